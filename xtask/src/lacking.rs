//! What tests need and this machine has none of, where nothing may be installed: it is told at the start, what needs it is
//! skipped and counted, and the rest is run.
//!
//! Without a Vulkan driver there is no device to draw with: the tests of drawing and of the window are left out. Without a
//! display the window itself does not open; its tests say so by themselves and count as skipped. Without Chromium there is
//! nothing to run the browser app in. Without Python its package is not tried.

use std::path::{Path, PathBuf};

use anyhow::Result;

use crate::step::root;
use crate::test::{Extent, Suite};
use crate::tools;

/// A thing that is lacking, and the line that says how it is got.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Lack {
    what: What,
    why: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum What {
    Vulkan,
    Display,
    Chromium,
    Python,
}

/// What this machine has for the tests, and what it lacks.
#[derive(Debug, Default)]
pub(crate) struct Machine {
    /// What a window is run under, where there is no display.
    pub(crate) display: Option<PathBuf>,
    /// The browser, where it is asked for.
    pub(crate) chromium: Option<PathBuf>,
    /// What runs the tests of the Python package, where they are asked for.
    pub(crate) python: Option<PathBuf>,
    lacks: Vec<Lack>,
}

/// Tests that draw: packages that are left out whole, and test programs of the others.
const DRAWING: ([&str; 1], [&str; 2]) = (["lumen-ui-tests"], ["render", "window"]);

impl Machine {
    /// Gets what `suites` need. What went wrong while it was installed ends the run.
    pub(crate) fn prepared(suites: &[Suite], extent: Extent) -> Result<Self> {
        let mut machine = Self::default();
        if suites.contains(&Suite::Native) {
            machine.take(What::Vulkan, tools::vulkan())?;
            machine.display = machine.take(What::Display, tools::display())?.flatten();
            machine.python = match extent {
                Extent::Quick => None,
                Extent::Ordinary => machine.take(What::Python, tools::package_python())?,
                Extent::Long => machine.take(What::Python, tools::wheel_python())?,
            };
        }
        if suites.contains(&Suite::Browser) {
            machine.chromium = machine.take(What::Chromium, tools::chromium())?;
        }
        Ok(machine)
    }

    fn take<T>(&mut self, what: What, found: Result<T>) -> Result<Option<T>> {
        match found {
            Ok(found) => Ok(Some(found)),
            Err(error) => match error.downcast::<tools::Missing>() {
                Ok(missing) => {
                    self.lacks.push(Lack { what, why: missing.to_string() });
                    Ok(None)
                }
                Err(error) => Err(error),
            },
        }
    }

    fn lacks(&self, what: What) -> bool {
        self.lacks.iter().any(|lack| lack.what == what)
    }

    /// Whether there is a device to draw with.
    pub(crate) fn draws(&self) -> bool {
        !self.lacks(What::Vulkan)
    }

    /// Whether the browser app can be run.
    pub(crate) fn browses(&self) -> bool {
        !self.lacks(What::Chromium)
    }

    /// What will be skipped and why, a line each; none where nothing is.
    pub(crate) fn told(&self) -> Vec<String> {
        let each = self.lacks.iter().map(|lack| {
            let skipped = match lack.what {
                What::Vulkan => "the tests that draw, and those of the window",
                What::Display => "the tests of the desktop window",
                What::Chromium => "the tests in the browser, and those of the npm package",
                What::Python => "the tests of the Python package",
            };
            format!("Skipped: {skipped}. {}", lack.why)
        });
        each.collect()
    }

    /// How many tests are left out, so that no runner counts them.
    pub(crate) fn left_out(&self) -> u64 {
        let mut count = 0;
        if !self.draws() {
            let folders = DRAWING.1.iter().map(|name| root().join("tests").join(name)).chain([root().join("tests/ui")]);
            count += folders.map(|folder| tests_in(&folder, "rs", "#[test]")).sum::<u64>();
        }
        if self.lacks(What::Python) {
            count += ["python/tests", "python/examples"]
                .map(|folder| tests_in(&root().join(folder), "py", "def test_"))
                .iter()
                .sum::<u64>();
        }
        if !self.browses() {
            count += ["tests/browser", "tests/npm"]
                .map(|folder| tests_in(&root().join(folder), "mjs", "test("))
                .iter()
                .sum::<u64>();
        }
        count
    }
}

/// The arguments of `cargo test` for all of the workspace that `arguments` name, without what draws: once the programs of
/// tests and once the examples in texts, which cargo runs by themselves.
pub(crate) fn without_drawing(arguments: &[&str]) -> [Vec<String>; 2] {
    let own = arguments.iter().map(|argument| (*argument).to_owned());
    let excluded = DRAWING.0.map(|package| format!("--exclude={package}"));
    let all: Vec<String> = own.chain(excluded).collect();
    let programs = programs(&root().join("tests"));
    let chosen = programs.into_iter().filter(|name| !DRAWING.1.contains(&name.as_str()));
    let tests = all.iter().cloned().chain(["--lib".to_owned(), "--bins".to_owned()]);
    let tests = tests.chain(chosen.map(|name| format!("--test={name}"))).collect();
    let texts = all.into_iter().chain(["--doc".to_owned()]).collect();
    [tests, texts]
}

/// The test programs in a folder, by name: files, and folders with a `main.rs`.
fn programs(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    let is_program = |path: &PathBuf| path.join("main.rs").is_file() || path.extension().is_some_and(|end| end == "rs");
    let names = entries.filter(is_program).filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()));
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

/// How many lines begin a test in a folder and below, or in the file of that name.
fn tests_in(folder: &Path, ending: &str, begins: &str) -> u64 {
    let file = folder.with_extension(ending);
    let files = crate::step::files_below(folder).unwrap_or_default();
    let files = files.into_iter().chain([file]).filter(|path| path.extension().is_some_and(|end| end == ending));
    let lines = |path: PathBuf| {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        text.lines().filter(|line| line.trim_start().starts_with(begins)).count() as u64
    };
    files.map(lines).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::anyhow;

    #[test]
    fn what_is_lacking_is_told_counted_and_left_out_and_what_fails_ends_the_run() {
        let mut machine = Machine::default();
        assert!(machine.told().is_empty() && machine.left_out() == 0 && machine.draws() && machine.browses());
        let missing = |what: &str| anyhow!(tools::Missing(format!("{what} is missing: install it")));
        assert_eq!(machine.take(What::Display, Ok(1)).unwrap(), Some(1));
        assert_eq!(machine.take::<()>(What::Vulkan, Err(missing("A Vulkan driver"))).unwrap(), None);
        assert_eq!(machine.take::<()>(What::Chromium, Err(missing("Chromium"))).unwrap(), None);
        assert!(machine.take::<()>(What::Display, Err(anyhow!("apt-get ended with 100"))).is_err());
        assert_eq!(
            machine.told(),
            [
                "Skipped: the tests that draw, and those of the window. A Vulkan driver is missing: install it",
                "Skipped: the tests in the browser, and those of the npm package. Chromium is missing: install it",
            ]
        );
        assert!(!machine.draws() && !machine.browses() && machine.left_out() > 100, "{}", machine.left_out());
    }

    #[test]
    fn without_drawing_all_other_test_programs_are_run() {
        let [tests, texts] = without_drawing(&["--workspace"]);
        let has = |argument: &str| tests.iter().any(|own| own == argument);
        assert!(
            ["--workspace", "--lib", "--bins", "--test=program", "--test=surface"].into_iter().all(has),
            "{tests:?}"
        );
        assert!(!has("--test=render") && !has("--test=window") && has("--exclude=lumen-ui-tests"), "{tests:?}");
        assert_eq!(texts, ["--workspace", "--exclude=lumen-ui-tests", "--doc"]);
    }
}
