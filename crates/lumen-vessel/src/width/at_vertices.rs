//! How wide the vessel is at each vertex of its wall, as one radius that varies smoothly along the surface.
//!
//! The radius is the inner ball's at the vertex ([`InnerRadii`](lumen_mesh::InnerRadii)), as the median of its ring, several times over,
//! for on rough surfaces many vertices have bad normals. From a thin vessel it grows by no more than the way along the
//! surface: so it has no jumps, and a narrow place counts for the surface beside it. Where no wall of a piece faces
//! another the radius is infinite.

use std::sync::Arc;

use super::ring_median;
use lumen_mesh::task::{Yielder, blocks};
use lumen_mesh::{SurfaceIndex, Topology, TriMesh, inner_radii_in_slices};

/// By what the radius may grow from vertex to vertex: of the edge between them.
const SLOPE: f32 = 1.0;
/// Vertices between two looks at the clock.
const VERTICES: usize = 4096;
/// Medians that are taken of medians: what is left of a bad ball is two rings wide at most.
const MEDIANS: usize = 4;
/// Sweeps at most: each goes all the way in one direction.
const SWEEPS: usize = 12;

/// The width at each vertex of `mesh`, whose adjacency is `topology`, as a radius in mm; and an index of the surface: the
/// one that is there already, or a new one.
pub async fn widths(
    mesh: &TriMesh,
    topology: &Topology,
    index: Option<Arc<SurfaceIndex>>,
    yielder: &Yielder,
) -> (Vec<f32>, Arc<SurfaceIndex>) {
    let index = SurfaceIndex::known_or_built(index, mesh, &yielder.part(0.0..0.1)).await;
    let balls = inner_radii_in_slices(mesh, topology, &index, &yielder.part(0.1..0.8)).await;
    let mut widths = balls.radii;
    let (count, mut radii, mut ring) = (widths.len(), Vec::new(), Vec::new());
    for pass in 0..MEDIANS {
        radii = std::mem::replace(&mut widths, Vec::with_capacity(count));
        for block in blocks(count, VERTICES) {
            widths.extend(block.map(|v| ring_median(topology, &radii, v as u32, &mut ring)));
            yielder.rest(0.8 + 0.05 * pass as f32 / MEDIANS as f32).await;
        }
    }
    drop(radii);
    for sweep in 0..SWEEPS {
        let mut has_changed = false;
        for block in blocks(count, VERTICES) {
            for i in block {
                has_changed |= relax(mesh, topology, &mut widths, if sweep % 2 == 0 { i } else { count - 1 - i });
            }
            yielder.rest(0.85 + 0.15 * sweep as f32 / SWEEPS as f32).await;
        }
        if !has_changed {
            break;
        }
    }
    (widths, index)
}

/// Lowers the width at `v` to what its neighbours leave it; whether it is lower than it was.
fn relax(mesh: &TriMesh, topology: &Topology, widths: &mut [f32], v: usize) -> bool {
    let p = mesh.positions[v];
    let reach = |&n: &u32| widths[n as usize] + SLOPE * p.distance(mesh.positions[n as usize]);
    let least = topology.neighbours(v as u32).iter().map(reach).fold(f32::INFINITY, f32::min);
    let is_lower = least < widths[v];
    if is_lower {
        widths[v] = least;
    }
    is_lower
}
