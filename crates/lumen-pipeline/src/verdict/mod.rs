//! What there is to say of a result, the weightiest first: whether a trial may rest on it, else what is to be looked at,
//! where that is, and what would help. The window, the command line, the numbers that are written and the page for the
//! record all say these.

mod finding;
mod judging;
mod written;

pub use finding::{Finding, FindingKind, Head, HeadText, Place, PlaceLabel, Remedied, Remedy, RemedyLabel, Verdict};
pub use judging::{Known, Rest, rate, takes_more};
pub use written::{FindingReport, PlaceReport, RemedyReport, VerdictReport};
