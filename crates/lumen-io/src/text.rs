//! Words and numbers of a text file, with the line they stand in.
//!
//! Works on bytes: names in any encoding pass through, and only what is used is looked at.

use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};

use super::pace::BYTES;
use lumen_mesh::task::Yielder;

/// Base64 as files have it: with or without its padding.
pub(super) const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// The words of a text, one after another, separated by white space.
pub(super) struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
}

impl<'a> Words<'a> {
    /// Starts at the beginning of `bytes`, in line `line`.
    pub(super) fn new(bytes: &'a [u8], line: usize) -> Self {
        Self { bytes, at: 0, line }
    }

    /// The line of the last word, from 1.
    pub(super) fn line(&self) -> usize {
        self.line
    }

    /// Bytes not yet read.
    pub(super) fn remaining(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The next word, or `None` at the end.
    pub(super) fn next(&mut self) -> Option<&'a [u8]> {
        while let Some(byte) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_whitespace()) {
            self.line += usize::from(*byte == b'\n');
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        (length > 0).then(|| &rest[..length])
    }

    /// Moves to the end of the current line.
    pub(super) fn skip_line(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += rest.iter().position(is_line_end).unwrap_or(rest.len());
    }

    /// Moves to where a word stands before another in the current line, in any case, or to its end. It looks at no byte
    /// beyond that place: a line may be the whole file.
    pub(super) fn skip_line_until(&mut self, word: &[u8], next: &[u8]) {
        let mut start = None;
        loop {
            let rest = &self.bytes[self.at..];
            let is_space = |byte: &u8| byte.is_ascii_whitespace() && !is_line_end(byte);
            let at = self.at + rest.iter().position(|byte| !is_space(byte)).unwrap_or(rest.len());
            let rest = &self.bytes[at..];
            let found = &rest[..rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len())];
            if let Some(start) = start.filter(|_| found.eq_ignore_ascii_case(next)) {
                self.at = start;
                return;
            }
            self.at = at + found.len();
            if found.is_empty() {
                return;
            }
            start = found.eq_ignore_ascii_case(word).then_some(at);
        }
    }
}

fn is_line_end(byte: &u8) -> bool {
    matches!(byte, b'\n' | b'\r')
}

/// The number that `word` is, rounded once to `f32`; "nan" and "inf" are numbers here.
pub(super) fn number<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok()?.parse().ok()
}

/// The coordinate that `word` is, relative to `origin`; where that is 0, rounded once.
pub(super) fn coordinate(word: &[u8], origin: f64) -> Option<f32> {
    if origin == 0.0 { number(word) } else { number(word).map(|x: f64| (x - origin) as f32) }
}

/// `word` for a message: at most 20 characters, whatever bytes it has.
pub(super) fn quoted(word: &[u8]) -> String {
    let text: String = String::from_utf8_lossy(word).chars().filter(|c| !c.is_control()).take(21).collect();
    match text.char_indices().nth(20) {
        Some((end, _)) => format!("\"{}...\"", &text[..end]),
        None => format!("\"{text}\""),
    }
}

/// A text in UTF-16 with its byte-order mark, as some editors save it, in UTF-8; `None` for any other bytes.
pub(super) async fn from_utf16(bytes: &[u8], yielder: &Yielder) -> Option<Vec<u8>> {
    let (mark, units) = bytes.split_first_chunk()?;
    let unit: fn([u8; 2]) -> u16 = match mark {
        b"\xff\xfe" => u16::from_le_bytes,
        b"\xfe\xff" => u16::from_be_bytes,
        _ => return None,
    };
    let units = units.as_chunks().0;
    // Formats begin with a letter, a sign or white space.
    units.first().filter(|&&first| (1..0x80).contains(&unit(first)))?;
    let mut text = String::with_capacity(units.len());
    for block in units.chunks(BYTES) {
        // A letter of two units at the end of a block is lost: what is read has none.
        let letters = char::decode_utf16(block.iter().map(|&bytes| unit(bytes)));
        text.extend(letters.map(|letter| letter.unwrap_or(char::REPLACEMENT_CHARACTER)));
        yielder.rest(0.0).await;
    }
    Some(text.into_bytes())
}

/// `bytes` without the byte-order mark that some editors put before a text.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)
}

/// A file from its first letter on: behind a byte-order mark and white space.
pub(super) fn beginning(bytes: &[u8]) -> &[u8] {
    without_mark(bytes).trim_ascii_start()
}

/// Whether a file begins with a word, in any case, behind a byte-order mark and white space.
pub(super) fn begins_with(bytes: &[u8], word: &[u8]) -> bool {
    let text = beginning(bytes);
    text.len() >= word.len() && text[..word.len()].eq_ignore_ascii_case(word)
}

/// Whether the beginning of `bytes` looks like text: no control characters but white space.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    bytes.iter().take(512).all(|&byte| byte >= 0x20 || byte.is_ascii_whitespace() || byte == 0x0b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_know_their_lines() {
        let mut words = Words::new(b" solid  a b\r\n 1e-3\n", 1);
        assert_eq!((words.next(), words.line()), (Some(&b"solid"[..]), 1));
        words.skip_line();
        assert_eq!((words.next(), words.line()), (Some(&b"1e-3"[..]), 2));
        assert_eq!(words.next(), None);
    }

    #[test]
    fn quotes_are_short_and_printable() {
        assert_eq!(quoted(b"ab\x00\xff"), "\"ab\u{fffd}\"");
        assert_eq!(quoted(&[b'x'; 99]), format!("\"{}...\"", "x".repeat(20)));
        assert_eq!(number::<f32>(b"1.5"), Some(1.5));
        assert_eq!(number::<f32>(b"1,5"), None);
    }
}
