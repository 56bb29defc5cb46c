//! What reduction does to the wire: one input on two surfaces, compared step by step.

use std::sync::Arc;

use glam::DVec3;

use super::course::{Course, TrialError, milliseconds};
use super::frame::{Progress, Summary};
use super::log::Row;
use super::session::Trial;
use super::wall::Wall;
use crate::mesh::TriMesh;
use crate::pipeline::run::fingerprint;
use web_time::Instant;

/// Length of a part of the route whose largest forces are compared, in mm.
const PART: f64 = 5.0;
/// Places where forces differ most that are told.
const PLACES: usize = 5;
/// A lumen is pinched where this part of its width, or less, is left.
const PINCHED: f64 = 0.5;

/// The difference between two trials under the same input.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Difference {
    /// One sentence.
    pub verdict: String,
    /// Length outside the guide at each row, in mm, and the distance between the two tips then.
    pub deviation: Vec<[f64; 2]>,
    /// Ways of the two tips: of the first surface, of the second.
    pub tips: [Vec<DVec3>; 2],
    /// Where along the route the largest forces differ most, and by how much in N: first less second.
    pub forces: Vec<(DVec3, f64)>,
    /// Places along the route where the first surface's lumen is pinched.
    pub pinched: Vec<DVec3>,
    /// The smallest diameter along the route, in mm: of the first surface, of the second.
    pub smallest_mm: [f64; 2],
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

impl Difference {
    /// Of a trial from another under the same input; the first is on the reduced surface.
    pub fn new(reduced: &Trial, original: &Trial) -> Self {
        let rows = [&reduced.log().rows, &original.log().rows];
        let pairs = || rows[0].iter().zip(rows[1].iter());
        let deviation: Vec<[f64; 2]> = pairs().map(|(a, b)| [b.inserted_mm, a.tip.distance(b.tip)]).collect();
        let route = &original.course().route;
        let peaks = rows.map(|rows| peaks(rows, original));
        let mut forces: Vec<(DVec3, f64)> = (peaks[0].iter().zip(&peaks[1]).enumerate())
            .map(|(part, (a, b))| (route.at((part as f64 + 0.5) * PART).at, a - b))
            .filter(|(_, difference)| difference.abs() > 1e-3)
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
        let pinched =
            route.points.iter().zip(&widths).filter(|(_, width)| is_pinched(width)).map(|(p, _)| p.at).collect();
        let least = |which: usize| 2.0 * widths.iter().map(|width| width[which]).fold(f64::INFINITY, f64::min);
        let summaries = [reduced.summary(), original.summary()];
        let most = deviation.iter().map(|entry| entry[1]).fold(0.0, f64::max);
        let verdict = verdict(&summaries, most, [reduced, original].map(Trial::progress));
        Self {
            verdict,
            deviation,
            tips: rows.map(|rows| rows.iter().map(|row| row.tip).collect()),
            forces,
            pinched,
            smallest_mm: [least(0), least(1)],
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

fn verdict([reduced, original]: &[Summary; 2], most: f64, [ends, ended]: [Progress; 2]) -> String {
    let gone = crate::pipeline::settings::reduction_percent(original.triangles, reduced.triangles);
    let path = format!("its tip path differs by {most:.1} mm at most");
    match (ends == Progress::Arrived, ended == Progress::Arrived) {
        (true, true) => format!("At {gone:.0} % this wire arrives; {path}."),
        (false, false) => {
            format!("This wire arrives on neither surface under this input; at {gone:.0} % {path}.")
        }
        (true, false) => format!(
            "At {gone:.0} % this wire arrives; under the same input it does not on the unreduced surface, and {path}."
        ),
        (false, true) => {
            format!("At {gone:.0} % this wire does not arrive, and on the unreduced surface it does; {path}.")
        }
    }
}
