//! A graphics device is lost, or its memory is full: nothing that was open is.

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::LastingApp;
use lumen::pipeline::settings::Target;
use lumen::render::Fault;
use lumen_ui_tests::{DESKTOP, LastingWindow};

/// Brings the reduction to another value, as by dragging the slider.
fn move_reduction(window: &mut LastingWindow, part: f32) {
    let rect = window.harness.get_by_role_and_label(Role::Slider, "Reduction").rect();
    let at = egui::pos2(rect.left() + rect.width() * part, rect.center().y);
    window.harness.drag_at(at);
    window.harness.run_steps(2);
    window.harness.drop_at(at);
    window.settle();
}

/// The picture of the two views, without what stands beside them.
fn views(window: &mut LastingWindow) -> Vec<u8> {
    let rect = window.harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    let other = window.harness.get_by_role_and_label(Role::Image, "Wireframe view").rect();
    let image = window.harness.render().unwrap();
    let mut pixels = Vec::new();
    for rect in [rect, other] {
        for y in rect.top() as u32 + 2..rect.bottom() as u32 - 2 {
            for x in rect.left() as u32 + 2..rect.right() as u32 - 2 {
                pixels.extend(image.get_pixel(x, y).0);
            }
        }
    }
    pixels
}

fn kept(window: &LastingWindow) -> LastingApp {
    window.harness.state().clone()
}

/// Loses the device, and goes on in a window with another.
fn lost(mut window: LastingWindow) -> LastingWindow {
    window.device.destroy();
    let _ = window.device.poll(egui_wgpu::wgpu::PollType::wait_indefinitely());
    window.harness.step();
    assert!(matches!(&*window.end.borrow(), Some(Fault::Lost(_))), "{:?}", window.end);
    // A frame more, as there may be, does no harm.
    window.harness.step();
    let app = kept(&window);
    app.leave();
    drop(window);

    let mut window = LastingWindow::new(DESKTOP, Some(app));
    window.settle();
    window.harness.run_steps(3);
    let notice = window.harness.query_by_label_contains("have been started again. Nothing was lost.");
    assert!(notice.is_some(), "the user is told");
    window
}

#[test]
fn another_device_shows_what_stood_on_the_one_that_was_lost() {
    let mut window = LastingWindow::new(DESKTOP, None);
    window.settle();
    move_reduction(&mut window, 0.4);
    window.harness.key_press(egui::Key::L);
    window.harness.run_steps(3);
    let settings = window.harness.state().look(|app| app.state().settings.clone());
    assert_ne!(settings.target, Target::default(), "the slider was moved");

    let first = views(&mut window);
    // Letters stand in their texture in the order in which they came, and are rounded by their place there: of windows that
    // both go on with an app it is the same.
    let mut window = lost(window);
    let before = views(&mut window);
    assert!(first.len() == before.len() && first.iter().zip(&before).all(|(a, b)| a.abs_diff(*b) <= 1), "as it stood");
    let mut window = lost(window);
    assert_eq!(window.harness.state().look(|app| app.state().settings.clone()), settings);
    let after = views(&mut window);
    let differing = before.chunks_exact(4).zip(after.chunks_exact(4)).filter(|(a, b)| a != b).count();
    assert_eq!((before.len(), differing), (after.len(), 0), "the same picture");
    assert_eq!(*window.end.borrow(), None);

    // What could be undone still can.
    window.harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    window.settle();
    assert_eq!(window.harness.state().look(|app| app.state().settings.target), Target::default());
}

#[test]
fn full_memory_is_told_and_tried_again_with_a_coarser_level() {
    let mut window = LastingWindow::new(DESKTOP, None);
    window.settle();
    let before = views(&mut window);
    window.harness.state().mark(Fault::OutOfMemory);
    window.harness.run_steps(3);
    assert_eq!(*window.end.borrow(), None, "the device goes on");
    let sentence = |window: &LastingWindow| {
        window.harness.state().look(|app| app.state().notices.newest().map(|notice| notice.text.clone()))
    };
    assert!(sentence(&window).is_some_and(|text| text.starts_with("The graphics memory is full")));
    let differs = |a: &[u8], b: &[u8]| a.chunks_exact(4).zip(b.chunks_exact(4)).filter(|(a, b)| a != b).count();
    let without = views(&mut window);
    assert!(differs(&before, &without) > 20_000, "the surface is not drawn");
    window.harness.run_steps(5);
    assert_eq!(differs(&without, &views(&mut window)), 0, "nor is it tried again and again");

    move_reduction(&mut window, 0.97);
    let coarser = views(&mut window);
    assert!(differs(&coarser, &without) > 20_000, "the coarser level is");
    assert!(
        window.harness.get_by_role_and_label(Role::Slider, "Reduction").accesskit_node().numeric_value() > Some(95.0)
    );
}
