//! The vessel tree that ends are found by.
//!
//! In the dents of a rough wall balls stand side by side as they do in a sheet, and no vessel is found. Such a surface is
//! smoothed for this alone, its rims aside. Where a vessel ends does not depend on dents that are smaller than it is wide;
//! what is cut is the surface as it was.
//!
//! Smoothing is that of Taubin, "A signal processing approach to fair surface design" (1995): vertices go a part of the way
//! to the mean of their neighbours, then a larger part back, so that narrow vessels stay as wide as they are.

use std::sync::Arc;

use lumen_mesh::task::Yielder;
use lumen_mesh::{SurfaceIndex, Topology, TriMesh, Vec3};
use lumen_vessel::{Tree, TreeError};

/// The parts of the way that a vertex goes, and how often it goes both: those of Taubin's paper for a pass band of 0.1.
const PARTS: [f32; 2] = [0.6307, -0.6732];
const ROUNDS: usize = 20;

/// The tree of a surface. Rests where the tree does.
///
/// # Errors
/// As [`Tree::new`].
pub async fn skeleton(mesh: &TriMesh, yielder: &Yielder) -> Result<Tree, TreeError> {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    match tree(mesh, &topology, &yielder.part(0.0..0.5)).await {
        Err(TreeError::Sheet { .. }) => {
            tree(&smoothed(mesh.clone(), &topology), &topology, &yielder.part(0.5..1.0)).await
        }
        known => known,
    }
}

async fn tree(mesh: &TriMesh, topology: &Topology, yielder: &Yielder) -> Result<Tree, TreeError> {
    let index = Arc::new(SurfaceIndex::new(&mesh.positions, &mesh.triangles));
    Tree::with_topology_in_slices(mesh, topology, index, yielder).await
}

fn smoothed(mut mesh: TriMesh, topology: &Topology) -> TriMesh {
    let is_on_rim = |v: u32| topology.edge_uses(v).iter().any(|edge| edge.is_boundary());
    for part in PARTS.repeat(ROUNDS) {
        let before = mesh.positions.clone();
        for (v, p) in (0u32..).zip(&mut mesh.positions) {
            let around = topology.neighbours(v);
            if !around.is_empty() && !is_on_rim(v) {
                let mean = around.iter().map(|&w| before[w as usize]).sum::<Vec3>() / around.len() as f32;
                *p = p.lerp(mean, part);
            }
        }
    }
    mesh
}
