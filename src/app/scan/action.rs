//! What can be asked of a scan, and which of its slices are shown behind the surface.

use crate::volume::{Axis, Method, Region, Selection};

/// What can be asked of a scan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Another volume of its files, by its number.
    Volume(usize),
    /// What of it is the vessel.
    Select(Selection),
    /// Only what is connected to this voxel, if one is given; where values are those of a scan, with the threshold around it.
    Seed(Option<[usize; 3]>),
    /// How the surface is made.
    Method(Method),
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

/// Which slices are shown, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SliceOptions {
    /// Across each axis of the grid: whether one is shown, and which, from 0.
    pub planes: [(bool, usize); 3],
    /// The values that are black and white.
    pub window: [f64; 2],
    /// Whether the outline of the surface is drawn in them.
    pub has_outline: bool,
}
