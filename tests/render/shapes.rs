//! Surfaces to draw.

use std::f32::consts::{PI, TAU};

use glam::Vec3;
use lumen::mesh::TriMesh;

/// A sphere of `radius` about the origin, of `2 * n` by `n` quadrilaterals.
pub(crate) fn sphere(radius: f32, n: u32) -> TriMesh {
    grid(2 * n, n, |u, v| {
        let (polar, azimuth) = (PI * v, TAU * u);
        radius * Vec3::new(polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), -polar.cos())
    })
}

/// A tube of varying width, bent like an aortic arch, open at both ends; its long leg hangs down.
pub(crate) fn arch(around: u32, along: u32) -> TriMesh {
    grid(around, along, |u, v| {
        let (centre, along) = arch_line(v);
        let across = Vec3::Y;
        let out = along.cross(across);
        let radius = 13.0 - 5.0 * v + 1.6 * (9.0 * v).sin() + 4.0 * (-((v - 0.78) / 0.06).powi(2)).exp();
        centre + radius * ((TAU * u).cos() * across + (TAU * u).sin() * out)
    })
}

/// Centre and direction of the arch: up, over, and down.
fn arch_line(v: f32) -> (Vec3, Vec3) {
    let bend = 38.0;
    let (rise, turn, fall) = (45.0, PI * bend, 130.0);
    let s = v * (rise + turn + fall);
    if s < rise {
        (Vec3::new(-bend, 0.0, s - rise), Vec3::Z)
    } else if s < rise + turn {
        let angle = (s - rise) / bend;
        (bend * Vec3::new(-angle.cos(), 0.0, angle.sin()), Vec3::new(angle.sin(), 0.0, angle.cos()))
    } else {
        (Vec3::new(bend, 0.0, rise + turn - s), Vec3::NEG_Z)
    }
}

/// A quadrilateral of two triangles, facing the front (-y), `size` wide and high, at depth `y`.
pub(crate) fn square(size: f32, y: f32) -> TriMesh {
    let half = size / 2.0;
    let positions = [(-half, -half), (half, -half), (half, half), (-half, half)].map(|(x, z)| Vec3::new(x, y, z));
    TriMesh { positions: positions.to_vec(), triangles: vec![[0, 1, 2], [0, 2, 3]] }
}

/// Both meshes in one.
pub(crate) fn together(a: &TriMesh, b: &TriMesh) -> TriMesh {
    let shift = a.positions.len() as u32;
    let moved = b.triangles.iter().map(|triangle| triangle.map(|v| v + shift));
    TriMesh {
        positions: [&a.positions[..], &b.positions[..]].concat(),
        triangles: a.triangles.iter().copied().chain(moved).collect(),
    }
}

/// A sheet over u (closed) and v (open), each 0 to 1, of `n` by `m` quadrilaterals; degenerate ones are left out.
fn grid(n: u32, m: u32, at: impl Fn(f32, f32) -> Vec3) -> TriMesh {
    let positions = (0..=m).flat_map(|j| (0..n).map(move |i| (i, j)));
    let positions: Vec<Vec3> = positions.map(|(i, j)| at(i as f32 / n as f32, j as f32 / m as f32)).collect();
    let index = |i, j| j * n + i % n;
    let mut triangles = Vec::new();
    for (i, j) in (0..m).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    triangles.retain(|&[a, b, c]| {
        let [a, b, c] = [a, b, c].map(|v| positions[v as usize]);
        (b - a).cross(c - a).length() > 1e-6
    });
    TriMesh { positions, triangles }
}
