//! The formats Lumen writes, and the units a file's numbers can have.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use lumen_language::say;

/// A format that Lumen reads and writes. (It also reads glTF as text, and the flat cells of VTK's unstructured grids.)
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// Stereolithography, written in binary.
    Stl,
    /// Stanford polygon file, written in little-endian binary.
    Ply,
    /// Wavefront object, text.
    Obj,
    /// VTK's XML format for polygonal data, written in compressed binary.
    Vtp,
    /// VTK's legacy format, written in binary.
    Vtk,
    /// Binary glTF 2.0.
    Glb,
}

impl Format {
    /// All formats, in the order in which menus show them.
    pub const ALL: [Self; 6] = [Self::Stl, Self::Ply, Self::Obj, Self::Vtp, Self::Vtk, Self::Glb];

    /// The extensions of all files that can be opened, those of formats that are not written included.
    pub const OPENED: [&str; 8] = ["stl", "ply", "obj", "vtp", "vtu", "vtk", "glb", "gltf"];

    /// The format of an extension such as `stl` or `.STL`.
    pub fn from_extension(extension: &str) -> Option<Self> {
        let extension = extension.strip_prefix('.').unwrap_or(extension);
        Self::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
    }

    /// The format of a file name, by its extension.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::from_extension(name.rsplit_once('.')?.1)
    }

    /// The extension, without a dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Stl => "stl",
            Self::Ply => "ply",
            Self::Obj => "obj",
            Self::Vtp => "vtp",
            Self::Vtk => "vtk",
            Self::Glb => "glb",
        }
    }

    /// The unit of length of what Lumen writes in it: millimetres, but for glTF, which has metres.
    pub fn unit(self) -> Unit {
        if self == Self::Glb { Unit::Metre } else { Unit::Millimetre }
    }

    /// What people call it.
    pub fn label(self) -> &'static str {
        match self {
            Self::Stl => "STL",
            Self::Ply => "PLY",
            Self::Obj => "OBJ",
            Self::Vtp => "VTP",
            Self::Vtk => "VTK",
            Self::Glb => "GLB",
        }
    }
}

/// A unit of length that the numbers in a file may have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Unit {
    /// mm, what Lumen works in.
    #[serde(rename = "mm")]
    Millimetre,
    /// cm, ten mm.
    #[serde(rename = "cm")]
    Centimetre,
    /// m, a thousand mm.
    #[serde(rename = "m")]
    Metre,
}

impl Unit {
    /// All units, smallest first.
    pub const ALL: [Self; 3] = [Self::Millimetre, Self::Centimetre, Self::Metre];

    /// Millimetres in one of this unit.
    pub fn to_mm(self) -> f64 {
        match self {
            Self::Millimetre => 1.0,
            Self::Centimetre => 10.0,
            Self::Metre => 1000.0,
        }
    }

    /// The unit's symbol: `mm`, `cm` or `m`.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Centimetre => "cm",
            Self::Metre => "m",
        }
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

/// A word that names no unit.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}", say!("errors-unknown-unit", word = .0))]
pub struct UnknownUnit(pub String);

impl FromStr for Unit {
    type Err = UnknownUnit;

    fn from_str(word: &str) -> Result<Self, Self::Err> {
        Self::ALL.into_iter().find(|unit| unit.symbol() == word).ok_or_else(|| UnknownUnit(word.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_words_find_their_format_and_unit() {
        assert_eq!(Format::from_name("left.leg.STL"), Some(Format::Stl));
        assert_eq!(Format::from_extension(".glb"), Some(Format::Glb));
        assert_eq!(Format::from_name("surface.gltf"), None, "glTF as text is read, not written");
        assert_eq!(Format::from_name("stl"), None);
        assert!(Format::ALL.iter().all(|format| Format::OPENED.contains(&format.extension())));
        assert_eq!("cm".parse(), Ok(Unit::Centimetre));
        assert_eq!("inch".parse::<Unit>(), Err(UnknownUnit("inch".to_owned())));
        assert_eq!(serde_json::to_string(&Unit::Metre).unwrap(), "\"m\"");
    }
}
