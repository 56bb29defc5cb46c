//! Stations along the branches of a tree: places that are near enough to each other to say what a vessel is in between.

use std::ops::Range;

use glam::DVec3;

use super::caps::{ExtendedLine, extended_to_caps};
use super::centreline::{Place, arcs, direction};
use super::tree::Tree;

/// Most and least distance of stations in mm (moved to the middle, they stay within 1 mm), and the part of the branch's mean
/// radius that it is between the two.
const FARTHEST_MM: f64 = 0.9;
const NEAREST_MM: f64 = 0.2;
const SPACING: f64 = 0.3;

/// A place on a branch's centreline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// In mm.
    pub at: DVec3,
    /// The way of the centreline there, of length 1.
    pub direction: DVec3,
    /// Arc length from the first station of the branch, in mm.
    pub abscissa_mm: f64,
    /// Radius of the largest ball inside there, in mm.
    pub radius_mm: f64,
}

/// The stations of all branches, those of a branch in a row.
#[derive(Clone, Debug, Default)]
pub struct Stations {
    /// All.
    pub all: Vec<Station>,
    /// Those of each branch.
    pub of: Vec<Range<usize>>,
    /// By how many mm each branch begins before its first point, at the cap that closes it there.
    pub before_mm: Vec<f64>,
    /// The vessel's radius in mm at both ends of each branch, where that is at a cap.
    pub(super) caps: Vec<[Option<f64>; 2]>,
}

impl Stations {
    /// Of a tree: at both ends of each branch, at the caps where it is closed, and no farther than 1 mm from each other.
    pub(super) fn new(tree: &Tree) -> Self {
        let mut stations = Self::default();
        for branch in tree.branches() {
            let first = stations.all.len();
            let ExtendedLine { points, before_mm, caps } = extended_to_caps(&tree.space, tree.branches(), branch);
            along(&points, &mut stations.all);
            stations.of.push(first..stations.all.len());
            stations.before_mm.push(before_mm);
            stations.caps.push(caps);
        }
        stations
    }
}

fn along(points: &[Place], all: &mut Vec<Station>) {
    let arcs = arcs(points);
    let directions: Vec<DVec3> = (0..points.len()).map(|i| direction(points, i)).collect();
    let length = arcs.last().copied().unwrap_or(0.0);
    let mean = points.iter().map(|place| place.radius).sum::<f64>() / points.len().max(1) as f64;
    let spacing = (SPACING * mean).clamp(NEAREST_MM, FARTHEST_MM);
    let steps = (length / spacing).ceil().max(1.0) as usize;
    if points.len() < 2 || length <= 0.0 {
        let station = |at: &Place| Station { at: at.at, direction: DVec3::Z, abscissa_mm: 0.0, radius_mm: at.radius };
        all.extend(points.first().map(station));
        return;
    }
    let mut next = 1;
    for step in 0..=steps {
        let arc = length * step as f64 / steps as f64;
        while next + 1 < points.len() && arcs[next] < arc {
            next += 1;
        }
        let part = ((arc - arcs[next - 1]) / (arcs[next] - arcs[next - 1]).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let (from, to) = (points[next - 1], points[next]);
        all.push(Station {
            at: from.at.lerp(to.at, part),
            direction: directions[next - 1].lerp(directions[next], part).normalize_or(directions[next - 1]),
            abscissa_mm: arc,
            radius_mm: from.radius + (to.radius - from.radius) * part,
        });
    }
}
