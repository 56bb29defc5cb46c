//! A surface beside a reference that it was not made from by Lumen: another program's, another resolution, another day.
//! `motion`: how it is moved onto the reference first; `report`: what came of it, for programs.

mod motion;
mod report;

use std::sync::Arc;

use serde::{Deserialize, Serialize};

pub use self::motion::{Align, BesideError, FileFrame, Fit, Moved, Placed, axes_differ, placed};
pub use self::report::{BesideReport, Branch, Calibre, Side};

use crate::deviation::{Comparing, Deviation, compare};
use lumen_mesh::task::Yielder;
use lumen_mesh::{Reach, SurfaceIndex, TriMesh, Vec3, reach};
use lumen_vessel::Subject;
use lumen_vessel::certificate::{CalibreError, Certificate};

/// How a surface is compared with a reference.
#[derive(Clone, Copy, Debug)]
pub struct Looking {
    /// Samples of each, at least one.
    pub samples: usize,
    /// The change of a vessel's radius in percent that is allowed.
    pub tolerance_percent: f64,
    /// Whether a map of the distances over the reference is made, too.
    pub with_reference_map: bool,
}

/// What is farthest of one surface from the other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Farthest {
    /// Its distance in mm.
    pub mm: f64,
    /// No other point is farther than this, in mm, for certain: less than 0.5 % more, or what the rounding of 32-bit
    /// coordinates makes of it.
    pub at_most_mm: f64,
    /// Where it is, in mm.
    pub at_mm: [f32; 3],
    /// What of the other surface is nearest to it, in mm.
    pub nearest_mm: [f32; 3],
}

/// Mean distances around each vertex of one of the surfaces from the other, in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Distances {
    /// Without a sign.
    pub plain: Vec<f32>,
    /// Positive where the surface lies outside the reference, over either of them.
    pub signed: Vec<f32>,
}

/// What [`beside`] finds.
#[derive(Debug)]
pub struct Beside {
    /// Mean, RMS, 95th percentile pooled over samples of both; the largest is that of `farthest`.
    pub deviation: Deviation,
    /// Over the vertices of the surface.
    pub over_surface: Distances,
    /// Over those of the reference, where that was asked for.
    pub over_reference: Option<Distances>,
    /// Of the reference from the surface, and of the surface from the reference.
    pub farthest: [Farthest; 2],
    /// The vessels of the reference, measured at the same places on both; [`BranchCalibre::smoothed`] is the reference
    /// again.
    ///
    /// [`BranchCalibre::smoothed`]: lumen_vessel::certificate::BranchCalibre::smoothed
    pub calibre: Result<Certificate, CalibreError>,
}

/// From this part of the reference's size on two surfaces are told to lie apart.
const APART: f64 = 0.05;

impl Beside {
    /// Whether the surfaces lie so far apart, on the mean, that they are hardly of one vessel in one place; `reference` is
    /// what was compared with.
    pub fn lie_apart(&self, reference: &TriMesh) -> bool {
        self.deviation.mean > APART * f64::from(reference.bounds().diagonal())
    }
}

/// Compares `surface` with `reference`.
///
/// # Errors
/// Where one of them has no area.
pub async fn beside(
    reference: &Arc<TriMesh>,
    surface: &Arc<TriMesh>,
    how: Looking,
    yielder: &Yielder,
) -> Result<Beside, BesideError> {
    compared(reference, surface, how, yielder).await.ok_or(BesideError::NoArea)
}

async fn compared(reference: &Arc<TriMesh>, surface: &Arc<TriMesh>, how: Looking, yielder: &Yielder) -> Option<Beside> {
    let comparing = Comparing { samples: how.samples, with_map: true, ..Comparing::default() };
    let compared = compare(reference, surface, comparing.clone(), &yielder.part(0.0..0.3)).await;
    let (comparison, indices) = (compared.comparison?, compared.indices);
    // What the samples found on either side: from there it is not far to what is certain.
    let places = comparison.deviation.max_at_mm.map(Vec3::from);
    let [of_reference, of_surface] = &indices;
    let there = farthest(reference, of_surface.as_deref()?, places[0], &yielder.part(0.3..0.4)).await?;
    let back = farthest(surface, of_reference.as_deref()?, places[1], &yielder.part(0.4..0.5)).await?;
    let over_reference = if how.with_reference_map {
        let [of_reference, of_surface] = indices.clone();
        let comparing = Comparing { indices: [of_surface, of_reference], ..comparing };
        let found = compare(surface, reference, comparing, &yielder.part(0.5..0.7)).await.comparison?;
        Some(Distances { plain: found.map, signed: found.signed_map.into_iter().map(|mm| 0.0 - mm).collect() })
    } else {
        None
    };
    let [of_reference, of_surface] = indices;
    let subject = |mesh, index| {
        let plain = Subject::new(mesh);
        let index = if Arc::ptr_eq(&plain.mesh, mesh) { index } else { None };
        Subject { index, ..plain }
    };
    let (reference, surface) = (subject(reference, of_reference), subject(surface, of_surface));
    let all = [reference.clone(), reference, surface];
    let calibre = Certificate::of(all, how.tolerance_percent, &yielder.part(0.7..1.0)).await;
    let (max, max_at_mm) = if there.mm > back.mm {
        (there.mm, [there.at_mm, there.nearest_mm])
    } else {
        (back.mm, [back.nearest_mm, back.at_mm])
    };
    let deviation = Deviation { max, max_at_mm, ..comparison.deviation };
    let over_surface = Distances { plain: comparison.map, signed: comparison.signed_map };
    Some(Beside { deviation, over_surface, over_reference, farthest: [there, back], calibre })
}

/// What of `mesh` is farthest from another surface; `place` is where it is thought to be.
async fn farthest(mesh: &TriMesh, from: &SurfaceIndex, place: Vec3, yielder: &Yielder) -> Option<Farthest> {
    let known_mm = from.nearest(place).map_or(0.0, |found| f64::from(found.distance));
    let Reach { farthest, at_most_mm } = reach(mesh, from, known_mm, yielder).await?;
    let (mm, at) = if known_mm > farthest.distance { (known_mm, place) } else { (farthest.distance, farthest.point) };
    let nearest_mm = from.nearest(at)?.point.to_array();
    Some(Farthest { mm, at_most_mm: at_most_mm.max(mm), at_mm: at.to_array(), nearest_mm })
}
