//! What the views draw while they are turned slowly.

use egui::accesskit::Role;
use egui::vec2;
use egui_kittest::kittest::Queryable;
use lumen_ui_tests::{DESKTOP, app_at, seen, settle_wholly};

/// The wireframe in the middle of a turn whose frames take so many seconds each, and when the camera has rested since.
fn turned(took_s: f64) -> [Vec<[u8; 4]>; 2] {
    let (mut harness, _) = seen(|| app_at(DESKTOP, 1.0 / 60.0));
    settle_wholly(&mut harness);
    let view = harness.get_by_role_and_label(Role::Image, "Wireframe view").rect();
    let hand = view.min + vec2(60.0, 200.0);
    harness.drag_at(hand);
    harness.run_steps(2);
    let mut pictures = Vec::new();
    for (frames, by) in [(8, 5.0), (4, 0.0)] {
        for i in 1..=frames {
            let now_s = harness.ctx.input(|input| input.time);
            harness.input_mut().time = Some(now_s + took_s.max(0.1 * f64::from(u8::from(by == 0.0))));
            harness.hover_at(hand + vec2(if by > 0.0 { by * i as f32 } else { 40.0 }, 0.0));
            harness.step();
        }
        let picture = harness.render().unwrap();
        let at = |x: u32, y: u32| picture.get_pixel(view.left() as u32 + x, view.top() as u32 + y).0;
        pictures.push((150..500).flat_map(|y| (20..400).map(move |x| (x, y))).map(|(x, y)| at(x, y)).collect());
    }
    pictures.try_into().unwrap()
}

/// The part of two pictures that differs by more than rounding.
fn differ(a: &[[u8; 4]], b: &[[u8; 4]]) -> f64 {
    let is_other = |(a, b): &(&[u8; 4], &[u8; 4])| a.iter().zip(b.iter()).any(|(a, b)| a.abs_diff(*b) > 24);
    a.iter().zip(b).filter(is_other).count() as f64 / a.len() as f64
}

#[test]
fn a_slow_turn_is_drawn_light_and_in_full_once_the_camera_rests() {
    let [fast, slow] = [0.02, 0.2].map(turned);
    let light = differ(&slow[0], &slow[1]);
    assert!(light > 0.01, "half the size while it turns: {light}");
    assert_eq!(differ(&fast[0], &fast[1]), 0.0, "a fast turn is drawn in full");
    assert_eq!(differ(&fast[1], &slow[1]), 0.0, "and so is a slow one at its end");
}
