//! The first reduction rate at which a vessel is pinched or lost: of all rates, whatever coarser levels make of it.
//!
//! A pinch need not last: a later step may open the vessel again. So no rate can be left out because those around it are
//! sound, and a look at every level would cost hundreds of times what one level does. But a level differs from the one
//! before by the few triangles that a step moves. Each triangle is followed from the finest level to its end, and at
//! each change
//!
//! - the triangle that comes to be is measured from the samples near it: where it is too close to one, the levels that it
//!   is part of are suspects;
//! - the tetrahedron between the triangle before and after says which samples the surface passes over: summed over all
//!   changes, with their signs, it is the change of the winding number about a sample, and where that falls below 1 the
//!   sample lies outside, the vessel is lost, and the levels until it rises again are suspects.
//!
//! The suspects are looked at in order, from the finest, by the measure that the report uses (`lumen_vessel::width`): the first
//! that it confirms is the answer.

mod tree;

use std::ops::Range;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use self::tree::Tree;
use super::progressive::{NEVER, ProgressiveMesh};
use super::settings::{Target, reduction_percent};
use super::task::{Yielder, at_once, blocks};
use lumen_mesh::parallel;
use lumen_mesh::{Ball, SurfaceIndex, Topology, TriMesh, Vec3, distance_to_triangle, inner_radii};
use lumen_message::messages;
use lumen_vessel::width::{PINCHED, clearances, samples, worst};

/// Triangles of a core that are followed between two looks at the clock.
const TRIANGLES: usize = 128;
/// Rates, in tenths of a percent, from 0 on.
const RATES: usize = Target::MAX_PER_MILLE as usize + 1;

/// The first reduction at which a vessel is pinched.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pinch {
    /// The first reduction rate at which it is, in percent.
    pub from_percent: f64,
    /// Triangles of that level.
    pub triangles: usize,
    /// The middle of the vessel there, in mm.
    pub at_mm: [f32; 3],
    /// Diameter there before, in mm.
    pub diameter_before_mm: f64,
    /// Diameter there at that level, in mm; 0 where the vessel is gone.
    pub diameter_after_mm: f64,
}

messages! {
    /// A [`Pinch`] in words, without a full stop.
    #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
    pub enum PinchMessage {
        /// Something of the vessel is left.
        "verdict-pinched-at-first" Pinched {
            /// Diameter before, in mm.
            before: f64 [1],
            /// In mm.
            x: f32 [1],
            /// In mm.
            y: f32 [1],
            /// In mm.
            z: f32 [1],
            /// The first reduction rate at which it is, in percent.
            percent: f64 [1],
        } => "A vessel of {before:.1} mm is pinched at ({x:.1}, {y:.1}, {z:.1}), first at {percent:.1} %",
        /// The vessel is gone.
        "verdict-lost-at-first" Lost {
            /// Diameter before, in mm.
            before: f64 [1],
            /// In mm.
            x: f32 [1],
            /// In mm.
            y: f32 [1],
            /// In mm.
            z: f32 [1],
            /// The first reduction rate at which it is, in percent.
            percent: f64 [1],
        } => "A vessel of {before:.1} mm is lost at ({x:.1}, {y:.1}, {z:.1}), first at {percent:.1} %",
    }
}

impl Pinch {
    /// In words, with its place.
    pub fn message(&self) -> PinchMessage {
        let Self { from_percent: percent, at_mm: [x, y, z], diameter_before_mm: before, .. } = *self;
        if self.diameter_after_mm > 0.0 {
            PinchMessage::Pinched { before, x, y, z, percent }
        } else {
            PinchMessage::Lost { before, x, y, z, percent }
        }
    }
}

impl std::fmt::Display for Pinch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.message().fmt(f)
    }
}

/// The first reduction rate, to a tenth of a percent, at which a vessel is pinched or lost; `None` where there is none
/// up to the coarsest level, or no vessel to begin with.
pub fn first_pinch(progressive: &ProgressiveMesh) -> Option<Pinch> {
    let finest = progressive.finest();
    let topology = Topology::new(finest.positions.len(), &finest.triangles);
    let index = SurfaceIndex::new(&finest.positions, &finest.triangles);
    let samples = samples(&finest, &topology, &inner_radii(&finest, &topology, &index), &index);
    at_once(first_pinch_of(progressive, &samples, &Yielder::never()))
}

/// As [`first_pinch`], by these samples of the finest level. Rests every millisecond or so; taking a level and measuring the
/// samples on it are one piece each, of up to 20 ns a triangle and 2 microseconds a sample.
pub async fn first_pinch_of(progressive: &ProgressiveMesh, samples: &[Ball], yielder: &Yielder) -> Option<Pinch> {
    if samples.is_empty() {
        return None;
    }
    let count = progressive.triangles.len();
    let mut search = Search::new(progressive, samples);
    for block in blocks(count, TRIANGLES * parallel::threads()) {
        let end = block.end;
        search.follow(block);
        yielder.rest(0.9 * end as f32 / count as f32).await;
    }
    search.settle_passes();
    for rate in 0..RATES as u32 {
        if !search.is_suspect[rate as usize] {
            continue;
        }
        let mesh = progressive.extract(&progressive.level(Target::Reduction(rate)).triangles);
        let at = 0.9 + 0.1 * rate as f32 / RATES as f32;
        let index = SurfaceIndex::build(&mesh.positions, &mesh.triangles, &yielder.part(at..at)).await;
        if let Some(pinch) = pinched(samples, rate, &mesh, &index) {
            return Some(pinch);
        }
        yielder.rest(at).await;
    }
    None
}

/// The vessel that is pinched most at this rate, if one is; `mesh` is the level.
fn pinched(samples: &[Ball], rate: u32, mesh: &TriMesh, index: &SurfaceIndex) -> Option<Pinch> {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let clearances = clearances(samples, mesh, &topology, index);
    let (i, _) = worst(samples, &clearances).filter(|(_, ratio)| *ratio < PINCHED)?;
    Some(Pinch {
        from_percent: reduction_percent(1000, 1000 - rate as usize),
        triangles: mesh.triangles.len(),
        at_mm: samples[i].centre.to_array(),
        diameter_before_mm: 2.0 * f64::from(samples[i].radius),
        diameter_after_mm: 2.0 * f64::from(clearances[i]),
    })
}

/// The search for rates at which a vessel may be pinched.
struct Search<'a> {
    progressive: &'a ProgressiveMesh,
    samples: &'a [Ball],
    tree: Tree,
    /// Steps of the level at each rate.
    steps: Vec<u32>,
    /// Whether each rate has a triangle that is too close to a sample, or a sample outside.
    is_suspect: Vec<bool>,
    passes: Vec<Pass>,
}

/// A step that changes a triangle.
struct Change {
    step: u32,
    /// The node that its corners which end become.
    heir: u32,
    next: [u32; 3],
    /// Whether nothing is left of it.
    is_gone: bool,
}

/// The surface passes over a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Pass {
    sample: u32,
    step: u32,
    /// 1 where the sample comes to lie inside, -1 where it comes to lie outside.
    turn: i32,
}

/// What came of following some triangles.
#[derive(Default)]
struct Followed {
    /// Rates with a triangle that is too close.
    close: Vec<Range<usize>>,
    passes: Vec<Pass>,
}

impl<'a> Search<'a> {
    fn new(progressive: &'a ProgressiveMesh, samples: &'a [Ball]) -> Self {
        let count = progressive.triangles.len();
        let steps = |rate: u32| progressive.steps_to(Target::Reduction(rate).triangles(count));
        Self {
            steps: (0..RATES as u32).map(steps).collect(),
            tree: Tree::new(samples),
            is_suspect: vec![false; RATES],
            passes: Vec::new(),
            progressive,
            samples,
        }
    }

    /// Follows these triangles.
    fn follow(&mut self, block: Range<usize>) {
        let (first, this) = (block.start, &*self);
        let pieces = parallel::map_ranges(block.len(), TRIANGLES, |piece| {
            let (mut found, mut near) = (Followed::default(), Vec::new());
            (first + piece.start..first + piece.end).for_each(|t| this.follow_one(t, &mut found, &mut near));
            found
        });
        for Followed { close, passes } in pieces {
            close.into_iter().for_each(|rates| self.is_suspect[rates].fill(true));
            self.passes.extend(passes);
        }
    }

    /// What a triangle becomes next; `None` where it lasts.
    fn next(&self, corners: [u32; 3]) -> Option<Change> {
        let ProgressiveMesh { node_ends, parents, .. } = self.progressive;
        let step = self.end_of(corners);
        if step == NEVER {
            return None;
        }
        // Both nodes that a step ends go on at once, to the same one.
        let mut heir = corners[0];
        let next = corners.map(|v| {
            let goes_on = node_ends[v as usize] == step;
            if goes_on {
                heir = parents[v as usize];
            }
            if goes_on { heir } else { v }
        });
        let is_gone = next[0] == next[1] || next[1] == next[2] || next[2] == next[0];
        Some(Change { step, heir, next, is_gone })
    }

    /// The step that ends a triangle.
    fn end_of(&self, corners: [u32; 3]) -> u32 {
        corners.map(|v| self.progressive.node_ends[v as usize]).into_iter().fold(NEVER, u32::min)
    }

    /// Whether a triangle comes near a sample from the finest level to its end, or may do so.
    fn comes_near(&self, mut corners: [u32; 3], near: &mut Vec<u32>) -> bool {
        let positions = &self.progressive.positions;
        let [a, b, c] = corners.map(|v| positions[v as usize]);
        let (mut low, mut high) = (a.min(b).min(c), a.max(b).max(c));
        while let Some(change) = self.next(corners) {
            let to = positions[change.heir as usize];
            (low, high) = (low.min(to), high.max(to));
            if change.is_gone {
                break;
            }
            corners = change.next;
        }
        near.clear();
        self.tree.near(low, high, near);
        !near.is_empty()
    }

    /// Follows triangle `t` from the finest level to its end.
    fn follow_one(&self, t: usize, found: &mut Followed, near: &mut Vec<u32>) {
        let ProgressiveMesh { triangles, positions, .. } = self.progressive;
        let mut corners = triangles[t];
        // Most are of the wall, and stay there.
        if !self.comes_near(corners, near) {
            return;
        }
        while let Some(Change { step, heir, next, is_gone }) = self.next(corners) {
            let before = corners.map(|v| positions[v as usize]);
            let to = positions[heir as usize];
            let (low, high) = (before[0].min(before[1]).min(before[2]), before[0].max(before[1]).max(before[2]));
            near.clear();
            self.tree.near(low.min(to), high.max(to), near);
            for &i in &*near {
                let turn = passes_over(&self.samples[i as usize], before, to);
                if turn != 0 {
                    found.passes.push(Pass { sample: i, step, turn });
                }
            }
            if is_gone {
                return;
            }
            let rates = self.rates_between(step, self.end_of(next));
            if !rates.is_empty() {
                let after = next.map(|v| positions[v as usize]);
                let is_close = |&i: &u32| {
                    let Ball { centre, radius } = self.samples[i as usize];
                    // A little more, for the rounding of the measure that decides.
                    distance_to_triangle(centre, after) <= f64::from(PINCHED * radius) * (1.0 + 1e-5)
                };
                if near.iter().any(is_close) {
                    found.close.push(rates);
                }
            }
            corners = next;
        }
    }

    /// The rates whose levels come after step `begin` and not after step `end`.
    fn rates_between(&self, begin: u32, end: u32) -> Range<usize> {
        self.steps.partition_point(|&steps| steps <= begin)..self.steps.partition_point(|&steps| steps <= end)
    }

    /// Makes suspects of the rates at which a sample lies outside.
    fn settle_passes(&mut self) {
        self.passes.sort_unstable();
        let passes = std::mem::take(&mut self.passes);
        for of_sample in passes.chunk_by(|a, b| a.sample == b.sample) {
            let mut winding = 1;
            let mut steps = of_sample.chunk_by(|a, b| a.step == b.step).peekable();
            while let Some(of_step) = steps.next() {
                winding += of_step.iter().map(|pass| pass.turn).sum::<i32>();
                if winding < 1 {
                    let until = steps.peek().map_or(NEVER, |next| next[0].step);
                    let rates = self.rates_between(of_step[0].step, until);
                    self.is_suspect[rates].fill(true);
                }
            }
        }
    }
}

/// What becomes of a sample when the triangle `before` becomes the one, or those, with a corner at `to`: 1 where the
/// surface passes over it outwards, -1 inwards, 0 where it does not.
fn passes_over(sample: &Ball, before: [Vec3; 3], to: Vec3) -> i32 {
    // A hair aside, so that the faces of no symmetric surface go through it.
    let aside = DVec3::new(0.571, 0.312, 0.759) * (1e-6 * f64::from(sample.radius));
    let p = sample.centre.as_dvec3() + aside;
    let [a, b, c] = before.map(Vec3::as_dvec3);
    let d = to.as_dvec3();
    let volume = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| (b - a).cross(c - a).dot(d - a);
    let parts = [volume(p, b, c, d), volume(a, p, c, d), volume(a, b, p, d), volume(a, b, c, p)];
    if parts.iter().all(|&part| part > 0.0) {
        1
    } else if parts.iter().all(|&part| part < 0.0) {
        -1
    } else {
        0
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::progressive::{Limit, Merge};
    use crate::run::Pipeline;
    use crate::settings::{Decimation, Method, Settings, Smoothing};
    use crate::task::{Budget, Progress, Running};
    use lumen_mesh::shapes::{icosphere, joined, square, tube};
    use lumen_vessel::width::narrowing;

    fn samples_of(mesh: &TriMesh) -> Vec<Ball> {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        samples(mesh, &topology, &inner_radii(mesh, &topology, &index), &index)
    }

    /// All levels of a surface as it is.
    fn levels(mesh: TriMesh, method: Method) -> Arc<ProgressiveMesh> {
        let smoothing = Smoothing { iterations: 0, ..Smoothing::default() };
        let decimation = Decimation { method, ..Decimation::default() };
        let settings = Settings { smoothing, decimation, ..Settings::default() };
        let mut pipeline = Pipeline::new(Arc::new(mesh), settings);
        while pipeline.progressive().is_none() {
            pipeline.advance(Budget::UNLIMITED).unwrap();
        }
        pipeline.progressive().unwrap().clone()
    }

    /// The first rate in tenths of a percent at which a look at the whole level finds a vessel pinched: one by one.
    fn by_looking(progressive: &ProgressiveMesh, samples: &[Ball]) -> Option<u32> {
        let mut before = 0;
        (1..=Target::MAX_PER_MILLE).find(|&rate| {
            let level = progressive.level(Target::Reduction(rate));
            if std::mem::replace(&mut before, level.steps) == level.steps {
                return false;
            }
            let mesh = progressive.extract(&level.triangles);
            let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
            let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
            narrowing(samples, &mesh, &topology, &index).is_some_and(|found| found.pinched_places > 0)
        })
    }

    fn rate(pinch: &Pinch) -> u32 {
        (pinch.from_percent * 10.0).round() as u32
    }

    /// A tube of 4 mm beside a sheet that loses its triangles step by step. After `steps[0]` steps a vertex of the tube's
    /// middle goes to the axis with its neighbour, after `steps[1]` back to the wall with another.
    fn pinched_for_a_while(steps: [usize; 2]) -> ProgressiveMesh {
        let (wall, sheet) = (tube(8, 20, 40.0, |_| 2.0), square(40, 40.0, 100.0));
        let mesh = joined(&[wall.clone(), sheet]);
        let first = wall.positions.len() as u32;
        let half = |gone: u32| Merge { gone, kept: gone + 1, made: None };
        let mut merges: Vec<Merge> = (0..40 * 41).map(|i| half(first + i / 40 * 41 + i % 40)).collect();
        let made = mesh.positions.len() as u32;
        let (v, on_axis) = (80, wall.positions[80] * Vec3::new(0.05, 0.05, 1.0));
        merges.insert(steps[0], Merge { gone: v, kept: v + 1, made: Some(made) });
        merges.insert(steps[1] + 1, Merge { gone: made, kept: v + 2, made: Some(made + 1) });
        let errors = vec![0.0; merges.len()];
        let made = [on_axis, wall.positions[v as usize + 1]];
        ProgressiveMesh::from_merges(&mesh, &merges, &made, errors, Limit::default())
    }

    #[test]
    fn a_pinch_that_coarser_levels_undo_is_found() {
        let wall = tube(8, 20, 40.0, |_| 2.0);
        for steps in [[200, 300], [700, 703], [1000, 1400]] {
            let progressive = pinched_for_a_while(steps);
            progressive.assert_well_formed();
            let samples = samples_of(&wall);
            let expected = by_looking(&progressive, &samples).expect("the wall is at the axis for a while");
            let pinch = at_once(first_pinch_of(&progressive, &samples, &Yielder::never())).unwrap();
            assert_eq!(rate(&pinch), expected, "{steps:?}: {pinch:?}");
            assert!((pinch.at_mm[2] - 20.0).abs() < 3.0 && (3.4..4.0).contains(&pinch.diameter_before_mm), "{pinch:?}");
        }
    }

    #[test]
    fn the_first_of_all_rates_is_found() {
        let waisted = |waist: f32| tube(10, 40, 30.0, move |z| 1.5 - (1.5 - waist) * (-(z - 15.0) * (z - 15.0)).exp());
        // A closed vessel that ends in a thin branch: there it is lost before it is pinched.
        let mut drop = icosphere(3, 5.0, Vec3::ZERO);
        drop.positions.iter_mut().for_each(|p| {
            if p.z > 4.5 {
                p.z += (p.z - 4.5) * 16.0;
            }
        });
        for (name, mesh) in [("tube", waisted(1.5)), ("waist", waisted(0.8)), ("drop", drop)] {
            for method in Method::ALL {
                let progressive = levels(mesh.clone(), method);
                let samples = samples_of(&progressive.finest());
                let found = first_pinch(&progressive).map(|pinch| rate(&pinch));
                assert_eq!(found, by_looking(&progressive, &samples), "{name}, {method:?}");
            }
        }
    }

    #[test]
    fn a_pinch_is_told_as_it_is_measured() {
        let progressive = levels(tube(32, 160, 40.0, |_| 0.75), Method::Schroeder);
        let pinch = first_pinch(&progressive).expect("at 99.9 % no more than ten triangles are left");
        let level = progressive.extract(&progressive.level(Target::Reduction(rate(&pinch))).triangles);
        let topology = Topology::new(level.positions.len(), &level.triangles);
        let index = SurfaceIndex::new(&level.positions, &level.triangles);
        let found = narrowing(&samples_of(&progressive.finest()), &level, &topology, &index).unwrap();
        assert!(rate(&pinch) >= 950 && found.pinched_places > 0, "{pinch:?}");
        assert_eq!((pinch.triangles, pinch.at_mm), (level.triangles.len(), found.at_mm));
        assert_eq!(pinch.diameter_after_mm, found.diameter_after_mm);
        assert!(pinch.to_string().starts_with("A vessel of 1.5 mm is "), "{pinch}");
    }

    #[test]
    fn slices_and_threads_change_nothing_and_nothing_has_no_pinch() {
        let progressive = levels(tube(24, 60, 20.0, |_| 0.75), Method::Schroeder);
        let whole = first_pinch(&progressive);
        let finest = progressive.finest();
        let (levels, samples) = (&*progressive, samples_of(&finest));
        let mut running = Running::new(|yielder| async move { first_pinch_of(levels, &samples, &yielder).await });
        let sliced = loop {
            match running.advance(Budget::new(std::time::Duration::ZERO)) {
                Progress::Working(fraction) => assert!((0.0..=1.0).contains(&fraction)),
                Progress::Done(found) => break found,
            }
        };
        assert_eq!(sliced, whole);
        for threads in [1, 2, 7] {
            assert_eq!(parallel::with_threads(threads, || first_pinch(&progressive)), whole);
        }
        assert_eq!(first_pinch(&ProgressiveMesh::default()), None);
    }
}
