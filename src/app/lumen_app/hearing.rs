//! What the app hears of platform and engines, and what it sends on.

use super::{LISTEN, LumenApp};
use crate::app::action::Action;
use crate::app::notices::Kind;
use crate::app::platform::PlatformEvent;
use crate::app::plot_file::PlotFile;
use crate::app::scan::{self, Told};
use crate::app::sharing::{self, Sharing};
use crate::app::state::{Effect, State};
use crate::app::{keys, large, lesson, recovery, verdict};
use crate::engine::{PAUSE_MS, Source};
use crate::io::ThresholdReport;
use crate::language::{decimal, tell};
use crate::pipeline::verdict::Verdict;
use crate::say;

impl LumenApp {
    /// Hears what platform and engines have to say, deaths among it.
    pub(super) fn listen(&mut self, ctx: &egui::Context) {
        while let Some(event) = self.platform.poll() {
            // Whatever the file is, it was the next.
            let has_come = matches!(event, PlatformEvent::Chosen { .. } | PlatformEvent::Scan { .. });
            let is_reference = has_come && self.state.takes_reference();
            match event {
                PlatformEvent::Chosen { name, bytes } if is_log(&name) => {
                    self.panels.trial.trial.replay(bytes, self.state.document.as_ref(), self.platform.trial());
                }
                PlatformEvent::Chosen { name, bytes } if sharing::is_settings(&name) => {
                    Sharing::take_file(&name, &bytes, &mut self.state, self.platform.link());
                }
                PlatformEvent::Chosen { name, bytes } if lesson::is_lesson(&name) => {
                    match self.panels.lesson.take(&bytes, None) {
                        Ok(()) => self.act(Action::Lesson(lesson::Action::Go(0)), ctx),
                        Err(error) => self.state.warn(&say!("app-open-failed", name = name, why = error.to_string())),
                    }
                }
                PlatformEvent::Chosen { name, bytes } if is_reference => {
                    let warning = self.too_large(&name, &bytes);
                    self.state.compare_with(name, bytes);
                    if let Some(warning) = warning {
                        self.state.tell(&warning);
                    }
                }
                PlatformEvent::Chosen { name, bytes } => {
                    self.leave_scan();
                    // What was asked for last counts.
                    self.sharing.before_file(&mut self.state);
                    self.recovery.before_file(&name, &mut self.state);
                    let warning = self.too_large(&name, &bytes);
                    self.state.open_file(name, bytes, self.platform.link());
                    if let Some(warning) = warning {
                        self.state.tell(&warning);
                    }
                }
                PlatformEvent::More { names } => {
                    if let Some((next, rest)) = names.split_first() {
                        let text = say!("app-others", next = next, rest = rest.len());
                        self.state.notices.tell(Kind::OffersNext, &text);
                    }
                }
                PlatformEvent::Linked { fragment } => {
                    // Who follows a link has something to look at.
                    self.invites = false;
                    self.follow_link(&fragment, ctx);
                }
                PlatformEvent::Restored(file) => {
                    self.recovery.restored(file, &mut self.state, &mut *self.platform);
                }
                PlatformEvent::Texts { language, texts } => {
                    match self.speech.take_texts(language, texts, &mut *self.platform) {
                        Ok(()) => self.panels.lesson.speak(),
                        Err(sentence) => self.state.warn(&sentence),
                    }
                    ctx.request_repaint();
                }
                PlatformEvent::Scan { files } => {
                    self.state.notices.clear();
                    if let Some(link) = self.platform.scans() {
                        self.panels.scan.scans.read(files, link);
                    }
                }
                PlatformEvent::Saved { message } => self.tell_saved(&message),
                PlatformEvent::Failed { message } => self.state.warn(&message),
            }
        }
        while let Some(event) = self.platform.link().poll() {
            let effect = self.state.receive(event);
            self.take_effect(effect, ctx);
        }
        if let Some(reason) = self.platform.link().failure() {
            let effect = self.state.engine_failed(&reason, self.platform.link());
            self.take_effect(effect, ctx);
        }
        while let Some(event) = self.platform.trial().poll() {
            if let Some(log) = self.panels.trial.trial.receive(event, self.platform.trial()) {
                self.platform.offer_pair(log, ctx);
            }
        }
        if let Some(reason) = self.platform.trial().failure() {
            let sentence = self.panels.trial.trial.engine_failed(&reason, self.platform.trial());
            self.state.warn(&sentence);
        }
        self.listen_to_scans();
    }

    /// A sentence where a file may need more memory than an engine can have.
    fn too_large(&self, name: &str, bytes: &[u8]) -> Option<String> {
        self.platform.memory_limit().and_then(|limit| large::warning(name, bytes, limit))
    }

    /// Lets what is outside the state follow it.
    pub(super) fn take_effect(&mut self, effect: Option<Effect>, ctx: &egui::Context) {
        match effect {
            Some(Effect::Opened) => {
                self.look_next = true;
                self.invites &= self.state.shows_sample();
                self.leave_surface(ctx);
                self.views.options.leave_surface();
            }
            Some(Effect::Reduced) => {
                // Until now a cancel would have gone back to it.
                self.panels.trial.trial.leave_surface(self.platform.trial());
                // Once more, at what is kept of it; unless the camera was moved meanwhile.
                self.look_next |= self.views.is_fitted();
                self.recovery.opened(&mut self.state, self.look_next, &mut *self.platform);
                self.sharing.opened(&mut self.state, self.platform.link());
            }
            Some(Effect::Offer { name, bytes }) => self.platform.offer_file(&name, bytes, ctx),
            None => {}
        }
    }

    /// Follows a link: to settings, to a lesson, or to both.
    pub(super) fn follow_link(&mut self, fragment: &str, ctx: &egui::Context) {
        let Some((name, step, rest)) = lesson::in_link(fragment) else {
            return self.sharing.follow(fragment, &mut self.state, self.platform.link());
        };
        if !rest.is_empty() {
            self.sharing.follow(&rest, &mut self.state, self.platform.link());
        }
        // A lesson opens what a part of another page has no way back from.
        if self.platform.is_embedded() {
            return;
        }
        match self.panels.lesson.open(&name) {
            Ok(()) => self.act(Action::Lesson(lesson::Action::Go(step)), ctx),
            Err(sentence) => self.state.warn(&sentence),
        }
    }

    /// Says that a file was saved, and what of the result is to be looked at.
    pub(super) fn tell_saved(&mut self, message: &str) {
        let verdict = self.state.document.as_ref().map(|document| verdict::verdict(&self.state, document));
        match verdict.filter(Verdict::has_reservations) {
            Some(verdict) => self.state.saved(&format!("{message} {}", verdict.in_short(tell))),
            None => self.state.saved(message),
        }
    }

    /// Hears what the engine of scans has to say.
    pub(super) fn listen_to_scans(&mut self) {
        while let Some(link) = self.platform.scans()
            && let Some(event) = link.poll()
        {
            match self.panels.scan.scans.receive(event, link) {
                Some(Told::Made(source)) => {
                    let threshold = if let Source::Made { threshold, .. } = &source { *threshold } else { None };
                    self.state.open(source, self.platform.link());
                    if let Some(ThresholdReport { lower_mm, higher_mm, .. }) = threshold {
                        let [lower, higher] = [lower_mm, higher_mm].map(|mm| decimal(mm, 2));
                        self.state.tell(&say!("scan-shifts", lower = lower, higher = higher));
                    }
                }
                Some(Told::Refused(sentence)) => self.state.warn(&sentence),
                Some(Told::Stopped) => self.state.tell(&say!("app-scan-cancelled")),
                None => {}
            }
        }
        if let Some(link) = self.platform.scans()
            && let Some(reason) = link.failure()
        {
            link.give_up();
            let sentence = self.panels.scan.scans.engine_failed(&reason);
            self.state.warn(&sentence);
        }
    }

    /// Sends on what was done and heard.
    pub(super) fn follow(&mut self, ctx: &egui::Context) {
        // What is played is one step to undo.
        let is_held =
            keys::moves_control(ctx) || self.panels.collapses.is_playing() || self.panels.playback.is_playing();
        self.state.follow(is_held, self.platform.link());
        if let Some(file) = PlotFile::take(ctx) {
            self.record.save_plot(&file, &mut self.state, &mut *self.platform, ctx);
        }
        if let Some((name, frames)) = self.record.follow(&mut self.state, self.platform.link()) {
            self.platform.offer_video(&name, frames, PAUSE_MS);
        }
        let now = recovery::Now {
            state: &self.state,
            trial: &self.panels.trial.trial,
            camera: &self.views.camera,
            language: self.speech.chosen(),
        };
        self.recovery.follow(now, &mut *self.platform, ctx);
        let State { document, settings, .. } = &self.state;
        let has_level = self.state.has_level();
        let trial = &mut self.panels.trial.trial;
        if !self.state.awaits_levels() {
            trial.follow_level(&settings.smoothing, has_level, document.as_ref(), self.platform.trial());
            trial.next_row(self.platform.trial());
        }
        if let Some(link) = self.platform.scans() {
            self.panels.scan.scans.follow(link);
        }
        let goes_on = self.panels.all().into_iter().any(|panel| panel.goes_on(&*self.platform));
        if goes_on || self.state.is_busy() || self.record.progress().is_some() {
            ctx.request_repaint_after(LISTEN);
        }
    }

    /// Closes the scan that is shown: a surface takes its place.
    pub(super) fn leave_scan(&mut self) {
        let scans = &mut self.panels.scan.scans;
        if let Some(link) = self.platform.scans().filter(|_| scans.is_open()) {
            scans.act(scan::Action::Close, link);
        }
    }
}

/// Whether a file is the log of a trial.
fn is_log(name: &str) -> bool {
    name.rsplit_once('.').is_some_and(|(_, ending)| ending.eq_ignore_ascii_case("csv"))
}
