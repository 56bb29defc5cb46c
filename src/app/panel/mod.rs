//! The panel: what is dragged, always in sight, and below it the method from top to bottom: each step folds, with a line
//! that says what it does, its few controls, and what experts alone change folded in it.

mod dock;
mod reduce;
mod result;
mod smooth;
mod steps;
mod surface;

pub(super) use self::dock::{dock, flat_dock};
pub(super) use self::result::result;
pub(super) use self::smooth::present_response;
pub(super) use self::steps::STEPS;
use super::action::Action;
use super::document::Document;
use super::state::State;
use crate::pipeline::report::Report;
use crate::pipeline::settings::{Settings, Target};
use crate::pipeline::verdict;

/// Asks for `settings`, if they are others than those of `state`.
fn set(settings: Settings, state: &State, asked: &mut Vec<Action>) {
    if settings != state.settings {
        asked.push(Action::Set(Box::new(settings)));
    }
}

/// The numbers of the level that is shown, or of the one before.
fn measured(document: Option<&Document>) -> Option<&Report> {
    Some(&document?.measured.as_ref()?.report)
}

/// How many triangles enter the reduction.
fn entering(state: &State) -> Option<usize> {
    Some(state.document.as_ref()?.levels.as_ref()?.1.triangles.len())
}

/// The target; where it is auto, the rate that it has come to, if that is known.
fn come_to(state: &State, target: Target) -> Target {
    let found = state.auto().filter(|_| target == Target::Auto);
    found.map_or(target, |found| verdict::rate(found.percent))
}
