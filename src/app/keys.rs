//! The keyboard: who has it, and short cuts. `sheets` lists them for the user.
//!
//! What lies on top has the keys: a sheet, an open list or menu, a field that is typed into. Only where there is none of
//! these do they reach the views, the wire and short cuts.

use egui::{Context, Event, Key, KeyboardShortcut, Modifiers, Popup, Ui};

use super::action::Action;
use super::views::{Colours, ViewOptions, Views};
use super::{measure, vessels};
use crate::io::Format;
use crate::render::StandardView;

const VIEW_KEYS: [Key; 6] = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6];

/// Who has the keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Keys {
    /// A sheet, and the pointer too.
    Sheet,
    /// An open list or menu.
    List,
    /// A field that is typed into; short cuts with Ctrl count, but for undo, which is the field's own.
    Field,
    /// The views, the wire and short cuts.
    Views,
}

impl Keys {
    /// Who has them as a frame begins, before a control has closed its list at Escape. Of a field that is typed into
    /// Escape has already taken the focus then: `was_typing` says whether it had it in the frame before.
    pub(super) fn of(ctx: &Context, has_sheet: bool, was_typing: bool) -> Self {
        if has_sheet {
            Self::Sheet
        } else if Popup::is_any_open(ctx) {
            Self::List
        } else if was_typing || ctx.text_edit_focused() {
            Self::Field
        } else {
            Self::Views
        }
    }
}

/// Whether a key goes down in this frame. One that is held counts once, however often the keyboard repeats it.
pub(super) fn pressed(ui: &Ui, modifiers: Modifiers, key: Key) -> bool {
    ui.input_mut(|input| {
        let mut goes_down = false;
        input.events.retain(|event| match event {
            Event::Key { key: other, pressed: true, repeat, modifiers: with, .. }
                if *other == key && with.matches_logically(modifiers) =>
            {
                goes_down |= !repeat;
                false
            }
            _ => true,
        });
        goes_down
    })
}

/// Whether a control is on its way: until the pointer, the key that moves it or the field is let go, what it sets is one
/// step to undo.
pub(super) fn moves_control(ctx: &Context) -> bool {
    let has_focus = ctx.memory(|memory| memory.focused().is_some());
    let is_down = ctx.input(|input| input.pointer.any_down() || has_focus && !input.keys_down.is_empty());
    is_down || ctx.text_edit_focused()
}

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
pub(super) fn action(ui: &Ui, views: &mut Views) -> Option<Action> {
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
    if pressed(Key::V) {
        return Some(Action::Vessels(vessels::Action::Toggle));
    }
    if pressed(Key::M) {
        return Some(Action::Measure(measure::Action::Toggle));
    }
    if pressed(Key::F) {
        return Some(Action::Fit);
    }
    if pressed(Key::P) {
        return Some(Action::Present);
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
