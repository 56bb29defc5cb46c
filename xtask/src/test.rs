//! `cargo xtask test`: every test, or with `--quick` those that answer within minutes, and at the end how many passed.

use std::io::{BufRead as _, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use anyhow::{Context as _, Result, anyhow, bail};
use clap::ValueEnum;

use crate::estimate::Estimate;
use crate::lacking::{self, Machine};
use crate::package::npm;
use crate::step::{cargo, files_below, name, root, step, target};
use crate::{build, firmware, tools};

/// What `--quick` runs: the arguments of `cargo test` in turn, and files of tests/browser.
const QUICK: ([&[&str]; 3], [&str; 2]) = (
    [
        // The unit tests of every crate.
        &["--workspace", "--lib", "--bins"],
        // A real window, and the app without one: it opens, is moved by its controls, says what it is.
        &["--package=lumen", "--test=window", "--", "the window starts"],
        &["--package=lumen-ui-tests", "--test=app", "--", "controls::", "labels::"],
    ],
    // From the file dialog to the saved file; files that are refused.
    ["open-reduce-save.test.mjs", "bad-file.test.mjs"],
);

/// What all other runs do: everything. What counts instructions has no tests, and an interpreter to compile.
const ALL: &[&str] = &["--workspace", "--exclude=lumen-instructions", "--exclude=xtask"];

/// By itself it is compiled from what its own command was made of.
const XTASK: &[&str] = &["--package=xtask"];

/// What a build without window and scans says of what it lacks. All of ours is compiled anew for two sentences, hence not
/// optimised, and with `--long` alone: `.ci/run` lets clippy look at that build.
const BARE: &[&str] = &[
    "--package=lumen",
    "--no-default-features",
    "--test=program",
    "--config=profile.dev.package.lumen-io.opt-level=0",
    "--config=profile.dev.package.lumen-mesh.opt-level=0",
    "--config=profile.dev.package.lumen-pipeline.opt-level=0",
    "--config=profile.dev.package.lumen-prepare.opt-level=0",
    "--config=profile.dev.package.lumen-trial.opt-level=0",
    "--config=profile.dev.package.lumen-vessel.opt-level=0",
    "--config=profile.dev.package.lumen-volume.opt-level=0",
    "--",
    "without_scans::",
];

/// How much of the tests is run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Extent {
    /// [`QUICK`].
    Quick,
    /// All tests, each on a sample of what it could try.
    Ordinary,
    /// All tests on everything.
    Long,
}

impl Extent {
    /// Which times of earlier runs are its own; the ordinary run's have no name.
    fn name(self) -> Option<&'static str> {
        match self {
            Self::Quick => Some("quick"),
            Self::Ordinary => None,
            Self::Long => Some("long"),
        }
    }
}

/// A part of the tests.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Suite {
    /// Library, command line and window, as `cargo test` runs them, and the firmware.
    Native,
    /// The built app in headless Chromium, the npm package there and in Node.
    Browser,
}

/// Counts of one run.
#[derive(Clone, Copy, Default)]
struct Counts {
    passed: u64,
    failed: u64,
    ignored: u64,
}

impl Counts {
    fn add(&mut self, other: Self) {
        self.passed += other.passed;
        self.failed += other.failed;
        self.ignored += other.ignored;
    }
}

/// Runs the suites named in `only`, or all of them, and fails if a test fails. What the machine lacks is told first and what
/// needs it is skipped; where `is_whole`, or where a suite is named that cannot be run at all, that is a failure.
pub(crate) fn test(only: &[Suite], extent: Extent, is_whole: bool) -> Result<()> {
    let asked: Vec<Suite> =
        [Suite::Native, Suite::Browser].into_iter().filter(|suite| only.is_empty() || only.contains(suite)).collect();
    let machine = Machine::prepared(&asked, extent)?;
    machine.told().iter().for_each(|line| println!("{line}"));
    if !machine.told().is_empty() && is_whole || !machine.browses() && only == [Suite::Browser] {
        bail!("not every test can be run here");
    }
    let wanted = |suite| asked.contains(&suite) && (suite != Suite::Browser || machine.browses());
    let suites =
        [(Suite::Native, "native"), (Suite::Browser, "browser")].into_iter().filter(|(suite, _)| wanted(*suite));
    let names: Vec<&str> = extent.name().into_iter().chain(suites.map(|(_, name)| name)).collect();
    let mut estimate = Estimate::new(&names.join("-"));
    let mut total = Counts { ignored: machine.left_out(), ..Counts::default() };
    let mut sound = true;
    let mut add = |(counts, ended_well): (Counts, bool)| {
        total.add(counts);
        sound &= ended_well;
    };
    let done = std::thread::scope(|scope| {
        // Linking and wasm-opt are one thread for minutes: they go on beside the native tests.
        let built = wanted(Suite::Browser).then(|| scope.spawn(move || Built::new(extent)));
        let native = if wanted(Suite::Native) {
            native(&machine, extent, &mut estimate).map(&mut add).and_then(|()| match extent {
                Extent::Quick => Ok(()),
                _ => firmware::firmware(),
            })
        } else {
            Ok(())
        };
        estimate.end();
        let browser = match built.map(std::thread::ScopedJoinHandle::join) {
            None => Ok(()),
            Some(Ok(Ok(built))) => browser(&machine, &built, extent, &mut estimate).map(&mut add),
            Some(Ok(Err(error))) => Err(error),
            Some(Err(_)) => Err(anyhow!("the build of the browser app panicked")),
        };
        native.and(browser)
    });
    estimate.keep();
    println!("{} passed, {} failed, {} skipped", total.passed, total.failed, total.ignored);
    // Where they are seen: what was told at the start is far above.
    machine.told().iter().for_each(|line| println!("{line}"));
    done?;
    if total.failed > 0 || !sound {
        bail!("not every test passed");
    }
    Ok(())
}

fn native(machine: &Machine, extent: Extent, estimate: &mut Estimate) -> Result<(Counts, bool)> {
    let whole = |arguments: &[&str]| arguments.iter().map(|argument| (*argument).to_owned()).collect::<Vec<_>>();
    let all = match (extent, machine.draws()) {
        (Extent::Quick, true) => QUICK.0.map(whole).to_vec(),
        // The second is the window's.
        (Extent::Quick, false) => vec![whole(QUICK.0[0])],
        (_, true) => vec![whole(ALL)],
        (_, false) => lacking::without_drawing(ALL).to_vec(),
    };
    let rest: &[&[&str]] = match extent {
        Extent::Quick => &[],
        Extent::Ordinary => &[XTASK],
        Extent::Long => &[XTASK, BARE],
    };
    let runs = all.into_iter().chain(rest.iter().map(|arguments| whole(arguments)));
    estimate.begin("compile the native tests");
    let (mut counts, mut ended_well) = (Counts::default(), true);
    step("Run the native tests", || {
        for arguments in runs {
            let mut command = cargo_test(machine.display.as_deref(), &arguments)?;
            if extent == Extent::Long {
                command.env("LUMEN_LONG", "1");
            }
            if let Some(python) = &machine.python {
                // The Python package is compared with the command line.
                command.env("LUMEN_PYTHON", python).env("LUMEN_PROGRAM", program());
            }
            let (found, well) = count(&mut command, cargo_counts, cargo_part, estimate)?;
            counts.add(found);
            ended_well &= well;
        }
        Ok((counts, ended_well))
    })
}

/// The command line, as it is built with the native tests.
fn program() -> PathBuf {
    target().join("debug").join(format!("lumen{}", std::env::consts::EXE_SUFFIX))
}

/// `cargo test` on a display.
fn cargo_test(display: Option<&Path>, arguments: &[String]) -> Result<Command> {
    let cargo = cargo();
    let mut command = match display {
        Some(xvfb_run) => {
            let mut command = Command::new(xvfb_run);
            command.args(["--auto-servernum", "--server-args=-screen 0 1280x800x24"]).arg(cargo.get_program());
            command
        }
        None => cargo,
    };
    command.args(["test", "--no-fail-fast"]).args(arguments);
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // Where there is no desktop session, what looks for a display complains in every test that opens a window.
        let folder = target().join("run");
        std::fs::create_dir_all(&folder)?;
        command.env("XDG_RUNTIME_DIR", folder);
    }
    Ok(command)
}

/// "     Running tests/real/main.rs (target/debug/deps/real-14627fb9)", on the error output: the binary that is run,
/// without its hash.
fn cargo_part(line: &str) -> Option<&str> {
    let (_, binary) = line.trim_start().strip_prefix("Running ")?.trim_end_matches(')').rsplit_once(['/', '\\'])?;
    binary.rsplit_once('-').map(|(name, _)| name)
}

/// "test result: ok. 12 passed; 0 failed; 1 ignored; ..."
fn cargo_counts(line: &str, counts: &mut Counts) {
    let Some((_, figures)) = line.strip_prefix("test result: ").and_then(|rest| rest.split_once(". ")) else { return };
    for figure in figures.split("; ") {
        let Some((number, what)) = figure.split_once(' ') else { continue };
        let Ok(number) = number.parse::<u64>() else { continue };
        match what {
            "passed" => counts.passed += number,
            "failed" => counts.failed += number,
            "ignored" => counts.ignored += number,
            _ => {}
        }
    }
}

/// What runs in browsers.
struct Built {
    /// The app.
    dist: PathBuf,
    /// The npm package.
    package: Option<PathBuf>,
    /// The libraries of its examples.
    examples: Option<PathBuf>,
}

impl Built {
    fn new(extent: Extent) -> Result<Self> {
        let has_package = extent != Extent::Quick;
        let dist = build::build_beside(if has_package { &[npm::PROGRAM] } else { &[] })?;
        let finish = if extent == Extent::Long { npm::Finish::Small } else { npm::Finish::Quick };
        let package = has_package.then(|| npm::folder(finish)).transpose()?;
        let libraries = || tools::npm_packages("tests/npm", "npm-examples", "Install three.js and vtk.js from npm");
        let examples = (extent == Extent::Long).then(libraries).transpose()?;
        Ok(Self { dist, package, examples })
    }
}

fn browser(machine: &Machine, built: &Built, extent: Extent, estimate: &mut Estimate) -> Result<(Counts, bool)> {
    let npm = tools::npm()?;
    let chromium = machine.chromium.as_ref().context("there is no browser")?;
    let mut files: Vec<_> = ["tests/browser", "tests/npm"]
        .into_iter()
        .map(|folder| files_below(&root().join(folder)))
        .collect::<Result<Vec<_>>>()?
        .concat()
        .into_iter()
        .filter(|path| path.to_string_lossy().ends_with(".test.mjs"))
        .filter(|path| extent != Extent::Quick || QUICK.1.iter().any(|name| path.ends_with(name)))
        .collect();
    files.sort();
    // As a test's, so that it has the features of the native tests and is there once they have run.
    step("Compile the command line the browser is compared with", || {
        crate::step::run(cargo().args(["test", "--quiet", "--no-run", "--test=program"]).args(ALL))
    })?;
    let mut command = Command::new("node");
    command
        // One at a time: they measure times, and the browser draws on the processor.
        .args(["--test", "--test-concurrency=1", "--test-reporter=spec"])
        .args(files)
        .env("CHROMIUM", chromium)
        .envs(tools::angle())
        .env("LUMEN_DIST", &built.dist)
        .env("LUMEN_NPM", npm)
        .env("LUMEN_PROGRAM", program());
    if extent == Extent::Long {
        command.env("LUMEN_LONG", "1");
    }
    for (name, folder) in [("LUMEN_PACKAGE", &built.package), ("LUMEN_EXAMPLES", &built.examples)] {
        command.envs(folder.iter().map(|folder| (name, folder)));
    }
    estimate.begin("browser tests");
    step("Run the browser tests", || count(&mut command, node_counts, |_| None, estimate))
}

/// "ℹ pass 5"
fn node_counts(line: &str, counts: &mut Counts) {
    let mut words = line.trim_start_matches(|letter: char| !letter.is_ascii_alphabetic()).split(' ');
    let (Some(what), Some(Ok(number)), None) = (words.next(), words.next().map(str::parse::<u64>), words.next()) else {
        return;
    };
    match what {
        "pass" => counts.passed += number,
        "fail" | "cancelled" => counts.failed += number,
        "skipped" | "todo" => counts.ignored += number,
        _ => {}
    }
}

/// Runs a test runner with its output shown and read; whether it ended well is told beside the counts. `part` finds in a
/// line of the error output what begins there.
fn count(
    command: &mut Command,
    read: fn(&str, &mut Counts),
    part: fn(&str) -> Option<&str>,
    estimate: &mut Estimate,
) -> Result<(Counts, bool)> {
    let mut runner = command
        .current_dir(root())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .with_context(|| format!("{} did not start", name(command)))?;
    let mut counts = Counts::default();
    let (output, errors) = (runner.stdout.take(), runner.stderr.take());
    std::thread::scope(|scope| {
        // Both have to be read, or the one that is not fills up and the runner waits.
        scope.spawn(|| {
            let lines = errors.into_iter().flat_map(|errors| BufReader::new(errors).split(b'\n')).map_while(Result::ok);
            for line in lines {
                // A driver may print what is no text.
                let line = String::from_utf8_lossy(&line);
                eprintln!("{line}");
                if let Some(part) = part(&line) {
                    estimate.begin(part);
                    estimate.left().into_iter().for_each(|left| eprintln!("     {left}"));
                }
            }
        });
        for line in output.into_iter().flat_map(|output| BufReader::new(output).lines()) {
            let line = line.context("what a test runner prints is no text")?;
            println!("{line}");
            read(&line, &mut counts);
        }
        anyhow::Ok(())
    })?;
    Ok((counts, runner.wait()?.success()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn summaries_are_read() {
        let mut counts = Counts::default();
        cargo_counts(
            "test result: ok. 12 passed; 0 failed; 1 ignored; 0 measured; 0 filtered out; finished in 0.1s",
            &mut counts,
        );
        cargo_counts("test result: FAILED. 3 passed; 2 failed; 0 ignored; 0 measured; 0 filtered out", &mut counts);
        node_counts("ℹ pass 5", &mut counts);
        node_counts("ℹ fail 1", &mut counts);
        node_counts("    pass the file to the chooser", &mut counts);
        assert_eq!((counts.passed, counts.failed, counts.ignored), (20, 3, 1));
        let part = cargo_part("     Running unittests src/lib.rs (target/debug/deps/lumen-189a92ad)");
        assert_eq!(part, Some("lumen"));
        assert_eq!(cargo_part("   Compiling lumen v0.1.0 (folder)"), None);
    }
}
