//! Scans on the desktop: the engine on a thread of its own, and the files of a scan, which it reads itself.

use std::fs::{self, File};
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use super::lock;
use super::thread::ThreadLink;
use crate::app::Waker;
use crate::engine::scan::{Contents, NamedFile, ScanEngine, ScanLink, Shelf};
use crate::io::volume;
use crate::say;

/// Endings of files that hold a scan; those of DICOM often have none.
pub(super) const ENDINGS: [&str; 9] = ["nii", "gz", "hdr", "nrrd", "nhdr", "mha", "mhd", "vti", "dcm"];

/// The line to the engine.
pub(super) struct Line {
    link: ThreadLink<ScanEngine>,
    disk: Disk,
}

impl Line {
    /// Starts an engine.
    pub(super) fn new(waker: Waker) -> Self {
        let disk = Disk::default();
        let shelf = disk.clone();
        Self { link: ThreadLink::new(waker, move || ScanEngine::with_shelf(shelf.clone())), disk }
    }

    /// The line.
    pub(super) fn link(&mut self) -> Option<&mut ScanLink> {
        Some(&mut self.link)
    }

    /// Where files are put for the engine.
    pub(super) fn disk(&self) -> Disk {
        self.disk.clone()
    }
}

/// Files that the engine reads from the disk; clones share them.
#[derive(Clone, Default)]
pub(super) struct Disk(Arc<Mutex<Known>>);

/// Paths by their numbers, and the number of the next.
#[derive(Default)]
struct Known {
    paths: Vec<(u32, PathBuf)>,
    next: u32,
}

impl Disk {
    /// Finds the files of a scan; `None` where there is one file and it is none, or a sentence on what cannot be read.
    pub(super) fn files(&self, paths: &[PathBuf]) -> Result<Option<Vec<NamedFile>>, String> {
        let found = volume::find(paths).map_err(|error| format!("{error}: {}.", error.source))?;
        let Some(paths) = found else { return Ok(None) };
        if paths.is_empty() {
            return Err(say!("app-folder-empty"));
        }
        let files: Result<Vec<NamedFile>, String> = paths.into_iter().map(|path| self.shelve(path)).collect();
        files.map(Some)
    }

    fn shelve(&self, path: PathBuf) -> Result<NamedFile, String> {
        let name = path.display().to_string();
        let bytes = fs::metadata(&path);
        let bytes = bytes.map_err(|error| say!("app-scan-not-found", name = &name, error = error.to_string()))?.len();
        let mut known = lock(&self.0);
        let number = known.next;
        known.next += 1;
        known.paths.push((number, path));
        Ok(NamedFile { name, contents: Contents::Shelved { number, bytes } })
    }
}

impl Shelf for Disk {
    fn read(&mut self, number: u32, begin: u64, target: &mut [u8]) -> Result<(), String> {
        let path = lock(&self.0).paths.iter().find(|(known, _)| *known == number).map(|(_, path)| path.clone());
        let path = path.ok_or_else(|| say!("app-scan-file-gone"))?;
        fill(&path, begin, target).map_err(|error| say!("app-scan-file-not-read", error = error.to_string()))
    }

    fn forget_before(&mut self, number: u32) {
        lock(&self.0).paths.retain(|(known, _)| *known >= number);
    }
}

fn fill(path: &Path, begin: u64, target: &mut [u8]) -> io::Result<()> {
    let mut file = File::open(path)?;
    file.seek(SeekFrom::Start(begin))?;
    file.read_exact(target)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_engine_reads_the_bytes_of_a_header_and_of_the_data_beside_it() {
        let folder = std::env::temp_dir().join(format!("lumen-disk-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        let header = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: a.raw\n";
        fs::write(folder.join("a.nhdr"), header).unwrap();
        fs::write(folder.join("a.raw"), [1, 2, 3, 4, 5, 6, 7, 8]).unwrap();
        fs::write(folder.join("letter"), "Dear colleague").unwrap();
        let mut disk = Disk::default();
        assert_eq!(disk.files(&[folder.join("letter")]), Ok(None));
        let files = disk.files(&[folder.join("a.nhdr")]).unwrap().unwrap();
        assert_eq!(files[0].contents, Contents::Shelved { number: 0, bytes: 8 });
        let mut piece = [0; 3];
        disk.read(0, 4, &mut piece).unwrap();
        assert_eq!(piece, [5, 6, 7]);
        assert!(disk.read(0, 6, &mut piece).unwrap_err().starts_with("A file of the scan cannot be read"));
        disk.forget_before(1);
        assert_eq!(disk.read(0, 0, &mut piece).unwrap_err(), "A file of the scan is not there any more.");
        fs::remove_dir_all(&folder).unwrap();
    }
}
