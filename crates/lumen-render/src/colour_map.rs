//! Viridis: from a number to a colour that is perceptually even, readable in grey and safe for colour-blind
//! eyes (van der Walt and Smith 2015, released under CC0).

use super::Colour;

/// How scalars on a surface become colours: `range.0` takes the first colour, `range.1` the last; beyond them
/// the colours stay. A range without a width puts everything at or below it to the first. Where a scalar is more than
/// [`UNKNOWN`](Self::UNKNOWN) the surface has its own colour, or that of [`Style::unknown`](super::Style::unknown).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ColourMap {
    /// Scalars of the first and the last colour.
    pub range: (f32, f32),
}

impl ColourMap {
    /// What is more stands for no number. The shader knows it too.
    pub const UNKNOWN: f32 = 1e6;
}

/// The map's colours, from the least to the largest.
pub const VIRIDIS: [Colour; 256] = {
    let mut colours = [Colour([0; 3]); 256];
    let mut i = 0;
    while i < 256 {
        colours[i] = Colour::hex(HEX[i]);
        i += 1;
    }
    colours
};

/// The colour at `t`, 0 (least) to 1 (largest), between the two nearest of the table: what a legend shows. The same
/// as the shader's, to its rounding. Not-a-number takes the first colour.
pub fn viridis(t: f32) -> Colour {
    between(&VIRIDIS, t)
}

fn between(table: &[Colour], t: f32) -> Colour {
    let last = table.len() - 1;
    let at = if t > 0.0 { t.min(1.0) * last as f32 } else { 0.0 };
    let i = (at as usize).min(last - 1);
    let fraction = at - i as f32;
    let (low, high) = (table[i].0, table[i + 1].0);
    Colour(std::array::from_fn(|k| {
        let (low, high) = (f32::from(low[k]), f32::from(high[k]));
        (low + (high - low) * fraction).round() as u8
    }))
}

/// From blue over white to red, even to either side and safe for colour-blind eyes: the eleven classes RdBu of ColorBrewer
/// (Harrower and Brewer 2003, Apache 2.0), from the last to the first.
const BLUE_RED: [Colour; 11] = [
    Colour::hex(0x05_30_61),
    Colour::hex(0x21_66_AC),
    Colour::hex(0x43_93_C3),
    Colour::hex(0x92_C5_DE),
    Colour::hex(0xD1_E5_F0),
    Colour::hex(0xF7_F7_F7),
    Colour::hex(0xFD_DB_C7),
    Colour::hex(0xF4_A5_82),
    Colour::hex(0xD6_60_4D),
    Colour::hex(0xB2_18_2B),
    Colour::hex(0x67_00_1F),
];

/// The colour of the diverging map at `t`, 0 (blue) to 1 (red), white at 0.5. Not-a-number takes the first.
pub fn diverging(t: f32) -> Colour {
    between(&BLUE_RED, t)
}

/// Colours that stay apart to every kind of colour vision (Okabe and Ito 2008), without black, and grey: those of labels.
pub const LABELS: [Colour; 8] = [
    Colour::hex(0x00_72_B2),
    Colour::hex(0xE6_9F_00),
    Colour::hex(0x00_9E_73),
    Colour::hex(0xCC_79_A7),
    Colour::hex(0x56_B4_E9),
    Colour::hex(0xD5_5E_00),
    Colour::hex(0xF0_E4_42),
    Colour::hex(0x99_99_99),
];

/// The colour of label number `n`: after eight they begin again.
pub fn label_colour(n: usize) -> Colour {
    LABELS[n % LABELS.len()]
}

const HEX: [u32; 256] = [
    0x440154, 0x440256, 0x450457, 0x450559, 0x46075A, 0x46085C, 0x460A5D, 0x460B5E, 0x470D60, 0x470E61, 0x471063,
    0x471164, 0x471365, 0x481467, 0x481668, 0x481769, 0x48186A, 0x481A6C, 0x481B6D, 0x481C6E, 0x481D6F, 0x481F70,
    0x482071, 0x482173, 0x482374, 0x482475, 0x482576, 0x482677, 0x482878, 0x482979, 0x472A7A, 0x472C7A, 0x472D7B,
    0x472E7C, 0x472F7D, 0x46307E, 0x46327E, 0x46337F, 0x463480, 0x453581, 0x453781, 0x453882, 0x443983, 0x443A83,
    0x443B84, 0x433D84, 0x433E85, 0x423F85, 0x424086, 0x424186, 0x414287, 0x414487, 0x404588, 0x404688, 0x3F4788,
    0x3F4889, 0x3E4989, 0x3E4A89, 0x3E4C8A, 0x3D4D8A, 0x3D4E8A, 0x3C4F8A, 0x3C508B, 0x3B518B, 0x3B528B, 0x3A538B,
    0x3A548C, 0x39558C, 0x39568C, 0x38588C, 0x38598C, 0x375A8C, 0x375B8D, 0x365C8D, 0x365D8D, 0x355E8D, 0x355F8D,
    0x34608D, 0x34618D, 0x33628D, 0x33638D, 0x32648E, 0x32658E, 0x31668E, 0x31678E, 0x31688E, 0x30698E, 0x306A8E,
    0x2F6B8E, 0x2F6C8E, 0x2E6D8E, 0x2E6E8E, 0x2E6F8E, 0x2D708E, 0x2D718E, 0x2C718E, 0x2C728E, 0x2C738E, 0x2B748E,
    0x2B758E, 0x2A768E, 0x2A778E, 0x2A788E, 0x29798E, 0x297A8E, 0x297B8E, 0x287C8E, 0x287D8E, 0x277E8E, 0x277F8E,
    0x27808E, 0x26818E, 0x26828E, 0x26828E, 0x25838E, 0x25848E, 0x25858E, 0x24868E, 0x24878E, 0x23888E, 0x23898E,
    0x238A8D, 0x228B8D, 0x228C8D, 0x228D8D, 0x218E8D, 0x218F8D, 0x21908D, 0x21918C, 0x20928C, 0x20928C, 0x20938C,
    0x1F948C, 0x1F958B, 0x1F968B, 0x1F978B, 0x1F988B, 0x1F998A, 0x1F9A8A, 0x1E9B8A, 0x1E9C89, 0x1E9D89, 0x1F9E89,
    0x1F9F88, 0x1FA088, 0x1FA188, 0x1FA187, 0x1FA287, 0x20A386, 0x20A486, 0x21A585, 0x21A685, 0x22A785, 0x22A884,
    0x23A983, 0x24AA83, 0x25AB82, 0x25AC82, 0x26AD81, 0x27AD81, 0x28AE80, 0x29AF7F, 0x2AB07F, 0x2CB17E, 0x2DB27D,
    0x2EB37C, 0x2FB47C, 0x31B57B, 0x32B67A, 0x34B679, 0x35B779, 0x37B878, 0x38B977, 0x3ABA76, 0x3BBB75, 0x3DBC74,
    0x3FBC73, 0x40BD72, 0x42BE71, 0x44BF70, 0x46C06F, 0x48C16E, 0x4AC16D, 0x4CC26C, 0x4EC36B, 0x50C46A, 0x52C569,
    0x54C568, 0x56C667, 0x58C765, 0x5AC864, 0x5CC863, 0x5EC962, 0x60CA60, 0x63CB5F, 0x65CB5E, 0x67CC5C, 0x69CD5B,
    0x6CCD5A, 0x6ECE58, 0x70CF57, 0x73D056, 0x75D054, 0x77D153, 0x7AD151, 0x7CD250, 0x7FD34E, 0x81D34D, 0x84D44B,
    0x86D549, 0x89D548, 0x8BD646, 0x8ED645, 0x90D743, 0x93D741, 0x95D840, 0x98D83E, 0x9BD93C, 0x9DD93B, 0xA0DA39,
    0xA2DA37, 0xA5DB36, 0xA8DB34, 0xAADC32, 0xADDC30, 0xB0DD2F, 0xB2DD2D, 0xB5DE2B, 0xB8DE29, 0xBADE28, 0xBDDF26,
    0xC0DF25, 0xC2DF23, 0xC5E021, 0xC8E020, 0xCAE11F, 0xCDE11D, 0xD0E11C, 0xD2E21B, 0xD5E21A, 0xD8E219, 0xDAE319,
    0xDDE318, 0xDFE318, 0xE2E418, 0xE5E419, 0xE7E419, 0xEAE51A, 0xECE51B, 0xEFE51C, 0xF1E51D, 0xF4E61E, 0xF6E620,
    0xF8E621, 0xFBE723, 0xFDE725,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_and_middle_are_the_published_ones() {
        assert_eq!(viridis(0.0), Colour::hex(0x44_01_54));
        assert_eq!(viridis(1.0), Colour::hex(0xFD_E7_25));
        assert_eq!(viridis(128.0 / 255.0), Colour([33, 145, 140]));
        assert_eq!(viridis(-3.0), viridis(0.0));
        assert_eq!(viridis(f32::INFINITY), viridis(1.0));
        assert_eq!(viridis(f32::NAN), viridis(0.0));
    }

    #[test]
    fn the_diverging_map_is_white_in_the_middle_and_as_dark_at_both_ends() {
        assert_eq!(diverging(0.5), Colour::hex(0xF7_F7_F7));
        assert_eq!((diverging(0.0), diverging(1.0)), (Colour::hex(0x05_30_61), Colour::hex(0x67_00_1F)));
        for i in 0..50 {
            let [near, far] = [0.5 - i as f32 * 0.01, 0.5 - (i + 1) as f32 * 0.01];
            assert!(diverging(far).luminance() < diverging(near).luminance());
            assert!(diverging(1.0 - far).luminance() < diverging(1.0 - near).luminance());
        }
    }

    #[test]
    fn labels_next_to_each_other_stay_apart() {
        for n in 0..16 {
            assert_ne!(label_colour(n), label_colour(n + 1));
        }
        assert_eq!(label_colour(8), LABELS[0]);
    }

    #[test]
    fn lightness_grows_all_the_way() {
        assert!(VIRIDIS.windows(2).all(|pair| pair[1].luminance() > pair[0].luminance() - 1e-3));
        assert!(VIRIDIS[255].luminance() > 0.7 && VIRIDIS[0].luminance() < 0.03);
    }
}
