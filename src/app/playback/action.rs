//! What can be asked while the reduction is played.

/// Something of the reduction that is played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Show or hide it.
    Toggle,
    /// Play, or stop where it is.
    Play,
    /// Take so many seconds from one end to the other and back.
    Last(f64),
}
