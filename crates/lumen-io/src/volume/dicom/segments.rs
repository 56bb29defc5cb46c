//! Segmentations (DICOM PS3.3 A.51): frames that each say where one segment is, of one bit a pixel or of parts of a whole.
//!
//! They become a map of the segments' numbers. A pixel that is half and more of its segment is in it. Slices without a frame
//! are empty. Where segments overlap no map can hold them, and each is a volume of its own, on the grid of all.
//!
//! Files of one series may each count their segments from 1. A segment is a number in a file; where two files have the same
//! number, or one of them is 0, segments are numbered anew, in the order of files and numbers.

use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use super::super::super::axes::Axes;
use super::super::super::error::Feature;
use super::super::super::numbers::Scalar;
use super::super::super::offer::{LabelName, VolumeField};
use super::super::super::problem::DicomProblem;
use super::super::super::problem::ScanProblem;
use super::super::super::warnings::Warning;
use super::super::error::ScanError;
use super::super::numbers::{Layout, MAX_UNFOLDED};
use super::super::outline::Scan;
use super::file::{FORMAT, File, Value};
use super::volumes::{Volume, is_twin, places};
use super::{SAME, Slice, geometry, missing, pixels, tags, uneven};
use lumen_volume::{Grid, Samples};

/// By so much of a step a frame may lie beside a slice.
const OFF: f64 = 0.1;
/// A grid has fewer slices.
const LONGEST: f64 = (1u32 << 20) as f64;

/// Whether slices are frames of segments. A map of labels is an image as any other.
pub(super) fn are(slices: &[Slice]) -> bool {
    slices
        .first()
        .is_some_and(|slice| slice.file.is_segmentation() && slice.file.text(tags::SEGMENTATION_TYPE) != "LABELMAP")
}

/// All segments as one volume, or each as its own where they overlap.
pub(super) fn split<'f, 'a>(mut slices: Vec<Slice<'f, 'a>>) -> Vec<Volume<'f, 'a>> {
    slices.sort_by(|a, b| {
        let number = |slice| Identity::of(slice).number;
        a.height.total_cmp(&b.height).then_with(|| number(a).cmp(&number(b)))
    });
    let all = slices.len();
    let names = names(&slices);
    slices.dedup_by(|next, kept| {
        let (next_of, kept_of) = (Identity::of(next), Identity::of(kept));
        next_of.number == kept_of.number && names.get(&next_of) == names.get(&kept_of) && is_twin(next, kept)
    });
    let (twice, places) = (all - slices.len(), places(&slices).count());
    let segments = Segments::of(&slices);
    let slices = Rc::from(slices);
    let volume = |by, segment| Volume { slices: Rc::clone(&slices), places, by, segment, twice, mixed: 0 };
    if !overlap(&slices, &segments) {
        return vec![volume(None, None)];
    }
    let names = segments.names.into_iter();
    let of_segment = |(label, named): (u16, Option<LabelName>)| {
        let name = named.map_or_else(|| label.to_string(), |named| named.name);
        volume(Some((VolumeField::Segment, name)), Some(label))
    };
    names.map(of_segment).collect()
}

/// A segment: the file that it is in, by where that stands in memory, and its number there.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Identity {
    file: usize,
    number: u16,
}

impl Identity {
    fn new(file: &File, number: u16) -> Self {
        Self { file: std::ptr::from_ref(file).addr(), number }
    }

    /// Of the segment that a frame is of.
    fn of(slice: &Slice) -> Self {
        let number = slice.file.value(slice.frame, tags::OF_FRAME).and_then(Value::number);
        Self::new(slice.file, number.unwrap_or(1.0) as u16)
    }
}

/// The labels of segments, and their names.
struct Segments {
    labels: BTreeMap<Identity, u16>,
    /// As far as files name them.
    names: Vec<(u16, Option<LabelName>)>,
}

impl Segments {
    /// Of the segments that frames are of. There are not more of them than a label can count, or the rest has none.
    fn of(slices: &[Slice]) -> Self {
        let identities: BTreeSet<Identity> = slices.iter().map(Identity::of).collect();
        let numbers: BTreeSet<u16> = identities.iter().map(|segment| segment.number).collect();
        let is_clear = numbers.len() == identities.len() && !numbers.contains(&0);
        let label = |(count, segment): (u16, Identity)| (segment, if is_clear { segment.number } else { count });
        let labels: BTreeMap<Identity, u16> = (1..=u16::MAX).zip(identities).map(label).collect();
        let said = names(slices);
        let names = labels.iter().map(|(segment, &label)| (label, said.get(segment).cloned())).collect();
        Self { labels, names }
    }

    fn label(&self, slice: &Slice) -> u16 {
        self.labels.get(&Identity::of(slice)).copied().unwrap_or(0)
    }
}

/// The files of slices, each once, by where they stand in memory.
fn files<'f, 'a>(slices: &[Slice<'f, 'a>]) -> BTreeMap<usize, &'f File<'a>> {
    slices.iter().map(|slice| (Identity::of(slice).file, slice.file)).collect()
}

/// What the files of slices call their segments.
fn names(slices: &[Slice]) -> BTreeMap<Identity, LabelName> {
    let of_file = |file| File::segments(file).map(move |named| (Identity::new(file, named.value as u16), named));
    files(slices).into_values().flat_map(of_file).collect()
}

/// Whether a pixel is of two segments, of frames in order of height.
fn overlap(slices: &[Slice], segments: &Segments) -> bool {
    places(slices).filter(|place| place.len() > 1).any(|place| {
        let mut known: Vec<u16> = Vec::new();
        place.iter().any(|slice| {
            let (label, inside) = (segments.label(slice), inside(slice).unwrap_or_default());
            known.resize(inside.len().max(known.len()), 0);
            let mut pixels = known.iter_mut().zip(inside).filter(|(_, inside)| *inside);
            pixels.any(|(known, _)| {
                let before = std::mem::replace(known, label);
                before != 0 && before != label
            })
        })
    })
}

/// Which pixels are in the segment of a frame.
fn inside(slice: &Slice) -> Result<Vec<bool>, ScanError> {
    let file = slice.file;
    if !matches!(file.bits_allocated, 1 | 8 | 16) {
        return Err(ScanError::unsupported(FORMAT, Feature::Bits { bits: file.bits_allocated }));
    }
    let pixels = pixels::frame(file, slice.frame)?;
    let largest = file.own(tags::LARGEST_FRACTION).map_or(1, |largest| largest.short().max(1));
    let half = if file.text(tags::SEGMENTATION_TYPE) == "FRACTIONAL" { largest.div_ceil(2) } else { 1 };
    Ok(match file.bits_allocated {
        16 => pixels.as_chunks().0.iter().map(|&word| u16::from_le_bytes(word) >= half).collect(),
        _ => pixels.iter().map(|&pixel| u16::from(pixel) >= half).collect(),
    })
}

/// The map of the segments of a volume.
pub(super) fn label_map(volume: &Volume, warnings: &mut Vec<Warning>) -> Result<Scan, ScanError> {
    let slices = &volume.slices;
    let [first, .., top] = &slices[..] else { return Err(missing(DicomProblem::SingleSlice)) };
    let rows = rows(slices, warnings).ok_or_else(|| missing(DicomProblem::SingleSlice))?;
    let last = rows[rows.len() - 1];
    let step = (top.position - first.position) / last as f64;
    let geometry = geometry(first, last + 1, step)?;
    let layout = Layout::new(FORMAT, geometry.size, Scalar::U16, false)?;
    let bytes = |file: &File| file.pixels.iter().map(|pixels| pixels.len() as u64).sum();
    let bytes: u64 = files(slices).into_values().map(bytes).max().unwrap_or(0);
    if layout.bytes() > MAX_UNFOLDED.saturating_mul(bytes) {
        return Err(ScanError::malformed(FORMAT, ScanProblem::Packed { needed: layout.bytes(), bytes }));
    }
    let mut labels: Vec<u16> = Vec::new();
    labels.try_reserve_exact(layout.points).map_err(|_| ScanError::Memory { bytes: layout.bytes() })?;
    labels.resize(layout.points, 0);
    let plane = geometry.size[0] * geometry.size[1];
    let segments = Segments::of(slices);
    for (slice, row) in slices.iter().zip(rows) {
        let segment = segments.label(slice);
        if volume.segment.is_some_and(|only| only != segment) {
            continue;
        }
        let target = labels.iter_mut().skip(row * plane).take(plane);
        target.zip(inside(slice)?).filter(|(_, inside)| *inside).for_each(|(label, _)| *label = segment);
    }
    let mut scan = Scan::new(Grid::new(geometry, Samples::U16(labels), 1.0, 0.0)?, FORMAT, Axes::Lps);
    let named =
        segments.names.into_iter().filter_map(|(label, named)| Some(LabelName { value: label.into(), ..named? }));
    scan.names = named.collect();
    Ok(scan)
}

/// Which slice of the grid each frame is; frames without a distance that they keep are one after another, which is told. `None`
/// where there is a single slice.
fn rows(slices: &[Slice], warnings: &mut Vec<Warning>) -> Option<Vec<usize>> {
    let steps: Vec<f64> =
        slices.windows(2).map(|two| two[1].height - two[0].height).filter(|&step| step >= SAME).collect();
    let least = steps.iter().copied().min_by(f64::total_cmp)?;
    let first = slices.first()?;
    let said = first.file.number(first.frame, tags::BETWEEN).filter(|&step| step >= SAME);
    let rows = |step: f64| -> Option<Vec<usize>> {
        let along = slices.iter().map(|slice| (slice.height - first.height) / step);
        let row = |row: f64| ((row - row.round()).abs() < OFF && row < LONGEST - 1.0).then_some(row.round() as usize);
        // A distance that is much too long leaves one slice of all.
        along.map(row).collect::<Option<Vec<_>>>().filter(|rows| rows.last() > Some(&0))
    };
    said.and_then(rows).or_else(|| rows(least)).or_else(|| {
        warnings.extend(uneven(&steps));
        let mut row = 0;
        let next = |two: &[Slice]| {
            row += usize::from(two[1].height - two[0].height >= SAME);
            row
        };
        Some(std::iter::once(0).chain(slices.windows(2).map(next)).collect())
    })
}
