//! A scan or a mask: what of it is the vessel, with a preview and a slice; and its slices behind the surface made of it.
//!
//! - `mode`: it as a mode of the window; `state`: what is chosen, what has come and what is on its way; `action`: what can be asked.
//! - `panel` with `histogram`: the controls; `view`: the preview and the slice.
//! - `slices`: the scan that is kept for its slices; `slices_panel`: the controls; `outline`: the surface's in a slice.
//!
//! The surface that is made is opened like any other ([`Source::Made`](crate::engine::Source)).

pub(super) mod action;
mod histogram;
mod mode;
pub(super) mod outline;
mod panel;
pub(super) mod slices;
mod slices_panel;
mod state;
#[cfg(test)]
mod tests;
mod view;

pub use self::action::{Action, SliceOptions};
pub(super) use self::mode::ScanPanel;
pub use self::slices::KeptScan;
pub use self::state::{OpenScan, Picture, Scans, Told};
