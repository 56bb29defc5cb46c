//! The test meshes: where they are, and which of them are vessels.

use std::path::{Path, PathBuf};

/// The folder of the test meshes: where `LUMEN_DATA` says, else `../shared/data` beside the checkout. They are not
/// part of the repository; `None` where there are none.
pub fn data() -> Option<PathBuf> {
    let folder = std::env::var_os("LUMEN_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    folder.join("INDEX.md").exists().then_some(folder)
}

/// Vessels of the test meshes that can be smoothed and reduced.
pub const VESSELS: [&str; 11] = [
    "bench/aorta74k.ply",
    "real/aorta-surface-open-ends.stl",
    "real/aorta-surface-segment-2.stl",
    "real/beamadapter_carotids.stl",
    "real/beamadapter_phantom.obj",
    "real/cathsim_low_tort_arch.stl",
    "real/matteopescio_abdominal_aorta_phantom.stl",
    "real/steve_mechanical_thrombectomy.obj",
    "real/steve_vessel_architecture.obj",
    "real/vmtk_aorta_mra_iso1000.ply",
    "real/vmtk_aorta_mra_iso800.stl",
];
