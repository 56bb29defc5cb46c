//! The surface between the points that are outside and the others, laid back onto what it wraps.
//!
//! Marching cubes leave it about half of the tolerance outside. Each vertex goes to the nearest point of what is wrapped, or
//! as much of the way as keeps the triangles around it from turning over and from becoming thin. Where that is a sheet with
//! outside on both its sides, vertices stop at [`APART`] of the tolerance before it, so that the two sides stay apart. Then
//! triangles that cross others, are folded, or have left the tolerance go back to where they were, and those around them,
//! until there are none: at the start nothing crosses and all is within the tolerance.

use std::task::Poll;

use glam::{DVec3, Vec3};
use lumen_mesh::task::{Yielder, blocks};
use lumen_mesh::{HausdorffBound, SurfaceIndex, Topology, TriMesh, parallel};

use super::grid::Outside;
use crate::folds::clashing;

/// The part of the tolerance by which the sides of a sheet stay away from it.
const APART: f64 = 0.4;
/// Parts of the way that are tried.
const WAYS: [f32; 4] = [1.0, 0.75, 0.5, 0.25];
/// The cosine of the largest angle by which a triangle may turn.
const TURN: f64 = 0.3;
/// A triangle stays this high, in steps of the grid.
const HIGH: f64 = 0.15;
/// Rounds in which vertices go back; in the last all do.
const ROUNDS: usize = 12;
/// Vertices between two looks at the clock, and of one thread.
const SLICE: usize = 8_192;
const CHUNK: usize = 512;

/// Lays `mesh` onto the surface of `index`, from which it is less than `tolerance` mm away.
pub(super) async fn fit(
    mesh: &mut TriMesh,
    index: &SurfaceIndex,
    outside: &Outside,
    tolerance: f64,
    yielder: &Yielder,
) {
    let before = mesh.positions.clone();
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let step = outside.geometry().spacing.x;
    let mut targets = Vec::with_capacity(before.len());
    for range in blocks(before.len(), SLICE) {
        let (from, end) = (range.start, range.end);
        let found = parallel::map_ranges(range.len(), CHUNK, |range| {
            let of = |v: usize| target(before[from + v], index, outside, step, tolerance);
            range.map(of).collect::<Vec<Vec3>>()
        });
        targets.extend(found.concat());
        yielder.rest(0.4 * end as f32 / before.len() as f32).await;
    }
    // The second time neighbours have made room.
    for round in 0..2 {
        for range in blocks(before.len(), SLICE) {
            let end = range.end;
            for v in range {
                go(mesh, &topology, &before, v as u32, targets[v], HIGH * step);
            }
            yielder.rest(0.4 + 0.1 * (round as f32 + end as f32 / before.len() as f32)).await;
        }
    }
    for round in 0..ROUNDS {
        let mut wrong = clashing(mesh);
        yielder.rest(0.6 + 0.03 * round as f32).await;
        // Distances take longest: they are asked for once more where nothing else is left.
        if round == 0 || wrong.is_empty() {
            wrong.extend(far(mesh, index, tolerance, yielder).await);
        }
        if wrong.is_empty() {
            return;
        }
        for t in wrong {
            let mut back = mesh.triangles[t as usize].to_vec();
            // What is near goes too, ring by ring.
            for _ in 0..round / 2 {
                back = back.iter().flat_map(|&v| topology.neighbours(v)).copied().collect();
                back.sort_unstable();
                back.dedup();
            }
            back.into_iter().for_each(|v| mesh.positions[v as usize] = before[v as usize]);
        }
    }
    mesh.positions = before;
}

/// Where the vertex at `p` is to go.
fn target(p: Vec3, index: &SurfaceIndex, outside: &Outside, step: f64, tolerance: f64) -> Vec3 {
    let Some(nearest) = index.nearest(p) else { return p };
    let at = nearest.point.as_dvec3();
    let Some(out) = (p.as_dvec3() - at).try_normalize() else { return p };
    // Two and three steps behind it there is outside again, or not.
    let is_sheet = [2.0, 3.0].iter().any(|steps| outside.has(at - out * (steps * step)));
    (if is_sheet { at + out * (APART * tolerance).min(f64::from(nearest.distance)) } else { at }).as_vec3()
}

/// Takes vertex `v` towards `target`, as far as the triangles around it allow.
fn go(mesh: &mut TriMesh, topology: &Topology, before: &[Vec3], v: u32, target: Vec3, high: f64) {
    let from = mesh.positions[v as usize];
    if from == target {
        return;
    }
    for part in WAYS {
        let to = from.lerp(target, part);
        let is_sound = topology.triangles(v).iter().all(|&t| {
            let triangle = mesh.triangles[t as usize];
            let now = triangle.map(|w| if w == v { to } else { mesh.positions[w as usize] }.as_dvec3());
            let was = triangle.map(|w| before[w as usize].as_dvec3());
            let across = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
            let [across_now, across_was] = [across(now), across(was)];
            let [a, b, c] = now;
            let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt();
            across_now.dot(across_was) > TURN * across_now.length() * across_was.length()
                && across_now.length() > high * longest
        });
        if is_sound {
            mesh.positions[v as usize] = to;
            return;
        }
    }
}

/// The triangles of which some point is farther than `tolerance` from the surface of `index`.
async fn far(mesh: &TriMesh, index: &SurfaceIndex, tolerance: f64, yielder: &Yielder) -> Vec<u32> {
    let mut far = Vec::new();
    for range in blocks(mesh.triangles.len(), SLICE) {
        let (from, end) = (range.start, range.end);
        let found = parallel::map_ranges(range.len(), CHUNK, |range| {
            let mut bound = HausdorffBound::new(tolerance);
            let mut is_far = |t: usize| {
                bound.begin(mesh.corners(t));
                loop {
                    match bound.advance(index, 64) {
                        Poll::Ready(found) => return found.is_some(),
                        Poll::Pending => {}
                    }
                }
            };
            let all = range.map(|t| from + t);
            all.filter(|&t| is_far(t)).map(|t| t as u32).collect::<Vec<u32>>()
        });
        far.extend(found.concat());
        yielder.rest(0.6 + 0.3 * end as f32 / mesh.triangles.len() as f32).await;
    }
    far
}
