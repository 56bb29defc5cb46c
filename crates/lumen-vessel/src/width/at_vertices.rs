//! How wide the vessel is at each vertex of its wall, as one radius that varies smoothly along the surface.
//!
//! The radius is the inner ball's at the vertex ([`InnerRadii`](lumen_mesh::InnerRadii)), as the median of its ring, several times over,
//! for on rough surfaces many vertices have bad normals. From a thin vessel it grows by no more than the way along the
//! surface: so it has no jumps, and a narrow place counts for the surface beside it. Where no wall of a piece faces
//! another the radius is infinite.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
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
    limit_growth(mesh, topology, &mut widths, &yielder.part(0.85..1.0)).await;
    (widths, index)
}

/// Lowers widths to what their neighbours leave them: the least first (Dijkstra), so that each is lowered once.
async fn limit_growth(mesh: &TriMesh, topology: &Topology, widths: &mut [f32], yielder: &Yielder) {
    let way = |v: u32, n: u32| SLOPE * mesh.positions[v as usize].distance(mesh.positions[n as usize]);
    let count = widths.len();
    // Positive numbers are in the order of their bits.
    let mut queue = BinaryHeap::new();
    for block in blocks(count, VERTICES) {
        let end = block.end;
        for v in block.map(|v| v as u32) {
            let left = |&n: &u32| widths[n as usize] + way(v, n);
            let least = topology.neighbours(v).iter().map(left).fold(f32::INFINITY, f32::min);
            if least < widths[v as usize] {
                queue.push(Reverse((least.to_bits(), v)));
            }
        }
        yielder.rest(0.5 * end as f32 / count as f32).await;
    }
    let mut taken = 0;
    while let Some(Reverse((bits, v))) = queue.pop() {
        let width = f32::from_bits(bits);
        if width < widths[v as usize] {
            widths[v as usize] = width;
            for &n in topology.neighbours(v) {
                let left = width + way(n, v);
                if left < widths[n as usize] {
                    queue.push(Reverse((left.to_bits(), n)));
                }
            }
        }
        taken += 1;
        if taken % VERTICES == 0 {
            yielder.rest(0.5).await;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::shapes::tube;
    use lumen_mesh::split_mix::SplitMix64;
    use lumen_mesh::task::at_once;

    #[test]
    fn growth_is_limited_as_by_relaxing_until_nothing_changes() {
        let mesh = tube(16, 60, 60.0, |z| 2.0 + 0.5 * (0.3 * z).sin());
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let mut random = SplitMix64::new(7);
        let mut width = || if random.unit() < 0.1 { f32::INFINITY } else { 0.1 + 40.0 * random.unit() as f32 };
        let widths: Vec<f32> = mesh.positions.iter().map(|_| width()).collect();
        let mut found = widths.clone();
        at_once(limit_growth(&mesh, &topology, &mut found, &Yielder::never()));
        let mut relaxed = widths.clone();
        let mut has_changed = true;
        while std::mem::take(&mut has_changed) {
            for v in 0..relaxed.len() {
                for &n in topology.neighbours(v as u32) {
                    let left = relaxed[n as usize] + mesh.positions[v].distance(mesh.positions[n as usize]);
                    if left < relaxed[v] {
                        (relaxed[v], has_changed) = (left, true);
                    }
                }
            }
        }
        assert!(found == relaxed && found != widths);
    }
}
