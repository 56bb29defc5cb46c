//! What the *View* menu does to the light of the shaded view.

use egui::accesskit::{Role, Toggled};
use egui::{Rect, pos2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::LumenApp;
use lumen_ui_tests::{DESKTOP, app, seen, settle, settle_wholly};

/// The sum of all colours in the shaded view, or where the comparison is.
fn brightness(harness: &mut Harness<'_, LumenApp>) -> u64 {
    let view = harness
        .query_by_role_and_label(Role::Image, "Shaded view")
        .map_or(Rect::from_min_max(pos2(330.0, 120.0), pos2(1270.0, 500.0)), |view| view.rect());
    let picture = harness.render().unwrap();
    let pixels = (view.top() as u32..view.bottom() as u32)
        .flat_map(|y| (view.left() as u32..view.right() as u32).map(move |x| (x, y)));
    pixels.map(|(x, y)| picture.get_pixel(x, y).0[..3].iter().map(|&c| u64::from(c)).sum::<u64>()).sum()
}

#[test]
fn ambient_occlusion_is_switched_in_the_view_menu() {
    let (mut harness, _) = seen(|| app(DESKTOP));
    settle_wholly(&mut harness);
    is_switched(&mut harness);
    // The cells of a comparison follow.
    harness.get_by_role_and_label(Role::Button, "Compare").click();
    harness.run_steps(3);
    settle(&mut harness);
    is_switched(&mut harness);
}

/// Off, on and off again, or the other way round.
fn is_switched(harness: &mut Harness<'_, LumenApp>) {
    let mut found = Vec::new();
    for _ in 0..3 {
        harness.hover_at(pos2(4.0, 796.0));
        harness.run_steps(3);
        let seen = brightness(harness);
        harness.get_by_role_and_label(Role::Button, "View").click();
        harness.run_steps(3);
        let switch = harness.get_by_role_and_label(Role::CheckBox, "Ambient occlusion");
        found.push((switch.accesskit_node().toggled() == Some(Toggled::True), seen));
        // The menu closes with that.
        switch.click();
        harness.run_steps(3);
    }
    assert_eq!(found[0], found[2], "off and on again it is as it was");
    found.truncate(2);
    found.sort_unstable();
    let [(false, without), (true, with)] = found[..] else { panic!("{found:?}") };
    assert!(with < without, "{with} is not darker than {without}");
}
