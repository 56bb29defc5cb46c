//! What all of the views are painted with.

use egui::{Color32, Rect, TextureId, Ui, pos2};

use crate::app::trial::state::Session;

/// The wire's radius in mm.
pub(super) fn radius(session: &Session) -> f32 {
    session.wire().radius() as f32
}

/// A picture that was drawn.
pub(super) fn image(ui: &Ui, rect: Rect, texture: TextureId) {
    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
    ui.painter_at(rect).image(texture, rect, whole, Color32::WHITE);
}

/// Where nothing was drawn.
pub(super) fn empty(ui: &Ui, rect: Rect) {
    ui.painter().rect_filled(rect, 0.0, ui.visuals().faint_bg_color);
}
