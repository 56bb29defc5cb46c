//! Coarser levels of one that is shown, for viewers that choose by how large it is on the screen.

use super::normals::{Weighting, vertex_normals};
use super::progressive::ProgressiveMesh;
use super::settings::Target;
use lumen_mesh::{TriMesh, Vec3};

/// The coarsest has at least so many triangles.
const FEWEST: usize = 500;

/// Levels of `levels` with a half, a quarter and so on of these `triangles`, with their normals: as far as the reduction went,
/// and down to some hundreds.
pub fn halved(levels: &ProgressiveMesh, triangles: usize) -> Vec<(TriMesh, Vec<Vec3>)> {
    let counts = std::iter::successors(Some(triangles / 2), |count| Some(count / 2));
    let wanted = counts.take_while(|&count| count >= FEWEST).map(|count| levels.level(Target::Triangles(count as u32)));
    let made = wanted.take_while(|level| level.shortfall.is_none()).map(|level| {
        let mesh = levels.extract(&level.triangles);
        let normals = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
        (mesh, normals)
    });
    made.collect()
}
