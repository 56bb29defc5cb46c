//! Checks of a trial from outside: how deep a wire reaches into the wall, which side of the wall a point is on, whether a
//! lumen is open for a wire at all.
//!
//! All of it in f64, by plain methods over a grid of its own: nothing here is shared with the contact solver or with the
//! index that it asks, so that neither can hide the other's mistakes.

mod segment;
mod sides;
mod wall;

use glam::DVec3;
use thiserror::Error;

pub use segment::segment_to_triangle;

use lumen_mesh::TriMesh;
use sides::Sides;
use wall::Wall;

/// What a lumen must have to spare beside the wire, as a part of the wire's radius, to count as open.
pub const MARGIN: f64 = 0.05;

/// A place where a wire does not fit.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "the lumen is {lumen_mm:.3} mm wide at ({:.1}, {:.1}, {:.1}), {arc_mm:.1} mm along, and a wire of {wire_mm:.3} mm needs \
     {needed_mm:.3} mm",
    at.x, at.y, at.z
)]
pub struct Shut {
    /// Where, in mm.
    pub at: DVec3,
    /// Length along the route up to there, in mm.
    pub arc_mm: f64,
    /// Diameter of the largest ball that fits there, in mm.
    pub lumen_mm: f64,
    /// Diameter of the wire in mm.
    pub wire_mm: f64,
    /// What it needs, with the margin, in mm.
    pub needed_mm: f64,
}

/// A surface to check against.
#[derive(Clone, Debug)]
pub struct Audit {
    wall: Wall,
    sides: Sides,
}

impl Audit {
    /// Of a surface; time and memory grow with its triangles. Triangles with a coordinate that is not finite are left out.
    pub fn new(mesh: &TriMesh) -> Self {
        let corners = |&[a, b, c]: &[u32; 3]| [a, b, c].map(|v| mesh.positions[v as usize].as_dvec3());
        let is_finite = |triangle: &[DVec3; 3]| triangle.iter().all(|p| p.is_finite());
        let triangles: Vec<[DVec3; 3]> = mesh.triangles.iter().map(corners).filter(is_finite).collect();
        Self { sides: Sides::new(mesh, &triangles), wall: Wall::new(triangles) }
    }

    /// How far a wire of this radius, a row of capsules between `nodes`, reaches into the wall, in mm: the radius less the
    /// smallest distance of the wire's axis from the surface. 0 if it is clear of it; the radius if the
    /// axis crosses it; infinite if a node is not finite.
    pub fn penetration(&self, nodes: &[DVec3], radius: f64) -> f64 {
        if nodes.iter().any(|p| !p.is_finite()) {
            return f64::INFINITY;
        }
        let one = |[p, q]: [DVec3; 2]| self.wall.distance(p, q, radius);
        let least = match nodes {
            [] => f64::INFINITY,
            &[p] => one([p, p]),
            _ => nodes.windows(2).map(|pair| one([pair[0], pair[1]])).fold(f64::INFINITY, f64::min),
        };
        (radius - least).max(0.0)
    }

    /// Distance of a point from the surface in mm, if it is at most `farthest`.
    pub fn distance(&self, p: DVec3, farthest: f64) -> Option<f64> {
        let found = self.wall.distance(p, p, farthest);
        found.is_finite().then_some(found)
    }

    /// How often the surface, its open ends capped, goes around `p`: about 1 inside, about 0 outside.
    pub fn winding(&self, p: DVec3) -> f64 {
        self.sides.winding(p)
    }

    /// Whether a wire of this diameter fits through a lumen along `route`: at points a quarter of the wire's diameter apart
    /// or closer, the largest ball with its middle straight beside the point must be larger than the wire by [`MARGIN`] of
    /// its radius, and have its middle inside.
    ///
    /// # Errors
    /// [`Shut`], the first place where it does not fit.
    pub fn is_open(&self, route: &[DVec3], wire_mm: f64) -> Result<(), Shut> {
        let needed = wire_mm / 2.0 * (1.0 + MARGIN);
        let mut arc_mm = 0.0;
        for (i, &to) in route.iter().enumerate() {
            let from = if i > 0 { route[i - 1] } else { to };
            let length = from.distance(to);
            let steps = (length / (wire_mm / 4.0)).ceil().clamp(1.0, 1e6) as usize;
            for step in 1..=steps {
                let part = step as f64 / steps as f64;
                let p = from.lerp(to, part);
                let (middle, clear) = self.widest(p, to - from, needed);
                let clear = if self.winding(middle) > 0.5 { clear } else { 0.0 };
                if clear < needed {
                    let arc_mm = arc_mm + length * part;
                    return Err(Shut { at: p, arc_mm, lumen_mm: 2.0 * clear, wire_mm, needed_mm: 2.0 * needed });
                }
            }
            arc_mm += length;
        }
        Ok(())
    }

    /// The largest ball with its middle beside `p`, across `along`, or the first found that is large enough. The middle
    /// goes where the wall is farther, by half of its distance or less, so it stays on its side of the wall, and not
    /// farther from `p` than `enough` and the first distance together.
    fn widest(&self, p: DVec3, along: DVec3, enough: f64) -> (DVec3, f64) {
        let first = self.wall.clearance(p);
        let (mut middle, mut clear) = (p, first);
        let (x, y) = along.normalize_or(DVec3::Z).any_orthonormal_pair();
        let mut step = 0.5;
        while clear < enough && step > 1e-3 {
            let ways = WAYS.map(|[a, b]| middle + (x * a + y * b).normalize() * (step * clear));
            let better = ways
                .into_iter()
                .map(|next| (next, self.wall.clearance(next)))
                .find(|(next, found)| *found > clear * (1.0 + 1e-6) && next.distance(p) <= first + enough);
            match better {
                Some(found) => (middle, clear) = found,
                None => step /= 2.0,
            }
        }
        (middle, clear)
    }
}

/// Eight ways across.
const WAYS: [[f64; 2]; 8] =
    [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [0.0, -1.0], [1.0, -1.0]];

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::Vec3;
    use lumen_mesh::shapes::{icosphere, tube};

    fn waisted() -> TriMesh {
        tube(64, 400, 40.0, |z| 1.0 - 0.8 * (-(z - 20.0) * (z - 20.0)).exp())
    }

    fn axis(offset: f64) -> Vec<DVec3> {
        (2..=38).map(|z| DVec3::new(offset, 0.0, f64::from(z))).collect()
    }

    #[test]
    fn a_wire_reaches_as_deep_as_its_offset_says() {
        // The flat sides of the tube lie up to 0.12 % nearer than its radius.
        let audit = Audit::new(&tube(64, 80, 40.0, |_| 1.0));
        for (offset, radius, expected) in [(0.0, 0.2, 0.0), (0.7, 0.2, 0.0), (0.9, 0.2, 0.1), (0.99, 0.2, 0.19)] {
            let found = audit.penetration(&axis(offset), radius);
            assert!((found - expected).abs() < 2e-3, "{offset}: {found}");
        }
        // Through the wall, and a long segment whose ends are both clear of it.
        assert_eq!(audit.penetration(&[DVec3::Z * 20.0, DVec3::new(5.0, 0.0, 20.0)], 0.2), 0.2);
        let across = [DVec3::new(-5.0, 1.1, 20.0), DVec3::new(5.0, 1.1, 20.0)];
        assert!((audit.penetration(&across, 0.2) - 0.1).abs() < 2e-3);
        assert_eq!(audit.penetration(&[], 0.2), 0.0);
        assert_eq!(audit.penetration(&[DVec3::NAN], 0.2), f64::INFINITY);
    }

    #[test]
    fn points_have_the_distance_they_have() {
        let audit = Audit::new(&icosphere(4, 10.0, Vec3::ONE));
        for (off, expected) in [(0.0, 10.0), (9.0, 1.0), (10.5, 0.5), (40.0, 30.0)] {
            let p = DVec3::ONE + DVec3::new(0.36, 0.48, 0.8) * off;
            assert!((audit.wall.clearance(p) - expected).abs() < 0.03, "{off}");
            assert!((audit.distance(p, expected + 1.0).unwrap() - expected).abs() < 0.03);
            assert_eq!(audit.distance(p, expected - 0.2), None);
        }
    }

    #[test]
    fn a_lumen_is_open_for_what_its_waist_lets_through() {
        let audit = Audit::new(&waisted());
        for off in [0.0, 0.15] {
            assert_eq!(audit.is_open(&axis(off), 0.36), Ok(()));
            // 0.39 would fit, but not with the margin.
            for wire in [0.39, 0.42, 1.0] {
                let shut = audit.is_open(&axis(off), wire).unwrap_err();
                assert!(shut.at.z < 20.5 && shut.at.z > 18.0 && shut.lumen_mm < shut.needed_mm, "{shut}");
                assert!((shut.arc_mm - (shut.at.z - 2.0)).abs() < 1e-9);
            }
        }
        assert!(audit.is_open(&axis(3.0), 0.36).is_err(), "beside the tube nothing is open");
    }

    #[test]
    fn without_a_surface_nothing_is_touched_and_nothing_is_open() {
        let audit = Audit::new(&TriMesh::default());
        assert_eq!(audit.penetration(&axis(0.0), 1.0), 0.0);
        assert_eq!(audit.winding(DVec3::ZERO), 0.0);
        assert!(audit.is_open(&axis(0.0), 0.36).is_err());
    }
}
