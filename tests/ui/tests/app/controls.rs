//! Each control of the settings does what it says, moved as a user moves it: by pointer and keys, found by role and name.

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::LumenApp;
use lumen::pipeline::filter::Filter;
use lumen::pipeline::settings::{Method, Target, Window};
use lumen_ui_tests::{DESKTOP, app, app_in_full, says, seen, settle, unfold};

pub(crate) fn open() -> Harness<'static, LumenApp> {
    let (mut harness, _) = app_in_full(DESKTOP);
    settle(&mut harness);
    harness
}

/// Moves a slider by pressing on it at a part of its length.
pub(crate) fn press_at(harness: &mut Harness<'_, LumenApp>, slider: &str, part: f32) {
    let rect = harness.get_by_role_and_label(Role::Slider, slider).rect();
    let at = egui::pos2(rect.left() + rect.width() * part, rect.center().y);
    harness.drag_at(at);
    harness.run_steps(2);
    harness.drop_at(at);
    harness.run_steps(2);
}

/// Types into the field beside a slider.
pub(crate) fn type_into(harness: &mut Harness<'_, LumenApp>, field: &str, text: &str) {
    harness.get_by_role_and_label(Role::SpinButton, field).scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::SpinButton, field).click();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.event(egui::Event::Text(text.to_owned()));
    harness.run_steps(1);
    harness.key_press(Key::Enter);
    harness.run_steps(2);
}

pub(crate) fn shown(harness: &Harness<'_, LumenApp>) -> usize {
    let document = harness.state().state().document.as_ref();
    document.and_then(|document| document.shown.as_ref()).map_or(0, |shown| shown.level.triangles.len())
}

#[test]
fn the_reduction_slider_shows_another_level_in_the_same_frame() {
    let (mut harness, memory) = app_in_full(DESKTOP);
    settle(&mut harness);
    memory.borrow_mut().runs = false;
    let before = shown(&harness);
    press_at(&mut harness, "Reduction", 0.5);
    let (after, target) = (shown(&harness), harness.state().state().settings.target);
    let wanted = target.triangles(74_307);
    assert!(after > 4 * before && after <= wanted && after + 2 > wanted, "{before} {after} {target:?}");
}

#[test]
fn the_picture_follows_the_slider_in_the_same_frame() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    settle(&mut harness);
    memory.borrow_mut().runs = false;
    let slider = harness.get_by_role_and_label(Role::Slider, "Reduction").rect();
    let at = |part: f32| egui::pos2(slider.left() + slider.width() * part, slider.center().y);
    let view = harness.get_by_role_and_label(Role::Image, "Wireframe view").rect().shrink(2.0);
    let picture = |harness: &mut Harness<'_, LumenApp>| {
        let [left, top] = [view.left() as u32, view.top() as u32];
        let whole = harness.render().unwrap();
        // Below the writing.
        let part = (top + 60..view.bottom() as u32).flat_map(|y| (left..view.right() as u32).map(move |x| (x, y)));
        part.map(|(x, y)| whole.get_pixel(x, y).0).collect::<Vec<_>>()
    };
    harness.drag_at(at(0.9));
    harness.run_steps(3);
    let before = picture(&mut harness);
    harness.hover_at(at(0.5));
    harness.step();
    let after = picture(&mut harness);
    harness.run_steps(3);
    assert!(before != after && after == picture(&mut harness));
}

#[test]
fn a_typed_rate_and_a_typed_count_are_met() {
    let mut harness = open();
    type_into(&mut harness, "Reduction value", "99");
    assert_eq!(harness.state().state().settings.target, Target::Reduction(990));
    assert!((742..=743).contains(&shown(&harness)));
    type_into(&mut harness, "Triangles wanted", "18576");
    assert_eq!(harness.state().state().settings.target, Target::Triangles(18_576));
    assert!((18_575..=18_576).contains(&shown(&harness)));
    let field = harness.get_by_role_and_label(Role::SpinButton, "Triangles wanted");
    assert_eq!(field.accesskit_node().value().as_deref(), Some("18,576"), "in groups, as all other counts");
}

#[test]
fn a_deviation_to_stop_at_is_chosen_set_and_left_again() {
    let mut harness = open();
    let largest = |harness: &Harness<'_, LumenApp>| {
        let measured = harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap();
        measured.report.deviation_mm.unwrap().max
    };
    let (before, deviation) = (shown(&harness), largest(&harness));
    choose(&mut harness, "Stop at", "Deviation");
    let bound = harness.state().state().settings.target.deviation_mm().unwrap();
    assert!((bound - deviation).abs() <= 1e-3, "it goes on from what is shown: {bound} beside {deviation}");
    assert!(harness.query_by_role_and_label(Role::Slider, "Reduction").is_none());
    for (typed, part) in [("0.3", 0.8), ("2", 0.95)] {
        type_into(&mut harness, "Largest deviation value", typed);
        settle(&mut harness);
        assert_eq!(harness.state().state().settings.target.deviation_mm(), typed.parse().ok());
        assert!(largest(&harness) <= typed.parse::<f64>().unwrap());
        let fine = shown(&harness);
        press_at(&mut harness, "Largest deviation", part);
        settle(&mut harness);
        assert!(shown(&harness) < fine, "a larger bound needs fewer triangles");
    }
    let found = shown(&harness);
    choose(&mut harness, "Stop at", "Rate or count");
    let rate = harness.state().state().settings.target;
    assert!(matches!(rate, Target::Reduction(_)) && rate.triangles(74_307).abs_diff(found) <= 75, "{rate:?}, {found}");
    for _ in 0..8 {
        if harness.state().state().settings.target == Target::default() {
            break;
        }
        harness.get_by_role_and_label(Role::Button, "Undo").click();
        harness.run_steps(2);
    }
    settle(&mut harness);
    assert_eq!(shown(&harness), before);
}

#[test]
fn the_next_coarser_level_is_that_of_the_settings() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    choose(&mut harness, "Stop at", "Deviation");
    settle(&mut harness);
    let measured = harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap();
    let next = format!("{:.3} mm", measured.report.bound.unwrap().next_coarser_mm.unwrap());
    assert!(harness.query_all_by_label(&next).next().is_some(), "{next}");
    memory.borrow_mut().runs = false;
    type_into(&mut harness, "Pass band value", "0.1");
    assert!(harness.query_all_by_label(&next).next().is_none(), "another smoothing has other levels");
}

#[test]
fn the_panel_says_how_far_is_safe_and_goes_there() {
    let mut harness = open();
    let percent = safe_percent(&mut harness);
    assert!((90.0..99.0).contains(&percent), "{percent}");
    assert!(harness.query_by_label(&format!("{percent:.1} %")).is_some());
    harness.get_by_role_and_label(Role::Button, "Go there").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::Button, "Go there").click();
    settle(&mut harness);
    let wanted = Target::Reduction((percent * 10.0).round() as u32);
    assert_eq!(harness.state().state().settings.target, wanted);
    assert_eq!(safe_percent(&mut harness), percent, "the same from every level");
}

/// Up to which rate a reduction is called safe, once that is known: it comes after the other numbers.
pub(crate) fn safe_percent(harness: &mut Harness<'_, LumenApp>) -> f64 {
    for _ in 0..4000 {
        let measured = harness.state().state().document.as_ref().and_then(|document| document.measured.as_ref());
        if let Some(safe) = measured.and_then(|measured| measured.safe.clone()) {
            harness.run_steps(2);
            return safe.percent.unwrap();
        }
        harness.step();
    }
    panic!("how far is safe is never told");
}

#[test]
fn the_other_method_leaves_less_deviation() {
    let mut harness = open();
    let mean = |harness: &Harness<'_, LumenApp>| {
        let document = harness.state().state().document.as_ref().unwrap();
        document.measured.as_ref().unwrap().report.deviation_mm.unwrap().mean
    };
    let (count, before) = (shown(&harness), mean(&harness));
    unfold(&mut harness, "Advanced: Reduce");
    choose(&mut harness, "Method", "Quadric");
    settle(&mut harness);
    assert_eq!(harness.state().state().settings.decimation.method, Method::Quadric);
    assert!(shown(&harness).abs_diff(count) <= 1 && mean(&harness) < 0.7 * before, "{} {before}", mean(&harness));
}

/// Chooses from a list.
pub(crate) fn choose(harness: &mut Harness<'_, LumenApp>, list: &str, choice: &str) {
    harness.get_by_role_and_label(Role::ComboBox, list).scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::ComboBox, list).click();
    harness.run_steps(2);
    harness.get_by_label(choice).click();
    harness.run_steps(2);
}

#[test]
fn smoothing_is_set_by_slider_field_and_list_and_goes_back() {
    let mut harness = open();
    press_at(&mut harness, "Pass band", 0.9);
    assert!(harness.state().state().settings.smoothing.pass_band > 0.5);
    harness.get_by_role_and_label(Role::Button, "Reset pass band").click();
    harness.run_steps(2);
    assert!((harness.state().state().settings.smoothing.pass_band - 0.01).abs() < 1e-12);
    type_into(&mut harness, "Iterations value", "30");
    assert_eq!(harness.state().state().settings.smoothing.iterations, 30);
    unfold(&mut harness, "Advanced: Smooth");
    choose(&mut harness, "Window", "Nuttall");
    assert_eq!(harness.state().state().settings.smoothing.window, Window::Nuttall);
    settle(&mut harness);
    let measured = harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap();
    assert_eq!(measured.report.settings, harness.state().state().settings);
}

#[test]
fn a_number_is_typed_with_a_decimal_comma_as_with_a_point() {
    let mut harness = open();
    for (typed, meant) in [("0,02", 0.02), ("0.03", 0.03)] {
        type_into(&mut harness, "Pass band value", typed);
        let pass_band = harness.state().state().settings.smoothing.pass_band;
        assert!((pass_band - meant).abs() < 1e-12, "{typed}: {pass_band}");
    }
    type_into(&mut harness, "Reduction value", "87,5");
    assert_eq!(harness.state().state().settings.target, Target::Reduction(875));
    type_into(&mut harness, "Triangles wanted", "10,000");
    assert_eq!(harness.state().state().settings.target, Target::Triangles(10_000));
}

/// A number that the panel states: in the text that has `part`, behind `after`.
fn stated(harness: &Harness<'_, LumenApp>, part: &str, after: &str) -> f64 {
    let nodes = harness.query_all_by_label_contains(part);
    let mut texts = nodes.filter_map(|node| node.accesskit_node().label().or(node.accesskit_node().value()));
    let text = texts.next().unwrap();
    let rest = &text[text.find(after).unwrap() + after.len()..];
    let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
    rest[..end].parse().unwrap()
}

/// What the panel says of the filter's half gain: its eigenvalue and the length of the waves in mm.
fn half_gain(harness: &Harness<'_, LumenApp>) -> (f64, f64) {
    let number = |after: &str| stated(harness, "Half gain at", after);
    (number("k = "), number("waves of "))
}

#[test]
fn the_panel_says_where_the_filter_cuts_and_the_words_move_with_the_sliders() {
    let mut harness = open();
    harness.get_by_label("Response").click();
    harness.run_steps(10);
    let report = harness.state().state().document.as_ref().unwrap().measured.as_ref().unwrap().report.clone();
    let response = report.smoothing_response.unwrap();
    let (k, length) = half_gain(&harness);
    assert!((k / response.half_gain.unwrap() - 1.0).abs() < 0.01);
    assert!((length / response.wavelength_mm_at_half_gain.unwrap() - 1.0).abs() < 0.01);
    press_at(&mut harness, "Pass band", 0.6);
    let (wider, shorter) = half_gain(&harness);
    assert!(wider > 2.0 * k && shorter < length / 1.4, "{k} {length} became {wider} {shorter}");
    type_into(&mut harness, "Iterations value", "0");
    assert!(harness.query_by_label_contains("Half gain at").is_none(), "nothing is smoothed");
}

#[test]
fn the_terms_add_up_on_the_curve_and_laplacian_smoothing_stands_beside_it() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    harness.get_by_label("Response").click();
    harness.run_steps(10);
    assert!(!says(&harness, "terms 0 to"), "all of them are the curve itself");
    harness.get_by_role_and_label(Role::Slider, "Terms").scroll_to_me();
    harness.run_steps(12);
    press_at(&mut harness, "Terms", 0.25);
    let last = stated(&harness, "terms 0 to", "terms 0 to ");
    assert!((15.0..35.0).contains(&last), "{last} of 100 at a quarter of the way");
    // What is left of the sum of c_n T_n(cos t), where T_n(cos t) = cos(n t), t from 0 to a right angle.
    let farthest = |last: f64| {
        let filter = Filter::new(&harness.state().state().settings.smoothing);
        let rest: Vec<(i32, f64)> = (0..).zip(filter.coefficients).skip(last as usize + 1).collect();
        let left = |part: i32| -> f64 {
            let angle = f64::from(part) / 2000.0 * std::f64::consts::FRAC_PI_2;
            rest.iter().map(|(n, c)| c * (f64::from(*n) * angle).cos()).sum()
        };
        (0..=2000).map(|part| 100.0 * left(part).abs()).fold(0.0, f64::max)
    };
    let (few, fewer) = (farthest(last), farthest(0.0));
    assert!((stated(&harness, "terms 0 to", "up to ") / few - 1.0).abs() < 0.02, "{few}");
    type_into(&mut harness, "Terms value", "0");
    assert!((stated(&harness, "terms 0 to 0 of 100", "up to ") / fewer - 1.0).abs() < 0.02 && fewer > few, "{fewer}");
    type_into(&mut harness, "Terms value", "100");
    assert!(!says(&harness, "terms 0 to"));

    harness.get_by_role_and_label(Role::CheckBox, "Laplacian beside it").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::CheckBox, "Laplacian beside it").click();
    harness.run_steps(3);
    // The edges, and the thinnest vessel as it was opened: a pass that shrinks it does not make its own yardstick.
    let measures = |harness: &Harness<'_, LumenApp>| {
        let document = harness.state().state().document.as_ref()?;
        let found = document.calibre.as_ref()?.found.as_ref().ok()?;
        let radii = found.branches.iter().filter_map(|branch| branch.opened.inscribed_radius_mm);
        let edge = document.measured.as_ref()?.report.smoothing_response?.edge_length_mm;
        Some((edge, 2.0 * radii.map(|radius| radius.least).reduce(f64::min)?))
    };
    while measures(&harness).is_none() {
        harness.step();
    }
    memory.borrow_mut().runs = false;
    harness.run_steps(2);
    let (edge, diameter) = measures(&harness).unwrap();
    // 100 passes at a half; 1 - J0(edge / radius), by Bessel's integral.
    let left = |edges: f64| {
        let cosines = (0..720).map(|i| (edges * (std::f64::consts::PI * f64::from(i) / 720.0).sin()).cos());
        let k = 1.0 - cosines.sum::<f64>() / 720.0;
        (1.0 - k / 2.0).powi(100)
    };
    let becomes = stated(&harness, "Laplacian passes", "becomes ");
    assert!((becomes - diameter * left(2.0 * edge / diameter)).abs() < 0.011, "{becomes} of {diameter}");
    assert!(becomes < 0.9 * diameter, "it shrinks");
    // A wave of 30 mm.
    type_into(&mut harness, "Wave value", "30");
    let of_wave = stated(&harness, "Laplacian passes", "= 0.5: ");
    assert!((of_wave - 100.0 * left(std::f64::consts::TAU * edge / 30.0)).abs() < 0.2, "{of_wave} %");
    // The wave around it lies below this pass band: what the paper's filter leaves alone.
    type_into(&mut harness, "Pass band value", "0.5");
    let by_sinc = stated(&harness, "Laplacian passes", "windowed sinc ");
    assert!((by_sinc / diameter - 1.0).abs() < 0.03, "{by_sinc} of {diameter}");
}

#[test]
fn the_volume_is_held_when_the_box_is_ticked() {
    let mut harness = open();
    unfold(&mut harness, "Advanced: Smooth");
    harness.get_by_role_and_label(Role::CheckBox, "Preserve volume").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::CheckBox, "Preserve volume").click();
    settle(&mut harness);
    let measured = harness.state().state().document.as_ref().unwrap().measured.clone().unwrap();
    assert_eq!(measured.report.volume_held, Some(true));
    assert!(measured.report.settings.smoothing.preserve_volume);
}

#[test]
fn thin_vessels_are_spared_when_the_box_is_ticked() {
    let mut harness = open();
    let before = harness.state().state().document.as_ref().unwrap().levels.clone().unwrap().1;
    unfold(&mut harness, "Advanced: Reduce");
    harness.get_by_role_and_label(Role::CheckBox, "Spare thin vessels").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::CheckBox, "Spare thin vessels").click();
    settle(&mut harness);
    let document = harness.state().state().document.as_ref().unwrap();
    assert!(document.measured.as_ref().unwrap().report.settings.decimation.spare_thin);
    assert!(document.levels.as_ref().unwrap().1 != before);
    assert!((7_429..=7_430).contains(&shown(&harness)));
}

#[test]
fn the_feature_angle_is_set() {
    let mut harness = open();
    unfold(&mut harness, "Advanced: Reduce");
    type_into(&mut harness, "Feature angle value", "15");
    settle(&mut harness);
    assert!((harness.state().state().settings.decimation.feature_angle - 15.0).abs() < 1e-12);
}

#[test]
fn undo_and_redo_walk_through_the_settings() {
    let mut harness = open();
    press_at(&mut harness, "Reduction", 0.2);
    let moved = harness.state().state().settings.clone();
    assert_ne!(moved.target, Target::default());
    harness.get_by_role_and_label(Role::Button, "Undo").click();
    harness.run_steps(2);
    assert_eq!(harness.state().state().settings.target, Target::default());
    assert!((7_429..=7_430).contains(&shown(&harness)));
    harness.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    harness.run_steps(2);
    assert_eq!(harness.state().state().settings, moved);
}
