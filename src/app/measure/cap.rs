//! What a clip plane cuts of a surface: its outlines, and the area between them, over a view.
//!
//! The cap needs no depth: from the side that is left out nothing lies before the plane, and from the other side the
//! surface itself is before it, so that only its outline is drawn.

use egui::{Mesh, Pos2, Shape, Stroke};
use glam::{DVec2, DVec3};

use super::canvas::Canvas;
use super::fill::trapezoids;
use super::subject::{Of, Subject};
use crate::app::theme;
use crate::mesh::{Vec3, cut};
use crate::render::ClipPlane;

/// What a plane cuts of one surface.
struct Cut {
    of: Of,
    plane: ClipPlane,
    outlines: Vec<(Vec<Vec3>, bool)>,
    fill: Vec<[Vec3; 4]>,
}

/// The cuts of the frame before: of the level, and of the surface as it was opened.
#[derive(Default)]
pub(super) struct Cuts(Vec<Cut>);

/// Cuts that are kept.
const KEPT: usize = 2;

impl Cuts {
    fn of(&mut self, subject: &Subject<'_>, plane: ClipPlane) -> &Cut {
        let known = self.0.iter().position(|cut| cut.of == subject.of && cut.plane == plane);
        let cut = match known {
            Some(i) => self.0.remove(i),
            None => made(subject, plane),
        };
        self.0.truncate(KEPT - 1);
        self.0.insert(0, cut);
        &self.0[0]
    }

    /// Draws what `plane` cuts of a surface.
    pub(super) fn show(&mut self, canvas: &Canvas<'_>, subject: &Subject<'_>, plane: ClipPlane, is_lines: bool) {
        let cut = self.of(subject, plane);
        let visuals = canvas.ui.visuals();
        if plane.height(canvas.camera.eye()) > 0.0 {
            let [r, g, b] = theme::style(visuals).inside.0;
            let colour = egui::Color32::from_rgb(r, g, b).gamma_multiply(if is_lines { 0.35 } else { 1.0 });
            let mut mesh = Mesh::default();
            for corners in &cut.fill {
                let [a, b, c, d] = corners.map(|place| canvas.at(place));
                if let (Some(a), Some(b), Some(c), Some(d)) = (a, b, c, d) {
                    let first = mesh.vertices.len() as u32;
                    [a, b, c, d].into_iter().for_each(|at: Pos2| mesh.colored_vertex(at, colour));
                    mesh.add_triangle(first, first + 1, first + 2);
                    mesh.add_triangle(first + 2, first + 1, first + 3);
                }
            }
            canvas.painter.add(Shape::mesh(mesh));
        }
        let stroke = Stroke::new(2.0, visuals.hyperlink_color);
        for (outline, is_closed) in &cut.outlines {
            let Some(mut points) = outline.iter().map(|&place| canvas.at(place)).collect::<Option<Vec<Pos2>>>() else {
                continue;
            };
            points.extend(points.first().copied().filter(|_| *is_closed));
            canvas.painter.add(Shape::line(points, stroke));
        }
    }
}

fn made(subject: &Subject<'_>, plane: ClipPlane) -> Cut {
    let normal = plane.normal.as_dvec3().normalize_or(DVec3::Z);
    let at = normal * f64::from(plane.offset);
    let outlines = cut(subject.positions, &subject.triangles, at, normal);
    let (x, y) = normal.any_orthonormal_pair();
    let closed = outlines.iter().filter(|outline| outline.is_closed);
    let flat = |p: &DVec3| DVec2::new((*p - at).dot(x), (*p - at).dot(y));
    let flat: Vec<Vec<DVec2>> = closed.map(|outline| outline.points.iter().map(flat).collect()).collect();
    let place = |p: DVec2| (at + x * p.x + y * p.y).as_vec3();
    let fill = trapezoids(&flat).into_iter().map(|corners| corners.map(place)).collect();
    let places = |points: &[DVec3]| points.iter().map(|p| p.as_vec3()).collect();
    let outlines = outlines.iter().map(|outline| (places(&outline.points), outline.is_closed)).collect();
    Cut { of: subject.of, plane, outlines, fill }
}
