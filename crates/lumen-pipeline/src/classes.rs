//! The five vertex classes of Schroeder, Zarge and Lorensen, "Decimation of triangle meshes" (1992), section 3.1 (the
//! paper's Figure 3), at any level of a progressive mesh.
//!
//! A vertex whose triangles form no single disc or half-disc is *complex*; at the end of a half-disc lies a *boundary*
//! vertex. Within the surface the feature edges that meet count: none at a *simple* vertex, two at an *interior edge*
//! vertex, one or more than two at a *corner*. [`Class::of`] is the rule by which decimation itself goes.
//!
//! Feature edges are found once, on the surface that enters decimation, and inherited: a collapse takes the edges of the
//! vertex that goes to the one that takes over. So those of a level are the images of the first under
//! [`ProgressiveMesh::heirs`], and so are the boundary's; complex vertices never go.

pub use super::lines::Lines;
use super::progressive::ProgressiveMesh;
use lumen_mesh::used_vertices;
use lumen_message::messages;

messages! {
    /// The class of a vertex. Its words are its name.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Class {
        /// Within the surface, on no feature edge.
        "views-class-simple" Simple => "Simple",
        /// The surface is no disc there: the vertex stays.
        "views-class-complex" Complex => "Complex",
        /// At an open end.
        "views-class-boundary" Boundary => "Boundary",
        /// On a feature edge.
        "views-class-interior-edge" InteriorEdge => "Interior edge",
        /// Where feature edges meet or end.
        "views-class-corner" Corner => "Corner",
    }
}

impl Class {
    /// All five, in the paper's order.
    pub const ALL: [Self; 5] = [Self::Simple, Self::Complex, Self::Boundary, Self::InteriorEdge, Self::Corner];

    /// The class of a vertex at which `features` feature edges meet.
    pub fn of(is_complex: bool, is_open: bool, features: usize) -> Self {
        match (is_complex, is_open, features) {
            (true, ..) => Self::Complex,
            (_, true, _) => Self::Boundary,
            (.., 0) => Self::Simple,
            (.., 2) => Self::InteriorEdge,
            _ => Self::Corner,
        }
    }
}

/// The classes of a level's vertices.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Classes {
    /// The class of each node that the level uses; `None` for the others.
    pub by_node: Vec<Option<Class>>,
    /// How many there are of each, in the order of [`Class::ALL`].
    pub counts: [usize; 5],
    /// The level's own lines.
    pub lines: Lines,
}

impl Classes {
    /// Of the level after `steps` steps, whose triangles over the nodes are `triangles`. Linear in both, but for the sorting
    /// of the lines.
    pub fn new(levels: &ProgressiveMesh, steps: u32, triangles: &[[u32; 3]]) -> Self {
        let heirs = levels.heirs(steps);
        let lines = levels.lines.mapped(|node| heirs[node as usize]);
        let nodes = levels.positions.len();
        let mut features = vec![0usize; nodes];
        lines.features.as_flattened().iter().for_each(|&node| features[node as usize] += 1);
        let (mut is_open, mut is_complex) = (vec![false; nodes], vec![false; nodes]);
        lines.boundary.as_flattened().iter().for_each(|&node| is_open[node as usize] = true);
        lines.complex.iter().for_each(|&node| is_complex[node as usize] = true);
        let (mut by_node, mut counts) = (vec![None; nodes], [0; 5]);
        for node in used_vertices(nodes, triangles).into_iter().map(|node| node as usize) {
            let class = Class::of(is_complex[node], is_open[node], features[node]);
            by_node[node] = Some(class);
            counts[class as usize] += 1;
        }
        Self { by_node, counts, lines }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use glam::Vec3;

    use super::*;
    use crate::decimation::decimate;
    use crate::settings::{Decimation, Method};
    use lumen_mesh::shapes::{joined, square, tube};
    use lumen_mesh::{Topology, TriMesh};

    fn levels_of(mesh: &TriMesh, method: Method) -> ProgressiveMesh {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        decimate(mesh, &topology, &Decimation { method, ..Decimation::default() })
    }

    fn classes(levels: &ProgressiveMesh, steps: u32) -> Classes {
        Classes::new(levels, steps, &levels.triangles_at(steps))
    }

    /// The surface of a cube of `n` cells a side: vertices of equal place are one.
    fn cube(n: u32) -> TriMesh {
        let face = square(n, 1.0, 0.0);
        let sides: [fn(Vec3) -> Vec3; 6] = [
            |p| Vec3::new(p.y, p.x, 0.0),
            |p| Vec3::new(p.x, p.y, 1.0),
            |p| Vec3::new(p.x, 0.0, p.y),
            |p| Vec3::new(p.y, 1.0, p.x),
            |p| Vec3::new(0.0, p.y, p.x),
            |p| Vec3::new(1.0, p.x, p.y),
        ];
        let mut mesh = TriMesh::default();
        let mut places: BTreeMap<[i32; 3], u32> = BTreeMap::new();
        for side in sides {
            let corner = |p: &Vec3| {
                let at = side(*p);
                let place = (at * n as f32).round().as_ivec3().to_array();
                (place, at)
            };
            let numbers: Vec<u32> = face
                .positions
                .iter()
                .map(|p| {
                    let (place, at) = corner(p);
                    *places.entry(place).or_insert_with(|| {
                        mesh.positions.push(at);
                        mesh.positions.len() as u32 - 1
                    })
                })
                .collect();
            mesh.triangles.extend(face.triangles.iter().map(|t| t.map(|v| numbers[v as usize])));
        }
        mesh
    }

    #[test]
    fn a_box_has_eight_corners_and_twelve_edges_at_every_level() {
        const N: usize = 6;
        let mesh = cube(N as u32);
        assert!(mesh.positions.len() == 6 * N * N + 2, "closed: Euler's formula");
        let levels = levels_of(&mesh, Method::Schroeder);
        let found = classes(&levels, 0);
        let on_edges = 12 * (N - 1);
        assert_eq!(found.counts, [mesh.positions.len() - 8 - on_edges, 0, 0, on_edges, 8]);
        assert_eq!(found.lines.features.len(), 12 * N);
        for (class, position) in found.by_node.iter().zip(&levels.positions) {
            // On how many of the three pairs of sides it lies says what it is.
            let sides = position.to_array().iter().filter(|x| **x == 0.0 || **x == 1.0).count();
            let expected = [Class::Simple, Class::Simple, Class::InteriorEdge, Class::Corner][sides];
            assert_eq!(*class, Some(expected), "{position}");
        }
        // Flat faces and straight edges cost nothing and go first: what is left is the box.
        let flat = levels.steps_to(12);
        let found = classes(&levels, flat);
        assert_eq!((found.counts, found.lines.features.len()), ([0, 0, 0, 0, 8], 12));
    }

    #[test]
    fn an_open_tube_has_two_boundary_loops_at_every_level() {
        let mesh = tube(24, 20, 20.0, |_| 3.0);
        for method in Method::ALL {
            let levels = levels_of(&mesh, method);
            let last = levels.errors.len() as u32;
            for steps in [0, last / 4, last / 2, last - last / 10, last] {
                let triangles = levels.triangles_at(steps);
                let found = classes(&levels, steps);
                let vertices = used_vertices(levels.positions.len(), &triangles).len();
                assert_eq!(found.counts.iter().sum::<usize>(), vertices, "{method:?} after {steps}");
                // As many edges as vertices, and each a side of one triangle: closed loops.
                assert_eq!(found.lines.boundary.len(), found.counts[Class::Boundary as usize]);
                let topology = Topology::new(levels.positions.len(), &triangles);
                let open: Vec<[u32; 2]> = topology
                    .edges()
                    .filter(|(.., uses)| uses.is_boundary())
                    .map(|(a, b, _)| [a.min(b), a.max(b)])
                    .collect();
                let mut open = open;
                open.sort_unstable();
                assert_eq!(open, found.lines.boundary, "{method:?} after {steps}");
                let low =
                    found.lines.boundary.iter().filter(|ends| levels.positions[ends[0] as usize].z < 10.0).count();
                assert!(low >= 3 && found.lines.boundary.len() - low >= 3, "both ends are open");
            }
        }
        assert_eq!(classes(&levels_of(&mesh, Method::Schroeder), 0).counts, [24 * 19, 0, 48, 0, 0]);
    }

    #[test]
    fn where_three_sheets_meet_in_a_spine_vertices_are_complex() {
        // Three squares that share the side x = 0.
        let leaf = |turn: f64| {
            let mut leaf = square(5, 10.0, 0.0);
            let (sin, cos) = (libm::sin(turn) as f32, libm::cos(turn) as f32);
            leaf.positions.iter_mut().for_each(|p| *p = Vec3::new(p.x * cos, p.y, p.x * sin));
            leaf
        };
        let book = joined(&[leaf(0.0), leaf(2.0), leaf(4.0)]);
        // The spine's vertices of the second and third leaf are those of the first.
        let number = |v: u32| if (v % 36).is_multiple_of(6) { v % 36 } else { v };
        let triangles: Vec<[u32; 3]> = book.triangles.iter().map(|t| t.map(number)).collect();
        let mesh = lumen_mesh::compacted(&book.positions, triangles);
        assert_eq!(mesh.positions.len(), 3 * 36 - 2 * 6);
        let levels = levels_of(&mesh, Method::Schroeder);
        for steps in [0, levels.errors.len() as u32] {
            let found = classes(&levels, steps);
            assert_eq!(found.counts[Class::Complex as usize], 6, "the whole spine, after {steps}");
            assert!(found.lines.complex.iter().all(|&node| levels.positions[node as usize].x == 0.0));
        }
        // Each leaf has three open sides: 14 vertices off the spine.
        assert_eq!(classes(&levels, 0).counts, [3 * 16, 6, 3 * 14, 0, 0]);
    }

    #[test]
    fn a_crease_that_ends_makes_corners() {
        assert_eq!([0, 1, 2, 3, 4].map(|n| Class::of(false, false, n)), {
            use Class::{Corner, InteriorEdge, Simple};
            [Simple, Corner, InteriorEdge, Corner, Corner]
        });
        assert_eq!([Class::of(true, true, 2), Class::of(false, true, 2)], [Class::Complex, Class::Boundary]);
    }
}
