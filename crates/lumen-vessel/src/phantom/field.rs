//! Which grid points lie in a lumen: a smooth union of tapered capsules, asked for row by row.
//!
//! The lumen of a vessel is the union of round cones along its centreline. Where two vessels meet, their distances
//! `a` and `b` are joined by the polynomial smooth minimum (Quilez 2013)
//!
//! ```text
//! h = max(k - |a - b|, 0),   d = min(a, b) - h^2 / (4 k)
//! ```
//!
//! which rounds the crotch with a fillet of about `k` and leaves all else alone. The result never changes faster
//! than the steepest cone, so along a row a sample at distance `d` decides all points nearer than `d`: as in sphere
//! tracing (Hart 1996) only the few points near the wall are ever computed. Addition, multiplication, division and
//! square roots are all it takes, which are the same on every platform.

use std::ops::Range;

use glam::DVec3;

use super::vessel::Vessel;
use lumen_volume::{Geometry, Mask};

/// Share of a branch's radius that the fillet at its origin has.
const FILLET: f64 = 0.45;
/// Voxels by which the tube goes on behind an open end, for the cut to pass through tube alone.
const OVERHANG: f64 = 1.5;

/// The thinnest tube in voxels of radius: any thinner and the mask falls apart into beads.
const THINNEST: f64 = 0.9;

/// A sphere that widens a vessel: a sinus of the aortic root.
pub(super) struct Bulge {
    pub(super) centre: DVec3,
    pub(super) radius: f64,
    pub(super) fillet: f64,
}

/// A round cone: the points nearer to the segment than a radius that changes linearly along it.
struct Cone {
    part: usize,
    start: DVec3,
    along: DVec3,
    inverse_squared_length: f64,
    radius: f64,
    radius_change: f64,
    min: DVec3,
    max: DVec3,
}

impl Cone {
    fn new(part: usize, [start, end]: [DVec3; 2], [radius, end_radius]: [f64; 2]) -> Self {
        let along = end - start;
        let squared = along.length_squared();
        Self {
            part,
            start,
            along,
            inverse_squared_length: if squared > 0.0 { 1.0 / squared } else { 0.0 },
            radius,
            radius_change: end_radius - radius,
            min: (start - radius).min(end - end_radius),
            max: (start + radius).max(end + end_radius),
        }
    }

    /// Distance in mm to the surface of the cone, negative inside.
    fn distance(&self, point: DVec3) -> f64 {
        let from = point - self.start;
        let t = (from.dot(self.along) * self.inverse_squared_length).clamp(0.0, 1.0);
        (from - self.along * t).length() - (self.radius + self.radius_change * t)
    }
}

/// An open end: cubes are left out in the cylinder that begins at `point` and holds the tube's overhang.
struct OpenEnd {
    point: DVec3,
    outward: DVec3,
    length: f64,
    radius: f64,
}

impl OpenEnd {
    /// Whether the cylinder, grown by `clearance` mm, holds the point.
    fn holds(&self, point: DVec3, clearance: f64) -> bool {
        let from = point - self.point;
        let height = from.dot(self.outward);
        let radius = self.radius + clearance;
        height > -clearance
            && height < self.length + clearance
            && from.length_squared() - height * height < radius * radius
    }
}

/// The lumen of a vessel tree with open ends, as it is sampled at one spacing.
pub(super) struct Field {
    /// Cones by part, in the order in which the parts are joined.
    cones: Vec<Cone>,
    fillets: Vec<f64>,
    open_ends: Vec<OpenEnd>,
    spacing: DVec3,
    /// Beyond this distance in mm no cone touches the sign of the whole.
    margin: f64,
    /// The most that the distance changes in 1 mm.
    slope: f64,
}

impl Field {
    /// The lumen of `vessels`, widened by `bulges`, for a grid of the given spacing (mm). Vessels that are thinner
    /// than the grid can show are widened to what it can, so that the tree stays whole on a coarse grid.
    pub(super) fn new(vessels: &[Vessel], bulges: &[Bulge], spacing: DVec3) -> Self {
        let voxel = spacing.max_element();
        let mut field =
            Self { cones: Vec::new(), fillets: Vec::new(), open_ends: Vec::new(), spacing, margin: 0.0, slope: 1.0 };
        for vessel in vessels {
            let ostium = vessel.stations[vessel.ostium].diameter / 2.0;
            field.begin_part(if vessel.parent.is_some() { FILLET * ostium } else { 0.0 });
            let radius_at = |i: usize| (vessel.stations[i].diameter / 2.0).max(THINNEST * voxel);
            for (i, pair) in vessel.stations.windows(2).enumerate() {
                field.add([pair[0].position, pair[1].position], [radius_at(i), radius_at(i + 1)]);
            }
            let last = vessel.stations.len() - 1;
            let ends = [(vessel.open_start, 0, -1.0), (vessel.open_end, last, 1.0)];
            for (_, i, sign) in ends.into_iter().filter(|end| end.0) {
                let (point, radius) = (vessel.stations[i].position, radius_at(i));
                let outward = vessel.direction(i) * sign;
                field.add([point, point + outward * (OVERHANG * voxel)], [radius, radius]);
                let (length, radius) = (radius + (OVERHANG + 1.0) * voxel, radius + voxel);
                field.open_ends.push(OpenEnd { point, outward, length, radius });
            }
        }
        for bulge in bulges {
            field.begin_part(bulge.fillet);
            field.add([bulge.centre; 2], [bulge.radius; 2]);
        }
        field
    }

    /// Begins a part that is joined to all before it with the given fillet (mm).
    pub(super) fn begin_part(&mut self, fillet: f64) {
        self.fillets.push(fillet);
        self.margin = self.margin.max(fillet);
    }

    /// Adds a round cone to the part begun last.
    pub(super) fn add(&mut self, ends: [DVec3; 2], radii: [f64; 2]) {
        let cone = Cone::new(self.fillets.len() - 1, ends, radii);
        let taper = cone.radius_change * cone.radius_change * cone.inverse_squared_length;
        self.slope = self.slope.max((1.0 + taper).sqrt());
        self.cones.push(cone);
    }

    /// Bound on the distance in mm from `point` to the wall, negative in the lumen.
    pub(super) fn distance(&self, point: DVec3) -> f64 {
        self.join(self.cones.iter(), point)
    }

    /// Whether the point lies in the part of an open end that is cut away, or within `clearance` mm of it.
    pub(super) fn is_behind_an_end(&self, point: DVec3, clearance: f64) -> bool {
        self.open_ends.iter().any(|end| end.holds(point, clearance))
    }

    fn join<'a>(&'a self, cones: impl Iterator<Item = &'a Cone>, point: DVec3) -> f64 {
        let (mut whole, mut of_part, mut part) = (f64::INFINITY, f64::INFINITY, 0);
        for cone in cones {
            if cone.part != part {
                whole = smooth_min(whole, of_part, self.fillets[part]);
                (of_part, part) = (f64::INFINITY, cone.part);
            }
            of_part = of_part.min(cone.distance(point));
        }
        smooth_min(whole, of_part, self.fillets.get(part).copied().unwrap_or(0.0))
    }

    /// The grid that holds the lumen.
    pub(super) fn grid(&self) -> Geometry {
        let (mut min, mut max) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for cone in &self.cones {
            min = min.min(cone.min);
            max = max.max(cone.max);
        }
        Geometry::around(min - self.margin, max + self.margin, self.spacing)
    }

    /// The lumen as a mask over `grid`.
    pub(super) fn mask<'a>(&'a self, grid: &'a Geometry) -> FieldMask<'a> {
        FieldMask { field: self, grid, k: 0, in_slice: Vec::new(), in_row: Vec::new(), spans: Vec::new() }
    }
}

/// The smaller of two distances, rounded by `k` where they are about equal.
fn smooth_min(a: f64, b: f64, k: f64) -> f64 {
    let h = k - (a - b).abs();
    if h > 0.0 { a.min(b) - h * h / (4.0 * k) } else { a.min(b) }
}

/// [`Field`] sampled on a grid.
pub(super) struct FieldMask<'a> {
    field: &'a Field,
    grid: &'a Geometry,
    k: usize,
    in_slice: Vec<&'a Cone>,
    in_row: Vec<&'a Cone>,
    spans: Vec<Range<usize>>,
}

impl Mask for FieldMask<'_> {
    const CLOSED: bool = true;

    fn begin_slice(&mut self, k: usize) {
        self.k = k;
        let (z, margin) = (self.grid.at(0.0, 0.0, k as f64).z, self.field.margin);
        self.in_slice.clear();
        self.in_slice.extend(self.field.cones.iter().filter(|c| c.min.z - margin <= z && z <= c.max.z + margin));
    }

    fn row(&mut self, j: usize, runs: &mut Vec<Range<usize>>) {
        let first = self.grid.at(0.0, j as f64, self.k as f64);
        let (y, dx, margin) = (first.y, self.grid.spacing.x, self.field.margin);
        self.in_row.clear();
        self.in_row.extend(self.in_slice.iter().filter(|c| c.min.y - margin <= y && y <= c.max.y + margin));
        if self.in_row.is_empty() {
            return;
        }
        self.spans.clear();
        self.spans.extend(self.in_row.iter().map(|cone| {
            // The grid is padded beyond the margin, so neither end leaves it.
            let start = (cone.min.x - margin - first.x) / dx;
            let end = (cone.max.x + margin - first.x) / dx;
            start as usize..end as usize + 1
        }));
        self.spans.sort_unstable_by_key(|span| span.start);
        let first_run = runs.len();
        let mut i = 0;
        for span in &self.spans {
            i = i.max(span.start);
            while i < span.end {
                let point = DVec3::new(first.x + dx * i as f64, y, first.z);
                let distance = self.field.join(self.in_row.iter().copied(), point);
                // Points this near have the same sign; a hair less, for rounding.
                let next = i + 1 + (distance.abs() * 0.999 / (self.field.slope * dx)) as usize;
                if distance < 0.0 {
                    match runs[first_run..].last_mut() {
                        Some(run) if run.end == i => run.end = next,
                        _ => runs.push(i..next),
                    }
                }
                i = next;
            }
        }
    }

    fn has_cuts(&mut self, k: usize) -> bool {
        let z = self.grid.at(0.0, 0.0, k as f64 + 0.5).z;
        self.field.open_ends.iter().any(|end| (end.point.z - z).abs() < end.length + end.radius)
    }

    fn is_cut(&self, centre: DVec3) -> bool {
        self.field.is_behind_an_end(centre, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::vessel::{Distal, Tree};
    use super::*;

    /// A tapering trunk with an oblique branch.
    fn fork() -> Field {
        let mut tree = Tree::default();
        tree.trunk("trunk", Distal::Open, &[[0.0, 0.0, 40.0, 14.0], [2.0, 1.0, 20.0, 12.0], [0.0, 0.0, 0.0, 8.0]]);
        tree.branch("side", "trunk", Distal::Open, &[[1.0, 1.0, 22.0, 5.0], [15.0, 6.0, 12.0, 4.0]]);
        let bulge = Bulge { centre: DVec3::new(-5.0, 0.0, 25.0), radius: 4.0, fillet: 2.0 };
        Field::new(&tree.vessels, &[bulge], DVec3::new(0.7, 0.7, 0.9))
    }

    #[test]
    fn rows_agree_with_every_point_computed_alone() {
        let field = fork();
        let grid = field.grid();
        let mut mask = field.mask(&grid);
        let mut inside = 0;
        // Rows are appended to what is there already, as marching cubes asks for them.
        let mut runs = Vec::new();
        for k in 0..grid.size[2] {
            mask.begin_slice(k);
            for j in 0..grid.size[1] {
                let first = runs.len();
                mask.row(j, &mut runs);
                let runs = &runs[first..];
                assert!(runs.windows(2).all(|w| w[0].end <= w[1].start));
                for i in 0..grid.size[0] {
                    let expected = field.distance(grid.at(i as f64, j as f64, k as f64)) < 0.0;
                    assert_eq!(runs.iter().any(|run| run.contains(&i)), expected, "point {i} {j} {k}");
                    inside += usize::from(expected);
                }
            }
        }
        assert!(inside > 5000);
    }

    #[test]
    fn a_cone_is_a_tapered_tube() {
        let cone = Cone::new(0, [DVec3::ZERO, DVec3::new(0.0, 0.0, 10.0)], [4.0, 2.0]);
        assert_eq!(cone.distance(DVec3::new(5.0, 0.0, 5.0)), 2.0);
        assert_eq!(cone.distance(DVec3::new(0.0, 0.0, -5.0)), 1.0);
        assert_eq!(cone.distance(DVec3::new(0.0, 0.0, 10.0)), -2.0);
    }

    #[test]
    fn the_fillet_is_deepest_where_both_are_equal_and_ends_where_they_differ_by_k() {
        assert_eq!(smooth_min(1.0, 1.0, 2.0), 0.5);
        assert_eq!(smooth_min(1.0, 3.0, 2.0), 1.0);
        assert_eq!(smooth_min(f64::INFINITY, f64::INFINITY, 2.0), f64::INFINITY);
        assert_eq!(smooth_min(2.0, 1.0, 0.0), 1.0);
    }
}
