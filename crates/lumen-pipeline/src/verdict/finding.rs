//! A verdict, and what it is made of.

use lumen_message::{Message, grouped, messages};
use serde::{Deserialize, Serialize};

use super::super::progressive::ShortfallMessage;
use super::super::settings::{Preset, Settings};
use super::super::warnings::{DrawnShut, Pinches, VolumeNotHeld, VolumeWarning};
use lumen_io::{Unit, UnusualSize, Warning};
use lumen_mesh::mending::MendWarning;
use lumen_vessel::BranchName;
use lumen_vessel::certificate::Coverage;
use lumen_vessel::summary::{CalibreSummary, CoverageText, PlaceText};
use lumen_vessel::variation::ReferenceText;

messages! {
    /// What there is to say of a result, in one or two sentences.
    #[derive(Clone, Debug, PartialEq)]
    pub enum FindingKind {
        /// The surface is a wall with two sides.
        "verdict-wall" Wall {
            /// In mm.
            thickness: f64 [2],
        } => "The surface is a wall with two sides, {thickness:.2} mm thick.",
        /// The wall has holes.
        "verdict-holes" Holes {
            /// How many.
            count: usize,
            /// That of the largest, in mm.
            diameter: f64 [1],
        } => {
            match count {
                1 => format!("The wall has a hole of {diameter:.1} mm."),
                _ => format!("The wall has {} holes, the largest of {diameter:.1} mm.", grouped(count)),
            }
        },
        /// Surfaces meet that should be apart.
        "verdict-crowded" Crowded {
            /// At how many edges and points.
            count: usize,
        } => {
            match count {
                1 => "At 1 edge or point surfaces meet that should be apart.".to_owned(),
                _ => format!("At {} edges and points surfaces meet that should be apart.", grouped(count)),
            }
        },
        /// Much of the surface is left out.
        "verdict-left-out" LeftOut {
            /// The part of its area, in percent.
            percent: f64 [0],
            /// In how many pieces.
            pieces: usize,
        } => {
            match pieces {
                1 => format!("{percent:.0} % of the surface is left out: another piece."),
                _ => format!("{percent:.0} % of the surface is left out: {} other pieces.", grouped(pieces)),
            }
        },
        /// A vessel is pinched at a rate that was reached.
        "verdict-pinched-first" PinchedFirst {
            /// Its diameter, in mm.
            before: f64 [1],
            /// The first rate at which it is, in percent.
            percent: f64 [1],
        } => "A vessel of {before:.1} mm is pinched, first at {percent:.1} %.",
        /// A vessel is lost at a rate that was reached.
        "verdict-lost-first" LostFirst {
            /// Its diameter, in mm.
            before: f64 [1],
            /// The first rate at which it is, in percent.
            percent: f64 [1],
        } => "A vessel of {before:.1} mm is lost, first at {percent:.1} %.",
        /// Triangles cross that did not before the reduction.
        "verdict-crossing" Crossing {
            /// How many.
            count: usize,
        } => {
            match count {
                1 => "1 triangle runs into others.".to_owned(),
                _ => format!("{} triangles run into others.", grouped(count)),
            }
        },
        /// Triangles cross, and some did before the reduction.
        "verdict-crossing-before" CrossingBefore {
            /// How many do now.
            count: usize,
            /// How many did.
            before: usize,
        } => {
            let (now, did) = (grouped(count), grouped(before));
            match count {
                1 => format!("{now} triangle runs into others; {did} did before the reduction."),
                _ => format!("{now} triangles run into others; {did} did before the reduction."),
            }
        },
        /// Inlets or outlets are not flat any more.
        "verdict-caps-rounded" CapsRounded {
            /// How many.
            count: usize,
        } => {
            match count {
                1 => "An inlet or outlet is no longer flat.".to_owned(),
                _ => format!("{} inlets and outlets are no longer flat.", grouped(count)),
            }
        },
        /// Inlets or outlets change their areas.
        "verdict-caps" Caps {
            /// How many.
            count: usize,
            /// The largest change, in percent.
            percent: f64 [1],
        } => {
            match count {
                1 => format!("The area of an inlet or outlet changes by {percent:.1} %."),
                _ => format!("The areas of {} inlets and outlets change, one by {percent:.1} %.", grouped(count)),
            }
        },
        /// A vessel is narrower than on either side.
        "verdict-narrower" Narrower {
            /// Which.
            name: BranchName,
            /// By how much of its diameter, in percent.
            percent: f64 [0],
            /// Over which length, in mm.
            length: f64 [1],
            /// What is left, and of what.
            reference: ReferenceText,
        } => "As opened, {name} is {percent:.0} % narrower over {length:.1} mm than on either side: {reference}.",
        /// A vessel is wider than on either side.
        "verdict-wider" Wider {
            /// Which.
            name: BranchName,
            /// By how much of its diameter, in percent.
            percent: f64 [0],
            /// Over which length, in mm.
            length: f64 [1],
            /// How wide, and beside what.
            reference: ReferenceText,
        } => "As opened, {name} is {percent:.0} % wider over {length:.1} mm than on either side: {reference}.",
        /// The filter misses its pass band.
        "verdict-few-iterations" FewIterations =>
            "Too few iterations for this pass band: more are needed to smooth.",
        /// Nothing is smoothed.
        "verdict-not-smoothed" NotSmoothed =>
            "Nothing is smoothed: if the surface has the steps of its scan, they are still there, and a wire catches on them.",
    } or {
        /// The size of the surface is unusual for vessels.
        Size(UnusualSize),
        /// What else was found when the file was read.
        Import(Warning),
        /// Vessels do not keep their calibre.
        Calibre(CalibreSummary),
        /// The level pinches a vessel.
        Pinches(Pinches),
        /// Smoothing has drawn a vessel shut.
        DrawnShut(DrawnShut),
        /// The volume changed much.
        Volume(VolumeWarning),
        /// The volume is not held.
        VolumeNotHeld(VolumeNotHeld),
        /// Something that mending was asked for is not done.
        Mending(MendWarning),
        /// The target is not met.
        Shortfall(ShortfallMessage),
    }
}

impl FindingKind {
    /// Whether the file itself is the reason: it is so whatever the settings, and was said when the file was read.
    pub fn is_of_file(&self) -> bool {
        matches!(self, Self::Size(_) | Self::Import(_))
    }

    /// Whether the sentence says where it is.
    pub fn says_where(&self) -> bool {
        matches!(self, Self::Pinches(_) | Self::DrawnShut(_))
    }
}

messages! {
    /// What there is to say of a place, in a few words.
    #[derive(Clone, Debug, PartialEq)]
    pub enum PlaceLabel {
        /// A hole in the wall.
        "verdict-place-hole" Hole => "Hole",
        /// Surfaces meet.
        "verdict-place-here" Here => "Here",
        /// A vessel is narrower than it was.
        "verdict-place-narrowed" Narrowed => "Pinched",
        /// A vessel is narrower than on either side.
        "verdict-place-narrower" Narrower {
            /// By how much of its diameter, in percent.
            percent: f64 [0],
        } => "{percent:.0} % narrower",
        /// A vessel is wider than on either side.
        "verdict-place-wider" Wider {
            /// By how much of its diameter, in percent.
            percent: f64 [0],
        } => "{percent:.0} % wider",
        /// A vessel is pinched.
        "verdict-place-pinched" Pinched => "pinched",
        /// A vessel is lost.
        "verdict-place-lost" Lost => "lost",
        /// A vessel is drawn shut.
        "verdict-place-shut" Shut => "Drawn shut",
        /// An inlet or outlet is not flat any more.
        "verdict-place-rounded" Rounded => "no longer flat",
        /// An inlet or outlet changes its area.
        "verdict-place-cap" Cap {
            /// In percent.
            percent: f64 [1],
        } => "area {percent:.1} %",
    } or {
        /// A vessel changes its calibre.
        Calibre(PlaceText),
    }
}

/// A place to look at.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// In mm.
    pub at_mm: [f32; 3],
    /// How wide the vessel is there, in mm.
    pub width_mm: f64,
    /// What there is to say of it.
    pub label: PlaceLabel,
}

messages! {
    /// What a remedy is called.
    #[derive(Clone, Debug, PartialEq)]
    pub enum RemedyLabel {
        /// Another rate.
        "verdict-reduce-to" ReduceTo {
            /// The rate in percent.
            percent: f64 [1],
        } => "Reduce to {percent:.1} %",
        /// Another unit.
        "verdict-read-in" ReadIn {
            /// Which.
            unit: Unit,
        } => "Read in {unit}",
        /// Of a wall the lumen.
        "verdict-take-lumen" TakeLumen => "Take the lumen",
        /// Nothing is left out.
        "verdict-all-pieces" AllPieces => "All pieces",
        /// Holes are filled.
        "verdict-fill" Fill => "Fill",
        /// Surfaces that meet are split.
        "verdict-split" Split => "Split",
        /// Smoothing makes no triangles cross.
        "verdict-no-crossings" NoCrossings => "No crossings",
        /// Flat caps stay flat.
        "verdict-hold-caps" HoldCaps => "Hold the caps",
    } or {
        /// Settings of the filter that have a name.
        Smoothing(Preset),
    }
}

/// Something that would help.
#[derive(Clone, Debug, PartialEq)]
pub struct Remedy {
    /// What it is called.
    pub label: RemedyLabel,
    /// What is to be changed.
    pub change: Remedied,
}

/// What a remedy changes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Remedied {
    /// These settings in place of those that were used.
    Settings(Box<Settings>),
    /// The file is read with its numbers in this unit.
    Unit(Unit),
}

/// Something to say of a result.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is.
    pub what: FindingKind,
    /// Whether a trial had better not rest on the result; else it is a note.
    pub is_grave: bool,
    /// Where it is; `None` where it is everywhere or nowhere.
    pub place: Option<Place>,
    /// What would help.
    pub remedies: Vec<Remedy>,
}

impl Finding {
    pub(super) fn grave(what: impl Into<FindingKind>) -> Self {
        Self { what: what.into(), is_grave: true, place: None, remedies: Vec::new() }
    }

    pub(super) fn note(what: impl Into<FindingKind>) -> Self {
        Self { is_grave: false, ..Self::grave(what) }
    }

    pub(super) fn at(self, at_mm: [f32; 3], width_mm: f64, label: impl Into<PlaceLabel>) -> Self {
        Self { place: Some(Place { at_mm, width_mm, label: label.into() }), ..self }
    }

    pub(super) fn helped_by(mut self, remedy: Option<Remedy>) -> Self {
        self.remedies.extend(remedy);
        self
    }
}

messages! {
    /// A verdict in a few words.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Head {
        /// A trial may rest on the result.
        "verdict-safe" Safe => "Safe to simulate on",
        /// Nothing is wrong, but too little is measured to say so of the whole surface.
        "verdict-kept" KeptWhereMeasured => "Kept where measured",
        /// Nothing is wrong, but no calibre is measured.
        "verdict-none-measured" NoneMeasured => "No vessel was measured",
        /// The measuring has stopped.
        "verdict-not-measured" NotMeasured => "Not measured",
        /// The measuring goes on.
        "verdict-coming" Coming => "Being measured...",
        /// There are grave findings.
        "verdict-to-look-at" ToLookAt {
            /// How many.
            count: usize,
        } => (count, "One thing to look at", "{count} things to look at"),
    }
}

messages! {
    /// A head, with what it rests on.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum HeadText {
        /// How much is measured.
        "verdict-covered" Covered {
            /// The head.
            head: Head,
            /// How much.
            coverage: CoverageText,
        } => "{head}: {coverage}",
    } or {
        /// Nothing that it rests on.
        Alone(Head),
    }
}

/// The verdict on a result.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// In a few words.
    pub head: Head,
    /// Whether a trial may rest on it; `None` while that is not known, and where too little is measured to say.
    pub is_safe: Option<bool>,
    /// How much of the vessels is measured; `None` where they are not measured.
    pub coverage: Option<Coverage>,
    /// What is said of the vessels; `None` where they are not measured.
    pub calibre: Option<CalibreSummary>,
    /// Grave ones first, in the order of their weight.
    pub findings: Vec<Finding>,
}

impl Verdict {
    /// The head, with how much is measured where it speaks of that.
    pub fn head_text(&self) -> HeadText {
        let head = self.head;
        match (head, self.coverage) {
            (Head::Safe | Head::KeptWhereMeasured, Some(found)) => HeadText::Covered { head, coverage: found.text() },
            _ => HeadText::Alone(head),
        }
    }

    /// Whether it is known that a trial had better not rest on the result, or that too little is measured to say.
    pub fn has_reservations(&self) -> bool {
        matches!(self.head, Head::ToLookAt { .. } | Head::KeptWhereMeasured | Head::NoneMeasured)
    }

    /// The head, and what is weightiest: a sentence each, as `say` says them.
    pub fn in_short(&self, say: impl Fn(&dyn Message) -> String) -> String {
        let grave = self.findings.first().filter(|finding| finding.is_grave).map(|finding| say(&finding.what));
        let head = say(&self.head_text());
        let head = head.trim_end_matches('.');
        match grave.or_else(|| Some(say(self.calibre.as_ref()?))) {
            Some(text) => format!("{head}. {text}"),
            None => format!("{head}."),
        }
    }
}
