//! Archives of packed files: `.tar.gz` and `.zip`.

use std::io::{Cursor, Write as _};
use std::path::Path;

use anyhow::{Context as _, Result};
use zip::write::SimpleFileOptions;

use super::packed::Packed;
use crate::build::gzip;

/// Seconds since 1970 that all files are said to be from: 1980 where nothing is asked for, since when there is ZIP's clock.
pub(super) fn time() -> Result<u64> {
    match std::env::var("SOURCE_DATE_EPOCH") {
        Ok(text) => text.parse().context("SOURCE_DATE_EPOCH is no number of seconds"),
        Err(_) => Ok(315_532_800),
    }
}

/// The files below `folder`, compressed, with an entry for each folder on the way (which dpkg wants).
pub(super) fn tar_gz(files: &[Packed], folder: &str) -> Result<Vec<u8>> {
    let mut tar = tar::Builder::new(Vec::new());
    let time = time()?;
    let mut header = |path: &str, mode: u32, kind: tar::EntryType, bytes: &[u8]| {
        let mut header = tar::Header::new_gnu();
        header.set_entry_type(kind);
        header.set_mode(mode);
        header.set_mtime(time);
        header.set_size(bytes.len() as u64);
        tar.append_data(&mut header, path, bytes)
    };
    let mut made = std::collections::BTreeSet::new();
    for file in files {
        let path = format!("{folder}/{}", file.path);
        let above: Vec<_> = Path::new(&path).ancestors().skip(1).collect();
        for above in above.into_iter().rev().filter(|above| !above.as_os_str().is_empty()) {
            if made.insert(above.to_owned()) {
                header(&format!("{}/", above.display()), 0o755, tar::EntryType::Directory, &[])?;
            }
        }
        header(&path, if file.is_program { 0o755 } else { 0o644 }, tar::EntryType::Regular, &file.bytes)?;
    }
    gzip(&tar.into_inner()?)
}

/// The files, compressed.
pub(super) fn zip(files: &[Packed]) -> Result<Vec<u8>> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    // `zip`'s own time where none is told: the first of January 1980.
    let options =
        SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated).unix_permissions(0o644);
    for file in files {
        zip.start_file(&*file.path, options)?;
        zip.write_all(&file.bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;

    use super::*;

    #[test]
    fn what_is_packed_is_unpacked_and_the_same_again() {
        let files =
            || [Packed { is_program: true, ..Packed::new("bin/a", *b"program") }, Packed::new("c.txt", *b"text")];
        let archive = tar_gz(&files(), "top").unwrap();
        assert_eq!(archive, tar_gz(&files(), "top").unwrap());
        let mut tar = tar::Archive::new(flate2::read::GzDecoder::new(&*archive));
        let entries: Vec<_> = tar
            .entries()
            .unwrap()
            .map(|entry| {
                let mut entry = entry.unwrap();
                let mut text = String::new();
                entry.read_to_string(&mut text).unwrap();
                (entry.path().unwrap().display().to_string(), entry.header().mode().unwrap(), text)
            })
            .collect();
        let entry = |path: &str, mode, text: &str| (path.to_owned(), mode, text.to_owned());
        assert_eq!(
            entries,
            [
                entry("top/", 0o755, ""),
                entry("top/bin/", 0o755, ""),
                entry("top/bin/a", 0o755, "program"),
                entry("top/c.txt", 0o644, "text")
            ]
        );
        let archive = zip(&files()).unwrap();
        assert_eq!(archive, zip(&files()).unwrap());
        let mut zip = zip::ZipArchive::new(Cursor::new(archive)).unwrap();
        let mut text = String::new();
        zip.by_name("c.txt").unwrap().read_to_string(&mut text).unwrap();
        assert_eq!((zip.len(), &*text), (2, "text"));
    }
}
