//! What is refused, and what is offered instead.

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use lumen::engine::trial::{TrialCommand, TrialEvent};
use lumen::pipeline::settings::{Settings, Smoothing};
use lumen_ui_tests::told::{
    App, DESKTOP, as_the_paper, asked, frame, id_of_start, now, on, open_coronary, press, ready, refused, retarget,
    says, start, tell, wait,
};
use lumen_ui_tests::{app, app_in_full, seen, settle};

use super::{ADAPT, picture};

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

/// The part of a view that is not of about its row's most frequent colour: its ground is shaded from above, and dithered.
fn part_drawn(harness: &mut App, view: &str) -> f64 {
    let width = harness.get_by_role_and_label(Role::Image, view).rect().shrink(2.0).x_range();
    let width = width.max as usize - width.min as usize;
    let picture = picture(harness, view);
    let ground = |row: &[[u8; 4]]| {
        let mut counts = std::collections::BTreeMap::new();
        row.iter().for_each(|colour| *counts.entry(*colour).or_insert(0_usize) += 1);
        let (most, _) = counts.into_iter().max_by_key(|(_, count)| *count).unwrap();
        let is_ground = |colour: &&[u8; 4]| (0..3).all(|i| colour[i].abs_diff(most[i]) < 8);
        row.iter().filter(is_ground).count()
    };
    1.0 - picture.chunks(width).map(ground).sum::<usize>() as f64 / picture.len() as f64
}

#[test]
fn a_refusal_keeps_the_vessel_in_view_and_goes_to_the_place_that_is_too_thin() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    settle(&mut harness);
    start(&mut harness);
    let commands = asked(&memory);
    let Some(TrialCommand::Start { id, mesh, .. }) = commands.last() else { panic!("{commands:?}") };
    let [middle, other] = [mesh.bounds().centre(), mesh.positions[0]];
    let away = |p: &&lumen::mesh::Vec3| p.distance(middle);
    let trunk = *mesh.positions.iter().min_by(|a, b| away(a).total_cmp(&away(b))).unwrap();
    let whole = harness.state().camera().distance;
    assert!(part_drawn(&mut harness, "Trial view") < 0.1, "the way is being found");
    let message = "The lumen is too thin for a wire of 0.89 mm.";
    let refuse = |id, at: lumen::mesh::Vec3| TrialEvent::Refused {
        id,
        message: message.to_owned(),
        is_too_thin: true,
        at: Some(at.to_array()),
    };
    tell(&mut harness, &memory, [refuse(*id, trunk)]);
    assert!(says(&harness, message) && !says(&harness, "12.3 cm"));
    let camera = *harness.state().camera();
    assert!(camera.target == trunk && camera.distance < whole, "{camera:?}");
    assert!(part_drawn(&mut harness, "Trial view") > 0.2, "the vessel is seen");
    // The trial that stands is left, and the place is gone to as well.
    press(&mut harness, "Start trial");
    let id = id_of_start(&asked(&memory));
    tell(&mut harness, &memory, [ready(id), now(id, frame())]);
    assert!(!says(&harness, message));
    retarget(&mut harness);
    let id = id_of_start(&asked(&memory));
    tell(&mut harness, &memory, [refuse(id, other)]);
    assert!(says(&harness, message) && says(&harness, "12.3 cm"));
    assert!(harness.state().camera().target == other);
}

#[test]
fn the_wire_fits_into_the_coronary_arteries_with_no_button_pressed_before() {
    let (mut harness, memory) = app_in_full(DESKTOP);
    settle(&mut harness);
    open_coronary(&mut harness);
    memory.borrow_mut().trial_runs = true;
    start(&mut harness);
    wait(&mut harness, |harness| harness.state().trial().session().is_some() || says(harness, "too thin"));
    assert!(harness.state().trial().session().is_some() && harness.query_by_label(ADAPT).is_none());
}

#[test]
fn where_smoothing_leaves_no_room_for_the_wire_less_of_it_is_offered_and_the_trial_starts_with_that() {
    let (mut harness, memory) = app_in_full(DESKTOP);
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
