//! The window's content, the same on the desktop and in the browser. It knows no platform: [`Platform`] gives it
//! files and the line to the engine.
//!
//! - [`State`]: what the app knows and how it changes; [`document`] the surface that is open, [`history`] undo.
//! - `panel`, `bar`, `sheets`, `keys`: the controls; `control` is a row of the panel, `icon` its icons, `theme` the look.
//! - [`compare`]: several settings side by side, in the window or as a figure.
//! - [`trial`]: the guidewire trial.
//! - `views`: the two 3-D views; `scene` what stands in GPU memory, `overlay` what is written over them.

mod bar;
pub mod compare;
mod control;
pub mod document;
pub mod history;
mod icon;
mod keys;
mod numbers;
mod overlay;
mod panel;
mod platform;
mod response;
mod scene;
mod sheets;
mod state;
mod theme;
pub mod trial;
mod views;

use std::time::Duration;

use egui::{CentralPanel, Frame, Margin, Panel, ScrollArea, Ui};

pub use self::bar::Action;
pub use self::platform::{Gamepad, Platform, PlatformEvent};
pub use self::sheets::Sheet;
pub use self::state::{Effect, Notice, State};
pub use self::views::Views;
use crate::phantom::Sample;
use crate::pipeline::settings::Keep;

/// Below this width in points the views stack and the panel becomes a sheet at the bottom.
const NARROW: f32 = 720.0;

/// How often the engine is listened to while it works and nothing else moves.
const LISTEN: Duration = Duration::from_millis(16);

/// The app.
pub struct LumenApp {
    state: State,
    views: Views,
    compare: compare::CompareView,
    trial: trial::Trial,
    trial_view: trial::TrialView,
    platform: Box<dyn Platform>,
    sheet: Option<Sheet>,
    /// The views find a new surface when they are next shown: their shape is known by then.
    look_next: bool,
}

impl LumenApp {
    /// The app, with a sample open.
    pub fn new(
        ctx: &egui::Context,
        render_state: Option<&egui_wgpu::RenderState>,
        mut platform: Box<dyn Platform>,
    ) -> Self {
        theme::apply(ctx);
        let mut state = State::default();
        state.open_sample(Sample::Aorta, platform.link());
        Self {
            state,
            views: Views::new(render_state),
            compare: compare::CompareView::new(render_state),
            trial: trial::Trial::new(),
            trial_view: trial::TrialView::new(render_state),
            platform,
            sheet: None,
            look_next: false,
        }
    }

    /// What the app knows.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// What the app knows of the trial.
    pub fn trial(&self) -> &trial::Trial {
        &self.trial
    }

    /// How many pictures of the trial were drawn since its views were shown.
    pub fn trial_draws(&self) -> u64 {
        self.trial_view.draws()
    }

    /// Whether the trial's views stand in the device's memory.
    pub fn trial_holds_memory(&self) -> bool {
        self.trial_view.holds_memory()
    }

    fn listen(&mut self, ctx: &egui::Context) {
        while let Some(event) = self.platform.poll() {
            match event {
                PlatformEvent::Chosen { name, bytes } if is_log(&name) => {
                    self.trial.replay(bytes, self.state.document.as_ref(), self.platform.trial());
                }
                PlatformEvent::Chosen { name, bytes } => self.state.open_file(name, bytes, self.platform.link()),
                PlatformEvent::Saved { message } => self.state.tell(&message),
                PlatformEvent::Failed { message } => self.state.warn(&message),
            }
        }
        while let Some(event) = self.platform.link().poll() {
            match self.state.receive(event) {
                Some(Effect::Opened) => {
                    self.look_next = true;
                    // A trial is in the surface that was open.
                    if self.trial.is_open {
                        self.trial.act(&trial::Ask::Close, None, self.platform.trial());
                    }
                }
                Some(Effect::Offer { name, bytes }) => self.platform.offer_file(&name, bytes, ctx),
                None => {}
            }
        }
        if let Some(reason) = self.platform.link().failure() {
            self.state.engine_failed(&reason, self.platform.link());
        }
        while let Some(event) = self.platform.trial().poll() {
            if let Some(log) = self.trial.receive(event, self.platform.trial()) {
                self.platform.offer_pair(log, ctx);
            }
        }
        if let Some(reason) = self.platform.trial().failure() {
            let sentence = self.trial.engine_failed(&reason, self.platform.trial());
            self.state.warn(&sentence);
        }
        let dropped = ctx.input(|input| input.raw.dropped_files.first().cloned());
        if let Some(file) = dropped {
            // The unit was chosen for a file of the dialog.
            self.state.next_unit = None;
            self.platform.read_dropped(file, ctx);
        }
    }

    fn act(&mut self, action: Action, ctx: &egui::Context) {
        let keep = self.state.settings.keep;
        let state = &mut self.state;
        match action {
            Action::Open | Action::OpenIn(_) => {
                state.next_unit = if let Action::OpenIn(unit) = action { Some(unit) } else { None };
                self.platform.choose_file(ctx);
            }
            Action::Sample(sample) => state.open_sample(sample, self.platform.link()),
            Action::Save(format) => state.save(format, self.platform.link()),
            Action::Undo => state.undo(),
            Action::Redo => state.redo(),
            Action::Cancel => state.cancel(self.platform.link()),
            Action::Fit => self.views.fit(state.document.as_ref(), keep),
            Action::View(view) => self.views.look_from(view, state.document.as_ref(), keep),
            Action::Compare => state.toggle_comparison(),
            Action::Trial => {
                let ask = if self.trial.is_open { trial::Ask::Close } else { trial::Ask::Start };
                self.act_on_trial(&ask, ctx);
            }
            Action::Theme => {
                let other = if ctx.theme() == egui::Theme::Dark { egui::Theme::Light } else { egui::Theme::Dark };
                ctx.set_theme(other);
            }
            Action::Help => self.sheet = toggled(self.sheet, Sheet::Help),
            Action::About => self.sheet = toggled(self.sheet, Sheet::About),
        }
    }

    fn act_on_trial(&mut self, ask: &trial::Ask, ctx: &egui::Context) {
        if *ask == trial::Ask::OpenLog {
            self.platform.choose_file(ctx);
        }
        if *ask == trial::Ask::SmoothLess {
            // One step to undo, whatever was changed before it.
            self.state.history.record(&self.state.settings);
            self.trial.smooth_less(&mut self.state.settings.smoothing);
        }
        if *ask == trial::Ask::Start {
            self.state.comparison.set_open(false);
        }
        self.trial.act(ask, self.state.document.as_ref(), self.platform.trial());
    }

    fn panels(&mut self, ui: &mut Ui) -> (Option<Action>, Option<trial::Ask>) {
        let is_narrow = ui.available_width() < NARROW;
        let bar = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, 6));
        let mut action = None;
        Panel::top("top").frame(bar).exact_size(48.0).show(ui, |ui| {
            action = bar::top(ui, &self.state, &mut self.views, self.trial.is_open, is_narrow);
        });
        Panel::bottom("status").frame(bar).exact_size(40.0).show(ui, |ui| {
            action = action.or(bar::status(ui, &mut self.state, &self.views, is_narrow));
        });
        let panel = if is_narrow {
            let height = ui.available_height() * 0.45;
            Panel::bottom("panel").exact_size(height)
        } else {
            Panel::left("panel").resizable(true).default_size(296.0).size_range(256.0..=440.0)
        };
        let margin = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(16, 8));
        let mut ask = None;
        panel.frame(margin).show(ui, |ui| {
            if self.trial.is_open {
                self.trial.pads(ui);
            }
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                // Room for the scroll bar beside what stands at the right.
                ui.set_max_width(ui.available_width() - 8.0);
                if self.trial.is_open {
                    ui.spacing_mut().item_spacing.y = 3.0;
                    let (smoothing, document) = (&self.state.settings.smoothing, self.state.document.as_ref());
                    ask = trial::panel(ui, &mut self.trial, smoothing, document);
                    return;
                }
                let (unit, asked) = panel::show(ui, &mut self.state, &mut self.views, &mut self.trial);
                ask = asked;
                if let Some(unit) = unit {
                    self.state.set_unit(unit, self.platform.link());
                }
            });
        });
        let keep = self.state.settings.keep;
        let mut picked = None;
        let clicked = CentralPanel::default()
            .frame(Frame::new().fill(ui.visuals().widgets.noninteractive.bg_stroke.color))
            .show(ui, |ui| {
                let State { document, comparison, settings, .. } = &mut self.state;
                let document = document.as_ref();
                if std::mem::take(&mut self.look_next) {
                    self.views.look_first(document, keep);
                }
                if !comparison.is_open() {
                    self.compare.let_go();
                }
                if !(self.trial.is_open || self.trial.tables.is_open || self.trial.tables.is_busy()) {
                    self.trial_view.let_go();
                }
                if self.trial.is_open {
                    picked = self.trial_view.show(ui, &mut self.trial, &mut self.views, document, keep, is_narrow);
                    return None;
                }
                if comparison.is_open() {
                    self.compare.show(ui, comparison, &mut self.views, settings, document, is_narrow);
                    return None;
                }
                self.views.show(ui, document, keep, is_narrow)
            });
        if let Some(piece) = clicked.inner {
            let is_largest = self.state.document.as_ref().and_then(|d| d.pieces.by_size.first()) == Some(&piece);
            self.state.settings.keep = if is_largest { Keep::Largest } else { Keep::Component(piece) };
        }
        if let (Some(at), Some(pick)) = (picked, self.trial.pick) {
            self.trial.choose(pick, at, self.state.document.as_ref(), self.platform.trial());
        }
        if self.trial_view.tables(ui, &mut self.trial) {
            self.trial.cancel_tables(self.platform.trial());
        }
        self.trial.next_row(self.platform.trial());
        (action, ask)
    }
}

/// Whether a file is the log of a trial.
fn is_log(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case("csv"))
}

fn toggled(open: Option<Sheet>, sheet: Sheet) -> Option<Sheet> {
    (open != Some(sheet)).then_some(sheet)
}

impl eframe::App for LumenApp {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        self.listen(&ctx);
        let held = keys::before_is_held(ui) || self.views.before_is_held || self.views.before_is_on;
        self.views.show_before = held;
        let (mut by_key, mut asked) = (None, None);
        if self.sheet.is_none() {
            by_key = keys::with_ctrl(ui);
            if self.trial.is_open {
                asked = trial::keys(ui, &mut self.trial);
            } else {
                by_key = by_key.or_else(|| keys::action(ui, &mut self.views, self.state.is_busy()));
            }
        }
        let (by_bar, by_panel) = self.panels(ui);
        if let Some(action) = by_key.or(by_bar) {
            self.act(action, &ctx);
        }
        if let Some(ask) = asked.or(by_panel) {
            self.act_on_trial(&ask, &ctx);
        }
        let gamepad = self.platform.gamepad();
        self.trial.follow_hand(ui, gamepad, self.platform.trial());
        if self.sheet.is_some_and(|sheet| sheets::show(ui, sheet, self.trial.is_open))
            || self.sheet.is_some() && keys::closes_sheet(ui)
        {
            self.sheet = None;
        }
        let is_held = ctx.input(|input| input.pointer.any_down()) || ctx.egui_wants_keyboard_input();
        self.state.follow(is_held, self.platform.link());
        let State { document, settings, .. } = &self.state;
        let has_level = self.state.has_level();
        self.trial.follow_level(&settings.smoothing, has_level, document.as_ref(), self.platform.trial());
        let is_in_hand = self.trial.is_open && self.trial.is_in_hand();
        if is_in_hand || self.state.is_busy() || self.trial.is_busy() {
            ctx.request_repaint_after(LISTEN);
        }
    }
}
