//! What the app knows, and how it changes: by the user's hand and by what the engine says. It draws nothing.

use std::sync::Arc;

use super::document::{Document, Measured};
use super::history::History;
use crate::engine::{Command, Event, Link, Source, Work};
use crate::io::{Format, ImportOptions};
use crate::phantom::Sample;
use crate::pipeline::settings::{Keep, Settings};

/// A sentence for the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Notice {
    /// The sentence.
    pub text: String,
    /// Whether something went wrong.
    pub is_error: bool,
}

/// What the app knows.
pub struct State {
    /// The settings, as the controls have them.
    pub settings: Settings,
    /// What they were before.
    pub history: History<Settings>,
    /// The surface that is open.
    pub document: Option<Document>,
    /// Surfaces that are being read, with the settings they begin with, the newest last.
    opening: Vec<(u64, Source, Settings)>,
    /// What the engine is doing, and the part that is done, 0 to 1.
    pub work: Option<(Work, f32)>,
    /// The last thing that the user should know.
    pub notice: Option<Notice>,
    /// The settings that the engine has, and their number.
    sent: Settings,
    generation: u64,
    /// The number of the newest command.
    number: u64,
    /// Whether a cancel waits for its answer, which has the settings that are in force.
    is_cancelling: bool,
    /// Times in a row that the engine has stopped by itself.
    failures: u32,
}

/// How often the engine may stop in a row before the app leaves it alone.
const PATIENCE: u32 = 2;

/// What has to happen outside the state.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// A new surface is shown: the camera should find it.
    Opened,
    /// A file is ready to be given to the user.
    Offer {
        /// Its name.
        name: String,
        /// Its bytes.
        bytes: Vec<u8>,
    },
}

impl Default for State {
    fn default() -> Self {
        let settings = Settings::default();
        Self {
            history: History::new(settings.clone()),
            sent: settings.clone(),
            settings,
            document: None,
            opening: Vec::new(),
            work: None,
            notice: None,
            generation: 0,
            number: 0,
            is_cancelling: false,
            failures: 0,
        }
    }
}

impl State {
    /// Opens the file `name`. What is open stays until the new surface is there.
    pub fn open_file(&mut self, name: String, bytes: Vec<u8>, link: &mut dyn Link) {
        let options = ImportOptions::default();
        self.open(Source::File { name, bytes: Arc::from(bytes), options }, link);
    }

    /// Opens a sample.
    pub fn open_sample(&mut self, sample: Sample, link: &mut dyn Link) {
        self.open(Source::sample(sample), link);
    }

    /// Opens a surface, of all of which the largest piece is kept.
    pub fn open(&mut self, source: Source, link: &mut dyn Link) {
        if self.failures > PATIENCE {
            link.restart();
        }
        self.number += 1;
        let settings = Settings { keep: Keep::Largest, ..self.settings.clone() };
        link.send(Command::Open { id: self.number, source: source.clone(), settings: settings.clone() });
        self.opening.push((self.number, source, settings));
        self.work = Some((Work::Reading, 0.0));
        self.notice = None;
    }

    /// Whether the engine is at work.
    pub fn is_busy(&self) -> bool {
        self.work.is_some()
    }

    /// The number of the settings that the engine has.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// Stops what the engine does and goes back to the last result.
    pub fn cancel(&mut self, link: &mut dyn Link) {
        if !self.opening.is_empty() {
            self.opening.clear();
            // Reading is one piece: only another engine can be told now. It takes up the surface that is shown.
            self.reopen(link);
            self.tell("Opening was cancelled; what was open still is.");
        } else {
            link.send(Command::Cancel);
            self.is_cancelling = true;
        }
        self.work = None;
    }

    /// Starts another engine on the surface that is open.
    fn reopen(&mut self, link: &mut dyn Link) {
        link.restart();
        self.is_cancelling = false;
        if let Some(document) = &self.document {
            self.number += 1;
            self.generation = self.number;
            let (id, source, settings) = (self.number, document.source.clone(), self.settings.clone());
            link.send(Command::Open { id, source, settings: settings.clone() });
            self.sent = settings;
        }
    }

    /// Asks for the shown level as a file.
    pub fn save(&mut self, format: Format, link: &mut dyn Link) {
        let Some((document, mesh)) = self.document.as_ref().and_then(|d| Some((d, d.shown_mesh()?))) else {
            self.tell("There is nothing to save yet.");
            return;
        };
        let stem = match document.name.rsplit_once('.') {
            Some((stem, _)) if Format::from_name(&document.name).is_some() => stem.to_owned(),
            _ => document.name.to_lowercase().replace(' ', "-"),
        };
        let name = format!("{stem}-{}.{}", mesh.triangles.len(), format.extension());
        link.send(Command::Write { name, format, mesh });
    }

    /// Goes one step back in the settings.
    pub fn undo(&mut self) {
        // A value that was typed a moment ago may not be a step yet.
        self.history.record(&self.settings);
        if let Some(settings) = self.history.undo() {
            self.settings = settings.clone();
        }
    }

    /// Takes back the last step back.
    pub fn redo(&mut self) {
        self.history.record(&self.settings);
        if let Some(settings) = self.history.redo() {
            self.settings = settings.clone();
        }
    }

    /// To be called each frame, after the controls: shows the level that the settings ask for and lets the engine
    /// know about them. While a control is held, the steps of its way are not recorded for undo. While a surface is
    /// being read or a cancel waits for its answer the engine is told nothing: it is then told all at once, and on
    /// which surface the settings act is never in doubt.
    pub fn follow(&mut self, is_held: bool, link: &mut dyn Link) {
        if !is_held {
            self.history.record(&self.settings);
        }
        if self.settings == self.sent {
            return;
        }
        if let Some(document) = &mut self.document
            && self.settings.target != self.sent.target
        {
            document.show(self.settings.target);
        }
        if self.document.is_none() || !self.opening.is_empty() || self.is_cancelling {
            return;
        }
        self.number += 1;
        self.generation = self.number;
        link.send(Command::Set { generation: self.generation, settings: self.settings.clone() });
        self.sent = self.settings.clone();
    }

    /// Hears what the engine has to say. Events that belong to a surface which was given up are passed over.
    pub fn receive(&mut self, event: Event) -> Option<Effect> {
        match event {
            Event::Opened(opened) => return self.receive_opened(*opened),
            Event::OpenFailed { id, name, message } => {
                if let Some(at) = self.opening.iter().position(|(waiting, ..)| *waiting == id) {
                    self.opening.remove(at);
                    if self.opening.is_empty() {
                        self.work = None;
                    }
                    let kept = if self.document.is_some() { " What was open still is." } else { "" };
                    self.warn(&format!("{name}: {}{kept}", sentence(&message)));
                }
            }
            Event::Pieces { labels, components } => {
                if let Some(document) = &mut self.document {
                    document.set_pieces(labels, components);
                }
            }
            Event::Progress { work, fraction } => self.work = Some((work, fraction)),
            Event::Reduced(reduced) => {
                let target = self.settings.target;
                if let Some(document) = &mut self.document {
                    document.set_levels(*reduced, target);
                }
            }
            Event::Measured { generation, complete, report, deviation } => {
                if complete {
                    self.failures = 0;
                    // Numbers of older settings, or of the surface before, end no work on newer ones.
                    if self.opening.is_empty() && generation == self.generation {
                        self.work = None;
                    }
                }
                if let Some(document) = &mut self.document {
                    document.set_measured(Measured { generation, report: *report, deviation });
                }
            }
            Event::Cancelled { generation, settings } => {
                self.generation = generation;
                self.is_cancelling = false;
                self.work = None;
                if settings != self.settings {
                    self.tell("Cancelled; the last result stands.");
                }
                if let Some(document) = &mut self.document {
                    document.show(settings.target);
                }
                self.settings = settings.clone();
                self.history.replace(&settings);
                self.sent = settings;
            }
            Event::Written { name, bytes } => return Some(Effect::Offer { name, bytes }),
            Event::Failed { message } => {
                self.work = None;
                self.warn(&sentence(&message));
            }
        }
        None
    }

    fn receive_opened(&mut self, opened: crate::engine::Opened) -> Option<Effect> {
        match self.opening.iter().position(|(id, ..)| *id == opened.id) {
            Some(at) => {
                // The engine gives up what it was asked for before.
                let (id, source, settings) = self.opening.drain(..=at).next_back()?;
                // Pieces are numbered in one surface only.
                self.settings.keep = Keep::Largest;
                self.history.change_all(|settings| settings.keep = Keep::Largest);
                self.generation = id;
                // What was moved while the surface was read follows.
                self.sent = settings;
                self.is_cancelling = false;
                self.notice = opened.report.warnings.first().map(|text| Notice { text: text.clone(), is_error: false });
                self.document = Some(Document::new(source, opened));
                Some(Effect::Opened)
            }
            // The surface that is shown was read again by a new engine.
            None => None,
        }
    }

    /// Hears that the engine has stopped by itself.
    pub fn engine_failed(&mut self, reason: &str, link: &mut dyn Link) {
        self.failures += 1;
        self.work = None;
        self.is_cancelling = false;
        let opening = std::mem::take(&mut self.opening).pop();
        if self.failures > PATIENCE {
            self.warn(&format!("The computation keeps stopping ({reason}). Nothing that is shown was lost."));
            return;
        }
        self.reopen(link);
        let text = match opening {
            Some((_, source, _)) => format!("{} could not be read: the computation stopped ({reason}).", source.name()),
            None => format!("The computation stopped ({reason}) and was started again. Nothing was lost."),
        };
        self.warn(&text);
    }

    /// Tells the user something.
    pub fn tell(&mut self, text: &str) {
        self.notice = Some(Notice { text: text.to_owned(), is_error: false });
    }

    /// Tells the user that something went wrong.
    pub fn warn(&mut self, text: &str) {
        self.notice = Some(Notice { text: text.to_owned(), is_error: true });
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
mod tests;
