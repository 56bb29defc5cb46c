//! Keeps triangles from running into each other: no collapse may make one cross a triangle that its input did not cross.
//!
//! Neighbouring slots are neighbours in space (`order.rs`), so a few of them at a time are a leaf: a box around their
//! triangles and a cone around these triangles' normals (`tree.rs`). Two leaves whose cones lie within a half-space and
//! that are parts of one sheet cannot run into each other as long as both keep to their cones (Volino and
//! Magnenat-Thalmann, "Efficient self-collision detection on smoothly discretized surface animations using geometrical
//! shape regularity", 1994). Within one closed surface all that look the same way may count as one sheet: two of its
//! sheets that do have a third between them that looks the other way. Where it is open or has several pieces, they have
//! to hang together (`sheet.rs`). What remains are pairs of leaves that are near each other and no sheet: the two walls
//! of a thin vessel, neighbouring vessels, a fold, one vessel in another. They are found once for every few collapses,
//! with room to grow (`pairs.rs`); a leaf that outgrows its box or its cone looks for its pairs anew.
//!
//! A collapse then asks the pairs of the leaf it happens in, and most have none near. Where boxes do overlap, triangles
//! are tested one by one (`crossings.rs`). A surface may enter with crossings: then a collapse is allowed if it leaves no
//! more triangles that cross than it found. None is allowed among more than [`MAX_NEAR`] triangles, or beside a vertex at
//! which more than [`MAX_FAN`] meet.

mod crossings;
mod pairs;
mod sheet;
#[cfg(test)]
mod tests;
mod tree;

use glam::Vec3A;

use self::pairs::Pairs;
use self::sheet::{FACING, Sheet, faces, turned};
use self::tree::{Leaves, Patch, SLACK, Tree, angle};
use super::one_ring::OneRing;
use super::rings::{Rings, SIZE, neighbour};
use lumen_mesh::TriMesh;
use lumen_mesh::crossing::Face;

/// Room for a leaf to grow, in mean edge lengths.
const MARGIN: f32 = 1.5;
/// Most leaves, and most triangles, that a collapse is tested against.
const MAX_NEAR: usize = 1 << 15;
/// Where more leaves than this are near, so many of them are tested first, then as many times more: they may be enough to refuse.
const TANGLED: usize = 64;
const FIRST: usize = 8;
/// A vertex beside one at which more triangles meet than this stays: each would have to be asked.
const MAX_FAN: usize = 1 << 12;
/// A leaf that overlaps more leaves than this counts as one that is crowded, whichever of them are one sheet with it.
const MAX_SHEET: usize = 1 << 12;
/// Slots, and leaves, that are worked on in one piece when a guard starts.
const SLOTS: usize = 1 << 12;
const LEAVES: usize = 1 << 9;

/// How far a guard has come to know the surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Stage {
    /// Slots are put into leaves.
    #[default]
    Leaves,
    /// Leaves find what is beside them, where that is asked for.
    Sheets,
    /// Leaves find their pairs.
    Pairs,
    Ready,
}

/// See the head of the file.
#[derive(Default)]
pub(super) struct Guard {
    stage: Stage,
    /// Whether the surface is one piece, closed, and nowhere cut.
    is_closed: bool,
    leaves: Leaves,
    tree: Tree,
    pairs: Pairs,
    sheet: Sheet,
    /// Corners of the boxes around the leaves' triangles as they are now.
    boxes: Vec<[Vec3A; 2]>,
    /// Mean length of an edge, and the room that leaves have to grow.
    edge: f32,
    margin: f32,
    near: Vec<u32>,
    /// For each leaf the last search that knew it.
    marks: Vec<u32>,
    mark: u32,
    found: Vec<[u32; 3]>,
    alike: Vec<[u32; 3]>,
    /// How many tests of boxes and triangles were made, about.
    effort: usize,
}

/// A collapse to be judged: `v` goes to `u`, which moves to `place` if there is one; the stars are theirs.
pub(super) struct Planned<'a> {
    pub(super) v: u32,
    pub(super) u: u32,
    /// Where `u` stands in the ring of `v`.
    pub(super) to: usize,
    /// Where `u` will be, relative to the middle of the rings.
    pub(super) end: Vec3A,
    pub(super) star: &'a OneRing,
    /// Of `u`, and where `v` stands in it: only if `u` moves.
    pub(super) other: Option<(&'a OneRing, usize)>,
}

impl Planned<'_> {
    /// The slots whose triangles go, or are others afterwards.
    fn centres(&self) -> impl Iterator<Item = u32> {
        std::iter::once(self.v).chain(self.other.is_some().then_some(self.u))
    }

    /// Whether a slot is one of these.
    fn is_centre(&self, slot: u32) -> bool {
        slot == self.v || self.other.is_some() && slot == self.u
    }

    /// The triangles that go or change, each once, and what becomes of them.
    fn faces(&self, rings: &Rings, mesh: &TriMesh) -> [Vec<Face>; 2] {
        let Self { v, u, .. } = *self;
        let moves = self.other.is_some();
        let end = if moves { rings.in_mm(self.end) } else { rings.place(u, mesh) };
        // Around v all, around u the others, where it moves.
        let of_u = rings.pairs(u).filter(|pair| moves && !pair.contains(&v)).map(|[a, b]| [u, a, b]);
        let old: Vec<[u32; 3]> = rings.pairs(v).map(|[a, b]| [v, a, b]).chain(of_u).collect();
        let lives = |corners: &&[u32; 3]| !(corners.contains(&u) && corners.contains(&v));
        let after = |&corners: &[u32; 3]| {
            let is_end = corners.map(|slot| slot == u || slot == v);
            let mut face = face(corners.map(|slot| if slot == v { u } else { slot }), rings, mesh);
            face.corners.iter_mut().zip(is_end).filter(|(_, is_end)| *is_end).for_each(|(corner, _)| *corner = end);
            face
        };
        let new = old.iter().filter(lives).map(after).collect();
        [old.into_iter().map(|corners| face(corners, rings, mesh)).collect(), new]
    }
}

/// A triangle of slots.
fn face(corners: [u32; 3], rings: &Rings, mesh: &TriMesh) -> Face {
    Face { vertices: corners.map(|s| rings.nodes[s as usize]), corners: corners.map(|s| rings.place(s, mesh)) }
}

impl Guard {
    /// Starts over the surface as it is now; [`Self::advance`] goes on. It `is_closed` if it is one piece without a
    /// boundary and without a cut.
    pub(super) fn start(&mut self, rings: &Rings, is_closed: bool) {
        let edge = mean_edge(rings);
        let leaves = Leaves::new(rings.len(), !is_closed);
        *self = Self { is_closed, leaves, edge, margin: MARGIN * edge, effort: self.effort, ..Self::default() };
    }

    /// Starts anew over the surface as it is now.
    pub(super) fn restart(&mut self, rings: &Rings) {
        self.start(rings, self.is_closed);
    }

    /// Goes on to know the surface, for about a millisecond; whether it does.
    pub(super) fn advance(&mut self, rings: &Rings, star: &mut OneRing) -> bool {
        match self.stage {
            Stage::Leaves => {
                if self.leaves.advance(rings, star, self.edge, SLOTS) {
                    self.plant();
                    self.stage = if self.is_closed { Stage::Pairs } else { Stage::Sheets };
                }
            }
            Stage::Sheets => {
                let end = self.leaves.len().min(self.sheet.len() + 4 * LEAVES);
                (self.sheet.len()..end).for_each(|_| self.sheet.add_leaf(rings, &self.leaves));
                if end == self.leaves.len() {
                    self.stage = Stage::Pairs;
                }
            }
            Stage::Pairs => {
                let end = self.leaves.len().min(self.pairs.len() + LEAVES);
                for leaf in self.pairs.len()..end {
                    self.find_pairs(leaf as u32);
                }
                if end == self.leaves.len() {
                    self.stage = Stage::Ready;
                }
            }
            Stage::Ready => {}
        }
        self.is_ready()
    }

    /// Whether it knows the surface; before, nothing may be asked of it.
    pub(super) fn is_ready(&self) -> bool {
        self.stage == Stage::Ready
    }

    /// How much was done since this was last asked, in tests of two boxes or triangles, about.
    pub(super) fn take_effort(&mut self) -> usize {
        std::mem::take(&mut self.effort)
    }

    /// Makes the tree of the leaves, which get room to grow.
    fn plant(&mut self) {
        let mut patches = std::mem::take(&mut self.leaves.patches);
        self.boxes = patches.iter().map(|leaf| [leaf.low, leaf.high]).collect();
        for leaf in &mut patches {
            if leaf.low.x <= leaf.high.x {
                leaf.low -= self.margin;
                leaf.high += self.margin;
            }
            leaf.widen_by(SLACK);
        }
        self.marks = vec![0; patches.len()];
        self.tree = Tree::new(patches);
    }

    /// Finds the first pairs of a leaf.
    fn find_pairs(&mut self, leaf: u32) {
        let patch = *self.tree.leaf(leaf);
        let mut near = std::mem::take(&mut self.near);
        near.clear();
        if self.is_closed {
            self.tree.leaves_near((patch.low, patch.high), &mut near, pairs::MAX_PAIRS, |other| patch.looks_as(other));
        } else {
            self.tree.leaves_near((patch.low, patch.high), &mut near, MAX_SHEET, |_| false);
            if near.len() <= MAX_SHEET {
                self.sheet.strike_out(&self.tree, leaf, &patch, &mut near);
            }
        }
        self.effort += near.len();
        self.pairs.add_leaf(&near);
        self.near = near;
    }

    /// Sees to it that the leaf has room for a box, and its cone for a cosine, and that it knows its pairs then.
    fn grow(&mut self, leaf: u32, low: Vec3A, high: Vec3A, cosine: f32) {
        let mut patch = *self.tree.leaf(leaf);
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
        self.tree.grow(leaf, patch);
        self.find_later_pairs(leaf, &patch);
    }

    /// Adds the pairs of a leaf that are not known yet.
    fn find_later_pairs(&mut self, leaf: u32, patch: &Patch) {
        let mut near = std::mem::take(&mut self.near);
        near.clear();
        self.tree.leaves_near((patch.low, patch.high), &mut near, usize::MAX, |_| false);
        self.effort += near.len();
        if self.is_closed {
            near.retain(|&other| !patch.looks_as(self.tree.leaf(other)));
        } else {
            self.sheet.strike_out(&self.tree, leaf, patch, &mut near);
        }
        let is_crowded = self.pairs.is_crowded(leaf);
        self.mark += 1;
        if !is_crowded {
            self.pairs.of(leaf).for_each(|other| self.marks[other as usize] = self.mark);
        }
        for &other in &near {
            if self.marks[other as usize] == self.mark {
                continue;
            }
            self.pairs.add(leaf, other);
            if other != leaf && !(is_crowded && self.pairs.knows(other, leaf)) {
                self.pairs.add(other, leaf);
            }
        }
        self.near = near;
    }

    /// Whether the collapse makes no crossing that was not there.
    pub(super) fn allows(&mut self, rings: &Rings, mesh: &TriMesh, planned: &Planned) -> bool {
        let Planned { v, u, star, .. } = *planned;
        let is_wide = |&entry: &u32| rings.around(neighbour(entry)).len() > MAX_FAN;
        if rings.widest() > MAX_FAN && star.entries().iter().any(is_wide) {
            return false;
        }
        let p = rings.at(v);
        let [mut low, mut high] = star.reach().map(|corner| corner + p);
        low = low.min(planned.end);
        high = high.max(planned.end);
        if let Some((other, _)) = planned.other {
            let [least, most] = other.reach().map(|corner| corner + rings.at(u));
            low = low.min(least);
            high = high.max(most);
        }
        let leaf = self.leaves.of(u);
        let axis = self.tree.leaf(leaf).axis;
        let mut cosine = star.least_cosine(planned.end - p, planned.to, axis);
        if let Some((other, at)) = planned.other {
            cosine = cosine.min(other.least_cosine(planned.end - rings.at(u), at, axis));
        }
        self.grow(leaf, low, high, cosine);
        let [least, most] = &mut self.boxes[leaf as usize];
        (*least, *most) = (least.min(low), most.max(high));
        let reach = (planned.end - low).max(high - planned.end).max_element();
        let reaches = &mut self.leaves.reaches[leaf as usize];
        *reaches = reaches.max(reach);
        let axis = (cosine > FACING).then_some(axis);
        let Some(near) = self.leaves_with(leaf, (low, high)) else { return false };
        let allowed = near.is_empty() || self.crossings_allow(rings, mesh, planned, &near, (low, high), axis);
        self.near = near;
        allowed
    }

    /// The pairs of a leaf whose triangles may reach into a box; `None` where a crowded leaf has more than [`MAX_NEAR`].
    fn leaves_with(&mut self, leaf: u32, (low, high): (Vec3A, Vec3A)) -> Option<Vec<u32>> {
        let mut near = std::mem::take(&mut self.near);
        near.clear();
        let boxes = &self.boxes;
        let reaches_in = |&other: &u32| {
            let [least, most] = boxes[other as usize];
            (least.cmple(high) & most.cmpge(low)).all()
        };
        if self.pairs.is_crowded(leaf) {
            self.tree.leaves_near((low, high), &mut near, MAX_NEAR, |_| false);
            self.effort += near.len();
            if near.len() > MAX_NEAR {
                self.near = near;
                return None;
            }
            near.retain(reaches_in);
        } else {
            near.extend(self.pairs.of(leaf).filter(reaches_in));
            self.effort += near.len();
        }
        Some(near)
    }

    /// [`Self::allows`], triangle by triangle, against those of the leaves in `near`. All new triangles look the way of
    /// `axis`, if there is one.
    fn crossings_allow(
        &mut self,
        rings: &Rings,
        mesh: &TriMesh,
        planned: &Planned,
        near: &[u32],
        corners: (Vec3A, Vec3A),
        axis: Option<Vec3A>,
    ) -> bool {
        // In a tangle, where each way is refused, the first of them say so.
        let mut first = FIRST;
        while near.len() > TANGLED && first < near.len() {
            self.gather(rings, planned, &near[..first], corners, axis);
            let [old, new] = planned.faces(rings, mesh);
            let others = self.found_faces(rings, mesh);
            self.effort += others.len() * new.len();
            if crossings::newly_hit(&old, &new, &others).is_none() {
                return false;
            }
            first *= FIRST;
        }
        self.gather(rings, planned, near, corners, axis);
        if self.found.is_empty() && axis.is_some() {
            return true;
        }
        if axis.is_some() {
            self.gather_beyond_folds(rings, planned);
        }
        if self.found.len() > MAX_NEAR {
            return false;
        }
        let [old, new] = planned.faces(rings, mesh);
        let others = self.found_faces(rings, mesh);
        self.effort += others.len() * new.len();
        if !crossings::any(&new, &others) {
            return true;
        }
        self.effort += others.len() * old.len();
        crossings::are_no_more(&old, &new, &others)
    }

    /// The triangles in `found`.
    fn found_faces(&self, rings: &Rings, mesh: &TriMesh) -> Vec<Face> {
        self.found.iter().map(|&corners| face(corners, rings, mesh)).collect()
    }

    /// Where `found` has a triangle at a vertex of a collapse's rim, the surface folds there, and what looks the same way
    /// beyond the fold is no part of the sheet: it adds all triangles at that vertex. The fold itself may share an edge with
    /// what runs through it, by which the two never cross.
    fn gather_beyond_folds(&mut self, rings: &Rings, planned: &Planned) {
        let around = planned.centres().flat_map(|centre| rings.around(centre));
        let mut rim: Vec<u32> =
            around.map(|&entry| neighbour(entry)).filter(|&slot| !planned.is_centre(slot)).collect();
        rim.sort_unstable();
        let corners = self.found.iter().flatten().copied();
        let mut folds: Vec<u32> = corners.filter(|slot| rim.binary_search(slot).is_ok()).collect();
        folds.sort_unstable();
        folds.dedup();
        if folds.is_empty() {
            return;
        }
        for &slot in &folds {
            let beyond = rings.pairs(slot).filter(|pair| !pair.iter().any(|&other| planned.is_centre(other)));
            self.found.extend(beyond.map(|[a, b]| turned([slot, a, b])));
        }
        self.found.sort_unstable();
        self.found.dedup();
    }

    /// Puts into `found` the triangles of the leaves in `near` that reach into the box of a collapse and do not go with
    /// it, without those of its own sheet; far more than [`MAX_NEAR`] need not all be there.
    fn gather(
        &mut self,
        rings: &Rings,
        planned: &Planned,
        near: &[u32],
        (low, high): (Vec3A, Vec3A),
        axis: Option<Vec3A>,
    ) {
        self.found.clear();
        self.alike.clear();
        self.mark += 1;
        near.iter().for_each(|&leaf| self.marks[leaf as usize] = self.mark);
        // Whether a triangle is found at this corner already.
        let is_seen = |slot: u32, p: Vec3A| {
            let leaf = self.leaves.of(slot);
            let reach = Vec3A::splat(self.leaves.reaches[leaf as usize]);
            self.marks[leaf as usize] == self.mark && !(p.cmpgt(high + reach) | p.cmplt(low - reach)).any()
        };
        for &leaf in near {
            if self.found.len().max(self.alike.len()) > 4 * MAX_NEAR {
                break;
            }
            let reach = Vec3A::splat(self.leaves.reaches[leaf as usize]);
            let (lowest, highest) = (low - reach, high + reach);
            for &s in self.leaves.slots(leaf) {
                let p = rings.at(s);
                if (p.cmpgt(highest) | p.cmplt(lowest)).any() || planned.is_centre(s) {
                    continue;
                }
                let mut ring = rings.around(s).iter().map(|&entry| neighbour(entry));
                let first = if rings.is_open(s) { ring.next() } else { ring.clone().next_back() };
                let Some(mut a) = first else { continue };
                let mut q = rings.at(a);
                for b in ring {
                    let r = rings.at(b);
                    let apart = p.min(q).min(r).cmpgt(high) | p.max(q).max(r).cmplt(low);
                    let is_out = apart.any()
                        || planned.is_centre(a)
                        || planned.is_centre(b)
                        || a < s && is_seen(a, q)
                        || b < s && is_seen(b, r);
                    if !is_out {
                        if axis.is_none_or(|axis| !faces([p, q, r], axis)) {
                            self.found.push(turned([s, a, b]));
                        } else if !self.is_closed {
                            self.alike.push(turned([s, a, b]));
                        }
                    }
                    (a, q) = (b, r);
                }
            }
        }
        if let Some(axis) = axis.filter(|_| !self.alike.is_empty()) {
            self.alike.sort_unstable();
            let of = [planned.v, if planned.other.is_some() { planned.u } else { planned.v }];
            self.sheet.follow(rings, of, axis, (low, high), &mut self.alike);
            self.found.append(&mut self.alike);
        }
    }
}

/// Mean length of an edge: of one at every few vertices, without those to a stray vertex, which are longer than all else.
fn mean_edge(rings: &Rings) -> f32 {
    const STEP: usize = 16;
    let (mut sum, mut count) = (0.0, 0u32);
    for v in (0..rings.len() as u32).step_by(STEP) {
        if let Some(&n) = rings.around(v).first() {
            let length = rings.at(v).distance(rings.at(neighbour(n)));
            if length < 2.0 * SIZE {
                sum += f64::from(length);
                count += 1;
            }
        }
    }
    if count > 0 { (sum / f64::from(count)) as f32 } else { 0.0 }
}
