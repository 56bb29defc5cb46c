//! From the axes of a file to those of the patient, and what is said where a file does not name them.

use super::super::warnings::{ScanWarning, Warning};
use glam::{DMat3, DVec3};

/// Turns steps and an origin in RAS into LPS: right is left reversed, front is back reversed.
pub(super) fn ras_to_lps(steps: DMat3, origin: DVec3) -> (DMat3, DVec3) {
    let turn = DVec3::new(-1.0, -1.0, 1.0);
    (DMat3::from_diagonal(turn) * steps, turn * origin)
}

/// What is said of a file of `format` that does not name its axes.
pub(super) fn silent(format: &str) -> Warning {
    ScanWarning::Silent { format: format.to_owned() }.into()
}

/// The numbers between white space or any of `,()`; `None` where something else is between them.
pub(super) fn list(text: &str) -> Option<Vec<f64>> {
    let words = text.split(|c: char| c.is_ascii_whitespace() || ",()".contains(c)).filter(|word| !word.is_empty());
    words.map(|word| word.parse().ok()).collect()
}
