//! Presenter mode: larger letters, of the panel only what is dragged, keys and pointer shown; all of it goes again.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::LumenApp;
use lumen_ui_tests::{DESKTOP, PHONE, app, says, seen, settle, settle_wholly};

fn picture(harness: &mut Harness<'_, LumenApp>) -> Vec<[u8; 4]> {
    harness.render().unwrap().pixels().map(|pixel| pixel.0).collect()
}

/// How many pixels of the page are not as they were.
fn changed(before: &[[u8; 4]], harness: &mut Harness<'_, LumenApp>) -> usize {
    before.iter().zip(picture(harness)).filter(|(a, b)| *a != b).count()
}

fn has_panel(harness: &Harness<'_, LumenApp>) -> bool {
    harness.query_by_role_and_label(Role::Heading, "Result").is_some()
}

#[test]
fn letters_grow_the_panel_goes_but_for_what_is_dragged_and_escape_brings_all_back() {
    for size in [DESKTOP, PHONE] {
        let (mut harness, _) = app(size);
        settle(&mut harness);
        let zoom = harness.ctx.zoom_factor();
        harness.key_press(Key::P);
        harness.run_steps(4);
        let state = harness.state().state();
        let (told, work) = (state.notices.newest().map(|notice| notice.text.clone()), state.work);
        assert!(says(&harness, "P or Esc ends it"), "{told:?} {work:?} at {size:?}");
        assert!(!has_panel(&harness));
        for slider in ["Pass band", "Iterations", "Reduction"] {
            let rect = harness.get_by_role_and_label(Role::Slider, slider).rect();
            let window = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::Vec2::from(size) / 1.4);
            assert!(window.contains_rect(rect), "{slider} at {rect} in {window}");
        }
        assert!((harness.ctx.zoom_factor() / zoom - 1.4).abs() < 1e-3);
        let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
        let curve = harness.query_all_by_role(Role::Image).find(|node| {
            let label = node.accesskit_node().label();
            label.is_some_and(|label| label.starts_with("Half gain"))
        });
        assert_eq!(curve.is_some(), size == DESKTOP, "what the filter lets through, where there is room");
        if let Some(curve) = curve.map(|node| node.rect()) {
            assert!(curve.height() > 200.0 && curve.width() > 240.0 && curve.left() > view.right(), "{curve}, {view}");
        }
        harness.key_press(Key::Escape);
        harness.run_steps(4);
        assert!(has_panel(&harness) && (harness.ctx.zoom_factor() - zoom).abs() < 1e-6);
        assert!(!says(&harness, "P or Esc ends it"), "it has ended");
    }
}

#[test]
fn a_key_is_shown_and_goes_again_and_the_pointer_has_a_halo() {
    let (mut harness, _) = seen(|| app(DESKTOP));
    // What is measured in the background is told in what stays of the panel.
    settle_wholly(&mut harness);
    harness.key_press(Key::P);
    harness.run_steps(20);
    let before = picture(&mut harness);
    // A key that does nothing else.
    harness.key_press(Key::J);
    harness.run_steps(2);
    let shown = changed(&before, &mut harness);
    assert!(shown > 300, "{shown} pixels");
    harness.run_steps(20);
    let gone = changed(&before, &mut harness);
    assert!(gone * 10 < shown, "{gone} of {shown} pixels");
    harness.hover_at(egui::pos2(500.0, 300.0));
    harness.run_steps(2);
    assert!(changed(&before, &mut harness) > 300);
}
