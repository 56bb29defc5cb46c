//! What can be asked of reports and pictures.

use crate::report::ReportFormat;

/// What can be asked of reports and pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
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
    /// Give up what is being drawn.
    Cancel,
}
