//! The numbers of a volume out of the bytes of a file, as they are, packed by gzip or zlib, or as text.

use std::io::{self, Read};

use flate2::bufread::{MultiGzDecoder, ZlibDecoder};

use super::super::error::ReadError;
use super::super::numbers::Scalar;
use super::super::text::{self, Words};
use super::error::ScanError;
use crate::volume::{SampleType, Samples};

/// The most bytes that the numbers of a volume may take: 512 x 512 x 800 at 16 bit five times over.
pub(super) const LARGEST: u64 = 1 << 31;
/// Deflate makes 258 bytes of two bits at most.
pub(super) const MOST_UNFOLDED: u64 = 1032;
/// Numbers that there is room for at once.
const FIRST_ROOM: usize = 1 << 20;
/// Bytes that are read at a time.
const BLOCK: usize = 1 << 16;

/// What a header says of the numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layout {
    /// The format, for errors.
    pub(super) format: &'static str,
    /// How many there are.
    pub(super) points: usize,
    pub(super) scalar: Scalar,
    pub(super) is_big_endian: bool,
}

/// How they are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    Plain,
    Gzip,
    Zlib,
    Text,
}

/// Whether bytes are packed by gzip.
pub(super) fn is_gzip(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x1f\x8b")
}

/// What the beginning of a gzip file unfolds to: as many bytes as any header here has, or fewer where it is damaged.
pub(super) fn first_unfolded(bytes: &[u8]) -> Vec<u8> {
    let mut head = vec![0; 600];
    let (mut source, mut filled) = (MultiGzDecoder::new(bytes), 0);
    while let Ok(read @ 1..) = source.read(&mut head[filled..]) {
        filled += read;
    }
    head.truncate(filled);
    head
}

/// The type in which numbers of a file are kept: 64-bit whole numbers as floats.
fn sample_type(scalar: Scalar) -> SampleType {
    match scalar {
        Scalar::I8 => SampleType::I8,
        Scalar::U8 => SampleType::U8,
        Scalar::I16 => SampleType::I16,
        Scalar::U16 => SampleType::U16,
        Scalar::I32 => SampleType::I32,
        Scalar::U32 => SampleType::U32,
        Scalar::F32 => SampleType::F32,
        Scalar::I64 | Scalar::U64 | Scalar::F64 => SampleType::F64,
    }
}

impl Layout {
    /// For a grid of so many points along each axis.
    pub(super) fn new(
        format: &'static str,
        size: [usize; 3],
        scalar: Scalar,
        is_big_endian: bool,
    ) -> Result<Self, ScanError> {
        let bytes = size.iter().try_fold(scalar.size() as u64, |bytes, &along| bytes.checked_mul(along as u64));
        match bytes {
            Some(bytes @ 0..=LARGEST) => {
                let points = (bytes / scalar.size() as u64) as usize;
                Ok(Self { format, points, scalar, is_big_endian })
            }
            _ => Err(ScanError::TooLarge { bytes: bytes.unwrap_or(u64::MAX), limit: LARGEST }),
        }
    }

    /// The bytes that the numbers take.
    fn bytes(self) -> u64 {
        (self.points * self.scalar.size()) as u64
    }

    /// Takes the numbers out of the bytes of a file, after `skipped` of those that these unfold to.
    pub(super) fn take(self, bytes: &[u8], packing: Packing, skipped: u64) -> Result<Samples, ScanError> {
        match packing {
            Packing::Text => self.take_text(bytes),
            Packing::Plain => {
                let start = usize::try_from(skipped).unwrap_or(usize::MAX).min(bytes.len());
                let bytes = &bytes[start..];
                if (bytes.len() as u64) < self.bytes() {
                    return Err(self.cut_short(bytes.len() as u64));
                }
                self.fill(bytes)
            }
            Packing::Gzip | Packing::Zlib => {
                let needed = self.bytes().saturating_add(skipped);
                if needed > MOST_UNFOLDED * bytes.len() as u64 {
                    let (what, file) = (format!("{needed} bytes"), bytes.len() as u64);
                    return Err(ReadError::Unfolds { format: self.format, what, file }.into());
                }
                if packing == Packing::Gzip {
                    self.unfold(MultiGzDecoder::new(bytes), skipped)
                } else {
                    self.unfold(ZlibDecoder::new(bytes), skipped)
                }
            }
        }
    }

    fn unfold(self, mut source: impl Read, skipped: u64) -> Result<Samples, ScanError> {
        let passed = io::copy(&mut source.by_ref().take(skipped), &mut io::sink());
        if passed.map_err(|_| self.damaged())? < skipped {
            return Err(self.cut_short(0));
        }
        self.fill(source)
    }

    /// Reads the numbers, making room as they come.
    fn fill(self, mut source: impl Read) -> Result<Samples, ScanError> {
        let mut samples = self.begin();
        let (size, mut block, mut kept) = (self.scalar.size(), vec![0; BLOCK], 0);
        while samples.len() < self.points {
            let read = source.read(&mut block[kept..]).map_err(|_| self.damaged())?;
            if read == 0 {
                return Err(self.cut_short((samples.len() * size + kept) as u64));
            }
            let filled = kept + read;
            let whole = (filled / size).min(self.points - samples.len());
            self.make_room(&mut samples, whole)?;
            let words = &block[..whole * size];
            match self.scalar {
                Scalar::I64 => self.push_wide(words, &mut samples, |word| i64::from_le_bytes(word) as f64),
                Scalar::U64 => self.push_wide(words, &mut samples, |word| u64::from_le_bytes(word) as f64),
                _ => samples.extend_from_bytes(words, self.is_big_endian),
            }
            block.copy_within(whole * size..filled, 0);
            kept = filled - whole * size;
        }
        Ok(samples)
    }

    /// Adds whole numbers of 64 bits as floats.
    fn push_wide(self, words: &[u8], samples: &mut Samples, value: impl Fn([u8; 8]) -> f64) {
        for &word in words.as_chunks::<8>().0 {
            let mut word = word;
            if self.is_big_endian {
                word.reverse();
            }
            samples.push(value(word));
        }
    }

    fn take_text(self, bytes: &[u8]) -> Result<Samples, ScanError> {
        // A digit and a space each.
        if (bytes.len() as u64).div_ceil(2) < self.points as u64 {
            return Err(self.cut_short(bytes.len() as u64));
        }
        let mut samples = self.begin();
        let mut words = Words::new(bytes, 1);
        while samples.len() < self.points {
            let word = words.next().ok_or_else(|| self.cut_short((samples.len() * self.scalar.size()) as u64))?;
            let value = text::number(word).ok_or_else(|| {
                ScanError::malformed(self.format, format!("{} stands where a number should", text::quoted(word)))
            })?;
            self.make_room(&mut samples, 1)?;
            samples.push(value);
        }
        Ok(samples)
    }

    /// None of the numbers yet.
    pub(super) fn begin(self) -> Samples {
        Samples::new(sample_type(self.scalar))
    }

    /// Adds the next numbers, as they are.
    pub(super) fn append(self, samples: &mut Samples, bytes: &[u8]) -> Result<(), ScanError> {
        self.make_room(samples, bytes.len() / self.scalar.size())?;
        samples.extend_from_bytes(bytes, self.is_big_endian);
        Ok(())
    }

    /// Makes room for `more` numbers: four times as much as there was, but never more than is needed.
    fn make_room(self, samples: &mut Samples, more: usize) -> Result<(), ScanError> {
        let needed = samples.len() + more;
        if needed > samples.capacity() {
            let room = needed.max(4 * samples.len()).max(FIRST_ROOM).min(self.points);
            samples.try_reserve(room - samples.len()).map_err(|_| ScanError::Memory { bytes: self.bytes() })?;
        }
        Ok(())
    }

    fn cut_short(self, found: u64) -> ScanError {
        let what = "bytes".to_owned();
        ReadError::CutShort { format: self.format, what, announced: self.bytes(), found }.into()
    }

    fn damaged(self) -> ScanError {
        ScanError::malformed(self.format, "its compressed data are damaged")
    }
}
