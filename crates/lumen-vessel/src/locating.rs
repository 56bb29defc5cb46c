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
    pub segment: u32,
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
    #[inline]
    fn power(&self, p: DVec3) -> Power {
        power(self.from, self.to, p)
    }
}

/// What a segment of a centreline is to a point.
#[derive(Clone, Copy, Debug)]
pub struct Power {
    /// `d^2 - r^2` of the ball at the place of the segment next to the point, in mm2: less where it holds the point deeper.
    pub power: f64,
    /// Where along the segment that place is, 0 to 1.
    pub part: f64,
    /// Squared distance of the point from it, in mm2.
    pub squared: f64,
    /// Radius of the ball, in mm.
    pub radius: f64,
}

/// The power of a point with regard to the balls along the segment between two places.
#[inline]
pub fn power(from: Place, to: Place, p: DVec3) -> Power {
    let along = to.at - from.at;
    let part = ((p - from.at).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    let squared = p.distance_squared(from.at + along * part);
    let radius = from.radius + (to.radius - from.radius) * part;
    Power { power: squared - radius * radius, part, squared, radius }
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
            best = (self.all[segment as usize].power(p).power, segment);
        }
        for chunk in &self.chunks {
            let gap = (chunk.low - p).max(p - chunk.high).max(DVec3::ZERO);
            if gap.length_squared() - chunk.squared_radius > best.0 {
                continue;
            }
            for number in chunk.first..chunk.first + chunk.count {
                let power = self.all[number as usize].power(p).power;
                if (power, number) < best {
                    best = (power, number);
                }
            }
        }
        let segment = self.all.get(best.1 as usize)?;
        let Power { part, squared, radius, .. } = segment.power(p);
        Some(Located {
            branch: segment.branch,
            arc_mm: segment.arc + part * segment.from.at.distance(segment.to.at),
            radius_mm: radius,
            distance_mm: squared.sqrt(),
            segment: best.1,
        })
    }
}
