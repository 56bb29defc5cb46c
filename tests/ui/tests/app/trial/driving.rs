//! Hands on the wire: keys, pads, buttons and gamepads.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use lumen::app::Gamepad;
use lumen::engine::trial::TrialCommand;
use lumen::trial::frame::Frame;
use lumen::trial::setup::Input;
use lumen_ui_tests::told::{App, DESKTOP, FIRST, PHONE, asked, frame, now, on, press, put_on, says, tell};
use lumen_ui_tests::{app_at, settle};

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
    assert_eq!(harness.state().trial().open().unwrap().carm.lao, 45.0);
    let pedal = harness.state().trial().open().unwrap().carm.is_on;
    harness.key_press(Key::Space);
    harness.run_steps(3);
    assert_ne!(harness.state().trial().open().unwrap().carm.is_on, pedal);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(asked(&memory), [TrialCommand::Stop]);
    assert!(!harness.state().trial().is_open());
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
fn a_gamepad_shakes_by_the_push_once_it_is_armed_and_is_still_after_escape() {
    let (mut harness, memory) = app_at(DESKTOP, 1.0 / 60.0);
    settle(&mut harness);
    put_on(&mut harness, &memory);
    memory.borrow_mut().gamepad = Some(Gamepad { can_rumble: true, ..Gamepad::default() });
    let mut step = 500;
    let mut go_on = |harness: &mut App| {
        for _ in 0..10 {
            step += 10;
            tell(harness, &memory, [now(FIRST, Frame { step, push_n: -0.02, ..frame() })]);
        }
        std::mem::take(&mut memory.borrow_mut().rumbled)
    };
    assert!(go_on(&mut harness).is_empty());
    press(&mut harness, "Arm rumble...");
    assert!(says(&harness, "with up to 40 %"));
    assert!(go_on(&mut harness).is_empty(), "nothing shakes before the user lets it");
    press(&mut harness, "Arm rumble");
    let heard = go_on(&mut harness);
    assert!(heard.last().is_some_and(|strength| (strength - 0.2).abs() < 1e-6), "0.1 N would be all of it: {heard:?}");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert_eq!(std::mem::take(&mut memory.borrow_mut().rumbled).last(), Some(&0.0));
    assert!(go_on(&mut harness).is_empty());
    assert!(harness.query_by_role_and_label(Role::Image, "Trial view").is_some(), "Escape did nothing else");
}

#[test]
fn a_tone_follows_the_push_while_it_is_on_and_the_window_is_not_left() {
    let (mut harness, memory) = app_at(DESKTOP, 1.0 / 60.0);
    settle(&mut harness);
    put_on(&mut harness, &memory);
    let toggle = |harness: &mut App| {
        harness.get_by_role_and_label(Role::CheckBox, "Sound of the force").scroll_to_me();
        harness.run_steps(12);
        harness.get_by_role_and_label(Role::CheckBox, "Sound of the force").click();
        harness.run_steps(2);
    };
    let mut step = 500;
    let mut go_on = |harness: &mut App, times: usize| {
        for _ in 0..times {
            step += 10;
            tell(harness, &memory, [now(FIRST, Frame { step, push_n: -0.05, ..frame() })]);
        }
        std::mem::take(&mut memory.borrow_mut().sounded)
    };
    go_on(&mut harness, 1);
    assert!(harness.query_by_role_and_label(Role::CheckBox, "Sound of the force").is_none(), "there is none here");
    assert!(harness.query_by_label_contains("pw-play").is_some(), "and it says what it would take");
    memory.borrow_mut().has_sound = true;
    assert!(go_on(&mut harness, 10).is_empty(), "off by default");
    toggle(&mut harness);
    let heard = go_on(&mut harness, 20);
    assert_eq!(heard.first().map(|tone| tone.loudness), Some(0.0), "it begins with the click, silent");
    // Of 0.1 N the half: an octave above 220 Hz, and half as loud as it goes.
    let last = heard.last().unwrap();
    assert!((last.pitch_hz - 440.0).abs() < 1.0 && (last.loudness - 0.1).abs() < 1e-3, "{last:?}");
    harness.input_mut().focused = false;
    let heard = go_on(&mut harness, 5);
    assert_eq!(heard.iter().map(|tone| tone.loudness).collect::<Vec<_>>(), [0.0], "left: told once");
    harness.input_mut().focused = true;
    assert!(go_on(&mut harness, 20).last().is_some_and(|tone| tone.loudness > 0.05), "and on again");
    toggle(&mut harness);
    assert_eq!(go_on(&mut harness, 1).last().map(|tone| tone.loudness), Some(0.0));
    assert!(go_on(&mut harness, 10).is_empty());
}
