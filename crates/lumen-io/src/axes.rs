//! Which way the patient lies in a surface's coordinates, as far as its file says.
//!
//! None of the formats has a place for it. 3D Slicer writes `SPACE=LPS` or `SPACE=RAS` into the header of an STL file, the
//! comments of PLY and OBJ and the title of a legacy VTK file, and the letters alone into a string `SPACE` of the field
//! data of VTP (`vtk/`); glTF says which way is up (y, which is read as z: `gltf/`), but not that a patient stands
//! upright in it. Everywhere else nothing is known, and nothing is asserted. What is known is written as Slicer writes it
//! (`vtkMRMLModelStorageNode`): the same words in the same places.

use lumen_message::messages;
use serde::{Deserialize, Serialize};

use lumen_mesh::{Array, TriMesh, Vec3};

messages! {
    /// What the coordinates grow towards.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    #[serde(rename_all = "lowercase")]
    pub enum Axes {
        /// Left, posterior, superior: as DICOM has it.
        "errors-axes-lps" Lps => "LPS",
        /// Right, anterior, superior.
        "errors-axes-ras" Ras => "RAS",
        /// Nothing is said.
        #[default]
        "errors-axes-unknown" Unknown => "unknown axes",
    }
}

messages! {
    /// Why a surface was not turned.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TurnError {
        /// Axes are asked for where those of the surface are not known, or the other way round.
        "errors-axes" UnknownAxes {
            /// Those of the surface.
            from: Axes,
            /// Those that were asked for.
            to: Axes,
        } => "Which way the axes of the surface point is not known, so it cannot be turned from {from} to {to}.",
    }
}

impl Axes {
    /// Turns a surface from these axes to `to`: from LPS to RAS, or back, is half a turn about the third axis, which
    /// leaves the outside out. Normals and vectors turn along: arrays of three components of floats but for colours
    /// (`RGB`, `COLOR_0`).
    ///
    /// # Errors
    /// When one of the two is not known and they are not the same; nothing is turned then.
    pub fn turn(
        self,
        to: Self,
        mesh: &mut TriMesh,
        normals: &mut [Vec3],
        arrays: &mut [Array],
    ) -> Result<(), TurnError> {
        if self == to {
            return Ok(());
        }
        if self == Self::Unknown || to == Self::Unknown {
            return Err(TurnError::UnknownAxes { from: self, to });
        }
        // Not to minus zero.
        let turned = |p: Vec3| Vec3::new(0.0 - p.x, 0.0 - p.y, p.z);
        mesh.positions.iter_mut().chain(normals).for_each(|p| *p = turned(*p));
        for array in arrays {
            if let Some(flips) = flips(array) {
                array.values = array.values.mapped(|i, x| if flips[i % flips.len()] { 0.0 - x } else { x });
            }
        }
        Ok(())
    }

    /// A letter for each axis: the patient's sides (H for the head), or the names of the axes.
    pub fn letters(self) -> [&'static str; 3] {
        match self {
            Self::Lps => ["L", "P", "H"],
            Self::Ras => ["R", "A", "H"],
            Self::Unknown => ["X", "Y", "Z"],
        }
    }

    /// What a header or comment says of them, behind what else stands there; nothing where they are not known.
    pub(super) fn said(self) -> &'static str {
        match self {
            Self::Lps => "; SPACE=LPS",
            Self::Ras => "; SPACE=RAS",
            Self::Unknown => "",
        }
    }
}

/// Whether an array has a direction at each place, which turns with the surface.
pub fn has_directions(array: &Array) -> bool {
    flips(array).is_some()
}

/// Which components change their sign where an array has a direction at each place: a vector, a tensor by rows, or a
/// symmetric one in VTK's order (XX, YY, ZZ, XY, YZ, XZ).
fn flips(array: &Array) -> Option<&'static [bool]> {
    let is_colour = array.name.starts_with("RGB") || array.name.starts_with("COLOR_");
    if array.values.scalar().is_whole() || is_colour {
        return None;
    }
    match array.components {
        3 => Some(&[true, true, false]),
        6 => Some(&[false, false, false, false, true, true]),
        9 => Some(&[false, false, true, false, false, true, true, true, false]),
        _ => None,
    }
}

/// Where a header or comments end at the latest.
const HEADER: usize = 4096;

/// What stands in the text before the numbers of an STL, PLY or OBJ file, or in the title of a VTK file.
pub(super) fn stated(bytes: &[u8]) -> Axes {
    let head = &bytes[..bytes.len().min(HEADER)];
    let holds = |words: &[u8]| head.windows(words.len()).any(|part| part == words);
    match (holds(b"SPACE=LPS"), holds(b"SPACE=RAS")) {
        (true, false) => Axes::Lps,
        (false, true) => Axes::Ras,
        _ => Axes::Unknown,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Format, ImportOptions, Output, import_mesh, read, write, write_output};
    use lumen_mesh::arrays::{Association, Values};
    use lumen_mesh::shapes::icosphere;

    #[test]
    fn a_surface_is_turned_about_the_third_axis_with_its_vectors() {
        let mut mesh =
            TriMesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 2.0, 3.0)], triangles: vec![[0, 1, 2]] };
        let before = mesh.clone();
        let mut normals = vec![Vec3::X; 3];
        let array = |name: &str| {
            Array::new(name, Association::Point, 3, Values::from_floats(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]))
        };
        let mut arrays = [array("Flow"), array("RGB")];
        Axes::Lps.turn(Axes::Ras, &mut mesh, &mut normals, &mut arrays).unwrap();
        assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::NEG_X, Vec3::new(-1.0, -2.0, 3.0)]);
        assert!(mesh.positions[0].x.is_sign_positive());
        assert_eq!((mesh.triangles[0], normals[2]), ([0, 1, 2], Vec3::NEG_X));
        let numbers: Vec<f64> = (0..9).map(|i| arrays[0].values.get(i)).collect();
        assert_eq!(numbers, [0.0, -1.0, 2.0, -3.0, -4.0, 5.0, -6.0, -7.0, 8.0]);
        assert_eq!(arrays[1], array("RGB"));
        let error = Axes::Unknown.turn(Axes::Lps, &mut mesh, &mut normals, &mut arrays).unwrap_err();
        assert_eq!(
            error.to_string(),
            "Which way the axes of the surface point is not known, so it cannot be turned from unknown axes to LPS."
        );
        Axes::Ras.turn(Axes::Lps, &mut mesh, &mut normals, &mut arrays).unwrap();
        assert_eq!(mesh, before);
        assert_eq!(Axes::Unknown.turn(Axes::Unknown, &mut mesh, &mut [], &mut []), Ok(()));
    }

    #[test]
    fn tensors_are_turned_as_their_definition_has_it() {
        let mut mesh = TriMesh { positions: vec![Vec3::ZERO], triangles: Vec::new() };
        // T' = R T R^t, with R half a turn about z.
        let half_turn = glam::DMat3::from_diagonal(glam::DVec3::new(-1.0, -1.0, 1.0));
        let rows: Vec<f64> = (1..10).map(f64::from).collect();
        let tensor = glam::DMat3::from_cols_slice(&rows).transpose();
        let turned = half_turn * tensor * half_turn.transpose();
        let symmetric = [[0, 0], [1, 1], [2, 2], [0, 1], [1, 2], [0, 2]];
        let six: Vec<f64> = symmetric.iter().map(|&[r, c]| tensor.row(r)[c]).collect();
        let array = |values: &[f64]| {
            let floats: Vec<f32> = values.iter().map(|&x| x as f32).collect();
            Array::new("Stress", Association::Point, values.len(), Values::from_floats(&floats))
        };
        let mut arrays = [array(&rows), array(&six)];
        Axes::Lps.turn(Axes::Ras, &mut mesh, &mut [], &mut arrays).unwrap();
        let numbers = |array: &Array| (0..array.components).map(|i| array.values.get(i)).collect::<Vec<_>>();
        assert_eq!(numbers(&arrays[0]), turned.transpose().to_cols_array());
        let expected: Vec<f64> = symmetric.iter().map(|&[r, c]| turned.row(r)[c]).collect();
        assert_eq!(numbers(&arrays[1]), expected);
    }

    #[test]
    fn axes_are_said_where_the_format_has_a_place_and_read_back() {
        let sphere = icosphere(1, 30.0, Vec3::ZERO);
        for axes in [Axes::Lps, Axes::Ras, Axes::Unknown] {
            for format in Format::ALL {
                let bytes = write_output(&Output { axes, ..Output::new(&sphere) }, format).unwrap();
                let found = read(&bytes, format.extension(), &ImportOptions::default()).unwrap().report.axes;
                // glTF has none.
                assert_eq!(found, if format == Format::Glb { Axes::Unknown } else { axes }, "{format:?}");
            }
        }
    }

    #[test]
    fn axes_are_those_that_the_file_states_and_no_others() {
        let sphere = icosphere(1, 30.0, lumen_mesh::Vec3::ZERO);
        for format in Format::ALL {
            let bytes = write(&sphere, None, format).unwrap();
            let axes = |bytes: &[u8]| read(bytes, format.extension(), &ImportOptions::default()).unwrap().report.axes;
            assert_eq!(axes(&bytes), Axes::Unknown, "{format:?}");
            for (words, expected) in [("SPACE=LPS", Axes::Lps), ("SPACE=RAS", Axes::Ras)] {
                let words = format!("3D Slicer output. {words}");
                let mut stated = bytes.clone();
                match format {
                    Format::Stl => stated[..words.len()].copy_from_slice(words.as_bytes()),
                    Format::Ply => {
                        let at = bytes.windows(8).position(|part| part == b"element ").unwrap();
                        stated.splice(at..at, format!("comment {words}\n").into_bytes());
                    }
                    Format::Vtk => {
                        let at = bytes.windows(7).position(|part| part == b"Surface").unwrap();
                        stated.splice(at..at, words.into_bytes());
                    }
                    Format::Vtp => {
                        let letters = if expected == Axes::Lps { "76 80 83 0" } else { "82 65 83 0" };
                        let at = bytes.windows(7).position(|part| part == b"<Piece ").unwrap();
                        let array = format!(
                            "<FieldData><Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">\n\
                             {letters}\n</Array></FieldData>"
                        );
                        stated.splice(at..at, array.into_bytes());
                    }
                    Format::Obj => drop(stated.splice(..0, format!("# {words}\n").into_bytes())),
                    Format::Glb => continue,
                }
                assert_eq!(axes(&stated), expected, "{format:?}");
            }
        }
        assert_eq!(import_mesh(sphere, "made").report.axes, Axes::Lps);
    }
}
