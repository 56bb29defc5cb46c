//! A coarse copy of a surface, made in one pass over it: for pictures in motion.
//!
//! Vertices in one cell of a grid become their mean, and triangles between three cells stay (Rossignac and Borrel,
//! "Multi-resolution 3D approximations for rendering complex scenes", 1993). It keeps no topology: sheets in one cell are
//! joined.

use glam::{DVec3, IVec3, Vec3};
use hashbrown::HashMap;

use super::{TriMesh, compacted, surface_area};

/// A copy of about `triangles` triangles, or of all where there are no more. Coordinates are finite.
pub fn clustered(mesh: &TriMesh, triangles: usize) -> TriMesh {
    if mesh.triangles.len() <= triangles {
        return mesh.clone();
    }
    // A plane passes 1.5 cells for each square of a cell's side in the mean, and has two triangles a vertex.
    let side = (3.0 * surface_area(mesh) / triangles.max(1) as f64).sqrt();
    let mut cells: HashMap<IVec3, u32> = HashMap::new();
    let mut sums: Vec<(DVec3, u32)> = Vec::new();
    let cell_of = |p: &Vec3| {
        let p = p.as_dvec3();
        let cell = *cells.entry((p / side).floor().as_ivec3()).or_insert(sums.len() as u32);
        if cell as usize == sums.len() {
            sums.push((DVec3::ZERO, 0));
        }
        let (sum, count) = &mut sums[cell as usize];
        (*sum, *count) = (*sum + p, *count + 1);
        cell
    };
    let cell_of: Vec<u32> = mesh.positions.iter().map(cell_of).collect();
    let positions: Vec<Vec3> = sums.iter().map(|(sum, count)| (*sum / f64::from(*count)).as_vec3()).collect();
    let cells = mesh.triangles.iter().map(|corners| corners.map(|v| cell_of[v as usize]));
    let between = cells.filter(|[a, b, c]| a != b && b != c && c != a);
    compacted(&positions, between.collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::icosphere;

    #[test]
    fn a_sphere_keeps_its_place_size_and_about_the_count() {
        let centre = Vec3::new(40.0, -7.0, 3.0);
        for size in [0.01, 1.0, 300.0] {
            let mesh = icosphere(6, 10.0 * size, centre);
            for count in [500, 5_000, 20_000] {
                let coarse = clustered(&mesh, count);
                let found = coarse.triangles.len();
                assert!((count / 2..=3 * count / 2).contains(&found), "{count}: {found}");
                // A ball of 4 pi r^2: of the mean of what is within a cell no part lies farther off than the cell is wide.
                let cell = (3.0 * 4.0 * std::f64::consts::PI * f64::from(10.0 * size).powi(2) / count as f64).sqrt();
                let off = |p: &Vec3| (f64::from(p.distance(centre)) - f64::from(10.0 * size)).abs();
                assert!(coarse.positions.iter().all(|p| off(p) < cell / 2.0), "{count}");
            }
        }
    }

    #[test]
    fn few_triangles_stay_as_they_are() {
        let mesh = icosphere(3, 10.0, Vec3::ZERO);
        assert_eq!(clustered(&mesh, mesh.triangles.len()), mesh);
        assert_eq!(clustered(&TriMesh::default(), 0), TriMesh::default());
    }
}
