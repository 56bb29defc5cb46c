//! Surfaces that are no manifolds: a noisy tube, and faults on it as segmentation, modelling and conversion leave them.
//! Proptest makes them, so one that fails is cut down to the few faults that it fails by.

use lumen_mesh::{TriMesh, Vec3};
use proptest::prelude::*;

/// A tube and what is wrong with it. The numbers of a fault name vertices, triangles and corners, each taken modulo how
/// many there are.
#[derive(Clone, Debug)]
pub struct Tangle {
    /// Rings of vertices along the tube.
    pub rings: u32,
    /// Vertices around each ring.
    pub sides: u32,
    /// Whether both ends are capped.
    pub is_closed: bool,
    /// What each coordinate is off by, in mm.
    pub noise: f32,
    /// Other seeds have other offsets.
    pub seed: u32,
    /// Added one after another.
    pub faults: Vec<Fault>,
}

/// Something that makes a surface no manifold, or more than one, or wound both ways.
#[derive(Clone, Copy, Debug)]
pub enum Fault {
    /// Two vertices become one.
    WeldVertices([u32; 2]),
    /// Two edges become one: four triangles.
    WeldEdges([u32; 2]),
    /// Two triangles become one that is there twice, the same way round or back to back.
    WeldTriangles([u32; 2]),
    /// The vertices of a ring become one.
    Pinch(u32),
    /// More triangles on an edge, each with a corner of its own.
    Fins(u32, u32),
    /// More triangles around a vertex, in a fan that closes or does not.
    Fan(u32, u32, bool),
    /// A triangle is turned over.
    Flip(u32),
    /// A triangle is there again.
    Double(u32),
    /// A triangle is there again, turned over.
    Back(u32),
    /// A triangle between any three vertices.
    Bridge([u32; 3]),
    /// A triangle is missing.
    Hole(u32),
    /// A piece of its own: a triangle, two back to back, a tetrahedron; with so many of its vertices welded to the tube.
    Speck(u32, u32, u32),
}

/// Tubes with up to `most` faults.
pub fn tangles(most: usize) -> impl Strategy<Value = Tangle> {
    let number = any::<u32>;
    let fault = prop_oneof![
        prop::array::uniform2(number()).prop_map(Fault::WeldVertices),
        prop::array::uniform2(number()).prop_map(Fault::WeldEdges),
        prop::array::uniform2(number()).prop_map(Fault::WeldTriangles),
        number().prop_map(Fault::Pinch),
        (number(), 1..4u32).prop_map(|(edge, count)| Fault::Fins(edge, count)),
        // 24 triangles around a vertex are many (`fan.rs`).
        (number(), prop_oneof![2..6u32, 23..40u32], any::<bool>())
            .prop_map(|(v, count, closes)| Fault::Fan(v, count, closes)),
        number().prop_map(Fault::Flip),
        number().prop_map(Fault::Double),
        number().prop_map(Fault::Back),
        prop::array::uniform3(number()).prop_map(Fault::Bridge),
        number().prop_map(Fault::Hole),
        (0..3u32, 0..3u32, number()).prop_map(|(kind, welded, at)| Fault::Speck(kind, welded, at)),
    ];
    let faults = prop::collection::vec(fault, 1..=most);
    (3..14u32, 3..10u32, any::<bool>(), prop::sample::select(vec![0.0f32, 0.05, 0.4]), number(), faults).prop_map(
        |(rings, sides, is_closed, noise, seed, faults)| Tangle { rings, sides, is_closed, noise, seed, faults },
    )
}

/// A number of 0 to 1 for each number (Wellons' "lowbias32").
fn scattered(n: u32) -> f32 {
    let mut x = n;
    x = (x ^ x >> 16).wrapping_mul(0x7feb_352d);
    x = (x ^ x >> 15).wrapping_mul(0x846c_a68b);
    ((x ^ x >> 16) >> 8) as f32 / (1 << 24) as f32
}

impl Tangle {
    /// The surface, not yet imported.
    pub fn mesh(&self) -> TriMesh {
        let mut mesh = self.tube();
        for (i, &fault) in self.faults.iter().enumerate() {
            self.add(fault, i as u32, &mut mesh);
        }
        mesh
    }

    /// An offset for coordinate after coordinate, -1 to 1 in each.
    fn offset(&self, n: u32) -> Vec3 {
        Vec3::from([0, 1, 2].map(|axis| 2.0 * scattered(self.seed.wrapping_add(3 * n + axis)) - 1.0))
    }

    fn tube(&self) -> TriMesh {
        let (rings, sides) = (self.rings, self.sides);
        let mut positions: Vec<Vec3> = (0..rings * sides)
            .map(|i| {
                let (ring, side) = ((i / sides) as f32, (i % sides) as f32);
                let (sin, cos) = (side / sides as f32 * std::f32::consts::TAU).sin_cos();
                Vec3::new(2.0 * cos, 2.0 * sin, 1.5 * ring) + self.offset(i) * self.noise
            })
            .collect();
        let mut triangles: Vec<[u32; 3]> = (0..(rings - 1) * sides)
            .flat_map(|i| {
                let (ring, side) = (i / sides, i % sides);
                let [a, b] = [ring * sides + side, ring * sides + (side + 1) % sides];
                [[a, b, a + sides], [b, b + sides, a + sides]]
            })
            .collect();
        if self.is_closed {
            let hub = positions.len() as u32;
            positions.extend([Vec3::new(0.0, 0.0, -1.0), Vec3::new(0.0, 0.0, 1.5 * rings as f32)]);
            let last = (rings - 1) * sides;
            triangles.extend((0..sides).map(|s| [hub, (s + 1) % sides, s]));
            triangles.extend((0..sides).map(|s| [hub + 1, last + s, last + (s + 1) % sides]));
        }
        TriMesh { positions, triangles }
    }

    fn add(&self, fault: Fault, number: u32, mesh: &mut TriMesh) {
        let TriMesh { positions, triangles } = mesh;
        let (vertices, faces) = (positions.len() as u32, triangles.len() as u32);
        if faces == 0 {
            return;
        }
        let triangle = |n: u32| triangles[(n % faces) as usize];
        let edge = |n: u32| {
            let corners = triangle(n / 3);
            [corners[n as usize % 3], corners[(n as usize + 1) % 3]]
        };
        // Where new corners are: near `at`, each in a place of its own.
        let beside = |at: Vec3, i: u32| at + self.offset(7 * (1000 * (number + 1) + i)) * 2.0;
        match fault {
            Fault::WeldVertices([a, b]) => weld(positions, &[(a % vertices, b % vertices)]),
            Fault::WeldEdges([a, b]) => {
                let ([a, b], [c, d]) = (edge(a), edge(b));
                weld(positions, &[(a, d), (b, c)]);
            }
            Fault::WeldTriangles([s, t]) => {
                let ([a, b, c], [d, e, f]) = (triangle(s), triangle(t));
                weld(positions, &[(a, d), (b, e), (c, f)]);
            }
            Fault::Pinch(ring) => {
                let first = ring % self.rings * self.sides;
                weld(positions, &(1..self.sides).map(|i| (first, first + i)).collect::<Vec<_>>());
            }
            Fault::Fins(at, count) => {
                let [a, b] = edge(at);
                for i in 0..count {
                    triangles.push([a, b, positions.len() as u32]);
                    positions.push(beside(positions[a as usize], i));
                }
            }
            Fault::Fan(v, count, closes) => {
                let (v, first) = (v % vertices, vertices);
                positions.extend((0..=count).map(|i| beside(positions[v as usize], i)).collect::<Vec<_>>());
                triangles.extend((0..count).map(|i| [v, first + i, first + i + 1]));
                if closes {
                    triangles.push([v, first + count, first]);
                }
            }
            Fault::Flip(t) => triangles[(t % faces) as usize].swap(0, 1),
            Fault::Double(t) => triangles.push(triangle(t)),
            Fault::Back(t) => {
                let [a, b, c] = triangle(t);
                triangles.push([c, b, a]);
            }
            Fault::Bridge(corners) => triangles.push(corners.map(|v| v % vertices)),
            Fault::Hole(t) => drop(triangles.swap_remove((t % faces) as usize)),
            Fault::Speck(kind, welded, at) => {
                let corner = |i: u32| if i < welded { edge(at)[i as usize] } else { vertices + i };
                let [a, b, c, d] = [0, 1, 2, 3].map(corner);
                let near = positions[(at % vertices) as usize] + Vec3::X * 6.0;
                positions.extend((0..4).map(|i| beside(near, i)).collect::<Vec<_>>());
                triangles.extend(match kind {
                    0 => vec![[a, b, c]],
                    1 => vec![[a, b, c], [c, b, a]],
                    _ => vec![[a, b, c], [a, c, d], [a, d, b], [b, d, c]],
                });
            }
        }
    }
}

/// Puts the second of each pair where the first is: import makes them one.
fn weld(positions: &mut [Vec3], pairs: &[(u32, u32)]) {
    for &(to, from) in pairs {
        positions[from as usize] = positions[to as usize];
    }
}
