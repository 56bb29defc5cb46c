//! What was done otherwise than asked for, and why a surface cannot be prepared, as a user is told it.
//!
//! The functions of this crate say by errors of their own exactly what is wrong, for whoever calls them. Of these a user of
//! [`prepare`](super::prepare::prepare) can do something about few; the others are [`Reason::Unsound`].

use serde::{Deserialize, Serialize};

use super::cap::CapError;
use super::clip::ClipError;
use super::ends::{EndError, RimError, SurfaceError};
use super::extend::ExtendError;
use super::remesh::RemeshError;
use lumen_message::messages;
use lumen_vessel::TreeError;

messages! {
    /// Why an end is not cut, extended or closed as asked.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum Reason {
        /// No plane keeps clear of the fork.
        "solver-why-fork" Fork {
            /// Distance from the end up to the fork, in mm.
            room_mm: f64 [1],
        } => "a fork is too near: {room_mm:.1} mm are free",
        /// No section is a circle or nearly.
        "solver-why-not-round" NotRound => "the vessel is nowhere round there",
        /// A plane leaves no closed outline.
        "solver-why-no-section" NoSection => "the surface has no closed section there",
        /// The outline runs into another opening.
        "solver-why-open" Open => "the section runs into an opening",
        /// The outline has too few triangles.
        "solver-why-coarse" Coarse => "the triangles are too large there",
        /// Nothing is parted.
        "solver-why-around" Around => "what lies beyond leads around to the other side",
        /// Another end would go.
        "solver-why-other-end" OtherEnd => "another end would be cut off",
        /// Most of the surface would go.
        "solver-why-most" Most {
            /// Of the area.
            percent: f64 [0],
        } => "{percent:.0} % of the surface would be cut off",
        /// It does not go around its middle once.
        "solver-why-folded" Folded => "its outline is folded",
        /// It crosses or touches itself.
        "solver-why-crossed" Crossed => "its outline crosses itself",
        /// It lies in no plane.
        "solver-why-not-flat" NotFlat => "it lies in no plane",
        /// Too many rings.
        "solver-why-long" TooLong => "that is too long for triangles as small as there",
        /// An extension would run into something at once.
        "solver-why-no-room" NoRoom => "there is no room for it",
        /// A cap would take too many vertices.
        "solver-why-fine" TooFine => "its edges are too short for its area",
        /// Something that [`check`](super::check::check) tells more of.
        "solver-why-unsound" Unsound => "the surface is not in order there",
        /// The vessel does not go on there.
        "solver-why-sac" Sac => "it is a sac, wider than its neck",
    }
}

messages! {
    /// Something that was done otherwise than asked for.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum Note {
        /// Pieces are left out.
        "solver-note-left-out" LeftOut {
            /// How many.
            others: usize,
        } => (others, "One smaller piece is left out.", "{others} smaller pieces are left out."),
        /// The surface is a wall with two sides, of which the inner one is taken.
        "solver-note-lumen" Lumen {
            /// Its thickness, in mm.
            thickness_mm: f64 [1],
        } => "The surface is a wall {thickness_mm:.1} mm thick: its inner side is taken.",
        /// An end is not cut.
        "solver-note-not-cut" NotCut {
            /// Its place, in mm.
            at: [f32; 3],
            /// Why not.
            why: Reason,
        } => { format!("The end at {} is not cut: {why}.", place(*at)) },
        /// A cut is not made.
        "solver-note-no-end" NoEndThere {
            /// Where, in mm.
            at: [f32; 3],
        } => { format!("No vessel ends near {}: nothing is cut there.", place(*at)) },
        /// Nothing is extended or closed.
        "solver-note-no-ends" NoEnds => "No end was found to extend or close: cut the ends first.",
        /// Holes of the wall are filled.
        "solver-note-filled" Filled {
            /// How many.
            count: usize,
        } => (count, "One hole in the wall is filled.", "{count} holes in the wall are filled."),
        /// A loop is no end.
        "solver-note-wall" AsWall {
            /// Its place, in mm.
            at: [f32; 3],
            /// Why it is none.
            why: Reason,
        } => { format!("The opening at {} is closed as part of the wall: {why}.", place(*at)) },
        /// An extension is shorter.
        "solver-note-shorter" Shortened {
            /// The end.
            name: String,
            /// How long it is, in mm.
            mm: f64 [1],
        } => "The extension of {name} is only {mm:.1} mm long: farther on it would run into something.",
        /// An end is not extended.
        "solver-note-not-extended" NotExtended {
            /// The end.
            name: String,
            /// Why not.
            why: Reason,
        } => "{name} is not extended: {why}.",
        /// The surface is wrapped.
        "solver-note-wrapped" Wrapped {
            /// How far the wrap is from what it wraps at most, in mm.
            deviation_mm: f64 [3],
        } => "The surface is wrapped, at most {deviation_mm:.3} mm away.",
        /// The wrap went into the vessel.
        "solver-note-wrap-hollow" WrapHollow {
            /// Where an end is that it went through, in mm.
            at: [f32; 3],
        } => {
            let at = place(*at);
            format!(
                "The wrap goes into the vessel at {at}: the wall has gaps wider than the tolerance, and it is the wall that is \
                 wrapped. Try a larger tolerance."
            )
        },
    }
}

messages! {
    /// Why a surface cannot be prepared.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum PrepareError {
        /// There is nothing to prepare.
        "solver-error-empty" Empty => "the surface has no triangles",
        /// The surface is broken.
        "solver-error-unsound" Unsound => "numbers of the surface are not finite or out of range",
        /// Ends are to be cut and there is no vessel.
        "solver-error-tree" NoVessel {
            /// Why not.
            why: TreeError,
        } => "no end can be found: {why}",
        /// It is a wall, and no vessel.
        "solver-error-wall" Wall {
            /// Its thickness, in mm.
            thickness_mm: f64 [1],
        } => "it is a wall {thickness_mm:.1} mm thick, and its inner side cannot be told from its outer side",
        /// An end cannot be closed.
        "solver-error-cap" Cap {
            /// Its name.
            name: String,
            /// Why not.
            why: Reason,
        } => "{name} cannot be closed: {why}",
        /// Edges have more than two triangles, or windings disagree.
        "solver-error-mend" Mend => "edges have more than two triangles, or triangles face opposite ways: mend the surface first",
        /// The wanted lengths make no sense.
        "solver-error-sizes" Sizes => "the wanted lengths make no sense",
        /// The wanted lengths ask for too many triangles.
        "solver-error-many" TooMany {
            /// How many there would be.
            about: u64,
            /// How many there may be.
            most: usize,
        } => { format!("edges as short as that make about {about} triangles, and at most {most} are made") },
        /// The wrap would be too large.
        "solver-error-wrap" Wrap {
            /// The tolerance, in mm.
            tolerance_mm: f64 [2],
            /// One that may do, in mm.
            least_mm: f64 [2],
        } => "a wrap within {tolerance_mm:.2} mm would be too large: try {least_mm:.2} mm",
        /// A wrap within the tolerance would have no shape.
        "solver-error-wrap-coarse" WrapCoarse {
            /// The tolerance, in mm.
            tolerance_mm: f64 [2],
            /// The largest, in mm.
            most_mm: f64 [2],
        } => "a wrap within {tolerance_mm:.2} mm would have nothing of the surface's shape: try {most_mm:.2} mm or less",
    }
}

fn place(at: [f32; 3]) -> String {
    format!("({})", at.map(|x| format!("{x:.1}")).join(", "))
}

impl From<SurfaceError> for PrepareError {
    fn from(error: SurfaceError) -> Self {
        if error == SurfaceError::NoTriangles { Self::Empty } else { Self::Unsound }
    }
}

impl From<TreeError> for PrepareError {
    fn from(why: TreeError) -> Self {
        Self::NoVessel { why }
    }
}

impl From<CapError> for PrepareError {
    fn from(error: CapError) -> Self {
        match error {
            CapError::Surface(error) => error.into(),
            CapError::Folded { name } => Self::Cap { name, why: Reason::Folded },
            CapError::SelfCrossing { name } => Self::Cap { name, why: Reason::Crossed },
            CapError::TooFine { name } => Self::Cap { name, why: Reason::TooFine },
            CapError::Joined { name } => Self::Cap { name, why: Reason::Coarse },
            CapError::Rim(_) | CapError::NoEnds | CapError::Shared { .. } | CapError::Holes { .. } => Self::Mend,
        }
    }
}

impl From<RemeshError> for PrepareError {
    fn from(error: RemeshError) -> Self {
        match error {
            RemeshError::Empty => Self::Empty,
            RemeshError::NonManifold { .. } | RemeshError::Flipped { .. } => Self::Mend,
            RemeshError::Sizing(_) => Self::Sizes,
            RemeshError::TooMany { about, most } => Self::TooMany { about, most },
            _ => Self::Unsound,
        }
    }
}

impl From<&EndError> for Reason {
    fn from(error: &EndError) -> Self {
        match error {
            EndError::TooNearFork { room_mm, .. } => Self::Fork { room_mm: room_mm.max(0.0) },
            EndError::NotRound { .. } => Self::NotRound,
            EndError::Sac { .. } => Self::Sac,
            EndError::NoSection { .. } => Self::NoSection,
            _ => Self::Unsound,
        }
    }
}

impl From<&ClipError> for Reason {
    fn from(error: &ClipError) -> Self {
        match error {
            ClipError::NoOutline { .. } => Self::NoSection,
            ClipError::Open { .. } => Self::Open,
            ClipError::TooCoarse { .. } => Self::Coarse,
            ClipError::NotSeparating { .. } => Self::Around,
            ClipError::OtherEnd { .. } => Self::OtherEnd,
            ClipError::MostOfSurface { part, .. } => Self::Most { percent: 100.0 * part },
            ClipError::Rim(error) => error.into(),
            ClipError::Surface(_) | ClipError::Plane { .. } | ClipError::NonManifold { .. } => Self::Unsound,
        }
    }
}

impl From<&RimError> for Reason {
    fn from(error: &RimError) -> Self {
        match error {
            RimError::TooFew { .. } => Self::Coarse,
            RimError::NotPlanar { .. } => Self::NotFlat,
            RimError::NoArea { .. } | RimError::NotBoundary { .. } => Self::Unsound,
        }
    }
}

impl From<&ExtendError> for Reason {
    fn from(error: &ExtendError) -> Self {
        match error {
            ExtendError::TooLong { .. } => Self::TooLong,
            ExtendError::Folded { .. } => Self::Folded,
            ExtendError::Collides { .. } => Self::NoRoom,
            ExtendError::Rim(error) => error.into(),
            _ => Self::Unsound,
        }
    }
}
