//! The guidewire trial in the window.
//!
//! - [`Trial`]: what the app knows of it: `state` says what that is, `events` how it changes by what the engine says,
//!   `actions` by what the user asks for ([`Action`]). None of them draws. `mode`: it as a mode of the window.
//! - `panel`, `setup`, `fluoroscope`, `readout`, `outcome`: the controls and the numbers; `drive`: the hand on the wire; `device`: a haptic
//!   device's, `rumble` a gamepad's, `sound` a tone in place of either;
//!   `tables`: the paper's Tables III and IV and their sweep, `tables_window` and `sweep` what is seen of them.
//! - `view`, `marks`, `plate`: the three views and what is written over them; `scene`: what stands in GPU memory; `carm`,
//!   `peaks`, `largest`: the C-arm, the largest forces on the wall and of all.

pub(super) mod action;
mod actions;
mod carm;
mod device;
mod drive;
mod events;
mod fluoroscope;
mod largest;
mod marks;
mod mode;
mod outcome;
mod panel;
mod peaks;
mod plate;
mod readout;
mod rumble;
mod scene;
mod setup;
mod sound;
mod state;
mod sweep;
mod tables;
mod tables_window;
mod view;

#[cfg(test)]
mod device_tests;

pub use self::action::{Action, Arm, DeviceAsk, Pick, RumbleAsk};
pub use self::carm::CArm;
pub(super) use self::mode::TrialPanel;
pub use self::state::{Open, Preparing, Run, Session, Stage, Trial};
pub use self::tables::Tables;
