//! The surface while it is being decimated: triangles that change hands, and the fan of triangles around a vertex.

use glam::{DVec3, Vec3};

use crate::mesh::{Topology, TriMesh};

/// Bit of the edge that leaves corner 0, 1, 2 of a triangle.
const EDGE_BITS: [u8; 3] = [1, 2, 4];

/// A triangle surface under half-edge collapses.
pub(super) struct Surface {
    /// Positions in mm, relative to the middle of the surface.
    positions: Vec<Vec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Which edges of a triangle are feature edges.
    creases: Vec<u8>,
    /// Triangles around each vertex: `fans[starts[v]..starts[v] + lengths[v]]`, without order.
    fans: Vec<u32>,
    starts: Vec<u32>,
    lengths: Vec<u32>,
}

/// A triangle `(v, a, b)` seen from `v`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spoke {
    pub(super) a: u32,
    pub(super) b: u32,
    /// Whether the edges v-a and v-b are feature edges.
    crease_a: bool,
    crease_b: bool,
}

/// The ordered fan of triangles around a vertex: `spokes[i].b == spokes[i + 1].a`.
#[derive(Default)]
pub(super) struct Ring {
    pub(super) spokes: Vec<Spoke>,
    /// Whether the last spoke meets the first: false at a boundary.
    pub(super) closed: bool,
}

impl Ring {
    /// The vertices around, each once, with whether the edge to it is a feature edge.
    pub(super) fn neighbours(&self) -> impl Iterator<Item = (u32, bool)> + '_ {
        let last = self.spokes.last().filter(|_| !self.closed).map(|spoke| (spoke.b, spoke.crease_b));
        self.spokes.iter().map(|spoke| (spoke.a, spoke.crease_a)).chain(last)
    }

    /// The two ends of an open ring.
    pub(super) fn ends(&self) -> [u32; 2] {
        [self.spokes[0].a, self.spokes[self.spokes.len() - 1].b]
    }
}

impl Surface {
    /// Takes over `mesh`, as yet without feature edges.
    pub(super) fn new(mesh: &TriMesh, topology: &Topology) -> Self {
        let centre = mesh.bounds().centre();
        let positions: Vec<Vec3> = mesh.positions.iter().map(|&p| p - centre).collect();
        let mut fans = Vec::with_capacity(mesh.triangles.len() * 6);
        let (mut starts, mut lengths) = (Vec::with_capacity(positions.len()), Vec::with_capacity(positions.len()));
        for v in 0..mesh.positions.len() as u32 {
            starts.push(fans.len() as u32);
            lengths.push(topology.triangles(v).len() as u32);
            fans.extend_from_slice(topology.triangles(v));
        }
        let creases = vec![0; mesh.triangles.len()];
        Self { positions, triangles: mesh.triangles.clone(), creases, fans, starts, lengths }
    }

    /// Makes feature edges of those edges of triangle `t` on which its normal and that of the one other triangle have
    /// a cosine below `limit`. To be called for every triangle before the first collapse.
    pub(super) fn find_creases(&mut self, t: u32, limit: f64) {
        let corners = self.triangles[t as usize];
        for i in 0..3 {
            let (from, to) = (corners[i], corners[(i + 1) % 3]);
            let Some(twin) = self.triangle_with_edge(to, from).filter(|&twin| twin > t) else { continue };
            let (n, m) = (self.normal(t), self.normal(twin));
            if n.dot(m) < limit * (n.length_squared() * m.length_squared()).sqrt() {
                self.set_crease(t, from, to);
                self.set_crease(twin, from, to);
            }
        }
    }

    pub(super) fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    pub(super) fn at(&self, v: u32) -> DVec3 {
        self.positions[v as usize].as_dvec3()
    }

    /// Triangles around `v`, without order.
    pub(super) fn fan(&self, v: u32) -> &[u32] {
        let start = self.starts[v as usize] as usize;
        &self.fans[start..start + self.lengths[v as usize] as usize]
    }

    /// Twice the area times the unit normal of a triangle.
    fn normal(&self, t: u32) -> DVec3 {
        let [a, b, c] = self.triangles[t as usize].map(|v| self.at(v));
        (b - a).cross(c - a)
    }

    fn spoke(&self, t: u32, v: u32) -> Spoke {
        let corners = self.triangles[t as usize];
        let i = corner_of(corners, v);
        let bits = self.creases[t as usize];
        Spoke {
            a: corners[(i + 1) % 3],
            b: corners[(i + 2) % 3],
            crease_a: bits & EDGE_BITS[i] != 0,
            crease_b: bits & EDGE_BITS[(i + 2) % 3] != 0,
        }
    }

    /// The triangle that runs `from -> to`.
    fn triangle_with_edge(&self, from: u32, to: u32) -> Option<u32> {
        if self.lengths[from as usize] <= self.lengths[to as usize] {
            self.fan(from).iter().copied().find(|&t| self.spoke(t, from).a == to)
        } else {
            self.fan(to).iter().copied().find(|&t| self.spoke(t, to).b == from)
        }
    }

    fn set_crease(&mut self, t: u32, a: u32, b: u32) {
        let corners = self.triangles[t as usize];
        let (i, j) = (corner_of(corners, a), corner_of(corners, b));
        let edge = if (i + 1) % 3 == j { i } else { j };
        self.creases[t as usize] |= EDGE_BITS[edge];
    }

    /// Puts the triangles around `v` in order. Returns false where they do not form one disc or half-disc of
    /// consistent winding: `v` is complex (or has no triangle).
    pub(super) fn order_ring(&self, v: u32, ring: &mut Ring) -> bool {
        ring.spokes.clear();
        ring.spokes.extend(self.fan(v).iter().map(|&t| self.spoke(t, v)));
        let spokes = &mut ring.spokes;
        if spokes.is_empty() {
            return false;
        }
        // At a boundary the first spoke is the one that no other leads to.
        let mut firsts = (0..spokes.len()).filter(|&i| spokes.iter().all(|s| s.b != spokes[i].a));
        let first = firsts.next();
        if firsts.next().is_some() {
            return false;
        }
        drop(firsts);
        ring.closed = first.is_none();
        spokes.swap(0, first.unwrap_or(0));
        for i in 1..spokes.len() {
            let mut next = (i..spokes.len()).filter(|&j| spokes[j].a == spokes[i - 1].b);
            let (Some(found), None) = (next.next(), next.next()) else { return false };
            drop(next);
            spokes.swap(i, found);
        }
        let last = spokes[spokes.len() - 1].b;
        if ring.closed { last == spokes[0].a } else { spokes.iter().all(|s| s.a != last) }
    }

    /// Moves every triangle of `gone` to `kept`; those that have both end, and are pushed to `ended`.
    pub(super) fn collapse(&mut self, gone: u32, kept: u32, ended: &mut Vec<u32>) {
        ended.clear();
        let start = self.fans.len();
        for i in 0..self.lengths[kept as usize] {
            let t = self.fans[(self.starts[kept as usize] + i) as usize];
            if self.triangles[t as usize].contains(&gone) {
                ended.push(t);
            } else {
                self.fans.push(t);
            }
        }
        // Feature edges gone-a and kept-a become one edge.
        for &t in ended.iter() {
            let (from_gone, from_kept) = (self.spoke(t, gone), self.spoke(t, kept));
            let a = if from_gone.a == kept { from_gone.b } else { from_gone.a };
            let crease = |s: Spoke| if s.a == a { s.crease_a } else { s.crease_b };
            let (gone_a, kept_a) = (crease(from_gone), crease(from_kept));
            self.remove_from_fan(a, t);
            if gone_a || kept_a {
                for i in 0..self.lengths[a as usize] {
                    let other = self.fans[(self.starts[a as usize] + i) as usize];
                    let corners = self.triangles[other as usize];
                    let side = [gone, kept].into_iter().find(|v| corners.contains(v));
                    if let (Some(v), false) = (side, ended.contains(&other)) {
                        self.set_crease(other, v, a);
                    }
                }
            }
        }
        for i in 0..self.lengths[gone as usize] {
            let t = self.fans[(self.starts[gone as usize] + i) as usize];
            if !ended.contains(&t) {
                let corner = corner_of(self.triangles[t as usize], gone);
                self.triangles[t as usize][corner] = kept;
                self.fans.push(t);
            }
        }
        self.lengths[gone as usize] = 0;
        self.starts[kept as usize] = start as u32;
        self.lengths[kept as usize] = (self.fans.len() - start) as u32;
    }

    fn remove_from_fan(&mut self, v: u32, t: u32) {
        let start = self.starts[v as usize] as usize;
        let length = &mut self.lengths[v as usize];
        let fan = &mut self.fans[start..start + *length as usize];
        if let Some(i) = fan.iter().position(|&other| other == t) {
            fan.copy_within(i + 1.., i);
            *length -= 1;
        }
    }
}

/// The corner of a triangle at which `v` stands.
fn corner_of(corners: [u32; 3], v: u32) -> usize {
    if corners[0] == v {
        0
    } else if corners[1] == v {
        1
    } else {
        2
    }
}
