//! The inner vertices of a patch moved so that it goes on as the surface around it does.
//!
//! Liepa, "Filling holes in meshes" (2003), section 5, after Kobbelt et al. (1998): the umbrella operator U takes a vertex
//! to its distance from the mean of its neighbours; the membrane has U = 0 within the rim, the thin plate least squares of
//! U over the patch and its rim, whose neighbours beyond the patch stay where they are. Both are solved by conjugate
//! gradients (Hestenes and Stiefel 1952), in f64 and in a fixed order.

use glam::DVec3;

use super::patch_mesh::Patch;

/// Steps of the solver at most, and the part of the first residual at which it ends.
const STEPS: usize = 400;
const ENOUGH: f64 = 1e-8;

/// A vertex less the mean of those around it: of unknown vertices by their numbers, of others their sum.
struct Umbrella {
    centre: Result<usize, DVec3>,
    around: Vec<usize>,
    fixed: DVec3,
    share: f64,
}

impl Umbrella {
    fn of(&self, x: &[DVec3]) -> DVec3 {
        let centre = self.centre.map_or(DVec3::ZERO, |v| x[v]);
        centre - self.around.iter().map(|&v| x[v]).sum::<DVec3>() * self.share
    }

    /// What stands on the other side: the part of the vertices that are known.
    fn known(&self) -> DVec3 {
        self.fixed * self.share - self.centre.err().unwrap_or(DVec3::ZERO)
    }

    fn add(&self, value: DVec3, sum: &mut [DVec3]) {
        if let Ok(v) = self.centre {
            sum[v] += value;
        }
        for &v in &self.around {
            sum[v] -= value * self.share;
        }
    }
}

/// Makes the patch a membrane.
pub(super) fn relax(patch: &mut Patch) {
    solve(patch, &[], false);
}

/// Makes it a thin plate; `beyond` has for each vertex of the rim the places of its neighbours beyond the patch.
pub(super) fn fair(patch: &mut Patch, beyond: &[Vec<DVec3>]) {
    solve(patch, beyond, true);
}

fn solve(patch: &mut Patch, beyond: &[Vec<DVec3>], with_rim: bool) {
    let rim = patch.rim;
    if patch.points.len() == rim {
        return;
    }
    let around = patch.neighbours();
    let umbrellas: Vec<Umbrella> = (if with_rim { 0 } else { rim }..patch.points.len())
        .map(|v| {
            let outer = beyond.get(v).map_or(&[][..], |outer| outer);
            let inner = |&w: &u32| w as usize >= rim;
            let known = around[v].iter().filter(|w| !inner(w)).map(|&w| patch.points[w as usize]);
            Umbrella {
                centre: if v >= rim { Ok(v - rim) } else { Err(patch.points[v]) },
                around: around[v].iter().filter(|w| inner(w)).map(|&w| w as usize - rim).collect(),
                fixed: known.chain(outer.iter().copied()).sum(),
                share: 1.0 / (around[v].len() + outer.len()) as f64,
            }
        })
        .collect();
    // The normal equations; for the membrane too, whose operator is not symmetric.
    let apply = |x: &[DVec3]| {
        let mut sum = vec![DVec3::ZERO; x.len()];
        umbrellas.iter().for_each(|umbrella| umbrella.add(umbrella.of(x), &mut sum));
        sum
    };
    let mut x: Vec<DVec3> = patch.points[rim..].to_vec();
    let mut residual = vec![DVec3::ZERO; x.len()];
    umbrellas.iter().for_each(|umbrella| umbrella.add(umbrella.known() - umbrella.of(&x), &mut residual));
    let mut direction = residual.clone();
    // Each coordinate by itself.
    let dot = |a: &[DVec3], b: &[DVec3]| a.iter().zip(b).map(|(a, b)| a * b).sum::<DVec3>();
    let mut size = dot(&residual, &residual);
    let end = size * ENOUGH * ENOUGH;
    let ratio =
        |a: DVec3, b: DVec3| DVec3::from_array(std::array::from_fn(|i| if b[i] > 0.0 { a[i] / b[i] } else { 0.0 }));
    for _ in 0..STEPS {
        if size.cmple(end).all() {
            break;
        }
        let image = apply(&direction);
        let step = ratio(size, dot(&direction, &image));
        for i in 0..x.len() {
            x[i] += direction[i] * step;
            residual[i] -= image[i] * step;
        }
        let next = dot(&residual, &residual);
        let turn = ratio(next, size);
        for i in 0..x.len() {
            direction[i] = residual[i] + direction[i] * turn;
        }
        size = next;
    }
    patch.points.truncate(rim);
    patch.points.extend(x);
}
