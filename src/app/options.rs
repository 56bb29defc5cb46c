//! What the views show, as the user chooses.

use crate::app::deviating::Deviating;
use crate::app::reveal::Reveal;
use crate::mesh::mending::FaultKind;

/// What the views show, as the user chooses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ViewOptions {
    /// The pieces that are left out, faintly; a click keeps one of them.
    pub left_out: bool,
    /// Each triangle with its own normal.
    pub flat: bool,
    /// Light from the side.
    pub raking: bool,
    /// Darker where walls stand close together: at first where a graphics processor draws.
    pub occlusion: bool,
    /// The hidden lines of the wireframe.
    pub see_through: bool,
    /// What the colours of the shaded view mean.
    pub colours: Colours,
    /// What of the deviation they mean, when they do.
    pub deviation: Deviating,
    /// The surface as it was opened, where nothing can be held.
    pub before: bool,
    /// Both in one picture.
    pub reveal: Reveal,
    /// That picture in the wireframe view too.
    pub reveal_lines: bool,
    /// Feature edges and open ends as lines.
    pub lines: bool,
    /// The faults that are marked, and the one that is looked at.
    pub fault: Option<FaultShown>,
}

impl ViewOptions {
    /// Forgets what belongs to the surface that was shown.
    pub fn leave_surface(&mut self) {
        self.fault = None;
        if matches!(self.colours, Colours::Array(_)) {
            self.colours = Colours::None;
        }
    }
}

/// A fault of the surface that is open: its kind, and which of them is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaultShown {
    /// All of these are marked.
    pub kind: FaultKind,
    /// The one that was gone to.
    pub index: u16,
}

/// What the colours of the shaded view mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colours {
    /// Nothing: the surface has one.
    #[default]
    None,
    /// The mean deviation around each vertex, in mm.
    Deviation(Deviating),
    /// The change of calibre of the vessel beside each vertex from the opened surface, in percent.
    Calibre,
    /// The vertices' classes, as decimation has them.
    Classes,
    /// What the file says of its vertices or triangles: the array of this number.
    Array(u16),
}

impl Colours {
    /// These, or none where they are shown already.
    #[must_use]
    pub fn toggled(self, other: Self) -> Self {
        if self == other { Self::None } else { other }
    }

    /// Whether they go both ways from white.
    pub(super) fn are_diverging(self) -> bool {
        matches!(self, Self::Deviation(Deviating { is_signed: true, .. }))
    }
}
