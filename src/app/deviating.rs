//! What of the deviation is shown, and up to how much.

use crate::language::decimal;
use crate::pipeline::deviation::Deviation;

/// What of the deviation is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Deviating {
    /// From the surface as it was opened, not from the smoothed one.
    pub from_opened: bool,
    /// Inside and outside apart.
    pub is_signed: bool,
    /// Up to how much.
    pub up_to: UpTo,
}

/// Up to which deviation there are colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum UpTo {
    /// What 95 % of the samples are within.
    #[default]
    Percentile,
    /// 0.1 mm.
    Tenth,
    /// 0.25 mm.
    Quarter,
    /// 0.5 mm.
    Half,
}

impl UpTo {
    pub(super) const ALL: [Self; 4] = [Self::Percentile, Self::Tenth, Self::Quarter, Self::Half];

    pub(super) fn label(self) -> String {
        match self {
            Self::Percentile => "95 %".to_owned(),
            Self::Tenth => format!("{} mm", decimal(0.1, 1)),
            Self::Quarter => format!("{} mm", decimal(0.25, 2)),
            Self::Half => format!("{} mm", decimal(0.5, 1)),
        }
    }

    pub(super) fn mm(self, deviation: &Deviation) -> f32 {
        match self {
            Self::Percentile => (deviation.p95 as f32).max(1e-6),
            Self::Tenth => 0.1,
            Self::Quarter => 0.25,
            Self::Half => 0.5,
        }
    }
}
