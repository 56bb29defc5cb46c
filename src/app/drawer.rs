//! The panel of a phone: a sheet that a finger draws up from below by its handle, and that comes to rest at one of three
//! heights.

use egui::{Align2, Context, EventFilter, Key, Rect, Role, Sense, TextStyle, Ui, vec2};

use super::assist::name;
use super::theme::FINGER;
use crate::say;

/// Its height at the highest stop, as a part of the room for panel and views.
const FULL: f32 = 0.75;
/// Room below what it shows, in points.
const BELOW: f32 = 16.0;
/// The height of a head before one was shown, in points.
const HEAD: f32 = 240.0;
/// Room below a head for what scrolls: where there is less, the head scrolls with it, in points.
const LEAST: f32 = 72.0;
/// What the second height shows below what is seen at the lowest, at least, in points.
const MORE: f32 = 96.0;

/// A height at which it rests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stop {
    /// What stays in sight, and nothing below it.
    Peek,
    /// Beside a view.
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

/// What stands in the panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// Something with a head that stays in sight, by its place in the list of panels; `None` for the method.
    Headed(Option<usize>),
    /// The method where a comparison or a lesson needs the room: at the lowest its handle is seen, and no more.
    Folded {
        /// Whether that is a comparison.
        compares: bool,
    },
    /// Something without.
    Plain,
}

/// The heights of the three stops, in points, the lowest first.
#[derive(Clone, Copy)]
struct Stops([f32; 3]);

impl Stops {
    /// Of a window that has `room` points for panel and views, `half` of them at the second stop, and `peek` points for what
    /// is seen at the lowest, without its handle.
    fn new(room: f32, half: f32, peek: f32) -> Self {
        let low = FINGER + peek;
        let half = (low + MORE).max(half).min(room * FULL).max(low);
        Self([low, half, half.max(room * FULL)])
    }

    fn nearest(self, height: f32) -> Stop {
        let away = |stop: &Stop| (self.0[*stop as usize] - height).abs();
        Stop::ALL.into_iter().min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(Stop::Peek)
    }
}

/// How far the panel is drawn up.
pub(super) struct Drawer {
    /// Where each kind of content rests, by [`Self::kind`]. What has no head would show nothing at the lowest.
    stops: [Stop; 3],
    /// Its height while a finger draws it, in points.
    drawn: Option<f32>,
    content: Content,
    /// How high the head is, as it was last shown, in points.
    head: f32,
    /// The width that this was at, in points.
    width: f32,
    /// The heights at which it can rest.
    heights: Stops,
}

impl Default for Drawer {
    fn default() -> Self {
        Self {
            stops: [Stop::Peek, Stop::Peek, Stop::Half],
            drawn: None,
            content: Content::Headed(None),
            head: HEAD,
            width: 0.0,
            heights: Stops::new(0.0, 0.0, 0.0),
        }
    }
}

impl Drawer {
    /// Takes what stands in it in this frame, in a window that has `room` points for panel and views, `half` as a part of it.
    pub(super) fn take(&mut self, content: Content, room: f32, half: f32) {
        if content != self.content {
            (self.content, self.width) = (content, 0.0);
            if matches!(content, Content::Folded { .. }) {
                // Each that needs the room begins with it.
                self.stops[self.kind()] = Stop::Peek;
            }
        }
        let (peek, least) = match content {
            Content::Headed(_) => (self.head + BELOW, 0.0),
            Content::Folded { .. } => (0.0, FINGER + self.head + BELOW),
            Content::Plain => (BELOW, 0.0),
        };
        self.heights = Stops::new(room, least.max(room * half), peek);
    }

    /// Takes how high the head is. It grows where its words need more room and does not shrink again with them: the views
    /// would move.
    pub(super) fn take_head(&mut self, ui: &Ui, height: f32) {
        let width = ui.available_width();
        let is_same = (width - self.width).abs() < 0.5;
        let head = if is_same { height.max(self.head) } else { height };
        if (head - self.head).abs() > 0.5 {
            ui.ctx().request_repaint();
        }
        (self.head, self.width) = (head, width);
    }

    /// Whether there is room for the head and something below it.
    pub(super) fn docks(&self, room: f32) -> bool {
        room >= self.head + LEAST
    }

    /// Its height now, in points.
    pub(super) fn height(&self) -> f32 {
        self.drawn.unwrap_or(self.heights.0[self.stop() as usize])
    }

    /// Whether there is room for no more than the lowest stop shows.
    pub(super) fn peeks(&self) -> bool {
        self.height() < self.heights.0[0] + MORE / 4.0
    }

    fn kind(&self) -> usize {
        match self.content {
            Content::Headed(_) => 0,
            Content::Folded { .. } => 1,
            Content::Plain => 2,
        }
    }

    fn stop(&self) -> Stop {
        self.stops[self.kind()]
    }

    fn rest(&mut self, stop: Stop, ctx: &Context) {
        self.stops[self.kind()] = stop;
        ctx.request_repaint();
    }

    /// Shows its handle: it is dragged, a tap goes to the next stop, arrows up and down.
    pub(super) fn handle(&mut self, ui: &mut Ui) {
        let stops = self.heights;
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), FINGER), Sense::click_and_drag());
        if response.dragged() {
            let height = self.height() - response.drag_delta().y;
            self.drawn = Some(height.clamp(stops.0[0], stops.0[2]));
        } else if let Some(height) = self.drawn.take() {
            self.rest(stops.nearest(height), ui.ctx());
        }
        let mut way = i32::from(response.clicked());
        if response.has_focus() {
            let arrows = EventFilter { vertical_arrows: true, ..EventFilter::default() };
            ui.memory_mut(|memory| memory.set_focus_lock_filter(response.id, arrows));
            way += ui.input(|input| input.num_presses(Key::ArrowUp) as i32 - input.num_presses(Key::ArrowDown) as i32);
        }
        let last = Stop::ALL.len() as i32 - 1;
        let next = self.stop() as i32 + way;
        // A tap at the highest goes back to the lowest; arrows stay there.
        let next = if response.clicked() && next > last { 0 } else { next.clamp(0, last) };
        if next != self.stop() as i32 {
            self.rest(Stop::ALL[next as usize], ui.ctx());
        }
        let visuals = ui.style().interact(&response);
        let grip = Rect::from_center_size(rect.center(), vec2(40.0, 5.0));
        ui.painter().rect_filled(grip, 2.5, visuals.fg_stroke.color.gamma_multiply(0.6));
        let is_folded = matches!(self.content, Content::Folded { .. }) && self.peeks();
        if is_folded {
            let (at, font) = (rect.left_center(), TextStyle::Small.resolve(ui.style()));
            let colour = ui.visuals().weak_text_color();
            ui.painter().text(at, Align2::LEFT_CENTER, say!("app-panel-folded"), font, colour);
        }
        if response.has_focus() {
            let ring = egui::Stroke::new(2.0, ui.visuals().hyperlink_color);
            ui.painter().rect_stroke(rect, 4.0, ring, egui::StrokeKind::Inside);
        }
        let label = self.stop().label();
        let label = if is_folded { format!("{}. {label}", say!("app-panel-folded")) } else { label };
        name(&response, Role::Button, &label);
        response.on_hover_text(say!("app-panel-help"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_rests_at_the_nearest_stop() {
        let stops = Stops::new(600.0, 270.0, 120.0);
        for (height, stop) in [(0.0, Stop::Peek), (200.0, Stop::Peek), (240.0, Stop::Half), (400.0, Stop::Full)] {
            assert_eq!(stops.nearest(height), stop, "{height}");
        }
    }

    #[test]
    fn each_stop_shows_more_than_the_one_below_it() {
        for (room, half, peek) in [
            (730.0, 328.0, 240.0),
            (530.0, 185.0, 240.0),
            (912.0, 410.0, 150.0),
            (730.0, 328.0, 8.0),
            (500.0, 300.0, 0.0),
        ] {
            let Stops([low, half, full]) = Stops::new(room, half, peek);
            assert!(low + 32.0 <= half && half + 16.0 <= full && full < room, "{low} {half} {full} of {room}");
        }
    }
}
