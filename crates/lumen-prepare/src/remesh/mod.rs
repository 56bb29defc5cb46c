//! Isotropic remeshing: triangles that are nearly equilateral, with edges as long as the calibre or the curvature of
//! the vessel asks for.
//!
//! The method is that of Botsch and Kobbelt, "A remeshing approach to multiresolution modeling" (2004): split,
//! collapse, flip, relax and project, in several rounds (`steps.rs`), with a length that differs from place to place
//! (`sizing.rs`). Rims, borders between patches and creases are feature curves (`features.rs`). Their vertices move
//! along them alone, and a corner, where curves meet or turn sharply, stays. Small angles that are left are widened one
//! by one (`clean.rs`). Where faces run into others that did not before, or the surfaces are farther apart than the
//! bound, the wanted length is reduced and the steps run again.
//!
//! A vertex at rest is left alone until something around it changes, and the rounds end where little does. A vertex that
//! moves finds its place by walking from its last one (`walk.rs`), with the triangles around it looked at four at a time
//! (`ring.rs`).
//!
//! Limits. Vertices lie on the surface that enters, so edges cut the vessel's corners: a tube gets 1.7 % narrower with
//! 12 edges around, and 0.4 % with 24. A vessel thinner than the least length keeps its topology, but not its shape.
//! Crossings that are left are listed in [`Remeshed::crossing`].

mod clean;
mod features;
mod measure;
mod net;
mod ring;
mod sizing;
mod steps;
#[cfg(test)]
mod tests;
mod trace;
mod triangle;
mod walk;

use std::sync::OnceLock;

use lumen_mesh::task::{Yielder, at_once};
use lumen_mesh::{Blend, Topology, TriMesh, Vec3, triangle_area};
use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use self::measure::{Deviation, Quality};

use self::measure::samples;
use self::net::{CORNER, NONE, Net, Unsound};
use self::steps::Original;
use self::trace::{Numbered, Trace, numbered};
use self::triangle::doubled;
use self::walk::Walk;
use super::Patched;
use crate::folds::{clashing_in, clashing_of};

/// Rounds of the steps, at most.
const ROUNDS: usize = 9;
/// A round that changes fewer triangles than this part of all is the last one.
const FEW: usize = 25;
/// The first rounds, in which a collapse may make edges that are split again: so even a grid of long triangles gets
/// another pattern.
const COARSE_ROUNDS: usize = 2;
/// Rounds of relaxation and flips for the angles after those.
const LAST_ROUNDS: usize = 2;
/// Rounds of the steps after wanted lengths were reduced.
const REPAIR_ROUNDS: usize = 3;
/// How often lengths are reduced at crossings, or beyond the bound on the deviation.
const REPAIRS: usize = 4;
/// Old triangles are looked at one by one for crossings that were there, where they are fewer than this part of all.
const FEW_CROSSED: usize = 16;
/// By what wanted lengths are multiplied there.
const REDUCTION: f64 = 0.7;
/// The largest coordinate, in mm: products of four fit into an f32.
const FARTHEST_MM: f32 = 1e9;
/// The most triangles that are made.
const MOST: usize = 20_000_000;

/// How large triangles should be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sizing {
    /// Edges around the circumference of the vessel, 3 or more: an edge is `2 pi r / around` long where the radius is
    /// `r`.
    pub around: f64,
    /// Least edge length in mm, above 0. It wins over every other wish.
    pub least_mm: f64,
    /// Largest edge length in mm, at least the least one.
    pub largest_mm: f64,
    /// By what the length of an edge may grow from triangle to triangle, above 1: along the surface it grows by half of
    /// `growth - 1` mm a mm at most.
    pub growth: f64,
    /// Where set, edges are also short enough for the new surface to lie within this of the one that enters, by its
    /// curvature; in mm. [`Remeshed::deviation`] says how far it does.
    pub max_deviation_mm: Option<f64>,
}

impl Default for Sizing {
    fn default() -> Self {
        Self { around: 12.0, least_mm: 0.1, largest_mm: 5.0, growth: 1.3, max_deviation_mm: None }
    }
}

impl Sizing {
    /// Refuses lengths that make no sense.
    ///
    /// # Errors
    /// [`RemeshError::Sizing`].
    pub fn check(&self) -> Result<(), RemeshError> {
        let Self { around, least_mm, largest_mm, growth, max_deviation_mm } = *self;
        let is_right = [
            (around.is_finite() && around >= 3.0, "there should be 3 edges around or more"),
            (least_mm.is_finite() && least_mm > 1e-6, "the least length should be above 0"),
            (largest_mm.is_finite() && largest_mm >= least_mm, "the largest length should be at least the least one"),
            (growth.is_finite() && growth > 1.0, "the growth should be above 1"),
            (max_deviation_mm.is_none_or(|d| d.is_finite() && d > 0.0), "the deviation should be above 0 mm"),
        ];
        is_right.into_iter().find(|(right, _)| !right).map_or(Ok(()), |(_, why)| Err(RemeshError::Sizing(why)))
    }
}

/// A surface that was remeshed. How far it went, and what each of its parts comes from, is found on request.
#[derive(Clone, Debug)]
pub struct Remeshed {
    /// The new surface, with the patches of the old one. Areas of patches are as they were.
    pub surface: Patched,
    /// The new triangles that run into others or are folded onto a neighbour, ascending.
    pub crossing: Vec<u32>,
    /// Chains of rim, patch border and crease that were kept.
    pub curves: usize,
    /// Vertices that were kept in their place, because such chains meet or turn there.
    pub corners: usize,
    trace: Trace,
}

impl Remeshed {
    /// How well the triangles are shaped.
    pub fn quality(&self) -> Quality {
        Quality::of(&self.surface.mesh)
    }

    /// How far the new and the old surface are apart.
    pub fn deviation(&self) -> Deviation {
        self.trace.deviation()
    }

    /// For each new triangle the triangle of the old surface that is nearest to its middle, on the same wall and in the same
    /// patch.
    pub fn triangle_sources(&self) -> Vec<u32> {
        self.trace.of_triangles()
    }

    /// For each new vertex the old vertices that it lies between, by barycentric weights.
    pub fn vertex_sources(&self) -> Blend {
        self.trace.of_vertices()
    }
}

/// Why a surface cannot be remeshed.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RemeshError {
    /// There is nothing to remesh.
    #[error("the surface has no triangles")]
    Empty,
    /// A list has not an entry for each vertex or triangle.
    #[error("{list} has {found} entries, and {expected} are needed")]
    Length {
        /// What the list holds.
        list: &'static str,
        /// Entries that it has.
        found: usize,
        /// Entries that it should have.
        expected: usize,
    },
    /// A triangle names a vertex, or a patch, that is not there.
    #[error("triangle {triangle} names {what} {index}, and there are {count}")]
    Index {
        /// The triangle.
        triangle: usize,
        /// `vertex` or `patch`.
        what: &'static str,
        /// What it names.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// A coordinate is not a number, or beyond 1e9 mm.
    #[error("vertex {vertex} has a coordinate that is not a number or beyond 1e9 mm")]
    OutOfRange {
        /// The vertex.
        vertex: usize,
    },
    /// A radius is negative or not a number.
    #[error("the radius at vertex {vertex} is {radius} mm, and it should be 0 or more")]
    Radius {
        /// The vertex.
        vertex: usize,
        /// Its radius in mm.
        radius: f32,
    },
    /// Edges have more than two triangles.
    #[error("{edges} edges have more than two triangles; the surface should be mended first")]
    NonManifold {
        /// How many.
        edges: usize,
    },
    /// Two triangles run an edge the same way.
    #[error("the triangles at {edges} edges face opposite ways; the surface should be mended first")]
    Flipped {
        /// At how many edges.
        edges: usize,
    },
    /// The wanted lengths make no sense.
    #[error("the sizing does not hold: {0}")]
    Sizing(&'static str),
    /// The wanted lengths ask for too many triangles.
    #[error("edges of this length make about {about} triangles, and at most {most} are made")]
    TooMany {
        /// How many there would be.
        about: u64,
        /// How many there may be.
        most: usize,
    },
}

/// Remeshes a surface. `radii` has the radius of the vessel in mm at each vertex, infinite where it is not known; there
/// lengths grow from where it is. Triangles that repeat a vertex are left out.
///
/// # Errors
/// Where a list has the wrong length, an index is out of range, a number is not finite or too large, an edge has more
/// than two triangles, windings disagree, the sizing does not hold, or asks for more than 20 million triangles.
pub fn remesh(surface: &Patched, radii: &[f32], sizing: &Sizing) -> Result<Remeshed, RemeshError> {
    at_once(remesh_in_slices(surface, radii, sizing, &Yielder::never()))
}

/// As [`remesh`], resting between its steps.
///
/// # Errors
/// As [`remesh`].
pub async fn remesh_in_slices(
    surface: &Patched,
    radii: &[f32],
    sizing: &Sizing,
    yielder: &Yielder,
) -> Result<Remeshed, RemeshError> {
    let (found, were_crowded) = remeshed(surface, radii, sizing, false, &yielder.part(0.0..0.9)).await?;
    if found.crossing.is_empty() || !were_crowded {
        return Ok(found);
    }
    // Walls so near that creases between them have no room may cross without them.
    let (other, _) = remeshed(surface, radii, sizing, true, &yielder.part(0.9..1.0)).await?;
    Ok(if other.crossing.len() < found.crossing.len() { other } else { found })
}

/// The surface, remeshed, and whether creases without room were dropped, which it does unless it `keeps_crowded` ones.
async fn remeshed(
    surface: &Patched,
    radii: &[f32],
    sizing: &Sizing,
    keeps_crowded: bool,
    yielder: &Yielder,
) -> Result<(Remeshed, bool), RemeshError> {
    sizing.check()?;
    let kept = check(surface, radii)?;
    let mesh = &surface.mesh;
    let triangles: Vec<[u32; 3]> = kept.iter().map(|&t| mesh.triangles[t as usize]).collect();
    let patch: Vec<u32> = kept.iter().map(|&t| surface.of_triangle[t as usize]).collect();
    let mut net = Net::new(&mesh.positions, &triangles, patch.clone()).map_err(unsound)?;

    let of_first = |values: &[f32]| net.first.iter().map(|&v| values[v as usize]).collect::<Vec<f32>>();
    let mut lengths = sizing::by_radius(&of_first(radii), sizing);
    net.size = lengths.iter().map(|&length| length.min(sizing.largest_mm) as f32).collect();
    let triangles: Vec<[u32; 3]> = net.origin.as_chunks::<3>().0.to_vec();
    let walk = Walk::on(&net, triangles.len(), |t| t);
    let curves = features::find(&mut net, &walk, keeps_crowded);
    if let Some(deviation) = sizing.max_deviation_mm {
        sizing::bound_deviation(&net, deviation, sizing, &mut lengths);
    }
    sizing::grade(&net, sizing, &mut lengths);
    check_count(&net, &triangles, &lengths)?;
    net.size = lengths.iter().map(|&length| length as f32).collect();
    let first = net.clone();
    let normals = triangles.iter().map(|t| doubled(t.map(|v| net.at[v as usize]))).collect();
    let (lengths_now, index) = (net.size.clone(), OnceLock::new());
    let mut original = Original { first, triangles, normals, patch, index, walk, curves, lengths: lengths_now };

    run(&mut net, &original, ROUNDS, COARSE_ROUNDS, &yielder.part(0.1..0.8)).await;
    let mut new = numbered(&net);
    let mut crossing = new.clashing();
    for _ in 0..REPAIRS {
        let mut coarse = where_crossed(&crossing, &new.mesh, &original);
        if let Some(bound) = sizing.max_deviation_mm {
            coarse.extend(where_far(bound, &new, &original));
        }
        if !reduce(&coarse, &original, sizing, &mut lengths) {
            break;
        }
        sizing::grade(&original.first, sizing, &mut lengths);
        if check_count(&original.first, &original.triangles, &lengths).is_err() {
            break;
        }
        original.lengths = lengths.iter().map(|&length| length as f32).collect();
        resize(&mut net, &original);
        run(&mut net, &original, REPAIR_ROUNDS, 0, &yielder.part(0.8..0.9)).await;
        new = numbered(&net);
        crossing = new.clashing();
    }
    yielder.rest(0.9).await;
    let were_crowded = original.curves.were_crowded;
    let of_triangle = new.triangles.iter().map(|&t| net.patch[t as usize]).collect();
    let mesh = std::mem::take(&mut new.mesh);
    let found = Remeshed {
        surface: Patched { mesh, of_triangle, patches: surface.patches.clone() },
        crossing,
        curves: original.curves.count(),
        corners: original.first.kind.iter().filter(|&&kind| kind == CORNER).count(),
        trace: Trace { kept, original, net, new },
    };
    Ok((found, were_crowded))
}

/// The triangles that have three vertices.
fn check(surface: &Patched, radii: &[f32]) -> Result<Vec<u32>, RemeshError> {
    let Patched { mesh, of_triangle, patches } = surface;
    let vertices = mesh.positions.len();
    if radii.len() != vertices {
        return Err(RemeshError::Length { list: "the list of radii", found: radii.len(), expected: vertices });
    }
    if of_triangle.len() != mesh.triangles.len() {
        let (found, expected) = (of_triangle.len(), mesh.triangles.len());
        return Err(RemeshError::Length { list: "the list of patches", found, expected });
    }
    // False for what is no number.
    let is_within = |p: &Vec3| p.abs().cmple(Vec3::splat(FARTHEST_MM)).all();
    if let Some(vertex) = mesh.positions.iter().position(|p| !is_within(p)) {
        return Err(RemeshError::OutOfRange { vertex });
    }
    if let Some(vertex) = radii.iter().position(|&r| r.is_nan() || r < 0.0) {
        return Err(RemeshError::Radius { vertex, radius: radii[vertex] });
    }
    let mut kept = Vec::with_capacity(mesh.triangles.len());
    for (triangle, (&corners, &patch)) in mesh.triangles.iter().zip(of_triangle).enumerate() {
        if let Some(&index) = corners.iter().find(|&&v| v as usize >= vertices) {
            return Err(RemeshError::Index { triangle, what: "vertex", index, count: vertices });
        }
        if patch as usize >= patches.len() {
            return Err(RemeshError::Index { triangle, what: "patch", index: patch, count: patches.len() });
        }
        let [a, b, c] = corners;
        if a != b && b != c && c != a {
            kept.push(triangle as u32);
        }
    }
    if kept.is_empty() { Err(RemeshError::Empty) } else { Ok(kept) }
}

fn unsound(Unsound { non_manifold, flipped }: Unsound) -> RemeshError {
    if non_manifold > 0 {
        RemeshError::NonManifold { edges: non_manifold }
    } else {
        RemeshError::Flipped { edges: flipped }
    }
}

/// Refuses lengths that ask for more than [`MOST`] triangles.
fn check_count(net: &Net, triangles: &[[u32; 3]], lengths: &[f64]) -> Result<(), RemeshError> {
    let of_triangle = |corners: &[u32; 3]| {
        let length = corners.iter().map(|&v| lengths[v as usize]).sum::<f64>() / 3.0;
        let [a, b, c] = corners.map(|v| net.at[v as usize]);
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        // One without area is cut into pieces too.
        (triangle_area([a, b, c]) / (3.0f64.sqrt() / 4.0 * length * length)).max(f64::from(longest) / length - 4.0)
    };
    let about: f64 = triangles.iter().map(of_triangle).sum();
    if about <= MOST as f64 { Ok(()) } else { Err(RemeshError::TooMany { about: about as u64, most: MOST }) }
}

/// The steps, and the clean-up after them.
async fn run(net: &mut Net, original: &Original, rounds: usize, coarse_rounds: usize, yielder: &Yielder) {
    let all = (rounds + LAST_ROUNDS + 1) as f32;
    // When edges were collapsed and flipped last.
    let (mut collapsed, mut flipped) = (0, 0);
    for round in 0..rounds {
        let done = round as f32 / all;
        net.clock += 1;
        let mut changes = steps::split_long(net, original, 2 * MOST);
        yielder.rest(done).await;
        let longest = if round < coarse_rounds { steps::LONGER } else { steps::LONG };
        // The last of the coarse rounds leaves edges that may not be collapsed from then on.
        let since = std::mem::replace(&mut collapsed, net.clock + 1);
        net.clock += 1;
        changes += steps::collapse_short(net, longest, since);
        yielder.rest(done).await;
        let since = std::mem::replace(&mut flipped, net.clock);
        changes += steps::flip_to_valence(net, since);
        yielder.rest(done).await;
        steps::relax(net, original);
        if round >= coarse_rounds && FEW * changes < net.triangle_count() {
            break;
        }
    }
    // Angles were not asked for yet.
    flipped = 0;
    for round in 0..LAST_ROUNDS {
        net.clock += 1;
        let since = std::mem::replace(&mut flipped, net.clock);
        steps::flip_to_angles(net, since);
        yielder.rest((rounds + round) as f32 / all).await;
        steps::relax(net, original);
    }
    clean::widen_angles(net, original);
}

/// The old triangles, none of which crossed others, at new ones that do.
fn where_crossed(crossing: &[u32], mesh: &TriMesh, original: &Original) -> Vec<u32> {
    if crossing.is_empty() {
        return Vec::new();
    }
    let index = original.index();
    let points = crossing.iter().flat_map(|&t| samples(mesh.corners(t as usize)));
    let mut near: Vec<u32> = points.filter_map(|p| index.nearest(p)).map(|found| found.triangle).collect();
    near.sort_unstable();
    near.dedup();
    let old = TriMesh { positions: original.first.at.clone(), triangles: original.triangles.clone() };
    let crossed_before = if FEW_CROSSED * near.len() < old.triangles.len() {
        clashing_of(&old, index, near.clone())
    } else {
        clashing_in(&old, index, &Topology::new(old.positions.len(), &old.triangles))
    };
    near.retain(|t| crossed_before.binary_search(t).is_err());
    near
}

/// The old triangles where one of the surfaces is farther than `bound` from the other, in mm.
fn where_far(bound: f64, new: &Numbered, original: &Original) -> Vec<u32> {
    let (bound, mesh, index) = (bound as f32, &new.mesh, &new.index);
    let mut far = Vec::new();
    for t in 0..mesh.triangles.len() {
        let beyond = samples(mesh.corners(t)).into_iter().filter(|&p| !original.index().is_within(p, bound));
        far.extend(beyond.filter_map(|p| original.index().nearest(p)).map(|found| found.triangle));
    }
    for (t, corners) in original.triangles.iter().enumerate() {
        let corners = corners.map(|v| original.first.at[v as usize]);
        if samples(corners).into_iter().any(|p| !index.is_within(p, bound)) {
            far.push(t as u32);
        }
    }
    far
}

/// Reduces the wanted lengths at some old triangles; whether there are any that can be reduced.
fn reduce(coarse: &[u32], original: &Original, sizing: &Sizing, lengths: &mut [f64]) -> bool {
    let mut vertices: Vec<u32> = coarse.iter().flat_map(|&t| original.triangles[t as usize]).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let mut is_reduced = false;
    for v in vertices {
        let length = &mut lengths[v as usize];
        let reduced = (*length * REDUCTION).max(sizing.least_mm);
        is_reduced |= reduced < *length;
        *length = reduced;
    }
    is_reduced
}

/// Looks the wanted lengths up again, and wakes the vertices at which they are others.
fn resize(net: &mut Net, original: &Original) {
    net.clock += 1;
    for v in 0..net.at.len() as u32 {
        let (foot, kind) = (net.foot[v as usize], net.kind[v as usize]);
        if net.out[v as usize] == NONE {
            continue;
        }
        let size = if foot.on != NONE {
            original.size_at(kind, foot)
        } else if net.first[v as usize] != NONE {
            original.lengths[v as usize]
        } else {
            original.project(net, v, net.at[v as usize]).map_or(net.size[v as usize], |place| place.size())
        };
        if size != net.size[v as usize] {
            net.size[v as usize] = size;
            net.wake_ring(v);
        }
    }
}
