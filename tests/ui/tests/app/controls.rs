//! Each control does what it says, moved as a user moves it: by pointer and keys, found by role and name.

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::{LumenApp, PlatformEvent};
use lumen::pipeline::settings::{Keep, Method, Target, Window};
use lumen_ui_tests::{app, settle};

const DESKTOP: [f32; 2] = [1280.0, 800.0];

fn open() -> Harness<'static, LumenApp> {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    harness
}

/// Moves a slider by pressing on it at a part of its length.
fn press_at(harness: &mut Harness<'_, LumenApp>, slider: &str, part: f32) {
    let rect = harness.get_by_role_and_label(Role::Slider, slider).rect();
    let at = egui::pos2(rect.left() + rect.width() * part, rect.center().y);
    harness.drag_at(at);
    harness.run_steps(2);
    harness.drop_at(at);
    harness.run_steps(2);
}

/// Types into the field beside a slider.
fn type_into(harness: &mut Harness<'_, LumenApp>, field: &str, text: &str) {
    harness.get_by_role_and_label(Role::SpinButton, field).scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::SpinButton, field).click();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.event(egui::Event::Text(text.to_owned()));
    harness.run_steps(1);
    harness.key_press(Key::Enter);
    harness.run_steps(2);
}

fn shown(harness: &Harness<'_, LumenApp>) -> usize {
    let document = harness.state().state().document.as_ref();
    document.and_then(|document| document.shown.as_ref()).map_or(0, |shown| shown.level.triangles.len())
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

#[test]
fn the_reduction_slider_shows_another_level_in_the_same_frame() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    memory.borrow_mut().runs = false;
    let before = shown(&harness);
    press_at(&mut harness, "Reduction", 0.5);
    let (after, target) = (shown(&harness), harness.state().state().settings.target);
    let wanted = target.triangles(74_307);
    assert!(after > 4 * before && after <= wanted && after + 2 > wanted, "{before} {after} {target:?}");
}

#[test]
fn the_picture_follows_the_slider_in_the_same_frame() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    memory.borrow_mut().runs = false;
    let slider = harness.get_by_role_and_label(Role::Slider, "Reduction").rect();
    let at = |part: f32| egui::pos2(slider.left() + slider.width() * part, slider.center().y);
    let view = harness.get_by_role_and_label(Role::Image, "Wireframe view").rect().shrink(2.0);
    let picture = |harness: &mut Harness<'_, LumenApp>| {
        let [left, top] = [view.left() as u32, view.top() as u32];
        let whole = harness.render().unwrap();
        // Below the writing.
        let part = (top + 60..view.bottom() as u32).flat_map(|y| (left..view.right() as u32).map(move |x| (x, y)));
        part.map(|(x, y)| whole.get_pixel(x, y).0).collect::<Vec<_>>()
    };
    harness.drag_at(at(0.9));
    harness.run_steps(3);
    let before = picture(&mut harness);
    harness.hover_at(at(0.5));
    harness.step();
    let after = picture(&mut harness);
    harness.run_steps(3);
    assert!(before != after && after == picture(&mut harness));
}

#[test]
fn a_surface_of_one_triangle_leaves_the_settings_for_the_next() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let bytes = b"v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n".to_vec();
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "one.obj".to_owned(), bytes });
    harness.run_steps(20);
    assert_eq!(harness.state().state().document.as_ref().unwrap().name, "one.obj");
    assert_eq!(harness.state().state().settings.target, Target::default());
    harness.get_by_role_and_label(Role::Button, "Sample").click();
    harness.run_steps(3);
    harness.get_by_label_contains("orta").click();
    harness.run_steps(3);
    settle(&mut harness);
    assert!((7_429..=7_430).contains(&shown(&harness)), "Table II at 90 %: {}", shown(&harness));
}

#[test]
fn a_typed_rate_and_a_typed_count_are_met() {
    let mut harness = open();
    type_into(&mut harness, "Reduction value", "99");
    assert_eq!(harness.state().state().settings.target, Target::Reduction(990));
    assert!((742..=743).contains(&shown(&harness)));
    type_into(&mut harness, "Triangles wanted", "18576");
    assert_eq!(harness.state().state().settings.target, Target::Triangles(18_576));
    assert!((18_575..=18_576).contains(&shown(&harness)));
}

#[test]
fn a_deviation_to_stop_at_is_chosen_set_and_left_again() {
    let mut harness = open();
    let largest = |harness: &Harness<'_, LumenApp>| {
        let measured = harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap();
        measured.report.deviation_mm.unwrap().max
    };
    let (before, deviation) = (shown(&harness), largest(&harness));
    choose(&mut harness, "Stop at", "Deviation");
    let bound = harness.state().state().settings.target.deviation_mm().unwrap();
    assert!((bound - deviation).abs() <= 1e-3, "it goes on from what is shown: {bound} beside {deviation}");
    assert!(harness.query_by_role_and_label(Role::Slider, "Reduction").is_none());
    for (typed, part) in [("0.3", 0.8), ("2", 0.95)] {
        type_into(&mut harness, "Largest deviation value", typed);
        settle(&mut harness);
        assert_eq!(harness.state().state().settings.target.deviation_mm(), typed.parse().ok());
        assert!(largest(&harness) <= typed.parse::<f64>().unwrap());
        let fine = shown(&harness);
        press_at(&mut harness, "Largest deviation", part);
        settle(&mut harness);
        assert!(shown(&harness) < fine, "a larger bound needs fewer triangles");
    }
    let found = shown(&harness);
    choose(&mut harness, "Stop at", "Rate or count");
    let rate = harness.state().state().settings.target;
    assert!(matches!(rate, Target::Reduction(_)) && rate.triangles(74_307).abs_diff(found) <= 75, "{rate:?}, {found}");
    for _ in 0..8 {
        if harness.state().state().settings.target == Target::default() {
            break;
        }
        harness.get_by_role_and_label(Role::Button, "Undo").click();
        harness.run_steps(2);
    }
    settle(&mut harness);
    assert_eq!(shown(&harness), before);
}

#[test]
fn the_next_coarser_level_is_that_of_the_settings() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    choose(&mut harness, "Stop at", "Deviation");
    settle(&mut harness);
    let measured = harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap();
    let next = format!("{:.3} mm", measured.report.bound.unwrap().next_coarser_mm.unwrap());
    assert!(harness.query_all_by_label(&next).next().is_some(), "{next}");
    memory.borrow_mut().runs = false;
    type_into(&mut harness, "Pass band value", "0.1");
    assert!(harness.query_all_by_label(&next).next().is_none(), "another smoothing has other levels");
}

#[test]
fn the_panel_says_how_far_is_safe_and_goes_there() {
    let mut harness = open();
    let percent = safe_percent(&mut harness);
    assert!((90.0..99.0).contains(&percent), "{percent}");
    assert!(harness.query_by_label(&format!("{percent:.1} %")).is_some());
    harness.get_by_role_and_label(Role::Button, "Go there").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::Button, "Go there").click();
    settle(&mut harness);
    let wanted = Target::Reduction((percent * 10.0).round() as u32);
    assert_eq!(harness.state().state().settings.target, wanted);
    assert_eq!(safe_percent(&mut harness), percent, "the same from every level");
}

/// Up to which rate a reduction is called safe, once that is known: it comes after the other numbers.
fn safe_percent(harness: &mut Harness<'_, LumenApp>) -> f64 {
    for _ in 0..4000 {
        let measured = harness.state().state().document.as_ref().and_then(|document| document.measured.as_ref());
        if let Some(safe) = measured.and_then(|measured| measured.report.safe.clone()) {
            harness.run_steps(2);
            return safe.percent.unwrap();
        }
        harness.step();
    }
    panic!("how far is safe is never told");
}

#[test]
fn the_other_method_leaves_less_deviation() {
    let mut harness = open();
    let mean = |harness: &Harness<'_, LumenApp>| {
        let document = harness.state().state().document.as_ref().unwrap();
        document.measured.as_ref().unwrap().report.deviation_mm.unwrap().mean
    };
    let (count, before) = (shown(&harness), mean(&harness));
    choose(&mut harness, "Method", "Quadric");
    settle(&mut harness);
    assert_eq!(harness.state().state().settings.decimation.method, Method::Quadric);
    assert!(shown(&harness).abs_diff(count) <= 1 && mean(&harness) < 0.7 * before, "{} {before}", mean(&harness));
}

/// Chooses from a list.
fn choose(harness: &mut Harness<'_, LumenApp>, list: &str, choice: &str) {
    harness.get_by_role_and_label(Role::ComboBox, list).scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::ComboBox, list).click();
    harness.run_steps(2);
    harness.get_by_label(choice).click();
    harness.run_steps(2);
}

#[test]
fn smoothing_is_set_by_slider_field_and_list_and_goes_back() {
    let mut harness = open();
    press_at(&mut harness, "Pass band", 0.9);
    assert!(harness.state().state().settings.smoothing.pass_band > 0.5);
    harness.get_by_role_and_label(Role::Button, "Reset pass band").click();
    harness.run_steps(2);
    assert!((harness.state().state().settings.smoothing.pass_band - 0.01).abs() < 1e-12);
    type_into(&mut harness, "Iterations value", "30");
    assert_eq!(harness.state().state().settings.smoothing.iterations, 30);
    harness.get_by_role_and_label(Role::ComboBox, "Window").click();
    harness.run_steps(2);
    harness.get_by_label("Nuttall").click();
    harness.run_steps(2);
    assert_eq!(harness.state().state().settings.smoothing.window, Window::Nuttall);
    settle(&mut harness);
    let measured = harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap();
    assert_eq!(measured.report.settings, harness.state().state().settings);
}

/// What the panel says of the filter's half gain: its eigenvalue and the length of the waves in mm.
fn half_gain(harness: &Harness<'_, LumenApp>) -> (f64, f64) {
    let nodes = harness.query_all_by_label_contains("Half gain at");
    let mut texts = nodes.filter_map(|node| node.accesskit_node().label().or(node.accesskit_node().value()));
    let text = texts.next().unwrap();
    let number = |after: &str| -> f64 {
        let rest = &text[text.find(after).unwrap() + after.len()..];
        let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
        rest[..end].parse().unwrap()
    };
    (number("k = "), number("waves of "))
}

#[test]
fn the_panel_says_where_the_filter_cuts_and_the_words_move_with_the_sliders() {
    let mut harness = open();
    harness.get_by_label("Response").click();
    harness.run_steps(10);
    let report = harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap().report.clone();
    let response = report.smoothing_response.unwrap();
    let (k, length) = half_gain(&harness);
    assert!((k / response.half_gain.unwrap() - 1.0).abs() < 0.01);
    assert!((length / response.wavelength_mm_at_half_gain.unwrap() - 1.0).abs() < 0.01);
    press_at(&mut harness, "Pass band", 0.6);
    let (wider, shorter) = half_gain(&harness);
    assert!(wider > 2.0 * k && shorter < length / 1.4, "{k} {length} became {wider} {shorter}");
    type_into(&mut harness, "Iterations value", "0");
    assert!(harness.query_by_label_contains("Half gain at").is_none(), "nothing is smoothed");
}

#[test]
fn the_volume_is_held_when_the_box_is_ticked() {
    let mut harness = open();
    harness.get_by_role_and_label(Role::CheckBox, "Preserve volume").click();
    settle(&mut harness);
    let measured = harness.state().state().document.as_ref().unwrap().measured.clone().unwrap();
    assert_eq!(measured.report.volume_held, Some(true));
    assert!(measured.report.settings.smoothing.preserve_volume);
}

#[test]
fn thin_vessels_are_spared_when_the_box_is_ticked() {
    let mut harness = open();
    let before = harness.state().state().document.as_ref().unwrap().levels.clone().unwrap().1;
    harness.get_by_role_and_label(Role::CheckBox, "Spare thin vessels").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::CheckBox, "Spare thin vessels").click();
    settle(&mut harness);
    let document = harness.state().state().document.as_ref().unwrap();
    assert!(document.measured.as_ref().unwrap().report.settings.decimation.spare_thin);
    assert!(document.levels.as_ref().unwrap().1 != before);
    assert!((7_429..=7_430).contains(&shown(&harness)));
}

#[test]
fn the_feature_angle_is_set() {
    let mut harness = open();
    type_into(&mut harness, "Feature angle value", "15");
    settle(&mut harness);
    assert!((harness.state().state().settings.decimation.feature_angle - 15.0).abs() < 1e-12);
}

#[test]
fn another_piece_is_chosen_in_the_list() {
    let mut harness = open();
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
fn undo_and_redo_walk_through_the_settings() {
    let mut harness = open();
    press_at(&mut harness, "Reduction", 0.2);
    let moved = harness.state().state().settings.clone();
    assert_ne!(moved.target, Target::default());
    harness.get_by_role_and_label(Role::Button, "Undo").click();
    harness.run_steps(2);
    assert_eq!(harness.state().state().settings.target, Target::default());
    assert!((7_429..=7_430).contains(&shown(&harness)));
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.run_steps(2);
    assert_eq!(harness.state().state().settings, moved);
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
    let notice = state.notice.as_ref().expect("a sentence");
    assert!(notice.is_error && notice.text.starts_with("scan.stl: ") && notice.text.ends_with('.'), "{notice:?}");
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
        harness.run_steps(10);
        let (name, bytes) = memory.borrow_mut().offered.pop().expect("a file is offered");
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
    let (mut harness, memory) = app(DESKTOP);
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
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let before = shown(&harness);
    memory.borrow_mut().slice = std::time::Duration::ZERO;
    harness.get_by_role_and_label(Role::Button, "Sample").click();
    harness.run_steps(3);
    harness.get_by_label_contains("oronary").click();
    harness.run_steps(20);
    assert!(harness.query_by_label_contains("Smoothing").is_some(), "it is read, and on its way");
    assert_eq!(shown(&harness), before);
    harness.get_by_role_and_label(Role::Button, "Cancel").click();
    harness.run_steps(5);
    let state = harness.state().state();
    assert!(state.opening().is_none());
    assert!(state.notice.as_ref().is_some_and(|notice| notice.text.contains("cancelled")));
    assert_eq!(state.document.as_ref().unwrap().name, "Abdominal aorta");
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
    assert!(harness.state().state().notice.as_ref().is_some_and(|notice| notice.text.contains("out of memory")));
    assert_eq!(shown(&harness), before);
    harness.run_steps(50);
    press_at(&mut harness, "Iterations", 0.1);
    settle(&mut harness);
    let state = harness.state().state();
    assert_eq!(state.document.as_ref().unwrap().measured.as_ref().unwrap().report.settings, state.settings);
}

#[test]
fn theme_help_and_about_open_and_close() {
    let mut harness = open();
    let dark = harness.ctx.theme();
    harness.get_by_role_and_label(Role::Button, "Theme").click();
    harness.run_steps(2);
    assert_ne!(harness.ctx.theme(), dark);
    harness.get_by_role_and_label(Role::Button, "About").click();
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("MIT or Apache-2.0").is_some());
    assert!(harness.query_by_label("Not for clinical decisions.").is_some());
    harness.get_by_role_and_label(Role::Button, "Close").click();
    harness.run_steps(3);
    assert!(harness.query_by_label_contains("MIT or Apache-2.0").is_none());
    harness.key_press(Key::F1);
    harness.run_steps(3);
    assert!(harness.query_by_label("Keys and gestures").is_some());
}

#[test]
fn the_views_turn_under_a_drag_and_show_the_surface_as_opened_while_b_is_held() {
    let mut harness = open();
    // What comes in the background changes the panel, and must not come between two pictures.
    safe_percent(&mut harness);
    let picture = harness.render().unwrap();
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    harness.drag_at(view.center());
    harness.run_steps(2);
    harness.hover_at(view.center() + egui::vec2(80.0, 0.0));
    harness.run_steps(2);
    harness.drop_at(view.center() + egui::vec2(80.0, 0.0));
    harness.run_steps(2);
    let turned = harness.render().unwrap();
    assert_ne!(picture.as_raw(), turned.as_raw());
    harness.key_down(Key::B);
    harness.run_steps(2);
    let before = harness.render().unwrap();
    assert_ne!(before.as_raw(), turned.as_raw());
    harness.key_up(Key::B);
    harness.run_steps(2);
    assert_eq!(harness.render().unwrap().as_raw(), turned.as_raw());
    // A slider that was moved keeps the focus.
    harness.get_by_role_and_label(Role::Slider, "Pass band").focus();
    harness.run_steps(2);
    let focused = harness.render().unwrap();
    harness.key_down(Key::B);
    harness.run_steps(2);
    assert_ne!(harness.render().unwrap().as_raw(), focused.as_raw());
}

#[test]
fn everything_is_there_on_a_phone() {
    let (mut harness, _) = app([390.0, 844.0]);
    settle(&mut harness);
    for (role, name) in [
        (Role::Button, "Open..."),
        (Role::Button, "Menu"),
        (Role::Image, "Shaded view"),
        (Role::Image, "Wireframe view"),
    ] {
        let rect = harness.get_by_role_and_label(role, name).rect();
        assert!(rect.left() >= 0.0 && rect.right() <= 390.0 && rect.bottom() <= 844.0, "{name} at {rect:?}");
    }
    let (shaded, wireframe) =
        ["Shaded view", "Wireframe view"].map(|name| harness.get_by_role_and_label(Role::Image, name).rect()).into();
    assert!(shaded.bottom() <= wireframe.top() + 1.0, "the views stack");
}
