//! Keeps triangles from running into each other: no collapse may make one cross a triangle that its input did not cross.
//!
//! Neighbouring slots are neighbours in space (`order.rs`), so a few of them at a time are a leaf: a box around their
//! triangles and a cone around these triangles' normals. Two leaves whose cones lie within a half-space can only be
//! parts of one sheet that does not fold, as long as both keep to their cones (Volino and Magnenat-Thalmann, "Efficient
//! self-collision detection on smoothly discretized surface animations using geometrical shape regularity", 1994: here
//! for pairs of leaves; two sheets of the same side of one closed surface have a third between them that looks the
//! other way). What remains are pairs of leaves that are near each other and look different ways: the two walls of a
//! thin vessel, neighbouring vessels, a fold. They are found once for every few collapses, by descending a tree of
//! leaves against itself, with room to grow; a leaf that outgrows its box or its cone looks for its pairs anew.
//!
//! A collapse then asks the pairs of the leaf it happens in, and most have none near. Where boxes do overlap, triangles
//! are tested one by one (`mesh::crossing`). A surface may enter with crossings: then a collapse is allowed if it leaves no
//! more triangles that cross than it found.

use std::f32::consts::{PI, SQRT_2};

use glam::Vec3A;

use super::rings::{Rings, neighbour};
use super::star::{MOST_AROUND, Star};
use crate::mesh::TriMesh;
use crate::mesh::crossing::{Face, cross};

/// Most slots of a leaf.
const LEAF: u32 = 8;
/// Most mean edge lengths from the first vertex of a leaf to another.
const LEAF_SIZE: f32 = 4.0;
/// Smallest cosine between the normals of a leaf's vertices and their mean so far.
const LEAF_TURN: f32 = 0.7;
/// Children of a node.
const WIDTH: usize = 4;
/// Room for a leaf to grow, in mean edge lengths.
const MARGIN: f32 = 1.5;
/// Room for its normals to turn, in radians.
const SLACK: f32 = 0.15;
/// A little less than a right angle, in radians.
const HALF_SPACE: f32 = 1.5;
/// Its cosine.
const FACING: f32 = 0.07;

/// A box around triangles, and a cone around their normals.
#[derive(Clone, Copy)]
struct Patch {
    low: Vec3A,
    high: Vec3A,
    axis: Vec3A,
    /// Between the axis and the normal farthest from it, in radians.
    angle: f32,
    /// The cosine of that angle; of leaves only.
    cosine: f32,
    /// Between the axis and the leaf's axis farthest from it, in radians; 0 for a leaf.
    spread: f32,
}

impl Patch {
    const NOTHING: Self = Self {
        low: Vec3A::INFINITY,
        high: Vec3A::NEG_INFINITY,
        axis: Vec3A::ZERO,
        angle: 0.0,
        cosine: 1.0,
        spread: 0.0,
    };

    /// Gives the cone this angle.
    fn widen(&mut self, angle: f32) {
        self.angle = angle.min(PI);
        self.cosine = libm::cosf(self.angle);
    }

    fn overlaps(&self, low: Vec3A, high: Vec3A) -> bool {
        (self.low.cmple(high) & self.high.cmpge(low)).all()
    }

    fn holds(&self, low: Vec3A, high: Vec3A) -> bool {
        (self.low.cmple(low) & self.high.cmpge(high)).all()
    }

    /// Whether, whichever leaf of the one and of the other are taken, all their normals look to the same side as the axis
    /// of either.
    fn looks_as(&self, other: &Self) -> bool {
        let own = (self.spread + self.angle).max(other.spread + other.angle);
        let mutual = (self.spread + other.angle).max(other.spread + self.angle);
        own < HALF_SPACE && mutual < HALF_SPACE && mutual + angle(self.axis.dot(other.axis)) < HALF_SPACE
    }
}

/// The angle of a cosine, or a little more: the first terms of the series about 0, the third enlarged to make up for
/// the rest.
fn angle(cosine: f32) -> f32 {
    if cosine < 0.0 {
        return libm::acosf(cosine.max(-1.0));
    }
    let u = (1.0 - cosine).max(0.0);
    (2.0 * u).sqrt() * (1.0 + u * (1.0 / 12.0 + 0.0275 * u))
}

/// End of a list of pairs.
const NONE: u32 = u32::MAX;

/// See the head of the file.
#[derive(Default)]
pub(super) struct Guard {
    /// Leaves first, then each level of nodes above; the last has one.
    levels: Vec<Vec<Patch>>,
    /// The leaf of each slot.
    leaf_of: Vec<u32>,
    /// The first slot of each leaf, and where the last ends.
    starts: Vec<u32>,
    /// Corners of the boxes around the leaves' triangles as they are now.
    boxes: Vec<[Vec3A; 2]>,
    /// Along any axis, the longest way from a vertex of each leaf to a neighbour.
    reaches: Vec<f32>,
    /// The pairs found at first: those of a leaf are `others[offsets[leaf]..offsets[leaf + 1]]`.
    offsets: Vec<u32>,
    others: Vec<u32>,
    /// For each leaf the first of its later pairs in `pairs`: the other leaf, and where the next one stands.
    first: Vec<u32>,
    pairs: Vec<[u32; 2]>,
    margin: f32,
    /// Whether the surface has more than one piece: then sheets that look the same way may lie upon each other.
    pub(super) several: bool,
    near: Vec<u32>,
    stack: Vec<(usize, u32)>,
    /// For each leaf the last search that knew it.
    marks: Vec<u32>,
    mark: u32,
    found: Vec<[u32; 3]>,
}

/// A collapse to be judged: `v` goes to `u`, which moves to `place` if there is one; the stars are theirs.
pub(super) struct Planned<'a> {
    pub(super) v: u32,
    pub(super) u: u32,
    /// Where `u` stands in the ring of `v`.
    pub(super) to: usize,
    /// Where `u` will be, relative to the middle of the rings.
    pub(super) end: Vec3A,
    pub(super) star: &'a Star,
    /// Of `u`, and where `v` stands in it: only if `u` moves.
    pub(super) other: Option<(&'a Star, usize)>,
}

impl Guard {
    /// A guard over the surface as it is now.
    fn new(rings: &Rings, star: &mut Star, several: bool) -> Self {
        let edge = mean_edge(rings);
        let (mut leaves, starts, reaches) = leaves_of(rings, star, edge);
        let count = leaves.len();
        let mut leaf_of = vec![0; rings.len()];
        for (leaf, ends) in starts.windows(2).enumerate() {
            leaf_of[ends[0] as usize..ends[1] as usize].fill(leaf as u32);
        }
        let margin = MARGIN * edge;
        let boxes = leaves.iter().map(|leaf: &Patch| [leaf.low, leaf.high]).collect();
        for leaf in &mut leaves {
            if leaf.low.x <= leaf.high.x {
                leaf.low -= margin;
                leaf.high += margin;
            }
            leaf.widen(leaf.angle + SLACK);
        }
        let mut levels = vec![leaves];
        while levels[levels.len() - 1].len() > 1 {
            let below = &levels[levels.len() - 1];
            levels.push(below.chunks(WIDTH).map(parent).collect());
        }
        let mut guard = Self {
            levels,
            leaf_of,
            starts,
            boxes,
            reaches,
            first: vec![NONE; count],
            pairs: Vec::new(),
            margin,
            several,
            offsets: vec![0; count + 1],
            others: Vec::new(),
            near: Vec::new(),
            stack: Vec::new(),
            marks: vec![0; count],
            mark: 0,
            found: Vec::new(),
        };
        guard.find_pairs();
        guard
    }

    /// Starts anew over the surface as it is now.
    pub(super) fn renew(&mut self, rings: &Rings, star: &mut Star) {
        *self = Self::new(rings, star, self.several);
    }

    fn find_pairs(&mut self) {
        let top = self.levels.len() - 1;
        let mut stack = vec![(top, 0u32, 0u32)];
        let mut found = Vec::new();
        while let Some((level, a, b)) = stack.pop() {
            let patches = &self.levels[level];
            let (Some(p), Some(q)) = (patches.get(a as usize), patches.get(b as usize)) else { continue };
            if a != b && !p.overlaps(q.low, q.high) || self.is_one_sheet(p, q) {
                continue;
            }
            if level == 0 {
                found.push([a, b]);
                continue;
            }
            let below = self.levels[level - 1].len() as u32;
            let children = |n: u32| n * WIDTH as u32..((n + 1) * WIDTH as u32).min(below);
            for i in children(a) {
                for j in children(b) {
                    if a != b || i <= j {
                        stack.push((level - 1, i, j));
                    }
                }
            }
        }
        // Each pair stands with both of its leaves.
        let both = |&[a, b]: &[u32; 2]| [Some([a, b]), (a != b).then_some([b, a])].into_iter().flatten();
        for [of, _] in found.iter().flat_map(both) {
            self.offsets[of as usize + 1] += 1;
        }
        (1..self.offsets.len()).for_each(|i| self.offsets[i] += self.offsets[i - 1]);
        self.others = vec![0; self.offsets[self.offsets.len() - 1] as usize];
        let mut cursor = self.offsets.clone();
        for [of, other] in found.iter().flat_map(both) {
            self.others[cursor[of as usize] as usize] = other;
            cursor[of as usize] += 1;
        }
    }

    fn is_one_sheet(&self, a: &Patch, b: &Patch) -> bool {
        !self.several && a.looks_as(b)
    }

    fn pair(&mut self, a: u32, b: u32) {
        for (of, other) in [(a, b), (b, a)] {
            self.pairs.push([other, self.first[of as usize]]);
            self.first[of as usize] = self.pairs.len() as u32 - 1;
            if a == b {
                break;
            }
        }
    }

    fn pairs_of(&self, leaf: u32) -> impl Iterator<Item = u32> + '_ {
        let known = self.offsets[leaf as usize] as usize..self.offsets[leaf as usize + 1] as usize;
        let mut next = self.first[leaf as usize];
        let later = std::iter::from_fn(move || {
            let &[other, after] = self.pairs.get(next as usize)?;
            next = after;
            Some(other)
        });
        self.others[known].iter().copied().chain(later)
    }

    /// Sees to it that the leaf has room for a box, and its cone for a cosine, and that it knows its pairs then.
    fn grow(&mut self, leaf: u32, low: Vec3A, high: Vec3A, cosine: f32) {
        let mut patch = self.levels[0][leaf as usize];
        let fits = patch.holds(low, high);
        if fits && cosine >= patch.cosine {
            return;
        }
        if !fits {
            patch.low = patch.low.min(low - self.margin);
            patch.high = patch.high.max(high + self.margin);
        }
        if cosine < patch.cosine {
            patch.widen(angle(cosine) + SLACK);
        }
        self.levels[0][leaf as usize] = patch;
        let mut at = leaf as usize;
        for level in 1..self.levels.len() {
            at /= WIDTH;
            let node = &mut self.levels[level][at];
            if node.holds(patch.low, patch.high) {
                break;
            }
            node.low = node.low.min(patch.low);
            node.high = node.high.max(patch.high);
        }
        self.find_pairs_of(leaf, &patch);
    }

    /// Adds the pairs of a leaf that it does not know yet.
    fn find_pairs_of(&mut self, leaf: u32, patch: &Patch) {
        let (mut near, mut stack) = (std::mem::take(&mut self.near), std::mem::take(&mut self.stack));
        near.clear();
        self.leaves_near(patch.low, patch.high, &mut near, &mut stack);
        let mut marks = std::mem::take(&mut self.marks);
        self.mark += 1;
        self.pairs_of(leaf).for_each(|other| marks[other as usize] = self.mark);
        for &other in &near {
            if marks[other as usize] != self.mark && !self.is_one_sheet(patch, &self.levels[0][other as usize]) {
                self.pair(leaf, other);
            }
        }
        (self.near, self.stack, self.marks) = (near, stack, marks);
    }

    fn leaves_near(&self, low: Vec3A, high: Vec3A, near: &mut Vec<u32>, stack: &mut Vec<(usize, u32)>) {
        stack.clear();
        stack.push((self.levels.len() - 1, 0));
        while let Some((level, at)) = stack.pop() {
            let Some(patch) = self.levels[level].get(at as usize) else { continue };
            if !patch.overlaps(low, high) {
                continue;
            }
            if level == 0 {
                near.push(at);
            } else {
                stack.extend((0..WIDTH as u32).map(|i| (level - 1, at * WIDTH as u32 + i)));
            }
        }
    }

    /// Whether the collapse makes no crossing that was not there.
    pub(super) fn allows(&mut self, rings: &Rings, mesh: &TriMesh, planned: &Planned) -> bool {
        let Planned { v, u, star, .. } = *planned;
        let p = rings.at(v);
        let [mut low, mut high] = star.reach().map(|corner| corner + p);
        low = low.min(planned.end);
        high = high.max(planned.end);
        if let Some((other, _)) = planned.other {
            let [least, most] = other.reach().map(|corner| corner + rings.at(u));
            low = low.min(least);
            high = high.max(most);
        }
        let leaf = self.leaf_of[u as usize];
        let axis = self.levels[0][leaf as usize].axis;
        let mut cosine = star.least_cosine(planned.end - p, planned.to, axis);
        if let Some((other, at)) = planned.other {
            cosine = cosine.min(other.least_cosine(planned.end - rings.at(u), at, axis));
        }
        self.grow(leaf, low, high, cosine);
        let near = |guard: &Self, other: u32| {
            let [least, most] = guard.boxes[other as usize];
            (least.cmple(high) & most.cmpge(low)).all()
        };
        let mut pairs = std::mem::take(&mut self.near);
        pairs.clear();
        pairs.extend(self.pairs_of(leaf).filter(|&other| near(self, other)));
        let [least, most] = &mut self.boxes[leaf as usize];
        (*least, *most) = (least.min(low), most.max(high));
        let reach = (planned.end - low).max(high - planned.end).max_element();
        self.reaches[leaf as usize] = self.reaches[leaf as usize].max(reach);
        let allowed = pairs.is_empty()
            || self.crossings_allow(rings, mesh, planned, &pairs, (low, high), (cosine > FACING).then_some(axis));
        self.near = pairs;
        allowed
    }

    /// [`Self::allows`], triangle by triangle, against those of the leaves in `near`.
    fn crossings_allow(
        &mut self,
        rings: &Rings,
        mesh: &TriMesh,
        planned: &Planned,
        near: &[u32],
        (low, high): (Vec3A, Vec3A),
        axis: Option<Vec3A>,
    ) -> bool {
        let Planned { v, u, .. } = *planned;
        let moves = planned.other.is_some();
        self.found.clear();
        for &leaf in near {
            let slots = self.starts[leaf as usize]..self.starts[leaf as usize + 1];
            for s in slots.filter(|&s| s != v && !(moves && s == u)) {
                let p = rings.at(s);
                let reach = Vec3A::splat(self.reaches[leaf as usize]);
                if (p.cmpgt(high + reach) | p.cmplt(low - reach)).any() {
                    continue;
                }
                for [a, b] in rings.pairs(s) {
                    let (q, r) = (rings.at(a), rings.at(b));
                    let apart = p.min(q).min(r).cmpgt(high) | p.max(q).max(r).cmplt(low);
                    if apart.any() || [a, b].contains(&v) || moves && [a, b].contains(&u) {
                        continue;
                    }
                    let normal = (q - p).cross(r - p);
                    if axis.is_none_or(|axis| normal.dot(axis) <= FACING * normal.length()) {
                        self.found.push(turned([s, a, b]));
                    }
                }
            }
        }
        if self.found.is_empty() && axis.is_some() {
            return true;
        }
        self.found.sort_unstable();
        self.found.dedup();
        let place = |s: u32| rings.place(s, mesh);
        let end = if moves { rings.in_mm(planned.end) } else { place(u) };
        let node = |s: u32| if s == v { rings.nodes[u as usize] } else { rings.nodes[s as usize] };
        let face = |corners: [u32; 3]| Face {
            vertices: corners.map(node),
            corners: corners.map(|s| if s == u || s == v { end } else { place(s) }),
        };
        // Those around both, each once: around v all, around u the others, where it moves.
        let of_u = rings.pairs(u).filter(|pair| moves && !pair.contains(&v)).map(|[a, b]| [u, a, b]);
        let old: Vec<[u32; 3]> = rings.pairs(v).map(|[a, b]| [v, a, b]).chain(of_u).collect();
        let lives = |corners: &&[u32; 3]| !(corners.contains(&u) && corners.contains(&v));
        let new_faces: Vec<Face> = old.iter().filter(lives).map(|&corners| face(corners)).collect();
        let old_face = |corners: [u32; 3]| Face {
            vertices: corners.map(|s| rings.nodes[s as usize]),
            corners: corners.map(place),
        };
        let others: Vec<Face> = self.found.iter().map(|&corners| old_face(corners)).collect();
        let after = crossing(&new_faces, &others);
        if after.is_none() {
            return true;
        }
        let old: Vec<Face> = old.into_iter().map(old_face).collect();
        let before = crossing(&old, &others);
        after.is_within(&before)
    }
}

/// Which triangles of two lists, or of the first alone, run into each other.
struct Crossing {
    /// How many of the first.
    own: usize,
    /// Which of the second.
    others: Vec<bool>,
}

fn crossing(own: &[Face], others: &[Face]) -> Crossing {
    let mut is_hit = vec![false; others.len()];
    let mut hits = vec![false; own.len()];
    for (i, face) in own.iter().enumerate() {
        for (j, other) in others.iter().enumerate() {
            if cross(face, other) {
                hits[i] = true;
                is_hit[j] = true;
            }
        }
        for j in i + 1..own.len() {
            if cross(face, &own[j]) {
                hits[i] = true;
                hits[j] = true;
            }
        }
    }
    Crossing { own: hits.into_iter().filter(|&hit| hit).count(), others: is_hit }
}

impl Crossing {
    fn is_none(&self) -> bool {
        self.own == 0
    }

    /// Whether no more triangles cross than did: each that is gone makes up for one that is new, of the first list or of
    /// the second.
    fn is_within(&self, before: &Self) -> bool {
        let newly_hit = self.others.iter().zip(&before.others).filter(|&(&after, &before)| after && !before).count();
        self.own + newly_hit <= before.own
    }
}

/// A triangle's corners, turned so that the least is the first.
fn turned([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Mean length of an edge: of one at every few vertices.
fn mean_edge(rings: &Rings) -> f32 {
    const STEP: usize = 16;
    let (mut sum, mut count) = (0.0, 0u32);
    for v in (0..rings.len() as u32).step_by(STEP) {
        if let Some(&n) = rings.around(v).first() {
            sum += f64::from(rings.at(v).distance(rings.at(neighbour(n))));
            count += 1;
        }
    }
    if count > 0 { (sum / f64::from(count)) as f32 } else { 0.0 }
}

/// Parts the slots into leaves: their boxes and cones without room to grow, where they start, and how far they reach.
fn leaves_of(rings: &Rings, star: &mut Star, edge: f32) -> (Vec<Patch>, Vec<u32>, Vec<f32>) {
    let count = rings.len() as u32;
    let (mut leaves, mut starts, mut reaches) = (Vec::new(), Vec::new(), Vec::new());
    // Of each vertex of a leaf: a mean normal, and the chord to the normal farthest from it.
    let mut cones: Vec<(Vec3A, f32)> = Vec::new();
    let mut v = 0;
    while v < count {
        let first = v;
        let mut patch = Patch::NOTHING;
        let mut sum = Vec3A::ZERO;
        let mut is_loose = false;
        let mut reach = 0.0f32;
        cones.clear();
        while v < count && v < first + LEAF {
            let p = rings.at(v);
            if p.distance(rings.at(first)) > LEAF_SIZE * edge {
                break;
            }
            if rings.is_gone(v) || rings.around(v).len() > MOST_AROUND {
                is_loose |= !rings.is_gone(v);
                for &entry in rings.around(v) {
                    let q = rings.at(neighbour(entry));
                    (patch.low, patch.high) = (patch.low.min(q), patch.high.max(q));
                    reach = reach.max((q - p).abs().max_element());
                }
                v += 1;
                continue;
            }
            star.load(rings, v);
            star.span();
            let normal = star.normal_sum();
            if v > first && normal.dot(sum) < LEAF_TURN * normal.length() * sum.length() {
                break;
            }
            let [low, high] = star.reach();
            reach = reach.max(high.max(-low).max_element());
            (patch.low, patch.high) = (patch.low.min(low + p), patch.high.max(high + p));
            sum += normal;
            let axis = normal.normalize_or_zero();
            cones.push((axis, (2.0 - 2.0 * star.cosine_to(axis)).max(0.0).sqrt()));
            // Beyond a boundary, or a cut, another sheet may follow.
            is_loose |= rings.is_open(v) || rings.stays(v);
            v += 1;
        }
        patch.axis = sum.normalize_or_zero();
        // As chords of the unit sphere, which add up at least as angles do.
        let chords = cones.iter().map(|&(axis, chord)| chord + axis.distance(patch.axis));
        let chord = chords.fold(0.0, f32::max);
        patch.angle = if is_loose || chord >= SQRT_2 { PI } else { angle(1.0 - chord * chord / 2.0) };
        starts.push(first);
        leaves.push(patch);
        reaches.push(reach);
    }
    starts.push(count);
    (leaves, starts, reaches)
}

fn parent(children: &[Patch]) -> Patch {
    let axis = children.iter().map(|child| child.axis).sum::<Vec3A>().normalize_or_zero();
    children.iter().fold(Patch { axis, ..Patch::NOTHING }, |all, child| {
        if child.low.x > child.high.x {
            return all;
        }
        let apart = angle(axis.dot(child.axis));
        Patch {
            low: all.low.min(child.low),
            high: all.high.max(child.high),
            axis,
            angle: all.angle.max(apart + child.angle),
            cosine: -1.0,
            spread: all.spread.max(apart + child.spread),
        }
    })
}
