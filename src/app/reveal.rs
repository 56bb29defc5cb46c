//! The surface as it was opened and the level in one picture, on two sides of a line that can be dragged.

use egui::{Align2, CursorIcon, EventFilter, FontId, Key, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, pos2, vec2};

use super::assist::describe;
use super::document::Document;
use super::{halo, theme};
use crate::say;

/// Triangles of an opened surface up to which both are shown by themselves: its normals take a frame of their own.
const BY_ITSELF: usize = 200_000;
/// Where the line rests at first.
const REST: f32 = 0.45;
/// Seconds in which it comes there from the right when the app starts.
const SWEEP_S: f32 = 2.4;
/// Of a frame that took longer no more is made up for.
const LONGEST_S: f32 = 0.1;
/// What an arrow key moves it by.
const STEP: f32 = 0.02;
/// Half of the width in which a mouse holds the line, in points.
const REACH: f32 = 8.0;

/// Whether both are shown in one picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reveal {
    /// Where that is quickly done.
    #[default]
    Auto,
    /// Yes.
    Association,
    /// No.
    Off,
}

impl Reveal {
    /// Whether they are for this surface.
    pub(super) fn holds(self, document: &Document) -> bool {
        match self {
            Self::Auto => document.opened.triangles.len() <= BY_ITSELF,
            Self::Association => true,
            Self::Off => false,
        }
    }
}

/// The line between the two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Divider {
    /// 0 at the left, 1 at the right.
    at: f32,
    /// Seconds of the way to its rest, while it moves by itself.
    sweep_s: Option<f32>,
}

impl Default for Divider {
    fn default() -> Self {
        Self { at: REST, sweep_s: None }
    }
}

impl Divider {
    /// Where it is: 0 at the left, 1 at the right.
    pub(super) fn at(&self) -> f32 {
        self.at
    }

    /// Lets it come from the right once there is something to see.
    pub(super) fn sweep(&mut self) {
        *self = Self { at: 1.0, sweep_s: Some(0.0) };
    }

    /// Shows it over the picture of view `index` in `rect`, and lets it be dragged, by pointer or arrow keys.
    /// `sides` is what stands at the left and at the right of it in place of the surface as it was opened and the level, if
    /// something does.
    pub(super) fn show(&mut self, ui: &mut Ui, rect: Rect, index: usize, sides: Option<[String; 2]>) {
        let x = rect.left() + rect.width() * self.at;
        let line = if theme::suits_finger(ui.ctx()) {
            // By its grip alone: a finger that turns the camera is not to catch the line.
            Rect::from_center_size(grip(rect, x), vec2(theme::FINGER, theme::FINGER))
        } else {
            Rect::from_x_y_ranges(x - REACH..=x + REACH, rect.y_range())
        };
        let response = ui.interact(line, ui.scope_id().with(("divider", index)), Sense::click_and_drag());
        let response = response.on_hover_and_drag_cursor(CursorIcon::ResizeHorizontal);
        let label = match &sides {
            Some([before, _]) if index > 0 => say!("views-divider-wireframe-other", before = before.as_str()),
            None if index > 0 => say!("views-divider-wireframe"),
            Some([before, _]) => say!("views-divider-other", before = before.as_str()),
            None => say!("views-divider"),
        };
        describe(&response, Role::Slider, &label, f64::from(self.at * 100.0).round());
        if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
            self.move_to((pointer.x - rect.left()) / rect.width().max(1.0));
        }
        if response.has_focus() {
            let filter = EventFilter { horizontal_arrows: true, ..EventFilter::default() };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, filter));
            let steps =
                ui.input(|input| input.num_presses(Key::ArrowRight) as f32 - input.num_presses(Key::ArrowLeft) as f32);
            if steps != 0.0 {
                self.move_to(self.at + STEP * steps);
            }
        }
        self.draw(
            ui,
            rect,
            sides.unwrap_or_else(|| [say!("views-as-opened"), say!("views-now")]),
            response.hovered() || response.dragged() || response.has_focus(),
        );
    }

    fn move_to(&mut self, at: f32) {
        *self = Self { at: at.clamp(0.0, 1.0), sweep_s: None };
    }

    /// Moves it on, once a frame in which it is seen, while it moves by itself.
    pub(super) fn advance(&mut self, ui: &Ui) {
        let Some(passed) = &mut self.sweep_s else { return };
        *passed += ui.input(|input| input.stable_dt).min(LONGEST_S);
        let part = (*passed / SWEEP_S).min(1.0);
        // Slow at both ends.
        self.at = 1.0 + (REST - 1.0) * part * part * (3.0 - 2.0 * part);
        if part >= 1.0 {
            self.sweep_s = None;
        }
        ui.ctx().request_repaint();
    }

    fn draw(&self, ui: &Ui, rect: Rect, [before, after]: [String; 2], is_held: bool) {
        let painter = ui.painter_at(rect);
        let x = rect.left() + rect.width() * self.at;
        let (accent, on_accent) = (ui.visuals().hyperlink_color, ui.visuals().selection.stroke.color);
        let width = if is_held { 3.0 } else { 2.0 };
        painter.line_segment([pos2(x, rect.top()), pos2(x, rect.bottom())], Stroke::new(width, accent));
        let grip = grip(rect, x);
        painter.circle_filled(grip, 11.0, accent);
        for side in [-1.0, 1.0] {
            let tip = grip + vec2(6.5 * side, 0.0);
            let arrow = [tip + vec2(-3.5 * side, -3.5), tip, tip + vec2(-3.5 * side, 3.5)];
            painter.add(Shape::line(arrow.to_vec(), Stroke::new(1.5, on_accent)));
        }
        let (text, plate) = (ui.visuals().text_color(), ui.visuals().window_fill.gamma_multiply(0.85));
        let sides = [(before, -1.0, Align2::RIGHT_CENTER), (after, 1.0, Align2::LEFT_CENTER)];
        for (words, side, align) in sides {
            let galley = painter.layout_no_wrap(words, FontId::proportional(12.0), text);
            let place = align.anchor_size(pos2(x + 12.0 * side, rect.top() + 64.0), galley.size());
            if rect.contains_rect(place) {
                painter.rect_filled(place.expand2(vec2(6.0, 3.0)), 4.0, plate);
                halo::galley(&painter, place.min, galley, text);
            }
        }
    }
}

/// Middle of the grip of a line at `x`: low enough to leave the middle of the surface free.
pub(super) fn grip(rect: Rect, x: f32) -> Pos2 {
    pos2(x, rect.top() + rect.height() * 0.85)
}
