//! A wall whose sides come apart at creases, as at the rims of what was modelled by thickening: whether a side looks into the
//! lumen is asked of each sheet as a whole, so that the thickness may vary as it likes.

use super::parting::{INNER, MIN_SHEET, OUTER};
use super::regions::Regions;
use super::search::{MIN_INNER, MIN_SEEN, PLACES};
use super::visibility::{PARALLEL, Place, Visibility};
use crate::{Topology, triangle_area};

/// A sheet ends where it bends by more than 30 degrees: the cosine.
const CREASE: f64 = 0.866;
/// Of a piece's area, what must be on sheets whose side is known.
const MIN_KNOWN: f64 = 0.8;
/// Of the inner side's places, those that line a space closed nearly all around; near the ends they do not.
const MIN_LINING: f64 = 0.5;
/// Of a piece's places, those that may face another wall of it where it is looked for creases: of a vessel without a wall few do.
pub(super) const MAY_FACE: std::ops::RangeInclusive<f64> = 0.2..=0.8;

/// The sides of a piece whose sheets come apart at creases.
pub(super) struct Sheets {
    /// Of each triangle of the surface, whether it is on the inner side, where that is known.
    pub(super) sides: Vec<Option<bool>>,
}

impl Sheets {
    /// Those of a piece; `None` where it has none, or not both sides.
    pub(super) fn of(looks: &Visibility<'_>, topology: &Topology, of_piece: &[u32]) -> Option<Self> {
        let area = |list: &[u32]| list.iter().map(|&t| triangle_area(looks.mesh.corners(t as usize))).sum::<f64>();
        let sheets = Regions::of(looks.mesh, topology, of_piece, Some(CREASE), |_| true).lists;
        let least = (MIN_SHEET * of_piece.len() as f64).max(1.0) as usize;
        let mut sides = vec![None; looks.mesh.triangles.len()];
        let mut known = [0.0; 2];
        for list in sheets.iter().filter(|list| list.len() >= least) {
            let places = list.iter().step_by(list.len().div_ceil(PLACES)).filter_map(|&t| Place::on(looks.mesh, t));
            let places: Vec<Place> = places.collect();
            let part = looks.facing(&places);
            if !(OUTER..=INNER).contains(&part) {
                list.iter().for_each(|&t| sides[t as usize] = Some(part > INNER));
                known[usize::from(part > INNER)] += area(list);
            }
        }
        let [outer, inner] = known;
        let whole = area(of_piece);
        (outer > 0.0 && inner >= MIN_INNER * whole && outer + inner >= MIN_KNOWN * whole).then_some(Self { sides })
    }

    /// How thick the wall is behind places of the inner side, and how wide the space before them; `None` where too few have
    /// the outer side behind them, or line a space that is closed nearly all around: the legs of a bent body face each other
    /// too.
    pub(super) fn across(&self, looks: &Visibility<'_>, places: &[Place]) -> Option<(Vec<f64>, Vec<f64>)> {
        let inner: Vec<&Place> =
            places.iter().filter(|place| self.sides[place.triangle as usize] == Some(true)).collect();
        let measured = inner.iter().filter_map(|place| {
            let (way, behind, cosine) = looks.met(place, -place.normal)?;
            let (width, ..) = looks.met(place, place.normal)?;
            (cosine < -PARALLEL && self.sides[behind as usize] == Some(false)).then_some((way, width))
        });
        let (ways, widths): (Vec<f64>, Vec<f64>) = measured.unzip();
        let lining = inner.iter().filter(|place| looks.lines_a_space(place)).count();
        let is_lumen = lining as f64 >= MIN_LINING * inner.len() as f64;
        (is_lumen && !ways.is_empty() && ways.len() as f64 >= MIN_SEEN * inner.len() as f64).then_some((ways, widths))
    }
}

impl Visibility<'_> {
    /// The triangles of a piece.
    pub(super) fn triangles_of(&self, piece: u32) -> Vec<u32> {
        (0u32..).zip(&self.pieces.of_triangle).filter(|(_, p)| **p == piece).map(|(t, _)| t).collect()
    }

    /// The part of places that face another wall.
    pub(super) fn facing(&self, places: &[Place]) -> f64 {
        let facing = places.iter().filter(|place| self.faces_another_wall(place)).count();
        facing as f64 / places.len().max(1) as f64
    }

    /// Whether straight out of a place its own piece is met from outside, as across a lumen.
    fn faces_another_wall(&self, place: &Place) -> bool {
        self.met(place, place.normal)
            .is_some_and(|(_, met, cosine)| cosine < -PARALLEL && self.piece(met) == self.piece(place.triangle))
    }
}
