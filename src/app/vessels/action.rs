//! What can be asked of the vessels.

use crate::vessel::CentrelineFormat;

/// What can be asked of the vessels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Show or hide them.
    Toggle,
    /// Draw the radius along the branch of this number.
    Select(u32),
    /// Save the calibre at each place of each branch.
    SaveTable,
    /// Save the centrelines.
    SaveCentrelines(CentrelineFormat),
}

/// What of the vessels can be saved: what it is called, how it is asked for, what is in it.
pub(in crate::app) const FILES: [(&str, Action, &str); 3] = [
    (
        "Centrelines (VTP)...",
        Action::SaveCentrelines(CentrelineFormat::Vtp),
        "Of the surface as opened, with the radius of the inscribed ball, as vmtk names its arrays",
    ),
    ("Centrelines (CSV)...", Action::SaveCentrelines(CentrelineFormat::Csv), "Of the surface as opened, a row a place"),
    ("Calibre (CSV)...", Action::SaveTable, "Area and radius as opened, smoothed and reduced, a row a place"),
];
