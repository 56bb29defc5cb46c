//! `cargo xtask peers`: Lumen natively and in the browser beside VTK, meshoptimizer and fast-simplification.
//!
//! What runs is in `benches/peers` (`run.py` puts the contenders in turn); here it is installed, started, and its report
//! made into the tables of `docs/benchmarks/peers.md` and `quality.csv` (`report` reads it, `tables` writes them).

mod report;
mod tables;

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};
use serde_json::json;

use crate::step::{cargo, output, root, run, step, target};
use crate::{build, document, tools};

/// What `cargo xtask peers` can be told.
#[derive(clap::Args)]
pub(crate) struct Options {
    /// Fewer runs, one setting of quality, no five million triangles; the document stays as it is
    #[arg(long)]
    quick: bool,
    /// Runs of every contender, in turn; 7 and 5 for the two surfaces
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    runs: Option<u32>,
    /// Leave the browser out
    #[arg(long)]
    native_only: bool,
    /// Surfaces to use, as PLY, in place of the two of the bench; the document stays as it is
    #[arg(long, value_name = "FILE.ply")]
    input: Vec<PathBuf>,
    /// Write the tables of a report that is there already
    #[arg(long, value_name = "REPORT.json", conflicts_with_all = ["quick", "runs", "input", "native_only"])]
    from: Option<PathBuf>,
}

/// The sizes of the bench, and the files that have them where `LUMEN_DATA` is.
const SURFACES: [(u32, &str); 2] = [(74_307, "aorta74k.ply"), (1_000_000, "aorta1m.ply")];
/// Sizes at which memory is told.
const MEMORY: [u32; 2] = [1_000_000, 5_000_000];

/// Runs the bench and prints its tables; they go into the document too where they are whole.
pub(crate) fn peers(options: &Options) -> Result<()> {
    if let Some(file) = &options.from {
        return publish(file, true);
    }
    let folder = target().join("peers");
    std::fs::create_dir_all(&folder)?;
    let (setup, report) = (folder.join("setup.json"), folder.join("report.json"));
    let python = tools::peers_python(&folder)?;
    std::fs::write(&setup, serde_json::to_string_pretty(&prepare(options, &folder)?)?)?;
    step("Run Lumen and its peers in turn", || {
        let script = root().join("benches/peers/run.py");
        run(Command::new(python).arg(script).arg(&setup).arg(&report))
    })?;
    publish(&report, !options.quick && options.input.is_empty() && !options.native_only)
}

/// Builds what is to be run, makes the surfaces, and says where all of it is.
fn prepare(options: &Options, folder: &Path) -> Result<serde_json::Value> {
    let npm = tools::npm_packages("benches/peers", "peers/npm", "Install meshoptimizer and vtk.js from npm")?;
    let native = native_meshoptimizer(folder)?;
    let lumen = native_lumen(folder)?;
    let surfaces = surfaces(options, folder, &lumen)?;
    let memory = if options.input.is_empty() { memory(options, folder, &lumen)? } else { Vec::new() };
    let (browser, environment) = if options.native_only {
        (None, json!({}))
    } else {
        let (dist, npm, chromium) = (build::build()?, tools::npm()?, tools::chromium()?);
        build::messages()?;
        let environment = json!({ "LUMEN_DIST": dist, "LUMEN_NPM": npm, "CHROMIUM": chromium, "LUMEN_PROGRAM": lumen });
        (Some(root().join("benches/peers/lumen.mjs")), environment)
    };
    let rust = output(Command::new("rustc").arg("--version")).unwrap_or_default();
    let node = output(Command::new("node").arg("--version")).unwrap_or_default();
    let versions = json!({
        "Rust": rust.split(' ').nth(1),
        "Node": node.trim_start_matches('v'),
        "meshoptimizer (npm)": version_in(&npm.join("node_modules/meshoptimizer/package.json"))?,
        "vtk.js": version_in(&npm.join("node_modules/@kitware/vtk.js/package.json"))?,
        "meshoptimizer (native, crate meshopt)": tools::locked("benches/peers/native/Cargo.lock", "meshopt")?,
    });
    Ok(json!({
        "surfaces": surfaces,
        "memory": memory,
        "lumen": lumen,
        "browser": browser,
        "environment": environment,
        "meshoptimizer": native,
        "meshoptimizer_wasm": root().join("benches/peers/meshoptimizer.mjs"),
        "vtkjs": root().join("benches/peers/vtkjs.mjs"),
        "peers_npm": npm,
        "versions": versions,
    }))
}

/// A file name as this system has it.
fn program(name: &str) -> String {
    format!("{name}{}", std::env::consts::EXE_SUFFIX)
}

/// The command line: the release build without the window, beside the one that may be there with it.
fn native_lumen(folder: &Path) -> Result<PathBuf> {
    let built = folder.join("lumen");
    step("Compile lumen", || {
        let build = ["build", "--quiet", "--release", "--package=lumen", "--bin=lumen", "--no-default-features"];
        run(cargo().args(build).env("CARGO_TARGET_DIR", &built))
    })?;
    Ok(built.join("release").join(program("lumen")))
}

/// meshoptimizer compiled for this machine.
fn native_meshoptimizer(folder: &Path) -> Result<PathBuf> {
    tools::cpp_compiler()?;
    let built = folder.join("native");
    step("Compile meshoptimizer", || {
        let manifest = root().join("benches/peers/native/Cargo.toml");
        run(cargo()
            .args(["build", "--quiet", "--release", "--locked", "--manifest-path"])
            .arg(manifest)
            .env("CARGO_TARGET_DIR", &built))
    })?;
    Ok(built.join("release").join(program("lumen-peer-meshoptimizer")))
}

/// The surfaces of the bench: those named, or the two of `LUMEN_DATA`, or samples of the same size.
fn surfaces(options: &Options, folder: &Path, lumen: &Path) -> Result<Vec<serde_json::Value>> {
    let entry = |file: PathBuf, runs: u32, qualities: usize| -> Result<serde_json::Value> {
        let file = file.canonicalize().with_context(|| format!("{} is not there", file.display()))?;
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let runs = options.runs.unwrap_or(runs);
        Ok(json!({ "name": name, "file": file, "runs": runs, "qualities": qualities }))
    };
    if !options.input.is_empty() {
        return options.input.iter().map(|file| entry(file.clone(), 3, 1)).collect();
    }
    let data = std::env::var_os("LUMEN_DATA").map_or_else(|| root().join("../shared/data"), PathBuf::from);
    let found = |(triangles, name): (u32, &str)| match data.join("bench").join(name) {
        file if file.is_file() => Ok(file),
        _ => phantom(folder, lumen, triangles, "ply"),
    };
    let [small, large] = SURFACES;
    Ok(if options.quick {
        vec![entry(found(small)?, 3, 1)?, entry(found(large)?, 1, 0)?]
    } else {
        vec![entry(found(small)?, 7, 2)?, entry(found(large)?, 5, 1)?]
    })
}

fn memory(options: &Options, folder: &Path, lumen: &Path) -> Result<Vec<PathBuf>> {
    let sizes = if options.quick { &MEMORY[..1] } else { &MEMORY[..] };
    sizes.iter().map(|&triangles| phantom(folder, lumen, triangles, "stl")).collect()
}

/// The aorta sample with so many triangles, as a file.
fn phantom(folder: &Path, lumen: &Path, triangles: u32, extension: &str) -> Result<PathBuf> {
    let file = folder.join(format!("phantom-aorta-{triangles}.{extension}"));
    if !file.is_file() {
        let mut command = Command::new(lumen);
        command.args(["phantom", "aorta", "--triangles", &triangles.to_string(), "-o"]).arg(&file);
        let made = command.output().with_context(|| format!("{} did not start", lumen.display()))?;
        if !made.status.success() {
            bail!("no sample of {triangles} triangles: {}", String::from_utf8_lossy(&made.stderr));
        }
    }
    Ok(file)
}

/// The version in a package.json.
fn version_in(file: &Path) -> Result<String> {
    let package: serde_json::Value = serde_json::from_slice(&std::fs::read(file)?)?;
    package["version"].as_str().map(str::to_owned).with_context(|| format!("{} has no version", file.display()))
}

/// Prints the tables of a report and, where it is `whole`, puts them into the document.
fn publish(file: &Path, whole: bool) -> Result<()> {
    let text = std::fs::read_to_string(file).with_context(|| format!("{} cannot be read", file.display()))?;
    let report = report::Report::parse(&text)?;
    let blocks = tables::blocks(&report);
    for (name, block) in &blocks {
        println!("{block}\n");
        match *name {
            _ if !whole => {}
            "quality" => document::write_csv("docs/benchmarks/quality.csv", block)?,
            _ => document::replace("docs/benchmarks/peers.md", name, block)?,
        }
    }
    Ok(())
}
