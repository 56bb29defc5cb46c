//! The app, frame by frame: it hears platform and engines, shows controls and views, and does what they ask for.

use std::time::Duration;

use egui::{CentralPanel, Frame, Key, Margin, Modifiers, Panel, ScrollArea, Ui};

use super::action::{Action, of_trial};
use super::keys::{self, Keys};
use super::paint_guard::PaintGuard;
use super::platform::{Platform, PlatformEvent};
use super::recovery::Recovery;
use super::scan::{self, ScanView, Scans, Told};
use super::sharing::{self, Sharing};
use super::sheets::{self, Sheet};
use super::state::{Effect, State};
use super::trial::{self, Trial, TrialView};
use super::vessels::{self, Vessels};
use super::views::{NO_MEMORY, Spot, Views};
use super::{bar, compare, panel, theme, verdict};
use crate::haptics::safety::Halt;
use crate::haptics::service::DeviceCommand;
use crate::pipeline::settings::{Keep, Settings};
use crate::render::{Camera, DeviceHealth, Fault};

/// Below this width in points the views stack and the panel becomes a sheet at the bottom.
const NARROW: f32 = 720.0;

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
    compare: compare::CompareView,
    trial: Trial,
    trial_view: TrialView,
    vessels: Vessels,
    recovery: Recovery,
    sharing: Sharing,
    scans: Scans,
    scan_view: ScanView,
    platform: Box<dyn Platform>,
    sheet: Option<Sheet>,
    /// Whether a field was typed into at the end of the frame before.
    was_typing: bool,
    /// The views find a new surface when they are next shown: their shape is known by then.
    look_next: bool,
}

impl LumenApp {
    /// The app, with what was open before, or a sample.
    pub fn new(
        ctx: &egui::Context,
        render_state: Option<&egui_wgpu::RenderState>,
        mut platform: Box<dyn Platform>,
    ) -> Self {
        let mut state = State::default();
        let recovery = Recovery::begin(&mut state, &mut *platform);
        let mut app = Self {
            ctx: ctx.clone(),
            health: DeviceHealth::default(),
            state,
            views: Views::new(None),
            compare: compare::CompareView::new(None),
            trial: Trial::new(),
            trial_view: TrialView::new(None),
            vessels: Vessels::default(),
            recovery,
            sharing: Sharing::default(),
            scans: Scans::default(),
            scan_view: ScanView::default(),
            platform,
            sheet: None,
            was_typing: false,
            look_next: false,
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
        ctx.add_plugin(PaintGuard(self.health.clone()));
        self.views.set_device(render_state);
        self.compare = compare::CompareView::new(render_state);
        self.trial_view.set_device(render_state);
        self.scan_view.set_device(render_state);
    }

    /// Lets go of the device and of all that stands on it, before it is replaced.
    pub fn leave(&mut self) {
        self.views.set_device(None);
        self.compare = compare::CompareView::new(None);
        self.trial_view.set_device(None);
        self.scan_view.set_device(None);
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
            self.scan_view.refuse();
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
    pub fn trial(&self) -> &Trial {
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
                PlatformEvent::Chosen { name, bytes } if sharing::is_settings(&name) => {
                    Sharing::take_file(&name, &bytes, &mut self.state, self.platform.link());
                }
                PlatformEvent::Chosen { name, bytes } => {
                    self.recovery.before_file(&name, &mut self.state);
                    self.sharing.before_file(&mut self.state);
                    self.state.open_file(name, bytes, self.platform.link());
                }
                PlatformEvent::Linked { fragment } => {
                    self.sharing.follow(&fragment, &mut self.state, self.platform.link());
                }
                PlatformEvent::Restored(file) => {
                    self.recovery.restored(file, &mut self.state, self.platform.link());
                }
                PlatformEvent::Scan { files } => {
                    if let Some(link) = self.platform.scans() {
                        self.scans.read(files, link);
                        self.state.tell("The scan is being read.");
                    }
                }
                PlatformEvent::Saved { message } => self.state.tell(&message),
                PlatformEvent::Failed { message } => self.state.warn(&message),
            }
        }
        while let Some(event) = self.platform.link().poll() {
            match self.state.receive(event) {
                Some(Effect::Opened) => {
                    self.look_next = true;
                    self.recovery.opened(&mut self.state, &mut *self.platform);
                    self.sharing.opened(&mut self.state);
                    self.vessels.selected = None;
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
        self.listen_to_scans();
    }

    /// Hears what the engine of scans has to say.
    fn listen_to_scans(&mut self) {
        while let Some(link) = self.platform.scans()
            && let Some(event) = link.poll()
        {
            match self.scans.receive(event, link) {
                Some(Told::Made(source)) => self.state.open(source, self.platform.link()),
                Some(Told::Refused(sentence)) => self.state.warn(&sentence),
                None => {}
            }
        }
        if let Some(link) = self.platform.scans()
            && let Some(reason) = link.failure()
        {
            link.restart();
            let sentence = self.scans.engine_failed(&reason);
            self.state.warn(&sentence);
        }
    }

    /// Sends on what was done and heard.
    fn follow(&mut self, ctx: &egui::Context) {
        self.state.follow(keys::moves_control(ctx), self.platform.link());
        self.recovery.follow(&self.state, &self.views.camera, &mut *self.platform, ctx);
        let State { document, settings, .. } = &self.state;
        let has_level = self.state.has_level();
        self.trial.follow_level(&settings.smoothing, has_level, document.as_ref(), self.platform.trial());
        self.trial.next_row(self.platform.trial());
        if let Some(link) = self.platform.scans() {
            self.scans.follow(link);
        }
        // A gamepad tells nothing by itself.
        let has_gamepad = self.trial.is_in_hand() && self.platform.gamepad().is_some();
        if has_gamepad
            || self.trial.is_moving()
            || self.trial.is_driven()
            || self.trial.has_device().0
            || self.state.is_busy()
            || self.trial.is_busy()
            || self.scans.opening().is_some()
            || self.scans.is_open()
        {
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
            if self.trial.is_open() {
                let mut asked = Vec::new();
                trial::keys(ui, &self.trial, &mut asked);
                self.act_on_all(of_trial(asked), ctx);
            } else {
                action = action.or_else(|| keys::action(ui, &mut self.views));
            }
            if keys::pressed(ui, Modifiers::NONE, Key::Escape) {
                self.act_on_all(self.on_top(), ctx);
            }
        }
        self.act_on_all(action, ctx);
    }

    /// What takes off one thing, the one that lies on top: the tables, picking, what is going on, the trial, the comparison.
    /// Sheets, lists and fields take themselves off.
    fn on_top(&self) -> Option<Action> {
        if self.trial.tables.is_open {
            Some(Action::Trial(trial::Action::CloseTables))
        } else if self.trial.pick.is_some() {
            Some(Action::Trial(trial::Action::Pick(None)))
        } else if self.state.is_busy() {
            Some(Action::Cancel)
        } else if self.trial.is_comparing() {
            Some(Action::Trial(trial::Action::CancelComparison))
        } else if let Some(scan) = self.scans.shown() {
            let cancel = if scan.is_making() { scan::Action::Cancel } else { scan::Action::Close };
            Some(Action::Scan(cancel))
        } else if self.trial.is_open() {
            Some(Action::Trial(trial::Action::Close))
        } else if self.state.comparison.is_open() {
            Some(Action::Compare)
        } else {
            self.vessels.is_open.then_some(Action::Vessels(vessels::Action::Toggle))
        }
    }

    fn act_on_all(&mut self, actions: impl IntoIterator<Item = Action>, ctx: &egui::Context) {
        actions.into_iter().for_each(|action| self.act(action, ctx));
    }

    /// Does what is asked for: nothing else changes settings, comparison or trial by the user's will, but for what is steered
    /// by hand: cameras, C-arm and wire.
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
            Action::ReadIn(unit) => state.set_unit(unit, self.platform.link()),
            Action::Sample(sample) => state.open_sample(sample, self.platform.link()),
            Action::Save(format) => state.save(format, self.platform.link()),
            Action::Axes(axes) => {
                if let Some(document) = &mut state.document {
                    document.import.axes = axes;
                }
            }
            Action::Set(settings) => state.settings = *settings,
            Action::Undo => state.undo(),
            Action::Redo => state.redo(),
            Action::Cancel => state.cancel(self.platform.link()),
            Action::Fit => {
                self.views.spot = None;
                self.views.fit(state.document.as_ref(), keep);
            }
            Action::View(view) => self.views.look_from(view, state.document.as_ref(), keep),
            Action::GoTo { at_mm, height_mm, label } => {
                self.views.go_to(Spot { at: at_mm.into(), label }, height_mm);
            }
            Action::Show(options) => self.views.options = options,
            Action::Reveal => self.views.toggle_reveal(state.document.as_ref()),
            Action::HoldBefore(is_held) => self.views.before_is_held = is_held,
            Action::Compare => state.toggle_comparison(),
            Action::Comparison(action) => state.comparison.act(action, &state.settings),
            Action::ToggleTrial => {
                let toggle = if self.trial.is_open() { trial::Action::Close } else { trial::Action::Start };
                self.act_on_trial(toggle, ctx);
            }
            Action::Trial(action) => self.act_on_trial(action, ctx),
            Action::Vessels(action) => self.act_on_vessels(action, ctx),
            Action::Share(action) => Sharing::act(action, state, &mut *self.platform, ctx),
            Action::Recovery(action) => self.recovery.act(action, state, &mut *self.platform),
            Action::Scan(action) => {
                if let Some(link) = self.platform.scans() {
                    self.scans.act(action, link);
                }
            }
            Action::Theme => {
                let other = if ctx.theme() == egui::Theme::Dark { egui::Theme::Light } else { egui::Theme::Dark };
                ctx.set_theme(other);
            }
            Action::Help => self.sheet = toggled(self.sheet, Sheet::Help),
            Action::About => self.sheet = toggled(self.sheet, Sheet::About),
        }
    }

    fn act_on_trial(&mut self, action: trial::Action, ctx: &egui::Context) {
        match action {
            trial::Action::OpenLog => self.platform.choose_file(ctx),
            trial::Action::Device(trial::DeviceAsk::SaveLatency) => {
                if let Some(table) = self.trial.latency_table() {
                    self.platform.offer_file("lumen-haptic-latency.csv", table.into_bytes(), ctx);
                }
            }
            trial::Action::Device(ask) => self.trial.act_on_device(ask, self.platform.devices()),
            trial::Action::AdaptSmoothing => {
                // One step to undo, whatever was changed before it.
                self.state.history.record(&self.state.settings);
                self.trial.adapt_smoothing(&mut self.state.settings.smoothing);
            }
            trial::Action::Start => self.state.comparison.set_open(false),
            _ => {}
        }
        self.trial.act(action, self.state.document.as_ref(), self.platform.trial());
    }

    fn act_on_vessels(&mut self, action: vessels::Action, ctx: &egui::Context) {
        match action {
            vessels::Action::Toggle => {
                self.vessels.is_open = !self.vessels.is_open && !self.trial.is_open();
                if self.vessels.is_open {
                    self.state.comparison.set_open(false);
                } else {
                    self.views.spot = None;
                }
            }
            vessels::Action::Select(branch) => self.vessels.selected = Some(branch),
            vessels::Action::SaveTable => match self.state.calibre_table() {
                Some((name, bytes)) => self.platform.offer_file(&name, bytes, ctx),
                None => self.state.tell("There is nothing to save yet."),
            },
            vessels::Action::SaveCentrelines(format) => self.state.save_centrelines(format, self.platform.link()),
        }
    }

    /// Whether the vessels are shown: a trial and a comparison take their place.
    fn shows_vessels(&self) -> bool {
        self.vessels.is_open && !self.trial.is_open() && !self.state.comparison.is_open()
    }

    /// Shows the bars and the panel, and does what is asked for there.
    fn controls(&mut self, ui: &mut Ui, is_narrow: bool) {
        let bar = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, 6));
        let mut asked = Vec::new();
        let in_trial = self.trial.is_open();
        let (keeps_surface, has_links) = (self.recovery.keeps(&mut *self.platform), self.platform.address().is_some());
        Panel::top("top").frame(bar).exact_size(48.0).show(ui, |ui| {
            let are_vessels_open = self.shows_vessels();
            let in_scan = self.scans.is_open();
            let shown = bar::Shown { in_trial, in_scan, is_narrow, are_vessels_open, keeps_surface, has_links };
            bar::top(ui, &self.state, &self.views, shown, &mut asked);
        });
        Panel::bottom("status").frame(bar).exact_size(40.0).show(ui, |ui| {
            bar::status(ui, &self.state, &self.views, is_narrow, &mut asked);
        });
        let panel = if is_narrow {
            let height = ui.available_height() * 0.45;
            Panel::bottom("panel").exact_size(height)
        } else {
            Panel::left("panel").resizable(true).default_size(296.0).size_range(256.0..=440.0)
        };
        let margin = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(16, 8));
        let takes_panel = is_narrow && self.shows_vessels();
        panel.frame(margin).show(ui, |ui| {
            if takes_panel {
                vessels::show(ui, &self.vessels, &self.state, &self.views, true, &mut asked);
                return;
            }
            if in_trial && !self.scans.is_open() {
                self.trial.pads(ui);
            }
            ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
                // Room for the scroll bar beside what stands at the right.
                ui.set_max_width(ui.available_width() - 8.0);
                ui.spacing_mut().item_spacing.y = 3.0;
                if let Some(scan) = self.scans.shown() {
                    let mut of_scan = Vec::new();
                    scan::panel(ui, scan, &mut of_scan);
                    asked.extend(of_scan.into_iter().map(Action::Scan));
                    return;
                }
                let of_trial = if in_trial { self.trial_panel(ui) } else { self.method_panel(ui) };
                asked.extend(of_trial);
            });
        });
        if !(in_trial || self.scans.is_open() || self.state.comparison.is_open() || takes_panel) {
            let strip = Frame::side_top_panel(ui.style()).inner_margin(Margin::symmetric(12, 4));
            Panel::top("verdict").frame(strip).exact_size(verdict::height(is_narrow) + 8.0).show(ui, |ui| {
                verdict::show(ui, &self.state, is_narrow, &mut asked);
            });
        }
        if self.shows_vessels() && !is_narrow {
            let height = (ui.available_height() * 0.4).clamp(160.0, 320.0);
            let below = Panel::bottom("vessels").resizable(true).default_size(height).size_range(120.0..=480.0);
            below.frame(margin).show(ui, |ui| {
                vessels::show(ui, &self.vessels, &self.state, &self.views, false, &mut asked);
            });
        }
        self.act_on_all(asked, ui.ctx());
    }

    /// Shows the method from top to bottom. What its steps set is done at once: what follows, and the views, are of the
    /// level that was just asked for. Returns what is asked of the trial.
    fn method_panel(&mut self, ui: &mut Ui) -> Vec<Action> {
        for (id, step) in panel::STEPS {
            let mut asked = Vec::new();
            ui.push_id(id, |ui| step(ui, &self.state, &self.views, &mut asked));
            self.act_on_all(asked, ui.ctx());
        }
        self.state.show_level();
        let asked = ui.push_id("trial", |ui| self.trial_panel(ui)).inner;
        let mut of_result = Vec::new();
        ui.push_id("result", |ui| panel::result(ui, &self.state, &mut of_result));
        asked.into_iter().chain(of_result).collect()
    }

    fn trial_panel(&self, ui: &mut Ui) -> Vec<Action> {
        let (smoothing, document) = (&self.state.settings.smoothing, self.state.document.as_ref());
        let mut asked = Vec::new();
        trial::panel(ui, &self.trial, smoothing, document, &mut asked);
        of_trial(asked).collect()
    }

    /// Shows the views, and what lies over them.
    fn centre(&mut self, ui: &mut Ui, is_narrow: bool) {
        let keep = self.state.settings.keep;
        let asked = CentralPanel::default()
            .frame(Frame::new().fill(ui.visuals().widgets.noninteractive.bg_stroke.color))
            .show(ui, |ui| {
                let State { document, comparison, settings, .. } = &self.state;
                let document = document.as_ref();
                if std::mem::take(&mut self.look_next) {
                    self.views.look_first(document, keep);
                    self.recovery.look(&mut self.views.camera);
                }
                if !comparison.is_open() {
                    self.compare.let_go();
                }
                if !(self.trial.is_open() || self.trial.tables.needs_views()) {
                    self.trial_view.let_go();
                }
                if let Some(scan) = self.scans.shown() {
                    self.scan_view.show(ui, scan, &mut self.views, is_narrow);
                    return Vec::new();
                }
                self.scan_view.let_go();
                if self.trial.is_open() {
                    let trial = &mut self.trial;
                    let asked = self.trial_view.show(ui, trial, &mut self.views, document, keep, is_narrow);
                    return Vec::from_iter(asked.map(Action::Trial));
                }
                if comparison.is_open() {
                    return self.compare.show(ui, comparison, &mut self.views, settings, document, is_narrow);
                }
                let Some(piece) = self.views.show(ui, document, keep, is_narrow) else { return Vec::new() };
                let is_largest = document.and_then(|document| document.pieces.by_size.first()) == Some(&piece);
                let keep = if is_largest { Keep::Largest } else { Keep::Component(piece) };
                vec![Action::Set(Box::new(Settings { keep, ..settings.clone() }))]
            });
        self.act_on_all(asked.inner, ui.ctx());
        self.trial_view.time_tables(ui, &mut self.trial.tables);
        let mut asked = Vec::new();
        trial::tables(ui, &self.trial.tables, &mut asked);
        self.act_on_all(of_trial(asked), ui.ctx());
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
        let is_hidden = ctx.input(|input| !input.raw.focused || input.viewport().visible() == Some(false));
        if self.trial.follow_device(self.platform.devices(), is_hidden) {
            self.trial.act(trial::Action::Pause, None, self.platform.trial());
        }
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
        // Before sheets, lists and fields: whoever presses it because a device pushes wants that to end.
        if self.trial.has_device().1 && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            let stop = DeviceCommand::Halt(Halt::Stopped);
            self.act_on_trial(trial::Action::Device(trial::DeviceAsk::Command(stop)), &ctx);
        }
        let dropped = ctx.input(|input| input.raw.dropped_files.first().cloned());
        if let Some(file) = dropped {
            // The unit was chosen for a file of the dialog.
            self.state.next_unit = None;
            self.platform.read_dropped(file, &ctx);
        }
        let keys = Keys::of(&ctx, self.sheet.is_some(), self.was_typing);
        let by_key = keys == Keys::Views && ctx.input(|input| input.key_down(Key::B));
        self.views.show_before = by_key || self.views.before_is_held || self.views.options.before;
        let is_narrow = ui.available_width() < NARROW;
        self.controls(ui, is_narrow);
        self.take_keys(ui, keys);
        // Before the views: they are of this frame.
        self.state.show_level();
        self.centre(ui, is_narrow);
        let gamepad = self.platform.gamepad();
        self.trial.follow_hand(&ctx, keys, gamepad, self.platform.trial());
        if let Some(sheet) = self.sheet {
            let is_done = sheets::show(ui, sheet, self.trial.is_open());
            if is_done || keys::pressed(ui, Modifiers::NONE, Key::F1) {
                self.sheet = None;
            }
        }
        self.was_typing = ctx.text_edit_focused();
        self.follow(&ctx);
    }
}
