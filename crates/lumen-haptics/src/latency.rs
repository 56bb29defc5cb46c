//! How long from an input report to the output report that answers it: how often each tenth of a ms.

use serde::{Deserialize, Serialize};

/// Bins of 0.1 ms; longer ones are in the last.
const BINS: usize = 1000;
const BIN_MS: f64 = 0.1;

/// Times between two things, counted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Latency {
    bins: Vec<u32>,
    count: u32,
}

/// What is told of times: half, nineteen of twenty, and ninety-nine of a hundred are not longer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Percentiles {
    /// How many there were.
    pub count: u32,
    /// Half, in ms.
    pub p50_ms: f64,
    /// Nineteen of twenty.
    pub p95_ms: f64,
    /// Ninety-nine of a hundred.
    pub p99_ms: f64,
}

impl Default for Latency {
    fn default() -> Self {
        Self { bins: vec![0; BINS], count: 0 }
    }
}

impl Latency {
    /// Counts one; what is no time is left out.
    pub fn count(&mut self, ms: f64) {
        if ms >= 0.0 {
            // A time that fills its bin is in it: what is told is never too short.
            let bin = (libm::ceil(ms / BIN_MS - 1e-9) as usize).saturating_sub(1);
            self.bins[bin.min(BINS - 1)] += 1;
            self.count += 1;
        }
    }

    /// All, in short; upper ends of their bins, none above 100 ms.
    pub fn percentiles(&self) -> Percentiles {
        let at = |part: f64| {
            let (mut sum, enough) = (0_u64, libm::ceil(part * f64::from(self.count)) as u64);
            let reached = |&bin: &u32| {
                sum += u64::from(bin);
                sum >= enough.max(1)
            };
            self.bins.iter().position(reached).map_or(0.0, |bin| (bin + 1) as f64 * BIN_MS)
        };
        Percentiles { count: self.count, p50_ms: at(0.5), p95_ms: at(0.95), p99_ms: at(0.99) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_hundred_times_the_half_and_the_last_are_where_they_are() {
        let mut latency = Latency::default();
        assert_eq!(latency.percentiles(), Percentiles::default());
        (1..=100).for_each(|i| latency.count(f64::from(i) * 0.1));
        latency.count(f64::NAN);
        let Percentiles { count, p50_ms, p95_ms, p99_ms } = latency.percentiles();
        assert_eq!(count, 100);
        assert!((p50_ms - 5.0).abs() < 1e-9 && (p95_ms - 9.5).abs() < 1e-9 && (p99_ms - 9.9).abs() < 1e-9);
        latency.count(1e9);
        assert!(latency.percentiles().p99_ms <= 100.0);
    }
}
