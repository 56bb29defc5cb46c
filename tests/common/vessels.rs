//! Vessels of the test meshes that can be smoothed and reduced.

pub(crate) const VESSELS: [&str; 11] = [
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
