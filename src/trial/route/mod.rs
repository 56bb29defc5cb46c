//! Where a wire can go: routes through the vessel tree of a surface (`way`), and where they could begin and end
//! (`propose`).

mod propose;
#[cfg(test)]
mod tests;
mod way;

use thiserror::Error;

pub use propose::{Target, phantom_task};
pub use way::{CrossSection, OnRoute, Route, RoutePoint};

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

/// Why there is no route.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RouteError {
    /// The wire would begin outside.
    #[error("the entry ({:.1}, {:.1}, {:.1}) lies outside of the vessel, {distance_mm:.1} mm from its wall", at[0], at[1], at[2])]
    EntryOutside {
        /// The entry in mm.
        at: [f32; 3],
        /// Its distance from the wall in mm.
        distance_mm: f32,
    },
    /// The target cannot be reached from inside.
    #[error("the target ({:.1}, {:.1}, {:.1}) lies outside of the vessel, {distance_mm:.1} mm from its wall", at[0], at[1], at[2])]
    TargetOutside {
        /// The target in mm.
        at: [f32; 3],
        /// Its distance from the wall in mm.
        distance_mm: f32,
    },
    /// No lumen leads from the one to the other.
    #[error(
        "there is no open way from the entry to the target: the lumen ends at ({:.1}, {:.1}, {:.1}), \
         {gap_mm:.1} mm from where the target's begins",
        at[0], at[1], at[2]
    )]
    NoWay {
        /// Where the part of the lumen with the entry comes nearest to the other, in mm.
        at: [f32; 3],
        /// From there to the other part, in mm.
        gap_mm: f32,
    },
    /// Entry and target are the same place of the centreline.
    #[error("entry and target are {length_mm:.1} mm apart: too near for a route")]
    TooShort {
        /// Distance along the vessel in mm.
        length_mm: f64,
    },
    /// The wire does not fit.
    #[error(
        "the lumen is too thin for a wire of {wire_mm:.2} mm: it is {lumen_mm:.2} mm wide at ({:.1}, {:.1}, {:.1}), \
         {arc_mm:.0} mm along the route; less smoothing keeps thin vessels wider",
        at[0], at[1], at[2]
    )]
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
