//! A guidewire that another program steers: the lines of `docs/serve.md`, without a process between.

use lumen::cli::serve::Door;
use lumen::trial::course::TrialError;
use lumen::trial::setup::{Entry, Setup};
use lumen::trial::wire::Wire;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{self, parsed};
use crate::surface::Surface;
use crate::working::detached;

/// A guidewire in a surface. `ask` takes and gives what `lumen trial --serve` does, as dictionaries.
///
/// Not for clinical decisions.
#[pyclass(module = "lumen")]
pub(crate) struct Guidewire(Door);

#[pymethods]
impl Guidewire {
    #[new]
    #[pyo3(signature = (surface, *, wire=None, entry=None, direction=None, target=None, seed=0))]
    fn new(
        py: Python<'_>,
        surface: &Surface,
        wire: Option<&str>,
        entry: Option<[f32; 3]>,
        direction: Option<[f32; 3]>,
        target: Option<[f32; 3]>,
        seed: u64,
    ) -> PyResult<Self> {
        let setup = setup(wire, entry, direction, target, seed)?;
        let door = detached(py, || Door::new(surface.mesh.clone(), surface.sample, setup, None))?;
        door.map(Self).map_err(|error| refused(py, &error))
    }

    /// Does what is asked for, and says how the wire is then.
    #[pyo3(signature = (**request))]
    fn ask<'py>(&mut self, py: Python<'py>, request: Option<&Bound<'py, PyDict>>) -> PyResult<Bound<'py, PyAny>> {
        let line: String = py.import("json")?.call_method1("dumps", (request,))?.extract()?;
        let answer = detached(py, || self.0.answered(line.as_bytes()))?;
        parsed(py, &answer.map_err(|error| refused(py, &error))?)
    }

    /// What stays as it is until the next reset, and how the wire is.
    fn about<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        parsed(py, &self.0.greeting().map_err(|error| refused(py, &error))?)
    }
}

/// What a trial or a line is refused for.
fn refused(py: Python<'_>, error: &anyhow::Error) -> PyErr {
    let known = error.downcast_ref::<TrialError>();
    known.map_or_else(|| PyValueError::new_err(format!("{error:#}")), |known| error::refused(py, known))
}

/// What a trial is to be; what is not given the vessel proposes.
pub(crate) fn setup(
    wire: Option<&str>,
    entry: Option<[f32; 3]>,
    direction: Option<[f32; 3]>,
    target: Option<[f32; 3]>,
    seed: u64,
) -> PyResult<Setup> {
    if direction.is_some() && entry.is_none() {
        return Err(PyTypeError::new_err("a direction is that of an entry, which is missing"));
    }
    let entry = entry.map(|at| Entry { at, direction: direction.unwrap_or_default() });
    let proposes_wire = wire.is_none();
    let wire = wire.map_or_else(
        || Ok(Wire::default()),
        |name| {
            let names = || Wire::names().collect::<Vec<_>>().join(", ");
            let none = || PyValueError::new_err(format!("there is no wire {name:?}; there are {}", names()));
            Wire::preset(name).ok_or_else(none)
        },
    )?;
    Ok(Setup { wire, proposes_wire, entry, target, seed, ..Setup::default() })
}
