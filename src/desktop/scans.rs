//! Scans on the desktop: the engine on a thread of its own, and the files of a scan.

use std::path::PathBuf;
use std::sync::Arc;

use super::thread::ThreadLink;
use crate::app::Waker;
use crate::engine::scan::{NamedFile, ScanEngine, ScanLink};
use crate::io::volume;

/// Endings of files that hold a scan; those of DICOM often have none.
pub(super) const ENDINGS: [&str; 9] = ["nii", "gz", "hdr", "nrrd", "nhdr", "mha", "mhd", "vti", "dcm"];

/// The line to the engine.
pub(super) struct Line(ThreadLink<ScanEngine>);

impl Line {
    /// Starts an engine.
    pub(super) fn new(waker: Waker) -> Self {
        Self(ThreadLink::new(waker, ScanEngine::new))
    }

    /// The line.
    pub(super) fn link(&mut self) -> Option<&mut ScanLink> {
        Some(&mut self.0)
    }
}

/// Reads the files of a scan; `None` where there is one file and it is none, or a sentence on what cannot be read.
pub(super) fn files(paths: &[PathBuf]) -> Result<Option<Vec<NamedFile>>, String> {
    let gathered = volume::gather(paths).map_err(|error| format!("{error}: {}.", error.source))?;
    let named = |(name, bytes)| NamedFile { name, bytes: Arc::new(bytes) };
    Ok(gathered.map(|files| files.into_iter().map(named).collect()))
}
