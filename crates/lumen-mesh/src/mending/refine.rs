//! The triangles of a patch made as small as those around it.
//!
//! Liepa, "Filling holes in meshes" (2003), section 4, after Pfeifle and Seidel (1996): a triangle whose middle is far
//! from its corners, as the lengths of the edges around go, is divided at its middle; then edges are turned until no
//! turn makes triangles more even.

use super::patch_mesh::Patch;

/// What the distance of the middle from the corners counts for: the root of two, as in the paper.
const DENSITY: f64 = std::f64::consts::SQRT_2;
/// Rounds of division, and of turning in each.
const ROUNDS: usize = 24;
const TURNS: usize = 100;
/// The most vertices of a patch.
const MAX_VERTICES: usize = 50_000;

/// Divides the triangles of `patch`; `lengths` has the mean length in mm of the edges beside each vertex of the rim, and
/// two vertices of the rim for which `is_taken` are not joined.
pub(super) fn refine(patch: &mut Patch, lengths: &[f64], is_taken: impl Fn(u32, u32) -> bool) {
    let mut lengths = lengths.to_vec();
    for _ in 0..ROUNDS {
        let mut is_divided = false;
        for t in 0..patch.triangles.len() {
            let (vertices, corners) = (patch.triangles[t], patch.corners(t));
            let middle = corners.iter().copied().sum::<glam::DVec3>() / 3.0;
            let here = vertices.map(|v| lengths[v as usize]);
            let length = here.iter().sum::<f64>() / 3.0;
            let is_far = corners.iter().zip(here).all(|(p, own)| {
                let distance = DENSITY * p.distance(middle);
                distance > length && distance > own
            });
            if is_far && patch.points.len() < MAX_VERTICES {
                patch.divide(t);
                lengths.push(length);
                is_divided = true;
            }
        }
        if !is_divided {
            return;
        }
        for _ in 0..TURNS {
            let mut is_turned = false;
            for t in 0..patch.triangles.len() {
                is_turned |= patch.relax(t, &is_taken);
            }
            if !is_turned {
                break;
            }
        }
    }
}
