//! A scan in the app: its axes go with the surface, are chosen where nothing says them, and turned on saving; its slices
//! stand behind the surface.

use std::cell::RefCell;
use std::rc::Rc;

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::{LumenApp, PlatformEvent};
use lumen::engine::scan::NamedFile;
use lumen::io::{Axes, Format, ImportOptions, read, write};
use lumen::language::{self, Language};
use lumen::phantom::{Sample, generate};
use lumen_ui_tests::{DESKTOP, Kept, Memory, app, offered, page, says, seen, settle, unfold};

use crate::recovery::{choose, tell};

const SIZE: usize = 48;

/// A ball of 15 mm in the middle of 48 voxels of 1 mm along each axis, 500 HU and more in it, in MetaImage.
pub(crate) fn ball(orientation: &str) -> PlatformEvent {
    let mut bytes = format!(
        "ObjectType = Image\nNDims = 3\n{orientation}Offset = 0 0 0\nElementSpacing = 1 1 1\nDimSize = {SIZE} {SIZE} {SIZE}\n\
         ElementType = MET_SHORT\nModality = MET_MOD_CT\nElementDataFile = LOCAL\n"
    )
    .into_bytes();
    let along = || (0..SIZE).map(|index| index as f64 - 23.5);
    for (z, y, x) in along().flat_map(|z| along().flat_map(move |y| along().map(move |x| (z, y, x)))) {
        let depth = 15.0 - (x * x + y * y + z * z).sqrt();
        bytes.extend(((180.0 + 100.0 * depth).clamp(-1000.0, 500.0) as i16).to_le_bytes());
    }
    PlatformEvent::Scan { files: vec![NamedFile::new("ball.mha", bytes)] }
}

/// The same ball as a mask.
fn mask() -> PlatformEvent {
    let head = format!(
        "ObjectType = Image\nNDims = 3\nOffset = 0 0 0\nElementSpacing = 1 1 1\nDimSize = {SIZE} {SIZE} {SIZE}\n\
         ElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
    );
    let along = || (0..SIZE).map(|index| index as f64 - 23.5);
    let places = along().flat_map(|z| along().flat_map(move |y| along().map(move |x| (x * x + y * y + z * z).sqrt())));
    let bytes = head.into_bytes().into_iter().chain(places.map(|r| u8::from(r < 15.0))).collect();
    PlatformEvent::Scan { files: vec![NamedFile::new("mask.mha", bytes)] }
}

/// Opens the ball and makes its surface.
fn make(harness: &mut Harness<'_, LumenApp>, memory: &Rc<RefCell<Memory>>, orientation: &str) {
    settle(harness);
    memory.borrow_mut().events.push_back(ball(orientation));
    for _ in 0..40 {
        harness.step();
    }
    harness.get_by_label("Make the surface").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_label("Make the surface").click();
    harness.run_steps(20);
    settle(harness);
}

fn axes(harness: &Harness<'_, LumenApp>) -> Axes {
    harness.state().state().document.as_ref().unwrap().import.axes
}

fn press(harness: &mut Harness<'_, LumenApp>, label: &str) {
    harness.get_by_role_and_label(Role::CheckBox, label).scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::CheckBox, label).click();
    harness.run_steps(6);
}

/// Chooses the axes in step 1.
fn say(harness: &mut Harness<'_, LumenApp>, choice: &str) {
    unfold(harness, "Surface");
    harness.get_by_role_and_label(Role::ComboBox, "Axes").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::ComboBox, "Axes").click();
    harness.run_steps(3);
    harness.get_by_label(choice).click();
    harness.run_steps(6);
}

#[test]
fn both_ways_from_a_mask_stand_beside_each_other_and_over_no_words() {
    for language in Language::ALL {
        language::speak(language, language::built_in(language).unwrap());
        let (mut harness, memory) = app(DESKTOP);
        settle(&mut harness);
        memory.borrow_mut().events.push_back(mask());
        harness.run_steps(40);
        let rect = |text: &str| harness.get_by_label(text).rect();
        let [words, nets, cubes] =
            [lumen::say!("scan-method"), lumen::say!("scan-surface-nets"), lumen::say!("scan-marching-cubes")]
                .map(|text| rect(&text));
        assert!(!words.intersects(nets) && !words.intersects(cubes) && !nets.intersects(cubes), "{language:?}");
        assert!(words.left() >= 0.0 && cubes.left() >= 0.0, "{language:?}: {words}, {cubes}");
    }
    language::speak(Language::English, &[]);
}

#[test]
fn what_a_scan_says_of_its_axes_goes_with_its_surface() {
    for (orientation, expected) in [("AnatomicalOrientation = RAI\n", Axes::Lps), ("", Axes::Unknown)] {
        let (mut harness, memory) = app(DESKTOP);
        make(&mut harness, &memory, orientation);
        let document = harness.state().state().document.as_ref().unwrap();
        assert_eq!((document.name.as_str(), document.import.axes), ("ball", expected));
        let is_told = document.import.warnings.iter().any(|text| text.to_string().contains("the axes are unknown"));
        assert_eq!(is_told, expected == Axes::Unknown);
        unfold(&mut harness, "Surface");
        let has_list = harness.query_by_role_and_label(Role::ComboBox, "Axes").is_some();
        assert_eq!(has_list, expected == Axes::Unknown, "asked where nothing says them");
    }
}

#[test]
fn axes_that_were_chosen_come_back_with_the_file_and_are_turned_on_saving() {
    let silent = |name: &str, triangles: usize| {
        let bytes = write(&generate(Sample::Aorta, triangles).unwrap(), None, Format::Stl).unwrap();
        PlatformEvent::Chosen { name: name.to_owned(), bytes }
    };
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, silent("patient.stl", 4000));
    assert_eq!(axes(&harness), Axes::Unknown);
    say(&mut harness, "RAS");
    assert_eq!(axes(&harness), Axes::Ras);
    tell(&mut harness, &memory, silent("other.stl", 5000));
    assert_eq!(axes(&harness), Axes::Unknown, "another file");
    // Under another name, after a reload.
    harness.run_steps(12);
    let kept = memory.borrow().kept.clone().unwrap();
    assert!(!kept.text.as_ref().unwrap().contains("patient"), "no name is kept with them");
    let (mut harness, memory) = page(DESKTOP, kept);
    settle(&mut harness);
    tell(&mut harness, &memory, silent("renamed.stl", 4000));
    assert_eq!(axes(&harness), Axes::Ras);

    let mut saved = |axes: &str| {
        choose(&mut harness, axes);
        choose(&mut harness, "STL...");
        offered(&mut harness, &memory).1
    };
    let (turned, plain) = (saved("Save in LPS"), saved("Save axes as they are"));
    let [turned, plain] = [turned, plain].map(|bytes| read(&bytes, "a.stl", &ImportOptions::default()).unwrap());
    assert_eq!((turned.report.axes, plain.report.axes), (Axes::Lps, Axes::Ras));
    for (a, b) in turned.mesh.positions.iter().zip(&plain.mesh.positions) {
        assert_eq!([a.x, a.y, a.z], [0.0 - b.x, 0.0 - b.y, b.z]);
    }

    choose(&mut harness, "Forget what is kept here");
    tell(&mut harness, &memory, silent("patient.stl", 4000));
    assert_eq!(axes(&harness), Axes::Unknown, "forgotten");
}

#[test]
fn slices_stand_behind_the_surface_and_are_moved() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    make(&mut harness, &memory, "AnatomicalOrientation = RAI\n");
    let before = picture(&mut harness, "none");
    // The view is from the front: the coronal plane is seen as it lies, the axial one from its edge, by the outline.
    press(&mut harness, "Coronal");
    let middle = picture(&mut harness, "coronal");
    assert!(says(&harness, "25 of 48, 24.0 mm"));
    press(&mut harness, "Axial");
    let both = picture(&mut harness, "both");
    press(&mut harness, "Axial");
    assert!(harness.query_by_role_and_label(Role::Slider, "Axial slice").is_none());
    press(&mut harness, "Outline of the surface");
    let plain = picture(&mut harness, "plain");
    assert!(before != middle && middle != both && middle != plain);
    harness.get_by_role_and_label(Role::ComboBox, "Window of values").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::ComboBox, "Window of values").click();
    harness.run_steps(3);
    harness.get_by_label("Bone").click();
    harness.run_steps(12);
    assert!(picture(&mut harness, "bone") != plain);
    // The slice is grey, and the outline in it is not.
    let is_grey = |pixel: &&[u8; 4]| pixel[0] == pixel[1] && pixel[1] == pixel[2];
    let greys = |pixels: &[[u8; 4]]| pixels.iter().filter(is_grey).count();
    assert!(greys(&plain) > greys(&before) + 10_000, "{} {}", greys(&plain), greys(&before));
    assert!(greys(&middle) < greys(&plain));
    // Turned off it is gone.
    press(&mut harness, "Keep the scan for slices (1 MB)");
    assert!(harness.query_by_role_and_label(Role::CheckBox, "Axial").is_none());
}

#[test]
fn the_scan_is_let_go_with_its_surface() {
    let (mut harness, memory) = app(DESKTOP);
    make(&mut harness, &memory, "AnatomicalOrientation = RAI\n");
    assert!(harness.query_by_role_and_label(Role::CheckBox, "Axial").is_some());
    choose_sample(&mut harness);
    settle(&mut harness);
    assert!(harness.query_by_role_and_label(Role::CheckBox, "Axial").is_none());
}

fn choose_sample(harness: &mut Harness<'_, LumenApp>) {
    harness.get_by_label("Sample").click();
    harness.run_steps(3);
    harness.get_by_label(&Sample::Aorta.label().to_string()).click();
    harness.run_steps(3);
}

/// What both views show; the whole window is also written beside what is built, to be looked at.
fn picture(harness: &mut Harness<'_, LumenApp>, name: &str) -> Vec<[u8; 4]> {
    let picture = harness.render().unwrap();
    crate::save(&format!("slices-{name}"), [picture.width(), picture.height()], picture.as_raw());
    // Beside the panel, above the bar below.
    let places = (140..picture.height() - 60).flat_map(|y| (460..picture.width()).map(move |x| (x, y)));
    places.map(|(x, y)| picture.get_pixel(x, y).0).collect()
}
