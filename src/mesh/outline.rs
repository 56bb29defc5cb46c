//! The outline of a surface in a plane: where its triangles cross it.
//!
//! A vertex that lies in the plane counts as above it, so that each triangle crosses it once or not at all, and the crossing
//! of an edge is computed from its lower vertex: triangles that share an edge end in the same point, and the outline of a
//! closed surface is closed.

use glam::{DVec3, Vec3};

/// The pieces of the outline of `triangles` in the plane through `point` (mm) across `normal`, in the triangles' order; none
/// where the normal has no length.
pub fn outline(positions: &[Vec3], triangles: &[[u32; 3]], point: Vec3, normal: Vec3) -> Vec<[Vec3; 2]> {
    let (point, normal) = (point.as_dvec3(), normal.as_dvec3().normalize_or_zero());
    let at = |v: u32| positions[v as usize].as_dvec3();
    let height = |v: u32| (at(v) - point).dot(normal);
    let crossing = |a: u32, b: u32| -> Vec3 {
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        let (below, above) = (height(low), height(high));
        DVec3::lerp(at(low), at(high), below / (below - above)).as_vec3()
    };
    let mut pieces = Vec::new();
    for &[a, b, c] in triangles {
        let above = [a, b, c].map(|v| height(v) >= 0.0);
        // The corner that lies alone on its side, then the other two in their order.
        let [alone, next, last] = match above {
            [x, y, z] if x == y && y == z => continue,
            [x, y, z] if y == z && x != y => [a, b, c],
            [x, _, z] if x == z => [b, c, a],
            _ => [c, a, b],
        };
        pieces.push([crossing(alone, next), crossing(alone, last)]);
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::icosphere;

    #[test]
    fn a_sphere_is_cut_in_a_closed_circle() {
        let centre = Vec3::new(3.0, -2.0, 100.0);
        let sphere = icosphere(4, 10.0, centre);
        let normal = Vec3::new(1.0, 2.0, -2.0) / 3.0;
        let pieces = outline(&sphere.positions, &sphere.triangles, centre + 6.0 * normal, normal * 7.0);
        let length: f32 = pieces.iter().map(|[a, b]| a.distance(*b)).sum();
        // A circle of 8 mm.
        assert!((length / (16.0 * std::f32::consts::PI) - 1.0).abs() < 0.01, "{length}");
        let mut ends: Vec<[u32; 3]> = pieces.as_flattened().iter().map(|p| p.to_array().map(f32::to_bits)).collect();
        for p in pieces.as_flattened() {
            assert!(((*p - centre).dot(normal) - 6.0).abs() < 1e-4, "in the plane");
            assert!((p.distance(centre) - 10.0).abs() < 0.05, "on the sphere");
        }
        ends.sort_unstable();
        assert!(ends.chunks(2).all(|pair| pair[0] == pair[1]), "each end is another's beginning");
    }

    #[test]
    fn a_plane_through_vertices_cuts_each_triangle_once() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::new(0.0, 1.0, 1.0), Vec3::new(0.0, 1.0, -1.0)];
        // The first two lie in the plane: only the triangle below it crosses, along them.
        let pieces = outline(&positions, &[[0, 1, 2], [1, 0, 3]], Vec3::ZERO, Vec3::Z);
        assert_eq!(pieces.len(), 1);
        assert!(pieces[0].contains(&Vec3::ZERO) && pieces[0].contains(&Vec3::X));
        assert!(outline(&positions, &[[0, 1, 2]], Vec3::ZERO, Vec3::ZERO).is_empty());
    }
}
