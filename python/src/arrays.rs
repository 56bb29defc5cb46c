//! Numbers that numpy looks at where they are, and numbers that come from it.
//!
//! numpy's array interface is a dictionary with the address, so nothing is copied. The arrays cannot be written to: the
//! surface that they are of is the same for whoever else holds it.

use std::sync::Arc;

use lumen::mesh::{TriMesh, Vec3};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};

/// What holds the numbers; an array holds it for as long as it is there.
pub(crate) enum Numbers {
    Points(Arc<TriMesh>),
    Triangles(Arc<TriMesh>),
    Floats(Vec<f64>),
    /// Places, three floats each.
    Places(Vec<[f64; 3]>),
    Counts(Vec<i64>),
}

/// Numbers with numpy's array interface.
#[pyclass(frozen)]
pub(crate) struct Memory(Numbers);

#[pymethods]
impl Memory {
    #[getter]
    fn __array_interface__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let of = |kind, address: usize, rows, columns| (kind, address, rows, columns);
        let (kind, address, rows, columns) = match &self.0 {
            Numbers::Points(mesh) => of("f4", mesh.positions.as_ptr() as usize, mesh.positions.len(), Some(3)),
            Numbers::Triangles(mesh) => of("u4", mesh.triangles.as_ptr() as usize, mesh.triangles.len(), Some(3)),
            Numbers::Floats(floats) => of("f8", floats.as_ptr() as usize, floats.len(), None),
            Numbers::Places(places) => of("f8", places.as_ptr() as usize, places.len(), Some(3)),
            Numbers::Counts(counts) => of("i8", counts.as_ptr() as usize, counts.len(), None),
        };
        let order = if cfg!(target_endian = "big") { ">" } else { "<" };
        let told = PyDict::new(py);
        told.set_item("version", 3)?;
        told.set_item("typestr", format!("{order}{kind}"))?;
        match columns {
            Some(columns) => told.set_item("shape", (rows, columns))?,
            None => told.set_item("shape", (rows,))?,
        }
        // The second says that nothing is to be written there.
        told.set_item("data", (address, true))?;
        Ok(told)
    }
}

/// An array of numpy over these numbers.
pub(crate) fn array(py: Python<'_>, numbers: Numbers) -> PyResult<Py<PyAny>> {
    Ok(py.import("numpy")?.call_method1("asarray", (Memory(numbers),))?.unbind())
}

/// The surface in two arrays of three columns each.
pub(crate) fn mesh(points: &Bound<'_, PyAny>, triangles: &Bound<'_, PyAny>) -> PyResult<TriMesh> {
    let numpy = points.py().import("numpy")?;
    let triangles = numpy.call_method1("asarray", (triangles,))?;
    let kind: String = triangles.getattr("dtype")?.getattr("kind")?.extract()?;
    if !matches!(kind.as_str(), "i" | "u") {
        return Err(PyTypeError::new_err("triangles are numbers of points: an array of integers"));
    }
    let positions: Vec<Vec3> = rows(&numpy, points, "float32", "points")?;
    let corners: Vec<[i64; 3]> = rows(&numpy, &triangles, "int64", "triangles")?;
    let index = |corner: i64| u32::try_from(corner).ok().filter(|&corner| (corner as usize) < positions.len());
    let mut found = Vec::with_capacity(corners.len());
    for (row, &[a, b, c]) in corners.iter().enumerate() {
        let [Some(a), Some(b), Some(c)] = [a, b, c].map(index) else {
            let count = positions.len();
            let text = format!("triangle {row} is ({a}, {b}, {c}), and there are {count} points, numbered from 0");
            return Err(PyValueError::new_err(text));
        };
        found.push([a, b, c]);
    }
    Ok(TriMesh { positions, triangles: found })
}

/// The rows of an array as `kind`, three numbers each.
fn rows<T: bytemuck::Pod>(
    numpy: &Bound<'_, PyModule>,
    array: &Bound<'_, PyAny>,
    kind: &str,
    name: &str,
) -> PyResult<Vec<T>> {
    let array = numpy.call_method1("asarray", (array, kind))?;
    let shape: Vec<usize> = array.getattr("shape")?.extract()?;
    let [_, 3] = shape[..] else {
        return Err(PyValueError::new_err(format!("{name} have three columns, and the shape is {shape:?}")));
    };
    let bytes = array.call_method0("tobytes")?;
    Ok(bytemuck::pod_collect_to_vec(bytes.cast::<PyBytes>()?.as_bytes()))
}
