//! The generalised winding number: how often a surface goes around a point.
//!
//! The sum of the solid angles of the triangles over 4 pi (Jacobson, Kavan and Sorkine-Hornung, "Robust inside-outside
//! segmentation using generalized winding numbers", 2013), each by van Oosterom and Strackee, "The solid angle of a plane
//! triangle" (1983): `tan(angle / 2) = a.(b x c) / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|)`. Groups of triangles that
//! are far away for their size count as one (Barill et al., "Fast winding numbers for soups and clouds", 2018, of the
//! first order). Open ends are closed by fans over their rims.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use glam::DVec3;

use lumen_mesh::TriMesh;

/// A group is far when its middle is this many times its radius away. The error of the sum is then below 1 %.
const FAR: f64 = 6.0;
/// Triangles in the smallest groups.
const LEAF: usize = 8;

#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    triangles: Vec<[DVec3; 3]>,
    groups: Vec<Group>,
}

#[derive(Clone, Copy, Debug)]
struct Group {
    middle: DVec3,
    radius: f64,
    /// Sum of the areas with their normals, in mm2.
    area: DVec3,
    first: u32,
    count: u32,
    /// The two halves, or 0 for a leaf.
    halves: [u32; 2],
}

impl Sides {
    /// Of a surface whose finite triangles are these.
    pub(super) fn new(mesh: &TriMesh, triangles: &[[DVec3; 3]]) -> Self {
        let mut sides = Self { triangles: triangles.to_vec(), groups: Vec::new() };
        sides.triangles.extend(caps(mesh));
        let count = sides.triangles.len();
        if count > 0 {
            sides.divide(0, count);
        }
        sides
    }

    fn divide(&mut self, first: usize, count: usize) -> u32 {
        let part = &mut self.triangles[first..first + count];
        let corners = || part.iter().flatten().copied();
        let (low, high) =
            (corners().fold(DVec3::INFINITY, DVec3::min), corners().fold(DVec3::NEG_INFINITY, DVec3::max));
        // The middle of the area: about it the next order of the sum is least.
        let (mut moment, mut whole) = (DVec3::ZERO, 0.0);
        for [a, b, c] in part.iter() {
            let size = (*b - *a).cross(*c - *a).length();
            moment += (*a + *b + *c) / 3.0 * size;
            whole += size;
        }
        let middle = if whole > 0.0 { moment / whole } else { (low + high) / 2.0 };
        let radius = corners().map(|p| p.distance(middle)).fold(0.0, f64::max);
        let area = part.iter().map(|[a, b, c]| (*b - *a).cross(*c - *a) / 2.0).sum();
        let axis = if (high - low).max_element() == high.x - low.x {
            0
        } else if high.y - low.y >= high.z - low.z {
            1
        } else {
            2
        };
        if count > LEAF {
            let along = |[a, b, c]: &[DVec3; 3]| a[axis] + b[axis] + c[axis];
            part.select_nth_unstable_by(count / 2, |s, t| along(s).total_cmp(&along(t)));
        }
        let number = self.groups.len();
        self.groups.push(Group { middle, radius, area, first: first as u32, count: count as u32, halves: [0; 2] });
        if count > LEAF {
            let half = count / 2;
            self.groups[number].halves = [self.divide(first, half), self.divide(first + half, count - half)];
        }
        number as u32
    }

    pub(super) fn winding(&self, p: DVec3) -> f64 {
        let mut sum = 0.0;
        let mut pending = if self.groups.is_empty() { Vec::new() } else { vec![0u32] };
        while let Some(number) = pending.pop() {
            let group = &self.groups[number as usize];
            let to = group.middle - p;
            let squared = to.length_squared();
            if squared > FAR * FAR * group.radius * group.radius {
                sum += group.area.dot(to) / (squared * squared.sqrt());
            } else if group.halves == [0; 2] {
                let part = &self.triangles[group.first as usize..(group.first + group.count) as usize];
                sum += part.iter().map(|&triangle| solid_angle(p, triangle)).sum::<f64>();
            } else {
                pending.extend(group.halves);
            }
        }
        sum / (4.0 * PI)
    }
}

/// The solid angle under which `p` sees a triangle, positive from behind.
fn solid_angle(p: DVec3, triangle: [DVec3; 3]) -> f64 {
    let [a, b, c] = triangle.map(|corner| corner - p);
    let (x, y, z) = (a.length(), b.length(), c.length());
    2.0 * libm::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y)
}

/// Fans over the rims. Each edge that more triangles run along one way than the other is part of one; which edges make a
/// rim matters little, as all of a piece lead to one middle.
fn caps(mesh: &TriMesh) -> Vec<[DVec3; 3]> {
    let mut uses: BTreeMap<(u32, u32), i32> = BTreeMap::new();
    for &[a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            if from != to {
                *uses.entry((from.min(to), from.max(to))).or_insert(0) += if from < to { 1 } else { -1 };
            }
        }
    }
    let open: Vec<(u32, u32, i32)> = uses.into_iter().filter(|used| used.1 != 0).map(|((a, b), n)| (a, b, n)).collect();
    // The pieces that the open edges make.
    let mut piece: BTreeMap<u32, u32> = open.iter().flat_map(|&(a, b, _)| [(a, a), (b, b)]).collect();
    loop {
        let mut is_changed = false;
        for (a, b, _) in &open {
            let least = piece[a].min(piece[b]);
            for end in [a, b] {
                is_changed |= piece.insert(*end, least) != Some(least);
            }
        }
        if !is_changed {
            break;
        }
    }
    let at = |v: u32| mesh.positions[v as usize].as_dvec3();
    let mut middles: BTreeMap<u32, (DVec3, f64)> = BTreeMap::new();
    for (&v, &of) in &piece {
        let sum = middles.entry(of).or_insert((DVec3::ZERO, 0.0));
        *sum = (sum.0 + at(v), sum.1 + 1.0);
    }
    let mut fans = Vec::new();
    for &(a, b, count) in &open {
        let (sum, number) = middles[&piece[&a]];
        let (from, to) = if count > 0 { (b, a) } else { (a, b) };
        fans.extend((0..count.abs()).map(|_| [at(from), at(to), sum / number]));
    }
    fans.retain(|fan| fan.iter().all(|p| p.is_finite()));
    fans
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::Vec3;
    use lumen_mesh::shapes::{icosphere, tube};

    fn sides(mesh: &TriMesh) -> Sides {
        let triangles: Vec<_> = (0..mesh.triangles.len()).map(|t| mesh.corners(t).map(Vec3::as_dvec3)).collect();
        Sides::new(mesh, &triangles)
    }

    #[test]
    fn an_octant_fills_an_eighth_of_the_view() {
        let angle = solid_angle(DVec3::ZERO, [DVec3::X, DVec3::Y, DVec3::Z]);
        assert!((angle - PI / 2.0).abs() < 1e-14, "{angle}");
        assert!((solid_angle(DVec3::ZERO, [DVec3::Y, DVec3::X, DVec3::Z]) + PI / 2.0).abs() < 1e-14);
    }

    #[test]
    fn around_a_point_inside_it_is_one_and_outside_none() {
        let centre = Vec3::new(30.0, -8.0, 5.0);
        let mut mesh = icosphere(4, 5.0, centre);
        let closed = sides(&mesh);
        mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
        let turned = sides(&mesh);
        for (off, expected) in [(0.0, 1.0), (3.0, 1.0), (4.9, 1.0), (5.1, 0.0), (8.0, 0.0), (90.0, 0.0)] {
            let p = centre.as_dvec3() + DVec3::new(0.6, 0.0, 0.8) * off;
            assert!((closed.winding(p) - expected).abs() < 0.02, "{off}: {}", closed.winding(p));
            assert!((turned.winding(p) + expected).abs() < 0.02);
        }
    }

    #[test]
    fn the_sum_by_groups_is_that_of_all_triangles() {
        let mesh = tube(40, 120, 60.0, |z| 2.0 + z / 20.0);
        let sides = sides(&mesh);
        for i in 0..60 {
            let p = DVec3::new(f64::from(i % 7) - 3.0, f64::from(i % 5) - 2.0, f64::from(i) * 1.3 - 8.0);
            let all: f64 = sides.triangles.iter().map(|&triangle| solid_angle(p, triangle)).sum::<f64>() / (4.0 * PI);
            assert!((sides.winding(p) - all).abs() < 0.01, "{p}: {} {all}", sides.winding(p));
        }
    }

    #[test]
    fn open_ends_are_capped() {
        let sides = sides(&tube(40, 60, 30.0, |_| 2.0));
        for (p, expected) in [
            (DVec3::new(0.5, 0.0, 0.2), 1.0),
            (DVec3::new(0.5, 0.0, -0.2), 0.0),
            (DVec3::new(0.0, 1.8, 29.8), 1.0),
            (DVec3::new(0.0, 1.8, 30.2), 0.0),
            (DVec3::new(2.2, 0.0, 15.0), 0.0),
        ] {
            assert!((sides.winding(p) - expected).abs() < 0.02, "{p}: {}", sides.winding(p));
        }
        assert_eq!(Sides::default().winding(DVec3::ZERO), 0.0);
    }
}
