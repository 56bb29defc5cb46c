//! What the pipeline made of a surface.

use std::sync::Arc;

use lumen::io::{Axes, Format, ImportReport};
use lumen::mesh::{Array, TriMesh, Vec3};
use lumen::phantom::Sample;
use lumen::pipeline::deviation::REPORT_SAMPLES;
use lumen::pipeline::normals::{Weighting, vertex_normals};
use lumen::pipeline::progressive::ProgressiveMesh;
use lumen::pipeline::report::{Report, UnitReport};
use lumen::pipeline::results::{Reduced, Smoothed};
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Target};
use lumen::pipeline::verdict::{Verdict, VerdictReport, rate};
use pyo3::exceptions::{PyKeyError, PyRuntimeError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{refused, told};
use crate::settings::Asked;
use crate::surface::Surface;
use crate::working::{Teller, detached};

/// A surface that was smoothed and reduced.
#[pyclass(frozen, module = "lumen")]
pub(crate) struct Optimised {
    smoothed: Arc<Smoothed>,
    reduced: Arc<Reduced>,
    reduced_arrays: Vec<Array>,
    progressive: Arc<ProgressiveMesh>,
    report: Py<PyDict>,
    source: Source,
}

/// What surfaces made of another have from it.
#[derive(Clone)]
struct Source {
    axes: Axes,
    name: String,
    sample: Option<Sample>,
}

impl Source {
    fn surface(&self, mesh: Arc<TriMesh>, normals: Vec<Vec3>, arrays: Vec<Array>) -> Surface {
        let Self { axes, name, sample } = self.clone();
        Surface { mesh, normals, arrays, axes, name, sample, import: None }
    }
}

/// Runs the pipeline on a surface.
pub(crate) fn optimised(
    py: Python<'_>,
    surface: &Surface,
    asked: &Asked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Optimised> {
    if let Some(unit) = asked.unit {
        let text = format!(
            "the settings file has a unit, which is of reading: give it to read(unit=\"{unit}\"), and optimise none"
        );
        return Err(PyTypeError::new_err(text));
    }
    let import = detached(py, || surface.imported())?;
    let pipeline = Pipeline::new(surface.mesh.clone(), asked.settings.clone()).with_samples(REPORT_SAMPLES);
    let mut pipeline = pipeline.with_arrays(surface.arrays.clone()).with_certificate();
    let mut teller = Teller::new(progress);
    teller.run(py, &mut pipeline)?;
    if asked.wants_safe {
        let safe = pipeline.safe().ok_or_else(unfinished)?;
        let refusal = || safe.refused.as_ref().map_or_else(unfinished, |why| refused(py, why));
        let percent = safe.percent.ok_or_else(refusal)?;
        let settings = Settings { target: rate(percent), ..asked.settings.clone() };
        pipeline.set(settings).map_err(|error| refused(py, &error))?;
        teller.run(py, &mut pipeline)?;
    }
    let report =
        told(py, &summed_up(surface, &pipeline, &import).ok_or_else(unfinished)?)?.cast_into::<PyDict>()?.unbind();
    teller.tell("", 1.0)?;
    Ok(Optimised {
        smoothed: pipeline.smoothed().ok_or_else(unfinished)?.clone(),
        reduced: pipeline.reduced().ok_or_else(unfinished)?.clone(),
        reduced_arrays: pipeline.level_arrays().map_or_else(Vec::new, |arrays| arrays.to_vec()),
        progressive: pipeline.progressive().ok_or_else(unfinished)?.clone(),
        report,
        source: Source { axes: import.axes, name: surface.name.clone(), sample: surface.sample },
    })
}

/// The report with what the file and its reader know.
fn summed_up(surface: &Surface, pipeline: &Pipeline, import: &ImportReport) -> Option<Report> {
    let mut report = Report::new(&surface.name, pipeline)?;
    report.axes = import.axes;
    report.unit = Some(UnitReport { unit: import.unit, by_size: import.unit_by_size });
    report.threshold = import.threshold;
    let verdict = Verdict::of_run(pipeline, &report, import, Format::from_name(&surface.name).is_some());
    report.verdict = Some(Box::new(VerdictReport::from(&verdict)));
    Some(report)
}

fn unfinished() -> PyErr {
    PyRuntimeError::new_err("the pipeline ended without a result")
}

#[pymethods]
impl Optimised {
    /// The surface at any rate: `levels[0.9]` is without nine tenths of the triangles.
    #[getter]
    fn levels(&self) -> Levels {
        Levels { progressive: self.progressive.clone(), source: self.source.clone() }
    }

    /// The surface at the rate that the settings ask for.
    #[getter]
    fn reduced(&self) -> Surface {
        let Reduced { mesh, normals, .. } = &*self.reduced;
        self.source.surface(mesh.clone(), normals.clone(), self.reduced_arrays.clone())
    }

    /// The surface before it was reduced.
    #[getter]
    fn smoothed(&self) -> Surface {
        self.source.surface(self.smoothed.mesh.clone(), Vec::new(), Vec::new())
    }

    /// All numbers, as `lumen optimise --report` writes them.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> Bound<'py, PyDict> {
        self.report.bind(py).clone()
    }

    /// What became of the calibre: `calibre` of the report, and its `branches`.
    #[getter]
    fn certificate<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let report = self.report.bind(py);
        let found = report.as_any().get_item("calibre")?.cast_into::<PyDict>()?.copy()?;
        found.set_item("branches", report.as_any().get_item("branches")?)?;
        Ok(found)
    }

    /// What there is to say of the result: `head` in a few words, `findings` with their places and remedies.
    #[getter]
    fn verdict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        self.report.bind(py).as_any().get_item("verdict")
    }

    fn __repr__(&self) -> String {
        format!("<lumen.Optimised with {} triangles>", self.reduced.mesh.triangles.len())
    }
}

/// The surface at any reduction rate, 0 to 0.999.
#[pyclass(frozen, module = "lumen")]
pub(crate) struct Levels {
    progressive: Arc<ProgressiveMesh>,
    source: Source,
}

#[pymethods]
impl Levels {
    fn __getitem__(&self, py: Python<'_>, rate: f64) -> PyResult<Surface> {
        let most = f64::from(Target::MAX_PER_MILLE) / 1000.0;
        if !(0.0..=most).contains(&rate) {
            return Err(PyKeyError::new_err(format!("a rate is 0 to {most}, not {rate}")));
        }
        let (mesh, normals) = detached(py, || {
            let level = self.progressive.level(Target::Reduction((rate * 1000.0).round() as u32));
            let mesh = self.progressive.extract(&level.triangles);
            let normals = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
            (mesh, normals)
        })?;
        Ok(self.source.surface(Arc::new(mesh), normals, Vec::new()))
    }
}
