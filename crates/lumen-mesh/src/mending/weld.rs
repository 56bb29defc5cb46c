//! Welding by a tolerance: open edges that nearly meet are joined.
//!
//! Only vertices on an edge of one triangle take part, since a closed surface has nothing to weld: however near two walls
//! come, they stay two. Pairs are joined from the nearest on (Kruskal's order), so that the result does not depend on the
//! order of the vertices unless two pairs are as near as each other. All vertices that become one lie within the
//! tolerance of each other; the new one is at their mean.
//!
//! Nothing collapses: no two ends of an edge become one, so no triangle is lost, and no vertex is joined over more than
//! [`REACH`] of the mean length of the edges at it, so a rim as narrow as its own triangles stays open, whatever the
//! tolerance. Nor are two vertices joined that a rim leads from one to the other in less than [`ALONG`] times their
//! distance: they are one stretch of it, and not its two sides. What this does not do: a vertex that lies along another's edge (a T-junction) is joined to nothing.

use std::ops::Range;

use glam::{DVec3, Vec3};

use crate::parallel;
use crate::task::{Yielder, at_once, blocks};
use crate::{Blend, SurfaceIndex, Topology, TriMesh};

/// The part of the mean length of its edges by which a vertex is joined at most.
pub const REACH: f32 = 0.5;
/// A rim that leads from one vertex to another in less than so many times their distance does not meet itself there.
pub const ALONG: f32 = 3.0;
/// Partners that are considered for a vertex, the nearest.
const PARTNERS: usize = 16;
/// Vertices that become one, at most.
const MEMBERS: usize = 64;
/// Vertices between two looks at the clock, and of one thread.
const SLICE: usize = 8_192;
const CHUNK: usize = 512;

/// A surface whose open edges were joined.
#[derive(Clone, Debug, PartialEq)]
pub struct Welded {
    /// The surface: the same triangles in the same order.
    pub mesh: TriMesh,
    /// What each vertex was made of.
    pub vertices: Blend,
    /// Vertices that are gone.
    pub joined: usize,
    /// Vertices on open edges at which the tolerance is more than [`REACH`] of the edges' length, so that less was taken.
    pub limited: usize,
}

/// Two vertices that may become one.
#[derive(Clone, Copy, Debug)]
struct Pair {
    squared: f32,
    low: u32,
    high: u32,
}

/// Joins open edges of `mesh` within `tolerance` mm, more than 0.
pub fn weld(mesh: &TriMesh, tolerance: f64) -> Welded {
    at_once(weld_in_slices(mesh, tolerance, &Yielder::never()))
}

/// As [`weld`], resting every few milliseconds.
pub async fn weld_in_slices(mesh: &TriMesh, tolerance: f64, yielder: &Yielder) -> Welded {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let rims = Rims::new(mesh, &topology, tolerance as f32);
    let points: Vec<[u32; 3]> = rims.open.iter().map(|&v| [v; 3]).collect();
    let index = SurfaceIndex::build(&mesh.positions, &points, &yielder.part(0.0..0.4)).await;
    let mut pairs = Vec::new();
    for block in blocks(rims.open.len(), SLICE) {
        let end = block.end;
        pairs.extend(rims.pairs(mesh, &topology, &index, block));
        yielder.rest(0.4 + 0.5 * end as f32 / rims.open.len() as f32).await;
    }
    join(mesh, &topology, &rims, pairs)
}

/// Vertices on open edges.
struct Rims {
    tolerance: f32,
    /// The vertices, ascending, and how far each may be joined.
    open: Vec<u32>,
    reach: Vec<f32>,
    limited: usize,
}

impl Rims {
    fn new(mesh: &TriMesh, topology: &Topology, tolerance: f32) -> Self {
        let is_open = |&v: &u32| topology.edge_uses(v).iter().any(|edge| edge.is_boundary());
        let open: Vec<u32> = (0..mesh.positions.len() as u32).filter(is_open).collect();
        let mean_edge = |v: u32| {
            let p = mesh.positions[v as usize];
            let around = topology.neighbours(v);
            around.iter().map(|&n| f64::from(p.distance(mesh.positions[n as usize]))).sum::<f64>() / around.len() as f64
        };
        let reach: Vec<f32> = open.iter().map(|&v| REACH * mean_edge(v) as f32).collect();
        let limited = reach.iter().filter(|&&reach| reach < tolerance).count();
        let reach = reach.iter().map(|reach| reach.min(tolerance)).collect();
        Self { tolerance, open, reach, limited }
    }

    /// The partners of these vertices, by their places.
    fn pairs(&self, mesh: &TriMesh, topology: &Topology, index: &SurfaceIndex, block: Range<usize>) -> Vec<Pair> {
        let Self { open, reach, .. } = self;
        let from = block.start;
        let found = parallel::map_ranges(block.len(), CHUNK, |range| {
            let (mut pairs, mut near) = (Vec::new(), Vec::new());
            for at in from + range.start..from + range.end {
                let (v, p) = (open[at], mesh.positions[open[at] as usize]);
                near.clear();
                let size = Vec3::splat(reach[at].next_up());
                index.for_each_near(p - size, p + size, |other| {
                    let other = other as usize;
                    let squared = p.distance_squared(mesh.positions[open[other] as usize]);
                    let least = reach[at].min(reach[other]);
                    let may_join = || !are_one_stretch(mesh, topology, v, open[other]);
                    if other != at && squared <= least * least && may_join() {
                        near.push((squared, open[other]));
                    }
                });
                near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                // Each pair is found from both sides.
                let partners = near.iter().take(PARTNERS).filter(|&&(_, w)| v < w);
                pairs.extend(partners.map(|&(squared, w)| Pair { squared, low: v, high: w }));
            }
            pairs
        });
        found.concat()
    }
}

/// Whether two vertices are joined by an edge, or by so short a stretch of open edges that joining them would fold it.
fn are_one_stretch(mesh: &TriMesh, topology: &Topology, v: u32, w: u32) -> bool {
    if topology.edge(v, w).is_some() {
        return true;
    }
    let length = |a: u32, b: u32| mesh.positions[a as usize].distance(mesh.positions[b as usize]);
    let farthest = ALONG * length(v, w);
    let open = |at: u32| {
        let edges = topology.neighbours(at).iter().zip(topology.edge_uses(at));
        edges.filter(|(_, edge)| edge.is_boundary()).map(|(&other, _)| other)
    };
    open(v).any(|first| {
        let (mut before, mut at, mut gone) = (v, first, length(v, first));
        while gone < farthest && at != v {
            let Some(next) = open(at).find(|&next| next != before) else { return false };
            if next == w {
                return gone + length(at, w) < farthest;
            }
            gone += length(at, next);
            (before, at) = (at, next);
        }
        false
    })
}

/// Joins the pairs, the nearest first.
fn join(mesh: &TriMesh, topology: &Topology, rims: &Rims, mut pairs: Vec<Pair>) -> Welded {
    let at = |v: u32| mesh.positions[v as usize];
    let order = |v: u32| at(v).to_array().map(f32::to_bits);
    pairs.sort_unstable_by(|a, b| {
        let place = |pair: &Pair| (order(pair.low).min(order(pair.high)), order(pair.low).max(order(pair.high)));
        a.squared
            .total_cmp(&b.squared)
            .then_with(|| place(a).cmp(&place(b)))
            .then((a.low, a.high).cmp(&(b.low, b.high)))
    });
    let mut clusters = Clusters::new(mesh.positions.len());
    let farthest = rims.tolerance * rims.tolerance;
    for Pair { low, high, .. } in pairs {
        clusters.join(low, high, |v, w| {
            at(v).distance_squared(at(w)) <= farthest && !are_one_stretch(mesh, topology, v, w)
        });
    }
    let (row_of, rows) = clusters.numbered();
    let joined = mesh.positions.len() - rows;
    let vertices = Blend::of_groups(rows, &row_of, |_| 1.0);
    let mean = |row: usize| match vertices.sources(row) {
        [(v, _)] => at(*v),
        sources => {
            let sum: DVec3 = sources.iter().map(|&(v, _)| at(v).as_dvec3()).sum();
            (sum / sources.len() as f64).as_vec3()
        }
    };
    let positions = (0..rows).map(mean).collect();
    let triangles = mesh.triangles.iter().map(|t| t.map(|v| row_of[v as usize])).collect();
    Welded { mesh: TriMesh { positions, triangles }, vertices, joined, limited: rims.limited }
}

/// Vertices that become one.
struct Clusters {
    /// The least of the cluster that each is in.
    first: Vec<u32>,
    /// For each the next of its cluster, all around.
    next: Vec<u32>,
}

impl Clusters {
    fn new(vertices: usize) -> Self {
        let each: Vec<u32> = (0..vertices as u32).collect();
        Self { first: each.clone(), next: each }
    }

    /// The vertices of the cluster of `v`.
    fn of(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let mut at = Some(v);
        std::iter::from_fn(move || {
            let member = at?;
            at = Some(self.next[member as usize]).filter(|&next| next != v);
            Some(member)
        })
    }

    /// Makes the clusters of two vertices one, if that is allowed of every vertex of the one and the other.
    fn join(&mut self, v: u32, w: u32, is_allowed: impl Fn(u32, u32) -> bool) {
        let (a, b) = (self.first[v as usize], self.first[w as usize]);
        let is_small = a != b && self.of(v).count() + self.of(w).count() <= MEMBERS;
        if !is_small || !self.of(v).all(|v| self.of(w).all(|w| is_allowed(v, w))) {
            return;
        }
        // Two rings become one where each goes on with the other.
        self.next.swap(v as usize, w as usize);
        let (first, mut at) = (a.min(b), v);
        loop {
            self.first[at as usize] = first;
            at = self.next[at as usize];
            if at == v {
                break;
            }
        }
    }

    /// The number of the cluster of each vertex, by the first of each, and how many there are.
    fn numbered(&self) -> (Vec<u32>, usize) {
        let mut row_of = Vec::with_capacity(self.first.len());
        let mut rows = 0;
        for (v, &first) in (0u32..).zip(&self.first) {
            if first == v {
                row_of.push(rows);
                rows += 1;
            } else {
                row_of.push(row_of[first as usize]);
            }
        }
        (row_of, rows as usize)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::components;
    use crate::shapes::{icosphere, joined, tube};
    use crate::split_mix::SplitMix64;

    /// Every triangle by itself, its corners moved by up to `noise` mm.
    fn soup(mesh: &TriMesh, noise: f32) -> TriMesh {
        let mut random = SplitMix64::new(1);
        let mut random = || (2.0 * random.unit() - 1.0) as f32;
        let corners = mesh.triangles.as_flattened().iter().map(|&v| mesh.positions[v as usize]);
        let positions: Vec<Vec3> = corners.map(|p| p + Vec3::new(random(), random(), random()) * noise).collect();
        let triangles = (0..mesh.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        TriMesh { positions, triangles }
    }

    #[test]
    fn a_soup_of_a_sphere_becomes_the_sphere_at_any_scale() {
        for scale in [0.01, 1.0, 1000.0] {
            let sphere = icosphere(3, 10.0 * scale, Vec3::splat(20.0 * scale));
            let welded = weld(&soup(&sphere, 0.01 * scale), 0.05 * f64::from(scale));
            assert_eq!((welded.mesh.positions.len(), welded.mesh.triangles.len()), (642, 1280));
            let edges = Topology::new(642, &welded.mesh.triangles).edge_counts();
            assert_eq!((edges.boundary, edges.non_manifold, edges.flipped), (0, 0, 0));
            assert_eq!((welded.joined, welded.limited), (3 * 1280 - 642, 0));
        }
    }

    #[test]
    fn what_is_closed_stays_as_it_is_however_near_and_so_does_a_narrow_rim() {
        let near = joined(&[icosphere(2, 5.0, Vec3::ZERO), icosphere(2, 5.0, Vec3::X * 10.2)]);
        assert_eq!(weld(&near, 1.0).mesh, near);
        // A tube of 0.1 mm with a tolerance of 1 mm.
        let thin = tube(5, 20, 2.0, |_| 0.05);
        let welded = weld(&thin, 1.0);
        assert_eq!((&welded.mesh, welded.joined), (&thin, 0));
        assert_eq!(welded.limited, 10, "at every vertex of both rims");
    }

    #[test]
    fn a_rim_of_short_edges_is_not_folded_onto_itself() {
        // Edges of 0.1 along the rim and of 1 along the tube: two that follow each other are within reach of their ends.
        let mesh = tube(120, 20, 20.0, |_| 2.0);
        for tolerance in [0.15, 0.25, 1.0] {
            assert_eq!(weld(&mesh, tolerance).joined, 0, "{tolerance}");
        }
    }

    #[test]
    fn the_order_of_the_triangles_does_not_matter() {
        let soup = soup(&icosphere(2, 10.0, Vec3::ZERO), 0.01);
        let mut turned = soup.clone();
        turned.triangles.reverse();
        turned.positions.reverse();
        let last = soup.positions.len() as u32 - 1;
        turned.triangles.iter_mut().for_each(|t| *t = t.map(|v| last - v));
        let [one, other] = [&soup, &turned].map(|mesh| weld(mesh, 0.05).mesh);
        assert_eq!(components(one.positions.len(), &one.triangles).count(), 1);
        // The mean of the same places in another order may differ in its last bit.
        assert_eq!(one.positions.len(), other.positions.len());
        let is_there = |p: &Vec3| other.positions.iter().any(|q| p.distance(*q) < 1e-5);
        assert!(one.positions.iter().all(is_there));
    }
}
