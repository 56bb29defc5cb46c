//! Numbers one after another, as text or in binary of either byte order: what the bodies of several formats are made of.

use super::error::ReadError;
use super::problem::TextProblem;
use super::text::{self, Words};
pub(super) use lumen_mesh::arrays::Scalar;

/// The numbers of a body, one after another. `None` is the end of the file, or a [`Numbers::fault`]: these calls
/// are the inner loop, so they return what fits into registers.
pub(super) trait Numbers {
    /// The next number, of any type: `f64` holds them all, whole ones exactly up to 2^53.
    fn number(&mut self, kind: Scalar) -> Option<f64>;

    /// The next number relative to `origin`; where that is 0, rounded once to `f32`.
    fn coordinate(&mut self, kind: Scalar, origin: f64) -> Option<f32> {
        self.number(kind).map(|x| (x - origin) as f32)
    }

    /// What is wrong in the place where the last `None` came from, if it was not the end of the file.
    fn fault(&mut self) -> Option<ReadError> {
        None
    }

    /// Whether the last `None` came from a word that is no number: it is passed over, as one that nothing needs.
    fn pass_over(&mut self) -> bool {
        self.fault().is_some()
    }

    /// A row of an element ends here.
    fn end_row(&mut self) {}

    /// Bytes left.
    fn remaining(&self) -> usize;
}

/// Numbers as text, between white space.
pub(super) struct TextNumbers<'a> {
    /// The format, for faults.
    format: &'static str,
    words: Words<'a>,
    /// Whether what is left of a line after a row is passed over.
    row_is_line: bool,
    fault: Option<ReadError>,
}

impl<'a> TextNumbers<'a> {
    /// The numbers of `words`; with `row_is_line` what is left of a line after a row is passed over.
    pub(super) fn new(format: &'static str, words: Words<'a>, row_is_line: bool) -> Self {
        Self { format, words, row_is_line, fault: None }
    }

    /// Whether no word is left; takes it where one is.
    pub(super) fn is_at_end(&mut self) -> bool {
        self.words.next().is_none()
    }

    fn parse<T>(&mut self, of: impl Fn(&[u8]) -> Option<T>) -> Option<T> {
        let word = self.words.next()?;
        let value = of(word);
        if value.is_none() {
            let problem = TextProblem::NoNumber { word: text::quoted(word) };
            self.fault = Some(ReadError::syntax(self.format, self.words.line(), problem));
        }
        value
    }
}

impl Numbers for TextNumbers<'_> {
    fn number(&mut self, _: Scalar) -> Option<f64> {
        self.parse(text::number)
    }

    fn coordinate(&mut self, _: Scalar, origin: f64) -> Option<f32> {
        self.parse(|word| text::coordinate(word, origin))
    }

    fn fault(&mut self) -> Option<ReadError> {
        self.fault.take()
    }

    fn end_row(&mut self) {
        if self.row_is_line {
            self.words.skip_line();
        }
    }

    fn remaining(&self) -> usize {
        self.words.remaining()
    }
}

/// Binary numbers, of the one byte order or the other.
pub(super) struct BinaryNumbers<'a, const BIG: bool> {
    bytes: &'a [u8],
}

impl<'a, const BIG: bool> BinaryNumbers<'a, BIG> {
    /// The numbers of `bytes`.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes }
    }

    /// The next `N` bytes in little-endian order.
    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (&first, rest) = self.bytes.split_first_chunk::<N>()?;
        self.bytes = rest;
        let mut value = first;
        if BIG {
            value.reverse();
        }
        Some(value)
    }
}

impl<const BIG: bool> Numbers for BinaryNumbers<'_, BIG> {
    #[inline]
    fn number(&mut self, kind: Scalar) -> Option<f64> {
        match kind {
            Scalar::I8 => self.take().map(|b| f64::from(i8::from_le_bytes(b))),
            Scalar::U8 => self.take().map(|b| f64::from(u8::from_le_bytes(b))),
            Scalar::I16 => self.take().map(|b| f64::from(i16::from_le_bytes(b))),
            Scalar::U16 => self.take().map(|b| f64::from(u16::from_le_bytes(b))),
            Scalar::I32 => self.take().map(|b| f64::from(i32::from_le_bytes(b))),
            Scalar::U32 => self.take().map(|b| f64::from(u32::from_le_bytes(b))),
            Scalar::I64 => self.take().map(|b| i64::from_le_bytes(b) as f64),
            Scalar::U64 => self.take().map(|b| u64::from_le_bytes(b) as f64),
            Scalar::F32 => self.take().map(|b| f64::from(f32::from_le_bytes(b))),
            Scalar::F64 => self.take().map(f64::from_le_bytes),
        }
    }

    fn remaining(&self) -> usize {
        self.bytes.len()
    }
}
