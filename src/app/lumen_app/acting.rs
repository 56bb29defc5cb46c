//! What the app does of what controls and keys ask for.

use egui::{Context, Key, Modifiers, Ui};
use glam::Vec3;

use super::LumenApp;
use crate::app::action::Action;
use crate::app::keys::{self, Keys};
use crate::app::mode::{Acting, Beside, Entry, Group, Layer, Mode, Panel};
use crate::app::record::Sight;
use crate::app::reference::against::Next;
use crate::app::row::Part;
use crate::app::sharing::Sharing;
use crate::app::sheets::{self, Sheet};
use crate::app::views::Spot;
use crate::app::{lesson, measure, record, shortcuts, theme, trial, vessels};
use crate::language;
use crate::pipeline::settings::{Keep, Settings};
use crate::say;

impl LumenApp {
    /// Does what the keys ask for.
    pub(super) fn take_keys(&mut self, ui: &Ui, keys: Keys) {
        let (mode, mut asked) = (self.mode(), Vec::new());
        for panel in self.panels.all_mut() {
            let is_shown = match panel.mode() {
                Some(of) => of == mode,
                None => mode == Mode::Method && panel.is_there(&self.state, self.beside),
            };
            panel.take_keys(ui, keys == Keys::Views && is_shown, &mut asked);
        }
        if matches!(keys, Keys::Sheet | Keys::List) {
            return;
        }
        let ctx = ui.ctx();
        let of_mode = self.panels.of_mut(mode);
        let leaves_short_cuts = of_mode.as_ref().is_none_or(|panel| panel.leaves_short_cuts());
        let mut action = shortcuts::with_ctrl(ui, keys);
        action.take_if(|action| of_mode.is_some_and(|panel| panel.blocks(action)));
        if keys == Keys::Views {
            self.act_on_all(asked, ctx);
            if leaves_short_cuts {
                let entries = self.entries(mode);
                action = action.or_else(|| shortcuts::action(ui, &mut self.views, &entries));
            }
            if keys::pressed(ui, Modifiers::NONE, Key::Escape) {
                self.act_on_all(self.on_top(), ctx);
            }
        }
        self.act_on_all(action, ctx);
    }

    /// Whether it may be asked for where Lumen is a part of another page: there is no bar to come back by, and what is open is
    /// all that there is.
    fn fits_embedded(&self, action: &Action) -> bool {
        match action {
            Action::Set(_) | Action::Undo | Action::Redo | Action::Theme => true,
            Action::View(_) | Action::Show(_) | Action::Fit | Action::Reveal | Action::HoldBefore(_) => true,
            Action::GoTo { .. } | Action::LookAt { .. } | Action::Mark { .. } | Action::Unmark => true,
            Action::MarkStretch { .. } => true,
            Action::Cancel => self.state.opening().is_none() && self.state.document.is_some(),
            _ => false,
        }
    }

    /// What modes and panels have in the bar. The first tab is open where no other is.
    pub(super) fn entries(&self, mode: Mode) -> Vec<Entry> {
        let mut entries: Vec<Entry> =
            self.panels.all().into_iter().filter_map(|panel| panel.entry(self.now(mode))).collect();
        // A trial ends by its own buttons or by the first tab, not by a click beside it. A surface on its way in may yet give
        // back what it covers.
        let is_free = matches!(mode, Mode::Method | Mode::Compare | Mode::Reference | Mode::Solver)
            && !self.state.awaits_levels();
        for entry in entries.iter_mut().filter(|entry| entry.group == Group::Tabs && !entry.is_open) {
            entry.is_enabled &= is_free;
        }
        let is_open = !entries.iter().any(|entry| entry.group == Group::Tabs && entry.is_open);
        let prepare = Entry {
            group: Group::Tabs,
            label: language::Key("app-prepare"),
            help: language::Key("app-prepare-help"),
            key: None,
            action: Action::Prepare,
            is_open,
            is_enabled: true,
        };
        entries.insert(0, prepare);
        entries
    }

    /// Leaves the trial, the comparison, and what stands beside the views. A scan stays.
    fn prepare(&mut self, ctx: &Context) {
        if self.panels.trial.trial.is_open() {
            self.act(Action::Trial(trial::Action::Close), ctx);
        }
        self.state.leave_modes();
        let beside = match self.beside {
            Beside::Nothing => return,
            Beside::Vessels => Action::Vessels(vessels::Action::Toggle),
            Beside::Measure => Action::Measure(measure::action::Action::Toggle),
        };
        self.act(beside, ctx);
    }

    /// The lines of the sheet of keys.
    pub(super) fn key_lines(&self) -> Vec<(crate::language::Key, crate::language::Key)> {
        let (mode, panels) = (self.mode(), self.panels.all());
        let of_mode = panels.iter().find(|panel| panel.mode() == Some(mode)).and_then(|panel| panel.key_sheet());
        let of_panels: Vec<_> = panels.iter().flat_map(|panel| panel.key_help()).copied().collect();
        sheets::keys(of_mode, &of_panels)
    }

    /// What takes off one thing, the one that lies on top. Sheets, lists and fields take themselves off; presenting ends, and
    /// the numbers that are still to come are given up, once nothing else is open.
    fn on_top(&self) -> Option<Action> {
        let now = self.now(self.mode());
        let of_panels = |layer| self.panels.all().into_iter().rev().find_map(|panel| panel.escape(now, layer));
        let recording = self.record.progress().map(|_| Action::Record(record::Action::Cancel));
        of_panels(Layer::Held)
            .or(recording)
            .or_else(|| of_panels(Layer::Awaited))
            .or_else(|| self.state.awaits().then_some(Action::Cancel))
            .or_else(|| of_panels(Layer::Underway))
            .or_else(|| of_panels(Layer::Open))
            .or_else(|| self.presenter.is_on().then_some(Action::Present))
            .or_else(|| self.state.is_busy().then_some(Action::Cancel))
    }

    /// Lets the panel whose action it is do it; gives back what is none of theirs.
    fn act_on_panels(&mut self, action: Action, ctx: &Context) -> Option<Action> {
        let mut left = Some(action);
        let then = self.change_panels(ctx, |panel, acting| {
            left = left.take().and_then(|action| panel.act(action, acting));
        });
        self.act_on_all(then, ctx);
        left
    }

    /// Another surface was opened: panels and reports forget the one before.
    pub(super) fn leave_surface(&mut self, ctx: &Context) {
        self.record.leave_surface();
        let then = self.change_panels(ctx, |panel, acting| panel.leave_surface(acting));
        self.act_on_all(then, ctx);
    }

    /// Lets each panel change with what it may change besides itself; says what is to be done next.
    fn change_panels(&mut self, ctx: &Context, mut change: impl FnMut(&mut dyn Panel, &mut Acting<'_>)) -> Vec<Action> {
        let mut acting = Acting {
            ctx,
            mode: self.panels.mode(&self.state),
            in_trial: self.panels.trial.trial.is_open(),
            state: &mut self.state,
            platform: &mut *self.platform,
            beside: &mut self.beside,
            then: Vec::new(),
        };
        for panel in self.panels.all_mut() {
            change(panel, &mut acting);
        }
        acting.then
    }

    pub(super) fn act_on_all(&mut self, actions: impl IntoIterator<Item = Action>, ctx: &egui::Context) {
        actions.into_iter().for_each(|action| self.act(action, ctx));
    }

    /// Does what is asked for: nothing else changes settings, comparison or trial by the user's will, but for what is steered
    /// by hand: cameras, C-arm and wire.
    pub(super) fn act(&mut self, action: Action, ctx: &egui::Context) {
        if self.platform.is_embedded() && !self.fits_embedded(&action) {
            return;
        }
        // What was shown of it before is not the last.
        ctx.request_repaint();
        let needs_level = matches!(action, Action::ToggleTrial | Action::Trial(trial::Action::Start) | Action::Compare);
        let cancels_playing =
            action == Action::Cancel && self.panels.playback.is_playing() && self.state.opening().is_none();
        if needs_level || cancels_playing {
            // Not that of an instant of what is played.
            self.panels.playback.close(&mut self.state);
            self.state.show_level();
        }
        if cancels_playing {
            return;
        }
        let Some(action) = self.act_on_panels(action, ctx) else { return };
        let keep = self.state.settings.keep;
        let state = &mut self.state;
        match action {
            Action::Prepare => self.prepare(ctx),
            Action::OpenNext => {
                state.against.expect(Next::Surface);
                state.notices.take_away();
                self.platform.open_next();
            }
            Action::TakeAway => state.notices.take_away(),
            Action::Open | Action::OpenIn(_) => {
                state.against.expect(Next::Surface);
                state.next_unit = if let Action::OpenIn(unit) = action { Some(unit) } else { None };
                self.platform.choose_file(ctx);
            }
            Action::Uninvite => self.invites = false,
            Action::ReadIn(unit) => state.set_unit(Some(unit), self.platform.link()),
            Action::Sample(sample) => {
                self.leave_scan();
                self.state.open_sample(sample, self.platform.link());
            }
            Action::Save(format) => state.save(format, self.platform.link()),
            Action::SaveLevels => state.save_levels(self.platform.link()),
            Action::Axes(axes) => self.recovery.choose_axes(state, axes),
            Action::SaveAxes(axes) => state.written_axes = axes,
            Action::Set(settings) => {
                // Who changes the level looks at the level.
                if *settings != state.settings {
                    state.preparation.shown = None;
                }
                state.settings = *settings;
            }
            Action::Undo => state.undo(self.platform.link()),
            Action::Redo => state.redo(self.platform.link()),
            Action::Cancel => {
                let effect = state.cancel(self.platform.link());
                self.take_effect(effect, ctx);
            }
            Action::Fit => {
                (self.views.spot, self.views.options.fault) = (None, None);
                self.views.fit(state.document.as_ref(), keep);
            }
            Action::View(view) => self.views.look_from(view, state.document.as_ref(), keep),
            Action::GoTo { at_mm, height_mm, label } => {
                self.views.go_to(Spot::new(at_mm, label), height_mm);
            }
            Action::LookAt { at_mm, height_mm } => {
                self.views.spot = None;
                self.views.fly(at_mm.into(), height_mm);
            }
            Action::Mark { at_mm, label } => self.views.spot = Some(Spot::new(at_mm, label)),
            Action::MarkStretch { along_mm, beside } => {
                if let Some(spot) = &mut self.views.spot {
                    spot.along = along_mm.into_iter().map(Vec3::from).collect();
                    spot.beside = beside.into_iter().map(|(at_mm, label)| (at_mm.into(), label)).collect();
                }
            }
            Action::Unmark => self.views.spot = None,
            Action::Show(options) => self.views.options = options,
            Action::ChoosePieces => {
                self.views.options.left_out = true;
                self.views.fit(state.document.as_ref(), Keep::All);
            }
            Action::Reveal => self.views.toggle_reveal(state.document.as_ref()),
            Action::Average(is_shown) => {
                state.shows_averaged = is_shown;
                let is_split = state.document.as_ref().is_some_and(|document| self.views.reveals(document));
                if is_shown && !is_split {
                    self.views.reveal();
                }
            }
            Action::HoldBefore(is_held) => self.views.before_is_held = is_held,
            Action::Unfold(part) => part.unfold(ctx),
            Action::Lesson(action) => self.act_on_lesson(action, ctx),
            Action::SaveSettings => Sharing::save(state, &mut *self.platform, ctx),
            Action::CopyLink => Sharing::copy_link(state, &self.views.camera, &*self.platform, ctx),
            Action::Record(action) => {
                if action == record::Action::Describe {
                    self.sheet = Some(Sheet::Report);
                }
                let sight = Sight {
                    views: &self.views,
                    style: theme::style(&ctx.global_style().visuals),
                    measures: self.panels.measure.shown(state),
                    today: self.platform.today(),
                };
                self.record.act(action, state, &sight);
            }
            Action::KeepSurface(keeps) => self.recovery.keep_surfaces(keeps, state, &mut *self.platform),
            Action::Forget => {
                self.recovery.forget(state, &mut self.panels.trial.trial, &mut *self.platform);
                self.speech.choose(None, &mut *self.platform);
                self.panels.lesson.speak();
            }
            Action::Present => {
                self.presenter.toggle(ctx);
                let told = say!("app-presenting");
                if self.presenter.is_on() {
                    state.tell(&told);
                } else {
                    state.notices.withdraw(&told);
                }
            }
            Action::Speak(language) => {
                self.speech.choose(language, &mut *self.platform);
                self.panels.lesson.speak();
            }
            Action::Theme => {
                let other = if ctx.theme() == egui::Theme::Dark { egui::Theme::Light } else { egui::Theme::Dark };
                ctx.set_theme(other);
            }
            Action::Help => self.sheet = toggled(self.sheet, Sheet::Help),
            Action::About => self.sheet = toggled(self.sheet, Sheet::About),
            of_panel => debug_assert!(false, "no panel takes {of_panel:?}"),
        }
    }

    pub(super) fn act_on_lesson(&mut self, action: lesson::Action, ctx: &egui::Context) {
        match action {
            lesson::Action::Open(name) => match self.panels.lesson.open(name) {
                Ok(()) => self.act_on_lesson(lesson::Action::Go(0), ctx),
                Err(sentence) => self.state.warn(&sentence),
            },
            lesson::Action::Choose => {
                self.state.against.expect(Next::Surface);
                self.platform.choose_file(ctx);
            }
            lesson::Action::Go(step) => {
                self.leave_scan();
                self.panels.playback.close(&mut self.state);
                // What was set by hand is a step of its own to undo.
                self.state.record();
                let now = lesson::Before {
                    state: &self.state,
                    options: self.views.options,
                    in_trial: self.panels.trial.trial.is_open(),
                    has_autopilot: self.panels.trial.trial.run().is_some_and(|run| run.autopilot),
                    are_vessels_open: self.beside == Beside::Vessels,
                    are_collapses_open: self.panels.collapses.is_open(),
                };
                let asked = self.panels.lesson.go(step, now);
                self.act_on_all(asked, ctx);
            }
            lesson::Action::Answer => self.panels.lesson.answer(),
            lesson::Action::CopyLink => {
                let given = self.panels.lesson.given().and_then(|given| Some((given.name?, given.step)));
                if let (Some((name, step)), Some(address)) = (given, self.platform.address()) {
                    ctx.copy_text(format!("{address}#{}", lesson::fragment(name, step)));
                    self.state.tell(&say!("app-step-link-copied"));
                }
            }
            lesson::Action::Close => {
                Part::forget(ctx);
                if let Some(stood) = self.panels.lesson.close() {
                    self.give_back(stood);
                }
            }
            lesson::Action::Glossary => self.sheet = toggled(self.sheet, Sheet::Glossary),
        }
    }

    /// Gives back what a lesson has changed, as a step to undo.
    fn give_back(&mut self, stood: lesson::Stood) {
        let lesson::Stood { surface, measures, settings, options } = stood;
        let is_same = self.state.document.as_ref().map(|document| document.revision.document)
            == surface.as_ref().map(|(number, _)| *number);
        // A sample of the lesson gives way; a surface that was opened since stays.
        if let Some((_, source)) = surface.filter(|_| !is_same && self.state.shows_sample()) {
            self.views.options = options;
            let name = source.label().into_owned();
            self.state.record();
            self.state.settings = Settings { keep: self.state.settings.keep, ..settings };
            self.state.open_again(source, measures, self.platform.link());
            return self.state.tell(&say!("lesson-given-back-surface", name = name));
        }
        // A wire is in the level that the lesson has set.
        if self.panels.trial.trial.is_open() {
            return;
        }
        // Pieces of one surface are none of another.
        let keep = if is_same { settings.keep } else { self.state.settings.keep };
        let settings = Settings { keep, ..settings };
        self.views.options = options;
        if !is_same {
            self.views.options.leave_surface();
        }
        if settings != self.state.settings {
            self.state.record();
            self.state.settings = settings;
            self.state.tell(&say!("lesson-given-back"));
        }
    }

    /// Does what a step of a lesson has asked for, once the level is there and looked at.
    pub(super) fn follow_lesson(&mut self, ctx: &egui::Context) {
        let has_level = self.state.opening().is_none() && self.state.has_level() && !self.look_next;
        while let Some(action) = self.panels.lesson.next(has_level, &self.panels.trial.trial) {
            self.act(action, ctx);
        }
    }
}

fn toggled(open: Option<Sheet>, sheet: Sheet) -> Option<Sheet> {
    (open != Some(sheet)).then_some(sheet)
}
