//! Errors of the graphics device in the language that is spoken.

use crate::language::decimal;
use crate::render::{PictureError, SurfaceError};
use crate::say;

/// A clause that says why a surface cannot be drawn.
pub(super) fn surface_error(error: &SurfaceError) -> String {
    match *error {
        // Positions, normals and scalars are those of all levels together: for them it is no help to reduce further.
        SurfaceError::TooLarge { what, bytes, limit } => {
            let [needed, limit] = [bytes, limit].map(|bytes| decimal(bytes as f64 / 1e6, 1));
            say!("views-too-large", what = what, needed = needed, limit = limit)
        }
        SurfaceError::Count { what, expected, found } => {
            say!("views-miscounted", found = found.to_string(), what = what, expected = expected.to_string())
        }
        SurfaceError::IndexOutOfRange { index, nodes } => {
            say!("views-no-node", index = index.to_string(), nodes = nodes.to_string())
        }
    }
}

/// A clause that says why a picture was not read back.
pub(super) fn picture_error(error: &PictureError) -> String {
    match error {
        PictureError::Map(error) => say!("views-picture-kept", error = error),
        PictureError::Lost => say!("views-picture-lost"),
    }
}
