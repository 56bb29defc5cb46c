//! FFBeast's wheels, joysticks and rudders: one report on their vendor's interface holds the force, and the device lets go
//! by itself where that does not come again (layout as in npm's `@shubham0x13/ffbeast-wheel-webhid-api` 0.1.1).

use super::ForceCommand;
use super::single::{SingleDriver, SingleForce};

/// The report's id.
pub const REPORT: u8 = 0xA3;
/// Its length without the id.
pub const BYTES: usize = 64;
/// What a force of 1 is.
const FULL_SCALE: f64 = 10_000.0;
/// The first byte: what follows takes the place of the effects that a game would play.
const OVERRIDE: u8 = 0x10;
/// ms after which an unchanged force is told again, so that the device does not let go, and the least between two.
const KEEP_MS: f64 = 20.0;
const MIN_MS: f64 = 2.0;

/// The report for a constant force of -1 to 1.
pub fn report(force: f64) -> Vec<u8> {
    let mut data = vec![0; BYTES];
    data[0] = OVERRIDE;
    let force = if force.is_nan() { 0.0 } else { force.clamp(-1.0, 1.0) };
    data[3..5].copy_from_slice(&((force * FULL_SCALE).round() as i16).to_le_bytes());
    data
}

/// Its only axis.
#[derive(Clone, Debug)]
pub struct Axis(usize);

/// Drives one: its only axis feeds, or rolls.
pub type Ffbeast = SingleDriver<Axis>;

impl Ffbeast {
    /// Moved by what is wished for feed, 0, or for roll, 1.
    pub fn new(axis: usize) -> Self {
        Self::by(Axis(axis.min(1)), MIN_MS, Some(KEEP_MS), report(0.0))
    }
}

impl SingleForce for Axis {
    const ID: u8 = REPORT;
    type Force = f64;

    fn force(&self, command: &ForceCommand) -> f64 {
        let of = command[self.0];
        of.force.clamp(-of.limit, of.limit)
    }

    fn report(&self, force: f64) -> Vec<u8> {
        report(force)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::force::{AxisForce, ForceDriver as _, Reply, Request};

    fn command(force: f64, limit: f64) -> ForceCommand {
        [AxisForce { force, coupling: None, limit }, AxisForce::default()]
    }

    #[test]
    fn the_report_is_as_the_published_one() {
        // setUint8(0, 0x10), setInt16(1, spring), setInt16(3, constant), setInt16(5, periodic), setUint8(7, drop): 64 bytes.
        let bytes = report(-0.5);
        assert_eq!((bytes.len(), &bytes[..8]), (64, &[0x10, 0, 0, 0x78, 0xEC, 0, 0, 0][..]));
        assert_eq!(report(7.0)[3..5], 10_000_i16.to_le_bytes());
    }

    #[test]
    fn it_is_told_again_and_stopped_at_once() {
        let mut driver = Ffbeast::new(0);
        assert_eq!(driver.next(0.0), None, "nothing was wished");
        driver.command(&command(0.8, 0.25));
        assert_eq!(driver.next(0.0), Some(Request::Send { id: 0xA3, data: report(0.25) }), "not beyond its limit");
        assert_eq!(driver.next(50.0), None, "one at a time");
        driver.reply(1.0, Reply::Done);
        assert_eq!(driver.next(10.0), None);
        assert!(driver.next(21.0).is_some());
        driver.reply(22.0, Reply::Done);
        driver.stop();
        assert_eq!(driver.next(22.1), Some(Request::Send { id: 0xA3, data: report(0.0) }));
        driver.reply(22.2, Reply::Failed);
        assert!(driver.next(22.3).is_some(), "a stop that failed comes again");
        driver.reply(22.4, Reply::Done);
        assert_eq!(driver.next(100.0), None);
    }
}
