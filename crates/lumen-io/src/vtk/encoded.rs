//! The bytes of an array in VTK's XML formats: a header of counts and the data, raw or in base64, as they are or in
//! compressed blocks.
//!
//! Without compression the header is one number, the bytes that follow. With it: the number of blocks, the bytes of a
//! block and of the last one when unfolded (0 where that is whole), and the compressed bytes of each block.
//!
//! A block of LZ4 or LZMA is unfolded at once: its crates' calls have no end but that of the block, and VTK makes blocks of
//! 32 kB (well below a millisecond for LZ4, about one for LZMA).

use std::borrow::Cow;

use base64::Engine as _;
use miniz_oxide::inflate::TINFLStatus;
use miniz_oxide::inflate::core::inflate_flags::{
    TINFL_FLAG_HAS_MORE_INPUT, TINFL_FLAG_PARSE_ZLIB_HEADER, TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF,
};
use miniz_oxide::inflate::core::{DecompressorOxide, decompress};
use xz4rust::{XzDecoder, XzError};

use super::super::error::{Feature, ReadError, Unfolded};
use super::super::pace::{BYTES, Pace};
use super::super::problem::{Problem, VtkProblem};
use super::super::text::BASE64;

/// Packed bytes of zlib between two rests: of numbers they make three times as many.
const PART: usize = 1 << 14;

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
/// The part of the work on a letter, or on a packed byte, that decoding or unfolding it is.
const DECODED: f64 = 0.5;

/// An array as it stands in the file.
#[derive(Clone, Copy, Debug)]
pub(super) enum Encoded<'a> {
    Raw(&'a [u8]),
    Base64(&'a [u8]),
}

impl<'a> Encoded<'a> {
    /// The first `count` bytes that it stands for; `None` where there are not so many. A letter is `done` by that.
    async fn first(self, count: u64, pace: &Pace, done: f64) -> Option<Cow<'a, [u8]>> {
        let count = usize::try_from(count).ok()?;
        match self {
            Self::Raw(bytes) => bytes.get(..count).map(Cow::Borrowed),
            Self::Base64(text) => from_base64(text, count, pace, done).await.map(Cow::Owned),
        }
    }

    /// Bytes of the file that `count` bytes are still to be told for once they are decoded: letters are half done.
    fn left(self, count: usize) -> f64 {
        count as f64 * if matches!(self, Self::Raw(_)) { 1.0 } else { 4.0 / 3.0 * (1.0 - DECODED) }
    }

    fn length(self) -> usize {
        match self {
            Self::Raw(bytes) | Self::Base64(bytes) => bytes.len(),
        }
    }
}

/// The first `count` bytes of a text in base64. A padding may stand in the middle: some writers encode the header by
/// itself.
async fn from_base64(text: &[u8], count: usize, pace: &Pace, done: f64) -> Option<Vec<u8>> {
    // Four letters make three bytes; whatever the header claims, nothing is counted beyond that.
    if count > text.len() {
        return None;
    }
    let mut out = Vec::with_capacity(count + 3);
    let mut rest = text;
    while out.len() < count {
        // Whole groups of four letters.
        let wanted = ((count - out.len()).div_ceil(3) * 4).min(BYTES);
        let run = &rest[..rest.len().min(wanted)];
        let end = run.iter().position(|&byte| byte == b'=').unwrap_or(run.len());
        if end == 0 {
            return None;
        }
        BASE64.decode_vec(&run[..end], &mut out).ok()?;
        rest = &rest[end..];
        let padding = rest.iter().take(2).take_while(|&&byte| byte == b'=').count();
        rest = &rest[padding..];
        pace.rest(done * end as f64).await;
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
    /// The bytes of an array, and how many bytes of the file are still to be told for it; `room` is how many compressed
    /// data may still unfold to.
    pub(super) async fn decode<'a>(
        self,
        source: Encoded<'a>,
        room: &mut u64,
        pace: &Pace,
    ) -> Result<(Cow<'a, [u8]>, f64), ReadError> {
        match self.compressor {
            None => self.plain(source, pace).await,
            Some(compressor) => {
                self.unfold(source, compressor, room, pace).await.map(|(bytes, left)| (Cow::Owned(bytes), left))
            }
        }
    }

    fn broken(self, problem: impl Into<Problem>) -> ReadError {
        ReadError::malformed(self.format, problem)
    }

    fn cut_short(self) -> ReadError {
        self.broken(VtkProblem::ArrayEnds)
    }

    async fn plain<'a>(self, source: Encoded<'a>, pace: &Pace) -> Result<(Cow<'a, [u8]>, f64), ReadError> {
        let length = self.header(source, 1, pace).await?[0];
        let header = self.word();
        let all = header.checked_add(length).ok_or_else(|| self.cut_short())?;
        let all = source.first(all, pace, DECODED).await.ok_or_else(|| self.cut_short())?;
        let left = source.left(all.len());
        let bytes = match all {
            Cow::Borrowed(bytes) => Cow::Borrowed(&bytes[header as usize..]),
            Cow::Owned(mut bytes) => {
                bytes.drain(..header as usize);
                Cow::Owned(bytes)
            }
        };
        Ok((bytes, left))
    }

    async fn unfold(
        self,
        source: Encoded<'_>,
        compressor: Compressor,
        room: &mut u64,
        pace: &Pace,
    ) -> Result<(Vec<u8>, f64), ReadError> {
        let blocks = self.header(source, 1, pace).await?[0];
        if blocks == 0 {
            return Ok((Vec::new(), 0.0));
        }
        let words = blocks.checked_add(3).filter(|&words| words <= source.length() as u64);
        let header = self.header(source, words.ok_or_else(|| self.cut_short())?, pace).await?;
        let (size, last, packed) = (header[1], header[2], &header[3..]);
        let whole = if last == 0 { blocks } else { blocks - 1 };
        let unfolded = whole.checked_mul(size).and_then(|bytes| bytes.checked_add(last));
        // Before anything is made for it.
        let unfolded = unfolded.filter(|bytes| bytes <= room).ok_or_else(|| ReadError::Unfolds {
            format: self.format,
            what: match unfolded {
                Some(bytes) => Unfolded::Bytes { bytes },
                None => Unfolded::TooManyBytes,
            },
            file: source.length() as u64,
        })?;
        *room -= unfolded;
        let header_bytes = self.word() * header.len() as u64;
        let all = packed.iter().try_fold(header_bytes, |sum, &bytes| sum.checked_add(bytes));
        let all = all.ok_or_else(|| self.cut_short())?;
        let all = source.first(all, pace, DECODED).await.ok_or_else(|| self.cut_short())?;
        let left = source.left(all.len());
        let done = DECODED * left / all.len().max(1) as f64;
        let mut input = &all[header_bytes as usize..];
        let mut out = vec![0; unfolded as usize];
        let mut rest = &mut out[..];
        let mut lzma = None;
        for (n, &bytes) in packed.iter().enumerate() {
            let is_partial = last != 0 && n + 1 == packed.len();
            let (block, after) = input.split_at(bytes as usize);
            let (target, others) = rest.split_at_mut(if is_partial { last } else { size } as usize);
            let is_whole = match compressor {
                Compressor::Zlib => inflate(block, PART, target, pace, done).await,
                Compressor::Lz4 => lz4_flex::block::decompress_into(block, target).is_ok_and(|n| n == target.len()),
                Compressor::Lzma => self.unpack(block, target, lzma.get_or_insert_with(|| decoder(source.length())))?,
            };
            if !is_whole {
                return Err(self.broken(VtkProblem::Block));
            }
            if compressor != Compressor::Zlib {
                pace.rest(done * bytes as f64).await;
            }
            (input, rest) = (after, others);
        }
        Ok((out, (1.0 - DECODED) * left))
    }

    /// The numbers of the header, in so many words.
    async fn header(self, source: Encoded<'_>, words: u64, pace: &Pace) -> Result<Vec<u64>, ReadError> {
        let bytes = words.checked_mul(self.word()).ok_or_else(|| self.cut_short())?;
        let bytes = source.first(bytes, pace, 0.0).await.ok_or_else(|| self.cut_short())?;
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
                    let feature = Feature::Lzma { bytes };
                    return Err(ReadError::Unsupported { format: self.format, feature });
                }
                Err(_) => return Ok(false),
            }
        }
    }
}

/// One for all blocks of an array of so many bytes: it keeps its dictionary.
fn decoder(file: usize) -> Box<XzDecoder<'static>> {
    Box::new(XzDecoder::with_alloc_dict_size(0, if file > LARGE { DICTIONARY } else { DICTIONARY_OF_SMALL }))
}

/// Fills `target` from a zlib stream, in parts of so many packed bytes; false where it is damaged or of another length. A
/// packed byte is `done` by that.
async fn inflate(block: &[u8], part: usize, target: &mut [u8], pace: &Pace, done: f64) -> bool {
    const FLAGS: u32 = TINFL_FLAG_USING_NON_WRAPPING_OUTPUT_BUF | TINFL_FLAG_PARSE_ZLIB_HEADER;
    let mut state = Box::new(DecompressorOxide::new());
    let (mut rest, mut written) = (block, 0);
    loop {
        let (now, after) = rest.split_at(rest.len().min(part));
        let flags = if after.is_empty() { FLAGS } else { FLAGS | TINFL_FLAG_HAS_MORE_INPUT };
        let (status, read, bytes) = decompress(&mut state, now, target, written, flags);
        written += bytes;
        pace.rest(done * now.len() as f64).await;
        // With the target full and the end of the stream in the next part it asks for more room, not for more to read.
        let goes_on = matches!(status, TINFLStatus::NeedsMoreInput | TINFLStatus::HasMoreOutput);
        if !goes_on || read < now.len() || after.is_empty() {
            return status == TINFLStatus::Done && written == target.len();
        }
        rest = after;
    }
}

#[cfg(test)]
mod tests {
    use miniz_oxide::deflate::compress_to_vec_zlib;

    use super::*;
    use lumen_mesh::task::at_once;

    #[test]
    fn a_stream_is_the_same_in_parts_of_any_length() {
        let numbers: Vec<u8> = (0..400u32).flat_map(|i| libm::sinf(i as f32).to_le_bytes()).collect();
        for level in [0, 1, 6, 9] {
            let packed = compress_to_vec_zlib(&numbers, level);
            let in_parts = |part: usize, length: usize| {
                let mut target = vec![0; length];
                let is_whole = at_once(inflate(&packed, part, &mut target, &Pace::never(), 0.0));
                is_whole.then_some(target)
            };
            for part in 1..=packed.len() {
                assert_eq!(in_parts(part, numbers.len()).as_ref(), Some(&numbers), "level {level}, parts of {part}");
                assert_eq!(in_parts(part, numbers.len() - 1), None, "more than there is room for");
                assert_eq!(in_parts(part, numbers.len() + 1), None, "less than was announced");
            }
        }
    }
}
