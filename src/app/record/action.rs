//! What can be asked of reports and pictures, and what of it stays chosen.

use crate::report::ReportFormat;

/// What can be asked of reports and pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Open the sheet of the report.
    Describe,
    /// Save a report.
    Report(ReportFormat),
    /// Whether it bears the name of the file.
    NameFile(bool),
    /// Save what is seen of the surface, so many times as large.
    Picture(u32),
    /// Whether there is nothing behind it there.
    Clear(bool),
    /// Save the surface as it turns.
    Turntable,
    /// The same as a video.
    Video,
    /// Save the surface as it is reduced and comes back.
    Film,
    /// Save what is compared, as a picture.
    Figure,
    /// Give up what is being drawn.
    Cancel,
}

/// What a user has chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::app) struct Chosen {
    /// Whether a report bears the name of the file.
    pub(in crate::app) names_file: bool,
    /// Whether there is nothing behind the surface in pictures.
    pub(in crate::app) is_clear: bool,
}
