//! What can be asked of measuring.

use super::clip::Clip;
use super::subject::Picked;
use super::tool::Tool;

/// What can be asked of measuring.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Show or hide it.
    Toggle,
    /// Take up a tool, from its first place; or lay it down.
    Take(Option<Tool>),
    /// Measure at a place of the surface.
    Place(Picked),
    /// Call a measure so.
    Rename(usize, String),
    /// Delete a measure.
    Delete(usize),
    /// Look at a measure.
    Look(usize),
    /// Leave out what lies before this plane.
    Clip(Option<Clip>),
    /// Show the measures in the views, or not.
    Mark(bool),
}
