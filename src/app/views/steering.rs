//! How the camera of the views is moved: by mouse, trackpad, touch or keys.

use egui::{PointerButton, Pos2, Rect, Ui, pos2, vec2};
use glam::Vec2;

use super::Views;
use crate::app::document::Document;
use crate::app::places::in_view;
use crate::pipeline::settings::Keep;

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
