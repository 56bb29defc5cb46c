//! The vessels, and what smoothing and reduction made of the calibre of each: a table, the radius along the one that is
//! chosen, and a way to each place.

mod action;
mod plot;
mod view;
mod words;

pub use self::action::Action;
pub(super) use self::action::FILES;
pub(super) use self::view::show;
pub(super) use self::words::verdict;

/// What of the vessels is shown.
#[derive(Clone, Copy, Debug, Default)]
pub struct Vessels {
    /// Whether they are shown.
    pub is_open: bool,
    /// The number of the branch whose radius is drawn; `None` for the one that stands first.
    pub selected: Option<u32>,
}
