//! DICOM: the slices of a series, one to a file in any order, or all in one file.
//!
//! Slices are put in order along their normal. Of several series, or of slices of other sizes or directions among them, those
//! are taken of which there are most; a sentence tells of the rest by number alone. Nothing that names a patient is looked
//! at, kept or reported, a file's name neither.

mod file;
mod pixels;

use glam::{DMat3, DVec3};

use super::super::numbers::Scalar;
use super::error::ScanError;
use super::numbers::Layout;
use super::{Part, Scan};
use crate::volume::{Geometry, Grid, Samples, VolumeError};
use file::File;

const FORMAT: &str = "DICOM";
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
    let files = parts.iter().map(|part| File::parse(part.bytes)).collect::<Result<Vec<_>, _>>()?;
    let mut warnings = Vec::new();
    let series = largest_series(&files, &mut warnings)?;
    let first = series[0];
    let [across, down] = first.orientation.ok_or_else(|| missing("which way its slices lie"))?;
    let [between_rows, between_columns] = first.spacing.ok_or_else(|| missing("how far apart its pixels are"))?;
    let mut slices = placed(&series, across.cross(down))?;
    slices.sort_by(|a, b| a.height.total_cmp(&b.height).then(a.file.instance.total_cmp(&b.file.instance)));
    let all = slices.len();
    slices.dedup_by(|next, kept| next.height - kept.height < SAME);
    if slices.len() < all {
        let more = all - slices.len();
        warnings.push(format!("{more} slices lie at the place of another: of each place the first is taken."));
    }
    let step = step(&slices, &mut warnings)?;
    let size = [first.columns, first.rows, slices.len()];
    let steps = DMat3::from_cols(across * between_columns, down * between_rows, step);
    let geometry = Geometry::from_steps(size, steps, slices[0].position).map_err(VolumeError::from)?;
    let (samples, slope, intercept) = samples(&slices, size)?;
    let grid = Grid::new(geometry, samples, slope, intercept)?;
    Ok(Scan { grid, format: FORMAT, is_ct: first.modality == "CT", warnings })
}

fn missing(what: &str) -> ScanError {
    ScanError::malformed(FORMAT, format!("it does not say {what}"))
}

/// The files that belong together, of which there are most images.
fn largest_series<'f, 'a>(files: &'f [File<'a>], warnings: &mut Vec<String>) -> Result<Vec<&'f File<'a>>, ScanError> {
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
        return Err(ScanError::malformed(FORMAT, "none of its files holds a slice in shades of grey"));
    };
    let series = groups.swap_remove(number);
    let slices = groups.iter().map(|group| images(group)).fold(0, usize::saturating_add);
    let empty = files.iter().filter(|file| !holds_slices(file)).count();
    if others > 0 {
        warnings.push(format!(
            "The files hold {} series: the one with most slices, {}, is taken, and {slices} of {} are left out.",
            others + 1,
            images(&series),
            if others == 1 { "the other".to_owned() } else { format!("{others} others") },
        ));
    }
    if empty > 0 {
        warnings.push(format!("{empty} files hold no slice in shades of grey and are left out."));
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
    a.series == b.series && same_way && form(a) == form(b)
}

/// The slices of all files, each with its place.
fn placed<'f, 'a>(series: &[&'f File<'a>], normal: DVec3) -> Result<Vec<Slice<'f, 'a>>, ScanError> {
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
            // Frames on top of each other, of which only the first has a place. Each has a pixel, so there are not more of
            // them than bytes.
            let frames = file.frames.min(file.pixels.iter().map(|fragment| fragment.len()).sum());
            slices.extend((0..frames).map(|frame| {
                let position = position + normal * (between * frame as f64);
                Slice { file, frame, position, height: position.dot(normal) }
            }));
        } else {
            return Err(missing("where its slices are"));
        }
    }
    Ok(slices)
}

/// The mean step from a slice to the next, which a tilted gantry makes oblique.
fn step(slices: &[Slice], warnings: &mut Vec<String>) -> Result<DVec3, ScanError> {
    let [first, .., last] = slices else {
        return Err(ScanError::malformed(FORMAT, "it holds a single slice, and a surface takes two or more"));
    };
    let steps = (slices.len() - 1) as f64;
    let mut distances: Vec<f64> = slices.windows(2).map(|two| two[1].height - two[0].height).collect();
    let widest = distances.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(slice, _)| slice);
    let farthest = distances[widest];
    distances.sort_unstable_by(f64::total_cmp);
    let usual = distances[distances.len() / 2];
    if farthest > usual * (1.0 + UNEVEN) || distances[0] < usual * (1.0 - UNEVEN) {
        let (below, above) = (widest + 1, widest + 2);
        warnings.push(format!(
            "The slices are not evenly apart: mostly {usual:.3} mm, but {farthest:.3} mm between slices {below} and {above}; \
             some may be missing, and the surface is stretched there."
        ));
    }
    Ok((last.position - first.position) / steps)
}

/// The stored numbers of all slices, and what turns them into values. Where that differs from slice to slice, the values.
fn samples(slices: &[Slice], size: [usize; 3]) -> Result<(Samples, f64, f64), ScanError> {
    let first = slices[0].file;
    let rescale = |file: &File| (file.slope.unwrap_or(1.0), file.intercept.unwrap_or(0.0));
    let scalar = match (first.bits_allocated, first.is_signed) {
        (8, false) => Scalar::U8,
        (8, true) => Scalar::I8,
        (16, false) => Scalar::U16,
        (16, true) => Scalar::I16,
        (bits, _) => return Err(ScanError::unsupported(FORMAT, format!("{bits} bits a pixel"))),
    };
    let layout = Layout::new(FORMAT, size, scalar, false)?;
    let (slope, intercept) = rescale(first);
    if slices.iter().all(|slice| rescale(slice.file) == (slope, intercept)) {
        let mut samples = layout.begin();
        for slice in slices {
            layout.append(&mut samples, &trimmed(slice)?)?;
        }
        return Ok((samples, slope, intercept));
    }
    let in_values = Layout::new(FORMAT, size, Scalar::F32, false)?;
    let mut samples = in_values.begin();
    for slice in slices {
        let mut stored = layout.begin();
        layout.append(&mut stored, &trimmed(slice)?)?;
        let (slope, intercept) = rescale(slice.file);
        let values = (0..stored.len()).map(|at| (slope * stored.stored(at) + intercept) as f32);
        in_values.append(&mut samples, &values.flat_map(f32::to_le_bytes).collect::<Vec<u8>>())?;
    }
    Ok((samples, 1.0, 0.0))
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
