//! What the app does of what controls and keys ask for.

use egui::{Key, Modifiers, Ui};

use super::LumenApp;
use crate::app::action::{Action, of_trial};
use crate::app::keys::{self, Keys};
use crate::app::sharing::Sharing;
use crate::app::sheets::Sheet;
use crate::app::shortcuts;
use crate::app::views::Spot;
use crate::app::{collapses, lesson, measure, record, recovery, scan, theme, trial, vessels};
use crate::say;

impl LumenApp {
    /// Does what the keys ask for.
    pub(super) fn take_keys(&mut self, ui: &Ui, keys: Keys) {
        let are_views = keys == Keys::Views && self.shows_measuring();
        self.measuring.take_keys(ui, are_views);
        if matches!(keys, Keys::Sheet | Keys::List) {
            return;
        }
        let ctx = ui.ctx();
        let mut action = shortcuts::with_ctrl(ui, keys);
        if self.scans.is_open() {
            // What lies below the scan is not to be seen.
            action = action.filter(|action| matches!(action, Action::Open | Action::Help));
            if keys == Keys::Views && keys::pressed(ui, Modifiers::NONE, Key::Escape) {
                action = self.on_top();
            }
            return self.act_on_all(action, ctx);
        }
        if keys == Keys::Views {
            if self.trial.is_open() {
                let mut asked = Vec::new();
                trial::keys(ui, &self.trial, &mut asked);
                self.act_on_all(of_trial(asked), ctx);
            } else {
                action = action.or_else(|| shortcuts::action(ui, &mut self.views));
            }
            if keys::pressed(ui, Modifiers::NONE, Key::Escape) {
                self.act_on_all(self.on_top(), ctx);
            }
        }
        self.act_on_all(action, ctx);
    }

    /// What takes off one thing, the one that lies on top: the tables, picking, a tool, what is waited for, the large
    /// fluoroscopy, the trial, the comparison, the vessels, presenting, the numbers that are still to come.
    /// Sheets, lists and fields take themselves off.
    pub(super) fn on_top(&self) -> Option<Action> {
        if self.trial.tables.is_open {
            Some(Action::Trial(trial::Action::CloseTables))
        } else if self.trial.pick.is_some() {
            Some(Action::Trial(trial::Action::Pick(None)))
        } else if let Some(action) = self.measuring.on_top().filter(|_| self.shows_measuring()) {
            Some(Action::Measure(action))
        } else if self.record.progress().is_some() {
            Some(Action::Record(record::Action::Cancel))
        } else if self.scans.opening().is_some() {
            Some(Action::Scan(scan::Action::Cancel))
        } else if self.state.awaits() {
            Some(Action::Cancel)
        } else if self.trial.is_comparing() {
            Some(Action::Trial(trial::Action::CancelComparison))
        } else if let Some(scan) = self.scans.shown() {
            let cancel = if scan.is_making() { scan::Action::Cancel } else { scan::Action::Close };
            Some(Action::Scan(cancel))
        } else if self.trial.carm.is_large {
            Some(Action::Trial(trial::Action::Arm(trial::Arm::Enlarge)))
        } else if self.trial.is_open() {
            Some(Action::Trial(trial::Action::Close))
        } else if self.state.comparison.is_open() {
            Some(Action::Compare)
        } else if self.shows_measuring() {
            Some(Action::Measure(measure::Action::Toggle))
        } else {
            let asked = [
                (self.vessels.is_open, Action::Vessels(vessels::Action::Toggle)),
                (self.views.collapses.is_open(), Action::Collapses(collapses::Action::Toggle)),
                (self.lessons.given().is_some(), Action::Lesson(lesson::Action::Close)),
                (self.presenter.is_on(), Action::Present),
                (self.state.is_busy(), Action::Cancel),
            ];
            asked.into_iter().find(|(is_open, _)| *is_open).map(|(_, action)| action)
        }
    }

    pub(super) fn act_on_all(&mut self, actions: impl IntoIterator<Item = Action>, ctx: &egui::Context) {
        actions.into_iter().for_each(|action| self.act(action, ctx));
    }

    /// Does what is asked for: nothing else changes settings, comparison or trial by the user's will, but for what is steered
    /// by hand: cameras, C-arm and wire.
    pub(super) fn act(&mut self, action: Action, ctx: &egui::Context) {
        // What was shown of it before is not the last.
        ctx.request_repaint();
        let keep = self.state.settings.keep;
        let state = &mut self.state;
        match action {
            Action::Open | Action::OpenIn(_) => {
                state.next_unit = if let Action::OpenIn(unit) = action { Some(unit) } else { None };
                self.platform.choose_file(ctx);
            }
            Action::ReadIn(unit) => state.set_unit(Some(unit), self.platform.link()),
            Action::Sample(sample) => {
                self.leave_scan();
                self.state.open_sample(sample, self.platform.link());
            }
            Action::Save(format) => state.save(format, self.platform.link()),
            Action::Axes(axes) => self.recovery.choose_axes(state, axes),
            Action::SaveAxes(axes) => state.written_axes = axes,
            Action::Set(settings) => state.settings = *settings,
            Action::Undo => state.undo(),
            Action::Redo => state.redo(),
            Action::Cancel => state.cancel(self.platform.link()),
            Action::Fit => {
                (self.views.spot, self.views.options.fault) = (None, None);
                self.views.fit(state.document.as_ref(), keep);
            }
            Action::View(view) => self.views.look_from(view, state.document.as_ref(), keep),
            Action::GoTo { at_mm, height_mm, label } => {
                self.views.go_to(Spot { at: at_mm.into(), label }, height_mm);
            }
            Action::LookAt { at_mm, height_mm } => {
                self.views.spot = None;
                self.views.fly(at_mm.into(), height_mm);
            }
            Action::Show(options) => self.views.options = options,
            Action::Reveal => self.views.toggle_reveal(state.document.as_ref()),
            Action::Average(is_shown) => {
                state.shows_averaged = is_shown;
                let is_split = state.document.as_ref().is_some_and(|document| self.views.reveals(document));
                if is_shown && !is_split {
                    self.views.reveal();
                }
            }
            Action::HoldBefore(is_held) => self.views.before_is_held = is_held,
            Action::Compare => state.toggle_comparison(),
            Action::Comparison(action) => state.comparison.act(action, &state.settings),
            Action::ToggleTrial => {
                let toggle = if self.trial.is_open() { trial::Action::Close } else { trial::Action::Start };
                self.act_on_trial(toggle, ctx);
            }
            Action::Trial(action) => self.act_on_trial(action, ctx),
            Action::Vessels(action) => self.act_on_vessels(action, ctx),
            Action::Measure(action) => self.act_on_measures(action),
            Action::Collapses(action) => {
                let now_s = ctx.input(|input| input.time);
                self.views.collapses.act(action, state, now_s);
            }
            Action::Lesson(action) => self.act_on_lesson(action, ctx),
            Action::Share(action) => Sharing::act(action, state, &mut *self.platform, ctx),
            Action::Record(action) => {
                self.record.act(action, state, &self.views, theme::style(&ctx.global_style().visuals));
            }
            Action::Recovery(action) => {
                self.recovery.act(action, state, &mut self.trial, &mut *self.platform);
                if action == recovery::Action::Forget {
                    self.speech.choose(None, &mut *self.platform);
                    self.lessons.speak();
                }
            }
            Action::Scan(action) => {
                if let Some(link) = self.platform.scans() {
                    self.scans.act(action, link);
                }
            }
            Action::Present => {
                self.presenter.toggle(ctx);
                if self.presenter.is_on() {
                    state.tell(&say!("app-presenting"));
                }
            }
            Action::Speak(language) => {
                self.speech.choose(language, &mut *self.platform);
                self.lessons.speak();
            }
            Action::Theme => {
                let other = if ctx.theme() == egui::Theme::Dark { egui::Theme::Light } else { egui::Theme::Dark };
                ctx.set_theme(other);
            }
            Action::Help => self.sheet = toggled(self.sheet, Sheet::Help),
            Action::About => self.sheet = toggled(self.sheet, Sheet::About),
        }
    }

    pub(super) fn act_on_trial(&mut self, action: trial::Action, ctx: &egui::Context) {
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
                self.state.record();
                self.trial.adapt_smoothing(&mut self.state.settings.smoothing);
            }
            trial::Action::Start => self.state.comparison.set_open(false),
            _ => {}
        }
        self.trial.act(action, self.state.document.as_ref(), self.platform.trial());
    }

    pub(super) fn act_on_lesson(&mut self, action: lesson::Action, ctx: &egui::Context) {
        match action {
            lesson::Action::Open(name) => match self.lessons.open(name) {
                Ok(()) => self.act_on_lesson(lesson::Action::Go(0), ctx),
                Err(sentence) => self.state.warn(&sentence),
            },
            lesson::Action::Choose => self.platform.choose_file(ctx),
            lesson::Action::Go(step) => {
                self.leave_scan();
                // What was set by hand is a step of its own to undo.
                self.state.record();
                let now = lesson::Now {
                    state: &self.state,
                    options: self.views.options,
                    in_trial: self.trial.is_open(),
                    has_autopilot: self.trial.run().is_some_and(|run| run.autopilot),
                    are_vessels_open: self.vessels.is_open,
                    are_collapses_open: self.views.collapses.is_open(),
                };
                let asked = self.lessons.go(step, now);
                self.act_on_all(asked, ctx);
            }
            lesson::Action::Answer => self.lessons.answer(),
            lesson::Action::CopyLink => {
                let given = self.lessons.given().and_then(|given| Some((given.name?, given.step)));
                if let (Some((name, step)), Some(address)) = (given, self.platform.address()) {
                    ctx.copy_text(format!("{address}#{}", lesson::fragment(name, step)));
                    self.state.tell(&say!("app-step-link-copied"));
                }
            }
            lesson::Action::Close => self.lessons.close(),
            lesson::Action::Glossary => self.sheet = toggled(self.sheet, Sheet::Glossary),
        }
    }

    /// Does what a step of a lesson has asked for, once the level is there and looked at.
    pub(super) fn follow_lesson(&mut self, ctx: &egui::Context) {
        let has_level = self.state.opening().is_none() && self.state.has_level() && !self.look_next;
        while let Some(action) = self.lessons.next(has_level, &self.trial) {
            self.act(action, ctx);
        }
    }

    pub(super) fn act_on_vessels(&mut self, action: vessels::Action, ctx: &egui::Context) {
        match action {
            vessels::Action::Toggle => {
                self.vessels.is_open = !self.vessels.is_open && !self.trial.is_open();
                if self.vessels.is_open {
                    self.state.comparison.set_open(false);
                    self.measuring.is_open = false;
                } else {
                    self.views.spot = None;
                }
            }
            vessels::Action::Select(branch) => self.vessels.selected = Some(branch),
            vessels::Action::SaveTable => match self.state.calibre_table() {
                Some((name, bytes)) => self.platform.offer_file(&name, bytes, ctx),
                None => self.state.tell(&say!("app-nothing-to-save")),
            },
            vessels::Action::SaveCentrelines(format) => self.state.save_centrelines(format, self.platform.link()),
        }
    }

    pub(super) fn act_on_measures(&mut self, action: measure::Action) {
        if action == measure::Action::Toggle && !self.shows_measuring() {
            // They stand where the measures do.
            self.state.comparison.set_open(false);
            self.vessels.is_open = false;
            self.measuring.is_open = false;
            if self.trial.is_open() {
                return;
            }
        }
        self.measuring.act(action, &mut self.state);
    }
}

fn toggled(open: Option<Sheet>, sheet: Sheet) -> Option<Sheet> {
    (open != Some(sheet)).then_some(sheet)
}
