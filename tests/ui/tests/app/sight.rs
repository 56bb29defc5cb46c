//! What is always in sight, on every screen and with a vessel open that has much to say of itself: what is dragged, how far is
//! safe, and in a trial the way on and the way out.

use egui::accesskit::Role;
use egui::{Key, Rect, Vec2, pos2};
use egui_kittest::kittest::Queryable;
use lumen_test_support::data::data;
use lumen_ui_tests::told::{App, FIRST, at_entry, frame, now, ready, start, tell};
use lumen_ui_tests::{DESKTOP, PHONE, app, in_hand, open, settle, unfold};

use crate::mending::faulty;

/// Width and height in points, and whether a finger points there.
type Screen = ([f32; 2], bool);

const TABLET: Screen = ([768.0, 1024.0], true);
const SCREENS: [Screen; 7] = [
    (DESKTOP, false),
    ([1920.0, 1080.0], false),
    ([1080.0, 1920.0], false),
    (PHONE, false),
    (PHONE, true),
    TABLET,
    ([1024.0, 768.0], true),
];

/// What is dragged, and what goes with it.
const DRAGGED: [(Role, &str); 8] = [
    (Role::Slider, "Pass band"),
    (Role::SpinButton, "Pass band value"),
    (Role::Slider, "Iterations"),
    (Role::SpinButton, "Iterations value"),
    (Role::Slider, "Reduction"),
    (Role::SpinButton, "Reduction value"),
    (Role::Button, "Go there"),
    (Role::Label, "Triangles"),
];

/// Files with a unit and axes to be chosen, faults and pieces: one that is made here, and a real one where there are any.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    let real = data().and_then(|folder| std::fs::read(folder.join("real/aorta-surface-open-ends.stl")).ok());
    let real = real.map(|bytes| ("aorta.stl", bytes));
    std::iter::once(("faulty.obj", faulty())).chain(real).collect()
}

/// The part of the window between its bars.
fn between_bars(harness: &App, [width, height]: [f32; 2]) -> Rect {
    let top = harness.get_by_role_and_label(Role::Button, "Open...").rect().bottom();
    Rect::from_min_max(pos2(0.0, top), pos2(width, height - 41.0))
}

fn is_in_sight(harness: &App, size: [f32; 2], (role, name): (Role, &str)) -> Rect {
    let (rect, sight) = (harness.get_by_role_and_label(role, name).rect(), between_bars(harness, size));
    assert!(sight.contains_rect(rect), "{name} at {rect} in a window of {size:?}");
    rect
}

fn open_on((size, has_finger): Screen) -> (App, std::rc::Rc<std::cell::RefCell<lumen_ui_tests::Memory>>) {
    let (mut harness, memory) = if has_finger { in_hand(size, 0.25, false) } else { app(size) };
    settle(&mut harness);
    (harness, memory)
}

#[test]
fn what_is_dragged_is_in_sight_on_every_screen_whatever_is_open() {
    for screen in SCREENS {
        for (name, bytes) in files() {
            let (mut harness, memory) = open_on(screen);
            open(&mut harness, &memory, name, bytes);
            let _ = DRAGGED.map(|control| is_in_sight(&harness, screen.0, control));
        }
    }
}

#[test]
fn what_is_dragged_is_in_sight_however_far_the_sheet_is_drawn_up() {
    for screen in [(PHONE, true), TABLET] {
        let (mut harness, memory) = open_on(screen);
        open(&mut harness, &memory, "faulty.obj", faulty());
        for stop in ["low", "half", "full"] {
            assert!(harness.query_by_label(&format!("Panel height: {stop}")).is_some(), "{stop}");
            let _ = DRAGGED.map(|control| is_in_sight(&harness, screen.0, control));
            harness.get_by_label_contains("Panel height").click();
            harness.run_steps(4);
        }
    }
}

#[test]
fn what_is_dragged_stays_where_it_is_when_the_rest_is_scrolled() {
    let (mut harness, memory) = open_on((DESKTOP, false));
    open(&mut harness, &memory, "faulty.obj", faulty());
    let before = DRAGGED.map(|control| is_in_sight(&harness, DESKTOP, control));
    for step in ["Surface", "Advanced: Smooth", "Advanced: Reduce"] {
        unfold(&mut harness, step);
    }
    let first = harness.get_by_role_and_label(Role::Heading, "Surface").rect();
    harness.get_by_role_and_label(Role::DisclosureTriangle, "Time a stage").scroll_to_me();
    harness.run_steps(12);
    let scrolled = first.top() - harness.get_by_role_and_label(Role::Heading, "Surface").rect().top();
    assert!(scrolled > 100.0, "{scrolled}");
    assert_eq!(DRAGGED.map(|control| is_in_sight(&harness, DESKTOP, control)), before);
}

#[test]
fn what_is_changed_once_stands_below_what_is_dragged_and_is_folded() {
    let (mut harness, memory) = open_on((DESKTOP, false));
    open(&mut harness, &memory, "faulty.obj", faulty());
    let lowest = DRAGGED.map(|control| is_in_sight(&harness, DESKTOP, control).bottom());
    let lowest = lowest.into_iter().fold(0.0, f32::max);
    let top =
        |harness: &App, role, name: &str| harness.query_by_role_and_label(role, name).map(|node| node.rect().top());
    let [surface, smooth, strength] =
        [(Role::Heading, "Surface"), (Role::Heading, "Smooth"), (Role::ComboBox, "Strength")]
            .map(|(role, name)| top(&harness, role, name).expect(name));
    assert!(lowest < surface && surface < smooth && smooth < strength, "{lowest} {surface} {smooth} {strength}");
    let once = [
        (Role::ComboBox, "Unit"),
        (Role::ComboBox, "Axes"),
        (Role::CheckBox, "Fill holes up to"),
        (Role::ComboBox, "Window"),
    ];
    for (role, name) in once {
        assert_eq!(top(&harness, role, name), None, "{name}");
    }
    unfold(&mut harness, "Advanced: Smooth");
    unfold(&mut harness, "Surface");
    for (role, name) in once {
        assert!(top(&harness, role, name).is_some_and(|top| top > lowest || name != "Window"), "{name}");
    }
}

#[test]
fn keys_go_from_what_is_dragged_to_what_stands_below_it() {
    let (mut harness, _) = open_on((DESKTOP, false));
    harness.get_by_role_and_label(Role::Slider, "Reduction").focus();
    harness.run_steps(2);
    let is_at = |harness: &App, (role, name)| harness.get_by_role_and_label(role, name).is_focused();
    let mut reached = Vec::new();
    for _ in 0..8 {
        harness.key_press(Key::Tab);
        harness.run_steps(2);
        let stops = [(Role::DisclosureTriangle, "Surface"), (Role::ComboBox, "Strength")];
        reached.extend(stops.into_iter().filter(|&stop| is_at(&harness, stop)).map(|(_, name)| name));
    }
    assert_eq!(reached, ["Surface", "Strength"], "in the order of what is seen");
}

#[test]
fn a_window_too_low_for_both_scrolls_what_is_dragged_too() {
    for screen in [([844.0, 390.0], true), ([640.0, 320.0], false)] {
        let (mut harness, _) = open_on(screen);
        for control in [(Role::Slider, "Pass band"), (Role::Button, "Go there"), (Role::Button, "Vessels")] {
            harness.query_all_by_role_and_label(control.0, control.1).last().expect(control.1).scroll_to_me();
            harness.run_steps(12);
            let rect = harness.query_all_by_role_and_label(control.0, control.1).last().unwrap().rect();
            assert!(between_bars(&harness, screen.0).contains_rect(rect), "{control:?} at {rect} on {screen:?}");
        }
    }
}

#[test]
fn a_tablet_that_is_held_upright_has_the_views_above_the_panel() {
    let (mut harness, _) = open_on(TABLET);
    for _tap in 0..3 {
        let views =
            ["Shaded view", "Wireframe view"].map(|name| harness.get_by_role_and_label(Role::Image, name).rect());
        let handle = harness.get_by_label_contains("Panel height").rect();
        for view in views {
            assert!(view.bottom() <= handle.top() + 1.0 && view.width() > 350.0, "{view} above {handle}");
        }
        let sliders = ["Pass band", "Iterations", "Reduction"]
            .map(|name| harness.get_by_role_and_label(Role::Slider, name).rect());
        assert!(sliders.iter().all(|rect| (rect.top() - sliders[0].top()).abs() < 1.0), "side by side: {sliders:?}");
        assert!(sliders[0].right() < sliders[1].left() && sliders[1].right() < sliders[2].left(), "{sliders:?}");
        harness.get_by_label_contains("Panel height").click();
        harness.run_steps(4);
    }
}

#[test]
fn the_way_on_and_the_way_out_of_a_trial_are_in_sight() {
    for screen in [(DESKTOP, false), (PHONE, true), TABLET] {
        let (mut harness, memory) = open_on(screen);
        start(&mut harness);
        tell(&mut harness, &memory, [ready(FIRST), now(FIRST, at_entry()), now(FIRST, frame())]);
        harness.run_steps(4);
        let [autopilot, _] = ["Autopilot", "Close"].map(|name| is_in_sight(&harness, screen.0, (Role::Button, name)));
        let views = harness.get_by_role_and_label(Role::Image, "Trial view").rect();
        assert!(!views.intersects(autopilot), "{views} over {autopilot}");
    }
}

/// The card over the sample, by its button.
fn invitation(harness: &App, button: &str) -> Option<Rect> {
    harness.query_by_role_and_label(Role::Button, button).map(|node| node.rect())
}

#[test]
fn the_sample_invites_to_open_a_vessel_until_one_is_open() {
    let (mut harness, memory) = open_on((DESKTOP, false));
    let rect = invitation(&harness, "open one").expect("an invitation");
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    assert!(view.contains_rect(rect) && harness.query_by_label("Drop a vessel here, or").is_some());
    harness.get_by_role_and_label(Role::Button, "open one").click();
    harness.run_steps(3);
    assert_eq!(memory.borrow().asked, 1, "a file is chosen");
    assert!(invitation(&harness, "open one").is_some(), "none was yet");
    open(&mut harness, &memory, "faulty.obj", faulty());
    assert_eq!(invitation(&harness, "open one"), None);
    harness.get_by_role_and_label(Role::Button, "Sample").click();
    harness.run_steps(3);
    harness.get_by_label("Abdominal aorta").click();
    harness.run_steps(3);
    settle(&mut harness);
    assert_eq!(invitation(&harness, "open one"), None, "who has opened one knows how");
}

#[test]
fn a_drag_over_the_invitation_turns_the_view_and_a_cross_takes_it_off() {
    let (mut harness, _) = open_on((DESKTOP, false));
    let before = harness.state().camera().rotation;
    let words = harness.get_by_label("Drop a vessel here, or").rect().center();
    lumen_ui_tests::drag(&mut harness, words, Vec2::new(60.0, 0.0));
    assert!(harness.state().camera().rotation.angle_between(before) > 0.05);
    harness.get_by_role_and_label(Role::Button, "Close the invitation").click();
    harness.run_steps(3);
    assert_eq!(invitation(&harness, "open one"), None);
}

#[test]
fn a_finger_is_not_asked_to_drop_anything() {
    let (harness, _) = open_on((PHONE, true));
    let rect = invitation(&harness, "Open a vessel").expect("an invitation");
    // The grip of the line between as opened and now stands at 85 % of the height, 11 points around.
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    let grip = view.top() + 0.85 * view.height();
    assert!(rect.bottom() < grip - 11.0 || rect.top() > grip + 11.0, "{rect} over the grip in {view}");
    assert!(rect.size().min_elem() >= 44.0 && harness.query_by_label_contains("Drop").is_none(), "{rect}");
}

#[test]
fn neither_a_lesson_nor_a_link_is_interrupted_by_an_invitation() {
    for fragment in ["#lesson=pass-band&step=1", "#v=1&sample=aorta&reduction=70"] {
        let (mut harness, memory) = open_on((DESKTOP, false));
        crate::recovery::tell(
            &mut harness,
            &memory,
            lumen::app::PlatformEvent::Linked { fragment: fragment.to_owned() },
        );
        assert_eq!(invitation(&harness, "open one"), None, "{fragment}");
    }
    let (mut harness, _) = open_on((DESKTOP, false));
    crate::teaching::click(&mut harness, "Learn");
    crate::teaching::click(&mut harness, "Stair-steps");
    settle(&mut harness);
    assert_eq!(invitation(&harness, "open one"), None, "a lesson from the menu");
}

#[test]
fn the_verdict_names_a_sample_as_a_sample_and_nothing_else() {
    let (mut harness, memory) = open_on((DESKTOP, false));
    let is_named = |harness: &App| harness.query_all_by_label_contains("Sample: ").next().is_some();
    assert!(is_named(&harness));
    open(&mut harness, &memory, "faulty.obj", faulty());
    assert!(!is_named(&harness));
}
