//! Windowed-sinc smoothing of a surface: Taubin, Zhang and Golub, "Optimal surface smoothing as filter design" (1996).
//!
//! With uniform (umbrella) weights, `K x_i = x_i - mean of x_i's neighbours` and `M = I - K/2`, the filtered surface
//! is `sum of c_n T_n(M) x` (`super::filter` has the `c_n`), evaluated by the Chebyshev recurrence
//!
//! ```text
//! x_0 = x,   x_1 = (x_0 + mean(x_0)) / 2,   x_{n+1} = x_n + mean(x_n) - x_{n-1}
//! ```
//!
//! in as many passes over the neighbours as there are iterations. Boundary vertices see the two neighbours along
//! their loop only; vertices on non-manifold edges, and those where several loops meet, stay where they are
//! (`stencil`). Positions are kept relative to the middle of the surface in f32, four lanes a vertex.
//!
//! Vertices are put in an `order` in which neighbours are close, and the order is cut into one `strip` a thread. What
//! comes out depends on neither: each vertex's sums have one order. The `terms` `x_n` are kept where they are few:
//! another filter of the same degree or less is then but another sum of them.

mod calibre;
mod gains;
mod guard;
mod kept_terms;
mod layout;
mod means;
mod order;
mod placement;
mod restore;
mod stencil;
mod strip;
mod terms;
mod volume;

use glam::{Vec3, Vec4};

pub(crate) use self::calibre::least_pass_bands;
use self::gains::{Gains, Mix};
pub(crate) use self::guard::{Guarded, guard};
pub(crate) use self::kept_terms::{KeptTerms, Preparation, TERMS_BYTES};
use self::layout::Layout;
use self::order::Order;
use self::placement::Placement;
pub(crate) use self::restore::restore;
use self::stencil::Stencil;
use self::strip::{Strip, Wave};
pub use self::terms::Terms;
pub(crate) use self::volume::{Before, TOLERANCE as VOLUME_TOLERANCE, hold_volume};
use super::filter::Filter;
use super::settings::{Boundary, Smoothing};
use super::task::{Yielder, at_once};
use lumen_mesh::parallel;
use lumen_mesh::{Bounds, Topology};

/// Passes in a wave, at most.
const DEEPEST: usize = 16;

/// Bytes that the chunks under a wave may have: about a core's share of the cache.
const CACHE: usize = 1 << 20;

/// Bytes of a vertex and its row that a pass touches.
const BYTES_A_VERTEX: usize = 3 * 16 + 6 * 4;

/// The smoothed positions of a surface, in mm.
pub fn smooth(positions: &[Vec3], topology: &Topology, boundary: Boundary, filter: &Filter) -> Vec<Vec3> {
    at_once(smooth_in_slices(positions, topology, boundary, filter, &Yielder::never()))
}

/// As [`smooth`], resting every millisecond or so.
pub async fn smooth_in_slices(
    positions: &[Vec3],
    topology: &Topology,
    boundary: Boundary,
    filter: &Filter,
    yielder: &Yielder,
) -> Vec<Vec3> {
    smooth_keeping_terms(positions, topology, boundary, filter, 0, yielder).await.0
}

/// As [`smooth_in_slices`], with the terms where they take no more than `bytes`.
pub async fn smooth_keeping_terms(
    positions: &[Vec3],
    topology: &Topology,
    boundary: Boundary,
    filter: &Filter,
    bytes: usize,
    yielder: &Yielder,
) -> (Vec<Vec3>, Option<Terms>) {
    let stencil = Stencil::new(positions, topology, boundary);
    filtered(positions.to_vec(), stencil, Coefficients::of(filter), bytes, yielder).await
}

/// Smooths each vertex with a pass band of its own, or that of `settings` if it is larger; the rest is as `settings`
/// say. Gives the positions in mm, and the terms where they take no more than `bytes`.
pub async fn smooth_varying(
    positions: &[Vec3],
    topology: &Topology,
    settings: &Smoothing,
    pass_bands: &[f32],
    bytes: usize,
    yielder: &Yielder,
) -> (Vec<Vec3>, Option<Terms>) {
    let stencil = Stencil::new(positions, topology, settings.boundary);
    yielder.rest(0.0).await;
    let (gains, mixes) = Gains::varying(settings, pass_bands);
    yielder.rest(0.0).await;
    filtered(positions.to_vec(), stencil, Coefficients { gains, mixes, gain: 1.0 }, bytes, yielder).await
}

/// By what each term counts at each vertex.
struct Coefficients {
    gains: Gains,
    /// Empty where the gains are the same everywhere.
    mixes: Vec<Mix>,
    /// `f(0)`.
    gain: f64,
}

impl Coefficients {
    fn of(filter: &Filter) -> Self {
        Self { gains: Gains::of(filter), mixes: Vec::new(), gain: filter.dc_gain() }
    }
}

/// Filters any three numbers at each vertex.
async fn filtered(
    values: Vec<Vec3>,
    stencil: Stencil<'_>,
    coefficients: Coefficients,
    bytes: usize,
    yielder: &Yielder,
) -> (Vec<Vec3>, Option<Terms>) {
    let Coefficients { gains, mixes, gain } = coefficients;
    let centre = Bounds::of_most(&values).centre();
    let mut order = Order::new(&stencil, &mixes);
    yielder.rest(0.0).await;
    let chunks = order.chunks.len() - 1;
    let count = strip_count(chunks);
    let widest = order.chunks.windows(2).map(|pair| (pair[1] - pair[0]) as usize).max().unwrap_or(1).max(1);
    let depth = (CACHE / (widest * BYTES_A_VERTEX)).clamp(2, DEEPEST).min((chunks / count / 2).max(1));
    let own = |i: usize| i * chunks / count..(i + 1) * chunks / count;
    let mut strips: Vec<Strip> = (0..count).map(|i| Strip::new(&order, own(i), depth)).collect();
    let fixed = (0..values.len() as u32).filter(|&v| stencil.stays(v));
    let fixed = fixed.map(|v| (v, values[v as usize])).collect();
    let placement = Placement { fixed, places: std::mem::take(&mut order.places), centre };

    let layout = Layout { order, stencil, values, centre, mixes };
    while !each(&mut strips, |strip| strip.lay_out(&layout, &placement.places, &gains, yielder)) {
        yielder.pause(0.0).await;
    }
    drop(layout);

    let degree = gains.degree();
    let keeps_terms = bytes > 0 && Terms::bytes(placement.places.len(), degree) <= bytes as u64;
    if keeps_terms {
        strips.iter_mut().for_each(|strip| strip.keep_terms(degree));
    }
    let mut first = 1;
    while first <= degree {
        let wave = Wave { first, count: depth.min(degree + 1 - first) };
        strips.iter_mut().for_each(Strip::rewind);
        while !each(&mut strips, |strip| strip.advance(wave, &gains, yielder)) {
            let done = strips.iter().map(|strip| strip.progress(wave)).sum::<f32>() / strips.len() as f32;
            yielder.pause(((first - 1) as f32 + done * wave.count as f32) / degree as f32).await;
        }
        for seam in 1..strips.len() {
            let (before, after) = strips.split_at_mut(seam);
            before[seam - 1].exchange(&mut after[0]);
        }
        first += wave.count;
        yielder.rest((first - 1) as f32 / degree as f32).await;
    }
    yielder.rest(1.0).await;
    let sums: Vec<&[Vec4]> = strips.iter().map(Strip::own_sum).collect();
    let positions = placement.place(&sums, gain);
    let blocks = strips.into_iter().map(|strip| strip.terms).collect();
    (positions, keeps_terms.then(|| Terms::new(blocks, degree, placement)))
}

/// Works on all strips at once; whether all are done.
fn each(strips: &mut [Strip], work: impl Fn(&mut Strip) -> bool + Sync + Send) -> bool {
    parallel::map(strips.iter_mut().collect(), work).into_iter().all(|done| done)
}

/// Strips for so many chunks: one a thread, but none so small that the halos would be most of it.
fn strip_count(chunks: usize) -> usize {
    (chunks / 8).clamp(1, parallel::threads())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::{Budget, Progress, Running};

    /// A flat n x n grid of quads split in two, spacing 1 mm.
    fn grid(n: u32, z: impl Fn(u32, u32) -> f32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let at = |x: u32, y: u32| y * (n + 1) + x;
        let positions = (0..=n).flat_map(|y| (0..=n).map(move |x| (x, y)));
        let triangles = (0..n).flat_map(|y| (0..n).map(move |x| (x, y))).flat_map(|(x, y)| {
            let (a, b, c, d) = (at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1));
            [[a, b, c], [a, c, d]]
        });
        (positions.map(|(x, y)| Vec3::new(x as f32, y as f32, z(x, y))).collect(), triangles.collect())
    }

    #[test]
    fn the_origin_does_not_matter() {
        let (positions, triangles) = grid(20, |x, y| ((x * 7 + y * 3) % 5) as f32 * 0.2);
        let topology = Topology::new(positions.len(), &triangles);
        for window in crate::settings::Window::ALL {
            let filter = Filter::new(&Smoothing { window, ..Smoothing::PAPER });
            let here = smooth(&positions, &topology, Boundary::Loop, &filter);
            // A shift that f32 holds exactly, so that nothing but the filter can differ.
            let shifted: Vec<Vec3> = positions.iter().map(|&p| p + 512.0).collect();
            let there = smooth(&shifted, &topology, Boundary::Loop, &filter);
            let worst = here.iter().zip(&there).map(|(a, b)| (*a + 512.0 - *b).length()).fold(0.0, f32::max);
            assert!(worst < 2e-4, "{window:?} moved by {worst} mm"); // three ulp at 512
        }
    }

    #[test]
    fn a_vertex_far_away_moves_none_that_it_does_not_reach() {
        let (positions, triangles) = grid(40, |x, y| ((x * 7 + y * 3) % 5) as f32 * 0.2);
        let topology = Topology::new(positions.len(), &triangles);
        let filter = Filter::new(&Smoothing { iterations: 7, ..Smoothing::PAPER });
        let without = smooth(&positions, &topology, Boundary::Loop, &filter);
        let stray = 41 * 20 + 3;
        for far in [1e6, 1e8] {
            let mut strayed = positions.clone();
            strayed[stray].z = far;
            let with = smooth(&strayed, &topology, Boundary::Loop, &filter);
            let out_of_reach =
                (0..positions.len()).filter(|&v| (positions[v] - positions[stray]).truncate().length() > 11.0);
            let worst = out_of_reach.map(|v| (with[v] - without[v]).length()).fold(0.0, f32::max);
            assert!(worst < 2e-5, "{far}: moved by {worst} mm");
        }
    }

    #[test]
    fn slices_give_what_one_run_gives() {
        let (positions, triangles) = grid(150, |x, y| ((x * 7 + y * 3) % 5) as f32 * 0.2);
        let topology = Topology::new(positions.len(), &triangles);
        let filter = Filter::new(&Smoothing { iterations: 7, ..Smoothing::PAPER });
        let whole = smooth(&positions, &topology, Boundary::Loop, &filter);
        let (positions, topology, filter) = (&positions, &topology, &filter);
        let mut running = Running::new(|yielder| async move {
            smooth_in_slices(positions, topology, Boundary::Loop, filter, &yielder).await
        });
        let mut slices = 0;
        let sliced = loop {
            match running.advance(Budget::new(std::time::Duration::ZERO)) {
                Progress::Working(fraction) => assert!((0.0..=1.0).contains(&fraction)),
                Progress::Done(result) => break result,
            }
            slices += 1;
        };
        assert!(slices >= 7);
        assert_eq!(whole, sliced);
    }

    #[test]
    fn vertices_on_a_non_manifold_edge_stay_to_the_bit() {
        let positions = vec![Vec3::X * 0.1, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Z];
        let triangles = [[0, 1, 2], [1, 0, 3], [0, 1, 4]];
        let topology = Topology::new(5, &triangles);
        let filter = Filter::new(&Smoothing::PAPER);
        let smoothed = smooth(&positions, &topology, Boundary::Loop, &filter);
        assert_eq!(smoothed[..2], positions[..2]);
        // The others are pulled between them: a filter of unit gain keeps them near.
        assert!(smoothed.iter().all(|p| p.length() < 2.0), "{smoothed:?}");
    }
}
