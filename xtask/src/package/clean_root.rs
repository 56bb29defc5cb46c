//! The Debian package in a Debian that has nothing else: installed with what it asks for, and run.

use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, Result, ensure};

use crate::step::{on_path, output, run, step, target};
use crate::tools;

/// The release that the package has to run on: the oldest that is supported.
const RELEASE: &str = "bookworm";

/// What is run in the clean root. The window is the last: it has to stand for ten seconds.
const COMMANDS: [(&str, &str); 6] = [
    ("Install the package with what it asks for", "apt-get -qq install --yes --no-install-recommends /lumen.deb"),
    ("Ask for the version", "lumen --version"),
    (
        "Look for its manual, icon and desktop entry",
        "gzip -t /usr/share/man/man1/lumen-optimise.1.gz && test -s /usr/share/icons/hicolor/scalable/apps/lumen.svg \
         && grep -q 'Exec=lumen %f' /usr/share/applications/lumen.desktop",
    ),
    ("Make a phantom", "lumen phantom aorta --triangles 8000 -o /tmp/vessel.stl"),
    ("Reduce it", "lumen optimise /tmp/vessel.stl -o /tmp/reduced.vtp --reduction 90 && test -s /tmp/reduced.vtp"),
    (
        "Open the window",
        "apt-get -qq install --yes --no-install-recommends xvfb xauth mesa-vulkan-drivers libvulkan1 libegl1 libgl1-mesa-dri \
         && { timeout 10 xvfb-run -a lumen /tmp/vessel.stl; test $? = 124; }",
    ),
];

/// Installs the package in a root of its own and runs it there.
pub(super) fn try_package(deb: &Path) -> Result<()> {
    ensure!(output(Command::new("id").arg("-u")).as_deref() == Some("0"), "a clean root is made as root");
    tools::debootstrap()?;
    let debootstrap = on_path(&["debootstrap"]).context("debootstrap is not on the PATH")?;
    let clean = target().join("clean-root");
    if clean.exists() {
        std::fs::remove_dir_all(&clean).with_context(|| format!("{} cannot be removed", clean.display()))?;
    }
    let mirror = mirror().context("apt names no mirror of Debian")?;
    step("Make a clean Debian (a minute or two)", || {
        let cache = target().join("debootstrap");
        std::fs::create_dir_all(&cache)?;
        let mut command = Command::new(&debootstrap);
        command.arg("--variant=minbase").arg(format!("--cache-dir={}", cache.display()));
        run(command.arg(RELEASE).arg(&clean).arg(&mirror))
    })?;
    std::fs::copy(deb, clean.join("lumen.deb")).context("the package cannot be copied")?;
    if Path::new("/etc/resolv.conf").is_file() {
        std::fs::copy("/etc/resolv.conf", clean.join("etc/resolv.conf"))
            .context("/etc/resolv.conf cannot be copied")?;
    }
    for (what, line) in COMMANDS {
        step(what, || {
            let mut command = Command::new("chroot");
            command.env_clear().env("PATH", "/usr/sbin:/usr/bin:/sbin:/bin").env("DEBIAN_FRONTEND", "noninteractive");
            run(command.env("LC_ALL", "C.UTF-8").env("HOME", "/root").arg(&clean).args(["sh", "-c", line]))
        })?;
    }
    std::fs::remove_dir_all(&clean).with_context(|| format!("{} cannot be removed", clean.display()))
}

/// The mirror of Debian's main archive that this machine's apt reads.
fn mirror() -> Option<String> {
    let sites = output(Command::new("apt-get").args(["indextargets", "--format", "$(RELEASE) $(SITE)"]))?;
    sites.lines().find_map(|line| line.strip_prefix(RELEASE)?.strip_prefix(' ').map(str::to_owned))
}
