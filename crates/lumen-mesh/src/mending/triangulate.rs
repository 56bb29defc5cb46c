//! The triangles over a loop of vertices that bend least, and of those the ones of least area.
//!
//! Liepa, "Filling holes in meshes" (2003), section 3, after Barequet and Sharir, "Filling gaps in the boundary of a
//! polyhedron" (1995): dynamic programming over the stretches of the loop. What is least is first the sharpest angle
//! between neighbours, those around the loop among them, then the sum of areas. O(n3) in the length of the loop.

use std::cmp::Ordering;

use glam::DVec3;

use crate::task::Yielder;

/// The longest loop that is triangulated.
pub const LONGEST: usize = 512;

/// How bad the triangles over a stretch are.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cost {
    /// One less the cosine of the largest angle between the normals of neighbours: 0 to 2.
    bend: f64,
    /// mm2.
    area: f64,
}

impl Cost {
    const NONE: Self = Self { bend: 0.0, area: 0.0 };
    const IMPOSSIBLE: Self = Self { bend: f64::INFINITY, area: f64::INFINITY };

    fn with(self, other: Self) -> Self {
        Self { bend: self.bend.max(other.bend), area: self.area + other.area }
    }

    fn is_less(self, other: Self) -> bool {
        // What differs by rounding alone is the same: then the area decides.
        let bend =
            if (self.bend - other.bend).abs() <= 1e-9 { Ordering::Equal } else { self.bend.total_cmp(&other.bend) };
        bend.then(self.area.total_cmp(&other.area)) == Ordering::Less
    }
}

/// The triangles over the loop through `points`, by their numbers, in the direction in which the triangles behind it run,
/// whose normals are `behind`; two points of `taken`, the lower first, are not joined. `None` where there are none.
pub(super) async fn triangulate(
    points: Vec<DVec3>,
    behind: Vec<DVec3>,
    mut taken: Vec<[u32; 2]>,
    yielder: &Yielder,
) -> Option<Vec<[u32; 3]>> {
    let count = points.len();
    taken.sort_unstable();
    let (costs, by_way_of) = (vec![Cost::NONE; count * count], vec![0; count * count]);
    let mut table = Table { points, behind, taken, costs, by_way_of };
    for span in 2..count {
        for i in 0..count - span {
            let k = i + span;
            (table.costs[i * count + k], table.by_way_of[i * count + k]) = table.best(i, k);
        }
        let part = span as f32 / count as f32;
        yielder.rest(part * part).await;
    }
    table.costs[count - 1].bend.is_finite().then(|| table.triangles())
}

/// The least that every stretch of the loop costs.
struct Table {
    points: Vec<DVec3>,
    /// The normal of the triangle behind each edge of the loop, from each vertex to the next.
    behind: Vec<DVec3>,
    /// Stretches that no edge may close, ascending: there is one already.
    taken: Vec<[u32; 2]>,
    /// For the stretch from `i` to `k`, how bad it is at best, and by way of which vertex.
    costs: Vec<Cost>,
    by_way_of: Vec<u16>,
}

impl Table {
    fn normal(&self, i: usize, m: usize, k: usize) -> (DVec3, f64) {
        // The patch runs along the loop the other way.
        let [a, b, c] = [k, m, i].map(|v| self.points[v]);
        let twice = (b - a).cross(c - a);
        (twice.normalize_or_zero(), twice.length() / 2.0)
    }

    /// The normal on the far side of the chord or edge from `i` to `k`.
    fn beyond(&self, i: usize, k: usize) -> DVec3 {
        if k == i + 1 {
            return self.behind[i];
        }
        self.normal(i, usize::from(self.by_way_of[i * self.points.len() + k]), k).0
    }

    fn best(&self, i: usize, k: usize) -> (Cost, u16) {
        let count = self.points.len();
        let is_whole = i == 0 && k == count - 1;
        let mut best = (Cost::IMPOSSIBLE, 0);
        if !is_whole && self.taken.binary_search(&[i as u32, k as u32]).is_ok() {
            return best;
        }
        for m in i + 1..k {
            let sides = self.costs[i * count + m].with(self.costs[m * count + k]);
            if !sides.bend.is_finite() || sides.bend > best.0.bend + 1e-9 {
                continue;
            }
            let (normal, area) = self.normal(i, m, k);
            let bend = |other: DVec3| if area > 0.0 { 1.0 - normal.dot(other) } else { 2.0 };
            let mut own = Cost { bend: bend(self.beyond(i, m)).max(bend(self.beyond(m, k))), area };
            if is_whole {
                own.bend = own.bend.max(bend(self.behind[count - 1]));
            }
            let cost = sides.with(own);
            if cost.is_less(best.0) {
                best = (cost, m as u16);
            }
        }
        best
    }

    /// The triangles that cost least, by the numbers of the points.
    fn triangles(&self) -> Vec<[u32; 3]> {
        let count = self.points.len();
        let mut triangles = Vec::with_capacity(count - 2);
        let mut stretches = vec![(0, count - 1)];
        while let Some((i, k)) = stretches.pop() {
            if k > i + 1 {
                let m = usize::from(self.by_way_of[i * count + k]);
                triangles.push([k as u32, m as u32, i as u32]);
                stretches.extend([(m, k), (i, m)]);
            }
        }
        triangles
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::task::at_once;

    fn of(points: &[[f64; 3]], taken: Vec<[u32; 2]>) -> Option<Vec<[u32; 3]>> {
        let points: Vec<DVec3> = points.iter().map(|&p| DVec3::from(p)).collect();
        let behind = vec![DVec3::NEG_Z; points.len()];
        at_once(triangulate(points, behind, taken, &Yielder::never()))
    }

    #[test]
    fn a_bent_square_is_cut_along_its_shorter_way_and_not_where_there_is_an_edge() {
        let corner = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.9, 0.9, 0.0], [0.0, 1.0, 0.0]];
        let uses = |triangles: &[[u32; 3]], a, b| triangles.iter().all(|t| t.contains(&a) && t.contains(&b));
        // Both are flat and of one area: either will do, and the one that is left must.
        assert!(uses(&of(&corner, vec![[0, 2]]).unwrap(), 1, 3));
        assert!(uses(&of(&corner, vec![[1, 3]]).unwrap(), 0, 2));
        assert_eq!(of(&corner, vec![[0, 2], [1, 3]]), None);
    }

    #[test]
    fn a_loop_that_is_not_convex_is_covered_once() {
        // A star with eight points: its area is that of the triangles only where none lies over another.
        let star: Vec<[f64; 3]> = (0..16)
            .map(|i| {
                let angle = std::f64::consts::TAU * f64::from(i) / 16.0;
                let radius = if i % 2 == 0 { 3.0 } else { 1.2 };
                [radius * libm::cos(angle), radius * libm::sin(angle), 0.0]
            })
            .collect();
        let triangles = of(&star, Vec::new()).unwrap();
        assert_eq!(triangles.len(), 14);
        let at = |v: u32| DVec3::from(star[v as usize]);
        let area = |&[a, b, c]: &[u32; 3]| (at(b) - at(a)).cross(at(c) - at(a)).z / 2.0;
        let whole = 8.0 * 3.0 * 1.2 * libm::sin(std::f64::consts::TAU / 16.0);
        assert!(triangles.iter().all(|t| area(t) < 0.0), "all face the same way, against the loop");
        assert!((triangles.iter().map(area).sum::<f64>() + whole).abs() < 1e-9);
    }
}
