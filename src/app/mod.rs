//! The window's content, the same on the desktop and in the browser. It knows no platform: [`Platform`] gives it
//! files and the line to the engine.
//!
//! Layers, the lowest first. A module uses only the layers below its own, so that no two know each other:
//!
//! 1. look and input: `theme`, `icon`, `row`, `control`, `assist`, `halo`, `labels`, `tie`, `keys`, `places`, `sides`;
//! 2. what is known: [`document`], [`history`], `options`, `platform`;
//! 3. actions: the `action.rs` of each panel and the data that it names (`compare/comparison.rs`, `scan/slices.rs`,
//!    `measure/{clip,subject,tool}.rs`), then `action`;
//! 4. `state`, `mode`;
//! 5. drawing: `arrays`, `overlay`, `scene`, `deviation`, `mending`, `verdict`;
//! 6. panels beside the views: [`collapses`], [`measure`], [`vessels`]; then `views`;
//! 7. modes with views of their own: `filling`, [`compare`], [`mod@reference`], [`solver`], [`trial`], [`scan`]; [`lesson`], [`record`], `recovery`;
//! 8. the window: `Panels` below, `bar`, `invitation`, `shortcuts`, `lumen_app`, `lasting`.
//!
//! One more panel is its folder, its variant in `action` and its lines in `Panels` below.
//!
//! - [`LumenApp`]: the app, frame by frame; [`Action`]: all that can be asked of it. [`LastingApp`]: it outlives the
//!   graphics device (`paint_guard`: and paints nothing with one that is gone).
//! - [`State`]: what the app knows and how it changes; [`document`] the surface that is open, [`history`] undo.
//! - `mode`: the modes, one at a time, and the trait of modes and panels; `filling`: modes with views of their own.
//! - `panel`, `numbers`, `bar`, `sheets`, `keys`, `shortcuts`: the controls; `row`, `control`, `swipe`, `response`,
//!   `error_plot`, `icon` what they are made of, `assist` what assistive tools are told of them, `theme` the look.
//! - `equations`: the paper's, set by `formula`; `tie`: what of them a slider and a mark of a plot stand for, too.
//! - `plot_file`: a plot as a file, as SVG by `svg`; `still_plot`: what all plots share.
//! - `labels`: who gives way where words over a view would collide.
//! - `invitation`: over the sample, to open a file.
//! - `drawer`: the panel of a phone; `tabs`: one large view there.
//! - `sharing`: settings as a file and in a link; `recovery`: what comes back after a reload.
//! - [`compare`]: several settings side by side, in the window or as a figure.
//! - [`mod@reference`]: the open surface beside another file.
//! - [`trial`]: the guidewire trial.
//! - [`solver`]: a level made ready for a solver.
//! - [`scan`]: a scan or a mask, before there is a surface.
//! - [`vessels`]: what became of the calibre of each vessel.
//! - [`record`]: reports, pictures and turntables, drawn by `portrait`.
//! - [`lesson`]: lessons and the glossary; [`collapses`]: the steps of decimation, one by one;
//!   [`playback`]: all of them, played.
//! - [`measure`]: measures on the surface, and the plane that cuts it open.
//! - `deviation`: how far the level is from what it was, in colours; [`deviating`]: which of that.
//! - `mending`: what is wrong with a file, where, and what is done about it.
//! - `presenter`: for a projector; `spoken`: for those who do not see the window; `speech`: in which
//!   language; `lettering`: over pictures for files.
//! - `classes`: the vertex classes of the level that is shown, as colours and lines.
//! - `views`: the two 3-D views; `scene` what stands in GPU memory, `window_texture` what of it the window shows,
//!   `overlay` what is written over them, `halo` how it is kept legible there, `flight` how their camera goes to a place.

mod action;
mod array_list;
mod arrays;
mod assist;
mod axes;
mod bar;
mod classes;
pub mod collapses;
pub mod compare;
mod control;
pub mod deviating;
mod deviation;
pub mod document;
mod drawer;
mod equations;
mod error_plot;
mod explain;
mod filling;
mod flight;
mod formula;
mod graphics_error;
mod halo;
pub mod history;
mod icon;
mod invitation;
mod keys;
mod labels;
mod large;
mod lasting;
pub mod lesson;
mod lettering;
mod lumen_app;
pub mod measure;
mod mending;
mod menus;
mod mode;
mod notices;
mod numbers;
mod options;
mod overlay;
mod paint_guard;
mod panel;
mod places;
mod platform;
pub mod playback;
mod plot_file;
mod portrait;
mod presenter;
pub mod record;
mod recovery;
pub mod reference;
mod response;
mod reveal;
mod row;
pub mod scan;
mod scene;
mod sharing;
mod sheets;
mod shortcuts;
mod sides;
pub mod solver;
mod speech;
mod spoken;
mod state;
mod still_plot;
mod svg;
mod swipe;
mod tabs;
mod theme;
mod tie;
pub mod trial;
mod verdict;
pub mod vessels;
mod views;
mod window_texture;

pub use self::action::Action;
pub use self::lasting::{LastingApp, OnEnd, Restarts};
pub use self::lumen_app::LumenApp;
pub use self::notices::{Kind as NoticeKind, Notice, Notices};
pub use self::options::{Colours, FaultShown, ViewOptions};
pub use self::platform::{
    Devices, Engines, FOLLOW_S, Files, Gamepad, Hands, Languages, Listing, OTHER_ENDINGS, Offer, Platform,
    PlatformEvent, SHAKE_MS, Screen, Sharing, Sound, Storage, Store, Tone, Video, Waker,
};
#[cfg(not(target_arch = "wasm32"))]
pub use self::portrait::report_pictures;
pub use self::reveal::Reveal;
pub use self::sheets::Sheet;
pub use self::state::{Effect, State, Step};
pub use self::views::Views;

use self::filling::Filling;
use self::mode::{Beside, Mode, Panel};

/// The modes and panels, each in its own folder. Bar, keys, Escape and layout go through `all`.
#[derive(Default)]
struct Panels {
    lesson: lesson::Lessons,
    collapses: collapses::Collapses,
    playback: playback::Playback,
    vessels: vessels::Vessels,
    measure: measure::Measuring,
    compare: compare::CompareView,
    reference: reference::ReferenceView,
    solver: solver::SolverView,
    trial: trial::TrialPanel,
    scan: scan::ScanPanel,
}

impl Panels {
    /// All of them, the lowest first: Escape takes off the last.
    fn all(&self) -> [&dyn Panel; 10] {
        let Self { lesson, collapses, playback, compare, reference, vessels, measure, solver, trial, scan } = self;
        [lesson, collapses, playback, compare, reference, vessels, measure, solver, trial, scan]
    }

    /// All of them, in the same order.
    fn all_mut(&mut self) -> [&mut dyn Panel; 10] {
        let Self { lesson, collapses, playback, compare, reference, vessels, measure, solver, trial, scan } = self;
        [lesson, collapses, playback, compare, reference, vessels, measure, solver, trial, scan]
    }

    /// Those that have views of their own.
    fn filling_mut(&mut self) -> [&mut dyn Filling; 5] {
        let Self { compare, reference, solver, trial, scan, .. } = self;
        [compare, reference, solver, trial, scan]
    }

    /// What fills the window in this mode; `None` for the views of the method.
    fn filling_of_mut(&mut self, mode: Mode) -> Option<&mut dyn Filling> {
        match mode {
            Mode::Method => None,
            Mode::Compare => Some(&mut self.compare),
            Mode::Reference => Some(&mut self.reference),
            Mode::Solver => Some(&mut self.solver),
            Mode::Trial => Some(&mut self.trial),
            Mode::Scan => Some(&mut self.scan),
        }
    }

    /// The mode that has the window. A surface that has no level yet covers what is open of the one before.
    fn mode(&self, state: &State) -> Mode {
        let there = self.all().into_iter().filter(|panel| panel.is_there(state, Beside::Nothing));
        let modes = there.filter_map(Panel::mode).filter(|mode| *mode == Mode::Scan || !state.awaits_levels());
        modes.max().unwrap_or(Mode::Method)
    }

    /// The panel that is this mode.
    fn of_mut(&mut self, mode: Mode) -> Option<&mut dyn Panel> {
        self.all_mut().into_iter().find(|panel| panel.mode() == Some(mode))
    }
}
