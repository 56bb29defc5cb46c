//! The compare view: up to six settings of one surface under one camera, each with its numbers.
//!
//! - [`Comparison`]: which settings are compared and what the engine made of them; [`Action`]: what is asked of it.
//! - `difference`: how far the others are from the first.
//! - `words`: a setting in words, a result in numbers; `cell`: one setting drawn, as `arrangement` says; `scene`: what
//!   stands in GPU memory.
//! - `mode`: it as a mode of the window; `view`: the grid there, `bar` what stands around it; `figure`: the same cells off screen, as the paper's figures.

pub(super) mod action;
mod arrangement;
mod bar;
mod cell;
pub(super) mod comparison;
mod difference;
pub mod figure;
mod mode;
mod scene;
mod view;
mod words;

pub use self::action::Action;
pub use self::arrangement::Arrangement;
pub use self::comparison::{Cell, Comparison, MAX_COMPARED, Made, Outcome};
pub use self::difference::Difference;
pub(super) use self::scene::{CompareScene, Shot};
pub(super) use self::view::CompareView;
