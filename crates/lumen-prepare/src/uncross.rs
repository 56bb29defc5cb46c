//! Triangles that run into others are moved apart or made anew, and nothing else is touched.
//!
//! Triangles that cross (`lumen_mesh::self_intersections`) or are folded onto a neighbour (`folds`) are gathered into places: those that share a vertex or cross each
//! other, and those between them that lie on the wrong side of the other wall (`clusters`). At each place the gentle way is
//! tried first (`apart`): the place's vertices and two rings around it move, along their normals or to the mean of their
//! neighbours, until nothing crosses, while the wall leaves its place by no more than [`SHALLOW`] of the local radius. Where
//! that does not do, the triangles of the place and a ring around them, or two, are cut out and each hole is filled as
//! `lumen_mesh::mending::fill` does (`recut`). What worked stays; what did not is tried again with more room, in [`ROUNDS`]
//! rounds at most; from the third on its vertices may move on their way to a membrane, by [`DEEP`] of the local radius at
//! most.
//!
//! Where edges have more than two triangles, little can be done: `lumen_mesh::mending::split` comes first. Rims that touch by
//! rounding are for `lumen_mesh::mending::weld`.
//!
//! Vertices farther than two rings from what crosses in a round keep their bits. A place whose hole opens into the end of a
//! vessel, or cannot be closed without crossing, stays as it was and is told as [`Remedy::Failed`]. So does one by which a
//! whole piece of the surface would be gone. Where more than half of all triangles cross, there is no wall to mend by: all
//! stays.

mod apart;
mod clusters;
mod membrane;
mod recut;

use lumen_mesh::task::{Yielder, at_once};
use lumen_mesh::{Bounds, SurfaceIndex, Topology, TriMesh, compacted};

use crate::ends::{SurfaceError, check_surface};
use crate::folds::clashing;

use clusters::clusters;

/// The part of the local radius by which a wall may leave its place on the gentle way.
pub const SHALLOW: f64 = 0.01;
/// The part of the local radius by which a vertex may move on its way to a membrane; where triangles are large, two of their
/// sides.
pub const DEEP: f64 = 0.5;
/// Rounds at most.
pub const ROUNDS: usize = 4;

/// How a place was mended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// Vertices moved, triangles stayed.
    PushedApart,
    /// Triangles were cut out and the holes filled.
    Recut,
    /// Nothing helped: it is as it was.
    Failed,
}

/// A place where triangles crossed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The mean of its triangles' vertices in mm.
    pub centre: [f64; 3],
    /// Triangles that crossed there or lay on the wrong side.
    pub faces: usize,
    /// How it was mended.
    pub remedy: Remedy,
    /// How far the wall moved, in mm: of vertices that were moved the longest way; where it was cut, the largest distance of
    /// a vertex that was from the wall that is, or of one that is from the wall that was. 0 where nothing helped.
    pub moved_mm: f64,
}

/// A surface whose crossings were mended as far as they could be.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncrossed {
    /// The surface; vertices and triangles that stayed keep their order, new ones stand behind them.
    pub mesh: TriMesh,
    /// For each triangle the one of before that it is or that is nearest to it along the rim of its hole.
    pub triangle_of: Vec<u32>,
    /// The places, in the order in which they were mended; those that failed last.
    pub places: Vec<Place>,
    /// Triangles that crossed or were folded before.
    pub crossing_before: usize,
    /// Triangles that cross or are folded now.
    pub crossing_after: usize,
}

/// Moves apart or makes anew what crosses in `mesh`.
///
/// # Errors
/// [`SurfaceError`], but for [`SurfaceError::NoTriangles`].
pub fn uncross(mesh: &TriMesh) -> Result<Uncrossed, SurfaceError> {
    at_once(uncross_in_slices(mesh, &Yielder::never()))
}

/// As [`uncross`], resting between its rounds.
///
/// # Errors
/// As [`uncross`].
pub async fn uncross_in_slices(mesh: &TriMesh, yielder: &Yielder) -> Result<Uncrossed, SurfaceError> {
    // Nothing crosses in a surface without triangles.
    match check_surface(mesh) {
        Ok(()) | Err(SurfaceError::NoTriangles) => {}
        Err(error) => return Err(error),
    }
    let mut crossing = clashing(mesh);
    let mut done = Uncrossed {
        mesh: mesh.clone(),
        triangle_of: (0..mesh.triangles.len() as u32).collect(),
        places: Vec::new(),
        crossing_before: crossing.len(),
        crossing_after: crossing.len(),
    };
    for round in 0..ROUNDS {
        if crossing.is_empty() || 2 * crossing.len() > done.mesh.triangles.len() {
            break;
        }
        yielder.rest(round as f32 / ROUNDS as f32).await;
        let next = mended(&done, &crossing, round);
        let left = clashing(&next.mesh);
        // A round that gains nothing is taken back; the next one cuts wider.
        if left.len() < crossing.len() {
            (done, crossing) = (next, left);
        }
    }
    done.crossing_after = crossing.len();
    // Cuts leave vertices behind, be it those of a filling that was taken back.
    if done.mesh.positions.len() > mesh.positions.len() || done.places.iter().any(|place| place.remedy == Remedy::Recut)
    {
        done.mesh = compacted(&done.mesh.positions, done.mesh.triangles);
    }
    if !crossing.is_empty() {
        let surface = Surface::of(&done.mesh);
        let failed = clusters(&surface, &crossing);
        done.places.extend(failed.iter().map(|cluster| cluster.place(&surface, Remedy::Failed, 0.0)));
    }
    Ok(done)
}

/// One round: what can be pushed apart is, the rest is cut out with a ring around it, later with two. What could not be cut
/// with two may go on its way to a membrane, by [`DEEP`] at most.
fn mended(done: &Uncrossed, crossing: &[u32], round: usize) -> Uncrossed {
    let surface = Surface::of(&done.mesh);
    let clusters = clusters(&surface, crossing);
    let mut next = done.clone();
    let mut pushing = apart::Pushing::new(&surface, &clusters);
    let mut left = Vec::new();
    for (number, cluster) in (0..).zip(&clusters) {
        match pushing.push(number, cluster, round > 1) {
            Some(moved_mm) => next.places.push(cluster.place(&surface, Remedy::PushedApart, moved_mm)),
            None => left.push(cluster),
        }
    }
    next.mesh.positions = pushing.positions;
    recut::recut(&mut next, &surface, &left, if round == 0 { 1 } else { 2 });
    next
}

/// A surface with what is asked of it.
struct Surface<'a> {
    mesh: &'a TriMesh,
    topology: Topology,
    index: SurfaceIndex,
    bounds: Bounds,
}

impl<'a> Surface<'a> {
    fn of(mesh: &'a TriMesh) -> Self {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
        Self { mesh, topology, index, bounds: mesh.bounds() }
    }
}

#[cfg(test)]
mod tests;
