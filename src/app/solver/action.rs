//! What is asked of the step that makes a level ready for a solver.

use super::preparation::Shown;
use crate::prepare::prepare::Plan;
use crate::prepare::write::SolverFormat;

/// What the user asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Go over to this plan.
    Set(Plan),
    /// Make the level that is shown ready.
    Prepare,
    /// Show what was made, or the cuts, or the level again.
    Show(Option<Shown>),
    /// Call a patch something else: its place, and its name.
    Rename(usize, String),
    /// Save what was made.
    Save(SolverFormat),
}
