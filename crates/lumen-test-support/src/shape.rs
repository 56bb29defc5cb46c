//! What no stage may change: pieces, open ends, holes, orientation.

use std::collections::BTreeSet;

use lumen_mesh::{Topology, TriMesh, boundary_loops, components};

/// What decimation must not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Connected pieces.
    pub components: usize,
    /// Connected pieces of the boundary: its loops, where none of them touch.
    pub boundaries: usize,
    /// Vertices less edges plus triangles.
    pub euler: i64,
    /// Edges of more than two triangles.
    pub non_manifold: usize,
    /// Edges whose two triangles are wound against each other.
    pub flipped: usize,
}

impl Shape {
    /// Counts those of `mesh`.
    pub fn of(mesh: &TriMesh) -> Self {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let counts = topology.edge_counts();
        Self {
            components: components(mesh.positions.len(), &mesh.triangles).count(),
            boundaries: boundaries(&topology),
            euler: mesh.positions.len() as i64 - counts.edges as i64 + mesh.triangles.len() as i64,
            non_manifold: counts.non_manifold,
            flipped: counts.flipped,
        }
    }
}

/// Loops of the boundary, those that touch in a vertex counted as one: which of two such loops a chain belongs to is a
/// matter of taste.
fn boundaries(topology: &Topology) -> usize {
    let loops = boundary_loops(topology);
    let mut sets: Vec<BTreeSet<u32>> = Vec::new();
    for chain in loops {
        let mut set: BTreeSet<u32> = chain.into_iter().collect();
        sets.retain(|other| {
            let apart = other.is_disjoint(&set);
            if !apart {
                set.extend(other);
            }
            apart
        });
        sets.push(set);
    }
    sets.len()
}
