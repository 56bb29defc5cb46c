//! For those who use the keyboard alone, or do not see the window: sliders and views by keys, and what is told.

use egui::Key;
use egui::accesskit::{Live, Role};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::LumenApp;
use lumen::pipeline::settings::Target;
use lumen_ui_tests::{DESKTOP, app, app_in_full, settle, settle_wholly};

fn target(harness: &Harness<'_, LumenApp>) -> Target {
    harness.state().state().settings.target
}

fn press(harness: &mut Harness<'_, LumenApp>, key: Key) {
    harness.key_press(key);
    harness.run_steps(3);
}

#[test]
fn page_up_and_down_go_a_tenth_of_a_slider_and_home_and_end_to_its_ends() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    let before = target(&harness);
    harness.get_by_role_and_label(Role::Slider, "Reduction").focus();
    harness.run_steps(2);
    let most = Target::MAX_PER_MILLE;
    let tenth = (f64::from(most) / 10.0).round() as u32;
    for (key, expected) in
        [(Key::Home, 0), (Key::PageUp, tenth), (Key::End, most), (Key::PageDown, most - tenth), (Key::PageUp, most)]
    {
        press(&mut harness, key);
        let Target::Reduction(rate) = target(&harness) else { panic!("the slider sets a rate") };
        assert!(rate.abs_diff(expected) <= 1, "{key:?}: {rate} for {expected}");
    }
    harness.get_by_role_and_label(Role::Button, "Undo").click();
    harness.run_steps(3);
    assert!(target(&harness) != Target::Reduction(most) && target(&harness) != before, "each is a step of its own");
}

#[test]
fn arrows_turn_the_view_that_has_the_focus_and_leave_it_there() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    let before = harness.state().camera().rotation;
    harness.get_by_role_and_label(Role::Image, "Wireframe view").focus();
    harness.run_steps(2);
    harness.key_down(Key::ArrowRight);
    harness.run_steps(6);
    harness.key_up(Key::ArrowRight);
    harness.run_steps(2);
    assert!(harness.state().camera().rotation.angle_between(before) > 0.05);
    assert!(harness.get_by_role_and_label(Role::Image, "Wireframe view").is_focused());
}

#[test]
fn space_holds_the_surface_as_it_was_opened_where_no_control_has_the_focus() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    let opened = |harness: &Harness<'_, LumenApp>| {
        let view = harness.get_by_role_and_label(Role::Image, "Shaded view");
        view.accesskit_node().data().description().is_some_and(|what| what.contains("as it was opened"))
    };
    harness.key_down(Key::Space);
    harness.run_steps(3);
    assert!(opened(&harness));
    harness.key_up(Key::Space);
    harness.run_steps(3);
    assert!(!opened(&harness));
    harness.get_by_role_and_label(Role::Slider, "Reduction").focus();
    harness.run_steps(2);
    harness.key_down(Key::Space);
    harness.run_steps(3);
    assert!(!opened(&harness), "a control that has the focus has the key");
    harness.key_up(Key::Space);
}

#[test]
fn views_and_what_goes_on_are_told_and_headings_are_headings() {
    let (mut harness, _) = app_in_full(DESKTOP);
    settle_wholly(&mut harness);
    let what = |harness: &Harness<'_, LumenApp>| {
        let view = harness.get_by_role_and_label(Role::Image, "Shaded view");
        view.accesskit_node().data().description().map(str::to_owned).unwrap_or_default()
    };
    let told = what(&harness);
    assert!(told.contains("from the front, 7,4") && told.contains("narrowest"), "{told}");
    press(&mut harness, Key::Num3);
    assert!(what(&harness).contains("from the left"));
    let news: Vec<_> = harness.query_all_by_role(Role::Status).collect();
    let [news] = &news[..] else { panic!("{} nodes tell what goes on", news.len()) };
    let node = news.accesskit_node();
    assert_eq!(node.data().live(), Some(Live::Polite));
    assert!(node.data().value().is_some_and(|text| text.contains("Safe to simulate on")), "{:?}", node.data().value());
    for heading in ["Surface", "Smooth", "Reduce", "Result"] {
        assert!(harness.query_by_role_and_label(Role::Heading, heading).is_some(), "{heading}");
    }
}
