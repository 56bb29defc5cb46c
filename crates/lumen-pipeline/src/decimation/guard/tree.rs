//! Leaves of a few neighbouring slots each, a box and a cone of normals around their triangles, and a tree of boxes and
//! cones over them.
//!
//! Slots that follow each other are neighbours in space (`order.rs`), but may lie on different sheets. Within one closed
//! surface that does not matter; else a leaf is a patch that hangs together. The tree is the leaves' order in groups of
//! four.

use std::f32::consts::{PI, SQRT_2};

use glam::Vec3A;

use super::super::one_ring::{MAX_AROUND, OneRing};
use super::super::rings::{Rings, neighbour};

/// Most slots of a leaf.
const LEAF: usize = 8;
/// Most mean edge lengths from the first vertex of a leaf to another.
const LEAF_SIZE: f32 = 4.0;
/// Smallest cosine between the normals of a leaf's vertices and their mean so far.
const LEAF_TURN: f32 = 0.7;
/// Children of a node.
const WIDTH: usize = 4;
/// Room for a leaf's normals to turn, in radians.
pub(super) const SLACK: f32 = 0.15;
/// A little less than a right angle, in radians.
const HALF_SPACE: f32 = 1.5;

/// A box around triangles, and a cone around their normals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    pub(super) low: Vec3A,
    pub(super) high: Vec3A,
    pub(super) axis: Vec3A,
    /// Between the axis and the normal farthest from it, in radians.
    angle: f32,
    /// The cosine of that angle; of leaves only.
    pub(super) cosine: f32,
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
    pub(super) fn widen(&mut self, angle: f32) {
        self.angle = angle.min(PI);
        self.cosine = libm::cosf(self.angle);
    }

    /// Gives the cone room to turn.
    pub(super) fn widen_by(&mut self, more: f32) {
        self.widen(self.angle + more);
    }

    pub(super) fn overlaps(&self, low: Vec3A, high: Vec3A) -> bool {
        (self.low.cmple(high) & self.high.cmpge(low)).all()
    }

    pub(super) fn holds(&self, low: Vec3A, high: Vec3A) -> bool {
        (self.low.cmple(low) & self.high.cmpge(high)).all()
    }

    /// Whether all its normals lie in a half-space.
    pub(super) fn is_one_sided(&self) -> bool {
        self.looks_as(self)
    }

    /// Whether, whichever leaf of the one and of the other are taken, all their normals look to the same side as the axis
    /// of either.
    pub(super) fn looks_as(&self, other: &Self) -> bool {
        let own = (self.spread + self.angle).max(other.spread + other.angle);
        let mutual = (self.spread + other.angle).max(other.spread + self.angle);
        own < HALF_SPACE && mutual < HALF_SPACE && mutual + angle(self.axis.dot(other.axis)) < HALF_SPACE
    }

    /// The patch around several.
    fn around(children: &[Self]) -> Self {
        let axis = children.iter().map(|child| child.axis).sum::<Vec3A>().normalize_or_zero();
        children.iter().fold(Self { axis, ..Self::NOTHING }, |all, child| {
            if child.low.x > child.high.x {
                return all;
            }
            let apart = angle(axis.dot(child.axis));
            Self {
                low: all.low.min(child.low),
                high: all.high.max(child.high),
                axis,
                angle: all.angle.max(apart + child.angle),
                cosine: -1.0,
                spread: all.spread.max(apart + child.spread),
            }
        })
    }
}

/// The angle of a cosine, or a little more: the first terms of the series about 0, the third enlarged to make up for
/// the rest.
pub(super) fn angle(cosine: f32) -> f32 {
    if cosine < 0.0 {
        return libm::acosf(cosine.max(-1.0));
    }
    let u = (1.0 - cosine).max(0.0);
    (2.0 * u).sqrt() * (1.0 + u * (1.0 / 12.0 + 0.0275 * u))
}

/// The slots of a surface in leaves, without room to grow.
#[derive(Default)]
pub(super) struct Leaves {
    /// Whether a leaf has to hang together.
    is_connected: bool,
    pub(super) patches: Vec<Patch>,
    /// The slots, leaf after leaf.
    slots: Vec<u32>,
    /// Where each leaf begins in `slots`, and at the end where the last one ends.
    starts: Vec<u32>,
    /// Along any axis, the longest way from a vertex of each leaf to a neighbour.
    pub(super) reaches: Vec<f32>,
    /// The leaf of each slot, [`NONE`] for those that have none yet.
    leaf_of: Vec<u32>,
    /// All slots before this one have a leaf.
    next: u32,
    queue: Vec<u32>,
    /// Of each vertex of a leaf: a mean normal, and the chord to the normal farthest from it.
    cones: Vec<(Vec3A, f32)>,
}

/// No leaf.
const NONE: u32 = u32::MAX;

/// A leaf that is being made.
struct Growing {
    patch: Patch,
    /// The sum of its vertices' normals.
    sum: Vec3A,
    is_loose: bool,
    reach: f32,
}

impl Leaves {
    /// For `count` slots; each leaf hangs together, or is what follows each other.
    pub(super) fn new(count: usize, is_connected: bool) -> Self {
        Self { is_connected, leaf_of: vec![NONE; count], starts: vec![0], ..Self::default() }
    }

    pub(super) fn len(&self) -> usize {
        self.reaches.len()
    }

    /// The leaf of a slot.
    pub(super) fn of(&self, slot: u32) -> u32 {
        self.leaf_of[slot as usize]
    }

    /// The slots of a leaf.
    pub(super) fn slots(&self, leaf: u32) -> &[u32] {
        &self.slots[self.starts[leaf as usize] as usize..self.starts[leaf as usize + 1] as usize]
    }

    /// Puts the next slots into leaves, about `count` of them; whether these were the last. `edge` is the mean length of
    /// an edge.
    pub(super) fn advance(&mut self, rings: &Rings, star: &mut OneRing, edge: f32, count: usize) -> bool {
        let end = self.leaf_of.len().min(self.slots.len() + count);
        while self.slots.len() < end {
            while self.leaf_of[self.next as usize] != NONE {
                self.next += 1;
            }
            self.add(rings, star, edge);
        }
        self.slots.len() == self.leaf_of.len()
    }

    /// Adds the leaf that begins at `next`.
    fn add(&mut self, rings: &Rings, star: &mut OneRing, edge: f32) {
        let first = self.next;
        let mut leaf = Growing { patch: Patch::NOTHING, sum: Vec3A::ZERO, is_loose: false, reach: 0.0 };
        let begin = self.slots.len();
        self.cones.clear();
        if self.is_connected {
            self.queue.clear();
            self.queue.push(first);
            let mut at = 0;
            while at < self.queue.len() && self.slots.len() < begin + LEAF {
                let v = self.queue[at];
                at += 1;
                if is_loose(rings, v) == is_loose(rings, first) && self.take(rings, star, edge, v, first, &mut leaf) {
                    for &entry in rings.around(v) {
                        let n = neighbour(entry);
                        if self.leaf_of[n as usize] == NONE && !self.queue.contains(&n) {
                            self.queue.push(n);
                        }
                    }
                }
            }
        } else {
            let end = (first as usize + LEAF).min(self.leaf_of.len()) as u32;
            let mut v = first;
            while v < end && self.take(rings, star, edge, v, first, &mut leaf) {
                v += 1;
            }
        }
        let Growing { mut patch, sum, is_loose, reach } = leaf;
        patch.axis = sum.normalize_or_zero();
        // As chords of the unit sphere, which add up at least as angles do.
        let chords = self.cones.iter().map(|&(axis, chord)| chord + axis.distance(patch.axis));
        let chord = chords.fold(0.0, f32::max);
        patch.angle = if is_loose || chord >= SQRT_2 { PI } else { angle(1.0 - chord * chord / 2.0) };
        self.starts.push(self.slots.len() as u32);
        self.patches.push(patch);
        self.reaches.push(reach);
    }

    /// Adds a slot to the leaf that is being made and begins with `first`, unless it is too far or turned too much.
    fn take(&mut self, rings: &Rings, star: &mut OneRing, edge: f32, v: u32, first: u32, leaf: &mut Growing) -> bool {
        let p = rings.at(v);
        if v != first && p.distance(rings.at(first)) > LEAF_SIZE * edge {
            return false;
        }
        let Growing { patch, sum, is_loose, reach } = leaf;
        if rings.is_gone(v) || rings.around(v).len() > MAX_AROUND {
            *is_loose |= !rings.is_gone(v);
            for &entry in rings.around(v) {
                let q = rings.at(neighbour(entry));
                (patch.low, patch.high) = (patch.low.min(q), patch.high.max(q));
                *reach = reach.max((q - p).abs().max_element());
            }
        } else {
            star.load(rings, v);
            star.span();
            let normal = star.normal_sum();
            if v != first && normal.dot(*sum) < LEAF_TURN * normal.length() * sum.length() {
                return false;
            }
            let [low, high] = star.reach();
            *reach = reach.max(high.max(-low).max_element());
            (patch.low, patch.high) = (patch.low.min(low + p), patch.high.max(high + p));
            *sum += normal;
            let axis = normal.normalize_or_zero();
            self.cones.push((axis, (2.0 - 2.0 * star.cosine_to(axis)).max(0.0).sqrt()));
            *is_loose |= self::is_loose(rings, v);
        }
        self.leaf_of[v as usize] = self.patches.len() as u32;
        self.slots.push(v);
        true
    }
}

/// Whether another sheet may follow beyond a vertex: it lies on a boundary or a cut, or too much meets there.
fn is_loose(rings: &Rings, v: u32) -> bool {
    rings.is_open(v) || rings.stays(v) || rings.around(v).len() > MAX_AROUND
}

/// A tree over patches.
#[derive(Default)]
pub(super) struct Tree {
    /// Leaves first, then each level of nodes above; the last has one.
    levels: Vec<Vec<Patch>>,
    stack: Vec<(usize, u32)>,
}

impl Tree {
    pub(super) fn new(leaves: Vec<Patch>) -> Self {
        let mut levels = vec![leaves];
        while levels[levels.len() - 1].len() > 1 {
            let below = &levels[levels.len() - 1];
            levels.push(below.chunks(WIDTH).map(Patch::around).collect());
        }
        Self { levels, stack: Vec::new() }
    }

    pub(super) fn leaf(&self, leaf: u32) -> &Patch {
        &self.levels[0][leaf as usize]
    }

    /// Replaces a leaf by a larger one. The nodes above make room for its box; their cones are those of the beginning.
    pub(super) fn grow(&mut self, leaf: u32, patch: Patch) {
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
    }

    /// Adds to `near` the leaves whose boxes overlap one, without the branches and leaves that `is_out` says are of no
    /// use. Ends as soon as there are more than `most`.
    pub(super) fn leaves_near(
        &mut self,
        (low, high): (Vec3A, Vec3A),
        near: &mut Vec<u32>,
        most: usize,
        is_out: impl Fn(&Patch) -> bool,
    ) {
        self.stack.clear();
        self.stack.push((self.levels.len(), 0));
        while let Some((level, at)) = self.stack.pop() {
            let below = &self.levels[level - 1];
            let first = at as usize * WIDTH;
            for (at, patch) in (first as u32..).zip(&below[first..below.len().min(first + WIDTH)]) {
                if !patch.overlaps(low, high) || is_out(patch) {
                    continue;
                }
                if level > 1 {
                    self.stack.push((level - 1, at));
                    continue;
                }
                near.push(at);
                if near.len() > most {
                    return;
                }
            }
        }
    }
}
