//! A file that is there whole or not at all: it is written beside its place, and given its name at the end.

use std::fs::{OpenOptions, remove_file, rename};
use std::io::Write as _;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{SystemTime, UNIX_EPOCH};

/// Writes `bytes` to `path`: what was there before stays if the disk is full.
///
/// # Errors
/// What the system answers.
pub fn put_whole(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    /// Files that this process has begun: threads may write to one path at once.
    static BEGUN: AtomicUsize = AtomicUsize::new(0);
    let number = BEGUN.fetch_add(1, Ordering::Relaxed);
    // Other machines that see the folder have processes of the same number.
    let nanos = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_nanos());
    let mut part = path.to_owned().into_os_string();
    part.push(format!(".{}.{number}.{nanos}.part", std::process::id()));
    let mut file = OpenOptions::new().write(true).create_new(true).open(&part)?;
    let written = file.write_all(bytes);
    // Windows renames none that is open.
    drop(file);
    written.and_then(|()| rename(&part, path)).inspect_err(|_| drop(remove_file(&part)))
}
