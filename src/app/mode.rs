//! The modes of the window and the panels in it.
//!
//! One [`Mode`] at a time has the window. Whatever lies below it goes on, and is seen again once the mode is left: a scan
//! covers a trial, a trial the comparison, both the method. Beside the views of the method stands [`Beside`], which is one
//! thing at a time too. Collapses and a lesson stand with any of these.
//!
//! Every mode and every panel is a [`Panel`] in a folder of its own. Bar, keys, Escape and layout ask the panels, and know
//! none of them by name.

use std::ops::RangeInclusive;

use egui::{Context, Ui};

use super::action::Action;
use super::options::ViewOptions;
use super::platform::Platform;
use super::state::State;
use crate::language::Key;
use crate::render::Camera;

/// What has the window. Each covers those before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Mode {
    /// The method's steps, and the two views of the surface.
    Method,
    /// Several settings side by side.
    Compare,
    /// The guidewire trial.
    Trial,
    /// A scan, before there is a surface of it.
    Scan,
}

/// What stands beside the views of the method. It stays while another mode covers them.
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

/// What Escape takes off, the first first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Layer {
    /// A window over all else, or what the next click is for.
    Held,
    /// A file that is on its way in.
    Awaited,
    /// Work on what is shown.
    Underway,
    /// What is open.
    Open,
}

/// Where a panel that is no mode stands.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Place {
    /// In place of the method's steps.
    Panel,
    /// At the right of the views: its width, and the widths that it may be drawn to, in points.
    Right(f32, RangeInclusive<f32>),
    /// Below the views: its height, and the heights that it may be drawn to, in points.
    Below(f32, Option<RangeInclusive<f32>>),
    /// Below everything, in every mode: its height, in points.
    Foot(f32),
}

/// Where the bar has an entry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Group {
    /// With the modes.
    Modes,
    /// With what stands beside the views.
    Beside,
    /// In the menu of what there is to learn.
    Learn,
}

/// An entry in the bar, and the key that does the same.
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

/// What a panel may look at.
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

    /// Whether this stands beside the views, and the views are shown.
    pub(super) fn shows(&self, beside: Beside) -> bool {
        self.mode == Mode::Method && self.beside == beside
    }
}

/// What a panel may change besides itself.
pub(super) struct Acting<'a> {
    pub(super) ctx: &'a Context,
    pub(super) state: &'a mut State,
    pub(super) platform: &'a mut dyn Platform,
    pub(super) mode: Mode,
    /// Whether a trial is open, though a scan may cover it.
    pub(super) in_trial: bool,
    pub(super) beside: &'a mut Beside,
    /// What is to be done next.
    pub(super) then: Vec<Action>,
}

/// A mode, or what stands beside the views: its state, its actions and how it is shown.
pub(super) trait Panel {
    /// By what egui knows it, from frame to frame.
    fn id(&self) -> &'static str;

    /// Whether it is open, though another may cover it.
    fn is_there(&self, state: &State, beside: Beside) -> bool;

    /// The mode that it is; `None` for what stands beside the views.
    fn mode(&self) -> Option<Mode> {
        None
    }

    /// Where it stands, if it is no mode.
    fn place(&self, _ui: &Ui, _now: Now<'_>) -> Place {
        Place::Panel
    }

    /// Whether its controls take the place of the method's steps while it has the window.
    fn replaces_method(&self) -> bool {
        false
    }

    /// Whether the short cuts of the views hold while it has the window.
    fn leaves_short_cuts(&self) -> bool {
        true
    }

    /// Whether it keeps this from being asked for by a key while it has the window.
    fn blocks(&self, _action: &Action) -> bool {
        false
    }

    /// Its entry in the bar.
    fn entry(&self, _now: Now<'_>) -> Option<Entry> {
        None
    }

    /// Takes its keys, to be called each frame; `are_its` says whether it has them: it is shown, and nothing lies over it.
    fn take_keys(&mut self, _ui: &Ui, _are_its: bool, _asked: &mut Vec<Action>) {}

    /// Its lines in the sheet of keys.
    fn key_help(&self) -> &'static [(Key, Key)] {
        &[]
    }

    /// The sheet of keys while it has the window, where that is one of its own.
    fn key_sheet(&self) -> Option<&'static [(Key, Key)]> {
        None
    }

    /// What takes off its topmost thing of a layer.
    fn escape(&self, _now: Now<'_>, _layer: Layer) -> Option<Action> {
        None
    }

    /// Shows it where it stands; as a mode, its controls.
    fn show(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Action>);

    /// Shows in the status bar what it is at; whether there is anything.
    fn show_status(&self, _ui: &mut Ui, _now: Now<'_>, _asked: &mut Vec<Action>) -> bool {
        false
    }

    /// The height in points of what a thumb needs below all else on a phone while it has the window, if it needs anything.
    fn thumb_height(&self) -> Option<f32> {
        None
    }

    /// Shows that.
    fn show_thumbs(&mut self, _ui: &mut Ui) {}

    /// Shows what of it lies over everything, whether it is open or not.
    fn show_over(&mut self, _ui: &Ui, _asked: &mut Vec<Action>) {}

    /// Does what is asked for, if it is one of its own actions; others are given back.
    fn act(&mut self, action: Action, acting: &mut Acting<'_>) -> Option<Action>;

    /// Another surface was opened: what belongs to the one before is no more.
    fn leave_surface(&mut self, _acting: &mut Acting<'_>) {}

    /// Whether frames have to go on by themselves.
    fn goes_on(&self, _platform: &dyn Platform) -> bool {
        false
    }
}
