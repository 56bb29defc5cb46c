//! What became of the calibre of each vessel, as a user sees it: by pointer and keys, found by role and name.

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::{LumenApp, PlatformEvent};
use lumen::engine::Calibre;
use lumen::pipeline::settings::Smoothing;
use lumen::vessel::certificate::Verdict;
use lumen_ui_tests::{DESKTOP, PHONE, app, app_in_full, drag, offered, open, says, seen, settle, settle_wholly, tube};

use crate::controls::type_into;

/// What the level makes of the vessels, once that is known: it comes after the other numbers.
fn calibre(harness: &mut Harness<'_, LumenApp>) -> Calibre {
    for _ in 0..2000 {
        if let Some(calibre) = harness.state().state().calibre() {
            let calibre = calibre.clone();
            harness.run_steps(2);
            return calibre;
        }
        harness.step();
    }
    panic!("the calibre is never told");
}

/// Opens the sample and shows its vessels.
fn vessels(size: [f32; 2]) -> Harness<'static, LumenApp> {
    let (mut harness, _) = app_in_full(size);
    settle(&mut harness);
    calibre(&mut harness);
    harness.key_press(Key::V);
    harness.run_steps(4);
    harness
}

#[test]
fn every_branch_has_a_row_and_a_click_goes_to_where_it_changes_most() {
    let mut harness = vessels(DESKTOP);
    let found = calibre(&mut harness).found.unwrap();
    // The sample has an aorta, two renal and two iliac arteries; the aorta is cut in pieces where they leave.
    assert!(found.branches.len() >= 5);
    assert!(says(&harness, "keep their calibre to 2 %"));
    let branch = found.branches.iter().find(|branch| branch.verdict == Verdict::Kept).unwrap();
    let before = *harness.state().camera();
    harness.get_by_role_and_label(Role::Button, &branch.name).click();
    harness.run_steps(3);
    let (after, change) = (*harness.state().camera(), branch.reduced.largest_change.unwrap());
    assert_eq!(after.target.to_array(), change.at_mm);
    assert!(after.distance < before.distance, "{} of {}", after.distance, before.distance);
    assert_eq!(after.rotation, before.rotation, "the side that is looked at stays");
    harness.get_by_role_and_label(Role::Image, &format!("Radius along {}", branch.name));
}

#[test]
fn no_column_is_cut_off_beside_the_plot() {
    let harness = vessels(DESKTOP);
    let plot = harness.get_by_role_and_label(Role::Image, "Radius along branch 1").rect();
    let head = |label: &str| harness.get_by_role_and_label(Role::Label, label).rect();
    let heads = ["Vessel", "Measured", "Length, mm", "Tortuosity", "Uneven"].map(head);
    assert!(heads.windows(2).all(|pair| pair[0].right() <= pair[1].left()), "{heads:?}");
    assert!(heads[4].right() < plot.left(), "{} beside {plot}", heads[4]);
    assert!(plot.width() > 180.0, "{plot}");
}

#[test]
fn the_allowed_change_decides_the_verdict_and_is_a_step_to_undo() {
    let mut harness = vessels(DESKTOP);
    // By hand: an automatic reduction goes by the allowed change, and what is measured is another level then.
    type_into(&mut harness, "Reduction value", "85");
    settle_wholly(&mut harness);
    let before = calibre(&mut harness).found.unwrap();
    assert_eq!((before.tolerance_percent, before.verdict), (2.0, Verdict::Kept));
    harness.get_by_role_and_label(Role::SpinButton, "Allowed change").click();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.event(egui::Event::Text("0.1".to_owned()));
    harness.run_steps(1);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    settle_wholly(&mut harness);
    let after = calibre(&mut harness).found.unwrap();
    assert_eq!((after.tolerance_percent, after.verdict), (0.1, Verdict::Changed));
    assert!(says(&harness, "by more than 0.1 %"));
    for (before, after) in before.branches.iter().zip(&after.branches) {
        assert!(before.reduced == after.reduced, "what is measured is the same");
    }
    harness.get_by_role_and_label(Role::Button, "Undo").click();
    harness.run_steps(3);
    assert_eq!(calibre(&mut harness).found.unwrap().tolerance_percent, 2.0);
}

#[test]
fn colours_show_one_thing_at_a_time_and_change_the_picture() {
    let mut harness = seen(|| vessels(DESKTOP));
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect().shrink(2.0);
    let middle = |harness: &mut Harness<'_, LumenApp>| {
        let picture = harness.render().unwrap();
        picture.get_pixel(view.center().x as u32, view.center().y as u32).0
    };
    let plain = middle(&mut harness);
    harness.get_by_role_and_label(Role::CheckBox, "Colour the surface").click();
    harness.run_steps(3);
    let [red, green, blue, _] = middle(&mut harness);
    // Viridis in its middle is a green-blue: hardly any change.
    assert!(plain != [red, green, blue, 255] && green > red && blue > red, "{red} {green} {blue}");
    harness.key_press(Key::D);
    harness.run_steps(3);
    let is_checked = harness.get_by_role_and_label(Role::CheckBox, "Colour the surface").accesskit_node().toggled();
    assert_eq!(is_checked, Some(egui::accesskit::Toggled::False), "now they are of the deviation");
}

#[test]
fn what_is_not_measured_has_a_colour_of_its_own_that_the_legend_names() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    settle(&mut harness);
    let bytes = tube(3.0, 12.0, 0.5);
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "tube.obj".to_owned(), bytes });
    harness.run_steps(20);
    settle(&mut harness);
    calibre(&mut harness);
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect().shrink(2.0);
    // Pixels that are grey, none of whose channels is far from another, and as bright as a lit wall; and those of the wall's own
    // warm colour.
    let count = |harness: &mut Harness<'_, LumenApp>| {
        let picture = harness.render().unwrap();
        let (mut grey, mut warm) = (0, 0);
        for y in view.top() as u32..view.bottom() as u32 {
            // Right of the line: left of it is the surface as opened.
            for x in view.center().x as u32..view.right() as u32 {
                let [red, green, blue, _] = picture.get_pixel(x, y).0.map(i32::from);
                let spread = red.max(green).max(blue) - red.min(green).min(blue);
                grey += u32::from(spread <= 3 && (80..=170).contains(&red));
                warm += u32::from(red > blue + 30 && red > green + 20);
            }
        }
        (grey, warm)
    };
    let plain = count(&mut harness);
    harness.key_press(Key::V);
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::CheckBox, "Colour the surface").click();
    harness.run_steps(3);
    harness.key_press(Key::V);
    harness.run_steps(3);
    let coloured = count(&mut harness);
    assert!(
        plain.1 > 10_000 && coloured.1 * 20 < plain.1,
        "{plain:?} {coloured:?}: nothing keeps the wall's own colour"
    );
    assert!(coloured.0 > plain.0 + 5_000, "{plain:?} {coloured:?}: half of it is grey");
}

#[test]
fn calibre_and_centrelines_are_saved() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let found = calibre(&mut harness).found.unwrap();
    harness.key_press(Key::V);
    harness.run_steps(3);
    harness.get_by_role_and_label(Role::Button, "Save CSV").click();
    let (table, rows) = offered(&mut harness, &memory);
    harness.get_by_role_and_label(Role::Button, "Save").click();
    harness.run_steps(3);
    harness.get_by_label("Centrelines (VTP)...").click();
    let (lines, xml) = offered(&mut harness, &memory);
    assert_eq!((&*table, &*lines), ("abdominal-aorta-calibre.csv", "abdominal-aorta-centrelines.vtp"));
    let rows = std::str::from_utf8(&rows).unwrap();
    let stations: usize = found.branches.iter().map(|branch| branch.abscissas_mm.len()).sum();
    assert_eq!(rows.lines().count(), stations + 1);
    let columns = rows.lines().next().unwrap().split(',').count();
    assert!(rows.lines().all(|row| row.split(',').count() == columns));
    let xml = std::str::from_utf8(&xml).unwrap();
    assert!(xml.contains("MaximumInscribedSphereRadius") && xml.contains("GroupIds"));
    assert!(xml.contains(&format!("NumberOfPoints=\"{stations}\"")));
}

#[test]
fn on_a_phone_the_vessels_take_the_place_of_the_controls_and_give_it_back() {
    let mut harness = vessels(PHONE);
    assert!(harness.query_by_role_and_label(Role::Slider, "Iterations").is_none());
    assert!(says(&harness, "keep their calibre"));
    harness.get_by_role_and_label(Role::Button, "Back").click();
    harness.run_steps(3);
    assert!(harness.query_by_role_and_label(Role::Slider, "Iterations").is_some());
}

#[test]
fn what_has_no_vessel_is_told_in_a_sentence() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let bytes = b"v 0 0 0\nv 50 0 0\nv 0 50 0\nf 1 2 3\n".to_vec();
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "one.obj".to_owned(), bytes });
    harness.run_steps(20);
    assert!(calibre(&mut harness).found.is_err());
    harness.key_press(Key::V);
    harness.run_steps(4);
    assert!(says(&harness, "There are no vessels to measure"));
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(harness.query_by_role_and_label(Role::SpinButton, "Allowed change").is_none());
}

#[test]
fn what_smoothing_draws_shut_is_told_as_changed_by_smoothing() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    // A tube of 1.5 mm on edges of 0.7 mm, which the paper's filter draws shut.
    let tube = tube(1.5, 40.0, 0.7);
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "tube.obj".to_owned(), bytes: tube });
    harness.run_steps(20);
    settle(&mut harness);
    let found = calibre(&mut harness).found.unwrap();
    assert!(found.branches.iter().all(|branch| branch.verdict_smoothed == Verdict::Kept), "as it is set by itself");
    harness.get_by_role_and_label(Role::ComboBox, "Strength").click();
    harness.run_steps(3);
    harness.get_by_label("The paper's").click();
    harness.run_steps(3);
    settle(&mut harness);
    assert!(harness.state().state().settings.smoothing.gives_same(&Smoothing::PAPER));
    let found = calibre(&mut harness).found.unwrap();
    assert!(found.branches.iter().all(|branch| branch.verdict_smoothed == Verdict::Changed), "{found:?}");
    harness.key_press(Key::V);
    harness.run_steps(4);
    assert!(says(&harness, "Smoothing itself changes"));
}

/// A tube so many mm long and 12 mm wide, to so many in its middle: a bell whose width squared is half of `spread` mm².
pub(crate) fn narrowed(length: f64, least: f64, spread: f64) -> Vec<u8> {
    let middle = length / 2.0;
    let wide = |z: f64| 6.0 - (12.0 - least) / 2.0 * (-(z - middle) * (z - middle) / spread).exp();
    let bytes = String::from_utf8(tube(6.0, length, 0.8)).unwrap();
    let narrowed = bytes.lines().map(|line| {
        let numbers: Vec<f64> = line.split(' ').skip(1).filter_map(|word| word.parse().ok()).collect();
        match (line.strip_prefix("v "), &numbers[..]) {
            (Some(_), &[x, y, z]) => format!("v {} {} {z}\n", x * wide(z) / 6.0, y * wide(z) / 6.0),
            _ => format!("{line}\n"),
        }
    });
    narrowed.collect::<String>().into_bytes()
}

#[test]
fn what_is_shown_of_a_narrowing_is_its_place_its_length_and_what_it_is_measured_by() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "narrowed.obj", narrowed(100.0, 5.0, 20.0));
    settle_wholly(&mut harness);
    let found = calibre(&mut harness).found.unwrap();
    let branch = found.branches.iter().find(|branch| branch.uneven()[0].is_some()).expect("a narrowing");
    let narrowing = branch.uneven()[0].unwrap();
    let is_there = |harness: &Harness<'_, LumenApp>| {
        let camera = harness.state().camera();
        let at = camera.target.distance(narrowing.at_mm.into());
        assert!(at < 1e-3, "{at} mm away");
        let (along, beside) = harness.state().marked();
        assert!(along.len() >= 3 && beside.len() == narrowing.sides.iter().flatten().count(), "{along:?} {beside:?}");
        assert!(beside.iter().all(|label| label.starts_with("reference ") && label.ends_with(" mm")), "{beside:?}");
    };
    press(&mut harness, Role::Button, "1 note");
    press(&mut harness, Role::Button, "Show me");
    is_there(&harness);
    harness.key_press(Key::V);
    harness.run_steps(4);
    harness.get_by_role_and_label(Role::Image, &format!("Radius along {}", branch.name));
    harness.key_press(Key::F);
    harness.run_steps(3);
    assert!(harness.state().marked().0.is_empty());
    press(&mut harness, Role::Button, &branch.name);
    is_there(&harness);
}

#[test]
fn the_reference_of_a_narrowing_is_chosen_and_dragged() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open(&mut harness, &memory, "narrowed.obj", narrowed(60.0, 9.0, 50.0));
    harness.key_press(Key::V);
    harness.run_steps(4);
    assert!(!says(&harness, "by the diameter at"));
    press(&mut harness, Role::CheckBox, "Own reference");
    let at = |harness: &Harness<'_, LumenApp>| {
        let field = harness.get_by_role_and_label(Role::SpinButton, "Reference at");
        field.accesskit_node().numeric_value().unwrap()
    };
    let told = |harness: &Harness<'_, LumenApp>, at: f64| says(harness, &format!("by the diameter at {at:.1} mm"));
    let first = at(&harness);
    assert!(says(&harness, "% narrower over") && says(&harness, "Reduced: "));
    let plot = harness.get_by_role_and_label(Role::Image, "Radius along branch 1").rect();
    let before = *harness.state().camera();
    drag(&mut harness, plot.center() + egui::vec2(0.1 * plot.width(), 0.0), egui::vec2(0.2 * plot.width(), 0.0));
    let moved = at(&harness);
    assert!((moved - first).abs() > 5.0, "from {first} to {moved} mm");
    let found = harness.state().state().calibre().unwrap().found.as_ref().unwrap().branches[0].narrowest_beside(moved);
    let found = found.unwrap();
    assert!((20.0..=30.0).contains(&found.degree_percent), "9 of 12 mm: {found:?}");
    assert!(told(&harness, found.sides[0].unwrap().abscissa_mm), "{found:?}");
    assert_eq!(*harness.state().camera(), before, "it is marked, and not flown to");
    press(&mut harness, Role::CheckBox, "Own reference");
    assert!(harness.query_by_role_and_label(Role::SpinButton, "Reference at").is_none());
}

fn press(harness: &mut Harness<'_, LumenApp>, role: Role, label: &str) {
    harness.get_by_role_and_label(role, label).click();
    harness.run_steps(3);
}
