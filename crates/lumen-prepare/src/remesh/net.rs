//! The surface while it changes: triangles with their neighbours, so that an edge is split, collapsed or flipped in the
//! time that its surroundings take.
//!
//! Half-edge `3 t + i` runs from corner `i` of triangle `t` to the next one. Its twin runs the other way in the
//! triangle beside; an edge of a rim has none. A vertex knows one half-edge that leaves it, at a rim the one that runs
//! along the rim, so that turning left from it visits every triangle around.

use glam::Vec3;

/// No half-edge, no curve.
pub(super) const NONE: u32 = u32::MAX;
/// A vertex of no feature curve, in [`Net::kind`].
pub(super) const FREE: u32 = u32::MAX;
/// A vertex that stays, in [`Net::kind`].
pub(super) const CORNER: u32 = u32::MAX - 1;

/// A surface in half-edges.
#[derive(Clone, Debug, Default)]
pub(super) struct Net {
    /// Positions in mm.
    pub(super) at: Vec<Vec3>,
    /// Wanted length of the edges at a vertex, in mm.
    pub(super) size: Vec<f32>,
    /// [`FREE`], [`CORNER`], or the number of the feature curve that the vertex is on.
    pub(super) kind: Vec<u32>,
    /// Where a vertex lies on the surface that entered.
    pub(super) foot: Vec<Foot>,
    /// A triangle of the surface that entered, near a vertex.
    pub(super) near: Vec<u32>,
    /// Whether a vertex may have left the surface that entered.
    pub(super) is_adrift: Vec<bool>,
    /// The vertex of the surface that entered which a vertex was; only the first ones were one.
    pub(super) first: Vec<u32>,
    /// A half-edge that leaves the vertex; [`NONE`] where the vertex is gone.
    pub(super) out: Vec<u32>,
    /// Where a half-edge begins; [`NONE`] where its triangle is gone.
    pub(super) origin: Vec<u32>,
    /// The half-edge the other way; [`NONE`] at a rim.
    pub(super) twin: Vec<u32>,
    /// The feature curve of an edge; [`NONE`] for other edges.
    pub(super) curve: Vec<u32>,
    /// The patch of a triangle.
    pub(super) patch: Vec<u32>,
    /// Whether something around a vertex has changed since it came to rest.
    pub(super) is_awake: Vec<bool>,
    /// When a vertex moved or got other neighbours last, by [`Self::clock`].
    touched: Vec<u32>,
    /// Steps that there were.
    pub(super) clock: u32,
    /// Triangles that are gone.
    spare: Vec<u32>,
}

/// Where a vertex lies on the surface that entered.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Foot {
    /// The triangle, or the feature segment if it is on a curve; [`NONE`] where it is a vertex of them.
    pub(super) on: u32,
    /// Weights of its corners, or of the two ends.
    pub(super) weights: [f32; 3],
}

impl Foot {
    const VERTEX: Self = Self { on: NONE, weights: [0.0; 3] };
}

/// The half-edge after `h` in its triangle.
#[inline]
pub(super) fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The half-edge before `h` in its triangle.
#[inline]
pub(super) fn prev(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

/// Why half-edges cannot be made of triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Unsound {
    /// Edges of more than two triangles.
    pub(super) non_manifold: usize,
    /// Edges of two triangles whose windings disagree.
    pub(super) flipped: usize,
}

impl Net {
    /// The half-edges of `triangles`, whose indices are in range and differ within a triangle. A vertex whose triangles
    /// are several fans becomes one vertex a fan, each a corner.
    pub(super) fn new(positions: &[Vec3], triangles: &[[u32; 3]], patch: Vec<u32>) -> Result<Self, Unsound> {
        let origin: Vec<u32> = triangles.as_flattened().to_vec();
        let mut net = Self {
            at: positions.to_vec(),
            kind: vec![FREE; positions.len()],
            foot: vec![Foot::VERTEX; positions.len()],
            near: vec![0; positions.len()],
            is_adrift: vec![false; positions.len()],
            first: (0..positions.len() as u32).collect(),
            out: vec![NONE; positions.len()],
            twin: vec![NONE; origin.len()],
            curve: vec![NONE; origin.len()],
            size: Vec::new(),
            origin,
            patch,
            is_awake: vec![true; positions.len()],
            touched: vec![0; positions.len()],
            clock: 0,
            spare: Vec::new(),
        };
        net.find_twins()?;
        net.part_fans();
        net.near = net.out.iter().map(|&h| if h == NONE { 0 } else { h / 3 }).collect();
        Ok(net)
    }

    fn find_twins(&mut self) -> Result<(), Unsound> {
        let ends = |h: u32| {
            let (a, b) = (self.origin[h as usize], self.origin[next(h) as usize]);
            (a.min(b), a.max(b))
        };
        // Half-edges by the lower one of their ends.
        let mut first = vec![0u32; self.at.len() + 1];
        (0..self.half_edges()).for_each(|h| first[ends(h).0 as usize + 1] += 1);
        (1..first.len()).for_each(|v| first[v] += first[v - 1]);
        let mut place = first.clone();
        let mut edges = vec![(0u32, 0u32); self.origin.len()];
        for h in 0..self.half_edges() {
            let (low, high) = ends(h);
            edges[place[low as usize] as usize] = (high, h);
            place[low as usize] += 1;
        }
        let mut unsound = Unsound { non_manifold: 0, flipped: 0 };
        for range in first.windows(2) {
            let edges = &mut edges[range[0] as usize..range[1] as usize];
            edges.sort_unstable();
            for uses in edges.chunk_by(|a, b| a.0 == b.0) {
                match *uses {
                    [_] => {}
                    [(_, h), (_, g)] if self.origin[h as usize] != self.origin[g as usize] => {
                        self.twin[h as usize] = g;
                        self.twin[g as usize] = h;
                    }
                    [_, _] => unsound.flipped += 1,
                    _ => unsound.non_manifold += 1,
                }
            }
        }
        if unsound == (Unsound { non_manifold: 0, flipped: 0 }) { Ok(()) } else { Err(unsound) }
    }

    fn part_fans(&mut self) {
        let mut was_seen = vec![false; self.origin.len()];
        let mut fan = Vec::new();
        for h in 0..self.origin.len() as u32 {
            if was_seen[h as usize] {
                continue;
            }
            let mut v = self.origin[h as usize];
            let is_another = self.out[v as usize] != NONE;
            if is_another {
                self.kind[v as usize] = CORNER;
                let copy = self.at.len() as u32;
                self.at.push(self.at[v as usize]);
                self.kind.push(CORNER);
                self.foot.push(Foot::VERTEX);
                self.is_adrift.push(false);
                self.is_awake.push(true);
                self.touched.push(0);
                self.first.push(v);
                self.out.push(NONE);
                v = copy;
            }
            self.anchor(v, h);
            fan.clear();
            fan.extend(self.around(v));
            for &h in &fan {
                was_seen[h as usize] = true;
                self.origin[h as usize] = v;
            }
        }
    }

    /// Half-edges there are or were.
    pub(super) fn half_edges(&self) -> u32 {
        self.origin.len() as u32
    }

    /// Triangles there are.
    pub(super) fn triangle_count(&self) -> usize {
        self.patch.len() - self.spare.len()
    }

    /// Whether a vertex is there.
    #[inline]
    pub(super) fn is_there(&self, v: u32) -> bool {
        self.out[v as usize] != NONE
    }

    /// Whether a half-edge, or the triangle that it is in, is there.
    #[inline]
    pub(super) fn is_live(&self, h: u32) -> bool {
        self.origin[h as usize] != NONE
    }

    #[inline]
    pub(super) fn origin(&self, h: u32) -> u32 {
        self.origin[h as usize]
    }

    #[inline]
    pub(super) fn end(&self, h: u32) -> u32 {
        self.origin[next(h) as usize]
    }

    #[inline]
    pub(super) fn twin(&self, h: u32) -> u32 {
        self.twin[h as usize]
    }

    /// The corner of its triangle that a half-edge does not touch.
    #[inline]
    pub(super) fn apex(&self, h: u32) -> u32 {
        self.origin[prev(h) as usize]
    }

    /// Whether `h` stands for its edge: of two half-edges the first one does.
    #[inline]
    pub(super) fn is_edge(&self, h: u32) -> bool {
        self.is_live(h) && h < self.twin[h as usize]
    }

    /// Of two half-edges the one that stands for their edge.
    #[inline]
    pub(super) fn edge(&self, h: u32) -> u32 {
        h.min(self.twin[h as usize])
    }

    #[inline]
    pub(super) fn is_feature(&self, h: u32) -> bool {
        self.curve[h as usize] != NONE
    }

    #[inline]
    pub(super) fn is_rim(&self, v: u32) -> bool {
        self.twin[self.out[v as usize] as usize] == NONE
    }

    /// Corners of a triangle in mm.
    #[inline]
    pub(super) fn corners(&self, t: u32) -> [Vec3; 3] {
        [0, 1, 2].map(|i| self.at[self.origin[(3 * t + i) as usize] as usize])
    }

    /// The half-edges that leave `v`, counter-clockwise.
    #[inline]
    pub(super) fn around(&self, v: u32) -> Around<'_> {
        let first = self.out[v as usize];
        Around { net: self, first, at: first }
    }

    /// The neighbours of `v` with the half-edge between, counter-clockwise; that half-edge leaves `v`, but for the last
    /// one at a rim.
    #[inline]
    pub(super) fn neighbours(&self, v: u32) -> Neighbours<'_> {
        let first = self.out[v as usize];
        Neighbours { net: self, first, at: first, last: NONE }
    }

    pub(super) fn valence(&self, v: u32) -> usize {
        self.neighbours(v).count()
    }

    /// The two neighbours of `v` along its feature curve.
    pub(super) fn along_curve(&self, v: u32) -> Option<[u32; 2]> {
        let mut along = self.neighbours(v).filter(|&(_, h)| self.is_feature(h)).map(|(n, _)| n);
        Some([along.next()?, along.next()?])
    }

    pub(super) fn are_neighbours(&self, v: u32, w: u32) -> bool {
        self.neighbours(v).any(|(n, _)| n == w)
    }

    /// Length of an edge over its wanted length, squared.
    #[inline]
    pub(super) fn stretch(&self, h: u32) -> f32 {
        self.stretch_between(self.origin(h), self.end(h))
    }

    /// As [`Self::stretch`], of two vertices that an edge would join.
    #[inline]
    pub(super) fn stretch_between(&self, a: u32, b: u32) -> f32 {
        let (a, b) = (a as usize, b as usize);
        let wanted = f32::midpoint(self.size[a], self.size[b]);
        self.at[a].distance_squared(self.at[b]) / (wanted * wanted)
    }

    /// Notes for `v` the half-edge to begin with, from any `h` that leaves it.
    fn anchor(&mut self, v: u32, h: u32) {
        let mut first = h;
        loop {
            let beside = self.twin[first as usize];
            if beside == NONE {
                break;
            }
            let right = next(beside);
            if right == h {
                break;
            }
            first = right;
        }
        self.out[v as usize] = first;
    }

    fn new_triangle(&mut self, patch: u32) -> u32 {
        if let Some(t) = self.spare.pop() {
            self.patch[t as usize] = patch;
            return t;
        }
        self.patch.push(patch);
        let length = self.origin.len() + 3;
        self.origin.resize(length, NONE);
        self.twin.resize(length, NONE);
        self.curve.resize(length, NONE);
        self.patch.len() as u32 - 1
    }

    fn set(&mut self, h: u32, origin: u32, twin: u32, curve: u32) {
        self.origin[h as usize] = origin;
        self.curve[h as usize] = curve;
        self.join(h, twin);
    }

    fn join(&mut self, h: u32, twin: u32) {
        if h != NONE {
            self.twin[h as usize] = twin;
        }
        if twin != NONE {
            self.twin[twin as usize] = h;
        }
    }

    /// Puts a vertex on an edge and returns it. It takes the mean of the ends' places and sizes.
    pub(super) fn split(&mut self, h: u32) -> u32 {
        let (v, w, a, g) = (self.origin(h), self.end(h), self.apex(h), self.twin(h));
        let curve = self.curve[h as usize];
        let m = self.at.len() as u32;
        self.at.push(self.at[v as usize].midpoint(self.at[w as usize]));
        self.size.push(f32::midpoint(self.size[v as usize], self.size[w as usize]));
        self.kind.push(curve);
        self.foot.push(Foot::VERTEX);
        let near = if self.kind[v as usize] == FREE { v } else { w };
        self.near.push(self.near[near as usize]);
        self.is_adrift.push(true);
        self.is_awake.push(true);
        self.touched.push(self.clock);
        self.first.push(NONE);
        self.out.push(NONE);
        let first = 3 * self.new_triangle(self.patch[(h / 3) as usize]);
        let beyond = next(h);
        let (beyond_twin, beyond_curve) = (self.twin(beyond), self.curve[beyond as usize]);
        self.set(first, m, NONE, curve);
        self.set(first + 1, w, beyond_twin, beyond_curve);
        self.set(first + 2, a, beyond, NONE);
        self.origin[beyond as usize] = m;
        self.curve[beyond as usize] = NONE;
        if g != NONE {
            let b = self.apex(g);
            let second = 3 * self.new_triangle(self.patch[(g / 3) as usize]);
            let before = prev(g);
            let (before_twin, before_curve) = (self.twin(before), self.curve[before as usize]);
            self.set(second, w, first, curve);
            self.set(second + 1, m, before, NONE);
            self.set(second + 2, b, before_twin, before_curve);
            self.curve[before as usize] = NONE;
            self.origin[g as usize] = m;
            self.anchor(b, second + 2);
        }
        self.anchor(w, first + 1);
        self.anchor(m, first);
        self.touch_ring(m);
        m
    }

    /// Joins the apexes of the two triangles at `h` in place of its ends. The edge is no feature, and the apexes are no
    /// neighbours.
    pub(super) fn flip(&mut self, h: u32) {
        let g = self.twin(h);
        let (v, w, a, b) = (self.origin(h), self.end(h), self.apex(h), self.apex(g));
        let (hn, hp, gn, gp) = (next(h), prev(h), next(g), prev(g));
        let old = [hn, hp, gn, gp].map(|e| (self.twin(e), self.curve[e as usize]));
        self.origin[h as usize] = b;
        self.origin[g as usize] = a;
        self.set(hn, a, old[1].0, old[1].1);
        self.set(hp, v, old[2].0, old[2].1);
        self.set(gn, b, old[3].0, old[3].1);
        self.set(gp, w, old[0].0, old[0].1);
        self.anchor(a, hn);
        self.anchor(v, hp);
        self.anchor(b, gn);
        self.anchor(w, gp);
        [v, w, a, b].into_iter().for_each(|v| self.touch(v));
    }

    /// Whether the edge of `h` can shrink to its end with the surface still the same but for its shape: the link
    /// condition (Dey, Edelsbrunner, Guha and Nekhayev, "Topology preserving edge contraction", 1999), and feature
    /// curves stay as they are.
    pub(super) fn can_collapse(&self, h: u32) -> bool {
        let (v, w, g) = (self.origin(h), self.end(h), self.twin(h));
        let kind = self.kind[v as usize];
        if kind == CORNER || (kind != FREE && self.curve[h as usize] != kind) {
            return false;
        }
        if kind == FREE && self.is_feature(h) {
            return false;
        }
        let is_thin = |h: u32| {
            let (one, other) = (next(h), prev(h));
            (self.is_feature(one) && self.is_feature(other))
                || (self.twin(one) == NONE && self.twin(other) == NONE)
                || self.has_few_neighbours(self.apex(h))
        };
        if is_thin(h) || (g != NONE && (is_thin(g) || (self.is_rim(v) && self.is_rim(w)))) {
            return false;
        }
        // The apexes are common neighbours, and no others may be.
        let apexes = [self.apex(h), if g == NONE { NONE } else { self.apex(g) }];
        apexes[0] != apexes[1]
            && !self.neighbours(v).any(|(n, _)| n != w && !apexes.contains(&n) && self.are_neighbours(w, n))
    }

    /// Whether a vertex has no more triangles than three, or one at a rim: with one less it would have no surroundings.
    fn has_few_neighbours(&self, v: u32) -> bool {
        let first = self.out[v as usize];
        let mut h = first;
        for count in 1.. {
            h = self.twin[prev(h) as usize];
            if h == NONE {
                return count < 2;
            }
            if h == first {
                return count <= 3;
            }
            if count > 3 {
                break;
            }
        }
        false
    }

    /// Shrinks the edge of `h` to its end, where [`Self::can_collapse`] says that it can.
    pub(super) fn collapse(&mut self, h: u32) {
        let (v, w, g) = (self.origin(h), self.end(h), self.twin(h));
        let mut leaving = self.out[v as usize];
        let first = leaving;
        loop {
            self.origin[leaving as usize] = w;
            leaving = self.twin[prev(leaving) as usize];
            if leaving == NONE || leaving == first {
                break;
            }
        }
        self.out[v as usize] = NONE;
        let one = self.close(h);
        let other = if g == NONE { one } else { self.close(g) };
        for v in [w, one, other] {
            self.anchor(v, self.out[v as usize]);
        }
        self.touch_ring(w);
    }

    fn touch(&mut self, v: u32) {
        self.is_awake[v as usize] = true;
        self.touched[v as usize] = self.clock;
    }

    fn touch_ring(&mut self, v: u32) {
        self.touch(v);
        self.for_each_neighbour(v, Self::touch);
    }

    /// Notes that a vertex moved: it and its neighbours are awake.
    pub(super) fn wake_ring(&mut self, v: u32) {
        self.touch(v);
        self.for_each_neighbour(v, |net, n| net.is_awake[n as usize] = true);
    }

    fn for_each_neighbour(&mut self, v: u32, mut each: impl FnMut(&mut Self, u32)) {
        let first = self.out[v as usize];
        let mut h = first;
        loop {
            each(self, self.end(h));
            let last = prev(h);
            h = self.twin[last as usize];
            if h == NONE {
                each(self, self.origin(last));
            }
            if h == NONE || h == first {
                break;
            }
        }
    }

    /// Whether a vertex moved or got other neighbours since then.
    #[inline]
    pub(super) fn was_touched(&self, v: u32, since: u32) -> bool {
        self.touched[v as usize] >= since
    }

    /// Takes away the triangle of `h`, whose ends are one vertex now, joins what is beside it, and returns its apex.
    fn close(&mut self, h: u32) -> u32 {
        let apex = self.apex(h);
        let (one, other) = (next(h), prev(h));
        let (a, b) = (self.twin(one), self.twin(other));
        let curve = self.curve[one as usize].min(self.curve[other as usize]);
        self.join(a, b);
        self.join(b, a);
        for e in [a, b].into_iter().filter(|&e| e != NONE) {
            self.curve[e as usize] = curve;
        }
        for e in [h, one, other] {
            self.origin[e as usize] = NONE;
            self.twin[e as usize] = NONE;
            self.curve[e as usize] = NONE;
        }
        self.spare.push(h / 3);
        // One of the two is there, and each runs between the vertex and the apex.
        for e in [a, b].into_iter().filter(|&e| e != NONE) {
            let (from, to) = (self.origin(e), self.end(e));
            self.out[from as usize] = e;
            self.out[to as usize] = next(e);
        }
        apex
    }
}

/// See [`Net::around`].
pub(super) struct Around<'a> {
    net: &'a Net,
    first: u32,
    at: u32,
}

impl Iterator for Around<'_> {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        let h = self.at;
        if h == NONE {
            return None;
        }
        self.at = self.net.twin[prev(h) as usize];
        if self.at == self.first {
            self.at = NONE;
        }
        Some(h)
    }
}

/// See [`Net::neighbours`].
pub(super) struct Neighbours<'a> {
    net: &'a Net,
    first: u32,
    at: u32,
    /// The half-edge along the rim that ends at the vertex, once the others were visited.
    last: u32,
}

impl Iterator for Neighbours<'_> {
    type Item = (u32, u32);

    #[inline]
    fn next(&mut self) -> Option<(u32, u32)> {
        let h = self.at;
        if h == NONE {
            let last = std::mem::replace(&mut self.last, NONE);
            return (last != NONE).then(|| (self.net.origin(last), last));
        }
        let before = prev(h);
        let left = self.net.twin(before);
        if left == NONE {
            self.last = before;
        }
        self.at = if left == self.first { NONE } else { left };
        Some((self.net.end(h), h))
    }
}

#[cfg(test)]
mod tests {
    use lumen_mesh::shapes::{icosphere, tube};

    use super::*;

    fn assert_sound(net: &Net) {
        for h in (0..net.half_edges()).filter(|&h| net.is_live(h)) {
            let g = net.twin(h);
            if g != NONE {
                assert_eq!((net.twin(g), net.origin(g), net.end(g)), (h, net.end(h), net.origin(h)));
                assert_eq!(net.curve[g as usize], net.curve[h as usize]);
            }
            assert!(net.around(net.origin(h)).any(|other| other == h), "each half-edge is found around its origin");
        }
    }

    fn net(mesh: &lumen_mesh::TriMesh) -> Net {
        let mut net = Net::new(&mesh.positions, &mesh.triangles, vec![0; mesh.triangles.len()]).unwrap();
        net.size = vec![1.0; net.at.len()];
        net
    }

    #[test]
    fn splits_flips_and_collapses_keep_the_half_edges_sound_and_the_euler_characteristic() {
        for mesh in [icosphere(2, 3.0, Vec3::ZERO), tube(8, 5, 4.0, |_| 1.0)] {
            let mut net = net(&mesh);
            assert_sound(&net);
            let euler = |net: &Net| {
                let vertices = net.out.iter().filter(|&&out| out != NONE).count() as i64;
                let edges = (0..net.half_edges()).filter(|&h| net.is_edge(h)).count() as i64;
                vertices - edges + net.triangle_count() as i64
            };
            let before = euler(&net);
            for step in 0..3000u32 {
                let h = step.wrapping_mul(2_654_435_761) % net.half_edges();
                if !net.is_live(h) {
                    continue;
                }
                match step % 5 {
                    0 => drop(net.split(h)),
                    1 | 2 if net.can_collapse(h) => net.collapse(h),
                    3 | 4 if net.twin(h) != NONE && !net.are_neighbours(net.apex(h), net.apex(net.twin(h))) => {
                        net.flip(h);
                    }
                    _ => {}
                }
                if step % 100 == 0 {
                    assert_sound(&net);
                }
            }
            assert_sound(&net);
            assert_eq!(euler(&net), before);
        }
    }

    #[test]
    fn a_sphere_collapses_to_a_tetrahedron_and_no_further() {
        let mut net = net(&icosphere(2, 3.0, Vec3::ZERO));
        for _ in 0..20 {
            for h in 0..net.half_edges() {
                if net.is_live(h) && net.can_collapse(h) {
                    net.collapse(h);
                }
            }
        }
        assert_eq!(net.triangle_count(), 4);
        assert_sound(&net);
    }
}
