//! The bytes of an array in VTK's XML formats: a header of counts and the data, raw or in base64, as they are or in
//! compressed blocks.
//!
//! Without compression the header is one number, the bytes that follow. With it: the number of blocks, the bytes of a
//! block and of the last one when unfolded (0 where that is whole), and the compressed bytes of each block.

use std::borrow::Cow;

use base64::Engine as _;
use xz4rust::{XzDecoder, XzError};

use super::super::error::ReadError;
use super::super::text::BASE64;

/// How blocks are compressed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compressor {
    Zlib,
    Lz4,
    Lzma,
}

impl Compressor {
    /// The compressor that a file calls `name`.
    pub(super) fn named(name: &str) -> Option<Self> {
        match name {
            "vtkZLibDataCompressor" => Some(Self::Zlib),
            "vtkLZ4DataCompressor" => Some(Self::Lz4),
            "vtkLZMADataCompressor" => Some(Self::Lzma),
            _ => None,
        }
    }
}

/// The largest dictionary that an LZMA block may ask for: that of the highest level, and half of it in small files.
const DICTIONARY: usize = 64 << 20;
const DICTIONARY_OF_SMALL: usize = 32 << 20;
/// Bytes of a file that is not small.
const LARGE: usize = 2_000_000;

/// An array as it stands in the file.
#[derive(Clone, Copy, Debug)]
pub(super) enum Encoded<'a> {
    Raw(&'a [u8]),
    Base64(&'a [u8]),
}

impl<'a> Encoded<'a> {
    /// The first `count` bytes that it stands for; `None` where there are not so many.
    fn first(self, count: u64) -> Option<Cow<'a, [u8]>> {
        let count = usize::try_from(count).ok()?;
        match self {
            Self::Raw(bytes) => bytes.get(..count).map(Cow::Borrowed),
            Self::Base64(text) => from_base64(text, count).map(Cow::Owned),
        }
    }

    fn length(self) -> usize {
        match self {
            Self::Raw(bytes) | Self::Base64(bytes) => bytes.len(),
        }
    }
}

/// The first `count` bytes of a text in base64. A padding may stand in the middle: some writers encode the header by
/// itself.
fn from_base64(text: &[u8], count: usize) -> Option<Vec<u8>> {
    // Four letters make three bytes; whatever the header claims, nothing is counted beyond that.
    if count > text.len() {
        return None;
    }
    let mut out = Vec::with_capacity(count + 3);
    let mut rest = text;
    while out.len() < count {
        let wanted = (count - out.len()).div_ceil(3) * 4;
        let run = &rest[..rest.len().min(wanted)];
        let end = run.iter().position(|&byte| byte == b'=').unwrap_or(run.len());
        if end == 0 {
            return None;
        }
        BASE64.decode_vec(&run[..end], &mut out).ok()?;
        rest = &rest[end..];
        let padding = rest.iter().take(2).take_while(|&&byte| byte == b'=').count();
        rest = &rest[padding..];
    }
    out.truncate(count);
    Some(out)
}

/// How the arrays of a file are encoded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Encoding {
    /// The format, for errors.
    pub(super) format: &'static str,
    pub(super) big_endian: bool,
    /// Whether the header's numbers have 64 bits, not 32.
    pub(super) wide_header: bool,
    pub(super) compressor: Option<Compressor>,
}

impl Encoding {
    /// The bytes of an array; `room` is how many compressed data may still unfold to.
    pub(super) fn decode<'a>(self, source: Encoded<'a>, room: &mut u64) -> Result<Cow<'a, [u8]>, ReadError> {
        match self.compressor {
            None => self.plain(source),
            Some(compressor) => self.unfold(source, compressor, room).map(Cow::Owned),
        }
    }

    fn broken(self, problem: &str) -> ReadError {
        ReadError::Malformed { format: self.format, problem: problem.to_owned() }
    }

    fn cut_short(self) -> ReadError {
        self.broken("an array goes on beyond the end of its data, or these are damaged")
    }

    fn plain(self, source: Encoded) -> Result<Cow<[u8]>, ReadError> {
        let length = self.header(source, 1)?[0];
        let header = self.word();
        let all = header.checked_add(length).and_then(|all| source.first(all)).ok_or_else(|| self.cut_short())?;
        Ok(match all {
            Cow::Borrowed(bytes) => Cow::Borrowed(&bytes[header as usize..]),
            Cow::Owned(mut bytes) => {
                bytes.drain(..header as usize);
                Cow::Owned(bytes)
            }
        })
    }

    fn unfold(self, source: Encoded, compressor: Compressor, room: &mut u64) -> Result<Vec<u8>, ReadError> {
        let blocks = self.header(source, 1)?[0];
        if blocks == 0 {
            return Ok(Vec::new());
        }
        let words = blocks.checked_add(3).filter(|&words| words <= source.length() as u64);
        let header = self.header(source, words.ok_or_else(|| self.cut_short())?)?;
        let (size, last, packed) = (header[1], header[2], &header[3..]);
        let whole = if last == 0 { blocks } else { blocks - 1 };
        let unfolded = whole.checked_mul(size).and_then(|bytes| bytes.checked_add(last));
        // Before anything is made for it.
        let unfolded = unfolded.filter(|bytes| bytes <= room).ok_or_else(|| ReadError::Unfolds {
            format: self.format,
            what: unfolded.map_or("more bytes than there can be".to_owned(), |bytes| format!("{bytes} bytes")),
            file: source.length() as u64,
        })?;
        *room -= unfolded;
        let header_bytes = self.word() * header.len() as u64;
        let all = packed.iter().try_fold(header_bytes, |sum, &bytes| sum.checked_add(bytes));
        let all = all.and_then(|all| source.first(all)).ok_or_else(|| self.cut_short())?;
        let mut input = &all[header_bytes as usize..];
        let mut out = vec![0; unfolded as usize];
        let mut rest = &mut out[..];
        let mut lzma = None;
        for (n, &bytes) in packed.iter().enumerate() {
            let is_partial = last != 0 && n + 1 == packed.len();
            let (block, after) = input.split_at(bytes as usize);
            let (target, left) = rest.split_at_mut(if is_partial { last } else { size } as usize);
            let done = match compressor {
                Compressor::Zlib => inflate(block, target),
                Compressor::Lz4 => lz4_flex::block::decompress_into(block, target).is_ok_and(|n| n == target.len()),
                Compressor::Lzma => self.unpack(block, target, lzma.get_or_insert_with(|| decoder(source.length())))?,
            };
            if !done {
                return Err(self.broken("a compressed block is damaged"));
            }
            (input, rest) = (after, left);
        }
        Ok(out)
    }

    /// The numbers of the header, in so many words.
    fn header(self, source: Encoded, words: u64) -> Result<Vec<u64>, ReadError> {
        let bytes = words.checked_mul(self.word()).and_then(|bytes| source.first(bytes));
        let bytes = bytes.ok_or_else(|| self.cut_short())?;
        let narrow =
            |word: &[u8; 4]| u64::from(if self.big_endian { u32::from_be_bytes } else { u32::from_le_bytes }(*word));
        let wide = |word: &[u8; 8]| if self.big_endian { u64::from_be_bytes } else { u64::from_le_bytes }(*word);
        Ok(match self.wide_header {
            true => bytes.as_chunks::<8>().0.iter().map(wide).collect(),
            false => bytes.as_chunks::<4>().0.iter().map(narrow).collect(),
        })
    }

    /// Bytes of one of the header's numbers.
    fn word(self) -> u64 {
        if self.wide_header { 8 } else { 4 }
    }

    /// Fills `target` from an .xz stream; false where that is damaged or of another length.
    fn unpack(self, block: &[u8], target: &mut [u8], decoder: &mut XzDecoder) -> Result<bool, ReadError> {
        decoder.reset();
        let (mut read, mut written) = (0, 0);
        loop {
            match decoder.decode(&block[read..], &mut target[written..]) {
                Ok(step) => {
                    read += step.input_consumed();
                    written += step.output_produced();
                    if step.is_end_of_stream() || !step.made_progress() {
                        return Ok(step.is_end_of_stream() && written == target.len());
                    }
                }
                Err(XzError::DictionaryTooLarge(bytes)) => {
                    let feature = format!("LZMA with a dictionary of {bytes} bytes");
                    return Err(ReadError::Unsupported { format: self.format, feature });
                }
                Err(_) => return Ok(false),
            }
        }
    }
}

/// One for all blocks of an array of so many bytes: it keeps its dictionary.
fn decoder(file: usize) -> XzDecoder<'static> {
    XzDecoder::with_alloc_dict_size(0, if file > LARGE { DICTIONARY } else { DICTIONARY_OF_SMALL })
}

/// Fills `target` from a zlib stream; false where that is damaged or of another length.
fn inflate(block: &[u8], target: &mut [u8]) -> bool {
    let filled = miniz_oxide::inflate::decompress_slice_iter_to_slice(target, std::iter::once(block), true, false);
    filled == Ok(target.len())
}
