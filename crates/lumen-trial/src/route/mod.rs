//! Where a wire can go: routes through the vessel tree of a surface (`way`), and where they could begin and end
//! (`propose`).

mod place_name;
mod propose;
#[cfg(test)]
mod tests;
mod way;

use thiserror::Error;

pub use place_name::{PlaceName, WayEnd};
pub use propose::{Proposals, Target, phantom_task};
pub use way::{CrossSection, OnRoute, Route, RoutePoint, Routes};

use lumen_language::decimal;
use lumen_language::say;

/// The radius that half of a way's length is narrower than: its pieces have a radius and a length each.
fn usual_radius(mut pieces: Vec<(f64, f64)>) -> f64 {
    pieces.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = pieces.iter().map(|piece| piece.1).sum::<f64>() / 2.0;
    let mut sum = 0.0;
    let is_beyond = |piece: &&(f64, f64)| {
        sum += piece.1;
        sum >= half
    };
    pieces.iter().find(is_beyond).map_or(0.0, |piece| piece.0)
}

/// What a branch is called in a message, as [`Branch::name`](lumen_vessel::Branch::name) is in English.
pub(super) fn called(branch: u32) -> String {
    say!("trial-branch-named", number = (branch + 1).to_string())
}

/// A place in mm, as it stands in a message.
fn place([x, y, z]: [f32; 3]) -> String {
    say!("trial-place", x = decimal(x, 1), y = decimal(y, 1), z = decimal(z, 1))
}

/// What is said of a lumen that is thinner than the wire, with both diameters, the place and how far it is along the route.
fn too_thin([wire_mm, lumen_mm]: [f64; 2], at: [f32; 3], arc_mm: f64) -> String {
    let (wire, lumen, along) = (decimal(wire_mm, 2), decimal(lumen_mm, 2), decimal(arc_mm, 0));
    say!("trial-too-thin", wire = wire, lumen = lumen, at = place(at), along = along)
}

/// Why there is no route.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RouteError {
    /// The wire would begin outside.
    #[error("{}", say!("trial-entry-outside", at = place(*at), distance = decimal(*distance_mm, 1)))]
    EntryOutside {
        /// The entry in mm.
        at: [f32; 3],
        /// Its distance from the wall in mm.
        distance_mm: f32,
    },
    /// The target cannot be reached from inside.
    #[error("{}", say!("trial-target-outside", at = place(*at), distance = decimal(*distance_mm, 1)))]
    TargetOutside {
        /// The target in mm.
        at: [f32; 3],
        /// Its distance from the wall in mm.
        distance_mm: f32,
    },
    /// No lumen leads from the one to the other.
    #[error("{}", say!("trial-no-way", at = place(*at), gap = decimal(*gap_mm, 1)))]
    NoWay {
        /// Where the part of the lumen with the entry comes nearest to the other, in mm.
        at: [f32; 3],
        /// From there to the other part, in mm.
        gap_mm: f32,
    },
    /// Entry and target are the same place of the centreline.
    #[error("{}", say!("trial-too-short", length = decimal(*length_mm, 1)))]
    TooShort {
        /// Distance along the vessel in mm.
        length_mm: f64,
    },
    /// The wire does not fit.
    #[error("{}", too_thin([*wire_mm, *lumen_mm], *at, *arc_mm))]
    TooThin {
        /// Diameter of the wire in mm.
        wire_mm: f64,
        /// Diameter of the lumen in mm.
        lumen_mm: f64,
        /// Where, in mm.
        at: [f32; 3],
        /// Arc length along the route in mm.
        arc_mm: f64,
    },
}

impl RouteError {
    /// The place that is the reason, in mm, where there is one.
    pub fn place(&self) -> Option<[f32; 3]> {
        match self {
            Self::EntryOutside { at, .. }
            | Self::TargetOutside { at, .. }
            | Self::NoWay { at, .. }
            | Self::TooThin { at, .. } => Some(*at),
            Self::TooShort { .. } => None,
        }
    }
}
