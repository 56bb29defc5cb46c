//! Lines and labels at places of the surface, drawn over a view.

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Shape, Stroke, Ui, vec2};

use crate::app::places::seen;
use crate::app::{halo, labels};
use crate::mesh::Vec3;
use crate::render::Camera;

/// A view to draw over.
pub(in crate::app) struct Canvas<'a> {
    pub(in crate::app) ui: &'a Ui,
    /// The whole view.
    pub(in crate::app) rect: Rect,
    pub(in crate::app) camera: &'a Camera,
    pub(in crate::app) painter: Painter,
}

impl<'a> Canvas<'a> {
    /// Over the part of the view in `rect` that is in `part`.
    pub(in crate::app) fn new(ui: &'a Ui, rect: Rect, part: Rect, camera: &'a Camera) -> Self {
        Self { ui, rect, camera, painter: ui.painter_at(rect.intersect(part)) }
    }

    /// Where a place is in the window; `None` behind the eye.
    pub(in crate::app) fn at(&self, place: Vec3) -> Option<Pos2> {
        seen(place, self.camera, self.rect)
    }

    /// A line through places, on a wider one of the background, so that it stands out of any colour.
    pub(in crate::app) fn line(&self, places: &[Vec3], is_closed: bool, width: f32, colour: Color32) {
        let Some(mut points) = places.iter().map(|&place| self.at(place)).collect::<Option<Vec<Pos2>>>() else {
            return;
        };
        if is_closed {
            points.extend(points.first().copied());
        }
        let halo = self.ui.visuals().window_fill.gamma_multiply(0.8);
        self.painter.add(Shape::line(points.clone(), Stroke::new(width + 2.0, halo)));
        self.painter.add(Shape::line(points, Stroke::new(width, colour)));
    }

    /// A dot at a place.
    pub(in crate::app) fn dot(&self, place: Vec3, colour: Color32) {
        if let Some(at) = self.at(place) {
            self.painter.circle(at, 3.5, colour, Stroke::new(1.5, self.ui.visuals().window_fill));
        }
    }

    /// A circle of so many mm around a place.
    pub(in crate::app) fn circle(&self, middle: Vec3, radius_mm: f32, width: f32, colour: Color32) {
        let right = self.camera.rotation * Vec3::X;
        if let (Some(at), Some(side)) = (self.at(middle), self.at(middle + right * radius_mm)) {
            let halo = self.ui.visuals().window_fill.gamma_multiply(0.8);
            let radius = at.distance(side);
            self.painter.circle_stroke(at, radius, Stroke::new(width + 2.0, halo));
            self.painter.circle_stroke(at, radius, Stroke::new(width, colour));
        }
    }

    /// Words beside a place, on a plate; none where there is no room for them.
    pub(in crate::app) fn label(&self, place: Vec3, words: &str, colour: Color32) {
        let Some(at) = self.at(place) else { return };
        let text = self.painter.layout_no_wrap(words.to_owned(), FontId::proportional(12.0), colour);
        let own = Align2::LEFT_CENTER.anchor_size(at + vec2(12.0, -10.0), text.size());
        let around = labels::around(at, text.size(), 12.0, self.rect);
        let Some(beside) = labels::free(self.ui, self.rect, std::iter::once(own).chain(around)) else { return };
        self.painter.rect_filled(
            beside.expand2(vec2(5.0, 2.0)),
            4.0,
            self.ui.visuals().window_fill.gamma_multiply(0.9),
        );
        halo::galley(&self.painter, beside.min, text, colour);
    }
}
