//! What the app knows, and how it changes: by the user's hand and by what the engine says. It draws nothing.

use std::sync::Arc;

use super::compare::Comparison;
use super::document::Document;
use super::history::History;
use crate::engine::{Calibre, Command, Event, Link, Source, Work};
use crate::io::{Format, ImportOptions, Unit};
use crate::phantom::Sample;
use crate::pipeline::paper;
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::{Keep, Settings};
use crate::vessel::CentrelineFormat;

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
    /// Settings that are compared.
    pub comparison: Comparison,
    /// Surfaces that are on their way in, the newest last; the one that is open stays until one of them has something
    /// to show.
    opening: Vec<Opening>,
    /// What the engine is doing, and the part that is done, 0 to 1.
    pub work: Option<(Work, f32)>,
    /// The last thing that the user should know.
    pub notice: Option<Notice>,
    /// The unit that was chosen for the next file, if one was.
    pub next_unit: Option<Unit>,
    /// The settings that the engine has, and their number.
    sent: Settings,
    generation: u64,
    /// The number of the newest command.
    number: u64,
    /// Whether a cancel waits for its answer, which has the settings that are in force.
    is_cancelling: bool,
    /// What there is to ask.
    engine: Engine,
    /// Times in a row that the engine has stopped by itself.
    failures: u32,
    /// The names of the files that the engine makes.
    writing: Vec<String>,
}

/// What there is to ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Engine {
    /// An engine that has the surface which is shown, or one that is on its way in.
    Loaded,
    /// One that reads the surface which is shown once more: it has nothing to go back to, and answers no cancel.
    Loading,
    /// An engine that has nothing open.
    Empty,
    /// None: it has stopped too often in a row. The next thing that is asked for starts another.
    Stopped,
}

/// A surface on its way in.
struct Opening {
    id: u64,
    source: Source,
    /// The settings it begins with.
    settings: Settings,
    /// What is known of it, once it is read.
    document: Option<Document>,
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
            comparison: Comparison::default(),
            opening: Vec::new(),
            work: None,
            notice: None,
            next_unit: None,
            generation: 0,
            number: 0,
            is_cancelling: false,
            engine: Engine::Empty,
            failures: 0,
            writing: Vec::new(),
        }
    }
}

impl State {
    /// Opens the file `name`. What is open stays until the new surface is there.
    pub fn open_file(&mut self, name: String, bytes: Vec<u8>, link: &mut dyn Link) {
        let options = ImportOptions { unit: self.next_unit.take() };
        self.open(Source::File { name, bytes: Arc::new(bytes), options }, link);
    }

    /// Opens a sample.
    pub fn open_sample(&mut self, sample: Sample, link: &mut dyn Link) {
        self.open(Source::sample(sample), link);
    }

    /// Opens a surface, of all of which the largest piece is kept.
    pub fn open(&mut self, source: Source, link: &mut dyn Link) {
        self.wake(link);
        self.number += 1;
        let id = self.number;
        let settings = Settings { keep: Keep::Largest, ..self.settings.clone() };
        link.send(Command::Open { id, source: source.clone(), settings: settings.clone() });
        self.opening.push(Opening { id, source, settings, document: None });
        self.work = Some((Work::Reading, 0.0));
        self.notice = None;
    }

    /// The name of the surface that is on its way in.
    pub fn opening(&self) -> Option<&str> {
        self.opening.last().map(|opening| opening.source.name())
    }

    /// Whether the engine is at work.
    pub fn is_busy(&self) -> bool {
        self.work.is_some()
    }

    /// Whether the level that is shown is that of the settings.
    pub fn has_level(&self) -> bool {
        let measured = self.document.as_ref().and_then(|document| document.measured.as_ref());
        self.settings == self.sent && measured.is_some_and(|measured| measured.generation == self.generation)
    }

    /// What the level that the settings ask for makes of the vessels, if that is known.
    pub fn calibre(&self) -> Option<&Calibre> {
        let calibre = self.document.as_ref()?.calibre.as_ref()?;
        (self.settings == self.sent && calibre.generation == self.generation).then_some(calibre)
    }

    /// The number of the settings that the engine has.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// Stops what the engine does and goes back to the last result.
    pub fn cancel(&mut self, link: &mut dyn Link) {
        if self.opening.is_empty() {
            self.comparison.stop("Cancelled.");
            // Whoever has nothing open has nothing to answer.
            if self.engine == Engine::Loaded {
                link.send(Command::Cancel);
                self.is_cancelling = true;
            }
        } else {
            // Reading is one piece, which no command can stop: another engine takes up the surface that is shown.
            self.opening.clear();
            let lost = self.reopen(link);
            let kept = if self.document.is_some() { "; what was open still is" } else { "" };
            self.tell(&format!("Opening was cancelled{kept}.{lost}"));
        }
        self.work = None;
    }

    /// Sees to it that there is an engine.
    fn wake(&mut self, link: &mut dyn Link) {
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
        self.load(link);
        self.lost_files()
    }

    /// Gives the engine the surface that is open.
    fn load(&mut self, link: &mut dyn Link) {
        if let Some(document) = &self.document {
            self.number += 1;
            self.generation = self.number;
            let (id, source, settings) = (self.number, document.source.clone(), self.settings.clone());
            link.send(Command::Open { id, source, settings: settings.clone() });
            self.sent = settings;
            self.engine = Engine::Loading;
        }
    }

    /// Forgets the files that an engine which is no more was to make; a sentence on each, after a space.
    fn lost_files(&mut self) -> String {
        self.writing.drain(..).map(|name| format!(" {name} was not saved: save it again.")).collect()
    }

    /// Asks for the shown level as a file.
    pub fn save(&mut self, format: Format, link: &mut dyn Link) {
        let Some((document, mesh)) = self.document.as_ref().and_then(|d| Some((d, d.shown_mesh()?))) else {
            self.tell("There is nothing to save yet.");
            return;
        };
        let name = format!("{}-{}.{}", document.stem(), mesh.triangles.len(), format.extension());
        let axes = document.import.axes;
        // An engine that has stopped too often with the surface open can still make a file.
        self.wake(link);
        self.notice = None;
        self.writing.push(name.clone());
        link.send(Command::Write { name, format, mesh, axes });
    }

    /// Asks for the centrelines of the surface that is open as a file.
    pub fn save_centrelines(&mut self, format: CentrelineFormat, link: &mut dyn Link) {
        let Some(document) = &self.document else { return };
        let name = format!("{}-centrelines.{}", document.stem(), format.extension());
        self.wake(link);
        self.notice = None;
        self.writing.push(name.clone());
        link.send(Command::WriteCentrelines { name, format });
    }

    /// How far a reduction is safe by the present settings, if that is known. It is the same for every level.
    pub fn safe(&self) -> Option<&Safe> {
        let report = &self.document.as_ref()?.measured.as_ref()?.report;
        let is_same_tolerance = report.settings.tolerance_percent == self.settings.tolerance_percent;
        let is_same = Settings { target: self.settings.target, ..report.settings.clone() }.gives_same(&self.settings);
        report.safe.as_ref().filter(|_| is_same_tolerance && is_same)
    }

    /// The calibre of each vessel as a file, a row a place: its name and its bytes.
    pub fn calibre_table(&self) -> Option<(String, Vec<u8>)> {
        let (document, calibre) = (self.document.as_ref()?, self.calibre()?);
        let found = calibre.found.as_ref().ok()?;
        Some((format!("{}-calibre.csv", document.stem()), found.csv().into_bytes()))
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

    /// Shows the level that the settings ask for.
    pub fn show_level(&mut self) {
        if let Some(document) = &mut self.document {
            document.show(self.settings.target);
        }
    }

    /// To be called each frame, after the controls: shows the level that the settings ask for and lets the engine
    /// know about them. While a control is held, the steps of its way are not recorded for undo. While a surface is on
    /// its way in or a cancel waits for its answer the engine is told nothing: it is then told all at once, and on
    /// which surface the settings act is never in doubt.
    pub fn follow(&mut self, is_held: bool, link: &mut dyn Link) {
        if !is_held {
            self.history.record(&self.settings);
        }
        self.show_level();
        if matches!(self.engine, Engine::Empty | Engine::Stopped) && self.opening.is_empty() {
            // It is left alone until the hand is done with something that it is needed for.
            let is_needed = self.settings != self.sent || self.comparison.is_waiting();
            if is_held || !is_needed {
                return;
            }
            self.wake(link);
            self.load(link);
        }
        let Some(document) = self.document.as_ref().filter(|_| self.opening.is_empty() && !self.is_cancelling) else {
            return;
        };
        let subject = (document.revision.document, self.settings.keep);
        if self.settings != self.sent {
            self.number += 1;
            self.generation = self.number;
            link.send(Command::Set { generation: self.generation, settings: self.settings.clone() });
            self.sent = self.settings.clone();
        }
        if let Some(settings) = self.comparison.request(subject, self.number + 1) {
            self.number += 1;
            link.send(Command::Compare { id: self.number, settings });
            self.rest();
        }
    }

    /// Says what the engine does once it is done with the settings in force: the comparison, or nothing.
    fn rest(&mut self) {
        self.work = match self.work {
            Some((Work::Comparing, _)) if !self.comparison.is_busy() => None,
            None if self.comparison.is_busy() => Some((Work::Comparing, 0.0)),
            work => work,
        };
    }

    /// Shows the compare view or leaves it. The first time it has the settings in force at the three rates of the
    /// paper's Figure 7, which need no more than three levels of what is there.
    pub fn toggle_comparison(&mut self) {
        let is_open = !self.comparison.is_open();
        self.comparison.set_open(is_open);
        if is_open && self.comparison.cells().is_empty() {
            self.comparison.set(paper::rates_of_figure_7(&self.settings));
        }
    }

    /// Hears what the engine has to say. Events that belong to a surface which was given up are passed over.
    pub fn receive(&mut self, event: Event) -> Option<Effect> {
        match event {
            Event::Opened(opened) => self.receive_opened(*opened),
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
                        self.comparison.stop("The surface could not be opened again.");
                    }
                    let kept = if self.document.is_some() { " What was open still is." } else { "" };
                    self.warn(&format!("{name}: {}{kept}", sentence(&message)));
                }
            }
            Event::Pieces { labels, components } => {
                if let Some(document) = self.worked_on() {
                    document.set_pieces(labels, components);
                }
            }
            // The comparison may have been given up meanwhile.
            Event::Progress { work: Work::Comparing, .. } if !self.comparison.is_busy() => {}
            Event::Progress { work, fraction } => self.work = Some((work, fraction)),
            Event::Compared(compared) => {
                self.comparison.receive(*compared);
                self.rest();
            }
            Event::NotCompared { id, index, message } => {
                self.comparison.receive_failure(id, index, &sentence(&message));
                self.rest();
            }
            Event::Reduced(reduced) => {
                let target = self.settings.target;
                let arrived = self.arrive();
                if let Some(document) = &mut self.document {
                    document.set_levels(*reduced, target);
                }
                return arrived;
            }
            Event::Measured { generation, complete, report, deviation } => {
                if complete {
                    self.failures = 0;
                    // Numbers of older settings, or of the surface before, end no work on newer ones.
                    if self.opening.is_empty() && generation == self.generation {
                        self.work = None;
                        self.rest();
                    }
                }
                if let Some(document) = &mut self.document {
                    document.set_measured(generation, *report, deviation);
                    // Of an older bound too: the view follows the slider as fast as levels are found.
                    if self.settings.target.deviation_mm().is_some() {
                        document.show_found();
                    }
                }
            }
            Event::Carried(carried) => {
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
            Event::Written { name, bytes } => {
                self.no_longer_writes(&name);
                return Some(Effect::Offer { name, bytes });
            }
            Event::NotWritten { name, message } => {
                self.no_longer_writes(&name);
                self.warn(&format!("{name} was not saved: {}", sentence(&message)));
            }
            Event::Failed { message } => {
                self.work = None;
                self.comparison.forget_request();
                self.warn(&sentence(&message));
            }
        }
        None
    }

    fn no_longer_writes(&mut self, name: &str) {
        if let Some(at) = self.writing.iter().position(|writing| writing == name) {
            self.writing.remove(at);
        }
    }

    /// The surface that the engine works on.
    fn worked_on(&mut self) -> Option<&mut Document> {
        let incoming = self.opening.iter_mut().filter_map(|opening| opening.document.as_mut()).next_back();
        incoming.or(self.document.as_mut())
    }

    fn receive_opened(&mut self, opened: crate::engine::Opened) {
        self.engine = Engine::Loaded;
        // Others were read again by a new engine, and are shown already.
        if let Some(at) = self.opening.iter().position(|opening| opening.id == opened.id) {
            // The engine gives up what it was asked for before.
            self.opening.drain(..at);
            let opening = &mut self.opening[0];
            opening.document = Some(Document::new(opening.source.clone(), opened));
        }
    }

    /// The surface that was on its way in takes the place of the one that is open.
    fn arrive(&mut self) -> Option<Effect> {
        let at = self.opening.iter().rposition(|opening| opening.document.is_some())?;
        let Opening { id, settings, document, .. } = self.opening.drain(..=at).next_back()?;
        let document = document?;
        // Pieces are numbered in one surface only.
        self.settings.keep = Keep::Largest;
        self.history.change_all(|settings| settings.keep = Keep::Largest);
        self.generation = id;
        // What was moved meanwhile follows.
        self.sent = settings;
        self.is_cancelling = false;
        // That another file could not be opened meanwhile is not to be lost.
        if self.notice.as_ref().is_none_or(|notice| !notice.is_error) {
            let warning = document.import.warnings.first();
            self.notice = warning.map(|text| Notice { text: text.clone(), is_error: false });
        }
        self.document = Some(document);
        Some(Effect::Opened)
    }

    fn receive_cancelled(&mut self, generation: u64, settings: Settings) {
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

    /// Hears that the engine has stopped by itself.
    pub fn engine_failed(&mut self, reason: &str, link: &mut dyn Link) {
        self.failures += 1;
        self.work = None;
        self.is_cancelling = false;
        self.comparison.stop("The computation stopped.");
        let opening = std::mem::take(&mut self.opening).pop();
        if self.failures > PATIENCE {
            self.engine = Engine::Stopped;
            if self.settings != self.sent {
                // No numbers are those of these settings, and it is not for them that it is started again.
                self.number += 1;
                self.generation = self.number;
                self.sent = self.settings.clone();
            }
            let lost = self.lost_files();
            self.warn(&format!(
                "The computation keeps stopping ({reason}).{lost} What is shown is still there and can be saved; \
                 change a setting or open a file to try again."
            ));
            return;
        }
        let lost = self.reopen(link);
        let text = match opening {
            Some(opening) => {
                format!("{} could not be opened: the computation stopped ({reason}).{lost}", opening.source.name())
            }
            None => {
                let lost = if lost.is_empty() { " Nothing was lost." } else { &lost };
                format!("The computation stopped ({reason}) and was started again.{lost}")
            }
        };
        self.warn(&text);
    }

    /// Opens the file that is shown again, with its numbers in `unit`. Samples have theirs.
    pub fn set_unit(&mut self, unit: Unit, link: &mut dyn Link) {
        if let Some(Source::File { name, bytes, .. }) = self.document.as_ref().map(|document| &document.source) {
            let options = ImportOptions { unit: Some(unit) };
            let source = Source::File { name: name.clone(), bytes: bytes.clone(), options };
            self.open(source, link);
        }
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
