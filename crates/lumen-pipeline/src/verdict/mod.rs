//! What there is to say of a result, the weightiest first: whether a trial may rest on it, else what is to be looked at,
//! where that is, and what would help. The window, the command line, the numbers that are written and the page for the
//! record all say it in these words.

mod finding;
mod judging;

pub use finding::{Finding, Place, Remedied, Remedy, Verdict};
pub use judging::{Known, Rest, rate};
