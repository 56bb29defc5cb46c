//! The least pass band at each vertex that leaves its vessel the calibre that it has.
//!
//! Around a round vessel of radius `r` the coordinates of its wall are waves of length `2 pi r`, one around: on edges
//! of length `h` they have the eigenvalue `k = 1 - J0(h / r)` (`pipeline::response`). A filter that stops them draws
//! the vessel shut, one whose pass band holds them leaves it as wide as it is. At an open end the rim is smoothed along
//! itself, where the same wave has `k = 1 - cos(h / r)`.
//!
//! `r` is the width of the vessel at the vertex (`lumen_vessel::width`).

use super::means::{even_out, rings_around};
use crate::settings::Smoothing;
use crate::task::{Yielder, blocks};
use lumen_mesh::{Topology, TriMesh};

/// By what the pass band is wider than the wave around the vessel needs: waves of half its length pass as well, so that what
/// changes along the vessel (an open end, a fork, a narrow place) does not make it swing.
const MARGIN: f64 = 4.0;
/// Largest part of a radius that an edge may be: beyond it a vessel has no shape to keep.
const COARSEST: f64 = 3.0;
/// Means with the neighbours that the pass bands are evened out by. Filters of other pass bands let even the longest waves
/// through by a hundredth more or less: what differs from vertex to vertex would be seen as roughness, and on `data/real` twice to five times as many triangles
/// run into others without.
const EVEN: usize = 16;
/// Vertices between two looks at the clock.
const VERTICES: usize = 4096;

/// The pass bands of `mesh`, whose vessels have these `widths`, as radii in mm. Only those above `above` are looked for: what
/// comes out for the other vertices is no more than that, and not evened out everywhere.
pub(crate) async fn least_pass_bands(
    mesh: &TriMesh,
    topology: &Topology,
    widths: &[f32],
    above: f32,
    yielder: &Yielder,
) -> Vec<f32> {
    let count = widths.len();
    let mut bands = Vec::with_capacity(count);
    for block in blocks(count, VERTICES) {
        bands.extend(block.map(|v| band(mesh, topology, widths, v as u32)));
        yielder.rest(0.1).await;
    }
    // Farther than the means reach from all that is above, they come to no more than `above`.
    let near = rings_around(topology, 2 * EVEN, |v| bands[v as usize] > above);
    yielder.rest(0.2).await;
    even_out(&mut bands, topology, &near, EVEN, &yielder.part(0.2..1.0)).await;
    bands
}

/// The least pass band at `v`.
fn band(mesh: &TriMesh, topology: &Topology, widths: &[f32], v: u32) -> f32 {
    let at = |v: u32| mesh.positions[v as usize];
    let neighbours = topology.neighbours(v);
    let squares = neighbours.iter().map(|&n| f64::from(at(v).distance_squared(at(n))));
    let edge = (squares.sum::<f64>() / neighbours.len().max(1) as f64).sqrt();
    let ratio = (edge / f64::from(widths[v as usize])).min(COARSEST);
    let is_rim = topology.edge_uses(v).iter().any(|edge| edge.is_boundary());
    let k = if is_rim { 1.0 - libm::cos(ratio) } else { 1.0 - libm::j0(ratio) };
    // Where few vertices stand around a vessel, corners are all that could be smoothed away, and they are its calibre.
    (MARGIN * (1.0 + ratio * ratio) * k).min(*Smoothing::PASS_BAND.end()) as f32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::response::eigenvalue;
    use crate::task::at_once;
    use lumen_mesh::rms_edge;
    use lumen_mesh::shapes::{square, tube};
    use lumen_vessel::width::widths;

    fn bands(mesh: &TriMesh) -> Vec<f32> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let (widths, _) = at_once(widths(mesh, &topology, None, &Yielder::never()));
        at_once(least_pass_bands(mesh, &topology, &widths, 0.0, &Yielder::never()))
    }

    #[test]
    fn bands_above_a_bound_do_not_depend_on_it() {
        // A thin vessel that becomes a wide one.
        let mesh = tube(48, 400, 120.0, |z| 1.0 + 5.0 / (1.0 + (30.0 - z).exp()));
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let (widths, _) = at_once(widths(&mesh, &topology, None, &Yielder::never()));
        let above = |least: f32| at_once(least_pass_bands(&mesh, &topology, &widths, least, &Yielder::never()));
        let all = above(0.0);
        let most = all.iter().copied().fold(0.0, f32::max);
        for least in [most / 2.0, most / 10.0, most] {
            let found = above(least);
            for (&found, &known) in found.iter().zip(&all) {
                assert!(found == known || found.max(known) <= least, "{found} for {known} above {least}");
            }
            assert!(least != most / 2.0 || found != all, "far from what is above nothing is evened out");
        }
    }

    #[test]
    fn in_a_tube_it_is_that_of_the_wave_around_it() {
        for radius in [1.5, 3.0, 8.0] {
            let mesh = tube(48, 60, 60.0 * radius * 0.13, |_| radius);
            let k = eigenvalue(2.0 * std::f64::consts::PI * f64::from(radius), rms_edge(&mesh));
            let found = bands(&mesh);
            // Away from the rims, whose waves are of another kind.
            let inside = &found[48 * 20..48 * 40];
            let (low, high) =
                inside.iter().fold((f32::MAX, 0.0f32), |(low, high), &band| (low.min(band), high.max(band)));
            assert!(f64::from(low) > 3.0 * k && f64::from(high) < 5.0 * k, "{radius}: {low} to {high}, the wave {k}");
        }
    }

    #[test]
    fn what_is_no_vessel_asks_for_nothing() {
        assert!(bands(&square(20, 10.0, 0.0)).iter().all(|&band| band == 0.0));
    }
}
