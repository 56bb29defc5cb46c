//! Scans and masks in a build without their readers: there are no options for them, and no file is one.

use anyhow::Result;
use clap::Args;

use crate::io::Imported;

/// A folder without surfaces is none of a scan's.
pub(super) const FOLDER_HINT: &str = "";

/// None.
#[derive(Clone, Debug, Default, Args)]
pub(super) struct ScanOptions {}

impl ScanOptions {
    /// Nothing is asked for.
    pub(super) fn is_any(&self) -> bool {
        false
    }

    /// No part is asked for.
    pub(super) fn has_box(&self) -> bool {
        false
    }

    /// Nothing is.
    pub(super) fn is_chosen(&self) -> bool {
        false
    }

    /// There is nothing to refuse.
    pub(super) fn refuse(&self, _: &str) -> Result<()> {
        Ok(())
    }
}

/// There is no volume to open.
pub(super) enum Opened {}

/// No file is a volume.
pub(super) fn open(_: &[String], _: &ScanOptions) -> Result<Option<Opened>> {
    Ok(None)
}

impl Opened {
    /// There is none.
    pub(super) fn surface(self, _: &ScanOptions) -> Result<Imported> {
        match self {}
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
