//! The app's state and an engine on one line, slice by slice: what overtakes what.

use std::collections::VecDeque;
use std::time::Duration;

use super::State;
use crate::engine::{Command, Engine, Event, Link};
use crate::io::Format;
use crate::phantom::{self, Sample};
use crate::pipeline::settings::{Keep, Target};

/// A line on which commands lie until the next slice.
#[derive(Default)]
struct Line {
    engine: Engine,
    sent: VecDeque<Command>,
    restarts: u32,
}

impl Line {
    fn deliver(&mut self) {
        while let Some(c) = self.sent.pop_front() {
            self.engine.handle(c);
        }
    }

    fn slice(&mut self) -> bool {
        self.deliver();
        self.engine.advance(Duration::from_millis(8))
    }
}

impl Link for Line {
    fn send(&mut self, c: Command) {
        self.sent.push_back(c);
    }

    fn poll(&mut self) -> Option<Event> {
        self.engine.poll()
    }

    fn restart(&mut self) {
        self.engine = Engine::new();
        self.sent.clear();
        self.restarts += 1;
    }

    fn failure(&mut self) -> Option<String> {
        None
    }
}

fn hear(s: &mut State, l: &mut Line) {
    while let Some(e) = l.poll() {
        s.receive(e);
    }
}

fn settle(s: &mut State, l: &mut Line) {
    for _ in 0..20000 {
        let more = l.slice();
        hear(s, l);
        s.follow(false, l);
        if !more && l.sent.is_empty() {
            return;
        }
    }
    panic!("no end");
}

fn stl(n: usize) -> Vec<u8> {
    crate::io::write(&phantom::generate(Sample::Aorta, n).unwrap(), None, Format::Stl).unwrap()
}

fn start() -> (State, Line) {
    let (mut s, mut l) = (State::default(), Line::default());
    s.open_file("z.stl".into(), stl(10_000), &mut l);
    settle(&mut s, &mut l);
    assert!(s.document.as_ref().unwrap().measured.is_some());
    (s, l)
}

fn agrees(s: &State) {
    let d = s.document.as_ref().unwrap();
    let m = d.measured.as_ref().unwrap();
    assert_eq!(m.report.settings, s.settings);
    assert_eq!(m.generation, s.generation());
    assert_eq!(m.report.input, d.name);
    assert_eq!(d.pieces.labels.len(), d.opened.triangles.len());
    assert!(!s.is_busy());
}

#[test]
fn numbers_are_current_after_a_second_file() {
    let (mut s, mut l) = start();
    s.settings.target = Target::Reduction(500);
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    s.open_file("b.stl".into(), stl(12_000), &mut l);
    settle(&mut s, &mut l);
    assert_eq!(s.document.as_ref().unwrap().name, "b.stl");
    agrees(&s);
}

#[test]
fn settings_moved_while_a_file_is_read_are_not_lost() {
    let (mut s, mut l) = start();
    s.settings.keep = Keep::Component(1);
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    s.open_file("b.stl".into(), stl(12_000), &mut l);
    s.settings.smoothing.iterations = 20;
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    agrees(&s);
    assert_eq!(s.settings.smoothing.iterations, 20);
    assert_eq!(s.settings.keep, Keep::Largest);
}

#[test]
fn settings_moved_while_the_first_file_is_read_are_not_lost() {
    let (mut s, mut l) = (State::default(), Line::default());
    s.open_file("z.stl".into(), stl(10_000), &mut l);
    s.settings.smoothing.iterations = 20;
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    agrees(&s);
}

#[test]
fn a_broken_file_opened_while_another_is_read() {
    let (mut s, mut l) = start();
    s.open_file("a.stl".into(), stl(12_000), &mut l);
    l.slice(); // a is read before the next command is heard
    s.open_file("b.stl".into(), vec![1, 2, 3], &mut l);
    settle(&mut s, &mut l);
    agrees(&s);
    assert_eq!(s.document.as_ref().unwrap().name, "a.stl");
}

#[test]
fn a_broken_file_opened_while_the_engine_starts_again() {
    let (mut s, mut l) = start();
    s.engine_failed("x", &mut l);
    s.open_file("b.stl".into(), vec![1, 2, 3], &mut l);
    settle(&mut s, &mut l);
    assert_eq!(s.document.as_ref().unwrap().name, "z.stl");
    s.settings.smoothing.iterations = 20;
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    agrees(&s);
}

#[test]
fn cancel_stops() {
    for stage in ["Smoothing", "Reducing", "Measuring deviation"] {
        let (mut s, mut l) = (State::default(), Line::default());
        s.open_file("z.stl".into(), stl(60_000), &mut l);
        loop {
            assert!(l.slice());
            hear(&mut s, &mut l);
            if s.work.is_some_and(|(w, _)| w.label() == stage) {
                break;
            }
        }
        s.cancel(&mut l);
        for _ in 0..50 {
            l.slice();
            hear(&mut s, &mut l);
            s.follow(false, &mut l);
        }
        assert!(!s.is_busy(), "{stage} goes on: {:?}", s.work);
        assert_eq!(s.document.is_some(), stage == "Measuring deviation", "{stage} goes on");
        let Some(document) = &s.document else {
            assert!(s.opening().is_none());
            continue;
        };
        assert!(document.measured.as_ref().is_none_or(|m| m.deviation.is_empty()), "{stage} goes on");
        s.settings.target = Target::Reduction(500);
        s.follow(false, &mut l);
        settle(&mut s, &mut l);
        agrees(&s);
    }
}

#[test]
fn settings_moved_before_the_cancel_is_answered() {
    let (mut s, mut l) = start();
    s.settings.smoothing.iterations = 20;
    s.follow(false, &mut l);
    l.slice();
    s.cancel(&mut l);
    s.settings.smoothing.iterations = 30;
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    agrees(&s);
}

#[test]
fn undo_does_not_bring_back_a_piece_of_another_file() {
    let (mut s, mut l) = start();
    s.settings.keep = Keep::Component(2);
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    s.settings.target = Target::Reduction(500);
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    s.open_file("b.obj".into(), b"v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n".to_vec(), &mut l);
    settle(&mut s, &mut l);
    while s.history.can_undo() {
        s.undo();
        s.follow(false, &mut l);
        settle(&mut s, &mut l);
        agrees(&s);
    }
}

#[test]
fn undo_of_a_typed_value_that_was_not_recorded() {
    let (mut s, mut l) = start();
    s.settings.target = Target::Reduction(500);
    s.follow(false, &mut l);
    s.settings.target = Target::Reduction(600);
    s.follow(true, &mut l);
    s.undo();
    assert_eq!(s.settings.target, Target::Reduction(500));
    s.redo();
    assert_eq!(s.settings.target, Target::Reduction(600));
}

#[test]
fn an_engine_that_cannot_start_is_left_alone() {
    let (mut s, mut l) = start();
    for _ in 0..50 {
        s.engine_failed("x", &mut l);
    }
    assert!(l.restarts <= 4, "{}", l.restarts);
    s.open_file("b.stl".into(), stl(12_000), &mut l);
    settle(&mut s, &mut l);
    agrees(&s);
}

#[test]
fn a_setting_that_changes_nothing_leaves_the_numbers() {
    let (mut s, mut l) = start();
    s.settings.smoothing.iterations = 0;
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    agrees(&s);
    s.settings.smoothing.pass_band = 0.5;
    s.follow(false, &mut l);
    settle(&mut s, &mut l);
    agrees(&s);
}
