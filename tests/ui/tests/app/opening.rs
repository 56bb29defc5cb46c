//! Files and samples: opened, chosen from, given up on the way, saved; and an engine that stops.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::{LumenApp, NoticeKind, PlatformEvent};
use lumen::pipeline::settings::{Keep, Target};
use lumen_ui_tests::{DESKTOP, app, app_in_full, offered, says, settle, unfold};

use crate::controls::{open, press_at, shown};

#[test]
fn another_piece_is_chosen_in_the_list() {
    let mut harness = open();
    unfold(&mut harness, "Surface");
    harness.get_by_role_and_label(Role::ComboBox, "Piece").click();
    harness.run_steps(2);
    harness.get_by_label("All pieces").click();
    settle(&mut harness);
    assert_eq!(harness.state().state().settings.keep, Keep::All);
    let document = harness.state().state().document.as_ref().unwrap();
    let all = document.opened.triangles.len();
    assert_eq!(document.levels.as_ref().unwrap().1.triangles.len(), all);
}

#[test]
fn a_broken_file_gets_a_sentence_and_what_was_open_stays() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let before = shown(&harness);
    let broken = PlatformEvent::Chosen { name: "scan.stl".to_owned(), bytes: vec![0; 50] };
    memory.borrow_mut().events.push_back(broken);
    harness.run_steps(10);
    let state = harness.state().state();
    let notice = state.notices.newest().expect("a sentence");
    assert!(
        notice.kind == NoticeKind::Wrong && notice.text.starts_with("scan.stl: ") && notice.text.ends_with('.'),
        "{notice:?}"
    );
    assert_eq!(shown(&harness), before);
    assert!(harness.query_by_label_contains("scan.stl").is_some());
}

#[test]
fn the_shown_level_is_saved_in_every_format_and_reads_back() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    for format in ["STL", "PLY", "OBJ", "GLB"] {
        harness.get_by_role_and_label(Role::Button, "Save").click();
        harness.run_steps(3);
        harness.get_by_label(&format!("{format}...")).click();
        let (name, bytes) = offered(&mut harness, &memory);
        assert_eq!(name, format!("abdominal-aorta-{}.{}", shown(&harness), format.to_lowercase()));
        let read = lumen::io::read(&bytes, &name, &lumen::io::ImportOptions::default()).unwrap();
        assert_eq!(read.report.triangles, shown(&harness));
    }
}

#[test]
fn a_unit_chosen_for_a_file_is_that_of_this_file_alone_and_stays_with_it() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let mesh = harness.state().state().document.as_ref().unwrap().shown_mesh().unwrap();
    let bytes = lumen::io::write(&mesh, None, lumen::io::Format::Stl).unwrap();
    let chosen = || PlatformEvent::Chosen { name: "scan.stl".to_owned(), bytes: bytes.clone() };
    let unit = |harness: &Harness<'_, LumenApp>| harness.state().state().document.as_ref().unwrap().import.unit;
    harness.get_by_role_and_label(Role::Button, "Open in").click();
    harness.run_steps(3);
    harness.get_by_label("cm...").click();
    harness.run_steps(3);
    assert_eq!(memory.borrow().asked, 1);
    memory.borrow_mut().events.push_back(chosen());
    harness.run_steps(3);
    settle(&mut harness);
    assert_eq!(unit(&harness), lumen::io::Unit::Centimetre);
    let size = |mesh: &lumen::mesh::TriMesh| mesh.bounds().diagonal();
    let opened = harness.state().state().document.as_ref().unwrap().opened.clone();
    assert!((size(&opened) / size(&mesh) - 10.0).abs() < 1e-3);
    // The engine is started again, and the file read again: as it was.
    memory.borrow_mut().engine_failure = Some("no memory".to_owned());
    harness.run_steps(3);
    settle(&mut harness);
    let again = harness.state().state().document.as_ref().unwrap();
    assert!(again.import.unit == lumen::io::Unit::Centimetre && size(&again.opened) == size(&opened));
    // Given up, or over: the next file says for itself.
    memory.borrow_mut().events.push_back(chosen());
    harness.run_steps(3);
    settle(&mut harness);
    assert_eq!(unit(&harness), lumen::io::Unit::Millimetre);
}

#[test]
fn only_a_surface_that_knows_the_patient_is_seen_from_the_patients_sides() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let has = |harness: &mut Harness<'_, LumenApp>, side: &str| {
        harness.get_by_role_and_label(Role::Button, "View").click();
        harness.run_steps(3);
        let has = harness.query_by_label(side).is_some();
        harness.key_press(Key::Escape);
        harness.run_steps(3);
        has
    };
    assert!(has(&mut harness, "Superior") && !has(&mut harness, "Top"), "the sample knows its axes");
    let mesh = harness.state().state().document.as_ref().unwrap().shown_mesh().unwrap();
    let bytes = lumen::io::write(&mesh, None, lumen::io::Format::Stl).unwrap();
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "scan.stl".to_owned(), bytes });
    harness.run_steps(3);
    settle(&mut harness);
    assert!(has(&mut harness, "Top") && !has(&mut harness, "Superior"), "an STL file says nothing");
}

#[test]
fn the_open_button_and_its_key_ask_for_a_file() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    harness.get_by_role_and_label(Role::Button, "Open...").click();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::O);
    harness.run_steps(2);
    assert_eq!(memory.borrow().asked, 2);
}

#[test]
fn the_coronary_sample_opens_from_the_menu() {
    let mut harness = open();
    harness.get_by_role_and_label(Role::Button, "Sample").click();
    harness.run_steps(3);
    harness.get_by_label_contains("oronary").click();
    harness.run_steps(3);
    settle(&mut harness);
    assert_ne!(harness.state().state().document.as_ref().unwrap().levels.as_ref().unwrap().1.triangles.len(), 74_307);
}

#[test]
fn cancel_goes_back_to_the_last_result() {
    let (mut harness, memory) = app_in_full(DESKTOP);
    settle(&mut harness);
    let before = harness.state().state().settings.clone();
    memory.borrow_mut().slice = std::time::Duration::ZERO;
    press_at(&mut harness, "Iterations", 0.1);
    assert_ne!(harness.state().state().settings, before);
    assert!(harness.state().state().is_busy());
    harness.get_by_role_and_label(Role::Button, "Cancel").click();
    harness.run_steps(3);
    assert_eq!(harness.state().state().settings, before);
    assert!((7_429..=7_430).contains(&shown(&harness)));
}

#[test]
fn a_surface_that_is_cancelled_on_its_way_in_leaves_the_one_that_is_open() {
    let (mut harness, memory) = app_in_full(DESKTOP);
    settle(&mut harness);
    let before = shown(&harness);
    memory.borrow_mut().slice = std::time::Duration::ZERO;
    harness.get_by_role_and_label(Role::Button, "Sample").click();
    harness.run_steps(3);
    harness.get_by_label_contains("oronary").click();
    // Pieces and caps are found first, a rest at a time.
    harness.run_steps(60);
    assert!(harness.query_by_label_contains("Smoothing").is_some(), "it is read, and on its way");
    let document = harness.state().state().document.as_ref().unwrap();
    assert!(document.name != "Abdominal aorta" && document.shown.is_none());
    // It is shown as it was opened, and nothing is told of it that was of the one before.
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view");
    let told = view.accesskit_node().data().description().map(str::to_owned).unwrap_or_default();
    assert!(told.contains("Coronary arteries as it was opened"), "{told}");
    assert!(says(&harness, "Being measured...") && says(&harness, "Being computed..."));
    assert!(!says(&harness, "Safe to simulate on"));
    harness.get_by_role_and_label(Role::Button, "Cancel").click();
    harness.run_steps(5);
    let state = harness.state().state();
    assert!(state.opening().is_none());
    assert!(state.notices.newest().is_some_and(|notice| notice.text.contains("cancelled")));
    assert_eq!(state.document.as_ref().unwrap().name, "Abdominal aorta");
    assert_eq!(shown(&harness), before);
    memory.borrow_mut().slice = std::time::Duration::from_millis(50);
    press_at(&mut harness, "Iterations", 0.1);
    settle(&mut harness);
    assert!((7_429..=7_430).contains(&shown(&harness)), "the engine works on the aorta again");
}

#[test]
fn an_engine_that_stops_is_started_again_and_nothing_is_lost() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let before = shown(&harness);
    memory.borrow_mut().engine_failure = Some("out of memory".to_owned());
    harness.run_steps(2);
    assert_eq!(memory.borrow().engines, 2);
    assert!(harness.state().state().notices.newest().is_some_and(|notice| notice.text.contains("out of memory")));
    assert_eq!(shown(&harness), before);
    harness.run_steps(50);
    press_at(&mut harness, "Iterations", 0.1);
    settle(&mut harness);
    let state = harness.state().state();
    assert_eq!(state.document.as_ref().unwrap().measured.as_ref().unwrap().report.settings, state.settings);
}

#[test]
fn a_surface_of_one_triangle_leaves_the_settings_for_the_next() {
    let (mut harness, memory) = app_in_full(DESKTOP);
    settle(&mut harness);
    let bytes = b"v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n".to_vec();
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "one.obj".to_owned(), bytes });
    harness.run_steps(20);
    assert_eq!(harness.state().state().document.as_ref().unwrap().name, "one.obj");
    assert_eq!(harness.state().state().settings.target, Target::default());
    harness.get_by_role_and_label(Role::Button, "Sample").click();
    harness.run_steps(3);
    harness.get_by_label("Abdominal aorta").click();
    harness.run_steps(3);
    settle(&mut harness);
    assert!((7_429..=7_430).contains(&shown(&harness)), "Table II at 90 %: {}", shown(&harness));
}

#[test]
fn the_app_opens_with_the_sample_of_the_paper_smoothed_and_reduced() {
    let harness = open();
    let document = harness.state().state().document.as_ref().unwrap();
    // Tables I and II of the paper: 74,307 polygons, 7,430 of them at 90 %.
    assert_eq!(document.levels.as_ref().unwrap().1.triangles.len(), 74_307);
    assert!((7_429..=7_430).contains(&shown(&harness)));
    assert!(document.pieces.list.len() > 5, "islands for connectivity to leave out");
    assert!(harness.query_by_label_contains("Not for clinical decisions").is_some());
}

/// A file that is dropped, of these bytes.
#[derive(Debug)]
pub(crate) struct Dropped(pub(crate) PathBuf, pub(crate) Vec<u8>);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Ok(self.1.clone())
    }
}

#[test]
fn of_several_files_that_are_dropped_each_is_offered_after_the_one_before() {
    let (mut harness, _memory) = app(DESKTOP);
    settle(&mut harness);
    let triangle = |name: &str| Dropped(name.into(), b"v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n".to_vec());
    let broken = Dropped("b.stl".into(), vec![0; 50]);
    let dropped: [egui::DroppedFileHandle; 3] =
        [Arc::new(triangle("a.obj")), Arc::new(broken), Arc::new(triangle("c.obj"))];
    harness.input_mut().dropped_files.extend(dropped);
    let name = |harness: &Harness<'_, LumenApp>| harness.state().state().document.as_ref().unwrap().name.clone();
    harness.run_steps(20);
    assert_eq!(name(&harness), "a.obj");
    assert!(says(&harness, "b.stl and one more came with it."));
    harness.get_by_label("Open next").click();
    harness.run_steps(20);
    assert_eq!(name(&harness), "a.obj", "the second cannot be read");
    // What is still to be opened stands under that it could not.
    harness.get_by_label("Dismiss").click();
    harness.run_steps(3);
    assert!(says(&harness, "c.obj came with it.") && !says(&harness, "b.stl: "));
    harness.get_by_label("Open next").click();
    harness.run_steps(20);
    assert_eq!((name(&harness).as_str(), says(&harness, "came with it")), ("c.obj", false));
    assert!(harness.query_by_label("Dismiss").is_none());
}

#[test]
fn what_was_done_goes_from_the_bar_once_it_has_been_read() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let saved = PlatformEvent::Saved { message: "a.stl was saved.".to_owned() };
    memory.borrow_mut().events.push_back(saved);
    harness.run_steps(3);
    assert!(says(&harness, "a.stl was saved."));
    // A quarter of a second each: 4 s, and a tenth of one for each of its 16 letters.
    harness.run_steps(20);
    assert!(says(&harness, "a.stl was saved."));
    harness.run_steps(6);
    assert!(!says(&harness, "a.stl was saved."));
}
