//! The deviation in colours: from which surface, signed or not, up to how much, and the pin where it is largest.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::LumenApp;
use lumen::pipeline::deviation::Deviation;
use lumen_ui_tests::{DESKTOP, app, says, seen, settle};

/// The numbers: from the smoothed surface, and from the one that was opened.
fn numbers(harness: &Harness<'_, LumenApp>) -> [Deviation; 2] {
    let report = &harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap().report;
    [report.deviation_mm.unwrap(), report.deviation_from_original_mm.unwrap()]
}

/// Chooses something below *Colour by deviation*, which must be on.
fn choose(harness: &mut Harness<'_, LumenApp>, role: Role, label: &str) {
    harness.get_by_role_and_label(Role::Button, "View").click();
    harness.run_steps(3);
    harness.get_by_role_and_label(role, label).click();
    harness.run_steps(3);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
}

#[test]
fn the_pin_is_where_the_deviation_from_the_chosen_surface_is_largest() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    harness.key_press(Key::D);
    harness.run_steps(3);
    let [smoothed, opened] = numbers(&harness);
    let label = |of: &Deviation| format!("Largest deviation: {:.3} mm", of.max);
    assert!(says(&harness, &label(&smoothed)));
    choose(&mut harness, Role::CheckBox, "From as opened");
    assert!(says(&harness, &label(&opened)) && label(&opened) != label(&smoothed));
    harness.get_by_role_and_label(Role::Button, &label(&opened)).click();
    harness.run_steps(3);
    assert_eq!(harness.state().camera().target.to_array(), opened.max_at_mm[1]);
    // Off and on again it is as it was chosen.
    for is_on in [false, true] {
        harness.key_press(Key::D);
        harness.run_steps(3);
        assert_eq!(harness.query_by_role_and_label(Role::Button, &label(&opened)).is_some(), is_on);
    }
}

#[test]
fn with_a_sign_small_deviations_are_white_and_the_steps_are_fixed() {
    let (mut harness, _) = seen(|| app(DESKTOP));
    settle(&mut harness);
    harness.key_press(Key::D);
    harness.run_steps(3);
    let view = harness.get_by_role_and_label(Role::Image, "Wireframe view").rect();
    let shaded = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    // A place of the surface right of the line between as opened and now.
    let place = |harness: &Harness<'_, LumenApp>| {
        let document = harness.state().state().document.as_ref().unwrap();
        let positions = &document.levels.as_ref().unwrap().1.positions;
        let seen = positions.iter().filter_map(|&p| harness.state().camera().project(p, view.width() / view.height()));
        let right = seen.filter(|at| (0.0..0.06).contains(&at.x)).map(|at| at.y);
        let (low, high) = right.fold((1.0f32, -1.0f32), |(low, high), y| (low.min(y), high.max(y)));
        let y = low + (high - low) * 0.75;
        shaded.center() + egui::vec2(0.03 * shaded.width() / 2.0, -y * shaded.height() / 2.0)
    };
    let at = place(&harness);
    let colour = |harness: &mut Harness<'_, LumenApp>| {
        let picture = harness.render().unwrap();
        picture.get_pixel(at.x as u32, at.y as u32).0.map(i32::from)
    };
    choose(&mut harness, Role::RadioButton, "Colours up to 0.5 mm");
    let [red, green, blue, _] = colour(&mut harness);
    assert!(blue > green, "next to nothing is the dark end of viridis: {red} {green} {blue}");
    choose(&mut harness, Role::CheckBox, "Inside and outside");
    let [red, green, blue, _] = colour(&mut harness);
    assert!(red.abs_diff(blue) < 40 && red.min(green) > 110, "next to nothing is white: {red} {green} {blue}");
}
