//! The window: its sheets and bar, how its views turn, and what becomes of it when it is narrow.

use egui::Key;
use egui::accesskit::{Role, Toggled};
use egui_kittest::kittest::{NodeT, Queryable};
use lumen_ui_tests::told::{App, press};
use lumen_ui_tests::{DESKTOP, PHONE, app, drag, seen, settle, settle_wholly};

use crate::controls::{open, safe_percent};

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
    let mut harness = seen(open);
    // What comes in the background changes the panel, and must not come between two pictures.
    safe_percent(&mut harness);
    let picture = harness.render().unwrap();
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    drag(&mut harness, view.center(), egui::vec2(80.0, 0.0));
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

/// The tabs of the bar.
const TABS: [&str; 5] = ["Prepare", "Compare", "Vessels", "Measure", "Trial"];

#[test]
fn one_tab_is_open_at_a_time_and_the_first_leads_back() {
    let (mut harness, _) = app(DESKTOP);
    settle_wholly(&mut harness);
    let open = |harness: &App| {
        let is_open = |tab: &&str| {
            let node = harness.query_all_by_role_and_label(Role::Button, tab).next();
            node.expect(tab).accesskit_node().toggled() == Some(Toggled::True)
        };
        TABS.into_iter().filter(is_open).collect::<Vec<_>>()
    };
    assert_eq!(open(&harness), ["Prepare"]);
    for tab in ["Compare", "Vessels", "Measure", "Trial", "Prepare", "Vessels", "Compare", "Trial", "Prepare"] {
        for _again in 0..2 {
            harness.query_all_by_role_and_label(Role::Button, tab).next().expect(tab).click();
            harness.run_steps(3);
            assert_eq!(open(&harness), [tab]);
        }
        let state = harness.state();
        assert_eq!(state.trial().is_open(), tab == "Trial");
        assert_eq!(state.state().comparison.is_open(), tab == "Compare");
        assert_eq!(
            harness.query_by_role_and_label(Role::SpinButton, "Allowed change").is_some(),
            tab == "Vessels",
            "{tab}"
        );
        assert_eq!(harness.query_all_by_label("Ruler").next().is_some(), tab == "Measure", "{tab}");
    }
    // A trial is not ended by a click beside it.
    press(&mut harness, "Trial");
    for tab in ["Compare", "Vessels", "Measure"] {
        let node = harness.query_all_by_role_and_label(Role::Button, tab).next().expect(tab);
        assert!(node.accesskit_node().is_disabled(), "{tab}");
    }
    press(&mut harness, "Prepare");
    // By its key from another.
    press(&mut harness, "Compare");
    harness.key_press(Key::V);
    harness.run_steps(3);
    assert_eq!(open(&harness), ["Vessels"]);
    harness.key_press(Key::V);
    harness.run_steps(3);
    assert_eq!(open(&harness), ["Prepare"]);
}

#[test]
fn everything_is_there_on_a_phone() {
    let (mut harness, _) = app(PHONE);
    settle(&mut harness);
    for (role, name) in [
        (Role::Button, "Open..."),
        (Role::Button, "Menu"),
        (Role::Image, "Shaded view"),
        (Role::Image, "Wireframe view"),
    ] {
        let rect = harness.get_by_role_and_label(role, name).rect();
        assert!(rect.left() >= 0.0 && rect.right() <= PHONE[0] && rect.bottom() <= PHONE[1], "{name} at {rect:?}");
    }
    let (shaded, wireframe) =
        ["Shaded view", "Wireframe view"].map(|name| harness.get_by_role_and_label(Role::Image, name).rect()).into();
    assert!(shaded.bottom() <= wireframe.top() + 1.0, "the views stack");
}

#[test]
fn whatever_the_width_every_button_of_the_bar_is_in_the_window_or_in_the_menu() {
    for width in [360.0, 719.0, 721.0, 768.0, 900.0, 1024.0, 1109.0, 1111.0, 1280.0] {
        let (mut harness, _) = app([width, 800.0]);
        settle(&mut harness);
        let bar = ["Open...", "Sample", "Save", "View", "Learn", "Help", "About"];
        let mut missed: Vec<&str> = bar.into_iter().chain(TABS).collect();
        for menu in ["", "Menu", "Prepare"] {
            let is_there = harness.query_all_by_role_and_label(Role::Button, menu).next().map(|node| node.click());
            if is_there.is_some() {
                harness.run_steps(3);
            }
            missed.retain(|label| {
                let is_there = |rect: egui::Rect| rect.left() >= 0.0 && rect.right() <= width && rect.bottom() <= 800.0;
                !harness.query_all_by_role_and_label(Role::Button, label).any(|node| is_there(node.rect()))
            });
            if !menu.is_empty() {
                harness.key_press(Key::Escape);
                harness.run_steps(3);
            }
        }
        assert!(missed.is_empty(), "{missed:?} at {width}");
        let top = harness.query_all_by_role(Role::Button).map(|node| node.rect()).filter(|rect| rect.top() < 40.0);
        for rect in top {
            assert!(rect.right() <= width, "{rect:?} at {width}");
        }
    }
}

#[test]
fn a_large_window_has_larger_letters_and_a_smaller_one_has_not() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    let zoom = |harness: &App| harness.ctx.zoom_factor();
    assert_eq!(zoom(&harness), 1.0);
    let resize = |harness: &mut App, width: f32| {
        // In points as they are drawn.
        harness.set_size(egui::vec2(width, 900.0) / harness.ctx.zoom_factor());
        harness.run_steps(4);
    };
    resize(&mut harness, 1920.0);
    let grown = zoom(&harness);
    assert!(grown > 1.05 && grown < 1.3, "{grown}");
    // Whoever presents meanwhile, in the one or the other, leaves what suits the window.
    for (while_presenting, after) in [(1280.0, 1.0), (1920.0, grown)] {
        harness.key_press(Key::P);
        harness.run_steps(4);
        resize(&mut harness, while_presenting);
        harness.key_press(Key::P);
        harness.run_steps(4);
        assert!((zoom(&harness) - after).abs() < 1e-3, "{} of {after}", zoom(&harness));
    }
    // A zoom of the user's own stays.
    harness.ctx.set_zoom_factor(1.5);
    harness.run_steps(4);
    resize(&mut harness, 1280.0);
    assert_eq!(zoom(&harness), 1.5);
}
