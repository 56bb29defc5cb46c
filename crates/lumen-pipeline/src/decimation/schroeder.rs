//! The paper's method: Schroeder, Zarge and Lorensen, "Decimation of triangle meshes" (1992). No vertex moves: one goes,
//! and one of its neighbours takes over.
//!
//! The distance of a vertex is measured from the planes and lines that the surface had there. Schroeder takes the
//! average plane of the triangles around the vertex as they are now, and so forgets what is already gone, and looks at
//! a vertex alone, whatever takes its place. Here each vertex keeps the planes of all triangles that it stands for, as
//! a quadratic form (Garland and Heckbert 1997), and the distance is the root mean square distance from them, by area,
//! of the neighbour that would take over: it counts what was lost before and what the patch will do.
//!
//! Of the five classes (section 3; the paper's Figure 3), complex vertices stay (`rings.rs`), simple ones and corners
//! are measured from planes, which lie far off where a corner is sharp, and boundary and interior-edge vertices count at
//! least their distance from the line through their two neighbours on it, along which alone they move.

use glam::Vec3A;

use super::method::{Candidate, Judged, Method, distance_to_segment};
use super::one_ring::{MAX_AROUND, OneRing};
use super::rings::{CREASE, Rings, gather, neighbour};
use crate::classes::Class;

/// What a poorly shaped triangle costs, as a part of its ring's size, beside the height swept.
const SHAPE_COST: f32 = 0.01;

/// The planes that a vertex stands for, each by its area: the sum of the squared distances from them at `x`, relative
/// to the vertex, is `x.Ax + 2 b.x + c`.
#[derive(Clone, Copy, Default)]
struct Planes {
    /// xx, xy, xz, yy, yz, zz.
    a: [f32; 6],
    b: Vec3A,
}

/// What it comes to at the vertex itself.
#[derive(Clone, Copy, Default)]
struct Own {
    /// The `c` of its planes.
    lost: f32,
    area: f32,
}

/// The method's state.
#[derive(Default)]
pub(super) struct Schroeder {
    planes: Vec<Planes>,
    own: Vec<Own>,
}

impl Planes {
    /// Adds a plane through the vertex with the normal `n`, counted by its length.
    fn add_plane(&mut self, n: Vec3A) -> f32 {
        let area = n.length();
        if area == 0.0 {
            return 0.0;
        }
        let unit = n / area;
        let (xx, xy, xz) = (unit.x * n.x, unit.x * n.y, unit.x * n.z);
        let (yy, yz, zz) = (unit.y * n.y, unit.y * n.z, unit.z * n.z);
        for (sum, part) in self.a.iter_mut().zip([xx, xy, xz, yy, yz, zz]) {
            *sum += part;
        }
        area
    }

    fn times(&self, x: Vec3A) -> Vec3A {
        let [xx, xy, xz, yy, yz, zz] = self.a;
        Vec3A::new(xx * x.x + xy * x.y + xz * x.z, xy * x.x + yy * x.y + yz * x.z, xz * x.x + yz * x.y + zz * x.z)
    }
}

impl Method for Schroeder {
    fn start(&mut self, slots: usize) {
        self.planes = vec![Planes::default(); slots];
        self.own = vec![Own::default(); slots];
    }

    fn meet(&mut self, rings: &Rings, star: &OneRing, v: u32) {
        let mut planes = Planes::default();
        let mut area = 0.0;
        for i in 0..star.triangles() {
            area += planes.add_plane(star.normal(i));
        }
        if rings.is_open(v) && star.triangles() > 0 {
            // The planes that stand on the two boundary edges, each by the square of its length.
            let last = star.triangles() - 1;
            for (edge, triangle) in [(0, 0), (last + 1, last)] {
                let (edge, normal) = (star.edge(edge), star.normal(triangle));
                area += planes.add_plane(edge.cross(normal.normalize_or_zero()) * edge.length());
            }
        }
        for (edge, normal) in star.borders() {
            area += planes.add_plane(edge.cross(normal.normalize_or_zero()) * edge.length());
        }
        self.planes[v as usize] = planes;
        self.own[v as usize] = Own { lost: 0.0, area };
    }

    fn judge(&mut self, rings: &Rings, star: &OneRing, v: u32, is_last: bool, border: Option<[usize; 2]>) -> Judged {
        let entries = star.entries();
        let (planes, own) = (&self.planes[v as usize], self.own[v as usize]);
        let mut values = [0.0; MAX_AROUND + 4];
        star.form(&planes.a, planes.b, own.lost, &mut values);
        let square = |j: usize| {
            let other = self.own[neighbour(entries[j]) as usize];
            let area = own.area + other.area;
            if area > 0.0 { (values[j].max(0.0) + other.lost) / area } else { 0.0 }
        };
        let creases = || (0..entries.len()).filter(|&j| !is_last && entries[j] & CREASE != 0);
        let class = Class::of(rings.stays(v), rings.is_open(v), creases().count());
        let along = match class {
            Class::Boundary => Some([0, entries.len() - 1]),
            _ if border.is_some() => border,
            Class::InteriorEdge => creases().next().zip(creases().next_back()).map(<[usize; 2]>::from),
            Class::Simple | Class::Complex | Class::Corner => None,
        };
        let distance = match along {
            Some([a, b]) => square(a).min(square(b)).sqrt().max(distance_to_segment(star.edge(a), star.edge(b))),
            None => (0..entries.len()).map(square).fold(f32::INFINITY, f32::min).sqrt(),
        };
        Judged { distance, priority: distance, along, is_held: class == Class::InteriorEdge && border.is_none() }
    }

    /// By the mean height over which the star would be swept.
    fn offer(&mut self, star: &OneRing, _: u32, judged: &Judged, candidates: &mut Vec<Candidate>) {
        let allowed = (0..star.entries().len()).filter(|&j| judged.allows(j));
        // Where the hole is patched makes no difference to the distance from the plane.
        let Judged { distance, priority, .. } = *judged;
        candidates.extend(allowed.map(|j| Candidate { distance, priority, cost: star.height(j), to: j, place: None }));
    }

    fn fair_quality(&self) -> f32 {
        0.15
    }

    fn shape_cost(&self, star: &OneRing, _: f32) -> f32 {
        SHAPE_COST * star.area().sqrt()
    }

    fn level(&self, _: u32, _: u32, _: Vec3A, _: Vec3A, _: Vec3A, _: f32) -> Option<Vec3A> {
        None
    }

    fn priority(&self, distance: f32) -> f32 {
        distance
    }

    /// The priority is a length.
    fn weight(&self, ratio: f32) -> f32 {
        ratio.sqrt()
    }

    fn merge(&mut self, v: u32, u: u32, way: Vec3A, _: Option<Vec3A>, tip: f32) {
        let (mut planes, own) = (self.planes[v as usize], self.own[v as usize]);
        let reach = way.length_squared();
        if tip > 0.0 && reach > 0.0 {
            // The tip counts as a point that the surface should come near to.
            let weight = own.area * tip * tip / reach;
            for i in [0, 3, 5] {
                planes.a[i] += weight;
            }
        }
        let turned = planes.times(way);
        let kept = &mut self.planes[u as usize];
        kept.a.iter_mut().zip(planes.a).for_each(|(sum, part)| *sum += part);
        kept.b += turned + planes.b;
        let kept = &mut self.own[u as usize];
        kept.lost += (way.dot(turned) + 2.0 * planes.b.dot(way) + own.lost).max(0.0);
        kept.area += own.area;
    }

    fn compact(&mut self, kept: &[u32]) {
        self.planes = gather(&self.planes, kept);
        self.own = gather(&self.own, kept);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumen_mesh::{Topology, TriMesh, Vec3};

    /// Vertices along each side of a ribbon.
    const ALONG: u32 = 7;
    /// By how much vertex 2, on the rim, is off the line of the others.
    const OFF: f32 = 0.1;

    /// A flat ribbon, 2 mm wide, with vertices every millimetre; those of the rim at y = 0 first.
    fn ribbon() -> TriMesh {
        let at = |i: u32| {
            let (x, is_far) = ((i % ALONG) as f32, i >= ALONG);
            Vec3::new(x, if is_far { 2.0 } else { 0.0 } + if i == 2 { OFF } else { 0.0 }, 0.0)
        };
        let cell = |i: u32| [[i, i + 1, i + 1 + ALONG], [i, i + 1 + ALONG, i + ALONG]];
        TriMesh { positions: (0..2 * ALONG).map(at).collect(), triangles: (0..ALONG - 1).flat_map(cell).collect() }
    }

    #[test]
    fn a_rim_that_was_bent_is_remembered_where_it_is_straight_now() {
        let mesh = ribbon();
        let mut rings = Rings::new(&mesh);
        assert!(rings.link(&mesh, &Topology::new(mesh.positions.len(), &mesh.triangles), mesh.positions.len()));
        let slot = |vertex: u32, rings: &Rings| (0..rings.len() as u32).find(|&v| rings.nodes[v as usize] == vertex);
        let [bent, straight] = [2, 3].map(|vertex| slot(vertex, &rings).unwrap());
        let (mut method, mut star) = (Schroeder::default(), OneRing::new());
        method.start(rings.len());
        for v in 0..rings.len() as u32 {
            star.load(&rings, v);
            star.span();
            method.meet(&rings, &star, v);
        }
        method.merge(bent, straight, rings.at(straight) - rings.at(bent), None, 0.0);
        rings.collapse(bent, straight);
        star.load(&rings, straight);
        let judged = method.judge(&rings, &star, straight, false, None);

        // Twice the area at a vertex, and the squares of the rim's edges there.
        let part = |v: usize| {
            let at = |v: u32| mesh.positions[v as usize];
            let here = mesh.triangles.iter().filter(|t| t.contains(&(v as u32)));
            let area: f32 = here.map(|&[a, b, c]| (at(b) - at(a)).cross(at(c) - at(a)).length()).sum();
            let beside = [v - 1, v + 1].map(|other| at(other as u32).distance_squared(at(v as u32)));
            area + beside[0] + beside[1]
        };
        // The lines from vertex 1 to 2 and from 2 to 3, which slope by OFF either way, are in the planes of 2, the second
        // in those of 3 too; weighed by the square of their length they are this far from 1 and from 4, squared.
        let [back, on] = [2.0 * 2.0 * 2.0, 3.0 * 3.0 + 2.0].map(|times| times * OFF * OFF);
        let of_both = part(2) + part(3);
        let exact = (back / (of_both + part(1))).min(on / (of_both + part(4))).sqrt();
        let found = judged.distance * rings.unit;
        assert!((found / exact - 1.0).abs() < 1e-3, "{found} mm instead of {exact}");
    }
}
