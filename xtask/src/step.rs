//! Steps: commands that are run, what is said about them, and how long they take; and where what they work on lies.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::RecvTimeoutError;
use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, bail};

/// The checkout's root.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("xtask lies in the checkout")
}

/// Cargo's target directory, where the tools and the stamps are kept too.
pub(crate) fn target() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |dir| root().join(dir))
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

/// Does something, saying what before and how long it took after.
pub(crate) fn step<T>(what: &str, work: impl FnOnce() -> Result<T>) -> Result<T> {
    eprintln!("==> {what}");
    let begun = Instant::now();
    let result = work().with_context(|| format!("could not {}", lower_first(what)));
    if result.is_ok() {
        eprintln!("    {what}: {:.1} s", begun.elapsed().as_secs_f64());
    }
    result
}

/// [`step`] for work that prints nothing by itself for long: says every ten seconds how far it is, by what it took the last
/// time, or at first `usual_s`, the seconds it takes from nothing on two cores.
pub(crate) fn quiet_step<T>(what: &str, usual_s: f64, work: impl FnOnce() -> Result<T>) -> Result<T> {
    let file = target().join("steps").join(format!("{}.seconds", what.replace(' ', "-").to_lowercase()));
    let last = std::fs::read_to_string(&file).ok().and_then(|text| text.trim().parse().ok());
    let expected = last.unwrap_or(usual_s);
    let begun = Instant::now();
    let result = step(what, || {
        eprintln!("    takes about {}", duration(expected));
        std::thread::scope(|scope| {
            let (done, ended) = std::sync::mpsc::channel::<()>();
            scope.spawn(move || {
                while ended.recv_timeout(Duration::from_secs(10)) == Err(RecvTimeoutError::Timeout) {
                    eprintln!("    {} of about {}", duration(begun.elapsed().as_secs_f64()), duration(expected));
                }
            });
            let result = work();
            drop(done);
            result
        })
    });
    if result.is_ok() {
        // Without it the next run has the usual time, which is no harm.
        let _ = std::fs::create_dir_all(target().join("steps"))
            .and_then(|()| std::fs::write(&file, format!("{:.1}", begun.elapsed().as_secs_f64())));
    }
    result
}

/// Seconds, as people say them.
fn duration(seconds: f64) -> String {
    match seconds.round() as u64 {
        seconds @ 0..90 => format!("{seconds} s"),
        seconds => format!("{} min {} s", seconds / 60, seconds % 60),
    }
}

fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

/// Runs a command in the checkout's root, with its output shown, and fails if it fails.
pub(crate) fn run(command: &mut Command) -> Result<()> {
    let status = command.current_dir(root()).status().with_context(|| format!("{} did not start", name(command)))?;
    if !status.success() {
        bail!("{} ended with {status}", name(command));
    }
    Ok(())
}

/// What a command prints, or `None` if it is not there or fails.
pub(crate) fn output(command: &mut Command) -> Option<String> {
    let output = command.current_dir(root()).stderr(Stdio::null()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// The command as one would type it.
pub(crate) fn name(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(|word| word.to_string_lossy().into_owned()).collect::<Vec<_>>().join(" ")
}

/// The cargo that runs this.
pub(crate) fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// The first of `names` that is on the PATH.
pub(crate) fn on_path(names: &[&str]) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    names.iter().find_map(|name| std::env::split_paths(&path).map(|dir| dir.join(name)).find(|file| file.is_file()))
}
