//! A scan or a mask, before there is a surface: what of it is the vessel, with a preview and a slice.
//!
//! - `state`: what is chosen, what has come and what is on its way; `action`: what can be asked.
//! - `panel` with `histogram`: the controls; `view`: the preview and the slice.
//!
//! The surface that is made is opened like any other ([`Source::Made`](crate::engine::Source)).

mod action;
mod histogram;
mod panel;
mod state;
#[cfg(test)]
mod tests;
mod view;

pub use self::action::Action;
pub(super) use self::panel::show as panel;
pub use self::state::{OpenScan, Picture, Scans, Told};
pub(super) use self::view::ScanView;
