//! What can be asked of a scan.

use super::SliceOptions;
use crate::volume::{Axis, Region, Selection};

/// What can be asked of a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// What of it is the vessel.
    Select(Selection),
    /// Look only here.
    Bound(Region),
    /// Show this slice.
    Slice(Axis, usize),
    /// Show slices with these values black and white.
    Window([f64; 2]),
    /// Keep the scan for its slices once there is a surface of it, or no longer.
    Keep(bool),
    /// Show these slices behind the surface.
    Slices(SliceOptions),
    /// Make the surface, and open it.
    Make,
    /// Stop what is being made.
    Cancel,
    /// Leave the scan.
    Close,
}
