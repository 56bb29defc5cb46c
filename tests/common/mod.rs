//! What a test does with the test meshes, and where there are none.

use std::path::Path;

use libtest_mimic::{Arguments, Trial};

mod data;

use data::data;

/// Runs the trials that `trials` makes of the data folder. Without one, a single trial is reported as ignored, not
/// as passed.
pub(crate) fn run(what: &str, trials: impl FnOnce(&Path) -> Vec<Trial>) -> ! {
    let arguments = Arguments::from_args();
    let trials = match data() {
        Some(folder) => trials(&folder),
        None => {
            eprintln!("no test meshes: set LUMEN_DATA to their folder");
            vec![Trial::test(what, || Ok(())).with_ignored_flag(true)]
        }
    };
    libtest_mimic::run(&arguments, trials).exit()
}
