//! A surface on its way into a file, with what is written beside it.

use super::Axes;
use super::error::WriteError;
use lumen_mesh::arrays::Association;
use lumen_mesh::{Array, TriMesh, Vec3};

/// What is written.
#[derive(Clone, Copy, Debug)]
pub struct Output<'a> {
    /// The surface, in mm.
    pub mesh: &'a TriMesh,
    /// Unit vectors, one a vertex. STL has no place for them and writes each facet's own.
    pub normals: Option<&'a [Vec3]>,
    /// A tuple for each vertex or triangle. Those that the format has no place for are not written: [`left_out`](super::left_out).
    pub arrays: &'a [Array],
    /// What the coordinates grow towards: said as 3D Slicer says it, where the format has a place for it; unknown is not
    /// said.
    pub axes: Axes,
}

impl<'a> Output<'a> {
    /// The surface alone.
    pub fn new(mesh: &'a TriMesh) -> Self {
        Self { mesh, normals: None, arrays: &[], axes: Axes::Unknown }
    }

    /// Refuses what no format can hold.
    pub(super) fn check(&self) -> Result<(), WriteError> {
        let Self { mesh, normals, arrays, .. } = *self;
        let vertices = mesh.positions.len();
        if mesh.triangles.is_empty() {
            return Err(WriteError::Empty);
        }
        for (triangle, corners) in mesh.triangles.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|&&v| v as usize >= vertices) {
                return Err(WriteError::IndexOutOfRange { triangle, index, vertices });
            }
        }
        if let Some(vertex) = mesh.positions.iter().position(|p| !p.is_finite()) {
            return Err(WriteError::NotFinite { vertex });
        }
        for array in arrays {
            let rows = if array.on == Association::Point { vertices } else { mesh.triangles.len() };
            if array.values.len() != rows * array.components {
                return Err(WriteError::ArrayLength { name: array.name.clone(), tuples: array.len(), rows });
            }
        }
        if let Some(normals) = normals {
            if normals.len() != vertices {
                return Err(WriteError::NormalCount { normals: normals.len(), vertices });
            }
            if let Some(vertex) = normals.iter().position(|n| !n.is_finite()) {
                return Err(WriteError::NotFinite { vertex });
            }
        }
        Ok(())
    }
}
