//! `cargo xtask package`: what is handed to others. A Debian package and an archive of the desktop program, and an archive
//! of `dist/` with the headers that common hosts of static files are told by; by itself the package for JavaScript.
//!
//! The same program and `dist/` give the same bytes: files are sorted, and their times are those of `SOURCE_DATE_EPOCH` or
//! 1980.

mod archive;
mod clean_root;
mod deb;
mod files;
mod headers;
pub(crate) mod npm;
mod packed;

use std::path::PathBuf;
use std::process::Command;

use anyhow::{Context as _, Result, bail};
use clap::{Args, ValueEnum};

use crate::build;
use crate::step::{cargo, run, step, target};

pub(crate) use headers::HEADERS;
use packed::VERSION;

/// Options of `cargo xtask package`.
#[derive(Args)]
pub(crate) struct Options {
    /// The package for JavaScript alone, as a folder and as `npm pack` packs it.
    #[arg(value_enum)]
    only: Option<Only>,
    /// The desktop program to pack, in place of a release build.
    #[arg(long)]
    program: Option<PathBuf>,
    /// The browser app to pack, in place of a build.
    #[arg(long)]
    dist: Option<PathBuf>,
    /// Let pages of this origin, such as https://lectures.example, have the browser app as a part; may be given more than once.
    #[arg(long, value_name = "ORIGIN")]
    embed_in: Vec<String>,
    /// Install the program from the checkout, and the Debian package in a clean Debian; run both. As root, with debootstrap.
    #[arg(long = "try")]
    tries: bool,
}

/// A package that is made by itself.
#[derive(Clone, Copy, ValueEnum)]
enum Only {
    /// `target/package/npm` and its archive.
    Npm,
}

/// Makes the packages in `target/package` and says where they are.
pub(crate) fn package(options: &Options) -> Result<()> {
    let out = target().join("package");
    std::fs::create_dir_all(&out).with_context(|| format!("{} cannot be made", out.display()))?;
    if let Some(Only::Npm) = options.only {
        return npm::package(&out);
    }
    if !cfg!(target_os = "linux") {
        bail!("packages are made on Linux");
    }
    let program = match &options.program {
        Some(program) => program.clone(),
        None => step("Compile the desktop program", || {
            run(cargo().args(["build", "--quiet", "--release", "--package=lumen", "--bin=lumen"]))?;
            Ok(target().join("release/lumen"))
        })?,
    };
    let dist = options.dist.clone().map_or_else(build::build, Ok)?;
    let write = |name: &str, bytes: &[u8]| -> Result<PathBuf> {
        let path = out.join(name);
        std::fs::write(&path, bytes).with_context(|| format!("{} cannot be written", path.display()))?;
        eprintln!("    {:>10} {}", bytes.len(), path.display());
        Ok(path)
    };
    let machine = std::env::consts::ARCH;
    let files = step("Gather the program's files", || files::desktop(&program))?;
    let deb = step("Make the Debian package", || {
        write(&format!("lumen_{VERSION}_{}.deb", deb::architecture()?), &deb::deb(&files)?)
    })?;
    step("Make the archive of the program", || {
        let folder = format!("lumen-{VERSION}-linux-{machine}");
        write(&format!("{folder}.tar.gz"), &archive::tar_gz(&files, &folder)?)
    })?;
    step("Make the archive of the browser app", || {
        write(&format!("lumen-{VERSION}-web.zip"), &archive::zip(&files::site(&dist, &options.embed_in)?)?)
    })?;
    if options.tries {
        step("Install the program from the checkout", install)?;
        clean_root::try_package(&deb)?;
    }
    Ok(())
}

/// Installs the program as docs/install.md says, into a folder of its own, and runs it.
fn install() -> Result<()> {
    let place = target().join("installed");
    run(cargo().args(["install", "--quiet", "--locked", "--force", "--path", "."]).arg("--root").arg(&place))?;
    run(Command::new(place.join("bin/lumen")).arg("--version"))
}
