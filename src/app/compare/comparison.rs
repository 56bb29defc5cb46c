//! Which settings are compared and what the engine made of them. It draws nothing.

use std::sync::Arc;

use super::action::Action;
use super::arrangement::Arrangement;
use super::difference::{Difference, Differences, Pair};
use crate::engine::{Compared, Differed};
use crate::mesh::TriMesh;
use crate::pipeline::paper;
use crate::pipeline::report::Report;
use crate::pipeline::settings::{Keep, Settings};

/// The most settings that are compared at a time.
pub const MAX_COMPARED: usize = 6;

/// What the pipeline made at one setting.
#[derive(Clone, Debug, PartialEq)]
pub struct Made {
    /// The numbers.
    pub report: Report,
    /// The level.
    pub mesh: Arc<TriMesh>,
}

/// How far a setting is.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The engine is to work on it, or does.
    Waiting,
    /// It is done.
    Done(Box<Made>),
    /// It was stopped, or cannot be worked on: one plain sentence.
    Failed(String),
}

/// One of the settings that are compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Its number; each has another.
    pub id: u64,
    /// The setting.
    pub settings: Settings,
    /// What came of it.
    pub outcome: Outcome,
}

impl Cell {
    /// The surface, if it is there.
    fn mesh(&self) -> Option<&Arc<TriMesh>> {
        match &self.outcome {
            Outcome::Done(made) => Some(&made.mesh),
            Outcome::Waiting | Outcome::Failed(_) => None,
        }
    }
}

/// The surface that is compared: the document and its pieces.
type Subject = (u64, Keep);

/// The settings that are compared.
#[derive(Debug, Default)]
pub struct Comparison {
    cells: Vec<Cell>,
    /// How their pictures are arranged.
    pub arrangement: Arrangement,
    /// Whether the others are coloured by their distance from the first.
    pub shows_difference: bool,
    differences: Differences,
    is_open: bool,
    /// The number of the newest cell.
    newest: u64,
    subject: Option<Subject>,
    /// The number of the newest request, and the cells that it names, in their order; answered ones are `None`.
    request: (u64, Vec<Option<u64>>),
}

impl Comparison {
    /// The settings, in the order of the grid.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// What was made at each of the settings; `None` until all of it is there.
    pub fn made(&self) -> Option<Vec<&Made>> {
        let made = self.cells.iter().map(|cell| match &cell.outcome {
            Outcome::Done(made) => Some(&**made),
            Outcome::Waiting | Outcome::Failed(_) => None,
        });
        made.collect::<Option<Vec<&Made>>>().filter(|made| !made.is_empty())
    }

    /// Whether the view is shown. Nothing is computed while it is not.
    pub fn is_open(&self) -> bool {
        self.is_open
    }

    /// Shows the view or leaves it.
    pub fn set_open(&mut self, is_open: bool) {
        if is_open && !self.is_open {
            self.differences.set_stopped(false);
        }
        self.is_open = is_open;
    }

    /// Does what the user asks for; `settings` are those in force.
    pub fn act(&mut self, action: Action, settings: &Settings) {
        match action {
            Action::Add => self.add(settings),
            Action::Figure6 => {
                self.set(paper::figure_6(settings.keep));
                self.arrangement = Arrangement::Shaded;
            }
            Action::Figure7 => {
                self.set(paper::figure_7(settings.keep));
                self.arrangement = Arrangement::Stacked;
            }
            Action::Arrange(arrangement) => self.arrangement = arrangement,
            Action::Difference => {
                self.shows_difference = !self.shows_difference;
                self.differences.set_stopped(false);
            }
            Action::Remove(id) => self.remove(id),
            Action::Retry(id) => self.retry(id),
            Action::Close => self.set_open(false),
        }
    }

    /// Compares these settings, at most [`MAX_COMPARED`]. What is known of one of them already is kept.
    pub fn set(&mut self, settings: impl IntoIterator<Item = Settings>) {
        let mut known = std::mem::take(&mut self.cells);
        for settings in settings.into_iter().take(MAX_COMPARED) {
            match known.iter().position(|cell| cell.settings == settings) {
                Some(at) => self.cells.push(known.swap_remove(at)),
                None => self.push(settings),
            }
        }
    }

    fn push(&mut self, settings: Settings) {
        self.newest += 1;
        self.differences.set_stopped(false);
        self.cells.push(Cell { id: self.newest, settings, outcome: Outcome::Waiting });
    }

    /// Whether `settings` can be added: there is room, and they are not compared already.
    pub fn can_add(&self, settings: &Settings) -> bool {
        self.cells.len() < MAX_COMPARED && !self.cells.iter().any(|cell| cell.settings.gives_same(settings))
    }

    /// Compares `settings` too, if they can be added.
    pub fn add(&mut self, settings: &Settings) {
        if self.can_add(settings) {
            self.push(settings.clone());
        }
    }

    /// Compares `id` no more.
    pub fn remove(&mut self, id: u64) {
        self.cells.retain(|cell| cell.id != id);
    }

    /// Tries one that was stopped or failed again.
    pub fn retry(&mut self, id: u64) {
        if let Some(cell) = self.cells.iter_mut().find(|cell| cell.id == id) {
            cell.outcome = Outcome::Waiting;
            self.differences.set_stopped(false);
        }
    }

    /// Whether the engine owes an answer.
    pub fn is_busy(&self) -> bool {
        self.request.1.iter().any(Option::is_some) || self.differences.is_busy()
    }

    /// Whether there is something that the engine has to be asked, or was.
    pub(in crate::app) fn is_waiting(&self) -> bool {
        self.is_open && self.cells.iter().any(|cell| cell.outcome == Outcome::Waiting)
    }

    /// Gives up what has no result yet, for this reason.
    pub(in crate::app) fn stop(&mut self, reason: &str) {
        self.forget_request();
        self.differences.set_stopped(true);
        for cell in self.cells.iter_mut().filter(|cell| cell.outcome == Outcome::Waiting) {
            cell.outcome = Outcome::Failed(reason.to_owned());
        }
    }

    /// The engine knows nothing of what it was asked for: it will be asked again.
    pub(in crate::app) fn forget_request(&mut self) {
        self.request.1.clear();
        self.differences.forget_request();
    }

    /// What the engine has to be asked now, if it is another thing than it was asked for last; `subject` is the surface
    /// that is open. Other settings of the pieces that go on are those of the comparison too.
    pub(in crate::app) fn request(&mut self, subject: Subject, id: u64) -> Option<Vec<Settings>> {
        if self.subject.replace(subject) != Some(subject) {
            self.forget_request();
            self.differences.set_stopped(false);
            for cell in &mut self.cells {
                cell.settings.keep = subject.1;
                cell.outcome = Outcome::Waiting;
            }
        }
        let waiting = self.cells.iter().filter(|cell| self.is_open && cell.outcome == Outcome::Waiting);
        let (ids, settings): (Vec<_>, Vec<_>) = waiting.map(|cell| (cell.id, cell.settings.clone())).unzip();
        if self.request.1.iter().flatten().eq(&ids) {
            return None;
        }
        self.request = (id, ids.into_iter().map(Some).collect());
        Some(settings)
    }

    /// Takes an answer; one to an older question is passed over.
    pub(in crate::app) fn receive(&mut self, compared: Compared) {
        let Compared { id, index, report, mesh } = compared;
        self.answer(id, index, Outcome::Done(Box::new(Made { report, mesh })));
    }

    /// Hears that one of the settings cannot be worked on.
    pub(in crate::app) fn receive_failure(&mut self, id: u64, index: u32, message: &str) {
        self.answer(id, index, Outcome::Failed(message.to_owned()));
    }

    /// The surfaces of which the engine has to be asked now how far they are apart, if it is to be.
    pub(in crate::app) fn request_difference(&mut self, id: u64) -> Option<Pair> {
        if !self.is_open {
            self.differences.forget_request();
            return None;
        }
        let mut meshes = self.cells.iter().map(Cell::mesh);
        let pairs: Vec<Pair> = match meshes.next().flatten() {
            Some(first) => meshes.flatten().map(|other| [first.clone(), other.clone()]).collect(),
            None => Vec::new(),
        };
        self.differences.next(&pairs, id)
    }

    /// Takes how far two surfaces are apart; an answer to an older question is passed over.
    pub(in crate::app) fn receive_difference(&mut self, differed: Differed) {
        self.differences.receive(differed);
    }

    /// How far the surface of `cell` is from the first, if that is known.
    pub fn difference(&self, cell: &Cell) -> Option<&Difference> {
        self.differences.of(self.cells.first()?.mesh()?, cell.mesh()?)
    }

    /// The largest difference, once all are known.
    pub fn largest_difference(&self) -> Option<&Difference> {
        let is_known = |cell: &Cell| match cell.outcome {
            Outcome::Waiting => false,
            Outcome::Failed(_) => true,
            Outcome::Done(_) => self.difference(cell).is_some(),
        };
        if !self.cells.iter().skip(1).all(is_known) {
            return None;
        }
        self.known().max_by(|a, b| a.most_mm().total_cmp(&b.most_mm()))
    }

    /// The distance that has the last colour, in mm: 95 % of the samples of every surface are within it. `None` until one
    /// is known.
    pub fn colours_up_to_mm(&self) -> Option<f32> {
        let all = self.known().filter_map(|found| found.deviation);
        all.map(|deviation| deviation.p95).max_by(f64::total_cmp).map(|most| (most as f32).max(1e-3))
    }

    /// What is known of the cells that there are.
    fn known(&self) -> impl Iterator<Item = &Difference> {
        self.cells.iter().skip(1).filter_map(|cell| self.difference(cell))
    }

    fn answer(&mut self, id: u64, index: u32, outcome: Outcome) {
        if self.request.0 != id {
            return;
        }
        let answered = self.request.1.get_mut(index as usize).and_then(Option::take);
        if let Some(cell) = self.cells.iter_mut().find(|cell| Some(cell.id) == answered) {
            cell.outcome = outcome;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SUBJECT: Subject = (1, Keep::Largest);

    fn fail(comparison: &mut Comparison, id: u64, index: u32) {
        comparison.receive_failure(id, index, "x");
    }

    #[test]
    fn the_engine_is_asked_once_for_what_is_not_there() {
        let mut comparison = Comparison::default();
        comparison.set(paper::figure_6(Keep::Largest));
        assert_eq!(comparison.request(SUBJECT, 1), None, "while the view is not shown");
        comparison.set_open(true);
        assert_eq!(comparison.request(SUBJECT, 1), Some(paper::figure_6(Keep::Largest)));
        assert_eq!(comparison.request(SUBJECT, 2), None);
        fail(&mut comparison, 1, 0);
        assert!(matches!(comparison.cells()[0].outcome, Outcome::Failed(_)) && comparison.is_busy());
        assert_eq!(comparison.request(SUBJECT, 2), None);
        comparison.retry(comparison.cells()[0].id);
        assert_eq!(comparison.request(SUBJECT, 3).map(|settings| settings.len()), Some(6));
        fail(&mut comparison, 1, 1);
        assert_eq!(comparison.cells()[1].outcome, Outcome::Waiting, "an answer to an older question");
        comparison.set_open(false);
        assert_eq!(comparison.request(SUBJECT, 4), Some(vec![]), "nothing is computed for a view that is closed");
        assert!(!comparison.is_busy());
    }

    #[test]
    fn another_surface_and_other_pieces_are_compared_anew() {
        let mut comparison = Comparison::default();
        comparison.set_open(true);
        comparison.set(paper::figure_7(Keep::Largest));
        comparison.request(SUBJECT, 1);
        (0..3).for_each(|i| fail(&mut comparison, 1, i));
        assert!(!comparison.is_busy());
        assert_eq!(comparison.request((2, Keep::Largest), 2), Some(paper::figure_7(Keep::Largest)));
        assert_eq!(comparison.request((2, Keep::All), 3), Some(paper::figure_7(Keep::All)));
    }

    #[test]
    fn there_are_six_at_most_and_none_twice() {
        let mut comparison = Comparison::default();
        comparison.set([paper::figure_6(Keep::Largest), paper::figure_7(Keep::Largest)].concat());
        assert_eq!(comparison.cells().len(), MAX_COMPARED);
        let first = comparison.cells()[0].clone();
        comparison.remove(comparison.cells()[5].id);
        comparison.add(&first.settings);
        assert_eq!(comparison.cells().len(), 5);
        comparison.add(&paper::reduced(42, Keep::Largest));
        assert!(comparison.cells().len() == MAX_COMPARED && !comparison.can_add(&Settings::default()));
        comparison.set([first.settings.clone()]);
        assert_eq!(comparison.cells(), [first], "what is known is kept");
    }

    #[test]
    fn what_is_stopped_stays_stopped_until_it_is_tried_again() {
        let mut comparison = Comparison::default();
        comparison.set_open(true);
        comparison.set(paper::figure_7(Keep::Largest));
        comparison.request(SUBJECT, 1);
        comparison.stop("Cancelled.");
        assert_eq!((comparison.request(SUBJECT, 2), comparison.is_busy()), (None, false));
        comparison.retry(comparison.cells()[1].id);
        assert_eq!(comparison.request(SUBJECT, 3).map(|settings| settings.len()), Some(1));
    }
}
