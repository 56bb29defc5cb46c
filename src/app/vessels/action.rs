//! What can be asked of the vessels.

use crate::language::Key;
use crate::vessel::CentrelineFormat;

/// What can be asked of the vessels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Show or hide them.
    Toggle,
    /// Draw the radius along the branch of this number.
    Select(u32),
    /// Compare the narrowest place of the branch that is drawn with the one at this arc length in mm; `None` for what stands on
    /// both sides of a narrowing.
    Refer(Option<f64>),
    /// Show them, with the one that is measured least, and go to where it is not.
    ShowUnmeasured,
    /// Draw the radius along the branch of this number, and go to its narrowing: the stretch is marked, and the places that it
    /// is measured by.
    ShowNarrowing(u32),
    /// Save the calibre at each place of each branch.
    SaveTable,
    /// Save the centrelines.
    SaveCentrelines(CentrelineFormat),
}

/// What of the vessels can be saved: what it is called, how it is asked for, what is in it.
pub(in crate::app) const FILES: [(Key, Action, Key); 3] = [
    (Key("vessels-save-vtp"), Action::SaveCentrelines(CentrelineFormat::Vtp), Key("vessels-save-vtp-help")),
    (Key("vessels-save-csv"), Action::SaveCentrelines(CentrelineFormat::Csv), Key("vessels-save-csv-help")),
    (Key("vessels-save-calibre"), Action::SaveTable, Key("vessels-save-calibre-help")),
];
