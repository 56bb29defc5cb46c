//! Vessels: centrelines with diameters, and how they branch.
//!
//! A course is drawn as a few control points and run through them with a centripetal Catmull-Rom spline (Catmull
//! and Rom 1974; centripetal knots after Yuksel, Schaefer and Keyser 2011, evaluated by Barry and Goldman's pyramid
//! 1988), which neither overshoots nor forms cusps between unevenly spaced points. The diameter is the fourth
//! coordinate of the same spline, so it tapers as smoothly as the course bends.

use glam::{DVec3, DVec4, Vec4Swizzles};

/// A place on a vessel's centreline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Position in mm.
    pub position: DVec3,
    /// Diameter of the lumen in mm.
    pub diameter: f64,
}

/// A vessel of a sample: its centreline from the proximal to the distal end.
#[derive(Clone, Debug, PartialEq)]
pub struct Vessel {
    /// What anatomy calls it, in lower case.
    pub name: &'static str,
    /// The vessel it branches from, by its place in the list (always an earlier one); `None` for the trunk.
    pub parent: Option<usize>,
    /// The centreline, at steps of at most 3 mm. That of a branch begins on its parent's centreline.
    pub stations: Vec<Station>,
    /// The first station outside the parent's lumen: the branch's ostium is there. 0 for the trunk.
    pub ostium: usize,
    /// Whether the surface is open at the first station, cut square to the centreline.
    pub open_start: bool,
    /// Whether the surface is open at the last station, cut square to the centreline. A vessel that is not open
    /// there divides into its branches.
    pub open_end: bool,
}

impl Vessel {
    /// Length of the centreline in mm, from the first station.
    pub fn length(&self) -> f64 {
        self.stations.windows(2).map(|pair| pair[0].position.distance(pair[1].position)).sum()
    }

    /// Direction of the centreline at station `i`, distally, of unit length.
    ///
    /// # Panics
    /// When there is no station `i`.
    pub fn direction(&self, i: usize) -> DVec3 {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(self.stations.len() - 1));
        let along = self.stations[after].position - self.stations[before].position;
        along / along.length()
    }

    /// The station nearest to a point, and its distance in mm.
    fn nearest(&self, point: DVec3) -> (usize, f64) {
        let mut best = (0, f64::INFINITY);
        for (i, station) in self.stations.iter().enumerate() {
            let distance = station.position.distance(point);
            if distance < best.1 {
                best = (i, distance);
            }
        }
        best
    }
}

/// What a vessel does at its distal end.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Distal {
    /// It leaves the volume: the surface is open there.
    Open,
    /// It divides into branches that are drawn as vessels of their own.
    Divides,
}

/// Vessels under construction, parents before branches.
#[derive(Default)]
pub(super) struct Tree {
    pub(super) vessels: Vec<Vessel>,
}

impl Tree {
    /// Adds the trunk, open where it begins, through control points x, y, z, diameter (mm).
    pub(super) fn trunk(&mut self, name: &'static str, distal: Distal, control: &[[f64; 4]]) {
        let control: Vec<DVec4> = control.iter().copied().map(DVec4::from).collect();
        let open_end = distal == Distal::Open;
        let stations = course(&control);
        self.vessels.push(Vessel { name, parent: None, stations, ostium: 0, open_start: true, open_end });
    }

    /// Adds a branch through control points x, y, z, diameter (mm); the first is moved onto the centreline of
    /// `parent`, to its nearest station.
    ///
    /// # Panics
    /// When there is no vessel named `parent` yet.
    pub(super) fn branch(&mut self, name: &'static str, parent: &str, distal: Distal, control: &[[f64; 4]]) {
        let mut control: Vec<DVec4> = control.iter().copied().map(DVec4::from).collect();
        let parent = self.vessels.iter().position(|v| v.name == parent).expect("a parent comes before its branches");
        let trunk = &self.vessels[parent];
        let root = trunk.stations[trunk.nearest(control[0].xyz()).0];
        control[0] = root.position.extend(control[0].w);
        let stations = course(&control);
        let leaves = |s: &Station| {
            let (i, distance) = trunk.nearest(s.position);
            distance >= trunk.stations[i].diameter / 2.0
        };
        let ostium = stations.iter().position(leaves).unwrap_or(stations.len() - 1);
        let open_end = distal == Distal::Open;
        self.vessels.push(Vessel { name, parent: Some(parent), stations, ostium, open_start: false, open_end });
    }
}

/// Stations along the spline through `control` (x, y, z, diameter), about half a radius apart.
fn course(control: &[DVec4]) -> Vec<Station> {
    let n = control.len();
    // End tangents come from points mirrored in the ends.
    let before = control[0] * 2.0 - control[1];
    let after = control[n - 1] * 2.0 - control[n - 2];
    let at = |i: usize| match i {
        0 => before,
        i if i > n => after,
        i => control[i - 1],
    };
    let mut stations = Vec::new();
    for span in 1..n {
        let points = [at(span - 1), at(span), at(span + 1), at(span + 2)];
        let chord = points[1].xyz().distance(points[2].xyz());
        let step = (points[1].w.min(points[2].w) / 4.0).clamp(0.4, 2.5);
        let steps = libm::ceil(chord / step).max(1.0) as usize;
        stations.extend((0..steps).map(|s| spline(points, s as f64 / steps as f64)).map(station));
    }
    stations.push(station(control[n - 1]));
    stations
}

fn station(at: DVec4) -> Station {
    Station { position: at.xyz(), diameter: at.w }
}

/// The centripetal Catmull-Rom span from `p[1]` (at 0) to `p[2]` (at 1).
fn spline(p: [DVec4; 4], along: f64) -> DVec4 {
    let mut knots = [0.0; 4];
    for i in 1..4 {
        knots[i] = knots[i - 1] + p[i].xyz().distance(p[i - 1].xyz()).sqrt();
    }
    let t = knots[1] + along * (knots[2] - knots[1]);
    let mix = |a: DVec4, b: DVec4, from: f64, to: f64| a * ((to - t) / (to - from)) + b * ((t - from) / (to - from));
    let a = [0, 1, 2].map(|i| mix(p[i], p[i + 1], knots[i], knots[i + 1]));
    let b = [0, 1].map(|i| mix(a[i], a[i + 1], knots[i], knots[i + 2]));
    mix(b[0], b[1], knots[1], knots[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_course_passes_through_its_control_points_and_stays_straight_on_a_line() {
        let control = [[0.0, 0.0, 0.0, 6.0], [10.0, 0.0, 0.0, 5.0], [14.0, 0.0, 0.0, 4.0], [30.0, 0.0, 0.0, 3.0]];
        let stations = course(&control.map(DVec4::from));
        for point in control.map(DVec4::from) {
            assert!(stations.iter().any(|s| s.position.distance(point.xyz()) < 1e-12 && s.diameter == point.w));
        }
        assert!(stations.iter().all(|s| s.position.y == 0.0 && s.position.z == 0.0));
        assert!(stations.windows(2).all(|w| w[0].position.x < w[1].position.x && w[0].diameter >= w[1].diameter));
    }

    #[test]
    fn a_branch_begins_on_its_parent_and_has_its_ostium_at_the_wall() {
        let mut tree = Tree::default();
        tree.trunk("trunk", Distal::Open, &[[0.0, 0.0, 50.0, 20.0], [0.0, 0.0, 0.0, 20.0]]);
        tree.branch("side", "trunk", Distal::Open, &[[1.0, 1.0, 25.2, 5.0], [40.0, 0.0, 25.0, 4.0]]);
        let side = &tree.vessels[1];
        assert_eq!(side.parent, Some(0));
        assert_eq!(side.stations[0].position.truncate(), glam::DVec2::ZERO);
        assert!((side.stations[side.ostium].position.x - 10.0).abs() < 1.5);
        assert!((side.length() - 40.0).abs() < 0.1);
        assert!(side.direction(3).x > 0.99);
    }
}
