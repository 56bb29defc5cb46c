//! What can be asked of a scan.

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
    /// Make the surface, and open it.
    Make,
    /// Stop what is being made.
    Cancel,
    /// Leave the scan.
    Close,
}
