//! Takes the lumen out of walls that were found: tells the inner side of each from its outer side and its rims.

use super::creases::Sheets;
use super::regions::{Regions, across};
use super::search::{FoundIn, PLACES};
use super::visibility::{PARALLEL, Place, Visibility};
use super::{CHUNK, Lumen};
use crate::parallel;
use crate::{Blend, Topology, compacted, used_vertices};

/// A wall of a piece may be so many times its usual thickness.
const THICKEST: f64 = 3.0;
/// Of the places on a sheet that was found, those that line a closed space: more make it the inner side, fewer the outer.
pub(super) const INNER: f64 = 0.6;
pub(super) const OUTER: f64 = 0.4;
/// A sheet ends where it bends by more than 60 degrees, as at a rim: the cosine.
const SMOOTH: f64 = 0.5;
/// Triangles of a sheet that are asked one by one, at most.
const MAX_ASKED: usize = 200_000;
/// A sheet has this part of its piece's triangles at least.
pub(super) const MIN_SHEET: f64 = 0.01;

/// What becomes of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
enum SideChange {
    Stays,
    /// It is of the inner side, and faces the lumen.
    Turns,
    Goes,
}

impl Visibility<'_> {
    /// Whether behind a triangle of a piece that is a wall by itself the other side is.
    pub(super) fn is_walled(&self, triangle: u32, found: &[FoundIn]) -> bool {
        let piece = self.piece(triangle);
        let own = found.iter().find(|found| found.outer == piece && !found.wall.is_two_pieces);
        let (Some(FoundIn { wall, .. }), Some(place)) = (own, Place::on(self.mesh, triangle)) else { return false };
        let farthest = THICKEST * wall.thicker_mm;
        let met = self.index.first_met(place.point, -place.normal, farthest, triangle);
        met.and_then(|(_, other)| Place::on(self.mesh, other))
            .is_some_and(|other| self.piece(other.triangle) == piece && other.normal.dot(place.normal) < -PARALLEL)
    }

    /// The surface without the outer sides and the rims; `None` where the sides of a piece cannot be told apart.
    pub(super) fn lumen(&self, found: &[FoundIn], is_walled: &[bool]) -> Option<Lumen> {
        let mut change = vec![SideChange::Stays; self.mesh.triangles.len()];
        for &FoundIn { outer, wall } in found {
            if wall.is_two_pieces {
                for (change, &piece) in change.iter_mut().zip(&self.pieces.of_triangle) {
                    if piece == outer {
                        *change = SideChange::Goes;
                    }
                }
            } else {
                self.part(outer, is_walled, &mut change)?;
            }
        }
        let kept: Vec<u32> =
            (0u32..).zip(&change).filter(|(_, change)| **change != SideChange::Goes).map(|(t, _)| t).collect();
        let triangles: Vec<[u32; 3]> = kept
            .iter()
            .map(|&t| {
                let [a, b, c] = self.mesh.triangles[t as usize];
                if change[t as usize] == SideChange::Turns { [a, c, b] } else { [a, b, c] }
            })
            .collect();
        let used = used_vertices(self.mesh.positions.len(), &triangles);
        Some(Lumen {
            mesh: compacted(&self.mesh.positions, triangles),
            vertices: Blend::of_rows(used.into_iter()),
            left_out: self.mesh.triangles.len() - kept.len(),
            triangles: Blend::of_rows(kept.into_iter()),
            wall: found.first()?.wall,
        })
    }

    /// The part of a sheet that lines a space, by every so manyth of its triangles.
    fn lining(&self, list: &[u32], step: usize) -> f64 {
        let places: Vec<Place> = list.iter().step_by(step).filter_map(|&t| Place::on(self.mesh, t)).collect();
        let lining = places.iter().filter(|place| self.lines_a_space(place)).count();
        lining as f64 / places.len().max(1) as f64
    }

    /// Parts the inner side of a piece from its outer side and its rims.
    fn part(&self, piece: u32, is_walled: &[bool], change: &mut [SideChange]) -> Option<()> {
        let topology = Topology::new(self.mesh.positions.len(), &self.mesh.triangles);
        let of_piece = self.triangles_of(piece);
        let by_lining = self.sides_by_lining(&topology, &of_piece, is_walled);
        let sides = by_lining.or_else(|| Some(Sheets::of(self, &topology, &of_piece)?.sides))?;
        let side = |t: u32| sides[t as usize];
        // What is on no sheet, in regions: one that only the inner side surrounds is a part of it.
        let between = Regions::of(self.mesh, &topology, &of_piece, None, |t| side(t).is_none());
        let mut touches = vec![[false; 2]; between.lists.len()];
        for (region, list) in between.lists.iter().enumerate() {
            for &t in list {
                for other in across(self.mesh, &topology, t) {
                    if let Some(is_inner) = side(other) {
                        touches[region][usize::from(is_inner)] = true;
                    }
                }
            }
        }
        for t in of_piece {
            let is_inner = side(t).unwrap_or_else(|| {
                between.of_triangle[t as usize].is_some_and(|region| touches[region as usize] == [false, true])
            });
            change[t as usize] = if is_inner { SideChange::Turns } else { SideChange::Goes };
        }
        Some(())
    }

    /// Which triangles of a piece are on its inner side, by the spaces that they line; `None` where that does not part them.
    fn sides_by_lining(&self, topology: &Topology, of_piece: &[u32], is_walled: &[bool]) -> Option<Vec<Option<bool>>> {
        let sheets = Regions::of(self.mesh, topology, of_piece, Some(SMOOTH), |t| is_walled[t as usize]);
        let least = (MIN_SHEET * of_piece.len() as f64).max(1.0) as usize;
        // Whether a triangle is of the inner side, where that is known.
        let mut sides: Vec<Option<bool>> = vec![None; self.mesh.triangles.len()];
        for list in sheets.lists.iter().filter(|list| list.len() >= least) {
            let part = self.lining(list, list.len().div_ceil(PLACES));
            if !(OUTER..=INNER).contains(&part) {
                list.iter().for_each(|&t| sides[t as usize] = Some(part > INNER));
                continue;
            }
            // Both sides hang together somewhere: each triangle is asked, and few that differ from those around are not heard.
            if list.len() > MAX_ASKED {
                return None;
            }
            let answers = parallel::map_ranges(list.len(), CHUNK, |range| {
                range.map(|i| Place::on(self.mesh, list[i]).is_some_and(|place| self.lines_a_space(&place))).collect()
            });
            let answers: Vec<bool> = answers.into_iter().flat_map(|part: Vec<bool>| part).collect();
            let mut answer_of = vec![None; self.mesh.triangles.len()];
            list.iter().zip(answers).for_each(|(&t, lines)| answer_of[t as usize] = Some(lines));
            for is_inner in [true, false] {
                let agree = |t: u32| answer_of[t as usize] == Some(is_inner);
                let parts = Regions::of(self.mesh, topology, list, Some(SMOOTH), agree).lists;
                for &t in parts.iter().filter(|part| part.len() >= least).flatten() {
                    sides[t as usize] = Some(is_inner);
                }
            }
        }
        (sides.contains(&Some(true)) && sides.contains(&Some(false))).then_some(sides)
    }
}
