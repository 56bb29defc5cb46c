//! `cargo xtask bench-trial`: a step of the trial at a million triangles and 300 nodes, natively and in the browser.

use std::process::Command;

use anyhow::Result;

use crate::step::{cargo, root, run, step, target};
use crate::{build, tools};

/// Runs `benches/trial.rs` with either input, and what it leaves in the trial's Worker (`benches/trial.mjs`).
pub(crate) fn bench_trial() -> Result<()> {
    let folder = target().join("trial");
    let (dist, npm, chromium) = (build::build()?, tools::npm()?, tools::chromium()?);
    build::messages()?;
    for row in ["1000000", "p1000000"] {
        step("Measure the trial natively", || {
            let bench = ["bench", "--quiet", "--bench=trial", "--no-default-features", "--", row];
            run(cargo().args(bench).env("LUMEN_TRIAL_LOG", &folder))
        })?;
        step("Measure the trial in the browser", || {
            let script = root().join("benches/trial.mjs");
            let mut node = Command::new("node");
            run(node
                .arg(script)
                .arg(&folder)
                .env("LUMEN_DIST", &dist)
                .env("LUMEN_NPM", &npm)
                .env("CHROMIUM", &chromium))
        })?;
    }
    Ok(())
}
