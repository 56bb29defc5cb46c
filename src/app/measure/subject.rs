//! The surface that a measure is made on: the level or the surface as it was opened, of which a place is picked; and the
//! index that finds the balls in it, built a little in each frame while it is wanted.

use std::borrow::Cow;
use std::task::Poll;
use std::time::Duration;

use web_time::Instant;

use crate::app::document::Document;
use crate::mesh::{IndexBuild, SurfaceIndex, Vec3};
use crate::pipeline::settings::Keep;
use crate::render::{ClipPlane, Ray, pick};
use crate::sharing::measures::MadeOn;

/// How long the index is worked on in a frame.
const SLICE: Duration = Duration::from_millis(8);
/// Units of work between two looks at the clock.
const WORK: usize = 20_000;

/// By what a surface is known: the document's number, and those of the level, or of the opened surface and what is kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Of {
    Opened(u64, u64, Keep),
    Level(u64, u64, u64),
}

/// A surface to measure on.
pub(super) struct Subject<'a> {
    pub(super) positions: &'a [Vec3],
    pub(super) triangles: Cow<'a, [[u32; 3]]>,
    pub(super) made_on: MadeOn,
    pub(super) of: Of,
}

/// A place of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picked {
    /// Where, in mm.
    pub at: Vec3,
    /// Whether it is on the surface as it was opened, not on the level.
    pub is_opened: bool,
}

impl<'a> Subject<'a> {
    /// The level that is shown, or the surface as it was opened, the pieces of it that are kept.
    pub(super) fn new(document: &'a Document, is_opened: bool, keep: Keep) -> Option<Self> {
        let revision = document.revision;
        if is_opened {
            let (mesh, pieces) = (&document.opened, &document.pieces);
            let triangles = if keep == Keep::All || pieces.list.len() < 2 {
                Cow::Borrowed(&mesh.triangles[..])
            } else {
                (0..mesh.triangles.len()).filter(|&t| pieces.keeps(keep, t)).map(|t| mesh.triangles[t]).collect()
            };
            let of = Of::Opened(revision.document, revision.opened, keep);
            return Some(Self { positions: &mesh.positions, triangles, made_on: MadeOn::Opened, of });
        }
        let (levels, shown) = (&document.levels.as_ref()?.1, document.shown.as_ref()?);
        Some(Self {
            positions: &levels.positions,
            triangles: Cow::Borrowed(&shown.level.triangles),
            made_on: MadeOn::Level(shown.level.triangles.len() as u32),
            of: Of::Level(revision.document, revision.levels, revision.shown),
        })
    }

    /// The first place that a ray meets of what a plane leaves.
    pub(super) fn pick(&self, ray: &Ray, clip: Option<ClipPlane>) -> Option<Picked> {
        let mut ray = *ray;
        if let Some(plane) = clip {
            let height = plane.height(ray.origin);
            let fall = -plane.normal.dot(ray.direction);
            if height > 0.0 {
                // A view from what is left out begins at the plane.
                ray.origin += ray.direction * if fall > 0.0 { height / fall } else { return None };
            }
        }
        let hit = pick(&ray, self.positions, &self.triangles)?;
        let at = ray.origin + ray.direction * hit.distance;
        let is_left = clip.is_none_or(|plane| plane.height(at) <= 1e-2);
        is_left.then_some(Picked { at, is_opened: self.made_on == MadeOn::Opened })
    }
}

/// The index of a surface, on its way.
#[derive(Default)]
pub(super) struct Indexing {
    of: Option<Of>,
    build: Box<IndexBuild>,
    index: Option<SurfaceIndex>,
}

impl Indexing {
    /// Works on the index of `subject` for a slice, or to the end; `None` while it is not there.
    pub(super) fn advance(&mut self, subject: &Subject<'_>, to_the_end: bool) -> Option<&SurfaceIndex> {
        if self.of != Some(subject.of) {
            *self = Self { of: Some(subject.of), ..Self::default() };
        }
        let begun = Instant::now();
        while self.index.is_none() {
            if let Poll::Ready(index) = self.build.advance(subject.positions, &subject.triangles, WORK) {
                self.index = Some(index);
            } else if !to_the_end && begun.elapsed() > SLICE {
                break;
            }
        }
        self.index.as_ref()
    }
}
