//! The comparison: which surface is measured to which, in which order, and what is kept of it.

use std::sync::Arc;

use glam::Vec3;

use super::map::DistanceMap;
use super::sampling::{Sampler, Side};
use super::summary::{Deviation, Farthest, summary};
use crate::histogram::Histogram;
use lumen_mesh::parallel;
use lumen_mesh::task::{Yielder, blocks};
use lumen_mesh::{Nearest, SurfaceIndex, TriMesh};

/// Queries of a core between two looks at the clock.
const QUERIES: usize = 256;

/// What [`compare`] finds.
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

/// How two surfaces are compared.
#[derive(Clone, Debug, Default)]
pub struct Comparing {
    /// Of each surface, at least one.
    pub samples: usize,
    /// Whether a map of the distances over the second surface is made as well.
    pub with_map: bool,
    /// Indices of either that are there already.
    pub indices: [Option<Arc<SurfaceIndex>>; 2],
}

/// What came of comparing two surfaces.
#[derive(Clone, Debug)]
pub struct Compared {
    /// `None` where one of the surfaces has no area.
    pub comparison: Option<Comparison>,
    /// The indices of both, as far as they were built or given.
    pub indices: [Option<Arc<SurfaceIndex>>; 2],
}

/// Compares `a` with `b`. Rests every fraction of a millisecond; the summary at the end takes up to 15 ns a sample in one
/// piece.
pub async fn compare(a: &TriMesh, b: &TriMesh, how: Comparing, yielder: &Yielder) -> Compared {
    let Comparing { samples, with_map, indices: [index_of_a, index_of_b] } = how;
    let samples = samples.max(1);
    let [of_b, areas_a, areas_b, vertices_a, samples_a, of_a, samples_b, vertices_b, map] =
        parts(a, b, samples, [index_of_a.is_some(), index_of_b.is_some()]).map(|part| yielder.part(part));
    let index_of_b = SurfaceIndex::known_or_built(index_of_b, b, &of_b).await;
    let a = Side::new(a, None, &areas_a).await;
    // A level's triangles stand in the order in which they go: the tree has those together that lie together.
    let b = Side::new(b, Some(index_of_b.triangles().collect()), &areas_b).await;
    if !(a.has_area() && b.has_area()) {
        return Compared { comparison: None, indices: [index_of_a, Some(index_of_b)] };
    }
    let mut measured = Measured { samples, map: with_map.then(DistanceMap::new), ..Measured::default() };
    // Vertices count where they are farther than all before.
    measured.vertices([&a, &b], 0, &index_of_b, &vertices_a).await;
    measured.samples([&a, &b], 0, &index_of_b, &samples_a).await;
    let index_of_a = SurfaceIndex::known_or_built(index_of_a, a.mesh, &of_a).await;
    measured.samples([&a, &b], 1, &index_of_a, &samples_b).await;
    measured.vertices([&a, &b], 1, &index_of_a, &vertices_b).await;
    if let Some(spreading) = &mut measured.map {
        while !spreading.spread(&b.mesh.triangles) {
            map.rest(0.0).await;
        }
    }
    map.rest(1.0).await;
    Compared { comparison: Some(measured.summed_up()), indices: [Some(index_of_a), Some(index_of_b)] }
}

/// The parts of the work that each step of [`compare`] is, by rule of thumb in nanoseconds.
fn parts(a: &TriMesh, b: &TriMesh, samples: usize, [has_a, has_b]: [bool; 2]) -> [std::ops::Range<f32>; 9] {
    let [triangles_a, triangles_b] = [a, b].map(|mesh| mesh.triangles.len());
    let [vertices_a, vertices_b] = [a, b].map(|mesh| mesh.positions.len());
    let costs = [
        if has_b { 0 } else { 250 * triangles_b },
        10 * triangles_a,
        10 * triangles_b,
        200 * vertices_a,
        700 * samples,
        if has_a { 0 } else { 250 * triangles_a },
        700 * samples,
        200 * vertices_b,
        20 * (triangles_b + samples),
    ];
    let all = costs.iter().sum::<usize>().max(1) as f32;
    let mut done = 0;
    costs.map(|cost| {
        let begun = done;
        done += cost;
        begun as f32 / all..done as f32 / all
    })
}

/// What was measured so far.
#[derive(Default)]
struct Measured {
    /// Of each surface.
    samples: usize,
    distances: Vec<f32>,
    farthest: Farthest,
    /// Over the second surface, where it was asked for.
    map: Option<DistanceMap>,
}

impl Measured {
    /// Measures the vertices of one side to the other, of which `other` is the index.
    async fn vertices(&mut self, sides: [&Side<'_>; 2], side: usize, other: &SurfaceIndex, yielder: &Yielder) {
        let Side { mesh, used, .. } = sides[side];
        let count = mesh.positions.len();
        for block in blocks(count, QUERIES * parallel::threads()) {
            let (first, end, sofar) = (block.start, block.end, self.farthest.distance);
            let pieces = parallel::map_ranges(block.len(), QUERIES, |piece| {
                let (mut queries, mut last) = (Queries::new(other, side), u32::MAX);
                let piece = first + piece.start..first + piece.end;
                for (&p, &used) in mesh.positions[piece.clone()].iter().zip(&used[piece]) {
                    if used && !other.is_within_from(p, sofar, &mut last) {
                        queries.measure(p);
                    }
                }
                queries
            });
            pieces.into_iter().for_each(|queries| self.farthest.take(queries.farthest));
            yielder.rest(end as f32 / count as f32).await;
        }
    }

    /// Measures the samples of one side to the other, of which `other` is the index.
    async fn samples(&mut self, sides: [&Side<'_>; 2], side: usize, other: &SurfaceIndex, yielder: &Yielder) {
        let second = sides[1].mesh;
        let sampler = Sampler { side: sides[side], count: self.samples, stream: side as u64 };
        let wants_map = self.map.is_some();
        if let Some(map) = &mut self.map {
            map.reserve(second.positions.len());
        }
        for block in blocks(self.samples, QUERIES * parallel::threads()) {
            let (first, end) = (block.start, block.end);
            let pieces = parallel::map_ranges(block.len(), QUERIES, |piece| {
                let mut queries = Queries::new(other, side);
                for sample in sampler.samples(first + piece.start, first + piece.end) {
                    let found = queries.measure(sample.point);
                    let distance = found.map_or(0.0, |found| found.distance);
                    let sign =
                        if wants_map { found.map_or(1.0, |found| sampler.sign(&sample, found.point)) } else { 1.0 };
                    queries.distances.push(distance.copysign(sign));
                    if wants_map {
                        let projection = found.map(|found| (found.triangle, found.barycentric));
                        queries.places.push(if side == 0 {
                            projection
                        } else {
                            Some((sample.triangle, sample.weights))
                        });
                    }
                }
                queries
            });
            for Queries { distances, places, farthest, .. } in pieces {
                self.farthest.take(farthest);
                if let Some(map) = &mut self.map {
                    for (place, &distance) in places.into_iter().zip(&distances) {
                        if let Some((triangle, weights)) = place {
                            map.add(second.triangles[triangle as usize], weights, distance);
                        }
                    }
                }
                self.distances.extend(distances);
            }
            yielder.rest(end as f32 / self.samples as f32).await;
        }
    }

    fn summed_up(mut self) -> Comparison {
        let most = f64::from(self.farthest.distance.max(0.0));
        let histogram = if self.map.is_some() { Histogram::new(&self.distances, most) } else { Histogram::default() };
        self.distances.iter_mut().for_each(|distance| *distance = distance.abs());
        let deviation = summary(&mut self.distances, &self.farthest);
        let [map, signed_map] = self.map.take().map(|map| map.means()).unwrap_or_default();
        Comparison { deviation, map, signed_map, histogram }
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
