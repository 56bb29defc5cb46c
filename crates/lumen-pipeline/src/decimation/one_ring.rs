//! The triangles around a vertex, laid out for four at a time: what a collapse onto each neighbour would do to them.
//!
//! Coordinates are relative to the vertex, so that f32 loses nothing. With `e_i` the neighbours, `N_i = e_i x e_(i+1)`
//! and `d_i = e_(i+1) - e_i`, the triangle `i` becomes one with the normal `N_i - e_j x d_i` when the vertex moves
//! onto neighbour `j`.

use glam::{Vec3, Vec3A, Vec4};

use super::rings::{BORDER, Rings, neighbour};
use lumen_mesh::closest_point_on_triangle;

/// Triangles around a vertex above which it waits for its neighbours to go first, and nothing collapses onto it: what
/// is asked of a star takes the square of its size, and the middle of a flat cap may have thousands.
pub(super) const MAX_AROUND: usize = 128;

/// One neighbour more than that may stand at the end of a boundary, one is repeated, and the next four are read.
const QUADS: usize = MAX_AROUND / 4 + 2;

/// x, y and z of four vectors.
type Vectors = [Vec4; 3];

/// Four triangles; zero where there are fewer.
#[derive(Clone, Copy)]
struct Quad {
    /// From the vertex to the first of the two others.
    e: Vectors,
    /// From the first to the second.
    d: Vectors,
    /// Twice the area times the unit normal.
    n: Vectors,
    /// Length of `n`.
    area: Vec4,
    /// Length of `d`, squared.
    side: Vec4,
    /// Quality, squared.
    quality: Vec4,
    /// 1 where there is no triangle.
    none: Vec4,
}

/// A vertex and the triangles around it.
pub(super) struct OneRing {
    /// Entries of the ring, `count` of them.
    entries: [u32; MAX_AROUND + 4],
    count: usize,
    triangles: usize,
    quads: [Quad; QUADS],
    /// Sum of the areas, doubled.
    area: f32,
    /// Sum of the normals.
    normals: Vectors,
}

/// A triangle of less quality than this, squared, has no normal but that of rounding.
const NO_NORMAL: f32 = 1e-12;

/// The square of the factor that makes an equilateral triangle's quality 1.
const NORM: f32 = 12.0;

fn dot(a: Vectors, b: Vectors) -> Vec4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vectors, b: Vectors) -> Vectors {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn add(a: Vectors, b: Vectors) -> Vectors {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

fn subtract(a: Vectors, b: Vectors) -> Vectors {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn sum(v: Vec4) -> f32 {
    (v.x + v.y) + (v.z + v.w)
}

impl OneRing {
    pub(super) fn new() -> Self {
        let zero = [Vec4::ZERO; 3];
        let none = Quad {
            e: zero,
            d: zero,
            n: zero,
            area: Vec4::ZERO,
            side: Vec4::ZERO,
            quality: Vec4::ZERO,
            none: Vec4::ZERO,
        };
        Self { entries: [0; MAX_AROUND + 4], count: 0, triangles: 0, quads: [none; QUADS], area: 0.0, normals: zero }
    }

    /// Loads the ring of `v`, which has at most [`MAX_AROUND`] neighbours; [`Self::span`] follows where triangles are
    /// asked for.
    pub(super) fn load(&mut self, rings: &Rings, v: u32) {
        let ring = rings.around(v);
        let is_open = rings.is_open(v);
        let p = rings.at(v);
        self.count = ring.len();
        self.triangles = if is_open { self.count.saturating_sub(1) } else { self.count };
        self.entries[..ring.len()].copy_from_slice(ring);
        // The first again where the ring closes, and to fill the four that it stands in.
        let Some(&first) = ring.first() else { return };
        let edge = |i: usize| rings.at(neighbour(ring.get(i).copied().unwrap_or(first))) - p;
        for (c, quad) in self.quads[..self.count / 4 + 1].iter_mut().enumerate() {
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| edge(4 * c + i));
            quad.e = [Vec4::new(a.x, b.x, c.x, d.x), Vec4::new(a.y, b.y, c.y, d.y), Vec4::new(a.z, b.z, c.z, d.z)];
        }
    }

    /// Works out the triangles.
    pub(super) fn span(&mut self) {
        let (mut area, mut normals) = (Vec4::ZERO, [Vec4::ZERO; 3]);
        let mut number = Vec4::new(0.0, 1.0, 2.0, 3.0);
        let end = Vec4::splat(self.triangles as f32);
        let zero = Vec4::ZERO;
        for c in 0..self.triangles.div_ceil(4) {
            let following = self.quads[c + 1].e;
            let quad = &mut self.quads[c];
            let is_there = number.cmplt(end);
            let e = quad.e;
            let next = [0, 1, 2].map(|axis| {
                let (here, there) = (e[axis], following[axis]);
                Vec4::new(here.y, here.z, here.w, there.x)
            });
            let d = subtract(next, e).map(|x| Vec4::select(is_there, x, zero));
            let n = cross(e, d);
            let square = dot(n, n);
            quad.d = d;
            quad.n = n;
            quad.area = square.sqrt();
            quad.side = dot(d, d);
            let edges = dot(e, e) + quad.side + dot(next, next);
            quad.quality = quality(square, edges);
            quad.none = Vec4::select(is_there, zero, Vec4::ONE);
            area += quad.area;
            normals = add(normals, n);
            number += 4.0;
        }
        self.area = sum(area);
        self.normals = normals.map(|all| Vec4::splat(sum(all)));
    }

    fn quads(&self) -> &[Quad] {
        &self.quads[..self.triangles.div_ceil(4)]
    }

    /// Number of triangles.
    pub(super) fn triangles(&self) -> usize {
        self.triangles
    }

    /// Sum of the areas of the triangles, doubled.
    pub(super) fn area(&self) -> f32 {
        self.area
    }

    /// Entries of the ring.
    pub(super) fn entries(&self) -> &[u32] {
        &self.entries[..self.count]
    }

    /// Where `v` stands in the ring.
    pub(super) fn position(&self, v: u32) -> Option<usize> {
        self.entries().iter().position(|&entry| neighbour(entry) == v)
    }

    /// The way to neighbour `i`.
    pub(super) fn edge(&self, i: usize) -> Vec3A {
        let e = &self.quads[i / 4].e;
        Vec3A::new(e[0][i % 4], e[1][i % 4], e[2][i % 4])
    }

    /// Twice the area times the unit normal of triangle `i`.
    pub(super) fn normal(&self, i: usize) -> Vec3A {
        let n = &self.quads[i / 4].n;
        Vec3A::new(n[0][i % 4], n[1][i % 4], n[2][i % 4])
    }

    /// The borders between labels: the way along each, and the sum of the normals of its two triangles.
    pub(super) fn borders(&self) -> impl Iterator<Item = (Vec3A, Vec3A)> + '_ {
        let on_border = |&i: &usize| self.entries[i] & BORDER != 0;
        let before = |i: usize| if i > 0 { i - 1 } else { self.count - 1 };
        (0..self.count).filter(on_border).map(move |i| (self.edge(i), self.normal(i) + self.normal(before(i))))
    }

    /// Mean height over which a collapse onto neighbour `j` would sweep the star.
    pub(super) fn height(&self, j: usize) -> f32 {
        let way = self.edge(j).to_array().map(Vec4::splat);
        let mut swept = Vec4::ZERO;
        for quad in self.quads() {
            swept += dot(way, quad.n).abs();
        }
        if self.area > 0.0 { sum(swept) / self.area } else { 0.0 }
    }

    /// Quality of the worst triangle after the vertex has gone the way `way` to where neighbour `j` is, or will be: 1 is
    /// equilateral, 0 has no area. The two triangles at the edge to `j` do not count. `None` if a triangle would turn
    /// so far that the cosine falls below `turn`, or one would get worse and end below `least`. One that has no area, and so
    /// no normal, is held to that of the star: else it could open against its neighbours, and lie back to back with them.
    pub(super) fn worst_after(&self, way: Vec3A, j: usize, turn: f32, least: f32) -> Option<f32> {
        let way = way.to_array().map(Vec4::splat);
        let before = if j > 0 { j - 1 } else { self.count - 1 };
        let (first, second) = (Vec4::splat(j as f32), Vec4::splat(before as f32));
        let (turn, least) = (Vec4::splat(turn), Vec4::splat(least * least));
        let mut worst = Vec4::ONE;
        let mut number = Vec4::new(0.0, 1.0, 2.0, 3.0);
        let mean = dot(self.normals, self.normals).sqrt();
        for quad in self.quads() {
            let new = subtract(quad.n, cross(way, quad.d));
            let square = dot(new, new);
            let is_flat = quad.quality.cmplt(Vec4::splat(NO_NORMAL));
            let along = Vec4::select(is_flat, dot(new, self.normals), dot(new, quad.n));
            let area = Vec4::select(is_flat, mean, quad.area);
            let near = subtract(quad.e, way);
            let far = add(near, quad.d);
            let edges = dot(near, near) + quad.side + dot(far, far);
            let quality = quality(square, edges);
            let folds = along.cmplt(turn * square.sqrt() * area);
            let is_poor = quality.cmplt(least) & quality.cmplt(quad.quality);
            let counts = number.cmpne(first) & number.cmpne(second);
            if (counts & (folds | is_poor)).any() {
                return None;
            }
            worst = worst.min(Vec4::select(counts & quad.none.cmpeq(Vec4::ZERO), quality, Vec4::ONE));
            number += 4.0;
        }
        Some(worst.min_element().max(0.0).sqrt())
    }

    /// The smallest cosine between `axis` and the normals of the triangles after the vertex has gone `way`, without
    /// the two at the edge to neighbour `j`; -1 if one of them has no area.
    pub(super) fn least_cosine(&self, way: Vec3A, j: usize, axis: Vec3A) -> f32 {
        let way = way.to_array().map(Vec4::splat);
        let before = if j > 0 { j - 1 } else { self.count - 1 };
        let (first, second) = (Vec4::splat(j as f32), Vec4::splat(before as f32));
        let mut least = Vec4::ONE;
        let mut number = Vec4::new(0.0, 1.0, 2.0, 3.0);
        for quad in self.quads() {
            let cosine = cosine(subtract(quad.n, cross(way, quad.d)), axis);
            let counts = number.cmpne(first) & number.cmpne(second) & quad.none.cmpeq(Vec4::ZERO);
            least = least.min(Vec4::select(counts, cosine, Vec4::ONE));
            number += 4.0;
        }
        least.min_element()
    }

    /// The smallest cosine between `axis` and the normals of the triangles; -1 if one of them has no area.
    pub(super) fn cosine_to(&self, axis: Vec3A) -> f32 {
        let least = self.quads().iter().fold(Vec4::ONE, |least, quad| {
            let is_there = quad.none.cmpeq(Vec4::ZERO);
            least.min(Vec4::select(is_there, cosine(quad.n, axis), Vec4::ONE))
        });
        least.min_element()
    }

    /// The values of the form `x.Ax + 2 b.x + c` at the neighbours, four at a time, into `values`; `a` is xx, xy, xz, yy,
    /// yz, zz.
    pub(super) fn form(&self, a: &[f32; 6], b: Vec3A, c: f32, values: &mut [f32; MAX_AROUND + 4]) {
        let [xx, xy, xz, yy, yz, zz] = a.map(Vec4::splat);
        let b = (b + b).to_array().map(Vec4::splat);
        let c = Vec4::splat(c);
        for (quad, values) in self.quads[..self.count.div_ceil(4)].iter().zip(values.as_chunks_mut::<4>().0) {
            let [x, y, z] = quad.e;
            let row =
                [xx * x + xy * y + xz * z + b[0], xy * x + yy * y + yz * z + b[1], xz * x + yz * y + zz * z + b[2]];
            *values = (dot(row, [x, y, z]) + c).to_array();
        }
    }

    /// How much the triangles look the same way: 1 if all do, 0 if their normals cancel.
    pub(super) fn flatness(&self) -> f32 {
        if self.area > 0.0 { self.normal_sum().length() / self.area } else { 0.0 }
    }

    /// Distance of the vertex from the triangles that are left when it has gone `way` to where neighbour `j` is.
    pub(super) fn distance_to_patch(&self, way: Vec3A, j: usize) -> f32 {
        let before = if j > 0 { j - 1 } else { self.count - 1 };
        let there = (0..self.triangles).filter(|&i| i != j && i != before);
        let corner = |i: usize| Vec3::from(if i < self.count { self.edge(i) } else { self.edge(0) });
        let squares =
            there.map(|i| closest_point_on_triangle(Vec3::ZERO, [Vec3::from(way), corner(i), corner(i + 1)]).squared);
        let least = squares.fold(f64::INFINITY, f64::min);
        // Where none is left, the vertex was an ear: the edge it stood on.
        if least.is_finite() { least.sqrt() as f32 } else { way.length() }
    }

    /// The sum of the normals of the triangles.
    pub(super) fn normal_sum(&self) -> Vec3A {
        Vec3A::from(self.normals.map(|all| all.x))
    }

    /// Corners of the box around the neighbours, relative to the vertex, with the vertex.
    pub(super) fn reach(&self) -> [Vec3A; 2] {
        let (mut low, mut high) = ([Vec4::ZERO; 3], [Vec4::ZERO; 3]);
        for quad in &self.quads[..self.count.div_ceil(4)] {
            for axis in 0..3 {
                low[axis] = low[axis].min(quad.e[axis]);
                high[axis] = high[axis].max(quad.e[axis]);
            }
        }
        [Vec3A::from(low.map(Vec4::min_element)), Vec3A::from(high.map(Vec4::max_element))]
    }
}

/// Cosines between `axis` and `n`; -1 where `n` is zero.
fn cosine(n: Vectors, axis: Vec3A) -> Vec4 {
    let square = dot(n, n);
    let cosine = dot(n, axis.to_array().map(Vec4::splat)) / square.sqrt();
    Vec4::select(square.cmpgt(Vec4::ZERO), cosine, Vec4::NEG_ONE)
}

/// Squares of the quality of triangles, from the squares of their areas, doubled, and the sums of those of their sides; 0
/// for a point.
fn quality(square: Vec4, edges: Vec4) -> Vec4 {
    square * NORM / (edges * edges).max(Vec4::splat(f32::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::{Topology, TriMesh};

    /// A cone of `sides` triangles around vertex 0, the apex, which is `height` above the others' circle of radius 1.
    fn cone(sides: u32, height: f32) -> OneRing {
        let at = |i: u32| libm::sincosf(i as f32 / sides as f32 * std::f32::consts::TAU);
        let rim = (0..sides).map(|i| Vec3::new(at(i).1, at(i).0, 0.0));
        let positions = std::iter::once(Vec3::Z * height).chain(rim).collect();
        let triangles = (0..sides).map(|i| [0, 1 + i, 1 + (i + 1) % sides]).collect();
        star_of(&TriMesh { positions, triangles })
    }

    /// That of vertex 0.
    fn star_of(mesh: &TriMesh) -> OneRing {
        let mut rings = Rings::new(mesh);
        assert!(rings.link(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles), mesh.positions.len()));
        let apex = (0..rings.len() as u32).find(|&v| rings.nodes[v as usize] == 0).unwrap();
        let mut star = OneRing::new();
        star.load(&rings, apex);
        star.span();
        star
    }

    #[test]
    fn a_flat_star_is_swept_over_no_height_and_a_cone_over_what_it_stands_out() {
        for sides in [3, 4, 5, 6, 7, 8, 11, 128] {
            let flat = cone(sides, 0.0);
            assert!((flat.flatness() - 1.0).abs() < 1e-5);
            assert!((0..sides as usize).all(|j| flat.height(j) < 1e-5 * flat.edge(0).length()));
            // Its triangles' normals lean by the angle between the axis and the slant; onto the axis falls the cosine.
            let steep = cone(sides, 2.0);
            let inner = libm::cosf(std::f32::consts::PI / sides as f32);
            let cosine = inner / (inner * inner + 4.0).sqrt();
            assert!((steep.flatness() - cosine).abs() < 1e-5, "{sides}: {} {cosine}", steep.flatness());
            let axis = Vec3A::Z;
            assert!((steep.cosine_to(axis) - cosine).abs() < 1e-5);
            // The apex goes down to the circle: every triangle comes to lie in its plane.
            let way = steep.edge(0);
            assert!((steep.least_cosine(way, 0, axis) - 1.0).abs() < 1e-4 || sides == 3);
        }
    }

    #[test]
    fn quality_is_one_for_equilateral_triangles_and_folding_is_refused() {
        let star = cone(6, 0.0);
        assert!(
            star.quads().iter().all(|quad| (0..4).all(|i| quad.none[i] > 0.0 || (quad.quality[i] - 1.0).abs() < 1e-5))
        );
        // On the spot nothing changes; the two triangles at the edge do not count.
        assert!((star.worst_after(Vec3A::ZERO, 0, 0.5, 0.1).unwrap() - 1.0).abs() < 1e-5);
        // Beyond the opposite side triangles turn over.
        assert_eq!(star.worst_after(star.edge(3) * 1.5, 0, 0.0, 0.0), None);
    }

    #[test]
    fn a_triangle_without_area_opens_with_its_star_and_not_against_it() {
        // Seen from above, four quarters; vertex 3 lies on the edge to 4, so that the triangle between them has no area.
        let around = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::NEG_X * 0.5, Vec3::NEG_X, Vec3::NEG_Y];
        let triangles = vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1]];
        let star = star_of(&TriMesh { positions: around.to_vec(), triangles });
        let along_x = |&j: &usize| star.edge(j).normalize().x > 0.9;
        let to = (0..5).find(along_x).unwrap();
        let after = |y: f32| star.worst_after(Vec3A::Y * y * star.edge(to).length(), to, 0.0, 0.0);
        // From the middle down it faces up, as the others do, and from the middle up it would face down.
        assert!(after(-0.1).is_some() && after(0.1).is_none());
    }
}
