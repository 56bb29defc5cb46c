//! Engines that are started again: where an opening was cancelled, and where one has stopped by itself.

use super::{Effect, Engine, State};
use crate::engine::{Command, Link};
use crate::say;

/// How often the engine may stop in a row before the app leaves it alone.
const PATIENCE: u32 = 2;

impl State {
    /// Stops what the engine does and goes back to the last result; to the surface before where the one that is open has none.
    pub fn cancel(&mut self, link: &mut dyn Link) -> Option<Effect> {
        let is_opening = !self.opening.is_empty() || self.awaits_levels();
        let effect = self.go_back();
        if !is_opening {
            self.comparison.stop(&say!("app-cancelled"));
            self.against.stop(&say!("app-cancelled"));
            self.preparation.give_up();
            // Whoever has nothing open has nothing to answer.
            if self.engine == Engine::Loaded {
                link.send(Command::Cancel);
                self.is_cancelling = true;
            }
        } else {
            // Another engine takes up the surface that is shown: a Worker never gives back the memory that a file took.
            self.opening.clear();
            let lost = self.reopen(link);
            let text = match self.document {
                Some(_) => say!("app-opening-cancelled-kept"),
                None => say!("app-opening-cancelled"),
            };
            self.tell(&format!("{text}{lost}"));
        }
        self.work = None;
        effect
    }

    /// Sees to it that there is an engine.
    pub(super) fn wake(&mut self, link: &mut dyn Link) {
        if self.engine == Engine::Stopped {
            link.restart();
            self.engine = Engine::Empty;
        }
    }

    /// Starts another engine on the surface that is open; says which files are lost by that.
    fn reopen(&mut self, link: &mut dyn Link) -> String {
        link.restart();
        self.engine = Engine::Empty;
        self.is_cancelling = false;
        self.comparison.forget_request();
        self.against.forget_request();
        self.preparation.give_up();
        self.load(link);
        self.lost_files()
    }

    /// Gives the engine the surface that is open.
    pub(super) fn load(&mut self, link: &mut dyn Link) {
        self.averaging = None;
        if let Some(document) = &self.document {
            self.number += 1;
            self.generation = self.number;
            let (id, source, settings) = (self.number, document.source.clone(), self.settings.clone());
            link.send(Command::Open { id, source, settings: settings.clone() });
            self.sent = settings;
            self.engine = Engine::Loading;
            self.is_stopped = false;
        }
    }

    /// Hears that the engine has stopped by itself: a surface that has no level yet is given up.
    pub fn engine_failed(&mut self, reason: &str, link: &mut dyn Link) -> Option<Effect> {
        self.failures += 1;
        self.work = None;
        // On the surface that is shown another would end at the same place.
        let is_too_large = link.is_out_of_memory() && self.opening.is_empty() && !self.awaits_levels();
        self.is_cancelling = false;
        self.comparison.stop(&say!("app-computation-stopped"));
        self.against.stop(&say!("app-computation-stopped"));
        self.preparation.give_up();
        // It may have been that which it stopped at.
        self.hide_averaged();
        let opening = std::mem::take(&mut self.opening).pop().map(|opening| opening.source.label().into_owned());
        let given_up =
            self.document.as_ref().filter(|_| self.awaits_levels()).map(|given_up| given_up.title().into_owned());
        let opening = opening.or(given_up);
        let effect = self.go_back();
        if self.failures > PATIENCE || is_too_large {
            self.engine = Engine::Stopped;
            if self.settings != self.sent {
                // No numbers are those of these settings, and it is not for them that it is started again.
                self.number += 1;
                self.generation = self.number;
                self.sent = self.settings.clone();
            }
            let lost = self.lost_files();
            let what = if is_too_large {
                say!("app-engine-stopped", reason = reason)
            } else {
                say!("app-engine-keeps-stopping", reason = reason)
            };
            let mut text = format!("{what}{lost} {}", say!("app-engine-try-again"));
            if is_too_large {
                text = format!("{text} {}", say!("app-engine-memory"));
            }
            self.warn(&text);
            return effect;
        }
        let lost = self.reopen(link);
        let text = match opening {
            Some(name) => {
                let text = say!("app-engine-stopped-opening", name = name, reason = reason);
                format!("{text}{lost}")
            }
            None => {
                let text = say!("app-engine-restarted", reason = reason);
                if lost.is_empty() { format!("{text} {}", say!("app-nothing-lost")) } else { format!("{text}{lost}") }
            }
        };
        self.warn(&text);
        effect
    }
}
