//! The verdict above the controls, and the surface as it was opened beside what became of it in one picture.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::{LumenApp, PlatformEvent};
use lumen::io::Unit;
use lumen::pipeline::settings::{Smoothing, Target};
use lumen_ui_tests::{Memory, app, moving_app, says, settle, settle_wholly, tube};

const DESKTOP: [f32; 2] = [1280.0, 800.0];
/// The line in the shaded view.
const LINE: &str = "Divider between as opened and now";

type Shared = std::rc::Rc<std::cell::RefCell<Memory>>;

fn open(harness: &mut Harness<'_, LumenApp>, memory: &Shared, name: &str, bytes: Vec<u8>) {
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: name.to_owned(), bytes });
    harness.run_steps(20);
    settle_wholly(harness);
}

fn click(harness: &mut Harness<'_, LumenApp>, label: &str) {
    harness.get_by_role_and_label(Role::Button, label).click();
    harness.run_steps(3);
}

#[test]
fn what_is_safe_is_told_above_everything_and_leads_to_the_vessels() {
    let (mut harness, _) = app(DESKTOP);
    assert!(!says(&harness, "Safe to simulate on"), "before it is known");
    settle_wholly(&mut harness);
    let head = harness.get_by_label("Safe to simulate on").rect();
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    assert!(head.bottom() < view.top() && head.left() >= view.left());
    assert!(says(&harness, "keep their calibre to 2 %"));
    click(&mut harness, "Show vessels");
    assert!(harness.query_by_role_and_label(Role::SpinButton, "Allowed change").is_some());
}

#[test]
fn a_vessel_that_the_reduction_changes_is_named_shown_and_mended_by_a_click() {
    let (mut harness, _) = app(DESKTOP);
    settle_wholly(&mut harness);
    harness.get_by_role_and_label(Role::SpinButton, "Reduction value").click();
    harness.run_steps(2);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
    harness.event(egui::Event::Text("99.9".to_owned()));
    harness.run_steps(1);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    settle_wholly(&mut harness);
    assert!(!says(&harness, "Safe to simulate on") && says(&harness, "to look at"));
    let (before, rate) = (*harness.state().camera(), harness.state().state().settings.target);
    assert_eq!(rate, Target::Reduction(999));
    click(&mut harness, "Show me");
    assert!(harness.state().camera().distance < before.distance, "it goes there");
    let safe = harness.state().state().safe().unwrap().percent.unwrap();
    click(&mut harness, &format!("Reduce to {safe:.1} %"));
    settle_wholly(&mut harness);
    assert_eq!(harness.state().state().settings.target, Target::Reduction((safe * 10.0).round() as u32));
    assert!(says(&harness, "Safe to simulate on"));
    click(&mut harness, "Undo");
    assert_eq!(harness.state().state().settings.target, Target::Reduction(999), "one step");
}

#[test]
fn numbers_in_metres_are_read_again_at_a_click() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    // A tube of 5 mm and 80 mm, in metres.
    open(&mut harness, &memory, "tube.obj", tube(0.005, 0.08, 0.0008));
    assert!(says(&harness, "may be in m"), "as the unit is told");
    click(&mut harness, "Read in m");
    harness.run_steps(20);
    settle_wholly(&mut harness);
    let document = harness.state().state().document.as_ref().unwrap();
    assert_eq!(document.import.unit, Unit::Metre);
    let length = document.import.bounds_mm.size().z;
    assert!((length - 79.2).abs() < 1.0, "{length} mm");
    assert!(!says(&harness, "may be in"));
}

#[test]
fn a_vessel_that_smoothing_draws_shut_is_mended_by_what_suits_it() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "tube.obj", tube(1.5, 40.0, 0.7));
    harness.get_by_role_and_label(Role::ComboBox, "Strength").click();
    harness.run_steps(3);
    harness.get_by_label("The paper's").click();
    harness.run_steps(3);
    settle_wholly(&mut harness);
    assert!(says(&harness, "Smoothing has drawn a vessel shut at"));
    click(&mut harness, "Suits this surface");
    settle_wholly(&mut harness);
    assert!(harness.state().state().settings.smoothing.gives_same(&Smoothing::AUTO));
    assert!(!says(&harness, "shut at"));
}

#[test]
fn what_has_no_vessel_is_not_called_safe() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "one.obj", b"v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n".to_vec());
    assert!(!says(&harness, "Safe to simulate on"));
    assert!(says(&harness, "There are no vessels to measure"));
}

#[test]
fn nothing_moves_with_what_the_verdict_says() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    let top = |harness: &Harness<'_, LumenApp>| harness.get_by_role_and_label(Role::Image, "Shaded view").rect().min;
    let before = top(&harness);
    settle_wholly(&mut harness);
    assert_eq!(top(&harness), before);
    harness.get_by_role_and_label(Role::ComboBox, "Strength").click();
    harness.run_steps(3);
    harness.get_by_label("None").click();
    harness.run_steps(3);
    settle_wholly(&mut harness);
    assert_eq!(top(&harness), before);
}

#[test]
fn the_line_parts_what_was_opened_from_what_it_has_become() {
    let (mut harness, _) = app(DESKTOP);
    settle_wholly(&mut harness);
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    let part = |harness: &mut Harness<'_, LumenApp>, left: f32, right: f32| {
        let picture = harness.render().unwrap();
        let x = (view.left() + left * view.width()) as u32..(view.left() + right * view.width()) as u32;
        let y = (view.top() + 110.0) as u32..(view.bottom() - 130.0) as u32;
        Vec::from_iter(y.flat_map(|y| x.clone().map(move |x| (x, y))).map(|(x, y)| picture.get_pixel(x, y).0))
    };
    let half = part(&mut harness, 0.0, 0.4);
    let other = part(&mut harness, 0.5, 1.0);
    harness.key_down(Key::B);
    harness.run_steps(3);
    assert!(is_same(&half, &part(&mut harness, 0.0, 0.4)), "as it was opened");
    assert!(!is_same(&other, &part(&mut harness, 0.5, 1.0)), "as it is now");
    harness.key_up(Key::B);
    harness.run_steps(3);
    click(&mut harness, "Split");
    assert!(!is_same(&half, &part(&mut harness, 0.0, 0.4)), "as it is now, once it is not split");
    assert!(is_same(&other, &part(&mut harness, 0.5, 1.0)));
}

/// Whether two pictures are the same but for rounding.
fn is_same(a: &[[u8; 4]], b: &[[u8; 4]]) -> bool {
    let differ = |(a, b): (&[u8; 4], &[u8; 4])| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 2);
    a.iter().zip(b).filter(|&pair| differ(pair)).count() * 1000 < a.len()
}

#[test]
fn the_line_is_moved_by_pointer_and_by_keys() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    let at = |harness: &Harness<'_, LumenApp>| {
        harness.get_by_role_and_label(Role::Slider, LINE).accesskit_node().numeric_value().unwrap()
    };
    assert_eq!(at(&harness), 45.0);
    let before = *harness.state().camera();
    let line = harness.get_by_role_and_label(Role::Slider, LINE).rect().center();
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    harness.drag_at(line);
    harness.hover_at(line + egui::vec2(view.width() / 4.0, 0.0));
    harness.run_steps(2);
    harness.drop_at(line + egui::vec2(view.width() / 4.0, 0.0));
    harness.run_steps(2);
    assert_eq!(at(&harness), 70.0);
    harness.get_by_role_and_label(Role::Slider, LINE).focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(2);
    assert_eq!(at(&harness), 68.0);
    assert_eq!(*harness.state().camera(), before, "the camera stays");
}

#[test]
fn at_the_first_start_the_line_comes_from_the_right_where_motion_is_welcome() {
    let (mut harness, _) = moving_app(DESKTOP, 1.0 / 20.0);
    let mut places = Vec::new();
    for _ in 0..2000 {
        harness.step();
        let line = harness.query_by_role_and_label(Role::Slider, LINE);
        places.extend(line.and_then(|line| line.accesskit_node().numeric_value()));
        if places.last() == Some(&45.0) {
            break;
        }
    }
    assert!(places.len() > 20 && places[0] > 99.0, "{places:?}");
    assert!(places.is_sorted_by(|a, b| a >= b) && places.last() == Some(&45.0), "{places:?}");
}
