//! Vessel trees that Lumen makes itself, to try everything on without a file.
//!
//! A sample is made the way a segmented scan is: vessels with published dimensions ([`vessels`]) are sampled as a
//! binary mask on an anisotropic, CT-like grid, and the mask is cut by marching cubes, or one by surface nets. So the surface
//! has the stair-steps of a segmentation, open ends where vessels leave the volume, and a few detached specks of noise.
//! Coordinates are LPS millimetres: x to the patient's left, y to the back, z up.
//!
//! The same sample and count give the same bytes on every platform.

mod aorta;
mod coronary;
mod field;
mod islands;
mod vessel;

use std::fmt;
use std::ops::ControlFlow;
use std::str::FromStr;
use std::sync::Arc;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use field::Field;
use lumen_mesh::{TriMesh, components};
use lumen_message::messages;
use lumen_volume::{Geometry, Grid, MarchingCubes, Mask as _, Relaxation, Samples, Selection, surface_nets};
pub use vessel::{Station, Vessel};

/// The fewest triangles [`generate`] makes.
pub const MIN_TRIANGLES: usize = 2_000;
/// The most triangles [`generate`] makes.
pub const MAX_TRIANGLES: usize = 5_000_000;

/// Distance between slices over distance between points in a slice: 0.5 mm slices at 0.4 mm in plane.
const SLICE_RATIO: f64 = 1.25;
/// Grids tried before giving up on a count. One to three are enough unless the grid is so coarse that branches touch
/// and part again from one to the next.
const ATTEMPTS: usize = 60;
/// Of these, the grids that begin in the same corner.
const STEADY_ATTEMPTS: usize = 8;
/// Steps in voxels that spread shifted grids evenly: powers of the root of x^4 = x + 1 (Roberts' R3 sequence).
const GRID_SHIFTS: [f64; 3] = [0.819_172_5, 0.671_043_6, 0.549_700_5];

/// A vessel tree that Lumen can make.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sample {
    /// Abdominal aorta with renal and common iliac arteries.
    Aorta,
    /// Aortic root and arch with the coronary arteries.
    Coronary,
    /// The mask of [`Self::Aorta`], its surface made by surface nets.
    #[serde(rename = "aorta-nets")]
    AortaNets,
}

impl Sample {
    /// Every sample, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Aorta, Self::Coronary, Self::AortaNets];

    /// The name on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Aorta => "aorta",
            Self::Coronary => "coronary",
            Self::AortaNets => "aorta-nets",
        }
    }

    /// What a surface made from it is called in reports and files, whatever is spoken.
    pub fn title(self) -> &'static str {
        match self {
            Self::Aorta => "Abdominal aorta",
            Self::Coronary => "Coronary arteries",
            Self::AortaNets => "Abdominal aorta by surface nets",
        }
    }

    /// The name in menus.
    pub fn label(self) -> SampleName {
        match self {
            Self::Aorta => SampleName::Aorta,
            Self::Coronary => SampleName::Coronary,
            Self::AortaNets => SampleName::AortaNets,
        }
    }

    /// Triangles of the largest component at the usual resolution, made in a single pass. The aorta has as many as
    /// the paper's aorta.
    pub fn default_triangles(self) -> usize {
        match self {
            Self::Aorta => 74_307,
            Self::Coronary => 380_000,
            Self::AortaNets => 74_328,
        }
    }

    /// Distance in mm between points in a slice that gives [`Self::default_triangles`] to the triangle.
    fn default_spacing(self) -> f64 {
        match self {
            Self::Aorta | Self::AortaNets => 0.593_508,
            Self::Coronary => 0.398_353,
        }
    }

    /// The lumen, with islands, for a grid of the given spacing.
    fn field(self, spacing: DVec3) -> Field {
        let (vessels, bulges, seed) = match self {
            Self::Aorta | Self::AortaNets => (aorta::vessels(), Vec::new(), 1),
            Self::Coronary => (coronary::vessels(), coronary::sinuses(), 2),
        };
        let mut field = Field::new(&vessels, &bulges, spacing);
        islands::scatter(&mut field, &vessels, spacing, seed);
        field
    }
}

impl fmt::Display for Sample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// There is no sample of this name.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("there is no sample {name:?}; there are \"aorta\", \"coronary\" and \"aorta-nets\"")]
pub struct UnknownSample {
    /// The name that was asked for.
    pub name: String,
}

impl FromStr for Sample {
    type Err = UnknownSample;

    fn from_str(name: &str) -> Result<Self, UnknownSample> {
        Self::ALL.into_iter().find(|s| s.name() == name).ok_or_else(|| UnknownSample { name: name.to_owned() })
    }
}

messages! {
    /// Why a sample could not be made.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum PhantomError {
        /// The count is out of range.
        "errors-sample-range" TrianglesOutOfRange {
            /// The count that was asked for.
            asked: usize,
            /// The fewest.
            least: usize,
            /// The most.
            most: usize,
        } => "{asked} triangles are outside the range of {least} to {most}",
        /// No grid that was tried comes within 1 % of the count.
        "errors-sample-grid" NotReached {
            /// The count that was asked for.
            asked: usize,
            /// The nearest count found.
            nearest: usize,
        } => "no grid gives {asked} triangles to within 1 %; the nearest gives {nearest}",
        /// The caller broke off.
        "errors-cancelled" Cancelled => "cancelled",
    }
}

messages! {
    /// The name of a sample in menus.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SampleName {
        /// Of [`Sample::Aorta`].
        "panel-sample-aorta" Aorta => "Abdominal aorta",
        /// Of [`Sample::Coronary`].
        "panel-sample-coronary" Coronary => "Coronary arteries",
        /// Of [`Sample::AortaNets`].
        "panel-sample-aorta-nets" AortaNets => "Abdominal aorta by surface nets",
    }
}

/// The vessels of a sample, parents before branches, in mm.
pub fn vessels(sample: Sample) -> Vec<Vessel> {
    match sample {
        Sample::Aorta | Sample::AortaNets => aorta::vessels(),
        Sample::Coronary => coronary::vessels(),
    }
}

/// Makes a sample whose largest component has `triangles` triangles to within 1 % (exactly, for
/// [`Sample::default_triangles`]). `triangles` is in [`MIN_TRIANGLES`]`..=`[`MAX_TRIANGLES`]. On coarse grids thin
/// branches are widened to what the grid can show; below about 10,000 triangles for the
/// coronary arteries they so come to touch their neighbours.
///
/// # Errors
/// [`PhantomError::TrianglesOutOfRange`] and [`PhantomError::NotReached`].
pub fn generate(sample: Sample, triangles: usize) -> Result<TriMesh, PhantomError> {
    generate_with(sample, triangles, &mut |_| ControlFlow::Continue(()))
}

/// [`generate`], telling `progress` the fraction done (0 to 1, never falling) after every slice of the grid.
///
/// # Errors
/// As [`generate`], and [`PhantomError::Cancelled`] when `progress` breaks off.
pub fn generate_with(
    sample: Sample,
    triangles: usize,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<TriMesh, PhantomError> {
    if !(MIN_TRIANGLES..=MAX_TRIANGLES).contains(&triangles) {
        return Err(PhantomError::TrianglesOutOfRange { asked: triangles, least: MIN_TRIANGLES, most: MAX_TRIANGLES });
    }
    let default = sample.default_triangles();
    // A surface sampled s times as finely has s^2 times as many triangles.
    let mut spacing = sample.default_spacing() * (default as f64 / triangles as f64).sqrt();
    let (mut nearest, mut nearest_spacing) = (0usize, spacing);
    let mut shift = [0.0; 3];
    // How far the bar is, and how far it will be after this grid: half of what is left, for others may follow.
    let (mut done, mut share) = (0.0, if triangles == default { 1.0 } else { 0.6 });
    for attempt in 1..=ATTEMPTS {
        let mesh = sampled(sample, spacing, shift, &mut |fraction| progress(done + share * fraction))?;
        let found = largest_component(&mesh);
        if found.abs_diff(triangles) * 100 <= triangles {
            return match progress(1.0) {
                ControlFlow::Continue(()) => Ok(mesh),
                ControlFlow::Break(()) => Err(PhantomError::Cancelled),
            };
        }
        if attempt == 1 || found.abs_diff(triangles) < nearest.abs_diff(triangles) {
            (nearest, nearest_spacing) = (found, spacing);
        }
        if found == 0 {
            break;
        }
        if attempt < STEADY_ATTEMPTS {
            spacing *= (found as f64 / triangles as f64).sqrt();
        } else {
            // The count jumps with the spacing here: grids that lie otherwise against the vessels jump elsewhere.
            spacing = nearest_spacing * (nearest as f64 / triangles as f64).sqrt();
            shift = GRID_SHIFTS.map(|s| (s * attempt as f64).fract());
        }
        done += share;
        share = (1.0 - done) / 2.0;
    }
    Err(PhantomError::NotReached { asked: triangles, nearest })
}

/// The surface of a sample on a grid of `spacing` mm in plane, that begins `shift` voxels (0 to 1) lower.
fn sampled(
    sample: Sample,
    spacing: f64,
    shift: [f64; 3],
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<TriMesh, PhantomError> {
    let field = sample.field(DVec3::new(spacing, spacing, spacing * SLICE_RATIO));
    let mut grid = field.grid();
    grid.origin -= grid.spacing * DVec3::from(shift);
    if sample == Sample::AortaNets {
        return nets(&field, grid, progress);
    }
    let mut surface = MarchingCubes::new(&grid, field.mask(&grid));
    while !surface.is_done() {
        surface.advance_layer();
        if progress(surface.fraction()).is_break() {
            return Err(PhantomError::Cancelled);
        }
    }
    Ok(surface.into_mesh())
}

/// The surface by surface nets, without what lies behind open ends.
fn nets(
    field: &Field,
    grid: Geometry,
    progress: &mut dyn FnMut(f32) -> ControlFlow<()>,
) -> Result<TriMesh, PhantomError> {
    /// The part of the time that the mask takes.
    const MASKED: f32 = 0.5;
    let [nx, ny, nz] = grid.size;
    let (mut inside, mut runs) = (vec![0; grid.points()], Vec::new());
    let mut mask = field.mask(&grid);
    for k in 0..nz {
        mask.begin_slice(k);
        for (j, row) in inside[k * nx * ny..][..nx * ny].chunks_exact_mut(nx).enumerate() {
            runs.clear();
            mask.row(j, &mut runs);
            runs.iter().for_each(|run| row[run.clone()].fill(1));
        }
        if progress(MASKED * (k + 1) as f32 / nz as f32).is_break() {
            return Err(PhantomError::Cancelled);
        }
    }
    let made = Grid::new(grid, Samples::U8(inside), 1.0, 0.0)
        .and_then(|mask| surface_nets(&Arc::new(mask), Selection::AnyLabel, None, Relaxation::default()));
    // A grid that is too coarse has no vessel in it.
    let mesh = made.map_or_else(|_| TriMesh::default(), |made| made.mesh);
    Ok(mesh.filtered(|t| {
        let [a, b, c] = mesh.corners(t).map(DVec3::from);
        !field.is_behind_an_end((a + b + c) / 3.0, 0.0)
    }))
}

/// Triangles of the largest component.
fn largest_component(mesh: &TriMesh) -> usize {
    let found = components(mesh.positions.len(), &mesh.triangles);
    found.triangle_counts.iter().max().map_or(0, |&count| count as usize)
}

#[cfg(test)]
mod tests;
