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

use std::sync::Arc;

use glam::Vec3;

use super::Stencil;
use super::volume::directions;
use crate::normals::{Weighting, vertex_normals};
use crate::response::edge_length;
use crate::results::Surface;
use crate::settings::Smoothing;
use crate::task::{Budget, Progress, Task};
use lumen_mesh::Topology;
use lumen_mesh::parallel;

/// Means with the neighbours. They reach as far as around vessels of some five edges' radius; of a wave of four edges
/// they leave less than a hundredth.
const MEANS: usize = 16;
/// Typical edges of the surface, root mean square, that an edge is long from.
const LONG: f32 = 2.0;
/// Vertices that a core works on in one go.
const PIECE: usize = 4096;
/// Vertices between two looks at the clock.
const VERTICES: usize = 16 * PIECE;

/// The restoration at work, in slices.
pub struct RestoreTask {
    /// As it was before smoothing; its windings agree.
    kept: Arc<Surface>,
    stencil: Stencil<Arc<Topology>>,
    /// As the filter made it.
    smoothed: Vec<Vec3>,
    /// Of each vertex, and that of the setting.
    bands: Arc<[f32]>,
    pass_band: f32,
    /// Before smoothing until the losses are known, then after it.
    normals: Vec<Vec3>,
    /// In mm, positive where the surface moved inwards, as far as they are evened out.
    losses: Vec<f32>,
    /// Of the pass at work.
    evened: Vec<f32>,
    step: Step,
    /// The vertices of the pass that are done.
    done: usize,
}

#[derive(Clone, Copy)]
enum Step {
    Normals,
    Losses,
    Even(usize),
    Place,
}

impl RestoreTask {
    /// Starts from `smoothed`, the positions in mm that the filter of `settings` gave the vertices of `kept`, each with its
    /// own of `bands`.
    ///
    /// # Errors
    /// The positions as they are, where no vessel asked for a wider pass band than the settings', or the windings do not
    /// agree: then no side is the inside.
    pub fn new(
        kept: &Arc<Surface>,
        smoothed: Vec<Vec3>,
        settings: &Smoothing,
        bands: &Arc<[f32]>,
    ) -> Result<Self, Vec<Vec3>> {
        let pass_band = settings.pass_band as f32;
        if kept.loops.is_none() || bands.iter().all(|&band| band <= pass_band) {
            return Err(smoothed);
        }
        Ok(Self {
            kept: kept.clone(),
            stencil: Stencil::new(&kept.mesh.positions, kept.topology.clone(), settings.boundary),
            bands: bands.clone(),
            pass_band,
            normals: Vec::new(),
            losses: Vec::new(),
            evened: vec![0.0; smoothed.len()],
            smoothed,
            step: Step::Normals,
            done: 0,
        })
    }

    fn normals_of(&self, positions: &[Vec3]) -> Vec<Vec3> {
        vertex_normals(positions, &self.kept.mesh.triangles, Weighting::Area)
    }

    /// What smoothing took at each vertex.
    fn measure(&mut self) {
        let after = self.normals_of(&self.smoothed);
        let (opened, before, smoothed) = (&self.kept.mesh.positions, &self.normals, &self.smoothed);
        let topology = &self.kept.topology;
        let typical = edge_length(&self.kept.mesh) as f32;
        let loss = |v: usize| {
            let loss = (opened[v] - smoothed[v]).dot((before[v] + after[v]).normalize_or_zero());
            // What moved by more than an edge was no vessel's wall: a flap, a short slit drawn together, or a spike, whose own
            // edges are as long as it is.
            let around = topology.neighbours(v as u32);
            let lengths = around.iter().map(|&n| opened[v].distance(opened[n as usize])).sum::<f32>();
            let edge = (lengths / around.len().max(1) as f32).min(LONG * typical);
            loss.max(-edge).min(edge)
        };
        self.losses = parallel::map_ranges(smoothed.len(), PIECE, |range| range.map(loss).collect::<Vec<_>>()).concat();
        self.normals = after;
    }

    /// The next vertices of a mean with the neighbours; whether they were the last.
    fn even_some(&mut self) -> bool {
        let (first, end) = (self.done, self.losses.len().min(self.done + VERTICES));
        let (losses, topology) = (&self.losses, &self.kept.topology);
        parallel::for_each_chunk_mut(&mut self.evened[first..end], PIECE, |from, chunk| {
            for (v, evened) in (first + from..).zip(chunk) {
                // A rim too is evened with the wall behind it, though the filter knows its loop alone.
                let around = topology.neighbours(v as u32);
                let sum = around.iter().map(|&n| losses[n as usize]).sum::<f32>();
                *evened = (losses[v] + sum / around.len().max(1) as f32) / 2.0;
            }
        });
        self.done = end;
        if end < self.losses.len() {
            return false;
        }
        self.done = 0;
        std::mem::swap(&mut self.losses, &mut self.evened);
        true
    }

    /// The positions with what was lost.
    fn place(&mut self) -> Vec<Vec3> {
        let loops = self.kept.loops.as_deref().unwrap_or_default();
        let directions = directions(&self.smoothed, &self.normals, loops);
        let mut positions = std::mem::take(&mut self.smoothed);
        parallel::for_each_chunk_mut(&mut positions, PIECE, |first, chunk| {
            for (v, position) in (first..).zip(chunk) {
                let share = (self.bands[v] / self.pass_band - 1.0).clamp(0.0, 1.0);
                if share > 0.0 && !self.stencil.stays(v as u32) {
                    *position += directions[v].as_vec3() * (share * self.losses[v]);
                }
            }
        });
        positions
    }
}

impl Task for RestoreTask {
    type Output = Vec<Vec3>;

    fn advance(&mut self, budget: Budget) -> Progress<Vec<Vec3>> {
        loop {
            let step = self.step;
            self.step = match step {
                Step::Normals => {
                    self.normals = self.normals_of(&self.kept.mesh.positions);
                    Step::Losses
                }
                Step::Losses => {
                    self.measure();
                    Step::Even(0)
                }
                Step::Even(mean) if !self.even_some() => Step::Even(mean),
                Step::Even(mean) if mean + 1 < MEANS => Step::Even(mean + 1),
                Step::Even(_) => Step::Place,
                Step::Place => return Progress::Done(self.place()),
            };
            if budget.is_spent() {
                let steps = MEANS as f32 + 3.0;
                return Progress::Working(match self.step {
                    Step::Normals => 0.0,
                    Step::Losses => 1.0 / steps,
                    Step::Even(mean) => (2.0 + mean as f32) / steps,
                    Step::Place => 1.0 - 1.0 / steps,
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use glam::Quat;

    use super::*;
    use lumen_mesh::shapes::tube;
    use lumen_mesh::{Measures, TriMesh, oriented_loops};

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
        Arc::new(Surface { mesh: Arc::new(mesh), topology: Arc::new(topology), loops, measures })
    }

    /// The pass bands of a vessel that is thin everywhere.
    fn thin(kept: &Surface) -> Arc<[f32]> {
        vec![0.1; kept.mesh.positions.len()].into()
    }

    fn restored(kept: &Arc<Surface>, smoothed: &[Vec3]) -> Vec<Vec3> {
        RestoreTask::new(kept, smoothed.to_vec(), &SETTINGS, &thin(kept)).ok().unwrap().finish()
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
        let wide: Arc<[f32]> = vec![band; drawn_in.len()].into();
        let unchanged = RestoreTask::new(&kept, drawn_in.clone(), &SETTINGS, &wide).err();
        assert!(unchanged.is_some_and(|positions| positions == drawn_in));
        // Half wide, half thin: the wide half stays to the bit, the thin one comes back, at 1.5 times the band by half.
        let share = |i: usize| [0.0, 1.0, 0.5][i * 3 / drawn_in.len()];
        let mixed: Arc<[f32]> = (0..drawn_in.len()).map(|i| band * (1.0 + share(i))).collect();
        let restored = RestoreTask::new(&kept, drawn_in.clone(), &SETTINGS, &mixed).ok().unwrap().finish();
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
        let unchanged = RestoreTask::new(&kept, smoothed.clone(), &SETTINGS, &thin(&kept)).err();
        assert!(unchanged.is_some_and(|positions| positions == smoothed));
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
        let mut task = RestoreTask::new(&kept, smoothed.clone(), &SETTINGS, &thin(&kept)).ok().unwrap();
        let mut last = 0.0;
        let sliced = loop {
            match parallel::with_threads(1, || task.advance(Budget::new(Duration::ZERO))) {
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
