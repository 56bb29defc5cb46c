//! The certificate of calibre: what smoothing and reduction made of each branch of a vessel tree.
//!
//! Stations are taken along the centrelines of the surface as it was opened, and all three surfaces are cut there by
//! the same planes. What is compared is the radius of the circle of the same area,
//!
//! ```text
//! r(s) = sqrt( mean of A over s - r .. s + r / pi )
//! ```
//!
//! with the mean weighted by `1 - |s - t| / r`. The mean is over the same stretch on all surfaces, so that a taper does not
//! tell in the change from one to another; in the radius that is shown, where there is more of the vessel on one side than
//! on the other, the line of least squares stands in its place. The area of one cross-section of a
//! stair-stepped surface jumps by whole rows of voxels as the plane goes on, that of a stretch as long as the vessel is
//! wide does not, and to the first order steps in and out of the wall leave it as it is. The inscribed radius, which
//! stands beside it, does not have that property: steps that stand in make the ball smaller by a part of a voxel, and
//! smoothing gives that back, though the calibre is the same.
//!
//! A change counts where the vessel can be measured: see `zones` for ends and forks; where the cut
//! closes on the opened surface; and where the vessel is at least two mean edges wide. Where the others are open or
//! folded in the plane, there is no saying, nor where the plane has another loop on them though the wall has not moved
//! (see `section`). Where they have no vessel any more, the change is -100 %.

mod basis;
mod branch;
mod coverage;
mod stretch;
mod unit;

use std::fmt::Write as _;

use serde::{Deserialize, Serialize};

pub use basis::Basis;
pub use coverage::{Coverage, ENOUGH_PERCENT};
pub use unit::CalibreError;
pub(super) use unit::checked;

use super::BranchName;
pub use super::on_surface::{Change, OnSurface, Spread, SpreadText, StationStatus};
use super::variation::{Along, Kind, UnevenText, Variation, greatest, narrowest_beside};
use lumen_message::messages;

/// The change in percent that a vessel is allowed, unless it is said otherwise.
pub const TOLERANCE_PERCENT: f64 = 2.0;

messages! {
    /// What is found of a branch.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "snake_case")]
    pub enum Verdict {
        /// Nowhere more change than the tolerance.
        "vessels-verdict-kept" Kept => "kept",
        /// More change than the tolerance.
        "vessels-verdict-changed" Changed => "changed",
        /// The vessel can nowhere be measured.
        "vessels-verdict-not-measured" NotMeasured => "not measured",
    }
}

/// A branch of the vessel tree, on all three surfaces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BranchCalibre {
    /// 1 for the first.
    pub number: u32,
    /// "branch 1" for the first.
    pub name: String,
    /// Number of the branch that it comes out of; null for the first of a tree.
    pub parent: Option<u32>,
    /// Length of the centreline in mm.
    pub length_mm: f64,
    /// Length over the distance of the ends; null where they are at one place.
    pub tortuosity: Option<f64>,
    /// Whether the reduced surface keeps it within the tolerance.
    pub verdict: Verdict,
    /// Whether the smoothed surface does.
    pub verdict_smoothed: Verdict,
    /// Stations that count.
    pub stations_counted: usize,
    /// Arc length at each station, from the first station of the branch, in mm.
    pub abscissas_mm: Vec<f32>,
    /// Each station, in mm.
    pub at_mm: Vec<[f32; 3]>,
    /// Whether each counts, and why not.
    pub standings: Vec<StationStatus>,
    /// As opened.
    pub opened: OnSurface,
    /// Smoothed.
    pub smoothed: OnSurface,
    /// Reduced.
    pub reduced: OnSurface,
    /// Where it is narrower or wider, as opened, than on either side.
    #[serde(default)]
    pub variations: Vec<Variation>,
}

/// What became of all branches.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// The change in percent that is allowed.
    pub tolerance_percent: f64,
    /// Changed where one branch is; kept where the others are.
    pub verdict: Verdict,
    /// How much of them that is said of.
    pub coverage: Coverage,
    /// The branches, a parent before its branches.
    pub branches: Vec<BranchCalibre>,
    /// How many open ends of the surface as opened no branch leads to: nothing was measured there.
    #[serde(default)]
    pub openings_without_branch: usize,
}

impl Certificate {
    /// Of these branches, which were judged by this tolerance; so many open ends have none.
    pub fn new(branches: Vec<BranchCalibre>, tolerance_percent: f64, openings_without_branch: usize) -> Self {
        let has = |verdict: Verdict| branches.iter().any(|branch| branch.verdict == verdict);
        let verdict = if has(Verdict::Changed) {
            Verdict::Changed
        } else if has(Verdict::Kept) {
            Verdict::Kept
        } else {
            Verdict::NotMeasured
        };
        Self { tolerance_percent, verdict, coverage: Coverage::of(&branches), branches, openings_without_branch }
    }

    /// A row a station, in the order of the branches. A field is empty where a cross-section does not close.
    pub fn csv(&self) -> String {
        self.csv_of(&[
            ("opened", |branch| &branch.opened),
            ("smoothed", |branch| &branch.smoothed),
            ("reduced", |branch| &branch.reduced),
        ])
    }

    /// [`csv`](Self::csv), with columns of these surfaces alone. The changes are from the first of them.
    pub fn csv_of(&self, surfaces: &[SurfaceColumns]) -> String {
        let heads = |before: &str, after: &str, surfaces: &[SurfaceColumns]| -> String {
            surfaces.iter().map(|(name, _)| format!(",{before}_{name}_{after}")).collect()
        };
        let later = surfaces.get(1..).unwrap_or_default();
        let (areas, radii) = (heads("area", "mm2", surfaces), heads("radius", "mm", surfaces));
        let changes = heads("change", "percent", later);
        let mut text = format!("branch,abscissa_mm,x_mm,y_mm,z_mm,standing{areas}{radii}{changes},variation_percent\n");
        for branch in &self.branches {
            for i in 0..branch.abscissas_mm.len() {
                let [x, y, z] = branch.at_mm[i];
                let (number, at, standing) = (branch.number, branch.abscissas_mm[i], branch.standings[i].label());
                let _ = write!(text, "{number},{at:.4},{x:.4},{y:.4},{z:.4},{standing}");
                let areas = surfaces.iter().map(|(_, of)| of(branch).areas_mm2[i]);
                let radii = surfaces.iter().map(|(_, of)| of(branch).radii_mm[i]);
                let changes = later.iter().map(|(_, of)| of(branch).changes_percent[i]);
                let variation = branch.variation_at(f64::from(at)).map(|percent| percent as f32);
                for value in areas.chain(radii).chain(changes).chain([variation]) {
                    let _ = match value {
                        Some(value) => write!(text, ",{value:.5}"),
                        None => write!(text, ","),
                    };
                }
                text.push('\n');
            }
        }
        text
    }
}

/// What a surface is called in the heads of a table, and which of a branch's it is.
pub type SurfaceColumns = (&'static str, fn(&BranchCalibre) -> &OnSurface);

impl BranchCalibre {
    /// What it is called; `name` is the same in English.
    pub fn label(&self) -> BranchName {
        BranchName::Numbered { number: self.number }
    }

    /// The stretches that are most narrower and most wider than on either side: a narrowing first, for it is measured by what is
    /// left, and a widening, whose degree has no upper end, would hide it.
    pub fn uneven(&self) -> [Option<&Variation>; 2] {
        [Kind::Narrower, Kind::Wider].map(|kind| greatest(&self.variations, kind))
    }

    /// The narrowest place beside the diameter at another of the user's choice, at this arc length in mm: where the sides of
    /// a narrowing are no reference, as at a fork or in a vessel that is narrow as a whole. `None` where nothing is measured.
    pub fn narrowest_beside(&self, reference_mm: f64) -> Option<Variation> {
        let along = Along {
            abscissas_mm: &self.abscissas_mm,
            at_mm: &self.at_mm,
            standings: &self.standings,
            opened: &self.opened,
            reduced: &self.reduced,
        };
        narrowest_beside(along, reference_mm)
    }

    /// These in words; `None` where there is neither.
    pub fn uneven_text(&self) -> Option<UnevenText> {
        match self.uneven().map(|found| found.map(Variation::text)) {
            [Some(narrower), Some(wider)] => Some(UnevenText::Both { narrower, wider }),
            [one, other] => one.or(other).map(UnevenText::One),
        }
    }

    /// The degree in percent, below 0 where it is narrower, of the stretch at this arc length; `None` outside of any.
    fn variation_at(&self, abscissa_mm: f64) -> Option<f64> {
        let found = self.variations.iter().find(|found| (found.from_mm..=found.to_mm).contains(&abscissa_mm))?;
        Some(if found.kind == Kind::Narrower { -found.degree_percent } else { found.degree_percent })
    }
}
