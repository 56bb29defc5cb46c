//! The surface as it was opened beside what became of it, in one picture with a line between.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::LumenApp;
use lumen::pipeline::settings::Keep;
use lumen_ui_tests::{DESKTOP, app, drag, moving_app, seen, settle, settle_wholly};

/// The line in the shaded view.
const LINE: &str = "Divider between as opened and now";
/// That in the wireframe view.
const LINE_IN_WIREFRAME: &str = "Divider in the wireframe";

#[test]
fn the_line_parts_what_was_opened_from_what_it_has_become() {
    let (mut harness, _) = seen(|| app(DESKTOP));
    settle_wholly(&mut harness);
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    let part = |harness: &mut Harness<'_, LumenApp>, left: f32, right: f32| part(harness, view, left, right);
    let half = part(&mut harness, 0.0, 0.4);
    let other = part(&mut harness, 0.5, 1.0);
    harness.key_down(Key::B);
    harness.run_steps(3);
    assert!(is_same(&half, &part(&mut harness, 0.0, 0.4)), "as it was opened");
    assert!(!is_same(&other, &part(&mut harness, 0.5, 1.0)), "as it is now");
    harness.key_up(Key::B);
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::Button, "Split").click();
    harness.run_steps(3);
    assert!(!is_same(&half, &part(&mut harness, 0.0, 0.4)), "as it is now, once it is not split");
    assert!(is_same(&other, &part(&mut harness, 0.5, 1.0)));
}

/// The pixels between two parts of the width of a view.
fn part(harness: &mut Harness<'_, LumenApp>, view: egui::Rect, left: f32, right: f32) -> Vec<[u8; 4]> {
    let picture = harness.render().unwrap();
    let x = (view.left() + left * view.width()) as u32..(view.left() + right * view.width()) as u32;
    let y = (view.top() + 110.0) as u32..(view.bottom() - 130.0) as u32;
    Vec::from_iter(y.flat_map(|y| x.clone().map(move |x| (x, y))).map(|(x, y)| picture.get_pixel(x, y).0))
}

#[test]
fn the_wireframe_is_parted_by_the_same_line_where_that_is_chosen() {
    let (mut harness, _) = seen(|| app(DESKTOP));
    settle_wholly(&mut harness);
    let view = harness.get_by_role_and_label(Role::Image, "Wireframe view").rect();
    let parts = |harness: &mut Harness<'_, LumenApp>| [part(harness, view, 0.0, 0.4), part(harness, view, 0.5, 1.0)];
    assert!(harness.query_by_role_and_label(Role::Slider, LINE_IN_WIREFRAME).is_none());
    let [left, right] = parts(&mut harness);
    harness.get_by_role_and_label(Role::Button, "View").click();
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::CheckBox, "Wireframe split too").click();
    harness.run_steps(3);
    harness.key_press(Key::Escape);
    harness.hover_at(egui::pos2(4.0, 796.0));
    harness.run_steps(3);
    let [opened, now] = parts(&mut harness);
    assert!(!is_same(&opened, &left) && is_same(&now, &right), "as opened at the left alone");
    harness.key_down(Key::B);
    harness.run_steps(3);
    let held = parts(&mut harness);
    assert!(is_same(&opened, &held[0]) && !is_same(&now, &held[1]), "what the left has is the surface as opened");
    harness.key_up(Key::B);
    harness.run_steps(3);
    // One line: moved in one view, it moves in both.
    harness.get_by_role_and_label(Role::Slider, LINE_IN_WIREFRAME).focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowRight);
    harness.run_steps(2);
    for line in [LINE, LINE_IN_WIREFRAME] {
        let at = harness.get_by_role_and_label(Role::Slider, line).accesskit_node().numeric_value();
        assert_eq!(at, Some(47.0), "{line}");
    }
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
    drag(&mut harness, line, egui::vec2(view.width() / 4.0, 0.0));
    assert_eq!(at(&harness), 70.0);
    harness.get_by_role_and_label(Role::Slider, LINE).focus();
    harness.run_steps(2);
    harness.key_press(Key::ArrowLeft);
    harness.run_steps(2);
    assert_eq!(at(&harness), 68.0);
    assert_eq!(*harness.state().camera(), before, "the camera stays");
}

#[test]
fn at_the_start_the_line_comes_from_the_right_where_motion_is_welcome() {
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

#[test]
fn laplacian_smoothing_is_seen_at_the_left_of_the_line_and_goes_again() {
    let (mut harness, _) = seen(|| app(DESKTOP));
    settle_wholly(&mut harness);
    harness.get_by_label("Response").click();
    harness.run_steps(10);
    let tick = |harness: &mut Harness<'_, LumenApp>, label: &str| {
        harness.get_by_role_and_label(Role::CheckBox, label).scroll_to_me();
        harness.run_steps(12);
        harness.get_by_role_and_label(Role::CheckBox, label).click();
        harness.run_steps(3);
    };
    tick(&mut harness, "Laplacian beside it");
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    let line = harness.get_by_role_and_label(Role::Slider, "Divider between as opened and now").rect().center().x;
    // The pixels that are not as they were, at the left of the line and at its right.
    let picture = |harness: &mut Harness<'_, LumenApp>| -> Vec<[u8; 4]> {
        harness.render().unwrap().pixels().map(|pixel| pixel.0).collect()
    };
    let changed = |before: &[[u8; 4]], after: &[[u8; 4]]| {
        let at = |x: u32, y: u32| y as usize * DESKTOP[0] as usize + x as usize;
        let differs = |x: u32, y: u32| before[at(x, y)] != after[at(x, y)];
        let of = |from: f32, to: f32| {
            let rows = view.top() as u32..view.bottom() as u32;
            rows.flat_map(|y| (from as u32..to as u32).map(move |x| (x, y))).filter(|&(x, y)| differs(x, y)).count()
        };
        [of(view.left(), line - 12.0), of(line + 60.0, view.right())]
    };
    let before = picture(&mut harness);
    tick(&mut harness, "In the picture, too");
    let averaged = |harness: &Harness<'_, LumenApp>| {
        let document = harness.state().state().document.as_ref()?;
        document.averaged(Keep::Largest).map(|averaged| averaged.passes)
    };
    for _ in 0..2000 {
        if averaged(&harness).is_some() {
            break;
        }
        harness.step();
    }
    assert_eq!(averaged(&harness), Some(100));
    harness.run_steps(3);
    let [left, right] = changed(&before, &picture(&mut harness));
    assert!(left > 2000 && right == 0, "{left} pixels at the left, {right} at the right");
    // Held, it takes the whole view, and says what it is.
    harness.key_down(Key::B);
    harness.run_steps(3);
    let description = harness
        .get_by_role_and_label(Role::Image, "Shaded view")
        .accesskit_node()
        .data()
        .description()
        .map(str::to_owned);
    assert!(description.as_deref().is_some_and(|said| said.contains("100 Laplacian passes")), "{description:?}");
    harness.key_up(Key::B);
    harness.run_steps(3);
    // So does the line in either view.
    let called = |harness: &Harness<'_, LumenApp>, line: &str| {
        let name = format!("{line} 100 Laplacian passes and now");
        harness.query_by_role_and_label(Role::Slider, &name).is_some()
    };
    assert!(called(&harness, "Divider between") && !called(&harness, "Divider in the wireframe between"));
    let split_lines = |harness: &mut Harness<'_, LumenApp>| {
        harness.get_by_role_and_label(Role::Button, "View").click();
        harness.run_steps(3);
        harness.get_by_role_and_label(Role::CheckBox, "Wireframe split too").click();
        harness.run_steps(3);
        harness.key_press(Key::Escape);
        harness.run_steps(3);
    };
    split_lines(&mut harness);
    assert!(called(&harness, "Divider in the wireframe between"));
    split_lines(&mut harness);
    tick(&mut harness, "In the picture, too");
    harness.run_steps(3);
    assert_eq!(averaged(&harness), None);
    assert_eq!(changed(&before, &picture(&mut harness)), [0, 0]);
}
