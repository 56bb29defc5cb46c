//! The app's state and an engine on one line, slice by slice: what overtakes what.

mod restarting;

use std::collections::VecDeque;
use std::time::Duration;

use super::{Effect, State};
use crate::app::notices::Kind;
use crate::app::solver::Shown;
use crate::engine::{Command, Engine, Event, Link, Source, Work};
use crate::io::{Format, Unit};
use crate::phantom::{self, Sample};
use crate::pipeline::pinch::Pinch;
use crate::pipeline::settings::{Keep, Target};
use crate::pipeline::stage::Stage;
use crate::prepare::cuts::Cut;

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

/// Goes on until the surface `name` is shown.
fn until_opened(state: &mut State, line: &mut Line, name: &str) {
    while state.document.as_ref().is_none_or(|document| document.name != name) {
        assert!(line.slice());
        hear(state, line);
    }
}

#[test]
fn a_surface_is_shown_as_soon_as_it_is_read_and_nothing_of_the_one_before_with_it() {
    let (mut state, mut line) = start();
    state.open_file("b.stl".into(), stl(60_000), &mut line);
    until_opened(&mut state, &mut line, "b.stl");
    let document = state.document.as_ref().unwrap();
    assert_eq!(document.opened.triangles.len(), phantom::generate(Sample::Aorta, 60_000).unwrap().triangles.len());
    assert!(document.levels.is_none() && document.shown.is_none() && document.measured.is_none());
    assert!(state.awaits_levels() && state.is_busy() && !state.has_level());
    assert!(state.calibre().is_none() && state.safe().is_none());
    let verdict = crate::app::verdict::verdict(&state, document);
    assert_eq!((verdict.head, verdict.is_safe), (crate::pipeline::verdict::Head::Coming, None));
    // What is moved meanwhile is followed at once.
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    assert!(line.sent.iter().any(|command| matches!(command, Command::Set { .. })));
    settle(&mut state, &mut line);
    agrees(&state);
    assert!(!state.awaits_levels() && state.history.can_undo());
    assert_eq!(state.settings.smoothing.iterations, 20);
}

#[test]
fn a_surface_that_is_given_up_before_it_has_a_level_gives_way_to_the_one_before() {
    for ends in [true, false] {
        let (mut state, mut line) = start();
        state.settings.keep = Keep::Component(1);
        state.follow(false, &mut line);
        settle(&mut state, &mut line);
        let before = shown(&state);
        // Of two that follow each other neither is gone back to.
        for name in ["b.stl", "c.stl"] {
            state.open_file(name.into(), stl(60_000), &mut line);
            until_opened(&mut state, &mut line, name);
            assert_eq!(state.settings.keep, Keep::Largest);
            state.follow(false, &mut line);
        }
        let effect = if ends { state.cancel(&mut line) } else { state.engine_failed("x", &mut line) };
        assert_eq!(effect, Some(Effect::Opened));
        let notice = &state.notices.newest().unwrap().text;
        assert!(notice.contains(if ends { "cancelled" } else { "c.stl" }), "{notice}");
        assert_eq!((state.document.as_ref().unwrap().name.as_str(), shown(&state)), ("z.stl", before));
        assert_eq!(state.settings.keep, Keep::Component(1));
        assert!(state.history.can_undo(), "its steps are there again");
        state.settings.smoothing.iterations = 20;
        state.follow(false, &mut line);
        settle(&mut state, &mut line);
        agrees(&state);
    }
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
fn a_notice_gives_way_to_work_that_is_waited_for_and_not_to_numbers_that_follow() {
    let mut state = State::default();
    state.tell("Presenting.");
    for stage in Stage::ALL {
        state.work = Some((Work::Stage(stage), 0.5));
        let follows = stage > Stage::Deviation && stage < Stage::Faults;
        assert_eq!(state.told_work().is_none(), follows, "{stage:?}");
    }
    state.work = Some((Work::Reading, 0.5));
    assert_eq!(state.told_work(), state.work);
    state.notices.clear();
    state.work = Some((Work::Stage(Stage::Measures), 0.5));
    assert_eq!(state.told_work(), state.work);
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
        state.undo(&mut line);
        state.follow(false, &mut line);
        settle(&mut state, &mut line);
        agrees(&state);
    }
}

#[test]
fn another_unit_of_a_file_is_a_step_to_undo_at_once() {
    let (mut state, mut line) = start();
    let across = |state: &State| {
        let corners = &state.document.as_ref().unwrap().opened.positions;
        corners.iter().fold(0.0_f32, |most, corner| most.max(corner[0]))
    };
    let before = across(&state);
    state.set_unit(Some(Unit::Centimetre), &mut line);
    state.follow(false, &mut line);
    assert!(state.history.can_undo(), "while it is read");
    settle(&mut state, &mut line);
    state.follow(false, &mut line);
    assert!((across(&state) / before - 10.0).abs() < 1e-4);
    state.undo(&mut line);
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    assert_eq!(across(&state), before);
    state.redo(&mut line);
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    assert!((across(&state) / before - 10.0).abs() < 1e-4);
    // Another file has its own unit; no step back reads it in another.
    state.open_file("b.obj".into(), b"v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n".to_vec(), &mut line);
    settle(&mut state, &mut line);
    while state.history.can_undo() {
        state.undo(&mut line);
        state.follow(false, &mut line);
        assert!(state.opening().is_none());
    }
}

#[test]
fn undo_of_a_typed_value_that_was_not_recorded() {
    let (mut state, mut line) = start();
    state.settings.target = Target::Reduction(500);
    state.follow(false, &mut line);
    state.settings.target = Target::Reduction(600);
    state.follow(true, &mut line);
    state.undo(&mut line);
    assert_eq!(state.settings.target, Target::Reduction(500));
    state.redo(&mut line);
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
    assert!(
        state.notices.newest().is_some_and(|notice| notice.kind == Kind::Wrong && notice.text.starts_with("b.stl: "))
    );
}

#[test]
fn samples_have_the_triangles_that_are_asked_for_within_what_they_can_have() {
    for (asked, wanted) in [(0, phantom::MIN_TRIANGLES), (5_000, 5_000), (20_000, 20_000)] {
        let (mut state, mut line) = (State::default(), Line::default());
        state.sample_triangles = Some(asked);
        state.open_sample(Sample::Coronary, &mut line);
        settle(&mut state, &mut line);
        let document = state.document.as_ref().unwrap();
        assert!(matches!(document.source, Source::Sample { triangles, .. } if triangles as usize == wanted), "{asked}");
        assert_eq!(document.import.triangles, phantom::generate(Sample::Coronary, wanted).unwrap().triangles.len());
    }
}

#[test]
fn more_triangles_than_a_sample_has_are_not_to_be_had() {
    for asked in [Sample::Aorta.default_triangles() as u32 + 1, u32::MAX] {
        let mut state = State { sample_triangles: Some(asked), ..State::default() };
        state.open_sample(Sample::Aorta, &mut Line::default());
        let source = &state.opening.last().unwrap().source;
        assert!(matches!(source, Source::Sample { triangles: 74_307, .. }), "{asked}");
    }
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
        state.undo(&mut line);
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
    let narrowing = crate::vessel::width::Narrowing {
        ratio: 0.0,
        at_mm: [0.0; 3],
        diameter_before_mm: 2.0,
        diameter_after_mm: 0.0,
        pinched_places: 1,
    };
    measured.report.narrowing = Some(narrowing);
    assert!(document.pinch().is_some());
    // A coarser level may open what a finer one had pinched: there it is not told.
    let opened = crate::vessel::width::Narrowing { ratio: 0.9, pinched_places: 0, ..narrowing };
    document.measured.as_mut().unwrap().report.narrowing = Some(opened);
    assert!(document.pinch().is_none());
    document.measured.as_mut().unwrap().report.narrowing = Some(narrowing);
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

#[test]
fn cuts_go_with_their_surface_and_come_back_with_it() {
    let (mut state, mut line) = start();
    let cuts = vec![Cut { end_mm: [1.0, 2.0, 3.0], at: None }];
    state.preparation.plan.cuts.clone_from(&cuts);
    state.follow(false, &mut line);
    state.open_file("b.stl".into(), stl(60_000), &mut line);
    until_opened(&mut state, &mut line, "b.stl");
    assert!(state.preparation.plan.cuts.is_empty());
    state.cancel(&mut line);
    settle(&mut state, &mut line);
    assert_eq!((&*state.document.as_ref().unwrap().name, &state.preparation.plan.cuts), ("z.stl", &cuts));
    // The same file in another unit has them still, another file has none, and none is to be had back there.
    state.set_unit(Some(Unit::Centimetre), &mut line);
    settle(&mut state, &mut line);
    assert_eq!(state.preparation.plan.cuts, cuts);
    state.open_file("c.stl".into(), stl(10_000), &mut line);
    settle(&mut state, &mut line);
    for _ in 0..3 {
        assert!(state.preparation.plan.cuts.is_empty());
        state.undo(&mut line);
        settle(&mut state, &mut line);
    }
}

#[test]
fn cuts_are_asked_for_again_where_an_engine_gave_up_and_of_one_that_has_stopped() {
    let (mut state, mut line) = start();
    state.preparation.shown = Some(Shown::Cuts);
    state.follow(false, &mut line);
    // Whatever else goes on, they are awaited: Escape gives them up.
    state.work = Some((Work::Stage(Stage::Measures), 0.5));
    state.follow(false, &mut line);
    assert!(state.awaits());
    state.receive(Event::Failed { message: "no more".to_owned() });
    settle(&mut state, &mut line);
    assert!(state.preparation.shown.is_none() && state.preparation.planned.is_none() && !state.is_busy());
    state.engine = super::Engine::Stopped;
    state.preparation.shown = Some(Shown::Cuts);
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    assert!(state.preparation.planned.is_some() && !state.is_busy());
}
