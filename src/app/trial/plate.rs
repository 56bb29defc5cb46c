//! Writing over a picture.

use egui::{FontId, Ui, vec2};

/// A line in a picture's corner, over a plate so that it can be read on anything.
pub(super) fn plate(ui: &Ui, at: egui::Pos2, align: egui::Align2, text: &str, strong: bool) {
    let font = FontId::proportional(12.0);
    let colour = if strong { ui.visuals().text_color() } else { ui.visuals().weak_text_color() };
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, colour);
    let rect = align.anchor_size(at, galley.size() + vec2(8.0, 4.0));
    ui.painter().rect_filled(rect, 3.0, ui.visuals().panel_fill.gamma_multiply(0.85));
    ui.painter().galley(rect.min + vec2(4.0, 2.0), galley, colour);
}
