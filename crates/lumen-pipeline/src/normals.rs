//! Vertex normals: the mean of the normals of the triangles around a vertex, weighted by area or by angle.
//!
//! Area: the cross product of two edges is the normal times the doubled area, so the sum is weighted as it stands; the
//! cheaper of the two, and the default. Angle: Thürmer and Wüthrich, "Computing vertex normals from polygonal facets"
//! (1998): each normal counts by the angle its triangle has at the vertex, which does not
//! depend on how the facets around it were cut into triangles.
//!
//! Triangles add to their corners in the order of the list. That order is part of the result: work on several threads
//! has to be parted by vertices, not by triangles.

use glam::Vec3;

/// How much the normal of a triangle counts at its corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Weighting {
    /// By the triangle's area.
    #[default]
    Area,
    /// By its angle at the corner.
    Angle,
}

/// Unit normals of all vertices, pointing to the side from which the triangles wind counter-clockwise. A vertex
/// without triangles, or whose triangles' normals cancel or do not exist, has the zero vector.
///
/// # Panics
/// When an index of a triangle is out of range.
pub fn vertex_normals(positions: &[Vec3], triangles: &[[u32; 3]], weighting: Weighting) -> Vec<Vec3> {
    let mut normals = Vec::new();
    vertex_normals_into(&mut normals, positions, triangles, weighting);
    normals
}

/// [`vertex_normals`] into a buffer that is kept from call to call; what it held is gone.
///
/// # Panics
/// When an index of a triangle is out of range.
pub fn vertex_normals_into(normals: &mut Vec<Vec3>, positions: &[Vec3], triangles: &[[u32; 3]], weighting: Weighting) {
    normals.clear();
    normals.resize(positions.len(), Vec3::ZERO);
    match weighting {
        Weighting::Area => add_by_area(normals, positions, triangles),
        Weighting::Angle => add_by_angle(normals, positions, triangles),
    }
    for normal in normals {
        if *normal != Vec3::ZERO {
            *normal = unit(*normal);
        }
    }
}

fn add_by_area(sums: &mut [Vec3], positions: &[Vec3], triangles: &[[u32; 3]]) {
    for &triangle in triangles {
        let [a, b, c] = triangle.map(|v| positions[v as usize]);
        let normal = (b - a).cross(c - a);
        for v in triangle {
            sums[v as usize] += normal;
        }
    }
}

fn add_by_angle(sums: &mut [Vec3], positions: &[Vec3], triangles: &[[u32; 3]]) {
    for &triangle in triangles {
        let [a, b, c] = triangle.map(|v| positions[v as usize].as_dvec3());
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let normal = ca.cross(ab);
        // Twice the area: at each corner the sine of the angle times the lengths of the edges that meet there. The dot
        // product is the cosine times the same two; unlike the arc cosine, their quotient is accurate at any angle.
        let area = normal.length();
        if !(area > 0.0 && area.is_finite()) {
            continue;
        }
        let normal = (normal / area).as_vec3();
        for (v, cosine) in triangle.into_iter().zip([-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)]) {
            sums[v as usize] += normal * libm::atan2(area, cosine) as f32;
        }
    }
}

/// The direction of `v`; zero where it has none.
#[inline]
fn unit(v: Vec3) -> Vec3 {
    let squared = v.length_squared();
    // Outside this range the square has lost digits or overflowed in f32.
    if squared > 1e-30 && squared < 1e30 {
        return v / squared.sqrt();
    }
    let wide = v.as_dvec3();
    let length = wide.length();
    if length > 0.0 && length.is_finite() { (wide / length).as_vec3() } else { Vec3::ZERO }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::TriMesh;
    use lumen_mesh::shapes::icosphere;

    const BOTH: [Weighting; 2] = [Weighting::Area, Weighting::Angle];

    fn of(mesh: &TriMesh, weighting: Weighting) -> Vec<Vec3> {
        vertex_normals(&mesh.positions, &mesh.triangles, weighting)
    }

    #[test]
    fn on_a_sphere_they_point_away_from_the_centre() {
        let centre = Vec3::new(30.0, -20.0, 10.0);
        let sphere = icosphere(4, 15.0, centre);
        for weighting in BOTH {
            for (normal, p) in of(&sphere, weighting).iter().zip(&sphere.positions) {
                assert!((normal.length() - 1.0).abs() < 1e-6);
                assert!(normal.dot((p - centre).normalize()) > 0.01f32.cos(), "{weighting:?} at {p}");
            }
        }
    }

    #[test]
    fn on_a_tube_they_point_away_from_the_axis() {
        let (sides, rings, radius) = (96u32, 20u32, 4.0f32);
        let positions = (0..sides * rings).map(|i| {
            let angle = f64::from(i % sides) / f64::from(sides) * std::f64::consts::TAU;
            Vec3::new(radius * angle.cos() as f32, radius * angle.sin() as f32, (i / sides) as f32)
        });
        let triangles = (0..sides * (rings - 1)).flat_map(|i| {
            let next = i / sides * sides + (i + 1) % sides;
            [[i, next, next + sides], [i, next + sides, i + sides]]
        });
        let tube = TriMesh { positions: positions.collect(), triangles: triangles.collect() };
        for weighting in BOTH {
            for (i, normal) in of(&tube, weighting).into_iter().enumerate() {
                let p = tube.positions[i];
                // Area weighting leans half a side at the open ends, where a vertex has one triangle on one side and
                // two on the other.
                assert!(normal.dot(Vec3::new(p.x, p.y, 0.0) / radius) > 0.04f32.cos(), "{weighting:?} at {p}");
                assert!(normal.z.abs() < 1e-5);
            }
        }
    }

    /// Three unit squares that meet in the origin, facing away from the positive octant's inside. The faces named in
    /// `from_corner` are cut along the diagonal that ends in the origin, the others along the one that does not.
    fn corner_of_a_cube(from_corner: [bool; 3]) -> TriMesh {
        let positions = (0..8).map(|i| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32)).collect();
        let quads = [[0, 2, 3, 1], [0, 1, 5, 4], [0, 4, 6, 2]];
        let triangles = quads
            .iter()
            .zip(from_corner)
            .flat_map(|(&[a, b, c, d], cut)| if cut { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        TriMesh { positions, triangles: triangles.collect() }
    }

    #[test]
    fn by_angle_a_corner_does_not_depend_on_how_its_faces_are_cut() {
        let expected = -Vec3::ONE / 3f32.sqrt();
        for cuts in 0..8 {
            let mesh = corner_of_a_cube([cuts & 1 != 0, cuts & 2 != 0, cuts & 4 != 0]);
            assert!(of(&mesh, Weighting::Angle)[0].distance(expected) < 1e-6, "{cuts:03b}");
        }
    }

    #[test]
    fn by_area_a_corner_is_the_sum_of_the_areas_that_touch_it() {
        for cuts in 0..8 {
            let cut = [cuts & 1 != 0, cuts & 2 != 0, cuts & 4 != 0];
            let area = cut.map(|both| if both { 1.0 } else { 0.5 });
            // The faces look down -z, -y and -x, in this order.
            let expected = -Vec3::new(area[2], area[1], area[0]).normalize();
            assert!(of(&corner_of_a_cube(cut), Weighting::Area)[0].distance(expected) < 1e-6, "{cuts:03b}");
        }
    }

    #[test]
    fn a_bend_of_two_planes_is_weighted_by_the_angles() {
        // At the origin: 60 degrees of the plane that faces z, and 90 of the one that faces x.
        let positions = [Vec3::ZERO, Vec3::Y, Vec3::new(-(3f32.sqrt()) / 2.0, 0.5, 0.0), Vec3::new(0.0, 0.0, -5.0)];
        let triangles = [[0, 1, 2], [0, 3, 1]];
        let expected = Vec3::new(90.0, 0.0, 60.0).normalize();
        assert!(vertex_normals(&positions, &triangles, Weighting::Angle)[0].distance(expected) < 1e-6);
    }

    #[test]
    fn unused_vertices_and_degenerate_triangles_have_none() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::Y, Vec3::Z, Vec3::splat(f32::NAN), Vec3::MAX];
        for weighting in BOTH {
            let degenerate = vertex_normals(&positions, &[[0, 1, 2], [0, 0, 3], [1, 1, 1]], weighting);
            assert_eq!(degenerate, [Vec3::ZERO; 7]);
            let broken = vertex_normals(&positions, &[[0, 1, 5], [0, 6, 3]], weighting);
            assert!(broken.iter().all(|n| *n == Vec3::ZERO || (n.length() - 1.0).abs() < 1e-6), "{broken:?}");
            let opposed = vertex_normals(&positions, &[[0, 1, 3], [3, 1, 0]], weighting);
            assert_eq!(opposed, [Vec3::ZERO; 7]);
            assert!(vertex_normals(&[], &[], weighting).is_empty());
        }
    }

    #[test]
    fn a_surface_in_any_unit_has_the_same_normals() {
        let sphere = icosphere(2, 1.0, Vec3::ZERO);
        for weighting in BOTH {
            let expected = of(&sphere, weighting);
            for scale in [1e-9f32, 1e9] {
                let scaled: Vec<Vec3> = sphere.positions.iter().map(|p| p * scale).collect();
                let found = vertex_normals(&scaled, &sphere.triangles, weighting);
                assert!(found.iter().zip(&expected).all(|(a, b)| a.distance(*b) < 1e-5), "{weighting:?} at {scale}");
            }
        }
    }

    #[test]
    fn a_kept_buffer_holds_nothing_of_the_last_call() {
        let (large, small) = (icosphere(2, 1.0, Vec3::ZERO), icosphere(1, 1.0, Vec3::ZERO));
        for weighting in BOTH {
            let mut buffer = of(&large, weighting);
            vertex_normals_into(&mut buffer, &small.positions, &small.triangles, weighting);
            assert_eq!(buffer, of(&small, weighting));
        }
    }
}
