//! `cargo xtask fuzz-trial`: random input for a wire, a million steps.

use anyhow::Result;

use crate::step::{cargo, root, run};

/// Runs the fuzz test of the trial with so many steps.
pub(crate) fn fuzz(steps: u64) -> Result<()> {
    run(cargo()
        .args(["test", "--release", "--no-default-features", "--test", "trial_fuzz", "--", "--nocapture"])
        .env("LUMEN_FUZZ_STEPS", steps.to_string())
        .current_dir(root()))
}
