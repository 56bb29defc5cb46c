//! What a place is called where a wire could enter or go.

use serde::{Deserialize, Serialize};

use super::called;
use lumen_language::decimal;
use lumen_language::say;

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

/// What a place is called: said anew each time that it is shown, in the language of then.
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
}

impl PlaceName {
    /// "branch 3, 9.0 mm", in the language that is spoken.
    pub fn label(self) -> String {
        match self {
            Self::Own => say!("trial-own"),
            Self::Entry { branch, diameter_mm } => format!("{}, {} mm", called(branch), decimal(diameter_mm, 1)),
            Self::Target { branch, end, diameter_mm, away_mm } => {
                let branch = called(branch);
                let name = match end {
                    WayEnd::Narrow => say!("trial-target-room", branch = branch),
                    WayEnd::Open => say!("trial-target-open", branch = branch),
                    WayEnd::Closed => say!("trial-target-closed", branch = branch),
                };
                let (width, away) = (decimal(diameter_mm, 1), decimal(away_mm, 0));
                say!("trial-target-away", name = name, width = width, away = away)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_language::{Language, built_in, speak};

    #[test]
    fn a_place_is_called_in_the_language_of_the_moment() {
        let entry = PlaceName::Entry { branch: 2, diameter_mm: 9.04 };
        let target = PlaceName::Target { branch: 0, end: WayEnd::Open, diameter_mm: 4.25, away_mm: 120.4 };
        assert_eq!(entry.label(), "branch 3, 9.0 mm");
        assert_eq!(target.label(), "branch 1, open end, 4.2 mm, 120 mm away");
        speak(Language::German, built_in(Language::German).unwrap());
        assert_eq!(entry.label(), "Ast 3, 9,0 mm");
        speak(Language::English, &[]);
    }
}
