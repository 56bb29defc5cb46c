//! A phone, held in the hand: what a finger does that a mouse does not.

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Pos2, TouchDeviceId, TouchId, TouchPhase, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::{LumenApp, PlatformEvent};
use lumen_ui_tests::told::{put_on, wait};
use lumen_ui_tests::{PHONE, app, in_hand, phone, says, settle, settle_wholly, unfold};

use crate::controls::shown;
use crate::recovery::tell;
use crate::scans::ball;
use crate::targets::fits_a_finger;
use crate::teaching::click;

type App = Harness<'static, LumenApp>;

fn finger(harness: &App, phase: TouchPhase, pos: Pos2) {
    let (device_id, id) = (TouchDeviceId(1), TouchId(1));
    harness.event(Event::Touch { device_id, id, phase, pos, force: None });
}

/// Puts a finger down, moves it in ten steps and takes it up again. As browsers have it, it is a pointer too.
fn swipe(harness: &mut App, from: Pos2, way: Vec2) {
    finger(harness, TouchPhase::Start, from);
    harness.hover_at(from);
    harness.drag_at(from);
    harness.run_steps(1);
    for step in 1..=10 {
        let at = from + way * (step as f32 / 10.0);
        finger(harness, TouchPhase::Move, at);
        harness.hover_at(at);
        harness.run_steps(1);
    }
    finger(harness, TouchPhase::End, from + way);
    harness.drop_at(from + way);
    harness.run_steps(3);
}

/// Unfolds what has a slider in what scrolls.
fn unfold_angle(harness: &mut App) {
    unfold(harness, "Advanced: Reduce");
    harness.get_by_role_and_label(Role::Slider, "Feature angle").scroll_to_me();
    harness.run_steps(12);
}

#[test]
fn a_finger_that_goes_up_over_a_slider_scrolls_and_one_that_goes_aside_moves_it() {
    let (mut harness, _) = phone();
    settle(&mut harness);
    draw_up(&mut harness);
    unfold_angle(&mut harness);
    let place = |harness: &App, role| harness.get_by_role_and_label(role, "Feature angle").rect();
    let before = harness.state().state().settings.clone();
    let slider = place(&harness, Role::Slider);
    // Not on the knob, and not straight: where the value would be another.
    swipe(&mut harness, slider.lerp_inside(vec2(0.8, 0.5)), vec2(20.0, -120.0));
    assert_eq!(harness.state().state().settings, before, "the value stays");
    let moved = place(&harness, Role::Slider).top() - slider.top();
    assert!((-121.0..=-90.0).contains(&moved), "it scrolled by {moved}");
    let field = harness.get_by_role_and_label(Role::SpinButton, "Feature angle value").rect();
    swipe(&mut harness, field.center(), vec2(0.0, 60.0));
    assert_eq!(harness.state().state().settings, before, "so does that of the field");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    assert_eq!(harness.state().state().settings, before, "there is nothing to undo");

    let slider = place(&harness, Role::Slider);
    swipe(&mut harness, slider.lerp_inside(vec2(0.5, 0.5)), vec2(100.0, 20.0));
    let after = harness.state().state().settings.clone();
    assert!(after.decimation.feature_angle > before.decimation.feature_angle + 10.0, "{:?}", after.decimation);
    assert!((place(&harness, Role::Slider).top() - slider.top()).abs() < 1.0, "it stands still");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    assert_eq!(harness.state().state().settings, before, "one step to undo");
}

#[test]
fn a_mouse_moves_the_slider_whichever_way_it_goes() {
    let (mut harness, _) = app(PHONE);
    settle(&mut harness);
    let before = harness.state().state().settings.clone();
    let slider = harness.get_by_role_and_label(Role::Slider, "Pass band").rect();
    let from = slider.lerp_inside(vec2(0.8, 0.5));
    harness.drag_at(from);
    harness.run_steps(1);
    harness.hover_at(from - vec2(0.0, 60.0));
    harness.run_steps(1);
    harness.drop_at(from - vec2(0.0, 60.0));
    harness.run_steps(2);
    assert!(harness.state().state().settings.smoothing.pass_band > before.smoothing.pass_band);
}

#[test]
fn the_title_of_a_lesson_is_whole() {
    let (mut harness, memory) = phone();
    settle(&mut harness);
    tell(&mut harness, &memory, PlatformEvent::Linked { fragment: "#lesson=windows&step=2".to_owned() });
    let given = harness.state().lessons().given().expect("a lesson").clone();
    let title = format!("{}, 2 of {}", given.lesson.title, given.lesson.steps.len());
    let font = egui::FontId::proportional(14.0);
    let width = harness.ctx.fonts_mut(|fonts| fonts.layout_no_wrap(title.clone(), font, egui::Color32::WHITE).size().x);
    let rect = harness.get_by_role_and_label(Role::Label, &title).rect();
    assert!(rect.width() >= width - 1.0 && rect.left() >= 0.0 && rect.right() <= PHONE[0], "{rect} of {width}");
}

#[test]
fn the_pads_lie_under_the_thumbs() {
    let (mut harness, memory) = phone();
    settle(&mut harness);
    put_on(&mut harness, &memory);
    let place = |pad| harness.get_by_role_and_label(Role::Slider, pad).rect();
    let (feed, roll) = (place("Feed pad"), place("Roll pad"));
    for (pad, reach) in [(feed, feed.left()), (roll, PHONE[0] - roll.right())] {
        assert!(reach <= 24.0 && PHONE[1] - pad.bottom() <= 88.0, "{pad} is not in a corner");
        assert!(pad.height() >= 44.0 && pad.width() >= 120.0, "{pad}");
    }
    assert!(feed.right() <= roll.left());
}

#[test]
fn one_view_is_large_and_a_tab_or_a_swipe_above_it_goes_to_the_other() {
    let (mut harness, _) = phone();
    settle(&mut harness);
    let view =
        |harness: &App, name: &'static str| harness.query_by_role_and_label(Role::Image, name).map(|node| node.rect());
    let is_shaded = |harness: &App| match (view(harness, "Shaded view"), view(harness, "Wireframe view")) {
        (Some(_), None) => true,
        (None, Some(_)) => false,
        other => panic!("not one view: {other:?}"),
    };
    let large = view(&harness, "Shaded view").expect("a view");
    assert!(is_shaded(&harness) && large.width() > 380.0 && large.height() > 200.0, "{large}");
    harness.get_by_role_and_label(Role::Button, "Wireframe").click();
    harness.run_steps(3);
    assert!(!is_shaded(&harness), "by its tab");
    assert_eq!(view(&harness, "Wireframe view"), Some(large));
    let strip = harness.get_by_role_and_label(Role::Button, "Wireframe").rect().center();
    swipe(&mut harness, strip, vec2(120.0, 0.0));
    assert!(is_shaded(&harness), "by a swipe to the right");
    swipe(&mut harness, strip, vec2(-120.0, 0.0));
    assert!(!is_shaded(&harness), "by a swipe to the left");
    let camera = *harness.state().camera();
    swipe(&mut harness, large.center(), vec2(120.0, 0.0));
    assert!(!is_shaded(&harness) && camera.rotation != harness.state().camera().rotation, "a swipe in the view turns");
}

#[test]
fn help_is_in_the_window_and_begins_with_fingers() {
    for size in [PHONE, [768.0, 1024.0]] {
        let (mut harness, _) = in_hand(size, 0.1, false);
        settle(&mut harness);
        harness.key_press(Key::F1);
        harness.run_steps(3);
        let place = |label: &str| harness.query_all_by_label(label).next().unwrap_or_else(|| panic!("{label}")).rect();
        assert!(place("One finger").top() < place("With mouse and keyboard").top());
        assert!(place("Close").bottom() < size[1]);
        for line in [
            "Shift or right button + drag, two fingers",
            "Next control; arrows, Page up, Page down, Home and End move a slider",
        ] {
            let rect = place(line);
            assert!(rect.left() >= 16.0 && rect.right() <= size[0] - 16.0, "{line}: {rect}");
        }
    }
}

#[test]
fn the_panel_gives_its_room_to_a_lesson_and_to_a_comparison_and_a_tap_brings_it_back() {
    let (mut harness, memory) = phone();
    settle(&mut harness);
    let camera = *harness.state().camera();
    harness.key_press(Key::C);
    harness.run_steps(3);
    settle(&mut harness);
    let has_sliders = |harness: &App| harness.query_by_role_and_label(Role::Slider, "Pass band").is_some();
    let cells: Vec<_> = harness.query_all_by_role(Role::RadioButton).map(|cell| cell.rect()).collect();
    assert!(!has_sliders(&harness) && cells.len() >= 2 && cells[1].bottom() < PHONE[1] - 100.0, "{cells:?}");
    let now = *harness.state().camera();
    assert!(now.target.distance(camera.target) < 0.1, "the whole vessel is seen, and not a patch of its wall");
    click(&mut harness, "Sliders. Panel height: low");
    harness.run_steps(3);
    assert!(has_sliders(&harness), "what is compared next is set here");
    // A step of a lesson ends the comparison.
    tell(&mut harness, &memory, PlatformEvent::Linked { fragment: "#lesson=windows&step=2".to_owned() });
    harness.run_steps(4);
    assert!(!has_sliders(&harness), "folded again: it is another place");
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    assert!(view.height() >= 160.0, "{view}");
}

/// Taps the handle until the panel stands at its highest.
fn draw_up(harness: &mut App) {
    for _ in 0..2 {
        harness.get_by_label_contains("Panel height").click();
        harness.run_steps(4);
    }
    assert!(harness.query_by_label("Panel height: full").is_some());
}

#[test]
fn the_panel_is_drawn_up_and_down_and_rests_at_three_heights() {
    let (mut harness, _) = phone();
    settle(&mut harness);
    let place = |harness: &App| harness.get_by_label_contains("Panel height").rect();
    let rests = |harness: &App, at: &str| harness.query_by_label(&format!("Panel height: {at}")).is_some();
    let has = |harness: &App, slider: &'static str| harness.query_by_role_and_label(Role::Slider, slider).is_some();
    let has_rest = |harness: &App| harness.query_by_role_and_label(Role::ComboBox, "Strength").is_some();
    let low = place(&harness);
    assert!(rests(&harness, "low") && low.height() >= 44.0 && low.width() > 300.0, "{low}");
    assert!(!has_rest(&harness), "what is dragged is all there is");
    swipe(&mut harness, low.center(), vec2(0.0, -90.0));
    let half = place(&harness);
    assert!(rests(&harness, "half") && has_rest(&harness) && half.top() < low.top() - 60.0, "{low} became {half}");
    swipe(&mut harness, half.center(), vec2(0.0, -200.0));
    let full = place(&harness);
    assert!(rests(&harness, "full") && full.top() < half.top() - 100.0, "{half} became {full}");
    swipe(&mut harness, full.center(), vec2(0.0, 450.0));
    assert!(rests(&harness, "low") && place(&harness) == low, "{full} became {}", place(&harness));
    // What it shows at the lowest is in sight, and works.
    assert!(["Pass band", "Iterations"].into_iter().all(|slider| has(&harness, slider)));
    let slider = harness.get_by_role_and_label(Role::Slider, "Reduction").rect();
    assert!(slider.top() > low.bottom() && slider.bottom() < PHONE[1] - 56.0, "{slider} above the status");
    let (before, tenth) = (harness.state().state().settings.target, shown(&harness));
    swipe(&mut harness, slider.lerp_inside(vec2(0.8, 0.5)), vec2(-100.0, 0.0));
    let count = shown(&harness);
    assert!(harness.state().state().settings.target != before && 10 * count > 27 * tenth, "{tenth} to {count}");
    // By keys, and by taps.
    harness.get_by_label_contains("Panel height").focus();
    harness.run_steps(2);
    for (key, at) in [(Key::ArrowUp, "half"), (Key::ArrowUp, "full"), (Key::ArrowUp, "full"), (Key::ArrowDown, "half")]
    {
        harness.key_press(key);
        harness.run_steps(2);
        assert!(rests(&harness, at), "{key:?} to {at}");
    }
    for at in ["full", "low", "half"] {
        harness.get_by_label_contains("Panel height").click();
        harness.run_steps(2);
        assert!(rests(&harness, at), "a tap to {at}");
    }
    assert!((place(&harness).top() - half.top()).abs() < 1.0 && has_rest(&harness));
}

/// Puts a finger down and takes it up again in the next frame.
fn tap(harness: &mut App, at: Pos2) {
    finger(harness, TouchPhase::Start, at);
    harness.hover_at(at);
    harness.drag_at(at);
    harness.run_steps(1);
    finger(harness, TouchPhase::End, at);
    harness.drop_at(at);
    harness.run_steps(3);
}

/// Whether this stands in what a tap or a resting pointer shows.
fn explains(harness: &App, words: &str) -> bool {
    let window = harness.ctx.content_rect();
    harness.query_all_by_label_contains(words).any(|node| window.contains_rect(node.rect()))
}

#[test]
fn a_tap_on_a_name_explains_it_until_the_next_tap() {
    let (mut harness, _) = phone();
    settle_wholly(&mut harness);
    for (name, words) in [
        ("Pass band", "What passes the filter"),
        ("Safe to", "keeps its calibre to"),
        ("Triangles", "After and before the red"),
    ] {
        let at = harness.query_all_by_role_and_label(Role::Label, name).last().expect(name).rect().center();
        assert!(!explains(&harness, words), "{words} before {name} is tapped");
        tap(&mut harness, at);
        assert!(explains(&harness, words), "{words} where {name} is tapped");
        let elsewhere = harness.get_by_role_and_label(Role::Image, "Shaded view").rect().center();
        tap(&mut harness, elsewhere);
        assert!(!explains(&harness, words), "{words} after the next tap");
    }
    // A second tap on the name takes it away as well, and a mouse shows it where it rests.
    let at = harness.query_all_by_role_and_label(Role::Label, "Pass band").last().expect("it is there").rect().center();
    for is_shown in [true, false] {
        tap(&mut harness, at);
        assert_eq!(explains(&harness, "What passes the filter"), is_shown);
    }
    // A sentence that is cut off is whole there.
    let told = |harness: &App| harness.query_all_by_label_contains("5 of 7 vessels were measured").count();
    let (before, at) = (told(&harness), harness.get_by_label_contains("5 of 7 vessels were measured").rect().center());
    tap(&mut harness, at);
    assert_eq!(told(&harness), before + 1);
    // What is told goes by what points.
    harness.get_by_role_and_label(Role::Button, "Open in").click();
    harness.run_steps(3);
    assert!(explains(&harness, "Unit of the file's numbers"));
}

#[test]
fn what_to_do_is_told_without_clicks_and_keys() {
    let (mut harness, memory) = phone();
    settle(&mut harness);
    harness.key_press(Key::M);
    harness.run_steps(4);
    let speaks_of_a_mouse = |harness: &App| ["lick", "Esc", "(W, S)"].iter().any(|words| says(harness, words));
    assert!(says(&harness, "then tap the surface") && !speaks_of_a_mouse(&harness));
    for (tool, words) in [("Ruler", "Tap the first place"), ("Diameter", "Tap the wall"), ("Section", "Tap a vessel")] {
        click(&mut harness, tool);
        assert!(says(&harness, words) && !speaks_of_a_mouse(&harness), "{tool}");
    }
    harness.key_press(Key::M);
    harness.run_steps(4);
    put_on(&mut harness, &memory);
    assert!(!speaks_of_a_mouse(&harness), "in a trial");
}

#[test]
fn what_is_saved_stands_in_menus_that_a_phone_has_room_for() {
    let (mut harness, memory) = phone();
    settle_wholly(&mut harness);
    harness.get_by_role_and_label(Role::Button, "Save").click();
    harness.run_steps(3);
    assert!(harness.query_by_label("STL...").is_none());
    for menu in ["Surface", "Vessels", "For the record"] {
        let rect = harness.get_by_role_and_label(Role::Button, menu).rect();
        assert!(harness.ctx.content_rect().contains_rect(rect), "{menu} at {rect}");
    }
    harness.get_by_role_and_label(Role::Button, "Surface").click();
    harness.run_steps(3);
    fits_a_finger(&harness, "the formats");
    harness.get_by_label("STL...").click();
    assert!(lumen_ui_tests::offered(&mut harness, &memory).0.ends_with(".stl"));
}

#[test]
fn every_target_is_as_large_as_a_fingertip() {
    let (mut harness, memory) = phone();
    settle(&mut harness);
    fits_a_finger(&harness, "as it starts");
    harness.get_by_role_and_label(Role::Button, "Menu").click();
    harness.run_steps(3);
    fits_a_finger(&harness, "the menu");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::Button, "Open in").click();
    harness.run_steps(3);
    fits_a_finger(&harness, "the units of a file");
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    put_on(&mut harness, &memory);
    fits_a_finger(&harness, "the trial");
}

#[test]
fn so_is_every_target_over_vessels_measures_and_what_is_saved() {
    let (mut harness, _) = phone();
    settle_wholly(&mut harness);
    harness.get_by_role_and_label(Role::Button, "Save").click();
    harness.run_steps(3);
    fits_a_finger(&harness, "what can be saved");
    harness.get_by_role_and_label(Role::Button, "For the record").click();
    harness.run_steps(3);
    fits_a_finger(&harness, "what is for the record");
    let last = harness.get_by_role_and_label(Role::Button, "Settings...").rect();
    assert!(last.height() >= 44.0 && harness.query_by_role_and_label(Role::Button, "Report...").is_some());
    harness.get_by_role_and_label(Role::Button, "Report...").click();
    harness.run_steps(3);
    fits_a_finger(&harness, "what a report is to have");
    harness.key_press(Key::Escape);
    harness.run_steps(3);

    harness.key_press(Key::V);
    harness.run_steps(4);
    assert!(harness.query_by_role_and_label(Role::SpinButton, "Allowed change").is_some());
    fits_a_finger(&harness, "the vessels");

    harness.key_press(Key::M);
    harness.run_steps(4);
    click(&mut harness, "Diameter");
    if let Some(focused) = harness.ctx.memory(egui::Memory::focused) {
        harness.ctx.memory_mut(|memory| memory.surrender_focus(focused));
    }
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert_eq!(harness.state().state().measures.len(), 1, "there is one to be listed");
    click(&mut harness, "Clip plane");
    assert!(harness.query_by_role_and_label(Role::Button, "Flip").is_some());
    fits_a_finger(&harness, "the measures");
    let delete = harness.get_by_label_contains("Delete ").rect();
    assert!(delete.right() <= PHONE[0] - 16.0, "{delete} is not cut off");
}

#[test]
fn so_is_every_target_of_a_lesson_the_collapses_and_the_folds_of_the_panel() {
    let (mut harness, memory) = phone();
    settle(&mut harness);
    draw_up(&mut harness);
    for fold in ["Response", "Error against triangles", "Surface", "Mending", "Advanced: Smooth", "Advanced: Reduce"] {
        click(&mut harness, fold);
        fits_a_finger(&harness, fold);
    }
    tell(&mut harness, &memory, PlatformEvent::Linked { fragment: "#lesson=decimation&step=1".to_owned() });
    wait(&mut harness, |harness| harness.query_by_role_and_label(Role::Button, "One on").is_some());
    assert!(harness.state().lessons().given().is_some() && harness.state().collapses().is_open());
    fits_a_finger(&harness, "a lesson and the collapses");
}

#[test]
fn so_is_every_target_of_a_comparison() {
    let (mut harness, _) = phone();
    settle(&mut harness);
    harness.key_press(Key::C);
    harness.run_steps(3);
    settle(&mut harness);
    assert!(harness.query_all_by_label_contains("Remove ").count() >= 2, "there are cells");
    fits_a_finger(&harness, "the comparison");
}

#[test]
fn so_is_every_target_of_a_scan() {
    let (mut harness, memory) = phone();
    settle(&mut harness);
    memory.borrow_mut().events.push_back(ball("AnatomicalOrientation = RAI\n"));
    harness.run_steps(40);
    assert!(harness.query_by_role_and_label(Role::Button, "Make the surface").is_some());
    let slice = harness.get_by_role_and_label(Role::Slider, "Slice").rect();
    assert!(slice.height() >= 44.0 && slice.right() <= PHONE[0], "{slice}");
    fits_a_finger(&harness, "a scan");
}

/// Scrolls to the slider of the feature angle and flicks a finger down over the place that `from` finds there: most of what
/// scrolls lies above it.
fn flick(harness: &mut App, from: fn(&App) -> Pos2) {
    harness.get_by_role_and_label(Role::Slider, "Feature angle").scroll_to_me();
    harness.run_steps(12);
    let from = from(harness);
    swipe(harness, from, vec2(0.0, 150.0));
}

/// How far the panel goes down in each of so many times 0.2 s.
fn goes_on(harness: &mut App, times: usize) -> Vec<f32> {
    let top = |harness: &App| harness.get_by_role_and_label(Role::Slider, "Feature angle").rect().top();
    let mut way = || {
        let before = top(harness);
        harness.run_steps(12);
        top(harness) - before
    };
    (0..times).map(|_| way()).collect()
}

/// On a slider, and on words beside it.
const PLACES: [fn(&App) -> Pos2; 2] = [
    |harness| harness.get_by_role_and_label(Role::Slider, "Feature angle").rect().lerp_inside(vec2(0.8, 0.5)),
    |harness| harness.get_by_role_and_label(Role::Label, "Feature angle").rect().center(),
];

/// Seconds between two frames: a finger has its speed of a tenth of a second.
const FRAME_S: f32 = 1.0 / 60.0;

#[test]
fn a_flick_scrolls_on_and_slows_down_over_a_slider_as_elsewhere_and_a_finger_stops_it() {
    let (mut harness, _) = in_hand(PHONE, FRAME_S, true);
    settle(&mut harness);
    draw_up(&mut harness);
    unfold_angle(&mut harness);
    let before = harness.state().state().settings.clone();
    for place in PLACES {
        flick(&mut harness, place);
        let ways = goes_on(&mut harness, 5);
        assert!(ways[0] > 30.0, "{ways:?}");
        // Speeds fall to 1/e in half a second, as lists on a phone have it (0.998 a millisecond).
        for pair in ways[..4].windows(2) {
            let part = pair[1] / pair[0];
            assert!((part - (-0.4f32).exp()).abs() < 0.1, "{part} of it, in {ways:?}");
        }
        let ways = goes_on(&mut harness, 25);
        assert_eq!(ways[24], 0.0, "it comes to rest: {ways:?}");

        flick(&mut harness, place);
        let held = egui::pos2(PHONE[0] / 2.0, PHONE[1] - 110.0);
        finger(&harness, TouchPhase::Start, held);
        harness.hover_at(held);
        harness.drag_at(held);
        harness.run_steps(1);
        assert_eq!(goes_on(&mut harness, 1), [0.0], "it stops under a finger");
        // Taken off aside, it has tapped nothing.
        let aside = held - vec2(0.0, 30.0);
        finger(&harness, TouchPhase::Move, aside);
        harness.hover_at(aside);
        harness.run_steps(1);
        finger(&harness, TouchPhase::End, aside);
        harness.drop_at(aside);
        harness.run_steps(120);
    }
    assert_eq!(harness.state().state().settings, before, "nothing was set");
}

#[test]
fn where_less_motion_is_asked_for_a_flick_ends_with_the_finger() {
    let (mut harness, _) = in_hand(PHONE, FRAME_S, false);
    settle(&mut harness);
    draw_up(&mut harness);
    unfold_angle(&mut harness);
    for place in PLACES {
        flick(&mut harness, place);
        assert_eq!(goes_on(&mut harness, 1), [0.0]);
    }
}
