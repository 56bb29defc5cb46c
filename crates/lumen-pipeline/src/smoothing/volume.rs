//! Smoothing that holds the volume.
//!
//! A low-pass filter takes volume off where the surface is convex on the scale of the filter, and most of it off thin
//! vessels. What is common puts it back evenly: by scaling the surface (Desbrun, Meyer, Schröder and Barr 1999), which
//! moves what was never smoothed, or by one offset along all normals (Kuprat, Khamayseh, George and Larkey 2001 give
//! the exact step), which swells thin vessels. Here it goes back where it was lost:
//!
//! 1. The loss at a vertex is the part of its way `x - S x` along the smoothed surface's normal. Stair-steps are in it;
//!    the same filter takes them out (Tukey's twicing, 1977, along the normals). The result is added.
//! 2. What is still missing, or too much, is little. It is spread evenly over what smoothing moved:
//!    `x = S x + n (loss + m rms share)`, with the root mean square of the way and a `share` that falls from 1 to 0
//!    where smoothing moved next to nothing. The volume is a cubic polynomial in `m`; its root next to 0 is the answer.
//!
//! Where a vessel is drawn together to a line, its normals are noise, and to follow them tears it to ribbons: then those
//! of the surface before smoothing, blurred, take their place. `m` is 1 at most, and a hundredth of the surface at most may
//! look the other way than before smoothing, which ribbons do. Where that cannot be had the surface is left as the filter
//! made it.
//! Vertices that smoothing fixes stay to the bit; those of a boundary loop move in the loop's plane.

use glam::{DVec3, Vec3};

use super::{Coefficients, Stencil, filtered};
use crate::filter::Filter;
use crate::normals::{Weighting, vertex_normals};
use crate::settings::Boundary;
use crate::task::Yielder;
use lumen_mesh::{Topology, TriMesh, volume_of, volume_within};

/// How near to the volume asked for counts as held, as a part of it.
pub(crate) const TOLERANCE: f64 = 1e-4;

/// The largest `|m|`.
const MAX_M: f64 = 1.0;

/// The largest part of the area that may look the other way than before smoothing. Of 13 vessels at 6 settings each, those
/// that come back whole have 0.8 % at most, stairs and folds that were smoothed out; torn ones have from 1.1 % on.
const TORN: f64 = 0.01;

/// The surface before smoothing.
pub(crate) struct Before<'a> {
    /// The surface.
    pub mesh: &'a TriMesh,
    pub topology: &'a Topology,
    /// Its boundary, each loop in the direction of its triangles.
    pub loops: &'a [Vec<u32>],
    /// Its volume in mm3.
    pub volume: f64,
}

/// Puts lost volume back into `smoothed`, the result of `filter` on the surface `before`. Gives the positions, and whether
/// they hold the volume: where they cannot, they are the smoothed ones.
pub(crate) async fn hold_volume(
    before: &Before<'_>,
    smoothed: Vec<Vec3>,
    boundary: Boundary,
    filter: &Filter,
    yielder: &Yielder,
) -> (Vec<Vec3>, bool) {
    let normals = vertex_normals(&smoothed, &before.mesh.triangles, Weighting::Area);
    if let Some(positions) = along(before, &smoothed, normals, boundary, filter, &yielder.part(0.0..0.5)).await {
        return (positions, true);
    }
    yielder.rest(0.5).await;
    let normals = blurred_normals(before);
    match along(before, &smoothed, normals, boundary, filter, &yielder.part(0.5..1.0)).await {
        Some(positions) => (positions, true),
        None => (smoothed, false),
    }
}

/// The positions that hold the volume by moving along these normals, if there are any.
async fn along(
    before: &Before<'_>,
    smoothed: &[Vec3],
    normals: Vec<Vec3>,
    boundary: Boundary,
    filter: &Filter,
    yielder: &Yielder,
) -> Option<Vec<Vec3>> {
    let ways = before.mesh.positions.iter().zip(smoothed).map(|(&x, &s)| x - s);
    // Loss, length of the way, 0.
    let field: Vec<Vec3> = ways.zip(&normals).map(|(way, n)| Vec3::new(way.dot(*n), way.length(), 0.0)).collect();
    let stencil = Stencil::new(&before.mesh.positions, before.topology, boundary);
    let (field, _) = filtered(field, stencil, Coefficients::of(filter), 0, yielder).await;
    place(before, smoothed, &normals, &field)
}

/// The normals of the surface before smoothing, each the mean of its neighbours' and itself time and again: without
/// stairs, and where the filter has drawn a vessel together to a line still pointing out of it.
fn blurred_normals(before: &Before) -> Vec<Vec3> {
    const TIMES: usize = 10;
    let mut normals = vertex_normals(&before.mesh.positions, &before.mesh.triangles, Weighting::Area);
    for _ in 0..TIMES {
        let blurred = |v: usize| {
            let around = before.topology.neighbours(v as u32);
            let sum: Vec3 = around.iter().map(|&n| normals[n as usize]).sum();
            normals[v] + sum / around.len().max(1) as f32
        };
        normals = (0..normals.len()).map(blurred).collect();
    }
    normals.into_iter().map(Vec3::normalize_or_zero).collect()
}

/// The positions that hold the volume with the filtered `field` of losses and ways, if there are any.
fn place(before: &Before, smoothed: &[Vec3], normals: &[Vec3], field: &[Vec3]) -> Option<Vec<Vec3>> {
    let directions = directions(smoothed, normals, before.loops);
    let origin = before.mesh.bounds().centre().as_dvec3();
    let way = |v: usize| f64::from(field[v].y.max(0.0));
    let squares = (0..field.len()).map(|v| way(v) * way(v)).sum::<f64>();
    let typical = libm::sqrt(squares / field.len().max(1) as f64);
    let at = |v: usize, m: f64| {
        // Evenly, but for where smoothing moved next to nothing.
        let share = if way(v) > 0.0 { way(v) / (way(v) + typical) } else { 0.0 };
        smoothed[v].as_dvec3() + directions[v] * (f64::from(field[v].x) + m * typical * share)
    };
    let volume_at = |m: f64| volume_of(&before.mesh.triangles, before.loops, |v| at(v as usize, m) - origin);
    let volumes = [-1.0, 0.0, 1.0, 2.0].map(volume_at);
    // What does not move keeps its bits.
    let moves = |v: usize| directions[v] != DVec3::ZERO && field[v] != Vec3::ZERO;
    let placed = |v: usize, m: f64| if moves(v) { at(v, m).as_vec3() } else { smoothed[v] };
    let mut target = before.volume;
    // Where the boundary is no closed curve the volume depends a little on the origin: then it takes a second look.
    for _ in 0..3 {
        let m = nearest_root(volumes.map(|volume| volume - target)).filter(|m| m.abs() <= MAX_M)?;
        let positions = (0..smoothed.len()).map(|v| placed(v, m)).collect();
        let mesh = TriMesh { positions, triangles: before.mesh.triangles.clone() };
        let missing = before.volume - volume_within(&mesh, before.loops);
        if missing.abs() <= TOLERANCE / 2.0 * before.volume.abs() {
            return (turned(before.mesh, &mesh) <= TORN).then_some(mesh.positions);
        }
        target += missing;
    }
    None
}

/// The part of the area of `before` whose triangles look the other way in `after`.
fn turned(before: &TriMesh, after: &TriMesh) -> f64 {
    let normal = |[a, b, c]: [Vec3; 3]| (b.as_dvec3() - a.as_dvec3()).cross(c.as_dvec3() - a.as_dvec3());
    let (mut turned, mut all) = (0.0, 0.0);
    for t in 0..before.triangles.len() {
        let (was, is) = (normal(before.corners(t)), normal(after.corners(t)));
        let area = was.length();
        all += area;
        turned += if was.dot(is) < 0.0 { area } else { 0.0 };
    }
    if all > 0.0 { turned / all } else { 0.0 }
}

/// The directions in which vertices may move: along their normals, on a loop in its plane.
pub(super) fn directions(smoothed: &[Vec3], normals: &[Vec3], loops: &[Vec<u32>]) -> Vec<DVec3> {
    let mut directions: Vec<DVec3> = normals.iter().map(|n| n.as_dvec3()).collect();
    let at = |v: u32| smoothed[v as usize].as_dvec3();
    for chain in loops {
        let origin = at(chain[0]);
        let pairs = chain.iter().zip(chain.iter().cycle().skip(1));
        // Newell: the loop's area vector.
        let across = pairs.map(|(&a, &b)| (at(a) - origin).cross(at(b) - origin)).sum::<DVec3>().normalize_or_zero();
        for &v in chain {
            let n = directions[v as usize];
            directions[v as usize] = if across == DVec3::ZERO { DVec3::ZERO } else { n - across * n.dot(across) };
        }
    }
    directions
}

/// The root next to 0 of the cubic polynomial that has these values at -1, 0, 1 and 2, within -2 to 2.
fn nearest_root(values: [f64; 4]) -> Option<f64> {
    if values.iter().any(|value| !value.is_finite()) {
        return None;
    }
    let [before, zero, one, two] = values;
    // Newton's forward differences from -1.
    let (d1, d2, d3) = (zero - before, one - 2.0 * zero + before, two - 3.0 * one + 3.0 * zero - before);
    let value = |m: f64| {
        let t = m + 1.0;
        before + t * (d1 + (t - 1.0) / 2.0 * (d2 + (t - 2.0) / 3.0 * d3))
    };
    if zero == 0.0 {
        return Some(0.0);
    }
    const STEPS: i32 = 128;
    let at = |step: i32| 2.0 * f64::from(step) / f64::from(STEPS);
    let crossing = |sign: i32| {
        (1..=STEPS).find(|&step| value(at(sign * step)) * value(at(sign * (step - 1))) <= 0.0).map(|step| (step, sign))
    };
    let (step, sign) = [crossing(1), crossing(-1)].into_iter().flatten().min()?;
    let (mut near, mut far) = (at(sign * (step - 1)), at(sign * step));
    for _ in 0..60 {
        let middle = (near + far) / 2.0;
        if value(middle) * value(near) <= 0.0 { far = middle } else { near = middle }
    }
    Some(far)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_root_next_to_zero_is_found() {
        let cubic = |m: f64| (m - 0.3) * (m + 0.9) * (m - 1.7);
        let found = nearest_root([-1.0, 0.0, 1.0, 2.0].map(cubic)).unwrap();
        assert!((found - 0.3).abs() < 1e-12, "{found}");
        assert_eq!(nearest_root([0.0; 4]), Some(0.0));
        assert_eq!(nearest_root([1.0; 4]), None);
        assert_eq!(nearest_root([f64::NAN, 1.0, 1.0, 1.0]), None);
    }
}
