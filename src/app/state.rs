//! What the app knows, and how it changes: by the user's hand and by what the engine says (`hearing`). It draws nothing.
//! What is on its way in (`opening`), another file beside it (`beside`), files on their way out (`saving`) and engines that end (`restarting`) have files of
//! their own.

mod beside;
mod hearing;
mod opening;
mod restarting;
mod saving;
#[cfg(test)]
mod tests;

use std::sync::Arc;

use super::compare::comparison::Comparison;
use super::document::{Document, Revision};
use super::history::History;
use super::notices::{Kind, Notices};
use super::reference::against::Against;
use super::solver::preparation::{Preparation, level};
use crate::engine::{Calibre, Command, Link, Source, Work};
use crate::io::{Axes, Unit};
use crate::pipeline::paper;
use crate::pipeline::report::AutoReport;
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::{Boundary, Keep, Settings, Target};
use crate::prepare::Patch;
use crate::prepare::cuts::Cut;
use crate::prepare::prepare::Plan;
use crate::sharing::measures::Measure;

/// What undo goes back to.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The settings.
    pub settings: Settings,
    /// What was measured on the surface.
    pub measures: Arc<Vec<Measure>>,
    /// The unit that was chosen for the numbers of the open file.
    pub unit: Option<Unit>,
    /// What is done to a level for a solver.
    pub plan: Plan,
}

impl Step {
    /// These settings, with nothing measured, in a unit that was chosen.
    pub fn of(settings: &Settings, unit: Option<Unit>) -> Self {
        Self { settings: settings.clone(), measures: Arc::default(), unit, plan: Plan::flow() }
    }
}

/// What the app knows.
pub struct State {
    /// The settings, as the controls have them.
    pub settings: Settings,
    /// What was measured on the surface that is open.
    pub measures: Arc<Vec<Measure>>,
    /// What they were before.
    pub history: History<Step>,
    /// The surface that is open.
    pub document: Option<Document>,
    /// Settings that are compared.
    pub comparison: Comparison,
    /// What is done to a level for a solver, and what came of it.
    pub preparation: Preparation,
    /// Another file that the surface is compared with, and what came of it.
    pub against: Against,
    /// Whether plain Laplacian smoothing is shown beside the level.
    pub shows_averaged: bool,
    /// The number of the newest request for it, and what that was for.
    averaging: Option<(u64, AveragedOf)>,
    /// Surfaces that are being read, the newest last; the one that is open stays until one of them is.
    opening: Vec<Opening>,
    /// What was open before the surface that is, as long as that has no level: a cancel goes back to it.
    before: Option<Box<Before>>,
    /// What the engine is doing, and the part that is done, 0 to 1.
    pub work: Option<(Work, f32)>,
    /// What the user should know.
    pub notices: Notices,
    /// The unit that was chosen for the next file, if one was.
    pub next_unit: Option<Unit>,
    /// How many triangles samples are opened with, where that is not for them to say; what they cannot have is brought to
    /// what they can.
    pub sample_triangles: Option<u32>,
    /// The axes that surfaces are saved in; `None` for those that they have.
    pub written_axes: Option<Axes>,
    /// The settings that the engine has, and their number.
    sent: Settings,
    generation: u64,
    /// The number of the newest command.
    number: u64,
    /// Whether a cancel waits for its answer, which has the settings that are in force.
    is_cancelling: bool,
    /// What there is to ask.
    engine: Engine,
    /// Whether it was cancelled and has been asked for nothing since: it measures nothing more by itself.
    is_stopped: bool,
    /// Times in a row that the engine has stopped by itself.
    failures: u32,
    /// The names of the files that the engine makes.
    writing: Vec<String>,
    /// What is not in the file that was made last.
    left_out: Option<String>,
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

/// What plain Laplacian smoothing is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct AveragedOf {
    /// The revisions of the document and of what was opened.
    surface: [u64; 2],
    keep: Keep,
    boundary: Boundary,
    passes: u32,
}

/// A surface that is being read.
struct Opening {
    id: u64,
    source: Source,
    /// The settings it begins with.
    settings: Settings,
    /// What was measured on it when it was open before.
    measures: Arc<Vec<Measure>>,
}

/// What was open before, and what belongs to it.
struct Before {
    document: Option<Document>,
    keep: Keep,
    measures: Arc<Vec<Measure>>,
    cuts: Vec<Cut>,
    history: History<Step>,
}

/// What has to happen outside the state.
#[derive(Clone, Debug, PartialEq)]
pub enum Effect {
    /// Another surface is shown, as it was opened: the camera should find it.
    Opened,
    /// It has its pieces and its levels.
    Reduced,
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
            history: History::new(Step::of(&settings, None)),
            measures: Arc::default(),
            sample_triangles: None,
            sent: settings.clone(),
            settings,
            document: None,
            comparison: Comparison::default(),
            preparation: Preparation::default(),
            against: Against::default(),
            shows_averaged: false,
            averaging: None,
            opening: Vec::new(),
            before: None,
            work: None,
            notices: Notices::default(),
            next_unit: None,
            written_axes: None,
            generation: 0,
            number: 0,
            is_cancelling: false,
            engine: Engine::Empty,
            is_stopped: false,
            failures: 0,
            writing: Vec::new(),
            left_out: None,
        }
    }
}

impl State {
    /// Whether the surface that is open is a sample.
    pub fn shows_sample(&self) -> bool {
        self.document.as_ref().is_some_and(|document| matches!(document.source, Source::Sample { .. }))
    }

    /// Whether the engine is at work.
    pub fn is_busy(&self) -> bool {
        self.work.is_some()
    }

    /// Whether the engine is at work on what is waited for: more than numbers of the level that is shown.
    pub fn awaits(&self) -> bool {
        self.work.is_some_and(|(work, _)| !work.adds_to_what_is_shown())
    }

    /// The work to tell of, and how far it is: a notice is hidden by what is waited for alone.
    pub fn told_work(&self) -> Option<(Work, f32)> {
        self.work.filter(|_| self.notices.newest().is_none() || self.awaits())
    }

    /// Whether what is not known yet of the surface that is open is on its way.
    pub fn is_measuring(&self) -> bool {
        matches!(self.engine, Engine::Loaded | Engine::Loading) && !self.is_stopped
    }

    /// Whether the surface that is open is shown as it was opened, because it has no level yet.
    pub fn awaits_levels(&self) -> bool {
        self.before.is_some()
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

    /// How far a reduction is safe by the present settings, if that is known. It is the same for every level.
    pub fn safe(&self) -> Option<&Safe> {
        let measured = self.document.as_ref()?.measured.as_ref()?;
        let report = &measured.report;
        let is_same_tolerance = report.settings.tolerance_percent == self.settings.tolerance_percent;
        let is_same = Settings { target: self.settings.target, ..report.settings.clone() }.gives_same(&self.settings);
        measured.safe.as_deref().filter(|_| is_same_tolerance && is_same)
    }

    /// What the target auto has come to under the present settings, as far as that is known.
    pub fn auto(&self) -> Option<&AutoReport> {
        let report = &self.document.as_ref()?.measured.as_ref()?.report;
        // Under another tolerance the level stays until it is known what is safe then.
        let settings = Settings { tolerance_percent: self.settings.tolerance_percent, ..report.settings.clone() };
        report.auto.as_ref().filter(|_| settings.gives_same(&self.settings))
    }

    /// Whether it is not known yet how far is safe, and the level is to go by it.
    pub fn is_deciding(&self) -> bool {
        let is_decided = self.auto().is_some_and(|found| found.is_decided) && self.has_level();
        self.settings.target == Target::Auto && self.is_measuring() && !is_decided
    }

    /// Notes what stands now as a step to undo, if it is another than before.
    pub fn record(&mut self) {
        let now = self.step();
        self.history.record(&now);
    }

    /// What stands now, as a step.
    fn step(&self) -> Step {
        let (measures, plan) = (self.measures.clone(), self.preparation.plan.clone());
        Step { measures, plan, ..Step::of(&self.settings, self.asked_unit()) }
    }

    /// Goes one step back. A file that was read in another unit then is read in it again.
    pub fn undo(&mut self, link: &mut dyn Link) {
        // A value that was typed a moment ago may not be a step yet.
        self.record();
        if let Some(step) = self.history.undo().cloned() {
            self.take(step, link);
        }
    }

    /// Takes back the last step back.
    pub fn redo(&mut self, link: &mut dyn Link) {
        self.record();
        if let Some(step) = self.history.redo().cloned() {
            self.take(step, link);
        }
    }

    fn take(&mut self, Step { settings, measures, unit, plan }: Step, link: &mut dyn Link) {
        (self.settings, self.measures, self.preparation.plan) = (settings, measures, plan);
        if unit != self.asked_unit() {
            self.set_unit(unit, link);
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
    /// its way in, also one that is read once more, or a cancel waits for its answer the engine is told nothing: it is then
    /// told all at once, and on which surface the settings act is never in doubt.
    pub fn follow(&mut self, is_held: bool, link: &mut dyn Link) {
        if !is_held {
            self.record();
        }
        self.show_level();
        if !self.shows_averaged {
            self.hide_averaged();
        }
        if matches!(self.engine, Engine::Empty | Engine::Stopped) && self.opening.is_empty() {
            // It is left alone until the hand is done with something that it is needed for.
            let is_wished = self.shows_averaged && self.engine == Engine::Stopped;
            let is_asked = self.comparison.is_waiting() || self.next_question().is_some() || self.wants_cuts();
            let is_needed = self.settings != self.sent || is_asked || is_wished;
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
        // One that has nothing open yet passes settings over.
        if self.settings != self.sent && self.engine != Engine::Loading {
            self.number += 1;
            self.generation = self.number;
            link.send(Command::Set { generation: self.generation, settings: self.settings.clone() });
            self.sent = self.settings.clone();
            self.is_stopped = false;
        }
        if let Some(settings) = self.comparison.request(subject, self.number + 1) {
            self.number += 1;
            link.send(Command::Compare { id: self.number, settings });
        }
        if let Some([first, other]) = self.comparison.request_difference(self.number + 1) {
            self.number += 1;
            link.send(Command::Differ { id: self.number, first, other });
        }
        self.compare_with_file(link);
        if !is_held {
            self.plan_cuts(link);
        }
        self.average(link);
        self.rest();
    }

    /// The patches of the level that is shown as it was made ready for a solver by what is asked for now; none where it
    /// was not.
    pub(in crate::app) fn patches_for_solver(&self) -> Vec<Patch> {
        let now = self.document.as_ref().map(|document| level(document.revision));
        let made = self.preparation.made.as_ref();
        let made = made.filter(|made| Some(made.of) == now && made.plan == self.preparation.plan);
        made.map(|made| made.ready.patches.clone()).unwrap_or_default()
    }

    /// Whether the engine is to say where the ends of the level are cut.
    fn wants_cuts(&self) -> bool {
        let document = self.document.as_ref().filter(|document| document.shown.is_some());
        document.is_some_and(|document| self.preparation.wants_cuts(level(document.revision)))
    }

    /// Asks where the ends of the level are cut, where that is shown and is not known.
    fn plan_cuts(&mut self, link: &mut dyn Link) {
        let Some(document) = self.document.as_ref().filter(|_| self.wants_cuts()) else { return };
        let (Some(mesh), of) = (document.shown_mesh(), level(document.revision)) else { return };
        self.number += 1;
        let (id, plan) = (self.number, self.preparation.plan.clone());
        self.preparation.ask_cuts(id, of);
        link.send(Command::PlanCuts { id, mesh: Arc::new(mesh), plan });
    }

    /// Asks for plain Laplacian smoothing where that is to be shown and is not, or no longer, what the settings would show.
    fn average(&mut self, link: &mut dyn Link) {
        let passes = self.settings.smoothing.iterations;
        let Some(document) = &mut self.document else { return };
        if !self.shows_averaged {
            return;
        }
        if passes == 0 {
            self.averaging = None;
            return document.set_averaged(None);
        }
        let Revision { document: open, opened, .. } = document.revision;
        let (keep, boundary) = (self.settings.keep, self.settings.smoothing.boundary);
        let of = AveragedOf { surface: [open, opened], keep, boundary, passes };
        if self.averaging.is_none_or(|(_, asked)| asked != of) {
            self.number += 1;
            self.averaging = Some((self.number, of));
            link.send(Command::Average { id: self.number, passes });
        }
    }

    /// Plain Laplacian smoothing is shown no longer.
    fn hide_averaged(&mut self) {
        (self.shows_averaged, self.averaging) = (false, None);
        if let Some(document) = &mut self.document {
            document.set_averaged(None);
        }
    }

    /// Says what the engine does once it is done with the settings in force: the comparison, or nothing.
    fn rest(&mut self) {
        self.work = match self.work {
            Some((Work::Comparing, _)) if !self.comparison.is_busy() => None,
            Some((Work::Preparing, _)) if !self.preparation.is_worked_on() => None,
            Some((Work::Beside, _)) if !self.against.is_busy() => None,
            None if self.preparation.is_worked_on() => Some((Work::Preparing, 0.0)),
            // What is asked for goes before numbers that nobody waits for.
            Some((work, _)) if work.adds_to_what_is_shown() && self.preparation.is_worked_on() => {
                Some((Work::Preparing, 0.0))
            }
            None if self.against.is_busy() => Some((Work::Beside, 0.0)),
            None if self.comparison.is_busy() => Some((Work::Comparing, 0.0)),
            work => work,
        };
    }

    /// Shows the compare view or leaves it. The first time it has the settings in force at the three rates of the
    /// paper's Figure 7, which need no more than three levels of what is there.
    pub fn toggle_comparison(&mut self) {
        let is_open = !self.comparison.is_open() && !self.against.is_open;
        self.leave_modes();
        self.comparison.set_open(is_open);
        if is_open && self.comparison.cells().is_empty() {
            self.comparison.set(paper::rates_of_figure_7(&self.settings));
        }
    }

    /// Leaves what covers the method, but for trials and scans.
    pub fn leave_modes(&mut self) {
        self.comparison.set_open(false);
        (self.preparation.shown, self.against.is_open) = (None, false);
    }

    /// Has the level that is shown made ready for a solver.
    pub fn prepare_for_solver(&mut self, link: &mut dyn Link) {
        let Some((document, mesh)) = self.document.as_ref().and_then(|d| Some((d, d.shown_mesh()?))) else { return };
        let of = level(document.revision);
        self.wake(link);
        if self.engine == Engine::Empty {
            self.load(link);
        }
        self.number += 1;
        let (id, plan) = (self.number, self.preparation.plan.clone());
        self.preparation.ask(id, of);
        link.send(Command::Prepare { id, mesh: Arc::new(mesh), plan });
        self.rest();
    }

    /// Tells the user something.
    pub fn tell(&mut self, text: &str) {
        self.notices.tell(Kind::Done, text);
    }

    /// Tells the user what nobody has asked for: after what went wrong.
    pub fn mention(&mut self, text: &str) {
        self.notices.mention(text);
    }

    /// Asks the user to do something.
    pub fn ask(&mut self, text: &str) {
        self.notices.tell(Kind::Asks, text);
    }

    /// Tells the user that something went wrong.
    pub fn warn(&mut self, text: &str) {
        self.notices.tell(Kind::Wrong, text);
    }
}
