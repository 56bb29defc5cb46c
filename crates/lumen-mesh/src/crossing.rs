//! Whether two triangles of a surface run into each other.
//!
//! The definition is that of MeshLab's "select self intersecting faces" (VCGlib), so that numbers can be compared, but for
//! its epsilon, which here goes with the triangles' size:
//!
//! - triangles over the same three vertices do, however they lie (VCGlib misses those in a plane along two axes, whose boxes have no
//!   volume);
//! - triangles with a common edge never do, even folded flat onto each other;
//! - triangles with one common vertex do where the opposite edge of one, moved half-way to that vertex, crosses the
//!   inside of the other: their common line beyond the vertex then lies in both;
//! - others do where they share a point, touching included, and their boxes overlap with a volume.
//!
//! Triangle against triangle is Moeller, "A fast triangle-triangle intersection test" (1997), in its form without
//! divisions; an edge against a triangle is Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection"
//! (1997). All in f64 on f32 coordinates: where surfaces only touch, rounding decides, as it does in MeshLab.
//!
//! A volume mesher is stricter: [`touch`] decides exactly (Shewchuk, "Adaptive precision floating-point arithmetic and fast
//! robust geometric predicates", 1997; crate `robust`), and what only touches counts.

use glam::{DVec2, DVec3, Vec3};
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Within this part of a triangle's height from a side, a crossing does not count.
const EPSILON: f64 = 1e-6;

/// Below this part of the product of two of its sides' lengths, a determinant says that an edge runs along a triangle's
/// plane. (MeshLab takes 1e-6 in the square of the file's unit, by which nothing crosses in metres, nor where triangles are
/// slivers.)
const ALONG: f64 = 1e-12;

/// A triangle of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// Its vertices' numbers.
    pub vertices: [u32; 3],
    /// Its corners in mm.
    pub corners: [Vec3; 3],
}

/// Whether two triangles of a surface run into each other.
pub fn cross(a: &Face, b: &Face) -> bool {
    cross_beyond(EPSILON, a, b)
}

/// The same, but a crossing as near to a side as can be counts too: what a triangle only touches, or passes by rounding.
pub fn cross_at_all(a: &Face, b: &Face) -> bool {
    cross_beyond(0.0, a, b)
}

/// Whether two triangles of a surface share a point besides common corners or a common edge, however little: decided exactly, also
/// in one plane. Corners at one place are common. Triangles with two of them never do, even folded flat onto each other; those
/// with all three do. What has no area counts by its sides alone.
#[inline(never)]
pub fn touch(a: &Face, b: &Face) -> bool {
    let [(low_a, high_a), (low_b, high_b)] = [a.corners, b.corners].map(|[p, q, r]| (p.min(q).min(r), p.max(q).max(r)));
    if !(low_a.cmple(high_b) & low_b.cmple(high_a)).all() {
        return false;
    }
    // By their places: TetGen joins vertices that lie at one.
    let own = |one: &Face, other: &Face| one.corners.iter().filter(|p| !other.corners.contains(p)).count();
    let common = |one: &Face, other: &Face| one.corners.iter().position(|p| other.corners.contains(p)).unwrap_or(0);
    match own(a, b) {
        3 if is_beyond(&a.corners, b.corners) || is_beyond(&b.corners, a.corners) => false,
        3 => edges(a.corners).any(|edge| meets(edge, b.corners)) || edges(b.corners).any(|edge| meets(edge, a.corners)),
        2 => {
            // What they share beyond the vertex goes on to the side opposite to it of one of them.
            let opposite = |corners: [Vec3; 3], at: usize| [corners[(at + 1) % 3], corners[(at + 2) % 3]];
            meets(opposite(a.corners, common(a, b)), b.corners) || meets(opposite(b.corners, common(b, a)), a.corners)
        }
        others => others == 0,
    }
}

/// The same, where a crossing within a part of a triangle's height from a side does not count.
fn cross_beyond(margin: f64, a: &Face, b: &Face) -> bool {
    if !boxes_overlap(a.corners, b.corners) {
        return a.vertices.iter().all(|v| b.vertices.contains(v));
    }
    let mut common = (0, 0, 0);
    for (i, v) in a.vertices.iter().enumerate() {
        for (j, w) in b.vertices.iter().enumerate() {
            if v == w {
                common = (common.0 + 1, i, j);
            }
        }
    }
    let (p, q) = (a.corners.map(Vec3::as_dvec3), b.corners.map(Vec3::as_dvec3));
    match common {
        (0, ..) => triangles_meet(p, q),
        (1, i, j) => meet_beyond_vertex(margin, p, i, q, j),
        (2, ..) => false,
        _ => true,
    }
}

/// Whether the boxes of two triangles overlap, with a volume.
fn boxes_overlap(a: [Vec3; 3], b: [Vec3; 3]) -> bool {
    let [low_a, low_b] = [a, b].map(|[p, q, r]| p.min(q).min(r));
    let [high_a, high_b] = [a, b].map(|[p, q, r]| p.max(q).max(r));
    low_a.cmplt(high_b).all() && low_b.cmplt(high_a).all()
}

/// Two triangles whose corners `i` and `j` are one vertex.
fn meet_beyond_vertex(margin: f64, p: [DVec3; 3], i: usize, q: [DVec3; 3], j: usize) -> bool {
    let half_way = |corners: [DVec3; 3], at: usize| {
        [(at + 1) % 3, (at + 2) % 3].map(|other| corners[other] * 0.5 + corners[at] * 0.5)
    };
    crossing(margin, half_way(p, i), q).or_else(|| crossing(margin, half_way(q, j), p)).unwrap_or(false)
}

/// Where a segment crosses a triangle, whether that is inside of it and not within `margin` of a side; `None` where it does
/// not.
fn crossing(margin: f64, [from, to]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> Option<bool> {
    let length = (to - from).length();
    let (direction, ab, ac) = ((to - from) / length, b - a, c - a);
    let across = direction.cross(ac);
    let determinant = ab.dot(across);
    // False for what is no number.
    let is_across = determinant.abs() > ALONG * ab.length() * ac.length();
    if !is_across {
        return None;
    }
    let offset = from - a;
    let turned = offset.cross(ab);
    let (v, w, t) =
        (offset.dot(across) / determinant, direction.dot(turned) / determinant, ac.dot(turned) / determinant);
    let is_on = v >= 0.0 && w >= 0.0 && v + w <= 1.0 && (0.0..=length).contains(&t);
    is_on.then_some(v > margin && w > margin && v + w < 1.0)
}

fn edges(corners: [Vec3; 3]) -> impl Iterator<Item = [Vec3; 2]> {
    (0..3).map(move |i| [corners[i], corners[(i + 1) % 3]])
}

/// Whether all points lie to one side of a triangle's plane, by more than what `f64` may be off.
fn is_beyond(points: &[Vec3], corners: [Vec3; 3]) -> bool {
    /// Some 16 roundings of 2^-53 of products of three lengths: 2e-15, and five times that to be sure.
    const ROUNDING: f64 = 1e-14;
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let most = ROUNDING * ab.abs().element_sum() * ac.abs().element_sum();
    let side = |p: &Vec3| {
        let way = p.as_dvec3() - a;
        let above = normal.dot(way);
        if above.abs() > most * way.abs().element_sum() { above } else { 0.0 }
    };
    points.iter().all(|p| side(p) > 0.0) || points.iter().all(|p| side(p) < 0.0)
}

/// Whether a segment and a triangle share a point: exactly.
fn meets([p, q]: [Vec3; 2], corners: [Vec3; 3]) -> bool {
    if is_beyond(&[p, q], corners) {
        return false;
    }
    let exact = |p: Vec3| Coord3D { x: p.x, y: p.y, z: p.z };
    let [a, b, c] = corners.map(exact);
    let [from, to] = [exact(p), exact(q)];
    let [above_from, above_to] = [orient3d(a, b, c, from), orient3d(a, b, c, to)];
    if !is_split(above_from, above_to) {
        return false;
    }
    if above_from == 0.0 && above_to == 0.0 {
        return meets_in_plane([p, q], corners);
    }
    let turns = [orient3d(from, to, a, b), orient3d(from, to, b, c), orient3d(from, to, c, a)];
    turns.iter().all(|&turn| turn >= 0.0) || turns.iter().all(|&turn| turn <= 0.0)
}

/// Whether a segment and a triangle of one plane share a point: exactly, seen along the first axis along which the triangle has
/// an area. One that has none along any meets nothing.
fn meets_in_plane(segment: [Vec3; 2], corners: [Vec3; 3]) -> bool {
    let turn = |p, q, r| orient2d::<f32>(p, q, r);
    let seen = |axis: usize| move |p: Vec3| Coord { x: p[(axis + 1) % 3], y: p[(axis + 2) % 3] };
    let area = |axis: &usize| {
        let [a, b, c] = corners.map(seen(*axis));
        turn(a, b, c) != 0.0
    };
    let Some(axis) = (0..3).find(area) else { return false };
    let [from, to] = segment.map(seen(axis));
    let [a, b, c] = corners.map(seen(axis));
    let inside = [turn(a, b, from), turn(b, c, from), turn(c, a, from)];
    let crosses = |p: Coord<f32>, q: Coord<f32>| {
        let [first, second] = [turn(from, to, p), turn(from, to, q)];
        let [third, fourth] = [turn(p, q, from), turn(p, q, to)];
        if first == 0.0 && second == 0.0 {
            // All on one line.
            let overlap = |p: f32, q: f32, r: f32, s: f32| p.min(q) <= r.max(s) && r.min(s) <= p.max(q);
            return overlap(p.x, q.x, from.x, to.x) && overlap(p.y, q.y, from.y, to.y);
        }
        is_split(first, second) && is_split(third, fourth)
    };
    inside.iter().all(|&turn| turn >= 0.0)
        || inside.iter().all(|&turn| turn <= 0.0)
        || crosses(a, b)
        || crosses(b, c)
        || crosses(c, a)
}

/// Whether two numbers are not both above zero, and not both below.
fn is_split(a: f64, b: f64) -> bool {
    (a <= 0.0 && b >= 0.0) || (a >= 0.0 && b <= 0.0)
}

/// Whether two triangles without a common vertex share a point.
fn triangles_meet(p: [DVec3; 3], q: [DVec3; 3]) -> bool {
    let normal_p = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero();
    let from_p = q.map(|corner| normal_p.dot(corner) - normal_p.dot(p[0]));
    if is_one_side(from_p) {
        return false;
    }
    let normal_q = (q[1] - q[0]).cross(q[2] - q[0]);
    let from_q = p.map(|corner| normal_q.dot(corner) - normal_q.dot(q[0]));
    if is_one_side(from_q) {
        return false;
    }
    let line = normal_p.cross(normal_q).abs();
    let axis = if line.x >= line.y && line.x >= line.z {
        0
    } else if line.y >= line.z {
        1
    } else {
        2
    };
    let cuts = Cut::new(p.map(|corner| corner[axis]), from_q).zip(Cut::new(q.map(|corner| corner[axis]), from_p));
    match cuts {
        None => coplanar_meet(normal_p, p, q),
        Some((one, other)) => {
            let (scale, other_scale) = (one.scale(), other.scale());
            let [low, high] = one.ends(other_scale);
            let [other_low, other_high] = other.ends(scale);
            low <= other_high && other_low <= high
        }
    }
}

fn is_one_side([a, b, c]: [f64; 3]) -> bool {
    a * b > 0.0 && a * c > 0.0
}

/// Where a triangle cuts the common line of two planes, by its coordinates along an axis and its corners' distances
/// from the other plane.
struct Cut {
    apex: f64,
    /// To the two other corners, times the apex's distance.
    steps: [f64; 2],
    /// By how much they are nearer to the plane.
    falls: [f64; 2],
}

impl Cut {
    /// `None` where all corners lie in the plane.
    fn new(along: [f64; 3], distances: [f64; 3]) -> Option<Self> {
        let [a, b, c] = distances;
        // The corner that is alone on its side of the plane.
        let apex = if a * b > 0.0 {
            2
        } else if a * c > 0.0 {
            1
        } else if b * c > 0.0 || a != 0.0 {
            0
        } else if b != 0.0 {
            1
        } else if c != 0.0 {
            2
        } else {
            return None;
        };
        let others = [[1, 2], [0, 2], [0, 1]][apex];
        Some(Self {
            apex: along[apex],
            steps: others.map(|i| (along[i] - along[apex]) * distances[apex]),
            falls: others.map(|i| distances[apex] - distances[i]),
        })
    }

    fn scale(&self) -> f64 {
        self.falls[0] * self.falls[1]
    }

    /// The ends, ascending, times both cuts' scales.
    fn ends(&self, other_scale: f64) -> [f64; 2] {
        let base = self.apex * (self.scale() * other_scale);
        let one = base + self.steps[0] * self.falls[1] * other_scale;
        let other = base + self.steps[1] * self.falls[0] * other_scale;
        [one.min(other), one.max(other)]
    }
}

/// Whether two triangles of one plane share a point.
fn coplanar_meet(normal: DVec3, p: [DVec3; 3], q: [DVec3; 3]) -> bool {
    let size = normal.abs();
    let flat = |corner: DVec3| {
        if size.x > size.y && size.x > size.z {
            DVec2::new(corner.y, corner.z)
        } else if size.x <= size.y && size.z <= size.y {
            DVec2::new(corner.x, corner.z)
        } else {
            DVec2::new(corner.x, corner.y)
        }
    };
    let (p, q) = (p.map(flat), q.map(flat));
    let edges = |corners: [DVec2; 3]| [0, 1, 2].map(|i| [corners[i], corners[(i + 1) % 3]]);
    edges(p).into_iter().any(|e| edges(q).into_iter().any(|f| edges_meet(e, f)))
        || is_inside(p[0], q)
        || is_inside(q[0], p)
}

/// Whether two edges of one plane that are not parallel share a point.
fn edges_meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let (ab, dc, ca) = (b - a, c - d, a - c);
    let f = ab.y * dc.x - ab.x * dc.y;
    let (s, t) = (dc.y * ca.x - dc.x * ca.y, ab.x * ca.y - ab.y * ca.x);
    if f > 0.0 {
        (0.0..=f).contains(&s) && (0.0..=f).contains(&t)
    } else {
        f < 0.0 && s <= 0.0 && s >= f && t <= 0.0 && t >= f
    }
}

fn is_inside(point: DVec2, corners: [DVec2; 3]) -> bool {
    let side = |i: usize| (corners[(i + 1) % 3] - corners[i]).perp_dot(point - corners[i]);
    side(0) * side(1) > 0.0 && side(0) * side(2) > 0.0
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const FLOOR: [Vec3; 3] = [Vec3::new(-1.0, -1.0, 0.0), Vec3::new(3.0, -1.0, 0.0), Vec3::new(-1.0, 3.0, 0.0)];

    fn face(first: u32, corners: [Vec3; 3]) -> Face {
        Face { vertices: [first, first + 1, first + 2], corners }
    }

    #[test]
    fn a_needle_through_the_floor_crosses_it_and_one_beside_or_above_does_not() {
        let needle = |x: f32, z: f32| [Vec3::new(x, 0.0, z), Vec3::new(x + 0.1, 0.2, z), Vec3::new(x, 0.1, z + 2.0)];
        for (x, z, crosses) in [(0.0, -1.0, true), (2.5, -1.0, false), (0.0, 0.1, false), (0.0, -2.5, false)] {
            let (floor, needle) = (face(0, FLOOR), face(3, needle(x, z)));
            assert_eq!([cross(&floor, &needle), cross(&needle, &floor)], [crosses; 2], "{x}, {z}");
        }
    }

    #[test]
    fn neighbours_over_an_edge_never_cross_and_doubles_always_do() {
        let folded = Face { vertices: [0, 1, 3], corners: [FLOOR[0], FLOOR[1], FLOOR[2] + Vec3::splat(0.01)] };
        assert!(!cross(&face(0, FLOOR), &folded));
        for corners in [[Vec3::ZERO, Vec3::X, Vec3::new(0.0, 1.0, 1.0)], FLOOR] {
            let double = Face { vertices: [2, 0, 1], corners: [corners[2], corners[0], corners[1]] };
            let back = Face { vertices: [1, 0, 2], corners: [corners[1], corners[0], corners[2]] };
            assert!(cross(&face(0, corners), &double) && cross(&face(0, corners), &back), "{corners:?}");
        }
    }

    #[test]
    fn with_one_common_vertex_only_what_lies_beyond_it_counts() {
        let apex = FLOOR[0];
        let wing = |to: Vec3, and: Vec3| Face { vertices: [0, 8, 9], corners: [apex, to, and] };
        let floor = face(0, FLOOR);
        let through = wing(Vec3::new(1.0, 0.5, 1.0), Vec3::new(0.5, 1.0, -1.0));
        let away = wing(Vec3::new(-3.0, -2.0, 1.0), Vec3::new(-2.0, -3.0, -1.0));
        let above = wing(Vec3::new(1.0, 0.5, 1.0), Vec3::new(0.5, 1.0, 0.2));
        let short = wing(Vec3::new(-0.9, -0.9, 0.1), Vec3::new(-0.9, -0.9, -0.1));
        let long = wing(Vec3::new(90.0, 90.0, 30.0), Vec3::new(90.0, 90.0, -30.0));
        for (other, crosses) in [(through, true), (away, false), (above, false), (short, true), (long, true)] {
            assert_eq!([cross(&floor, &other), cross(&other, &floor)], [crosses; 2], "{other:?}");
        }
    }

    #[test]
    fn the_size_of_a_surface_does_not_matter() {
        let scaled = |face: &Face, size: f32| Face { corners: face.corners.map(|p| p * size), ..*face };
        let floor = face(0, FLOOR);
        let wing = |to: Vec3, and: Vec3| Face { vertices: [0, 8, 9], corners: [FLOOR[0], to, and] };
        let through = wing(Vec3::new(1.0, 0.5, 1.0), Vec3::new(0.5, 1.0, -1.0));
        let above = wing(Vec3::new(1.0, 0.5, 1.0), Vec3::new(0.5, 1.0, 0.2));
        let apart = face(3, [Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.1, 0.2, -1.0), Vec3::new(0.0, 0.1, 1.0)]);
        for power in -30..=30 {
            let size = libm::exp2f(power as f32);
            for (other, crosses) in [(through, true), (above, false), (apart, true)] {
                let [a, b] = [scaled(&floor, size), scaled(&other, size)];
                assert_eq!([cross(&a, &b), cross(&b, &a)], [crosses; 2], "2^{power}: {other:?}");
            }
        }
    }

    #[test]
    fn in_one_plane_that_is_along_no_axis_overlap_counts_and_distance_does_not() {
        let turn = glam::Quat::from_euler(glam::EulerRot::XYZ, 0.4, 0.7, 0.2);
        let at =
            |x: f32| [Vec3::new(x, 0.0, 0.0), Vec3::new(x + 2.0, 0.0, 0.0), Vec3::new(x, 2.0, 0.0)].map(|p| turn * p);
        let meet =
            |x: f32| coplanar_meet((turn * Vec3::Z).as_dvec3(), at(0.0).map(Vec3::as_dvec3), at(x).map(Vec3::as_dvec3));
        assert!(meet(0.5) && meet(-0.5) && !meet(2.5) && !meet(-2.5));
        let small = at(0.2).map(|p| p * 0.2 + turn * Vec3::splat(0.3) * Vec3::ONE).map(Vec3::as_dvec3);
        let plane = (turn * Vec3::Z).as_dvec3();
        assert!(coplanar_meet(plane, small, at(0.0).map(Vec3::as_dvec3)));
        assert!(coplanar_meet(plane, at(0.0).map(Vec3::as_dvec3), small));
    }

    #[test]
    fn what_only_touches_is_told_exactly() {
        // In the plane of the floor: an edge that runs out of a corner into it, and one that runs along its side or away.
        let from_corner = |x: f32, y: f32, z: f32| Face {
            vertices: [0, 8, 9],
            corners: [FLOOR[0], FLOOR[0] + Vec3::new(x, y, z), FLOOR[0] + Vec3::new(x + y, y + x, z + 1.0)],
        };
        let least = 1e-30;
        for (x, y, z, does) in [
            (1.0, 1.0, 0.0, true),
            (1.0, 1.0, least, false),
            (9.0, 0.0, 0.0, true),
            (9.0, 9.0, 0.0, true),
            (-1.0, -1.0, 0.0, false),
            (-1.0, -1.0, least, false),
        ] {
            let (floor, wing) = (face(0, FLOOR), from_corner(x, y, z));
            assert_eq!([touch(&floor, &wing), touch(&wing, &floor)], [does; 2], "{x} {y} {z}");
        }
        // A flat cap along an axis has a box without volume: another in its plane, a needle that stands on it, one just above.
        let shifted = |by: Vec3| face(3, FLOOR.map(|p| p + by));
        let standing = |z: f32| face(3, [Vec3::new(0.0, 0.0, z), Vec3::new(0.1, 0.2, 2.0), Vec3::new(0.0, 0.1, 2.0)]);
        for (other, does) in [
            (shifted(Vec3::new(0.5, 0.5, 0.0)), true),
            (shifted(Vec3::new(5.0, 5.0, 0.0)), false),
            (shifted(Vec3::new(0.5, 0.5, least)), false),
            // It ends on the long side, and ends short of it.
            (shifted(Vec3::new(2.0, 2.0, 0.0)), true),
            (shifted(Vec3::new(2.0, 2.0 + 2e-7, 0.0)), false),
            (standing(0.0), true),
            (standing(-1.0), true),
            (standing(least), false),
        ] {
            assert_eq!([touch(&face(0, FLOOR), &other), touch(&other, &face(0, FLOOR))], [does; 2], "{other:?}");
        }
        // A small one within a large one of its plane has no side in common with it.
        let small = face(3, FLOOR.map(|p| p * 0.1));
        assert!(touch(&small, &face(0, FLOOR)) && touch(&face(0, FLOOR), &small));
        let twice = Face { vertices: [2, 0, 1], corners: [FLOOR[2], FLOOR[0], FLOOR[1]] };
        let beside = Face { vertices: [0, 1, 3], corners: [FLOOR[0], FLOOR[1], FLOOR[2] + Vec3::X] };
        assert!(touch(&face(0, FLOOR), &twice) && !touch(&face(0, FLOOR), &beside));
    }

    #[test]
    fn nothing_crosses_what_is_no_place() {
        let broken = [Vec3::new(f32::NAN, 0.0, -1.0), Vec3::new(0.1, f32::INFINITY, -1.0), Vec3::new(0.0, 0.0, 1.0)];
        assert!(!cross(&face(0, FLOOR), &face(3, broken)));
        assert!(!cross(&face(0, FLOOR), &face(3, [Vec3::ZERO; 3])));
        assert!(!touch(&face(0, FLOOR), &face(3, broken)));
    }

    fn corners() -> impl Strategy<Value = [Vec3; 3]> {
        prop::array::uniform3(prop::array::uniform3(-5.0f32..5.0).prop_map(Vec3::from))
    }

    /// Two triangles cross in general position where an edge of one crosses the other: each edge by the signs of five
    /// volumes.
    fn by_volumes(p: [Vec3; 3], q: [Vec3; 3]) -> bool {
        let volume = |a: Vec3, b: Vec3, c: Vec3, d: Vec3| {
            let [b, c, d] = [b, c, d].map(|corner| corner.as_dvec3() - a.as_dvec3());
            b.cross(c).dot(d) > 0.0
        };
        let pierces = |e: Vec3, f: Vec3, [a, b, c]: [Vec3; 3]| {
            let turns = [volume(e, f, a, b), volume(e, f, b, c), volume(e, f, c, a)];
            volume(e, a, b, c) != volume(f, a, b, c) && (turns == [true; 3] || turns == [false; 3])
        };
        (0..3).any(|i| pierces(p[i], p[(i + 1) % 3], q) || pierces(q[i], q[(i + 1) % 3], p))
    }

    proptest! {
        #[test]
        fn signs_of_volumes_say_the_same(p in corners(), q in corners()) {
            prop_assert_eq!(cross(&face(0, p), &face(3, q)), by_volumes(p, q));
            prop_assert_eq!(touch(&face(0, p), &face(3, q)), by_volumes(p, q));
        }

        #[test]
        fn neither_order_nor_winding_matters(p in corners(), q in corners()) {
            let (a, b) = (face(0, p), face(3, q));
            let turned = Face { vertices: [5, 4, 3], corners: [q[2], q[1], q[0]] };
            prop_assert_eq!(cross(&a, &b), cross(&b, &a));
            prop_assert_eq!(cross(&a, &b), cross(&a, &turned));
        }

        /// Of triangles with one common vertex, what crosses touches, and in general position what touches crosses.
        #[test]
        fn at_a_common_vertex_touching_is_crossing(p in corners(), q in corners()) {
            let (a, b) = (face(0, p), Face { vertices: [7, 0, 8], corners: [q[0], p[0], q[1]] });
            prop_assert_eq!(touch(&a, &b), cross(&a, &b));
            prop_assert_eq!(touch(&a, &b), touch(&b, &a));
        }

        /// On a grid of whole numbers much lies in one plane or on one line; 1-D, 2-D and 3-D answers come by brute force in
        /// whole numbers: the closed triangles are apart if and only if one of the directions below parts them.
        #[test]
        fn on_a_grid_a_parting_plane_says_the_same(
            p in prop::array::uniform3(prop::array::uniform3(-3i64..4)),
            q in prop::array::uniform3(prop::array::uniform3(-3i64..4)),
        ) {
            let minus = |a: [i64; 3], b: [i64; 3]| [0, 1, 2].map(|i| a[i] - b[i]);
            let dot = |a: [i64; 3], b: [i64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
            let times = |a: [i64; 3], b: [i64; 3]| {
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
            };
            let sides = |t: [[i64; 3]; 3]| [0, 1, 2].map(|i| minus(t[(i + 1) % 3], t[i]));
            let normals = [p, q].map(|t| times(sides(t)[0], sides(t)[1]));
            prop_assume!(normals.iter().all(|n| *n != [0; 3]) && p.iter().all(|v| !q.contains(v)));
            // The axes of the separating axis theorem, those within each plane among them.
            let mut axes = normals.to_vec();
            for e in sides(p) {
                axes.extend(sides(q).map(|f| times(e, f)));
            }
            for (n, t) in normals.into_iter().zip([p, q]) {
                axes.extend(sides(t).map(|e| times(n, e)));
            }
            let is_parted = axes.into_iter().any(|axis| {
                let [low_p, high_p, low_q, high_q] = [
                    p.map(|v| dot(axis, v)).into_iter().min(),
                    p.map(|v| dot(axis, v)).into_iter().max(),
                    q.map(|v| dot(axis, v)).into_iter().min(),
                    q.map(|v| dot(axis, v)).into_iter().max(),
                ];
                high_p < low_q || high_q < low_p
            });
            let corners = |t: [[i64; 3]; 3]| t.map(|v| Vec3::from(v.map(|x| x as f32)));
            prop_assert_eq!(touch(&face(0, corners(p)), &face(3, corners(q))), !is_parted);
        }
    }
}
