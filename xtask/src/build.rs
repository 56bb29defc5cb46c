//! `cargo xtask build`: the browser app as a folder of static files.
//!
//! Trunk builds the program and lays out the folder, wasm-opt makes the module smaller and faster, and the page is
//! stamped (`page`). The build fails if a first visit would have to download more than 4 MB, gzip-compressed.

use std::hash::{DefaultHasher, Hasher as _};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};
use flate2::Compression;
use flate2::write::GzEncoder;

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
    let bin = tools::wasm_tools()?;
    let npm = tools::npm()?;
    step("Compile the browser app", || {
        // The same call as Trunk's, so that cargo alone decides what has to be compiled again.
        run(cargo().args(["build", "--quiet", "--release", "--target=wasm32-unknown-unknown", "--package=lumen-web"]))
    })?;

    let stamp_file = dist_stamp();
    let stamp = inputs()?;
    let unchanged = dist.join("index.html").is_file() && std::fs::read_to_string(&stamp_file).is_ok_and(|s| s == stamp);
    if !unchanged {
        step("Lay out dist/ with Trunk", || trunk(&bin))?;
        step("Optimise the module with wasm-opt", || optimise(&npm, &dist.join(MODULE)))?;
        page::stamp(&dist, &dist.join(MODULE))?;
    }
    report_sizes(&dist)?;
    std::fs::write(&stamp_file, stamp).context("the stamp cannot be written")?;
    Ok(dist)
}

fn dist_stamp() -> PathBuf {
    target().join("dist.stamp")
}

fn trunk(bin: &Path) -> Result<()> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let path = std::env::join_paths(std::iter::once(bin.to_owned()).chain(std::env::split_paths(&path)))?;
    // Some machines set NO_COLOR to 1, which this Trunk takes for a malformed option.
    run(Command::new(bin.join("trunk"))
        .args(["build", "--release", "--log=warn"])
        .env("PATH", path)
        .env_remove("NO_COLOR"))
}

/// Optimises for speed: the pipeline runs in here.
fn optimise(npm: &Path, module: &Path) -> Result<()> {
    let optimised = module.with_extension("opt");
    let before = std::fs::metadata(module)?.len();
    let script = npm.join("node_modules/binaryen/bin/wasm-opt");
    let mut node = Command::new("node");
    run(node.arg(script).arg("-O3").args(WASM_FEATURES).arg(module).arg("-o").arg(&optimised))?;
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
fn files_below(folder: &Path) -> Result<Vec<PathBuf>> {
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
    files.push(root().join("Trunk.toml"));
    files.push(root().join("xtask/npm/package-lock.json"));
    files.push(target().join("wasm32-unknown-unknown/release/lumen-web.wasm"));
    files.push(std::env::current_exe()?);
    files.sort();
    let mut hasher = DefaultHasher::new();
    for file in files {
        hasher.write(&std::fs::read(&file).with_context(|| format!("{} cannot be read", file.display()))?);
    }
    Ok(format!("{:016x}", hasher.finish()))
}
