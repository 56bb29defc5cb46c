//! `cargo xtask fuzz-trial`: random input for a wire, a million steps; `cargo xtask fuzz-surfaces`: a hundred thousand
//! surfaces that are no manifolds.

use anyhow::Result;

use crate::step::{cargo, root, run};

/// Runs the fuzz test of the trial with so many steps.
pub(crate) fn trial(steps: u64) -> Result<()> {
    run(cargo()
        .args(["test", "--release", "--no-default-features", "--test", "trial", "--", "fuzz::", "--nocapture"])
        .env("LUMEN_FUZZ_STEPS", steps.to_string())
        .current_dir(root()))
}

/// Runs the fuzz test of decimation on so many surfaces, those of `seed`.
pub(crate) fn surfaces(count: u32, seed: u32) -> Result<()> {
    run(cargo()
        .args(["test", "--release", "--no-default-features", "--test", "surface", "--", "fuzz::", "--nocapture"])
        .env("LUMEN_FUZZ_SURFACES", count.to_string())
        .env("LUMEN_FUZZ_SEED", seed.to_string())
        .current_dir(root()))
}
