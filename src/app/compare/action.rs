//! What is asked of a comparison.

use super::arrangement::Arrangement;

/// What the user asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Compare the settings in force too.
    Add,
    /// Compare those of the paper's Figure 6.
    Figure6,
    /// Compare those of its Figure 7.
    Figure7,
    /// Arrange the pictures so.
    Arrange(Arrangement),
    /// Colour the others by their distance from the first, or no longer.
    Difference,
    /// Compare this no more.
    Remove(u64),
    /// Try again one that was stopped or failed.
    Retry(u64),
    /// Back to the two views.
    Close,
}
