//! Writing over a picture.

use egui::{FontId, Ui, vec2};

use crate::app::halo;

/// A sentence at the foot of a picture, in as many lines as it takes, over a plate as `plate` has it.
pub(super) fn sentence(ui: &Ui, rect: egui::Rect, text: &str) {
    let (font, colour) = (FontId::proportional(13.0), ui.visuals().error_fg_color);
    let galley = ui.painter().layout(text.to_owned(), font, colour, (rect.width() - 40.0).clamp(120.0, 520.0));
    // Scale bar and names stand below it.
    let foot = rect.center_bottom() - vec2(0.0, 40.0);
    let place = egui::Align2::CENTER_BOTTOM.anchor_size(foot, galley.size() + vec2(16.0, 8.0));
    let painter = ui.painter_at(rect);
    painter.rect_filled(place, 3.0, ui.visuals().panel_fill.gamma_multiply(0.92));
    halo::galley(&painter, place.min + vec2(8.0, 4.0), galley, colour);
}

/// A line in a picture's corner, over a plate so that it can be read on anything.
pub(super) fn plate(ui: &Ui, at: egui::Pos2, align: egui::Align2, text: &str, strong: bool) {
    let font = FontId::proportional(12.0);
    let colour = if strong { ui.visuals().text_color() } else { ui.visuals().weak_text_color() };
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, colour);
    let rect = align.anchor_size(at, galley.size() + vec2(8.0, 4.0));
    ui.painter().rect_filled(rect, 3.0, ui.visuals().panel_fill.gamma_multiply(0.85));
    halo::galley(ui.painter(), rect.min + vec2(4.0, 2.0), galley, colour);
}
