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
    /// For each leaf the last walk that asked for it: its number until it comes by, one more where the leaf is part of the
    /// sheet.
    marks: Vec<u32>,
    walk: u32,
    /// The leaves beside each leaf: `beside[offsets[leaf]..offsets[leaf + 1]]`.
    offsets: Vec<u32>,
    beside: Vec<u32>,
    queue: Vec<u32>,
    /// The triangles of a sheet around a collapse, and the corner of each beyond the side that led there.
    triangles: Vec<([u32; 3], u32)>,
    /// Which of the triangles that look alike are not on it.
    kept: Vec<bool>,
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

    /// Strikes out of `near`, the leaves that overlap the box of `patch`, those that are one sheet with `leaf`, whose patch it
    /// is: those that look the same way, and that it hangs together with by such leaves.
    pub(super) fn strike_out(&mut self, tree: &Tree, leaf: u32, patch: &Patch, near: &mut Vec<u32>) {
        if !patch.is_one_sided() {
            return;
        }
        self.walk += 2;
        near.iter().for_each(|&other| self.marks[other as usize] = self.walk);
        let mut left = near.len() - usize::from(self.marks[leaf as usize] == self.walk);
        self.marks[leaf as usize] = self.walk + 1;
        self.queue.clear();
        self.queue.push(leaf);
        while let Some(at) = self.queue.pop().filter(|_| left > 0) {
            for &next in &self.beside[self.offsets[at as usize] as usize..self.offsets[at as usize + 1] as usize] {
                let mark = &mut self.marks[next as usize];
                if *mark != self.walk {
                    continue;
                }
                left -= 1;
                if patch.looks_as(tree.leaf(next)) {
                    *mark = self.walk + 1;
                    self.queue.push(next);
                } else {
                    *mark = 0;
                }
            }
        }
        near.retain(|&other| self.marks[other as usize] != self.walk + 1);
    }

    /// Strikes out of `alike`, ascending triangles with their least corner first, those of the sheet around a collapse: what
    /// looks as `axis` does and hangs together, by edges, with the stars of `of`, as far as it reaches into the box.
    pub(super) fn follow(
        &mut self,
        rings: &Rings,
        of: [u32; 2],
        axis: Vec3A,
        corners: (Vec3A, Vec3A),
        alike: &mut Vec<[u32; 3]>,
    ) {
        self.triangles.clear();
        self.kept.clear();
        self.kept.resize(alike.len(), true);
        let mut walk = Walk { rings, of, axis, corners, alike, left: alike.len(), bits: 0 };
        let [v, u] = of;
        for centre in [Some(v), (u != v).then_some(u)].into_iter().flatten() {
            for side in rings.pairs(centre) {
                walk.step(side, &mut self.triangles, &mut self.kept);
            }
        }
        let mut at = 0;
        while at < self.triangles.len() && self.triangles.len() < MAX_LEAVES && walk.left > 0 {
            let ([a, b, c], apex) = self.triangles[at];
            at += 1;
            // The third side is the one that led here.
            for side in [[a, b], [b, c], [c, a]].into_iter().filter(|side| side.contains(&apex)) {
                walk.step(side, &mut self.triangles, &mut self.kept);
            }
        }
        let mut kept = self.kept.iter();
        alike.retain(|_| kept.next() == Some(&true));
    }
}

/// A walk over the sheet around a collapse.
struct Walk<'a> {
    rings: &'a Rings,
    of: [u32; 2],
    axis: Vec3A,
    corners: (Vec3A, Vec3A),
    alike: &'a [[u32; 3]],
    /// How many of `alike` it has not come by.
    left: usize,
    /// A bit for each triangle that it came by, others may have the same.
    bits: u64,
}

impl Walk<'_> {
    /// Adds the triangle beyond a side to `known`, if it is part of the sheet, and strikes it out of those kept.
    fn step(&mut self, [a, b]: [u32; 2], known: &mut Vec<([u32; 3], u32)>, kept: &mut [bool]) {
        // It runs from b to a.
        let ring = self.rings.around(a);
        let Some(at) = ring.iter().position(|&entry| neighbour(entry) == b) else { return };
        let before = if at > 0 { ring.get(at - 1) } else { ring.last().filter(|_| !self.rings.is_open(a)) };
        let Some(c) = before.map(|&entry| neighbour(entry)) else { return };
        if [a, b, c].iter().any(|corner| self.of.contains(corner)) {
            return;
        }
        let triangle = turned([a, c, b]);
        let bit = 1 << ((a ^ b ^ c) & 63);
        if self.bits & bit != 0 && known.iter().any(|&(other, _)| other == triangle) {
            return;
        }
        let [p, q, r] = [a, c, b].map(|s| self.rings.at(s));
        let (low, high) = self.corners;
        let apart = p.min(q).min(r).cmpgt(high) | p.max(q).max(r).cmplt(low);
        if apart.any() || !faces([p, q, r], self.axis) {
            return;
        }
        self.bits |= bit;
        known.push((triangle, c));
        if let Ok(found) = self.alike.binary_search(&triangle) {
            kept[found] = false;
            self.left -= 1;
        }
    }
}

/// Whether a triangle looks the way of `axis`.
#[inline]
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
