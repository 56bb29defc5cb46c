//! DICOM: the slices of a series, one to a file in any order, or all in one file.
//!
//! Slices are put in order along their normal. Of several series, or of slices of other sizes or directions among them, those
//! are taken of which there are most; a sentence tells of the rest by number alone. Files that cannot be read are left out and
//! counted, as long as there are others. Nothing that names a patient is looked at, kept or reported, a file's name neither.

mod file;
mod pixels;

use glam::{DMat3, DVec3};

use super::super::axes::Axes;
use super::super::error::Feature;
use super::super::numbers::Scalar;
use super::super::problem::DicomProblem;
use super::super::warnings::{ScanWarning, Warning};
use super::error::ScanError;
use super::numbers::Layout;
use super::outline::Scan;
use super::parts::Part;
use file::{FORMAT, File};
use lumen_message::Message as _;
use lumen_volume::{Geometry, Grid, Samples, VolumeError};

/// By so much of a mean distance two neighbours may be farther apart or closer than others.
const UNEVEN: f64 = 0.05;
/// By so much a direction may differ between slices of a series, and by so many mm two slices of one place.
const SAME: f64 = 1e-3;

/// A slice of the volume.
struct Slice<'f, 'a> {
    file: &'f File<'a>,
    frame: usize,
    position: DVec3,
    /// Along the normal, in mm.
    height: f64,
}

/// Reads a series from the files of a folder.
pub(super) fn read(parts: &[&Part]) -> Result<Scan, ScanError> {
    let (mut files, mut unreadable) = (Vec::new(), Unreadable::default());
    for part in parts {
        match File::parse(part.bytes) {
            Ok(file) => files.push(file),
            Err(error) => unreadable.add(error),
        }
    }
    if files.is_empty() {
        return Err(unreadable.into_error());
    }
    let mut warnings = Vec::new();
    let series = largest_series(&files, &mut warnings)?;
    let first = series[0];
    let [across, down] = first.orientation.ok_or_else(|| missing(DicomProblem::NoDirections))?;
    let [between_rows, between_columns] = first.spacing.ok_or_else(|| missing(DicomProblem::NoSpacing))?;
    let mut slices = placed(&series, across.cross(down), &mut unreadable);
    slices.sort_by(|a, b| a.height.total_cmp(&b.height).then(a.file.instance.total_cmp(&b.file.instance)));
    let all = slices.len();
    slices.dedup_by(|next, kept| next.height - kept.height < SAME);
    if slices.len() < all {
        let more = all - slices.len();
        warnings.push(ScanWarning::SamePlace { count: more }.into());
    }
    let (samples, slope, intercept) = samples(&mut slices, &mut unreadable)?;
    warnings.extend(unreadable.warning());
    let step = step(&slices, &mut warnings)?;
    let size = [first.columns, first.rows, slices.len()];
    let steps = DMat3::from_cols(across * between_columns, down * between_rows, step);
    let geometry = Geometry::from_steps(size, steps, slices[0].position).map_err(VolumeError::from)?;
    let grid = Grid::new(geometry, samples, slope, intercept)?;
    Ok(Scan { grid, format: FORMAT, axes: Axes::Lps, is_ct: first.modality == "CT", warnings })
}

/// Files and slices that cannot be read.
#[derive(Default)]
struct Unreadable {
    first: Option<ScanError>,
    count: usize,
}

impl Unreadable {
    fn add(&mut self, error: ScanError) {
        self.first.get_or_insert(error);
        self.count += 1;
    }

    /// Why there is nothing left.
    fn into_error(self) -> ScanError {
        self.first.unwrap_or_else(|| missing(DicomProblem::NoPlaces))
    }

    /// What to tell the user of them.
    fn warning(&self) -> Option<Warning> {
        let first = self.first.as_ref()?;
        Some(ScanWarning::Unreadable { count: self.count, why: first.told() }.into())
    }
}

/// That a file does not say what it should.
fn missing(what: DicomProblem) -> ScanError {
    ScanError::malformed(FORMAT, what)
}

/// The files that belong together, of which there are most images.
fn largest_series<'f, 'a>(files: &'f [File<'a>], warnings: &mut Vec<Warning>) -> Result<Vec<&'f File<'a>>, ScanError> {
    let mut groups: Vec<Vec<&File>> = Vec::new();
    let holds_slices = |file: &&File| {
        !file.pixels.is_empty() && file.is_monochrome && file.samples_per_pixel == 1 && file.rows * file.columns > 0
    };
    for file in files.iter().filter(holds_slices) {
        match groups.iter_mut().find(|group| belong_together(group[0], file)) {
            Some(group) => group.push(file),
            None => groups.push(vec![file]),
        }
    }
    let images = |group: &[&File]| group.iter().map(|file| file.frames).fold(0, usize::saturating_add);
    let others = groups.len().saturating_sub(1);
    let taken = groups.iter().enumerate().max_by_key(|(number, group)| (images(group), std::cmp::Reverse(*number)));
    let Some((number, _)) = taken else {
        return Err(ScanError::malformed(FORMAT, DicomProblem::NoSlice));
    };
    let series = groups.swap_remove(number);
    let slices = groups.iter().map(|group| images(group)).fold(0, usize::saturating_add);
    let empty = files.iter().filter(|file| !holds_slices(file)).count();
    if others > 0 {
        let (count, taken, slices) = (others + 1, images(&series), slices);
        warnings.push(ScanWarning::Series { count, taken, slices, others }.into());
    }
    if empty > 0 {
        warnings.push(ScanWarning::NoSlices { count: empty }.into());
    }
    Ok(series)
}

/// Whether two files are slices of one volume.
fn belong_together(a: &File, b: &File) -> bool {
    let alike = |a: DVec3, b: DVec3| a.distance(b) < SAME;
    let same_way = match (a.orientation, b.orientation) {
        (Some(a), Some(b)) => alike(a[0], b[0]) && alike(a[1], b[1]),
        (a, b) => a.is_none() && b.is_none(),
    };
    let form = |file: &File| (file.rows, file.columns, file.bits_allocated, file.is_signed);
    let same_spacing = match (a.spacing, b.spacing) {
        (Some(a), Some(b)) => a.iter().zip(b).all(|(a, b)| (a - b).abs() < SAME),
        (a, b) => a.is_none() && b.is_none(),
    };
    a.series == b.series && same_way && same_spacing && form(a) == form(b)
}

/// The most frames that the bytes of a file can hold: packed ones have a fragment each.
fn most_frames(file: &File) -> usize {
    let frame = (file.rows * file.columns).saturating_mul(usize::from(file.bits_allocated)) / 8;
    let bytes: usize = file.pixels.iter().map(|fragment| fragment.len()).sum();
    file.pixels.len().max(bytes / frame.max(1))
}

/// The slices of all files, each with its place.
fn placed<'f, 'a>(series: &[&'f File<'a>], normal: DVec3, unreadable: &mut Unreadable) -> Vec<Slice<'f, 'a>> {
    let mut slices = Vec::new();
    for &file in series {
        if file.positions.len() == file.frames {
            slices.extend(file.positions.iter().enumerate().map(|(frame, &position)| Slice {
                file,
                frame,
                position,
                height: position.dot(normal),
            }));
        } else if let (&[position], Some(between)) = (&file.positions[..], file.between) {
            // Frames on top of each other, of which only the first has a place.
            let frames = file.frames.min(most_frames(file));
            slices.extend((0..frames).map(|frame| {
                let position = position + normal * (between * frame as f64);
                Slice { file, frame, position, height: position.dot(normal) }
            }));
        } else {
            unreadable.add(missing(DicomProblem::NoPlaces));
        }
    }
    slices
}

/// The mean step from a slice to the next, which a tilted gantry makes oblique.
fn step(slices: &[Slice], warnings: &mut Vec<Warning>) -> Result<DVec3, ScanError> {
    let [first, .., last] = slices else {
        return Err(ScanError::malformed(FORMAT, DicomProblem::SingleSlice));
    };
    let steps = (slices.len() - 1) as f64;
    let distances: Vec<f64> = slices.windows(2).map(|two| two[1].height - two[0].height).collect();
    let usual = {
        let mut sorted = distances.clone();
        sorted.sort_unstable_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    };
    let off = |distance: f64| (distance - usual).abs();
    let worst = (0..distances.len()).max_by(|&a, &b| off(distances[a]).total_cmp(&off(distances[b]))).unwrap_or(0);
    let there = distances[worst];
    if off(there) > usual * UNEVEN {
        let (below, above) = (worst + 1, worst + 2);
        let (is_wide, usual, there) = (there > usual, usual, there);
        warnings.push(if is_wide {
            ScanWarning::Gap { usual, there, below, above }.into()
        } else {
            ScanWarning::Squeeze { usual, there, below, above }.into()
        });
    }
    Ok((last.position - first.position) / steps)
}

/// The stored numbers of all slices, and what turns them into values. Where that differs from slice to slice, the values.
/// Slices whose pixels cannot be read are taken out, as long as there are others.
fn samples(slices: &mut Vec<Slice>, unreadable: &mut Unreadable) -> Result<(Samples, f64, f64), ScanError> {
    let Some(Slice { file: first, .. }) = slices.first() else {
        return Err(std::mem::take(unreadable).into_error());
    };
    let size = [first.columns, first.rows, slices.len()];
    let rescale = |file: &File| (file.slope.unwrap_or(1.0), file.intercept.unwrap_or(0.0));
    let scalar = match (first.bits_allocated, first.is_signed) {
        (8, false) => Scalar::U8,
        (8, true) => Scalar::I8,
        (16, false) => Scalar::U16,
        (16, true) => Scalar::I16,
        (bits, _) => return Err(ScanError::unsupported(FORMAT, Feature::Bits { bits })),
    };
    let layout = Layout::new(FORMAT, size, scalar, false)?;
    let (slope, intercept) = rescale(first);
    let is_uniform = slices.iter().all(|slice| rescale(slice.file) == (slope, intercept));
    let kept = if is_uniform { layout } else { Layout::new(FORMAT, size, Scalar::F32, false)? };
    let mut samples = kept.begin();
    let mut failed = None;
    slices.retain(|slice| {
        if failed.is_some() {
            return false;
        }
        let pixels = match trimmed(slice) {
            Ok(pixels) => pixels,
            Err(error) => {
                unreadable.add(error);
                return false;
            }
        };
        let appended = if is_uniform {
            kept.append(&mut samples, &pixels)
        } else {
            values(layout, &pixels, rescale(slice.file)).and_then(|values| kept.append(&mut samples, &values))
        };
        failed = appended.err();
        failed.is_none()
    });
    match (failed, slices.is_empty()) {
        (Some(error), _) => Err(error),
        (None, true) => Err(std::mem::take(unreadable).into_error()),
        (None, false) if is_uniform => Ok((samples, slope, intercept)),
        (None, false) => Ok((samples, 1.0, 0.0)),
    }
}

/// The values that stored numbers stand for, as bytes of floats.
fn values(layout: Layout, pixels: &[u8], (slope, intercept): (f64, f64)) -> Result<Vec<u8>, ScanError> {
    let mut stored = layout.begin();
    layout.append(&mut stored, pixels)?;
    let values = (0..stored.len()).map(|at| (slope * stored.stored(at) + intercept) as f32);
    Ok(values.flat_map(f32::to_le_bytes).collect())
}

/// The pixels of a slice without what older files keep in the bits above a pixel's own.
fn trimmed(slice: &Slice) -> Result<Vec<u8>, ScanError> {
    let file = slice.file;
    let mut pixels = pixels::frame(file, slice.frame)?;
    let unused = u32::from(file.bits_allocated.saturating_sub(file.bits_stored));
    if file.bits_allocated == 16 && (1..16).contains(&unused) {
        for word in pixels.as_chunks_mut::<2>().0 {
            let shifted = u16::from_le_bytes(*word) << unused;
            *word = if file.is_signed {
                (shifted as i16 >> unused).to_le_bytes()
            } else {
                (shifted >> unused).to_le_bytes()
            };
        }
    }
    Ok(pixels)
}
