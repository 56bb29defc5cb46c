//! What a new surface comes from: what is left of the steps when they are done, to measure how far it went and to say where
//! its vertices and triangles lay.

use lumen_mesh::{Blend, SurfaceIndex, Topology, TriMesh};

use super::measure::{Deviation, Target, farthest, middle};
use super::net::{CORNER, FREE, NONE, Net};
use super::steps::Original;
use super::walk::Walk;
use crate::folds::clashing_in;

/// The old and the new surface, and how vertices lie on the old one.
#[derive(Clone, Debug)]
pub(super) struct Trace {
    /// What was asked for had these of its triangles in the old surface.
    pub(super) kept: Vec<u32>,
    /// The old surface.
    pub(super) original: Original,
    /// The new one.
    pub(super) net: Net,
    /// The same as it is returned, but for its patches.
    pub(super) new: Numbered,
}

impl Trace {
    /// How far the new and the old surface are apart.
    pub(super) fn deviation(&self) -> Deviation {
        let Self { original, net, new, .. } = self;
        let mut number = vec![NONE; net.patch.len()];
        (0..).zip(&new.triangles).for_each(|(new, &t)| number[t as usize] = new);
        let walk = Walk::on(net, new.triangles.len(), |t| number[t as usize]);
        let of_new = Target { walk: &walk, index: &new.index };
        let old: Vec<u32> = original.index().triangles().collect();
        // What is new lies where its vertices do.
        let to_old_mm = farthest(net, &new.triangles, original.to_measure(), true);
        Deviation { to_old_mm, to_new_mm: farthest(&original.first, &old, of_new, false) }
    }

    /// For each new triangle one that entered.
    pub(super) fn of_triangles(&self) -> Vec<u32> {
        self.new.triangles.iter().map(|&t| self.kept[self.of_triangle(t) as usize]).collect()
    }

    /// The old triangle for a triangle of the net.
    fn of_triangle(&self, t: u32) -> u32 {
        let Self { original, net, .. } = self;
        let vertices = corners(net, t);
        let patch = net.patch[t as usize];
        let nearest = original.walk.from(net.near[vertices[0] as usize], middle(net.corners(t)), 0.0).triangle;
        if original.patch[nearest as usize] == patch {
            return nearest;
        }
        // Beside a border the middle may be nearer to the other patch; a corner is not.
        let free = vertices.into_iter().filter(|&v| net.kind[v as usize] == FREE);
        let other = free.map(|v| net.foot[v as usize].on).find(|&foot| foot != NONE);
        other.filter(|&other| original.patch[other as usize] == patch).unwrap_or(nearest)
    }

    /// For each new vertex those that entered, by weights.
    pub(super) fn of_vertices(&self) -> Blend {
        let vertices = &self.new.vertices;
        let mut blend = Blend::with_capacity(vertices.len(), 3 * vertices.len());
        vertices.iter().for_each(|&v| self.push_sources(&mut blend, v));
        blend
    }

    /// Adds the row of a vertex of the net.
    fn push_sources(&self, blend: &mut Blend, v: u32) {
        let Self { original, net, .. } = self;
        let (kind, at, foot) = (net.kind[v as usize], net.at[v as usize], net.foot[v as usize]);
        let row = if foot.on == NONE && net.first[v as usize] != NONE {
            Some(([v, v, v], [1.0, 0.0, 0.0]))
        } else if kind != FREE && foot.on != NONE && !net.is_adrift[v as usize] {
            let [a, b] = original.curves.segments[foot.on as usize];
            Some(([a, b, b], foot.weights))
        } else if kind == FREE && foot.on != NONE && !net.is_adrift[v as usize] {
            Some((original.triangles[foot.on as usize], foot.weights))
        } else {
            let found = original.index().nearest(at);
            found.map(|found| (original.triangles[found.triangle as usize], found.barycentric))
        };
        for (corner, weight) in row.into_iter().flat_map(|(corners, weights)| corners.into_iter().zip(weights)) {
            blend.push(original.first.first[corner as usize], weight);
        }
        blend.finish_row();
    }
}

/// A list of triangles with their index, and what of a net they are.
#[derive(Clone, Debug)]
pub(super) struct Numbered {
    pub(super) mesh: TriMesh,
    pub(super) index: SurfaceIndex,
    /// The net's vertex of each vertex.
    vertices: Vec<u32>,
    /// The net's triangle of each triangle.
    pub(super) triangles: Vec<u32>,
}

impl Numbered {
    /// The triangles that run into others or are folded onto a neighbour, ascending.
    pub(super) fn clashing(&self) -> Vec<u32> {
        clashing_in(&self.mesh, &self.index, &Topology::new(self.mesh.positions.len(), &self.mesh.triangles))
    }
}

/// The corners of a triangle: those that were parted where fans of triangles touch are one again.
fn corners(net: &Net, t: u32) -> [u32; 3] {
    [0, 1, 2].map(|i| {
        let v = net.origin(3 * t + i);
        let is_copy = net.kind[v as usize] == CORNER && net.first[v as usize] != NONE;
        if is_copy { net.first[v as usize] } else { v }
    })
}

/// A net as a list of triangles.
pub(super) fn numbered(net: &Net) -> Numbered {
    let mut number = vec![NONE; net.at.len()];
    let (mut mesh, mut vertices, mut triangles) = (TriMesh::default(), Vec::new(), Vec::new());
    for t in (0..net.patch.len() as u32).filter(|&t| net.is_live(3 * t)) {
        let corners = corners(net, t).map(|v| {
            if number[v as usize] == NONE {
                number[v as usize] = mesh.positions.len() as u32;
                mesh.positions.push(net.at[v as usize]);
                vertices.push(v);
            }
            number[v as usize]
        });
        let [a, b, c] = corners;
        if a != b && b != c && c != a {
            mesh.triangles.push(corners);
            triangles.push(t);
        }
    }
    let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
    Numbered { mesh, index, vertices, triangles }
}
