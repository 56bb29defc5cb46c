//! What comes back after a reload, and what does not without being asked for.

use std::cell::RefCell;

use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::{LumenApp, PlatformEvent};
use lumen::engine::Source;
use lumen::io::{Format, write};
use lumen::phantom::{Sample, generate};
use lumen::pipeline::settings::{Keep, Settings, Target};
use lumen::sharing::{SharedSettings, write_settings};
use lumen_ui_tests::told::wait;
use lumen_ui_tests::{DESKTOP, Kept, Memory, dying_page, page, settle, settle_wholly};

/// A vessel as the bytes of a file.
pub(crate) fn vessel(triangles: usize) -> Vec<u8> {
    write(&generate(Sample::Aorta, triangles).unwrap(), None, Format::Stl).unwrap()
}

fn name(harness: &Harness<'_, LumenApp>) -> String {
    harness.state().state().document.as_ref().map_or(String::new(), |document| document.name.clone())
}

pub(crate) fn notice(harness: &Harness<'_, LumenApp>) -> String {
    harness.state().state().notices.newest().map_or(String::new(), |notice| notice.text.clone())
}

pub(crate) fn choose(harness: &mut Harness<'_, LumenApp>, entry: &str) {
    harness.get_by_label("Save").click();
    harness.run_steps(3);
    harness.get_by_label(entry).click();
    harness.run_steps(3);
}

/// The defaults at another rate, as a file of settings.
pub(crate) fn settings_at(per_mille: u32) -> PlatformEvent {
    let settings = Settings { target: Target::Reduction(per_mille), ..Settings::default() };
    let text = write_settings(&SharedSettings { unit: None, settings });
    PlatformEvent::Chosen { name: "settings.json".to_owned(), bytes: text.into_bytes() }
}

/// Lets the platform report something, and waits until nothing follows from it any more.
pub(crate) fn tell(harness: &mut Harness<'_, LumenApp>, memory: &RefCell<Memory>, event: PlatformEvent) {
    memory.borrow_mut().events.push_back(event);
    harness.run_steps(2);
    settle(harness);
}

fn file(name: &str) -> PlatformEvent {
    PlatformEvent::Chosen { name: name.to_owned(), bytes: vessel(4000) }
}

#[test]
fn settings_steps_and_view_come_back_and_the_file_is_named() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file("left.stl"));
    tell(&mut harness, &memory, settings_at(500));
    tell(&mut harness, &memory, settings_at(700));
    harness.key_press(Key::Num3);
    // It is written at most once a second, and a step is a quarter of one.
    harness.run_steps(12);
    let (settings, camera) = (harness.state().state().settings.clone(), *harness.state().camera());
    let kept = memory.borrow().kept.clone().unwrap();
    assert!(kept.surface.is_none(), "no surface without being asked for");
    assert!(kept.text.as_ref().unwrap().contains("left.stl"));

    let (mut harness, memory) = page(DESKTOP, kept);
    settle(&mut harness);
    assert_eq!(harness.state().state().settings, settings);
    assert_eq!(
        notice(&harness),
        "left.stl was open before. Open it again: the settings are as they were, and the view will be."
    );
    // A sample stands in for it, which is not taken for what was open.
    harness.run_steps(12);
    assert!(memory.borrow().kept.as_ref().unwrap().text.as_ref().unwrap().contains("left.stl"));
    tell(&mut harness, &memory, file("left.stl"));
    assert_eq!(name(&harness), "left.stl");
    assert_eq!(notice(&harness), "left.stl is back, with the settings and the view that it was left with.");
    let back = harness.state().camera();
    assert_eq!((back.target, back.rotation, back.distance), (camera.target, camera.rotation, camera.distance));
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(harness.state().state().settings.target, Target::Reduction(500), "undo survives");
}

#[test]
fn a_surface_is_kept_only_where_that_is_asked_for_and_forgotten_with_all_else() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file("right.stl"));
    choose(&mut harness, "Keep opened surfaces on this device");
    harness.run_steps(12);
    let kept = memory.borrow().kept.clone().unwrap();
    assert_eq!(
        kept.surface.as_ref().map(|(name, bytes)| (&**name, bytes.len())),
        Some(("right.stl", vessel(4000).len()))
    );

    let (mut harness, memory) = page(DESKTOP, kept);
    wait(&mut harness, |harness| notice(harness).starts_with("right.stl is back"));
    settle_wholly(&mut harness);
    assert!(
        matches!(&harness.state().state().document.as_ref().unwrap().source, Source::File { name, .. } if name == "right.stl")
    );
    choose(&mut harness, "Forget what is kept here");
    harness.run_steps(12);
    let kept = memory.borrow().kept.clone().unwrap();
    assert!(kept.text.is_none() && kept.surface.is_none());
    assert!(notice(&harness).starts_with("Everything that was kept"), "{}", notice(&harness));
}

#[test]
fn a_surface_that_ends_the_program_is_not_brought_back_again() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file("bad.stl"));
    choose(&mut harness, "Keep opened surfaces on this device");
    harness.run_steps(12);
    let kept = memory.borrow().kept.clone().unwrap();
    let died = |kept| {
        let (harness, memory) = dying_page(DESKTOP, kept);
        drop(harness);
        memory.borrow().kept.clone().unwrap()
    };
    // Whoever is impatient reloads once.
    let kept = died(kept);
    assert!(kept.surface.is_some());
    let kept = died(kept);
    let (mut harness, memory) = page(DESKTOP, kept);
    settle(&mut harness);
    assert_eq!(name(&harness), Sample::Aorta.label().to_string());
    let said =
        "bad.stl was open before. The program has ended twice while it was being opened, so it is kept here no longer.";
    assert!(notice(&harness).starts_with(said), "{}", notice(&harness));
    assert!(memory.borrow().kept.as_ref().unwrap().surface.is_none());
}

#[test]
fn a_surface_that_is_shown_may_be_reloaded_as_often_as_one_likes() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file("again.stl"));
    choose(&mut harness, "Keep opened surfaces on this device");
    harness.run_steps(12);
    for _ in 0..4 {
        let kept = memory.borrow().kept.clone().unwrap();
        let (mut harness, again) = page(DESKTOP, kept);
        settle(&mut harness);
        harness.run_steps(12);
        assert_eq!(name(&harness), "again.stl");
        memory.borrow_mut().kept = again.borrow().kept.clone();
    }
}

#[test]
fn no_surface_stays_that_no_session_asks_for() {
    let bytes = Some(("left.stl".to_owned(), vessel(4000)));
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file("left.stl"));
    harness.run_steps(12);
    let not_kept = memory.borrow().kept.clone().unwrap().text;
    for text in [None, Some("[1]".to_owned()), not_kept] {
        let (_, memory) = page(DESKTOP, Kept { text: text.clone(), surface: bytes.clone() });
        assert!(memory.borrow().kept.as_ref().unwrap().surface.is_none(), "{text:?}");
    }
}

#[test]
fn the_bytes_of_another_file_do_not_come_back_under_a_name() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file("second.stl"));
    choose(&mut harness, "Keep opened surfaces on this device");
    harness.run_steps(12);
    // The browser had no room for the second.
    let text = memory.borrow().kept.clone().unwrap().text;
    let (mut harness, memory) = page(DESKTOP, Kept { text, surface: Some(("first.stl".to_owned(), vessel(5000))) });
    settle(&mut harness);
    assert_eq!(name(&harness), Sample::Aorta.label().to_string());
    assert!(notice(&harness).starts_with("second.stl was open before."), "{}", notice(&harness));
    assert!(memory.borrow().kept.as_ref().unwrap().surface.is_none());
}

#[test]
fn the_piece_that_was_kept_is_kept_again() {
    // Two vessels side by side, the second the smaller.
    let pieces = || {
        let (mut both, small) = (generate(Sample::Aorta, 5000).unwrap(), generate(Sample::Aorta, 3000).unwrap());
        let first = both.positions.len() as u32;
        both.triangles.extend(small.triangles.iter().map(|corners| corners.map(|vertex| first + vertex)));
        both.positions.extend(small.positions.into_iter().map(|mut at| {
            at.x += 500.0;
            at
        }));
        PlatformEvent::Chosen { name: "two.stl".to_owned(), bytes: write(&both, None, Format::Stl).unwrap() }
    };
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, pieces());
    let settings = Settings { keep: Keep::Component(1), ..Settings::default() };
    let text = write_settings(&SharedSettings { unit: None, settings: settings.clone() });
    let chosen = PlatformEvent::Chosen { name: "settings.json".to_owned(), bytes: text.into_bytes() };
    tell(&mut harness, &memory, chosen);
    assert_eq!(harness.state().state().settings.keep, Keep::Component(1));
    harness.run_steps(12);

    // The sample that stands in has no such piece, and another reload comes before the file.
    let mut kept = memory.borrow().kept.clone().unwrap();
    for _ in 0..2 {
        let (mut harness, memory) = page(DESKTOP, kept.clone());
        settle(&mut harness);
        assert_eq!(harness.state().state().settings.keep, Keep::Largest);
        harness.run_steps(12);
        kept = memory.borrow().kept.clone().unwrap();
    }
    let (mut harness, memory) = page(DESKTOP, kept);
    settle(&mut harness);
    tell(&mut harness, &memory, pieces());
    assert_eq!(harness.state().state().settings, settings);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(3);
    assert_eq!(harness.state().state().settings.keep, Keep::Largest);
}

#[test]
fn what_is_forgotten_is_not_written_again_by_a_turn_of_the_camera() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file("secret.stl"));
    harness.run_steps(12);
    choose(&mut harness, "Forget what is kept here");
    harness.key_press(Key::Num3);
    harness.run_steps(12);
    assert!(memory.borrow().kept.as_ref().unwrap().text.is_none());
    tell(&mut harness, &memory, file("next.stl"));
    harness.run_steps(12);
    assert!(memory.borrow().kept.as_ref().unwrap().text.as_ref().unwrap().contains("next.stl"));
}

#[test]
fn what_no_version_has_written_is_passed_over() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, settings_at(700));
    harness.run_steps(12);
    let written = memory.borrow().kept.clone().unwrap().text.unwrap();
    let newer = written.replacen("\"version\":1", "\"version\":9", 1);
    assert_ne!(newer, written);
    let rate = |text: &str| {
        let (mut harness, _) = page(DESKTOP, Kept { text: Some(text.to_owned()), surface: None });
        settle(&mut harness);
        assert_eq!(name(&harness), Sample::Aorta.label().to_string(), "{text}");
        harness.state().state().settings.target
    };
    assert_eq!(rate(&written), Target::Reduction(700));
    for text in ["", "{}", "[1]", &newer] {
        assert_eq!(rate(text), Target::default(), "{text}");
    }
}
