//! Splitting: where more than two triangles share an edge, or fans touch in a vertex, the sheets are parted.
//!
//! Sides of triangles are joined in pairs, and a vertex is divided into the fans that the pairs leave (cutting, as in
//! Gueziec, Taubin, Lazarus and Horn, "Cutting and stitching: converting sets of polygons to manifold surfaces", 2001).
//! At an edge of more than two triangles, the pairs are those that bound the same wedge of the inside, where as many
//! triangles run along the edge as against it and none is of a sheet much smaller than the others: two vessels that touch
//! become two vessels. Elsewhere the largest sheets are joined first, of equal ones the flattest pair, and what is left
//! over gets an open edge: a fin comes off the wall it stands on. A sheet is what hangs together by edges of two triangles.
//! Of triangles over the same three vertices that share such an edge, the first stays.
//!
//! No vertex moves. Afterwards every edge has one triangle or two, and every vertex one fan.

use glam::DVec3;

use super::faults::Faults;
use super::sides::{by_edge, doubles};
use crate::disjoint_sets::{root, singles, union};
use crate::{Blend, Topology, TriMesh, compacted, used_vertices};

/// A sheet is much smaller than one of more than so many times its triangles.
const MUCH: u32 = 10;
/// No side.
const NONE: u32 = u32::MAX;

/// A surface whose sheets were parted.
#[derive(Clone, Debug, PartialEq)]
pub struct Split {
    /// The surface: its first vertices are those of before.
    pub mesh: TriMesh,
    /// What each vertex was made of.
    pub vertices: Blend,
    /// What each triangle was made of.
    pub triangles: Blend,
    /// Edges of more than two triangles that there were.
    pub edges: usize,
    /// Vertices that were divided.
    pub divided: usize,
    /// Triangles over the same three vertices as another that were left out.
    pub duplicates: usize,
}

/// Parts the sheets of `mesh`, whose triangles repeat no vertex.
pub fn split(mesh: &TriMesh) -> Split {
    if is_manifold(mesh) {
        let own = |count: usize| Blend::of_rows(0..count as u32);
        let (vertices, triangles) = (own(mesh.positions.len()), own(mesh.triangles.len()));
        return Split { mesh: mesh.clone(), vertices, triangles, edges: 0, divided: 0, duplicates: 0 };
    }
    let doubles = doubles(mesh);
    let kept: Vec<u32> = (0..mesh.triangles.len() as u32).filter(|&t| !doubles[t as usize]).collect();
    let mut sheets = Sheets::of(mesh, kept.iter().map(|&t| mesh.triangles[t as usize]).collect());
    let edges = sheets.pair();
    let mut source_of: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    let mut parted = sheets.parted(&mut source_of);
    while sheets.loosen(&parted) {
        source_of.truncate(mesh.positions.len());
        parted = sheets.parted(&mut source_of);
    }
    let mut is_divided = vec![false; mesh.positions.len()];
    source_of[mesh.positions.len()..].iter().for_each(|&v| is_divided[v as usize] = true);
    // Vertices of triangles that were left out go with them.
    let used = used_vertices(source_of.len(), &parted);
    let positions: Vec<_> = source_of.iter().map(|&v| mesh.positions[v as usize]).collect();
    let vertices = Blend::of_rows(used.iter().map(|&v| source_of[v as usize]));
    Split {
        mesh: compacted(&positions, parted),
        vertices,
        triangles: Blend::of_rows(kept.iter().copied()),
        edges,
        divided: is_divided.iter().filter(|&&is| is).count(),
        duplicates: mesh.triangles.len() - kept.len(),
    }
}

/// Whether every edge has at most two triangles and every vertex one fan.
fn is_manifold(mesh: &TriMesh) -> bool {
    let found = Faults::of(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
    found.non_manifold_edges.is_empty() && found.non_manifold_vertices.is_empty()
}

/// Triangles, and how their sides are joined.
struct Sheets<'a> {
    mesh: &'a TriMesh,
    triangles: Vec<[u32; 3]>,
    /// For each side the one that it is joined to.
    mates: Vec<u32>,
    /// Whether a triangle was taken off: it is joined to none.
    is_off: Vec<bool>,
}

impl<'a> Sheets<'a> {
    fn of(mesh: &'a TriMesh, triangles: Vec<[u32; 3]>) -> Self {
        let (mates, is_off) = (vec![NONE; 3 * triangles.len()], vec![false; triangles.len()]);
        Self { mesh, triangles, mates, is_off }
    }

    fn join(&mut self, a: u32, b: u32) {
        (self.mates[a as usize], self.mates[b as usize]) = (b, a);
    }

    /// Whether a side runs from the lower to the higher of its vertices.
    fn is_forward(&self, side: u32) -> bool {
        let t = self.triangles[side as usize / 3];
        t[side as usize % 3] < t[(side as usize + 1) % 3]
    }

    /// Joins sides in pairs; how many edges had more than two.
    fn pair(&mut self) -> usize {
        let all = by_edge(&self.triangles);
        let mut parent = singles(self.triangles.len());
        for sides in all.chunk_by(|a, b| a.0 == b.0) {
            if let [(_, a), (_, b)] = *sides {
                self.join(a, b);
                union(&mut parent, a / 3, b / 3);
            }
        }
        let crowds: Vec<Vec<u32>> = all
            .chunk_by(|a, b| a.0 == b.0)
            .filter(|sides| sides.len() > 2)
            .map(|sides| sides.iter().map(|&(_, side)| side).collect())
            .collect();
        if crowds.is_empty() {
            return 0;
        }
        let roots: Vec<u32> = (0..parent.len() as u32).map(|t| root(&mut parent, t)).collect();
        let mut sizes = vec![0u32; roots.len()];
        roots.iter().for_each(|&sheet| sizes[sheet as usize] += 1);
        let sheet_of = |side: u32| sizes[roots[side as usize / 3] as usize];
        crowds.iter().for_each(|sides| self.pair_around(sides, sheet_of));
        crowds.len()
    }

    /// Joins the sides on one edge in pairs of opposite directions; `size` is how many triangles the sheet of a side has.
    fn pair_around(&mut self, sides: &[u32], size: impl Fn(u32) -> u32) {
        let mut around: Vec<(f64, u32)> = sides.iter().zip(self.angles(sides)).map(|(&s, angle)| (angle, s)).collect();
        around.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let forward = around.iter().filter(|&&(_, side)| self.is_forward(side)).count();
        let sizes = || sides.iter().map(|&side| size(side));
        let is_even = sizes().max() <= sizes().min().map(|least| least.saturating_mul(MUCH));
        if 2 * forward == around.len() && is_even {
            // The inside lies behind a triangle that runs forward and before one that runs backward, all around: so the
            // first round leaves forward ones that the backward ones still waiting belong to.
            let mut waiting = Vec::new();
            for &(_, side) in &around {
                if !self.is_forward(side) {
                    waiting.push(side);
                } else if let Some(before) = waiting.pop() {
                    self.join(before, side);
                }
            }
            for &(_, side) in &around {
                if self.is_forward(side)
                    && self.mates[side as usize] == NONE
                    && let Some(before) = waiting.pop()
                {
                    self.join(before, side);
                }
            }
            return;
        }
        let mut pairs = Vec::new();
        for (i, &(angle, side)) in around.iter().enumerate() {
            for &(other_angle, other) in &around[i + 1..] {
                if self.is_forward(side) != self.is_forward(other) {
                    // Two halves of a plane are half a turn apart.
                    let bend = ((other_angle - angle) - std::f64::consts::PI).abs();
                    pairs.push((size(side).min(size(other)), bend, side, other));
                }
            }
        }
        pairs.sort_unstable_by(|a, b| b.0.cmp(&a.0).then(a.1.total_cmp(&b.1)).then((a.2, a.3).cmp(&(b.2, b.3))));
        for (.., side, other) in pairs {
            if self.mates[side as usize] == NONE && self.mates[other as usize] == NONE {
                self.join(side, other);
            }
        }
    }

    /// The angle about the edge, from its lower to its higher vertex, at which the triangle of each side lies.
    fn angles(&self, sides: &[u32]) -> Vec<f64> {
        let at = |v: u32| self.mesh.positions[v as usize].as_dvec3();
        let corners = |side: u32| {
            let (t, i) = (self.triangles[side as usize / 3], side as usize % 3);
            [t[i], t[(i + 1) % 3], t[(i + 2) % 3]]
        };
        let [a, b, _] = corners(sides[0]);
        let (low, high) = (a.min(b), a.max(b));
        let axis = (at(high) - at(low)).try_normalize().unwrap_or(DVec3::Z);
        let right = axis.any_orthonormal_vector();
        let up = axis.cross(right);
        let angle = |&side: &u32| {
            let out = at(corners(side)[2]) - at(low);
            libm::atan2(out.dot(up), out.dot(right))
        };
        sides.iter().map(angle).collect()
    }

    /// The triangles over vertices divided by the fans around them; `source_of` grows by the vertex that each new one was.
    fn parted(&self, source_of: &mut Vec<u32>) -> Vec<[u32; 3]> {
        // Corners that are joined have one root.
        let mut parent = singles(self.mates.len());
        let corner_at = |t: u32, v: u32| {
            let at = self.triangles[t as usize].iter().position(|&corner| corner == v).unwrap_or(0);
            3 * t + at as u32
        };
        for (side, &mate) in (0u32..).zip(&self.mates) {
            if mate != NONE && side < mate {
                let (t, other) = (side / 3, mate / 3);
                let corners = self.triangles[t as usize];
                for v in [corners[side as usize % 3], corners[(side as usize + 1) % 3]] {
                    union(&mut parent, corner_at(t, v), corner_at(other, v));
                }
            }
        }
        let mut is_taken = vec![false; source_of.len()];
        let mut vertex_of = vec![NONE; self.mates.len()];
        let mut parted = self.triangles.clone();
        for (corner, v) in parted.as_flattened_mut().iter_mut().enumerate() {
            let slot = root(&mut parent, corner as u32) as usize;
            if vertex_of[slot] == NONE {
                // The first fan keeps the vertex.
                vertex_of[slot] = if std::mem::replace(&mut is_taken[*v as usize], true) {
                    source_of.push(*v);
                    source_of.len() as u32 - 1
                } else {
                    *v
                };
            }
            *v = vertex_of[slot];
        }
        parted
    }

    /// Takes triangles off that still share an edge with two others, because they hang together beyond both of its ends;
    /// whether there were any. What shares an edge with one other after all is joined to it.
    fn loosen(&mut self, parted: &[[u32; 3]]) -> bool {
        let mut was_any = false;
        for sides in by_edge(parted).chunk_by(|a, b| a.0 == b.0) {
            let is_sound = match sides {
                [_] => true,
                [(_, a), (_, b)] => self.mates[*a as usize] == *b,
                _ => false,
            };
            // What was taken off in this round has vertices of its own in the next.
            if is_sound || sides.iter().any(|&(_, side)| self.is_off[side as usize / 3]) {
                continue;
            }
            if let [(_, a), (_, b)] = *sides
                && self.is_forward(a) != self.is_forward(b)
            {
                self.join(a, b);
                continue;
            }
            was_any = true;
            let kept = sides[0].1;
            let mate = self.mates[kept as usize];
            for &(_, side) in sides.iter().filter(|&&(_, side)| side != kept && side != mate) {
                self.is_off[side as usize / 3] = true;
                for own in 3 * (side / 3)..3 * (side / 3) + 3 {
                    let other = std::mem::replace(&mut self.mates[own as usize], NONE);
                    if other != NONE {
                        self.mates[other as usize] = NONE;
                    }
                }
            }
        }
        was_any
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::shapes::{icosphere, joined, tube};
    use crate::{Vec3, components};

    /// Two tetrahedra; the vertices of the second that are given are those of the first.
    fn two(shared: &[(u32, u32)]) -> TriMesh {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let one: Vec<[u32; 3]> = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let of = |v: u32| shared.iter().find(|&&(theirs, _)| theirs == v).map_or(v + 4, |&(_, ours)| ours);
        let other = one.iter().map(|t| t.map(of).map(|v| v));
        // The second is turned half around the z axis: it touches the first in that axis.
        let positions = corners.iter().copied().chain(corners.map(|p| Vec3::new(-p.x, -p.y, p.z))).collect();
        TriMesh { positions, triangles: one.iter().copied().chain(other).collect() }
    }

    #[test]
    fn bodies_that_touch_in_an_edge_or_a_vertex_become_two() {
        for (shared, edges, divided) in [(&[(0, 0), (3, 3)][..], 1, 2), (&[(0, 0)][..], 0, 1)] {
            let mesh = two(shared);
            let used = used_vertices(8, &mesh.triangles).len();
            let found = split(&TriMesh { ..compacted(&mesh.positions, mesh.triangles.clone()) });
            assert_eq!((found.edges, found.divided, found.duplicates), (edges, divided, 0));
            assert_eq!(found.mesh.positions.len(), used + divided);
            assert_eq!(components(8, &found.mesh.triangles).triangle_counts, [4, 4]);
            assert_eq!(Topology::new(8, &found.mesh.triangles).edge_counts().boundary, 0);
        }
    }

    #[test]
    fn a_fin_comes_off_and_the_tube_stays_whole() {
        let tube = tube(12, 10, 20.0, |_| 3.0);
        let mut mesh = tube.clone();
        let [a, b, _] = mesh.triangles[60];
        mesh.positions.push(mesh.positions[a as usize] * Vec3::new(2.0, 2.0, 1.0));
        mesh.triangles.push([b, a, mesh.positions.len() as u32 - 1]);
        let found = split(&mesh);
        assert_eq!((found.edges, found.mesh.positions.len()), (1, tube.positions.len() + 3));
        assert_eq!(found.mesh.triangles[..tube.triangles.len()], tube.triangles);
        assert!(is_manifold(&found.mesh));
        assert_eq!(components(found.mesh.positions.len(), &found.mesh.triangles).triangle_counts, [240, 1]);
    }

    #[test]
    fn what_is_there_twice_is_there_once_and_what_is_sound_is_not_touched() {
        let sphere = icosphere(2, 5.0, Vec3::ZERO);
        assert_eq!(split(&sphere).mesh, sphere);
        let twice = TriMesh { triangles: [&sphere.triangles[..], &sphere.triangles].concat(), ..sphere.clone() };
        let found = split(&twice);
        assert_eq!((found.mesh, found.duplicates, found.edges), (sphere.clone(), 320, 0));
        let apart = joined(&[sphere.clone(), icosphere(1, 2.0, Vec3::X * 9.0)]);
        assert_eq!(split(&apart).mesh, apart);
        // A Moebius band is a manifold, with no inside.
        let band = vec![[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 0, 4], [4, 0, 1]];
        let positions = (0..5).map(|i| Vec3::new(i as f32, (i * i) as f32, (i % 2) as f32)).collect();
        let band = TriMesh { positions, triangles: band };
        assert_eq!(split(&band).mesh, band);
    }

    proptest! {
        #[test]
        fn whatever_comes_in_a_manifold_comes_out(
            places in prop::collection::vec(prop::array::uniform3(-5i8..5), 3..9),
            corners in prop::collection::vec(prop::array::uniform3(0usize..9), 0..40),
        ) {
            let positions: Vec<Vec3> = places.iter().map(|p| Vec3::from(p.map(f32::from))).collect();
            let count = positions.len();
            let mut triangles: Vec<[u32; 3]> = corners.iter().map(|t| t.map(|v| (v % count) as u32)).collect();
            triangles.retain(|&[a, b, c]| a != b && b != c && c != a);
            let mesh = compacted(&positions, triangles);
            let found = split(&mesh);
            prop_assert!(is_manifold(&found.mesh));
            prop_assert_eq!(found.mesh.triangles.len() + found.duplicates, mesh.triangles.len());
            for (after, blend) in found.mesh.triangles.iter().zip(0..) {
                let source = found.triangles.sources(blend)[0].0 as usize;
                let before = mesh.corners(source);
                prop_assert_eq!(after.map(|v| found.mesh.positions[v as usize]), before);
            }
            prop_assert_eq!(split(&found.mesh).mesh, found.mesh);
        }
    }
}
