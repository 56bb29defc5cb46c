//! Where a wire can go: routes through the vessel tree of a surface (`way`), and where they could begin and end
//! (`propose`).

mod forks;
mod place_name;
mod propose;
#[cfg(test)]
mod tests;
mod way;

use std::fmt;

pub use forks::Fork;
pub use place_name::{PlaceLabel, PlaceName, TargetLabel, WayEnd};
pub(crate) use propose::last_passed;
pub use propose::{Proposals, Target, phantom_task};
pub use way::{CrossSection, OnRoute, Route, RoutePoint, Routes};

use lumen_message::{ToValue, Value, messages};

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

/// A place in mm, as it stands in a message.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct At(pub [f32; 3]);

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.text().fmt(f)
    }
}

impl ToValue for At {
    fn to_value(&self) -> Value {
        self.text().to_value()
    }
}

impl At {
    fn text(self) -> AtText {
        let Self([x, y, z]) = self;
        AtText::Point { x, y, z }
    }
}

messages! {
    /// A place.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum AtText {
        /// By its coordinates in mm.
        "trial-place" Point {
            /// The first.
            x: f32 [1],
            /// The second.
            y: f32 [1],
            /// The third.
            z: f32 [1],
        } => "({x:.1}, {y:.1}, {z:.1})",
    }
}

messages! {
    /// Why there is no route.
    #[derive(Clone, Debug, PartialEq)]
    pub enum RouteError {
        /// The wire would begin outside.
        "trial-entry-outside" EntryOutside {
            /// The entry in mm.
            at: At,
            /// Its distance from the wall in mm.
            distance_mm: f32 [1],
        } => "the entry {at} lies outside of the vessel, {distance_mm:.1} mm from its wall",
        /// The target cannot be reached from inside.
        "trial-target-outside" TargetOutside {
            /// The target in mm.
            at: At,
            /// Its distance from the wall in mm.
            distance_mm: f32 [1],
        } => "the target {at} lies outside of the vessel, {distance_mm:.1} mm from its wall",
        /// No lumen leads from the one to the other.
        "trial-no-way" NoWay {
            /// Where the part of the lumen with the entry comes nearest to the other, in mm.
            at: At,
            /// From there to the other part, in mm.
            gap_mm: f32 [1],
        } => "there is no open way from the entry to the target: \
              the lumen ends at {at}, {gap_mm:.1} mm from where the target's begins",
        /// Entry and target are the same place of the centreline.
        "trial-too-short" TooShort {
            /// Distance along the vessel in mm.
            length_mm: f64 [1],
        } => "entry and target are {length_mm:.1} mm apart: too near for a route",
        /// The wire does not fit.
        "trial-too-thin" TooThin {
            /// Diameter of the wire in mm.
            wire_mm: f64 [2],
            /// Diameter of the lumen in mm.
            lumen_mm: f64 [2],
            /// Where, in mm.
            at: At,
            /// Arc length along the route in mm.
            arc_mm: f64 [0],
        } => "the lumen is too thin for a wire of {wire_mm:.2} mm: it is {lumen_mm:.2} mm wide at {at}, \
              {arc_mm:.0} mm along the route; less smoothing keeps thin vessels wider",
    }
}

impl RouteError {
    /// The place that is the reason, in mm, where there is one.
    pub fn place(&self) -> Option<[f32; 3]> {
        match self {
            Self::EntryOutside { at, .. }
            | Self::TargetOutside { at, .. }
            | Self::NoWay { at, .. }
            | Self::TooThin { at, .. } => Some(at.0),
            Self::TooShort { .. } => None,
        }
    }
}
