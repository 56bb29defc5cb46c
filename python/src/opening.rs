//! Files, bytes, scans and samples to surfaces, and surfaces to files.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use lumen::io::volume::{self, Files, Part, ScanError};
use lumen::io::{
    Format, ImportOptions, Imported, ReadError, ThresholdReport, Unit, Warning, import_made, import_mesh,
    read_in_slices,
};
use lumen::phantom::{self, Sample};
use lumen::task::Yielder;
use lumen::volume::{Cut, Method, Selection, VolumeError, half_way, surface_in_slices, survey};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::error::{refused, unusable};
use crate::surface::Surface;
use crate::working::{detached, worked};

/// What of a scan is the vessel.
#[derive(Clone, Copy)]
struct Wanted {
    threshold: Option<f64>,
    label: Option<i64>,
    seed: Option<[f64; 3]>,
}

/// Reads a surface: of a file, of its bytes, of a folder of DICOM slices, or a sample ("sample:aorta", "sample:coronary").
///
/// `name` is the file's name where bytes are read; it matters where they alone do not tell the format, as with OBJ. `unit` is
/// that of the file's numbers: "mm", "cm", "m", or "auto" for the one in which the size is that of vessels. Of a scan
/// `threshold` says where the vessel's wall is, of a mask `label` which label it is (all but 0 without it), and `seed` leaves
/// only what is connected to that point in mm. What takes none of these refuses them with a `TypeError`.
///
/// Not for clinical decisions.
#[pyfunction]
#[pyo3(signature = (source, name=None, *, unit=None, threshold=None, label=None, seed=None))]
pub(crate) fn read(
    py: Python<'_>,
    source: &Bound<'_, PyAny>,
    name: Option<String>,
    unit: Option<&str>,
    threshold: Option<f64>,
    label: Option<i64>,
    seed: Option<[f64; 3]>,
) -> PyResult<Surface> {
    let wanted = Wanted { threshold, label, seed };
    let is_chosen = threshold.is_some() || label.is_some() || seed.is_some();
    if threshold.is_some() && label.is_some() {
        return Err(PyTypeError::new_err("threshold and label are two ways to say one thing"));
    }
    let (name, files) = match source.cast::<PyBytes>() {
        Ok(bytes) => {
            let name = name.unwrap_or_default();
            let files = vec![(name.clone(), bytes.as_bytes().to_vec())];
            let is_volume = volume::is_volume(&files[0].1);
            (name, if is_volume { Ok(files) } else { Err(files) })
        }
        Err(_) => {
            let path: PathBuf = source.extract()?;
            let source = path.to_string_lossy().into_owned();
            if let Some(sample) = source.strip_prefix("sample:") {
                if unit.is_some() || is_chosen {
                    return Err(PyTypeError::new_err("a sample takes no unit, threshold, label or seed"));
                }
                let sample: Sample = sample.parse().map_err(|error| PyValueError::new_err(format!("{error}")))?;
                return Ok(Surface::opened(made(py, sample)?, name.unwrap_or(source), Some(sample)));
            }
            (name.unwrap_or(source), detached(py, || gathered(&path))?.map_err(|error| unusable(&error, &path))?)
        }
    };
    let read = match files {
        Ok(_) if unit.is_some() => return Err(PyTypeError::new_err("a scan is in millimetres: it takes no unit")),
        Err(_) if is_chosen => {
            return Err(PyTypeError::new_err(
                "threshold, label and seed are for scans and masks, and this is a surface",
            ));
        }
        Ok(files) => worked(py, |yielder| async move { scan(&files, wanted, &yielder).await })?,
        Err(mut files) => {
            let bytes = Arc::new(files.swap_remove(0).1);
            let given = unit.filter(|unit| *unit != "auto").map(str::parse::<Unit>).transpose();
            let given = given.map_err(|error| refused(py, &error))?;
            let (name, is_open) = (&name, unit == Some("auto"));
            worked(py, |yielder| async move { surface(bytes, name, given, is_open, &yielder).await })?
                .map_err(ScanError::from)
        }
    };
    Ok(Surface::opened(read.map_err(|error| refused(py, &error))?, name, None))
}

/// Writes a surface: the ending of `path` is the format, .stl, .ply, .obj, .vtp, .vtk or .glb. It is there whole or not at
/// all.
#[pyfunction]
pub(crate) fn write(py: Python<'_>, surface: &Surface, path: PathBuf) -> PyResult<()> {
    surface.save(py, path)
}

fn made(py: Python<'_>, sample: Sample) -> PyResult<Imported> {
    let mut signal = Ok(());
    let mut heard = |py: Python<'_>| match py.check_signals() {
        Ok(()) => ControlFlow::Continue(()),
        Err(found) => {
            signal = Err(found);
            ControlFlow::Break(())
        }
    };
    let made = detached(py, || {
        phantom::generate_with(sample, sample.default_triangles(), &mut |_| Python::attach(&mut heard))
    })?;
    signal?;
    Ok(import_mesh(made.map_err(|error| refused(py, &error))?, "sample"))
}

/// The files of a volume, or the one file that is a surface.
fn gathered(path: &Path) -> std::io::Result<Result<Files, Files>> {
    std::fs::metadata(path)?;
    if let Some(files) = volume::gather(&[path.to_owned()]).map_err(|error| error.source)? {
        return Ok(Ok(files));
    }
    Ok(Err(vec![(String::new(), std::fs::read(path)?)]))
}

async fn surface(
    bytes: Arc<Vec<u8>>,
    name: &str,
    unit: Option<Unit>,
    is_open: bool,
    yielder: &Yielder,
) -> Result<Imported, ReadError> {
    let imported = read_in_slices(bytes.clone(), name, &ImportOptions { unit }, yielder).await?;
    let Some(unit) = imported.report.unit_by_size().filter(|_| is_open) else { return Ok(imported) };
    let mut imported = read_in_slices(bytes, name, &ImportOptions { unit: Some(unit) }, yielder).await?;
    imported.report.unit_by_size = true;
    imported.report.warnings.push(Warning::UnitBySize { unit });
    Ok(imported)
}

/// The surface in a scan or a mask. Reading is one piece, what is made of it is in slices.
async fn scan(files: &Files, wanted: Wanted, yielder: &Yielder) -> Result<Imported, ScanError> {
    let parts: Vec<Part> = files.iter().map(|(name, bytes)| Part { name, bytes }).collect();
    let volume::Scan { grid, format, axes, warnings, .. } = volume::read(&parts)?;
    yielder.rest(0.2).await;
    let grid = Arc::new(grid);
    let survey = survey(&grid);
    let place = |seed| grid.geometry().voxel_at(DVec3::from(seed)).ok_or(VolumeError::SeedNowhere);
    let seed = wanted.seed.map(place).transpose()?;
    let threshold = match seed.filter(|_| wanted.threshold.is_none() && wanted.label.is_none() && !survey.is_mask()) {
        Some(seed) => Some(half_way(&grid, seed).ok_or(VolumeError::NoEdge)?.threshold),
        None => wanted.threshold,
    };
    let selection = Selection::choose(&survey, threshold, wanted.label)?;
    let cut = Cut { selection, region: None, seed, method: Method::of(selection) };
    let mesh = surface_in_slices(&grid, cut, &yielder.part(0.2..0.8)).await?;
    let threshold = ThresholdReport::new(&grid, &mesh, selection);
    let mut imported = import_made(mesh, format.to_owned(), axes, warnings, &yielder.part(0.8..1.0)).await;
    imported.report.threshold = threshold;
    Ok(imported)
}

/// The format that the name of an output file asks for.
pub(crate) fn output_format(path: &Path) -> PyResult<Format> {
    Format::from_name(&path.to_string_lossy()).ok_or_else(|| {
        let endings: Vec<_> = Format::ALL.iter().map(|format| format!(".{}", format.extension())).collect();
        PyValueError::new_err(format!("{} does not end in one of {}", path.display(), endings.join(", ")))
    })
}
