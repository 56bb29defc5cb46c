//! The skeleton of a legacy VTK file: its words, its lines, and the numbers between them as text or big-endian binary.

use std::borrow::Cow;

use super::super::error::ReadError;
use super::super::numbers::Scalar;
use super::super::pace::{NUMBERS, Pace};
use super::super::problem::{Problem, TextProblem, VtkProblem};
use super::super::text::{self, Words};
use super::array::{Array, Content};

/// A place in the file.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    pub(super) is_binary: bool,
    pub(super) pace: &'a Pace,
}

impl<'a> Cursor<'a> {
    /// Begins at the start of `bytes`.
    pub(super) fn new(bytes: &'a [u8], pace: &'a Pace) -> Self {
        Self { bytes, at: 0, line: 1, is_binary: false, pace }
    }

    /// The label for errors.
    pub(super) fn label(&self) -> &'static str {
        if self.is_binary { "VTK binary" } else { "VTK ascii" }
    }

    /// What is wrong here.
    pub(super) fn broken(&self, problem: impl Into<Problem>) -> ReadError {
        let format = self.label();
        if self.is_binary {
            // Binary numbers have no lines.
            let problem = VtkProblem::AtByte { problem: Box::new(problem.into()), byte: self.at };
            ReadError::malformed(format, problem)
        } else {
            ReadError::syntax(format, self.line, problem)
        }
    }

    /// What is left of the line; the next one begins after it.
    pub(super) fn rest_of_line(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        self.line += 1;
        rest[..length].trim_ascii()
    }

    /// The next word, on this line or a later one.
    pub(super) fn word(&mut self) -> Option<&'a [u8]> {
        let mut words = Words::new(&self.bytes[self.at..], self.line);
        let word = words.next();
        self.at = self.bytes.len() - words.remaining();
        self.line = words.line();
        word
    }

    /// Goes back to a word that was the last to be read.
    pub(super) fn go_back(&mut self, word: &[u8]) {
        self.at -= word.len();
    }

    /// The next word, without going past it.
    fn peek(&self) -> Option<&'a [u8]> {
        Words::new(&self.bytes[self.at..], self.line).next()
    }

    /// Whether the next word is `word`, in any case.
    pub(super) fn comes(&self, word: &[u8]) -> bool {
        self.peek().is_some_and(|next| next.eq_ignore_ascii_case(word))
    }

    /// The next word as a count.
    pub(super) fn count(&mut self) -> Result<u64, ReadError> {
        let word = self.word().ok_or_else(|| self.broken(VtkProblem::EndsAtCount))?;
        text::number(word).ok_or_else(|| self.broken(TextProblem::NoCount { word: text::quoted(word) }))
    }

    /// The next word as a type of number.
    pub(super) fn kind(&mut self) -> Result<Scalar, ReadError> {
        let word = self.word().ok_or_else(|| self.broken(VtkProblem::EndsAtType))?;
        scalar(word).ok_or_else(|| self.broken(TextProblem::NoType { word: text::quoted(word) }))
    }

    /// The `count` numbers that begin on the next line if they are binary, and with the next word if they are text; those
    /// that are there where the file ends before.
    pub(super) async fn numbers(&mut self, kind: Scalar, count: u64) -> Array<'a> {
        /// To find where a text ends is half the work on it, to read the numbers the other.
        const FOUND: f64 = 0.5;
        if self.is_binary {
            self.rest_of_line();
            let bytes = self.take(count.saturating_mul(kind.size() as u64));
            return Array { kind, content: Content::Big(Cow::Borrowed(bytes)), weight: 1.0 };
        }
        let (text, line) = (&self.bytes[self.at..], self.line);
        let mut words = Words::new(text, line);
        let (mut left, mut is_there) = (count, true);
        while left > 0 && is_there {
            let (before, block) = (words.remaining(), left.min(NUMBERS as u64));
            is_there = (0..block).all(|_| words.next().is_some());
            left -= block;
            self.pace.rest(FOUND * (before - words.remaining()) as f64).await;
        }
        let length = text.len() - words.remaining();
        (self.at, self.line) = (self.at + length, words.line());
        Array { kind, content: Content::Text { text: &text[..length], line }, weight: 1.0 - FOUND }
    }

    /// The next bytes, as many of `count` as there are.
    fn take(&mut self, count: u64) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = usize::try_from(count).unwrap_or(rest.len()).min(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// Steps over an array of field data: its numbers, bits or strings.
    pub(super) async fn skip_array(&mut self, kind: &[u8], count: u64) -> Result<(), ReadError> {
        if kind.eq_ignore_ascii_case(b"string") || kind.eq_ignore_ascii_case(b"utf8_string") {
            self.rest_of_line();
            for n in 0..count {
                if self.at == self.bytes.len() {
                    break;
                }
                if n % NUMBERS as u64 == 0 {
                    self.pace.rest(0.0).await;
                }
                if self.is_binary {
                    self.skip_string();
                } else {
                    self.rest_of_line();
                }
            }
        } else if kind.eq_ignore_ascii_case(b"bit") && self.is_binary {
            self.rest_of_line();
            self.take(count.div_ceil(8));
        } else {
            let kind = scalar(kind);
            let kind = kind.ok_or_else(|| self.broken(VtkProblem::FieldType))?;
            self.numbers(kind, count).await;
        }
        Ok(())
    }

    /// Steps over a string in binary: its length comes first, in 1, 2, 4 or 8 bytes by its first two bits.
    fn skip_string(&mut self) {
        let first = self.bytes.get(self.at).copied().unwrap_or(0);
        let bytes = match first >> 6 {
            3 => 1,
            2 => 2,
            1 => 4,
            _ => 8,
        };
        let head = self.take(bytes);
        let length = head.iter().fold(0, |sum: u64, &byte| sum << 8 | u64::from(byte));
        self.take(length & ((1 << (8 * bytes - 2)) - 1));
    }

    /// Steps over a block of metadata, which ends with an empty line.
    pub(super) fn skip_metadata(&mut self) {
        self.rest_of_line();
        while self.at < self.bytes.len() && !self.rest_of_line().is_empty() {}
    }
}

/// The type that a file calls `name`; a `long` has 64 bits, as where VTK is mostly used.
pub(super) fn scalar(name: &[u8]) -> Option<Scalar> {
    Some(match name.to_ascii_lowercase().as_slice() {
        b"char" | b"signed_char" => Scalar::I8,
        b"unsigned_char" | b"bit" => Scalar::U8,
        b"short" => Scalar::I16,
        b"unsigned_short" => Scalar::U16,
        // VTK writes its own type for ids as an int.
        b"int" | b"vtkidtype" => Scalar::I32,
        b"unsigned_int" => Scalar::U32,
        b"long" | b"long_long" | b"vtktypeint64" => Scalar::I64,
        b"unsigned_long" | b"unsigned_long_long" | b"vtktypeuint64" => Scalar::U64,
        b"float" => Scalar::F32,
        b"double" => Scalar::F64,
        _ => return None,
    })
}
