//! Segmentations (DICOM PS3.3 A.51): frames that each say where one segment is, of one bit a pixel or of parts of a whole.
//!
//! They become a map of the segments' numbers. A pixel that is half and more of its segment is in it. Slices without a frame
//! are empty. Where segments overlap no map can hold them, and each is a volume of its own.

use super::super::super::axes::Axes;
use super::super::super::numbers::Scalar;
use super::super::super::offer::VolumeField;
use super::super::super::problem::DicomProblem;
use super::super::super::problem::ScanProblem;
use super::super::error::ScanError;
use super::super::numbers::{Layout, MAX_UNFOLDED};
use super::super::outline::Scan;
use super::file::FORMAT;
use super::volumes::Volume;
use super::{SAME, Slice, geometry, missing, pixels, tags};
use lumen_volume::{Grid, Samples};

/// By so much of a step a frame may lie beside a slice.
const OFF: f64 = 0.1;

/// Whether slices are frames of segments. A map of labels is an image as any other.
pub(super) fn are(slices: &[Slice]) -> bool {
    slices
        .first()
        .is_some_and(|slice| slice.file.is_segmentation() && slice.file.text(tags::SEGMENTATION_TYPE) != "LABELMAP")
}

/// All segments as one volume, or each as its own where they overlap.
pub(super) fn split<'f, 'a>(mut slices: Vec<Slice<'f, 'a>>) -> Vec<Volume<'f, 'a>> {
    slices.sort_by(|a, b| a.height.total_cmp(&b.height).then(segment(a).cmp(&segment(b))));
    let all = slices.len();
    slices.dedup_by(|a, b| a.height - b.height < SAME && segment(a) == segment(b));
    let twice = all - slices.len();
    if !overlap(&slices) {
        return vec![Volume { slices, by: None, segment: None, twice, mixed: 0 }];
    }
    let mut numbers: Vec<u16> = slices.iter().map(segment).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let names: Vec<_> = slices[0].file.segments().collect();
    let volume = |number: u16| {
        let name = names
            .iter()
            .find(|(known, _)| *known == number)
            .map_or_else(|| number.to_string(), |(_, name)| name.clone());
        Volume {
            slices: slices.clone(),
            by: Some((VolumeField::Segment, name)),
            segment: Some(number),
            twice,
            mixed: 0,
        }
    };
    numbers.into_iter().map(volume).collect()
}

/// The number of the segment that a frame is of.
fn segment(slice: &Slice) -> u16 {
    slice.file.value(slice.frame, tags::OF_FRAME).map_or(1, |number| number.number().unwrap_or(1.0) as u16)
}

/// Whether a pixel is of two segments, of frames in order of height.
fn overlap(slices: &[Slice]) -> bool {
    slices.chunk_by(|a, b| b.height - a.height < SAME).filter(|place| place.len() > 1).any(|place| {
        let mut known: Vec<bool> = Vec::new();
        place.iter().any(|slice| {
            let inside = inside(slice).unwrap_or_default();
            let meets = known.iter().zip(&inside).any(|(a, b)| *a && *b);
            known.resize(inside.len().max(known.len()), false);
            known.iter_mut().zip(inside).for_each(|(known, inside)| *known |= inside);
            meets
        })
    })
}

/// Which pixels are in the segment of a frame.
fn inside(slice: &Slice) -> Result<Vec<bool>, ScanError> {
    let file = slice.file;
    let pixels = pixels::frame(file, slice.frame)?;
    let largest = file.own(tags::LARGEST_FRACTION).map_or(1, |largest| largest.short().max(1));
    let half = if file.text(tags::SEGMENTATION_TYPE) == "FRACTIONAL" { largest.div_ceil(2) } else { 1 };
    Ok(match file.bits_allocated {
        16 => pixels.as_chunks().0.iter().map(|&word| u16::from_le_bytes(word) >= half).collect(),
        _ => pixels.iter().map(|&pixel| u16::from(pixel) >= half).collect(),
    })
}

/// The map of the segments of a volume.
pub(super) fn label_map(volume: &Volume) -> Result<Scan, ScanError> {
    let slices = &volume.slices;
    let first = slices.first().ok_or_else(|| missing(DicomProblem::SingleSlice))?;
    let rows = rows(slices).ok_or_else(|| missing(DicomProblem::SingleSlice))?;
    let last = rows[rows.len() - 1];
    let step = (slices[slices.len() - 1].position - first.position) / last as f64;
    let geometry = geometry(first, last + 1, step)?;
    let layout = Layout::new(FORMAT, geometry.size, Scalar::U16, false)?;
    let bytes = slices
        .iter()
        .map(|slice| slice.file)
        .map(|file| file.pixels.iter().map(|pixels| pixels.len() as u64).sum::<u64>());
    let bytes = bytes.max().unwrap_or(0);
    if layout.bytes() > MAX_UNFOLDED.saturating_mul(bytes) {
        return Err(ScanError::malformed(FORMAT, ScanProblem::Packed { needed: layout.bytes(), bytes }));
    }
    let mut labels: Vec<u16> = Vec::new();
    labels.try_reserve_exact(layout.points).map_err(|_| ScanError::Memory { bytes: layout.bytes() })?;
    labels.resize(layout.points, 0);
    let plane = geometry.size[0] * geometry.size[1];
    for (slice, row) in
        slices.iter().zip(rows).filter(|(slice, _)| volume.segment.is_none_or(|only| only == segment(slice)))
    {
        let target = labels.iter_mut().skip(row * plane);
        target.zip(inside(slice)?).filter(|(_, inside)| *inside).for_each(|(label, _)| *label = segment(slice));
    }
    let mut scan = Scan::new(Grid::new(geometry, Samples::U16(labels), 1.0, 0.0)?, FORMAT, Axes::Lps);
    scan.names = first.file.segments().map(|(number, name)| (number.into(), name)).collect();
    Ok(scan)
}

/// Which slice of the grid each frame is; frames without a distance that they keep are one after another. `None` where there is
/// a single slice.
fn rows(slices: &[Slice]) -> Option<Vec<usize>> {
    let steps = slices.windows(2).map(|two| two[1].height - two[0].height).filter(|&step| step >= SAME);
    let least = steps.min_by(f64::total_cmp)?;
    let [first, ..] = slices else { return None };
    let said = first.file.number(first.frame, tags::BETWEEN).filter(|&step| step >= SAME);
    let rows = |step: f64| -> Option<Vec<usize>> {
        let along = slices.iter().map(|slice| (slice.height - first.height) / step);
        along.map(|row| ((row - row.round()).abs() < OFF).then_some(row.round() as usize)).collect()
    };
    said.and_then(rows).or_else(|| rows(least)).or_else(|| {
        let mut row = 0;
        let next = |two: &[Slice]| {
            row += usize::from(two[1].height - two[0].height >= SAME);
            row
        };
        Some(std::iter::once(0).chain(slices.windows(2).map(next)).collect())
    })
}
