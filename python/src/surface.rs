//! A surface, and what can be done with it.

use std::path::PathBuf;
use std::sync::Arc;

use lumen::cli::whole::put_whole;
use lumen::io::{
    self, Axes, Format, ImportReport, Imported, Unit, UnknownUnit, import_arrays, import_mesh, in_english,
};
use lumen::mesh::{Array, TriMesh, Vec3};
use lumen::phantom::Sample;
use lumen::trial::course::Course;
use lumen::trial::frame::Progress;
use lumen::trial::session::Trial;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::{self, Numbers, array};
use crate::centrelines::{self, Centrelines};
use crate::error::{refused, told, unusable};
use crate::guidewire::setup;
use crate::opening::output_format;
use crate::optimised::{Optimised, optimised};
use crate::working::{Teller, detached, slice, worked};

/// A surface of triangles in mm.
///
/// `Surface(points, triangles)` makes one of arrays: n x 3 coordinates, and m x 3 numbers of points from 0. As of a file,
/// points that coincide are welded, points that nothing uses are left out, and windings are made to agree.
///
/// Not for clinical decisions.
#[pyclass(frozen, module = "lumen")]
pub(crate) struct Surface {
    pub(crate) mesh: Arc<TriMesh>,
    /// One a point, or none.
    pub(crate) normals: Vec<Vec3>,
    /// What the file has for its points and triangles.
    pub(crate) arrays: Vec<Array>,
    pub(crate) axes: Axes,
    pub(crate) name: String,
    pub(crate) sample: Option<Sample>,
    /// What was found when it was read; none of what was made here.
    pub(crate) import: Option<ImportReport>,
}

impl Surface {
    pub(crate) fn opened(imported: Imported, name: String, sample: Option<Sample>) -> Self {
        let Imported { mesh, arrays, report } = imported;
        let axes = report.axes;
        Self { mesh: Arc::new(mesh), normals: Vec::new(), arrays, axes, name, sample, import: Some(report) }
    }

    /// What is known of it as of a file, and whether that has a unit of its own.
    pub(crate) fn imported(&self) -> ImportReport {
        self.import.clone().unwrap_or_else(|| {
            let report = import_mesh((*self.mesh).clone(), "Lumen").report;
            ImportReport { axes: self.axes, ..report }
        })
    }
}

#[pymethods]
impl Surface {
    #[new]
    #[pyo3(signature = (points, triangles, *, unit="mm"))]
    fn new(py: Python<'_>, points: &Bound<'_, PyAny>, triangles: &Bound<'_, PyAny>, unit: &str) -> PyResult<Self> {
        let unit: Unit = unit.parse().map_err(|error: UnknownUnit| refused(py, &error))?;
        let mesh = arrays::mesh(points, triangles)?;
        let imported = worked(py, |yielder| async move { import_arrays(mesh, unit, &yielder).await })?;
        let imported = imported.map_err(|error| refused(py, &error))?;
        Ok(Self::opened(imported, "arrays".to_owned(), None))
    }

    /// The points in mm, n x 3 float32. The array looks at the surface itself, and cannot be written to.
    #[getter]
    fn points(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        array(py, Numbers::Points(self.mesh.clone()))
    }

    /// The numbers of each triangle's points, m x 3 uint32, counter-clockwise from outside. Likewise.
    #[getter]
    fn triangles(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        array(py, Numbers::Triangles(self.mesh.clone()))
    }

    /// What looked odd when it was read, or was mended: sentences.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.import.as_ref().map_or_else(Vec::new, |report| in_english(&report.warnings))
    }

    /// What is in it, as `lumen inspect --json` says it: area, volume, pieces, open edges.
    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        told(py, &detached(py, || self.imported())?)
    }

    /// Keeps the largest piece, smooths it, and reduces it to a progressive mesh.
    ///
    /// `settings` is the content of a settings file, or settings by name; more of them may stand beside it by the names of
    /// the command line: `pass_band=0.01`, `iterations=100`, `reduction=90` (in percent), "auto" or "safe",
    /// `smoothing="paper"`. `progress` is called with what is under way and the part of all that is done, 0 to 1. Ctrl-C and
    /// an exception of `progress` end the work.
    #[pyo3(signature = (settings=None, *, progress=None, **named))]
    fn optimise(
        &self,
        py: Python<'_>,
        settings: Option<&Bound<'_, PyDict>>,
        progress: Option<&Bound<'_, PyAny>>,
        named: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Optimised> {
        optimised(py, self, &crate::settings::asked(py, settings, named)?, progress)
    }

    /// The middles of the vessels with their radii, for PyVista and VTK. `keep` is "largest" or "all" pieces.
    #[pyo3(signature = (*, keep="largest"))]
    fn centrelines(&self, py: Python<'_>, keep: &str) -> PyResult<Centrelines> {
        centrelines::found(py, &self.mesh, keep)
    }

    /// Lets the autopilot steer a guidewire through the surface as it is, and says what came of it, as
    /// `lumen trial --json` does. Without an entry, a target or a wire those are taken that suit the vessel.
    #[pyo3(signature = (*, wire=None, entry=None, direction=None, target=None, seed=0, progress=None))]
    #[allow(clippy::too_many_arguments, reason = "in Python each has its name")]
    fn trial<'py>(
        &self,
        py: Python<'py>,
        wire: Option<&str>,
        entry: Option<[f32; 3]>,
        direction: Option<[f32; 3]>,
        target: Option<[f32; 3]>,
        seed: u64,
        progress: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let mut setup = setup(wire, entry, direction, target, seed)?;
        let begun = detached(py, || {
            let course = Course::new(&self.mesh, self.sample, &mut setup)?;
            Trial::new(Arc::new(course), setup)
        })?;
        let mut trial = begun.map_err(|error| refused(py, &error))?;
        let mut teller = Teller::new(progress);
        trial.set_autopilot(true);
        while trial.progress() == Progress::Running {
            detached(py, || {
                let budget = slice();
                while trial.progress() == Progress::Running && !budget.is_spent() {
                    trial.step();
                }
            })?;
            teller.tell("Trial", trial.part_done() as f32)?;
            py.check_signals()?;
        }
        told(py, &trial.summary())
    }

    /// Writes it: the ending of `path` is the format. It is there whole or not at all.
    #[allow(clippy::needless_pass_by_value, reason = "Python gives it away")]
    pub(crate) fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let format = output_format(&path)?;
        let bytes = detached(py, || self.written(format))?.map_err(|error| refused(py, &error))?;
        py.detach(|| put_whole(&path, &bytes)).map_err(|error| unusable(&error, &path))
    }

    fn __repr__(&self) -> String {
        let TriMesh { positions, triangles } = &*self.mesh;
        format!("<lumen.Surface of {} points and {} triangles>", positions.len(), triangles.len())
    }
}

impl Surface {
    fn written(&self, format: Format) -> Result<Vec<u8>, io::WriteError> {
        let Self { mesh, normals, arrays, axes, .. } = self;
        let normals = (!normals.is_empty()).then_some(&normals[..]);
        io::write_output(&io::Output { mesh, normals, arrays, axes: *axes }, format)
    }
}
