//! The numbers of a volume as they stand in a file: their type and number, and how they become samples. Those that are packed
//! come through `stream`.

use std::io::{BufReader, Read as _};

use flate2::bufread::MultiGzDecoder;

use super::super::detect::GZIP;
use super::super::error::{Counted, ReadError};
use super::super::numbers::Scalar;
use super::super::problem::{ScanProblem, TextProblem};
use super::super::text::{self, Words};
use super::error::ScanError;
use lumen_volume::{SampleType, Samples};

/// The most bytes that the numbers of a volume may take: 512 x 512 x 800 at 16 bit five times over.
pub(super) const LARGEST: u64 = 1 << 31;
/// Deflate makes 258 bytes of two bits at most.
pub(super) const MAX_UNFOLDED: u64 = 1032;
/// Numbers that there is room for at once.
const FIRST_ROOM: usize = 1 << 20;

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
    bytes.starts_with(GZIP)
}

/// What the beginning of a gzip file unfolds to: as many bytes as any header here has, or fewer where it is damaged.
pub(super) fn first_unfolded(bytes: &[u8]) -> Vec<u8> {
    let mut head = vec![0; 600];
    // Byte by byte: what stands before damage counts, wherever that is.
    let (mut source, mut filled) = (MultiGzDecoder::new(BufReader::with_capacity(1, bytes)), 0);
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

    /// For so many grids in each other.
    pub(super) fn times(self, layers: usize) -> Result<Self, ScanError> {
        let bytes = self.bytes().saturating_mul(layers as u64);
        if bytes > LARGEST {
            return Err(ScanError::TooLarge { bytes, limit: LARGEST });
        }
        Ok(Self { points: self.points * layers, ..self })
    }

    /// The bytes that the numbers take.
    pub(super) fn bytes(self) -> u64 {
        (self.points * self.scalar.size()) as u64
    }

    /// Refuses packed data of so many bytes that cannot unfold to the numbers.
    pub(super) fn check_packed(self, packing: Packing, bytes: u64, skipped: u64) -> Result<(), ScanError> {
        let needed = self.bytes().saturating_add(skipped);
        let is_packed = matches!(packing, Packing::Gzip | Packing::Zlib);
        if is_packed && needed > MAX_UNFOLDED.saturating_mul(bytes) {
            let problem = ScanProblem::Packed { needed, bytes };
            return Err(ScanError::malformed(self.format, problem));
        }
        Ok(())
    }

    /// Takes the numbers out of bytes that are unpacked.
    pub(super) fn take(self, bytes: &[u8]) -> Result<Samples, ScanError> {
        if (bytes.len() as u64) < self.bytes() {
            return Err(self.cut_short(bytes.len() as u64));
        }
        let mut samples = self.begin();
        self.add(&mut samples, bytes)?;
        Ok(samples)
    }

    /// Adds the next numbers, whole ones, and none that are too many.
    pub(super) fn add(self, samples: &mut Samples, words: &[u8]) -> Result<(), ScanError> {
        let wanted = (self.points - samples.len()) * self.scalar.size();
        let words = &words[..words.len().min(wanted)];
        self.make_room(samples, words.len() / self.scalar.size())?;
        match self.scalar {
            Scalar::I64 => self.push_wide(words, samples, |word| i64::from_le_bytes(word) as f64),
            Scalar::U64 => self.push_wide(words, samples, |word| u64::from_le_bytes(word) as f64),
            _ => samples.extend_from_bytes(words, self.is_big_endian),
        }
        Ok(())
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

    /// Takes numbers that are written as text.
    pub(super) fn take_text(self, bytes: &[u8]) -> Result<Samples, ScanError> {
        // A digit and a space each.
        if (bytes.len() as u64).div_ceil(2) < self.points as u64 {
            return Err(self.cut_short(bytes.len() as u64));
        }
        let mut samples = self.begin();
        let mut words = Words::new(bytes, 1);
        while samples.len() < self.points {
            let word = words.next().ok_or_else(|| self.cut_short((samples.len() * self.scalar.size()) as u64))?;
            let value = text::number(word)
                .ok_or_else(|| ScanError::malformed(self.format, TextProblem::NoNumber { word: text::quoted(word) }))?;
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
    pub(super) fn make_room(self, samples: &mut Samples, more: usize) -> Result<(), ScanError> {
        let needed = samples.len() + more;
        if needed > samples.capacity() {
            let room = needed.max(4 * samples.len()).max(FIRST_ROOM).min(self.points);
            samples.try_reserve(room - samples.len()).map_err(|_| ScanError::Memory { bytes: self.bytes() })?;
        }
        Ok(())
    }

    /// That there are no more than `found` bytes of them.
    pub(super) fn cut_short(self, found: u64) -> ScanError {
        let what = Counted::Bytes;
        ReadError::CutShort { format: self.format, what, announced: self.bytes(), found }.into()
    }

    /// That they cannot be unpacked.
    pub(super) fn damaged(self) -> ScanError {
        ScanError::malformed(self.format, ScanProblem::PackedDamaged)
    }
}
