//! Scans and masks in a build without their readers: whatever is one is refused, by the name of the feature.

use std::path::Path;

use anyhow::{Error, Result, bail};

use super::scan_options::ScanOptions;
use crate::io::{Axes, Imported, ReadError};
use crate::volume::LabelledSurface;

/// What is said of a folder without surfaces: it may be a scan.
pub(super) const FOLDER_HINT: &str = "; a folder of DICOM takes a build with scans (feature scans)";

const MISSING: &str = "this build was made without scans and masks (feature scans)";

/// This build cannot.
pub(super) fn check() -> Result<()> {
    bail!(MISSING)
}

/// Why a file is no surface: what is a scan another build may read.
pub(super) fn refused(error: ReadError) -> Error {
    if matches!(error, ReadError::ImageVolume { .. }) { Error::msg(MISSING) } else { error.into() }
}

/// There is no volume to open.
pub(super) enum Opened {}

/// No file is a volume, and a folder could be nothing else.
pub(super) fn open(names: &[String], _: &ScanOptions) -> Result<Option<Opened>> {
    match names.iter().find(|name| Path::new(name).is_dir()) {
        Some(folder) => bail!("{folder}: {MISSING}"),
        None => Ok(None),
    }
}

impl Opened {
    /// There is none.
    pub(super) fn surface(&self, _: &ScanOptions) -> Result<Imported> {
        match *self {}
    }

    /// There is none.
    pub(super) fn borders(&self, _: &ScanOptions) -> Result<Option<LabelledSurface>> {
        match *self {}
    }

    /// There is none.
    pub(super) fn axes(&self) -> Axes {
        match *self {}
    }

    /// There is none.
    pub(super) fn print_half_way(&self, _: &ScanOptions) -> Result<()> {
        match *self {}
    }

    /// There is none.
    pub(super) fn warnings(&self) -> &[String] {
        match *self {}
    }

    /// There is none.
    pub(super) fn json(&self) -> Result<String> {
        match *self {}
    }

    /// There is none.
    pub(super) fn print(&self) {
        match *self {}
    }
}
