//! The files of a volume on a disk: a header's data beside it, and all that lies in a folder.

use std::fs;
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

use lumen_message::{Message, Signature, ToValue as _, Value};
use thiserror::Error;

use super::headers::{data_name, is_volume};
use super::parts::{HEAD, base_name};

/// A file or a folder that cannot be read.
#[derive(Debug, Error)]
#[error("cannot read {path}")]
pub struct Unreadable {
    /// Its name.
    pub path: String,
    /// What the system says.
    #[source]
    pub source: io::Error,
}

impl Unreadable {
    /// Identifier and placeables of the message.
    pub const MESSAGES: &'static [Signature] = &[("scan-unreadable", &["path"])];
}

impl Message for Unreadable {
    fn id(&self) -> &str {
        Self::MESSAGES[0].0
    }

    fn values(&self) -> Vec<(&str, Value)> {
        vec![("path", self.path.to_value())]
    }
}

/// Names and bytes of files.
pub type Files = Vec<(String, Vec<u8>)>;

/// Finds the files of the volume that `paths` name: files, headers with the data beside them, folders with all in them but
/// further folders. `None` where there is a single file that is no volume. No more is read than the beginnings.
///
/// # Errors
/// [`Unreadable`], the first that is.
pub fn find(paths: &[PathBuf]) -> Result<Option<Vec<PathBuf>>, Unreadable> {
    let mut files = Vec::new();
    for path in paths {
        if path.is_dir() {
            files.extend(listed(path)?);
            continue;
        }
        let head = head(path)?;
        if paths.len() == 1 && !is_volume(&head) {
            return Ok(None);
        }
        if let Some(data) = data_name(&head, &path.to_string_lossy()) {
            // Beside the header, wherever the header says that it was.
            let beside = path.with_file_name(base_name(&data));
            if beside.is_file() && !paths.contains(&beside) {
                files.push(beside);
            }
        }
        files.push(path.clone());
    }
    Ok(Some(files))
}

/// Reads the files that [`find`] finds.
///
/// # Errors
/// [`Unreadable`], the first that is.
pub fn gather(paths: &[PathBuf]) -> Result<Option<Files>, Unreadable> {
    find(paths)?.map(|paths| paths.iter().map(|path| file(path)).collect()).transpose()
}

fn unreadable(path: &Path) -> impl FnOnce(io::Error) -> Unreadable {
    move |source| Unreadable { path: path.display().to_string(), source }
}

/// The files in a folder, by name.
fn listed(folder: &Path) -> Result<Vec<PathBuf>, Unreadable> {
    let paths: io::Result<Vec<PathBuf>> =
        fs::read_dir(folder).and_then(|entries| entries.map(|entry| entry.map(|entry| entry.path())).collect());
    let mut paths = paths.map_err(unreadable(folder))?;
    paths.retain(|path| path.is_file());
    paths.sort();
    Ok(paths)
}

/// The first bytes of a file.
fn head(path: &Path) -> Result<Vec<u8>, Unreadable> {
    let mut head = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(HEAD as u64).read_to_end(&mut head));
    read.map_err(unreadable(path))?;
    Ok(head)
}

fn file(path: &Path) -> Result<(String, Vec<u8>), Unreadable> {
    let bytes = fs::read(path).map_err(unreadable(path))?;
    Ok((path.to_string_lossy().into_owned(), bytes))
}
