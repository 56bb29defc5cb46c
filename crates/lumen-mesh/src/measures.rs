//! Area and enclosed volume of a surface.
//!
//! Volume is the sum of signed tetrahedra (divergence theorem) about the centre of the bounding box, in f64; open
//! ends are capped by a fan from each boundary loop to the mean of its vertices.

use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

use super::{Topology, TriMesh, boundary_loops};

/// Area and volume of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measures {
    /// Surface area in mm2, caps not counted.
    pub area_mm2: f64,
    /// Enclosed volume in mm3, open ends capped; `None` where the windings do not agree.
    pub volume_mm3: Option<f64>,
}

/// Area and volume of `mesh`; `topology` must be that of its triangles.
pub fn measures(mesh: &TriMesh, topology: &Topology) -> Measures {
    measures_within(mesh, oriented_loops(topology).as_deref())
}

/// The boundary loops of a surface whose windings agree; `None` where they do not.
pub fn oriented_loops(topology: &Topology) -> Option<Vec<Vec<u32>>> {
    topology.is_consistent().then(|| boundary_loops(topology))
}

/// Area and volume of `mesh`, whose [`oriented_loops`] are known: they stay when vertices move.
pub fn measures_within(mesh: &TriMesh, loops: Option<&[Vec<u32>]>) -> Measures {
    let volume = loops.map(|loops| volume_within(mesh, loops));
    Measures { area_mm2: surface_area(mesh), volume_mm3: volume }
}

/// Area of a triangle in mm2.
pub fn triangle_area(corners: [Vec3; 3]) -> f64 {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    (b - a).cross(c - a).length() / 2.0
}

/// Mean length of the triangles' sides, in mm: an edge counts once for each of its triangles. 0 without triangles. It says how
/// finely a wall is resolved.
pub fn mean_edge(mesh: &TriMesh) -> f32 {
    let around = |t: usize| {
        let [a, b, c] = mesh.corners(t).map(Vec3::as_dvec3);
        a.distance(b) + b.distance(c) + c.distance(a)
    };
    let sum: f64 = (0..mesh.triangles.len()).map(around).sum();
    (sum / (3 * mesh.triangles.len()).max(1) as f64) as f32
}

/// Root mean square of the lengths of the triangles' sides, in mm: an edge counts once for each of its triangles. 0
/// without triangles. The eigenvalues of a wave on the mesh go by it.
pub fn rms_edge(mesh: &TriMesh) -> f64 {
    let squares = (0..mesh.triangles.len()).map(|t| {
        let [a, b, c] = mesh.corners(t).map(Vec3::as_dvec3);
        (b - a).length_squared() + (c - b).length_squared() + (a - c).length_squared()
    });
    let sum: f64 = squares.sum();
    libm::sqrt(sum / (3 * mesh.triangles.len()).max(1) as f64)
}

/// Sum of the triangles' areas in mm2.
pub fn surface_area(mesh: &TriMesh) -> f64 {
    (0..mesh.triangles.len()).map(|t| triangle_area(mesh.corners(t))).sum()
}

/// Signed volume in mm3, open ends capped by a fan to each loop's centroid: positive when the triangles wind
/// counter-clockwise seen from outside.
pub fn volume(mesh: &TriMesh, topology: &Topology) -> f64 {
    volume_within(mesh, &boundary_loops(topology))
}

/// As [`volume`], of a surface whose boundary loops are known.
pub fn volume_within(mesh: &TriMesh, loops: &[Vec<u32>]) -> f64 {
    let origin = mesh.bounds().centre().as_dvec3();
    volume_of(&mesh.triangles, loops, |v| mesh.positions[v as usize].as_dvec3() - origin)
}

/// As [`volume`], of vertices wherever `at` says they are; best near the origin.
pub fn volume_of(triangles: &[[u32; 3]], loops: &[Vec<u32>], at: impl Fn(u32) -> DVec3) -> f64 {
    let mut six = 0.0;
    for &[a, b, c] in triangles {
        six += at(a).dot(at(b).cross(at(c)));
    }
    for chain in loops {
        let middle = chain.iter().map(|&v| at(v)).sum::<DVec3>() / chain.len() as f64;
        for (i, &from) in chain.iter().enumerate() {
            let to = chain[(i + 1) % chain.len()];
            six += at(to).dot(at(from).cross(middle));
        }
    }
    six / 6.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The unit cube, outward; without its top (the last two triangles) if `open`.
    fn cube(open: bool, offset: f32) -> TriMesh {
        let positions = (0..8u32).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32) + offset);
        let quads = [[0, 2, 3, 1], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6], [4, 5, 7, 6]];
        let used = if open { &quads[..5] } else { &quads[..] };
        let triangles = used.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        TriMesh { positions: positions.collect(), triangles }
    }

    #[test]
    fn a_cube_measures_what_it_should_open_or_closed_and_anywhere() {
        for offset in [0.0, 512.0] {
            for open in [false, true] {
                let mesh = cube(open, offset);
                let found = measures(&mesh, &Topology::new(8, &mesh.triangles));
                assert!((found.area_mm2 - if open { 5.0 } else { 6.0 }).abs() < 1e-12);
                assert!((found.volume_mm3.unwrap() - 1.0).abs() < 1e-12, "{found:?}");
            }
        }
    }

    #[test]
    fn disagreeing_windings_have_no_volume() {
        let mut mesh = cube(false, 0.0);
        mesh.triangles[0].swap(0, 1);
        assert_eq!(measures(&mesh, &Topology::new(8, &mesh.triangles)).volume_mm3, None);
    }
}
