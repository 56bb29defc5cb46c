//! What can be asked of the collapses.

/// Something of the collapses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// Show or hide them.
    Toggle,
    /// One on, or one back.
    Step(bool),
    /// Let them follow one another, or no longer.
    Play,
    /// Go to the place of each, or no longer.
    Follow(bool),
    /// Say where the vertex at this node may go.
    Why(u32),
}
