//! The whole device, a ms at a time: what its encoders and switches say, what the host has said, what its motors do.
//!
//! A motor is on only while the host talks and has switched it on, the USB is awake, the motors have their supply, the driver
//! has no fault and both places are known. What ends the force from outside also forgets the effects: it does not come back
//! by itself.

use crate::axis::Axis;
use crate::effects::{Effects, Motion, Refusal};
use crate::feeder::id;
use crate::quadrature::Steps;
use crate::turn::{Line, Turn};

/// Counts of an encoder of 1000 lines on a friction wheel of 20 mm for 50 mm of wire: 4000 x 50 / (20 pi).
pub const FEED_HALF_WAY: i32 = 3183;
/// Counts of an encoder of 1000 lines for a turn.
pub const ROLL_HALF_WAY: i32 = 4000;

/// What the board sees in a ms.
#[derive(Clone, Copy, Debug, Default)]
pub struct Seen {
    /// What the encoders of feed and roll have done.
    pub steps: [Steps; 2],
    /// Whether the clutch is pressed.
    pub is_clutched: bool,
    /// Whether the button that makes here the middle is pressed.
    pub is_centred: bool,
    /// Whether the motors have their supply; the stop switch takes it from them.
    pub has_power: bool,
    /// Whether the driver says that it is too hot, or shorted.
    pub is_faulty: bool,
}

/// The device.
#[derive(Clone, Copy, Debug)]
pub struct Device {
    effects: Effects,
    axes: [Axis; 2],
    seen: Seen,
    /// Whether an encoder was too fast to be followed since the middle was last set.
    is_lost: bool,
    turn: Turn,
}

impl Default for Device {
    fn default() -> Self {
        Self::new()
    }
}

impl Device {
    /// In the middle of both ways, with the motors off.
    pub const fn new() -> Self {
        let none = Steps { counts: 0, missed: 0 };
        Self {
            effects: Effects::new(),
            axes: [Axis::new(FEED_HALF_WAY), Axis::new(ROLL_HALF_WAY)],
            seen: Seen { steps: [none; 2], is_clutched: false, is_centred: false, has_power: false, is_faulty: false },
            is_lost: false,
            turn: Turn::new(),
        }
    }

    /// Lets a ms pass. Returns the force on feed and roll as parts of the greatest, -1 to 1.
    pub fn advance(&mut self, seen: &Seen) -> [f32; 2] {
        self.seen = *seen;
        self.turn.advance();
        for (axis, steps) in self.axes.iter_mut().zip(&seen.steps) {
            axis.advance(steps.counts);
            self.is_lost |= steps.missed > 0;
        }
        // With the clutch held the host does not follow, and without motors no spring jumps.
        if seen.is_centred && seen.is_clutched && !self.effects.are_motors_on() {
            self.axes.iter_mut().for_each(Axis::centre);
            self.is_lost = false;
        }
        if !self.may_push() {
            self.effects.forget();
        }
        let motions = self.axes.each_ref().map(|axis| Motion { part: axis.part(), part_per_s: axis.part_per_s() });
        self.effects.advance(&motions)
    }

    /// The USB was reset, put to sleep or unplugged: no force, and nothing that was told counts any more.
    pub fn release(&mut self) {
        self.effects.forget();
        self.turn = Turn::new();
    }

    /// A report has come by `line`: whether it is this line's turn, and the report is to be taken. Where the other had it, what
    /// that has told is forgotten.
    pub fn hears(&mut self, line: Line) -> bool {
        let heard = self.turn.take(line);
        if heard.is_another() {
            self.effects.forget();
        }
        heard.is_taken()
    }

    /// The host at the end of `line` has left: no force, where it was its own.
    pub fn leaves(&mut self, line: Line) {
        if self.turn.is_of(line) {
            self.release();
        }
    }

    /// Takes an output report, without its id.
    ///
    /// # Errors
    /// As for [`Effects::take`].
    pub fn take(&mut self, id: u8, data: &[u8]) -> Result<(), Refusal> {
        self.effects.take(id, data)
    }

    /// Takes a feature report, without its id.
    ///
    /// # Errors
    /// As for [`Effects::take_feature`].
    pub fn take_feature(&mut self, id: u8, data: &[u8]) -> Result<(), Refusal> {
        self.effects.take_feature(id, data)
    }

    /// A feature report that can be got, with its id.
    pub fn feature(&self, id: u8) -> Option<[u8; 5]> {
        self.effects.feature(id).map(|[a, b, c, d]| [id, a, b, c, d])
    }

    /// The input report of the ms, with its id: buttons, feed, roll.
    pub fn state(&self) -> [u8; 6] {
        let buttons = u8::from(self.seen.is_clutched) | u8::from(self.seen.is_centred) << 1;
        let [feed, roll] = self.axes.each_ref().map(|axis| axis.reported().to_le_bytes());
        [id::STATE, buttons, feed[0], feed[1], roll[0], roll[1]]
    }

    /// The input report to send when it changes, with its id: paused, actuators on, safety switch, power, playing. The safety
    /// switch is on where nothing keeps the motors from pushing.
    pub fn playing(&self) -> [u8; 2] {
        let effects = &self.effects;
        let bits =
            [effects.is_paused(), effects.are_motors_on(), self.may_push(), self.seen.has_power, effects.is_playing()];
        [id::PLAYING, bits.into_iter().rev().fold(0, |bits, bit| bits << 1 | u8::from(bit))]
    }

    fn may_push(&self) -> bool {
        self.seen.has_power && !self.seen.is_faulty && !self.is_lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WELL: Seen = Seen {
        steps: [Steps { counts: 0, missed: 0 }; 2],
        is_clutched: false,
        is_centred: false,
        has_power: true,
        is_faulty: false,
    };

    /// A device that pushes with half its force along the feed, for as long as the host talks.
    fn pushing() -> Device {
        let mut device = Device::new();
        device.advance(&WELL);
        device.take(id::CONTROL, &[4]).unwrap();
        device.take(id::CONTROL, &[1]).unwrap();
        device.take_feature(id::CREATE, &[1, 0, 0]).unwrap();
        assert_eq!(device.feature(id::LOAD), Some([id::LOAD, 1, 1, 0, 0]));
        device.take(id::EFFECT, &[1, 1, 0, 0, 255, 0, 1, 0, 0]).unwrap();
        device.take(id::CONSTANT, &[1, 0xFF, 0x3F]).unwrap();
        device.take(id::OPERATION, &[1, 1, 1]).unwrap();
        assert!((device.advance(&WELL)[0] - 0.5).abs() < 1e-4);
        device
    }

    #[test]
    fn a_wheel_of_20_mm_goes_the_way_that_the_descriptor_says() {
        let [feed, roll] = crate::feeder::HALF_WAY;
        let mm_a_count = 20.0 * core::f64::consts::PI / 4000.0;
        assert!((f64::from(FEED_HALF_WAY) * mm_a_count - feed).abs() < mm_a_count);
        assert!((f64::from(ROLL_HALF_WAY) / 4000.0 * core::f64::consts::TAU - roll).abs() < 1e-9);
    }

    #[test]
    fn what_stands_in_the_reports() {
        let mut device = pushing();
        assert_eq!(device.playing(), [2, 0b11110]);
        let mut seen = WELL;
        seen.is_clutched = true;
        seen.steps = [Steps { counts: FEED_HALF_WAY, missed: 0 }, Steps { counts: -ROLL_HALF_WAY, missed: 0 }];
        device.advance(&seen);
        // 32767 is 50 mm, -32767 a turn back.
        assert_eq!(device.state(), [1, 1, 0xFF, 0x7F, 0x01, 0x80]);
    }

    #[test]
    fn what_ends_the_force_forgets_the_effects() {
        let lost = [Steps { counts: 0, missed: 1 }, Steps::default()];
        for ended in [Seen { has_power: false, ..WELL }, Seen { is_faulty: true, ..WELL }, Seen { steps: lost, ..WELL }]
        {
            let mut device = pushing();
            assert_eq!(device.advance(&ended), [0.0; 2], "{ended:?}");
            assert_eq!(device.advance(&WELL), [0.0; 2], "{ended:?}");
            assert!(device.take(id::OPERATION, &[1, 1, 1]).is_err(), "{ended:?}: there is no effect any more");
        }
        let mut device = pushing();
        device.release();
        assert_eq!(device.advance(&WELL), [0.0; 2]);
        assert_eq!(device.playing(), [2, 0b01100]);
    }

    #[test]
    fn a_place_that_was_lost_is_found_by_setting_the_middle() {
        let mut device = pushing();
        device.advance(&Seen { steps: [Steps { counts: 7, missed: 1 }, Steps::default()], ..WELL });
        assert_eq!(device.playing()[1] & 0b100, 0);
        device.advance(&Seen { is_centred: true, ..WELL });
        assert_eq!(device.playing()[1] & 0b100, 0, "the clutch was not held");
        device.advance(&Seen { is_centred: true, is_clutched: true, ..WELL });
        assert_eq!(device.playing()[1] & 0b100, 0b100);
        assert_eq!(device.state(), [1, 3, 0, 0, 0, 0]);
    }

    #[test]
    fn one_host_is_heard_at_a_time_and_what_it_told_is_not_the_other_s() {
        let mut device = pushing();
        assert!(device.hears(Line::Hid));
        assert!(!device.hears(Line::Serial), "the other talks");
        device.leaves(Line::Serial);
        assert!(device.advance(&WELL)[0] > 0.4, "it is not the one that left");
        for ms in 1..crate::feeder::WATCHDOG_MS {
            assert!(!device.hears(Line::Serial), "{ms} ms");
            device.advance(&WELL);
        }
        assert!(device.hears(Line::Serial), "the other is silent");
        assert!(device.take(id::OPERATION, &[1, 1, 1]).is_err(), "its effects are not this one's");
        assert!(!device.hears(Line::Hid));
        let mut device = pushing();
        assert!(device.hears(Line::Serial));
        device.leaves(Line::Serial);
        assert_eq!(device.advance(&WELL), [0.0; 2]);
        assert!(device.hears(Line::Hid), "at once");
    }

    #[test]
    fn the_middle_stays_while_the_motors_are_on() {
        let mut device = pushing();
        device.advance(&Seen { steps: [Steps { counts: 100, missed: 0 }, Steps::default()], ..WELL });
        let before = device.state();
        device.advance(&Seen { is_centred: true, is_clutched: true, ..WELL });
        assert_eq!(device.state()[2..], before[2..]);
    }
}
