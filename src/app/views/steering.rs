//! How the camera of the views is moved: by mouse, trackpad, touch or keys, and where it stands at first.

use std::f32::consts::PI;

use egui::{PointerButton, Pos2, Rect, Ui, pos2, vec2};
use glam::{Quat, Vec2, Vec3};

use super::Views;
use crate::app::document::Document;
use crate::io::Axes;
use crate::pipeline::settings::Keep;
use crate::render::{Camera, StandardView};

impl Views {
    /// Moves the camera by what the hand does to the pictures in `response`, `rows` of which stand one above the other.
    pub(in crate::app) fn steer(
        &mut self,
        ui: &Ui,
        response: &egui::Response,
        rows: usize,
        document: Option<&Document>,
        keep: Keep,
    ) {
        let rect = response.rect;
        let height = (rect.height() / rows as f32).max(1.0);
        let fraction = |v: egui::Vec2| Vec2::new(v.x / height, v.y / height);
        let aspect = rect.width() / height;
        if let Some(touch) = ui.input(egui::InputState::multi_touch).filter(|touch| rect.contains(touch.center_pos)) {
            self.camera.pan(fraction(touch.translation_delta));
            self.camera.zoom(touch.zoom_delta, in_row(touch.center_pos, rect, rows), aspect);
            return;
        }
        let shift = ui.input(|input| input.modifiers.shift);
        if response.dragged_by(PointerButton::Primary) && !shift {
            self.camera.orbit(fraction(response.drag_delta()));
        } else if response.dragged() {
            self.camera.pan(fraction(response.drag_delta()));
        }
        if response.double_clicked() {
            self.fit(document, keep);
        }
        let Some(pointer) = response.hover_pos() else { return };
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta(), input.zoom_delta()));
        let factor = pinch * (scroll.y / 240.0).exp();
        if (factor - 1.0).abs() > 1e-4 {
            self.camera.zoom(factor, in_row(pointer, rect, rows), aspect);
        }
    }

    /// Moves the camera by keys: arrows turn, plus and minus zoom, as far in a second however many frames it has.
    pub fn steer_by_keys(&mut self, ui: &Ui) {
        use egui::Key;
        /// A drag over so many heights of the view, a second.
        const TURN: f32 = 1.2;
        /// The logarithm of what comes nearer, a second.
        const ZOOM: f32 = 1.8;
        /// Of a frame that took longer no more is made up for.
        const LONGEST: f32 = 0.1;
        let (mut turn, mut zoom) = (Vec2::ZERO, 0.0);
        let seconds = ui.input(|input| input.stable_dt).min(LONGEST);
        ui.input(|input| {
            let held = |key| f32::from(u8::from(input.key_down(key)));
            turn.x = held(Key::ArrowRight) - held(Key::ArrowLeft);
            turn.y = held(Key::ArrowDown) - held(Key::ArrowUp);
            zoom = (held(Key::Plus).max(held(Key::Equals)) - held(Key::Minus)) * ZOOM * seconds;
        });
        if turn != Vec2::ZERO {
            self.camera.orbit(turn * TURN * seconds);
            ui.ctx().request_repaint();
        }
        if zoom != 0.0 {
            self.camera.zoom(zoom.exp(), Vec2::ZERO, self.aspect);
            ui.ctx().request_repaint();
        }
    }
}

/// From where a surface of this size is first seen: from the front, unless it lies on its back, as some scans are stored.
pub(in crate::app) fn first_view(size: glam::Vec3) -> StandardView {
    if size.y > size.z && size.y > size.x { StandardView::Superior } else { StandardView::Anterior }
}

/// Stands on a side: RAS is LPS, whose sides the views are named for, after half a turn about the axis to the head.
pub(in crate::app) fn stand(camera: &mut Camera, view: StandardView, axes: Axes) {
    camera.standard_view(view);
    if axes == Axes::Ras {
        camera.rotation = (Quat::from_rotation_z(PI) * camera.rotation).normalize();
    }
}

/// A point of the window in normalised device coordinates of a view: -1 to 1, y up.
pub(in crate::app) fn in_view(at: Pos2, rect: Rect) -> Vec2 {
    let v = (at - rect.center()) / (rect.size() / 2.0).max(vec2(1.0, 1.0));
    Vec2::new(v.x, -v.y)
}

/// Where a place in mm is seen in the view in `rect`; `None` behind the eye.
pub(in crate::app) fn seen(at: Vec3, camera: &Camera, rect: Rect) -> Option<Pos2> {
    let at = camera.project(at, rect.width() / rect.height().max(1.0))?;
    Some(rect.center() + vec2(at.x, -at.y) * rect.size() / 2.0)
}

/// The size of a view in pixels, no side below one.
pub(in crate::app) fn pixels(ui: &Ui, rect: Rect) -> [u32; 2] {
    let size = rect.size() * ui.ctx().pixels_per_point();
    [size.x.round().max(1.0) as u32, size.y.round().max(1.0) as u32]
}

/// What [`in_view`] says, in that of `rows` pictures, one above the other in `rect`, in which the point is.
fn in_row(at: Pos2, rect: Rect, rows: usize) -> Vec2 {
    let height = rect.height() / rows as f32;
    let row = ((at.y - rect.top()) / height).floor().clamp(0.0, rows as f32 - 1.0);
    in_view(at, Rect::from_min_size(pos2(rect.left(), rect.top() + row * height), vec2(rect.width(), height)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_each_picture_is_its_middle() {
        let rect = Rect::from_min_size(pos2(100.0, 50.0), vec2(200.0, 400.0));
        assert_eq!(in_row(rect.center(), rect, 1), Vec2::ZERO);
        for middle in [pos2(200.0, 150.0), pos2(200.0, 350.0)] {
            assert_eq!(in_row(middle, rect, 2), Vec2::ZERO);
        }
        assert_eq!(in_row(rect.min, rect, 2), Vec2::new(-1.0, 1.0));
        assert_eq!(in_row(rect.max, rect, 2), Vec2::new(1.0, -1.0));
    }
}
