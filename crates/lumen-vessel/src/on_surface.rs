//! What is said of a branch on one of the surfaces: radii, areas, the largest change, and whether each station counts.

use serde::{Deserialize, Serialize};

use lumen_message::messages;

/// Why a station does not count, or that it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StationStatus {
    /// It counts.
    Counts,
    /// Within a radius of an open end, or two of a cap.
    End,
    /// At a fork.
    Fork,
    /// The vessel is less than two mean edges wide.
    Thin,
    /// One of the surfaces has no closed loop around the centreline there.
    NotClosed,
    /// The plane grazes the wall: what it cuts is a cleft, or on one of the surfaces another loop though the wall has not
    /// moved.
    Ambiguous,
}

/// Least, mean and largest of something.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Least.
    pub least: f64,
    /// Mean over the length.
    pub mean: f64,
    /// Largest.
    pub largest: f64,
}

impl Spread {
    /// As "1.50 (1.00 to 2.00)".
    pub fn text(&self) -> SpreadText {
        SpreadText::MeanAndRange { mean: self.mean, least: self.least, largest: self.largest }
    }
}

messages! {
    /// A [`Spread`] as tables show it.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum SpreadText {
        /// The mean, with the least and the largest in brackets.
        "vessels-spread" MeanAndRange {
            /// Mean.
            mean: f64 [2],
            /// Least.
            least: f64 [2],
            /// Largest.
            largest: f64 [2],
        } => "{mean:.2} ({least:.2} to {largest:.2})",
    }
}

/// A change of calibre.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Change {
    /// Change of the radius in percent of what it was.
    pub percent: f64,
    /// Where, in mm.
    pub at_mm: [f32; 3],
    /// Arc length there, from the first station of the branch, in mm.
    pub abscissa_mm: f64,
}

/// A branch on one of the surfaces.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OnSurface {
    /// Radius of the circle of the same area, in mm, over what is one vessel; null where no cut closes.
    pub radius_mm: Option<Spread>,
    /// Radius of the largest ball inside, in mm, over the same.
    pub inscribed_radius_mm: Option<Spread>,
    /// The largest change of the radius from the opened surface; null for that itself, and where nothing can be measured.
    pub largest_change: Option<Change>,
    /// Area of the cross-section at each station, in mm2; null where the cut does not close.
    pub areas_mm2: Vec<Option<f32>>,
    /// Radius of the circle of the same area at each station, in mm; null likewise.
    pub radii_mm: Vec<Option<f32>>,
    /// Radius of the largest ball inside at each station, in mm; null where the centreline is not inside.
    pub inscribed_radii_mm: Vec<Option<f32>>,
    /// Change of the radius from the opened surface at each station, in percent; null where the station does not count, and
    /// for the opened surface.
    #[serde(default)]
    pub changes_percent: Vec<Option<f32>>,
}

impl StationStatus {
    /// As files have it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Counts => "counts",
            Self::End => "end",
            Self::Fork => "fork",
            Self::Thin => "thin",
            Self::NotClosed => "not_closed",
            Self::Ambiguous => "ambiguous",
        }
    }
}
