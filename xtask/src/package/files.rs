//! What is packed: the desktop program with all that a desktop wants beside it, and the browser app with what a host wants.

use std::path::Path;
use std::process::Command;

use anyhow::{Context as _, Result, ensure};

use super::headers;
use super::packed::{Packed, read, read_file};
use crate::build::gzip;
use crate::step::{files_below, run, target};

/// The program's files under the paths that they have below `/usr`, sorted.
pub(super) fn desktop(program: &Path) -> Result<Vec<Packed>> {
    let program = program.canonicalize().with_context(|| format!("{} is not there", program.display()))?;
    let manual = target().join("manual");
    if manual.exists() {
        std::fs::remove_dir_all(&manual)?;
    }
    run(Command::new(&program).arg("manual").arg(&manual))?;
    // The scans stand in the file, the surfaces in the program's table of formats.
    let with_surfaces = |file: &str, types: &str| -> Result<Vec<u8>> {
        let types = String::from_utf8(read_file(&manual.join(types))?)?;
        Ok(String::from_utf8(read(file)?)?.replace("@SURFACES@", &types).into_bytes())
    };
    let mut files = vec![
        Packed { is_program: true, ..Packed::new("bin/lumen", read_file(&program)?) },
        Packed::new("share/applications/lumen.desktop", with_surfaces("xtask/packaging/lumen.desktop", "types.txt")?),
        Packed::new("share/icons/hicolor/scalable/apps/lumen.svg", read("www/icon.svg")?),
        Packed::new("share/mime/packages/lumen.xml", with_surfaces("xtask/packaging/lumen-mime.xml", "types.xml")?),
        Packed::new("share/doc/lumen/copyright", copyright()?),
        Packed::new("share/bash-completion/completions/lumen", read_file(&manual.join("lumen.bash"))?),
        Packed::new("share/fish/vendor_completions.d/lumen.fish", read_file(&manual.join("lumen.fish"))?),
        Packed::new("share/zsh/vendor-completions/_lumen", read_file(&manual.join("_lumen"))?),
    ];
    for page in files_below(&manual)? {
        let name = page.file_name().context("a page has no name")?.to_string_lossy().into_owned();
        if name.ends_with(".1") {
            files.push(Packed::new(format!("share/man/man1/{name}.gz"), gzip(&read_file(&page)?)?));
        }
    }
    ensure!(files.iter().any(|file| file.path == "share/man/man1/lumen.1.gz"), "the program wrote no manual");
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

/// Both licences, of which the user chooses one, and that of the letters.
fn copyright() -> Result<Vec<u8>> {
    Ok([
        b"Lumen may be used under either of two licences, MIT or Apache-2.0, as its user chooses.\n\n".to_vec(),
        read("LICENSE-MIT")?,
        b"\n".to_vec(),
        read("LICENSE-APACHE")?,
        b"\nIts letters are Ubuntu Light derivative Lumen, Copyright 2011 Canonical Ltd.\n\n".to_vec(),
        read("www/ubuntu-font-licence.txt")?,
    ]
    .concat())
}

/// The files of `dist` and those that tell a host its headers, sorted.
pub(super) fn site(dist: &Path, embed_in: &[String]) -> Result<Vec<Packed>> {
    let mut files = headers::files(embed_in)?;
    for path in files_below(dist)? {
        let name = path.strip_prefix(dist)?.to_string_lossy().replace('\\', "/");
        files.push(Packed::new(name, read_file(&path)?));
    }
    ensure!(files.iter().any(|file| file.path == "index.html"), "{} is no browser app", dist.display());
    files.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(path: &str) -> String {
        String::from_utf8(read(path).unwrap()).unwrap()
    }

    // What the program writes of surfaces is tested where it writes that (`src/cli/manual.rs`).
    #[test]
    fn every_type_of_the_desktop_entry_is_declared_and_stands_for_a_file_that_is_opened() {
        let (entry, types) = (text("xtask/packaging/lumen.desktop"), text("xtask/packaging/lumen-mime.xml"));
        assert_eq!(types.matches("@SURFACES@").count(), 1);
        let named = entry.lines().find_map(|line| line.strip_prefix("MimeType=@SURFACES@")).unwrap();
        let mut endings = Vec::new();
        for name in named.split_terminator(';') {
            let (_, declared) = types.split_once(&format!("<mime-type type=\"{name}\">")).unwrap();
            let (declared, _) = declared.split_once("</mime-type>").unwrap();
            let (_, glob) = declared.split_once("<glob pattern=\"*.").unwrap();
            endings.push(glob.split('"').next().unwrap().to_owned());
        }
        // As the window's dialog has them.
        let scans = text("src/desktop/scans.rs");
        let (_, scans) = scans.split_once("const ENDINGS:").unwrap();
        let (_, scans) = scans.split_once("= [").unwrap();
        let (scans, _) = scans.split_once(']').unwrap();
        assert!(endings.iter().all(|ending| scans.contains(&format!("\"{ending}\""))), "{endings:?} of {scans}");
        // What a hospital and a segmentation tool hand over opens at a double click.
        for ending in ["nii", "nrrd"] {
            assert!(endings.iter().any(|known| known == ending), "{ending} of {endings:?}");
        }
        assert_eq!(entry.lines().filter(|line| *line == "Exec=lumen %f").count(), 1);
    }
}
