//! Buttons that open menus, one function for all. Egui's are functions of the closure that fills the menu, so that each menu
//! of ours was the whole of egui's once more: 45 kB in the browser's program.

use egui::{Response, ScrollArea, Ui};

use super::theme;

/// Room that is left above and below a menu that scrolls, in points.
const MARGIN: f32 = 24.0;

/// A button that opens a menu, filled by `content`.
pub(super) fn menu(ui: &mut Ui, title: &str, content: &mut dyn FnMut(&mut Ui)) -> Response {
    ui.menu_button(title, content).response
}

/// The same for a menu that may be higher than the window where its rows are for a finger.
pub(super) fn long_menu(ui: &mut Ui, title: &str, content: &mut dyn FnMut(&mut Ui)) -> Response {
    menu(ui, title, &mut |ui| {
        if !theme::suits_finger(ui.ctx()) {
            return content(ui);
        }
        let height = ui.ctx().content_rect().height() - MARGIN;
        ScrollArea::vertical().max_height(height).show(ui, &mut *content);
    })
}
