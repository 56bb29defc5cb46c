//! The cut of a surface by a plane: the outlines in which it meets the triangles, and what their size is.
//!
//! Every triangle is looked at. A vertex counts as before or behind the plane and never as in it, so a triangle that is cut
//! has one side where an outline comes in and one where it goes out, and outlines are joined by the edges that they pass.
//! They run so that a closed surface's outermost are counter-clockwise seen against the normal, and those of a cavity
//! clockwise. Where the surface has a border an outline ends.
//!
//! Widths are those between two parallel lines that hold the outline (Feret's diameters); the least is found along the
//! edges of the convex hull (Freeman and Shapira, "Determining the minimum-area encasing rectangle for an arbitrary closed
//! curve", 1975), which comes from Andrew's monotone chain (1979).

use glam::{DVec2, DVec3, Vec3};

/// A line in which a plane cuts a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Its points in mm, one on each edge that it passes.
    pub points: Vec<DVec3>,
    /// Whether the last is followed by the first.
    pub is_closed: bool,
}

/// Where an outline passes a triangle: the edges by which it comes in and goes out where that faces outwards, the lesser
/// vertex first, and the points on them.
struct Passage {
    edges: [[u32; 2]; 2],
    points: [DVec3; 2],
}

/// The outlines in the plane through `at` across `normal`, of length 1. Triangles with an index beyond `positions` or a
/// corner that is not finite are passed over.
pub fn cut(positions: &[Vec3], triangles: &[[u32; 3]], at: DVec3, normal: DVec3) -> Vec<Outline> {
    let passages: Vec<Passage> = triangles.iter().filter_map(|t| passage(positions, t, at, normal)).collect();
    let ends = |(i, passage): (usize, &Passage)| passage.edges.map(|edge| (edge, i));
    let mut ends: Vec<([u32; 2], usize)> = passages.iter().enumerate().flat_map(ends).collect();
    ends.sort_unstable();
    let on = |edge: [u32; 2]| {
        let first = ends.partition_point(|end| end.0 < edge);
        ends[first..].iter().take_while(move |end| end.0 == edge).map(|end| end.1)
    };
    // Those that begin at a border first: what is left then is closed.
    let is_border = |&(i, side): &(usize, usize)| on(passages[i].edges[side]).count() == 1;
    let borders = (0..passages.len()).flat_map(|i| [(i, 0), (i, 1)]).filter(is_border);
    let starts: Vec<(usize, usize)> = borders.chain((0..passages.len()).map(|i| (i, 0))).collect();
    let mut is_left = vec![true; passages.len()];
    let mut outlines = Vec::new();
    for (start, side) in starts {
        if !is_left[start] {
            continue;
        }
        let (mut i, mut entered) = (start, side);
        let mut points = vec![passages[start].points[side]];
        // Triangles without an area may face either way: the longer part says which way it runs.
        let mut forwards = 0.0;
        let is_closed = loop {
            is_left[i] = false;
            let Passage { edges, points: [into, out] } = &passages[i];
            forwards += into.distance(*out) * if entered == 0 { 1.0 } else { -1.0 };
            points.push(if entered == 0 { *out } else { *into });
            let edge = edges[1 - entered];
            let Some(next) = on(edge).find(|&next| is_left[next]) else {
                break edge == passages[start].edges[side];
            };
            (i, entered) = (next, usize::from(passages[next].edges[0] != edge));
        };
        if is_closed {
            points.pop();
        }
        if forwards < 0.0 {
            points.reverse();
        }
        outlines.push(Outline { points, is_closed });
    }
    outlines
}

/// The pieces of these outlines one by one, in the triangles' order, through `point` (mm) across `normal`, of any length; none
/// where that is 0.
pub fn cut_pieces(positions: &[Vec3], triangles: &[[u32; 3]], point: Vec3, normal: Vec3) -> Vec<[Vec3; 2]> {
    let (at, normal) = (point.as_dvec3(), normal.as_dvec3().normalize_or_zero());
    let passages = triangles.iter().filter_map(|triangle| passage(positions, triangle, at, normal));
    passages.map(|passage| passage.points.map(DVec3::as_vec3)).collect()
}

fn passage(positions: &[Vec3], triangle: &[u32; 3], at: DVec3, normal: DVec3) -> Option<Passage> {
    let mut heights = [0.0; 3];
    for (height, &v) in heights.iter_mut().zip(triangle) {
        *height = (positions.get(v as usize)?.as_dvec3() - at).dot(normal);
    }
    let is_before = heights.map(|height| height >= 0.0);
    if is_before == [true; 3] || is_before == [false; 3] || !heights.iter().all(|height| height.is_finite()) {
        return None;
    }
    let side = |leads_before: bool| {
        let i = (0..3).find(|&i| is_before[i] != leads_before && is_before[(i + 1) % 3] == leads_before)?;
        let (mut from, mut to) = ((triangle[i], heights[i]), (triangle[(i + 1) % 3], heights[(i + 1) % 3]));
        // The same point for the triangles on both sides.
        if from.0 > to.0 {
            std::mem::swap(&mut from, &mut to);
        }
        let place = |v: u32| positions[v as usize].as_dvec3();
        Some(([from.0, to.0], place(from.0).lerp(place(to.0), from.1 / (from.1 - to.1))))
    };
    let ((into, came), (out, went)) = (side(false)?, side(true)?);
    Some(Passage { edges: [into, out], points: [came, went] })
}

impl Outline {
    /// Area in mm2, negative for one that runs clockwise seen against `normal`; 0 for one that is open.
    pub fn area(&self, normal: DVec3) -> f64 {
        if self.is_closed { area_and_middle(&self.points, self.origin(), normal).0 } else { 0.0 }
    }

    /// Centroid of the area, in mm.
    pub fn middle(&self, normal: DVec3) -> DVec3 {
        area_and_middle(&self.points, self.origin(), normal).1
    }

    /// How often it winds about `p`, a point of the plane.
    pub fn winding(&self, p: DVec3, normal: DVec3) -> i32 {
        let about: Vec<DVec3> = self.points.iter().map(|&point| point - p).collect();
        let (x, y) = normal.any_orthonormal_pair();
        winding(&about, [x, y])
    }

    /// The least and the largest distance in mm of two parallel lines that hold it.
    pub fn widths(&self, normal: DVec3) -> [f64; 2] {
        let (x, y) = normal.any_orthonormal_pair();
        let origin = self.origin();
        let hull = hull(self.points.iter().map(|&p| DVec2::new((p - origin).dot(x), (p - origin).dot(y))).collect());
        let mut least = f64::INFINITY;
        let mut largest = 0.0f64;
        for (i, &one) in hull.iter().enumerate() {
            let next = hull[(i + 1) % hull.len()];
            if let Some(along) = (next - one).try_normalize() {
                let across = hull.iter().map(|&p| along.perp_dot(p - one).abs());
                least = least.min(across.fold(0.0, f64::max));
            }
            largest = hull.iter().map(|p| p.distance(one)).fold(largest, f64::max);
        }
        [least.min(largest), largest]
    }

    fn origin(&self) -> DVec3 {
        self.points.first().copied().unwrap_or_default()
    }
}

/// Area in mm2 and centroid in mm of a closed line of points, seen from `p` in its plane.
pub fn area_and_middle(points: &[DVec3], p: DVec3, normal: DVec3) -> (f64, DVec3) {
    let (mut area, mut moment) = (0.0, DVec3::ZERO);
    for (i, &one) in points.iter().enumerate() {
        let (one, next) = (one - p, points[(i + 1) % points.len()] - p);
        let part = one.cross(next).dot(normal) / 2.0;
        area += part;
        moment += (one + next) / 3.0 * part;
    }
    (area, p + if area == 0.0 { DVec3::ZERO } else { moment / area })
}

/// How often a closed line winds about the origin, by what passes the half-line along x.
pub fn winding(points: &[DVec3], [x, y]: [DVec3; 2]) -> i32 {
    let mut turns = 0;
    for (i, &one) in points.iter().enumerate() {
        let next = points[(i + 1) % points.len()];
        let (before, after) = (one.dot(y), next.dot(y));
        if (before < 0.0) != (after < 0.0) {
            let part = before / (before - after);
            let meets = one.dot(x) + (next.dot(x) - one.dot(x)) * part > 0.0;
            turns += i32::from(meets) * if before < 0.0 { 1 } else { -1 };
        }
    }
    turns
}

/// The corners of the convex hull, counter-clockwise.
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let mut hull: Vec<DVec2> = Vec::new();
    let mut add = |p: DVec2, least: usize| {
        while let [.., a, b] = hull[..]
            && hull.len() > least
            && (b - a).perp_dot(p - b) <= 0.0
        {
            hull.pop();
        }
        hull.push(p);
        hull.len()
    };
    let lower = points.iter().fold(0, |_, &p| add(p, 1));
    points.iter().rev().skip(1).fold(lower, |_, &p| add(p, lower));
    if hull.len() > 1 {
        hull.pop();
    }
    hull
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::TriMesh;
    use crate::shapes::{icosphere, joined, tube};

    fn of(mesh: &TriMesh, at: DVec3, normal: DVec3) -> Vec<Outline> {
        cut(&mesh.positions, &mesh.triangles, at, normal)
    }

    /// Area of a circle's inscribed polygon over that of the circle.
    fn of_circle(sides: f64) -> f64 {
        let angle = TAU / sides;
        libm::sin(angle) / angle
    }

    #[test]
    fn a_tube_is_cut_in_a_circle_square_and_in_an_ellipse_aslant() {
        let mesh = tube(96, 60, 60.0, |_| 3.0);
        let [square] = &of(&mesh, DVec3::new(0.5, 0.2, 30.0), DVec3::Z)[..] else { panic!() };
        assert!(square.is_closed && square.winding(DVec3::new(1.0, 1.0, 30.0), DVec3::Z) == 1);
        assert_eq!(square.winding(DVec3::new(4.0, 0.0, 30.0), DVec3::Z), 0);
        assert!((square.area(DVec3::Z) / (PI * 9.0 * of_circle(96.0)) - 1.0).abs() < 1e-4);
        assert!(square.middle(DVec3::Z).distance(DVec3::Z * 30.0) < 1e-4);
        assert!(square.widths(DVec3::Z).iter().all(|width| (width / 6.0 - 1.0).abs() < 2e-3));
        // At 60 degrees the ellipse is twice as long as wide.
        let (sin, cos) = libm::sincos(PI / 3.0);
        let normal = DVec3::new(sin, 0.0, cos);
        let [aslant] = &of(&mesh, DVec3::Z * 30.0, normal)[..] else { panic!() };
        let [least, largest] = aslant.widths(normal);
        assert!((least / 6.0 - 1.0).abs() < 5e-3 && (largest / 12.0 - 1.0).abs() < 5e-3, "{least} {largest}");
        assert!((aslant.area(normal) / (PI * 18.0) - 1.0).abs() < 3e-3);
        // From the other side it is as large.
        let [other] = &of(&mesh, DVec3::Z * 30.0, -normal)[..] else { panic!() };
        assert!((other.area(-normal) - aslant.area(normal)).abs() < 1e-6);
    }

    #[test]
    fn a_wall_with_two_sides_has_two_outlines_of_opposite_sense() {
        let (outer, mut inner) = (icosphere(4, 5.0, Vec3::ZERO), icosphere(4, 4.0, Vec3::ZERO));
        inner.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        let found = of(&joined(&[outer, inner]), DVec3::X * 3.0, DVec3::X);
        let mut areas: Vec<f64> = found.iter().map(|outline| outline.area(DVec3::X)).collect();
        areas.sort_by(f64::total_cmp);
        let [cavity, whole] = areas[..] else { panic!("{areas:?}") };
        assert!((cavity / (-7.0 * PI) - 1.0).abs() < 0.01 && (whole / (16.0 * PI) - 1.0).abs() < 0.01, "{areas:?}");
    }

    #[test]
    fn triangles_without_an_area_that_face_the_wrong_way_end_no_outline() {
        let mesh = tube(32, 20, 20.0, |_| 3.0);
        let expected = of(&mesh, DVec3::Z * 9.5, DVec3::Z)[0].area(DVec3::Z);
        // Between two triangles a third, of the edge and a copy of one of its ends, as marching cubes leave them.
        let mut sewn = mesh.clone();
        let height = |v: u32| mesh.positions[v as usize].z;
        let t = mesh.triangles.iter().position(|t| height(t[0]) == 9.0 && height(t[1]) == 10.0).unwrap();
        let [a, b, c] = mesh.triangles[t];
        let copy = sewn.positions.len() as u32;
        sewn.positions.push(mesh.positions[b as usize]);
        sewn.triangles[t] = [a, copy, c];
        sewn.triangles.extend([[a, copy, b], [b, c, copy]]);
        let found = of(&sewn, DVec3::Z * 9.5, DVec3::Z);
        assert!(found.iter().any(|line| (line.area(DVec3::Z) / expected - 1.0).abs() < 1e-9), "{found:?}");
    }

    #[test]
    fn an_open_tube_cut_along_itself_has_two_open_lines_and_nothing_is_cut_beside_it() {
        let mesh = tube(32, 20, 20.0, |_| 3.0);
        let found = of(&mesh, DVec3::X * 0.1, DVec3::X);
        assert_eq!(found.len(), 2);
        for line in &found {
            assert!(!line.is_closed && line.area(DVec3::X) == 0.0);
            let ends = [line.points[0], line.points[line.points.len() - 1]];
            assert!((ends[0].distance(ends[1]) - 20.0).abs() < 1e-6, "{ends:?}");
        }
        assert!(of(&mesh, DVec3::X * 9.0, DVec3::X).is_empty());
        assert!(of(&TriMesh::default(), DVec3::ZERO, DVec3::X).is_empty());
        let broken = TriMesh { positions: vec![Vec3::NAN, Vec3::X, -Vec3::X], triangles: vec![[0, 1, 2], [1, 2, 9]] };
        assert!(of(&broken, DVec3::ZERO, DVec3::X).is_empty());
    }

    #[test]
    fn the_widths_of_a_rectangle_are_its_side_and_its_diagonal() {
        let corner = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        let points = vec![corner(0.0, 0.0), corner(4.0, 0.0), corner(4.0, 3.0), corner(1.0, 1.5), corner(0.0, 3.0)];
        let [least, largest] = Outline { points, is_closed: true }.widths(DVec3::Z);
        assert!((least - 3.0).abs() < 1e-12 && (largest - 5.0).abs() < 1e-12, "{least} {largest}");
    }

    #[test]
    fn the_pieces_of_a_sphere_are_a_closed_circle() {
        let centre = Vec3::new(3.0, -2.0, 100.0);
        let sphere = icosphere(4, 10.0, centre);
        let normal = Vec3::new(1.0, 2.0, -2.0) / 3.0;
        let pieces = cut_pieces(&sphere.positions, &sphere.triangles, centre + 6.0 * normal, normal * 7.0);
        let length: f32 = pieces.iter().map(|[a, b]| a.distance(*b)).sum();
        // A circle of 8 mm.
        assert!((length / (16.0 * std::f32::consts::PI) - 1.0).abs() < 0.01, "{length}");
        let mut ends: Vec<[u32; 3]> = pieces.as_flattened().iter().map(|p| p.to_array().map(f32::to_bits)).collect();
        for p in pieces.as_flattened() {
            assert!(((*p - centre).dot(normal) - 6.0).abs() < 1e-4, "in the plane");
            assert!((p.distance(centre) - 10.0).abs() < 0.05, "on the sphere");
        }
        ends.sort_unstable();
        assert!(ends.chunks(2).all(|pair| pair[0] == pair[1]), "each end is another's beginning");
    }

    #[test]
    fn a_plane_through_vertices_has_a_piece_in_each_triangle_once() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::new(0.0, 1.0, 1.0), Vec3::new(0.0, 1.0, -1.0)];
        // The first two lie in the plane: only the triangle below it crosses, along them.
        let pieces = cut_pieces(&positions, &[[0, 1, 2], [1, 0, 3]], Vec3::ZERO, Vec3::Z);
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].contains(&Vec3::ZERO) && pieces[0].contains(&Vec3::X));
        assert!(cut_pieces(&positions, &[[0, 1, 2]], Vec3::ZERO, Vec3::ZERO).is_empty());
    }
}
