//! How a trial begins: with what, with which wire, between which places.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::engine::trial::{TrialCommand, TrialEvent};
use lumen::phantom::Sample;
use lumen::trial::autopilot::AutopilotTask;
use lumen::trial::frame::Frame;
use lumen::trial::setup::Setup;
use lumen::trial::summary::Summary;
use lumen::trial::wire::Wire;
use lumen_ui_tests::told::{
    App, DESKTOP, FIRST, as_the_paper, asked, choose, ended, frame, id_of_start, now, on, press, put_on, ready,
    refused, retarget, says, start, tell,
};
use lumen_ui_tests::{app, app_in_full, open, settle, settle_wholly, tube};

use super::{ADAPT, unfold};

#[test]
fn the_trial_starts_with_the_level_that_is_shown_and_its_views_take_the_place_of_the_others() {
    let (mut harness, memory) = app_in_full(DESKTOP);
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
    assert!(["12.3 cm", "0.350 N", "-0.200 N"].iter().all(|number| says(&harness, number)), "three gauges");
    assert!(!says(&harness, "812 a second"), "the rest is folded up");
    unfold(&mut harness);
    for number in ["12.3 cm", "42.0 mm", "1:15.0 min", "0.350 N", "-0.200 N", "812 a second"] {
        assert!(says(&harness, number), "{number}");
    }
    press(&mut harness, "Close");
    assert_eq!(asked(&memory), [TrialCommand::Stop]);
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_some());
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
fn the_wire_that_went_in_for_one_that_failed_is_named() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    start(&mut harness);
    let id = id_of_start(&asked(&memory));
    let TrialEvent::Ready(mut ready) = ready(id) else { panic!("it is ready") };
    ready.setup.wire = Wire::preset("workhorse").unwrap();
    ready.setup.next_wires = vec![Wire::preset("035-j").unwrap()];
    let value = |harness: &App| {
        let list = harness.get_by_role_and_label(Role::ComboBox, "Wire");
        list.accesskit_node().value().unwrap_or_default()
    };
    tell(&mut harness, &memory, [TrialEvent::Ready(ready), now(id, frame())]);
    assert_eq!(value(&harness), "0.014 in workhorse");
    let doing = Some(AutopilotTask::Exchanging);
    tell(&mut harness, &memory, [now(id, Frame { doing, ..frame() })]);
    assert!(says(&harness, "taking the wire out for another"));
    tell(&mut harness, &memory, [now(id, Frame { wire: 1, ..frame() })]);
    assert!(value(&harness) == "0.035 in J tip" && !says(&harness, "Restart to try"));
    let summary = Summary {
        success: true,
        time_s: 61.2,
        wire: "035-j".to_owned(),
        failed_wires: vec!["workhorse".to_owned()],
        ..Summary::default()
    };
    tell(&mut harness, &memory, [ended(id, summary)]);
    assert!(says(&harness, "after 61.2 s with the wire 0.035 in J tip, after 0.014 in workhorse had failed"));
    // The first goes in again.
    press(&mut harness, "Restart");
    let commands = asked(&memory);
    let Some(&TrialCommand::Restart { id }) = commands.first() else { panic!("{commands:?}") };
    tell(&mut harness, &memory, [now(id, frame())]);
    assert_eq!(value(&harness), "0.014 in workhorse");
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
    as_the_paper(&mut harness);
    put_on(&mut harness, &memory);
    press(&mut harness, "Restart");
    assert!(matches!(asked(&memory)[..], [TrialCommand::Restart { .. }]));
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

/// Looks from near at the middle of the view.
fn zoom(harness: &mut App) {
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    harness.hover_at(view.center());
    harness.event(egui::Event::Zoom(2.0));
    harness.run_steps(12);
}

#[test]
fn a_trial_begins_with_the_whole_vessel_in_view_and_goes_back_to_where_one_has_looked() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let camera = |harness: &App| *harness.state().camera();
    let whole = camera(&harness);
    zoom(&mut harness);
    let near = camera(&harness);
    assert!(near.distance < 0.7 * whole.distance, "{} of {}", near.distance, whole.distance);
    put_on(&mut harness, &memory);
    assert!((0.6..2.0).contains(&(camera(&harness).distance / whole.distance)));
    press(&mut harness, "Prepare");
    harness.run_steps(3);
    assert_eq!(camera(&harness), near);
}

#[test]
fn who_opens_another_file_in_a_trial_sees_the_whole_of_that() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    zoom(&mut harness);
    let near = *harness.state().camera();
    put_on(&mut harness, &memory);
    open(&mut harness, &memory, "tube.obj", tube(5.0, 60.0, 1.0));
    settle_wholly(&mut harness);
    let title = harness.state().state().document.as_ref().map(|open| open.title().into_owned());
    assert_eq!(title.as_deref(), Some("tube.obj"));
    let now = *harness.state().camera();
    assert!(now.target != near.target && now.distance != near.distance, "{now:?}");
}
