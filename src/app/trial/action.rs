//! What is asked of a trial: by a button, a key or a click on the vessel.

use crate::haptics::service::DeviceCommand;
use crate::mesh::Vec3;
use crate::trial::setup::Setup;

/// What the user asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Begin: with the level that is shown.
    Start,
    /// Adapt the smoothing to the calibre, so that thin vessels stay open, and begin with the level that this makes.
    AdaptSmoothing,
    /// Begin again; anew where the level or the setup have changed.
    Restart,
    /// Steer by itself, or no longer.
    Autopilot,
    /// Stand still, or go on.
    Pause,
    /// Slow motion, or no longer.
    Slow,
    /// A second back.
    StepBack,
    /// The log as files.
    Save,
    /// Replay what a chosen log holds.
    OpenLog,
    /// Compare with the surface that was not reduced.
    Compare,
    /// Compare no more.
    CancelComparison,
    /// Back to the surface.
    Close,
    /// Another wire, place or seed, for the next beginning.
    Set(Box<Setup>),
    /// The next click on the vessel chooses this; `None`: nothing any more.
    Pick(Option<Pick>),
    /// Begin with this place, which was picked.
    Place(Pick, Vec3),
    /// Something of the fluoroscope.
    Arm(Arm),
    /// Something of the haptic device.
    Device(DeviceAsk),
    /// Show the paper's tables, and run what of them has not been run.
    Tables,
    /// Run them again.
    RepeatTables,
    /// Try many seeds at each of their rates, beside the unreduced surface.
    Sweep,
    /// Run them no further.
    CancelTables,
    /// Take the tables off; what runs goes on.
    CloseTables,
}

impl Action {
    /// Whether it tries something: what could not be done before it is no longer said.
    pub(super) fn is_attempt(&self) -> bool {
        match self {
            Self::Start
            | Self::AdaptSmoothing
            | Self::Restart
            | Self::Autopilot
            | Self::Pause
            | Self::Slow
            | Self::StepBack
            | Self::Save
            | Self::OpenLog
            | Self::Compare
            | Self::CancelComparison
            | Self::Close
            | Self::Tables => true,
            Self::Set(_)
            | Self::Pick(_)
            | Self::Place(..)
            | Self::Arm(_)
            | Self::Device(_)
            | Self::RepeatTables
            | Self::Sweep
            | Self::CancelTables
            | Self::CloseTables => false,
        }
    }
}

/// What the next click on the vessel chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pick {
    /// Where the wire enters.
    Entry,
    /// Where it should go.
    Target,
}

/// What is asked of the haptic device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DeviceAsk {
    /// List those that are there now.
    Look,
    /// Hold the wire by this one; by none.
    Choose(Option<usize>),
    /// Say what will move once its force is armed, or no longer.
    Confirm(bool),
    /// Remember no longer which of its axes feed and roll.
    Forget,
    /// Save how long it takes from report to report.
    SaveLatency,
    /// Something of the device itself.
    Command(DeviceCommand),
    /// Something of the gamepad's motors; [`DeviceCommand::Halt`] ends both.
    Rumble(RumbleAsk),
    /// A tone in place of a force, or none.
    Sound(bool),
}

/// What is asked of a gamepad's motors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RumbleAsk {
    /// Say what will shake once it is armed, or no longer.
    Confirm(bool),
    /// Let it shake.
    Arm,
}

/// What is asked of the fluoroscope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Arm {
    /// The beam on, or off.
    Pedal,
    /// A puff of contrast, at this second of the window's clock.
    Contrast(f64),
    /// Whether the lumen is shown over the picture.
    Roadmap(bool),
    /// The detector to so many degrees LAO and CRAN.
    Look(f32, f32),
    /// So many pulses a second.
    Rate(f32),
    /// The fluoroscopy as the large picture with the others over it, or side by side again.
    Enlarge,
}
