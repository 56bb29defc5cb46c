//! Points spread evenly over a surface: sample `i` of `n` lies in the `i`-th of `n` equal parts of the area, in an order
//! of its triangles, and its place there comes from a hash of `i`.

use glam::Vec3;

use lumen_mesh::split_mix;
use lumen_mesh::task::{Yielder, blocks};
use lumen_mesh::{TriMesh, triangle_area};

/// Triangles between two looks at the clock.
const UNITS: usize = 8192;

/// One of the two surfaces that are compared.
#[derive(Debug)]
pub(super) struct Side<'a> {
    pub(super) mesh: &'a TriMesh,
    /// Triangles in the order in which samples go through them; `None` where that is their own.
    order: Option<Vec<u32>>,
    /// Area of those up to and with each of the order, in mm2.
    areas: Vec<f64>,
    /// Vertices that a triangle uses.
    pub(super) used: Vec<bool>,
}

impl<'a> Side<'a> {
    pub(super) async fn new(mesh: &'a TriMesh, order: Option<Vec<u32>>, yielder: &Yielder) -> Self {
        let count = order.as_ref().map_or(mesh.triangles.len(), Vec::len);
        let (mut areas, mut used) = (Vec::with_capacity(count), vec![false; mesh.positions.len()]);
        let mut total = 0.0;
        for block in blocks(count, UNITS) {
            let end = block.end;
            for at in block {
                let t = order.as_ref().map_or(at, |order| order[at] as usize);
                let area = triangle_area(mesh.corners(t));
                if area.is_finite() {
                    total += area;
                    for v in mesh.triangles[t] {
                        used[v as usize] = true;
                    }
                }
                areas.push(total);
            }
            yielder.rest(end as f32 / count as f32).await;
        }
        Self { mesh, order, areas, used }
    }

    /// Whether it has any area: without, there are no samples, and nothing is near to it.
    pub(super) fn has_area(&self) -> bool {
        self.areas.last().is_some_and(|&area| area > 0.0)
    }
}

/// A point of a surface.
pub(super) struct Sample {
    pub(super) point: Vec3,
    pub(super) triangle: u32,
    /// Of the triangle's corners at the point.
    pub(super) weights: [f32; 3],
}

/// `count` points spread evenly over a surface.
pub(super) struct Sampler<'a> {
    pub(super) side: &'a Side<'a>,
    pub(super) count: usize,
    pub(super) stream: u64,
}

impl Sampler<'_> {
    /// 1 where the way from the first surface to the second at a sample, whose nearest point on the other is `projection`, leads
    /// out of them, else -1.
    pub(super) fn sign(&self, sample: &Sample, projection: Vec3) -> f32 {
        let [a, b, c] = self.side.mesh.corners(sample.triangle as usize).map(Vec3::as_dvec3);
        let way = (projection.as_dvec3() - sample.point.as_dvec3()) * if self.stream == 0 { 1.0 } else { -1.0 };
        if (b - a).cross(c - a).dot(way) < 0.0 { -1.0 } else { 1.0 }
    }

    /// Points `from..to`.
    pub(super) fn samples(&self, from: usize, to: usize) -> impl Iterator<Item = Sample> {
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
            let at = t.min(areas.len() - 1);
            let triangle = self.side.order.as_ref().map_or(at, |order| order[at] as usize);
            let [a, b, c] = self.side.mesh.corners(triangle).map(Vec3::as_dvec3);
            // The square root makes the density even (Osada, Funkhouser, Chazelle and Dobkin 2002, section 3.2).
            let (root, along) = (unit(self.stream, i, 1).sqrt(), unit(self.stream, i, 2));
            let weights = [1.0 - root, root * (1.0 - along), root * along];
            let point = (a * weights[0] + b * weights[1] + c * weights[2]).as_vec3();
            Sample { point, triangle: triangle as u32, weights: weights.map(|weight| weight as f32) }
        })
    }
}

/// Coordinate `axis` of sample `i`, in 0..1.
fn unit(stream: u64, i: usize, axis: u64) -> f64 {
    split_mix::unit_at((stream << 48) + i as u64 * 4 + axis + 1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::task::at_once;

    #[test]
    fn samples_are_spread_by_area() {
        // Triangles of very different size; each gets its share of the samples to within one at either end.
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(-9.0, 0.0, 0.0), Vec3::new(0.0, -90.0, 0.0)];
        let mesh = TriMesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]] };
        let side = at_once(Side::new(&mesh, Some(vec![2, 0, 1]), &Yielder::never()));
        let sampler = Sampler { side: &side, count: 8200, stream: 1 };
        let points: Vec<Vec3> = sampler.samples(0, 8200).map(|sample| sample.point).collect();
        let large = points.iter().filter(|p| p.y < 0.0).count();
        let small = points.iter().filter(|p| p.x > 0.0).count();
        assert!((8099..=8101).contains(&large) && (9..=11).contains(&small), "{large}, {small}");
        let centroid = points.iter().filter(|p| p.y < 0.0).sum::<Vec3>() / large as f32;
        assert!(centroid.distance(Vec3::new(-3.0, -30.0, 0.0)) < 0.7, "{centroid}");
    }
}
