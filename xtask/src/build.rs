//! `cargo xtask build`: the browser app as a folder of static files.
//!
//! There are two programs: the page's, which a first visit waits for, and that of scans, which is fetched in the background.
//! wasm-bindgen makes the glue between module and page, what the first picture does without becomes a module of its own
//! (`split`), wasm-opt makes the modules smaller and terser the glue, the files of `www` are put beside them and the page is
//! stamped (`page`). `trunk build` lays out the same folder for those who have Trunk,
//! less wasm-opt and the stamp; here it would be minutes of compiling for a copy. The build fails if a first visit would
//! have to download more than 3.2 MB, gzip-compressed, before the app starts.

use std::hash::{DefaultHasher, Hasher as _};
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, bail};
use flate2::Compression;
use flate2::write::GzEncoder;

use crate::step::{cargo, files_below, quiet_step, root, run, step, target};
use crate::{glue, page, split, tools};

/// The most a first visit may download, in bytes, each file compressed with gzip.
const BUDGET: usize = 3_200_000;

/// The page's program, and that of scans. Each is built by itself: together they would share the features of both.
const PROGRAMS: [&str; 2] = ["lumen-web", "lumen-scan"];

/// The half of the page's module that its first picture does without.
const LATE: &str = "lumen-web_late.wasm";

/// The languages whose messages are no part of the program, and what their files end in.
pub(crate) const LANGUAGES: [&str; 2] = ["de", "fr"];
const MESSAGES: &str = "ftl";

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
    build_beside(&[])
}

/// As [`build`], with programs that have the page's features and none beside: in one run they share what is compiled.
pub(crate) fn build_beside(others: &[&str]) -> Result<PathBuf> {
    let dist = root().join("dist");
    tools::wasm_target()?;
    let npm = tools::npm()?;
    quiet_step("Compile the browser app", 480.0, || {
        let [page, scans] = PROGRAMS;
        compile(&[&[page], others].concat())?;
        compile(&[scans])
    })?;

    let stamp_file = dist_stamp();
    let stamp = inputs()?;
    let unchanged = dist.join("index.html").is_file() && std::fs::read_to_string(&stamp_file).is_ok_and(|s| s == stamp);
    if !unchanged {
        // What is there stays until all of the new is.
        let made = target().join("dist");
        step("Lay out dist/ with wasm-bindgen", || lay_out(&made))?;
        let page = made.join(module(PROGRAMS[0]));
        let late = made.join(LATE);
        step("Take apart what the first picture does without", || split::split(&page, &late))?;
        quiet_step("Optimise the modules with wasm-opt", 40.0, || {
            let modules = PROGRAMS.map(|program| made.join(module(program)));
            modules.iter().chain([&late]).try_for_each(|module| optimise(&npm, module))
        })?;
        step("Shorten the scripts with terser", || {
            PROGRAMS.into_iter().try_for_each(|program| glue::shorten(&npm, &made.join(format!("{program}.js"))))
        })?;
        page::stamp(&made, &page)?;
        replace(&made, &dist)?;
    }
    report_sizes(&dist)?;
    std::fs::write(&stamp_file, stamp).context("the stamp cannot be written")?;
    Ok(dist)
}

/// Compiles `benches/messages.rs`, by which `benches/worker.mjs` speaks with a Worker.
pub(crate) fn messages() -> Result<()> {
    step("Compile what speaks with the browser's Worker", || {
        run(cargo().args(["bench", "--quiet", "--no-run", "--bench=messages", "--no-default-features"]))
    })
}

/// Compiles programs for the browser.
pub(crate) fn compile(programs: &[&str]) -> Result<()> {
    let options = ["--quiet", "--release", "--target=wasm32-unknown-unknown"];
    let programs = programs.iter().flat_map(|program| ["--package", program]);
    run(cargo().arg("build").args(options).args(programs))
}

fn dist_stamp() -> PathBuf {
    target().join("dist.stamp")
}

/// A compiled program, before wasm-bindgen.
pub(crate) fn compiled(program: &str) -> PathBuf {
    target().join(format!("wasm32-unknown-unknown/release/{program}.wasm"))
}

/// The file of a program's module in `dist/`.
fn module(program: &str) -> String {
    format!("{program}_bg.wasm")
}

/// Makes the folder `made` of modules, glue and the files of `www`.
fn lay_out(made: &Path) -> Result<()> {
    if made.exists() {
        std::fs::remove_dir_all(made).with_context(|| format!("{} cannot be removed", made.display()))?;
    }
    std::fs::create_dir_all(made)?;
    for program in PROGRAMS {
        glue::write(&compiled(program), made)?;
    }
    for file in files_below(&root().join("www"))? {
        let name = file.file_name().context("a file of www has no name")?;
        std::fs::copy(&file, made.join(name)).with_context(|| format!("{} cannot be copied", file.display()))?;
    }
    for tag in LANGUAGES {
        let mut files = files_below(&root().join("crates/lumen-language/locales").join(tag))?;
        files.sort();
        let texts: Vec<String> = files.iter().map(std::fs::read_to_string).collect::<Result<_, _>>()?;
        std::fs::write(made.join(format!("lumen-{tag}.{MESSAGES}")), texts.join("\n"))?;
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
pub(crate) fn optimise(npm: &Path, module: &Path) -> Result<()> {
    let optimised = module.with_extension("opt");
    let before = std::fs::metadata(module)?.len();
    let script = npm.join("node_modules/binaryen/bin/wasm-opt");
    let mut node = Command::new("node");
    // Functions of one name and crate are alike: side by side, in order of size gzip would make a thirteenth more of them.
    run(node
        .arg(script)
        .args(["-O1", "--reorder-functions-by-name"])
        .args(WASM_FEATURES)
        .arg(module)
        .arg("-o")
        .arg(&optimised))?;
    std::fs::rename(&optimised, module)?;
    let after = std::fs::metadata(module)?.len();
    eprintln!("    {:.2} MB before, {:.2} MB after", before as f64 / 1e6, after as f64 / 1e6);
    Ok(())
}

/// Endings of what the start does not wait for, as a browser test sees it too (`shell.test.mjs`): texts of other languages,
/// what an installed app has, the engines' Worker, the licence of the letters.
const LATER: [&str; 7] = [LATE, MESSAGES, ".png", ".webmanifest", "service-worker.js", "worker.js", ".txt"];

/// Prints what a first visit downloads, and what is fetched in the background, and fails if the first is too much.
fn report_sizes(dist: &Path) -> Result<()> {
    let (mut raw, mut compressed, mut later) = (0, 0, 0);
    let mut files = files_below(dist)?;
    files.sort();
    for file in &files {
        let bytes = std::fs::read(file)?;
        let gzip = gzip(&bytes)?.len();
        let name = file.strip_prefix(dist).unwrap_or(file).display().to_string();
        if name.starts_with(PROGRAMS[1]) || LATER.iter().any(|ending| name.ends_with(ending)) {
            later += gzip;
        } else {
            raw += bytes.len();
            compressed += gzip;
        }
        eprintln!("    {:>10} {:>10} gzip  {name}", bytes.len(), gzip);
    }
    eprintln!(
        "    {raw:>10} {compressed:>10} gzip  before the app starts, {BUDGET} allowed; {later} in the background"
    );
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

/// A hash of all that goes into `dist/`.
fn inputs() -> Result<String> {
    let mut files = files_below(&root().join("www"))?;
    files.push(root().join("xtask/npm/package-lock.json"));
    for tag in LANGUAGES {
        files.extend(files_below(&root().join("crates/lumen-language/locales").join(tag))?);
    }
    files.extend(PROGRAMS.map(compiled));
    files.push(std::env::current_exe()?);
    files.sort();
    let mut hasher = DefaultHasher::new();
    for file in files {
        hasher.write(&std::fs::read(&file).with_context(|| format!("{} cannot be read", file.display()))?);
    }
    Ok(format!("{:016x}", hasher.finish()))
}
