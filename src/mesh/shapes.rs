//! Surfaces of known geometry, for tests.

use std::collections::BTreeMap;

use glam::Vec3;

use super::TriMesh;

/// An icosahedron whose triangles were divided into four `level` times, all vertices at `radius` from `centre`.
pub(crate) fn icosphere(level: u32, radius: f32, centre: Vec3) -> TriMesh {
    let g = f32::midpoint(1.0, 5f32.sqrt());
    let mut positions: Vec<Vec3> = [(0.0, 1.0, g), (0.0, -1.0, g), (0.0, 1.0, -g), (0.0, -1.0, -g)]
        .iter()
        .flat_map(|&(x, y, z)| [Vec3::new(x, y, z), Vec3::new(y, z, x), Vec3::new(z, x, y)])
        .collect();
    let edge = 2.0;
    let mut triangles = Vec::new();
    for a in 0..12u32 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(|v| positions[v as usize]);
                if [p.distance(q), q.distance(r), r.distance(p)].iter().all(|length| (length - edge).abs() < 1e-3) {
                    let outward = (q - p).cross(r - p).dot(p) > 0.0;
                    triangles.push(if outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    for _ in 0..level {
        let mut middles = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                positions.push(positions[a as usize].normalize() + positions[b as usize].normalize());
                positions.len() as u32 - 1
            })
        };
        triangles = triangles
            .iter()
            .flat_map(|&[a, b, c]| {
                let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    let positions =
        positions.iter().map(|p| (p.as_dvec3().normalize() * f64::from(radius)).as_vec3() + centre).collect();
    TriMesh { positions, triangles }
}

/// How far the triangles of an inscribed sphere lie below it at most: `radius` less the least distance of a triangle's
/// plane from the centre, in mm.
pub(crate) fn sagitta(sphere: &TriMesh, radius: f32, centre: Vec3) -> f32 {
    let depths = (0..sphere.triangles.len()).map(|t| {
        let [a, b, c] = sphere.corners(t);
        radius - (b - a).cross(c - a).normalize().dot(a - centre)
    });
    depths.fold(0.0, f32::max)
}

/// A square of `cells` by `cells` pairs of triangles over 0..`size` in x and y, at height `z`, facing up.
pub(crate) fn square(cells: u32, size: f32, z: f32) -> TriMesh {
    let row = cells + 1;
    let at = |i: u32| i as f32 * size / cells as f32;
    let positions = (0..row * row).map(|i| Vec3::new(at(i % row), at(i / row), z)).collect();
    let triangles = (0..cells * cells)
        .flat_map(|i| {
            let corner = i / cells * row + i % cells;
            [[corner, corner + 1, corner + row + 1], [corner, corner + row + 1, corner + row]]
        })
        .collect();
    TriMesh { positions, triangles }
}

/// An open tube along z from 0 to `length`, `sides` around and `rings` cells long, whose radius at z is `radius(z)`.
pub(crate) fn tube(sides: u32, rings: u32, length: f32, radius: impl Fn(f32) -> f32) -> TriMesh {
    let mut positions = Vec::new();
    for ring in 0..=rings {
        let z = ring as f32 * length / rings as f32;
        for side in 0..sides {
            // Every other ring is turned by half a side, so that no two walls are the same.
            let angle = (f64::from(side) + f64::from(ring % 2) / 2.0) / f64::from(sides) * std::f64::consts::TAU;
            let (x, y) = (libm::cos(angle) as f32, libm::sin(angle) as f32);
            positions.push(Vec3::new(x * radius(z), y * radius(z), z));
        }
    }
    let at = |ring: u32, side: u32| ring * sides + side % sides;
    let mut triangles = Vec::new();
    for ring in 0..rings {
        for side in 0..sides {
            let (a, b) = (at(ring, side), at(ring, side + 1));
            let (c, d) = (at(ring + 1, side), at(ring + 1, side + 1));
            if ring % 2 == 0 {
                triangles.extend([[a, b, c], [b, d, c]]);
            } else {
                triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
    TriMesh { positions, triangles }
}

/// Several surfaces as one, in their order.
pub(crate) fn joined(meshes: &[TriMesh]) -> TriMesh {
    let mut all = TriMesh::default();
    for mesh in meshes {
        let first = all.positions.len() as u32;
        all.positions.extend(&mesh.positions);
        all.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Topology;

    #[test]
    fn a_tube_is_open_at_both_ends_and_faces_outwards() {
        let mesh = tube(12, 5, 10.0, |_| 2.0);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let edges = topology.edge_counts();
        assert_eq!((edges.boundary, edges.non_manifold, edges.flipped), (24, 0, 0));
        assert!(crate::mesh::volume(&mesh, &topology) > 0.0);
    }

    #[test]
    fn an_icosphere_is_closed_and_round() {
        let sphere = icosphere(3, 10.0, Vec3::ONE);
        assert_eq!((sphere.positions.len(), sphere.triangles.len()), (642, 1280));
        let edges = Topology::new(642, &sphere.triangles).edge_counts();
        assert_eq!((edges.edges, edges.boundary, edges.non_manifold, edges.flipped), (1920, 0, 0, 0));
        assert!(sagitta(&sphere, 10.0, Vec3::ONE) < 0.08);
    }
}
