//! A force in space, one report with a number for each of X, Y and Z: an arm behind its maker's service
//! ([`haply`](crate::haply)).

use super::ForceCommand;
use super::single::{SingleDriver, SingleForce};
use crate::haply::{FORCE_BYTES, id, number};
use crate::usage::{Usage, desktop};

/// ms after which an unchanged force is told again, so that it does not end, and the least between two.
const KEEP_MS: f64 = 20.0;
const MIN_MS: f64 = 1.0;

/// The axes that feed and roll are by, where they can push.
#[derive(Clone, Debug)]
pub struct Along([Option<usize>; 2]);

/// Drives one: feed, and roll, push along the axes that they are by; what turns has no motor.
pub type Cartesian = SingleDriver<Along>;

impl Cartesian {
    /// Pushed along the axes of feed and roll; `None` where neither is one that can push.
    pub fn new(axes: [Option<Usage>; 2]) -> Option<Self> {
        let along = axes.map(|axis| [desktop::X, desktop::Y, desktop::Z].iter().position(|&of| Some(of) == axis));
        along.iter().any(Option::is_some).then(|| Self::by(Along(along), MIN_MS, Some(KEEP_MS), vec![0; FORCE_BYTES]))
    }
}

impl SingleForce for Along {
    const ID: u8 = id::FORCE;
    type Force = [f64; 3];

    fn force(&self, command: &ForceCommand) -> [f64; 3] {
        let (mut force, mut limit) = ([0.0; 3], 0.0_f64);
        for (along, of) in self.0.iter().zip(command) {
            if let Some(along) = along {
                force[*along] += of.force;
                limit = limit.max(of.limit);
            }
        }
        // The arm has one strength, whichever way it pushes.
        let length = libm::sqrt(force.iter().map(|part| part * part).sum());
        let scale = if length > limit { limit / length } else { 1.0 };
        force.map(|part| part * scale)
    }

    fn report(&self, force: [f64; 3]) -> Vec<u8> {
        force.into_iter().flat_map(|part| number(part).to_le_bytes()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::force::{AxisForce, ForceDriver as _, Reply, Request};

    #[test]
    fn feed_pushes_along_its_axis_within_its_limit_and_a_stop_ends_it() {
        let mut driver = Cartesian::new([Some(desktop::Z), Some(desktop::RX)]).unwrap();
        let of = |force, limit| AxisForce { force, coupling: None, limit };
        driver.command(&[of(-0.9, 0.4), of(0.7, 1.0)]);
        let sent = |z: i16| Some(Request::Send { id: 2, data: [[0; 4].as_slice(), &z.to_le_bytes()].concat() });
        assert_eq!(driver.next(0.0), sent(-13107));
        driver.reply(0.1, Reply::Done);
        assert_eq!(driver.next(10.0), None, "nothing has changed");
        assert_eq!(driver.next(20.0), sent(-13107), "or it would end");
        driver.reply(20.1, Reply::Done);
        driver.stop();
        assert_eq!(driver.next(20.2), sent(0));
        assert_eq!(driver.farewell().len(), 1);
    }

    #[test]
    fn feed_and_roll_together_push_no_more_than_either_may() {
        let of = |force| AxisForce { force, coupling: None, limit: 0.4 };
        let sent = |axes: [Usage; 2]| {
            let mut driver = Cartesian::new(axes.map(Some)).unwrap();
            driver.command(&[of(0.4), of(0.4)]);
            let Some(Request::Send { data, .. }) = driver.next(0.0) else { panic!() };
            let parts = data.chunks(2).map(|two| f64::from(i16::from_le_bytes([two[0], two[1]])) / 32767.0);
            parts.map(|part| part * part).sum::<f64>().sqrt()
        };
        for axes in [[desktop::X; 2], [desktop::X, desktop::Y]] {
            assert!((sent(axes) - 0.4).abs() < 1e-4, "{axes:?}");
        }
    }

    #[test]
    fn what_turns_has_no_motor() {
        assert!(Cartesian::new([Some(desktop::RX), None]).is_none());
    }
}
