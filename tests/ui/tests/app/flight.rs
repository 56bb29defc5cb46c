//! The camera flies to a place that is gone to, where motion is welcome, and the hand has it at once.

use egui::accesskit::Role;
use egui::{Key, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::LumenApp;
use lumen::render::Camera;
use lumen_ui_tests::{DESKTOP, moving_app, settle};

/// Seconds between two frames.
const FRAME_S: f32 = 1.0 / 20.0;

type App = Harness<'static, LumenApp>;

/// The app with the deviation in colours, the name of its pin and the place that it leads to.
fn with_pin() -> (App, String, [f32; 3]) {
    let (mut harness, _) = moving_app(DESKTOP, FRAME_S);
    settle(&mut harness);
    harness.key_press(Key::D);
    harness.run_steps(3);
    let report = &harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap().report;
    let deviation = report.deviation_mm.unwrap();
    (harness, format!("Largest deviation: {:.3} mm", deviation.max), deviation.max_at_mm[1])
}

/// The camera after each of so many frames.
fn film(harness: &mut App, frames: usize) -> Vec<Camera> {
    let film = (0..frames).map(|_| {
        harness.step();
        *harness.state().camera()
    });
    film.collect()
}

#[test]
fn it_flies_for_six_tenths_of_a_second_and_is_then_at_the_place() {
    let (mut harness, pin, place) = with_pin();
    let before = *harness.state().camera();
    harness.get_by_role_and_label(Role::Button, &pin).click();
    let film = film(&mut harness, 30);
    let after = film[29];
    assert!(after.target.to_array() == place && after.distance < before.distance, "{after:?}");
    let on_its_way = film.iter().filter(|&&camera| camera != before && camera != after).count();
    // Some of the first frames are those of the click.
    assert!((8..=13).contains(&on_its_way), "{on_its_way} frames of {FRAME_S} s on its way");
    assert!(film.is_sorted_by(|a, b| a.distance >= b.distance), "it comes nearer all the way");
    assert!(film.iter().all(|camera| camera.rotation == before.rotation));
}

#[test]
fn a_hand_on_the_camera_ends_the_flight() {
    let (mut harness, pin, place) = with_pin();
    let before = *harness.state().camera();
    let view = harness.get_by_role_and_label(Role::Image, "Wireframe view").rect();
    let hand = view.min + vec2(60.0, 200.0);
    harness.hover_at(hand);
    harness.run_steps(1);
    harness.get_by_role_and_label(Role::Button, &pin).click();
    let begun = film(&mut harness, 4).pop().unwrap();
    assert!(begun != before && begun.target.to_array() != place, "it is on its way");
    harness.drag_at(hand);
    harness.run_steps(1);
    harness.hover_at(hand + vec2(40.0, 0.0));
    harness.run_steps(1);
    harness.drop_at(hand + vec2(40.0, 0.0));
    harness.run_steps(1);
    let held = *harness.state().camera();
    assert!(held.rotation != before.rotation && held.target.to_array() != place, "{held:?}");
    assert!(film(&mut harness, 20).iter().all(|camera| *camera == held), "it stays where the hand has left it");
}
