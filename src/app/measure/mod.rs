//! Measures on the surface that is open: a tool is taken up, places are clicked in a view, and what is found is kept under
//! a name; and the plane that lets one see inside.
//!
//! The measures themselves are part of what undo goes back to ([`State`]); here is what a user is about to do.

pub(super) mod action;
pub(super) mod canvas;
mod cap;
mod clip;
mod fill;
mod marks;
mod over;
mod panel;
mod subject;
mod take;
mod tool;

use std::sync::Arc;

use egui::{Modifiers, Pos2, Rect, ScrollArea, Ui};

pub use self::action::Action;
pub use self::clip::{Across, Clip};
pub(super) use self::over::Seen;
pub use self::subject::Picked;
pub use self::tool::Tool;
use super::action::Action as Ask;
use super::keys;
use super::mode::{Acting, Beside, Entry, Group, Layer, Mode, Now, Panel, Place};
use super::state::State;
use crate::language::Key;
use crate::mesh::{Ball, Vec3};
use crate::render::Camera;
use crate::sharing::measures::Measure;

/// What a user is about to measure. The clip plane and the marks of the measures stay in the views when the panel is
/// closed; the tool is in hand only while it is open.
pub struct Measuring {
    /// The tool that was taken up.
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
    under: Option<(Under, Option<Ball>)>,
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
    fn forget_surface(&mut self) {
        *self = Self { marks: self.marks, ..Self::default() };
    }

    /// The measures that the views show.
    pub(super) fn shown(&self, state: &State) -> Arc<Vec<Measure>> {
        if self.marks { state.measures.clone() } else { Arc::default() }
    }

    /// Whether clicks in the views are for a tool, while the panel is open.
    pub(super) fn has_tool(&self) -> bool {
        self.tool.is_some()
    }

    /// Does what is asked for.
    fn act_on(&mut self, action: Action, acting: &mut Acting<'_>) {
        let state = &mut *acting.state;
        match action {
            Action::Toggle if acting.mode == Mode::Method && *acting.beside == Beside::Measure => {
                *acting.beside = Beside::Nothing;
                self.take_up(None);
            }
            Action::Toggle => {
                // They stand where the measures do.
                state.leave_modes();
                *acting.beside = if acting.in_trial { Beside::Nothing } else { Beside::Measure };
            }
            Action::Take(tool) => self.take_up(tool),
            Action::Place(picked) => self.place(picked, state),
            Action::Rename(i, name) => {
                let measures = Arc::make_mut(&mut state.measures);
                if let Some(measure) = measures.get_mut(i) {
                    measure.name = name.chars().take(crate::sharing::measures::LONGEST_NAME).collect();
                }
            }
            Action::Delete(i) => {
                // One step to undo, whatever was done before it.
                state.record();
                if i < state.measures.len() {
                    Arc::make_mut(&mut state.measures).remove(i);
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
                Arc::make_mut(&mut state.measures).push(measure);
                self.chosen = Some(state.measures.len() - 1);
            }
            Err(why) => self.why = Some(why),
        }
    }
}

/// Draws measures over a picture that is seen by `camera`, as over a view.
pub(super) fn draw(ui: &Ui, rect: Rect, camera: &Camera, measures: &[Measure]) {
    marks::show(&canvas::Canvas::new(ui, rect, rect, camera), measures, None);
}

const TOGGLE: Ask = Ask::Measure(Action::Toggle);

impl Panel for Measuring {
    fn id(&self) -> &'static str {
        "measure"
    }

    fn is_there(&self, _: &State, beside: Beside) -> bool {
        beside == Beside::Measure
    }

    fn place(&self, _: &Ui, now: Now<'_>) -> Place {
        if now.is_narrow { Place::Panel } else { Place::Right(264.0, 232.0..=400.0) }
    }

    fn entry(&self, now: Now<'_>) -> Option<Entry> {
        let is_open = now.shows(Beside::Measure);
        Some(Entry {
            group: Group::Tabs,
            label: Key("app-measure"),
            help: Key("app-measure-help"),
            key: Some(egui::Key::M),
            action: TOGGLE,
            is_open,
            is_enabled: now.has_level() || is_open,
        })
    }

    fn take_keys(&mut self, ui: &Ui, are_its: bool, _: &mut Vec<Ask>) {
        let is_free = are_its && self.has_tool() && ui.ctx().memory(|memory| memory.focused().is_none());
        self.enter = is_free && keys::pressed(ui, Modifiers::NONE, egui::Key::Enter);
    }

    fn key_help(&self) -> &'static [(Key, Key)] {
        &[(Key("app-key-measure"), Key("app-key-measure-does"))]
    }

    fn escape(&self, now: Now<'_>, layer: Layer) -> Option<Ask> {
        match layer {
            _ if !now.shows(Beside::Measure) => None,
            // The places of a tool, the tool.
            Layer::Held => {
                let tool = self.tool?;
                Some(Ask::Measure(Action::Take((!self.begun.is_empty()).then_some(tool))))
            }
            Layer::Open => Some(TOGGLE),
            Layer::Awaited | Layer::Underway => None,
        }
    }

    fn show(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Ask>) {
        ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            ui.set_max_width(ui.available_width() - 8.0);
            panel::show(ui, self, now, asked);
        });
    }

    fn act(&mut self, action: Ask, acting: &mut Acting<'_>) -> Option<Ask> {
        let Ask::Measure(action) = action else { return Some(action) };
        self.act_on(action, acting);
        None
    }

    fn leave_surface(&mut self, _: &mut Acting<'_>) {
        self.forget_surface();
    }
}
