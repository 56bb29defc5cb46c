//! Whether a surface has the size of vessels, and in which unit its numbers would.
//!
//! A body of vessels may be a few centimetres across or a metre; how wide they are tells more: the mean calibre, by area,
//! is four times the volume over the area, as it is of a cylinder.

use std::fmt;
use std::ops::RangeInclusive;

use lumen_message::{ToValue, Value, messages};
use serde::{Deserialize, Serialize};

use super::Unit;
use super::report::ImportReport;

/// Diagonals, in mm, that draw no warning.
const USUAL_DIAGONAL_MM: RangeInclusive<f64> = 20.0..=2000.0;
/// Mean calibres, in mm, that draw none: coronary arteries have some 3, an aneurysm of the aorta 40.
const USUAL_CALIBRE_MM: RangeInclusive<f64> = 2.5..=45.0;
/// Mean calibres, in mm, that draw none from a diagonal of so many mm on: a tree of the heart or the brain. An aorta in cm is
/// less long.
const FINE_CALIBRE_MM: RangeInclusive<f64> = 1.5..=2.5;
const FINE_DIAGONAL_MM: RangeInclusive<f64> = 50.0..=300.0;
/// A piece of small vessels, of the brain or the heart: its diagonal and its mean calibre in mm, and how many calibres the
/// diagonal is at most. In cm it has the size of a piece of the aorta.
const SMALL_DIAGONAL_MM: RangeInclusive<f64> = 3.0..=25.0;
const SMALL_CALIBRE_MM: RangeInclusive<f64> = 0.8..=6.0;
const SMALL_CALIBRES: f64 = 10.0;

messages! {
    /// A size that vessels seldom have.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum UnusualSize {
        /// The diagonal is unusual, and would be in every unit.
        "errors-size" Across {
            /// The diagonal in mm.
            across: Length,
        } => "The surface is {across} mm from corner to corner, which is unusual for vessels: check its unit of length.",
        /// The diagonal is unusual.
        "errors-size-units" AcrossInUnits {
            /// The diagonal in mm.
            across: Length,
            /// The units in which it would be usual, and what it would be.
            units: InUnits,
        } => "The surface is {across} mm from corner to corner, which is unusual for vessels: its numbers may be in {units}.",
        /// It is a piece of small vessels, or of large ones in another unit.
        "errors-size-small" Small {
            /// The diagonal in mm.
            across: Length,
            /// The other units, and what the diagonal would be.
            units: InUnits,
        } => "The surface is {across} mm from corner to corner: a piece of small vessels, or its numbers are in {units}.",
        /// The calibre is unusual, which a wall with two sides has none of.
        "errors-calibre-units" Calibre {
            /// The mean calibre in mm.
            wide: Length,
            /// The units in which it would be usual, and what it would be.
            units: InUnits,
        } => "Its vessels are {wide} mm wide on average, which is unusual: the numbers of the file may be in {units}.",
    }
}

impl UnusualSize {
    /// The other units in which the size would be usual; none where no unit helps.
    pub fn units(&self) -> Vec<Unit> {
        match self {
            Self::Across { .. } => Vec::new(),
            Self::AcrossInUnits { units, .. } | Self::Small { units, .. } | Self::Calibre { units, .. } => {
                units.units()
            }
        }
    }
}

messages! {
    /// A length in other units.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum InUnits {
        /// In one.
        "errors-size-in" One {
            /// The unit.
            unit: Unit,
            /// The length in mm, if the file has that unit.
            length: Length,
        } => "{unit} ({length} mm)",
        /// In one of several.
        "errors-size-or" Or {
            /// The first.
            first: Box<InUnits>,
            /// The others.
            next: Box<InUnits>,
        } => "{first} or in {next}",
    }
}

impl InUnits {
    /// `mm` in each unit, by `in_unit`; nothing where there is none.
    fn new(units: &[Unit], in_unit: impl Fn(Unit) -> f64) -> Option<Self> {
        let each = units.iter().map(|&unit| Self::One { unit, length: Length(in_unit(unit)) });
        each.reduce(|first, next| Self::Or { first: first.into(), next: next.into() })
    }

    fn units(&self) -> Vec<Unit> {
        match self {
            Self::One { unit, .. } => vec![*unit],
            Self::Or { first, next } => [first.units(), next.units()].concat(),
        }
    }
}

/// A length in mm, written to three digits or to the mm, whichever is more.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Length(pub f64);

impl Length {
    /// Decimals that are written; `None` is a power of ten.
    fn places(self) -> Option<u8> {
        match self.0.abs() {
            x if x >= 100.0 || x == 0.0 => Some(0),
            x if x >= 10.0 => Some(1),
            x if x >= 0.01 => Some(3),
            _ => None,
        }
    }
}

impl fmt::Display for Length {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.places() {
            Some(places) => write!(f, "{:.*}", usize::from(places), self.0),
            None => write!(f, "{:.2e}", self.0),
        }
    }
}

impl ToValue for Length {
    fn to_value(&self) -> Value {
        self.places().map_or_else(|| Value::Text(self.to_string()), |places| Value::decimal(self.0, places))
    }
}

impl ImportReport {
    /// The one unit in which the size would be usual, where it is not and only one would do: none where the size fits small
    /// vessels as well.
    pub fn unit_by_size(&self) -> Option<Unit> {
        let unusual = self.unusual_size().filter(|unusual| !matches!(unusual, UnusualSize::Small { .. }))?;
        match unusual.units()[..] {
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
        let list = |units: &[Unit], mm: f64| InUnits::new(units, |other| in_unit(mm, other));
        let is_fine = FINE_DIAGONAL_MM.contains(&diagonal) && calibre.is_some_and(|mm| FINE_CALIBRE_MM.contains(&mm));
        if is_fine {
            return None;
        }
        let is_usual = is_as_long(&self.unit) && is_as_wide(&self.unit);
        let is_small = SMALL_DIAGONAL_MM.contains(&diagonal)
            && calibre.is_none_or(|mm| SMALL_CALIBRE_MM.contains(&mm) && diagonal <= SMALL_CALIBRES * mm);
        if is_small && !is_usual {
            let units = list(&fitting, diagonal)?;
            return Some(UnusualSize::Small { across: Length(diagonal), units });
        }
        if !is_as_long(&self.unit) {
            let units: Vec<Unit> = if fitting.is_empty() { others().collect() } else { fitting };
            let across = Length(diagonal);
            return Some(match list(&units, diagonal) {
                Some(units) => UnusualSize::AcrossInUnits { across, units },
                None => UnusualSize::Across { across },
            });
        }
        let calibre = calibre.filter(|_| !is_as_wide(&self.unit))?;
        Some(UnusualSize::Calibre { wide: Length(calibre), units: list(&fitting, calibre)? })
    }
}
