//! The tests beside this file that are written in Python, as one of Cargo's: by the Python that `LUMEN_PYTHON` names, which has
//! what `requirements.txt` asks for. `cargo xtask test` makes one; without it nothing is run.
//!
//! The library as Cargo has built it with the rest is laid beside the Python sources, in the target directory. With `--long`
//! that Python has the wheel, and what the examples take.

use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Command, ExitCode, Stdio};
use std::{env, fs, io};

fn main() -> ExitCode {
    if env::args().any(|argument| argument == "--list") {
        return ExitCode::SUCCESS;
    }
    let Some(python) = env::var_os("LUMEN_PYTHON") else {
        println!("LUMEN_PYTHON names no Python with numpy and pytest");
        println!("test result: ok. 0 passed; 0 failed; 1 ignored");
        return ExitCode::SUCCESS;
    };
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut pytest = Command::new(python);
    pytest.args(["-m", "pytest", "-q", "-p", "no:cacheprovider"]).arg(here.join("tests"));
    if env::var_os("LUMEN_LONG").is_some() {
        pytest.arg(here.join("examples")).current_dir(env!("CARGO_TARGET_TMPDIR"));
    } else {
        let package = package().expect("the library and the sources are where Cargo has put them");
        pytest.current_dir(&package).env("PYTHONPATH", package);
    }
    let pytest = pytest.env("PYTHONDONTWRITEBYTECODE", "1").stdout(Stdio::piped()).spawn();
    let mut pytest = pytest.expect("LUMEN_PYTHON starts");
    let output = pytest.stdout.take().expect("the output is piped");
    let mut last = String::new();
    for line in BufReader::new(output).lines().map_while(Result::ok) {
        println!("{line}");
        last = line;
    }
    let is_well = pytest.wait().is_ok_and(|status| status.success());
    let [passed, failed, errors, skipped] = ["passed", "failed", "error", "skipped"].map(|what| counted(&last, what));
    let word = if is_well { "ok" } else { "FAILED" };
    println!("test result: {word}. {passed} passed; {} failed; {skipped} ignored", failed + errors);
    if is_well { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The folder that Python finds the package in.
fn package() -> io::Result<std::path::PathBuf> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("python");
    let (sources, there) = (Path::new(env!("CARGO_MANIFEST_DIR")).join("lumen"), folder.join("lumen"));
    fs::create_dir_all(&there)?;
    for source in fs::read_dir(sources)? {
        let source = source?.path();
        if let (true, Some(name)) = (source.is_file(), source.file_name()) {
            fs::copy(&source, there.join(name))?;
        }
    }
    let library = env::current_exe()?.with_file_name(format!("{DLL_PREFIX}_lumen{DLL_SUFFIX}"));
    let name = if cfg!(windows) { "_lumen.pyd" } else { "_lumen.abi3.so" };
    // Over one that a process still has open it would be written into that.
    let _ = fs::remove_file(there.join(name));
    fs::copy(library, there.join(name))?;
    Ok(folder)
}

/// Of "3 failed, 44 passed, 1 error in 9.67s" the number before a word that begins so.
fn counted(line: &str, what: &str) -> u64 {
    let words: Vec<&str> = line.split(' ').collect();
    let pair = words.windows(2).find(|pair| pair[1].starts_with(what));
    pair.and_then(|pair| pair[0].parse().ok()).unwrap_or(0)
}
