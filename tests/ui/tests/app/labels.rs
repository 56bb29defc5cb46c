//! What is written over a view can be read on whatever lies below it.

use egui::accesskit::Role;
use egui::{Key, Rect, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::LumenApp;
use lumen::render::{Colour, contrast};
use lumen_ui_tests::{DESKTOP, app, open, seen, settle_wholly};

/// The contrast of the brightest and the darkest pixel in a part of the window.
fn contrast_in(harness: &mut Harness<'_, LumenApp>, part: Rect) -> f32 {
    let picture = harness.render().unwrap();
    let [left, right, top, bottom] = [part.left(), part.right(), part.top(), part.bottom()].map(|at| at as u32);
    let colours = (top..bottom).flat_map(|y| (left..right).map(move |x| (x, y))).map(|(x, y)| {
        let [r, g, b, _] = picture.get_pixel(x, y).0;
        Colour([r, g, b])
    });
    let mut colours = Vec::from_iter(colours);
    colours.sort_by(|a, b| a.luminance().total_cmp(&b.luminance()));
    contrast(colours[0], colours[colours.len() - 1])
}

#[test]
fn labels_over_the_outside_and_the_inside_of_a_wall_have_their_contrast_in_both_themes() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    settle_wholly(&mut harness);
    let bytes = b"v -30 0 -30\nv 30 0 -30\nv 30 0 30\nv -30 0 30\nf 1 2 3 4\n".to_vec();
    open(&mut harness, &memory, "sheet.obj", bytes);
    for _theme in 0..2 {
        for side in [Key::Num1, Key::Num2] {
            harness.key_press(side);
            harness.run_steps(3);
            // As near as that the wall is behind all of the view.
            harness.key_down(Key::Plus);
            harness.run_steps(12);
            harness.key_up(Key::Plus);
            harness.run_steps(3);
            let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
            let title = Rect::from_min_size(view.left_top() + vec2(13.0, 12.0), vec2(70.0, 18.0));
            let foot = view.left_bottom();
            let scale = Rect::from_min_max(foot + vec2(13.0, -36.0), foot + vec2(90.0, -24.0));
            let ground = harness.render().unwrap();
            for at in [pos2(view.left() + 6.0, view.top() + 20.0), pos2(view.left() + 6.0, view.bottom() - 30.0)] {
                let [r, g, _, _] = ground.get_pixel(at.x as u32, at.y as u32).0.map(i32::from);
                assert!(r > g + 20, "{side:?}: the wall is below what is written: {r} {g}");
            }
            for label in [title, scale] {
                let found = contrast_in(&mut harness, label);
                assert!(found >= 4.5, "{side:?}: {label}: {found}");
            }
        }
        harness.key_press(Key::T);
        harness.run_steps(3);
    }
}
