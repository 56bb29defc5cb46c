//! What a place is called where a wire could enter or go.

use serde::{Deserialize, Serialize};

use lumen_message::messages;
use lumen_vessel::BranchName;

/// What is at the end of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum WayEnd {
    /// The vessel goes on, and becomes too thin for the wire.
    Narrow,
    /// The vessel is cut off.
    Open,
    /// The vessel is closed.
    Closed,
}

/// What a place is called.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum PlaceName {
    /// The one that a sample brings.
    Own,
    /// A place where a wire could enter.
    Entry {
        /// The branch's place in [`Tree::branches`](lumen_vessel::Tree::branches).
        branch: u32,
        /// Of the lumen there, in mm.
        diameter_mm: f64,
    },
    /// A place where it could go.
    Target {
        /// As for an entry.
        branch: u32,
        /// What is there.
        end: WayEnd,
        /// Of the lumen there, in mm.
        diameter_mm: f64,
        /// Length of the way there, in mm.
        away_mm: f64,
    },
    /// Where a guide catheter lies, in the ostium of an artery.
    Ostium {
        /// As for an entry.
        branch: u32,
        /// Of the lumen there, in mm.
        diameter_mm: f64,
    },
}

impl PlaceName {
    /// "branch 3, 9.0 mm".
    pub fn label(self) -> PlaceLabel {
        match self {
            Self::Own => PlaceLabel::Own,
            Self::Entry { branch, diameter_mm } => {
                PlaceLabel::Entry { branch: BranchName::of_place(branch), width: diameter_mm }
            }
            Self::Ostium { branch, diameter_mm } => {
                PlaceLabel::Ostium { branch: BranchName::of_place(branch), width: diameter_mm }
            }
            Self::Target { branch, end, diameter_mm, away_mm } => {
                let branch = BranchName::of_place(branch);
                let name = match end {
                    WayEnd::Narrow => TargetLabel::Narrow { branch },
                    WayEnd::Open => TargetLabel::Open { branch },
                    WayEnd::Closed => TargetLabel::Closed { branch },
                };
                PlaceLabel::Target { name, width: diameter_mm, away: away_mm }
            }
        }
    }
}

messages! {
    /// A place where a wire could enter or go, as lists show it.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum PlaceLabel {
        /// The one that a sample brings.
        "trial-own" Own => "the sample's own",
        /// Where it could enter.
        "trial-entry-wide" Entry {
            /// The branch.
            branch: BranchName,
            /// Diameter of the lumen there, in mm.
            width: f64 [1],
        } => "{branch}, {width:.1} mm",
        /// Where a guide catheter lies.
        "trial-entry-ostium" Ostium {
            /// The artery.
            branch: BranchName,
            /// Diameter of the lumen there, in mm.
            width: f64 [1],
        } => "ostium of {branch}, {width:.1} mm",
        /// Where it could go.
        "trial-target-away" Target {
            /// The end.
            name: TargetLabel,
            /// Diameter of the lumen there, in mm.
            width: f64 [1],
            /// Length of the way there, in mm.
            away: f64 [0],
        } => "{name}, {width:.1} mm, {away:.0} mm away",
    }
}

messages! {
    /// The end of a way.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TargetLabel {
        /// The vessel goes on.
        "trial-target-room" Narrow {
            /// The branch.
            branch: BranchName,
        } => "{branch}, as far as there is room",
        /// The vessel is cut off.
        "trial-target-open" Open {
            /// The branch.
            branch: BranchName,
        } => "{branch}, open end",
        /// The vessel is closed.
        "trial-target-closed" Closed {
            /// The branch.
            branch: BranchName,
        } => "{branch}, closed end",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_called_by_its_branch_and_its_width() {
        let entry = PlaceName::Entry { branch: 2, diameter_mm: 9.04 };
        let target = PlaceName::Target { branch: 0, end: WayEnd::Open, diameter_mm: 4.25, away_mm: 120.4 };
        assert_eq!(entry.label().to_string(), "branch 3, 9.0 mm");
        assert_eq!(target.label().to_string(), "branch 1, open end, 4.2 mm, 120 mm away");
    }
}
