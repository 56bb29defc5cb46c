//! How the pictures of a setting stand.

use crate::language::Key;
use crate::render::Look;

/// How the pictures of a setting are arranged.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arrangement {
    /// Shaded.
    #[default]
    Shaded,
    /// Its edges.
    Wireframe,
    /// Edges over the shaded surface.
    Both,
    /// Shaded, and its edges in a second picture below.
    Stacked,
}

impl Arrangement {
    /// All, in the order of a menu.
    pub const ALL: [Self; 4] = [Self::Shaded, Self::Wireframe, Self::Both, Self::Stacked];

    /// What it is called.
    pub fn label(self) -> Key {
        match self {
            Self::Shaded => Key("compare-shaded"),
            Self::Wireframe => Key("compare-wireframe"),
            Self::Both => Key("compare-both"),
            Self::Stacked => Key("compare-stacked"),
        }
    }

    /// What it shows.
    pub(super) fn help(self) -> Key {
        match self {
            Self::Shaded => Key("compare-shaded-help"),
            Self::Wireframe => Key("compare-wireframe-help"),
            Self::Both => Key("compare-both-help"),
            Self::Stacked => Key("compare-stacked-help"),
        }
    }

    /// The pictures of a setting, from the top, each of surfaces and lines over one another.
    pub(super) fn pictures(self, flat: bool) -> &'static [&'static [Look]] {
        match (self, flat) {
            (Self::Shaded, false) => &[&[Look::Shaded]],
            (Self::Shaded, true) => &[&[Look::Flat]],
            (Self::Wireframe, _) => &[&[Look::Wireframe]],
            (Self::Both, false) => &[&[Look::Shaded, Look::Wireframe]],
            (Self::Both, true) => &[&[Look::Flat, Look::Wireframe]],
            (Self::Stacked, false) => &[&[Look::Shaded], &[Look::Wireframe]],
            (Self::Stacked, true) => &[&[Look::Flat], &[Look::Wireframe]],
        }
    }

    /// How many pictures stand one above the other.
    pub(super) fn rows(self) -> usize {
        self.pictures(false).len()
    }
}
