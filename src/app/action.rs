//! What the user asks for. Every control and key says it in these words, and [`LumenApp`](super::LumenApp) does it in one
//! place. Of the panels it knows their actions alone, each of which stands in a file that knows no panel.

use super::options::ViewOptions;
use super::row::Part;
use super::{collapses, compare, lesson, measure, playback, record, reference, scan, solver, trial, vessels};
use crate::io::{Axes, Format, Unit};
use crate::language::Language;
use crate::phantom::Sample;
use crate::pipeline::settings::Settings;
use crate::render::StandardView;

/// What the user asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Choose a file to open.
    Open,
    /// Invite no longer to open one.
    Uninvite,
    /// Choose a file to open whose numbers are in this unit.
    OpenIn(Unit),
    /// Open the next of the files that came together.
    OpenNext,
    /// Take away what is told.
    TakeAway,
    /// Open the file that is shown again, with its numbers in this unit.
    ReadIn(Unit),
    /// Open a sample.
    Sample(Sample),
    /// Save the shown level.
    Save(Format),
    /// Save the level and coarser ones in one file.
    SaveLevels,
    /// Take the axes of the surface, whose file does not state them, to be these.
    Axes(Axes),
    /// Save surfaces in these axes; `None` for those that they have.
    SaveAxes(Option<Axes>),
    /// Go over to these settings.
    Set(Box<Settings>),
    /// One step back.
    Undo,
    /// One step forth.
    Redo,
    /// Stop what is going on.
    Cancel,
    /// Fit the surface into the views.
    Fit,
    /// Look from a side.
    View(StandardView),
    /// Look at a place, and ring it.
    GoTo {
        /// In mm.
        at_mm: [f32; 3],
        /// What is to be seen there, in mm.
        height_mm: f32,
        /// What there is to say of it.
        label: String,
    },
    /// Look at a place.
    LookAt {
        /// In mm.
        at_mm: [f32; 3],
        /// What is to be seen there, in mm.
        height_mm: f32,
    },
    /// Ring a place, without going there.
    Mark {
        /// In mm.
        at_mm: [f32; 3],
        /// What there is to say of it.
        label: String,
    },
    /// Mark a stretch that the ringed place lies in, and what it is measured by: it goes with the ring.
    MarkStretch {
        /// Places along it, in mm.
        along_mm: Vec<[f32; 3]>,
        /// Places that are ringed besides, in mm, and what there is to say of them.
        beside: Vec<([f32; 3], String)>,
    },
    /// Take the ring off that marks a place.
    Unmark,
    /// Show other things in the views.
    Show(ViewOptions),
    /// Show the pieces that are left out as well, all of them in view: a click keeps one.
    ChoosePieces,
    /// Show the surface as it was opened beside the level in one picture, or no longer.
    Reveal,
    /// Show what as many passes of plain Laplacian smoothing make of the surface, in place of it as it was opened, or no longer.
    Average(bool),
    /// Show the surface as it was opened, for as long as this is so.
    HoldBefore(bool),
    /// Leave the other modes and what stands beside the views.
    Prepare,
    /// Show or leave the compare view.
    Compare,
    /// Something of the comparison.
    Comparison(compare::action::Action),
    /// Something of the comparison with another file.
    Reference(reference::action::Action),
    /// Start a trial or leave it.
    ToggleTrial,
    /// Something of the trial.
    Trial(trial::action::Action),
    /// Something of the step that makes a level ready for a solver.
    Solver(solver::action::Action),
    /// Something of the vessels and their calibre.
    Vessels(vessels::action::Action),
    /// Something of what is measured.
    Measure(measure::action::Action),
    /// Something of the collapses, one by one.
    Collapses(collapses::action::Action),
    /// Something of the reduction that is played.
    Playback(playback::action::Action),
    /// Unfold a part of the panel, and scroll to it.
    Unfold(Part),
    /// Something of the lessons.
    Lesson(lesson::action::Action),
    /// Save the settings as a file.
    SaveSettings,
    /// Copy a link with the settings and the file's digits.
    CopyLink,
    /// Something of reports and pictures.
    Record(record::action::Action),
    /// Keep the surfaces that are opened for the next start, or do so no longer.
    KeepSurface(bool),
    /// Forget everything that is kept on this device.
    Forget,
    /// Something of a scan.
    Scan(scan::action::Action),
    /// Present, or no longer.
    Present,
    /// Speak a language; `None` for that of the system.
    Speak(Option<Language>),
    /// The other theme.
    Theme,
    /// Show or hide the keys.
    Help,
    /// Show or hide what Lumen is.
    About,
}
