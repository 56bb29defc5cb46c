//! An incremental encoder's two lines, a quarter of a period apart: four counts a period, up where A leads.
//!
//! The lines are sampled at a fixed rate, 16 samples a word. Between two samples the lines may move by one count; where both
//! have changed, nobody knows which way, and the place is no longer known.

/// Samples in a word.
pub const SAMPLES: u32 = 16;

/// What a word of samples says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Steps {
    /// Counts, up where A leads B.
    pub counts: i32,
    /// Times that both lines changed at once.
    pub missed: u32,
}

/// Counts an encoder's steps.
#[derive(Clone, Copy, Debug, Default)]
pub struct Decoder {
    /// The quarter of the period in which it was last, once it is known.
    quarter: Option<u32>,
}

impl Decoder {
    /// Counts the steps in a word of samples: the oldest in the highest bits, of each A in the lower bit and B in the higher.
    pub fn take(&mut self, word: u32) -> Steps {
        let mut steps = Steps::default();
        for sample in (0..SAMPLES).rev().map(|place| word >> (2 * place) & 3) {
            // The two lines are a Gray code of the quarter.
            let quarter = sample ^ (sample >> 1);
            match quarter.wrapping_sub(self.quarter.unwrap_or(quarter)) & 3 {
                0 => {}
                1 => steps.counts += 1,
                3 => steps.counts -= 1,
                _ => steps.missed += 1,
            }
            self.quarter = Some(quarter);
        }
        steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A period with A ahead, as (A, B) in any encoder's data sheet: 00, 10, 11, 01.
    const PERIOD: [u32; 4] = [0b00, 0b01, 0b11, 0b10];

    fn word(samples: impl Iterator<Item = u32>) -> u32 {
        samples.fold(0, |word, sample| word << 2 | sample)
    }

    fn taken(decoder: &mut Decoder, word: u32) -> (i32, u32) {
        let steps = decoder.take(word);
        (steps.counts, steps.missed)
    }

    #[test]
    fn a_period_is_four_counts_up_where_a_leads_and_down_where_b_does() {
        let mut decoder = Decoder::default();
        let up = word(PERIOD.into_iter().cycle().take(16));
        assert_eq!(taken(&mut decoder, up), (15, 0), "the first sample is where it begins");
        assert_eq!(taken(&mut decoder, up), (16, 0));
        let down = word(PERIOD.into_iter().rev().cycle().take(16));
        assert_eq!(taken(&mut decoder, down), (-15, 0), "it stood where this begins");
    }

    #[test]
    fn what_bounces_on_one_line_counts_for_nothing() {
        let mut decoder = Decoder::default();
        assert_eq!(taken(&mut decoder, word([0b00, 0b01].into_iter().cycle().take(16))), (1, 0));
        assert_eq!(taken(&mut decoder, 0), (-1, 0));
    }

    #[test]
    fn two_lines_at_once_are_told() {
        let mut decoder = Decoder::default();
        assert_eq!(taken(&mut decoder, 0), (0, 0));
        assert_eq!(taken(&mut decoder, u32::MAX), (0, 1));
    }
}
