//! Which way the patient lies in a surface's coordinates, as far as its file says.
//!
//! None of the formats has a place for it. 3D Slicer writes `SPACE=LPS` or `SPACE=RAS` into the header of an STL file, the
//! comments of PLY and OBJ and the title of a legacy VTK file, and the letters alone into a string `SPACE` of the field
//! data of VTP (`vtk/xml.rs`); glTF says which way is up (y, which is read as z: `gltf.rs`), but not that a patient stands
//! upright in it. Everywhere else nothing is known, and nothing is asserted.

use serde::{Deserialize, Serialize};

/// What the coordinates grow towards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axes {
    /// Left, posterior, superior: as DICOM has it.
    Lps,
    /// Right, anterior, superior.
    Ras,
    /// Nothing is said.
    #[default]
    Unknown,
}

impl Axes {
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
    use crate::io::{Format, ImportOptions, import_mesh, read, write};
    use crate::mesh::shapes::icosphere;

    #[test]
    fn axes_are_those_that_the_file_states_and_no_others() {
        let sphere = icosphere(1, 30.0, crate::mesh::Vec3::ZERO);
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
