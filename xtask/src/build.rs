//! `cargo xtask build`: the browser app as a folder of static files.
//!
//! wasm-bindgen makes the glue between module and page, wasm-opt makes the module smaller, the files of `www`
//! are put beside them and the page is stamped (`page`). `trunk build` lays out the same folder for those who have Trunk,
//! less wasm-opt and the stamp; here it would be minutes of compiling for a copy. The build fails if a first visit would
//! have to download more than 4 MB, gzip-compressed.

use std::hash::{DefaultHasher, Hasher as _};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};
use flate2::Compression;
use flate2::write::GzEncoder;
use wasm_bindgen_cli_support::Bindgen;

use crate::step::{cargo, root, run, step, target};
use crate::{page, tools};

/// The most a first visit may download, in bytes, each file compressed with gzip.
const BUDGET: usize = 4_000_000;

const MODULE: &str = "lumen-web_bg.wasm";

/// The features of `.cargo/config.toml`, with those that Rust switches on by itself.
const WASM_FEATURES: [&str; 7] = [
    "--enable-bulk-memory",
    "--enable-multivalue",
    "--enable-mutable-globals",
    "--enable-nontrapping-float-to-int",
    "--enable-reference-types",
    "--enable-sign-ext",
    "--enable-simd",
];

/// Builds `dist/`, or leaves it as it is where nothing has changed since the last build, and returns its path.
pub(crate) fn build() -> Result<PathBuf> {
    let dist = root().join("dist");
    tools::wasm_target()?;
    let npm = tools::npm()?;
    step("Compile the browser app", || {
        run(cargo().args(["build", "--quiet", "--release", "--target=wasm32-unknown-unknown", "--package=lumen-web"]))
    })?;

    let stamp_file = dist_stamp();
    let stamp = inputs()?;
    let unchanged = dist.join("index.html").is_file() && std::fs::read_to_string(&stamp_file).is_ok_and(|s| s == stamp);
    if !unchanged {
        // What is there stays until all of the new is.
        let made = target().join("dist");
        step("Lay out dist/ with wasm-bindgen", || lay_out(&made))?;
        step("Optimise the module with wasm-opt", || optimise(&npm, &made.join(MODULE)))?;
        page::stamp(&made, &made.join(MODULE))?;
        replace(&made, &dist)?;
    }
    report_sizes(&dist)?;
    std::fs::write(&stamp_file, stamp).context("the stamp cannot be written")?;
    Ok(dist)
}

fn dist_stamp() -> PathBuf {
    target().join("dist.stamp")
}

/// The compiled program, before wasm-bindgen.
fn program() -> PathBuf {
    target().join("wasm32-unknown-unknown/release/lumen-web.wasm")
}

/// Makes the folder `made` of module, glue and the files of `www`.
fn lay_out(made: &Path) -> Result<()> {
    if made.exists() {
        std::fs::remove_dir_all(made).with_context(|| format!("{} cannot be removed", made.display()))?;
    }
    std::fs::create_dir_all(made)?;
    Bindgen::new().input_path(program()).web(true)?.typescript(false).generate(made)?;
    for file in files_below(&root().join("www"))? {
        let name = file.file_name().context("a file of www has no name")?;
        std::fs::copy(&file, made.join(name)).with_context(|| format!("{} cannot be copied", file.display()))?;
    }
    Ok(())
}

/// Puts the folder `made` in the place of `dist`, by copies: the target directory may lie on another disk.
fn replace(made: &Path, dist: &Path) -> Result<()> {
    if dist.exists() {
        std::fs::remove_dir_all(dist).with_context(|| format!("{} cannot be removed", dist.display()))?;
    }
    std::fs::create_dir_all(dist)?;
    for file in files_below(made)? {
        let name = file.file_name().context("a file of dist has no name")?;
        std::fs::copy(&file, dist.join(name)).with_context(|| format!("{} cannot be copied", file.display()))?;
    }
    Ok(())
}

/// Makes the module smaller; for speed the compiler has optimised it. A higher level takes three times as long, and made
/// it 3 % larger once compressed.
fn optimise(npm: &Path, module: &Path) -> Result<()> {
    let optimised = module.with_extension("opt");
    let before = std::fs::metadata(module)?.len();
    let script = npm.join("node_modules/binaryen/bin/wasm-opt");
    let mut node = Command::new("node");
    run(node.arg(script).arg("-O1").args(WASM_FEATURES).arg(module).arg("-o").arg(&optimised))?;
    std::fs::rename(&optimised, module)?;
    let after = std::fs::metadata(module)?.len();
    eprintln!("    {:.2} MB before, {:.2} MB after", before as f64 / 1e6, after as f64 / 1e6);
    Ok(())
}

/// Prints what a first visit downloads and fails if that is too much.
fn report_sizes(dist: &Path) -> Result<()> {
    let (mut raw, mut compressed) = (0, 0);
    let mut files = files_below(dist)?;
    files.sort();
    for file in &files {
        let bytes = std::fs::read(file)?;
        let gzip = gzip(&bytes)?.len();
        raw += bytes.len();
        compressed += gzip;
        let name = file.strip_prefix(dist).unwrap_or(file).display();
        eprintln!("    {:>10} {:>10} gzip  {name}", bytes.len(), gzip);
    }
    eprintln!("    {raw:>10} {compressed:>10} gzip  in all, {BUDGET} allowed");
    if compressed > BUDGET {
        bail!("a first visit downloads {compressed} bytes, {} more than allowed", compressed - BUDGET);
    }
    Ok(())
}

/// `bytes` as a web server would send them.
pub(crate) fn gzip(bytes: &[u8]) -> Result<Vec<u8>> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::new(6));
    encoder.write_all(bytes)?;
    Ok(encoder.finish()?)
}

/// Every file below a folder.
pub(crate) fn files_below(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(|| format!("{} cannot be read", folder.display()))? {
        let path = entry?.path();
        if path.is_dir() {
            files.append(&mut files_below(&path)?);
        } else {
            files.push(path);
        }
    }
    Ok(files)
}

/// A hash of all that goes into `dist/`.
fn inputs() -> Result<String> {
    let mut files = files_below(&root().join("www"))?;
    files.push(root().join("xtask/npm/package-lock.json"));
    files.push(program());
    files.push(std::env::current_exe()?);
    files.sort();
    let mut hasher = DefaultHasher::new();
    for file in files {
        hasher.write(&std::fs::read(&file).with_context(|| format!("{} cannot be read", file.display()))?);
    }
    Ok(format!("{:016x}", hasher.finish()))
}
