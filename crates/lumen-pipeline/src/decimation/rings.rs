//! The surface while it is being decimated: around each vertex the ring of its neighbours, in order.
//!
//! Two neighbours that follow each other in a ring are the far edge of a triangle, so the rings are the triangles. A
//! collapse needs no more than the rings of the two vertices and of those around them. Which triangle ends when is
//! found afterwards from the merge forest (`super::super::progressive`).
//!
//! A ring is one disc or half-disc. A vertex at which the surface is anything else is cut into a slot for each of its
//! fans; those slots stay ([`Rings::stays`]), so the surface can be put together again as it was. Slots are numbered
//! along a space-filling curve (`order.rs`): what is near is near in memory, whatever the order of the file.

mod linking;

use glam::{Vec3, Vec3A};

use super::fan::Fan;
use super::order::curve_order;
use lumen_mesh::{Bounds, TriMesh};

/// Bit of a ring's entry: the edge to that neighbour is a feature edge.
pub(super) const CREASE: u32 = 1 << 31;

/// Bit of a ring's entry: the edge to that neighbour is a border between labels.
pub(super) const BORDER: u32 = 1 << 30;

/// What an entry says of its edge.
const KIND: u32 = CREASE | BORDER;

/// Size of the surface while it is being decimated: far from where f32 under- or overflows when squared twice.
pub(super) const SIZE: f32 = 1024.0;

/// The farthest that a stray vertex may be then: squared twice, still a number.
const FARTHEST: f32 = (1 << 26) as f32;

/// Where a ring stands in the store.
#[derive(Clone, Copy, Debug, Default)]
struct Head {
    start: u32,
    length: u32,
    room: u32,
    is_open: bool,
    stays: bool,
    is_gone: bool,
}

/// A triangle surface as rings.
pub(super) struct Rings {
    /// Positions relative to the middle of the surface, in a unit that makes its size about [`SIZE`], strays not counted.
    pub(super) positions: Vec<Vec3A>,
    /// That unit in mm, a power of two.
    pub(super) unit: f32,
    heads: Vec<Head>,
    entries: Vec<u32>,
    /// The middle of the surface in mm.
    centre: Vec3,
    /// The node of the merge forest that each slot stands for: a vertex of the mesh, or one that was made.
    pub(super) nodes: Vec<u32>,
    /// How many vertices the mesh has.
    vertices: u32,
    /// Positions in mm of the nodes that were made.
    pub(super) made: Vec<Vec3>,
    /// For the slots of cut vertices, `(node, slot)`, ascending.
    cut: Vec<(u32, u32)>,
    scratch: Vec<u32>,
    has_borders: bool,
    /// No ring is longer.
    widest: u32,
    /// Until all slots have a ring: the slot of each vertex, and the slots found at which the surface is no fan.
    slots: Vec<u32>,
    complex: Vec<u32>,
    fan: Fan,
}

/// The power of two that makes the size of `most` about [`SIZE`], and that of all no more than [`FARTHEST`].
fn unit_of(most: &Bounds, all: &Bounds) -> f32 {
    let ratio = (most.longest_side() / SIZE).max(all.longest_side() / FARTHEST);
    // Without the digits after the leading one; 1 where that is no number to divide by.
    if ratio.is_normal() { f32::from_bits(ratio.to_bits() & 0x7f80_0000) } else { 1.0 }
}

/// `entry` without its bits.
pub(super) fn neighbour(entry: u32) -> u32 {
    entry & !KIND
}

impl Rings {
    /// The slots of `mesh`, as yet without rings.
    pub(super) fn new(mesh: &TriMesh) -> Self {
        let most = Bounds::of_most(&mesh.positions);
        let (centre, unit) = (most.centre(), unit_of(&most, &mesh.bounds()));
        let nodes = curve_order(&mesh.positions);
        let mut slots = vec![0; nodes.len()];
        for (slot, &v) in nodes.iter().enumerate() {
            slots[v as usize] = slot as u32;
        }
        Self {
            positions: nodes.iter().map(|&v| Vec3A::from((mesh.positions[v as usize] - centre) / unit)).collect(),
            unit,
            centre,
            heads: Vec::with_capacity(nodes.len()),
            entries: Vec::with_capacity(mesh.triangles.len() * 4),
            vertices: nodes.len() as u32,
            nodes,
            made: Vec::new(),
            cut: Vec::new(),
            scratch: Vec::new(),
            has_borders: false,
            widest: 0,
            slots,
            complex: Vec::new(),
            fan: Fan::default(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.heads.len()
    }

    pub(super) fn at(&self, v: u32) -> Vec3A {
        self.positions[v as usize]
    }

    /// Where `v` is in mm, as it stands in the mesh.
    pub(super) fn place(&self, v: u32, mesh: &TriMesh) -> Vec3 {
        let node = self.nodes[v as usize];
        match node.checked_sub(self.vertices) {
            None => mesh.positions[node as usize],
            Some(made) => self.made[made as usize],
        }
    }

    /// A place in mm as a position of this surface.
    pub(super) fn in_unit(&self, place: Vec3) -> Vec3A {
        Vec3A::from((place - self.centre) / self.unit)
    }

    /// A position of this surface in mm.
    pub(super) fn in_mm(&self, position: Vec3A) -> Vec3 {
        Vec3::from(position) * self.unit + self.centre
    }

    /// Makes of `v` a new node at `position`, and returns its number.
    pub(super) fn renew(&mut self, v: u32, position: Vec3A) -> u32 {
        let node = self.vertices + self.made.len() as u32;
        self.made.push(self.in_mm(position));
        self.nodes[v as usize] = node;
        self.positions[v as usize] = position;
        node
    }

    /// The entries of the ring around `v`, counter-clockwise seen from outside.
    pub(super) fn around(&self, v: u32) -> &[u32] {
        let head = &self.heads[v as usize];
        &self.entries[head.start as usize..(head.start + head.length) as usize]
    }

    fn around_mut(&mut self, v: u32) -> &mut [u32] {
        let head = &self.heads[v as usize];
        &mut self.entries[head.start as usize..(head.start + head.length) as usize]
    }

    /// The triangles around `v`, each as the two other corners in its winding.
    pub(super) fn pairs(&self, v: u32) -> impl Iterator<Item = [u32; 2]> + '_ {
        let ring = self.around(v);
        let closing = (!self.is_open(v)).then(|| ring.last().zip(ring.first())).flatten().map(|(&a, &b)| [a, b]);
        let inner = ring.windows(2).map(|pair| [pair[0], pair[1]]);
        inner.chain(closing).map(|pair| pair.map(neighbour))
    }

    /// Whether `v` lies on the boundary: its ring has two ends.
    pub(super) fn is_open(&self, v: u32) -> bool {
        self.heads[v as usize].is_open
    }

    /// Whether the surface has no boundary and was cut nowhere.
    pub(super) fn is_closed(&self) -> bool {
        self.heads.iter().all(|head| head.is_gone || !head.is_open && !head.stays)
    }

    /// Whether `v` must stay: the surface was cut there.
    pub(super) fn stays(&self, v: u32) -> bool {
        self.heads[v as usize].stays
    }

    /// Whether `v` has collapsed, or never was in a triangle.
    pub(super) fn is_gone(&self, v: u32) -> bool {
        self.heads[v as usize].is_gone
    }

    /// Marks the edge from `v` to its `i`-th neighbour as a feature edge, on this side.
    pub(super) fn set_crease(&mut self, v: u32, i: usize) {
        self.around_mut(v)[i] |= CREASE;
    }

    /// Marks the edge from `v` to its `i`-th neighbour as a border between labels, on this side.
    pub(super) fn set_border(&mut self, v: u32, i: usize) {
        self.around_mut(v)[i] |= BORDER;
        self.has_borders = true;
    }

    /// Whether there are borders between labels.
    pub(super) fn has_borders(&self) -> bool {
        self.has_borders
    }

    /// Whether `v` lies on one.
    pub(super) fn is_on_border(&self, v: u32) -> bool {
        self.has_borders && self.around(v).iter().any(|entry| entry & BORDER != 0)
    }

    /// Whether collapsing `v` onto `u` keeps the topology: the vertices that both touch are just those opposite their
    /// common edge, and no ring falls below a triangle (below three edges for a boundary).
    pub(super) fn may_collapse(&self, v: u32, u: u32) -> bool {
        let (of_v, of_u) = (self.around(v), self.around(u));
        let Some(j) = of_v.iter().position(|&n| neighbour(n) == u) else { return false };
        let last = of_v.len() - 1;
        let is_open = self.is_open(v);
        if is_open && j != 0 && j != last {
            return false;
        }
        // The neighbours before and after u around v: those opposite the edge.
        let before = if j > 0 { Some(j - 1) } else { (!is_open).then_some(last) };
        let after = if j < last { Some(j + 1) } else { (!is_open).then_some(0) };
        let sides = [before, after].map(|i| i.map(|i| neighbour(of_v[i])));
        let fewest = |n: u32| if self.is_open(n) { 2 } else { 3 };
        for n in sides.into_iter().flatten() {
            if self.around(n).len() - 1 < fewest(n) {
                return false;
            }
        }
        if of_u.len() + of_v.len() - 2 - sides.iter().flatten().count() < fewest(u) {
            return false;
        }
        let mut bits = 0u64;
        for &n in of_v {
            bits |= 1 << (n & 63);
        }
        let is_common = |n: u32| {
            bits & (1 << (n & 63)) != 0 && !sides.contains(&Some(n)) && of_v.iter().any(|&other| neighbour(other) == n)
        };
        if of_u.iter().any(|&n| is_common(neighbour(n))) {
            return false;
        }
        self.cut.is_empty() || !self.meets_in_a_cut(of_v, u, &sides)
    }

    /// Whether `u`, or another part of its vertex, touches a vertex of `ring` apart from `sides`, be it in other parts.
    fn meets_in_a_cut(&self, ring: &[u32], u: u32, sides: &[Option<u32>; 2]) -> bool {
        let node = |n: u32| self.nodes[neighbour(n) as usize];
        let far = |n: u32| neighbour(n) != u && !sides.contains(&Some(neighbour(n)));
        let touches = |n: u32| ring.iter().any(|&other| far(other) && node(other) == node(n));
        self.around(u).iter().any(|&n| touches(n))
            || self.stays(u) && self.parts(u).any(|part| self.around(part).iter().any(|&n| touches(n)))
    }

    /// The slots that `u`, part of a cut vertex, was cut into.
    fn parts(&self, u: u32) -> impl Iterator<Item = u32> + '_ {
        let node = self.nodes[u as usize];
        let from = self.cut.partition_point(|&(n, _)| n < node);
        self.cut[from..].iter().take_while(move |&&(n, _)| n == node).map(|&(_, slot)| slot)
    }

    /// Collapses `v` onto `u`, which [`Self::may_collapse`] has allowed.
    pub(super) fn collapse(&mut self, v: u32, u: u32) {
        let head = self.heads[v as usize];
        let (start, n) = (head.start as usize, head.length as usize);
        let j = self.position(v, u);
        // The far neighbours, in order: those that u takes over.
        let (far, count) = match (head.is_open, j) {
            (true, 0) => (2, n - 2),
            (true, _) => (0, n - 2),
            (false, _) => (j + 2, n - 3),
        };
        let mut taken = std::mem::take(&mut self.scratch);
        taken.clear();
        taken.extend((0..count).map(|i| self.entries[start + (far + i) % n]));
        let sides = if head.is_open {
            [Some(if j == 0 { 1 } else { n - 2 }), None]
        } else {
            [Some((j + 1) % n), Some((j + n - 1) % n)]
        };
        for side in sides.into_iter().flatten() {
            let entry = self.entries[start + side];
            let w = neighbour(entry);
            if entry & KIND != 0 {
                // The feature edge v-w becomes u-w.
                let (of_u, of_w) = (self.position(u, w), self.position(w, u));
                self.around_mut(u)[of_u] |= entry & KIND;
                self.around_mut(w)[of_w] |= entry & KIND;
            }
            let i = self.position(w, v);
            let ring = self.around_mut(w);
            for k in i + 1..ring.len() {
                ring[k - 1] = ring[k];
            }
            self.heads[w as usize].length -= 1;
        }
        for &entry in &taken {
            self.replace(neighbour(entry), v, u);
        }
        self.splice(u, v, &taken);
        self.scratch = taken;
        let head = &mut self.heads[v as usize];
        head.is_gone = true;
        head.length = 0;
    }

    /// Where `n` stands in the ring around `v`.
    fn position(&self, v: u32, n: u32) -> usize {
        let found = self.around(v).iter().position(|&entry| neighbour(entry) == n);
        found.expect("neighbours know each other")
    }

    /// Puts `new` where `old` stands in the ring around `v`; the edge keeps its kind.
    fn replace(&mut self, v: u32, old: u32, new: u32) {
        if let Some(entry) = self.around_mut(v).iter_mut().find(|entry| neighbour(**entry) == old) {
            *entry = new | (*entry & KIND);
        }
    }

    /// Puts `taken` where `v` stands in the ring around `u`.
    fn splice(&mut self, u: u32, v: u32, taken: &[u32]) {
        let k = self.position(u, v);
        let head = self.heads[u as usize];
        let (start, old) = (head.start as usize, head.length as usize);
        let length = old - 1 + taken.len();
        let end = start + old;
        if length > head.room as usize {
            let room = length + length / 2;
            let moved = self.entries.len();
            self.entries.resize(moved + room, 0);
            let (before, after) = self.entries.split_at_mut(moved);
            let ring = before[start..start + k].iter().chain(taken).chain(&before[start + k + 1..end]);
            after.iter_mut().zip(ring).for_each(|(to, from)| *to = *from);
            let head = &mut self.heads[u as usize];
            (head.start, head.room) = (moved as u32, room as u32);
        } else {
            let ring = &mut self.entries[start..start + old.max(length)];
            if taken.is_empty() {
                for i in k + 1..old {
                    ring[i - 1] = ring[i];
                }
            } else {
                for i in (k + 1..old).rev() {
                    ring[i + taken.len() - 1] = ring[i];
                }
                for (i, &entry) in taken.iter().enumerate() {
                    ring[k + i] = entry;
                }
            }
        }
        self.heads[u as usize].length = length as u32;
        self.widest = self.widest.max(length as u32);
    }

    /// A length that no ring exceeds, once they are numbered.
    pub(super) fn widest(&self) -> usize {
        self.widest as usize
    }

    /// Renumbers the slots that are left, in their order, and returns those that were kept.
    pub(super) fn compact(&mut self) -> Vec<u32> {
        let kept: Vec<u32> = (0..self.heads.len() as u32).filter(|&v| !self.is_gone(v)).collect();
        let mut new = vec![0; self.heads.len()];
        kept.iter().enumerate().for_each(|(i, &v)| new[v as usize] = i as u32);
        let mut entries = Vec::with_capacity(kept.len() * 8);
        let mut heads = Vec::with_capacity(kept.len());
        for &v in &kept {
            let start = entries.len() as u32;
            entries.extend(self.around(v).iter().map(|&entry| new[neighbour(entry) as usize] | (entry & KIND)));
            let head = self.heads[v as usize];
            heads.push(Head { start, room: head.length, ..head });
        }
        self.widest = heads.iter().map(|head| head.length).max().unwrap_or(0);
        (self.entries, self.heads) = (entries, heads);
        self.positions = gather(&self.positions, &kept);
        self.nodes = gather(&self.nodes, &kept);
        self.cut.iter_mut().for_each(|(_, slot)| *slot = new[*slot as usize]);
        kept
    }

    /// Checks every promise of the structure; for tests.
    #[cfg(test)]
    pub(super) fn assert_well_formed(&self) {
        let slots = (0..self.len() as u32).filter(|&v| !self.is_gone(v));
        for v in slots {
            let ring: Vec<u32> = self.around(v).iter().map(|&entry| neighbour(entry)).collect();
            assert!(ring.iter().all(|&n| !self.is_gone(n) && n != v));
            // Known once the slots are numbered.
            assert!(self.widest == 0 || ring.len() <= self.widest());
            if !self.stays(v) {
                let least = if self.is_open(v) { 2 } else { 3 };
                assert!(ring.len() >= least, "{} around {v}", ring.len());
                let mut distinct = ring.clone();
                distinct.sort_unstable();
                distinct.dedup();
                assert_eq!(distinct.len(), ring.len(), "each neighbour of {v} stands in its ring once");
            }
            for [a, b] in self.pairs(v) {
                assert!(self.pairs(a).any(|pair| pair == [b, v]), "{a} knows its triangle with {b} and {v}");
                assert!(self.pairs(b).any(|pair| pair == [v, a]), "{b} knows its triangle with {v} and {a}");
            }
        }
    }
}

/// The values of the slots in `kept`.
pub(super) fn gather<T: Copy>(values: &[T], kept: &[u32]) -> Vec<T> {
    kept.iter().map(|&v| values[v as usize]).collect()
}

#[cfg(test)]
mod tests;
