//! A file on its way to a surface.
//!
//! The bytes are parsed (`parsing`), then taken through the import stage, which takes longer.

use std::sync::Arc;

use super::ImportOptions;
use super::error::ReadError;
use super::import::import_file;
use super::parsing::parse;
use super::report::Imported;
use lumen_mesh::task::{Yielder, at_once};

/// The part of the time that goes by until the bytes are parsed.
const PARSED: f32 = 0.2;

/// Reads the surface in `bytes`. `name` is the file's name: it matters only where the content alone does not tell
/// the format, as with OBJ.
///
/// # Errors
/// [`ReadError`], each in one plain sentence: the file is empty, of another kind, cut short or broken, or holds no
/// triangle that has an area.
pub fn read(bytes: &[u8], name: &str, options: &ImportOptions) -> Result<Imported, ReadError> {
    let yielder = &Yielder::never();
    let (raw, unit, axes) = at_once(parse(bytes, name, options, yielder))?;
    at_once(import_file(raw, unit, axes, yielder))
}

/// As [`read`], resting every millisecond or so while bytes are parsed. They are let go when they are.
///
/// # Errors
/// As [`read`].
pub async fn read_in_slices(
    bytes: Arc<Vec<u8>>,
    name: &str,
    options: &ImportOptions,
    yielder: &Yielder,
) -> Result<Imported, ReadError> {
    let parsed = parse(&bytes, name, options, &yielder.part(0.0..PARSED)).await;
    drop(bytes);
    let (raw, unit, axes) = parsed?;
    yielder.rest(PARSED).await;
    import_file(raw, unit, axes, &yielder.part(PARSED..1.0)).await
}
