//! What a package is made of: files with their paths in it.

use std::path::Path;

use anyhow::{Context as _, Result};

use crate::step::root;

/// Lumen's version, which all packages of the workspace have.
pub(super) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A file of a package: its path there, its bytes, and whether it is a program.
pub(super) struct Packed {
    pub(super) path: String,
    pub(super) bytes: Vec<u8>,
    pub(super) is_program: bool,
}

impl Packed {
    pub(super) fn new(path: impl Into<String>, bytes: impl Into<Vec<u8>>) -> Self {
        Self { path: path.into(), bytes: bytes.into(), is_program: false }
    }
}

/// The bytes of a file of the checkout.
pub(super) fn read(path: &str) -> Result<Vec<u8>> {
    read_file(&root().join(path))
}

pub(super) fn read_file(path: &Path) -> Result<Vec<u8>> {
    std::fs::read(path).with_context(|| format!("{} cannot be read", path.display()))
}
