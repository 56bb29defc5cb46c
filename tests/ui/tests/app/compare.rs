//! The compare view, used as a user uses it: by pointer and by keys.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::LumenApp;
use lumen::app::compare::{Arrangement, Cell, Made, Outcome};
use lumen::pipeline::paper;
use lumen::pipeline::settings::{Keep, Target};
use lumen_ui_tests::{app, settle, settle_wholly};

const DESKTOP: [f32; 2] = [1280.0, 800.0];
const PHONE: [f32; 2] = [390.0, 844.0];

fn press(harness: &mut Harness<'_, LumenApp>, button: &str) {
    harness.get_by_role_and_label(Role::Button, button).click();
    harness.run_steps(3);
}

/// The app with the compare view open and all results there.
fn open() -> Harness<'static, LumenApp> {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    press(&mut harness, "Compare");
    settle(&mut harness);
    harness
}

fn cells<'a>(harness: &'a Harness<'_, LumenApp>) -> &'a [Cell] {
    harness.state().state().comparison.cells()
}

fn made(cell: &Cell) -> &Made {
    match &cell.outcome {
        Outcome::Done(made) => made,
        outcome => panic!("{outcome:?}"),
    }
}

fn titles(harness: &Harness<'_, LumenApp>) -> Vec<String> {
    let cells = harness.query_all_by_role(Role::RadioButton);
    cells.map(|cell| cell.accesskit_node().label().unwrap_or_default()).collect()
}

#[test]
fn the_button_opens_figure_seven_with_its_counts_and_closes_again() {
    let mut harness = open();
    assert_eq!(titles(&harness), ["Reduction 10 %", "Reduction 90 %", "Reduction 99 %"]);
    // Table II of the paper.
    for (cell, printed) in cells(&harness).iter().zip([66_875, 7_430, 743]) {
        let made = made(cell);
        assert!((printed - 2..=printed).contains(&made.mesh.triangles.len()), "{}", made.mesh.triangles.len());
        assert_eq!(made.report.output.triangles, made.mesh.triangles.len());
        assert!(made.report.deviation_mm.is_some() && made.report.volume_change_percent.is_some());
    }
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_none());
    assert!(harness.query_all_by_label_contains("Not for clinical decisions").count() >= 2, "in the view and the bar");
    press(&mut harness, "Compare");
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_some());
    assert!(titles(&harness).is_empty());
}

#[test]
fn figure_six_has_six_settings_and_a_click_takes_one() {
    let mut harness = open();
    press(&mut harness, "Figure 6");
    settle(&mut harness);
    assert_eq!(
        cells(&harness).iter().map(|cell| cell.settings.clone()).collect::<Vec<_>>(),
        paper::figure_6(Keep::Largest)
    );
    assert!(cells(&harness).iter().all(|cell| made(cell).mesh.triangles.len() == 74_307));
    // The paper: more iterations and a narrower pass band smooth more, which takes the surface farther from what it was.
    let moved = |i: usize| made(&cells(&harness)[i]).report.deviation_from_original_mm.unwrap().mean;
    assert!(moved(0) < moved(3) && moved(2) < moved(5), "{} {} {} {}", moved(0), moved(3), moved(2), moved(5));
    harness.get_by_role_and_label(Role::RadioButton, "Pass band 0.1, 30 iterations").click();
    harness.run_steps(3);
    assert_eq!(harness.state().state().settings, cells(&harness)[0].settings);
    settle(&mut harness);
    press(&mut harness, "Undo");
    assert_eq!(harness.state().state().settings.target, Target::Reduction(900));
}

#[test]
fn settings_are_added_removed_and_never_more_than_six() {
    let mut harness = open();
    assert!(!harness.state().state().comparison.can_add(&harness.state().state().settings), "90 % is there already");
    press(&mut harness, "Remove Reduction 90 %");
    assert_eq!(cells(&harness).len(), 2);
    press(&mut harness, "Add current settings");
    settle(&mut harness);
    assert_eq!(titles(&harness), ["Reduction 10 %", "Reduction 99 %", "Reduction 90 %"]);
    press(&mut harness, "Figure 6");
    let before = cells(&harness).len();
    harness.get_by_role_and_label(Role::Button, "Add current settings").click();
    harness.run_steps(3);
    assert_eq!((before, cells(&harness).len()), (6, 6));
    // Until the last result is there, numbers that arrive move what is pressed.
    settle(&mut harness);
    for title in titles(&harness) {
        let title =
            titles(&harness).iter().find(|now| **now == title).cloned().unwrap_or_else(|| titles(&harness)[0].clone());
        press(&mut harness, &format!("Remove {title}"));
    }
    assert!(cells(&harness).is_empty());
    assert!(harness.query_by_label_contains("Nothing is compared yet").is_some());
}

#[test]
fn keys_open_choose_and_close() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    harness.key_press(Key::C);
    harness.run_steps(3);
    settle(&mut harness);
    let cell = harness.get_by_role_and_label(Role::RadioButton, "Reduction 99 %");
    cell.focus();
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(harness.state().state().settings.target, Target::Reduction(990));
    settle(&mut harness);
    harness.key_press(Key::C);
    harness.run_steps(3);
    assert!(!harness.state().state().comparison.is_open());
}

#[test]
fn a_view_that_is_left_and_opened_again_shows_the_same() {
    let mut harness = open();
    // Marks and verdicts that come later would be seen.
    settle_wholly(&mut harness);
    let picture = |harness: &mut Harness<'_, LumenApp>| {
        harness.hover_at(egui::pos2(640.0, 20.0));
        harness.run_steps(12);
        harness.render().unwrap()
    };
    let before = picture(&mut harness);
    press(&mut harness, "Compare");
    let left = picture(&mut harness);
    press(&mut harness, "Compare");
    assert_eq!(picture(&mut harness).as_raw(), before.as_raw());
    assert_ne!(left.as_raw(), before.as_raw());
}

#[test]
fn the_tab_key_reaches_every_cell() {
    let mut harness = open();
    let mut reached = std::collections::BTreeSet::new();
    for _ in 0..60 {
        harness.key_press(Key::Tab);
        harness.run_steps(1);
        let cells = harness.query_all_by_role(Role::RadioButton);
        reached.extend(cells.filter(egui_kittest::Node::is_focused).filter_map(|cell| cell.accesskit_node().label()));
    }
    assert_eq!(reached.len(), 3, "{reached:?}");
}

#[test]
fn all_pictures_turn_together_and_go_with_the_theme_and_the_arrangement() {
    let mut harness = open();
    let places: Vec<_> = harness.query_all_by_role(Role::RadioButton).map(|cell| cell.rect()).collect();
    let look = |harness: &mut Harness<'_, LumenApp>| -> Vec<Vec<u8>> {
        // The pointer would mark the cell that it is over.
        harness.hover_at(egui::pos2(640.0, 20.0));
        harness.run_steps(3);
        let picture = harness.render().unwrap();
        let crop = |rect: &egui::Rect| {
            let rect = rect.shrink(4.0);
            let rows = rect.top() as u32..rect.bottom() as u32;
            let columns = rect.left() as u32..rect.right() as u32;
            let pixels = rows.flat_map(|y| columns.clone().map(move |x| (x, y)));
            pixels.flat_map(|(x, y)| picture.get_pixel(x, y).0).collect()
        };
        places.iter().map(crop).collect()
    };
    let first = look(&mut harness);
    let middle = places[1].center();
    harness.drag_at(middle);
    harness.run_steps(2);
    harness.hover_at(middle + egui::vec2(60.0, 0.0));
    harness.run_steps(2);
    harness.drop_at(middle + egui::vec2(60.0, 0.0));
    harness.run_steps(2);
    let turned = look(&mut harness);
    assert!(first.iter().zip(&turned).all(|(a, b)| a != b), "one camera for all");
    assert_eq!(harness.state().state().settings.target, Target::Reduction(900), "a drag is no click");
    harness.get_by_role_and_label(Role::ComboBox, "Show as").click();
    harness.run_steps(3);
    harness.get_by_label("Wireframe").click();
    harness.run_steps(3);
    assert_eq!(harness.state().state().comparison.arrangement, Arrangement::Wireframe);
    let lines = look(&mut harness);
    assert!(turned.iter().zip(&lines).all(|(a, b)| a != b));
    press(&mut harness, "Theme");
    assert!(look(&mut harness).iter().zip(&lines).all(|(a, b)| a != b));
}

#[test]
fn another_surface_is_compared_anew() {
    let mut harness = open();
    press(&mut harness, "Sample");
    harness.get_by_label_contains("oronary").click();
    harness.run_steps(3);
    settle(&mut harness);
    let entering = harness.state().state().document.as_ref().unwrap().levels.as_ref().unwrap().1.triangles.len();
    assert_ne!(entering, 74_307);
    for (cell, rate) in cells(&harness).iter().zip([100, 900, 990]) {
        let wanted = Target::Reduction(rate).triangles(entering);
        assert!(made(cell).mesh.triangles.len().abs_diff(wanted) <= 2, "{rate}");
    }
}

#[test]
fn a_cancel_leaves_cells_to_be_tried_again() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    memory.borrow_mut().slice = std::time::Duration::ZERO;
    press(&mut harness, "Compare");
    press(&mut harness, "Figure 6");
    harness.run_steps(20);
    assert!(harness.state().state().is_busy());
    press(&mut harness, "Cancel");
    harness.run_steps(5);
    assert!(!harness.state().state().is_busy());
    assert!(cells(&harness).iter().all(|cell| matches!(&cell.outcome, Outcome::Failed(why) if why == "Cancelled.")));
    memory.borrow_mut().slice = std::time::Duration::from_millis(50);
    harness.query_all_by_role_and_label(Role::Button, "Try again").next().expect("a button").click();
    harness.run_steps(3);
    settle(&mut harness);
    assert_eq!(cells(&harness).iter().filter(|cell| matches!(cell.outcome, Outcome::Done(_))).count(), 1);
}

#[test]
fn a_phone_has_two_cells_a_row() {
    let (mut harness, _) = app(PHONE);
    settle(&mut harness);
    press(&mut harness, "Menu");
    press(&mut harness, "Compare");
    press(&mut harness, "Figure 6");
    settle(&mut harness);
    let places: Vec<_> = harness.query_all_by_role(Role::RadioButton).map(|cell| cell.rect()).collect();
    assert_eq!(places.len(), 6);
    assert!(places.iter().all(|rect| rect.left() >= 0.0 && rect.right() <= PHONE[0]), "{places:?}");
    assert!(places[0].top() == places[1].top() && places[2].top() > places[1].bottom(), "{places:?}");
}

/// Leaves pictures to look at in the target folder's `tmp`.
#[test]
fn pictures_of_the_compare_view() {
    for (size, name) in [(DESKTOP, "desktop"), (PHONE, "phone")] {
        let (mut harness, _) = app(size);
        settle(&mut harness);
        harness.key_press(Key::C);
        harness.run_steps(3);
        for figure in ["Figure 7", "Figure 6"] {
            press(&mut harness, figure);
            settle(&mut harness);
            for theme in [egui::Theme::Light, egui::Theme::Dark] {
                harness.ctx.set_theme(theme);
                harness.run_steps(3);
                let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"))
                    .join(format!("compare-{name}-{}-{theme:?}.png", figure.replace(' ', "-")).to_lowercase());
                let picture = harness.render().unwrap();
                let colours: std::collections::BTreeSet<_> = picture.pixels().map(|pixel| pixel.0).collect();
                assert!(colours.len() > 200, "{}", colours.len());
                let mut encoder =
                    png::Encoder::new(std::fs::File::create(path).unwrap(), picture.width(), picture.height());
                encoder.set_color(png::ColorType::Rgba);
                encoder.write_header().unwrap().write_image_data(picture.as_raw()).unwrap();
            }
        }
    }
}
