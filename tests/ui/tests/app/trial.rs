//! The trial, used as a user uses it: by buttons and keys. The engine is told what to say: what it computes is tested
//! elsewhere.

use std::sync::Arc;

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::{Gamepad, PlatformEvent};
use lumen::engine::trial::{TrialCommand, TrialComparison, TrialEvent};
use lumen::io::import_mesh;
use lumen::phantom::{Sample, generate};
use lumen::pipeline::settings::{Settings, Smoothing};
use lumen::trial::course::Course;
use lumen::trial::frame::{Frame, Progress, Touch};
use lumen::trial::report::{StepCounts, StepKind, StepReport};
use lumen::trial::setup::{Entry, Input, Setup};
use lumen::trial::stopwatch::StationResult;
use lumen::trial::summary::Summary;
use lumen::trial::wire::Wire;
use lumen_ui_tests::told::{
    App, DESKTOP, FIRST, PHONE, as_the_paper, asked, at_entry, choose, ended, frame, id_of_start, now, on,
    open_coronary, press, put_on, ready, refused, retarget, says, start, tell, wait,
};
use lumen_ui_tests::{app, settle};

/// What is offered where smoothing left no room for the wire.
const ADAPT: &str = "Adapt smoothing to the calibre and start";

#[test]
fn the_trial_starts_with_the_level_that_is_shown_and_its_views_take_the_place_of_the_others() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    press(&mut harness, "Start trial");
    let commands = asked(&memory);
    let Some(TrialCommand::Start { id, mesh, sample, setup }) = commands.first() else { panic!("{commands:?}") };
    assert!((7_429..=7_430).contains(&mesh.triangles.len()), "Table II at 90 %: {}", mesh.triangles.len());
    assert_eq!((*sample, setup), (Some(Sample::Aorta), &Setup { proposes_wire: true, ..Setup::default() }));
    tell(&mut harness, &memory, [TrialEvent::Preparing { id: *id, fraction: 0.4 }]);
    assert!(says(&harness, "Finding"));
    tell(&mut harness, &memory, [ready(*id), now(*id, frame())]);
    for view in ["Trial view", "Fluoroscopy view", "Tip view"] {
        assert!(harness.query_by_role_and_label(Role::Image, view).is_some(), "{view}");
    }
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_none());
    for number in ["12.3 cm", "42.0 mm", "1:15.0 min", "0.350 N", "-0.200 N", "812 a second"] {
        assert!(says(&harness, number), "{number}");
    }
    press(&mut harness, "Close");
    assert_eq!(asked(&memory), [TrialCommand::Stop]);
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_some());
}

#[test]
fn keys_drive_while_they_are_held_and_nothing_does_when_all_are_let_go() {
    let (mut harness, memory) = on(DESKTOP);
    let drive = |feed, roll| TrialCommand::Drive(Input { feed, roll });
    let half_a_turn = std::f32::consts::PI;
    for (key, feed, roll) in [
        (Key::W, 15.0, 0.0),
        (Key::S, -15.0, 0.0),
        (Key::A, 0.0, -half_a_turn),
        (Key::D, 0.0, half_a_turn),
        (Key::ArrowUp, 15.0, 0.0),
        (Key::ArrowDown, -15.0, 0.0),
        (Key::ArrowLeft, 0.0, -half_a_turn),
        (Key::ArrowRight, 0.0, half_a_turn),
    ] {
        harness.key_down(key);
        harness.run_steps(3);
        let mut commands = asked(&memory);
        commands.dedup();
        assert_eq!(commands, [drive(feed, roll)], "{key:?}");
        harness.key_up(key);
        harness.run_steps(3);
        assert_eq!(asked(&memory), [drive(0.0, 0.0)], "{key:?}");
    }
    harness.key_down_modifiers(egui::Modifiers::SHIFT, Key::W);
    harness.run_steps(3);
    assert_eq!(asked(&memory).first(), Some(&drive(50.0, 0.0)), "with Shift");
    harness.event(egui::Event::WindowFocused(false));
    harness.input_mut().focused = false;
    harness.run_steps(3);
    assert_eq!(asked(&memory), [drive(0.0, 0.0)], "without the window's attention");
}

#[test]
fn pads_drive_by_pointer_and_by_two_fingers_at_once() {
    let (mut harness, memory) = on(PHONE);
    let place = |harness: &App, pad: &str| harness.get_by_role_and_label(Role::Slider, pad).rect();
    let (feed, roll) = (place(&harness, "Feed pad"), place(&harness, "Roll pad"));
    assert!(feed.height() >= 48.0 && feed.width() >= 120.0 && roll.width() >= 120.0, "{feed} {roll}");
    harness.drag_at(feed.right_center() - egui::vec2(10.0, 0.0));
    harness.run_steps(3);
    let Some(TrialCommand::Drive(input)) = asked(&memory).pop() else { panic!("nothing was asked") };
    assert!(input.feed > 45.0 && input.roll == 0.0, "{input:?}");
    harness.drop_at(feed.center());
    harness.run_steps(3);
    assert_eq!(asked(&memory).pop(), Some(TrialCommand::Drive(Input::default())));
    let touch = |harness: &mut App, finger: u64, phase, pos| {
        let (device_id, id) = (egui::TouchDeviceId(1), egui::TouchId(finger));
        harness.event(egui::Event::Touch { device_id, id, phase, pos, force: None });
        harness.run_steps(2);
    };
    touch(&mut harness, 1, egui::TouchPhase::Start, feed.left_center() + egui::vec2(10.0, 0.0));
    touch(&mut harness, 2, egui::TouchPhase::Start, roll.right_center() - egui::vec2(10.0, 0.0));
    let Some(TrialCommand::Drive(input)) = asked(&memory).pop() else { panic!("nothing was asked") };
    assert!(input.feed < -45.0 && input.roll > 10.0, "{input:?}");
    touch(&mut harness, 1, egui::TouchPhase::End, feed.center());
    touch(&mut harness, 2, egui::TouchPhase::End, roll.center());
    assert_eq!(asked(&memory).pop(), Some(TrialCommand::Drive(Input::default())));
}

#[test]
fn buttons_and_keys_ask_for_the_same() {
    let (mut harness, memory) = on(DESKTOP);
    let restart = |id| TrialCommand::Restart { id };
    let asks: [(&str, Key, [TrialCommand; 2]); 4] = [
        ("Autopilot", Key::G, [TrialCommand::Autopilot(true), TrialCommand::Autopilot(false)]),
        ("Pause", Key::P, [TrialCommand::Pause(true), TrialCommand::Pause(false)]),
        ("Slow motion", Key::M, [TrialCommand::Pace(0.25), TrialCommand::Pace(1.0)]),
        ("Restart", Key::R, [restart(FIRST + 1), restart(FIRST + 2)]),
    ];
    for (button, key, [first, second]) in asks {
        press(&mut harness, button);
        assert_eq!(asked(&memory), [first], "{button}");
        harness.key_press(key);
        harness.run_steps(3);
        assert_eq!(asked(&memory), [second], "{key:?}");
    }
    harness.key_press(Key::Z);
    harness.run_steps(3);
    assert_eq!(asked(&memory), [TrialCommand::StepBack { id: FIRST + 3 }]);
    assert!(harness.state().trial().run().unwrap().is_paused);
    harness.key_press(Key::Num2);
    harness.run_steps(3);
    assert!(says(&harness, "LAO 45"));
    assert_eq!(harness.state().trial().carm.lao, 45.0);
    let pedal = harness.state().trial().carm.is_on;
    harness.key_press(Key::Space);
    harness.run_steps(3);
    assert_ne!(harness.state().trial().carm.is_on, pedal);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(asked(&memory), [TrialCommand::Stop]);
    assert!(!harness.state().trial().is_open());
}

#[test]
fn views_are_drawn_only_where_they_change_and_a_trial_that_stands_asks_for_no_frames() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Pause");
    // Off the button, whose hint comes up by itself.
    harness.hover_at(egui::pos2(640.0, 20.0));
    harness.run_steps(20);
    let draws = |harness: &mut App, steps| {
        let before = harness.state().trial_draws();
        harness.run_steps(steps);
        harness.state().trial_draws() - before
    };
    assert_eq!(draws(&mut harness, 20), 0);
    let delay = |harness: &App| harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
    assert_eq!(delay(&harness), std::time::Duration::MAX, "no frame is asked for");
    let next = |step| now(FIRST, Frame { step, tip_direction: [0.0, 1.0, 0.0], ..frame() });
    memory.borrow_mut().trial_events.push_back(next(501));
    assert_eq!(draws(&mut harness, 20), 3, "each view once");
    harness.key_press(Key::Num2);
    assert_eq!(draws(&mut harness, 20), 1, "the C-arm turns");
    harness.key_press(Key::Space);
    memory.borrow_mut().trial_events.push_back(next(502));
    assert_eq!(draws(&mut harness, 20), 2, "the last image stays");
    harness.ctx.set_theme(egui::Theme::Light);
    assert_eq!(draws(&mut harness, 20), 2, "X-rays have no theme");
    assert_eq!(delay(&harness), std::time::Duration::MAX);
    harness.key_press(Key::C);
    harness.run_steps(1);
    assert!(delay(&harness) < std::time::Duration::from_millis(100), "contrast flows");
    assert!(draws(&mut harness, 80) > 10);
    assert_eq!(draws(&mut harness, 20), 0, "nothing is left of it");
    assert_eq!(delay(&harness), std::time::Duration::MAX);
}

#[test]
fn a_trial_that_is_closed_gives_back_the_memory_of_its_views_and_can_be_started_again() {
    let (mut harness, memory) = on(DESKTOP);
    assert!(harness.state().trial_holds_memory());
    press(&mut harness, "Close");
    harness.run_steps(3);
    assert!(!harness.state().trial_holds_memory());
    start(&mut harness);
    let id = id_of_start(&asked(&memory));
    tell(&mut harness, &memory, [ready(id), now(id, frame())]);
    harness.run_steps(10);
    assert!(harness.state().trial_holds_memory() && harness.state().trial_draws() >= 3);
}

#[test]
fn a_hand_on_the_wire_takes_it_from_the_autopilot() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Autopilot");
    asked(&memory);
    harness.key_down(Key::W);
    harness.run_steps(3);
    let drive = TrialCommand::Drive(Input { feed: 15.0, roll: 0.0 });
    let mut commands = asked(&memory);
    commands.dedup();
    assert_eq!(commands, [TrialCommand::Autopilot(false), drive]);
}

#[test]
fn what_is_refused_is_said_and_what_stood_stands() {
    let (mut harness, memory) = on(DESKTOP);
    retarget(&mut harness);
    let commands = asked(&memory);
    let Some(TrialCommand::Start { id, setup, .. }) = commands.first() else { panic!("{commands:?}") };
    assert_eq!(setup.target, Some([1.0, 2.0, 3.0]));
    let message = "The lumen is thinner than the wire 31 mm along the way.".to_owned();
    tell(&mut harness, &memory, [refused(*id, &message, false)]);
    assert!(says(&harness, &message));
    assert!(harness.query_by_label(ADAPT).is_none(), "smoothing is not the reason");
    assert!(says(&harness, "12.3 cm"), "the trial before stands");
}

#[test]
fn the_wire_fits_into_the_coronary_arteries_with_no_button_pressed_before() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open_coronary(&mut harness);
    memory.borrow_mut().trial_runs = true;
    start(&mut harness);
    wait(&mut harness, |harness| harness.state().trial().session().is_some() || says(harness, "too thin"));
    assert!(harness.state().trial().session().is_some() && harness.query_by_label(ADAPT).is_none());
}

#[test]
fn where_smoothing_leaves_no_room_for_the_wire_less_of_it_is_offered_and_the_trial_starts_with_that() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open_coronary(&mut harness);
    as_the_paper(&mut harness);
    memory.borrow_mut().trial_runs = true;
    start(&mut harness);
    let is_refused = |harness: &App| says(harness, "The lumen is too thin for a wire of");
    wait(&mut harness, is_refused);
    asked(&memory);
    let before = harness.state().state().settings.clone();
    press(&mut harness, ADAPT);
    let smoothing = Smoothing { adapt: true, ..before.smoothing };
    assert_eq!(harness.state().state().settings, Settings { smoothing, ..before.clone() });
    assert!(
        !is_refused(&harness)
            && says(&harness, "Adapting the smoothing: the trial starts when the new level is there.")
    );
    assert!(asked(&memory).is_empty(), "not with the level before");
    wait(&mut harness, |harness| harness.state().trial().session().is_some());
    let commands = asked(&memory);
    let starts = commands.iter().filter(|command| matches!(command, TrialCommand::Start { .. }));
    assert_eq!(starts.count(), 1);
    assert!(harness.query_by_label(ADAPT).is_none());
    press(&mut harness, "Undo");
    assert_eq!(harness.state().state().settings, before, "one step");
}

#[test]
fn of_two_starts_the_first_goes_on_where_the_second_is_refused() {
    let (mut harness, memory) = on(DESKTOP);
    retarget(&mut harness);
    let second = id_of_start(&asked(&memory));
    harness.key_press(Key::R);
    harness.run_steps(3);
    assert!(asked(&memory).is_empty(), "what is on its way in begins at its entry");
    choose(&mut harness, "Wire");
    harness.get_by_label("0.014 in stiff").click();
    harness.run_steps(3);
    harness.key_press(Key::R);
    harness.run_steps(3);
    let third = id_of_start(&asked(&memory));
    assert!(FIRST < second && second < third);
    tell(&mut harness, &memory, [ready(second), now(second, Frame { inserted_mm: 55.0, ..frame() })]);
    tell(&mut harness, &memory, [refused(third, "The wire does not fit.", false)]);
    assert!(says(&harness, "The wire does not fit.") && says(&harness, "5.5 cm"));
    tell(&mut harness, &memory, [now(second, Frame { inserted_mm: 66.0, ..frame() })]);
    assert!(says(&harness, "6.6 cm"));
}

#[test]
fn a_level_that_is_no_longer_wanted_is_not_awaited() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    as_the_paper(&mut harness);
    put_on(&mut harness, &memory);
    press(&mut harness, "Restart");
    retarget(&mut harness);
    let id = id_of_start(&asked(&memory));
    tell(&mut harness, &memory, [refused(id, "The lumen is too thin.", true)]);
    memory.borrow_mut().runs = false;
    press(&mut harness, ADAPT);
    press(&mut harness, "Undo");
    memory.borrow_mut().runs = true;
    settle(&mut harness);
    assert!(asked(&memory).is_empty() && says(&harness, "0.0 cm"), "the trial before stands, at its entry");
}

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
    let is_new = |harness: &App| says(harness, "Wall force, up to 1 mN") && says(harness, "Push force, up to 1 mN");
    assert!(is_new(&harness));
    let late = Frame { step: 502, max_wall_force_n: 0.1, push_n: -1.3, ..frame() };
    tell(&mut harness, &memory, [now(FIRST, late), ended(FIRST, Summary { success: true, ..Summary::default() })]);
    assert!(
        is_new(&harness) && !says(&harness, "Success"),
        "what was under way at the restart belongs to the run before"
    );
    // What was felt in a step between two frames.
    let felt = |id| TrialEvent::Felt { id, touches: vec![Touch { at: [0.0; 3], triangle: 0, force: 0.03 }] };
    tell(&mut harness, &memory, [felt(FIRST)]);
    assert!(is_new(&harness));
    tell(&mut harness, &memory, [felt(FIRST + 1)]);
    assert!(says(&harness, "Wall force, up to 0.05 N"));
    let own = Frame { step: 1, max_wall_force_n: 0.3, push_n: 0.0, ..frame() };
    tell(&mut harness, &memory, [now(FIRST + 1, own)]);
    assert!(says(&harness, "Wall force, up to 0.5 N"));
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
    let touch = Touch { at: [0.0; 3], triangle: 0, force: 0.03 };
    tell(&mut harness, &memory, [TrialEvent::Felt { id: FIRST + 1, touches: vec![touch] }]);
    assert!(says(&harness, "Wall force, up to 0.05 N"));
    press(&mut harness, "Step back");
    assert!(says(&harness, "Wall force, up to 1 mN"), "what was felt since is taken back");
}

#[test]
fn steps_that_are_not_balanced_are_told() {
    let (mut harness, memory) = on(DESKTOP);
    let step_kinds = StepCounts { balanced: 750, braked: 200, waited: 50, ..StepCounts::default() };
    let report = StepReport { kind: StepKind::Waited, wanted_mm: 0.04, ..StepReport::default() };
    tell(&mut harness, &memory, [now(FIRST, Frame { step: 501, step_kinds, report, ..frame() })]);
    assert!(says(&harness, "25.0 %, now waiting") && says(&harness, "0.0 of 20.0 mm/s"));
}

#[test]
fn the_wire_is_proposed_and_named_until_another_is_chosen() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    start(&mut harness);
    let commands = asked(&memory);
    let Some(TrialCommand::Start { setup, .. }) = commands.last() else { panic!("{commands:?}") };
    assert!(setup.proposes_wire);
    let TrialEvent::Ready(mut ready) = ready(id_of_start(&commands)) else { panic!("it is ready") };
    ready.setup.wire = Wire::preset("035-j").unwrap();
    tell(&mut harness, &memory, [TrialEvent::Ready(ready)]);
    let is_as_proposed = |harness: &App| {
        let list = harness.get_by_role_and_label(Role::ComboBox, "Wire");
        assert_eq!(list.accesskit_node().value().as_deref(), Some("0.035 in J tip"));
        assert!(!says(harness, "Restart to try"));
    };
    let pick = |harness: &mut App, wire: &str| {
        choose(harness, "Wire");
        harness.get_by_label(wire).click();
        harness.run_steps(3);
    };
    is_as_proposed(&harness);
    pick(&mut harness, "0.014 in floppy");
    assert!(says(&harness, "Restart to try"));
    pick(&mut harness, "Proposed");
    is_as_proposed(&harness);
    pick(&mut harness, "0.014 in floppy");
    press(&mut harness, "Restart");
    let commands = asked(&memory);
    let Some(TrialCommand::Start { setup, .. }) = commands.first() else { panic!("{commands:?}") };
    assert!(setup.wire.name == "floppy" && !setup.proposes_wire);
}

#[test]
fn another_wire_takes_effect_on_restart() {
    let (mut harness, memory) = on(DESKTOP);
    choose(&mut harness, "Wire");
    harness.get_by_label("0.035 in J tip").click();
    harness.run_steps(3);
    assert!(asked(&memory).is_empty() && says(&harness, "Restart to try"));
    press(&mut harness, "Restart");
    let commands = asked(&memory);
    let Some(TrialCommand::Start { setup, .. }) = commands.first() else { panic!("{commands:?}") };
    assert!(setup.wire.name == "035-j" && !setup.proposes_wire);
}

#[test]
fn the_comparison_asks_for_the_surface_before_reduction_and_shows_its_verdict() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Compare with the unreduced surface");
    let commands = asked(&memory);
    let Some(TrialCommand::Compare { id, mesh }) = commands.first() else { panic!("{commands:?}") };
    // Table I of the paper.
    assert_eq!(mesh.triangles.len(), 74_307);
    let comparison = TrialComparison {
        verdict: "At 90 % this wire arrives; its tip path differs by 0.3 mm at most.".to_owned(),
        inserted_mm: vec![0.0, 50.0, 100.0],
        deviation_mm: vec![0.0, 0.3, 0.1],
        tip: vec![[0.0; 3], [0.0, 0.0, 50.0]],
        other_tip: vec![[0.0; 3], [0.3, 0.0, 50.0]],
        smallest_before_mm: 3.21,
        smallest_after_mm: 3.05,
        ..TrialComparison::default()
    };
    let compared = TrialEvent::Compared { id: *id, comparison: Box::new(comparison.clone()) };
    tell(&mut harness, &memory, [compared]);
    assert!(says(&harness, &comparison.verdict) && says(&harness, "3.05 mm, was 3.21 mm"));
}

#[test]
fn a_comparison_can_be_cancelled_alone_and_ends_with_its_trial() {
    let (mut harness, memory) = on(DESKTOP);
    let compare = "Compare with the unreduced surface";
    press(&mut harness, compare);
    let Some(TrialCommand::Compare { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    tell(&mut harness, &memory, [TrialEvent::Busy { id, fraction: 0.4 }]);
    assert!(says(&harness, "Comparing: 40 %"));
    press(&mut harness, "Cancel comparison");
    assert_eq!(asked(&memory), [TrialCommand::Cancel { id }]);
    assert!(says(&harness, "12.3 cm"), "the trial stands");
    // What the engine had told before it heard of that.
    let late = TrialComparison { verdict: "Too late.".to_owned(), ..TrialComparison::default() };
    tell(&mut harness, &memory, [TrialEvent::Compared { id, comparison: Box::new(late) }]);
    assert!(!says(&harness, "Too late."));
    press(&mut harness, compare);
    press(&mut harness, "Restart");
    assert!(!harness.state().trial().is_busy(), "the engine gives up comparing what is no more");
    let Some(TrialCommand::Restart { id }) = asked(&memory).pop() else { panic!("no restart") };
    tell(&mut harness, &memory, [now(id, frame())]);
    press(&mut harness, compare);
    let Some(TrialCommand::Compare { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    tell(&mut harness, &memory, [refused(id, "The wire does not fit.", false)]);
    assert!(says(&harness, "The wire does not fit.") && !harness.state().trial().is_busy());
}

#[test]
fn a_row_that_is_refused_says_why_and_the_tables_are_cancelled_without_the_trial() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Tables III and IV");
    harness.run_steps(3);
    let Some(TrialCommand::Measure { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    tell(&mut harness, &memory, [refused(id, "The lumen is too thin.", true)]);
    assert!(says(&harness, "10 %: The lumen is too thin."));
    let Some(TrialCommand::Measure { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    press(&mut harness, "Cancel tables");
    assert_eq!(asked(&memory), [TrialCommand::Cancel { id }]);
    assert!(says(&harness, "12.3 cm"), "the trial stands");
}

#[test]
fn the_tables_run_one_rate_after_another_and_can_be_cancelled() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    press(&mut harness, "Tables III and IV");
    let station = StationResult { simulation_ms: Some(8.0), ..StationResult::default() };
    let summary = Summary {
        success: true,
        initial_simulation_ms: 5.0,
        stations: vec![station; 5],
        wire: "stiff".to_owned(),
        entry: Some(Entry { at: [1.0, 2.0, 3.0], direction: [0.0, 0.0, 1.0] }),
        target: Some([4.0, 5.0, 6.0]),
        ..Summary::default()
    };
    // Table II of the paper.
    for (row, printed) in [66_875, 37_153, 18_576].into_iter().enumerate() {
        harness.run_steps(3);
        let commands = asked(&memory);
        let [TrialCommand::Measure { id, mesh, sample, setup }] = &commands[..] else { panic!("{commands:?}") };
        // What the first row proposes is what all are run with.
        let proposed = (false, summary.entry, summary.target);
        let with = (setup.proposes_wire, setup.entry, setup.target);
        assert_eq!(with, if row == 0 { (true, None, None) } else { proposed });
        assert!(row == 0 || setup.wire.name == "stiff");
        assert!((printed - 2..=printed).contains(&mesh.triangles.len()), "{}", mesh.triangles.len());
        assert_eq!(*sample, Some(Sample::Aorta));
        // Later rows tell of other places, which nothing is taken from.
        let mut told = Box::new(summary.clone());
        if row > 0 {
            (told.entry, told.target) = (None, Some([row as f32; 3]));
        }
        tell(&mut harness, &memory, [TrialEvent::Measured { id: *id, summary: told }]);
    }
    assert!(says(&harness, "yes (no)") && says(&harness, "yes (yes)"), "the paper's beside ours");
    press(&mut harness, "Cancel tables");
    harness.run_steps(3);
    asked(&memory);
    assert!(harness.query_by_role_and_label(Role::Button, "Cancel tables").is_none() && says(&harness, "Cancelled."));
    press(&mut harness, "Run again");
    harness.run_steps(3);
    assert!(matches!(&asked(&memory)[..], [TrialCommand::Measure { .. }]));
}

#[test]
fn a_click_on_the_vessel_picks_the_middle_of_its_lumen() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Pick target");
    let view = harness.get_by_role_and_label(Role::Image, "Trial view").rect();
    // The trunk of the aorta is in the middle of the view.
    for button in [true, false] {
        harness.hover_at(view.center());
        harness.event(egui::Event::PointerButton {
            pos: view.center(),
            button: egui::PointerButton::Primary,
            pressed: button,
            modifiers: egui::Modifiers::NONE,
        });
        harness.run_steps(2);
    }
    let commands = asked(&memory);
    let Some(TrialCommand::Start { mesh, setup, .. }) = commands.first() else { panic!("{commands:?}") };
    let target = lumen::mesh::Vec3::from(setup.target.expect("a target"));
    let wall = mesh.positions.iter().map(|p| p.distance(target)).fold(f32::INFINITY, f32::min);
    assert!(wall > 5.0 && wall < 15.0, "{wall} mm from the wall of a vessel of about 20 mm");
}

#[test]
fn the_log_is_saved_and_a_chosen_one_is_replayed() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Save log");
    assert_eq!(asked(&memory), [TrialCommand::Save]);
    let (csv, json) = ("# schema 1\n".to_owned(), "{\"schema\": 1}".to_owned());
    tell(&mut harness, &memory, [TrialEvent::Saved { csv: csv.clone(), json: json.clone() }]);
    assert_eq!(memory.borrow().pairs, 1, "the user is asked once");
    let offered = memory.borrow().offered.clone();
    assert_eq!(
        offered.iter().map(|(name, _)| &name[..]).collect::<Vec<_>>(),
        ["abdominal-aorta-trial.csv", "abdominal-aorta-trial.json"]
    );
    assert_eq!((&offered[0].1[..], &offered[1].1[..]), (csv.as_bytes(), json.as_bytes()));
    let message = "run.csv and run.json were saved in logs.".to_owned();
    memory.borrow_mut().events.push_back(PlatformEvent::Saved { message: message.clone() });
    harness.run_steps(3);
    assert!(says(&harness, &message));
    press(&mut harness, "Open log...");
    assert_eq!(memory.borrow().asked, 1);
    let chosen = PlatformEvent::Chosen { name: "log.csv".to_owned(), bytes: csv.clone().into_bytes() };
    memory.borrow_mut().events.push_back(chosen);
    harness.run_steps(3);
    let commands = asked(&memory);
    let [TrialCommand::Replay { csv: bytes, .. }] = &commands[..] else { panic!("{commands:?}") };
    assert_eq!(&bytes[..], csv.as_bytes());
}

#[test]
fn a_log_of_another_way_begins_a_trial_with_its_own_wire_and_way() {
    let mesh = Arc::new(import_mesh(generate(Sample::Aorta, 4000).unwrap(), "sample").mesh);
    let mut setup = Setup { wire: Wire::preset("stiff").unwrap(), ..Setup::default() };
    let course = Arc::new(Course::new(&mesh, Some(Sample::Aorta), &mut setup).unwrap());
    let mut run = lumen::trial::session::Trial::new(course, setup.clone()).unwrap();
    (0..20).for_each(|_| run.step());
    let csv = run.log().csv(20).unwrap();
    let (mut harness, memory) = on(DESKTOP);
    let chosen = PlatformEvent::Chosen { name: "log.csv".to_owned(), bytes: csv.clone().into_bytes() };
    press(&mut harness, "Open log...");
    memory.borrow_mut().events.push_back(chosen);
    harness.run_steps(3);
    let commands = asked(&memory);
    let [TrialCommand::Start { id, setup: asked_for, .. }] = &commands[..] else { panic!("{commands:?}") };
    assert_eq!(asked_for, &setup);
    tell(&mut harness, &memory, [ready(*id)]);
    let commands = asked(&memory);
    assert!(
        matches!(&commands[..], [TrialCommand::Replay { csv: bytes, .. }] if bytes[..] == *csv.as_bytes()),
        "{commands:?}"
    );
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
fn a_phone_has_all_controls_and_stacks_the_views() {
    let (harness, _) = on(PHONE);
    for button in ["Restart", "Autopilot", "Pause", "Slow motion", "Step back", "Close", "Fluoroscopy"] {
        let rect = harness.get_by_role_and_label(Role::Button, button).rect();
        assert!(rect.left() >= 0.0 && rect.right() <= PHONE[0] && rect.height() >= 26.0, "{button}: {rect}");
    }
    let view = |name| harness.get_by_role_and_label(Role::Image, name).rect();
    assert!(view("Trial view").bottom() <= view("Fluoroscopy view").top());
    assert!(harness.query_by_role_and_label(Role::ComboBox, "Wire").is_some());
}

/// The part of the window in which a view is, below its writing.
fn picture(harness: &mut App, view: &str) -> Vec<[u8; 4]> {
    let rect = harness.get_by_role_and_label(Role::Image, view).rect().shrink(2.0);
    let whole = harness.render().unwrap();
    let rows = rect.top() as u32 + 90..rect.bottom() as u32 - 30;
    rows.flat_map(|y| (rect.left() as u32..rect.right() as u32).map(move |x| (x, y)))
        .map(|(x, y)| whole.get_pixel(x, y).0)
        .collect()
}

#[test]
fn a_restart_shows_the_wire_at_its_entry_at_once_and_then_what_is_told() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    start(&mut harness);
    let id = id_of_start(&asked(&memory));
    tell(&mut harness, &memory, [ready(id), now(id, at_entry())]);
    let entry = picture(&mut harness, "Trial view");
    tell(&mut harness, &memory, [now(id, frame())]);
    assert!(picture(&mut harness, "Trial view") != entry);
    harness.key_down(Key::R);
    harness.step();
    assert!(picture(&mut harness, "Trial view") == entry, "not the wire of the run before, in no frame");
    harness.step();
    assert!(says(&harness, "0.0 cm") && !says(&harness, "12.3 cm"));
    // The same step, and a wire that lies otherwise.
    let told = Frame { nodes: frame().nodes, ..at_entry() };
    tell(&mut harness, &memory, [now(id + 1, told)]);
    assert!(picture(&mut harness, "Trial view") != entry, "what is told is shown");
}

#[test]
fn a_step_back_forgets_what_the_wall_has_felt_since() {
    let (mut harness, memory) = on(DESKTOP);
    let felt = |id, force| TrialEvent::Felt { id, touches: vec![Touch { at: [0.0; 3], triangle: 0, force }] };
    let before = picture(&mut harness, "Trial view");
    tell(&mut harness, &memory, [felt(FIRST, 0.9), now(FIRST, Frame { step: 900, ..frame() })]);
    assert!(picture(&mut harness, "Trial view") != before);
    harness.key_press(Key::Z);
    harness.run_steps(3);
    // All that was felt up to there is told again: nothing.
    tell(&mut harness, &memory, [now(FIRST + 1, frame())]);
    assert!(picture(&mut harness, "Trial view") == before);
    assert!(says(&harness, "Wall force, up to 0.5 N"), "that of the frame, 0.35 N");
}

#[test]
fn a_wire_at_its_entry_asks_for_no_frames() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    start(&mut harness);
    let id = id_of_start(&asked(&memory));
    tell(&mut harness, &memory, [ready(id), now(id, at_entry())]);
    harness.hover_at(egui::pos2(640.0, 20.0));
    harness.run_steps(30);
    let delay = |harness: &App| harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
    assert_eq!(delay(&harness), std::time::Duration::MAX);
    memory.borrow_mut().gamepad = Some(Gamepad::default());
    harness.run_steps(2);
    assert!(delay(&harness) <= std::time::Duration::from_millis(100), "a gamepad tells nothing by itself");
    memory.borrow_mut().gamepad = Some(Gamepad { feed: 1.0, ..Gamepad::default() });
    harness.run_steps(2);
    assert!(matches!(asked(&memory)[..], [TrialCommand::Drive(Input { feed: 15.0, .. }), ..]));
}

#[test]
fn another_surface_closes_the_tables_and_forgets_the_places_of_the_last() {
    let (mut harness, memory) = on(DESKTOP);
    retarget(&mut harness);
    let id = id_of_start(&asked(&memory));
    tell(&mut harness, &memory, [ready(id), now(id, at_entry())]);
    press(&mut harness, "Tables III and IV");
    let Some(TrialCommand::Measure { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    harness.key_press(Key::Escape);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    press(&mut harness, "Tables III and IV");
    assert!(says(&harness, "Initial fps"));
    asked(&memory);
    let bytes = lumen::io::write(&generate(Sample::Aorta, 4000).unwrap(), None, lumen::io::Format::Stl).unwrap();
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "b.stl".to_owned(), bytes });
    settle(&mut harness);
    assert_eq!(harness.state().state().document.as_ref().unwrap().name, "b.stl");
    assert!(!says(&harness, "Initial fps") && asked(&memory).contains(&TrialCommand::Cancel { id }));
    assert!(!harness.state().trial().is_busy());
    start(&mut harness);
    let commands = asked(&memory);
    let Some(TrialCommand::Start { setup, .. }) = commands.last() else { panic!("{commands:?}") };
    assert_eq!((setup.entry, setup.target), (None, None), "places in one vessel are nowhere in another");
}

/// Leaves pictures to look at in the target folder's `tmp`: all of them with `cargo xtask test --long`, else the phone's.
#[test]
fn pictures_of_the_trial() {
    let phone = [(PHONE, "phone", Sample::Aorta)].into_iter();
    let desktop = Sample::ALL.map(|sample| (DESKTOP, "desktop", sample)).into_iter();
    for (size, name, sample) in phone.chain(desktop.filter(|_| std::env::var_os("LUMEN_LONG").is_some())) {
        let (mut harness, memory) = app(size);
        settle(&mut harness);
        if sample == Sample::Coronary {
            open_coronary(&mut harness);
            as_the_paper(&mut harness);
        }
        memory.borrow_mut().trial_runs = true;
        start(&mut harness);
        harness.run_steps(5);
        if sample == Sample::Coronary {
            save(&mut harness, &format!("trial-{name}-{sample}-refused"));
            press(&mut harness, ADAPT);
            wait(&mut harness, |harness| harness.state().trial().session().is_some());
        }
        press(&mut harness, "Autopilot");
        harness.run_steps(600);
        save(&mut harness, &format!("trial-{name}-{sample}-on"));
        harness.key_press(Key::C);
        harness.key_press(Key::Num4);
        harness.run_steps(8);
        save(&mut harness, &format!("trial-{name}-{sample}-contrast"));
        harness.get_by_role_and_label(Role::CheckBox, "Roadmap").scroll_to_me();
        harness.run_steps(12);
        harness.get_by_role_and_label(Role::CheckBox, "Roadmap").click();
        harness.ctx.set_theme(egui::Theme::Light);
        harness.run_steps(60);
        save(&mut harness, &format!("trial-{name}-{sample}-roadmap"));
        press(&mut harness, "Compare with the unreduced surface");
        harness.run_steps(5);
        save(&mut harness, &format!("trial-{name}-{sample}-comparing"));
        wait(&mut harness, |harness| !harness.state().trial().is_busy());
        harness.run_steps(5);
        save(&mut harness, &format!("trial-{name}-{sample}-compared"));
        press(&mut harness, "Tables III and IV");
        harness.run_steps(60);
        save(&mut harness, &format!("trial-{name}-{sample}-tables"));
    }
}

fn save(harness: &mut App, name: &str) {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
    let picture = harness.render().unwrap();
    let colours: std::collections::BTreeSet<_> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.len() > 200, "{}", colours.len());
    let mut encoder = png::Encoder::new(std::fs::File::create(path).unwrap(), picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(picture.as_raw()).unwrap();
}
