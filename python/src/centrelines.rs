//! The middles of vessels as arrays.

use std::sync::Arc;

use lumen::mesh::TriMesh;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Keep, Settings};
use lumen::vessel::{Centrelines as Found, Subject};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

use crate::arrays::{Numbers, array};
use crate::error::refused;
use crate::working::{detached, slice, worked};

/// The middles of the vessels, a line a branch, a parent before its branches.
#[pyclass(frozen, get_all, module = "lumen")]
pub(crate) struct Centrelines {
    /// The stations in mm, n x 3 float64.
    points: Py<PyAny>,
    /// The branches as VTK's cells: how many stations, and their numbers, int64.
    lines: Py<PyAny>,
    /// The radius of the largest ball inside at each station, in mm.
    radius: Py<PyAny>,
    /// The area of the cross-section at each station in mm2, nan where it does not close.
    area: Py<PyAny>,
    /// How far each station is along its branch, in mm.
    abscissa: Py<PyAny>,
    /// The branch that each branch comes from, by number from 0; -1 where it comes from none.
    parents: Py<PyAny>,
}

pub(crate) fn found(py: Python<'_>, mesh: &Arc<TriMesh>, keep: &str) -> PyResult<Centrelines> {
    let keep: Keep = keep.parse().map_err(|_| PyValueError::new_err(format!("{keep} is no value of keep")))?;
    let mut pipeline = Pipeline::new(mesh.clone(), Settings { keep, ..Settings::default() });
    while pipeline.kept().is_none() {
        detached(py, || pipeline.advance(slice()))?.map_err(|error| refused(py, &error))?;
        py.check_signals()?;
    }
    let kept = pipeline.kept().ok_or_else(|| PyRuntimeError::new_err("there is no surface"))?;
    let subject = Subject { mesh: kept.mesh.clone(), topology: kept.topology.clone(), index: None };
    let found = worked(py, |yielder| async move { Found::find(&subject, &yielder).await })?;
    let found = found.map_err(|error| refused(py, &error))?;
    let stations = &found.stations;
    let line = |range: &std::ops::Range<usize>| std::iter::once(range.len()).chain(range.clone());
    let counts = |counts: Vec<usize>| Numbers::Counts(counts.into_iter().map(|count| count as i64).collect());
    let along = |of: fn(&lumen::vessel::Station) -> f64| Numbers::Floats(stations.all.iter().map(of).collect());
    let areas = found.calibres.iter().map(|calibre| calibre.area_mm2.unwrap_or(f64::NAN)).collect();
    let parents = found.branches.iter().map(|branch| branch.parent.map_or(-1, i64::from)).collect();
    Ok(Centrelines {
        points: array(py, Numbers::Places(stations.all.iter().map(|station| station.at.to_array()).collect()))?,
        lines: array(py, counts(stations.of.iter().flat_map(line).collect()))?,
        radius: array(py, along(|station| station.radius_mm))?,
        area: array(py, Numbers::Floats(areas))?,
        abscissa: array(py, along(|station| station.abscissa_mm))?,
        parents: array(py, Numbers::Counts(parents))?,
    })
}
