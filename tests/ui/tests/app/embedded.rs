//! A part of another page, however low: the vessel is seen, the three sliders are dragged, and nothing lies over anything.

use std::cell::RefCell;
use std::rc::Rc;

use egui::Rect;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use lumen::app::LumenApp;
use lumen_ui_tests::{Kept, Memory, app, in_hand, page_in_full, says, settle, settle_wholly};

const SLIDERS: [&str; 3] = ["Pass band", "Iterations", "Reduction"];

/// The sample in a part of another page, of this size.
fn embedded(size: [f32; 2], has_finger: bool) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    let (mut harness, memory) = if has_finger { in_hand(size, 0.25, false) } else { app(size) };
    memory.borrow_mut().is_embedded = true;
    memory.borrow_mut().address = Some("https://a.example/lumen/".to_owned());
    settle_wholly(&mut harness);
    harness.run_steps(4);
    (harness, memory)
}

fn views(harness: &Harness<'_, LumenApp>) -> Vec<Rect> {
    let views = ["Shaded view", "Wireframe view"];
    views.into_iter().filter_map(|view| Some(harness.query_by_role_and_label(Role::Image, view)?.rect())).collect()
}

#[test]
fn in_a_low_part_of_a_page_a_view_is_large_enough_to_turn_and_sliders_and_verdict_are_in_sight() {
    for (size, has_finger) in [([500.0, 320.0], false), ([500.0, 320.0], true), ([640.0, 400.0], false)] {
        let (harness, _) = embedded(size, has_finger);
        let window = Rect::from_min_size(egui::Pos2::ZERO, size.into());
        let views = views(&harness);
        assert!(views.iter().any(|view| view.height() >= 140.0 && view.width() >= 200.0), "{views:?} of {size:?}");
        for slider in SLIDERS {
            let rect = harness.get_by_role_and_label(Role::Slider, slider).rect();
            assert!(window.contains_rect(rect), "{slider} at {rect} in {size:?}");
            assert!(rect.height() >= if has_finger { 44.0 } else { 20.0 }, "{slider} at {rect}");
            assert!(views.iter().all(|view| view.intersect(rect).height() <= 0.0), "{slider} at {rect} over {views:?}");
        }
        let head = harness.get_by_label("Safe to simulate on").rect();
        assert!(
            window.contains_rect(head) && views.iter().all(|view| view.top() >= head.bottom()),
            "{head}, {views:?}"
        );
        assert!(says(&harness, "triangles"));
    }
}

#[test]
fn the_way_to_the_whole_stands_in_the_bar_below() {
    let size = [500.0, 320.0];
    // Links lead to samples as users have them.
    let (mut harness, memory) = page_in_full(size, Kept::default());
    memory.borrow_mut().is_embedded = true;
    memory.borrow_mut().kept = None;
    settle(&mut harness);
    let link = harness.get_by_label("Open in Lumen").rect();
    assert!(Rect::from_min_size(egui::Pos2::ZERO, size.into()).contains_rect(link), "{link}");
    let count = harness.query_all_by_label_contains("triangles").map(|node| node.rect());
    assert!(count.into_iter().all(|count| !count.intersects(link)), "beside what is told");
    assert!(views(&harness).iter().all(|view| view.height() >= 140.0 && !view.intersects(link)));
}

#[test]
fn where_a_low_part_is_narrow_one_view_has_tabs() {
    let (mut harness, _) = embedded([240.0, 460.0], true);
    assert_eq!(views(&harness).len(), 1);
    harness.get_by_role_and_label(Role::Button, "Wireframe").click();
    harness.run_steps(3);
    assert!(harness.query_by_role_and_label(Role::Image, "Wireframe view").is_some() && views(&harness).len() == 1);
}

#[test]
fn the_field_of_a_slider_does_not_cover_its_name() {
    for size in [[500.0, 320.0], [640.0, 400.0], [640.0, 560.0], [700.0, 560.0], [900.0, 600.0]] {
        let (harness, _) = embedded(size, false);
        for slider in SLIDERS {
            let field = harness.get_by_role_and_label(Role::SpinButton, &format!("{slider} value")).rect();
            let names = [slider.to_owned(), format!("{slider} (auto)")];
            let mut found = names.iter().flat_map(|name| harness.query_all_by_role_and_label(Role::Label, name));
            let name = found.next().expect("the whole name").rect();
            assert!(name.right() <= field.left(), "{slider} at {name} under its field at {field} of {size:?}");
        }
    }
}
