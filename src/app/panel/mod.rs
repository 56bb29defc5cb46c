//! The panel: the method from top to bottom, each step with its few controls, its result in numbers, and one line
//! that says what it does.

mod reduce;
mod result;
mod smooth;
mod steps;
mod surface;

pub(super) use self::reduce::peek;
pub(super) use self::result::result;
pub(super) use self::steps::STEPS;
use super::action::Action;
use super::document::Document;
use super::state::State;
use crate::pipeline::report::Report;
use crate::pipeline::settings::Settings;

/// Height of what [`peek`] shows, in points.
pub(super) const PEEK: f32 = 132.0;

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
