//! Settings for others: what a link says to whoever follows it, and the settings file.

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::{LumenApp, PlatformEvent};
use lumen::io::Unit;
use lumen::phantom::Sample;
use lumen::pipeline::settings::{Keep, Settings, Target};
use lumen::sharing::{Digest, Eye, Link, SharedSettings, SharedSurface, write_settings};
use lumen_ui_tests::{DESKTOP, Kept, offered, page, page_in_full, says, settle};

use crate::recovery::{choose, notice, settings_at, tell, vessel};

/// A link to a surface, as the platform reports it.
fn link(surface: SharedSurface, unit: Option<Unit>, settings: Settings) -> PlatformEvent {
    let link = Link { surface, shared: SharedSettings { unit, settings }, eye: None };
    PlatformEvent::Linked { fragment: format!("#{}", link.fragment()) }
}

/// The unit that the numbers of the open file were taken in.
fn unit(harness: &Harness<'_, LumenApp>) -> Unit {
    harness.state().state().document.as_ref().unwrap().import.unit
}

fn half() -> Settings {
    Settings { target: Target::Reduction(500), ..Settings::default() }
}

fn file(bytes: &[u8]) -> PlatformEvent {
    PlatformEvent::Chosen { name: "vessel.stl".to_owned(), bytes: bytes.to_vec() }
}

#[test]
fn a_link_is_copied_and_says_to_another_whether_it_is_the_same_file() {
    let (bytes, other) = (vessel(4000), vessel(5000));
    let digest = Digest::of(&bytes).short();
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file(&bytes));
    tell(&mut harness, &memory, settings_at(500));
    choose(&mut harness, "Copy link");
    assert!(notice(&harness).starts_with("The link was copied."), "{}", notice(&harness));

    let shared = SharedSettings { unit: None, settings: half() };
    let link = Link { surface: SharedSurface::File(digest), shared, eye: None };
    let fragment = format!("#{}", link.fragment());
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    memory.borrow_mut().events.push_back(PlatformEvent::Linked { fragment: fragment.clone() });
    harness.run_steps(2);
    settle(&mut harness);
    assert_eq!(harness.state().state().settings, half());
    let asks =
        format!("This link belongs to a file whose SHA-256 begins with {digest}; open it and you will see the same.");
    assert_eq!(notice(&harness), asks);
    tell(&mut harness, &memory, file(&other));
    let (found, shown) = (Digest::of(&other).short(), notice(&harness));
    assert!(shown.starts_with("This is another file") && shown.contains(&found.to_string()), "{shown}");
    tell(&mut harness, &memory, file(&bytes));
    assert_eq!(notice(&harness), "This is what the link belongs to: you see the same.");
    assert_eq!(harness.state().state().settings, half());
    // Once more, with the file open.
    tell(&mut harness, &memory, settings_at(900));
    tell(&mut harness, &memory, PlatformEvent::Linked { fragment });
    assert_eq!(harness.state().state().settings, half());
    assert_eq!(notice(&harness), "The settings of the link are in force.");
}

#[test]
fn the_unit_of_a_link_counts_whenever_it_is_followed() {
    let bytes = vessel(4000);
    let to = SharedSurface::File(Digest::of(&bytes).short());
    let same = "This is what the link belongs to: you see the same.";
    // Followed before the file, which was in another unit here the time before.
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file(&bytes));
    tell(&mut harness, &memory, link(to, Some(Unit::Centimetre), half()));
    assert_eq!((unit(&harness), &*notice(&harness)), (Unit::Centimetre, same));
    harness.run_steps(12);
    let kept = memory.borrow().kept.clone().unwrap();
    for (asked, expected) in [(Some(Unit::Metre), Unit::Metre), (None, Unit::Millimetre)] {
        let (mut harness, memory) = page(DESKTOP, kept.clone());
        settle(&mut harness);
        tell(&mut harness, &memory, link(to, asked, half()));
        tell(&mut harness, &memory, file(&bytes));
        assert_eq!((unit(&harness), &*notice(&harness)), (expected, same));
    }
    // Followed with the file open: one after the other.
    for (asked, expected) in [(Some(Unit::Metre), Unit::Metre), (None, Unit::Millimetre)] {
        tell(&mut harness, &memory, link(to, asked, half()));
        assert_eq!((unit(&harness), &*notice(&harness)), (expected, same));
        assert_eq!(harness.state().state().settings, half());
    }
}

#[test]
fn the_piece_of_a_link_is_asked_of_its_own_surface_alone() {
    let (mut harness, memory) = page_in_full(DESKTOP, Kept::default());
    settle(&mut harness);
    let settings = Settings { keep: Keep::Component(40_000), ..half() };
    let to = SharedSurface::File(Digest::of(b"another").short());
    tell(&mut harness, &memory, link(to, None, settings.clone()));
    assert_eq!(harness.state().state().settings, half());
    assert!(notice(&harness).starts_with("This link belongs to a file"), "{}", notice(&harness));
    // Nor does its own surface have a piece of that number.
    tell(&mut harness, &memory, link(SharedSurface::Sample(Sample::Aorta), None, settings));
    assert_eq!(harness.state().state().settings, half());
    assert_eq!(notice(&harness), "The settings of the link are in force.");
}

#[test]
fn a_link_to_a_sample_counts_more_than_the_file_that_comes_back() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, file(&vessel(4000)));
    choose(&mut harness, "Keep opened surfaces on this device");
    harness.run_steps(12);
    let kept = memory.borrow().kept.clone().unwrap();
    let (mut harness, memory) = page_in_full(DESKTOP, kept);
    // The address is read before the store answers.
    memory.borrow_mut().events.push_front(link(SharedSurface::Sample(Sample::Aorta), None, half()));
    harness.run_steps(2);
    settle(&mut harness);
    assert_eq!(harness.state().state().document.as_ref().unwrap().name, Sample::Aorta.label().to_string());
    assert_eq!(notice(&harness), "This is what the link belongs to: you see the same.");
}

#[test]
fn a_broken_link_changes_nothing_and_says_what_is_wrong() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, PlatformEvent::Linked { fragment: "#v=1&file=12".to_owned() });
    assert_eq!(notice(&harness), "The link cannot be read: \"12\" is no value for \"file\".");
    assert_eq!(harness.state().state().settings, Settings::default());
}

#[test]
fn settings_are_saved_as_a_file_and_opened_as_one() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    choose(&mut harness, "Settings...");
    let shared = SharedSettings::default();
    let (name, bytes) = offered(&mut harness, &memory);
    assert!(name.ends_with("-settings.json"), "{name}");
    assert_eq!(String::from_utf8(bytes).unwrap(), write_settings(&shared));

    let changed = write_settings(&SharedSettings { settings: half(), ..shared });
    let chosen = |text: &str| PlatformEvent::Chosen { name: "s.JSON".to_owned(), bytes: text.into() };
    tell(&mut harness, &memory, chosen(&changed));
    assert_eq!(harness.state().state().settings, half());
    tell(&mut harness, &memory, chosen("{}"));
    assert_eq!(notice(&harness), "s.JSON: This is no file of Lumen's settings.");
    assert_eq!(harness.state().state().settings, half());
}

#[test]
fn a_sample_of_fewer_triangles_is_no_surface_of_a_link() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    choose(&mut harness, "Copy link");
    let fewer = "This sample has fewer triangles than it has by itself: no link leads to it.";
    assert!(notice(&harness).starts_with(fewer), "{}", notice(&harness));
    tell(&mut harness, &memory, link(SharedSurface::Sample(Sample::Aorta), None, half()));
    assert!(notice(&harness).starts_with(fewer), "{}", notice(&harness));
    assert_eq!(harness.state().state().settings, half());
}

/// The link that was copied, or that a control leads to.
fn commands(harness: &Harness<'_, LumenApp>) -> Vec<String> {
    let said = harness.output().platform_output.commands.iter();
    said.filter_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        egui::OutputCommand::OpenUrl(open) => Some(open.url.clone()),
        _ => None,
    })
    .collect()
}

#[test]
fn a_part_of_another_page_has_the_sliders_and_the_view_of_its_link_and_a_way_to_the_whole() {
    let (mut harness, memory) = page_in_full(DESKTOP, Kept::default());
    settle(&mut harness);
    let sample = SharedSurface::Sample(Sample::Coronary);
    let shared = SharedSettings { unit: None, settings: half() };
    let rotation = [0.0, 0.0, 0.6, 0.8];
    let eye = Eye { target_mm: [10.0, -5.0, 20.0], rotation, distance_mm: 150.0 };
    assert_eq!(eye.rounded(), eye);
    let fragment = Link { surface: sample, shared, eye: Some(eye) }.fragment();
    {
        let mut memory = memory.borrow_mut();
        (memory.is_embedded, memory.kept) = (true, None);
        memory.address = Some("https://a.example/lumen/".to_owned());
    }
    tell(&mut harness, &memory, PlatformEvent::Linked { fragment: format!("#{fragment}") });
    settle(&mut harness);
    harness.run_steps(3);
    for slider in ["Pass band", "Iterations", "Reduction"] {
        assert!(harness.query_by_role_and_label(Role::Slider, slider).is_some(), "{slider}");
    }
    for button in ["Open...", "Save", "Copy link", "Show vessels"] {
        assert!(harness.query_by_role_and_label(Role::Button, button).is_none(), "{button}");
    }
    assert!(says(&harness, "Not for clinical decisions") && !says(&harness, "Drop a vessel here"));
    assert!(harness.query_by_label_contains("Sample: ").is_some(), "the verdict is told");
    let camera = harness.state().camera();
    assert_eq!((camera.target.to_array(), camera.distance), (eye.target_mm, eye.distance_mm));
    assert!(camera.rotation.to_array().iter().zip(rotation).all(|(a, b)| (a - b).abs() < 1e-3));
    for key in [egui::Key::C, egui::Key::V, egui::Key::M, egui::Key::P, egui::Key::F1] {
        harness.key_press(key);
        harness.run_steps(2);
    }
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::O);
    harness.run_steps(2);
    tell(&mut harness, &memory, PlatformEvent::Linked { fragment: "#lesson=wire".to_owned() });
    assert!(memory.borrow().asked == 0 && memory.borrow().offered.is_empty());
    let app = harness.state();
    assert!(!app.state().comparison.is_open() && app.lessons().given().is_none() && !app.trial().is_on());
    for label in ["Close", "Done", "Vessels", "Presenting"] {
        assert!(harness.query_by_label(label).is_none(), "no key leaves the views: {label}");
    }
    harness.get_by_label("Open in Lumen").click();
    harness.step();
    assert_eq!(commands(&harness), [format!("https://a.example/lumen/#{fragment}")]);
}
