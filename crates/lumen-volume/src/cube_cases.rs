//! The 256 cases of marching cubes, traced instead of tabulated.
//!
//! Marching cubes (Lorensen and Cline 1987) looks up, for each of the 256 ways in which the corners of a cube can
//! lie inside or outside, the triangles that separate them. The published table left holes where two neighbours
//! split an ambiguous face (inside corners on one diagonal) differently (Dürst 1988). Here each case is traced from
//! one rule, so neighbours cannot disagree:
//!
//! - On each face, seen from outside the cube and walked counter-clockwise, every run of inside corners is cut off
//!   by one segment, from the edge where the walk comes in to the edge where it goes out. An ambiguous face so
//!   separates its two inside corners. The neighbour walks the same face the other way round and finds the same
//!   segments reversed.
//! - A crossed edge ends one segment and begins another, so the segments link up into closed loops, which run
//!   counter-clockwise seen from the outside of the object.
//! - Each loop is triangulated with the shortest diagonals of which none joins two edges of one face: such a
//!   diagonal could coincide with one of the neighbour's and put four triangles on one edge.
//!
//! Every crossed edge lies on one loop of each of its four cubes, so the surface of any mask is a manifold, in its
//! vertices too.

use glam::{IVec3, Vec3};

/// The edges of a cube in which a surface can have a vertex.
pub(crate) const EDGES: usize = 12;

/// The triangles of every case: corners inside -> edges of the cube.
///
/// Corner `x + 2 y + 4 z` lies at (x, y, z) of the unit cube and is bit `1 << corner` of a case. Edge `4 a + b` runs
/// along axis `a` (0 = x, 1 = y, 2 = z); `b` is its place on the other two axes, the lower axis in the lower bit.
pub(crate) struct CubeCases {
    starts: [u16; 257],
    triangles: Vec<[u8; 3]>,
}

impl CubeCases {
    /// Traces all cases.
    pub(crate) fn new() -> Self {
        let mut starts = [0; 257];
        let mut triangles = Vec::with_capacity(900);
        for case in 0..256 {
            for chain in loops(case as u8) {
                triangulate(&chain, &mut triangles);
            }
            starts[case + 1] = triangles.len() as u16;
        }
        Self { starts, triangles }
    }

    /// The triangles of a case, each as three edges of the cube, counter-clockwise seen from outside the object.
    pub(crate) fn triangles(&self, case: u8) -> &[[u8; 3]] {
        let case = usize::from(case);
        &self.triangles[usize::from(self.starts[case])..usize::from(self.starts[case + 1])]
    }
}

/// The loops of every case, each of which is one vertex of a surface net.
pub(crate) struct CubeLoops {
    /// For each case, the loop that each edge lies on.
    of_edge: Vec<[u8; EDGES]>,
    /// For each case, the middle of each loop's edges in the unit cube.
    middles: Vec<Vec<Vec3>>,
}

impl CubeLoops {
    /// Traces all cases; case 0, which no surface crosses, has one loop of all edges.
    pub(crate) fn new() -> Self {
        let mut of_edge = vec![[0; EDGES]; 256];
        let mut middles = vec![vec![Vec3::splat(0.5)]];
        for (case, of_edge) in of_edge.iter_mut().enumerate().skip(1) {
            let loops = loops(case as u8);
            for (n, edges) in loops.iter().enumerate() {
                for &edge in edges {
                    of_edge[edge] = n as u8;
                }
            }
            let middle = |edges: &Vec<usize>| {
                let doubled = edges.iter().map(|&edge| IVec3::from(doubled_midpoint(edge))).sum::<IVec3>();
                doubled.as_vec3() / (2 * edges.len()) as f32
            };
            middles.push(loops.iter().map(middle).collect());
        }
        Self { of_edge, middles }
    }

    /// The loop of a case that a crossed edge lies on.
    pub(crate) fn of_edge(&self, case: u8, edge: usize) -> u8 {
        self.of_edge[usize::from(case)][edge]
    }

    /// Where the loops of a case lie in the unit cube.
    pub(crate) fn middles(&self, case: u8) -> &[Vec3] {
        &self.middles[usize::from(case)]
    }
}

/// The corners of a face counter-clockwise seen from outside the cube: `side` 0 or 1 of `axis`.
fn face_corners(axis: usize, side: usize) -> [usize; 4] {
    let (u, v) = (1 << ((axis + 1) % 3), 1 << ((axis + 2) % 3));
    let base = side << axis;
    if side == 1 { [base, base + u, base + u + v, base + v] } else { [base, base + v, base + u + v, base + u] }
}

/// The edge between two adjacent corners.
fn edge_between(a: usize, b: usize) -> usize {
    let axis = (a ^ b).trailing_zeros() as usize;
    let low = a & b;
    let place = match axis {
        0 => low >> 1,
        1 => (low & 1) | (low >> 1 & 2),
        _ => low & 3,
    };
    4 * axis + place
}

/// The two faces an edge lies on, as a mask with bit `2 axis + side`.
fn faces_of(edge: usize) -> u8 {
    let (axis, place) = (edge / 4, edge % 4);
    let others = [[1, 2], [0, 2], [0, 1]][axis];
    1 << (2 * others[0] + (place & 1)) | 1 << (2 * others[1] + (place >> 1))
}

/// Twice the position of an edge's midpoint in the unit cube.
fn doubled_midpoint(edge: usize) -> [i32; 3] {
    let (axis, place) = (edge / 4, edge as i32 % 4);
    let (low, high) = (2 * (place & 1), 2 * (place >> 1));
    match axis {
        0 => [1, low, high],
        1 => [low, 1, high],
        _ => [low, high, 1],
    }
}

/// The closed loops of crossed edges of a case, each beginning at its smallest edge.
fn loops(case: u8) -> Vec<Vec<usize>> {
    let inside = |corner: usize| case >> corner & 1 == 1;
    let mut next = [None; EDGES];
    for axis in 0..3 {
        for side in 0..2 {
            let corners = face_corners(axis, side);
            for i in 0..4 {
                if inside(corners[(i + 3) % 4]) || !inside(corners[i]) {
                    continue;
                }
                let from = edge_between(corners[(i + 3) % 4], corners[i]);
                let mut last = i;
                while inside(corners[(last + 1) % 4]) {
                    last += 1;
                }
                next[from] = Some(edge_between(corners[last % 4], corners[(last + 1) % 4]));
            }
        }
    }
    let mut found = Vec::new();
    for first in 0..EDGES {
        let mut chain = Vec::new();
        let mut edge = first;
        while let Some(to) = next[edge].take() {
            chain.push(edge);
            edge = to;
        }
        if !chain.is_empty() {
            found.push(chain);
        }
    }
    found
}

/// Appends the triangles of one loop: the triangulation with the least sum of squared diagonals among those that
/// join no two edges of one face (dynamic programme over sub-polygons, Klincsek 1980).
fn triangulate(chain: &[usize], triangles: &mut Vec<[u8; 3]>) {
    const FORBIDDEN: i32 = 1 << 20;
    let n = chain.len();
    let length = |i: usize, j: usize| -> i32 {
        if j == i + 1 || (i == 0 && j == n - 1) {
            return 0;
        }
        if faces_of(chain[i]) & faces_of(chain[j]) != 0 {
            return FORBIDDEN;
        }
        let (p, q) = (doubled_midpoint(chain[i]), doubled_midpoint(chain[j]));
        (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum()
    };
    let mut cost = [[0i32; EDGES]; EDGES];
    let mut apex = [[0usize; EDGES]; EDGES];
    for width in 2..n {
        for i in 0..n - width {
            let j = i + width;
            let candidates = (i + 1..j).map(|m| (cost[i][m] + cost[m][j] + length(i, m) + length(m, j), m));
            let (least, at) = candidates.min().expect("a polygon has an apex between its ends");
            (cost[i][j], apex[i][j]) = (least, at);
        }
    }
    debug_assert!(cost[0][n - 1] < FORBIDDEN, "every loop of a cube has a triangulation without face diagonals");
    let mut pending = vec![(0, n - 1)];
    while let Some((i, j)) = pending.pop() {
        if j > i + 1 {
            let m = apex[i][j];
            triangles.push([chain[i] as u8, chain[m] as u8, chain[j] as u8]);
            pending.extend([(m, j), (i, m)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn crossed(case: u8) -> Vec<usize> {
        let inside = |corner: usize| case >> corner & 1 == 1;
        let pairs = (0..8).flat_map(|a| (0..3).map(move |axis| (a, a | 1 << axis)));
        pairs.filter(|&(a, b)| a != b && inside(a) != inside(b)).map(|(a, b)| edge_between(a, b)).collect()
    }

    #[test]
    fn the_twelve_edges_are_numbered_once() {
        let mut edges: Vec<usize> = crossed(0b1001_0110).into_iter().chain(crossed(0b0110_1001)).collect();
        edges.sort_unstable();
        edges.dedup();
        assert_eq!(edges, (0..EDGES).collect::<Vec<_>>());
    }

    #[test]
    fn every_case_crosses_each_of_its_edges_in_one_loop() {
        for case in 0..=255u8 {
            let mut visited: Vec<usize> = loops(case).concat();
            visited.sort_unstable();
            let mut expected = crossed(case);
            expected.sort_unstable();
            assert_eq!(visited, expected, "case {case:08b}");
            assert!(loops(case).iter().all(|chain| (3..=7).contains(&chain.len())), "case {case:08b}");
        }
    }

    #[test]
    fn triangles_meet_in_the_inner_diagonals_and_leave_the_face_segments_open() {
        let cases = CubeCases::new();
        for case in 0..=255u8 {
            let triangles = cases.triangles(case);
            let expected: usize = loops(case).iter().map(|chain| chain.len() - 2).sum();
            assert_eq!(triangles.len(), expected);
            let directed = |t: &[u8; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
            let edges: Vec<(u8, u8)> = triangles.iter().flat_map(directed).collect();
            for &(a, b) in &edges {
                assert_eq!(edges.iter().filter(|&&e| e == (a, b)).count(), 1);
                let on_a_face = faces_of(a.into()) & faces_of(b.into()) != 0;
                assert_eq!(edges.contains(&(b, a)), !on_a_face, "case {case:08b}, edge {a}-{b}");
            }
        }
    }

    #[test]
    fn neighbours_agree_on_every_face_they_share() {
        let cases = CubeCases::new();
        // The segments a case leaves on a face, as edges (place along the face, direction) within it.
        let segments = |case: u8, axis: usize, side: usize| {
            let mut found = Vec::new();
            for t in cases.triangles(case) {
                for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                    let face = 1 << (2 * axis + side);
                    if faces_of(a.into()) & faces_of(b.into()) & face != 0 {
                        let flat = |edge: u8| {
                            let mut at = doubled_midpoint(edge.into());
                            at[axis] = 0;
                            at
                        };
                        found.push((flat(a), flat(b)));
                    }
                }
            }
            found.sort_unstable();
            found
        };
        for axis in 0..3 {
            for low in 0..=255u8 {
                // Every neighbour above `low` that has `low`'s upper corners as its lower ones.
                let lower_corners: Vec<usize> = (0..8).filter(|c| c >> axis & 1 == 0).collect();
                let shared: u8 = lower_corners.iter().map(|&c| (low >> (c | 1 << axis) & 1) << c).sum();
                for upper in 0..16u8 {
                    let above: u8 =
                        lower_corners.iter().enumerate().map(|(i, &c)| (upper >> i & 1) << (c | 1 << axis)).sum();
                    let turned = segments(shared | above, axis, 0).into_iter().map(|(a, b)| (b, a));
                    let mut reversed: Vec<_> = turned.collect();
                    reversed.sort_unstable();
                    assert_eq!(segments(low, axis, 1), reversed);
                }
            }
        }
    }

    #[test]
    fn a_single_inside_corner_is_seen_counter_clockwise_from_outside() {
        let cases = CubeCases::new();
        let [a, b, c] = cases.triangles(1)[0].map(|e| doubled_midpoint(e.into()));
        let (u, v) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        assert!(normal.iter().all(|&n| n > 0), "{normal:?} points away from corner 0");
    }
}
