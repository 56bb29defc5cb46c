//! Faces of any number of corners, and their triangles.
//!
//! Quads that are convex are cut along their shorter diagonal, as VTK does; everything else is cut ear by ear
//! (Meisters 1975, "Polygons have ears") in the plane of its Newell normal, so that a concave face does not fold
//! over itself. A face of n corners always gives n - 2 triangles and every corner is used: leaving out those on a
//! straight edge, as the crate `earcut` does, would tear the face from its neighbours.

use glam::DVec3;

use lumen_mesh::Vec3;

/// Corners of a face beyond which it is fanned at once: ears would use up their time before they had cut much of it, and
/// the lists for them take more memory than the file may have been long.
const LARGEST: usize = 1 << 18;

/// The faces of a file in its order.
#[derive(Default)]
pub(super) struct Faces {
    corners: Vec<u32>,
    ends: Vec<usize>,
    /// Faces of fewer than three corners, which are not kept.
    pub(super) short: usize,
    /// The cell of the file that a face is of: the one under way, and that of each face where it is noted.
    cell: u32,
    cells: Option<Vec<u32>>,
}

/// Triangles cut from faces.
#[derive(Default)]
pub(super) struct Triangulated {
    pub(super) triangles: Vec<[u32; 3]>,
    /// Faces of more than three corners.
    pub(super) polygons: usize,
    /// Faces too large or too tangled to be cut by ears, cut as a fan.
    pub(super) fanned: usize,
}

impl Faces {
    /// Adds a corner to the face at the end.
    pub(super) fn push_corner(&mut self, vertex: u32) {
        self.corners.push(vertex);
    }

    /// Ends the face whose corners were pushed last.
    pub(super) fn finish_face(&mut self) {
        let start = self.ends.last().copied().unwrap_or(0);
        if self.corners.len() - start < 3 {
            self.corners.truncate(start);
            self.short += 1;
        } else {
            self.ends.push(self.corners.len());
            if let Some(cells) = &mut self.cells {
                cells.push(self.cell);
            }
        }
    }

    /// Says which cell of the file the faces that follow are of; to be said before the first.
    pub(super) fn of_cell(&mut self, cell: u32) {
        self.cell = cell;
        self.cells.get_or_insert_default();
    }

    /// The cell of each triangle that the faces will be cut into; none where it was not said.
    pub(super) fn cells(&self) -> Vec<u32> {
        let Some(cells) = &self.cells else { return Vec::new() };
        let mut of_triangles = Vec::with_capacity(self.triangles());
        let mut start = 0;
        for (&end, &cell) in self.ends.iter().zip(cells) {
            of_triangles.extend(std::iter::repeat_n(cell, end - start - 2));
            start = end;
        }
        of_triangles
    }

    /// How many triangles the faces will be cut into.
    pub(super) fn triangles(&self) -> usize {
        self.ends.last().map_or(0, |&end| end - 2 * self.ends.len())
    }

    /// Adds a whole face.
    pub(super) fn push(&mut self, corners: &[u32]) {
        self.corners.extend_from_slice(corners);
        self.finish_face();
    }

    /// Cuts all faces; corners must be in range of `positions`.
    pub(super) fn triangulate(&self, positions: &[Vec3]) -> Triangulated {
        let mut result = Triangulated {
            triangles: Vec::with_capacity(self.corners.len() - 2 * self.ends.len()),
            ..Default::default()
        };
        let mut cutter = Cutter { work_left: 1 << 27, ..Default::default() };
        let mut start = 0;
        for &end in &self.ends {
            match &self.corners[start..end] {
                &[a, b, c] => result.triangles.push([a, b, c]),
                polygon if polygon.len() > LARGEST => {
                    result.polygons += 1;
                    result.fanned += 1;
                    let hub = polygon[0];
                    result.triangles.extend(polygon[1..].windows(2).map(|two| [hub, two[0], two[1]]));
                }
                polygon => {
                    result.polygons += 1;
                    result.fanned += usize::from(!cutter.cut(polygon, positions, &mut result.triangles));
                }
            }
            start = end;
        }
        result
    }
}

/// Cuts polygons by ears; keeps its lists between polygons.
#[derive(Default)]
struct Cutter {
    /// Corners still to be compared with ears in this file: ears take quadratic time, and a file may hold one
    /// polygon of a million corners. When it is used up the rest is fanned.
    work_left: u64,
    flat: Vec<[f64; 2]>,
    next: Vec<usize>,
    previous: Vec<usize>,
}

impl Cutter {
    /// Adds the triangles of `polygon` (four corners or more) to `triangles`; false if part of it was fanned.
    fn cut(&mut self, polygon: &[u32], positions: &[Vec3], triangles: &mut Vec<[u32; 3]>) -> bool {
        self.flatten(polygon, positions);
        if let &[a, b, c, d] = polygon
            && (0..4).all(|i| turn(self.flat[i], self.flat[(i + 1) % 4], self.flat[(i + 2) % 4]) > 0.0)
        {
            let length = |from: u32, to: u32| positions[from as usize].distance_squared(positions[to as usize]);
            triangles.extend(if length(a, c) <= length(b, d) {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            });
            return true;
        }
        let n = polygon.len();
        self.next = (0..n).map(|i| (i + 1) % n).collect();
        self.previous = (0..n).map(|i| (i + n - 1) % n).collect();
        let (mut left, mut tip, mut refused) = (n, 0, 0);
        while left > 3 && refused < left {
            let (before, after) = (self.previous[tip], self.next[tip]);
            if self.is_ear(tip, left) {
                triangles.push([polygon[before], polygon[tip], polygon[after]]);
                (self.next[before], self.previous[after]) = (after, before);
                left -= 1;
                refused = 0;
                // Passing one corner by gives rounder triangles than eating on from the same place.
                tip = self.next[after];
            } else {
                refused += 1;
                tip = after;
            }
        }
        let fanned = left > 3;
        let (hub, mut at) = (tip, self.next[tip]);
        for _ in 2..left {
            triangles.push([polygon[hub], polygon[at], polygon[self.next[at]]]);
            at = self.next[at];
        }
        !fanned
    }

    /// Puts the polygon into the plane of the two axes in which it is largest, counter-clockwise.
    fn flatten(&mut self, polygon: &[u32], positions: &[Vec3]) {
        let origin = positions[polygon[0] as usize].as_dvec3();
        let at = |i: usize| positions[polygon[i % polygon.len()] as usize].as_dvec3() - origin;
        let normal: DVec3 = (0..polygon.len()).map(|i| at(i).cross(at(i + 1))).sum();
        let size = normal.abs();
        let (u, v, along) = if size.x > size.y && size.x > size.z {
            (1, 2, normal.x)
        } else if size.y > size.z {
            (2, 0, normal.y)
        } else {
            (0, 1, normal.z)
        };
        let (u, v) = if along < 0.0 { (v, u) } else { (u, v) };
        self.flat.clear();
        self.flat.extend((0..polygon.len()).map(|i| [at(i)[u], at(i)[v]]));
    }

    /// Whether the triangle at `tip` can be cut off: it turns left and no other corner lies in it or on its rim.
    fn is_ear(&mut self, tip: usize, left: usize) -> bool {
        let (before, after) = (self.previous[tip], self.next[tip]);
        let [a, b, c] = [before, tip, after].map(|i| self.flat[i]);
        if self.work_left < left as u64 || turn(a, b, c) <= 0.0 {
            return false;
        }
        self.work_left -= left as u64;
        let mut other = self.next[after];
        while other != before {
            let p = self.flat[other];
            if p != a && p != b && p != c && turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0 {
                return false;
            }
            other = self.next[other];
        }
        true
    }
}

/// Twice the signed area of a triangle in the plane: positive when it turns left.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::triangle_area;

    /// The triangles of one face over points of a tilted plane, after checking that they cover it exactly:
    /// right count, right area, none turned over.
    fn cut(outline: &[(f32, f32)], area: f64) -> Vec<[u32; 3]> {
        let positions: Vec<Vec3> = outline.iter().map(|&(x, y)| Vec3::new(x, y, 2.0 * x - y)).collect();
        let mut faces = Faces::default();
        faces.push(&(0..outline.len() as u32).collect::<Vec<_>>());
        let result = faces.triangulate(&positions);
        assert_eq!((result.triangles.len(), result.polygons, result.fanned), (outline.len() - 2, 1, 0));
        let tilt = 6f64.sqrt();
        let sum: f64 = result.triangles.iter().map(|t| triangle_area(t.map(|v| positions[v as usize]))).sum();
        assert!((sum - area * tilt).abs() < 1e-9, "area {sum} of {}", area * tilt);
        result.triangles
    }

    #[test]
    fn convex_quads_take_the_shorter_diagonal() {
        assert_eq!(cut(&[(0.0, 0.0), (2.0, 0.0), (3.0, 1.0), (0.0, 1.0)], 2.5), [[0, 1, 3], [1, 2, 3]]);
    }

    #[test]
    fn concave_faces_do_not_fold_over() {
        cut(&[(0.0, 0.0), (4.0, 0.0), (1.0, 1.0), (0.0, 4.0)], 4.0);
        cut(&[(4.0, 0.0), (1.0, 1.0), (0.0, 4.0), (0.0, 0.0)], 4.0);
        cut(&[(0.0, 0.0), (3.0, 0.0), (3.0, 3.0), (2.0, 3.0), (2.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)], 7.0);
        cut(&[(0.0, 0.0), (0.0, 3.0), (1.0, 3.0), (1.0, 1.0), (2.0, 1.0), (2.0, 3.0), (3.0, 3.0), (3.0, 0.0)], 7.0);
    }

    #[test]
    fn corners_on_a_straight_edge_are_used() {
        let triangles = cut(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)], 4.0);
        assert!((0..5).all(|v| triangles.as_flattened().contains(&v)));
    }

    #[test]
    fn a_face_without_area_still_gives_its_triangles() {
        let mut faces = Faces::default();
        faces.push(&[0, 1, 2, 3]);
        faces.push(&[0, 1]);
        let result = faces.triangulate(&[Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::X * 3.0]);
        assert_eq!((result.triangles.len(), result.fanned, faces.short), (2, 1, 1));
    }

    #[test]
    fn triangles_know_the_cell_that_they_are_cut_from() {
        let mut faces = Faces::default();
        for (cell, corners) in [(7, &[0, 1, 2, 3, 4][..]), (3, &[0, 1]), (2, &[0, 2, 3])] {
            faces.of_cell(cell);
            faces.push(corners);
        }
        assert_eq!((faces.cells(), faces.triangles()), (vec![7, 7, 7, 2], 4));
    }

    #[test]
    fn a_huge_face_ends_in_good_time() {
        // A comb: every second corner is a notch, the worst case for ears.
        let n = 60_000u32;
        let positions: Vec<Vec3> = (0..n).map(|i| Vec3::new(i as f32, (i % 2) as f32, 0.0)).collect();
        let mut faces = Faces::default();
        faces.push(&(0..n).collect::<Vec<_>>());
        assert_eq!(faces.triangulate(&positions).triangles.len() as u32, n - 2);
    }
}
