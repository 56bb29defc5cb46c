//! Groups of triangles that are joined by edges: each grows from a first triangle across its edges.

use super::visibility::Place;
use crate::{Topology, TriMesh};

/// Triangles that are joined by edges, in groups.
pub(super) struct Regions {
    pub(super) of_triangle: Vec<Option<u32>>,
    pub(super) lists: Vec<Vec<u32>>,
}

impl Regions {
    /// Those of the triangles `among` for which `is_in` holds; with a `bend` they end at edges where the cosine between the
    /// normals is no more than that.
    pub(super) fn of(
        mesh: &TriMesh,
        topology: &Topology,
        among: &[u32],
        bend: Option<f64>,
        is_in: impl Fn(u32) -> bool,
    ) -> Self {
        let normal = |t: u32| Place::on(mesh, t).map(|place| place.normal);
        let is_smooth = |t: u32, other: u32| match (bend, normal(t), normal(other)) {
            (None, ..) => true,
            (Some(least), Some(n), Some(m)) => n.dot(m) > least,
            _ => false,
        };
        let mut of_triangle = vec![None; mesh.triangles.len()];
        let mut lists = Vec::new();
        for &first in among {
            if of_triangle[first as usize].is_some() || !is_in(first) {
                continue;
            }
            let number = lists.len() as u32;
            of_triangle[first as usize] = Some(number);
            let mut list = vec![first];
            let mut at = 0;
            while at < list.len() {
                for other in across(mesh, topology, list[at]) {
                    if of_triangle[other as usize].is_none() && is_in(other) && is_smooth(list[at], other) {
                        of_triangle[other as usize] = Some(number);
                        list.push(other);
                    }
                }
                at += 1;
            }
            lists.push(list);
        }
        Self { of_triangle, lists }
    }
}

/// The triangles that share an edge with `t`.
pub(super) fn across<'a>(mesh: &'a TriMesh, topology: &'a Topology, t: u32) -> impl Iterator<Item = u32> + 'a {
    let [a, b, c] = mesh.triangles[t as usize];
    let sides = [(a, b), (b, c), (c, a)].into_iter();
    sides.flat_map(|(v, w)| topology.triangles_on(&mesh.triangles, v, w)).filter(move |&other| other != t)
}
