//! Measures on the surface that is open: a tool is taken up, places are clicked in a view, and what is found is kept under
//! a name; and the plane that lets one see inside.
//!
//! The measures themselves are part of what undo goes back to ([`State`]); here is what a user is about to do.

mod action;
mod canvas;
mod cap;
mod clip;
mod fill;
mod marks;
mod over;
mod panel;
mod subject;
mod take;
mod tool;

use egui::{Key, Modifiers, Pos2, Ui};

use super::keys;
use super::state::State;
use crate::mesh::{InnerBall, Vec3};
use crate::render::Camera;

pub use self::action::Action;
pub use self::clip::{Across, Clip};
pub(super) use self::over::Seen;
pub(super) use self::panel::show;
pub use self::subject::Picked;
pub use self::tool::Tool;

/// What a user is about to measure.
pub struct Measuring {
    /// Whether the panel is shown.
    pub is_open: bool,
    /// The tool in hand.
    tool: Option<Tool>,
    /// Whether Enter was pressed for the views in this frame: it measures at the middle of the first.
    enter: bool,
    /// The places that it has, and the surface that they are on.
    begun: Vec<Picked>,
    /// Why nothing came of the last place.
    why: Option<String>,
    /// What is left out of the views.
    clip: Option<Clip>,
    /// Whether the measures are drawn.
    marks: bool,
    /// The measure that was looked at last.
    chosen: Option<usize>,
    indexing: subject::Indexing,
    /// The ball under the pointer, and what it was found for.
    under: Option<(Under, Option<InnerBall>)>,
    cuts: cap::Cuts,
}

/// What the ball under the pointer depends on.
#[derive(Clone, Copy, PartialEq)]
struct Under {
    at: Pos2,
    camera: Camera,
    of: subject::Of,
}

impl Default for Measuring {
    fn default() -> Self {
        Self {
            is_open: false,
            tool: None,
            enter: false,
            begun: Vec::new(),
            why: None,
            clip: None,
            marks: true,
            chosen: None,
            indexing: subject::Indexing::default(),
            under: None,
            cuts: cap::Cuts::default(),
        }
    }
}

impl Measuring {
    /// Forgets what belongs to the surface that was shown.
    pub(super) fn leave_surface(&mut self) {
        let Self { is_open, marks, .. } = *self;
        *self = Self { is_open, marks, ..Self::default() };
    }

    /// Whether clicks in the views are for a tool.
    pub(super) fn has_tool(&self) -> bool {
        self.is_open && self.tool.is_some()
    }

    /// Takes what the keys ask for in the views, where no control has them.
    pub(super) fn take_keys(&mut self, ui: &Ui, are_for_views: bool) {
        let is_free = are_for_views && self.has_tool() && ui.ctx().memory(|memory| memory.focused().is_none());
        self.enter = is_free && keys::pressed(ui, Modifiers::NONE, Key::Enter);
    }

    /// What takes off one thing: the places of a tool, the tool.
    pub(super) fn on_top(&self) -> Option<Action> {
        let tool = self.tool.filter(|_| self.is_open)?;
        Some(Action::Take((!self.begun.is_empty()).then_some(tool)))
    }

    /// Does what is asked for.
    pub(super) fn act(&mut self, action: Action, state: &mut State) {
        match action {
            Action::Toggle => {
                self.is_open = !self.is_open;
                if !self.is_open {
                    self.take_up(None);
                }
            }
            Action::Take(tool) => self.take_up(tool),
            Action::Place(picked) => self.place(picked, state),
            Action::Rename(i, name) => {
                let measures = std::sync::Arc::make_mut(&mut state.measures);
                if let Some(measure) = measures.get_mut(i) {
                    measure.name = name.chars().take(crate::sharing::measures::LONGEST_NAME).collect();
                }
            }
            Action::Delete(i) => {
                // One step to undo, whatever was done before it.
                state.record();
                if i < state.measures.len() {
                    std::sync::Arc::make_mut(&mut state.measures).remove(i);
                }
                self.chosen = None;
            }
            Action::Look(i) => self.chosen = Some(i),
            Action::Clip(clip) => self.clip = clip,
            Action::Mark(marks) => self.marks = marks,
        }
    }

    fn take_up(&mut self, tool: Option<Tool>) {
        self.tool = tool;
        self.begun.clear();
        (self.why, self.under) = (None, None);
    }

    /// Takes a place for the tool in hand; where it was the last, what was found is a measure.
    fn place(&mut self, picked: Picked, state: &mut State) {
        let Some(tool) = self.tool else { return };
        // Places of two surfaces are no measure of either.
        if self.begun.first().is_some_and(|first| first.is_opened != picked.is_opened) {
            self.begun.clear();
        }
        self.begun.push(picked);
        self.why = None;
        if self.begun.len() < tool.places() {
            return;
        }
        let places: Vec<Vec3> = self.begun.drain(..).map(|picked| picked.at).collect();
        match self.measured(tool, &places, picked.is_opened, state) {
            Ok(measure) => {
                state.record();
                std::sync::Arc::make_mut(&mut state.measures).push(measure);
                self.chosen = Some(state.measures.len() - 1);
            }
            Err(why) => self.why = Some(why),
        }
    }
}
