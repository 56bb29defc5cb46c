//! One large view where a finger has no room for two: a strip above it says which, and changes it by a tap or a swipe.

use egui::{Button, Rect, Sense, Ui, UiBuilder, vec2};

use super::theme::FINGER;
use crate::language::Key;

/// Height of the strip, in points.
pub(super) const HEIGHT: f32 = FINGER;

/// A finger that has gone this far aside has swiped, in points.
const SWIPED: f32 = 32.0;

const NAMES: [(Key, Key); 2] =
    [(Key("app-tab-shaded"), Key("app-tab-shaded-help")), (Key("app-tab-wireframe"), Key("app-tab-wireframe-help"))];

/// Shows the strip in `rect`; `shown` is the view that is large: 0 shaded, 1 wireframe.
pub(super) fn show(ui: &mut Ui, rect: Rect, shown: &mut usize) {
    ui.painter().rect_filled(rect, 0.0, ui.visuals().panel_fill);
    // Below the tabs, which take taps alone.
    let strip = ui.interact(rect, ui.scope_id().with("tabs"), Sense::DRAG);
    if let Some(way) = strip.total_drag_delta().filter(|way| way.x.abs() > SWIPED) {
        *shown = usize::from(way.x < 0.0);
    }
    ui.scope_builder(UiBuilder::new().max_rect(rect), |ui| {
        ui.spacing_mut().item_spacing.x = 0.0;
        ui.horizontal(|ui| {
            let size = vec2(rect.width() / NAMES.len() as f32, HEIGHT);
            for (index, (name, help)) in NAMES.into_iter().enumerate() {
                let tab = Button::selectable(*shown == index, name.say()).min_size(size);
                if ui.add(tab).on_hover_text(help.say()).clicked() {
                    *shown = index;
                }
            }
        });
    });
}
