//! What measuring draws over a view, and what the hand does there: the cut and its handle, the measures, the places that a
//! tool is given.

use egui::{Align2, CursorIcon, Pos2, Rect, Response, Role, Sense, Shape, Stroke, Ui, Vec2, vec2};

use super::canvas::Canvas;
use super::clip::{Clip, Placed};
use super::subject::Subject;
use super::{Action, Measuring, Tool, Under, marks};
use crate::app::assist::describe;
use crate::app::document::Document;
use crate::app::places::in_view;
use crate::app::theme;
use crate::mesh::Ball;
use crate::pipeline::settings::Keep;
use crate::render::{Camera, ClipPlane};
use crate::say;
use crate::sharing::measures::Measure;

/// Side of the square in which the handle of the clip plane is held, in points.
const HANDLE: f32 = 36.0;
/// Length of its arrow to either side.
const ARROW: f32 = 26.0;
/// Below this many points a mm the way of the plane is not to be seen, and it is dragged up and down.
const MIN_POINTS_A_MM: f32 = 0.15;

/// What a view shows.
pub(in crate::app) struct Seen<'a> {
    /// Its number.
    pub(in crate::app) index: usize,
    /// Where it is.
    pub(in crate::app) rect: Rect,
    /// From where it looks.
    pub(in crate::app) camera: &'a Camera,
    /// What is open.
    pub(in crate::app) document: Option<&'a Document>,
    /// The pieces that are shown.
    pub(in crate::app) keep: Keep,
    /// Its parts, and whether each shows the surface as it was opened.
    pub(in crate::app) parts: &'a [(Rect, bool)],
    /// Whether it is a wireframe.
    pub(in crate::app) is_lines: bool,
    /// Whether the panel is open: then the hand may move the plane and use the tool.
    pub(in crate::app) is_measuring: bool,
    /// What was measured.
    pub(in crate::app) measures: &'a [Measure],
}

impl Seen<'_> {
    /// Whether the surface is shown as it was opened at a point of the window.
    fn is_opened(&self, at: Pos2) -> bool {
        self.parts.iter().find(|(part, _)| part.contains(at)).or(self.parts.first()).is_some_and(|part| part.1)
    }
}

impl Measuring {
    /// What is left out of the views.
    pub(in crate::app) fn clip_plane(&self, document: Option<&Document>, keep: Keep) -> Option<ClipPlane> {
        Some(self.clip?.place(document?, keep)?.plane)
    }

    /// Draws what the clip plane cuts, over the picture and under what is written there.
    pub(in crate::app) fn show_cut(&mut self, ui: &Ui, seen: &Seen<'_>) {
        let Some((document, plane)) = seen.document.zip(self.clip_plane(seen.document, seen.keep)) else { return };
        for &(part, is_opened) in seen.parts {
            if let Some(subject) = Subject::new(document, is_opened, seen.keep) {
                let canvas = Canvas::new(ui, seen.rect, part, seen.camera);
                self.cuts.show(&canvas, &subject, plane, seen.is_lines);
            }
        }
    }

    /// Draws the measures and the handle, and hears what the hand in `response` asks for.
    pub(in crate::app) fn show_over(&mut self, ui: &Ui, response: &Response, seen: &Seen<'_>) -> Option<Action> {
        let document = seen.document?;
        let canvas = Canvas::new(ui, seen.rect, seen.rect, seen.camera);
        if self.marks {
            marks::show(&canvas, seen.measures, self.chosen);
        }
        let tool = self.tool.filter(|_| seen.is_measuring);
        if tool.is_some() {
            let places: Vec<_> = self.begun.iter().map(|picked| picked.at).collect();
            marks::begun(&canvas, &places);
        }
        if tool == Some(Tool::Diameter)
            && let Some(ball) = self.ball_under(ui, response, document, seen)
        {
            marks::ball(&canvas, &ball);
        }
        let handle = self.handle(ui, &canvas, document, seen);
        handle.or_else(|| {
            tool?;
            self.placed(ui, response, document, seen)
        })
    }

    /// The place that the hand gives to the tool: where it clicks, or with Enter the middle of the view.
    fn placed(&self, ui: &Ui, response: &Response, document: &Document, seen: &Seen<'_>) -> Option<Action> {
        if response.hovered() {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
        // A view that has the focus is clicked by Enter, without a pointer.
        let is_focused = response.has_focus() && response.clicked() && response.interact_pointer_pos().is_none();
        let by_key = seen.index == 0 && self.enter || is_focused;
        // The second click of two fits the view.
        let is_click = response.clicked() && !response.double_clicked();
        let clicked = is_click.then(|| response.interact_pointer_pos()).flatten();
        if seen.index == 0 && clicked.is_none() && !response.hovered() {
            cross(ui, seen.rect);
        }
        let at = clicked.or(by_key.then(|| seen.rect.center()))?;
        self.subject(document, seen, at).map(|(_, picked)| Action::Place(picked))
    }

    /// The surface at a point of the view, and the place there.
    fn subject<'d>(&self, document: &'d Document, seen: &Seen<'_>, at: Pos2) -> Option<(Subject<'d>, super::Picked)> {
        // On a side that is only held beside the level nothing is measured.
        if !seen.parts.iter().any(|(part, _)| part.contains(at)) {
            return None;
        }
        let subject = Subject::new(document, seen.is_opened(at), seen.keep)?;
        let aspect = seen.rect.width() / seen.rect.height().max(1.0);
        let ray = seen.camera.ray(in_view(at, seen.rect), aspect);
        let picked = subject.pick(&ray, self.clip_plane(Some(document), seen.keep))?;
        Some((subject, picked))
    }

    /// The ball inside that touches the wall under the pointer. Its index is built while one waits.
    fn ball_under(&mut self, ui: &Ui, response: &Response, document: &Document, seen: &Seen<'_>) -> Option<Ball> {
        if seen.index == 0 {
            let subject = Subject::new(document, false, seen.keep)?;
            if self.indexing.advance(&subject, false).is_none() {
                ui.ctx().request_repaint();
                return None;
            }
        }
        let at = response.hover_pos().filter(|_| !response.dragged())?;
        // On the surface as it was opened a ball is found by a click alone: one index at a time.
        if seen.is_opened(at) {
            return None;
        }
        let subject = Subject::new(document, false, seen.keep)?;
        let key = Under { at, camera: *seen.camera, of: subject.of };
        if let Some((_, ball)) = self.under.filter(|(under, _)| *under == key) {
            return ball;
        }
        let picked = self.subject(document, seen, at).map(|(_, picked)| picked.at);
        let index = self.indexing.advance(&subject, false)?;
        let limit = document.opened.bounds().diagonal();
        let found = picked.and_then(|at| index.inner_ball_beside(subject.positions, &subject.triangles, at, limit));
        let ball = found.map(|(_, ball)| ball);
        self.under = Some((key, ball));
        ball
    }

    /// Shows the handle of the clip plane, and moves the plane with it.
    fn handle(&self, ui: &Ui, canvas: &Canvas<'_>, document: &Document, seen: &Seen<'_>) -> Option<Action> {
        let clip = self.clip.filter(|_| seen.is_measuring)?;
        let Placed { at, way, range_mm: [low, high], .. } = clip.place(document, seen.keep)?;
        let middle = canvas.at(at).filter(|middle| seen.rect.contains(*middle))?;
        let per_mm = canvas.at(at + way).map_or(Vec2::ZERO, |next| next - middle);
        let is_seen = per_mm.length() > MIN_POINTS_A_MM;
        let shown = if is_seen { per_mm.normalized() } else { vec2(0.0, -1.0) };
        let square = Rect::from_center_size(middle, Vec2::splat(theme::row(ui.ctx(), HANDLE)));
        let response = ui.interact(square, ui.scope_id().with(("clip", seen.index)), Sense::drag());
        let response = response.on_hover_and_drag_cursor(CursorIcon::Move);
        describe(&response, Role::Slider, &say!("measure-clip-handle"), f64::from(clip.at_mm));
        draw_handle(canvas, middle, shown, response.hovered() || response.dragged());
        let (held, origin) = (response.id.with("held"), ui.input(|input| input.pointer.press_origin()));
        if response.drag_started() {
            ui.data_mut(|data| data.insert_temp(held, (middle, clip.at_mm)));
        }
        let hand = response.interact_pointer_pos().filter(|_| response.dragged())? - origin?;
        let (from, from_mm) = ui.data(|data| data.get_temp::<(Pos2, f32)>(held))?;
        // By where the hand is, not by how far it went since: with the press a pointer may have come from anywhere.
        let at_mm = if is_seen {
            clip.at_mm + (from + hand - middle).dot(per_mm) / per_mm.length_sq()
        } else {
            from_mm - hand.y * seen.camera.mm_per_pixel(seen.rect.height().max(1.0))
        };
        let at_mm = at_mm.clamp(low, high);
        Some(Action::Clip(Some(Clip { at_mm, ..clip })))
    }
}

fn draw_handle(canvas: &Canvas<'_>, middle: Pos2, way: Vec2, is_held: bool) {
    let visuals = canvas.ui.visuals();
    let (accent, on_accent) = (visuals.hyperlink_color, visuals.selection.stroke.color);
    let stroke = Stroke::new(if is_held { 4.0 } else { 3.0 }, accent);
    for side in [-1.0, 1.0] {
        let tip = middle + way * (ARROW * side);
        let across = way.rot90() * 5.0;
        let back = tip - way * (8.0 * side);
        canvas.painter.line_segment([middle, tip], stroke);
        canvas.painter.add(Shape::line(vec![back + across, tip, back - across], stroke));
    }
    canvas.painter.circle(middle, 9.0, accent, Stroke::new(1.5, on_accent));
    canvas.painter.text(middle, Align2::CENTER_CENTER, "+", egui::FontId::proportional(13.0), on_accent);
}

/// A small cross in the middle of a view: where Enter measures.
fn cross(ui: &Ui, rect: Rect) {
    let (painter, middle) = (ui.painter_at(rect), rect.center());
    let stroke = Stroke::new(1.5, ui.visuals().text_color());
    for (from, to) in [(vec2(-8.0, 0.0), vec2(8.0, 0.0)), (vec2(0.0, -8.0), vec2(0.0, 8.0))] {
        painter.line_segment([middle + from, middle + to], stroke);
    }
}
