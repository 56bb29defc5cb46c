//! The cross-section of a vessel: the closed loop in which a plane cuts its wall around a point of its centreline.
//!
//! In the plane a ray finds a triangle of the wall; from it the cut is followed from triangle to triangle until it
//! closes. A vertex counts as before or behind the plane and never as in it, so every triangle that is cut has one side
//! where the loop comes in and one where it goes out. It begins so that it runs counter-clockwise seen against the
//! direction of the plane where the first triangle faces outwards. It is the loop around the point if it winds about it
//! once. What lies elsewhere in the plane (the next turn of the vessel, other vessels) is not met. Cost: a few rays,
//! and as many steps as the loop has edges.
//!
//! Where the plane grazes the wall, as beside a saddle of it or in a spur between two vessels that touch, a surface that
//! has hardly moved can have another loop around the point, of another part of the lumen. That is no change of the
//! vessel. On a wall that has moved by `d` the area of the same loop changes by no more than the sum of `d` along it, over
//! the sine of the angle between plane and wall: where it changes by more, it is another one
//! ([`Shell::has_another_loop`]).

use glam::{DVec3, Vec3};

use super::space::Space;
use lumen_mesh::cut::{area_and_middle, winding};
use lumen_mesh::{SurfaceIndex, Topology, TriMesh};

/// Rays that are tried.
const RAYS: usize = 8;
/// Where no loop goes around the point, one whose middle is at most this many radii away is the vessel's, moved.
const MOVED: f64 = 1.0;
/// A radius that differs by less than this part is no sign of another loop,
const JUMP: f64 = 0.1;
/// nor an area by what a wall that has moved makes of it where it meets the plane at one in this, 30 degrees.
const STEEP: f64 = 2.0;

/// A cross-section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Section {
    /// Area in mm2.
    pub(super) area: f64,
    /// Its centroid in mm.
    pub(super) middle: DVec3,
    /// A triangle that it goes through.
    pub(super) triangle: u32,
}

/// What a plane makes of a vessel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Found {
    /// A closed loop.
    Closed(Section),
    /// The surface is open in the plane, or folded so that there is no saying.
    Open,
    /// No vessel is there.
    Gone,
}

impl Found {
    /// The area in mm2, 0 where the vessel is gone; `None` where there is no saying.
    pub(super) fn area(&self) -> Option<f64> {
        match self {
            Self::Closed(section) => Some(section.area),
            Self::Open => None,
            Self::Gone => Some(0.0),
        }
    }
}

/// A surface to cut, and an index of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wall<'a> {
    pub(super) shell: Shell<'a>,
    pub(super) index: &'a SurfaceIndex,
}

impl Wall<'_> {
    /// The cross-section around `p` in the plane across `normal`, of length 1.
    pub(super) fn section(&self, p: DVec3, normal: DVec3) -> Option<Section> {
        let (x, y) = normal.any_orthonormal_pair();
        let mut last = None;
        for i in 0..RAYS {
            // Turned a little, so that no ray lies along an axis of the grid that the surface may come from.
            let angle = std::f64::consts::TAU * (i as f64 + 0.17) / RAYS as f64;
            let (sin, cos) = libm::sincos(angle);
            let Some(triangle) = self.index.outlet(p, x * cos + y * sin, f64::INFINITY) else { continue };
            if last.replace(triangle) == Some(triangle) {
                continue;
            }
            if let Some(rim) = self.shell.rim(triangle, p, normal) {
                let section = summed(&rim, p, normal, triangle);
                if section.area > 0.0 && winding(&rim, [x, y]) == 1 {
                    return Some(section);
                }
            }
        }
        None
    }

    /// As [`Self::section`], on a surface that need not have the vessel where it was: `radius` mm is what it had there.
    pub(super) fn follow(&self, space: &Space, p: DVec3, normal: DVec3, radius: f64) -> Found {
        if let Some(section) = self.section(p, normal) {
            return Found::Closed(section);
        }
        if space.is_inside(p.as_vec3()) {
            return Found::Open;
        }
        // The plane through the wall that is nearest, a little within its triangle, which is then cut for certain.
        let Some(nearest) = self.index.nearest(p.as_vec3()) else { return Found::Gone };
        // Past an open end the vessel may go on outside of the surface.
        let Shell { mesh, topology } = self.shell;
        let is_rim = |v: u32| topology.edge_uses(v).iter().any(|edge| edge.is_boundary());
        if mesh.triangles[nearest.triangle as usize].into_iter().any(is_rim) {
            return Found::Open;
        }
        let corners = mesh.corners(nearest.triangle as usize).map(Vec3::as_dvec3);
        let centroid = (corners[0] + corners[1] + corners[2]) / 3.0;
        let at = nearest.point.as_dvec3().lerp(centroid, 0.1);
        if f64::from(nearest.distance) > MOVED * radius || (at - p).dot(normal).abs() > MOVED * radius {
            return Found::Gone;
        }
        match self.shell.rim(nearest.triangle, at, normal) {
            None => Found::Open,
            Some(rim) => {
                let section = summed(&rim, at, normal, nearest.triangle);
                let is_it = section.area > 0.0 && section.middle.distance(p) <= MOVED * radius;
                if is_it { Found::Closed(section) } else { Found::Gone }
            }
        }
    }
}

/// A surface along whose triangles a cut is followed, with its adjacency.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shell<'a> {
    pub(super) mesh: &'a TriMesh,
    pub(super) topology: &'a Topology,
}

impl Shell<'_> {
    /// Whether the surface that was made from this one, whose wall is `moved`, has its area of `area` mm2 in the plane
    /// across `normal` at `p` by another loop than this has there through `triangle`, with an area of `before` mm2.
    pub(super) fn has_another_loop(
        &self,
        (triangle, before): (u32, f64),
        p: DVec3,
        normal: DVec3,
        moved: &SurfaceIndex,
        area: f64,
    ) -> bool {
        // Nearly always: the loop is as long as the vessel is wide.
        if ((area / before).sqrt() - 1.0).abs() <= JUMP {
            return false;
        }
        let Some(rim) = self.rim(triangle, p, normal) else { return false };
        // Where the vessel had moved the area was that of a plane beside.
        let before = summed(&rim, p, normal, triangle).area;
        // What the wall has moved by, times the length of the loop, summed up until it is enough.
        let mut left = (area - before).abs() / STEEP;
        let mut last = None;
        for (i, &from) in rim.iter().enumerate() {
            let to = rim[(i + 1) % rim.len()];
            let middle = (p + (from + to) / 2.0).as_vec3();
            let nearest = match &last {
                Some(last) => moved.nearest_from(middle, last),
                None => moved.nearest(middle),
            };
            let Some(nearest) = nearest else { return false };
            left -= f64::from(nearest.distance) * from.distance(to);
            if left <= 0.0 {
                return false;
            }
            last = Some(nearest);
        }
        true
    }

    /// The points of the loop that begins in a triangle, relative to `p` in the plane; `None` where the plane does not
    /// cut the triangle, or the loop does not close.
    fn rim(&self, start: u32, p: DVec3, normal: DVec3) -> Option<Vec<DVec3>> {
        let place = |v: u32| self.mesh.positions[v as usize].as_dvec3() - p;
        let is_before = |v: u32| place(v).dot(normal) >= 0.0;
        let [a, b, c] = self.mesh.triangles[start as usize];
        // Out by the side that leads from behind the plane to before it.
        let mut side = [(a, b), (b, c), (c, a)].into_iter().find(|&(from, to)| !is_before(from) && is_before(to))?;
        let (first, mut triangle) = (side, start);
        let mut rim = Vec::new();
        loop {
            let (from, to) = side;
            let [one, other] = [from, to].map(place);
            let [below, above] = [one, other].map(|point| point.dot(normal));
            rim.push(one.lerp(other, below / (below - above)));
            triangle = self.across(triangle, from, to)?;
            let corners = self.mesh.triangles[triangle as usize];
            let third = corners.into_iter().find(|&v| v != from && v != to)?;
            side = if is_before(third) { (from, third) } else { (third, to) };
            if side == first {
                return Some(rim);
            }
            if rim.len() > self.mesh.triangles.len() {
                return None;
            }
        }
    }

    /// The triangle on the other side of an edge, if there is one and no more.
    fn across(&self, triangle: u32, from: u32, to: u32) -> Option<u32> {
        let mut others = self.topology.triangles_on(&self.mesh.triangles, from, to).filter(|&t| t != triangle);
        others.next().filter(|_| others.next().is_none())
    }
}

/// Area and centroid of a loop of points relative to `p`.
fn summed(rim: &[DVec3], p: DVec3, normal: DVec3, triangle: u32) -> Section {
    let (area, middle) = area_and_middle(rim, DVec3::ZERO, normal);
    Section { area, middle: p + middle, triangle }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::shapes::{icosphere, in_capsule, isosurface, joined, tube};

    fn cut(mesh: &TriMesh, p: DVec3, normal: DVec3) -> Option<Section> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        Wall { shell: Shell { mesh, topology: &topology }, index: &index }.section(p, normal)
    }

    /// Area of a circle's inscribed polygon over that of the circle.
    fn of_circle(sides: u32) -> f64 {
        let angle = std::f64::consts::TAU / f64::from(sides);
        libm::sin(angle) / angle
    }

    #[test]
    fn a_round_tube_has_the_area_of_its_polygon_square_and_aslant() {
        let mesh = tube(64, 40, 40.0, |_| 3.0);
        let circle = std::f64::consts::PI * 9.0;
        // A cut between two rings, which are turned against each other, has twice as many corners.
        for (z, sides) in [(20.0, 64), (20.5, 128)] {
            let found = cut(&mesh, DVec3::new(0.7, -0.4, z), DVec3::Z).unwrap();
            assert!((found.area / circle / of_circle(sides) - 1.0).abs() < 1e-3, "{found:?}");
            assert!(found.middle.distance(DVec3::Z * z) < 1e-3, "{found:?}");
        }
        let (sin, cos) = libm::sincos(0.5);
        let found = cut(&mesh, DVec3::Z * 20.0, DVec3::new(sin, 0.0, cos)).unwrap();
        assert!((found.area * cos / circle - 1.0).abs() < 2e-3, "{found:?}");
    }

    #[test]
    fn the_loop_is_that_around_the_point_and_not_another_in_the_plane() {
        let mut other = tube(32, 10, 10.0, |_| 5.0);
        other.positions.iter_mut().for_each(|p| p.x += 9.0);
        let both = joined(&[tube(32, 10, 10.0, |_| 2.0), other]);
        for (p, radius) in [(DVec3::new(1.0, 0.0, 5.0), 2.0), (DVec3::new(6.0, 0.0, 5.0), 5.0)] {
            let found = cut(&both, p, DVec3::Z).unwrap();
            assert!((found.area / (std::f64::consts::PI * radius * radius) - of_circle(32)).abs() < 2e-3, "{found:?}");
        }
        assert_eq!(cut(&both, DVec3::new(3.0, 0.0, 5.0), DVec3::Z), None, "between the two");
    }

    #[test]
    fn what_does_not_close_has_no_area() {
        let mesh = tube(32, 20, 20.0, |_| 3.0);
        // A plane along the tube leaves it by both open ends.
        assert_eq!(cut(&mesh, DVec3::Z * 10.0, DVec3::X), None);
        let mut turned = icosphere(3, 5.0, glam::Vec3::ZERO);
        assert!(cut(&turned, DVec3::ZERO, DVec3::X).is_some());
        turned.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        assert_eq!(cut(&turned, DVec3::ZERO, DVec3::X), None);
        assert_eq!(cut(&TriMesh::default(), DVec3::ZERO, DVec3::X), None);
    }

    /// Whether `after` has another loop than `before` around `p` in the plane across z.
    fn has_another_loop(before: &TriMesh, after: &TriMesh, p: DVec3) -> bool {
        let topology = Topology::new(before.positions.len(), &before.triangles);
        let [section, moved] = [before, after].map(|mesh| cut(mesh, p, DVec3::Z).unwrap());
        let index = SurfaceIndex::new(&after.positions, &after.triangles);
        let shell = Shell { mesh: before, topology: &topology };
        shell.has_another_loop((section.triangle, section.area), p, DVec3::Z, &index, moved.area)
    }

    #[test]
    fn a_plane_that_grazes_a_bridge_to_another_vessel_has_another_loop_where_the_wall_has_hardly_moved() {
        // Two vessels of 3 mm along z, joined by one of 2 mm across, whose top is at 2 mm.
        let inside = |p: DVec3| {
            let vessel = |x: f64| in_capsule(p, DVec3::new(x, 0.0, -12.0), DVec3::new(x, 0.0, 12.0), 3.0);
            vessel(0.0).max(vessel(9.0)).max(in_capsule(p, DVec3::ZERO, DVec3::X * 9.0, 2.0))
        };
        let mesh = isosurface(DVec3::new(-4.0, -4.0, -16.0), DVec3::new(13.0, 4.0, 16.0), 0.5, inside);
        let by = |way: f32| {
            let mut moved = mesh.clone();
            moved.positions.iter_mut().for_each(|p| p.z += way);
            moved
        };
        let area = |mesh: &TriMesh, z: f64| cut(mesh, DVec3::Z * z, DVec3::Z).unwrap().area;
        // The facets' own top.
        let top = (150..250).map(|i| f64::from(i) / 100.0).find(|&z| area(&mesh, z) < 40.0).unwrap();
        let below = top - 0.015;
        assert!(area(&mesh, below) > 50.0, "both vessels");
        assert!(has_another_loop(&mesh, &by(-0.04), DVec3::Z * below), "it loses the other vessel");
        assert!(has_another_loop(&mesh, &by(0.04), DVec3::Z * (top + 0.015)), "it takes it in");
        // Where the plane meets the wall square, it does not: neither unchanged, nor moved, nor narrowed.
        let mut narrowed = mesh.clone();
        for p in narrowed.positions.iter_mut().filter(|p| p.x < 4.5 && p.z.abs() > 4.0) {
            (p.x, p.y) = (p.x * 0.8, p.y * 0.8);
        }
        for after in [&mesh, &by(-0.04), &narrowed] {
            assert!(!has_another_loop(&mesh, after, DVec3::Z * 7.3));
        }
        assert!((area(&narrowed, 7.3) / area(&mesh, 7.3) - 0.64).abs() < 0.01);
    }
}
