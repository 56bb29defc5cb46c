//! Whether a surface has the size of vessels, and in which unit its numbers would.
//!
//! A body of vessels may be a few centimetres across or a metre; how wide they are tells more: the mean calibre, by area,
//! is four times the volume over the area, as it is of a cylinder.

use std::ops::RangeInclusive;

use super::Unit;
use super::report::ImportReport;
use lumen_language::say;
use lumen_language::{decimal, scientific};

/// Diagonals, in mm, that draw no warning.
const USUAL_DIAGONAL_MM: RangeInclusive<f64> = 20.0..=2000.0;
/// Mean calibres, in mm, that draw none: coronary arteries have some 3, an aneurysm of the aorta 40.
const USUAL_CALIBRE_MM: RangeInclusive<f64> = 2.5..=45.0;

/// A size that vessels seldom have.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnusualSize {
    /// What is unusual, and what the numbers of the file may be in.
    pub sentence: String,
    /// The units in which the size would be usual; none where no unit helps.
    pub units: Vec<Unit>,
    /// Whether it is the calibre that is unusual, which a wall with two sides has none of.
    pub is_calibre: bool,
}

impl ImportReport {
    /// The one unit in which the size would be usual, where it is not and only one would do.
    pub fn unit_by_size(&self) -> Option<Unit> {
        match self.unusual_size()?.units[..] {
            [unit] => Some(unit),
            _ => None,
        }
    }

    /// What is unusual about the size; `None` where nothing is.
    pub fn unusual_size(&self) -> Option<UnusualSize> {
        if self.vertices == 0 {
            return None;
        }
        let diagonal = f64::from(self.bounds_mm.diagonal());
        let calibre = self.volume_mm3.map(|volume| 4.0 * volume / self.area_mm2);
        let in_unit = |mm: f64, other: Unit| mm / self.unit.to_mm() * other.to_mm();
        let is_as_long = |&other: &Unit| USUAL_DIAGONAL_MM.contains(&in_unit(diagonal, other));
        let is_as_wide = |&other: &Unit| calibre.is_none_or(|mm| USUAL_CALIBRE_MM.contains(&in_unit(mm, other)));
        let others = || Unit::ALL.into_iter().filter(|&other| other != self.unit).filter(is_as_long);
        let fitting: Vec<Unit> = others().filter(is_as_wide).collect();
        let list = |units: &[Unit], mm: f64| {
            let each = units.iter().map(|&other| format!("{other} ({} mm)", length(in_unit(mm, other))));
            each.reduce(|first, next| say!("errors-size-or", first = first, next = next)).unwrap_or_default()
        };
        if !is_as_long(&self.unit) {
            let units = if fitting.is_empty() { others().collect() } else { fitting };
            let across = length(diagonal);
            let sentence = if units.is_empty() {
                say!("errors-size", across = across)
            } else {
                say!("errors-size-units", across = across, units = list(&units, diagonal))
            };
            return Some(UnusualSize { sentence, units, is_calibre: false });
        }
        let calibre = calibre.filter(|_| !is_as_wide(&self.unit) && !fitting.is_empty())?;
        let sentence = say!("errors-calibre-units", wide = length(calibre), units = list(&fitting, calibre));
        Some(UnusualSize { sentence, units: fitting, is_calibre: true })
    }
}

/// A length in mm to three digits or to the mm, whichever is more.
pub(super) fn length(mm: f64) -> String {
    match mm.abs() {
        x if x >= 100.0 || x == 0.0 => decimal(mm, 0),
        x if x >= 10.0 => decimal(mm, 1),
        x if x >= 0.01 => decimal(mm, 3),
        _ => scientific(mm, 2),
    }
}
