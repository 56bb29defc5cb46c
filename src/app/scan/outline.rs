//! The outline of the surface in the slices behind it, drawn over the views: it lies in the slice, and is seen through what
//! is before it.

use std::sync::Arc;

use egui::{Color32, Rect, Shape, Stroke, Ui};
use glam::Vec3;

use super::slices::SlicePicture;
use crate::app::document::{Document, Revision};
use crate::app::places::seen;
use crate::mesh::cut_pieces;
use crate::pipeline::settings::Keep;
use crate::render::Camera;

/// On any grey: bright, in a dark border.
const BRIGHT: Color32 = Color32::from_rgb(255, 196, 61);
const BORDER: Color32 = Color32::from_black_alpha(190);

/// What an outline is of: the slice, the surface, and whether that is the one that was opened.
type Of = (u64, Revision, Keep, bool);

/// The outlines that are drawn, kept as long as nothing moves.
#[derive(Default)]
pub(in crate::app) struct Outlines(Vec<(Of, Vec<[Vec3; 2]>)>);

impl Outlines {
    /// Forgets those of slices that are not shown.
    pub(in crate::app) fn keep_only(&mut self, slices: &[Arc<SlicePicture>], revision: Revision) {
        // Numbers that come in change no surface.
        let revision = of_surface(revision);
        self.0.retain(|((serial, of, ..), _)| *of == revision && slices.iter().any(|slice| slice.serial == *serial));
    }

    /// Draws those of `document`, or of it as it was opened, over the picture in `rect`, as far as they lie in `part`.
    pub(in crate::app) fn draw(
        &mut self,
        ui: &Ui,
        [rect, part]: [Rect; 2],
        camera: &Camera,
        slices: &[Arc<SlicePicture>],
        (document, keep, before): (&Document, Keep, bool),
    ) {
        let painter = ui.painter_at(part);
        let place = |p: Vec3| seen(p, camera, rect);
        for slice in slices {
            let pieces = self.of(slice, document, keep, before);
            let lines: Vec<[egui::Pos2; 2]> =
                pieces.iter().filter_map(|&[a, b]| Some([place(a)?, place(b)?])).collect();
            for stroke in [Stroke::new(3.5, BORDER), Stroke::new(1.75, BRIGHT)] {
                painter.extend(lines.iter().map(|&points| Shape::LineSegment { points, stroke }));
            }
        }
    }

    /// The outline in a slice.
    fn of(&mut self, slice: &SlicePicture, document: &Document, keep: Keep, before: bool) -> &[[Vec3; 2]] {
        let of = (slice.serial, of_surface(document.revision), keep, before);
        let known = self.0.iter().position(|(known, _)| *known == of);
        let at = known.unwrap_or_else(|| {
            let cut = |positions: &[Vec3], triangles: &[[u32; 3]]| {
                cut_pieces(positions, triangles, slice.corners[0], slice.normal())
            };
            let pieces = match (&document.levels, &document.shown) {
                (Some((_, levels)), Some(shown)) if !before => cut(&levels.positions, &shown.level.triangles),
                _ => {
                    let before = document.before(keep);
                    cut(&before.positions, &before.triangles)
                }
            };
            self.0.push((of, pieces));
            self.0.len() - 1
        });
        &self.0[at].1
    }
}

/// What of a revision is the surface.
fn of_surface(revision: Revision) -> Revision {
    Revision { measured: 0, ..revision }
}
