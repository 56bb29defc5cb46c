//! Means of numbers at vertices with those of their neighbours, taken where somebody asks for them.

use crate::task::Yielder;
use lumen_mesh::Topology;
use lumen_mesh::parallel;
use lumen_mesh::task::blocks;

/// Vertices that a core works on in one go, and those between two looks at the clock.
const PIECE: usize = 4096;
const VERTICES: usize = 16 * PIECE;

/// The vertices for which `is_seed`, and those up to so many rings around them, ascending.
pub(super) fn rings_around(topology: &Topology, rings: usize, is_seed: impl Fn(u32) -> bool) -> Vec<u32> {
    let count = topology.vertex_count();
    let mut is_in = vec![false; count];
    let mut all: Vec<u32> = (0..count as u32).filter(|&v| is_seed(v)).collect();
    all.iter().for_each(|&v| is_in[v as usize] = true);
    let mut ring = 0;
    for _ in 0..rings {
        for i in std::mem::replace(&mut ring, all.len())..all.len() {
            for &n in topology.neighbours(all[i]) {
                if !std::mem::replace(&mut is_in[n as usize], true) {
                    all.push(n);
                }
            }
        }
    }
    (0..count as u32).filter(|&v| is_in[v as usize]).collect()
}

/// Replaces `values` at the vertices of `at` by the middle between each and the mean of its neighbours, `times` times over;
/// the others stay. Where `at` has all that is up to `times - 1` rings around a vertex, that comes out as if all were in it.
pub(super) async fn even_out(values: &mut [f32], topology: &Topology, at: &[u32], times: usize, yielder: &Yielder) {
    let mut evened = vec![0.0; at.len()];
    for time in 0..times {
        for block in blocks(at.len(), VERTICES) {
            let (of_block, values) = (&at[block.clone()], &*values);
            parallel::for_each_chunk_mut(&mut evened[block], PIECE, |first, chunk| {
                for (&v, evened) in of_block[first..].iter().zip(chunk) {
                    let (own, around) = (values[v as usize], topology.neighbours(v));
                    let sum = around.iter().map(|&n| values[n as usize]).sum::<f32>();
                    *evened = (own + if around.is_empty() { own } else { sum / around.len() as f32 }) / 2.0;
                }
            });
            yielder.rest(time as f32 / times as f32).await;
        }
        for (&v, &evened) in at.iter().zip(&evened) {
            values[v as usize] = evened;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::at_once;
    use lumen_mesh::shapes::square;

    #[test]
    fn around_some_vertices_it_comes_out_as_with_all() {
        let mesh = square(40, 40.0, 0.0);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let values: Vec<f32> = (0..mesh.positions.len()).map(|v| (v * 7919 % 101) as f32).collect();
        let evened = |at: &[u32]| {
            let mut values = values.clone();
            at_once(even_out(&mut values, &topology, at, 5, &Yielder::never()));
            values
        };
        let all: Vec<u32> = (0..values.len() as u32).collect();
        let (everywhere, seeds) = (evened(&all), [0u32, 820, 1500]);
        let near = rings_around(&topology, 4, |v| seeds.contains(&v));
        assert!(near.len() < all.len() / 2);
        let here = evened(&near);
        seeds.iter().for_each(|&v| assert_eq!(here[v as usize], everywhere[v as usize], "{v}"));
        let is_near = |v: usize| near.contains(&(v as u32));
        assert!((0..values.len()).all(|v| is_near(v) || here[v] == values[v]), "others stay");
        assert_eq!(rings_around(&topology, 0, |v| v == 820), [820]);
        assert_eq!(rings_around(&topology, 1, |v| v == 820).len(), 1 + topology.neighbours(820).len());
        assert!(rings_around(&topology, 3, |_| false).is_empty());
    }

    #[test]
    fn a_wave_along_a_grid_loses_what_the_mean_takes() {
        // Along a row of a grid whose cells are cut the same way a wave of angle a from vertex to vertex has the mean
        // (4 cos a + 2) / 6: its two neighbours in the row, two above and two below.
        let (n, angle) = (60, 0.5f32);
        let mesh = square(n, n as f32, 0.0);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let wave = |v: usize| (angle * mesh.positions[v].x).cos();
        let mut values: Vec<f32> = (0..mesh.positions.len()).map(wave).collect();
        let all: Vec<u32> = (0..values.len() as u32).collect();
        at_once(even_out(&mut values, &topology, &all, 6, &Yielder::never()));
        let left = (0.5 + (4.0 * angle.cos() + 2.0) / 12.0).powi(6);
        let inner = (0..values.len()).filter(|&v| {
            let p = mesh.positions[v];
            [p.x, p.y].iter().all(|&x| (8.0..52.0).contains(&(x - mesh.positions[0].x)))
        });
        let mut count = 0;
        for v in inner {
            count += 1;
            assert!((values[v] - left * wave(v)).abs() < 1e-4, "{v}: {} for {}", values[v], left * wave(v));
        }
        assert!(count > 1000);
    }
}
