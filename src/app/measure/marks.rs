//! Measures as they are drawn over a view.

use super::canvas::Canvas;
use crate::language::decimal;
use crate::mesh::{Ball, Vec3};
use crate::say;
use crate::sharing::measures::{Found, Measure};

/// Draws these measures, `chosen` among them with thicker lines.
pub(super) fn show(canvas: &Canvas<'_>, measures: &[Measure], chosen: Option<usize>) {
    let visuals = canvas.ui.visuals();
    let (accent, text) = (visuals.hyperlink_color, visuals.text_color());
    for (i, measure) in measures.iter().enumerate() {
        let width = if chosen == Some(i) { 3.0 } else { 1.5 };
        let places = measure.places();
        let mut at = measure.extent().0;
        match &measure.found {
            Found::Ruler { .. } => canvas.line(&places, false, width, accent),
            Found::Angle { .. } => {
                canvas.line(&places, false, width, accent);
                arc(canvas, &places, width);
                at = places[1];
            }
            Found::Diameter { diameter_mm, .. } => {
                canvas.circle(places[1], diameter_mm / 2.0, width, accent);
                at = places[1];
            }
            Found::Section { outline_mm, .. } => {
                let outline: Vec<Vec3> = outline_mm.iter().map(|&p| p.into()).collect();
                canvas.line(&outline, true, width, accent);
            }
        }
        places.iter().for_each(|&place| canvas.dot(place, accent));
        canvas.label(at, &say!("measure-mark", name = &measure.name, value = measure.in_short()), text);
    }
}

/// Draws the places of a measure that is not whole yet.
pub(super) fn begun(canvas: &Canvas<'_>, places: &[Vec3]) {
    let accent = canvas.ui.visuals().hyperlink_color;
    canvas.line(places, false, 1.5, accent);
    places.iter().for_each(|&place| canvas.dot(place, accent));
}

/// Draws the ball under the pointer, with its diameter.
pub(super) fn ball(canvas: &Canvas<'_>, ball: &Ball) {
    let visuals = canvas.ui.visuals();
    canvas.circle(ball.centre, ball.radius, 1.5, visuals.hyperlink_color);
    canvas.dot(ball.centre, visuals.hyperlink_color);
    canvas.label(ball.centre, &format!("{} mm", decimal(2.0 * ball.radius, 2)), visuals.text_color());
}

/// The arc of an angle, a third of its shorter side away from the vertex.
fn arc(canvas: &Canvas<'_>, places: &[Vec3], width: f32) {
    const STEPS: usize = 16;
    let [one, vertex, other] = places else { return };
    let (a, b) = (*one - *vertex, *other - *vertex);
    let radius = a.length().min(b.length()) / 3.0;
    let (Some(a), Some(b)) = (a.try_normalize(), b.try_normalize()) else { return };
    let side = (b - a * a.dot(b)).normalize_or_zero();
    let angle = a.dot(b).clamp(-1.0, 1.0).acos();
    let points: Vec<Vec3> = (0..=STEPS)
        .map(|i| {
            let (sin, cos) = (angle * i as f32 / STEPS as f32).sin_cos();
            *vertex + (a * cos + side * sin) * radius
        })
        .collect();
    canvas.line(&points, false, width, canvas.ui.visuals().hyperlink_color);
}
