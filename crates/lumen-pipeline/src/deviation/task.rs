//! The comparison in slices: which surface is measured to which, in which order, and what is kept of it.

use std::ops::Deref;
use std::sync::Arc;

use glam::Vec3;

use super::map::DistanceMap;
use super::sampling::{Sampler, Side, UNITS};
use super::summary::{Deviation, Farthest, summary};
use crate::histogram::Histogram;
use lumen_mesh::parallel;
use lumen_mesh::task::{Budget, Progress, Task};
use lumen_mesh::{IndexBuild, Nearest, SurfaceIndex, TriMesh};

/// Queries of a core between two looks at the clock.
const QUERIES: usize = 256;

/// What a [`DeviationTask`] finds.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The summary.
    pub deviation: Deviation,
    /// For each vertex of the second surface, the mean distance of the samples around it, in mm; 0 for a vertex no
    /// triangle uses. Empty unless a map was asked for.
    pub map: Vec<f32>,
    /// The same of signed distances: positive where the second surface lies outside the first.
    pub signed_map: Vec<f32>,
    /// How the samples are spread; empty unless a map was asked for.
    pub histogram: Histogram,
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
    /// Over the second surface, where it was asked for.
    map: Option<DistanceMap>,
    result: Option<Comparison>,
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
            map: None,
            result: None,
        }
    }

    /// Makes a map of the distances over `b` as well.
    #[must_use]
    pub fn with_map(mut self) -> Self {
        self.map = Some(DistanceMap::new());
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
            Stage::Map if self.map.is_some() => self.sides[1].mesh.triangles.len(),
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
            Stage::Map => self.map.as_mut().is_none_or(|map| map.spread(&self.sides[1].mesh.triangles)),
            Stage::Summary => {
                let most = f64::from(self.farthest.distance.max(0.0));
                let histogram =
                    if self.map.is_some() { Histogram::new(&self.distances, most) } else { Histogram::default() };
                self.distances.iter_mut().for_each(|distance| *distance = distance.abs());
                let deviation = summary(&mut self.distances, &self.farthest);
                let [map, signed_map] = self.map.take().map(|map| map.means()).unwrap_or_default();
                self.result = Some(Comparison { deviation, map, signed_map, histogram });
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
        let (first, wants_map) = (self.next, self.map.is_some());
        let pieces = parallel::map_ranges(end - first, QUERIES, |piece| {
            let mut queries = Queries::new(other, side);
            for sample in sampler.samples(first + piece.start, first + piece.end) {
                let found = queries.measure(sample.point);
                let distance = found.map_or(0.0, |found| found.distance);
                let sign = if wants_map { found.map_or(1.0, |found| sampler.sign(&sample, found.point)) } else { 1.0 };
                queries.distances.push(distance.copysign(sign));
                if wants_map {
                    let foot = found.map(|found| (found.triangle, found.barycentric));
                    queries.places.push(if side == 0 { foot } else { Some((sample.triangle, sample.weights)) });
                }
            }
            queries
        });
        if let Some(map) = &mut self.map {
            map.reserve(self.sides[1].mesh.positions.len());
        }
        for Queries { distances, places, farthest, .. } in pieces {
            self.farthest.take(farthest);
            if let Some(map) = &mut self.map {
                for (place, &distance) in places.into_iter().zip(&distances) {
                    if let Some((triangle, weights)) = place {
                        map.add(self.sides[1].mesh.triangles[triangle as usize], weights, distance);
                    }
                }
            }
            self.distances.extend(distances);
        }
    }
}

/// Queries of one piece of work.
struct Queries<'a> {
    surface: &'a SurfaceIndex,
    /// The surface that the queries are points of.
    side: usize,
    last: Option<Nearest>,
    /// With the sign of the side on which the second surface lies, where a map is made.
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
