//! A patch over a hole: triangles over the rim's vertices and its own, whose edges can be turned and triangles divided.

use std::collections::HashMap;

use glam::DVec3;

/// A patch. The first vertices are those of the rim.
#[derive(Clone, Debug)]
pub(super) struct Patch {
    /// In mm.
    pub(super) points: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// How many of the points are the rim's.
    pub(super) rim: usize,
    /// The triangle that runs from one vertex to another. Looked up only: its order is no one's.
    sides: HashMap<(u32, u32), u32>,
}

impl Patch {
    /// A patch of these triangles over the rim alone.
    pub(super) fn new(points: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let mut patch = Self { rim: points.len(), points, triangles, sides: HashMap::new() };
        (0..patch.triangles.len()).for_each(|t| patch.note(t));
        patch
    }

    fn note(&mut self, t: usize) {
        let [a, b, c] = self.triangles[t];
        for side in [(a, b), (b, c), (c, a)] {
            self.sides.insert(side, t as u32);
        }
    }

    fn forget(&mut self, t: usize) {
        let [a, b, c] = self.triangles[t];
        for side in [(a, b), (b, c), (c, a)] {
            self.sides.remove(&side);
        }
    }

    /// The corner of the triangle that runs from `a` to `b` which is neither.
    fn across(&self, a: u32, b: u32) -> Option<u32> {
        let &t = self.sides.get(&(a, b))?;
        self.triangles[t as usize].into_iter().find(|&v| v != a && v != b)
    }

    /// The corners of a triangle.
    pub(super) fn corners(&self, t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| self.points[v as usize])
    }

    /// Divides a triangle at a new point, which is given its middle.
    pub(super) fn divide(&mut self, t: usize) {
        let [a, b, c] = self.triangles[t];
        let middle = self.corners(t).into_iter().sum::<DVec3>() / 3.0;
        let new = self.points.len() as u32;
        self.points.push(middle);
        self.forget(t);
        self.triangles[t] = [a, b, new];
        self.note(t);
        for triangle in [[b, c, new], [c, a, new]] {
            self.triangles.push(triangle);
            self.note(self.triangles.len() - 1);
        }
    }

    /// Turns an inner edge of a triangle where the two triangles on it are then more even (their opposite angles come to
    /// more than half a turn), unless there is such an edge already or `is_taken` says that there is one beyond the patch.
    pub(super) fn relax(&mut self, t: usize, is_taken: impl Fn(u32, u32) -> bool) -> bool {
        for side in 0..3 {
            let [a, b, c] = std::array::from_fn(|i| self.triangles[t][(side + i) % 3]);
            let Some(d) = self.across(b, a) else { continue };
            if d == c || !is_uneven([a, b, c, d].map(|v| self.points[v as usize])) {
                continue;
            }
            if self.sides.contains_key(&(c, d)) || self.sides.contains_key(&(d, c)) || is_taken(c, d) {
                continue;
            }
            let other = self.sides[&(b, a)] as usize;
            self.forget(t);
            self.forget(other);
            (self.triangles[t], self.triangles[other]) = ([a, d, c], [d, b, c]);
            self.note(t);
            self.note(other);
            return true;
        }
        false
    }

    /// For each vertex its neighbours in the patch, ascending.
    pub(super) fn neighbours(&self) -> Vec<Vec<u32>> {
        let mut around = vec![Vec::new(); self.points.len()];
        for &[a, b, c] in &self.triangles {
            for (v, w) in [(a, b), (b, c), (c, a)] {
                around[v as usize].push(w);
                around[w as usize].push(v);
            }
        }
        for ring in &mut around {
            ring.sort_unstable();
            ring.dedup();
        }
        around
    }

    /// The largest bend over an inner edge: one less the cosine of the angle between the normals.
    pub(super) fn sharpest(&self) -> f64 {
        let normal = |t: usize| {
            let [a, b, c] = self.corners(t);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let mut most: f64 = 0.0;
        for (t, &[a, b, c]) in self.triangles.iter().enumerate() {
            for (v, w) in [(a, b), (b, c), (c, a)] {
                if let Some(&other) = self.sides.get(&(w, v))
                    && (other as usize) > t
                {
                    most = most.max(1.0 - normal(t).dot(normal(other as usize)));
                }
            }
        }
        most
    }
}

/// Whether the edge from `a` to `b` of the triangles `a b c` and `b a d` is better turned: the angles at `c` and `d` come
/// to more than half a turn, and the four do not fold when it is.
fn is_uneven([a, b, c, d]: [DVec3; 4]) -> bool {
    let cotangent = |p: DVec3, q: DVec3| p.dot(q) / p.cross(q).length().max(f64::MIN_POSITIVE);
    let sum = cotangent(a - c, b - c) + cotangent(a - d, b - d);
    let (one, other) = ((d - a).cross(c - a), (b - d).cross(c - d));
    let before = (b - a).cross(c - a) + (a - b).cross(d - b);
    sum < -1e-9 && one.dot(other) > 0.0 && one.dot(before) > 0.0 && other.dot(before) > 0.0
}
