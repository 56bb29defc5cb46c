//! Another file that the open surface is compared with, and what came of it. It draws nothing.

use std::sync::Arc;

use crate::app::document::Revision;
use crate::engine::{FilesCompared, Over, Source, TwoFiles};
use crate::io::{Axes, Unit};
use crate::pipeline::beside::Align;

/// What is compared, and how.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) struct Question {
    /// The number of the file, of those that were taken.
    reference: u64,
    align: Align,
    tolerance_percent: f64,
    surface: Judged,
    /// What the surface's coordinates grow towards, as the file or the user says.
    axes: Axes,
}

/// Which surface is compared with the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Judged {
    /// That of a document as it was opened: its number, and that of what was mended.
    Opened(u64, u64),
    /// A level: of which document, which levels, which of them.
    Level(u64, u64, u64),
}

/// What the engine found.
#[derive(Clone, Debug)]
pub struct Found {
    /// The surfaces and the numbers.
    pub two: TwoFiles,
    /// The distances over the reference and over the surface, in mm: without a sign, and with one.
    pub over: [[Arc<Vec<f32>>; 2]; 2],
}

/// What the next file that comes is taken for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) enum Next {
    /// It was dropped: the reference where the comparison has the window, else a surface.
    #[default]
    Dropped,
    /// A surface to be opened.
    Surface,
    /// The reference.
    Reference,
}

/// Another file that the open surface is compared with.
#[derive(Debug, Default)]
pub struct Against {
    /// Whether the comparison has the window.
    pub is_open: bool,
    /// The file.
    pub source: Option<Source>,
    /// How the surface is moved first.
    pub align: Align,
    /// Whether the level is compared, not the surface as it was opened.
    pub of_level: bool,
    /// Whether inside and outside have the same colours.
    pub is_plain: bool,
    /// What the next file is.
    next: Next,
    /// How many files were taken.
    taken: u64,
    asked: Option<(u64, Question)>,
    /// The last question that was answered, and the answer: what was found, or one sentence.
    answered: Option<(Question, Result<Box<Found>, String>)>,
    /// Why nothing is asked.
    stopped: Option<String>,
}

impl Against {
    /// Notes what the next file is.
    pub(in crate::app) fn expect(&mut self, next: Next) {
        self.next = next;
    }

    /// Whether a file that has come is the reference. Nothing is known of the one after it.
    pub(in crate::app) fn takes_file(&mut self) -> bool {
        match std::mem::take(&mut self.next) {
            Next::Dropped => self.is_open,
            Next::Surface => false,
            Next::Reference => true,
        }
    }

    /// Compares with this.
    pub fn take(&mut self, source: Source) {
        self.taken += 1;
        (self.source, self.is_open, self.stopped) = (Some(source), true, None);
    }

    /// Reads the file with its numbers in this unit.
    pub(in crate::app) fn read_in(&mut self, unit: Unit) {
        if let Some(Source::File { options, .. }) = &mut self.source {
            options.unit = Some(unit);
            self.taken += 1;
        }
    }

    /// What is to be asked and was not yet.
    pub(in crate::app) fn next(&self, revision: Revision, axes: Axes, tolerance_percent: f64) -> Option<Question> {
        if !self.is_open || self.source.is_none() || self.stopped.is_some() {
            return None;
        }
        let question = self.question(revision, axes, tolerance_percent);
        let newest = self.asked.as_ref().map(|(_, of)| of).or(self.answered.as_ref().map(|(of, _)| of));
        (newest != Some(&question)).then_some(question)
    }

    /// Notes what was asked for under this number.
    pub(in crate::app) fn ask(&mut self, id: u64, question: Question) {
        self.asked = Some((id, question));
    }

    fn question(&self, revision: Revision, axes: Axes, tolerance_percent: f64) -> Question {
        let Revision { document, opened, levels, shown, .. } = revision;
        let surface =
            if self.of_level { Judged::Level(document, levels, shown) } else { Judged::Opened(document, opened) };
        Question { reference: self.taken, align: self.align, tolerance_percent, surface, axes }
    }

    /// Hears an answer; one to an older question is passed over. Says whether it is one to this.
    pub fn receive(&mut self, FilesCompared { id, outcome }: FilesCompared) -> bool {
        let Some((_, question)) = self.asked.take_if(|(asked, _)| *asked == id) else { return false };
        let found = outcome.map(|mut two| {
            let over = [&mut two.over_reference, &mut two.over_surface].map(std::mem::take);
            let over = over.map(|Over { plain, signed }| [plain, signed].map(Arc::new));
            Box::new(Found { two, over })
        });
        self.answered = Some((question, found));
        true
    }

    /// What was found last, or why nothing was.
    pub fn answer(&self) -> Option<Result<&Found, &str>> {
        self.answered.as_ref().map(|(_, answer)| answer.as_deref().map_err(String::as_str))
    }

    /// Whether the engine owes an answer.
    pub fn is_busy(&self) -> bool {
        self.asked.is_some()
    }

    /// Why nothing is asked.
    pub fn stopped(&self) -> Option<&str> {
        self.stopped.as_deref()
    }

    /// The engine knows nothing of what it was asked for.
    pub(in crate::app) fn forget_request(&mut self) {
        self.asked = None;
    }

    /// Asks for nothing more until it is told to; `why` is said meanwhile. Only where something was asked for.
    pub(in crate::app) fn stop(&mut self, why: &str) {
        if self.asked.take().is_some() {
            self.stopped = Some(why.to_owned());
        }
    }

    /// Goes on after a stop.
    pub(in crate::app) fn go_on(&mut self) {
        self.stopped = None;
    }

    /// Another surface is open: nothing of this is of it.
    pub(in crate::app) fn leave_surface(&mut self) {
        *self = Self { align: self.align, taken: self.taken, next: self.next, ..Self::default() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::ImportOptions;
    use crate::phantom::Sample;

    fn revision(document: u64, shown: u64) -> Revision {
        Revision { document, shown, ..Revision::default() }
    }

    /// Asks for what is to be asked, under the number `id`; whether anything is.
    fn ask(against: &mut Against, revision: Revision, tolerance_percent: f64, id: u64) -> bool {
        let question = against.next(revision, Axes::Unknown, tolerance_percent);
        question.map(|question| against.ask(id, question)).is_some()
    }

    fn failed(id: u64) -> FilesCompared {
        FilesCompared { id, outcome: Err("no".into()) }
    }

    #[test]
    fn each_question_is_asked_once_and_anew_where_it_is_another() {
        let mut against = Against::default();
        assert!(!ask(&mut against, revision(1, 0), 1.0, 1), "there is no file");
        against.take(Source::sample(Sample::Aorta));
        assert!(against.is_open && ask(&mut against, revision(1, 0), 1.0, 2));
        assert!(!ask(&mut against, revision(1, 0), 1.0, 3), "asked already");
        assert!(!ask(&mut against, revision(1, 7), 1.0, 3), "the surface as opened is the same at any level");
        assert!(!against.receive(failed(1)) && against.is_busy(), "an answer to another question");
        assert!(against.receive(failed(2)) && !against.is_busy());
        assert_eq!(against.answer().map(Result::err), Some(Some("no")));
        assert!(!ask(&mut against, revision(1, 0), 1.0, 4), "answered");
        against.align = Align::Rigid;
        assert!(ask(&mut against, revision(1, 0), 1.0, 4));
        // Before that is answered, another is asked for.
        against.of_level = true;
        assert!(ask(&mut against, revision(1, 0), 1.0, 5) && !against.receive(failed(4)));
        assert!(ask(&mut against, revision(1, 7), 1.0, 6), "another level");
        assert!(ask(&mut against, revision(1, 7), 2.0, 7), "another tolerance");
        against.take(Source::sample(Sample::Aorta));
        assert!(ask(&mut against, revision(1, 7), 2.0, 8), "another file");
    }

    #[test]
    fn after_a_stop_nothing_is_asked_until_that_is_wished() {
        let mut against = Against::default();
        against.take(Source::sample(Sample::Aorta));
        against.stop("nothing was asked");
        assert!(ask(&mut against, revision(1, 0), 1.0, 1) && against.stopped().is_none());
        against.stop("cancelled");
        assert_eq!((against.stopped(), against.is_busy()), (Some("cancelled"), false));
        assert!(!ask(&mut against, revision(1, 0), 1.0, 2));
        against.go_on();
        assert!(ask(&mut against, revision(1, 0), 1.0, 2));
        against.forget_request();
        assert!(ask(&mut against, revision(1, 0), 1.0, 3), "a new engine is asked again");
        against.receive(failed(3));
        against.leave_surface();
        assert!(!against.is_open && against.answer().is_none() && against.source.is_none());
    }

    #[test]
    fn a_file_is_the_reference_where_one_was_asked_for_or_it_is_dropped_on_the_comparison() {
        let mut against = Against::default();
        assert!(!against.takes_file());
        against.expect(Next::Reference);
        assert!(against.takes_file() && !against.takes_file(), "one file");
        // A dialog that was cancelled says nothing of what is dropped later.
        against.expect(Next::Reference);
        against.expect(Next::Dropped);
        assert!(!against.takes_file());
        against.is_open = true;
        assert!(against.takes_file() && against.takes_file(), "dropped on the comparison");
        against.expect(Next::Surface);
        assert!(!against.takes_file(), "*Open...* opens");
    }

    #[test]
    fn axes_and_the_unit_of_the_file_are_part_of_the_question() {
        let mut against = Against::default();
        let options = ImportOptions::default();
        against.take(Source::File { name: "a.stl".into(), bytes: Arc::default(), options });
        let question = |against: &Against, axes| against.next(revision(1, 0), axes, 1.0);
        let first = question(&against, Axes::Unknown).unwrap();
        against.ask(1, first);
        assert!(question(&against, Axes::Unknown).is_none() && question(&against, Axes::Lps).is_some());
        against.read_in(Unit::Centimetre);
        assert!(question(&against, Axes::Unknown).is_some());
        assert!(
            matches!(&against.source, Some(Source::File { options, .. }) if options.unit == Some(Unit::Centimetre))
        );
    }
}
