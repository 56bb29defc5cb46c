//! Presenter mode, for a projector: larger letters and no panel; keys are shown as they are pressed, and the pointer has a
//! halo that fills while a button is down.

use egui::{Align2, Context, CornerRadius, Event, FontId, Id, LayerId, ModifierNames, Order, Stroke, vec2};

/// How much larger everything is.
const ZOOM: f32 = 1.4;
/// For how long a key is shown, in seconds.
const SHOWN_S: f64 = 1.6;
/// Keys that are shown at once.
const MAX_KEYS: usize = 4;
/// Radius of the halo, in points.
const HALO: f32 = 22.0;
/// Height of the status bar, above which keys are shown, with some room, in points.
const FOOT: f32 = 56.0;

/// A key that was pressed, and when by the window's clock.
struct Pressed {
    words: String,
    at_s: f64,
}

/// Whether someone presents, and what was pressed last.
#[derive(Default)]
pub(super) struct Presenter {
    /// Whether someone presents.
    is_on: bool,
    pressed: Vec<Pressed>,
}

impl Presenter {
    /// Whether someone presents.
    pub(super) fn is_on(&self) -> bool {
        self.is_on
    }

    /// Begins, or ends.
    pub(super) fn toggle(&mut self, ctx: &Context) {
        let zoom = ctx.zoom_factor();
        ctx.set_zoom_factor(if self.is_on { zoom / ZOOM } else { zoom * ZOOM });
        self.is_on = !self.is_on;
        self.pressed.clear();
    }

    /// Takes the keys of a frame, before they are taken by what they are for. Typing is shown as nothing.
    pub(super) fn hear(&mut self, ctx: &Context) {
        if !self.is_on() || ctx.text_edit_focused() {
            return;
        }
        let is_mac = ctx.os().is_mac();
        ctx.input(|input| {
            for event in &input.events {
                if let Event::Key { key, pressed: true, repeat: false, modifiers, .. } = event {
                    let held = ModifierNames::NAMES.format(modifiers, is_mac);
                    let words = if held.is_empty() { key.name().to_owned() } else { format!("{held}+{}", key.name()) };
                    self.pressed.push(Pressed { words, at_s: input.time });
                }
            }
            self.pressed.retain(|pressed| input.time - pressed.at_s < SHOWN_S);
        });
        let surplus = self.pressed.len().saturating_sub(MAX_KEYS);
        self.pressed.drain(..surplus);
    }

    /// Shows keys and halo over all else.
    pub(super) fn show(&self, ctx: &Context) {
        if !self.is_on() {
            return;
        }
        let painter = ctx.layer_painter(LayerId::new(Order::Tooltip, Id::unique("presenter")));
        let visuals = ctx.global_style().visuals.clone();
        let accent = visuals.hyperlink_color;
        if let Some(at) = ctx.input(|input| input.pointer.hover_pos()) {
            let is_down = ctx.input(|input| input.pointer.any_down());
            painter.circle(
                at,
                HALO,
                accent.gamma_multiply(if is_down { 0.45 } else { 0.15 }),
                Stroke::new(2.0, accent),
            );
        }
        let screen = ctx.content_rect();
        let texts: Vec<_> = self
            .pressed
            .iter()
            .map(|pressed| {
                painter.layout_no_wrap(pressed.words.clone(), FontId::proportional(22.0), visuals.text_color())
            })
            .collect();
        let room = vec2(12.0, 6.0);
        let width: f32 = texts.iter().map(|text| text.size().x + 2.0 * room.x + 8.0).sum();
        let mut left = screen.center().x - width / 2.0;
        for text in texts {
            let size = text.size() + 2.0 * room;
            let place = Align2::LEFT_BOTTOM.anchor_size(egui::pos2(left, screen.bottom() - FOOT), size);
            painter.rect(
                place,
                CornerRadius::same(6),
                visuals.window_fill,
                Stroke::new(1.5, accent),
                egui::StrokeKind::Inside,
            );
            painter.galley(place.min + room, text, visuals.text_color());
            left += size.x + 8.0;
        }
        if let Some(first) = self.pressed.first() {
            let rest = first.at_s + SHOWN_S - ctx.input(|input| input.time);
            ctx.request_repaint_after_secs(rest.max(0.01) as f32);
        }
    }
}
