//! A PLY file, and a text whose header has left out numbers.

use glam::DVec3;

use super::super::error::ReadError;
use super::super::numbers::{BinaryNumbers, TextNumbers};
use super::super::pace::Pace;
use super::super::raw::RawSurface;
use super::super::text::{self, Words};
use super::super::warnings::Warning;
use super::body;
use super::header::{Encoding, header};

/// Reads a file, with positions relative to an origin.
///
/// White space is white space to a body of text; but where its numbers do not come out even, a header has left out some that
/// stand at the ends of lines (MeshLab once wrote colours so), and taking every row to be a line gets over them.
pub(crate) async fn read(bytes: &[u8], origin: DVec3, pace: &Pace) -> Result<RawSurface, ReadError> {
    let file = text::without_mark(bytes).trim_ascii_start();
    let header = header(file)?;
    let (length, numbers) = (file.len(), &file[header.body..]);
    match header.encoding {
        Encoding::Little => body::read(&header, length, origin, &mut BinaryNumbers::<false>::new(numbers), pace).await,
        Encoding::Big => body::read(&header, length, origin, &mut BinaryNumbers::<true>::new(numbers), pace).await,
        Encoding::Ascii => {
            let as_text = |by_lines| TextNumbers::new("PLY", Words::new(numbers, header.body_line), by_lines);
            let mut words = as_text(false);
            let first = body::read(&header, length, origin, &mut words, pace).await;
            if first.is_ok() && words.is_at_end() {
                return first;
            }
            pace.begin_again();
            pace.rest(0.0).await;
            let mut rows = as_text(true);
            let second = body::read(&header, length, origin, &mut rows, pace).await;
            let (read, what) = if second.is_ok() && rows.is_at_end() {
                (second, Warning::PlyUnannounced)
            } else {
                (first, Warning::PlyMoreNumbers)
            };
            read.map(|mut raw| {
                raw.warnings.push(what);
                raw
            })
        }
    }
}
