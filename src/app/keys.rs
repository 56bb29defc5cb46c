//! Keyboard short cuts. `sheets` lists them for the user.

use egui::{Key, KeyboardShortcut, Modifiers, Ui};

use super::bar::Action;
use super::views::Views;
use crate::io::Format;
use crate::render::StandardView;

const VIEW_KEYS: [Key; 6] = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6];

/// What the keys with Ctrl, which count while text is typed too, and F1 ask for in this frame.
pub(super) fn with_ctrl(ui: &Ui) -> Option<Action> {
    let ctrl_shift = Modifiers::COMMAND | Modifiers::SHIFT;
    let with_ctrl = [
        (ctrl_shift, Key::Z, Action::Redo),
        (Modifiers::COMMAND, Key::Z, Action::Undo),
        (Modifiers::COMMAND, Key::Y, Action::Redo),
        (Modifiers::COMMAND, Key::O, Action::Open),
        (Modifiers::COMMAND, Key::S, Action::Save(Format::Stl)),
        (Modifiers::NONE, Key::F1, Action::Help),
    ];
    for (modifiers, key, action) in with_ctrl {
        if ui.input_mut(|input| input.consume_shortcut(&KeyboardShortcut::new(modifiers, key))) {
            return Some(action);
        }
    }
    None
}

/// What the other keys ask for in this frame, except while text is typed.
pub(super) fn action(ui: &Ui, views: &mut Views, is_busy: bool) -> Option<Action> {
    if ui.ctx().text_edit_focused() {
        return None;
    }
    if is_busy && ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
        return Some(Action::Cancel);
    }
    let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    for (key, view) in VIEW_KEYS.into_iter().zip(StandardView::ALL) {
        if pressed(key) {
            return Some(Action::View(view));
        }
    }
    if pressed(Key::L) {
        views.show_left_out = !views.show_left_out;
    }
    if pressed(Key::D) {
        views.show_deviation = !views.show_deviation;
    }
    if pressed(Key::F) {
        return Some(Action::Fit);
    }
    if pressed(Key::C) {
        return Some(Action::Compare);
    }
    if pressed(Key::T) {
        return Some(Action::Theme);
    }
    if ui.ctx().memory(|memory| memory.focused().is_none()) {
        views.steer_by_keys(ui);
    }
    None
}

/// Whether the key that opened the sheet is pressed again.
pub(super) fn closes_sheet(ui: &Ui) -> bool {
    ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::F1))
}

/// Whether the key that shows the surface as it was opened is held, except while text is typed.
pub(super) fn before_is_held(ui: &Ui) -> bool {
    !ui.ctx().text_edit_focused() && ui.input(|input| input.key_down(Key::B))
}
