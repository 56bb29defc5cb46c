//! The rings of a mesh, slot by slot, and what is cut where the surface is no disc.

use super::{Head, Rings};
use crate::decimation::fan::fans_of;
use lumen_mesh::{Topology, TriMesh};

impl Rings {
    /// Adds the rings of the next slots, as yet without feature edges, `count` of them at most; whether all have one.
    pub(in crate::decimation) fn link(&mut self, mesh: &TriMesh, topology: &Topology, count: usize) -> bool {
        let all = self.vertices as usize;
        let (mut fan, slots) = (std::mem::take(&mut self.fan), std::mem::take(&mut self.slots));
        for slot in self.heads.len()..all.min(self.heads.len() + count) {
            let v = self.nodes[slot];
            fan.load(v, topology.triangles(v), &mesh.triangles);
            let is_fan = fan.order();
            if is_fan {
                self.add(fan.entries().map(|n| slots[n as usize]), !fan.is_closed);
            } else {
                self.heads.push(Head {
                    start: self.entries.len() as u32,
                    stays: true,
                    is_gone: true,
                    ..Head::default()
                });
                if !fan.spokes.is_empty() {
                    self.complex.push(slot as u32);
                }
            }
        }
        if self.heads.len() < all {
            (self.fan, self.slots) = (fan, slots);
            return false;
        }
        let complex = std::mem::take(&mut self.complex);
        if !complex.is_empty() {
            self.cut_open(mesh, topology, &slots, &complex);
        }
        true
    }

    /// Adds the ring of the next slot.
    fn add(&mut self, ring: impl Iterator<Item = u32>, is_open: bool) {
        let start = self.entries.len() as u32;
        self.entries.extend(ring);
        let length = self.entries.len() as u32 - start;
        self.heads.push(Head { start, length, room: length, is_open, ..Head::default() });
    }

    /// Gives each fan around a complex vertex a slot of its own, which stays.
    fn cut_open(&mut self, mesh: &TriMesh, topology: &Topology, slots: &[u32], complex: &[u32]) {
        let mut is_complex = vec![false; mesh.positions.len()];
        complex.iter().for_each(|&slot| is_complex[self.nodes[slot as usize] as usize] = true);
        // The slot of each corner at a complex vertex: (triangle, vertex, slot).
        let mut corners: Vec<(u32, u32, u32)> = Vec::new();
        let mut fans: Vec<(u32, Vec<[u32; 3]>, bool)> = Vec::new();
        for &slot in complex {
            let v = self.nodes[slot as usize];
            for (i, (spokes, is_closed)) in fans_of(v, topology, &mesh.triangles).into_iter().enumerate() {
                let own = if i == 0 {
                    slot
                } else {
                    self.positions.push(self.positions[slot as usize]);
                    self.nodes.push(v);
                    self.heads.push(Head::default());
                    self.heads.len() as u32 - 1
                };
                self.cut.push((v, own));
                corners.extend(spokes.iter().map(|&[_, _, t]| (t, v, own)));
                fans.push((own, spokes, is_closed));
            }
        }
        self.cut.sort_unstable();
        corners.sort_unstable();
        let slot_at = |t: u32, n: u32| {
            if !is_complex[n as usize] {
                return slots[n as usize];
            }
            let found = corners.binary_search_by_key(&(t, n), |&(t, n, _)| (t, n));
            corners[found.expect("every corner at a cut vertex has a slot")].2
        };
        for (own, spokes, is_closed) in fans {
            let start = self.entries.len() as u32;
            self.entries.extend(spokes.iter().map(|&[a, _, t]| slot_at(t, a)));
            if !is_closed {
                self.entries.extend(spokes.last().map(|&[_, b, t]| slot_at(t, b)));
            }
            let length = self.entries.len() as u32 - start;
            self.heads[own as usize] =
                Head { start, length, room: length, is_open: !is_closed, stays: true, is_gone: false };
            // The others around know the vertex by its first slot.
            let first = slots[self.nodes[own as usize] as usize];
            for i in start..start + length {
                let n = self.entries[i as usize] as usize;
                if own != first && !self.heads[n].stays {
                    self.replace(n as u32, first, own);
                }
            }
        }
    }
}
