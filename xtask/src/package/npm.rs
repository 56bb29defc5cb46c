//! The npm package: a folder, and the archive that `npm pack` makes of it. It is published by nobody here.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};

use super::packed::VERSION;
use crate::step::{files_below, output, quiet_step, root, step, target};
use crate::{build, glue, tools};

/// The program that the package's Worker runs.
pub(crate) const PROGRAM: &str = "lumen-npm";

/// The most that the package may be without its readme and types, in bytes, each file compressed with gzip.
const BUDGET: usize = 1_200_000;

/// Files of the checkout that the package has as they are.
const AS_THEY_ARE: [&str; 3] = ["web/npm/README.md", "LICENSE-APACHE", "LICENSE-MIT"];

/// How much is made of the module.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Finish {
    /// What tests need: of the program that was compiled beside the app's, a quarter of a minute sooner, and larger.
    Quick,
    /// What is handed to others.
    Small,
}

/// Makes the folder of the package and returns it.
pub(crate) fn folder(finish: Finish) -> Result<PathBuf> {
    if finish == Finish::Small {
        tools::wasm_target()?;
        quiet_step("Compile the npm package's program", 180.0, || build::compile(&[PROGRAM]))?;
    }
    let npm = tools::npm()?;
    // What tests have is not what is handed to others.
    let made = target().join(if finish == Finish::Small { "package/npm" } else { "npm-package" });
    step("Lay out the npm package", || {
        if made.exists() {
            std::fs::remove_dir_all(&made)?;
        }
        std::fs::create_dir_all(&made)?;
        glue::write(&build::compiled(PROGRAM), &made)?;
        let ours = files_below(&root().join("web/npm/js"))?;
        for file in ours.into_iter().chain(AS_THEY_ARE.map(|name| root().join(name))) {
            std::fs::copy(&file, made.join(file.file_name().context("a file has no name")?))
                .with_context(|| format!("{} cannot be copied", file.display()))?;
        }
        // The drawing of a saved page, as a module.
        let draw = std::fs::read_to_string(root().join("src/report/draw.js"))?;
        std::fs::write(made.join("draw.js"), draw + "\nexport { surfaceView };\n")?;
        let manifest = std::fs::read_to_string(root().join("web/npm/package.json"))?;
        std::fs::write(made.join("package.json"), manifest.replace("0.0.0", VERSION))?;
        Ok(())
    })?;
    if finish == Finish::Small {
        quiet_step("Optimise the npm package's module with wasm-opt", 25.0, || {
            build::optimise(&npm, &made.join(format!("{PROGRAM}_bg.wasm")))
        })?;
        step("Shorten the npm package's glue with terser", || {
            glue::shorten(&npm, &made.join(format!("{PROGRAM}.js")))
        })?;
        report_size(&made)?;
    }
    Ok(made)
}

/// Makes the folder and its archive.
pub(crate) fn package(out: &Path) -> Result<()> {
    let folder = folder(Finish::Small)?;
    step("Pack the npm package", || {
        let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
        let name = output(Command::new(npm).args(["pack", "--silent", "--pack-destination"]).arg(out).arg(&folder))
            .context("npm pack has failed")?;
        eprintln!("    {}", out.join(name).display());
        Ok(())
    })
}

/// Prints what a page downloads, and fails if it is too much.
fn report_size(made: &Path) -> Result<()> {
    let mut total = 0;
    let mut files = files_below(made)?;
    files.sort();
    for file in files.iter().filter(|file| file.extension().is_some_and(|kind| kind == "js" || kind == "wasm")) {
        let bytes = std::fs::read(file)?;
        let gzip = build::gzip(&bytes)?.len();
        total += gzip;
        eprintln!("    {:>10} {gzip:>10} gzip  {}", bytes.len(), file.file_name().unwrap_or_default().display());
    }
    eprintln!("    {total:>21} gzip  in all, {BUDGET} allowed");
    if total > BUDGET {
        bail!("the npm package is {total} bytes, {} more than allowed", total - BUDGET);
    }
    Ok(())
}
