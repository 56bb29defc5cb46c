//! The modes of the window, and the trait that each mode and panel implements.
//!
//! One [`Mode`] at a time has the window. A scan covers a trial, a trial covers what was made for a solver, that another file
//! beside the surface, that the comparison, and each of them covers the method. A surface that has no level yet covers all but a scan. What is covered keeps its state and is shown again when what
//! covers it is left; a tab of the bar leaves the other tabs. Beside the views of the method stands at most one of
//! [`Beside`]. Collapses, the reduction that is played and a lesson combine with these.
//!
//! Each mode and panel is a [`Panel`] in its own folder, with its state and its actions. Bar, keys, Escape and layout go
//! through the list of panels (`Panels::all`) and name none of them.

use std::ops::RangeInclusive;

use egui::{Context, Ui};

use super::action::Action;
use super::options::ViewOptions;
use super::platform::Platform;
use super::state::State;
use crate::language::Key;
use crate::render::Camera;

/// What has the window. A later mode covers the earlier ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Mode {
    /// The method's steps, and the two views of the surface.
    Method,
    /// Several settings side by side.
    Compare,
    /// The surface beside another file.
    Reference,
    /// What was made ready for a solver.
    Solver,
    /// The guidewire trial.
    Trial,
    /// A scan, before there is a surface of it.
    Scan,
}

/// What stands beside the views of the method. It stays open while another mode covers the views.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Beside {
    /// Nothing.
    #[default]
    Nothing,
    /// The vessels and their calibre.
    Vessels,
    /// The measures and the clip plane.
    Measure,
}

/// What one press of Escape takes off: the first layer that is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layer {
    /// A window over all else, a tool, or a pick.
    Held,
    /// A file that is being opened.
    Awaited,
    /// Work on what is shown.
    Underway,
    /// The mode or panel itself.
    Open,
}

/// Where a panel stands that is not a mode.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Place {
    /// In place of the method's steps.
    Panel,
    /// Right of the views: width and range of widths, in points.
    Right(f32, RangeInclusive<f32>),
    /// Below the views: height and, where the user may change it, the range of heights, in points.
    Below(f32, Option<RangeInclusive<f32>>),
    /// Below everything, in every mode: height in points.
    Foot(f32),
    /// Right of everything, in every mode: width and range of widths, in points.
    Side(f32, RangeInclusive<f32>),
}

/// Where an entry of the bar stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Group {
    /// Among the tabs: one at a time is open.
    Tabs,
    /// In the menu *Learn*.
    Learn,
}

/// An entry of the bar, and the key with the same action.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) group: Group,
    pub(super) label: Key,
    pub(super) help: Key,
    pub(super) key: Option<egui::Key>,
    pub(super) action: Action,
    pub(super) is_open: bool,
    pub(super) is_enabled: bool,
}

/// What a panel can read.
#[derive(Clone, Copy)]
pub(super) struct Now<'a> {
    pub(super) state: &'a State,
    pub(super) mode: Mode,
    pub(super) beside: Beside,
    pub(super) options: ViewOptions,
    pub(super) camera: &'a Camera,
    /// Whether the window is that of a phone.
    pub(super) is_narrow: bool,
    /// Whether links can be made here.
    pub(super) has_links: bool,
}

impl Now<'_> {
    /// Whether a level is shown.
    pub(super) fn has_level(&self) -> bool {
        self.state.document.as_ref().is_some_and(|document| document.shown.is_some())
    }

    /// Whether the views are shown, with this beside them.
    pub(super) fn shows(&self, beside: Beside) -> bool {
        self.mode == Mode::Method && self.beside == beside
    }
}

/// What a panel can change besides itself.
pub(super) struct Acting<'a> {
    pub(super) ctx: &'a Context,
    pub(super) state: &'a mut State,
    pub(super) platform: &'a mut dyn Platform,
    pub(super) mode: Mode,
    /// Whether a trial is open, though a scan may cover it.
    pub(super) in_trial: bool,
    pub(super) beside: &'a mut Beside,
    /// Actions to be done next.
    pub(super) then: Vec<Action>,
}

/// A mode, or a panel beside the views.
pub(super) trait Panel {
    /// The name under which egui keeps its size from frame to frame.
    fn id(&self) -> &'static str;

    /// Whether it is open. A mode above may cover it.
    fn is_there(&self, state: &State, beside: Beside) -> bool;

    /// The mode that it is; `None` for a panel beside the views.
    fn mode(&self) -> Option<Mode> {
        None
    }

    /// Where it stands, if it is not a mode.
    fn place(&self, _ui: &Ui, _now: Now<'_>) -> Place {
        Place::Panel
    }

    /// Whether its controls replace the steps of the method while it has the window.
    fn replaces_method(&self) -> bool {
        false
    }

    /// Whether the shortcuts of the views work while it has the window.
    fn leaves_short_cuts(&self) -> bool {
        true
    }

    /// Whether it blocks this action of a key while it has the window.
    fn blocks(&self, _action: &Action) -> bool {
        false
    }

    /// Its entry in the bar.
    fn entry(&self, _now: Now<'_>) -> Option<Entry> {
        None
    }

    /// Takes its keys. Called each frame; `are_its` is set where it is shown and nothing lies over it.
    fn take_keys(&mut self, _ui: &Ui, _are_its: bool, _asked: &mut Vec<Action>) {}

    /// Its lines in the list of keys.
    fn key_help(&self) -> &'static [(Key, Key)] {
        &[]
    }

    /// The whole list of keys while it has the window, where it has its own.
    fn key_sheet(&self) -> Option<&'static [(Key, Key)]> {
        None
    }

    /// What Escape does in this layer; `None` where it has nothing there.
    fn escape(&self, _now: Now<'_>, _layer: Layer) -> Option<Action> {
        None
    }

    /// Whether it has a head, which stays in sight: the window scrolls what [`Self::show`] shows below it.
    fn has_head(&self) -> bool {
        false
    }

    /// Shows its head.
    fn show_head(&mut self, _ui: &mut Ui, _now: Now<'_>, _asked: &mut Vec<Action>) {}

    /// Shows the panel in its place; for a mode, its controls.
    fn show(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Action>);

    /// Shows its work in the status bar. Returns whether there is any.
    fn show_status(&self, _ui: &mut Ui, _now: Now<'_>, _asked: &mut Vec<Action>) -> bool {
        false
    }

    /// The height in points of its controls for thumbs: they stand lowest where the panel stands below the views, else
    /// above the panel.
    fn thumb_height(&self) -> Option<f32> {
        None
    }

    /// Shows the controls for thumbs.
    fn show_thumbs(&mut self, _ui: &mut Ui) {}

    /// Shows what lies over everything, whether the panel is open or not.
    fn show_over(&mut self, _ui: &Ui, _asked: &mut Vec<Action>) {}

    /// Does one of its own actions. Returns any other.
    fn act(&mut self, action: Action, acting: &mut Acting<'_>) -> Option<Action>;

    /// Drops what belongs to the previous surface, after another was opened.
    fn leave_surface(&mut self, _acting: &mut Acting<'_>) {}

    /// Whether it needs frames without input.
    fn goes_on(&self, _platform: &dyn Platform) -> bool {
        false
    }
}
