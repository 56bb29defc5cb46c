//! Surfaces of known geometry, for tests.

use std::collections::{BTreeMap, HashMap};

use glam::{DVec3, Vec3};

use super::{Topology, TriMesh};

/// An icosahedron whose triangles were divided into four `level` times, all vertices at `radius` from `centre`.
pub fn icosphere(level: u32, radius: f32, centre: Vec3) -> TriMesh {
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
pub fn sagitta(sphere: &TriMesh, radius: f32, centre: Vec3) -> f32 {
    let depths = (0..sphere.triangles.len()).map(|t| {
        let [a, b, c] = sphere.corners(t);
        radius - (b - a).cross(c - a).normalize().dot(a - centre)
    });
    depths.fold(0.0, f32::max)
}

/// A square of `cells` by `cells` pairs of triangles over 0..`size` in x and y, at height `z`, facing up.
pub fn square(cells: u32, size: f32, z: f32) -> TriMesh {
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
pub fn tube(sides: u32, rings: u32, length: f32, radius: impl Fn(f32) -> f32) -> TriMesh {
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

/// A [`tube`] of one radius with a fan of triangles in both ends.
pub fn capped(sides: u32, rings: u32, length: f32, radius: f32) -> TriMesh {
    let mut mesh = tube(sides, rings, length, |_| radius);
    close_by_fans(&mut mesh);
    mesh
}

/// Closes each opening by triangles around the middle of its rim.
pub fn close_by_fans(mesh: &mut TriMesh) {
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    for rim in super::boundary_loops(&topology) {
        let middle: Vec3 = rim.iter().map(|&v| mesh.positions[v as usize]).sum::<Vec3>() / rim.len() as f32;
        mesh.positions.push(middle);
        let apex = mesh.positions.len() as u32 - 1;
        mesh.triangles.extend((0..rim.len()).map(|i| [rim[(i + 1) % rim.len()], rim[i], apex]));
    }
}

/// Several surfaces as one, in their order.
pub fn joined(meshes: &[TriMesh]) -> TriMesh {
    let mut all = TriMesh::default();
    for mesh in meshes {
        let first = all.positions.len() as u32;
        all.positions.extend(&mesh.positions);
        all.triangles.extend(mesh.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    all
}

/// The surface where `inside` is 0, over a grid of tetrahedra; `inside` is positive in it.
pub fn isosurface(low: DVec3, high: DVec3, spacing: f64, inside: impl Fn(DVec3) -> f64) -> TriMesh {
    // The six tetrahedra along the diagonal of a cube, by their corners' bits.
    const TETRAHEDRA: [[usize; 4]; 6] =
        [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];
    let counts = ((high - low) / spacing).ceil().as_ivec3() + 1;
    let at = |i: usize| {
        let (x, y) = (i % counts.x as usize, i / counts.x as usize % counts.y as usize);
        let z = i / (counts.x * counts.y) as usize;
        low + DVec3::new(x as f64, y as f64, z as f64) * spacing
    };
    let number = |x: i32, y: i32, z: i32| ((z * counts.y + y) * counts.x + x) as usize;
    let values: Vec<f64> = (0..(counts.x * counts.y * counts.z) as usize).map(|i| inside(at(i)) + 1e-9).collect();
    let mut vertices: HashMap<(usize, usize), u32> = HashMap::new();
    let mut mesh = TriMesh::default();
    for z in 0..counts.z - 1 {
        for y in 0..counts.y - 1 {
            for x in 0..counts.x - 1 {
                let corner =
                    |bits: usize| number(x + (bits & 1) as i32, y + (bits >> 1 & 1) as i32, z + (bits >> 2 & 1) as i32);
                for tetrahedron in TETRAHEDRA {
                    let corners = tetrahedron.map(corner);
                    let (within, without): (Vec<usize>, Vec<usize>) =
                        corners.into_iter().partition(|&c| values[c] > 0.0);
                    let mut cut = |a: usize, b: usize| {
                        *vertices.entry((a.min(b), a.max(b))).or_insert_with(|| {
                            let part = values[a] / (values[a] - values[b]);
                            mesh.positions.push(at(a).lerp(at(b), part).as_vec3());
                            mesh.positions.len() as u32 - 1
                        })
                    };
                    let polygon: Vec<u32> = match (&within[..], &without[..]) {
                        ([a], [b, c, d]) | ([b, c, d], [a]) => vec![cut(*a, *b), cut(*a, *c), cut(*a, *d)],
                        ([a, b], [c, d]) => vec![cut(*a, *c), cut(*a, *d), cut(*b, *d), cut(*b, *c)],
                        _ => continue,
                    };
                    let outward = without.iter().map(|&c| at(c)).sum::<DVec3>() / without.len() as f64
                        - within.iter().map(|&c| at(c)).sum::<DVec3>() / within.len() as f64;
                    for i in 1..polygon.len() - 1 {
                        let [a, b, c] = [polygon[0], polygon[i], polygon[i + 1]];
                        let [p, q, r] = [a, b, c].map(|v| mesh.positions[v as usize]);
                        let is_right = (q - p).cross(r - p).as_dvec3().dot(outward) > 0.0;
                        mesh.triangles.push(if is_right { [a, b, c] } else { [a, c, b] });
                    }
                }
            }
        }
    }
    mesh
}

/// How deep a point lies in the capsule about a segment.
pub fn in_capsule(p: DVec3, a: DVec3, b: DVec3, radius: f64) -> f64 {
    let part = ((p - a).dot(b - a) / a.distance_squared(b)).clamp(0.0, 1.0);
    radius - p.distance(a.lerp(b, part))
}

/// Two branches of 3 and 2 mm radius that leave a trunk of 4 mm at 40 degrees, all with round ends.
pub fn fork() -> (TriMesh, [DVec3; 4]) {
    let (sin, cos) = libm::sincos(40.0f64.to_radians());
    let ends = [DVec3::ZERO, DVec3::Z * 40.0, DVec3::new(sin, 0.0, cos) * 40.0, DVec3::new(-sin, 0.0, cos) * 40.0];
    let [joint, _, left, right] = [ends[0] + DVec3::Z * 40.0, ends[0], ends[2], ends[3]];
    let (left, right) = (joint + left, joint + right);
    let inside = |p: DVec3| {
        let trunk = in_capsule(p, DVec3::ZERO, joint, 4.0);
        trunk.max(in_capsule(p, joint, left, 3.0)).max(in_capsule(p, joint, right, 2.0))
    };
    let (low, high) = (DVec3::new(-32.0, -5.0, -5.0), DVec3::new(32.0, 5.0, 78.0));
    (isosurface(low, high, 0.5, inside), [DVec3::ZERO, joint, left, right])
}

/// A trunk along z with a branch half as wide that leaves it half-way by 60 degrees towards x, all with round ends; and where
/// the axis of the branch ends. The trunk's begins at the origin; all lengths in mm.
pub fn parted(radius: f64, length: f64, branch_length: f64, cell: f64) -> (TriMesh, DVec3) {
    let (sin, cos) = libm::sincos(60.0f64.to_radians());
    let joint = DVec3::Z * length / 2.0;
    let end = joint + DVec3::new(sin, 0.0, cos) * branch_length;
    let inside = |p: DVec3| {
        let trunk = in_capsule(p, DVec3::ZERO, DVec3::Z * length, radius);
        trunk.max(in_capsule(p, joint, end, radius / 2.0))
    };
    let out = radius + 1.0;
    let high = DVec3::new(end.x + radius / 2.0 + 1.0, out, length + out);
    (isosurface(DVec3::splat(-out), high, cell, inside), end)
}

/// Whether the triangles around every vertex form one fan.
pub fn vertices_are_manifold(mesh: &TriMesh, topology: &Topology) -> bool {
    (0..mesh.positions.len() as u32).all(|v| {
        let around = topology.triangles(v);
        let links = around.iter().map(|&t| {
            let [a, b, c] = mesh.triangles[t as usize];
            if a == v {
                (b, c)
            } else if b == v {
                (c, a)
            } else {
                (a, b)
            }
        });
        let links: Vec<(u32, u32)> = links.collect();
        let starts = links.iter().filter(|(a, _)| !links.iter().any(|(_, b)| a == b)).count();
        // One chain, or one cycle: walk it.
        let first = links.iter().position(|(a, _)| !links.iter().any(|(_, b)| a == b)).unwrap_or(0);
        let (mut seen, mut at) = (1, links[first].1);
        while seen < links.len() && at != links[first].0 {
            let Some(next) = links.iter().find(|(a, _)| *a == at) else { break };
            (at, seen) = (next.1, seen + 1);
        }
        starts <= 1 && seen == links.len()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Topology;

    #[test]
    fn a_tube_is_open_at_both_ends_and_faces_outwards() {
        let mesh = tube(12, 5, 10.0, |_| 2.0);
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let edges = topology.edge_counts();
        assert_eq!((edges.boundary, edges.non_manifold, edges.flipped), (24, 0, 0));
        assert!(crate::volume(&mesh, &topology) > 0.0);
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
