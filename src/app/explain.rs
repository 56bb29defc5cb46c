//! The explanation of a label: a mouse that rests on it shows it; a finger, which cannot rest, taps the label. What a tap has
//! shown goes with the next one, wherever that is. Buttons are not explained so: a tap presses them.

use egui::{Id, Response, Sense, Tooltip};

use super::theme;

/// Explains what a label says.
pub(super) fn explain(label: Response, help: &str) -> Response {
    if help.is_empty() {
        return label;
    }
    if !theme::suits_finger(&label.ctx) {
        return label.on_hover_text(help);
    }
    // It takes no focus: keys go from control to control.
    let label = label.interact(Sense::CLICK);
    let id = Id::unique("explanation that a tap has shown");
    let was_shown = label.ctx.data(|data| data.get_temp::<Id>(id)) == Some(label.id);
    let is_tapped_elsewhere =
        label.ctx.input(|input| input.pointer.any_pressed()) && !label.is_pointer_button_down_on();
    let is_shown = was_shown != label.clicked() && !is_tapped_elsewhere;
    if is_shown {
        label.ctx.data_mut(|data| data.insert_temp(id, label.id));
        Tooltip::for_widget(&label).show(|ui| ui.label(help));
    } else if was_shown {
        label.ctx.data_mut(|data| data.remove::<Id>(id));
    }
    label
}
