//! The verdict above the views.

use std::time::Duration;

use egui::Key;
use egui::accesskit::{Role, Toggled};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::{LumenApp, PlatformEvent};
use lumen::io::Unit;
use lumen::pipeline::settings::{Keep, Settings, Smoothing, Target};
use lumen::sharing::{SharedSettings, write_settings};
use lumen_ui_tests::{DESKTOP, app, app_in_full, open, phone, says, settle, settle_wholly, slow_app, tube, unfold};

use crate::mending::faulty;
use crate::targets::fits_a_finger;

fn click(harness: &mut Harness<'_, LumenApp>, label: &str) {
    harness.get_by_role_and_label(Role::Button, label).click();
    harness.run_steps(3);
}

#[test]
fn what_is_safe_is_told_above_everything_and_leads_to_the_vessels() {
    let (slow, _) = slow_app(DESKTOP, Duration::from_millis(1));
    assert!(!says(&slow, "Safe to simulate on"), "before it is known");
    let (mut harness, _) = app_in_full(DESKTOP);
    settle_wholly(&mut harness);
    let head = harness.get_by_label("Safe to simulate on").rect();
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    assert!(head.bottom() < view.top() && head.left() >= view.left());
    assert!(says(&harness, "keep their calibre to 2 %"));
    click(&mut harness, "Show vessels");
    assert!(harness.query_by_role_and_label(Role::SpinButton, "Allowed change").is_some());
}

/// A tube of 12 mm and 24 mm between open ends, of which 12 mm can be measured.
fn short() -> Vec<u8> {
    tube(6.0, 25.0, 1.0)
}

#[test]
fn of_what_is_measured_little_it_is_said_how_little_and_a_click_leads_to_the_rest() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "tube.obj", short());
    assert!(!says(&harness, "Safe to simulate on") && !says(&harness, "Safe to"));
    let head = harness.get_by_label("Kept where measured").rect();
    let coverage = harness.state().state().calibre().unwrap().found.as_ref().unwrap().coverage;
    let percent = coverage.percent();
    assert!((percent - 50.0).abs() < 12.0, "{percent}");
    let words = format!("{:.0} % of the length, 1 of 1 vessel", percent.floor());
    let link = harness.get_by_role_and_label(Role::Button, &words).rect();
    assert!(link.left() > head.right() && link.center().y - head.center().y < 4.0, "beside it");
    assert!(says(&harness, "Kept to"), "so is the rate told");
    assert_eq!(harness.query_all_by_label(&words).count(), 2, "and what it rests on");
    for way in [&*words, "Show unmeasured"] {
        harness.get_all_by_role_and_label(Role::Button, way).next().unwrap().click();
        harness.run_steps(3);
        assert!(harness.query_by_role_and_label(Role::SpinButton, "Allowed change").is_some(), "{way}");
        let colours = harness.get_by_role_and_label(Role::CheckBox, "Colour the surface").accesskit_node().toggled();
        assert_eq!(colours, Some(Toggled::True), "{way}");
        // Within a radius of an end.
        let z = harness.state().camera().target.z;
        assert!(!(8.0..=16.0).contains(&z), "{way} goes to {z}");
        harness.key_press(Key::V);
        harness.run_steps(3);
        assert!(harness.query_by_role_and_label(Role::SpinButton, "Allowed change").is_none(), "{way}");
    }
}

#[test]
fn on_a_phone_how_much_is_measured_stands_first() {
    let (mut harness, memory) = phone();
    settle(&mut harness);
    open(&mut harness, &memory, "tube.obj", short());
    assert!(harness.query_by_label("Kept where measured").is_some());
    let sentence =
        harness.get_by_label_contains(" % of the length, 1 of 1 vessel. The vessel keeps its calibre").rect();
    assert!(sentence.left() >= 0.0 && sentence.right() <= lumen_ui_tests::PHONE[0]);
    fits_a_finger(&harness, "what is measured little");
    click(&mut harness, "Show unmeasured");
    assert!(harness.query_by_role_and_label(Role::SpinButton, "Allowed change").is_some());
}

#[test]
fn the_list_of_what_was_found_stays_as_it_opened_while_more_is_found() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    memory.borrow_mut().slice = Duration::from_millis(2);
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "faulty.obj".to_owned(), bytes: faulty() });
    let list = |harness: &Harness<'_, LumenApp>| {
        let all = harness.query_all_by_role(Role::Button).map(|node| (node.accesskit_node().label(), node.rect()));
        all.filter(|(label, _)| {
            label.as_ref().is_some_and(|label| label.ends_with(" note") || label.ends_with(" notes"))
        })
        .map(|(label, rect)| (label.unwrap(), rect))
        .next()
    };
    let words = |harness: &Harness<'_, LumenApp>, above: f32| {
        let labels = harness.query_all_by_role(Role::Label).map(|node| (node.rect(), node.accesskit_node().value()));
        // In the card below the button, over the views.
        let inside = labels.filter(|(rect, _)| rect.left() > 700.0 && rect.top() > above && rect.bottom() < 760.0);
        inside.filter_map(|(rect, label)| Some((label?, rect.min))).collect::<Vec<_>>()
    };
    while !(harness.state().state().document.as_ref().is_some_and(|d| d.title().contains("faulty")))
        || list(&harness).is_none()
    {
        harness.step();
    }
    let (first, button) = list(&harness).unwrap();
    assert!(harness.state().state().calibre().is_none(), "more is to come");
    click(&mut harness, &first);
    let shown = words(&harness, button.bottom());
    assert!(!shown.is_empty());
    settle_wholly(&mut harness);
    let (then, beside) = list(&harness).unwrap();
    assert_ne!(first, then, "more was found");
    assert_eq!(button, beside, "and the button did not move");
    assert_eq!(words(&harness, button.bottom()), shown, "nor what it opened");
    click(&mut harness, &then);
    assert!(words(&harness, button.bottom()).is_empty(), "closed");
    click(&mut harness, &then);
    assert!(words(&harness, button.bottom()).len() > shown.len());
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
fn on_a_phone_what_would_help_is_in_a_list() {
    let (mut harness, memory) = phone();
    settle(&mut harness);
    let settings = Settings { smoothing: Smoothing::PAPER, ..Settings::default() };
    let bytes = write_settings(&SharedSettings { unit: None, settings }).into_bytes();
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "paper.json".to_owned(), bytes });
    harness.run_steps(3);
    open(&mut harness, &memory, "tube.obj", tube(1.5, 40.0, 0.7));
    assert!(says(&harness, "Smoothing has drawn a vessel shut at"));
    fits_a_finger(&harness, "what is grave");
    click(&mut harness, "What to do");
    // The panel has a button of that name too; the list lies over it.
    let remedy = harness.get_all_by_role_and_label(Role::Button, "Suits this surface").last().expect("in the list");
    remedy.click();
    harness.run_steps(3);
    settle_wholly(&mut harness);
    assert!(harness.state().state().settings.smoothing.gives_same(&Smoothing::AUTO));
}

#[test]
fn what_was_cancelled_is_not_said_to_be_measured() {
    let (mut harness, memory) = slow_app(DESKTOP, Duration::from_millis(1));
    let is_shown = |harness: &Harness<'_, LumenApp>| {
        let state = harness.state().state();
        state.is_busy() && state.document.as_ref().is_some_and(|document| document.shown.is_some())
    };
    for _ in 0..20_000 {
        harness.step();
        if is_shown(&harness) {
            break;
        }
    }
    assert!(says(&harness, "Being measured..."));
    harness.key_press(Key::Escape);
    harness.run_steps(4);
    assert!(says(&harness, "Not measured") && !says(&harness, "Being measured..."));
    memory.borrow_mut().slice = Duration::from_millis(50);
    unfold(&mut harness, "Advanced: Reduce");
    harness.get_by_role_and_label(Role::CheckBox, "Spare thin vessels").scroll_to_me();
    harness.run_steps(30);
    harness.get_by_role_and_label(Role::CheckBox, "Spare thin vessels").click();
    settle_wholly(&mut harness);
    assert!(!says(&harness, "Not measured"));
}

#[test]
fn what_has_no_vessel_is_not_called_safe() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "one.obj", b"v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n".to_vec());
    assert!(!says(&harness, "Safe to simulate on"));
    assert!(says(&harness, "There are no vessels to measure"));
    // And once more where the safe rate would stand, which nobody looks for any more.
    assert_eq!(harness.query_all_by_label_contains("the surface has no inside").count(), 2);
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

/// Tubes side by side, which touch nowhere.
fn tubes(count: usize) -> Vec<u8> {
    let one = String::from_utf8(tube(3.0, 30.0, 0.8)).unwrap();
    let vertices = one.lines().filter(|line| line.starts_with('v')).count();
    let shifted = |i: usize| {
        let number = |text: &str| text.parse::<f64>().unwrap();
        let line = move |line: &str| {
            let words: Vec<&str> = line.split(' ').collect();
            match words[..] {
                ["v", x, y, z] => format!("v {} {y} {z}\n", number(x) + 20.0 * i as f64),
                ["f", ..] => {
                    let corners = words[1..].iter().map(|v| (number(v) as usize + i * vertices).to_string());
                    format!("f {}\n", corners.collect::<Vec<_>>().join(" "))
                }
                _ => String::new(),
            }
        };
        one.lines().map(line).collect::<String>()
    };
    (0..count).map(shifted).collect::<String>().into_bytes()
}

#[test]
fn much_that_is_left_out_is_told_and_all_of_it_or_another_piece_is_a_click_away() {
    let (mut harness, memory) = app(DESKTOP);
    settle_wholly(&mut harness);
    open(&mut harness, &memory, "four.obj", tubes(4));
    assert!(says(&harness, "75 % of the surface is left out: 3 other pieces."));
    assert!(!says(&harness, "Safe to simulate on"));
    let near = harness.state().camera().distance;
    click(&mut harness, "Choose pieces");
    assert!(harness.state().camera().distance > near, "all of them are in view");
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    let keep = |harness: &Harness<'_, LumenApp>| harness.state().state().settings.keep;
    // Somewhere in the row of them a click hits one that is not kept.
    let hit = (1..40).find(|i| {
        let at = egui::pos2(view.left() + view.width() * *i as f32 / 40.0, view.center().y);
        harness.drag_at(at);
        harness.drop_at(at);
        harness.run_steps(2);
        keep(&harness) != Keep::Largest
    });
    assert!(hit.is_some() && matches!(keep(&harness), Keep::Component(_)), "{:?}", keep(&harness));
    settle_wholly(&mut harness);
    assert!(!says(&harness, "is left out"), "who has chosen knows");
    click(&mut harness, "Undo");
    settle_wholly(&mut harness);
    click(&mut harness, "All pieces");
    settle_wholly(&mut harness);
    assert_eq!(keep(&harness), Keep::All);
    assert!(!says(&harness, "is left out"));
}
