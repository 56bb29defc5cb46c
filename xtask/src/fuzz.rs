//! `cargo xtask fuzz-trial`: random input for a wire, a million steps; `cargo xtask fuzz-surfaces`: a hundred thousand
//! surfaces that are no manifolds; `cargo xtask fuzz-files`: libFuzzer on every reader, ten minutes each.

use std::process::Command;

use anyhow::{Result, bail};

use crate::step::{cargo, root, run, step, target};
use crate::tools;

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

/// The targets in `fuzz/fuzz_targets`.
const READERS: [&str; 7] = ["stl", "ply", "obj", "vtp", "vtk", "gltf", "scan"];
/// The longest file that is made up, in bytes.
const LONGEST: u32 = 1 << 14;
/// What a file may take: 64 MB and twenty times its length. libFuzzer counts whole MB, and an allocation at a time.
const MOST_MB: u32 = 64;

/// Lets libFuzzer make up files for the readers named, or for all, for so many minutes each.
pub(crate) fn files(only: &[String], minutes: u64) -> Result<()> {
    if let Some(unknown) = only.iter().find(|name| !READERS.contains(&name.as_str())) {
        bail!("{unknown} is no reader: {}", READERS.join(", "));
    }
    let cargo_fuzz = tools::cargo_fuzz()?;
    let folder = target().join("fuzz");
    let corpus = folder.join("corpus");
    // The rustup that names toolchains, not the cargo of the one that runs this.
    let nightly = |arguments: &[&str]| {
        let mut command = Command::new("rustup");
        command.args(["run", "nightly"]).args(arguments).env_remove("RUSTUP_TOOLCHAIN").env_remove("CARGO");
        command
    };
    let program = cargo_fuzz.to_string_lossy();
    let shared = ["--sanitizer", "none", "--target-dir"];
    step("Build the fuzz targets", || {
        let seeds = ["test", "--quiet", "--no-default-features", "--features=scans"];
        for samples in ["formats", "scans"] {
            run(cargo().args(seeds).args(["--test", samples, "--", "samples::seeds"]).env("LUMEN_SEEDS", &corpus))?;
        }
        run(nightly(&[&*program, "build"]).args(shared).arg(&folder))
    })?;
    for reader in READERS.into_iter().filter(|reader| only.is_empty() || only.iter().any(|name| name == reader)) {
        step(&format!("Fuzz the reader of {reader} for {minutes} minutes"), || {
            run(nightly(&[&*program, "run"])
                .args(shared)
                .arg(&folder)
                .arg(reader)
                .arg(corpus.join(reader))
                .arg("--")
                .args(["-timeout=10", "-print_final_stats=1", "-verbosity=0"])
                .arg(format!("-max_len={LONGEST}"))
                .arg(format!("-malloc_limit_mb={MOST_MB}"))
                .arg(format!("-max_total_time={}", 60 * minutes)))
        })?;
    }
    Ok(())
}
