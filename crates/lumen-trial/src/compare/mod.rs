//! What reduction does to the wire: one input on two surfaces, compared step by step.
//!
//! A wire in a vessel is chaotic: what buckles to this side or that, or passes an edge on this triangle or that, goes on
//! from there on another way. So two runs differ even where the surface is one and the same and only its triangles come in
//! another order. That is the noise below which a difference says nothing about reduction: it is measured by running the
//! unreduced surface against itself, [`SHUFFLES`] times in other orders ([`shuffled`]), and stands in the verdict.

mod verdict;

use std::sync::Arc;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use web_time::Instant;

use self::verdict::verdict;
pub use self::verdict::{ComparisonVerdict, PathVerdict};
use super::course::{Course, TrialError};
use super::session::Trial;
use super::summary::Summary;
use super::wall::Wall;
use lumen_mesh::{TriMesh, shuffled};
use lumen_message::{Message as _, Told};
use lumen_pipeline::results::fingerprint;
use lumen_pipeline::task::milliseconds;
use lumen_vessel::width::PINCHED;

/// Length of a part of the route whose largest forces are compared, in mm.
const PART: f64 = 5.0;
/// Forces that differ by less than this are alike, in N.
const MIN_DIFFERENCE_N: f32 = 1e-3;
/// Places where forces differ most that are told.
const PLACES: usize = 5;
/// Times that the unreduced surface is run against itself.
pub const SHUFFLES: u64 = 3;

/// How one trial's wire differs from another's under the same input.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrialComparison {
    /// One sentence.
    pub verdict: Told,
    /// Inserted length in mm at each sample.
    #[serde(with = "lumen_transfer::bulk")]
    pub inserted_mm: Vec<f32>,
    /// Distance between the two tips, in mm.
    #[serde(with = "lumen_transfer::bulk")]
    pub deviation_mm: Vec<f32>,
    /// The largest distance at each sample between the tip on the unreduced surface and on the same in another order, in
    /// mm; empty where that was not tried, and shorter than the others where the wire arrived sooner there.
    #[serde(with = "lumen_transfer::bulk")]
    pub noise_mm: Vec<f32>,
    /// How many other orders were tried, and on how many of them the wire arrived.
    pub orders: [usize; 2],
    /// The way of the tip on the level that is shown.
    #[serde(with = "lumen_transfer::bulk")]
    pub tip: Vec<[f32; 3]>,
    /// The way of the tip on the other surface.
    #[serde(with = "lumen_transfer::bulk")]
    pub other_tip: Vec<[f32; 3]>,
    /// Places where the wall's largest forces differ most, and by more than from order to order: where, and by how much in
    /// N. They are those of all balanced steps.
    pub force_differences: Vec<([f32; 3], f32)>,
    /// Places along the route where the lumen is pinched, if there are any.
    pub pinched: Vec<[f32; 3]>,
    /// The smallest diameter of the lumen along the route before reduction, in mm.
    pub smallest_before_mm: f64,
    /// And after.
    pub smallest_after_mm: f64,
    /// What came of the two.
    pub summaries: [Summary; 2],
}

impl Trial {
    /// The same trial on another surface: the same way, entry and wire, and the input that this one had.
    ///
    /// # Errors
    /// When the wire does not fit there.
    pub fn on(&self, mesh: &Arc<TriMesh>) -> Result<Self, TrialError> {
        let start = Instant::now();
        let wall = Arc::new(Wall::new(mesh.clone()));
        let own = self.course();
        let course = Course {
            wall,
            tree: own.tree.clone(),
            route: own.route.clone(),
            forks: own.forks.clone(),
            reach: own.reach,
            entries: own.entries.clone(),
            targets: own.targets.clone(),
            wall_ms: milliseconds(start),
            route_ms: 0.0,
            fingerprint: fingerprint(mesh),
        };
        let mut other = Self::new(Arc::new(course), self.setup().clone())?;
        other.replay(self.log().inputs(), self.simulation().steps());
        Ok(other)
    }
}

impl Trial {
    /// The same trial on a surface in the order that `seed` decides; see [`Self::on`].
    ///
    /// # Errors
    /// When the wire does not fit there.
    pub fn on_shuffled(&self, mesh: &TriMesh, seed: u64) -> Result<Self, TrialError> {
        self.on(&Arc::new(shuffled(mesh, seed)))
    }
}

/// How far a trial differs from itself where only the order of triangles is another.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Noise {
    /// The largest distance of the tip at each sample, in mm.
    deviation_mm: Vec<f32>,
    /// The largest difference of the largest force in each part of the route, in N.
    peaks: Vec<f32>,
    /// How many orders were tried, and on how many the wire arrived.
    orders: [usize; 2],
}

impl Noise {
    /// Takes in a run of `original` in another order.
    pub fn take(&mut self, original: &Trial, other: &Trial) {
        let grow = |all: &mut Vec<f32>, found: Vec<f32>| {
            all.resize(all.len().max(found.len()), 0.0);
            all.iter_mut().zip(found).for_each(|(most, here)| *most = most.max(here));
        };
        grow(&mut self.deviation_mm, deviations(original, other));
        let peaks = [original, other].map(peaks);
        grow(&mut self.peaks, peaks[0].iter().zip(&peaks[1]).map(|(a, b)| (a - b).abs()).collect());
        self.orders[0] += 1;
        self.orders[1] += usize::from(other.summary().success);
    }
}

/// The distance of the two tips at each sample, in mm.
fn deviations(one: &Trial, other: &Trial) -> Vec<f32> {
    one.log().rows.iter().zip(&other.log().rows).map(|(a, b)| a.tip.distance(b.tip) as f32).collect()
}

impl TrialComparison {
    /// Of a trial on the reduced surface with the same input on the original, and what that differs from itself by.
    pub fn new(reduced: &Trial, original: &Trial, noise: &Noise) -> Self {
        let plain = |p: DVec3| p.as_vec3().to_array();
        let rows = [&reduced.log().rows, &original.log().rows];
        let route = &original.course().route;
        let peaks = [reduced, original].map(peaks);
        let least = |part: usize| noise.peaks.get(part).map_or(MIN_DIFFERENCE_N, |noise| noise.max(MIN_DIFFERENCE_N));
        let mut forces: Vec<([f32; 3], f32)> = (peaks[0].iter().zip(&peaks[1]).enumerate())
            .filter(|(part, (a, b))| (*a - *b).abs() > least(*part))
            .map(|(part, (a, b))| (plain(route.at((part as f64 + 0.5) * PART).at), a - b))
            .collect();
        forces.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        forces.truncate(PLACES);
        let clear = |trial: &Trial, p: DVec3| {
            trial
                .course()
                .wall
                .index()
                .project_point(p, f64::INFINITY, u32::MAX)
                .map_or(0.0, |projection| projection.distance)
        };
        let widths: Vec<[f64; 2]> =
            route.points.iter().map(|p| [clear(reduced, p.at), clear(original, p.at)]).collect();
        let wire = reduced.wire().radius();
        let is_pinched = |width: &[f64; 2]| width[0] < f64::from(PINCHED) * width[1] || width[0] < wire;
        let pinched = route.points.iter().zip(&widths).filter(|(_, width)| is_pinched(width));
        let least = |which: usize| 2.0 * widths.iter().map(|width| width[which]).fold(f64::INFINITY, f64::min);
        let summaries = [reduced.summary(), original.summary()];
        let deviation_mm = deviations(reduced, original);
        let mut noise_mm = noise.deviation_mm.clone();
        noise_mm.truncate(deviation_mm.len());
        // Judged as far as the runs in other orders went.
        let judged = if noise.orders[0] > 0 { &deviation_mm[..noise_mm.len()] } else { &deviation_mm[..] };
        Self {
            verdict: verdict(&summaries, [judged, &noise_mm].map(largest), noise.orders).told(),
            inserted_mm: rows[0].iter().zip(rows[1]).map(|(_, b)| b.inserted_mm as f32).collect(),
            deviation_mm,
            noise_mm,
            orders: noise.orders,
            tip: rows[0].iter().map(|row| plain(row.tip)).collect(),
            other_tip: rows[1].iter().map(|row| plain(row.tip)).collect(),
            force_differences: forces,
            pinched: pinched.map(|(p, _)| plain(p.at)).collect(),
            smallest_before_mm: least(1),
            smallest_after_mm: least(0),
            summaries,
        }
    }
}

fn largest(all: &[f32]) -> f32 {
    all.iter().copied().fold(0.0, f32::max)
}

/// The largest force in each part of the route, in N.
fn peaks(trial: &Trial) -> Vec<f32> {
    let route = &trial.course().route;
    let mut peaks = vec![0.0f32; (route.length_mm / PART) as usize + 1];
    for touch in trial.felt().peaks() {
        let part = (route.locate(DVec3::from(touch.at.map(f64::from))).arc_mm / PART) as usize;
        if let Some(peak) = peaks.get_mut(part) {
            *peak = peak.max(touch.force);
        }
    }
    peaks
}
