//! The steps, in their order.

use egui::Ui;

use super::{reduce, smooth, surface};
use crate::app::action::Action;
use crate::app::state::State;
use crate::app::views::Views;

/// A step of the method: shows its controls, and says what they ask for.
pub(in crate::app) type Step = fn(&mut Ui, &State, &Views, &mut Vec<Action>);

/// The steps that lead to a level, each with an identity of its own: what comes and goes in one must not take the focus
/// away in another.
pub(in crate::app) const STEPS: [(&str, Step); 3] =
    [("surface", surface::show), ("smooth", smooth::show), ("reduce", reduce::show)];
