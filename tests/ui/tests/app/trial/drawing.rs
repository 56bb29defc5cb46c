//! What the views show, and when they are drawn.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use lumen::app::Gamepad;
use lumen::engine::trial::{TrialCommand, TrialEvent};
use lumen::trial::frame::{Frame, Touch};
use lumen::trial::setup::Input;
use lumen_ui_tests::told::{
    App, DESKTOP, FIRST, PHONE, asked, at_entry, frame, id_of_start, now, on, press, ready, retarget, says, start, tell,
};
use lumen_ui_tests::{app, drag, seen, settle};

use super::picture;

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

#[test]
fn a_restart_shows_the_wire_at_its_entry_at_once_and_then_what_is_told() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    settle(&mut harness);
    start(&mut harness);
    let id = id_of_start(&asked(&memory));
    // The scale of forces is that of both.
    tell(&mut harness, &memory, [ready(id), now(id, frame()), now(id, at_entry())]);
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
fn the_fluoroscopy_is_the_large_picture_on_demand_with_the_others_over_it() {
    let (mut harness, memory) = on(DESKTOP);
    let views = |harness: &App| {
        ["Trial view", "Fluoroscopy view", "Tip view"]
            .map(|view| harness.get_by_role_and_label(Role::Image, view).rect())
    };
    let beside = views(&harness);
    press(&mut harness, "Large fluoroscopy");
    let [vessel, large, tip] = views(&harness);
    let all = beside[0].union(beside[1]).union(beside[2]);
    assert!(large.width() > 0.99 * all.width() && large.height() > 0.99 * all.height(), "{large} of {all}");
    assert!(large.contains_rect(vessel) && large.contains_rect(tip) && !vessel.intersects(tip), "{vessel} {tip}");
    assert!(vessel.width() < 0.4 * large.width() && vessel.width() > 200.0, "{vessel}");
    // What is dragged in the strip is the strip's.
    let arm = |harness: &App| {
        (harness.state().trial().open().unwrap().carm.lao, harness.state().trial().open().unwrap().carm.cran)
    };
    let aside = egui::vec2(60.0, 0.0);
    let (camera, before) = (*harness.state().camera(), arm(&harness));
    drag(&mut harness, vessel.center(), aside);
    let turned = *harness.state().camera();
    assert!(turned.rotation != camera.rotation && arm(&harness) == before);
    drag(&mut harness, tip.center(), aside);
    assert!(*harness.state().camera() == turned && arm(&harness) == before);
    drag(&mut harness, large.left_center() + egui::vec2(100.0, 60.0), aside);
    assert!(*harness.state().camera() == turned && arm(&harness) != before);
    for key in [Key::F, Key::F, Key::Escape] {
        let is_large = harness.state().trial().open().unwrap().carm.is_large;
        harness.key_press(key);
        harness.run_steps(3);
        assert_ne!(harness.state().trial().open().unwrap().carm.is_large, is_large, "{key:?}");
    }
    assert!(views(&harness) == beside && harness.state().trial().is_open() && asked(&memory).is_empty());
}

/// Two runs are compared by eye: the weaker one fills less of its bar.
#[test]
fn the_scale_of_forces_stays_from_run_to_run() {
    let (mut harness, memory) = on(DESKTOP);
    let felt = |id, force| TrialEvent::Felt { id, touches: vec![Touch { at: [0.0; 3], triangle: 0, force }] };
    tell(&mut harness, &memory, [felt(FIRST, 0.9), now(FIRST, Frame { step: 900, ..frame() })]);
    assert!(says(&harness, "Wall force, up to 1 N"));
    retarget(&mut harness);
    let id = id_of_start(&asked(&memory));
    tell(&mut harness, &memory, [ready(id), now(id, frame())]);
    assert!(says(&harness, "Wall force, up to 1 N"), "0.35 N of it");
}

#[test]
fn a_step_back_forgets_what_the_wall_has_felt_since() {
    let (mut harness, memory) = seen(|| on(DESKTOP));
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
