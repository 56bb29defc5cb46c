//! A membrane: each vertex in the mean of its neighbours, by the umbrella operator of Kobbelt et al., "Interactive
//! multi-resolution modeling on arbitrary meshes" (1998). Solved by conjugate gradients (Hestenes and Stiefel 1952), in f64
//! and in a fixed order.

use glam::{DVec3, Vec3};

use lumen_mesh::Topology;

/// Steps of the solver at most, and the part of the first residual at which it ends.
const STEPS: usize = 1000;
const ENOUGH: f64 = 1e-6;

/// Where `vertices` stand when each is in the mean of its neighbours and all others stay at `positions`.
pub(super) fn membrane(topology: &Topology, positions: &[Vec3], vertices: &[u32]) -> Vec<DVec3> {
    let mut slots: Vec<(u32, usize)> = vertices.iter().copied().zip(0..).collect();
    slots.sort_unstable();
    let slot = |v: u32| slots.binary_search_by_key(&v, |&(vertex, _)| vertex).ok().map(|found| slots[found].1);
    let rows: Vec<Vec<Option<usize>>> =
        vertices.iter().map(|&v| topology.neighbours(v).iter().map(|&w| slot(w)).collect()).collect();
    let apply = |x: &[DVec3]| -> Vec<DVec3> {
        let row = |(i, row): (usize, &Vec<Option<usize>>)| {
            x[i] * row.len() as f64 - row.iter().flatten().map(|&other| x[other]).sum::<DVec3>()
        };
        rows.iter().enumerate().map(row).collect()
    };
    let mut x: Vec<DVec3> = vertices.iter().map(|&v| positions[v as usize].as_dvec3()).collect();
    let known = vertices.iter().map(|&v| {
        let fixed = topology.neighbours(v).iter().filter(|&&w| slot(w).is_none());
        fixed.map(|&w| positions[w as usize].as_dvec3()).sum::<DVec3>()
    });
    let mut residual: Vec<DVec3> = known.zip(apply(&x)).map(|(known, image)| known - image).collect();
    let mut direction = residual.clone();
    let dot = |a: &[DVec3], b: &[DVec3]| a.iter().zip(b).map(|(a, b)| a.dot(*b)).sum::<f64>();
    let mut size = dot(&residual, &residual);
    let end = size * ENOUGH * ENOUGH;
    for _ in 0..STEPS {
        let image = apply(&direction);
        let bend = dot(&direction, &image);
        // False for what is no number; none is left where all is solved, or where nothing holds a piece in its place.
        let goes_on = size > end && bend > 0.0;
        if !goes_on {
            break;
        }
        for i in 0..x.len() {
            x[i] += direction[i] * (size / bend);
            residual[i] -= image[i] * (size / bend);
        }
        let next = dot(&residual, &residual);
        for i in 0..x.len() {
            direction[i] = residual[i] + direction[i] * (next / size);
        }
        size = next;
    }
    x
}

#[cfg(test)]
mod tests {
    use lumen_mesh::shapes::square;

    use super::*;

    #[test]
    fn a_membrane_over_a_flat_rim_is_flat_and_over_a_tilted_one_tilted() {
        let mut mesh = square(8, 8.0, 0.0);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let is_rim = |v: u32| topology.edge_uses(v).iter().any(|edge| edge.is_boundary());
        let inner: Vec<u32> = (0..mesh.positions.len() as u32).filter(|&v| !is_rim(v)).collect();
        for slope in [0.0, 0.5] {
            for (i, p) in mesh.positions.iter_mut().enumerate() {
                p.z = if is_rim(i as u32) { slope * p.x } else { 3.0 + (i % 3) as f32 };
            }
            // A linear function has no umbrella on a regular grid.
            for (p, &v) in membrane(&topology, &mesh.positions, &inner).iter().zip(&inner) {
                let expected = f64::from(slope * mesh.positions[v as usize].x);
                assert!((p.z - expected).abs() < 1e-4, "{p}");
            }
        }
    }
}
