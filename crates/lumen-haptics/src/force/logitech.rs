//! Logitech's wheels in their own mode: commands of seven bytes (as in npm's `logitech-g29` 2.0.0 and on
//! wiibrew.org/wiki/Logitech_USB_steering_wheel).
//!
//! A wheel plays its last command until another comes, without end. So it is given no force that could move it once the
//! host is silent, but friction in proportion to the force: that resists a hand, and cannot push.

use super::ForceCommand;
use super::single::{SingleDriver, SingleForce};

/// A command's length; it has no id.
pub const BYTES: usize = 7;
/// No centring by the wheel itself.
const NO_CENTRING: [u8; BYTES] = [0xF5, 0, 0, 0, 0, 0, 0];
/// All effects end.
const OFF: [u8; BYTES] = [0xF3, 0, 0, 0, 0, 0, 0];
/// The strongest friction.
const MAX_FRICTION: f64 = 7.0;
const MIN_MS: f64 = 4.0;

/// The command for friction of 0 to 1 in both directions: into the second slot, and played.
pub fn friction(part: f64) -> [u8; BYTES] {
    let strength = if part.is_nan() { 0 } else { (part.clamp(0.0, 1.0) * MAX_FRICTION).round() as u8 };
    if strength == 0 { [0x20, 0, 0, 0, 0, 0, 0] } else { [0x21, 0x02, strength, 0, strength, 0, 0] }
}

/// Its only axis, and whether its own centring is off.
#[derive(Clone, Debug)]
pub struct Wheel {
    axis: usize,
    is_prepared: bool,
}

/// Drives one: its only axis feeds, or rolls.
pub type Logitech = SingleDriver<Wheel>;

impl Logitech {
    /// Braked by what is wished for feed, 0, or for roll, 1.
    pub fn new(axis: usize) -> Self {
        Self::by(Wheel { axis: axis.min(1), is_prepared: false }, MIN_MS, None, OFF.to_vec())
    }
}

impl SingleForce for Wheel {
    const ID: u8 = 0;
    type Force = f64;

    fn force(&self, command: &ForceCommand) -> f64 {
        let of = command[self.axis];
        of.force.abs().min(of.limit)
    }

    fn report(&self, force: f64) -> Vec<u8> {
        if self.is_prepared { friction(force) } else { NO_CENTRING }.to_vec()
    }

    fn arrived(&mut self, report: &[u8]) {
        self.is_prepared |= report == NO_CENTRING;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::force::{AxisForce, ForceDriver as _, Reply, Request};

    #[test]
    fn commands_are_the_published_ones() {
        // forceFriction(1): 21 02 07 00 07 00 00; forceFriction(0): slot 2 off, 20 and zeros; autoCenter off: f5; all off: f3.
        assert_eq!(friction(1.0), [0x21, 0x02, 0x07, 0x00, 0x07, 0x00, 0x00]);
        assert_eq!(friction(0.0), [0x20, 0, 0, 0, 0, 0, 0]);
        assert_eq!(friction(f64::NAN), friction(-1.0));
    }

    #[test]
    fn a_force_of_either_sign_brakes_and_a_stop_ends_it() {
        let mut driver = Logitech::new(1);
        let command = |force| [AxisForce::default(), AxisForce { force, coupling: None, limit: 0.6 }];
        let mut sent = Vec::new();
        let mut turn = |driver: &mut Logitech, now| {
            if let Some(Request::Send { data, .. }) = driver.next(now) {
                sent.push(data);
                driver.reply(now, Reply::Done);
            }
        };
        turn(&mut driver, 0.0);
        driver.command(&command(-0.9));
        turn(&mut driver, 1.0);
        turn(&mut driver, 6.0);
        turn(&mut driver, 12.0);
        driver.stop();
        turn(&mut driver, 12.1);
        turn(&mut driver, 20.0);
        assert_eq!(sent, [NO_CENTRING.to_vec(), friction(0.6).to_vec(), OFF.to_vec()]);
    }
}
