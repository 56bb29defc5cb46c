//! What a hand holds and what answers it: gamepads, haptic devices, a tone.

use crate::haptics::service::{DeviceCommand, DeviceStatus};

/// Gamepads and haptic devices.
pub trait Hands {
    /// What the first gamepad that is plugged in does; `None` without one. The desktop has none: what reads them there
    /// needs a C library (libudev), and keys and pads on the screen do the same.
    fn gamepad(&self) -> Option<Gamepad> {
        None
    }

    /// Lets that gamepad shake with so much of its strength, 0 to 1, for [`SHAKE_MS`]; 0 ends it at once. Not called where
    /// none can.
    fn rumble(&mut self, _strength: f64) {}

    /// Haptic devices; `None` where the platform has none.
    fn devices(&mut self) -> Option<&mut dyn Devices> {
        None
    }
}

/// A tone in place of a force.
pub trait Sound {
    /// Whether it can sound: the desktop can where it finds a program that plays.
    fn has_sound(&self) -> bool {
        false
    }

    /// Sounds so for [`SHAKE_MS`], in place of what sounded before. Not called where it cannot.
    fn sound(&mut self, _tone: Tone) {}
}

/// The haptic devices that can be chosen.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// Their names.
    pub names: Vec<String>,
    /// Why the system lists no others, if so.
    pub problem: Option<String>,
    /// The one that is served.
    pub chosen: Option<usize>,
}

/// Haptic devices, of which one holds the wire.
pub trait Devices {
    /// Names of those that are there now, and why the system lists none, if so.
    fn look(&mut self) -> (Vec<String>, Option<String>);

    /// Those that can be chosen and which is, where that has changed by itself: one was plugged in, or has been paired.
    fn changed(&mut self) -> Option<Listing> {
        None
    }

    /// Serves one of those that were listed last, and none else; none at all for `None`.
    fn choose(&mut self, number: Option<usize>);

    /// Asks the one that is served for something.
    fn ask(&mut self, command: DeviceCommand);

    /// How the one that is served is; `None` where there is none.
    fn status(&self) -> Option<DeviceStatus>;
}

/// The state of a gamepad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gamepad {
    /// The left stick, forwards positive, -1 to 1: feed.
    pub feed: f32,
    /// The right stick, to the right positive, -1 to 1: roll.
    pub roll: f32,
    /// Whether a shoulder button is held: faster.
    pub fast: bool,
    /// Whether it has motors that can be told to shake it.
    pub can_rumble: bool,
}

/// A tone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tone {
    /// Its frequency, in Hz; above 0.
    pub pitch_hz: f64,
    /// Its amplitude as a part of the most that can be played, 0 (silent) to 1.
    pub loudness: f64,
}

/// For how long a gamepad shakes, and a tone sounds, that is not told again, in ms.
pub const SHAKE_MS: f64 = 100.0;

/// How fast a tone follows what it is told, and fades, in s: fast enough for a force, too slow to click.
pub const FOLLOW_S: f64 = 0.015;
