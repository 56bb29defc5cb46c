//! The pixels of a frame: as they are, by run lengths (DICOM PS3.5, annex G), or as a JPEG, JPEG-LS or JPEG 2000 picture.
//!
//! The codecs of `dicom-transfer-syntax-registry` are not used: where a picture is smaller than the file says, or a run ends
//! early, they index beyond it and panic. Its JPEG decoder is used directly; run lengths are thirty lines. JPEG 2000 is read by
//! `hayro-jpeg2000`, which forbids unsafe code, as a bare codestream alone, which is all that DICOM has.

use hayro_jpeg2000::{DecodeSettings, DecoderContext, Image};
use jpeg_decoder::{Decoder, Error, PixelFormat, UnsupportedFeature};

use super::super::super::error::Feature;
use super::super::super::problem::DicomProblem;
use super::super::error::ScanError;
use super::super::numbers::{LARGEST, MAX_UNFOLDED};
use super::file::{FORMAT, File, Packing};
use super::jpeg_ls;

/// The pixels of frame `frame` of a file, in little-endian order.
pub(super) fn frame(file: &File, frame: usize) -> Result<Vec<u8>, ScanError> {
    let size = (file.bits_allocated as usize / 8).max(1);
    let bytes = (file.rows as u64 * file.columns as u64).saturating_mul(size as u64);
    if bytes > LARGEST {
        return Err(ScanError::TooLarge { bytes, limit: LARGEST });
    }
    let bytes = bytes as usize;
    let short = || ScanError::malformed(FORMAT, DicomProblem::Pixels);
    if file.bits_allocated == 1 && matches!(file.packing, Some(Packing::Little | Packing::Big)) {
        return bits(file, frame, bytes).ok_or_else(short);
    }
    match file.packing {
        Some(kind @ (Packing::Rle | Packing::Jpeg | Packing::JpegLs | Packing::Jpeg2000)) => {
            let packed = packed(file, frame).ok_or_else(short)?;
            // Of an empty slice JPEG 2000 keeps hardly more than its size, and JPEG-LS a bit for each row.
            let is_dense = matches!(kind, Packing::JpegLs | Packing::Jpeg2000);
            let most = if is_dense { 64 * MAX_UNFOLDED } else { MAX_UNFOLDED };
            if bytes as u64 > most * packed.len() as u64 {
                return Err(short());
            }
            match kind {
                Packing::Rle => run_lengths(&packed, size, bytes).ok_or_else(short),
                Packing::JpegLs => predicted(&packed, file),
                Packing::Jpeg2000 => wavelets(&packed, file),
                _ => picture(&packed, file),
            }
        }
        is_big_endian => {
            let all = file.pixels.first().copied().unwrap_or_default();
            let start = frame.checked_mul(bytes).ok_or_else(short)?;
            let mut pixels = all.get(start..).and_then(|rest| rest.get(..bytes)).ok_or_else(short)?.to_vec();
            if is_big_endian == Some(Packing::Big) {
                pixels.chunks_exact_mut(size).for_each(<[u8]>::reverse);
            }
            Ok(pixels)
        }
    }
}

/// Pixels of one bit, the lowest of a byte first; a frame begins where the one before ends, within a byte too.
fn bits(file: &File, frame: usize, pixels: usize) -> Option<Vec<u8>> {
    let all = file.pixels.first()?;
    let start = frame.checked_mul(pixels)?;
    let end = start.checked_add(pixels)?;
    let bit = |at: usize| all[at / 8] >> (at % 8) & 1;
    (end <= all.len().saturating_mul(8)).then(|| (start..end).map(bit).collect())
}

/// The fragments of a frame, one after another: all of them for a file's only one, a fragment for each, or several.
fn packed(file: &File, frame: usize) -> Option<Vec<u8>> {
    match file.frames {
        1 => Some(file.pixels.concat()),
        frames if frames == file.pixels.len() => file.pixels.get(frame).map(|fragment| fragment.to_vec()),
        frames if frames == file.first_fragments.len() => {
            let end = file.first_fragments.get(frame + 1).copied().unwrap_or(file.pixels.len());
            Some(file.pixels.get(*file.first_fragments.get(frame)?..end)?.concat())
        }
        _ => None,
    }
}

/// Unfolds run lengths: a segment for each byte of a pixel, the highest first, into little-endian pixels. `None` where a
/// segment is too short.
fn run_lengths(packed: &[u8], size: usize, bytes: usize) -> Option<Vec<u8>> {
    let word = |index: usize| {
        packed.get(4 * index..4 * index + 4)?.first_chunk().map(|&word| u32::from_le_bytes(word) as usize)
    };
    if word(0)? != size {
        return None;
    }
    let mut pixels = vec![0; bytes];
    for segment in 0..size {
        let end = if segment + 1 < size { word(segment + 2)? } else { packed.len() };
        let mut input = packed.get(word(segment + 1)?..end)?.iter().copied();
        let mut output = pixels.iter_mut().skip(size - 1 - segment).step_by(size);
        let mut left = bytes / size;
        while left > 0 {
            match input.next()? as i8 {
                -128 => {}
                count @ 0.. => {
                    for _ in 0..=count {
                        let byte = input.next()?;
                        if let Some(pixel) = output.next() {
                            *pixel = byte;
                        }
                    }
                    left = left.saturating_sub(count as usize + 1);
                }
                count => {
                    let (byte, run) = (input.next()?, 1 + usize::from(count.unsigned_abs()));
                    output.by_ref().take(run).for_each(|pixel| *pixel = byte);
                    left = left.saturating_sub(run);
                }
            }
        }
    }
    Some(pixels)
}

/// Decodes a JPEG picture of one channel.
fn picture(packed: &[u8], file: &File) -> Result<Vec<u8>, ScanError> {
    let damaged = || ScanError::malformed(FORMAT, DicomProblem::Jpeg);
    let mut decoder = Decoder::new(packed);
    decoder.read_info().map_err(|error| match error {
        Error::Unsupported(UnsupportedFeature::SamplePrecision(bits)) => {
            ScanError::unsupported(FORMAT, Feature::JpegBits { bits })
        }
        _ => damaged(),
    })?;
    let info = decoder.info().ok_or_else(damaged)?;
    let (width, height) = (usize::from(info.width), usize::from(info.height));
    let size = match info.pixel_format {
        PixelFormat::L8 => 1,
        PixelFormat::L16 => 2,
        _ => return Err(damaged()),
    };
    if (width, height) != (file.columns, file.rows) || size > file.bits_allocated as usize / 8 {
        return Err(ScanError::malformed(FORMAT, DicomProblem::JpegSize));
    }
    decoder.set_max_decoding_buffer_size(width * height * size);
    let pixels = decoder.decode().map_err(|_| damaged())?;
    if pixels.len() != width * height * size {
        return Err(damaged());
    }
    Ok(match (size, file.bits_allocated) {
        (1, 16) => pixels.into_iter().flat_map(|byte| [byte, 0]).collect(),
        (2, _) => pixels.as_chunks().0.iter().flat_map(|&word| u16::from_ne_bytes(word).to_le_bytes()).collect(),
        _ => pixels,
    })
}

/// Decodes a JPEG-LS picture.
fn predicted(packed: &[u8], file: &File) -> Result<Vec<u8>, ScanError> {
    let damaged = || ScanError::malformed(FORMAT, DicomProblem::Jpeg);
    let picture = jpeg_ls::Picture::parse(packed).ok_or_else(damaged)?;
    if (picture.columns, picture.rows) != (file.columns, file.rows)
        || u16::from(picture.bits) > file.bits_allocated
        || !matches!(file.bits_allocated, 8 | 16 | 32)
    {
        return Err(ScanError::malformed(FORMAT, DicomProblem::JpegSize));
    }
    let samples = picture.decode().ok_or_else(damaged)?;
    let size = usize::from(file.bits_allocated / 8);
    Ok(samples.into_iter().flat_map(|sample| u32::from(sample).to_le_bytes().into_iter().take(size)).collect())
}

/// What a JPEG 2000 picture says first (ISO/IEC 15444-1, A.5.1): its size, its tiles and the numbers of its one component. It
/// is looked at before the decoder is, which makes room for all components and tiles that are announced.
struct Announced {
    size: [u64; 2],
    tiles: u64,
    is_signed: bool,
}

impl Announced {
    /// `None` where it is no bare codestream of one component.
    fn parse(packed: &[u8]) -> Option<Self> {
        const CODESTREAM: &[u8] = &[0xFF, 0x4F, 0xFF, 0x51];
        const COMPONENTS: usize = 40;
        const DEPTH: usize = 42;
        let word = |at: usize| packed.get(at..)?.first_chunk().map(|&word| u64::from(u32::from_be_bytes(word)));
        let pair = |at: usize| Some([word(at)?, word(at + 4)?]);
        if !packed.starts_with(CODESTREAM) || packed.get(COMPONENTS..DEPTH)? != [0, 1] {
            return None;
        }
        let [end, start, tile, first_tile] = [pair(8)?, pair(16)?, pair(24)?, pair(32)?];
        let along = |axis: usize| end[axis].checked_sub(start[axis]);
        let tiles = |axis: usize| {
            (tile[axis] > 0)
                .then(|| end[axis].checked_sub(first_tile[axis]))
                .flatten()
                .map(|all| all.div_ceil(tile[axis]))
        };
        let (size, is_signed) = ([along(0)?, along(1)?], packed.get(DEPTH)? & 0x80 != 0);
        Some(Self { size, tiles: tiles(0)?.checked_mul(tiles(1)?)?, is_signed })
    }
}

/// Decodes a JPEG 2000 picture of one channel. The decoder takes pixels for numbers from 0 on; whether they are signed the
/// picture says, whatever the file says.
fn wavelets(packed: &[u8], file: &File) -> Result<Vec<u8>, ScanError> {
    /// As many as the standard can number.
    const MOST_TILES: u64 = 65_535;
    /// Its numbers are floats, which hold so many bits.
    const DEEPEST: u8 = 24;
    let damaged = || ScanError::malformed(FORMAT, DicomProblem::Jpeg);
    let other_size = || ScanError::malformed(FORMAT, DicomProblem::JpegSize);
    let announced = Announced::parse(packed).filter(|announced| announced.tiles <= MOST_TILES).ok_or_else(damaged)?;
    if announced.size != [file.columns as u64, file.rows as u64] {
        return Err(other_size());
    }
    let image = Image::new(packed, &DecodeSettings::default()).map_err(|_| damaged())?;
    let bits = image.original_bit_depth();
    if (image.width() as usize, image.height() as usize) != (file.columns, file.rows)
        || u16::from(bits) > file.bits_allocated
        || !matches!(file.bits_allocated, 8 | 16 | 32)
    {
        return Err(other_size());
    }
    let mut context = DecoderContext::default();
    let decoded = image.decode(&mut context).map_err(|_| damaged())?;
    let [channel] = decoded.components() else { return Err(damaged()) };
    if channel.samples().len() != file.rows * file.columns || !(1..=DEEPEST).contains(&bits) {
        return Err(damaged());
    }
    let lowest = if announced.is_signed { 1 << (bits - 1) } else { 0 };
    let last = (1i32 << bits) - 1;
    let numbers = channel.samples().iter().map(|&sample| (sample.round() as i32).clamp(0, last) - lowest);
    let size = usize::from(file.bits_allocated / 8);
    Ok(numbers.flat_map(|number| number.to_le_bytes().into_iter().take(size)).collect())
}
