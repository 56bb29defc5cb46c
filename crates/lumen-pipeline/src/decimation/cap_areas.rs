//! What caps may lose of their area: a rim of fewer vertices has less within.
//!
//! A collapse along a rim takes a triangle from the cap, or gives it one. What all of them come to is kept for each cap; a
//! collapse that would bring it beyond [`SPENT`] of the cap's area is not made.

use glam::Vec3A;

use super::rings::{BORDER, Rings, gather, neighbour};
use lumen_mesh::FlatCap;

/// The part of a cap's area that decimation may take or give: less than half a percent, with what rounding does.
pub const SPENT: f32 = 0.004;

/// A cap, in the unit of the rings.
struct Cap {
    normal: Vec3A,
    middle: Vec3A,
    /// What has been given to its area, less what was taken.
    change: f32,
    /// How large that may be, either way.
    most: f32,
}

/// The caps of a surface under collapses.
#[derive(Default)]
pub(super) struct CapAreas {
    caps: Vec<Cap>,
    /// For each slot the number of the cap on whose rim it is, from 1 on; 0 on none. Empty without caps.
    of_slot: Vec<u32>,
}

impl CapAreas {
    /// Of `caps` of the surface that `rings` were made from, none of whose vertices is gone yet.
    pub(super) fn new(caps: &[FlatCap], rings: &Rings) -> Self {
        if caps.is_empty() {
            return Self::default();
        }
        let vertices = rings.nodes.iter().max().map_or(0, |&last| last as usize + 1);
        let mut of_vertex = vec![0; vertices];
        for (i, cap) in caps.iter().enumerate() {
            cap.rim.iter().filter(|&&v| (v as usize) < vertices).for_each(|&v| of_vertex[v as usize] = i as u32 + 1);
        }
        let unit = f64::from(rings.unit);
        let in_unit = |cap: &FlatCap| Cap {
            normal: cap.normal.as_vec3a(),
            middle: rings.in_unit(cap.centre.as_vec3()),
            change: 0.0,
            most: SPENT * (cap.area_mm2 / (unit * unit)) as f32,
        };
        let of_slot = rings.nodes.iter().map(|&node| of_vertex[node as usize]).collect();
        Self { caps: caps.iter().map(in_unit).collect(), of_slot }
    }

    /// The cap on whose rim `v` and `u` both are, and by how much its area grows where `v` goes to `u` and that to `end`.
    fn change(&self, rings: &Rings, v: u32, u: u32, end: Vec3A) -> Option<(usize, f32)> {
        let number = *self.of_slot.get(v as usize)?;
        if number == 0 || self.of_slot.get(u as usize) != Some(&number) {
            return None;
        }
        let beyond = |of: u32, not: u32| {
            let on_rim = rings.around(of).iter().filter(|&&entry| entry & BORDER != 0);
            on_rim.map(|&entry| neighbour(entry)).find(|&n| n != not)
        };
        let (i, cap) = (number as usize - 1, self.caps.get(number as usize - 1)?);
        let [a, b] = [beyond(v, u)?, beyond(u, v)?].map(|n| rings.at(n));
        let [from, to] = [v, u].map(|n| rings.at(n));
        let triangle = |p: Vec3A, q: Vec3A, r: Vec3A| (q - p).cross(r - p).dot(cap.normal) / 2.0;
        // Whichever way round the rim the vertex goes.
        let way = triangle(cap.middle, from, to).signum();
        Some((i, way * (triangle(a, end, b) - triangle(a, from, to) - triangle(a, to, b))))
    }

    /// Whether no cap loses or gains too much where `v` goes to `u` and that to `end`.
    pub(super) fn allow(&self, rings: &Rings, v: u32, u: u32, end: Vec3A) -> bool {
        let spends = |(i, change): (usize, f32)| (self.caps[i].change + change).abs() <= self.caps[i].most;
        self.change(rings, v, u, end).is_none_or(spends)
    }

    /// Hears that they go.
    pub(super) fn spend(&mut self, rings: &Rings, v: u32, u: u32, end: Vec3A) {
        if let Some((i, change)) = self.change(rings, v, u, end) {
            self.caps[i].change += change;
        }
    }

    /// Drops the slots that are gone.
    pub(super) fn compact(&mut self, kept: &[u32]) {
        if !self.of_slot.is_empty() {
            self.of_slot = gather(&self.of_slot, kept);
        }
    }
}
