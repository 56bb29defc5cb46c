//! The window's content, the same on the desktop and in the browser. It knows no platform: [`Platform`] gives it
//! files and the line to the engine.
//!
//! - [`LumenApp`]: the app, frame by frame; [`Action`]: all that can be asked of it. [`LastingApp`]: it outlives the
//!   graphics device (`paint_guard`: and paints nothing with one that is gone).
//! - [`State`]: what the app knows and how it changes; [`document`] the surface that is open, [`history`] undo.
//! - `panel`, `numbers`, `bar`, `sheets`, `keys`: the controls; `row`, `control`, `response`, `icon` what they are made of,
//!   `assist` what assistive tools are told of them, `theme` the look.
//! - `sharing`: settings as a file and in a link; `recovery`: what comes back after a reload.
//! - [`compare`]: several settings side by side, in the window or as a figure.
//! - [`trial`]: the guidewire trial.
//! - [`scan`]: a scan or a mask, before there is a surface.
//! - [`vessels`]: what became of the calibre of each vessel.
//! - `views`: the two 3-D views; `scene` what stands in GPU memory, `window_texture` what of it the window shows,
//!   `overlay` what is written over them.

mod action;
mod arrays;
mod assist;
mod axes;
mod bar;
pub mod compare;
mod control;
pub mod document;
pub mod history;
mod icon;
mod keys;
mod lasting;
mod lumen_app;
mod numbers;
mod overlay;
mod paint_guard;
mod panel;
mod platform;
mod recovery;
mod response;
mod reveal;
mod row;
pub mod scan;
mod scene;
mod sharing;
mod sheets;
mod state;
mod theme;
pub mod trial;
mod verdict;
pub mod vessels;
mod views;
mod window_texture;

pub use self::action::Action;
pub use self::lasting::{LastingApp, OnEnd, Restarts};
pub use self::lumen_app::LumenApp;
pub use self::platform::{Devices, Gamepad, Listing, Offer, Platform, PlatformEvent, Store, Waker};
pub use self::reveal::Reveal;
pub use self::sheets::Sheet;
pub use self::state::{Effect, Notice, State};
pub use self::views::{Colours, ViewOptions, Views};
