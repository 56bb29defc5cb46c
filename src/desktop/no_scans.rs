//! Scans in a build without their readers: there is no engine, and what may be one is refused.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use crate::app::Waker;
use crate::engine::scan::{NamedFile, ScanLink};
use crate::io::may_be_volume;
use crate::say;

/// None.
pub(super) const ENDINGS: [&str; 0] = [];

/// No line.
pub(super) struct Line;

impl Line {
    /// Starts nothing.
    pub(super) fn new(_: Waker) -> Self {
        Self
    }

    /// There is none.
    pub(super) fn link(&mut self) -> Option<&mut ScanLink> {
        None
    }

    /// No files are put anywhere.
    pub(super) fn disk(&self) -> Disk {
        Disk
    }
}

/// No files.
#[derive(Default)]
pub(super) struct Disk;

impl Disk {
    /// No file is a scan that this build could read.
    pub(super) fn files(&self, paths: &[PathBuf]) -> Result<Option<Vec<NamedFile>>, String> {
        if paths.iter().any(|path| may_be_scan(path)) { Err(say!("app-no-scans")) } else { Ok(None) }
    }
}

/// Whether it is a folder, or a file that begins as a scan does.
fn may_be_scan(path: &Path) -> bool {
    let mut head = Vec::new();
    // What cannot be read is said where it is read.
    let is_read = File::open(path).and_then(|file| file.take(4096).read_to_end(&mut head)).is_ok();
    let is_packed = head.starts_with(b"\x1f\x8b") && !path.to_string_lossy().to_ascii_lowercase().ends_with(".nii.gz");
    path.is_dir() || (is_read && !is_packed && may_be_volume(&head))
}
