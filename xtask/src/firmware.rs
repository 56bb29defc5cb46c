//! `cargo xtask firmware`: the tests of the open feeder's firmware, and its program for the RP2040.

use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;

use crate::step::{cargo, output, root, run, step, target};
use crate::tools;

/// Of the RP2040's Cortex-M0+.
const TARGET: &str = "thumbv6m-none-eabi";

/// Builds the firmware for its board, or says why not, after its tests.
pub(crate) fn firmware() -> Result<()> {
    step("Test the firmware on this machine", || {
        run(&mut in_firmware(&["test", "--quiet", "--locked", "--package", "lumen-feeder"]))
    })?;
    match build()? {
        Some(program) => println!("{}: see docs/haptic-device.md for how to flash it", program.display()),
        None => println!("firmware not built: there is no {TARGET} (rustup target add {TARGET})"),
    }
    Ok(())
}

/// The program in ELF, or `None` where the target cannot be had.
fn build() -> Result<Option<PathBuf>> {
    if !tools::has_target(TARGET) {
        // Where there is no rustup or no way to its server, the tests are all that can be done.
        output(Command::new("rustup").args(["--quiet", "target", "add", TARGET]));
        if !tools::has_target(TARGET) {
            return Ok(None);
        }
    }
    step("Build the firmware for the RP2040", || {
        run(&mut in_firmware(&["build", "--quiet", "--locked", "--release", "--target", TARGET]))
    })?;
    Ok(Some(folder().join(TARGET).join("release/lumen-firmware")))
}

/// A workspace of its own, with a folder of its own in the target directory.
fn in_firmware(arguments: &[&str]) -> Command {
    let mut command = cargo();
    command.args(arguments).arg("--manifest-path").arg(root().join("firmware/Cargo.toml"));
    command.arg("--target-dir").arg(folder());
    command
}

fn folder() -> PathBuf {
    target().join("firmware")
}
