//! Colours as a theme writes them, and their contrast as WCAG 2.2 measures it.

/// A colour in sRGB, gamma-encoded, 0-255 each for red, green and blue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Colour(pub [u8; 3]);

impl Colour {
    /// The colour of a hexadecimal number: `0xRRGGBB`.
    pub const fn hex(rgb: u32) -> Self {
        let [_, r, g, b] = rgb.to_be_bytes();
        Self([r, g, b])
    }

    /// In linear light, 0-1 (IEC 61966-2-1).
    pub fn linear(self) -> [f32; 3] {
        self.0.map(|byte| {
            let c = f32::from(byte) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { libm::powf((c + 0.055) / 1.055, 2.4) }
        })
    }

    /// Relative luminance, 0 (black) to 1 (white).
    pub fn luminance(self) -> f32 {
        let [r, g, b] = self.linear();
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }
}

/// The contrast of two colours, 1 (none) to 21 (black on white): WCAG 2.2, "contrast ratio".
pub fn contrast(a: Colour, b: Colour) -> f32 {
    let (a, b) = (a.luminance(), b.luminance());
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contrasts_are_those_of_wcag() {
        let white = Colour::hex(0xFF_FF_FF);
        assert!((contrast(Colour::hex(0), white) - 21.0).abs() < 1e-4);
        assert!((contrast(white, white) - 1.0).abs() < 1e-6);
        // The grey that is known as the lightest with 4.5 : 1 on white.
        assert!((contrast(Colour::hex(0x76_76_76), white) - 4.54).abs() < 0.005);
        assert!((contrast(Colour::hex(0xFF_00_00), white) - 4.0).abs() < 0.005);
    }

    #[test]
    fn linear_light_is_that_of_srgb() {
        let [r, g, b] = Colour::hex(0xFF_80_00).linear();
        assert_eq!((r, b), (1.0, 0.0));
        assert!((g - 0.215_86).abs() < 1e-5);
    }
}
