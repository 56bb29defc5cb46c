//! The files of a volume by their names, whole or as far as they are known.

use super::error::ScanError;

/// A file by its name.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    /// Its name, with extension; a folder before it does not matter.
    pub name: &'a str,
    /// Its bytes.
    pub bytes: &'a [u8],
}

/// The beginning of a file.
#[derive(Clone, Copy, Debug)]
pub struct Head<'a> {
    /// Its name, with extension.
    pub name: &'a str,
    /// Its first bytes, [`HEAD`] of them or all.
    pub bytes: &'a [u8],
    /// How many bytes it has.
    pub length: u64,
}

/// Bytes of a file that say what it is and where its numbers stand.
pub const HEAD: usize = 1 << 16;

/// A file's name without the folder before it.
pub(super) fn base_name(name: &str) -> &str {
    name.rsplit(['/', '\\']).next().unwrap_or(name)
}

/// Which file a header names, whatever folder it lies in.
pub(super) fn named(files: &[Head], name: &str, format: &'static str) -> Result<usize, ScanError> {
    let wanted = base_name(name);
    let same = |file: &Head| base_name(file.name) == wanted;
    let alike = |file: &Head| base_name(file.name).eq_ignore_ascii_case(wanted);
    let found = files.iter().position(same).or_else(|| files.iter().position(alike));
    found.ok_or_else(|| ScanError::DataElsewhere { format, name: wanted.to_owned() })
}
