//! The language is chosen in the menu of the views, at once and for the next start.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::{LumenApp, PlatformEvent};
use lumen::language::{self, Key as Message, Language};
use lumen_ui_tests::{DESKTOP, Kept, app, in_hand, page, says, settle};

/// Chooses a language, in a window that has these words for its menu and the languages.
fn choose(harness: &mut Harness<'_, LumenApp>, [view, language]: [&str; 2], choice: &str) {
    harness.get_by_role_and_label(Role::Button, view).click();
    harness.run_steps(3);
    harness.get_by_label(language).click();
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::RadioButton, choice).click();
    harness.run_steps(3);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    harness.hover_at(egui::pos2(4.0, 796.0));
    harness.run_steps(3);
}

const ENGLISH: [&str; 2] = ["View", "Language"];
const GERMAN: [&str; 2] = ["Ansicht", "Sprache"];

/// Whether the window speaks German, and no English, or the other way round.
fn speaks_german(harness: &Harness<'_, LumenApp>) -> bool {
    let has = |label| harness.query_by_role_and_label(Role::Button, label).is_some();
    let found = [has("Öffnen..."), says(harness, "Nicht für klinische Entscheidungen")];
    let english = [has("Open..."), says(harness, "Not for clinical decisions")];
    assert_eq!(found, english.map(|is_english| !is_english), "one language alone");
    assert_eq!(found[0], found[1]);
    found[0]
}

#[test]
fn a_language_that_is_chosen_is_spoken_at_once_and_english_again() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    assert!(!speaks_german(&harness));
    choose(&mut harness, ENGLISH, "Deutsch");
    assert!(speaks_german(&harness));
    assert_eq!(harness.query_all_by_role_and_label(Role::Splitter, "Größe der Leiste").count(), 1);
    assert_eq!(harness.query_all_by_role(Role::Splitter).count(), 1, "and none by egui's own name");
    // Messages that nobody has asked for.
    let text = "app-open = Ouvrir...".to_owned();
    memory.borrow_mut().events.push_back(PlatformEvent::Texts { language: Language::French, texts: Ok(text) });
    harness.run_steps(3);
    assert!(speaks_german(&harness));
    choose(&mut harness, GERMAN, "English");
    assert!(!speaks_german(&harness));
    choose(&mut harness, ENGLISH, "Français");
    harness.get_by_role_and_label(Role::Button, "Ouvrir...");
    assert!(says(&harness, "Pas pour des décisions cliniques"));
    // This system says nothing of its language.
    choose(&mut harness, ["Vue", "Langue"], "Comme le système");
    assert!(!speaks_german(&harness));
}

#[test]
fn a_language_that_was_chosen_comes_back_at_the_next_start() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    choose(&mut harness, ENGLISH, "Deutsch");
    // It is written at most once a second, and a step is a quarter of one.
    harness.run_steps(12);
    let kept = memory.borrow().kept.clone().unwrap();

    // As on a machine that was started anew.
    language::speak(Language::English, &[]);
    let (mut harness, memory) = page(DESKTOP, kept);
    settle(&mut harness);
    assert!(speaks_german(&harness));
    choose(&mut harness, GERMAN, "Wie das System");
    assert!(!speaks_german(&harness));
    harness.run_steps(12);
    let kept = memory.borrow().kept.clone().unwrap();
    let (mut harness, _) = page(DESKTOP, kept);
    settle(&mut harness);
    assert!(!speaks_german(&harness));
}

/// The messages of the buttons that the bar may have, from left to right.
const BAR: [Message; 18] = [
    Message("app-open"),
    Message("app-open-in"),
    Message("app-sample"),
    Message("app-save"),
    Message("app-undo"),
    Message("app-redo"),
    Message("app-prepare"),
    Message("app-compare"),
    Message("app-vessels"),
    Message("app-measure"),
    Message("app-trial"),
    Message("app-learn"),
    Message("app-split"),
    Message("app-before"),
    Message("app-view"),
    Message("app-theme"),
    Message("app-help"),
    Message("app-about"),
];

#[test]
fn in_every_language_the_buttons_of_the_bar_lie_side_by_side_in_the_window() {
    for spoken in Language::ALL {
        language::speak(spoken, language::built_in(spoken).unwrap());
        for (width, has_finger) in [
            (360.0, false),
            (360.0, true),
            (721.0, false),
            (768.0, true),
            (1180.0, true),
            (1200.0, false),
            (1280.0, false),
        ] {
            let size = [width, 800.0];
            let (mut harness, _) = if has_finger { in_hand(size, 0.25, false) } else { app(size) };
            harness.run_steps(3);
            let menu =
                harness.query_by_role_and_label(Role::Button, &Message("app-menu").say()).map(|node| node.rect());
            let named = |message: &Message| {
                let label = message.say();
                let nodes = harness.query_all_by_role_and_label(Role::Button, &label);
                nodes.map(|node| node.rect()).find(|rect| rect.bottom() <= 56.0)
            };
            let mut right = 0.0;
            for rect in BAR.iter().filter_map(named).chain(menu) {
                assert!(rect.left() >= right && rect.right() <= width, "{spoken:?}, {width}, {has_finger}: {rect}");
                right = rect.right();
            }
            assert!(right > 0.0, "{spoken:?}, {width}, {has_finger}: no button was found");
        }
    }
    language::speak(Language::English, &[]);
}
