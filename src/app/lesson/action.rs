//! What can be asked of the lessons.

/// Something of the lessons.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Begin the lesson of this name, of those that come with Lumen.
    Open(&'static str),
    /// Choose the file of a lesson.
    Choose,
    /// Go to this step, from 0.
    Go(usize),
    /// Show the answer.
    Answer,
    /// Copy a link to this step.
    CopyLink,
    /// Leave the lesson.
    Close,
    /// Show or hide the words that are used.
    Glossary,
}
