//! What is asked of the comparison with another file.

use crate::io::Unit;
use crate::pipeline::beside::Align;

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Choose a file to compare with.
    Choose,
    /// Compare with the next of the files that came together.
    TakeNext,
    /// Read the file with its numbers in this unit.
    Unit(Unit),
    /// Compare the level, or the surface as it was opened.
    OfLevel(bool),
    /// Move the surface so first.
    Align(Align),
    /// Give inside and outside the same colours.
    Plain(bool),
    /// Compare once more, after that was stopped.
    Again,
    /// Save the numbers.
    SaveNumbers,
    /// Save the table of stations.
    SaveStations,
    /// Show the comparison, or leave it.
    Show(bool),
}
