//! The app, frame by frame: it hears platform and engines (`hearing`), shows controls and views (`layout`), and does what
//! they ask for (`acting`).

mod acting;
mod hearing;
mod layout;

use std::time::Duration;

use egui::{Key, Modifiers, Ui};

use super::action::Action;
use super::drawer::Drawer;
use super::filling::Filling;
use super::keys::{self, Keys};
use super::lesson::Lessons;
use super::mode::{Beside, Mode, Now};
use super::options::ViewOptions;
use super::paint_guard::PaintGuard;
use super::platform::Platform;
use super::presenter::Presenter;
use super::record::{self, Record};
use super::recovery::{self, Recovery};
use super::reference::against::Next;
use super::sharing::Sharing;
use super::sheets::{self, Sheet};
use super::speech::Speech;
use super::state::State;
use super::trial::{self, Trial};
use super::views::{NO_MEMORY, Views};
use super::{Panels, collapses, theme};
use crate::haptics::safety::Halt;
use crate::haptics::service::DeviceCommand;
use crate::render::{Camera, DeviceHealth, Fault};
use crate::say;

/// A window that is so many times as high as wide has the panel below the views, too: a tablet that is held upright.
const UPRIGHT: f32 = 1.2;

/// From this width of a window on, in points before any zoom, everything is drawn [`GROWN`] times as large.
const LARGE: f32 = 1600.0;
const GROWN: f32 = 1.125;

/// How often the engine is listened to while it works and nothing else moves.
const LISTEN: Duration = Duration::from_millis(16);

/// The app.
pub struct LumenApp {
    /// The window that it is in.
    ctx: egui::Context,
    /// What is known of its device.
    health: DeviceHealth,
    state: State,
    views: Views,
    panels: Panels,
    /// What stands beside the views.
    beside: Beside,
    record: Record,
    recovery: Recovery,
    sharing: Sharing,
    speech: Speech,
    platform: Box<dyn Platform>,
    sheet: Option<Sheet>,
    /// Whether the sample invites to open a file.
    invites: bool,
    presenter: Presenter,
    drawer: Drawer,
    /// Whether a field was typed into at the end of the frame before.
    was_typing: bool,
    /// The views find a new surface when they are next shown: their shape is known by then.
    look_next: bool,
    /// Whether the window is that of a phone, in this frame.
    is_narrow: bool,
    /// Whether the panel stands below the views, in this frame.
    is_stacked: bool,
    /// Whether links can be made here.
    has_links: bool,
    /// The zoom with which everything is drawn larger, while a large window has room for that.
    grown: Option<f32>,
}

impl LumenApp {
    /// The app, with what was open before, or a sample.
    pub fn new(
        ctx: &egui::Context,
        render_state: Option<&egui_wgpu::RenderState>,
        mut platform: Box<dyn Platform>,
    ) -> Self {
        let mut state = State::default();
        state.sample_triangles = platform.sample_triangles();
        let mut panels = Panels::default();
        // Before anything is said.
        let speech = Speech::begin(recovery::language(&mut *platform), &mut *platform);
        let recovery = Recovery::begin(&mut state, &mut panels.trial.trial, &mut *platform);
        let mut app = Self {
            ctx: ctx.clone(),
            health: DeviceHealth::default(),
            state,
            views: Views::new(None),
            panels,
            beside: Beside::default(),
            record: Record::default(),
            recovery,
            sharing: Sharing::default(),
            speech,
            platform,
            sheet: None,
            invites: true,
            presenter: Presenter::default(),
            drawer: Drawer::default(),
            was_typing: false,
            look_next: false,
            is_narrow: false,
            is_stacked: false,
            has_links: false,
            grown: None,
        };
        if !app.platform.prefers_less_motion() {
            app.views.divider.sweep();
        }
        app.enter(ctx, render_state);
        app
    }

    /// Goes on in another window, with another device: what is open, the settings, their history, the camera, the trial
    /// and how the controls stand stay as they are, and what was on the old device is made again.
    pub fn resume(&mut self, ctx: &egui::Context, render_state: Option<&egui_wgpu::RenderState>) {
        let memory = self.ctx.memory(Clone::clone);
        ctx.memory_mut(|now| *now = memory);
        self.platform.enter(ctx);
        self.panels.trial.trial.restart_clock();
        self.enter(ctx, render_state);
        self.state.tell(&say!("app-graphics-restarted"));
    }

    fn enter(&mut self, ctx: &egui::Context, render_state: Option<&egui_wgpu::RenderState>) {
        theme::apply(ctx);
        theme::suit(ctx, self.platform.has_finger(), !self.platform.prefers_less_motion());
        self.ctx = ctx.clone();
        self.health = render_state.map_or_else(DeviceHealth::default, |state| {
            let ctx = ctx.clone();
            DeviceHealth::watch(&state.device, move || ctx.request_repaint())
        });
        ctx.add_plugin(PaintGuard(self.health.clone()));
        self.set_device(render_state);
    }

    fn set_device(&mut self, render_state: Option<&egui_wgpu::RenderState>) {
        self.views.set_device(render_state);
        self.panels.filling_mut().into_iter().for_each(|filling| filling.set_device(render_state));
        self.record.set_device(render_state);
    }

    /// Lets go of the device and of all that stands on it, before it is replaced.
    pub fn leave(&mut self) {
        self.set_device(None);
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
            self.panels.filling_mut().into_iter().for_each(Filling::refuse);
            self.record.cancel(&mut self.state);
            self.state.warn(&NO_MEMORY.say());
        }
    }

    /// Draws everything larger in a large window, and no longer in a smaller one. A zoom that the user has chosen meanwhile
    /// stays.
    fn suit_window(&mut self, ctx: &egui::Context) {
        if self.presenter.is_on() {
            return;
        }
        let zoom = ctx.zoom_factor();
        let width = ctx.content_rect().width() * zoom;
        match self.grown {
            None if width >= LARGE => {
                self.grown = Some(zoom * GROWN);
                ctx.set_zoom_factor(zoom * GROWN);
            }
            Some(grown) if width < 0.95 * LARGE => {
                self.grown = None;
                if (zoom / grown - 1.0).abs() < 0.01 {
                    ctx.set_zoom_factor(zoom / GROWN);
                }
            }
            _ => {}
        }
    }

    /// Whether the hand on the keys can be followed: see [`Screen::has_attention`](super::platform::Screen::has_attention).
    pub fn has_attention(&self) -> bool {
        self.platform.has_attention()
    }

    /// What the app knows.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// What the app knows of the trial.
    pub fn trial(&self) -> &Trial {
        &self.panels.trial.trial
    }

    /// The lesson that is given.
    pub fn lessons(&self) -> &Lessons {
        &self.panels.lesson
    }

    /// The collapses, one by one.
    pub fn collapses(&self) -> &collapses::Collapses {
        &self.panels.collapses
    }

    /// What has the window.
    fn mode(&self) -> Mode {
        self.panels.mode(&self.state)
    }

    /// What a panel may look at.
    fn now(&self, mode: Mode) -> Now<'_> {
        Now {
            state: &self.state,
            mode,
            beside: self.beside,
            options: self.views.options,
            camera: &self.views.camera,
            is_narrow: self.is_narrow,
            has_links: self.has_links,
        }
    }

    /// What the views show.
    pub fn options(&self) -> ViewOptions {
        self.views.options
    }

    /// From where the surface is looked at.
    pub fn camera(&self) -> &Camera {
        &self.views.camera
    }

    /// What is marked besides the place that is ringed: the stretch that it lies in, in mm, and what is said of places beside it.
    pub fn marked(&self) -> (Vec<[f32; 3]>, Vec<&str>) {
        let spot = self.views.spot.as_ref();
        let along = spot.iter().flat_map(|spot| &spot.along).map(glam::Vec3::to_array).collect();
        (along, spot.iter().flat_map(|spot| &spot.beside).map(|(_, label)| label.as_str()).collect())
    }

    /// How many pictures of the trial were drawn since its views were shown.
    pub fn trial_draws(&self) -> u64 {
        self.panels.trial.view.draws()
    }

    /// Whether the trial's views stand in the device's memory.
    pub fn trial_holds_memory(&self) -> bool {
        self.panels.trial.view.holds_memory()
    }
}

impl eframe::App for LumenApp {
    /// Before each frame, and alone while the window is minimised or its tab hidden: what is heard does not wait for
    /// eyes, and no hand that nobody sees is on the wire.
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.listen(ctx);
        let was_left = self.platform.was_left();
        let is_hidden = was_left || ctx.input(|input| !input.raw.focused || input.viewport().visible() == Some(false));
        let trial = &mut self.panels.trial.trial;
        if trial.follow_device(self.platform.devices(), is_hidden) {
            trial.act(trial::Action::Pause, None, self.platform.trial());
        }
        let (now_ms, gamepad) = (1000.0 * ctx.input(|input| input.time), self.platform.gamepad());
        let (shake, tone) = trial.follow_force(now_ms, gamepad, self.platform.has_sound(), is_hidden);
        if let Some(strength) = shake {
            self.platform.rumble(strength);
        }
        if let Some(tone) = tone {
            self.platform.sound(tone);
        }
        if ctx.input(|input| input.viewport().visible() == Some(false)) {
            self.panels.trial.trial.follow_hand(ctx, Keys::Views, None, self.platform.trial());
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
        self.views.follow_flight(&ctx, !self.platform.prefers_less_motion());
        // Before sheets, lists and fields: whoever presses it because a device pushes wants that to end.
        if self.panels.trial.trial.has_device().1
            && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape))
        {
            let stop = DeviceCommand::Halt(Halt::Stopped);
            self.act(Action::Trial(trial::Action::Device(trial::DeviceAsk::Command(stop))), &ctx);
        }
        let dropped = ctx.input(|input| input.raw.dropped_files.clone());
        if !dropped.is_empty() && !self.platform.is_embedded() {
            // The unit was chosen for a file of the dialog.
            self.state.next_unit = None;
            self.state.against.expect(Next::Dropped);
            self.platform.read_dropped(dropped, &ctx);
        }
        self.suit_window(&ctx);
        self.presenter.hear(&ctx);
        let keys = Keys::of(&ctx, self.sheet.is_some(), self.was_typing);
        // A control that has the focus is pressed by Space.
        let has_space = self.mode() != Mode::Trial && ctx.memory(|memory| memory.focused().is_none());
        let by_key =
            keys == Keys::Views && ctx.input(|input| input.key_down(Key::B) || has_space && input.key_down(Key::Space));
        let is_asked = by_key || self.views.before_is_held || self.views.options.before;
        self.views.show_before = is_asked || self.state.awaits_levels();
        let window = ui.available_size();
        self.is_narrow = theme::is_narrow(&ctx);
        self.is_stacked = self.is_narrow || window.y > UPRIGHT * window.x;
        self.has_links = self.platform.address().is_some();
        self.controls(ui);
        self.take_keys(ui, keys);
        // Before the views: they are of this frame.
        self.state.show_level();
        self.follow_lesson(&ctx);
        let now_s = ctx.input(|input| input.time);
        let (document, collapses) = (self.state.document.as_ref(), &mut self.panels.collapses);
        let played = self.views.led_by(|camera| collapses.follow(document, camera, now_s));
        if self.views.is_flying() {
            ctx.request_repaint();
        }
        self.act_on_all(played, &ctx);
        let mode = self.mode();
        let played = self.panels.playback.follow(&self.state, mode, now_s);
        self.act_on_all(played, &ctx);
        self.state.show_level();
        self.centre(ui);
        let gamepad = self.platform.gamepad();
        self.panels.trial.trial.follow_hand(&ctx, keys, gamepad, self.platform.trial());
        if let Some(sheet) = self.sheet {
            let mut asked = None;
            let lines = self.key_lines();
            let is_done = sheets::show(ui, sheet, &lines, &mut |ui| asked = self.record.sheet(ui));
            let is_saved = matches!(asked, Some(record::Action::Report(_)));
            self.act_on_all(asked.map(Action::Record), &ctx);
            if is_done || is_saved || keys::pressed(ui, Modifiers::NONE, Key::F1) {
                self.sheet = None;
            }
        }
        self.presenter.show(&ctx);
        self.was_typing = ctx.text_edit_focused();
        self.follow(&ctx);
    }
}
