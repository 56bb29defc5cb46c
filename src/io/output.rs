//! A surface on its way into a file, with what is written beside it, and which format has a place for what.

use super::{Axes, Format};
use crate::mesh::arrays::On;
use crate::mesh::{Array, TriMesh, Vec3};

/// What is written.
#[derive(Clone, Copy, Debug)]
pub struct Output<'a> {
    /// The surface, in mm.
    pub mesh: &'a TriMesh,
    /// Unit vectors, one a vertex. STL has no place for them and writes each facet's own.
    pub normals: Option<&'a [Vec3]>,
    /// A tuple for each vertex or triangle. Those that the format has no place for are not written: [`left_out`].
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

    /// The arrays that the format has a place for.
    pub(super) fn arrays_in(&self, format: Format) -> impl Iterator<Item = &'a Array> {
        self.arrays.iter().filter(move |array| has_place(format, array))
    }
}

/// Whether `format` has a place for an array.
fn has_place(format: Format, array: &Array) -> bool {
    match format {
        Format::Vtp | Format::Vtk | Format::Ply => true,
        Format::Glb => super::gltf_arrays::has_place(array),
        Format::Obj => super::obj::is_colour(array),
        Format::Stl => false,
    }
}

/// A sentence about the arrays that a file of `format` does not hold, if there are any.
pub fn left_out(arrays: &[Array], format: Format) -> Option<String> {
    let names: Vec<&str> =
        arrays.iter().filter(|array| !has_place(format, array)).map(|array| array.name.as_str()).collect();
    let of_triangles = arrays.iter().filter(|array| !has_place(format, array)).all(|array| array.on == On::Triangle);
    let what = match format {
        Format::Glb if of_triangles => "arrays of triangles",
        Format::Obj => "arrays other than colours",
        Format::Stl => "arrays",
        _ => "such arrays",
    };
    let verb = if names.len() == 1 { "is" } else { "are" };
    let format = format.label();
    (!names.is_empty()).then(|| format!("{format} has no place for {what}: {} {verb} left out.", names.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::arrays::{Scalar, Values};

    #[test]
    fn what_a_format_leaves_out_is_one_sentence() {
        let zeros = |scalar| Values::from_bytes(scalar, vec![0; 96]);
        let height = Array::new("Height", On::Point, 1, zeros(Scalar::F32));
        let face = Array::new("Face", On::Triangle, 1, zeros(Scalar::I32));
        let colour = Array::new("RGB", On::Point, 3, zeros(Scalar::F32));
        let tensor = Array::new("Stress", On::Point, 9, zeros(Scalar::F64));
        let all = [height, face, colour, tensor];
        for format in [Format::Vtp, Format::Vtk, Format::Ply] {
            assert_eq!(left_out(&all, format), None);
        }
        let said = |arrays: &[Array], format| left_out(arrays, format).unwrap();
        assert_eq!(said(&all, Format::Stl), "STL has no place for arrays: Height, Face, RGB, Stress are left out.");
        assert_eq!(
            said(&all[..3], Format::Obj),
            "OBJ has no place for arrays other than colours: Height, Face are left out."
        );
        assert_eq!(said(&all[..3], Format::Glb), "GLB has no place for arrays of triangles: Face is left out.");
        assert_eq!(said(&all, Format::Glb), "GLB has no place for such arrays: Face, Stress are left out.");
    }
}
