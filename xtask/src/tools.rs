//! What has to be there and how it is got: each function finds a tool or installs it.
//!
//! wasm-opt and playwright-core come from npm into `target/npm` (their versions are in `xtask/npm`), the browser and a
//! display for it from apt. wasm-bindgen is a library of xtask's own, of the version that Cargo.lock has for the app.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, anyhow, bail};

use crate::step::{cargo, on_path, output, root, run, step, target};

/// What is not there and cannot be installed here, and in one line how it is got.
#[derive(Debug)]
pub(crate) struct Missing(pub(crate) String);

impl std::fmt::Display for Missing {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Missing {}

/// The wasm target of the toolchain in use.
pub(crate) fn wasm_target() -> Result<()> {
    const TARGET: &str = "wasm32-unknown-unknown";
    if has_target(TARGET) {
        return Ok(());
    }
    step("Install the wasm target", || {
        run(Command::new("rustup").args(["target", "add", TARGET])).context(
            "where no wasm target can be downloaded, Debian's packages rustc-web, cargo-web, rust-web-src and lld-22 \
             build it from source: RUSTC_BOOTSTRAP=1 RUSTC=/usr/bin/rustc /usr/bin/cargo build \
             -Z build-std=std,panic_abort --target wasm32-unknown-unknown, with -C linker=rust-lld",
        )
    })
}

/// Whether the toolchain in use has the libraries of a target.
pub(crate) fn has_target(target: &str) -> bool {
    let libraries = output(Command::new("rustc").args(["--print", "target-libdir", "--target", target]));
    libraries.is_some_and(|dir| Path::new(&dir).is_dir())
}

/// The version of a package in a lock file of the checkout.
pub(crate) fn locked(file: &str, package: &str) -> Result<String> {
    let lock = std::fs::read_to_string(root().join(file)).with_context(|| format!("{file} cannot be read"))?;
    let mut lines = lock.lines();
    let name = format!("name = \"{package}\"");
    lines.find(|line| *line == name).with_context(|| format!("{file} has no {package}"))?;
    let version = lines.next().and_then(|line| line.strip_prefix("version = \"")?.strip_suffix('"'));
    version.map(str::to_owned).with_context(|| format!("{file} has no version of {package}"))
}

/// The folder with `node_modules`, as `xtask/npm` asks.
pub(crate) fn npm() -> Result<PathBuf> {
    npm_packages("xtask/npm", "npm", "Install wasm-opt, terser, playwright-core and axe-core from npm")
}

/// The folder of the target directory with `node_modules`, as the package.json in `asked` says.
pub(crate) fn npm_packages(asked: &str, folder: &str, what: &str) -> Result<PathBuf> {
    let (folder, asked) = (target().join(folder), root().join(asked));
    let same = |name: &str| std::fs::read(folder.join(name)).ok() == std::fs::read(asked.join(name)).ok();
    // npm writes this file last.
    let done = folder.join("node_modules/.package-lock.json").is_file();
    if done && same("package.json") && same("package-lock.json") {
        return Ok(folder);
    }
    if on_path(&["npm", "npm.cmd"]).is_none() {
        bail!("npm is missing: install Node.js 20 or newer");
    }
    step(what, || {
        std::fs::create_dir_all(&folder)?;
        for name in ["package.json", "package-lock.json"] {
            std::fs::copy(asked.join(name), folder.join(name))?;
        }
        let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
        run(Command::new(npm).args(["ci", "--silent", "--no-audit", "--no-fund", "--prefix"]).arg(&folder))
    })?;
    Ok(folder)
}

/// A Python with what `benches/peers/requirements.txt` asks for, in a virtual environment below `folder`.
pub(crate) fn peers_python(folder: &Path) -> Result<PathBuf> {
    let what = "Install VTK, fast-simplification, Open3D and MeshLab with pip (a minute or two, once)";
    let bin = python(folder, "benches/peers/requirements.txt", what)?;
    // Open3D and MeshLab load libraries of the system.
    if output(Command::new(&bin).args(["-c", "import open3d, pymeshlab, vtk"])).is_none() {
        apt("What Open3D loads", "libusb-1.0-0 libgomp1 libgl1 libegl1", "see what `import open3d` says")?;
    }
    Ok(bin)
}

/// A Python with what `tests/formats/requirements.txt` asks for, in a virtual environment below `folder`.
pub(crate) fn read_back_python(folder: &Path) -> Result<PathBuf> {
    python(folder, "tests/formats/requirements.txt", "Install VTK, trimesh and meshio with pip (a minute, once)")
}

/// A Python with what `python/tests/requirements.txt` asks for.
pub(crate) fn package_python() -> Result<PathBuf> {
    let folder = target().join("python");
    python(&folder, "python/tests/requirements.txt", "Install numpy, pytest and gymnasium with pip (seconds, once)")
}

/// A Python of its own with the package as a wheel, built by maturin, and with what tests and examples of it ask for.
pub(crate) fn wheel_python() -> Result<PathBuf> {
    let (folder, wheels) = (target().join("python/wheel"), target().join("python/wheels"));
    let maturin =
        python(&target().join("python/maturin"), "python/maturin.txt", "Install maturin with pip (seconds, once)")?;
    for old in [&folder, &wheels].into_iter().filter(|old| old.is_dir()) {
        std::fs::remove_dir_all(old)?;
    }
    step("Build the wheel of the Python package", || {
        run(Command::new(&maturin)
            .args(["-m", "maturin", "build", "--release", "--locked", "--manifest-path", "python/Cargo.toml", "--out"])
            .arg(&wheels))
    })?;
    let bin = python(&folder, "python/tests/requirements.txt", "Install what its tests take with pip")?;
    let wheel = crate::step::files_below(&wheels)?.into_iter().next().context("maturin has built no wheel")?;
    step("Install the wheel and what its examples take with pip", || {
        let asked = root().join("python/examples/requirements.txt");
        run(pip(&bin).arg(wheel).arg("--requirement").arg(asked))
    })?;
    Ok(bin)
}

/// What installs for this Python.
fn pip(python: &Path) -> Command {
    let mut command = Command::new(python);
    command.args(["-m", "pip", "--quiet", "--disable-pip-version-check", "install"]);
    command
}

/// A Python with what the list `asked` of the checkout asks for, in a virtual environment below `folder`.
fn python(folder: &Path, asked: &str, what: &str) -> Result<PathBuf> {
    let asked = root().join(asked);
    let (environment, done) = (folder.join("venv"), folder.join("venv/requirements.txt"));
    let bin = environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    if bin.is_file() && std::fs::read(&done).ok() == std::fs::read(&asked).ok() {
        return Ok(bin);
    }
    const NAMES: [&str; 2] = ["python3", "python.exe"];
    let python = match on_path(&NAMES) {
        Some(python) => python,
        None => {
            apt("Python", "python3 python3-venv", "install Python 3.10 or newer")?;
            on_path(&NAMES).context("apt installed Python, but it is not on the PATH")?
        }
    };
    // Debian has the module that this needs in a package of its own.
    if output(Command::new(&python).args(["-c", "import ensurepip, venv"])).is_none() {
        apt("Python's venv", "python3-venv", "install Python with its standard library")?;
    }
    step(what, || {
        run(Command::new(&python).args(["-m", "venv"]).arg(&environment))?;
        let list = asked.display();
        run(pip(&bin).arg("--requirement").arg(&asked)).map_err(|why| {
            // Without a registry of Python's all else can be tried.
            anyhow!(Missing(format!("pip cannot install what {list} asks for ({why}): give it a way to a registry")))
        })
    })?;
    std::fs::copy(&asked, &done)?;
    Ok(bin)
}

/// cargo-fuzz, and a nightly toolchain for it.
pub(crate) fn cargo_fuzz() -> Result<PathBuf> {
    if output(Command::new("rustup").args(["run", "nightly", "cargo", "--version"])).is_none() {
        step("Install a nightly toolchain", || {
            run(Command::new("rustup").args(["toolchain", "install", "nightly", "--profile", "minimal"]))
        })?;
    }
    cpp_compiler()?;
    cargo_tool("cargo-fuzz", "0.13.2")
}

/// A program of this version, compiled into the target directory without optimisation: none of them works for long.
fn cargo_tool(program: &str, version: &str) -> Result<PathBuf> {
    let folder = target().join("tools");
    let path = folder.join(format!("bin/{program}{}", std::env::consts::EXE_SUFFIX));
    let entry = format!("\"{program} {version} (");
    let has_version = std::fs::read_to_string(folder.join(".crates.toml")).is_ok_and(|list| list.contains(&entry));
    if !(path.is_file() && has_version) {
        step(&format!("Install {program} (some minutes, once)"), || {
            run(cargo().args(["install", program, "--version", version, "--locked", "--debug", "--root"]).arg(&folder))
        })?;
    }
    Ok(path)
}

/// typos, which reads the checkout for spelling mistakes.
pub(crate) fn typos() -> Result<PathBuf> {
    let bin = python(&target().join("typos"), "xtask/typos.txt", "Install typos with pip (seconds, once)")?;
    Ok(bin.with_file_name(format!("typos{}", std::env::consts::EXE_SUFFIX)))
}

/// Sees to it that C++ can be compiled.
pub(crate) fn cpp_compiler() -> Result<()> {
    if std::env::var_os("CXX").is_some() || on_path(&["c++", "g++", "clang++"]).is_some() || cfg!(windows) {
        return Ok(());
    }
    apt("A C++ compiler", "g++", "name one in the environment variable CXX")
}

/// The browser the tests drive: the environment's `CHROMIUM`, else the one on the PATH, else apt's.
pub(crate) fn chromium() -> Result<PathBuf> {
    if let Some(named) = std::env::var_os("CHROMIUM") {
        return Ok(named.into());
    }
    const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
    let found: Vec<PathBuf> = NAMES.iter().filter_map(|name| on_path(&[name])).collect();
    if let Some(found) = found.iter().find(|path| !is_snap(path)) {
        return Ok(found.clone());
    }
    if let Some(stub) = found.first() {
        // Where there is one, apt has no other.
        bail!(Missing(format!(
            "{} only starts a snap, which tests cannot drive: name another Chromium in the environment variable CHROMIUM \
             (npx playwright install chromium gets one)",
            stub.display()
        )));
    }
    apt("Chromium", "chromium", "name one in the environment variable CHROMIUM")?;
    on_path(&NAMES).context("apt installed chromium, but it is not on the PATH")
}

/// Longest script that is taken for one that only starts something else, in bytes.
const STUB: u64 = 16 << 10;

/// Whether a program is a stub that starts a snap: it cannot read what tests give it, and there may be no snap.
fn is_snap(program: &Path) -> bool {
    let is_small = std::fs::metadata(program).is_ok_and(|found| found.len() <= STUB);
    let script = if is_small { std::fs::read(program).unwrap_or_default() } else { Vec::new() };
    let is_link = std::fs::canonicalize(program).is_ok_and(|path| path.ends_with("snap"));
    is_link || calls_snap(&script) || {
        let asked = Command::new(program).arg("--version").output();
        asked.is_ok_and(|asked| !asked.status.success() && speaks_of_snap(&[asked.stdout, asked.stderr].concat()))
    }
}

/// Whether a script starts a snap.
fn calls_snap(script: &[u8]) -> bool {
    script.starts_with(b"#!") && speaks_of_snap(script)
}

fn speaks_of_snap(text: &[u8]) -> bool {
    let text = String::from_utf8_lossy(text).to_lowercase();
    text.split(|letter: char| !letter.is_alphanumeric()).any(|word| word == "snap")
}

/// What a window needs on a machine without a display: `None` where there is a display.
pub(crate) fn display() -> Result<Option<PathBuf>> {
    let has_display = ["DISPLAY", "WAYLAND_DISPLAY"].iter().any(|name| std::env::var_os(name).is_some());
    if has_display || !cfg!(target_os = "linux") {
        return Ok(None);
    }
    if let Some(found) = on_path(&["xvfb-run"]) {
        return Ok(Some(found));
    }
    apt("Xvfb", "xvfb", "run the tests where there is a display")?;
    on_path(&["xvfb-run"]).context("apt installed xvfb, but xvfb-run is not on the PATH").map(Some)
}

/// A Vulkan driver for the native views: the machine's own, else Mesa's, which needs no graphics card.
pub(crate) fn vulkan() -> Result<()> {
    const DRIVERS: [&str; 2] = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"];
    let found = DRIVERS.iter().any(|dir| std::fs::read_dir(dir).is_ok_and(|mut drivers| drivers.next().is_some()));
    if found || std::env::var_os("VK_ICD_FILENAMES").is_some() || !cfg!(target_os = "linux") {
        return Ok(());
    }
    apt("A Vulkan driver", "mesa-vulkan-drivers", "install the driver of your graphics card")
}

/// Where Mesa says that it is there: what takes it in place of another driver.
const MESA_VENDOR: &str = "/usr/share/glvnd/egl_vendor.d/50_mesa.json";

/// What the browser draws with, as `LUMEN_ANGLE` and the variables beside it: Mesa on the processor where it is there or can
/// be had, which takes half as long as the SwiftShader that Chromium brings. What the user has set in `LUMEN_ANGLE` stays.
pub(crate) fn angle() -> Vec<(&'static str, &'static str)> {
    const PACKAGES: &str = "libegl1 libegl-mesa0 libgl1-mesa-dri";
    if std::env::var_os("LUMEN_ANGLE").is_some() {
        return Vec::new();
    }
    let own = vec![("LUMEN_ANGLE", "swiftshader")];
    if !cfg!(target_os = "linux") {
        return own;
    }
    if !has_mesa()
        && let Err(error) = apt("Mesa", PACKAGES, "wait longer for the browser tests")
    {
        eprintln!("    {error}");
    }
    if !has_mesa() {
        return own;
    }
    vec![("LUMEN_ANGLE", "gl-egl"), ("LIBGL_ALWAYS_SOFTWARE", "1"), ("__EGL_VENDOR_LIBRARY_FILENAMES", MESA_VENDOR)]
}

/// Whether all of Mesa is there: what finds a driver, its EGL, and what draws on the processor.
fn has_mesa() -> bool {
    let libraries = output(Command::new("/sbin/ldconfig").arg("-p")).unwrap_or_default();
    let folders = std::fs::read_dir("/usr/lib").into_iter().flatten().filter_map(|entry| Some(entry.ok()?.path()));
    Path::new(MESA_VENDOR).is_file()
        && libraries.contains("libEGL.so.1")
        && (libraries.contains("libgallium")
            || folders.into_iter().any(|folder| folder.join("dri/swrast_dri.so").is_file()))
}

/// What makes a root with a Debian of its own.
pub(crate) fn debootstrap() -> Result<()> {
    if on_path(&["debootstrap"]).is_some() {
        return Ok(());
    }
    apt("debootstrap", "debootstrap", "make the package without --try")
}

/// Installs Debian packages where that is allowed, else says in one line what is missing and how to get it.
fn apt(what: &str, package: &str, instead: &str) -> Result<()> {
    let is_root = output(Command::new("id").arg("-u")).as_deref() == Some("0");
    let may_sudo = !is_root && output(Command::new("sudo").args(["-n", "true"])).is_some();
    if on_path(&["apt-get"]).is_none() || !(is_root || may_sudo) {
        bail!(Missing(format!("{what} is missing: sudo apt-get install {package} (Debian, Ubuntu), or {instead}")));
    }
    let apt_get = |arguments: &[&str]| {
        let mut command = Command::new(if is_root { "apt-get" } else { "sudo" });
        if may_sudo {
            command.args(["-n", "DEBIAN_FRONTEND=noninteractive", "apt-get"]);
        }
        run(command.env("DEBIAN_FRONTEND", "noninteractive").args(["-qq", "-o", "Dpkg::Use-Pty=0"]).args(arguments))
    };
    step(&format!("Install {package} with apt"), || {
        apt_get(&["update"])?;
        let packages: Vec<&str> = package.split(' ').collect();
        apt_get(&[&["install", "--yes", "--no-install-recommends"], &packages[..]].concat())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_script_that_starts_a_snap_is_no_browser() {
        let ubuntu =
            "#!/bin/sh\nif ! [ -x /snap/bin/chromium ]; then\n  echo 'Command requires the chromium snap' >&2\nfi\n";
        assert!(calls_snap(ubuntu.as_bytes()));
        let debian = "#!/bin/sh\n# Snapshots are kept.\nexec /usr/lib/chromium/chromium \"$@\"\n";
        assert!(!calls_snap(debian.as_bytes()) && !calls_snap(b"\x7fELF snap"));
        assert!(speaks_of_snap(b"Please install it with: snap install chromium") && !speaks_of_snap(b"Chromium 140"));
    }
}
