//! The rows of the panel: the head of a step, a control with its label, a number, a remark.

use egui::{Align, Label, Layout, RichText, ScrollArea, Ui};

use super::assist::heading;
use super::theme;

/// A column that scrolls.
pub(super) fn scrolled<R>(ui: &mut Ui, show: impl FnOnce(&mut Ui) -> R) -> R {
    let column = ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        // Room for the scroll bar beside what stands at the right.
        ui.set_max_width(ui.available_width() - 8.0);
        ui.spacing_mut().item_spacing.y = 3.0;
        show(ui)
    });
    column.inner
}

/// The head of a step of the method: its number and name, and what it does.
pub(super) fn step(ui: &mut Ui, number: u32, title: &str, what: &str) {
    if number > 1 {
        ui.separator();
    }
    ui.horizontal(|ui| {
        ui.label(RichText::new(number.to_string()).heading().color(ui.visuals().hyperlink_color));
        heading(ui, title);
    });
    ui.add(Label::new(RichText::new(what).small().weak()).wrap());
}

/// What on the left, the control on the right.
pub(super) fn row(ui: &mut Ui, what: &str, help: &str, control: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.label(what).on_hover_text(help.to_owned());
        ui.with_layout(Layout::right_to_left(Align::Center), control);
    });
}

/// A line of the numbers: what it is on the left, how much on the right.
pub(super) fn number(ui: &mut Ui, what: &str, how_much: &str, help: &str) {
    let before = std::mem::replace(&mut ui.spacing_mut().interact_size.y, 18.0);
    let row = ui.horizontal(|ui| {
        ui.label(RichText::new(what).weak());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| ui.label(how_much));
    });
    if theme::suits_finger(ui.ctx()) {
        // What follows may be for a finger.
        ui.spacing_mut().interact_size.y = before;
    }
    if !help.is_empty() {
        row.response.on_hover_text(help.to_owned());
    }
}

/// A remark in small letters.
pub(super) fn remark(ui: &mut Ui, text: &str) {
    ui.add(Label::new(RichText::new(text).small()).wrap());
}

/// A remark on something that is wrong.
pub(super) fn warning(ui: &mut Ui, text: &str) {
    let text = RichText::new(text).small().color(ui.visuals().error_fg_color);
    ui.add(Label::new(text).wrap());
}
