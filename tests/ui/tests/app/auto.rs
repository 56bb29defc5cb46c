//! The reduction that is set by itself: as far as is safe, and 90 % at most.

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::LumenApp;
use lumen::pipeline::settings::Target;
use lumen_ui_tests::{DESKTOP, app, app_in_full, open, says, settle_wholly, tube};

use crate::controls::{press_at, shown};

fn target(harness: &Harness<'_, LumenApp>) -> Target {
    harness.state().state().settings.target
}

fn entering(harness: &Harness<'_, LumenApp>) -> usize {
    harness.state().state().document.as_ref().unwrap().levels.as_ref().unwrap().1.triangles.len()
}

/// What the field beside the slider shows.
fn field(harness: &Harness<'_, LumenApp>) -> String {
    let node = harness.get_by_role_and_label(Role::SpinButton, "Reduction value");
    node.accesskit_node().value().unwrap_or_default()
}

#[test]
fn a_coarse_surface_opens_as_far_reduced_as_is_safe_and_that_is_told() {
    let (mut harness, memory) = app(DESKTOP);
    settle_wholly(&mut harness);
    // Thirteen edges about a tube of 4 mm: of a tenth of them no circle is left.
    open(&mut harness, &memory, "tube.obj", tube(2.0, 40.0, 1.0));
    settle_wholly(&mut harness);
    let state = harness.state().state();
    let safe = state.safe().unwrap().percent.unwrap();
    assert!(safe < 90.0, "{safe}");
    let wanted = Target::Reduction((safe * 10.0).round() as u32).triangles(entering(&harness));
    assert!(shown(&harness).abs_diff(wanted) <= 1, "{} beside {wanted}", shown(&harness));
    assert!(target(&harness) == Target::Auto && !state.history.can_undo(), "no step to undo comes of it");
    assert!(says(&harness, &format!("Automatic: {safe:.1} %, as far as is safe")));
    assert!(says(&harness, &format!("Reduced by {safe:.1} %: more would not be safe.")));
    assert!(says(&harness, "Safe to simulate on"));
    let is_there = |harness: &Harness<'_, LumenApp>| {
        harness.get_by_role_and_label(Role::Button, "Go there").accesskit_node().is_disabled()
    };
    assert!(is_there(&harness), "one is there");
    let before = shown(&harness);
    // A hand at the slider makes it a number; the way back is a click.
    press_at(&mut harness, "Reduction", 0.95);
    settle_wholly(&mut harness);
    assert!(matches!(target(&harness), Target::Reduction(rate) if rate > 900), "{:?}", target(&harness));
    assert!(says(&harness, "to look at") && !is_there(&harness));
    harness.get_by_role_and_label(Role::Button, "Reset reduction").click();
    settle_wholly(&mut harness);
    assert_eq!((target(&harness), shown(&harness)), (Target::Auto, before));
    // Another tolerance is another rate, and the number stays where it is once the box is empty.
    harness.get_by_label_contains("as far as is safe").click();
    harness.run_steps(2);
    assert_eq!(target(&harness), Target::Reduction((safe * 10.0).round() as u32));
    harness.get_by_label_contains("or as far as is safe").click();
    harness.run_steps(2);
    assert_eq!(target(&harness), Target::Auto);
}

#[test]
fn the_sample_is_safe_at_ninety_percent_and_opens_there() {
    let (mut harness, _) = app_in_full(DESKTOP);
    settle_wholly(&mut harness);
    assert_eq!(target(&harness), Target::Auto);
    assert!((7_429..=7_430).contains(&shown(&harness)));
    assert!(says(&harness, "Automatic: 90.0 %") && !says(&harness, "more would not be safe"));
    assert!(says(&harness, "Reduction (auto)") && field(&harness).contains("90.0 %"), "{}", field(&harness));
}
