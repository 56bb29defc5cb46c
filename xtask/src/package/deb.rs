//! A Debian package (deb(5)): an `ar` archive of a version, an archive of facts, and an archive of files.
//!
//! `cargo deb` does the same with a hundred crates and a build of its own; what a package without scripts needs is this.

use anyhow::{Context as _, Result, bail};

use super::archive::{tar_gz, time};
use super::packed::{Packed, VERSION};

/// What the window loads when it opens, so that no linker names it.
const WINDOW: &str =
    "libx11-6, libx11-xcb1, libxcursor1, libxi6, libxkbcommon0, libxkbcommon-x11-0, libwayland-client0";
/// What draws in it: either is enough.
const DRIVERS: &str = "libvulkan1, mesa-vulkan-drivers, libegl1, libgl1-mesa-dri";

/// What Debian calls this machine.
pub(super) fn architecture() -> Result<&'static str> {
    match std::env::consts::ARCH {
        "x86_64" => Ok("amd64"),
        "aarch64" => Ok("arm64"),
        "riscv64" => Ok("riscv64"),
        other => bail!("Debian's name for {other} is not known here"),
    }
}

/// The package of these files, which come below `/usr`.
pub(super) fn deb(files: &[Packed]) -> Result<Vec<u8>> {
    let program = files.iter().find(|file| file.is_program).context("there is no program to pack")?;
    let size: usize = files.iter().map(|file| file.bytes.len()).sum();
    let control = format!(
        "Package: lumen\nVersion: {VERSION}\nArchitecture: {}\nMaintainer: The Lumen developers\nSection: science\n\
         Priority: optional\nInstalled-Size: {}\nDepends: libc6 (>= {}), libgcc-s1, {WINDOW}\nRecommends: {DRIVERS}\n\
         Description: Makes a blood-vessel surface light enough to simulate on\n \
         Opens a surface made from a CT or MR angiogram, keeps its largest piece,\n \
         smooths it, reduces it to a progressive mesh, and tries the result with a\n \
         virtual guidewire. Not for clinical decisions.\n",
        architecture()?,
        size.div_ceil(1024),
        newest_glibc(&program.bytes).context("the program says nothing of the C library that it needs")?,
    );
    let control = tar_gz(&[Packed::new("control", control)], ".")?;
    let data = tar_gz(files, "./usr")?;
    let mut archive = ar::Builder::new(Vec::new());
    for (name, bytes) in [("debian-binary", &b"2.0\n"[..]), ("control.tar.gz", &control), ("data.tar.gz", &data)] {
        let mut header = ar::Header::new(name.as_bytes().to_vec(), bytes.len() as u64);
        header.set_mode(0o100_644);
        header.set_mtime(time()?);
        archive.append(&header, bytes)?;
    }
    Ok(archive.into_inner()?)
}

/// The newest version of the C library of which the program names a symbol: "2.34" of `GLIBC_2.34`.
fn newest_glibc(program: &[u8]) -> Option<String> {
    const NAME: &[u8] = b"GLIBC_2.";
    let versions = program.windows(NAME.len() + 3).filter(|window| window.starts_with(NAME)).filter_map(|window| {
        let digits: String =
            window[NAME.len()..].iter().take_while(|byte| byte.is_ascii_digit()).map(|&byte| byte as char).collect();
        digits.parse::<u32>().ok()
    });
    versions.max().map(|version| format!("2.{version}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_version_of_the_c_library_is_found() {
        assert_eq!(newest_glibc(b"..GLIBC_2.2.5\0GLIBC_2.34\0GLIBC_2.9\0GLIBC_PRIVATE\0").as_deref(), Some("2.34"));
        assert_eq!(newest_glibc(b"nothing"), None);
    }
}
