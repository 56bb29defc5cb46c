//! Scans in a build without their readers: there is no engine, and no file is one.

use std::path::PathBuf;

use crate::app::Waker;
use crate::engine::scan::{NamedFile, ScanLink};

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
    /// No file is a scan.
    pub(super) fn files(&self, _: &[PathBuf]) -> Result<Option<Vec<NamedFile>>, String> {
        Ok(None)
    }
}
