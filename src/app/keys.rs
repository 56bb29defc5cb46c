//! The keyboard: who has it, and what counts as a key that goes down.
//!
//! What lies on top has the keys: a sheet, an open list or menu, a field that is typed into. Only where there is none of
//! these do they reach the views, the wire and short cuts (`shortcuts`).

use egui::{Context, Event, Key, Modifiers, Popup, Ui};

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
