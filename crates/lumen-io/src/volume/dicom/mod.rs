//! DICOM: the slices of a series, one to a file in any order, or all in one file.
//!
//! Slices of one series, size, direction and spacing are taken apart into volumes (`volumes`) and put in order along their
//! normal. Of several volumes the one of most slices is taken unless another is asked for; the rest is told by number and by
//! what it differs in. Files that cannot be read are left out and counted, as long as there are others. Nothing that names a
//! patient is looked at, kept or reported, a file's name neither.

mod colours;
mod file;
mod jpeg_ls;
mod pixels;
mod segments;
mod tags;
mod volumes;

use glam::{DMat3, DVec3};

use super::super::axes::Axes;
use super::super::error::Feature;
use super::super::numbers::Scalar;
use super::super::offer::Offer;
use super::super::problem::DicomProblem;
use super::super::warnings::{ScanWarning, Warning};
use super::error::ScanError;
use super::numbers::Layout;
use super::outline::{Offers, Scan};
use super::parts::Part;
use file::{FORMAT, File};
use lumen_message::Message as _;
use lumen_volume::{Geometry, Grid, Samples, VolumeError};
use volumes::Volume;

/// By so much of a mean distance two neighbours may be farther apart or closer than others.
const UNEVEN: f64 = 0.05;
/// By so much a direction may differ between slices of a series, and by so many mm two slices of one place.
const SAME: f64 = 1e-3;

/// A slice of a volume.
#[derive(Clone, Copy)]
struct Slice<'f, 'a> {
    file: &'f File<'a>,
    frame: usize,
    position: DVec3,
    /// The directions in which columns and rows are counted.
    orientation: [DVec3; 2],
    /// Distance between rows, and between columns.
    spacing: [f64; 2],
    /// Along the normal, in mm.
    height: f64,
}

/// Reads a volume from the files of a folder: that of number `choice`, from 0, or the one of most slices.
pub(super) fn read(parts: &[&Part], choice: Option<usize>) -> Result<Scan, ScanError> {
    let (mut files, mut unreadable) = (Vec::new(), Unreadable::default());
    let prepared: Vec<_> = parts.iter().map(|part| file::prepared(part.bytes)).collect();
    for bytes in &prepared {
        match bytes.as_ref().map_err(ScanError::clone).and_then(|bytes| File::parse(bytes)) {
            Ok(file) => files.push(file),
            Err(error) => unreadable.add(error),
        }
    }
    if files.is_empty() {
        return Err(unreadable.into_error());
    }
    let empty = files.iter().filter(|file| !file.holds_slices()).count();
    let series = series(&files, &mut unreadable);
    if series.is_empty() {
        let none = if files.iter().any(File::is_in_colours) { DicomProblem::Colours } else { DicomProblem::NoSlice };
        return Err(if empty == files.len() { missing(none) } else { unreadable.into_error() });
    }
    let sizes: Vec<usize> = series.iter().map(Vec::len).collect();
    let volumes: Vec<(usize, Volume)> = series.into_iter().enumerate().flat_map(volumes_of).collect();
    let offers = offers(&volumes);
    let mixed = volumes.iter().filter(|(_, volume)| volume.mixed > 0).count();
    let is_open = |number: usize| volumes[number].1.mixed == 0 || mixed == volumes.len();
    let taken = choice.unwrap_or_else(|| offers.largest(is_open));
    let mut volumes = volumes;
    if taken >= volumes.len() {
        return Err(ScanError::NoSuchVolume { number: taken + 1, count: volumes.len() });
    }
    let (number, volume) = volumes.swap_remove(taken);
    let mut warnings = Vec::new();
    if choice.is_none() {
        warnings.extend(others(&sizes, number, volume.places));
        warnings.extend(offers.warning(number, taken));
        if mixed > 0 {
            warnings.push(ScanWarning::MixedLeftOut { count: mixed }.into());
        }
    }
    if empty > 0 {
        warnings.push(ScanWarning::NoSlices { count: empty }.into());
    }
    if volume.twice > 0 {
        warnings.push(ScanWarning::SamePlace { count: volume.twice }.into());
    }
    if volume.mixed > 0 {
        // Pixels that cannot be read are never the same.
        let unread = volume.shared().find_map(|slice| pixels::frame(slice.file, slice.frame).err());
        return Err(unread.unwrap_or(ScanError::Mixed { places: volume.mixed }));
    }
    let mut scan = if segments::are(&volume.slices) {
        segments::label_map(&volume, &mut warnings)?
    } else {
        scan(volume.slices.to_vec(), &mut unreadable, &mut warnings)?
    };
    warnings.extend(unreadable.warning());
    scan.warnings.splice(..0, warnings);
    (scan.offers, scan.taken) = (offers.list, taken);
    Ok(scan)
}

/// The volumes of a series, with its number.
fn volumes_of<'f, 'a>((number, slices): (usize, Vec<Slice<'f, 'a>>)) -> Vec<(usize, Volume<'f, 'a>)> {
    let volumes = if segments::are(&slices) { segments::split(slices) } else { volumes::split(slices) };
    volumes.into_iter().map(|volume| (number, volume)).collect()
}

/// What the volumes are told by.
fn offers(volumes: &[(usize, Volume)]) -> Offers {
    let offer = |(series, volume): &(usize, Volume)| Offer {
        series: *series,
        slices: volume.places,
        by: volume.by.as_ref().map(|(field, _)| *field),
        value: volume.by.as_ref().map_or_else(String::new, |(_, value)| value.clone()),
    };
    Offers { list: volumes.iter().map(offer).collect() }
}

/// What is told of the series beside number `series`, of whose volumes one of `taken` slices is opened; `sizes` are the slices
/// of each series.
fn others(sizes: &[usize], series: usize, taken: usize) -> Option<Warning> {
    let others = sizes.len() - 1;
    let slices = sizes.iter().sum::<usize>() - sizes[series];
    (others > 0).then(|| ScanWarning::Series { count: others + 1, taken, slices, others }.into())
}

/// The volume of slices.
fn scan(mut slices: Vec<Slice>, unreadable: &mut Unreadable, warnings: &mut Vec<Warning>) -> Result<Scan, ScanError> {
    let (samples, slope, intercept) = samples(&mut slices, unreadable)?;
    let step = step(&slices, warnings)?;
    let geometry = geometry(&slices[0], slices.len(), step)?;
    let grid = Grid::new(geometry, samples, slope, intercept)?;
    let mut scan = Scan::new(grid, FORMAT, Axes::Lps);
    scan.is_ct = slices[0].file.text(tags::MODALITY) == "CT";
    scan.names = slices[0].file.segments().collect();
    Ok(scan)
}

/// Where a grid lies whose first slice is this one.
fn geometry(first: &Slice, slices: usize, step: DVec3) -> Result<Geometry, ScanError> {
    let ([across, down], [between_rows, between_columns]) = (first.orientation, first.spacing);
    let steps = DMat3::from_cols(across * between_columns, down * between_rows, step);
    let size = [first.file.columns, first.file.rows, slices];
    Ok(Geometry::from_steps(size, steps, first.position).map_err(VolumeError::from)?)
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

/// That a file, which may be sound, does not have what a volume takes.
fn missing(what: DicomProblem) -> ScanError {
    ScanError::NoScan { format: FORMAT, problem: what.into() }
}

/// The slices of all files, each with its place, those of a kind together: images first, then segments.
fn series<'f, 'a>(files: &'f [File<'a>], unreadable: &mut Unreadable) -> Vec<Vec<Slice<'f, 'a>>> {
    /// Series are looked back at: slices that each have a direction of their own are of as many.
    const LOOKED_AT: usize = 256;
    let mut series: Vec<Vec<Slice>> = Vec::new();
    for file in files.iter().filter(|file| file.holds_slices()) {
        for frame in 0..file.held_frames() {
            match placed(file, frame) {
                Err(what) => unreadable.add(missing(what)),
                // Most belong to the one before.
                Ok(slice) => {
                    match series.iter_mut().rev().take(LOOKED_AT).find(|group| belong_together(&group[0], &slice)) {
                        Some(group) => group.push(slice),
                        None => series.push(vec![slice]),
                    }
                }
            }
        }
    }
    series.sort_by_key(|group| group[0].file.is_segmentation());
    series
}

/// A frame with its place.
fn placed<'f, 'a>(file: &'f File<'a>, frame: usize) -> Result<Slice<'f, 'a>, DicomProblem> {
    let orientation = file.orientation(frame).ok_or(DicomProblem::NoDirections)?;
    let spacing = file.spacing(frame).ok_or(DicomProblem::NoSpacing)?;
    let normal = orientation[0].cross(orientation[1]);
    let position = file.position(frame, normal).ok_or(DicomProblem::NoPlaces)?;
    Ok(Slice { file, frame, position, orientation, spacing, height: position.dot(normal) })
}

/// Whether two slices may be of one volume.
fn belong_together(a: &Slice, b: &Slice) -> bool {
    let same_way = a.orientation.iter().zip(b.orientation).all(|(a, b)| a.distance(b) < SAME);
    let same_spacing = a.spacing.iter().zip(b.spacing).all(|(a, b)| (a - b).abs() < SAME);
    let form = |file: &File| (file.rows, file.columns, file.bits_allocated, file.is_signed, file.is_segmentation());
    let same_file = std::ptr::eq(a.file, b.file);
    same_way
        && same_spacing
        && (same_file || form(a.file) == form(b.file) && a.file.text(tags::SERIES) == b.file.text(tags::SERIES))
}

/// Whether the pixels of two slices stand for the same values.
fn same_pixels(a: &Slice, b: &Slice) -> bool {
    a.file.rescale(a.frame) == b.file.rescale(b.frame) && matches!((trimmed(a), trimmed(b)), (Ok(a), Ok(b)) if a == b)
}

/// The mean step from a slice to the next, which a tilted gantry makes oblique.
fn step(slices: &[Slice], warnings: &mut Vec<Warning>) -> Result<DVec3, ScanError> {
    let [first, .., last] = slices else {
        return Err(missing(DicomProblem::SingleSlice));
    };
    let steps = (slices.len() - 1) as f64;
    let distances: Vec<f64> = slices.windows(2).map(|two| two[1].height - two[0].height).collect();
    warnings.extend(uneven(&distances));
    Ok((last.position - first.position) / steps)
}

/// What is told of distances that differ: the one that differs most from the usual.
fn uneven(distances: &[f64]) -> Option<Warning> {
    let usual = {
        let mut sorted = distances.to_vec();
        sorted.sort_unstable_by(f64::total_cmp);
        *sorted.get(sorted.len() / 2)?
    };
    let off = |distance: f64| (distance - usual).abs();
    let worst = (0..distances.len()).max_by(|&a, &b| off(distances[a]).total_cmp(&off(distances[b])))?;
    let (there, below, above) = (distances[worst], worst + 1, worst + 2);
    (off(there) > usual * UNEVEN).then(|| {
        if there > usual {
            ScanWarning::Gap { usual, there, below, above }.into()
        } else {
            ScanWarning::Squeeze { usual, there, below, above }.into()
        }
    })
}

/// The stored numbers of all slices, and what turns them into values. Where that differs from slice to slice, the values.
/// Slices whose pixels cannot be read are taken out, as long as there are others.
fn samples(slices: &mut Vec<Slice>, unreadable: &mut Unreadable) -> Result<(Samples, f64, f64), ScanError> {
    let Some(Slice { file: first, .. }) = slices.first() else {
        return Err(std::mem::take(unreadable).into_error());
    };
    let size = [first.columns, first.rows, slices.len()];
    let rescale = |slice: &Slice| slice.file.rescale(slice.frame);
    let layout = Layout::new(FORMAT, size, scalar(first)?, false)?;
    let (slope, intercept) = rescale(&slices[0]);
    let is_uniform = slices.iter().all(|slice| rescale(slice) == (slope, intercept));
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
            values(layout, &pixels, rescale(slice)).and_then(|values| kept.append(&mut samples, &values))
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

/// The type of a file's pixels.
fn scalar(file: &File) -> Result<Scalar, ScanError> {
    Ok(match (file.bits_allocated, file.is_float, file.is_signed) {
        (32, true, _) => Scalar::F32,
        (64, true, _) => Scalar::F64,
        (1 | 8, false, false) => Scalar::U8,
        (8, false, true) => Scalar::I8,
        (16, false, false) => Scalar::U16,
        (16, false, true) => Scalar::I16,
        (32, false, false) => Scalar::U32,
        (32, false, true) => Scalar::I32,
        (bits, ..) => return Err(ScanError::unsupported(FORMAT, Feature::Bits { bits })),
    })
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
