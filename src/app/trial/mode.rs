//! The trial as a mode of the window.

use egui::Ui;

use super::action::{Action as OfTrial, Arm, DeviceAsk};
use super::state::Trial;
use super::view::TrialView;
use super::{panel, tables_window};
use crate::app::action::Action;
use crate::app::document::Document;
use crate::app::filling::Filling;
use crate::app::mode::{Acting, Beside, Entry, Group, Layer, Mode, Now, Panel};
use crate::app::platform::Platform;
use crate::app::reference::against::Next;
use crate::app::state::State;
use crate::app::views::Views;
use crate::language::Key;
use crate::pipeline::settings::Smoothing;

/// What the keys do while a trial is shown.
const KEYS: [(Key, Key); 18] = [
    (Key("app-trial-key-feed"), Key("app-trial-key-feed-does")),
    (Key("app-trial-key-roll"), Key("app-trial-key-roll-does")),
    (Key("app-trial-key-faster"), Key("app-trial-key-faster-does")),
    (Key("app-trial-key-gamepad"), Key("app-trial-key-gamepad-does")),
    (Key("app-trial-key-autopilot"), Key("app-trial-key-autopilot-does")),
    (Key("app-trial-key-fluoroscopy"), Key("app-trial-key-fluoroscopy-does")),
    (Key("app-trial-key-enlarge"), Key("app-trial-key-enlarge-does")),
    (Key("app-trial-key-contrast"), Key("app-trial-key-contrast-does")),
    (Key("app-trial-key-arm"), Key("app-trial-key-arm-does")),
    (Key("app-trial-key-turn-arm"), Key("app-trial-key-turn-arm-does")),
    (Key("app-trial-key-magnify"), Key("app-trial-key-magnify-does")),
    (Key("app-trial-key-restart"), Key("app-trial-key-restart-does")),
    (Key("app-trial-key-pause"), Key("app-trial-key-pause-does")),
    (Key("app-trial-key-back"), Key("app-trial-key-back-does")),
    (Key("app-trial-key-slow"), Key("app-trial-key-slow-does")),
    (Key("app-trial-key-escape"), Key("app-trial-key-escape-does")),
    (Key("app-trial-key-view"), Key("app-trial-key-view-does")),
    (Key("app-trial-key-sheet"), Key("app-trial-key-sheet-does")),
];

/// The trial: what is known of it, and its views.
pub(in crate::app) struct TrialPanel {
    pub(in crate::app) trial: Trial,
    pub(in crate::app) view: TrialView,
}

impl Default for TrialPanel {
    fn default() -> Self {
        Self { trial: Trial::new(), view: TrialView::new(None) }
    }
}

impl TrialPanel {
    /// Shows the last step of the method: where a trial begins, or its controls.
    pub(in crate::app) fn show_step(&self, ui: &mut Ui, state: &State, asked: &mut Vec<Action>) {
        let (smoothing, document): (&Smoothing, Option<&Document>) =
            (&state.settings.smoothing, state.document.as_ref());
        let mut of_trial = Vec::new();
        panel::show(ui, &self.trial, smoothing, document, &mut of_trial);
        asked.extend(of_trial.into_iter().map(Action::Trial));
    }

    fn act_on(&mut self, action: OfTrial, acting: &mut Acting<'_>) {
        match action {
            OfTrial::OpenLog => {
                acting.state.against.expect(Next::Surface);
                acting.platform.choose_file(acting.ctx);
            }
            OfTrial::Device(DeviceAsk::SaveLatency) => {
                if let Some(table) = self.trial.latency_table() {
                    acting.platform.offer_file("lumen-haptic-latency.csv", table.into_bytes(), acting.ctx);
                }
            }
            OfTrial::Device(ask) => self.trial.act_on_device(ask, acting.platform.devices()),
            OfTrial::AdaptSmoothing => {
                // One step to undo, whatever was changed before it.
                acting.state.record();
                self.trial.adapt_smoothing(&mut acting.state.settings.smoothing);
            }
            OfTrial::Start => acting.state.comparison.set_open(false),
            _ => {}
        }
        self.trial.act(action, acting.state.document.as_ref(), acting.platform.trial());
    }
}

impl Panel for TrialPanel {
    fn id(&self) -> &'static str {
        "trial"
    }

    fn is_there(&self, _: &State, _: Beside) -> bool {
        self.trial.is_open()
    }

    fn mode(&self) -> Option<Mode> {
        Some(Mode::Trial)
    }

    fn replaces_method(&self) -> bool {
        true
    }

    fn leaves_short_cuts(&self) -> bool {
        false
    }

    fn entry(&self, now: Now<'_>) -> Option<Entry> {
        Some(Entry {
            group: Group::Tabs,
            label: Key("app-trial"),
            help: Key("app-trial-help"),
            key: None,
            action: Action::ToggleTrial,
            is_open: now.mode == Mode::Trial,
            is_enabled: now.has_level(),
        })
    }

    fn take_keys(&mut self, ui: &Ui, are_its: bool, asked: &mut Vec<Action>) {
        if are_its {
            let mut of_trial = Vec::new();
            panel::keys(ui, &self.trial, &mut of_trial);
            asked.extend(of_trial.into_iter().map(Action::Trial));
        }
    }

    fn key_sheet(&self) -> Option<&'static [(Key, Key)]> {
        Some(&KEYS)
    }

    fn escape(&self, _: Now<'_>, layer: Layer) -> Option<Action> {
        let open = self.trial.open();
        let asked = match layer {
            Layer::Held if self.trial.tables.is_open => OfTrial::CloseTables,
            Layer::Held if open.is_some_and(|open| open.pick.is_some()) => OfTrial::Pick(None),
            Layer::Underway if self.trial.is_comparing() => OfTrial::CancelComparison,
            Layer::Open if open.is_some_and(|open| open.carm.is_large) => OfTrial::Arm(Arm::Enlarge),
            Layer::Open if open.is_some() => OfTrial::Close,
            _ => return None,
        };
        Some(Action::Trial(asked))
    }

    fn has_head(&self) -> bool {
        true
    }

    fn show_head(&mut self, ui: &mut Ui, _: Now<'_>, asked: &mut Vec<Action>) {
        let mut of_trial = Vec::new();
        panel::head(ui, &self.trial, &mut of_trial);
        asked.extend(of_trial.into_iter().map(Action::Trial));
    }

    fn show(&mut self, ui: &mut Ui, now: Now<'_>, asked: &mut Vec<Action>) {
        self.show_step(ui, now.state, asked);
    }

    fn thumb_height(&self) -> Option<f32> {
        Some(72.0)
    }

    fn show_thumbs(&mut self, ui: &mut Ui) {
        self.trial.pads(ui);
    }

    fn show_over(&mut self, ui: &Ui, asked: &mut Vec<Action>) {
        self.view.time_tables(ui, &mut self.trial.tables);
        let mut of_trial = Vec::new();
        tables_window::show(ui, &self.trial.tables, &mut of_trial);
        asked.extend(of_trial.into_iter().map(Action::Trial));
    }

    fn act(&mut self, action: Action, acting: &mut Acting<'_>) -> Option<Action> {
        let action = match action {
            Action::ToggleTrial if self.trial.is_open() => OfTrial::Close,
            Action::ToggleTrial => OfTrial::Start,
            Action::Trial(action) => action,
            other => return Some(other),
        };
        self.act_on(action, acting);
        None
    }

    fn goes_on(&self, platform: &dyn Platform) -> bool {
        // A gamepad tells nothing by itself.
        let has_gamepad = self.trial.is_in_hand() && platform.gamepad().is_some();
        has_gamepad
            || self.trial.is_moving()
            || self.trial.is_driven()
            || self.trial.has_device().0
            || self.trial.is_busy()
    }
}

impl Filling for TrialPanel {
    fn set_device(&mut self, device: Option<&egui_wgpu::RenderState>) {
        self.view.set_device(device);
    }

    fn refuse(&mut self) {
        self.view.refuse();
    }

    fn release(&mut self, state: &State, views: &mut Views) {
        if self.trial.is_open() {
            return;
        }
        self.view.leave(views, state.document.as_ref());
        if !self.trial.tables.needs_views() {
            self.view.release();
        }
    }

    fn fill(&mut self, ui: &mut Ui, state: &State, views: &mut Views, is_narrow: bool) -> Vec<Action> {
        let (document, keep) = (state.document.as_ref(), state.settings.keep);
        self.trial.take_title(document);
        let asked = self.view.show(ui, &mut self.trial, views, document, keep, is_narrow);
        asked.map(Action::Trial).into_iter().collect()
    }
}
