//! What the engine says, and what it changes.

use super::{Effect, Engine, State};
use crate::engine::{Event, Work};
use crate::language::decimal;
use crate::pipeline::report::Report;
use crate::pipeline::safe::{Claim, Safe};
use crate::pipeline::settings::Settings;
use crate::say;

impl State {
    /// Hears what the engine has to say. Events that belong to a surface which was given up are passed over.
    pub fn receive(&mut self, event: Event) -> Option<Effect> {
        match event {
            Event::Opened(opened) => return self.receive_opened(*opened),
            Event::OpenFailed { id, name, message } => {
                let at = self.opening.iter().position(|opening| opening.id == id);
                let is_shown = matches!(self.engine, Engine::Loaded | Engine::Loading) && id == self.generation;
                if at.is_some() || is_shown {
                    if let Some(at) = at {
                        self.opening.remove(at);
                    }
                    if self.opening.is_empty() {
                        self.work = None;
                    }
                    if is_shown {
                        self.engine = Engine::Empty;
                        self.is_cancelling = false;
                        self.comparison.stop(&say!("app-not-opened-again"));
                        self.preparation.give_up();
                    }
                    let why = sentence(&message);
                    let text = match self.document {
                        Some(_) => say!("app-open-failed-kept", name = name, why = why),
                        None => say!("app-open-failed", name = name, why = why),
                    };
                    self.warn(&text);
                }
            }
            Event::Mended { mesh } => {
                if let Some(document) = &mut self.document {
                    document.set_mended(mesh);
                }
            }
            Event::Faults(found) => {
                if let Some(document) = &mut self.document {
                    document.faults = Some(found);
                }
            }
            Event::Pieces { labels, components } => {
                if let Some(document) = &mut self.document {
                    document.set_pieces(labels, components);
                }
            }
            // The comparison may have been given up meanwhile.
            Event::Progress { work: Work::Comparing, .. } if !self.comparison.is_busy() => {}
            Event::Progress { work: Work::Preparing, .. } if !self.preparation.is_worked_on() => {}
            Event::Progress { work, fraction } => self.work = Some((work, fraction)),
            Event::Compared(compared) => {
                self.comparison.receive(*compared);
                self.rest();
            }
            Event::Differed(differed) => {
                self.comparison.receive_difference(*differed);
                self.rest();
            }
            Event::Prepared(ready) => {
                self.preparation.receive(*ready);
                self.comparison.set_open(self.comparison.is_open() && self.preparation.shown.is_none());
                self.rest();
            }
            Event::CutsPlanned(planned) => {
                self.preparation.receive_cuts(*planned);
                self.rest();
            }
            Event::Beside(compared) => {
                self.against.receive(*compared);
                self.rest();
            }
            Event::Averaged(averaged) => {
                let is_awaited = self.averaging.is_some_and(|(id, _)| id == averaged.id);
                if let Some(document) = self.document.as_mut().filter(|_| is_awaited) {
                    document.set_averaged(Some(averaged));
                }
            }
            Event::NotCompared { id, index, message } => {
                self.comparison.receive_failure(id, index, &sentence(&message));
                self.rest();
            }
            Event::Reduced(reduced) => {
                let target = self.settings.target;
                if let Some(document) = &mut self.document {
                    document.set_levels(*reduced, target);
                }
                return self.before.take().map(|_| Effect::Reduced);
            }
            Event::Measured { generation, complete, report, safe, deviation } => {
                if complete {
                    self.failures = 0;
                    // Numbers of older settings, or of the surface before, end no work on newer ones.
                    if self.opening.is_empty() && generation == self.generation {
                        self.work = None;
                        self.rest();
                    }
                }
                let went_back = self.has_gone_back(&report).map(|percent| gone_back(percent, safe.as_deref()));
                if let Some(document) = &mut self.document {
                    document.set_measured(generation, *report, safe, deviation);
                    // Of an older bound too: the view follows the slider as fast as levels are found.
                    if self.settings.target.is_searched() {
                        document.show_found();
                    }
                }
                if let Some(told) = went_back {
                    self.mention(&told);
                }
            }
            Event::Deviated(deviated) => {
                if let Some(document) = self.document.as_mut().filter(|_| self.engine == Engine::Loaded) {
                    document.set_deviated(deviated);
                }
            }
            Event::LevelArrays(carried) => {
                if let Some(document) = self.document.as_mut().filter(|_| self.engine == Engine::Loaded) {
                    document.set_carried(carried);
                }
            }
            Event::Certified(calibre) => {
                if let Some(document) = self.document.as_mut().filter(|_| self.engine == Engine::Loaded) {
                    document.set_calibre(*calibre);
                }
            }
            Event::Cancelled { generation, settings } => self.receive_cancelled(generation, settings),
            Event::Written { name, bytes, left_out } => {
                self.forget_file(&name);
                if let Some(sentence) = &left_out {
                    self.tell(sentence);
                }
                self.left_out = left_out;
                return Some(Effect::Offer { name, bytes });
            }
            Event::NotWritten { name, message } => {
                self.forget_file(&name);
                self.warn(&say!("app-not-saved", name = name, why = sentence(&message)));
            }
            Event::Failed { message } => {
                self.work = None;
                self.comparison.forget_request();
                self.against.forget_request();
                self.preparation.give_up();
                self.warn(&sentence(&message));
            }
        }
        None
    }

    /// The rate in percent that auto has come to by `report`, where a level of a higher one was shown until now.
    fn has_gone_back(&self, report: &Report) -> Option<f64> {
        let (before, now) = (self.auto()?, report.auto.filter(|now| now.is_decided)?);
        (now.percent < before.percent).then_some(now.percent)
    }

    fn receive_cancelled(&mut self, generation: u64, settings: Settings) {
        self.generation = generation;
        self.is_cancelling = false;
        self.is_stopped = true;
        self.work = None;
        if settings != self.settings {
            self.tell(&say!("app-cancelled-result-stands"));
        }
        if let Some(document) = &mut self.document {
            document.show(settings.target);
        }
        self.settings = settings.clone();
        self.sent = settings;
        self.history.replace(&self.step());
    }
}

/// That auto has gone back to a rate in percent, and why no further: as much as is known, and no more.
fn gone_back(percent: f64, safe: Option<&Safe>) -> String {
    let percent = decimal(percent, 1);
    match safe.map(Safe::claim) {
        Some(Claim::Safe) => say!("app-gone-back", percent = percent),
        Some(Claim::NotPinched) => say!("app-gone-back-pinched", percent = percent),
        Some(Claim::KeptWhereMeasured) | None => say!("app-gone-back-kept", percent = percent),
    }
}

/// `text` with a capital and a full stop.
fn sentence(text: &str) -> String {
    let text = text.trim();
    let mut letters = text.chars();
    let first: String = letters.next().map(|c| c.to_uppercase().collect()).unwrap_or_default();
    let end = if text.ends_with(['.', '!', '?']) { "" } else { "." };
    format!("{first}{}{end}", letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::safe::NoSafeRate;
    use crate::vessel::certificate::Coverage;

    #[test]
    fn a_rate_that_auto_goes_back_to_is_called_safe_where_enough_is_measured_alone() {
        let safe = |measured_mm: f64| Safe {
            percent: Some(55.5),
            coverage: Some(Coverage {
                length_mm: 100.0,
                measured_mm,
                vessels: 2,
                vessels_measured: 2,
                ..Coverage::default()
            }),
            refused: None,
            ..Safe::refused(2.0, NoSafeRate::NoneMeasured)
        };
        let told = [Some(safe(80.0)), Some(safe(40.0)), Some(Safe::refused(2.0, NoSafeRate::NoneMeasured)), None];
        assert_eq!(
            told.map(|safe| gone_back(55.5, safe.as_ref())),
            [
                "Reduced by 55.5 %: more would not be safe.",
                "Reduced by 55.5 %: more would not keep the calibre where it is measured.",
                "Reduced by 55.5 %: more would pinch a vessel.",
                "Reduced by 55.5 %: more would not keep the calibre where it is measured.",
            ]
        );
    }
}
