//! What reduction does to the wire: one input on two surfaces, compared step by step.

use std::sync::Arc;

use glam::DVec3;
use serde::{Deserialize, Serialize};
use web_time::Instant;

use super::course::{Course, TrialError};
use super::frame::Summary;
use super::log::Row;
use super::session::Trial;
use super::wall::Wall;
use crate::mesh::TriMesh;
use crate::pipeline::results::fingerprint;
use crate::pipeline::settings::reduction_percent;
use crate::pipeline::task::milliseconds;

/// Length of a part of the route whose largest forces are compared, in mm.
const PART: f64 = 5.0;
/// Forces that differ by less than this are alike, in N.
const LEAST: f32 = 1e-3;
/// Places where forces differ most that are told.
const PLACES: usize = 5;
/// A lumen is pinched where this part of its width, or less, is left.
const PINCHED: f64 = 0.5;

/// How one trial's wire differs from another's under the same input.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrialComparison {
    /// One sentence.
    pub verdict: String,
    /// Inserted length in mm at each sample.
    pub inserted_mm: Vec<f32>,
    /// Distance between the two tips, in mm.
    pub deviation_mm: Vec<f32>,
    /// The way of the tip on the level that is shown.
    pub tip: Vec<[f32; 3]>,
    /// The way of the tip on the other surface.
    pub other_tip: Vec<[f32; 3]>,
    /// Places where the wall's forces differ most: where, and by how much in N.
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

impl TrialComparison {
    /// Of a trial on the reduced surface with the same input on the original.
    pub fn new(reduced: &Trial, original: &Trial) -> Self {
        let plain = |p: DVec3| p.as_vec3().to_array();
        let rows = [&reduced.log().rows, &original.log().rows];
        let pairs = || rows[0].iter().zip(rows[1].iter());
        let route = &original.course().route;
        let peaks = rows.map(|rows| peaks(rows, original));
        let mut forces: Vec<([f32; 3], f32)> = (peaks[0].iter().zip(&peaks[1]).enumerate())
            .map(|(part, (a, b))| (plain(route.at((part as f64 + 0.5) * PART).at), (a - b) as f32))
            .filter(|(_, difference)| difference.abs() > LEAST)
            .collect();
        forces.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        forces.truncate(PLACES);
        let clear = |trial: &Trial, p: DVec3| {
            trial.course().wall.index().foot(p, f64::INFINITY, u32::MAX).map_or(0.0, |foot| foot.distance)
        };
        let widths: Vec<[f64; 2]> =
            route.points.iter().map(|p| [clear(reduced, p.at), clear(original, p.at)]).collect();
        let wire = reduced.setup().wire.radius();
        let is_pinched = |width: &[f64; 2]| width[0] < PINCHED * width[1] || width[0] < wire;
        let pinched = route.points.iter().zip(&widths).filter(|(_, width)| is_pinched(width));
        let least = |which: usize| 2.0 * widths.iter().map(|width| width[which]).fold(f64::INFINITY, f64::min);
        let summaries = [reduced.summary(), original.summary()];
        let deviation_mm: Vec<f32> = pairs().map(|(a, b)| a.tip.distance(b.tip) as f32).collect();
        let most = deviation_mm.iter().copied().fold(0.0, f32::max);
        Self {
            verdict: verdict(&summaries, most),
            inserted_mm: pairs().map(|(_, b)| b.inserted_mm as f32).collect(),
            deviation_mm,
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

/// The largest force in each part of the route.
fn peaks(rows: &[Row], trial: &Trial) -> Vec<f64> {
    let route = &trial.course().route;
    let mut peaks = vec![0.0f64; (route.length_mm / PART) as usize + 1];
    for row in rows.iter().filter(|row| row.max_wall_force_n > 0.0) {
        let part = (route.locate(row.max_at).arc_mm / PART) as usize;
        if let Some(peak) = peaks.get_mut(part) {
            *peak = peak.max(row.max_wall_force_n);
        }
    }
    peaks
}

fn verdict([reduced, original]: &[Summary; 2], most: f32) -> String {
    let gone = reduction_percent(original.triangles, reduced.triangles);
    let path = format!("its tip path differs by {most:.1} mm at most");
    match (reduced.success, original.success) {
        (true, true) => format!("At {gone:.0} % this wire arrives; {path}."),
        (false, false) => format!("This wire arrives on neither surface under this input; at {gone:.0} % {path}."),
        (true, false) => format!(
            "At {gone:.0} % this wire arrives; under the same input it does not on the unreduced surface, and {path}."
        ),
        (false, true) => {
            format!("At {gone:.0} % this wire does not arrive, and on the unreduced surface it does; {path}.")
        }
    }
}
