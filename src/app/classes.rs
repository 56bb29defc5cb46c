//! The vertex classes of the level that is shown: as colours, with how many there are of each, and the feature edges and
//! boundary loops as lines.

use egui::{Align2, Color32, FontId, Rect, Role, Sense, Stroke, Ui, Vec2, pos2, vec2};
use glam::Vec3;

use super::assist::name;
use super::document::Document;
use super::halo;
use super::places::seen;
use crate::language::{inner, tell};
use crate::pipeline::classes::{Class, Lines};
use crate::render::{Camera, Colour, ColourMap, label_colour};
use crate::say;

/// The palette's colour for each class, in the order of [`Class::ALL`]: grey for what is most.
const COLOURS: [usize; 5] = [7, 5, 0, 1, 2];

/// For each node of the level that is shown the number of its colour.
pub(super) fn labels(document: &Document) -> Option<Vec<f32>> {
    let number = |class: &Option<Class>| class.map_or(2.0 * ColourMap::UNKNOWN, |class| COLOURS[class as usize] as f32);
    Some(document.classes()?.by_node.iter().map(number).collect())
}

/// The colour of a class, where it is written or drawn beside the surface.
pub(super) fn colour(class: Class) -> Color32 {
    let Colour([r, g, b]) = label_colour(COLOURS[class as usize]);
    Color32::from_rgb(r, g, b)
}

/// Writes beside the view in `rect` how many vertices there are of each class.
pub(super) fn legend(ui: &Ui, rect: Rect, counts: &[usize; 5]) {
    const SIDE: f32 = 12.0;
    const STEP: f32 = 18.0;
    let (painter, text) = (ui.painter_at(rect), ui.visuals().text_color());
    let font = FontId::proportional(12.0);
    let (right, top) = (rect.right() - 12.0, rect.center().y - 0.5 * STEP * counts.len() as f32);
    halo::text(&painter, pos2(right, top - 6.0), Align2::RIGHT_BOTTOM, &say!("panel-class"), font.clone(), text);
    let mut said = Vec::new();
    for (i, (class, &count)) in Class::ALL.into_iter().zip(counts).enumerate() {
        let corner = pos2(right - SIDE, top + STEP * i as f32);
        painter.rect_filled(Rect::from_min_size(corner, Vec2::splat(SIDE)), 2.0, colour(class));
        let words = say!("panel-class-count", class = tell(&class), count = count);
        halo::text(&painter, corner + vec2(-6.0, 0.5 * SIDE), Align2::RIGHT_CENTER, &words, font.clone(), text);
        said.push(words);
    }
    let whole = Rect::from_min_max(pos2(right - 132.0, top - 20.0), pos2(right, top + STEP * counts.len() as f32));
    let place = ui.interact(whole, ui.scope_id().with("vertex classes"), Sense::hover());
    name(&place, Role::Label, &say!("panel-classes", classes = inner(&said.join(", "))));
    place.on_hover_text(say!("panel-classes-help"));
}

/// Draws feature edges and boundary over the view in `rect`; faintly where the surface turns away from the eye, by its
/// `normals`.
pub(super) fn lines(ui: &Ui, rect: Rect, camera: &Camera, document: &Document, lines: &Lines, normals: &[Vec3]) {
    const BEHIND: f32 = 0.3;
    let Some((_, levels)) = &document.levels else { return };
    let (painter, eye) = (ui.painter_at(rect), camera.eye());
    for (edges, class) in [(&lines.features, Class::InteriorEdge), (&lines.boundary, Class::Boundary)] {
        let stroke = Stroke::new(2.0, colour(class));
        for ends in edges {
            let [Some(a), Some(b)] = ends.map(|node| seen(levels.positions[node as usize], camera, rect)) else {
                continue;
            };
            let is_behind = |&node: &u32| {
                let towards = eye - levels.positions[node as usize];
                normals.get(node as usize).is_some_and(|normal| normal.dot(towards) < 0.0)
            };
            let faint = if ends.iter().all(is_behind) { BEHIND } else { 1.0 };
            painter.line_segment([a, b], Stroke::new(stroke.width, stroke.color.gamma_multiply(faint)));
        }
    }
}
