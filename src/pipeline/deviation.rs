//! The deviation of one surface from another: how far apart they are, in millimetres, measured both ways.
//!
//! Each surface is sampled evenly by area and each sample is measured to the nearest point of the other; mean, RMS and
//! 95th percentile are over the pooled samples of both, as in Metro (Cignoni, Rocchini and Scopigno, "Metro: measuring
//! error on simplified surfaces", 1998). The maximum is over the samples and all
//! vertices of both, so it misses no tip; it remains a lower bound of the Hausdorff distance, which can lie between.
//!
//! Sample `i` of `n` lies in the `i`-th of `n` equal parts of the area, in the order of the triangles, and its place
//! there comes from a hash of `i` (SplitMix64: Steele, Lea and Flood, "Fast splittable pseudorandom number generators",
//! 2014). A sample is thus known from its number alone, and the result depends on neither slices nor threads: all cores
//! measure samples, and of equal distances the first counts.
//!
//! The same samples make a map over the second surface ([`DeviationTask::with_map`]): each counts at the corners of the
//! triangle that it lies on or is nearest to, by its place there, and a vertex has the mean of what counts at it. So the
//! mean over the map is the mean that is reported, and its range is that of the percentile: a map of the farthest point
//! around each vertex would be of another kind than the numbers beside it.

use std::mem;
use std::ops::Deref;
use std::sync::Arc;
use std::task::Poll;

use glam::Vec3;
use serde::{Deserialize, Serialize};

use super::task::{Budget, Progress, Task};
use crate::mesh::{IndexBuild, Nearest, SurfaceIndex, TriMesh, triangle_area};
use crate::parallel;

/// Samples of each surface for a report.
pub const REPORT_SAMPLES: usize = 200_000;
/// Samples of each surface while a user waits.
pub const INTERACTIVE_SAMPLES: usize = 50_000;

/// Queries of a core between two looks at the clock.
const QUERIES: usize = 256;
/// Units of lighter work between two looks at the clock.
const UNITS: usize = 8192;
/// A vertex of the map at which less than so many samples count has its neighbours' as well.
const FEW: f64 = 4.0;

/// Two-sided distance between two surfaces, in mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Deviation {
    /// Mean over the samples of both surfaces.
    pub mean: f64,
    /// Root of the mean square over the samples.
    pub rms: f64,
    /// 95th percentile of the samples, interpolated between neighbours.
    pub p95: f64,
    /// Largest over the samples and the vertices of both surfaces.
    pub max: f64,
    /// Where: the two points that are so far apart, on the first surface and on the second, in mm.
    pub max_at_mm: [[f32; 3]; 2],
}

/// What a [`DeviationTask`] finds.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The summary.
    pub deviation: Deviation,
    /// For each vertex of the second surface, the mean distance of the samples around it, in mm; 0 for a vertex no
    /// triangle uses. Empty unless a map was asked for.
    pub map: Vec<f32>,
}

/// The deviation between `a` and `b` by `samples` samples of each (at least one); `None` where one of them has no area.
///
/// # Panics
/// When an index of a triangle is out of range.
pub fn deviation(a: &TriMesh, b: &TriMesh, samples: usize) -> Option<Deviation> {
    Some(DeviationTask::new(a, b, samples).finish()?.deviation)
}

/// A comparison of two surfaces in slices; `M` is any pointer to a mesh.
#[derive(Debug)]
pub struct DeviationTask<M> {
    samples: usize,
    sides: [Side<M>; 2],
    /// Position in [`STAGES`].
    stage: usize,
    /// Position within the stage.
    next: usize,
    build: IndexBuild,
    index_was_given: bool,
    distances: Vec<f32>,
    farthest: Farthest,
    wants_map: bool,
    /// For each vertex of the second surface, the weights that count there, and the distances times their weights.
    sums: Vec<[f64; 2]>,
    /// Below this weight a vertex of the map takes its neighbours' sums.
    least_weight: f64,
    result: Option<Comparison>,
}

#[derive(Debug)]
struct Side<M> {
    mesh: M,
    index: Option<Arc<SurfaceIndex>>,
    /// Area of the triangles up to and with each, in mm2.
    areas: Vec<f64>,
    /// Vertices that a triangle uses.
    used: Vec<bool>,
}

#[derive(Clone, Copy, Debug)]
enum Stage {
    /// Prefix sums of this side's areas.
    Areas(usize),
    /// The index of this side's triangles.
    Index(usize),
    /// This side's vertices to the other.
    Vertices(usize),
    /// This side's samples to the other.
    Samples(usize),
    /// The map, where it was asked for.
    Map,
    Summary,
}

/// Vertices count where they are farther than all before.
const STAGES: [Stage; 10] = [
    Stage::Areas(0),
    Stage::Areas(1),
    Stage::Index(1),
    Stage::Vertices(0),
    Stage::Samples(0),
    Stage::Index(0),
    Stage::Samples(1),
    Stage::Vertices(1),
    Stage::Map,
    Stage::Summary,
];

impl<M: Deref<Target = TriMesh> + Sync> DeviationTask<M> {
    /// A comparison of `a` with `b` by `samples` samples of each (at least one).
    pub fn new(a: M, b: M, samples: usize) -> Self {
        Self {
            samples: samples.max(1),
            sides: [a, b].map(|mesh| Side { mesh, index: None, areas: Vec::new(), used: Vec::new() }),
            stage: 0,
            next: 0,
            build: IndexBuild::new(),
            index_was_given: false,
            distances: Vec::new(),
            farthest: Farthest::default(),
            wants_map: false,
            sums: Vec::new(),
            least_weight: FEW,
            result: None,
        }
    }

    /// Makes a map of the distances over `b` as well.
    #[must_use]
    pub fn with_map(mut self) -> Self {
        self.wants_map = true;
        self
    }

    /// Uses an index of `a` that is there already: for many levels compared with one input.
    #[must_use]
    pub fn with_index_of_a(mut self, index: Arc<SurfaceIndex>) -> Self {
        self.sides[0].index = Some(index);
        self.index_was_given = true;
        self
    }

    /// The index of `a`, once it is built.
    pub fn index_of_a(&self) -> Option<&Arc<SurfaceIndex>> {
        self.sides[0].index.as_ref()
    }

    /// The index of `b`, once it is built.
    pub fn index_of_b(&self) -> Option<&Arc<SurfaceIndex>> {
        self.sides[1].index.as_ref()
    }

    /// The part that is done, 0-1, by estimated time.
    fn fraction(&self) -> f32 {
        let cost = |stage: &Stage| self.cost(*stage) as f32;
        let done: f32 = STAGES[..self.stage].iter().map(cost).sum();
        let all: f32 = STAGES.iter().map(cost).sum();
        let current = STAGES.get(self.stage).map_or(0.0, |&stage| match stage {
            Stage::Index(_) => cost(&stage) * self.build.fraction(),
            _ => cost(&stage) * self.next as f32 / self.length(stage).max(1) as f32,
        });
        (done + current) / all
    }

    /// Number of things a stage goes through.
    fn length(&self, stage: Stage) -> usize {
        match stage {
            Stage::Areas(side) | Stage::Index(side) => self.sides[side].mesh.triangles.len(),
            Stage::Vertices(side) => self.sides[side].mesh.positions.len(),
            Stage::Samples(_) | Stage::Summary => self.samples,
            Stage::Map if self.wants_map => self.sides[1].mesh.triangles.len(),
            Stage::Map => 0,
        }
    }

    /// Time of a stage, in nanoseconds by rule of thumb.
    fn cost(&self, stage: Stage) -> usize {
        let each = match stage {
            Stage::Areas(_) => 10,
            Stage::Index(0) if self.index_was_given => 0,
            Stage::Index(_) => 250,
            Stage::Samples(_) => 700,
            Stage::Vertices(_) => 200,
            Stage::Map | Stage::Summary => 20,
        };
        1 + each * self.length(stage)
    }

    /// One piece of the current stage.
    fn step(&mut self) {
        let stage = STAGES[self.stage];
        let length = self.length(stage);
        let done = match stage {
            Stage::Areas(side) => {
                self.next = self.sides[side].add_areas(self.next, length.min(self.next + UNITS));
                // A surface without area has no samples, and nothing is near to it.
                if self.next == length && self.sides[side].areas.last().is_none_or(|&area| area <= 0.0) {
                    self.stage = STAGES.len();
                    return;
                }
                self.next == length
            }
            Stage::Index(side) => self.sides[side].add_index(&mut self.build),
            Stage::Vertices(side) => {
                let end = length.min(self.next + QUERIES * parallel::threads());
                self.measure_vertices(side, end);
                self.next = end;
                end == length
            }
            Stage::Samples(side) => {
                let end = length.min(self.next + QUERIES * parallel::threads());
                self.measure_samples(side, end);
                self.next = end;
                end == length
            }
            Stage::Map => !self.wants_map || self.spread(),
            Stage::Summary => {
                let deviation = summary(&mut self.distances, &self.farthest);
                let mean = |[weight, sum]: [f64; 2]| if weight > 0.0 { (sum / weight) as f32 } else { 0.0 };
                let map = mem::take(&mut self.sums).into_iter().map(mean).collect();
                self.result = Some(Comparison { deviation, map });
                true
            }
        };
        if done {
            self.stage += 1;
            self.next = 0;
        }
    }

    fn measure_vertices(&mut self, side: usize, end: usize) {
        let Side { mesh, used, .. } = &self.sides[side];
        let Some(other) = &self.sides[1 - side].index else { return };
        let (first, sofar) = (self.next, self.farthest.distance);
        let pieces = parallel::map_ranges(end - first, QUERIES, |piece| {
            let mut queries = Queries::new(other, side);
            let piece = first + piece.start..first + piece.end;
            for (&p, &used) in mesh.positions[piece.clone()].iter().zip(&used[piece]) {
                if used && !other.is_within(p, sofar) {
                    queries.measure(p);
                }
            }
            queries
        });
        pieces.into_iter().for_each(|queries| self.farthest.take(queries.farthest));
    }

    fn measure_samples(&mut self, side: usize, end: usize) {
        let Some(other) = &self.sides[1 - side].index else { return };
        let sampler = Sampler { side: &self.sides[side], count: self.samples, stream: side as u64 };
        let (first, wants_map) = (self.next, self.wants_map);
        let pieces = parallel::map_ranges(end - first, QUERIES, |piece| {
            let mut queries = Queries::new(other, side);
            for sample in sampler.samples(first + piece.start, first + piece.end) {
                let found = queries.measure(sample.point);
                let distance = found.map_or(0.0, |found| found.distance);
                queries.distances.push(distance);
                if wants_map {
                    let foot = found.map(|found| (found.triangle, found.barycentric));
                    queries.places.push(if side == 0 { foot } else { Some((sample.triangle, sample.weights)) });
                }
            }
            queries
        });
        if wants_map && self.sums.is_empty() {
            self.sums = vec![[0.0; 2]; self.sides[1].mesh.positions.len()];
        }
        for Queries { distances, places, farthest, .. } in pieces {
            self.farthest.take(farthest);
            for (place, &distance) in places.into_iter().zip(&distances) {
                let Some((triangle, weights)) = place else { continue };
                let corners = self.sides[1].mesh.triangles[triangle as usize];
                for (v, weight) in corners.into_iter().zip(weights.map(f64::from)) {
                    let [weights, sum] = &mut self.sums[v as usize];
                    *weights += weight;
                    *sum += weight * f64::from(distance);
                }
            }
            self.distances.extend(distances);
        }
    }

    /// Gives the vertices of the map at which few samples count their neighbours' as well, and round by round those at
    /// which none counts; whether that was the last round.
    fn spread(&mut self) -> bool {
        let is_poor = |[weight, _]: [f64; 2], least: f64| weight < least || weight == 0.0;
        let before = self.sums.clone();
        let mut has_gained = false;
        for &corners in &self.sides[1].mesh.triangles {
            let sums = corners.map(|v| before[v as usize]);
            for (i, v) in corners.into_iter().enumerate() {
                if is_poor(sums[i], self.least_weight) {
                    let [of_one, of_other] = [sums[(i + 1) % 3], sums[(i + 2) % 3]];
                    let own = &mut self.sums[v as usize];
                    *own = [own[0] + of_one[0] + of_other[0], own[1] + of_one[1] + of_other[1]];
                    has_gained |= own[0] > 0.0;
                }
            }
        }
        self.least_weight = 0.0;
        let is_empty = |corners: &[u32; 3]| corners.iter().any(|&v| self.sums[v as usize][0] == 0.0);
        !has_gained || !self.sides[1].mesh.triangles.iter().any(is_empty)
    }
}

/// Two points that are farther apart than all before.
#[derive(Clone, Copy, Debug)]
struct Farthest {
    /// Less than 0 where there is none yet.
    distance: f32,
    /// On the first surface and on the second.
    points: [Vec3; 2],
}

impl Default for Farthest {
    fn default() -> Self {
        Self { distance: -1.0, points: [Vec3::ZERO; 2] }
    }
}

impl Farthest {
    fn take(&mut self, other: Self) {
        if other.distance > self.distance {
            *self = other;
        }
    }
}

/// Queries of one piece of work.
struct Queries<'a> {
    surface: &'a SurfaceIndex,
    /// The surface that the queries are points of.
    side: usize,
    last: Option<Nearest>,
    distances: Vec<f32>,
    /// For the map: the triangle of the second surface at which each distance counts, and where in it.
    places: Vec<Option<(u32, [f32; 3])>>,
    farthest: Farthest,
}

impl<'a> Queries<'a> {
    fn new(surface: &'a SurfaceIndex, side: usize) -> Self {
        let (distances, places) = (Vec::with_capacity(QUERIES), Vec::new());
        Self { surface, side, last: None, distances, places, farthest: Farthest::default() }
    }

    /// The point of the surface that is nearest to `p`; none to a point that is not finite.
    fn measure(&mut self, p: Vec3) -> Option<Nearest> {
        let found = match &self.last {
            Some(last) => self.surface.nearest_from(p, last),
            None => self.surface.nearest(p),
        };
        self.last = found.or(self.last);
        let Nearest { distance, point, .. } = found?;
        let points = if self.side == 0 { [p, point] } else { [point, p] };
        self.farthest.take(Farthest { distance, points });
        found
    }
}

impl<M: Deref<Target = TriMesh> + Sync> Task for DeviationTask<M> {
    /// `None` where one of the surfaces has no area.
    type Output = Option<Comparison>;

    /// The clock is read every fraction of a millisecond; the summary at the end takes up to 15 ns a sample in one
    /// piece.
    fn advance(&mut self, budget: Budget) -> Progress<Option<Comparison>> {
        while self.stage < STAGES.len() {
            self.step();
            if self.stage < STAGES.len() && budget.is_spent() {
                return Progress::Working(self.fraction());
            }
        }
        Progress::Done(self.result.take())
    }
}

impl<M: Deref<Target = TriMesh>> Side<M> {
    /// Adds the areas of triangles `from..to` and returns `to`.
    fn add_areas(&mut self, from: usize, to: usize) -> usize {
        if from == 0 {
            self.used = vec![false; self.mesh.positions.len()];
            self.areas.reserve_exact(self.mesh.triangles.len());
        }
        let mut total = self.areas.last().copied().unwrap_or(0.0);
        for t in from..to {
            let area = triangle_area(self.mesh.corners(t));
            if area.is_finite() {
                total += area;
                for v in self.mesh.triangles[t] {
                    self.used[v as usize] = true;
                }
            }
            self.areas.push(total);
        }
        to
    }

    /// Continues the index; whether it is there.
    fn add_index(&mut self, build: &mut IndexBuild) -> bool {
        if self.index.is_none() {
            match build.advance(&self.mesh.positions, &self.mesh.triangles, UNITS) {
                Poll::Ready(index) => self.index = Some(Arc::new(index)),
                Poll::Pending => return false,
            }
        }
        true
    }
}

/// A point of a surface.
struct Sample {
    point: Vec3,
    triangle: u32,
    /// Of the triangle's corners at the point.
    weights: [f32; 3],
}

/// `count` points spread evenly over a surface.
struct Sampler<'a, M> {
    side: &'a Side<M>,
    count: usize,
    stream: u64,
}

impl<M: Deref<Target = TriMesh>> Sampler<'_, M> {
    /// Points `from..to`.
    fn samples(&self, from: usize, to: usize) -> impl Iterator<Item = Sample> {
        let areas = &self.side.areas;
        let total = areas.last().copied().unwrap_or(0.0);
        let target = move |i: usize| (i as f64 + unit(self.stream, i, 0)) / self.count as f64 * total;
        let first = target(from);
        let mut t = areas.partition_point(|&area| area <= first);
        (from..to).map(move |i| {
            let target = target(i);
            while t + 1 < areas.len() && areas[t] <= target {
                t += 1;
            }
            let triangle = t.min(areas.len() - 1);
            let [a, b, c] = self.side.mesh.corners(triangle).map(Vec3::as_dvec3);
            // The square root makes the density even (Osada, Funkhouser, Chazelle and Dobkin 2002, section 3.2).
            let (root, along) = (unit(self.stream, i, 1).sqrt(), unit(self.stream, i, 2));
            let weights = [1.0 - root, root * (1.0 - along), root * along];
            let point = (a * weights[0] + b * weights[1] + c * weights[2]).as_vec3();
            Sample { point, triangle: triangle as u32, weights: weights.map(|weight| weight as f32) }
        })
    }
}

/// Coordinate `axis` of sample `i`, in 0..1: SplitMix64 at that position of the stream.
fn unit(stream: u64, i: usize, axis: u64) -> f64 {
    let counter = (stream << 48) + i as u64 * 4 + axis + 1;
    let mut z = counter.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// Summary of at least one distance; leaves them in another order.
fn summary(distances: &mut [f32], farthest: &Farthest) -> Deviation {
    let (mut sum, mut squares) = (0.0, 0.0);
    for &distance in &*distances {
        let distance = f64::from(distance);
        sum += distance;
        squares += distance * distance;
    }
    let count = distances.len() as f64;
    let rank = 0.95 * (count - 1.0);
    let (_, &mut at, above) = distances.select_nth_unstable_by(rank as usize, f32::total_cmp);
    let next = above.iter().copied().min_by(f32::total_cmp).unwrap_or(at);
    let (at, next) = (f64::from(at), f64::from(next));
    Deviation {
        mean: sum / count,
        rms: (squares / count).sqrt(),
        p95: at + (next - at) * rank.fract(),
        max: f64::from(farthest.distance.max(0.0)),
        max_at_mm: farthest.points.map(|p| p.to_array()),
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::mesh::shapes::{icosphere, sagitta, square};

    const SAMPLES: usize = 20_000;

    #[test]
    fn parallel_planes_are_their_distance_apart() {
        let found = deviation(&square(7, 8.0, 1.0), &square(16, 8.0, 3.5), SAMPLES).unwrap();
        assert_eq!([found.mean, found.rms, found.p95, found.max], [2.5; 4]);
        assert_eq!(found.max_at_mm.map(|[.., z]| z), [1.0, 3.5]);
    }

    #[test]
    fn a_surface_does_not_deviate_from_itself() {
        let sphere = icosphere(4, 20.0, Vec3::new(100.0, 50.0, -30.0));
        let found = deviation(&sphere, &sphere, SAMPLES).unwrap();
        // A sample is rounded to f32, by at most 4e-6 mm a coordinate here.
        assert!(found.max < 1e-5, "{found:?}");
    }

    #[test]
    fn concentric_spheres_are_the_difference_of_their_radii_apart() {
        let (small, large) = (icosphere(5, 10.0, Vec3::ONE), icosphere(4, 12.0, Vec3::ONE));
        let slack = f64::from(sagitta(&small, 10.0, Vec3::ONE).max(sagitta(&large, 12.0, Vec3::ONE)));
        let found = deviation(&small, &large, SAMPLES).unwrap();
        for value in [found.mean, found.rms, found.p95, found.max] {
            assert!((value - 2.0).abs() <= slack + 1e-5, "{found:?}, slack {slack}");
        }
        assert!(found.mean <= found.rms && found.rms <= found.p95 && found.p95 <= found.max);
    }

    #[test]
    fn a_sphere_that_was_moved_is_as_far_as_it_was_moved_at_most_and_half_of_it_on_average() {
        let (radius, shift) = (10.0, 0.1);
        let sphere = icosphere(5, radius, Vec3::ZERO);
        let moved = icosphere(5, radius, Vec3::X * shift);
        let found = deviation(&moved, &sphere, SAMPLES).unwrap();
        let slack = f64::from(sagitta(&sphere, radius, Vec3::ZERO));
        // The distance is |shift cos(angle)| to first order, and cos is spread evenly over a sphere.
        let shift = f64::from(shift);
        assert!((found.max - shift).abs() <= slack, "{found:?}");
        assert!((found.mean - shift / 2.0).abs() <= slack, "{found:?}");
        assert!((found.rms - shift / 3f64.sqrt()).abs() <= slack, "{found:?}");
        assert!((found.p95 - shift * 0.95).abs() <= slack, "{found:?}");
    }

    #[test]
    fn what_one_surface_lacks_counts_once_whichever_comes_first() {
        // Half of a square of 10 mm is missing: the whole is 0 to 5 mm from it there, it is nowhere from the whole. Over
        // the samples of both: mean 5/8, mean square 25/12, and one in twenty farther than 4 mm.
        let (whole, mut half) = (square(16, 10.0, 0.0), square(16, 10.0, 0.0));
        half.triangles.retain(|t| t.iter().all(|&v| whole.positions[v as usize].x <= 5.0));
        let expected = [5.0 / 8.0, (25.0f64 / 12.0).sqrt(), 4.0, 5.0];
        for (a, b) in [(&whole, &half), (&half, &whole)] {
            let found = deviation(a, b, SAMPLES).unwrap();
            for (value, expected) in [found.mean, found.rms, found.p95, found.max].into_iter().zip(expected) {
                assert!((value - expected).abs() < 0.01, "{found:?}");
            }
        }
    }

    #[test]
    fn a_tip_between_the_samples_counts_for_the_maximum_from_either_side() {
        let flat = square(10, 10.0, 0.0);
        let mut tipped = flat.clone();
        tipped.positions[60].z = 3.0;
        for (a, b) in [(&tipped, &flat), (&flat, &tipped)] {
            let found = DeviationTask::new(a, b, 10).finish().unwrap();
            assert_eq!(found.deviation.max, 3.0);
            let tip = tipped.positions[60].to_array();
            let foot = [tip[0], tip[1], 0.0];
            let expected = if std::ptr::eq(a, &tipped) { [tip, foot] } else { [foot, tip] };
            assert_eq!(found.deviation.max_at_mm, expected);
        }
    }

    #[test]
    fn the_map_is_the_mean_around_each_vertex_and_over_all_the_mean_that_is_reported() {
        // A floor below two storeys of one ceiling, with a ramp from the one to the other.
        let floor = square(20, 10.0, 0.0);
        let mut steps = floor.clone();
        steps.positions.iter_mut().for_each(|p| p.z = 0.5 + ((p.x - 3.0) * 0.375).clamp(0.0, 1.5));
        let found = DeviationTask::new(&floor, &steps, SAMPLES).with_map().finish().unwrap();
        for (p, &near) in steps.positions.iter().zip(&found.map) {
            let expected = if p.x < 2.0 { 0.5 } else { 2.0 };
            assert!((2.0..8.5).contains(&p.x) || (near - expected).abs() < 1e-4, "{p}: {near}");
        }
        let share = |t: &[u32; 3]| {
            let area = triangle_area(t.map(|v| steps.positions[v as usize]));
            let values: f64 = t.iter().map(|&v| f64::from(found.map[v as usize])).sum();
            [area, area * values / 3.0]
        };
        let [area, sum] = steps.triangles.iter().map(share).fold([0.0; 2], |a, b| [a[0] + b[0], a[1] + b[1]]);
        assert!((sum / area / found.deviation.mean - 1.0).abs() < 0.05, "{} of {:?}", sum / area, found.deviation);
    }

    #[test]
    fn a_map_of_few_samples_has_no_holes_and_none_is_made_unless_asked() {
        let (low, high) = (square(40, 10.0, 0.0), square(40, 10.0, 3.0));
        let found = DeviationTask::new(&low, &high, 5).with_map().finish().unwrap();
        assert!(found.map.iter().all(|&near| (near - 3.0).abs() < 1e-5), "{:?}", found.map);
        assert!(DeviationTask::new(&low, &high, 5).finish().unwrap().map.is_empty());
    }

    #[test]
    fn vertices_that_no_triangle_uses_do_not_count() {
        let flat = square(4, 4.0, 0.0);
        let mut littered = flat.clone();
        littered.positions.extend([Vec3::splat(50.0), Vec3::splat(f32::NAN)]);
        for (a, b) in [(&littered, &flat), (&flat, &littered)] {
            let found = DeviationTask::new(a, b, 100).with_map().finish().unwrap();
            assert_eq!((found.deviation.max, found.map), (0.0, vec![0.0; b.positions.len()]));
        }
    }

    #[test]
    fn a_surface_without_area_has_no_deviation() {
        let (flat, empty) = (square(2, 2.0, 0.0), TriMesh::default());
        let line = TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::X * 2.0], triangles: vec![[0, 1, 2]] };
        for (a, b) in [(&flat, &empty), (&empty, &flat), (&empty, &empty), (&line, &flat), (&flat, &line)] {
            assert_eq!(deviation(a, b, 10), None);
        }
    }

    #[test]
    fn slices_and_a_given_index_change_nothing() {
        let (a, b) = (Arc::new(icosphere(3, 10.0, Vec3::ZERO)), Arc::new(icosphere(4, 10.5, Vec3::X)));
        let whole = DeviationTask::new(a.clone(), b.clone(), 5000).with_map().finish().unwrap();
        let mut task = DeviationTask::new(a.clone(), b.clone(), 5000).with_map();
        let mut fraction = 0.0;
        let sliced = loop {
            match task.advance(Budget::new(Duration::ZERO)) {
                Progress::Working(now) => {
                    assert!((fraction..=1.0).contains(&now), "{fraction} then {now}");
                    fraction = now;
                }
                Progress::Done(result) => break result.unwrap(),
            }
        };
        let index = task.index_of_a().unwrap().clone();
        assert_eq!(sliced, whole);
        assert_eq!(DeviationTask::new(a, b, 5000).with_map().with_index_of_a(index).finish().unwrap(), whole);
    }

    #[test]
    fn the_number_of_threads_changes_nothing() {
        let (a, b) = (icosphere(4, 10.0, Vec3::ZERO), icosphere(3, 10.2, Vec3::new(0.3, 0.2, 0.1)));
        let all =
            |threads| parallel::with_threads(threads, || DeviationTask::new(&a, &b, 5000).with_map().finish().unwrap());
        let alone = all(1);
        assert_eq!([all(2), all(7)], [alone.clone(), alone]);
    }

    #[test]
    fn samples_are_spread_by_area() {
        // Triangles of very different size; each gets its share of the samples to within one at either end.
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(-9.0, 0.0, 0.0), Vec3::new(0.0, -90.0, 0.0)];
        let mesh = TriMesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]] };
        let mut side = Side { mesh: &mesh, index: None, areas: Vec::new(), used: Vec::new() };
        side.add_areas(0, 3);
        let sampler = Sampler { side: &side, count: 8200, stream: 1 };
        let points: Vec<Vec3> = sampler.samples(0, 8200).map(|sample| sample.point).collect();
        let large = points.iter().filter(|p| p.y < 0.0).count();
        let small = points.iter().filter(|p| p.x > 0.0).count();
        assert!((8099..=8101).contains(&large) && (9..=11).contains(&small), "{large}, {small}");
        let centroid = points.iter().filter(|p| p.y < 0.0).sum::<Vec3>() / large as f32;
        assert!(centroid.distance(Vec3::new(-3.0, -30.0, 0.0)) < 0.7, "{centroid}");
    }

    #[test]
    fn the_percentile_is_interpolated() {
        let mut distances: Vec<f32> = (0..=10).rev().map(|i| i as f32).collect();
        let farthest = Farthest { distance: 11.0, points: [Vec3::X, Vec3::Y] };
        let found = summary(&mut distances, &farthest);
        assert!((found.p95 - 9.5).abs() < 1e-12);
        assert_eq!((found.mean, found.rms, found.max), (5.0, 35f64.sqrt(), 11.0));
        let max_at_mm = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(found.max_at_mm, max_at_mm);
        let alone = summary(&mut [2.0], &Farthest { distance: 2.0, ..farthest });
        assert_eq!(alone, Deviation { mean: 2.0, rms: 2.0, p95: 2.0, max: 2.0, max_at_mm });
    }
}
