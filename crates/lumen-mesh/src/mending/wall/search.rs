//! Looks for walls: between two pieces of which one lies in the other, and in a piece that is a wall by itself.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::creases::{MAY_FACE, Sheets};
use super::visibility::{PARALLEL, Place, Visibility};
use crate::{Topology, triangle_area};

/// The tenth largest thickness of ten is at most so many times the tenth smallest.
pub const SPREAD: f64 = 4.0;
/// Pieces that are looked at, the largest, and the least part of the area that they have.
const PIECES: usize = 6;
const MIN_AREA: f64 = 0.05;
/// Places on each.
pub(super) const PLACES: usize = 256;
/// Of a sheet's places, those that must see the other side, and of the other side's those that must see it.
pub(super) const MIN_SEEN: f64 = 0.8;
const MANY_SEE: f64 = 0.6;
/// The part of a piece that must line such a space.
pub(super) const MIN_INNER: f64 = 0.15;

/// A wall with two sides.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Wall {
    /// Its thickness in mm: the median over the inner side.
    pub thickness_mm: f64,
    /// A tenth of it is thinner, in mm.
    pub thinner_mm: f64,
    /// A tenth of it is thicker, in mm.
    pub thicker_mm: f64,
    /// Whether its sides are two pieces; else they are one, joined at the rims.
    pub is_two_pieces: bool,
}

/// What a wall was found in.
#[derive(Clone, Copy, Debug)]
pub(super) struct FoundIn {
    /// The piece of which the outer side is.
    pub(super) outer: u32,
    pub(super) wall: Wall,
}

impl Visibility<'_> {
    /// Places on the pieces that are large enough, spread evenly over the area of each.
    fn places(&self) -> Vec<(u32, f64, Vec<Place>)> {
        let mut areas = vec![0.0; self.pieces.count()];
        for (t, &piece) in self.pieces.of_triangle.iter().enumerate() {
            areas[piece as usize] += triangle_area(self.mesh.corners(t));
        }
        let whole: f64 = areas.iter().sum();
        let mut large: Vec<u32> = (0..areas.len() as u32).filter(|&p| areas[p as usize] > MIN_AREA * whole).collect();
        large.sort_by(|&a, &b| areas[b as usize].total_cmp(&areas[a as usize]).then(a.cmp(&b)));
        large.truncate(PIECES);
        let mut slots = vec![None; areas.len()];
        large.iter().enumerate().for_each(|(i, &piece)| slots[piece as usize] = Some(i));
        let mut found: Vec<(u32, f64, Vec<Place>)> =
            large.iter().map(|&piece| (piece, areas[piece as usize], Vec::with_capacity(PLACES))).collect();
        let mut passed = vec![0.0; large.len()];
        for (t, &piece) in (0u32..).zip(&self.pieces.of_triangle) {
            let Some(slot) = slots[piece as usize] else { continue };
            passed[slot] += triangle_area(self.mesh.corners(t as usize));
            let (_, area, places) = &mut found[slot];
            // The first triangle at or beyond each of the marks.
            let mark = *area * (places.len() as f64 + 0.5) / PLACES as f64;
            if passed[slot] >= mark && places.len() < PLACES {
                places.extend(Place::on(self.mesh, t));
            }
        }
        found
    }

    /// Every wall among the large pieces.
    pub(super) fn walls(&self) -> Vec<FoundIn> {
        let places = self.places();
        let mut found = Vec::new();
        for (inner, inner_area, on_inner) in &places {
            for (outer, outer_area, on_outer) in &places {
                if inner != outer
                    && inner_area < outer_area
                    && let Some(wall) = self.between(*inner, on_inner, *outer, on_outer)
                {
                    found.push(FoundIn { outer: *outer, wall });
                }
            }
        }
        for (piece, _, places) in &places {
            let is_known = found.iter().any(|found| found.outer == *piece);
            if !is_known && let Some(wall) = self.within(places).or_else(|| self.creased(*piece, places)) {
                found.push(FoundIn { outer: *piece, wall });
            }
        }
        found
    }

    /// The wall between two pieces.
    fn between(&self, inner: u32, on_inner: &[Place], outer: u32, on_outer: &[Place]) -> Option<Wall> {
        let sees = |place: &Place, direction: DVec3, other: u32| {
            let (depth, triangle, cosine) = self.met(place, direction)?;
            (self.piece(triangle) == other && cosine > PARALLEL).then_some(depth)
        };
        let ways: Vec<f64> = on_inner.iter().filter_map(|place| sees(place, place.normal, outer)).collect();
        let backs = on_outer.iter().filter(|place| sees(place, -place.normal, inner).is_some()).count();
        if (ways.len() as f64) < MIN_SEEN * on_inner.len() as f64 || (backs as f64) < MANY_SEE * on_outer.len() as f64 {
            return None;
        }
        let across: Vec<f64> = on_inner.iter().filter_map(|place| Some(self.met(place, -place.normal)?.0)).collect();
        wall(ways, across, true)
    }

    /// The wall that a piece is whose sides come apart at creases.
    fn creased(&self, piece: u32, places: &[Place]) -> Option<Wall> {
        if !MAY_FACE.contains(&self.facing(places)) {
            return None;
        }
        let topology = Topology::new(self.mesh.positions.len(), &self.mesh.triangles);
        let (ways, across) = Sheets::of(self, &topology, &self.triangles_of(piece))?.across(self, places)?;
        measured(ways, across, false)
    }

    /// The wall that a piece is by itself.
    fn within(&self, places: &[Place]) -> Option<Wall> {
        let inner: Vec<&Place> = places.iter().filter(|place| self.lines_a_space(place)).collect();
        if (inner.len() as f64) < MIN_INNER * places.len() as f64 {
            return None;
        }
        let (mut ways, mut across) = (Vec::new(), Vec::new());
        for place in &inner {
            let behind = self.met(place, -place.normal).filter(|&(.., cosine)| cosine < -PARALLEL);
            let before = self.met(place, place.normal);
            let (Some((way, other_side, _)), Some((width, opposite, _))) = (behind, before) else { continue };
            let lines = |triangle| Place::on(self.mesh, triangle).is_some_and(|place| self.lines_a_space(&place));
            if !lines(other_side) && lines(opposite) {
                ways.push(way);
                across.push(width);
            }
        }
        if (ways.len() as f64) < MIN_SEEN * inner.len() as f64 {
            return None;
        }
        wall(ways, across, false)
    }
}

/// The wall of these thicknesses around a space so wide, unless they vary too much or it is too narrow.
fn wall(ways: Vec<f64>, across: Vec<f64>, is_two_pieces: bool) -> Option<Wall> {
    measured(ways, across, is_two_pieces).filter(|wall| wall.thicker_mm <= SPREAD * wall.thinner_mm)
}

/// The same, however much they vary.
fn measured(mut ways: Vec<f64>, mut across: Vec<f64>, is_two_pieces: bool) -> Option<Wall> {
    let mut at = |part: usize| {
        ways.sort_unstable_by(f64::total_cmp);
        ways.get(ways.len() * part / 10).copied()
    };
    let (thinner_mm, thickness_mm, thicker_mm) = (at(1)?, at(5)?, at(9)?);
    across.sort_unstable_by(f64::total_cmp);
    let width = across.get(across.len() / 2).copied().unwrap_or(f64::INFINITY);
    (thickness_mm < width).then_some(Wall { thickness_mm, thinner_mm, thicker_mm, is_two_pieces })
}
