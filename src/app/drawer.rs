//! The panel of a phone: a sheet that a finger draws up from below by its handle, and that comes to rest at one of three
//! heights.

use egui::{EventFilter, Key, Rect, Role, Sense, Ui, vec2};

use super::assist::name;
use super::theme::FINGER;
use crate::say;

/// A height at which it rests.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Stop {
    /// The count and the slider of the reduction.
    Peek,
    /// Beside a view.
    #[default]
    Half,
    /// Nearly alone.
    Full,
}

impl Stop {
    const ALL: [Self; 3] = [Self::Peek, Self::Half, Self::Full];

    /// What is told of the panel that stands there.
    fn label(self) -> String {
        match self {
            Self::Peek => say!("app-panel-low"),
            Self::Half => say!("app-panel-half"),
            Self::Full => say!("app-panel-full"),
        }
    }
}

/// The heights of the three stops, in points, the lowest first.
#[derive(Clone, Copy)]
pub(super) struct Stops([f32; 3]);

impl Stops {
    /// Of a window that has `room` points for panel and views, `half` as a part of it, and `peek` points for what is seen
    /// at the lowest, without its handle.
    pub(super) fn new(room: f32, half: f32, peek: f32) -> Self {
        let low = FINGER + peek;
        let half = low.max(room * half);
        Self([low, half, half.max(room * 0.75)])
    }

    fn nearest(self, height: f32) -> Stop {
        let away = |stop: &Stop| (self.0[*stop as usize] - height).abs();
        Stop::ALL.into_iter().min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or_default()
    }
}

/// How far the panel is drawn up.
#[derive(Default)]
pub(super) struct Drawer {
    stop: Stop,
    /// Its height while a finger draws it, in points.
    drawn: Option<f32>,
}

impl Drawer {
    /// Its height now, in points.
    pub(super) fn height(&self, stops: Stops) -> f32 {
        self.drawn.unwrap_or(stops.0[self.stop as usize])
    }

    /// Whether there is room for no more than the lowest stop shows.
    pub(super) fn peeks(&self, stops: Stops) -> bool {
        self.height(stops) < (stops.0[0] + stops.0[1]) / 2.0
    }

    /// Shows its handle: it is dragged, a tap goes to the next stop, arrows up and down.
    pub(super) fn handle(&mut self, ui: &mut Ui, stops: Stops) {
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), FINGER), Sense::click_and_drag());
        if response.dragged() {
            let height = self.height(stops) - response.drag_delta().y;
            self.drawn = Some(height.clamp(stops.0[0], stops.0[2]));
        } else if let Some(height) = self.drawn.take() {
            self.stop = stops.nearest(height);
            ui.ctx().request_repaint();
        }
        let mut way = i32::from(response.clicked());
        if response.has_focus() {
            let arrows = EventFilter { vertical_arrows: true, ..EventFilter::default() };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
            way += ui.input(|input| input.num_presses(Key::ArrowUp) as i32 - input.num_presses(Key::ArrowDown) as i32);
        }
        let last = Stop::ALL.len() as i32 - 1;
        let next = self.stop as i32 + way;
        // A tap at the highest goes back to the lowest; arrows stay there.
        let next = if response.clicked() && next > last { 0 } else { next.clamp(0, last) };
        if next != self.stop as i32 {
            self.stop = Stop::ALL[next as usize];
            ui.ctx().request_repaint();
        }
        let visuals = ui.style().interact(&response);
        let grip = Rect::from_center_size(rect.center(), vec2(40.0, 5.0));
        ui.painter().rect_filled(grip, 2.5, visuals.fg_stroke.color.gamma_multiply(0.6));
        if response.has_focus() {
            let ring = egui::Stroke::new(2.0, ui.visuals().hyperlink_color);
            ui.painter().rect_stroke(rect, 4.0, ring, egui::StrokeKind::Inside);
        }
        name(&response, Role::Button, &self.stop.label());
        response.on_hover_text(say!("app-panel-help"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rests_at_the_nearest_stop() {
        let stops = Stops::new(600.0, 0.45, 120.0);
        for (height, stop) in [(0.0, Stop::Peek), (200.0, Stop::Peek), (240.0, Stop::Half), (400.0, Stop::Full)] {
            assert_eq!(stops.nearest(height), stop, "{height}");
        }
    }
}
