//! Places in a view: of the window, in mm, in pixels.

use egui::{Pos2, Rect, Ui, vec2};
use glam::{Vec2, Vec3};

use crate::render::Camera;

/// A point of the window in normalised device coordinates of a view: -1 to 1, y up.
pub(super) fn in_view(at: Pos2, rect: Rect) -> Vec2 {
    let v = (at - rect.center()) / (rect.size() / 2.0).max(vec2(1.0, 1.0));
    Vec2::new(v.x, -v.y)
}

/// Where a place in mm is seen in the view in `rect`; `None` behind the eye.
pub(super) fn seen(at: Vec3, camera: &Camera, rect: Rect) -> Option<Pos2> {
    let at = camera.project(at, rect.width() / rect.height().max(1.0))?;
    Some(rect.center() + vec2(at.x, -at.y) * rect.size() / 2.0)
}

/// The size of a view in pixels, no side below one.
pub(super) fn pixels(ui: &Ui, rect: Rect) -> [u32; 2] {
    let size = rect.size() * ui.ctx().pixels_per_point();
    [size.x.round().max(1.0) as u32, size.y.round().max(1.0) as u32]
}
