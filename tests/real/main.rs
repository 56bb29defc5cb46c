//! What is tried over lists: the facts of `data/INDEX.md`, real vessels, and surfaces made here under many settings.
//!
//! The test meshes are no part of the repository: they are looked for where `LUMEN_DATA` says, else in `../shared/data`
//! beside the checkout. Where there are none, one trial is reported as ignored, not as passed.

#![allow(clippy::disallowed_methods, reason = "a test compares within bounds")]

mod arrays;
mod guarantees;
mod import;
mod measures;
mod mending;
mod pipeline;
mod public;
mod route;
#[cfg(feature = "scans")]
mod scans;
mod smoothing;
mod smoothing_oracle;
mod spare_thin;
mod trial;
mod verdict;

use libtest_mimic::{Arguments, Trial};
use lumen_test_support::data::data;

fn main() {
    let mut trials = guarantees::made();
    match data() {
        Some(folder) => {
            let parts = [
                arrays::trials,
                guarantees::trials,
                import::trials,
                measures::trials,
                mending::trials,
                pipeline::trials,
                public::trials,
                spare_thin::trials,
                route::trials,
                smoothing::trials,
                smoothing_oracle::trials,
                trial::trials,
                verdict::trials,
            ];
            trials.extend(parts.into_iter().flat_map(|part| part(&folder)));
            #[cfg(feature = "scans")]
            trials.extend(scans::trials(&folder));
        }
        None => {
            eprintln!("no test meshes: set LUMEN_DATA to their folder");
            trials.push(Trial::test("real vessels", || Ok(())).with_ignored_flag(true));
        }
    }
    libtest_mimic::run(&Arguments::from_args(), trials).exit()
}
