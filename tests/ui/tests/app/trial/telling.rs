//! What is told of a trial: its forces, its steps, its end.

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use lumen::engine::trial::TrialEvent;
use lumen::trial::frame::{Frame, Progress, Touch};
use lumen::trial::report::{StepCounts, StepKind, StepReport};
use lumen::trial::summary::Summary;
use lumen_ui_tests::seen;
use lumen_ui_tests::told::{
    App, DESKTOP, FIRST, asked, at_entry, ended, frame, id_of_start, now, on, press, says, tell,
};

use super::unfold;

#[test]
fn the_end_is_said() {
    let (mut harness, memory) = on(DESKTOP);
    let arrived = Frame { progress: Progress::Arrived, ..frame() };
    let summary = Summary { success: true, time_s: 23.4, max_wall_force_n: 0.31, ..Summary::default() };
    tell(&mut harness, &memory, [now(FIRST, arrived), ended(FIRST, summary)]);
    assert!(says(&harness, "Success: the tip arrived after 23.4 s; largest wall force 0.310 N."));
    press(&mut harness, "Restart");
    assert!(!says(&harness, "Success"));
    let reason = "the wire buckled three times.".to_owned();
    let summary = Summary { reason, time_s: 61.0, ..Summary::default() };
    tell(&mut harness, &memory, [ended(FIRST + 1, summary)]);
    assert!(says(&harness, "Failed after 61.0 s: the wire buckled three times."));
}

#[test]
fn the_bars_of_forces_grow_with_the_largest_so_far() {
    let (mut harness, memory) = on(DESKTOP);
    assert!(says(&harness, "Wall force, up to 0.5 N") && says(&harness, "Push force, up to 0.2 N"));
    let held_back = Frame { step: 501, max_wall_force_n: 0.1, push_n: -1.3, ..frame() };
    tell(&mut harness, &memory, [now(FIRST, held_back)]);
    assert!(says(&harness, "Wall force, up to 0.5 N") && says(&harness, "Push force, up to 2 N"));
    press(&mut harness, "Restart");
    // Two runs are compared by eye: the scale stays.
    let is_same = |harness: &App| says(harness, "Wall force, up to 0.5 N") && says(harness, "Push force, up to 2 N");
    assert!(is_same(&harness));
    let late = Frame { step: 502, max_wall_force_n: 0.9, push_n: -3.0, ..frame() };
    tell(&mut harness, &memory, [now(FIRST, late), ended(FIRST, Summary { success: true, ..Summary::default() })]);
    assert!(
        is_same(&harness) && !says(&harness, "Success"),
        "what was under way at the restart belongs to the run before"
    );
    // What was felt in a step between two frames.
    let felt = |id| TrialEvent::Felt { id, touches: vec![Touch { at: [0.0; 3], triangle: 0, force: 0.9 }] };
    tell(&mut harness, &memory, [felt(FIRST)]);
    assert!(is_same(&harness));
    tell(&mut harness, &memory, [felt(FIRST + 1)]);
    assert!(says(&harness, "Wall force, up to 1 N"));
    let own = Frame { step: 1, max_wall_force_n: 1.3, push_n: 0.0, ..frame() };
    tell(&mut harness, &memory, [now(FIRST + 1, own)]);
    assert!(says(&harness, "Wall force, up to 2 N"));
}

#[test]
fn a_restart_shows_no_wire_of_before_and_a_step_back_no_force_of_later() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Restart");
    let shown = harness.state().trial().frame().cloned().unwrap();
    assert!(shown.nodes == at_entry().nodes && shown.step == 0, "{shown:?}");
    // The wire at the entry is of step 0, too, and is drawn all the same.
    harness.run_steps(3);
    let before = harness.state().trial_draws();
    let entry = Frame { step: 0, time_s: 0.0, push_n: 0.0, max_wall_force_n: 0.0, ..frame() };
    tell(&mut harness, &memory, [now(FIRST + 1, entry)]);
    assert!(harness.state().trial_draws() > before, "the wire at the entry is drawn");
    let touch = Touch { at: [0.0; 3], triangle: 0, force: 0.9 };
    tell(&mut harness, &memory, [TrialEvent::Felt { id: FIRST + 1, touches: vec![touch] }]);
    assert!(says(&harness, "Wall force, up to 1 N"));
    press(&mut harness, "Step back");
    assert!(says(&harness, "Wall force, up to 0.5 N"), "what was felt since is taken back");
}

#[test]
fn steps_that_are_not_balanced_are_told() {
    let (mut harness, memory) = on(DESKTOP);
    unfold(&mut harness);
    let step_kinds = StepCounts { balanced: 750, braked: 200, waited: 50, ..StepCounts::default() };
    let report = StepReport { kind: StepKind::Waited, wanted_mm: 0.04, ..StepReport::default() };
    tell(&mut harness, &memory, [now(FIRST, Frame { step: 501, step_kinds, report, ..frame() })]);
    assert!(says(&harness, "25.0 %, now waiting") && says(&harness, "0.0 of 20.0 mm/s"));
}

#[test]
fn a_trial_that_dies_is_told_and_the_surface_stays() {
    let (mut harness, memory) = on(DESKTOP);
    memory.borrow_mut().trial_failure = Some("no memory left".to_owned());
    harness.run_steps(3);
    assert!(says(&harness, "The trial stopped (no memory left)."));
    assert!(harness.state().state().document.as_ref().is_some_and(|document| document.shown.is_some()));
    press(&mut harness, "Start trial");
    id_of_start(&asked(&memory));
}

#[test]
fn a_fork_that_was_missed_is_gone_to_and_ringed_until_the_wire_is_back_at_its_entry() {
    let (mut harness, memory) = seen(|| on(DESKTOP));
    let view = harness.get_by_role_and_label(Role::Image, "Trial view").rect();
    // The part of a circle of 14 points about the middle of the view that is red.
    let ringed = |harness: &mut App| {
        let picture = harness.render().unwrap();
        let is_red = |i: &i32| {
            let angle = std::f32::consts::TAU * *i as f32 / 64.0;
            let at = view.center() + egui::vec2(14.0 * angle.cos(), 14.0 * angle.sin());
            let [red, green, blue, _] = picture.get_pixel(at.x as u32, at.y as u32).0.map(i32::from);
            red > green + 40 && red > blue + 40
        };
        (0..64).filter(is_red).count() as f64 / 64.0
    };
    // The parts of the fluoroscopy that are red: of the ring and its words alone.
    let red = |harness: &mut App| {
        let place = harness.get_by_role_and_label(Role::Image, "Fluoroscopy view").rect();
        let picture = harness.render().unwrap();
        let points = (place.top() as u32..place.bottom() as u32)
            .flat_map(|y| (place.left() as u32..place.right() as u32).map(move |x| (x, y)));
        let is_red = |&(x, y): &(u32, u32)| {
            let [red, green, blue, _] = picture.get_pixel(x, y).0.map(i32::from);
            red > green + 40 && red > blue + 40
        };
        points.filter(is_red).count()
    };
    // Off the way: nothing else is drawn there.
    let (fork, before) = ([12.0, 0.0, 70.0], *harness.state().camera());
    let reason = "the autopilot gave up: it missed the fork 31 mm along the route.".to_owned();
    let failed = |missed_fork_at| Summary { reason: reason.clone(), missed_fork_at, ..Summary::default() };
    tell(&mut harness, &memory, [ended(FIRST, failed(None))]);
    assert_eq!(*harness.state().camera(), before, "no fork was missed");
    assert_eq!(red(&mut harness), 0);
    tell(&mut harness, &memory, [ended(FIRST, failed(Some(fork)))]);
    let camera = *harness.state().camera();
    assert!(camera.target.to_array() == fork && camera.distance < before.distance, "{camera:?}");
    assert!(ringed(&mut harness) > 0.7, "{}", ringed(&mut harness));
    // Two points wide, about a circle of 14.
    assert!(red(&mut harness) > 100, "{}", red(&mut harness));
    press(&mut harness, "Restart");
    assert_eq!(*harness.state().camera(), camera, "the view stays");
    assert!(ringed(&mut harness) < 0.2, "{}", ringed(&mut harness));
    assert_eq!(red(&mut harness), 0);
}
