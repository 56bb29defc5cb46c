//! Where a point is in a tree: the segment of a centreline whose balls hold it deepest, or are nearest to it.

use glam::DVec3;

use super::centreline::Place;

/// Segments of a branch that are left out together in a search.
const CHUNK: usize = 8;

/// Where a point is in the tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Located {
    /// The branch.
    pub branch: u32,
    /// Arc length along its centreline of the place next to the point, in mm.
    pub arc_mm: f64,
    /// Radius of the lumen there, in mm.
    pub radius_mm: f64,
    /// Distance of the point from that place, in mm.
    pub distance_mm: f64,
    /// The segment of the centreline, for a faster search near by.
    pub(crate) segment: u32,
}

/// A segment of a centreline, with the radii at its ends.
#[derive(Clone, Copy, Debug)]
struct Segment {
    from: Place,
    to: Place,
    branch: u32,
    arc: f64,
}

impl Segment {
    /// The power of a point with regard to the balls along the segment, least where a ball holds it deepest; where along
    /// the segment, 0 to 1; the squared distance.
    #[inline]
    fn power(&self, p: DVec3) -> (f64, f64, f64) {
        let along = self.to.at - self.from.at;
        let part = ((p - self.from.at).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let squared = p.distance_squared(self.from.at + along * part);
        let radius = self.from.radius + (self.to.radius - self.from.radius) * part;
        (squared - radius * radius, part, squared)
    }
}

/// The box around a few segments, and the largest radius there.
#[derive(Clone, Copy, Debug)]
struct Chunk {
    low: DVec3,
    high: DVec3,
    squared_radius: f64,
    first: u32,
    count: u32,
}

/// The segments of a tree's centrelines.
#[derive(Clone, Debug, Default)]
pub(super) struct Segments {
    all: Vec<Segment>,
    chunks: Vec<Chunk>,
}

impl Segments {
    /// Adds those of a branch between these points, which lie at these arc lengths.
    pub(super) fn add(&mut self, branch: u32, points: &[Place], arcs: &[f64]) {
        let bottom = self.all.len();
        for (ends, &arc) in points.windows(2).zip(arcs) {
            self.all.push(Segment { from: ends[0], to: ends[1], branch, arc });
        }
        for (i, piece) in self.all[bottom..].chunks(CHUNK).enumerate() {
            let ends = || piece.iter().flat_map(|segment| [segment.from, segment.to]);
            let low = ends().map(|place| place.at).fold(DVec3::INFINITY, DVec3::min);
            let high = ends().map(|place| place.at).fold(DVec3::NEG_INFINITY, DVec3::max);
            let radius = ends().map(|place| place.radius).fold(0.0, f64::max);
            let first = (bottom + i * CHUNK) as u32;
            let count = piece.len() as u32;
            self.chunks.push(Chunk { low, high, squared_radius: radius * radius, first, count });
        }
    }

    /// Where `p` is: the branch whose lumen holds it deepest, or is nearest to it. `last` is the answer for a point near
    /// by, if there is one; it makes this faster and changes nothing.
    pub(super) fn locate(&self, p: DVec3, last: Option<&Located>) -> Option<Located> {
        let mut best = (f64::INFINITY, u32::MAX);
        if let Some(segment) = last.and_then(|last| self.all.get(last.segment as usize).map(|_| last.segment)) {
            best = (self.all[segment as usize].power(p).0, segment);
        }
        for chunk in &self.chunks {
            let gap = (chunk.low - p).max(p - chunk.high).max(DVec3::ZERO);
            if gap.length_squared() - chunk.squared_radius > best.0 {
                continue;
            }
            for number in chunk.first..chunk.first + chunk.count {
                let power = self.all[number as usize].power(p).0;
                if (power, number) < best {
                    best = (power, number);
                }
            }
        }
        let segment = self.all.get(best.1 as usize)?;
        let (_, part, squared) = segment.power(p);
        Some(Located {
            branch: segment.branch,
            arc_mm: segment.arc + part * segment.from.at.distance(segment.to.at),
            radius_mm: segment.from.radius + (segment.to.radius - segment.from.radius) * part,
            distance_mm: squared.sqrt(),
            segment: best.1,
        })
    }
}
