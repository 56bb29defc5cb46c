//! What was done otherwise than asked for, and why a surface cannot be prepared, as a user is told it.
//!
//! The functions of this crate say by errors of their own exactly what is wrong, for whoever calls them. Of these a user of
//! [`prepare`](super::prepare::prepare) can do something about few; the others are [`Reason::Unsound`].

use std::fmt;

use serde::{Deserialize, Serialize};

use super::cap::CapError;
use super::clip::ClipError;
use super::ends::{EndError, RimError, SurfaceError};
use super::extend::ExtendError;
use super::remesh::RemeshError;
use lumen_message::{ToValue, Value, messages};
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
        /// The same of several ends.
        "solver-why-forks" Forks {
            /// The most that is free at one of them, in mm.
            most_mm: f64 [1],
        } => "a fork is too near: {most_mm:.1} mm are free at most",
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
        /// No vessel is there.
        "solver-why-spicule" Spicule => "it is a spike of a rough wall, and no vessel",
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
        /// Several ends are not cut for one reason.
        "solver-note-not-cut-many" NotCutMany {
            /// How many.
            count: usize,
            /// Where, in mm.
            places: Places,
            /// Why not.
            why: Reason,
        } => "{count} ends are not cut: {why}. They are at {places}.",
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
        /// Several loops are no ends for one reason.
        "solver-note-wall-many" AsWallMany {
            /// How many.
            count: usize,
            /// Where, in mm.
            places: Places,
            /// Why they are none.
            why: Reason,
        } => "{count} openings are closed as part of the wall: {why}. They are at {places}.",
        /// An extension is shorter.
        "solver-note-shorter" Shortened {
            /// The end.
            name: String,
            /// How long it is, in mm.
            mm: f64 [1],
        } => "The extension of {name} is only {mm:.1} mm long: farther on it would run into something.",
        /// Several extensions are shorter.
        "solver-note-shorter-many" ShortenedMany {
            /// How many.
            count: usize,
            /// The ends, with commas between.
            names: String,
            /// How long the shortest is, in mm.
            least_mm: f64 [1],
            /// How long the longest is, in mm.
            most_mm: f64 [1],
        } => {
            format!(
                "{count} extensions are only {least_mm:.1} to {most_mm:.1} mm long, farther on they would run into something: {names}."
            )
        },
        /// An end is not extended.
        "solver-note-not-extended" NotExtended {
            /// The end.
            name: String,
            /// Why not.
            why: Reason,
        } => "{name} is not extended: {why}.",
        /// Several ends are not extended for one reason.
        "solver-note-not-extended-many" NotExtendedMany {
            /// How many.
            count: usize,
            /// The ends, with commas between.
            names: String,
            /// Why not.
            why: Reason,
        } => "{count} ends are not extended: {why}. They are {names}.",
        /// The surface is wrapped.
        "solver-note-wrapped" Wrapped {
            /// How far the wrap is from what it wraps at most, in mm.
            deviation_mm: f64 [3],
        } => "The surface is wrapped, at most {deviation_mm:.3} mm away.",
        /// The surface is a wall with two sides, of which the inner one is wrapped.
        "solver-note-wrap-lumen" WrapLumen {
            /// The wall's thickness, in mm.
            thickness_mm: f64 [1],
        } => "The surface is a wall {thickness_mm:.1} mm thick: its lumen is wrapped.",
        /// The surface is a wall with two sides, both of which are wrapped.
        "solver-note-wrap-wall" WrapWall {
            /// The wall's thickness, in mm.
            thickness_mm: f64 [1],
        } => "The surface is a wall {thickness_mm:.1} mm thick whose sides cannot be told apart: the wall is wrapped, and not its lumen.",
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

/// Places in mm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Places(pub Vec<[f32; 3]>);

impl fmt::Display for Places {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.iter().copied().map(place).collect::<Vec<_>>().join(", "))
    }
}

impl ToValue for Places {
    fn to_value(&self) -> Value {
        Value::Text(self.to_string())
    }
}

/// What several notes have in common that are told as one.
#[derive(PartialEq)]
enum Group {
    NotCut(Reason),
    AsWall(Reason),
    Shortened,
    NotExtended(Reason),
    Filled,
}

impl Group {
    fn of(note: &Note) -> Option<Self> {
        // The free lengths at forks all differ.
        let alike = |why: &Reason| match why {
            Reason::Fork { .. } => Reason::Fork { room_mm: 0.0 },
            why => why.clone(),
        };
        match note {
            Note::NotCut { why, .. } => Some(Self::NotCut(alike(why))),
            Note::AsWall { why, .. } => Some(Self::AsWall(alike(why))),
            Note::Shortened { .. } => Some(Self::Shortened),
            Note::NotExtended { why, .. } => Some(Self::NotExtended(alike(why))),
            Note::Filled { .. } => Some(Self::Filled),
            _ => None,
        }
    }

    /// Its notes as one.
    fn told(self, notes: Vec<Note>) -> Note {
        let (mut places, mut names, mut lengths, mut rooms, mut filled) =
            (Vec::new(), Vec::new(), Vec::new(), Vec::new(), 0);
        for note in notes {
            if let Note::NotCut { why: Reason::Fork { room_mm }, .. } = note {
                rooms.push(room_mm);
            }
            match note {
                Note::NotCut { at, .. } | Note::AsWall { at, .. } => places.push(at),
                Note::Shortened { name, mm } => {
                    names.push(name);
                    lengths.push(mm);
                }
                Note::NotExtended { name, .. } => names.push(name),
                Note::Filled { count } => filled += count,
                _ => {}
            }
        }
        let (count, names) = (places.len().max(names.len()), names.join(", "));
        let most = |all: &[f64]| all.iter().copied().fold(0.0, f64::max);
        match self {
            Self::NotCut(Reason::Fork { .. }) => {
                Note::NotCutMany { count, places: Places(places), why: Reason::Forks { most_mm: most(&rooms) } }
            }
            Self::NotCut(why) => Note::NotCutMany { count, places: Places(places), why },
            Self::AsWall(why) => Note::AsWallMany { count, places: Places(places), why },
            Self::Shortened => {
                let least_mm = lengths.iter().copied().fold(f64::INFINITY, f64::min);
                Note::ShortenedMany { count, names, least_mm, most_mm: most(&lengths) }
            }
            Self::NotExtended(why) => Note::NotExtendedMany { count, names, why },
            Self::Filled => Note::Filled { count: filled },
        }
    }
}

/// The notes with those that say the same of several places or ends as one, in the order of the first of each. What is said
/// twice of a place is said once.
pub(crate) fn grouped(notes: Vec<Note>) -> Vec<Note> {
    let mut groups: Vec<(Option<Group>, Vec<Note>)> = Vec::new();
    for note in notes {
        let group = Group::of(&note);
        match groups.iter_mut().find(|(known, _)| group.is_some() && *known == group) {
            Some((Some(Group::Filled), of)) => of.push(note),
            Some((_, of)) => {
                let is_known = of.iter().any(|known| known.to_string() == note.to_string());
                of.extend(Some(note).filter(|_| !is_known));
            }
            None => groups.push((group, vec![note])),
        }
    }
    let told = |(group, mut notes): (Option<Group>, Vec<Note>)| match group {
        Some(group) if notes.len() > 1 => vec![group.told(notes)],
        _ => notes.pop().into_iter().collect(),
    };
    groups.into_iter().flat_map(told).collect()
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
            EndError::Spicule { .. } => Self::Spicule,
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_said_of_several_places_is_one_note() {
        let fork = |x: f32, room_mm: f64| Note::NotCut { at: [x, 0.0, 0.0], why: Reason::Fork { room_mm } };
        let not_round = Note::NotCut { at: [9.0, 0.0, 0.0], why: Reason::NotRound };
        let shorter = |name: &str, mm: f64| Note::Shortened { name: name.into(), mm };
        let notes = vec![
            Note::Filled { count: 2 },
            fork(1.0, 0.5),
            not_round.clone(),
            fork(2.0, 1.25),
            shorter("outlet_1", 3.0),
            fork(1.0, 0.5),
            Note::NoEnds,
            shorter("outlet_2", 7.0),
            Note::Filled { count: 1 },
        ];
        let texts: Vec<String> = grouped(notes).iter().map(Note::to_string).collect();
        let expected = [
            "3 holes in the wall are filled.",
            "2 ends are not cut: a fork is too near: 1.2 mm are free at most. They are at (1.0, 0.0, 0.0), (2.0, 0.0, 0.0).",
            "The end at (9.0, 0.0, 0.0) is not cut: the vessel is nowhere round there.",
            "2 extensions are only 3.0 to 7.0 mm long, farther on they would run into something: outlet_1, outlet_2.",
            "No end was found to extend or close: cut the ends first.",
        ];
        assert_eq!(texts, expected);
        assert_eq!(grouped(vec![not_round.clone(), not_round.clone()]), [not_round]);
    }
}
