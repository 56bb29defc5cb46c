//! Short cuts: what keys ask for. `sheets` lists them for the user.

use egui::{Key, KeyboardShortcut, Modifiers, Ui};

use super::action::Action;
use super::keys::{Keys, pressed};
use super::mode::Entry;
use super::options::{Colours, ViewOptions};
use super::views::Views;
use crate::io::Format;
use crate::render::StandardView;

const VIEW_KEYS: [Key; 6] = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6];

/// What the keys with Ctrl and F1 ask for in this frame.
pub(super) fn with_ctrl(ui: &Ui, keys: Keys) -> Option<Action> {
    let ctrl_shift = Modifiers::COMMAND | Modifiers::SHIFT;
    let steps = [
        (ctrl_shift, Key::Z, Action::Redo),
        (Modifiers::COMMAND, Key::Z, Action::Undo),
        (Modifiers::COMMAND, Key::Y, Action::Redo),
    ];
    // These go on while they are held.
    let step = steps.into_iter().find(|(modifiers, key, _)| {
        keys == Keys::Views && ui.input_mut(|input| input.consume_shortcut(&KeyboardShortcut::new(*modifiers, *key)))
    });
    let others = [
        (Modifiers::COMMAND, Key::O, Action::Open),
        (Modifiers::COMMAND, Key::S, Action::Save(Format::Stl)),
        (Modifiers::NONE, Key::F1, Action::Help),
    ];
    let found = step.or_else(|| others.into_iter().find(|(modifiers, key, _)| pressed(ui, *modifiers, *key)));
    found.map(|(.., action)| action)
}

/// What the other keys ask for in this frame.
pub(super) fn action(ui: &Ui, views: &mut Views, entries: &[Entry]) -> Option<Action> {
    let pressed = |key| pressed(ui, Modifiers::NONE, key);
    for (key, view) in VIEW_KEYS.into_iter().zip(StandardView::ALL) {
        if pressed(key) {
            return Some(Action::View(view));
        }
    }
    let options = views.options;
    if pressed(Key::L) {
        return Some(Action::Show(ViewOptions { left_out: !options.left_out, ..options }));
    }
    if pressed(Key::D) {
        return Some(Action::Show(ViewOptions {
            colours: options.colours.toggled(Colours::Deviation(options.deviation)),
            ..options
        }));
    }
    if pressed(Key::K) {
        return Some(Action::Show(ViewOptions { raking: !options.raking, ..options }));
    }
    if pressed(Key::R) {
        return Some(Action::Reveal);
    }
    if let Some(entry) = entries.iter().find(|entry| entry.key.is_some_and(pressed)) {
        return Some(entry.action.clone());
    }
    if pressed(Key::F) {
        return Some(Action::Fit);
    }
    if pressed(Key::P) {
        return Some(Action::Present);
    }
    if pressed(Key::T) {
        return Some(Action::Theme);
    }
    if ui.ctx().memory(|memory| memory.focused().is_none()) {
        views.steer_by_keys(ui);
    }
    None
}
