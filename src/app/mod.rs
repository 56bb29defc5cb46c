//! The window's content, the same on the desktop and in the browser. It knows no platform: [`Platform`] gives it
//! files and the line to the engine.
//!
//! - [`State`]: what the app knows and how it changes; [`document`] the surface that is open, [`history`] undo.
//! - `panel`, `bar`, `sheets`, `keys`: the controls; `control` is a row of the panel, `icon` its icons, `theme` the look.
//! - [`compare`]: several settings side by side, in the window or as a figure.
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
            platform,
            sheet: None,
            look_next: false,
        }
    }

    /// What the app knows.
    pub fn state(&self) -> &State {
        &self.state
    }

    fn listen(&mut self, ctx: &egui::Context) {
        while let Some(event) = self.platform.poll() {
            match event {
                PlatformEvent::Chosen { name, bytes } => self.state.open_file(name, bytes, self.platform.link()),
                PlatformEvent::Saved { name } => self.state.tell(&format!("{name} was saved.")),
                PlatformEvent::Failed { message } => self.state.warn(&message),
            }
        }
        while let Some(event) = self.platform.link().poll() {
            match self.state.receive(event) {
                Some(Effect::Opened) => self.look_next = true,
                Some(Effect::Offer { name, bytes }) => self.platform.offer_file(&name, bytes, ctx),
                None => {}
            }
        }
        if let Some(reason) = self.platform.link().failure() {
            self.state.engine_failed(&reason, self.platform.link());
        }
        let dropped = ctx.input(|input| input.raw.dropped_files.first().cloned());
        if let Some(file) = dropped {
            self.platform.read_dropped(file, ctx);
        }
    }

    fn act(&mut self, action: Action, ctx: &egui::Context) {
        let keep = self.state.settings.keep;
        let state = &mut self.state;
        match action {
            Action::Open => self.platform.choose_file(ctx),
            Action::Sample(sample) => state.open_sample(sample, self.platform.link()),
            Action::Save(format) => state.save(format, self.platform.link()),
            Action::Undo => state.undo(),
            Action::Redo => state.redo(),
            Action::Cancel => state.cancel(self.platform.link()),
            Action::Fit => self.views.fit(state.document.as_ref(), keep),
            Action::View(view) => self.views.look_from(view, state.document.as_ref(), keep),
            Action::Compare => state.toggle_comparison(),
            Action::Theme => {
                let other = if ctx.theme() == egui::Theme::Dark { egui::Theme::Light } else { egui::Theme::Dark };
                ctx.set_theme(other);
            }
            Action::Help => self.sheet = toggled(self.sheet, Sheet::Help),
            Action::About => self.sheet = toggled(self.sheet, Sheet::About),
        }
    }

    fn panels(&mut self, ui: &mut Ui) -> Option<Action> {
        let is_narrow = ui.available_width() < NARROW;
        let bar = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, 6));
        let mut action = None;
        Panel::top("top").frame(bar).exact_size(48.0).show(ui, |ui| {
            action = bar::top(ui, &self.state, &mut self.views, is_narrow);
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
        panel.frame(margin).show(ui, |ui| {
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                // Room for the scroll bar beside what stands at the right.
                ui.set_max_width(ui.available_width() - 8.0);
                if let Some(unit) = panel::show(ui, &mut self.state, &mut self.views) {
                    self.state.set_unit(unit, self.platform.link());
                }
            });
        });
        let keep = self.state.settings.keep;
        let clicked = CentralPanel::default()
            .frame(Frame::new().fill(ui.visuals().widgets.noninteractive.bg_stroke.color))
            .show(ui, |ui| {
                let State { document, comparison, settings, .. } = &mut self.state;
                let document = document.as_ref();
                if std::mem::take(&mut self.look_next) {
                    self.views.look_first(document, keep);
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
        action
    }
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
        let by_key = if self.sheet.is_none() { keys::action(ui, &mut self.views, self.state.is_busy()) } else { None };
        let by_bar = self.panels(ui);
        if let Some(action) = by_key.or(by_bar) {
            self.act(action, &ctx);
        }
        if self.sheet.is_some_and(|sheet| sheets::show(ui, sheet)) || self.sheet.is_some() && keys::closes_sheet(ui) {
            self.sheet = None;
        }
        let is_held = ctx.input(|input| input.pointer.any_down()) || ctx.egui_wants_keyboard_input();
        self.state.follow(is_held, self.platform.link());
        if self.state.is_busy() {
            ctx.request_repaint_after(LISTEN);
        }
    }
}
