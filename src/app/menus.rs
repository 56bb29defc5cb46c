//! Buttons that open menus, one function for all. Egui's are functions of the closure that fills the menu, so that each menu
//! of ours was the whole of egui's once more: 45 kB in the browser's program.

use egui::{Align, Button, Frame, Id, Layout, Margin, Popup, PopupCloseBehavior, Response, ScrollArea, Ui, vec2};

use super::icon::{self, Icon};
use super::theme;

/// Room that is left above and below a menu that scrolls, in points.
const MARGIN: f32 = 24.0;

/// Least width of a button that opens a card, in points.
const LEAST: f32 = 84.0;

/// A button that opens a menu, filled by `content`.
pub(super) fn menu(ui: &mut Ui, title: &str, content: &mut dyn FnMut(&mut Ui)) -> Response {
    ui.menu_button(title, content).response
}

/// An icon that opens a menu, filled by `content`. `label` is its name for assistive tools, `help` what it is for.
pub(super) fn icon_menu(ui: &mut Ui, icon: Icon, label: &str, help: &str, content: &mut dyn FnMut(&mut Ui)) {
    let button = icon::button(ui, icon, true, label, help);
    Popup::menu(&button).show(|ui| scrolled(ui, content));
}

/// A button that opens a card, which stays open until something else is pressed or `content`, which fills it, closes it.
/// `content` is told whether the card opens in this frame. `id` keeps it open whatever stands beside its button.
pub(super) fn card(ui: &mut Ui, id: Id, title: &str, width: f32, content: &mut dyn FnMut(&mut Ui, bool)) {
    // As wide for 2 as for 12: what stands beside it does not move as they are found.
    let button = ui.add(Button::new(title).min_size(vec2(LEAST, 0.0)));
    let was_open = Popup::is_id_open(ui.ctx(), id);
    let card = Popup::from_toggle_button_response(&button)
        .id(id)
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .layout(Layout::top_down(Align::Min))
        .frame(Frame::popup(ui.style()).inner_margin(Margin::same(12)))
        .width(width);
    let height = (ui.ctx().content_rect().height() - button.rect.bottom() - 2.0 * MARGIN).max(MARGIN);
    card.show(|ui| {
        let scrolled = ScrollArea::vertical().max_height(height).min_scrolled_height(height);
        scrolled.show(ui, |ui| content(ui, !was_open));
    });
}

/// The same for a menu that may be higher than the window where its rows are for a finger.
pub(super) fn long_menu(ui: &mut Ui, title: &str, content: &mut dyn FnMut(&mut Ui)) -> Response {
    menu(ui, title, &mut |ui| scrolled(ui, content))
}

fn scrolled(ui: &mut Ui, content: &mut dyn FnMut(&mut Ui)) {
    if !theme::suits_finger(ui.ctx()) {
        return content(ui);
    }
    let height = ui.ctx().content_rect().height() - MARGIN;
    // As high as it is, where that is in the window: a menu begins lower than its own height.
    ScrollArea::vertical().max_height(height).min_scrolled_height(height).show(ui, content);
}
