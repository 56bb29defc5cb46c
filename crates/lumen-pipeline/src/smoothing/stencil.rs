//! Which vertices pull on which.

use glam::Vec3;

use crate::settings::Boundary;
use lumen_mesh::Topology;

/// The neighbours that each vertex is averaged over, in compressed rows.
///
/// An inner vertex has all of its neighbours, a boundary vertex the two along its loop. A vertex that stays is its own
/// only neighbour: then `mean(x) = x`, and the recurrence keeps it where it is for those that it pulls on. Those on
/// non-manifold edges stay, those where several loops meet, and those without neighbours.
pub(super) struct Stencil<'a> {
    pub(super) topology: &'a Topology,
    kinds: Vec<Kind>,
}

/// How a vertex is averaged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Inner,
    Boundary,
    Stays,
}

impl<'a> Stencil<'a> {
    pub(super) fn new(positions: &[Vec3], topology: &'a Topology, boundary: Boundary) -> Self {
        let kind = |v| Kind::of(v, positions, topology, boundary);
        Self { kinds: (0..topology.vertex_count() as u32).map(kind).collect(), topology }
    }

    pub(super) fn stays(&self, v: u32) -> bool {
        self.kinds[v as usize] == Kind::Stays
    }

    /// Length of the row of `v`.
    pub(super) fn valence(&self, v: u32) -> usize {
        match self.kinds[v as usize] {
            Kind::Inner => self.topology.neighbours(v).len(),
            Kind::Boundary => 2,
            Kind::Stays => 1,
        }
    }

    /// Calls `each` with the vertices in the row of `v`.
    pub(super) fn for_each(&self, v: u32, each: impl FnMut(u32)) {
        match self.kinds[v as usize] {
            Kind::Inner => self.topology.neighbours(v).iter().copied().for_each(each),
            Kind::Boundary => boundary_neighbours(self.topology, v).for_each(each),
            Kind::Stays => std::iter::once(v).for_each(each),
        }
    }
}

impl Kind {
    fn of(v: u32, positions: &[Vec3], topology: &Topology, boundary: Boundary) -> Self {
        let uses = topology.edge_uses(v);
        if uses.iter().all(|edge| edge.triangles() == 2) {
            return if uses.is_empty() { Self::Stays } else { Self::Inner };
        }
        if uses.iter().any(|edge| edge.is_non_manifold()) {
            return Self::Stays;
        }
        let mut ends = boundary_neighbours(topology, v);
        match (ends.next(), ends.next(), ends.next()) {
            (Some(a), Some(b), None) if boundary == Boundary::Loop || !turns_by_15_degrees(positions, a, v, b) => {
                Self::Boundary
            }
            _ => Self::Stays,
        }
    }
}

/// The neighbours of `v` along boundary edges.
fn boundary_neighbours(topology: &Topology, v: u32) -> impl Iterator<Item = u32> + '_ {
    let edges = topology.neighbours(v).iter().zip(topology.edge_uses(v));
    edges.filter(|(_, edge)| edge.is_boundary()).map(|(&n, _)| n)
}

/// Whether the way a -> v -> b turns by more than 15 degrees.
fn turns_by_15_degrees(positions: &[Vec3], a: u32, v: u32, b: u32) -> bool {
    const COS_15: f64 = 0.965_925_826_289_068_3;
    let at = |i: u32| positions[i as usize].as_dvec3();
    let (incoming, outgoing) = (at(v) - at(a), at(b) - at(v));
    let lengths = incoming.length() * outgoing.length();
    lengths > 0.0 && incoming.dot(outgoing) < COS_15 * lengths
}
