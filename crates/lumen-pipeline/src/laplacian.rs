//! Plain Laplacian smoothing as a filter, to hold beside the windowed sinc: no surface is made of it, it is only shown.
//!
//! A pass moves each vertex by a part `lambda` of the way to the mean of its neighbours, `x' = x - lambda K x`, so `n`
//! passes have the gain `(1 - lambda k)^n` (Taubin, "A signal processing approach to fair surface design", 1995). Only a
//! constant has a gain of 1: every wave loses, the one around a vessel too, and the vessel becomes thinner. With a
//! `lambda` of a half a pass is the operator `I - K/2` of which the windowed sinc is a polynomial
//! ([`filter`](super::filter)): as many passes cost as much, and may be compared.

/// `lambda`: half of the way, the largest that turns no wave over.
pub const RELAXATION: f64 = 0.5;

/// What `passes` of Laplacian smoothing leave of a wave of the eigenvalue `k`, 0 to 2: from 0 to 1.
pub fn laplacian_response(k: f64, passes: u32) -> f64 {
    libm::pow(1.0 - RELAXATION * k, f64::from(passes))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use glam::{DVec2, DVec3};

    use super::*;
    use crate::filter::Filter;
    use crate::response::eigenvalue;
    use crate::settings::Boundary;
    use crate::smoothing::smooth;
    use lumen_mesh::shapes::tube;
    use lumen_mesh::{Topology, Vec3};

    /// Vertices around the tube, and rings along it, which ends where it begins.
    const AROUND: usize = 32;
    const RINGS: usize = 6;

    /// The neighbours on a lattice of equilateral triangles that is rolled up: every other ring is half an edge ahead.
    fn neighbours(ring: usize, i: usize) -> [(usize, usize); 6] {
        let (before, after) = ((i + AROUND - 1) % AROUND, (i + 1) % AROUND);
        let beside = if ring.is_multiple_of(2) { [before, i] } else { [i, after] };
        let rings = [(ring + 1) % RINGS, (ring + RINGS - 1) % RINGS];
        let [up, down] = rings.map(|ring| beside.map(|i| (ring, i)));
        [(ring, before), (ring, after), up[0], up[1], down[0], down[1]]
    }

    #[test]
    fn a_tube_shrinks_as_the_wave_around_it_is_damped() {
        let step = 2.0 * PI / AROUND as f64;
        let angle = |ring: usize, i: usize| step * (i as f64 + 0.5 * (ring % 2) as f64);
        let mut tube: Vec<Vec<DVec2>> =
            (0..RINGS).map(|ring| (0..AROUND).map(|i| 4.0 * DVec2::from_angle(angle(ring, i))).collect()).collect();
        // Its edges: two along the ring, four to the rings beside it, which are as far as in an equilateral triangle.
        let along = 3f64.sqrt() / 2.0 * (tube[0][1] - tube[0][0]).length();
        let place = |(ring, i): (usize, usize), z: f64| DVec3::from((tube[ring][i], z));
        let squares: f64 = (0..6)
            .map(|n| place(neighbours(0, 0)[n], if n < 2 { 0.0 } else { along }) - place((0, 0), 0.0))
            .map(DVec3::length_squared)
            .sum();
        let edge = (squares / 6.0).sqrt();
        for passes in 1..=200_u32 {
            let mean = |ring, i| neighbours(ring, i).into_iter().map(|(r, j)| tube[r][j]).sum::<DVec2>() / 6.0;
            tube = (0..RINGS)
                .map(|ring| (0..AROUND).map(|i| tube[ring][i].lerp(mean(ring, i), RELAXATION)).collect())
                .collect();
            let radius = tube[0][0].length();
            // The wave goes once around: its eigenvalue on this lattice, and its mean over all directions.
            let k = 1.0 - (2.0 * step.cos() + 4.0 * (step / 2.0).cos()) / 6.0;
            assert!((radius / 4.0 - laplacian_response(k, passes)).abs() < 1e-9, "{passes} passes: {radius} mm");
            let stated = laplacian_response(eigenvalue(2.0 * PI * 4.0, edge), passes);
            assert!((radius / 4.0 / stated - 1.0).abs() < 0.01, "{passes} passes: {radius} mm, {stated} is stated");
        }
        assert!(tube[0][0].length() < 2.0, "less than a half is left");
    }

    #[test]
    fn as_a_filter_it_has_the_same_response_and_draws_a_tube_in_as_far() {
        for passes in [0, 1, 2, 20, 101, 200] {
            let filter = Filter::laplacian(passes);
            for k in [0.0, 1e-3, 0.02, 0.3, 1.0, 1.7, 2.0] {
                let (found, stated) = (filter.response(k), laplacian_response(k, passes));
                assert!((found - stated).abs() < 1e-12, "{passes} passes, k = {k}: {found}, not {stated}");
            }
        }
        // The middle of a long open tube, whose ends stay: passes counted by hand, on the surface's own neighbours.
        let mesh = tube(24, 60, 60.0, |_| 3.0);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let mut by_hand = mesh.positions.clone();
        let passes = 15;
        for _ in 0..passes {
            let mut sums = vec![(Vec3::ZERO, 0.0); by_hand.len()];
            let mut seen = std::collections::BTreeSet::new();
            for &[a, b, c] in &mesh.triangles {
                for (from, to) in [(a, b), (b, c), (c, a), (b, a), (c, b), (a, c)] {
                    if seen.insert((from, to)) {
                        sums[from as usize].0 += by_hand[to as usize];
                        sums[from as usize].1 += 1.0;
                    }
                }
            }
            by_hand = by_hand.iter().zip(&sums).map(|(p, (sum, count))| p.lerp(*sum / *count, 0.5)).collect();
        }
        let found = smooth(&mesh.positions, &topology, Boundary::Loop, &Filter::laplacian(passes));
        let middle = |positions: &[Vec3]| -> Vec<Vec3> {
            (0..positions.len()).filter(|&v| (mesh.positions[v].z - 30.0).abs() < 5.0).map(|v| positions[v]).collect()
        };
        let (found, by_hand) = (middle(&found), middle(&by_hand));
        assert!(found.len() > 100);
        for (a, b) in found.iter().zip(&by_hand) {
            assert!(a.distance(*b) < 1e-4, "{a} and {b}");
        }
        assert!(found[0].truncate().length() < 2.9, "it shrinks: {}", found[0].truncate().length());
    }

    #[test]
    fn only_a_constant_stays_and_no_wave_is_turned_over() {
        assert_eq!(
            [laplacian_response(0.0, 100), laplacian_response(2.0, 1), laplacian_response(1.3, 0)],
            [1.0, 0.0, 1.0]
        );
        for k in [0.01, 0.5, 1.0, 1.9] {
            let left = [1, 10, 100].map(|passes| laplacian_response(k, passes));
            assert!(left[0] < 1.0 && left[0] > left[1] && left[1] > left[2] && left[2] >= 0.0, "{left:?}");
        }
    }
}
