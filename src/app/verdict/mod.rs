//! The verdict on what is shown, above the views: whether a trial may rest on it, else what is to be looked at,
//! where that is, and what would help.

mod findings;
mod view;

pub(super) use self::findings::verdict;
pub(super) use self::view::{Strip, show};
