//! Where the test meshes are, and what a test does where there are none.

use std::path::{Path, PathBuf};

use libtest_mimic::{Arguments, Trial};

/// The folder of the test meshes: where `LUMEN_DATA` says, else `../shared/data` beside the checkout. They are not
/// part of the repository; `None` where there are none.
pub(crate) fn data() -> Option<PathBuf> {
    let folder = std::env::var_os("LUMEN_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
    folder.join("INDEX.md").exists().then_some(folder)
}

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
