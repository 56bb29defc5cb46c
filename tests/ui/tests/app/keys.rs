//! The keyboard: what is on top has it, Escape takes off one thing at a time, and a hand that is not seen is at rest.

use std::time::Duration;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use lumen::app::PlatformEvent;
use lumen::engine::trial::{TrialCommand, TrialEvent};
use lumen::pipeline::settings::Target;
use lumen::trial::setup::Input;
use lumen::trial::summary::Summary;
use lumen_ui_tests::told::{App, DESKTOP, asked, choose, on, press, says};
use lumen_ui_tests::{app, app_at, hide, settle, settle_wholly};

fn escape(harness: &mut App) {
    harness.key_press(Key::Escape);
    harness.run_steps(3);
}

/// What the trial was told of the hand, without what only says it again.
fn driven(commands: Vec<TrialCommand>) -> Vec<Input> {
    let mut inputs: Vec<Input> = commands
        .into_iter()
        .filter_map(|command| if let TrialCommand::Drive(input) = command { Some(input) } else { None })
        .collect();
    inputs.dedup();
    inputs
}

const FEED: Input = Input { feed: 15.0, roll: 0.0 };
const REST: Input = Input { feed: 0.0, roll: 0.0 };

#[test]
fn escape_closes_an_open_list_and_then_the_trial() {
    let (mut harness, _) = on(DESKTOP);
    choose(&mut harness, "Wire");
    assert!(harness.query_by_label("0.014 in stiff").is_some());
    escape(&mut harness);
    assert!(harness.query_by_label("0.014 in stiff").is_none() && harness.state().trial().is_open());
    press(&mut harness, "Sample");
    assert!(harness.query_by_label_contains("oronary").is_some());
    escape(&mut harness);
    assert!(harness.query_by_label_contains("oronary").is_none() && harness.state().trial().is_open());
    escape(&mut harness);
    assert!(!harness.state().trial().is_open());
}

#[test]
fn escape_ends_picking_and_then_the_trial() {
    let (mut harness, _) = on(DESKTOP);
    press(&mut harness, "Pick target");
    assert!(says(&harness, "Click the vessel where it should go."));
    escape(&mut harness);
    assert!(!says(&harness, "Click the vessel") && harness.state().trial().is_open());
    escape(&mut harness);
    assert!(!harness.state().trial().is_open());
}

#[test]
fn escape_closes_the_sheet_then_the_tables_then_the_trial() {
    let (mut harness, _) = on(DESKTOP);
    press(&mut harness, "Tables III and IV");
    assert!(says(&harness, "Initial fps"));
    harness.key_press(Key::F1);
    harness.run_steps(3);
    assert!(says(&harness, "Keys and gestures"));
    escape(&mut harness);
    assert!(!says(&harness, "Keys and gestures") && says(&harness, "Initial fps"));
    escape(&mut harness);
    assert!(!says(&harness, "Initial fps") && harness.state().trial().is_open());
    escape(&mut harness);
    assert!(!harness.state().trial().is_open());
}

#[test]
fn escape_leaves_a_field_that_is_typed_into_and_then_the_trial() {
    let (mut harness, _) = on(DESKTOP);
    harness.get_by_role_and_label(Role::SpinButton, "Seed").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::SpinButton, "Seed").click();
    harness.run_steps(3);
    harness.event(Event::Text("7".to_owned()));
    harness.run_steps(2);
    assert!(harness.ctx.text_edit_focused());
    escape(&mut harness);
    assert!(harness.state().trial().is_open(), "the field alone is left");
    escape(&mut harness);
    assert!(!harness.state().trial().is_open());
}

#[test]
fn escape_cancels_what_is_going_on_before_it_closes_the_trial_and_leaves_the_comparison_last() {
    let (mut harness, memory) = on(DESKTOP);
    memory.borrow_mut().slice = Duration::ZERO;
    press(&mut harness, "Sample");
    harness.get_by_label_contains("oronary").click();
    harness.run_steps(5);
    let is_opening = |harness: &App| {
        let state = harness.state().state();
        state.opening().is_some() || state.awaits_levels()
    };
    assert!(is_opening(&harness));
    escape(&mut harness);
    assert!(!is_opening(&harness) && harness.state().trial().is_open());
    assert_eq!(harness.state().state().document.as_ref().unwrap().name, "Abdominal aorta");
    // Another engine takes up the surface that is shown.
    memory.borrow_mut().slice = Duration::from_millis(50);
    // Escape would cancel what it does in the background.
    settle_wholly(&mut harness);
    harness.run_steps(10);
    settle(&mut harness);
    assert!(harness.state().trial().is_open());
    escape(&mut harness);
    assert!(!harness.state().trial().is_open());
    press(&mut harness, "Compare");
    assert!(harness.state().state().comparison.is_open());
    choose(&mut harness, "Show as");
    escape(&mut harness);
    assert!(harness.state().state().comparison.is_open());
    while harness.state().state().is_busy() {
        harness.step();
    }
    escape(&mut harness);
    assert!(!harness.state().state().comparison.is_open());
}

#[test]
fn keys_do_not_reach_the_wire_under_a_sheet_or_an_open_list() {
    let (mut harness, memory) = on(DESKTOP);
    harness.key_press(Key::F1);
    harness.run_steps(3);
    harness.key_down(Key::W);
    harness.run_steps(3);
    assert_eq!(driven(asked(&memory)), []);
    harness.key_press(Key::P);
    harness.run_steps(3);
    assert_eq!(asked(&memory), []);
    harness.key_up(Key::W);
    escape(&mut harness);
    choose(&mut harness, "Wire");
    harness.key_down(Key::W);
    harness.run_steps(3);
    assert_eq!(driven(asked(&memory)), []);
    harness.key_press(Key::P);
    harness.run_steps(3);
    assert_eq!(asked(&memory), []);
    harness.key_up(Key::W);
    escape(&mut harness);
    harness.key_down(Key::W);
    harness.run_steps(3);
    assert_eq!(driven(asked(&memory)), [FEED]);
    harness.key_press(Key::F1);
    harness.run_steps(3);
    assert_eq!(driven(asked(&memory)), [FEED, REST], "a sheet comes over a hand that is on the wire");
}

#[test]
fn a_hand_on_the_wire_is_told_again_and_again() {
    let (mut harness, memory) = on(DESKTOP);
    harness.key_down(Key::W);
    harness.run_steps(8);
    let commands = asked(&memory);
    // Two seconds: eight frames of a quarter.
    assert!(commands.len() >= 8 && driven(commands.clone()) == [FEED], "{commands:?}");
    harness.key_up(Key::W);
    harness.run_steps(8);
    assert_eq!(asked(&memory).iter().filter(|command| **command == TrialCommand::Drive(REST)).count(), 1);
}

#[test]
fn a_hidden_window_lets_go_of_the_wire() {
    let (mut harness, memory) = on(DESKTOP);
    harness.key_down(Key::W);
    harness.run_steps(3);
    assert_eq!(driven(asked(&memory)), [FEED]);
    hide(&mut harness, 3);
    assert_eq!(asked(&memory), [TrialCommand::Drive(REST)], "without a frame");
}

#[test]
fn a_pad_that_was_held_when_the_window_lost_attention_is_let_go() {
    let (mut harness, memory) = on(DESKTOP);
    let pad = harness.get_by_role_and_label(Role::Slider, "Feed pad").rect();
    let end = pad.right_center() - egui::vec2(10.0, 0.0);
    harness.drag_at(end);
    harness.run_steps(3);
    assert!(matches!(driven(asked(&memory))[..], [Input { feed: 40.0.., .. }]));
    hide(&mut harness, 2);
    assert_eq!(asked(&memory), [TrialCommand::Drive(REST)]);
    // Shown again; that the button came up elsewhere was not heard.
    harness.run_steps(3);
    assert_eq!(asked(&memory), []);
    harness.drop_at(end);
    harness.drag_at(end);
    harness.run_steps(3);
    assert!(matches!(driven(asked(&memory))[..], [Input { feed: 40.0.., .. }]), "pressed anew");
    // A finger too.
    harness.drop_at(end);
    harness.run_steps(3);
    let touch = |phase, pos| {
        let (device_id, id) = (egui::TouchDeviceId(1), egui::TouchId(1));
        Event::Touch { device_id, id, phase, pos, force: None }
    };
    harness.event(touch(egui::TouchPhase::Start, end));
    harness.run_steps(3);
    asked(&memory);
    hide(&mut harness, 2);
    assert_eq!(asked(&memory), [TrialCommand::Drive(REST)]);
    harness.run_steps(3);
    assert_eq!(asked(&memory), []);
    harness.event(touch(egui::TouchPhase::End, end));
    harness.event(touch(egui::TouchPhase::Start, end));
    harness.run_steps(3);
    assert!(matches!(driven(asked(&memory))[..], [Input { feed: 40.0.., .. }]), "put down anew");
}

#[test]
fn a_hidden_window_goes_on_listening() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Tables III and IV");
    let Some(TrialCommand::Measure { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    memory.borrow_mut().trial_events.push_back(TrialEvent::Measured { id, summary: Box::new(Summary::default()) });
    hide(&mut harness, 1);
    assert!(matches!(asked(&memory)[..], [TrialCommand::Measure { .. }]), "the next row");
    memory.borrow_mut().trial_failure = Some("no memory left".to_owned());
    memory.borrow_mut().engine_failure = Some("no memory left".to_owned());
    hide(&mut harness, 1);
    assert_eq!(memory.borrow().engines, 2, "another engine");
    let bytes = b"v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3\n".to_vec();
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "one.obj".to_owned(), bytes });
    hide(&mut harness, 50);
    assert_eq!(harness.state().state().document.as_ref().unwrap().name, "one.obj");
    assert!(!harness.state().state().is_busy());
}

#[test]
fn a_held_key_switches_once() {
    let (mut harness, memory) = on(DESKTOP);
    let hold = |harness: &mut App, key| {
        (0..6).for_each(|_| harness.key_down(key));
        harness.run_steps(2);
        harness.key_up(key);
        harness.run_steps(2);
    };
    hold(&mut harness, Key::P);
    assert_eq!(asked(&memory), [TrialCommand::Pause(true)]);
    let pedal = harness.state().trial().open().unwrap().carm.is_on;
    hold(&mut harness, Key::Space);
    assert_ne!(harness.state().trial().open().unwrap().carm.is_on, pedal);
    hold(&mut harness, Key::F1);
    assert!(says(&harness, "Keys and gestures"));
    hold(&mut harness, Key::F1);
    assert!(!says(&harness, "Keys and gestures"));
    escape(&mut harness);
    let theme = harness.ctx.theme();
    hold(&mut harness, Key::T);
    assert_ne!(harness.ctx.theme(), theme);
    hold(&mut harness, Key::C);
    assert!(harness.state().state().comparison.is_open());
}

#[test]
fn each_step_of_a_control_that_has_the_focus_is_undone_by_itself() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    harness.get_by_role_and_label(Role::Slider, "Reduction").focus();
    harness.run_steps(2);
    let target = |harness: &App| harness.state().state().settings.target;
    let mut stood = vec![target(&harness)];
    for _ in 0..3 {
        harness.key_press(Key::ArrowLeft);
        harness.run_steps(2);
        stood.push(target(&harness));
    }
    assert!(stood.windows(2).all(|pair| pair[0] != pair[1]), "{stood:?}");
    for before in stood.iter().rev().skip(1) {
        harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        harness.run_steps(2);
        assert_eq!(target(&harness), *before, "of {stood:?}");
    }
    // A key that is held is one step, as a drag is.
    (0..5).for_each(|_| harness.key_down(Key::ArrowLeft));
    harness.run_steps(2);
    harness.key_up(Key::ArrowLeft);
    harness.run_steps(2);
    assert!(matches!((stood[1], target(&harness)), (Target::Reduction(a), Target::Reduction(b)) if b + 4 <= a));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    assert_eq!(target(&harness), stood[0]);
}

#[test]
fn what_is_typed_is_undone_in_its_field_and_not_in_the_settings() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    harness.get_by_role_and_label(Role::Slider, "Reduction").focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(2);
    let moved = harness.state().state().settings.clone();
    harness.get_by_role_and_label(Role::SpinButton, "Pass band value").click();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    assert_eq!(harness.state().state().settings, moved);
    escape(&mut harness);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    assert_eq!(harness.state().state().settings.target, Target::default());
}

#[test]
fn keys_turn_and_zoom_by_the_second_however_fast_frames_come() {
    let held = |frames: usize| {
        let (mut harness, _) = app_at(DESKTOP, 0.5 / frames as f32);
        settle(&mut harness);
        for key in [Key::ArrowRight, Key::Plus] {
            harness.key_down(key);
            harness.run_steps(frames);
            harness.key_up(key);
            harness.run_steps(1);
        }
        *harness.state().camera()
    };
    let (slow, fast) = (held(15), held(60));
    let turned = slow.rotation.angle_between(fast.rotation);
    // Half a second turns by more than a quarter; a frame more or less is 1/15 of that.
    assert!(turned < 0.15, "{turned} rad apart");
    assert!((slow.distance / fast.distance - 1.0).abs() < 0.1, "{} {}", slow.distance, fast.distance);
    assert!(slow.rotation.angle_between(lumen::render::Camera::default().rotation) > 0.5, "it turns");
}
