//! Where a run reads and writes: nothing that it writes goes over a file that it reads, or to where something else goes, and
//! what it writes is there whole or not at all.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use anyhow::{Context as _, Result};

use super::misuse::misuse;
use super::whole::put_whole;
use crate::io::Format;

/// Refuses where one of the `outputs`, each with what it is, would go over one of the `inputs` or to the place of another. To
/// be called before anything is made or written.
pub(super) fn check<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    outputs: impl IntoIterator<Item = (String, &'a Path)>,
) -> Result<()> {
    compare(inputs, outputs).map_err(misuse)
}

/// The format that the name of an output file asks for.
pub(super) fn output_format(path: &Path) -> Result<Format> {
    let format = Format::from_name(&path.to_string_lossy());
    format.ok_or_else(|| misuse(format!("{} does not end in {}", path.display(), endings(".", "or"))))
}

/// Where a surface can be written, for the help.
pub(super) fn where_to_write() -> String {
    format!("Where to write: {}", endings(".", "or"))
}

/// The extensions of the formats that are written, each behind `before`, the last behind `word`.
pub(super) fn endings(before: &str, word: &str) -> String {
    let [others @ .., last] = Format::ALL.map(|format| format!("{before}{}", format.extension()));
    format!("{} {word} {last}", others.join(", "))
}

/// Writes `bytes` to `path` whole or not at all: what was there before stays if the disk is full.
pub(super) fn write_whole(path: &Path, bytes: &[u8]) -> Result<()> {
    path.file_name().context("the output has no file name")?;
    put_whole(path, bytes).with_context(|| format!("cannot write {}", path.display()))
}

fn compare<'a>(
    inputs: impl IntoIterator<Item = &'a Path>,
    outputs: impl IntoIterator<Item = (String, &'a Path)>,
) -> Result<(), String> {
    // A name that is no file (a sample) is in nobody's way.
    let inputs: BTreeSet<PathBuf> = inputs.into_iter().filter_map(|input| input.canonicalize().ok()).collect();
    let mut taken: BTreeMap<String, String> = BTreeMap::new();
    for (what, path) in outputs {
        let (place, shown) = (place(path), path.display());
        if inputs.contains(&place) {
            return Err(format!("{shown} would be overwritten by {what}, and is to be read: choose another name"));
        }
        // Some file systems take upper and lower case for the same.
        if let Some(other) = taken.insert(place.to_string_lossy().to_lowercase(), what.clone()) {
            return Err(format!("{other} and {what} would both be written to {shown}"));
        }
    }
    Ok(())
}

/// The one name of a place, whatever is there: what is there of the way to it as the system calls it, and the rest as it
/// is written.
fn place(path: &Path) -> PathBuf {
    // Where there is no current folder, names are compared as they stand.
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let there = whole.ancestors().find_map(|part| Some((part, part.canonicalize().ok()?)));
    let Some((part, start)) = there else { return whole };
    let rest = whole.strip_prefix(part).unwrap_or(&whole);
    rest.components().fold(start, |place, component| match component {
        Component::ParentDir => place.parent().map_or_else(|| place.clone(), Path::to_owned),
        component => place.join(component),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(inputs: &[&str], outputs: &[&str]) -> Option<String> {
        let outputs = outputs.iter().enumerate().map(|(i, path)| (format!("the {i}"), Path::new(*path)));
        compare(inputs.iter().map(Path::new), outputs).err()
    }

    #[test]
    fn two_names_of_one_place_are_one() {
        for (one, other) in [
            ("o.stl", "./o.stl"),
            ("o.stl", "O.STL"),
            ("new/o.stl", "new/../new/o.stl"),
            ("src/o.stl", "src/cli/../o.stl"),
        ] {
            let said = said(&[], &[one, other]).unwrap_or_default();
            assert_eq!(said, format!("the 0 and the 1 would both be written to {other}"));
        }
        assert_eq!(said(&[], &["o.stl", "o.json", "new/o.stl"]), None);
    }

    #[test]
    fn what_is_read_is_not_written_over() {
        let said = said(&["sample:aorta", "Cargo.toml"], &["o.stl", "src/../Cargo.toml"]).unwrap_or_default();
        assert!(said.starts_with("src/../Cargo.toml would be overwritten by the 1, and is to be read"), "{said}");
        assert_eq!(self::said(&["sample:aorta", "Cargo.toml"], &["Cargo.json"]), None);
    }
}
