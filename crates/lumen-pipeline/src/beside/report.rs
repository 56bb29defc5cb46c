//! What a comparison of two files came to, as JSON and as a table. The names of the fields are public and stay.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::{Beside, Farthest, Moved};
use crate::deviation::Deviation;
use crate::report::DISCLAIMER;
use lumen_io::Axes;
use lumen_mesh::{Measures, TriMesh};
use lumen_vessel::certificate::{BranchCalibre, SurfaceColumns, Verdict};

/// What was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BesideReport {
    /// That it is not for clinical decisions.
    pub disclaimer: Cow<'static, str>,
    /// Lumen's version.
    pub version: Cow<'static, str>,
    /// What is compared with.
    pub reference: Side,
    /// What is judged.
    pub surface: Side,
    /// Null where nothing was moved.
    pub moved: Option<Moved>,
    /// Pooled over samples of both.
    pub deviation_mm: Deviation,
    /// What of the reference is farthest from the surface.
    pub reference_farthest: Farthest,
    /// What of the surface is farthest from the reference.
    pub surface_farthest: Farthest,
    /// What became of the vessels.
    pub calibre: Calibre,
}

/// One of the two surfaces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Side {
    /// Its name.
    pub file: String,
    /// Of the file; null of a sample.
    pub sha256: Option<String>,
    /// What its coordinates grow towards.
    pub axes: Axes,
    /// How many.
    pub triangles: usize,
    /// How many.
    pub vertices: usize,
    /// Area, in mm2.
    pub area_mm2: f64,
    /// The volume with open ends closed, in mm3; null where the windings do not agree.
    pub volume_mm3: Option<f64>,
}

/// What became of the vessels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Calibre {
    /// The change of a radius that counts as kept, in percent.
    pub tolerance_percent: f64,
    /// Why nothing was measured.
    pub refused: Option<String>,
    /// Of all branches.
    pub verdict: Option<Verdict>,
    /// The part of their length that was measured on both.
    pub measured_percent: Option<f64>,
    /// Each vessel of the reference.
    pub branches: Vec<Branch>,
}

/// A vessel on both surfaces. Radii and changes are null where nothing was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Branch {
    /// Its number, from 1.
    pub number: u32,
    /// What it is called.
    pub name: String,
    /// The number of the one that it leaves.
    pub parent: Option<u32>,
    /// Its length in mm.
    pub length_mm: f64,
    /// Whether its radius is kept.
    pub verdict: Verdict,
    /// The part of its length that was measured on both.
    pub measured_percent: f64,
    /// On the reference, in mm.
    pub mean_radius_reference_mm: Option<f64>,
    /// On the surface, in mm.
    pub mean_radius_surface_mm: Option<f64>,
    /// The largest change of its radius from station to station.
    pub largest_change_percent: Option<f64>,
    /// Where that is, in mm.
    pub largest_change_at_mm: Option<[f32; 3]>,
}

/// The surfaces of the table of stations.
const COLUMNS: [SurfaceColumns; 2] = [("reference", |branch| &branch.opened), ("surface", |branch| &branch.reduced)];

impl Side {
    /// The side of `mesh`, which has these measures.
    pub fn new(file: &str, sha256: Option<String>, axes: Axes, mesh: &TriMesh, measures: Measures) -> Self {
        let (triangles, vertices) = (mesh.triangles.len(), mesh.positions.len());
        let Measures { area_mm2, volume_mm3 } = measures;
        Self { file: file.to_owned(), sha256, axes, triangles, vertices, area_mm2, volume_mm3 }
    }
}

impl BesideReport {
    /// What there is to tell of `found`.
    pub fn new([reference, surface]: [Side; 2], moved: Option<Moved>, found: &Beside, tolerance_percent: f64) -> Self {
        let certificate = found.calibre.as_ref().ok();
        let calibre = Calibre {
            tolerance_percent,
            refused: found.calibre.as_ref().err().map(ToString::to_string),
            verdict: certificate.map(|found| found.verdict),
            measured_percent: certificate.map(|found| found.coverage.percent()),
            branches: certificate.map_or_else(Vec::new, |found| found.branches.iter().map(branch).collect()),
        };
        Self {
            disclaimer: DISCLAIMER.into(),
            version: env!("CARGO_PKG_VERSION").into(),
            reference,
            surface,
            moved,
            deviation_mm: found.deviation,
            reference_farthest: found.farthest[0],
            surface_farthest: found.farthest[1],
            calibre,
        }
    }
}

impl Beside {
    /// A row for each station of a vessel: area and radius on both, empty where a cross-section does not close. `None` where
    /// there are no vessels.
    pub fn csv(&self) -> Option<String> {
        self.calibre.as_ref().ok().map(|calibre| calibre.csv_of(&COLUMNS))
    }
}

fn branch(of: &BranchCalibre) -> Branch {
    Branch {
        number: of.number,
        name: of.name.clone(),
        parent: of.parent,
        length_mm: of.length_mm,
        verdict: of.verdict,
        measured_percent: of.coverage().percent(),
        mean_radius_reference_mm: of.opened.radius_mm.map(|radius| radius.mean),
        mean_radius_surface_mm: of.reduced.radius_mm.map(|radius| radius.mean),
        largest_change_percent: of.reduced.largest_change.map(|change| change.percent),
        largest_change_at_mm: of.reduced.largest_change.map(|change| change.at_mm),
    }
}
