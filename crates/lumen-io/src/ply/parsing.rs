//! A PLY file in slices, and a text whose header has left out numbers.

use glam::DVec3;

use super::super::error::ReadError;
use super::super::numbers::{BinaryNumbers, TextNumbers};
use super::super::parsing::Parse;
use super::super::raw::RawSurface;
use super::super::text::{self, Words};
use super::body::Body;
use super::header::{Encoding, Header, header};
use lumen_language::Key;
use lumen_mesh::task::{Budget, Progress};

/// A PLY file on its way to a surface, in slices, with positions relative to an origin.
///
/// White space is white space to a body of text; but where its numbers do not come out even, a header has left out some that
/// stand at the ends of lines (MeshLab once wrote colours so), and taking every row to be a line gets over them.
pub(super) struct Parsing {
    header: Header,
    /// Where the file begins, behind a mark and white space.
    start: usize,
    origin: DVec3,
    body: Body,
    /// What came of a text whose numbers do not come out even: its rows are read once more, as lines.
    uneven: Option<Result<RawSurface, ReadError>>,
}

impl Parsing {
    /// Of `bytes`, which are handed over again with each slice.
    pub(super) fn new(bytes: &[u8], origin: DVec3) -> Result<Self, ReadError> {
        let file = text::without_mark(bytes).trim_ascii_start();
        let header = header(file)?;
        let body = Body::new(&header, file.len(), origin);
        Ok(Self { start: bytes.len() - file.len(), header, origin, body, uneven: None })
    }
}

impl Parse for Parsing {
    fn advance(&mut self, bytes: &[u8], budget: Budget) -> Progress<Result<RawSurface, ReadError>> {
        let Self { header, body, .. } = self;
        let file = &bytes[self.start..];
        let length = file.len() - header.body;
        let numbers = &file[header.body + body.at..];
        let read = match header.encoding {
            Encoding::Little => body.advance(header, &mut BinaryNumbers::<false>::new(numbers), budget),
            Encoding::Big => body.advance(header, &mut BinaryNumbers::<true>::new(numbers), budget),
            Encoding::Ascii => {
                let words = Words::new(numbers, body.line);
                let mut numbers = TextNumbers::new("PLY", words, self.uneven.is_some());
                let read = body.advance(header, &mut numbers, budget);
                body.line = numbers.line();
                match read {
                    Progress::Done(read) => {
                        let is_even = read.is_ok() && numbers.is_at_end();
                        return self.judged(read, is_even, file.len());
                    }
                    working => working,
                }
            }
        };
        match read {
            Progress::Working(_) => Progress::Working(body.at as f32 / length.max(1) as f32),
            done => done,
        }
    }
}

impl Parsing {
    /// What comes of a text that was read, or the beginning of another reading of it.
    fn judged(
        &mut self,
        read: Result<RawSurface, ReadError>,
        is_even: bool,
        file: usize,
    ) -> Progress<Result<RawSurface, ReadError>> {
        let told = |read: Result<RawSurface, ReadError>, what: Key| {
            read.map(|mut raw| {
                raw.warnings.push(what.say());
                raw
            })
        };
        Progress::Done(match (self.uneven.take(), is_even) {
            (None, true) => read,
            (None, false) => {
                self.uneven = Some(read);
                self.body = Body::new(&self.header, file, self.origin);
                return Progress::Working(0.0);
            }
            (Some(_), true) => told(read, Key("errors-ply-unannounced")),
            (Some(first), false) => told(first, Key("errors-ply-more-numbers")),
        })
    }
}
