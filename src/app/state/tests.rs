//! The app's state and an engine on one line, slice by slice: what overtakes what.

use std::collections::VecDeque;
use std::time::Duration;

use super::{Effect, State};
use crate::app::compare::Outcome;
use crate::engine::{Command, Engine, Event, Link};
use crate::io::Format;
use crate::phantom::{self, Sample};
use crate::pipeline::pinch::Pinch;
use crate::pipeline::settings::{Keep, Target};

/// A line on which commands lie until the next slice.
#[derive(Default)]
struct Line {
    engine: Engine,
    sent: VecDeque<Command>,
    restarts: u32,
    /// The engine has stopped: nothing is heard by it or of it until another is started.
    is_dead: bool,
}

impl Line {
    fn deliver(&mut self) {
        while let Some(command) = self.sent.pop_front() {
            self.engine.handle(command);
        }
    }

    fn slice(&mut self) -> bool {
        if self.is_dead {
            self.sent.clear();
            return false;
        }
        self.deliver();
        self.engine.advance(Duration::from_millis(8))
    }
}

impl Link for Line {
    fn send(&mut self, command: Command) {
        self.sent.push_back(command);
    }

    fn poll(&mut self) -> Option<Event> {
        self.engine.poll()
    }

    fn restart(&mut self) {
        self.engine = Engine::new();
        self.sent.clear();
        self.restarts += 1;
        self.is_dead = false;
    }

    fn failure(&mut self) -> Option<String> {
        None
    }
}

/// Hears what there is; gives the names of the files that came.
fn hear(state: &mut State, line: &mut Line) -> Vec<String> {
    let mut files = Vec::new();
    while let Some(event) = line.poll() {
        if let Some(Effect::Offer { name, .. }) = state.receive(event) {
            files.push(name);
        }
    }
    files
}

/// Goes on until nothing more happens; gives the names of the files that came.
fn settle(state: &mut State, line: &mut Line) -> Vec<String> {
    let mut files = Vec::new();
    for _ in 0..20000 {
        let more = line.slice();
        files.extend(hear(state, line));
        state.follow(false, line);
        if !more && line.sent.is_empty() {
            return files;
        }
    }
    panic!("no end");
}

/// The engine stops by itself.
fn die(state: &mut State, line: &mut Line) {
    line.is_dead = true;
    state.engine_failed("x", line);
}

/// The engine stops for the third time in a row: it is left alone.
fn die_for_good(state: &mut State, line: &mut Line) {
    (0..3).for_each(|_| die(state, line));
    assert!(line.is_dead);
}

fn stl(triangles: usize) -> Vec<u8> {
    crate::io::write(&phantom::generate(Sample::Aorta, triangles).unwrap(), None, Format::Stl).unwrap()
}

fn start() -> (State, Line) {
    let (mut state, mut line) = (State::default(), Line::default());
    state.open_file("z.stl".into(), stl(10_000), &mut line);
    settle(&mut state, &mut line);
    assert!(state.document.as_ref().unwrap().measured.is_some());
    (state, line)
}

fn agrees(state: &State) {
    let document = state.document.as_ref().unwrap();
    let measured = document.measured.as_ref().unwrap();
    assert_eq!(measured.report.settings, state.settings);
    assert_eq!(measured.generation, state.generation());
    assert_eq!(measured.report.input, document.name);
    assert_eq!(document.pieces.labels.len(), document.opened.triangles.len());
    assert!(!state.is_busy());
}

#[test]
fn numbers_are_current_after_a_second_file() {
    let (mut state, mut line) = start();
    state.settings.target = Target::Reduction(500);
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    state.open_file("b.stl".into(), stl(12_000), &mut line);
    settle(&mut state, &mut line);
    assert_eq!(state.document.as_ref().unwrap().name, "b.stl");
    agrees(&state);
}

#[test]
fn settings_moved_while_a_file_is_read_are_not_lost() {
    let (mut state, mut line) = start();
    state.settings.keep = Keep::Component(1);
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    state.open_file("b.stl".into(), stl(12_000), &mut line);
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
    assert_eq!(state.settings.smoothing.iterations, 20);
    assert_eq!(state.settings.keep, Keep::Largest);
}

#[test]
fn settings_moved_while_the_first_file_is_read_are_not_lost() {
    let (mut state, mut line) = (State::default(), Line::default());
    state.open_file("z.stl".into(), stl(10_000), &mut line);
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn a_broken_file_opened_while_another_is_read() {
    let (mut state, mut line) = start();
    state.open_file("a.stl".into(), stl(12_000), &mut line);
    line.slice(); // a is read before the next command is heard
    state.open_file("b.stl".into(), vec![1, 2, 3], &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
    assert_eq!(state.document.as_ref().unwrap().name, "a.stl");
}

#[test]
fn a_broken_file_opened_while_the_engine_starts_again() {
    let (mut state, mut line) = start();
    state.engine_failed("x", &mut line);
    state.open_file("b.stl".into(), vec![1, 2, 3], &mut line);
    settle(&mut state, &mut line);
    assert_eq!(state.document.as_ref().unwrap().name, "z.stl");
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn cancel_stops() {
    for stage in ["Smoothing", "Reducing", "Measuring deviation"] {
        let (mut state, mut line) = (State::default(), Line::default());
        state.open_file("z.stl".into(), stl(60_000), &mut line);
        loop {
            assert!(line.slice());
            hear(&mut state, &mut line);
            if state.work.is_some_and(|(work, _)| work.label() == stage) {
                break;
            }
        }
        state.cancel(&mut line);
        for _ in 0..50 {
            line.slice();
            hear(&mut state, &mut line);
            state.follow(false, &mut line);
        }
        assert!(!state.is_busy(), "{stage} goes on: {:?}", state.work);
        assert_eq!(state.document.is_some(), stage == "Measuring deviation", "{stage} goes on");
        let Some(document) = &state.document else {
            assert!(state.opening().is_none());
            continue;
        };
        assert!(document.measured.as_ref().is_none_or(|measured| measured.deviation.is_empty()), "{stage} goes on");
        state.settings.target = Target::Reduction(500);
        state.follow(false, &mut line);
        settle(&mut state, &mut line);
        agrees(&state);
    }
}

#[test]
fn settings_moved_before_the_cancel_is_answered() {
    let (mut state, mut line) = start();
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    line.slice();
    state.cancel(&mut line);
    state.settings.smoothing.iterations = 30;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn undo_does_not_bring_back_a_piece_of_another_file() {
    let (mut state, mut line) = start();
    state.settings.keep = Keep::Component(2);
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    state.settings.target = Target::Reduction(500);
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    state.open_file("b.obj".into(), b"v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n".to_vec(), &mut line);
    settle(&mut state, &mut line);
    while state.history.can_undo() {
        state.undo();
        state.follow(false, &mut line);
        settle(&mut state, &mut line);
        agrees(&state);
    }
}

#[test]
fn undo_of_a_typed_value_that_was_not_recorded() {
    let (mut state, mut line) = start();
    state.settings.target = Target::Reduction(500);
    state.follow(false, &mut line);
    state.settings.target = Target::Reduction(600);
    state.follow(true, &mut line);
    state.undo();
    assert_eq!(state.settings.target, Target::Reduction(500));
    state.redo();
    assert_eq!(state.settings.target, Target::Reduction(600));
}

#[test]
fn an_engine_that_cannot_start_is_left_alone() {
    let (mut state, mut line) = start();
    for _ in 0..50 {
        state.engine_failed("x", &mut line);
    }
    assert!(line.restarts <= 4, "{}", line.restarts);
    state.open_file("b.stl".into(), stl(12_000), &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn a_setting_that_changes_nothing_leaves_the_numbers() {
    let (mut state, mut line) = start();
    state.settings.smoothing.iterations = 0;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
    state.settings.smoothing.pass_band = 0.5;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn a_broken_file_opened_with_the_first_surface_is_not_passed_over() {
    let (mut state, mut line) = (State::default(), Line::default());
    state.open_sample(Sample::Aorta, &mut line);
    state.open_file("b.stl".into(), vec![1, 2, 3], &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
    assert!(state.notice.as_ref().is_some_and(|notice| notice.is_error && notice.text.starts_with("b.stl: ")));
}

/// Triangles of the level that is shown.
fn shown(state: &State) -> usize {
    state.document.as_ref().unwrap().shown.as_ref().unwrap().level.triangles.len()
}

#[test]
fn the_level_for_a_bound_on_the_deviation_comes_with_the_answer() {
    let (mut state, mut line) = start();
    let before = shown(&state);
    let mut counts = Vec::new();
    for bound in [100, 1_000, 5_000] {
        state.settings.target = Target::Deviation(bound);
        let last = shown(&state);
        state.follow(false, &mut line);
        assert_eq!(shown(&state), last, "nothing is guessed");
        settle(&mut state, &mut line);
        agrees(&state);
        let report = &state.document.as_ref().unwrap().measured.as_ref().unwrap().report;
        assert_eq!(shown(&state), report.output.triangles);
        assert!(report.deviation_mm.unwrap().max <= f64::from(bound) / 1000.0 + 1e-5);
        counts.push(shown(&state));
    }
    assert!(counts.is_sorted_by(|a, b| a > b), "{counts:?}");
    // Other levels under the same bound, and the way back.
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
    let report = &state.document.as_ref().unwrap().measured.as_ref().unwrap().report;
    assert_eq!(shown(&state), report.output.triangles);
    while state.history.can_undo() {
        state.undo();
        state.follow(false, &mut line);
        settle(&mut state, &mut line);
        agrees(&state);
    }
    assert_eq!(shown(&state), before);
}

#[test]
fn a_cancelled_bound_leaves_the_level_that_was_shown() {
    let (mut state, mut line) = start();
    for target in [Target::Reduction(700), Target::Deviation(1_000)] {
        state.settings.target = target;
        state.follow(false, &mut line);
        settle(&mut state, &mut line);
        let before = shown(&state);
        state.settings.target = Target::Deviation(20);
        state.follow(false, &mut line);
        line.deliver();
        line.engine.advance(Duration::ZERO);
        hear(&mut state, &mut line);
        assert!(state.is_busy());
        state.cancel(&mut line);
        settle(&mut state, &mut line);
        assert_eq!((state.settings.target, shown(&state)), (target, before));
    }
}

#[test]
fn new_levels_have_no_colours_and_no_pinched_vessel_of_older_ones() {
    let (mut state, mut line) = start();
    let document = state.document.as_mut().unwrap();
    assert!(document.deviation_by_node().is_some());
    let finest = document.levels.as_ref().unwrap().1.triangles.len();
    let measured = document.measured.as_mut().unwrap();
    let pinch = Pinch {
        from_percent: 0.0,
        triangles: finest,
        at_mm: [0.0; 3],
        diameter_before_mm: 2.0,
        diameter_after_mm: 0.0,
    };
    measured.report.pinch = Some(pinch);
    assert!(document.pinch().is_some());
    let levels = document.revision.levels;
    // As many triangles, and other places.
    state.settings.smoothing.pass_band = 0.1;
    state.follow(false, &mut line);
    assert!(!state.has_level());
    line.deliver();
    while state.document.as_ref().unwrap().revision.levels == levels {
        line.engine.advance(Duration::from_millis(8));
        while let Some(event) = line.poll() {
            let is_new = matches!(event, Event::Reduced(_));
            state.receive(event);
            if is_new {
                let document = state.document.as_ref().unwrap();
                assert!(document.deviation_by_node().is_none() && document.pinch().is_none());
            }
        }
    }
    settle(&mut state, &mut line);
    assert!(state.has_level() && state.document.as_ref().unwrap().deviation_by_node().is_some());
}

#[test]
fn after_the_third_death_what_is_shown_can_still_be_saved() {
    let (mut state, mut line) = start();
    die_for_good(&mut state, &mut line);
    state.save(Format::Stl, &mut line);
    let name = format!("z-{}.stl", shown(&state));
    assert_eq!(settle(&mut state, &mut line), [name]);
    // The one that wrote it has nothing open.
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn after_the_third_death_another_surface_and_a_file_that_is_under_way_both_come() {
    let (mut state, mut line) = start();
    die_for_good(&mut state, &mut line);
    state.save(Format::Ply, &mut line);
    state.open_file("b.stl".into(), stl(12_000), &mut line);
    assert_eq!(settle(&mut state, &mut line).len(), 1);
    assert_eq!(state.document.as_ref().unwrap().name, "b.stl");
    agrees(&state);
}

#[test]
fn a_file_that_dies_with_the_engine_is_said_not_to_be_saved() {
    let (mut state, mut line) = start();
    let name = format!("z-{}.stl", shown(&state));
    let says = |state: &State, what: &str| {
        let notice = state.notice.as_ref().unwrap();
        assert!(notice.text.contains(&format!("{name} was not saved")) && notice.text.contains(what), "{notice:?}");
    };
    state.save(Format::Stl, &mut line);
    die(&mut state, &mut line);
    says(&state, "(x)");
    assert_eq!(settle(&mut state, &mut line), [""; 0]);
    state.save(Format::Stl, &mut line);
    state.open_file("b.stl".into(), stl(12_000), &mut line);
    state.cancel(&mut line);
    says(&state, "cancelled");
    die_for_good(&mut state, &mut line);
    state.save(Format::Stl, &mut line);
    die(&mut state, &mut line);
    says(&state, "keeps stopping");
    settle(&mut state, &mut line);
    state.save(Format::Stl, &mut line);
    assert_eq!(settle(&mut state, &mut line).len(), 1);
    assert!(state.notice.as_ref().is_none_or(|notice| !notice.text.contains("not saved")), "{:?}", state.notice);
}

#[test]
fn after_the_third_death_a_comparison_is_tried_again_by_another_engine() {
    let (mut state, mut line) = start();
    state.toggle_comparison();
    state.follow(false, &mut line);
    line.slice();
    die_for_good(&mut state, &mut line);
    settle(&mut state, &mut line);
    assert!(line.is_dead, "it is left alone until something is asked for");
    assert!(state.comparison.cells().iter().all(|cell| matches!(cell.outcome, Outcome::Failed(_))));
    let again = state.comparison.cells()[1].id;
    state.comparison.retry(again);
    settle(&mut state, &mut line);
    assert!(matches!(state.comparison.cells()[1].outcome, Outcome::Done(_)));
    assert!(!state.is_busy() && !state.comparison.is_busy());
}

#[test]
fn a_comparison_that_stops_the_engine_again_is_not_in_progress_for_ever() {
    let (mut state, mut line) = start();
    state.toggle_comparison();
    state.follow(false, &mut line);
    die_for_good(&mut state, &mut line);
    let again = state.comparison.cells()[0].id;
    state.comparison.retry(again);
    state.follow(false, &mut line);
    state.follow(false, &mut line);
    die(&mut state, &mut line);
    settle(&mut state, &mut line);
    assert!(line.is_dead && !state.is_busy() && !state.comparison.is_busy());
    assert!(matches!(state.comparison.cells()[0].outcome, Outcome::Failed(_)));
    assert!(state.notice.as_ref().is_some_and(|notice| notice.is_error));
}

#[test]
fn a_cancel_that_nobody_can_answer_holds_nothing_up() {
    let (mut state, mut line) = start();
    die_for_good(&mut state, &mut line);
    state.cancel(&mut line);
    settle(&mut state, &mut line);
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
    // One that was on its way when the engine stopped.
    state.settings.smoothing.iterations = 10;
    state.follow(false, &mut line);
    state.cancel(&mut line);
    die_for_good(&mut state, &mut line);
    state.settings.smoothing.iterations = 30;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn a_surface_that_another_engine_cannot_open_again_stays_and_that_is_said() {
    let (mut state, mut line) = start();
    let before = shown(&state);
    die(&mut state, &mut line);
    line.sent.clear();
    let id = state.generation();
    state.receive(Event::OpenFailed { id, name: "z.stl".into(), message: "no memory left".into() });
    assert!(state.notice.as_ref().is_some_and(|notice| notice.is_error && notice.text.contains("no memory left")));
    state.cancel(&mut line);
    settle(&mut state, &mut line);
    assert_eq!(shown(&state), before);
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn a_level_is_looked_up_once_while_a_file_is_read() {
    let (mut state, mut line) = start();
    state.open_file("b.stl".into(), stl(12_000), &mut line);
    state.settings.target = Target::Reduction(500);
    let before = state.document.as_ref().unwrap().lookups;
    (0..20).for_each(|_| state.follow(false, &mut line));
    assert_eq!(state.document.as_ref().unwrap().lookups, before + 1);
    state.settings.target = Target::Reduction(600);
    (0..20).for_each(|_| state.follow(false, &mut line));
    assert_eq!(state.document.as_ref().unwrap().lookups, before + 2);
    settle(&mut state, &mut line);
    agrees(&state);
}
