//! The window's content, the same on the desktop and in the browser. It knows no platform: [`Platform`] gives it
//! files and the line to the engine.
//!
//! - [`State`]: what the app knows and how it changes; [`document`] the surface that is open, [`history`] undo.
//! - `panel`, `bar`, `sheets`, `keys`: the controls; `control` is a row of the panel, `icon` its icons, `theme` the look.
//! - [`compare`]: several settings side by side, in the window or as a figure.
//! - [`trial`]: the guidewire trial.
//! - `views`: the two 3-D views; `scene` what stands in GPU memory, `window_texture` what of it the window shows,
//!   `overlay` what is written over them. [`LastingApp`]: the app outlives the graphics device.

mod bar;
pub mod compare;
mod control;
pub mod document;
pub mod history;
mod icon;
mod keys;
mod lasting;
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
mod window_texture;

use std::time::Duration;

use egui::{CentralPanel, Frame, Key, Margin, Modifiers, Panel, ScrollArea, Ui};

pub use self::bar::Action;
use self::keys::Keys;
pub use self::lasting::{LastingApp, OnEnd, Restarts};
pub use self::platform::{Gamepad, Platform, PlatformEvent, Waker};
pub use self::sheets::Sheet;
pub use self::state::{Effect, Notice, State};
pub use self::views::Views;
use crate::phantom::Sample;
use crate::pipeline::settings::Keep;
use crate::render::{Camera, DeviceHealth, Fault};

/// Below this width in points the views stack and the panel becomes a sheet at the bottom.
const NARROW: f32 = 720.0;

/// How often the engine is listened to while it works and nothing else moves.
const LISTEN: Duration = Duration::from_millis(16);

/// Said where the surface is not drawn because an allocation on the graphics device failed.
const NO_MEMORY: &str = "The graphics memory is full, so this surface cannot be drawn; it is still open and can be reduced further or saved.";

/// The app.
pub struct LumenApp {
    /// The window that it is in.
    ctx: egui::Context,
    /// What is known of its device.
    health: DeviceHealth,
    state: State,
    views: Views,
    compare: compare::CompareView,
    trial: trial::Trial,
    trial_view: trial::TrialView,
    platform: Box<dyn Platform>,
    sheet: Option<Sheet>,
    /// Whether a field was typed into at the end of the frame before.
    was_typing: bool,
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
        let mut state = State::default();
        state.open_sample(Sample::Aorta, platform.link());
        let mut app = Self {
            ctx: ctx.clone(),
            health: DeviceHealth::default(),
            state,
            views: Views::new(None),
            compare: compare::CompareView::new(None),
            trial: trial::Trial::new(),
            trial_view: trial::TrialView::new(None),
            platform,
            sheet: None,
            was_typing: false,
            look_next: false,
        };
        app.enter(ctx, render_state);
        app
    }

    /// Goes on in another window, with another device: what is open, the settings, their history, the camera, the trial
    /// and how the controls stand stay as they are, and what was on the old device is made again.
    pub fn resume(&mut self, ctx: &egui::Context, render_state: Option<&egui_wgpu::RenderState>) {
        let memory = self.ctx.memory(Clone::clone);
        ctx.memory_mut(|now| *now = memory);
        self.platform.enter(ctx);
        self.trial.restart_clock();
        self.enter(ctx, render_state);
        self.state.tell("The graphics were interrupted and have been started again. Nothing was lost.");
    }

    fn enter(&mut self, ctx: &egui::Context, render_state: Option<&egui_wgpu::RenderState>) {
        theme::apply(ctx);
        self.ctx = ctx.clone();
        self.health = render_state.map_or_else(DeviceHealth::default, |state| {
            let ctx = ctx.clone();
            DeviceHealth::watch(&state.device, move || ctx.request_repaint())
        });
        ctx.add_plugin(lasting::PaintGuard(self.health.clone()));
        self.views.set_device(render_state);
        self.compare = compare::CompareView::new(render_state);
        self.trial_view.set_device(render_state);
    }

    /// Lets go of the device and of all that stands on it, before it is replaced.
    pub fn leave(&mut self) {
        self.views.set_device(None);
        self.compare = compare::CompareView::new(None);
        self.trial_view.set_device(None);
    }

    /// Why the device has to be replaced, if it has to be.
    pub fn device_end(&self) -> Option<Fault> {
        self.health.end()
    }

    /// What is known of the device, for whoever hears of its end before it does.
    pub fn device_health(&self) -> &DeviceHealth {
        &self.health
    }

    /// Gives up what is on a device whose memory is full, and says so. It is tried again with what is shown next.
    fn heed_memory(&mut self) {
        if self.health.take_full() {
            self.views.refuse(self.state.document.as_ref().map(|document| document.revision));
            self.compare.refuse();
            self.trial_view.refuse();
            self.state.warn(NO_MEMORY);
        }
    }

    /// Whether the hand on the keys can be followed: see [`Platform::has_attention`].
    pub fn has_attention(&self) -> bool {
        self.platform.has_attention()
    }

    /// What the app knows.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// What the app knows of the trial.
    pub fn trial(&self) -> &trial::Trial {
        &self.trial
    }

    /// From where the surface is looked at.
    pub fn camera(&self) -> &Camera {
        &self.views.camera
    }

    /// How many pictures of the trial were drawn since its views were shown.
    pub fn trial_draws(&self) -> u64 {
        self.trial_view.draws()
    }

    /// Whether the trial's views stand in the device's memory.
    pub fn trial_holds_memory(&self) -> bool {
        self.trial_view.holds_memory()
    }

    /// Hears what platform and engines have to say, deaths among it.
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
                    self.trial.leave_surface(self.platform.trial());
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
    }

    /// Sends on what was done and heard.
    fn follow(&mut self, ctx: &egui::Context) {
        self.state.follow(keys::moves_control(ctx), self.platform.link());
        let State { document, settings, .. } = &self.state;
        let has_level = self.state.has_level();
        self.trial.follow_level(&settings.smoothing, has_level, document.as_ref(), self.platform.trial());
        self.trial.next_row(self.platform.trial());
        // A gamepad tells nothing by itself.
        let has_gamepad = self.trial.is_open && self.trial.is_in_hand() && self.platform.gamepad().is_some();
        let is_moving = self.trial.is_open && self.trial.is_moving();
        if has_gamepad || is_moving || self.trial.is_driven() || self.state.is_busy() || self.trial.is_busy() {
            ctx.request_repaint_after(LISTEN);
        }
    }

    /// Does what the keys ask for.
    fn take_keys(&mut self, ui: &Ui, keys: Keys) {
        if matches!(keys, Keys::Sheet | Keys::List) {
            return;
        }
        let ctx = ui.ctx();
        let mut action = keys::with_ctrl(ui, keys);
        if keys == Keys::Views {
            if self.trial.is_open {
                if let Some(ask) = trial::keys(ui, &mut self.trial) {
                    self.act_on_trial(&ask, ctx);
                }
            } else {
                action = action.or_else(|| keys::action(ui, &mut self.views));
            }
            if keys::pressed(ui, Modifiers::NONE, Key::Escape) {
                self.take_off(ctx);
            }
        }
        if let Some(action) = action {
            self.act(action, ctx);
        }
    }

    /// Takes off one thing, what lies on top: the tables, picking, what is going on, the trial, the comparison. Sheets,
    /// lists and fields do so themselves.
    fn take_off(&mut self, ctx: &egui::Context) {
        if self.trial.tables.is_open {
            self.trial.tables.is_open = false;
        } else if self.trial.pick.is_some() {
            self.trial.pick = None;
        } else if self.state.is_busy() {
            self.act(Action::Cancel, ctx);
        } else if self.trial.is_open && self.trial.comparing.is_some() {
            self.act_on_trial(&trial::Ask::CancelComparison, ctx);
        } else if self.trial.is_open {
            self.act_on_trial(&trial::Ask::Close, ctx);
        } else {
            self.state.comparison.set_open(false);
        }
    }

    fn act(&mut self, action: Action, ctx: &egui::Context) {
        // What was shown of it before is not the last.
        ctx.request_repaint();
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

    /// Shows the bars and the panel, and does what is asked for there.
    fn controls(&mut self, ui: &mut Ui, is_narrow: bool) {
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
        if let Some(action) = action {
            self.act(action, ui.ctx());
        }
        if let Some(ask) = ask {
            self.act_on_trial(&ask, ui.ctx());
        }
    }

    /// Shows the views, and what lies over them.
    fn centre(&mut self, ui: &mut Ui, is_narrow: bool) {
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
    /// Before each frame, and alone while the window is minimised or its tab hidden: what is heard does not wait for
    /// eyes, and no hand that nobody sees is on the wire.
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.listen(ctx);
        if ctx.input(|input| input.viewport().visible() == Some(false)) {
            self.trial.follow_hand(ctx, Keys::Views, None, self.platform.trial());
            self.follow(ctx);
        }
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        let ctx = ui.ctx().clone();
        if let Some(end) = self.health.end() {
            // Nothing can be drawn any more, and calls to the device may panic. A call that was refused is a mistake in
            // here, which tests should not pass over.
            debug_assert!(!matches!(end, Fault::Refused(_)), "{end}");
            return;
        }
        self.heed_memory();
        let dropped = ctx.input(|input| input.raw.dropped_files.first().cloned());
        if let Some(file) = dropped {
            // The unit was chosen for a file of the dialog.
            self.state.next_unit = None;
            self.platform.read_dropped(file, &ctx);
        }
        let keys = Keys::of(&ctx, self.sheet.is_some(), self.was_typing);
        let by_key = keys == Keys::Views && ctx.input(|input| input.key_down(Key::B));
        self.views.show_before = by_key || self.views.before_is_held || self.views.before_is_on;
        let is_narrow = ui.available_width() < NARROW;
        self.controls(ui, is_narrow);
        self.take_keys(ui, keys);
        // Before the views: they are of this frame.
        self.state.show_level();
        self.centre(ui, is_narrow);
        let gamepad = self.platform.gamepad();
        self.trial.follow_hand(&ctx, keys, gamepad, self.platform.trial());
        if let Some(sheet) = self.sheet {
            let is_done = sheets::show(ui, sheet, self.trial.is_open);
            if is_done || keys::pressed(ui, Modifiers::NONE, Key::F1) {
                self.sheet = None;
            }
        }
        self.was_typing = ctx.text_edit_focused();
        self.follow(&ctx);
    }
}
