//! Gives vessels back what the adapted filter took of their calibre.
//!
//! A pass band that lets the wave around a vessel through (`super::calibre`) still takes a little of its radius: at
//! shoulders and forks, where the calibre changes, and by the filter's window. In the coordinates what is missing is a
//! wave around the vessel, but along the normals it is all but a constant, which the mean of neighbours leaves alone
//! while it takes out stair-steps:
//!
//! 1. The loss at a vertex is the part of its way `x - S x` along `m`, the mean of its normals before and after. (A
//!    vertex that only slid along a round wall has lost nothing: its way is square to `m`, and to neither of the two.)
//! 2. The losses, none larger than the edges around it, are evened out by means with the neighbours.
//! 3. `x = S x + w n loss`, with `n` the normal after smoothing and `w` from 0 where the pass band is the setting's to
//!    1 where it is twice as wide: on wide vessels the filter's own result stays, to the bit.
//!
//! Vertices that smoothing fixes stay to the bit; those of a boundary loop move in the loop's plane: the tips of an end
//! that is cut off at a slant stay as far off as the filter left them (at 60 degrees a sixth of the radius).
//!
//! It is Tukey's twicing (1977) along the normals, as in `super::volume`, but by a short filter, and each place for
//! itself.

use glam::Vec3;

use super::Stencil;
use super::means::{even_out, rings_around};
use super::volume::directions;
use crate::normals::{Weighting, vertex_normals};
use crate::results::Surface;
use crate::settings::Smoothing;
use crate::task::Yielder;
use lumen_mesh::{parallel, rms_edge};

/// Means with the neighbours. They reach as far as around vessels of some five edges' radius; of a wave of four edges
/// they leave less than a hundredth.
const MEANS: usize = 16;
/// Typical edges of the surface, root mean square, that an edge is long from.
const LONG: f32 = 2.0;
/// Vertices that a core works on in one go.
const PIECE: usize = 4096;

/// Puts back what `smoothed`, the positions in mm that the filter of `settings` gave the vertices of `kept`, each with its
/// own of `bands`, took off thin vessels. They stay as they are where no vessel asked for a wider pass band than the
/// settings', or the windings do not agree: then no side is the inside.
pub(crate) async fn restore(
    kept: &Surface,
    smoothed: Vec<Vec3>,
    settings: &Smoothing,
    bands: &[f32],
    yielder: &Yielder,
) -> Vec<Vec3> {
    let pass_band = settings.pass_band as f32;
    let Some(loops) = kept.loops.as_deref().filter(|_| bands.iter().any(|&band| band > pass_band)) else {
        return smoothed;
    };
    let Surface { mesh, topology, .. } = kept;
    let steps = MEANS as f32 + 3.0;
    let stencil = Stencil::new(&mesh.positions, topology, settings.boundary);
    yielder.rest(0.0).await;
    let before = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
    yielder.rest(1.0 / steps).await;
    let after = vertex_normals(&smoothed, &mesh.triangles, Weighting::Area);
    yielder.rest(1.0 / steps).await;
    let typical = rms_edge(mesh) as f32;
    yielder.rest(1.0 / steps).await;
    // What vessels get back of it depends on what they lost around.
    let near = rings_around(topology, MEANS, |v| bands[v as usize] > pass_band);
    let mut losses = losses(kept, typical, &before, &smoothed, &after);
    drop(before);
    yielder.rest(2.0 / steps).await;

    // A rim too is evened with the wall behind it, though the filter knows its loop alone.
    even_out(&mut losses, topology, &near, MEANS, &yielder.part(2.0 / steps..(steps - 1.0) / steps)).await;

    let directions = directions(&smoothed, &after, loops);
    yielder.rest((steps - 1.0) / steps).await;
    let mut positions = smoothed;
    parallel::for_each_chunk_mut(&mut positions, PIECE, |first, chunk| {
        for (v, position) in (first..).zip(chunk) {
            let share = (bands[v] / pass_band - 1.0).clamp(0.0, 1.0);
            if share > 0.0 && !stencil.stays(v as u32) {
                *position += directions[v].as_vec3() * (share * losses[v]);
            }
        }
    });
    positions
}

/// What smoothing took at each vertex, in mm, positive where the surface moved inwards; `before` and `after` are its normals.
/// `typical` is the surface's root mean square edge in mm.
fn losses(kept: &Surface, typical: f32, before: &[Vec3], smoothed: &[Vec3], after: &[Vec3]) -> Vec<f32> {
    let opened = &kept.mesh.positions;
    let loss = |v: usize| {
        let loss = (opened[v] - smoothed[v]).dot((before[v] + after[v]).normalize_or_zero());
        // What moved by more than an edge was no vessel's wall: a flap, a short slit drawn together, or a spike, whose own
        // edges are as long as it is.
        let around = kept.topology.neighbours(v as u32);
        let lengths = around.iter().map(|&n| opened[v].distance(opened[n as usize])).sum::<f32>();
        let edge = (lengths / around.len().max(1) as f32).min(LONG * typical);
        loss.max(-edge).min(edge)
    };
    parallel::map_ranges(smoothed.len(), PIECE, |range| range.map(loss).collect::<Vec<_>>()).concat()
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, OnceLock};
    use std::time::Duration;

    use glam::Quat;

    use super::*;
    use crate::task::{Budget, Progress, Running, at_once};
    use lumen_mesh::shapes::tube;
    use lumen_mesh::{Measures, Topology, TriMesh, oriented_loops};

    const RADIUS: f32 = 2.0;
    const SETTINGS: Smoothing = Smoothing::AUTO;

    /// A tube about the z axis, of 24 sides and open ends.
    fn kept() -> Arc<Surface> {
        surface(tube(24, 60, 30.0, |_| RADIUS))
    }

    fn surface(mesh: TriMesh) -> Arc<Surface> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let loops = oriented_loops(&topology);
        let measures = Measures { area_mm2: 0.0, volume_mm3: None };
        Arc::new(Surface { mesh: Arc::new(mesh), topology: Arc::new(topology), loops, measures, caps: OnceLock::new() })
    }

    /// The pass bands of a vessel that is thin everywhere.
    fn thin(kept: &Surface) -> Vec<f32> {
        vec![0.1; kept.mesh.positions.len()]
    }

    fn restored(kept: &Surface, smoothed: &[Vec3]) -> Vec<Vec3> {
        restored_by(kept, smoothed, &thin(kept))
    }

    fn restored_by(kept: &Surface, smoothed: &[Vec3], bands: &[f32]) -> Vec<Vec3> {
        at_once(restore(kept, smoothed.to_vec(), &SETTINGS, bands, &Yielder::never()))
    }

    /// The largest part by which a vertex is off the radius.
    fn off(positions: &[Vec3]) -> f32 {
        positions.iter().map(|p| (p.truncate().length() / RADIUS - 1.0).abs()).fold(0.0, f32::max)
    }

    #[test]
    fn a_tube_that_was_drawn_in_has_its_radius_again() {
        let kept = kept();
        let drawn_in: Vec<Vec3> = kept.mesh.positions.iter().map(|p| *p * Vec3::new(0.97, 0.97, 1.0)).collect();
        assert!(off(&drawn_in) > 0.029);
        let restored = restored(&kept, &drawn_in);
        assert!(off(&restored) < 1e-4, "{}", off(&restored));
        // Open ends stay in their planes.
        let rims = (0..24).chain(restored.len() - 24..restored.len());
        assert!(rims.into_iter().all(|v| (restored[v].z - drawn_in[v].z).abs() < 1e-6));
    }

    #[test]
    fn a_wall_that_slid_around_its_axis_has_lost_nothing() {
        let kept = kept();
        let turn = Quat::from_rotation_z(0.2);
        let slid: Vec<Vec3> = kept.mesh.positions.iter().map(|p| turn * *p).collect();
        let restored = restored(&kept, &slid);
        // Along the normals after it alone the way is 1 - cos 0.2 of the radius, 2 %.
        assert!(off(&restored) < 1e-5, "{}", off(&restored));
    }

    #[test]
    fn teeth_that_were_taken_off_do_not_come_back() {
        // Ridges of a fifth of a millimetre along the tube, one side wide.
        let kept = kept();
        let teeth = |(i, p): (usize, &Vec3)| *p + p.truncate().extend(0.0) * if i % 2 == 0 { 0.05 } else { -0.05 };
        let toothed = surface(TriMesh {
            positions: kept.mesh.positions.iter().enumerate().map(teeth).collect(),
            triangles: kept.mesh.triangles.clone(),
        });
        assert!(off(&toothed.mesh.positions) > 0.049);
        let restored = restored(&toothed, &kept.mesh.positions);
        assert!(off(&restored) < 0.002, "{}", off(&restored));
    }

    #[test]
    fn a_spike_that_was_taken_off_leaves_the_wall_around_it_alone() {
        // One vertex ten radii out, as a stray one of a scan: without a bound its loss swells the wall by a third of its radius.
        let kept = kept();
        let (spike, wall) = (24 * 30, kept.mesh.positions.clone());
        let mut spiked = wall.clone();
        spiked[spike] = wall[spike] * Vec3::new(10.0, 10.0, 1.0);
        let spiked = surface(TriMesh { positions: spiked, triangles: kept.mesh.triangles.clone() });
        let restored = restored(&spiked, &wall);
        let (edge, mut others) = (wall[spike].distance(wall[spike + 24]), restored);
        others[spike] = wall[spike];
        assert!(off(&others) * RADIUS < edge / 4.0, "{} mm of edges of {edge}", off(&others) * RADIUS);
    }

    #[test]
    fn where_the_pass_band_is_that_of_the_setting_no_bit_changes() {
        let kept = kept();
        let drawn_in: Vec<Vec3> = kept.mesh.positions.iter().map(|p| *p * 0.98).collect();
        let band = SETTINGS.pass_band as f32;
        assert!(restored_by(&kept, &drawn_in, &vec![band; drawn_in.len()]) == drawn_in);
        // Half wide, half thin: the wide half stays to the bit, the thin one comes back, at 1.5 times the band by half.
        let share = |i: usize| [0.0, 1.0, 0.5][i * 3 / drawn_in.len()];
        let mixed: Vec<f32> = (0..drawn_in.len()).map(|i| band * (1.0 + share(i))).collect();
        let restored = restored_by(&kept, &drawn_in, &mixed);
        let third = drawn_in.len() / 3;
        assert!(restored[..third] == drawn_in[..third]);
        for (i, expected) in [(third + third / 2, 1.0), (2 * third + third / 2, 0.99)] {
            let radius = restored[i].truncate().length() / RADIUS;
            assert!((radius - expected).abs() < 1e-3, "{i}: {radius}");
        }
    }

    #[test]
    fn a_surface_without_an_inside_is_left_alone() {
        let mut mesh = (*kept().mesh).clone();
        mesh.triangles[100].swap(0, 1);
        let kept = surface(mesh);
        assert!(kept.loops.is_none());
        let smoothed: Vec<Vec3> = kept.mesh.positions.iter().map(|p| *p * 0.98).collect();
        assert!(restored(&kept, &smoothed) == smoothed);
    }

    #[test]
    fn what_the_filter_fixes_stays_to_the_bit() {
        // Three triangles at one edge beside the tube: its corners stay.
        let mut mesh = (*kept().mesh).clone();
        let first = mesh.positions.len() as u32;
        mesh.positions.extend([Vec3::X * 50.0, Vec3::X * 51.0, Vec3::X * 50.5 + Vec3::Y, Vec3::X * 50.5 - Vec3::Y]);
        mesh.positions.push(Vec3::X * 50.5 + Vec3::Z);
        mesh.triangles.extend([[0, 1, 2], [1, 0, 3], [0, 1, 4]].map(|t| t.map(|v| v + first)));
        let mut kept = surface(mesh);
        // Such a surface has no inside; as if it had.
        Arc::get_mut(&mut kept).unwrap().loops = Some(Vec::new());
        let smoothed: Vec<Vec3> = kept.mesh.positions.iter().map(|p| *p * 0.98 + Vec3::Z * 0.1).collect();
        let restored = restored(&kept, &smoothed);
        assert!(restored[first as usize..first as usize + 2] == smoothed[first as usize..first as usize + 2]);
        assert!(restored[first as usize + 2] != smoothed[first as usize + 2]);
    }

    #[test]
    fn slices_give_what_one_run_gives_on_any_number_of_threads() {
        let kept = surface(tube(400, 400, 30.0, |z| 2.0 + (z * 3.0).sin()));
        let smoothed: Vec<Vec3> = kept.mesh.positions.iter().map(|p| *p * (0.98 + 0.01 * p.z.sin())).collect();
        let whole = restored(&kept, &smoothed);
        let (surface, positions, bands) = (&kept, smoothed.clone(), thin(&kept));
        let mut running =
            Running::new(|yielder| async move { restore(surface, positions, &SETTINGS, &bands, &yielder).await });
        let mut last = 0.0;
        let sliced = loop {
            match parallel::with_threads(1, || running.advance(Budget::new(Duration::ZERO))) {
                Progress::Working(fraction) => {
                    assert!((last..1.0).contains(&fraction), "{fraction} after {last}");
                    last = fraction;
                }
                Progress::Done(positions) => break positions,
            }
        };
        assert!(whole == sliced);
        for threads in [2, 7] {
            assert!(parallel::with_threads(threads, || restored(&kept, &smoothed)) == whole, "{threads} threads");
        }
    }
}
