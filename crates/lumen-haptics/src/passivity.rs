//! How stiff a wall the host may render: sampled and held, a spring gives more than it took, and only what brakes on the
//! device takes that away again. It does while `b > K (T / 2 + d)`: K the stiffness, T the time between two forces, d how
//! late they come, b the device's own damping (Colgate & Schenkel, "Passivity of a class of sampled-data systems", Journal
//! of Robotic Systems 14, 1997). So a host that is slow renders softly.
//!
//! A spring that the device renders itself has its own T of a ms or less; only what exceeds it is the host's.

/// What every motor with its gear brakes at least: parts of the most force at half a way a second.
const BRAKES: f64 = 0.004;
/// How late a force comes beside the time for which it is held, in ms: an input report and an output report.
const LATE_MS: f64 = 3.0;
/// What resists less than this part of the most is nothing: a hold that was let go of dies away, and never is 0.
const NOTHING: f64 = 1e-6;
/// How fast a longest time between two forces is forgotten, in parts a force.
const FORGOTTEN: f64 = 0.002;

/// What part of a stiffness may be rendered along one axis.
#[derive(Clone, Copy, Debug)]
pub struct Softness {
    told_ms: Option<f64>,
    /// The longest time between two forces, slowly forgotten.
    longest_ms: f64,
    part: f64,
}

impl Default for Softness {
    fn default() -> Self {
        Self { told_ms: None, longest_ms: 0.0, part: 1.0 }
    }
}

impl Softness {
    /// The part, 0 to 1, of a force that may be told at `now_ms`. `slope` is by how much it grows along half of the axis's
    /// way, as a part of the most; `own` is as much of that as the device renders itself; `resists` is what resists now, as a
    /// part of the most: the part grows only while that is nothing to a hand, for a compressed spring that stiffens gives
    /// more than it took.
    pub fn part(&mut self, now_ms: f64, slope: f64, own: f64, resists: f64) -> f64 {
        if let Some(told) = self.told_ms.replace(now_ms) {
            let passed = (now_ms - told).max(0.0);
            self.longest_ms = passed.max(self.longest_ms * (1.0 - FORGOTTEN));
        }
        let held_s = (0.5 * self.longest_ms + LATE_MS) / 1000.0;
        let most = own.max(0.0) + BRAKES / held_s;
        let allowed = if slope > most { most / slope } else { 1.0 };
        self.part = if resists.abs() < NOTHING { allowed } else { allowed.min(self.part) };
        self.part
    }

    /// Nothing is rendered any more; how slow the host is stays known.
    pub fn release(&mut self) {
        (self.told_ms, self.part) = (None, 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slower_the_host_the_softer_the_wall() {
        // b = K (T / 2 + d): at 1 kHz 0.004 / 0.0035 = 1.14, at 60 Hz 0.004 / 0.01133 = 0.353.
        for (period, most) in [(1.0, 0.004 / 0.0035), (1000.0 / 60.0, 0.004 / (0.5 / 60.0 + 0.003))] {
            let mut softness = Softness::default();
            let part = (0..100).map(|i| softness.part(f64::from(i) * period, 4.0, 0.0, 0.0)).last().unwrap();
            assert!((part - most / 4.0).abs() < 1e-9, "{part}");
            assert_eq!(softness.part(100.0 * period, 4.0, 4.0, 0.0), 1.0, "the device's own");
        }
    }

    #[test]
    fn a_pressed_wall_does_not_harden() {
        let mut softness = Softness::default();
        (0..50).for_each(|i| _ = softness.part(f64::from(i), 4.0, 0.0, 0.0));
        let soft = softness.part(100.0, 4.0, 0.0, 0.1);
        assert!(soft < 0.2);
        (1..5000).for_each(|i| assert!(softness.part(100.0 + f64::from(i), 4.0, 0.0, 0.1) <= soft));
        assert!(softness.part(6000.0, 4.0, 0.0, 0.0) <= 0.5);
    }

    #[test]
    fn once_what_resists_has_died_away_the_part_is_that_of_the_host_again() {
        let mut softness = Softness::default();
        let before = (0..50).map(|i| softness.part(f64::from(i), 4.0, 0.0, 0.0)).last().unwrap();
        // A stall of half a second.
        let soft = softness.part(550.0, 4.0, 0.0, 0.1);
        assert!(soft < 0.1 * before);
        // The longest time is forgotten within seconds, and what is left of a hold never comes to 0.
        let after = (1..5000).map(|i| softness.part(550.0 + f64::from(i), 4.0, 0.0, 2e-50)).last().unwrap();
        assert!((after / before - 1.0).abs() < 0.01, "{after} after {before}");
    }
}
