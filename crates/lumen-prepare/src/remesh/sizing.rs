//! The wanted edge length at each vertex of the surface that enters.
//!
//! A length is the circumference `2 pi r` of the vessel over the edges around it. Where a bound `d` on the deviation is
//! given it is at most `sqrt(6 d / k)` at a curvature `k`: a triangle of that side, its corners on a sphere, lies at
//! most `d` below it; on a feature curve `sqrt(8 d / k)`, the chord of a circle. Lengths are then graded: along each
//! edge they grow by at most half of `growth - 1` mm a mm, from the least one on, in the order of Dijkstra.

use std::collections::BinaryHeap;

use glam::DVec3;

use super::Sizing;
use super::net::{FREE, NONE, Net};

/// The part of `growth - 1` that lengths grow by on a mm. Triangles differ from their wanted size, so that with a half
/// the growth holds from triangle to triangle too.
const SLOPE: f64 = 0.5;
/// Rounds of averaging of the curvature over neighbours, against noise.
const AVERAGING: usize = 2;

/// Lengths by the radius alone; infinite where it is not known.
pub(super) fn by_radius(radii: &[f32], sizing: &Sizing) -> Vec<f64> {
    let length = |&r: &f32| std::f64::consts::TAU * f64::from(r) / sizing.around;
    let clamped =
        |length: f64| if length.is_finite() { length.clamp(sizing.least_mm, sizing.largest_mm) } else { length };
    radii.iter().map(length).map(clamped).collect()
}

/// Lowers `lengths` to what the bound on the deviation allows.
pub(super) fn bound_deviation(net: &Net, deviation: f64, sizing: &Sizing, lengths: &mut [f64]) {
    for (v, curvature) in curvatures(net).into_iter().enumerate() {
        let factor = if net.kind[v] == FREE { 6.0 } else { 8.0 };
        let allowed = (factor * deviation / curvature.max(f64::MIN_POSITIVE)).sqrt();
        lengths[v] = lengths[v].min(allowed.max(sizing.least_mm));
    }
}

/// Largest curvature of an edge at each vertex in 1/mm, averaged over neighbours; on a curve that of the curve.
fn curvatures(net: &Net) -> Vec<f64> {
    let at = |v: u32| net.at[v as usize].as_dvec3();
    let normals: Vec<DVec3> = (0..net.at.len() as u32).map(|v| vertex_normal(net, v)).collect();
    let of_vertex = |v: u32| {
        if net.out[v as usize] == NONE {
            return 0.0;
        }
        if net.kind[v as usize] != FREE {
            let Some([a, b]) = net.along_curve(v) else { return 0.0 };
            let (to_a, to_b) = (at(a) - at(v), at(b) - at(v));
            let bend = (to_a.normalize_or_zero() + to_b.normalize_or_zero()).length();
            return 2.0 * bend / (to_a.length() + to_b.length()).max(f64::MIN_POSITIVE);
        }
        let on_edge = |(n, _): (u32, u32)| {
            let along = at(n) - at(v);
            let turn = (normals[n as usize] - normals[v as usize]).dot(along);
            if net.kind[n as usize] == FREE {
                (turn / along.length_squared().max(f64::MIN_POSITIVE)).abs()
            } else {
                0.0
            }
        };
        net.neighbours(v).map(on_edge).fold(0.0, f64::max)
    };
    let mut curvatures: Vec<f64> = (0..net.at.len() as u32).map(of_vertex).collect();
    for _ in 0..AVERAGING {
        let mean = |v: u32| {
            let own = curvatures[v as usize];
            if net.out[v as usize] == NONE || net.kind[v as usize] != FREE {
                return own;
            }
            let alike = net.neighbours(v).filter(|&(n, _)| net.kind[n as usize] == FREE);
            let (sum, count) =
                alike.fold((own, 1.0), |(sum, count), (n, _)| (sum + curvatures[n as usize], count + 1.0));
            sum / count
        };
        curvatures = (0..net.at.len() as u32).map(mean).collect();
    }
    curvatures
}

/// The unit normal at a vertex, weighted by area; 0 where there is none.
pub(super) fn vertex_normal(net: &Net, v: u32) -> DVec3 {
    if net.out[v as usize] == NONE {
        return DVec3::ZERO;
    }
    let doubled = net.around(v).map(|h| {
        let [a, b, c] = net.corners(h / 3).map(glam::Vec3::as_dvec3);
        (b - a).cross(c - a)
    });
    doubled.sum::<DVec3>().normalize_or_zero()
}

/// Lowers `lengths` until none grows faster than `sizing.growth` along an edge, none is above the largest and none
/// below the least.
pub(super) fn grade(net: &Net, sizing: &Sizing, lengths: &mut [f64]) {
    let slope = SLOPE * (sizing.growth - 1.0);
    // Lengths are above 0, so their bits are in their order; the heap gives the least first.
    let entry = |length: f64, v: u32| std::cmp::Reverse((length.to_bits(), v));
    let allowed =
        |length: f64, v: u32, n: u32| length + slope * f64::from(net.at[v as usize].distance(net.at[n as usize]));
    lengths.iter_mut().for_each(|length| *length = length.clamp(sizing.least_mm, sizing.largest_mm));
    // Those that lower a neighbour.
    let lowers = |v: u32| {
        let length = lengths[v as usize];
        let is_lowered = |n: u32| length < lengths[n as usize] && allowed(length, v, n) < lengths[n as usize];
        net.out[v as usize] != NONE && net.neighbours(v).any(|(n, _)| is_lowered(n))
    };
    let first = (0..lengths.len() as u32).filter(|&v| lowers(v)).map(|v| entry(lengths[v as usize], v));
    let mut heap: BinaryHeap<_> = first.collect();
    while let Some(std::cmp::Reverse((bits, v))) = heap.pop() {
        let length = f64::from_bits(bits);
        if length > lengths[v as usize] || net.out[v as usize] == NONE {
            continue;
        }
        for (n, _) in net.neighbours(v) {
            let allowed = allowed(length, v, n);
            if allowed < lengths[n as usize] {
                lengths[n as usize] = allowed;
                heap.push(entry(allowed, n));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use lumen_mesh::shapes::{icosphere, square};

    use super::*;

    #[test]
    fn a_length_is_the_circumference_over_the_edges_around_it_within_its_bounds() {
        let sizing = Sizing { around: 12.0, least_mm: 0.2, largest_mm: 2.0, ..Sizing::default() };
        let found = by_radius(&[1.0, 0.1, 100.0, f32::INFINITY], &sizing);
        assert!((found[0] - std::f64::consts::FRAC_PI_6).abs() < 1e-9);
        assert_eq!(found[1..], [0.2, 2.0, f64::INFINITY]);
    }

    #[test]
    fn lengths_grow_by_half_the_growth_less_one_a_mm_along_a_line_of_edges() {
        let mesh = square(20, 20.0, 0.0);
        let net = Net::new(&mesh.positions, &mesh.triangles, vec![0; mesh.triangles.len()]).unwrap();
        let mut lengths = vec![f64::INFINITY; net.at.len()];
        lengths[0] = 0.5;
        grade(&net, &Sizing { growth: 1.3, least_mm: 0.1, largest_mm: 3.0, ..Sizing::default() }, &mut lengths);
        for (x, length) in lengths.iter().take(21).enumerate() {
            assert!((length - (0.5 + 0.15 * x as f64).min(3.0)).abs() < 1e-5, "{x}: {length}");
        }
    }

    #[test]
    fn the_curvature_of_a_sphere_is_one_over_its_radius() {
        let sphere = icosphere(4, 4.0, glam::Vec3::ONE);
        let net = Net::new(&sphere.positions, &sphere.triangles, vec![0; sphere.triangles.len()]).unwrap();
        for curvature in curvatures(&net) {
            assert!((curvature - 0.25).abs() < 0.02, "{curvature}");
        }
    }
}
