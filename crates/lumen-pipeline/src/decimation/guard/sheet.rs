//! What is one sheet: triangles that look the same way and hang together without a fold between them do not run into
//! each other (Volino and Magnenat-Thalmann 1994). That they look the same way is not enough: the two sides of a wall that
//! is open or in pieces, or two turns of a scroll, do as well.

use glam::Vec3A;

use super::super::rings::{Rings, neighbour};
use super::tree::{Leaves, Patch, Tree};

/// The cosine of a little less than a right angle.
pub(super) const FACING: f32 = 0.07;

/// Triangles of a sheet that are followed around a collapse, and leaves beside a leaf; beyond them what looks the same
/// way is tested.
const MAX_LEAVES: usize = 64;

/// Walks over sheets.
#[derive(Default)]
pub(super) struct Sheet {
    /// For each leaf the last walk that came by: twice its number where the leaf is part of the sheet, one more where
    /// not.
    marks: Vec<u32>,
    walk: u32,
    /// The leaves beside each leaf: `beside[offsets[leaf]..offsets[leaf + 1]]`.
    offsets: Vec<u32>,
    beside: Vec<u32>,
    queue: Vec<u32>,
    /// The triangles of a sheet around a collapse, and the corner of each beyond the side that led there.
    triangles: Vec<([u32; 3], u32)>,
}

impl Sheet {
    /// For how many leaves it is known what is beside them.
    pub(super) fn len(&self) -> usize {
        self.marks.len()
    }

    /// Finds what is beside the next leaf. That stays true while vertices go: what hung together by a leaf still does.
    pub(super) fn add_leaf(&mut self, rings: &Rings, leaves: &Leaves) {
        let leaf = self.len() as u32;
        if leaf == 0 {
            self.offsets.push(0);
        }
        let first = self.beside.len();
        for &slot in leaves.slots(leaf) {
            for &entry in rings.around(slot) {
                let next = leaves.of(neighbour(entry));
                if next != leaf && !self.beside[first..].contains(&next) && self.beside.len() < first + MAX_LEAVES {
                    self.beside.push(next);
                }
            }
        }
        self.offsets.push(self.beside.len() as u32);
        self.marks.push(0);
    }

    /// Finds the leaves that are one sheet with `leaf`, whose patch is `patch`: those that look the same way, be it within
    /// its box, and that it hangs together with by such leaves. [`Self::has_leaf`] knows them until the next walk.
    pub(super) fn spread(&mut self, tree: &Tree, leaf: u32, patch: &Patch) {
        self.walk += 2;
        if !patch.is_one_sided() {
            return;
        }
        self.marks[leaf as usize] = self.walk;
        self.queue.clear();
        self.queue.push(leaf);
        while let Some(at) = self.queue.pop() {
            for &next in &self.beside[self.offsets[at as usize] as usize..self.offsets[at as usize + 1] as usize] {
                let mark = &mut self.marks[next as usize];
                if *mark >= self.walk {
                    continue;
                }
                let other = tree.leaf(next);
                if other.overlaps(patch.low, patch.high) && patch.looks_as(other) {
                    *mark = self.walk;
                    self.queue.push(next);
                } else {
                    *mark = self.walk + 1;
                }
            }
        }
    }

    /// Whether the last walk found `leaf` to be part of the sheet.
    pub(super) fn has_leaf(&self, leaf: u32) -> bool {
        self.marks[leaf as usize] == self.walk
    }

    /// Strikes out of `alike`, ascending triangles with their least corner first, those of the sheet around a collapse: what
    /// looks as `axis` does and hangs together, by edges, with the stars of `of`, as far as it reaches into the box.
    pub(super) fn follow(
        &mut self,
        rings: &Rings,
        of: &[u32],
        axis: Vec3A,
        corners: (Vec3A, Vec3A),
        alike: &mut Vec<[u32; 3]>,
    ) {
        self.triangles.clear();
        for &v in of {
            for side in rings.pairs(v) {
                self.step(rings, of, side, axis, corners, alike);
            }
        }
        let mut at = 0;
        while at < self.triangles.len() && self.triangles.len() < MAX_LEAVES && !alike.is_empty() {
            let ([a, b, c], apex) = self.triangles[at];
            at += 1;
            // The third side is the one that led here.
            for side in [[a, b], [b, c], [c, a]].into_iter().filter(|side| side.contains(&apex)) {
                self.step(rings, of, side, axis, corners, alike);
            }
        }
    }

    /// Adds the triangle beyond a side, if it is part of the sheet.
    fn step(
        &mut self,
        rings: &Rings,
        of: &[u32],
        [a, b]: [u32; 2],
        axis: Vec3A,
        (low, high): (Vec3A, Vec3A),
        alike: &mut Vec<[u32; 3]>,
    ) {
        // It runs from b to a.
        let ring = rings.around(a);
        let Some(at) = ring.iter().position(|&entry| neighbour(entry) == b) else { return };
        let before = if at > 0 { ring.get(at - 1) } else { ring.last().filter(|_| !rings.is_open(a)) };
        let Some(c) = before.map(|&entry| neighbour(entry)) else { return };
        if of.contains(&a) || of.contains(&b) || of.contains(&c) {
            return;
        }
        let [p, q, r] = [a, c, b].map(|s| rings.at(s));
        let apart = p.min(q).min(r).cmpgt(high) | p.max(q).max(r).cmplt(low);
        if apart.any() || !faces([p, q, r], axis) {
            return;
        }
        let triangle = turned([a, c, b]);
        if !self.triangles.iter().any(|&(known, _)| known == triangle) {
            self.triangles.push((triangle, c));
            if let Ok(found) = alike.binary_search(&triangle) {
                alike.remove(found);
            }
        }
    }
}

/// Whether a triangle looks the way of `axis`.
pub(super) fn faces([p, q, r]: [Vec3A; 3], axis: Vec3A) -> bool {
    let normal = (q - p).cross(r - p);
    normal.dot(axis) > FACING * normal.length()
}

/// A triangle's corners, turned so that the least is the first.
pub(super) fn turned([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
