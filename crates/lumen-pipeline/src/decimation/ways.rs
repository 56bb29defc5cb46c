//! Where a vertex of a level could go, and what forbids it: the run's own checks, on the triangles around it.
//!
//! Topology is that of `rings.rs` (the link condition), shape that of `one_ring.rs` under the limits of `collapse.rs`. Both need
//! no more than the vertex, its neighbours and theirs. Whether triangles would cross is decided by the whole surface, and is
//! not looked at here; nor is shape for quadrics, whose places rest on planes that only the run knew.

use super::collapse::STRICTNESS;
use super::method::Method as _;
use super::one_ring::{MAX_AROUND, OneRing};
use super::rings::{Rings, neighbour};
use super::schroeder::Schroeder;
use crate::classes::{Class, Classes};
use crate::progressive::ProgressiveMesh;
use crate::settings::Method;
use lumen_mesh::{Topology, TriMesh, used_vertices};

/// What becomes of one way for a vertex to go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CollapseStatus {
    /// Nothing that is looked at forbids it.
    Open,
    /// As [`CollapseStatus::Open`], under limits that have been eased: the vertex waits for that.
    Eased,
    /// A boundary vertex goes along its open end, one on a feature edge along that.
    OffLine,
    /// The topology would change: the link condition, or an open end of fewer than three edges.
    Link,
    /// A triangle would turn over.
    Flip,
    /// A triangle would become a sliver.
    Sliver,
}

/// Where a vertex could go.
#[derive(Clone, Debug, PartialEq)]
pub struct Ways {
    /// Its class.
    pub class: Class,
    /// Its neighbours, in order around it, and what becomes of the way there; none where it stays by rule: a complex
    /// vertex, or one with too many triangles.
    pub to: Vec<(u32, CollapseStatus)>,
}

impl Ways {
    /// Of `node` on a level with `triangles` and `classes`; `None` where the level does not use it.
    pub fn new(
        levels: &ProgressiveMesh,
        triangles: &[[u32; 3]],
        classes: &Classes,
        node: u32,
        method: Method,
    ) -> Option<Self> {
        let class = (*classes.by_node.get(node as usize)?)?;
        let (mesh, nodes) = around(levels, triangles, node);
        let number = |node: u32| nodes.binary_search(&node).ok().map(|number| number as u32);
        let v = number(node)?;
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let mut rings = Rings::new(&mesh);
        rings.link(&mesh, &topology, mesh.positions.len());
        let slot = (0..rings.len() as u32).find(|&slot| rings.nodes[slot as usize] == v && !rings.is_gone(slot))?;
        if class == Class::Complex || rings.stays(slot) || rings.around(slot).len() > MAX_AROUND {
            return Some(Self { class, to: Vec::new() });
        }
        let mut star = OneRing::new();
        star.load(&rings, slot);
        star.span();
        let last = star.entries().len() - 1;
        let fate = |j: usize| {
            let u = neighbour(star.entries()[j]);
            let other = nodes[rings.nodes[u as usize] as usize];
            let ends = [node.min(other), node.max(other)];
            let is_along = match class {
                Class::Boundary => j == 0 || j == last,
                Class::InteriorEdge => {
                    method != Method::Schroeder || classes.lines.features.binary_search(&ends).is_ok()
                }
                Class::Simple | Class::Corner | Class::Complex => true,
            };
            let fate = if !is_along {
                CollapseStatus::OffLine
            } else if !rings.may_collapse(slot, u) {
                CollapseStatus::Link
            } else if method == Method::Schroeder {
                shape(&star, j)
            } else {
                CollapseStatus::Open
            };
            (other, fate)
        };
        Some(Self { class, to: (0..=last).map(fate).collect() })
    }
}

/// The first limits that the triangles keep when the vertex goes to neighbour `j`.
fn shape(star: &OneRing, j: usize) -> CollapseStatus {
    let keeps = |turn: f32, quality: f32| star.worst_after(star.edge(j), j, turn, quality).is_some();
    let eased = &STRICTNESS[1..];
    if keeps(STRICTNESS[0].turn, Schroeder::default().fair_quality()) {
        CollapseStatus::Open
    } else if eased.iter().any(|limits| keeps(limits.turn, limits.quality)) {
        CollapseStatus::Eased
    } else if eased.last().is_some_and(|limits| keeps(limits.turn, 0.0)) {
        CollapseStatus::Sliver
    } else {
        CollapseStatus::Flip
    }
}

/// The triangles at a node's neighbours as a surface of its own, and the node of each of its vertices, ascending.
fn around(levels: &ProgressiveMesh, triangles: &[[u32; 3]], node: u32) -> (TriMesh, Vec<u32>) {
    let mut is_near = vec![false; levels.positions.len()];
    let at_node = triangles.iter().filter(|corners| corners.contains(&node));
    at_node.flatten().for_each(|&near| is_near[near as usize] = true);
    let reaches = |corners: &&[u32; 3]| corners.iter().any(|&corner| is_near[corner as usize]);
    let triangles: Vec<[u32; 3]> = triangles.iter().filter(reaches).copied().collect();
    let nodes = used_vertices(levels.positions.len(), &triangles);
    (levels.extract(&triangles), nodes)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::decimation::decimate;
    use crate::settings::Decimation;

    /// The ways of the vertex that is at `at`, before anything has gone.
    fn ways(mesh: &TriMesh, at: Vec3, method: Method) -> (ProgressiveMesh, Ways) {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let levels = decimate(mesh, &topology, &Decimation { method, ..Decimation::default() });
        let triangles = levels.triangles_at(0);
        let classes = Classes::new(&levels, 0, &triangles);
        let node = levels.positions.iter().position(|p| *p == at).unwrap() as u32;
        let ways = Ways::new(&levels, &triangles, &classes, node, method).unwrap();
        (levels, ways)
    }

    #[test]
    fn no_corner_of_a_tetrahedron_may_go() {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let mesh = TriMesh { positions, triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]] };
        for method in Method::ALL {
            let (_, found) = ways(&mesh, Vec3::ZERO, method);
            assert_eq!(
                found.to.iter().map(|(_, fate)| *fate).collect::<Vec<_>>(),
                [CollapseStatus::Link; 3],
                "{method:?}"
            );
        }
    }

    /// A flat fan around the origin over a polygon, in a larger sheet.
    fn fan(corners: &[[f32; 2]]) -> TriMesh {
        let n = corners.len() as u32;
        let mut positions = vec![Vec3::ZERO];
        let ring = |scale: f32| corners.iter().map(move |[x, y]| Vec3::new(x * scale, y * scale, 0.0));
        positions.extend(ring(1.0));
        positions.extend(ring(3.0));
        let triangles = (0..n).flat_map(|i| {
            let (a, b) = (1 + i, 1 + (i + 1) % n);
            [[0, a, b], [a, a + n, b + n], [a, b + n, b]]
        });
        TriMesh { triangles: triangles.collect(), positions }
    }

    #[test]
    fn a_way_is_open_just_where_the_polygon_is_seen_whole() {
        // An arrow head: from the notch at (0.2, 0) everything is seen, from either wing the other is not.
        let notch = [[1.0, 0.0], [-1.0, 1.0], [-0.3, 0.0], [-1.0, -1.0]];
        let (levels, found) = ways(&fan(&notch), Vec3::ZERO, Method::Schroeder);
        assert_eq!(found.class, Class::Simple);
        for (node, fate) in found.to {
            let at = levels.positions[node as usize];
            // Seen from a wing, the far wing's triangle lies behind the notch.
            let is_wing = at.x == -1.0;
            assert_eq!(fate == CollapseStatus::Flip, is_wing, "{at}: {fate:?}");
        }
    }

    #[test]
    fn a_rim_goes_along_itself_alone() {
        let mesh = fan(&[[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]);
        let (levels, found) = ways(&mesh, Vec3::new(3.0, 0.0, 0.0), Method::Schroeder);
        assert_eq!(found.class, Class::Boundary);
        for (node, fate) in found.to {
            let is_rim = levels.positions[node as usize].length() > 2.0;
            assert_eq!(fate == CollapseStatus::OffLine, !is_rim);
        }
    }
}
