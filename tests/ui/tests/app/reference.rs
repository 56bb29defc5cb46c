//! The open surface beside another file, used as a user uses it.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use crate::opening::Dropped;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::reference::Against;
use lumen::app::{LumenApp, PlatformEvent};
use lumen_ui_tests::{DESKTOP, Memory, app, offered, open, says, settle, tube};

fn press(harness: &mut Harness<'_, LumenApp>, role: Role, label: &str) {
    harness.get_by_role_and_label(role, label).click();
    harness.run_steps(4);
}

fn against<'a>(harness: &'a Harness<'_, LumenApp>) -> &'a Against {
    &harness.state().state().against
}

/// A tube of a radius of 3 mm, and beside it, as the reference, one of 3.3 mm in other triangles.
fn two() -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "narrow.obj", tube(3.0, 40.0, 0.4));
    press(&mut harness, Role::Button, "Compare");
    press(&mut harness, Role::Button, "Compare with a file...");
    open(&mut harness, &memory, "wide.obj", tube(3.3, 40.0, 0.5));
    (harness, memory)
}

#[test]
fn a_narrower_tube_is_told_to_be_so_and_what_is_told_is_saved() {
    let (mut harness, memory) = two();
    assert_eq!(memory.borrow().asked, 1, "a file dialog");
    let opened = harness.state().state().document.as_ref().unwrap();
    assert_eq!(opened.title(), "narrow.obj", "what was open still is");
    let found = against(&harness).answer().unwrap().unwrap();
    let report = &found.two.report;
    assert_eq!([&report.reference.file, &report.surface.file], ["wide.obj", "narrow.obj"]);
    assert!((report.deviation_mm.mean - 0.3).abs() < 0.01, "{:?}", report.deviation_mm);
    let change = report.calibre.branches[0].largest_change_percent.unwrap();
    assert!((change + 100.0 / 11.0).abs() < 0.5, "3 of 3.3 mm: {change} %");
    // Signed: the surface lies inside, and is nowhere outside.
    assert!(found.over.iter().all(|[plain, signed]| {
        plain.iter().all(|mm| (0.2..0.45).contains(mm)) && signed.iter().all(|mm| (-0.45..-0.2).contains(mm))
    }));
    assert!(says(&harness, "The vessel changed by more than 2 %.") && says(&harness, "Two surfaces"));
    for picture in ["Shaded", "Distance from the other"] {
        assert!(harness.query_by_role_and_label(Role::Image, picture).is_some(), "{picture}");
    }
    press(&mut harness, Role::CheckBox, "Inside and outside");
    assert!(against(&harness).is_plain);
    let report = &against(&harness).answer().unwrap().unwrap().two.report;
    let mean = format!("\"mean\": {}", report.deviation_mm.mean);
    press(&mut harness, Role::Button, "Save JSON");
    let (name, bytes) = offered(&mut harness, &memory);
    let text = String::from_utf8(bytes).unwrap();
    let holds = |part: &str| text.contains(part);
    assert!(name == "narrow-compared.json" && holds("\"file\": \"narrow.obj\"") && holds(&mean), "{text}");
    press(&mut harness, Role::Button, "Save CSV");
    let (name, bytes) = offered(&mut harness, &memory);
    let text = String::from_utf8(bytes).unwrap();
    assert!(name == "narrow-compared.csv" && text.lines().count() > 20 && text.contains("area_reference_mm2"));
    harness.key_press(egui::Key::Escape);
    harness.run_steps(3);
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_some() && !against(&harness).is_open);
}

#[test]
fn the_level_and_another_motion_are_compared_and_a_file_that_is_dropped_is_the_next_reference() {
    let (mut harness, memory) = two();
    press(&mut harness, Role::RadioButton, "reduced");
    settle(&mut harness);
    let triangles = |harness: &Harness<'_, LumenApp>| {
        let report = &against(harness).answer().unwrap().unwrap().two.report;
        [report.reference.triangles, report.surface.triangles]
    };
    let state = harness.state().state();
    let level = state.document.as_ref().unwrap().shown.as_ref().unwrap().level.triangles.len();
    let wide = triangles(&harness)[0];
    assert_eq!(triangles(&harness)[1], level);
    press(&mut harness, Role::RadioButton, "best fit");
    settle(&mut harness);
    assert!(against(&harness).answer().unwrap().unwrap().two.report.moved.is_some_and(|moved| moved.fit.is_some()));
    press(&mut harness, Role::RadioButton, "axes");
    settle(&mut harness);
    assert!(says(&harness, "They cannot be compared: which way the axes point"));
    press(&mut harness, Role::RadioButton, "not");
    open(&mut harness, &memory, "finer.obj", tube(3.3, 40.0, 0.3));
    assert!(triangles(&harness)[0] > wide && against(&harness).source.as_ref().unwrap().name() == "finer.obj");
    open(&mut harness, &memory, "broken.stl", b"solid".to_vec());
    assert!(says(&harness, "They cannot be compared:"));
    let opened = harness.state().state().document.as_ref().unwrap();
    assert_eq!(opened.title(), "narrow.obj", "what was open still is");
}

#[test]
fn a_cancel_stops_it_until_it_is_wished_again_and_another_surface_ends_it() {
    let (mut harness, memory) = two();
    memory.borrow_mut().runs = false;
    press(&mut harness, Role::RadioButton, "reduced");
    assert!(against(&harness).is_busy());
    press(&mut harness, Role::Button, "Cancel");
    memory.borrow_mut().runs = true;
    settle(&mut harness);
    assert!(!against(&harness).is_busy() && against(&harness).stopped().is_some());
    press(&mut harness, Role::Button, "Compare again");
    settle(&mut harness);
    assert!(against(&harness).answer().unwrap().unwrap().two.report.surface.file.ends_with("reduced"));
    // Whoever presses *Open...* opens, also here.
    press(&mut harness, Role::Button, "Open...");
    open(&mut harness, &memory, "other.obj", tube(2.0, 40.0, 0.4));
    assert!(!against(&harness).is_open && against(&harness).answer().is_none() && against(&harness).source.is_none());
    assert_eq!(harness.state().state().document.as_ref().unwrap().title(), "other.obj");
}

#[test]
fn a_dialog_that_was_cancelled_makes_no_reference_of_what_is_dropped_later() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "first.obj", tube(3.0, 40.0, 0.4));
    press(&mut harness, Role::Button, "Compare");
    press(&mut harness, Role::Button, "Compare with a file...");
    let dropped = Dropped("second.obj".into(), tube(3.3, 40.0, 0.4));
    harness.input_mut().dropped_files.push(Arc::new(dropped));
    harness.run_steps(20);
    settle(&mut harness);
    assert!(!against(&harness).is_open);
    assert_eq!(harness.state().state().document.as_ref().unwrap().title(), "second.obj");
}

#[test]
fn the_camera_and_the_ring_of_the_two_stay_with_them_and_there_is_a_way_back() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "narrow.obj", tube(3.0, 40.0, 0.4));
    let before = *harness.state().camera();
    press(&mut harness, Role::Button, "Compare");
    press(&mut harness, Role::Button, "Compare with a file...");
    // A metre away.
    let far = String::from_utf8(tube(3.3, 40.0, 0.5)).unwrap();
    let far: String = far.lines().map(|line| moved(line, 1000.0)).collect();
    open(&mut harness, &memory, "far.obj", far.into_bytes());
    assert!(says(&harness, "on the mean."), "they lie apart");
    press(&mut harness, Role::Button, "Bring them together");
    settle(&mut harness);
    let report = &against(&harness).answer().unwrap().unwrap().two.report;
    assert!((report.deviation_mm.mean - 0.3).abs() < 0.02, "{:?}", report.deviation_mm);
    press(&mut harness, Role::Button, "Go there: Farthest on surface");
    assert!(harness.state().camera().target.x > 900.0);
    harness.key_press(egui::Key::Escape);
    harness.run_steps(4);
    assert_eq!(*harness.state().camera(), before);
    press(&mut harness, Role::Button, "Compare");
    press(&mut harness, Role::Button, "Back to far.obj");
    assert!(against(&harness).is_open && !against(&harness).is_busy() && against(&harness).answer().is_some());
}

/// A line of an OBJ file, its vertex moved along x.
fn moved(line: &str, by: f64) -> String {
    match line.strip_prefix("v ").and_then(|rest| rest.split_once(' ')) {
        Some((x, rest)) => format!("v {} {rest}\n", x.parse::<f64>().unwrap() + by),
        None => format!("{line}\n"),
    }
}

#[test]
fn of_two_files_that_come_together_the_second_can_be_the_reference() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "first.obj", tube(3.0, 40.0, 0.4));
    memory.borrow_mut().events.push_back(PlatformEvent::More { names: vec!["second.obj".to_owned()] });
    harness.run_steps(4);
    press(&mut harness, Role::Button, "Compare with it");
    open(&mut harness, &memory, "second.obj", tube(3.3, 40.0, 0.4));
    assert!(against(&harness).is_open && against(&harness).answer().is_some_and(|answer| answer.is_ok()));
    assert_eq!(harness.state().state().document.as_ref().unwrap().title(), "first.obj");
}
