//! How the distances of a deviation are spread: the samples of which the deviation gives mean, percentile and maximum,
//! counted in even bins, those inside the reference surface apart from those outside.

use serde::{Deserialize, Serialize};

/// Bins of each side.
const BINS: usize = 100;

/// Samples by their distance.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Histogram {
    /// Width of a bin in mm; 0 where no sample is away.
    pub width_mm: f64,
    /// Samples inside the reference surface, by their distance from it: the first bin begins at 0.
    pub inside: Vec<u32>,
    /// Samples outside, likewise.
    pub outside: Vec<u32>,
}

impl Histogram {
    /// Of signed distances, negative inside, none of which is more than `most` mm from 0.
    pub(super) fn new(signed: &[f32], most: f64) -> Self {
        let width_mm = most / BINS as f64;
        let (mut inside, mut outside) = (vec![0; BINS], vec![0; BINS]);
        for &distance in signed {
            let side = if distance.is_sign_negative() { &mut inside } else { &mut outside };
            let bin = if width_mm > 0.0 { (f64::from(distance.abs()) / width_mm) as usize } else { 0 };
            side[bin.min(BINS - 1)] += 1;
        }
        Self { width_mm, inside, outside }
    }

    /// The part of all samples that are farther than `mm`, 0 or more, in percent.
    pub fn percent_over(&self, mm: f64) -> f64 {
        let all = self.count();
        if all == 0.0 || self.width_mm <= 0.0 {
            return 0.0;
        }
        100.0 * (self.count_between(f64::NEG_INFINITY, -mm) + self.count_between(mm, f64::INFINITY)) / all
    }

    /// The samples from `from` to `to` mm, negative inside, as a part of all.
    pub fn part_between(&self, from: f64, to: f64) -> f64 {
        let all = self.count();
        if all == 0.0 { 0.0 } else { self.count_between(from, to) / all }
    }

    /// How many samples there are.
    fn count(&self) -> f64 {
        self.inside.iter().chain(&self.outside).map(|&count| f64::from(count)).sum()
    }

    /// How many there are from `from` to `to` mm, negative inside; within a bin they are taken to be spread evenly.
    fn count_between(&self, from: f64, to: f64) -> f64 {
        let width = self.width_mm.max(f64::MIN_POSITIVE);
        let share = |side: &[u32], from: f64, to: f64| -> f64 {
            let of = |(i, &count): (usize, &u32)| {
                let (low, high) = (i as f64, i as f64 + 1.0);
                f64::from(count) * ((to / width).min(high) - (from / width).max(low)).clamp(0.0, 1.0)
            };
            side.iter().enumerate().map(of).sum()
        };
        share(&self.outside, from.max(0.0), to) + share(&self.inside, (-to).max(0.0), -from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_those_of_an_even_spread() {
        let signed: Vec<f32> = (0..10_000).map(|i| i as f32 * 3e-4 - 1.0).collect();
        let found = Histogram::new(&signed, 2.0);
        assert_eq!(found.inside.iter().chain(&found.outside).sum::<u32>(), 10_000);
        // From -1 to 2 mm: a third is inside.
        assert!((f64::from(found.inside.iter().sum::<u32>()) / 10_000.0 - 1.0 / 3.0).abs() < 1e-3);
        for (mm, percent) in [(0.0, 100.0), (0.5, 200.0 / 3.0), (1.0, 100.0 / 3.0), (1.51, 49.0 / 3.0), (2.0, 0.0)] {
            assert!((found.percent_over(mm) - percent).abs() < 0.1, "{mm}: {}", found.percent_over(mm));
        }
        for (from, to, part) in [(-1.0, 2.0, 1.0), (-0.5, 0.25, 0.25), (-2.0, -0.4, 0.2), (0.5, 0.8, 0.1)] {
            assert!((found.part_between(from, to) - part).abs() < 2e-3, "{from} to {to}");
        }
    }

    #[test]
    fn where_nothing_is_away_nothing_is_over() {
        let found = Histogram::new(&[0.0, -0.0], 0.0);
        assert_eq!((found.percent_over(0.0), found.inside[0], found.outside[0]), (0.0, 1, 1));
        assert_eq!(Histogram::default().part_between(0.0, 1.0), 0.0);
    }
}
