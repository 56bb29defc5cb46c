//! Where the test meshes are.

use std::path::{Path, PathBuf};

/// The folder of the test meshes: where `LUMEN_DATA` says, else `../shared/data` beside the checkout. They are not
/// part of the repository; `None` where there are none.
pub(crate) fn data() -> Option<PathBuf> {
    let folder = std::env::var_os("LUMEN_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data"), PathBuf::from);
    folder.join("INDEX.md").exists().then_some(folder)
}
