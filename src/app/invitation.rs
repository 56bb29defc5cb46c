//! The first ten seconds: over the sample stands an invitation to open a vessel of one's own, until a file is opened or it is
//! dismissed. It lies in the picture, so that what is dragged over its words turns the view.

use egui::{Align, FontSelection, Layout, Rect, Stroke, StrokeKind, TextStyle, Ui, UiBuilder, pos2, vec2};

use super::action::Action;
use super::icon::{self, Icon};
use super::reveal::grip;
use super::theme;
use crate::say;

/// Room around the words, in points.
const MARGIN: f32 = 8.0;
/// Width of the scale of the view with the room around it, in points: the card stands beside it.
const SCALE: f32 = 140.0;
/// Where there is no room beside it: room below the card for the scale, and above it for the title, in points.
const BELOW: f32 = 44.0;
const ABOVE: f32 = 56.0;
/// Room for the handle of the line between as opened and now, in points.
const HANDLE: f32 = 20.0;

/// Shows it in a view. A finger drops nothing.
pub(super) fn show(ui: &mut Ui, view: Rect, asked: &mut Vec<Action>) {
    let has_finger = theme::suits_finger(ui.ctx());
    let (words, open) = if has_finger {
        (String::new(), say!("app-invite-open-alone"))
    } else {
        (say!("app-invite-drop"), say!("app-invite-open"))
    };
    let height = theme::row(ui.ctx(), 28.0);
    let font = FontSelection::from(TextStyle::Body).resolve(ui.style());
    let width = |text: &str| {
        let galley = ui.painter().layout_no_wrap(text.to_owned(), font.clone(), ui.visuals().text_color());
        galley.size().x
    };
    let spacing = ui.spacing().item_spacing.x;
    let button = width(&open) + 2.0 * ui.spacing().button_padding.x;
    let icon = theme::row(ui.ctx(), 20.0);
    let before = if words.is_empty() { 0.0 } else { width(&words) + spacing };
    let size = vec2(before + button + spacing + icon, height) + vec2(2.0 * MARGIN, MARGIN);
    // Below the handle, or above it where there is no room for that.
    let handle = grip(view, view.center().x).y;
    let lowest = view.bottom() - BELOW;
    let bottom = if lowest - size.y >= handle + HANDLE { lowest } else { lowest.min(handle - HANDLE) };
    let corner = Rect::from_min_size(view.right_bottom() - size - vec2(MARGIN, MARGIN), size);
    let card = if view.width() >= SCALE + size.x + MARGIN && corner.top() >= handle + HANDLE {
        corner
    } else {
        Rect::from_center_size(pos2(view.center().x, bottom - size.y / 2.0), size)
    };
    if card.width() > view.width() || card.top() < view.top() + ABOVE {
        return;
    }
    let visuals = ui.visuals();
    let line = Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color);
    ui.painter().rect(card, 8.0, visuals.window_fill, line, StrokeKind::Inside);
    let inside = UiBuilder::new().max_rect(card.shrink2(vec2(MARGIN, MARGIN / 2.0)));
    ui.scope_builder(inside.id_salt("invitation").layout(Layout::left_to_right(Align::Center)), |ui| {
        if !words.is_empty() {
            ui.label(words);
        }
        if ui.button(open).on_hover_text(say!("app-invite-open-help")).clicked() {
            asked.push(Action::Open);
        }
        let close = icon::button(ui, Icon::Close, true, &say!("app-invite-close"), &say!("app-invite-close-help"));
        if close.clicked() {
            asked.push(Action::Uninvite);
        }
    });
}
