//! A trial that is told what to say, and the app with one on: what the engine computes is tested elsewhere.

use std::cell::RefCell;
use std::rc::Rc;

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use lumen::app::LumenApp;
use lumen::engine::trial::{RouteShown, TrialCommand, TrialEvent, TrialReady};
use lumen::trial::frame::Frame;
use lumen::trial::route::{PlaceName, WayEnd};
use lumen::trial::setup::{Entry, Setup};
use lumen::trial::summary::Summary;
use lumen_message::Told;

pub use crate::{DESKTOP, PHONE, says};
use crate::{Memory, app, settle, settle_wholly};

/// The app under test.
pub type App = Harness<'static, LumenApp>;

/// Presses a button, wherever in the panel it is.
pub fn press(harness: &mut App, button: &str) {
    harness.get_by_role_and_label(Role::Button, button).scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::Button, button).click();
    harness.run_steps(3);
}

/// Opens the coronary sample by the bar.
pub fn open_coronary(harness: &mut App) {
    press(harness, "Sample");
    harness.get_by_label_contains("oronary").click();
    harness.run_steps(3);
    settle(harness);
}

/// Smooths as the paper does: thin vessels lose their calibre.
pub fn as_the_paper(harness: &mut App) {
    choose(harness, "Strength");
    harness.get_by_label("The paper's").click();
    harness.run_steps(3);
    settle(harness);
}

/// Starts a trial by the bar, or by the menu that has its tabs.
pub fn start(harness: &mut App) {
    for menu in ["Prepare", "Menu"] {
        let is_there = |name| harness.query_all_by_role_and_label(Role::Button, name).next().is_some();
        if !is_there("Trial") && is_there(menu) {
            press(harness, menu);
        }
    }
    press(harness, "Trial");
}

/// Opens a list.
pub fn choose(harness: &mut App, list: &str) {
    harness.get_by_role_and_label(Role::ComboBox, list).scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::ComboBox, list).click();
    harness.run_steps(3);
}

/// What the trial was asked since it was last asked for.
pub fn asked(memory: &Rc<RefCell<Memory>>) -> Vec<TrialCommand> {
    std::mem::take(&mut memory.borrow_mut().asked_of_trial)
}

/// Lets the trial say this.
pub fn tell(harness: &mut App, memory: &Rc<RefCell<Memory>>, events: impl IntoIterator<Item = TrialEvent>) {
    memory.borrow_mut().trial_events.extend(events);
    harness.run_steps(3);
}

/// Steps until it is so.
///
/// # Panics
/// When that takes too long.
pub fn wait(harness: &mut App, is_so: impl Fn(&App) -> bool) {
    for _ in 0..4000 {
        if is_so(harness) {
            return;
        }
        harness.step();
    }
    panic!("it does not come to be");
}

/// A way through the middle of the sample.
pub fn ready(id: u64) -> TrialEvent {
    let points: Vec<[f32; 3]> = (0..100).map(|i| [0.0, 0.0, i as f32]).collect();
    let entry = Entry { at: points[0], direction: [0.0, 0.0, 1.0] };
    let setup = Setup { entry: Some(entry), target: points.last().copied(), ..Setup::default() };
    let route = RouteShown {
        radii: vec![8.0; points.len()],
        stations: vec![points[20], points[40]],
        length_mm: 99.0,
        points,
        ..RouteShown::default()
    };
    let renal = PlaceName::Target { branch: 4, end: WayEnd::Closed, diameter_mm: 5.0, away_mm: 120.0 };
    let targets = vec![(renal, [1.0, 2.0, 3.0])];
    TrialEvent::Ready(Box::new(TrialReady {
        id,
        setup,
        route,
        entries: vec![(PlaceName::Entry { branch: 1, diameter_mm: 9.0 }, entry)],
        targets,
        ..TrialReady::default()
    }))
}

/// The number of the first trial of an app.
pub const FIRST: u64 = 1;

/// The wire now.
pub fn now(id: u64, frame: Frame) -> TrialEvent {
    TrialEvent::Frame { id, frame: Box::new(frame) }
}

/// Words that no language has.
pub fn told(words: &str) -> Told {
    Told::new("", Vec::new(), words.to_owned())
}

/// The end of a trial.
pub fn ended(id: u64, summary: Summary) -> TrialEvent {
    let end = told(&summary.reason);
    TrialEvent::Ended { id, summary: Box::new(summary), end }
}

/// A wire on its way.
pub fn frame() -> Frame {
    Frame {
        step: 500,
        time_s: 75.0,
        nodes: (0..30).map(|i| [0.0, 0.0, 30.0 - i as f32]).collect(),
        tip_direction: [0.0, 0.0, 1.0],
        tip_side: [1.0, 0.0, 0.0],
        inserted_mm: 123.4,
        max_wall_force_n: 0.35,
        push_n: -0.2,
        target_mm: 42.0,
        steps_per_second: 812.0,
        ..Frame::default()
    }
}

/// What cannot be done, and why.
pub fn refused(id: u64, message: &str, is_too_thin: bool) -> TrialEvent {
    TrialEvent::Refused { id, message: message.to_owned(), is_too_thin, at: None }
}

/// The number of the newest start.
///
/// # Panics
/// When there is none.
pub fn id_of_start(commands: &[TrialCommand]) -> u64 {
    match commands.iter().rev().find(|command| matches!(command, TrialCommand::Start { .. })) {
        Some(TrialCommand::Start { id, .. }) => *id,
        _ => panic!("no start among {} commands", commands.len()),
    }
}

/// The wire at its entry.
pub fn at_entry() -> Frame {
    let nodes = (0..10).map(|i| [0.0, 0.0, 10.0 - i as f32]).collect();
    Frame { nodes, tip_direction: [0.0, 0.0, 1.0], tip_side: [1.0, 0.0, 0.0], ..Frame::default() }
}

/// Chooses another target, to which a trial starts.
pub fn retarget(harness: &mut App) {
    choose(harness, "Target");
    harness.get_by_label("branch 5, closed end, 5.0 mm, 120 mm away").click();
    harness.run_steps(3);
}

/// The app with a trial on: the wire at its entry, and then on its way.
///
/// # Panics
/// When it does not start.
pub fn on(size: [f32; 2]) -> (App, Rc<RefCell<Memory>>) {
    let (mut harness, memory) = app(size);
    put_on(&mut harness, &memory);
    (harness, memory)
}

/// Starts the first trial, in the level that auto has come to (with one that follows *Restart* would take that), and tells
/// that its wire is under way.
pub fn put_on(harness: &mut App, memory: &Rc<RefCell<Memory>>) {
    settle_wholly(harness);
    start(harness);
    assert_eq!(id_of_start(&asked(memory)), FIRST);
    tell(harness, memory, [ready(FIRST), now(FIRST, at_entry()), now(FIRST, frame())]);
}
