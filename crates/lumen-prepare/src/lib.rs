#![doc = include_str!("../README.md")]

pub mod cap;
pub mod check;
pub mod clip;
pub mod cuts;
pub mod ends;
pub mod extend;
pub mod folds;
pub mod notes;
pub mod prepare;
pub mod remesh;
pub mod uncross;
pub mod wrap;
pub mod write;

use serde::{Deserialize, Serialize};

use lumen_mesh::{TriMesh, triangle_area};

/// What a patch is to a solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PatchKind {
    /// The vessel's wall.
    Wall,
    /// Where blood comes in.
    Inlet,
    /// Where it goes out.
    Outlet,
}

/// A part of a surface with a boundary condition of its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Patch {
    /// The number that it has in files: 1 for the wall, from 2 on for inlets and outlets. It stays whatever is done after.
    pub id: u32,
    /// Its name: letters, digits, `_` and `-` alone.
    pub name: String,
    /// What it is.
    pub kind: PatchKind,
    /// The middle of an inlet or outlet, in mm; 0 for the wall.
    pub centre: [f64; 3],
    /// The unit normal of an inlet or outlet out of the vessel; 0 for the wall.
    pub normal: [f64; 3],
    /// Its area in mm2; of the wall 0 until it is measured.
    pub area_mm2: f64,
}

impl Patch {
    /// The wall.
    pub fn wall() -> Self {
        let (centre, normal) = ([0.0; 3], [0.0; 3]);
        Self { id: 1, name: "wall".to_owned(), kind: PatchKind::Wall, centre, normal, area_mm2: 0.0 }
    }

    /// The radius of a circle of its area, in mm.
    pub fn radius_mm(&self) -> f64 {
        (self.area_mm2 / std::f64::consts::PI).sqrt()
    }
}

/// What the messages of this crate need of a translation.
pub const MESSAGES: &[&[lumen_message::Signature]] =
    &[check::Fault::MESSAGES, notes::Note::MESSAGES, notes::PrepareError::MESSAGES, notes::Reason::MESSAGES];

/// A surface in patches.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Patched {
    /// The surface, in mm, triangles counter-clockwise seen from outside.
    pub mesh: TriMesh,
    /// For each triangle the place of its patch in [`Self::patches`].
    pub of_triangle: Vec<u32>,
    /// The patches, the wall first.
    pub patches: Vec<Patch>,
}

impl Patched {
    /// A surface that is wall alone.
    pub fn wall(mesh: TriMesh) -> Self {
        Self { of_triangle: vec![0; mesh.triangles.len()], mesh, patches: vec![Patch::wall()] }
    }

    /// The area of the triangles of each patch, in mm2.
    ///
    /// # Panics
    /// When a triangle names a vertex or a patch that is not there.
    pub fn areas_mm2(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.patches.len()];
        for (t, &patch) in self.of_triangle.iter().enumerate() {
            areas[patch as usize] += triangle_area(self.mesh.corners(t));
        }
        areas
    }
}
