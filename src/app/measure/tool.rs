//! The tools: what is measured, and by how many places.

use crate::language::Key;
use crate::sharing::measures::Measure;

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tool {
    /// The straight distance of two places.
    Ruler,
    /// The largest ball inside at a place.
    Diameter,
    /// The cross-section of the vessel at a place.
    Section,
    /// The angle at the second of three places.
    Angle,
    /// The angle between the branches of the fork next to a place.
    Fork,
}

impl Tool {
    /// Every tool, in the order in which they are shown.
    pub(super) const ALL: [Self; 5] = [Self::Ruler, Self::Diameter, Self::Section, Self::Angle, Self::Fork];

    /// What it is called.
    pub(super) fn label(self) -> Key {
        match self {
            Self::Ruler => Key("measure-ruler"),
            Self::Diameter => Key("measure-diameter"),
            Self::Section => Key("measure-section"),
            Self::Angle => Key("measure-angle"),
            Self::Fork => Key("measure-fork"),
        }
    }

    /// What it measures.
    pub(super) fn help(self) -> Key {
        match self {
            Self::Ruler => Key("measure-ruler-help"),
            Self::Diameter => Key("measure-diameter-help"),
            Self::Section => Key("measure-section-help"),
            Self::Angle => Key("measure-angle-help"),
            Self::Fork => Key("measure-fork-help"),
        }
    }

    /// What the next click does, and what the next tap, when some places are there already.
    pub(super) fn hint(self, places: usize) -> [Key; 2] {
        match (self, places) {
            (Self::Ruler | Self::Angle, 0) => [Key("measure-click-first"), Key("measure-tap-first")],
            (Self::Ruler, _) => [Key("measure-click-end"), Key("measure-tap-end")],
            (Self::Angle, 1) => [Key("measure-click-vertex"), Key("measure-tap-vertex")],
            (Self::Angle, _) => [Key("measure-click-last"), Key("measure-tap-last")],
            (Self::Diameter, _) => [Key("measure-point-wall"), Key("measure-tap-wall")],
            (Self::Section, _) => [Key("measure-click-vessel"), Key("measure-tap-vessel")],
            (Self::Fork, _) => [Key("measure-click-branch"), Key("measure-tap-branch")],
        }
    }

    /// How many places it takes.
    pub(super) fn places(self) -> usize {
        match self {
            Self::Ruler => 2,
            Self::Angle => 3,
            Self::Diameter | Self::Section | Self::Fork => 1,
        }
    }

    /// The name of the next measure: with the least number above all that its names have.
    pub(super) fn name(self, measures: &[Measure]) -> String {
        let label = self.label().say();
        let number = |measure: &Measure| measure.name.strip_prefix(label.as_str())?.trim().parse::<u32>().ok();
        let last = measures.iter().filter_map(number).max().unwrap_or(0);
        format!("{label} {}", last.saturating_add(1))
    }
}
