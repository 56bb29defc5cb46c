//! The places where triangles cross.
//!
//! Where two walls run through each other, only the triangles along their common line cross; those within it lie on the
//! wrong side of the other wall and go with them. Which side that is, is told by the winding number just outside a
//! triangle, 0 on a sound surface: the number of times that a ray leaves the surface less that it enters, the middle one of
//! three rays along the axes, so that one through an open end does not matter.

use glam::{DVec2, DVec3, Vec3};

use lumen_mesh::crossing::{Face, touch};
use lumen_mesh::disjoint_sets::{root, union};

use super::{Place, Remedy, Surface};

/// No place.
pub(super) const NONE: u32 = u32::MAX;

/// Triangles that cross each other, and those on the wrong side between them.
pub(super) struct Cluster {
    /// Their numbers, ascending.
    pub(super) triangles: Vec<u32>,
    /// Their vertices, ascending.
    pub(super) vertices: Vec<u32>,
}

impl Cluster {
    pub(super) fn place(&self, surface: &Surface, remedy: Remedy, moved_mm: f64) -> Place {
        let sum: DVec3 = self.vertices.iter().map(|&v| surface.mesh.positions[v as usize].as_dvec3()).sum();
        let centre = (sum / self.vertices.len().max(1) as f64).to_array();
        Place { centre, faces: self.triangles.len(), remedy, moved_mm }
    }
}

/// The places of the triangles `crossing`, in the order of their first triangles.
pub(super) fn clusters(surface: &Surface, crossing: &[u32]) -> Vec<Cluster> {
    let Surface { mesh, topology, index, .. } = surface;
    let count = mesh.triangles.len();
    let mut parent: Vec<u32> = (0..count as u32).collect();
    let mut is_in = vec![false; count];
    crossing.iter().for_each(|&t| is_in[t as usize] = true);
    for &t in crossing {
        let face = surface.face(t);
        let (low, high) = bounds(face.corners);
        index.for_each_near(low, high, |other| {
            let is_new = other > t && is_in[other as usize] && root(&mut parent, t) != root(&mut parent, other);
            if is_new && touch(&face, &surface.face(other)) {
                union(&mut parent, t, other);
            }
        });
    }
    is_in = with_wrong_sides(surface, crossing, is_in);
    let all: Vec<u32> = (0..count as u32).filter(|&t| is_in[t as usize]).collect();
    for &t in &all {
        for v in mesh.triangles[t as usize] {
            topology.triangles(v).iter().filter(|&&other| is_in[other as usize]).for_each(|&other| {
                union(&mut parent, t, other);
            });
        }
    }
    let mut number = vec![NONE; count];
    let mut clusters: Vec<Cluster> = Vec::new();
    for &t in &all {
        let root = root(&mut parent, t) as usize;
        if number[root] == NONE {
            number[root] = clusters.len() as u32;
            clusters.push(Cluster { triangles: Vec::new(), vertices: Vec::new() });
        }
        let cluster = &mut clusters[number[root] as usize];
        cluster.triangles.push(t);
        cluster.vertices.extend(mesh.triangles[t as usize]);
    }
    for cluster in &mut clusters {
        cluster.vertices.sort_unstable();
        cluster.vertices.dedup();
    }
    clusters
}

/// Adds the triangles on the wrong side that hang together with those that cross; none where they come to more than half of
/// all, as on a surface that faces inwards.
fn with_wrong_sides(surface: &Surface, crossing: &[u32], is_crossing: Vec<bool>) -> Vec<bool> {
    let Surface { mesh, topology, .. } = surface;
    let mut is_in = is_crossing.clone();
    let mut was_asked = is_crossing.clone();
    let mut queue = crossing.to_vec();
    let mut at = 0;
    while at < queue.len() {
        for v in mesh.triangles[queue[at] as usize] {
            for &t in topology.triangles(v) {
                if !std::mem::replace(&mut was_asked[t as usize], true) && surface.is_wrong(t) {
                    is_in[t as usize] = true;
                    queue.push(t);
                }
            }
        }
        at += 1;
        if 2 * queue.len() > mesh.triangles.len() {
            return is_crossing;
        }
    }
    is_in
}

impl Surface<'_> {
    pub(super) fn face(&self, t: u32) -> Face {
        Face { vertices: self.mesh.triangles[t as usize], corners: self.mesh.corners(t as usize) }
    }

    /// Whether the winding number just outside a triangle is not 0.
    fn is_wrong(&self, t: u32) -> bool {
        let [a, b, c] = self.mesh.corners(t as usize).map(Vec3::as_dvec3);
        let normal = (b - a).cross(c - a);
        let p = (a + b + c) / 3.0;
        let mut numbers = [0, 1, 2].map(|axis| self.leaves(p, axis, t) - i32::from(normal[axis] < 0.0));
        numbers.sort_unstable();
        numbers[1] != 0
    }

    /// How many times more a ray from `p` along an axis leaves the surface than it enters, `own` left out.
    fn leaves(&self, p: DVec3, axis: usize, own: u32) -> i32 {
        let mut far = p.as_vec3();
        far[axis] = self.bounds.max[axis];
        let margin = Vec3::splat(p.abs().max_element() as f32 * 1e-6);
        let mut near = Vec::new();
        self.index.for_each_near(p.as_vec3() - margin, far + margin, |t| near.push(t));
        near.sort_unstable();
        near.dedup();
        let flat = |q: DVec3| DVec2::new(q[(axis + 1) % 3], q[(axis + 2) % 3]);
        let at = flat(p);
        let turns = |corners: [DVec3; 3]| {
            let [a, b, c] = corners.map(flat);
            [(a, b), (b, c), (c, a)].map(|(from, to)| side_of_edge(from, to, at)).iter().sum::<i32>()
        };
        let is_ahead = |[a, b, c]: [DVec3; 3]| {
            let normal = (b - a).cross(c - a);
            (a - p).dot(normal) / normal[axis] > 0.0
        };
        let all = near.into_iter().filter(|&t| t != own).map(|t| self.mesh.corners(t as usize).map(Vec3::as_dvec3));
        all.filter(|&corners| is_ahead(corners)).map(turns).sum()
    }
}

/// What an edge adds to how often a polygon goes around `p`: 1 where it passes to the right of it upwards, -1 where it does
/// so downwards. An end at the height of `p` counts as above one below alone, so that a ray through a vertex counts once.
fn side_of_edge(from: DVec2, to: DVec2, p: DVec2) -> i32 {
    let side = (to - from).perp_dot(p - from);
    match (from.y <= p.y, to.y <= p.y) {
        (true, false) if side > 0.0 => 1,
        (false, true) if side < 0.0 => -1,
        _ => 0,
    }
}

/// The box of a triangle.
pub(super) fn bounds([a, b, c]: [Vec3; 3]) -> (Vec3, Vec3) {
    (a.min(b).min(c), a.max(b).max(c))
}
