//! What a volume mesher will say of a surface, before it is asked.
//!
//! TetGen (`-pY`, the surface kept as it is) and Gmsh fill a surface with tetrahedra when it is closed, when no triangle
//! runs into another or lies on a neighbour, and when no edge is too short or triangle too thin to be told from none.
//! [`check`] finds what breaks this, and what does not stop a mesher but spoils its mesh or a solver's boundary
//! conditions. It looks at what is there and changes nothing.
//!
//! It errs to one side: TetGen joins duplicates, goes along with edges of three triangles and with triangles without an area
//! as long as nothing is open or crosses, while Gmsh refuses them, most times.

use glam::{DVec3, Vec3};

use lumen_mesh::{Components, Topology, TriMesh, boundary_loops, compacted, components, corner_angles, triangle_area};
use lumen_message::messages;
use serde::{Deserialize, Serialize};

use crate::Patched;
use crate::folds::{folds, touching};

/// The most places that a finding names.
const PLACES: usize = 20;
/// A triangle with a smaller angle, in degrees, is a sliver.
pub const SLIVER_DEGREES: f64 = 1.0;
/// A triangle is degenerate when its height is below this part of its longest side: about what the rounding of `f32`
/// coordinates leaves of three points on a line.
const FLAT: f64 = 1e-6;

messages! {
    /// Something in a surface that a volume mesher or a solver minds.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub enum Fault {
        /// There is no triangle.
        "check-empty" Empty => "The surface has no triangle.",
        /// The arrays do not go together.
        "check-broken" Broken {
            /// Vertices with a coordinate that is not finite, triangles without their vertices or patch.
            count: usize,
        } => (
            count,
            "One vertex or triangle has numbers that are not finite or out of range.",
            "{count} vertices or triangles have numbers that are not finite or out of range."
        ),
        /// Rims with triangles on one side alone.
        "check-open-rims" OpenRims {
            /// Closed chains of open edges.
            count: usize,
        } => (count, "The surface is open at one rim.", "The surface is open at {count} rims."),
        /// Edges of more than two triangles.
        "check-shared-edges" SharedEdges {
            /// How many.
            count: usize,
        } => (count, "One edge has more than two triangles.", "{count} edges have more than two triangles."),
        /// Triangles over the same three vertices as another.
        "check-duplicates" Duplicates {
            /// Those beyond the first over their vertices.
            count: usize,
        } => (count, "One triangle is there twice.", "{count} triangles are there more than once."),
        /// Triangles without an area.
        "check-degenerate" Degenerate {
            /// How many.
            count: usize,
        } => (count, "One triangle has no area.", "{count} triangles have no area."),
        /// Triangles that run into others, or touch them.
        "check-crossing" Crossing {
            /// How many.
            count: usize,
        } => (count, "One triangle runs into another or touches it.", "{count} triangles run into others or touch them."),
        /// Neighbours with less than [`FOLD_DEGREES`](crate::folds::FOLD_DEGREES) between them.
        "check-folds" Folds {
            /// Edges between them.
            count: usize,
        } => (
            count,
            "The surface is folded onto itself at one edge.",
            "The surface is folded onto itself at {count} edges."
        ),
        /// Vertices at the place of another.
        "check-coincident" Coincident {
            /// Those beyond the first at their place.
            count: usize,
        } => (
            count,
            "One vertex lies at the place of another and is not joined to it.",
            "{count} vertices lie at the place of others and are not joined to them."
        ),
        /// Neighbours whose windings disagree.
        "check-windings" Windings {
            /// Edges between them.
            count: usize,
        } => (
            count,
            "The triangles beside one edge face different sides.",
            "The triangles beside {count} edges face different sides."
        ),
        /// Closed pieces that face inwards.
        "check-inside-out" InsideOut {
            /// How many.
            count: usize,
        } => (count, "One closed piece faces inwards.", "{count} closed pieces face inwards."),
        /// Triangles with an angle below [`SLIVER_DEGREES`].
        "check-slivers" Slivers {
            /// How many.
            count: usize,
            /// The smallest angle in degrees.
            least_degrees: f64 [3],
        } => (
            count,
            "One triangle has an angle below 1 degree: {least_degrees:.3} degrees.",
            "{count} triangles have an angle below 1 degree; the smallest is {least_degrees:.3} degrees."
        ),
        /// Pieces that do not hang together.
        "check-pieces" Pieces {
            /// How many.
            count: usize,
        } => (count, "The surface is in one piece.", "The surface is in {count} pieces."),
    }
}

impl Fault {
    /// Whether TetGen (`-pY`) or Gmsh may refuse the surface for it. Neither minds windings, which way a piece faces, several
    /// pieces, vertices at one place where nothing is open, or slivers; a solver may.
    pub fn stops(&self) -> bool {
        match self {
            Self::Empty
            | Self::Broken { .. }
            | Self::OpenRims { .. }
            | Self::SharedEdges { .. }
            | Self::Duplicates { .. }
            | Self::Degenerate { .. }
            | Self::Crossing { .. }
            | Self::Folds { .. } => true,
            Self::Coincident { .. }
            | Self::Windings { .. }
            | Self::InsideOut { .. }
            | Self::Slivers { .. }
            | Self::Pieces { .. } => false,
        }
    }
}

/// A fault and where it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// What it is.
    pub fault: Fault,
    /// Some of its places in mm, the first found: 20 at most.
    pub places: Vec<[f64; 3]>,
}

/// What awaits a surface at a volume mesher.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Fate {
    /// What is wrong, the gravest first.
    pub findings: Vec<Finding>,
    /// The volume that it encloses in mm3; `None` where it is open or its windings disagree.
    pub volume_mm3: Option<f64>,
}

impl Fate {
    /// Whether nothing was found for which TetGen (`-pY`) or Gmsh would make no volume mesh of it.
    pub fn is_ready(&self) -> bool {
        !self.findings.iter().any(|finding| finding.fault.stops())
    }

    /// Triangles that run into others.
    pub fn crossing(&self) -> usize {
        let count = |finding: &Finding| if let Fault::Crossing { count } = finding.fault { count } else { 0 };
        self.findings.iter().map(count).sum()
    }

    fn only(fault: Fault, places: Vec<[f64; 3]>) -> Self {
        Self { findings: vec![Finding { fault, places }], volume_mm3: None }
    }
}

/// Looks for what a volume mesher minds. Where numbers are broken, nothing else is looked for.
pub fn check(surface: &Patched) -> Fate {
    let Patched { mesh, of_triangle, patches } = surface;
    if mesh.triangles.is_empty() {
        return Fate::only(Fault::Empty, Vec::new());
    }
    let count = broken(mesh) + mesh.triangles.len().abs_diff(of_triangle.len());
    let count = count + of_triangle.iter().filter(|&&patch| patch as usize >= patches.len()).count();
    if count > 0 {
        return Fate::only(Fault::Broken { count }, Vec::new());
    }
    let shapes: Vec<Shape> = (0..mesh.triangles.len()).map(|t| Shape::of(mesh, t)).collect();
    let degenerate = of_shape(&shapes, |shape| shape.is_degenerate);
    let mut slivers = of_shape(&shapes, |shape| !shape.is_degenerate && shape.least_degrees < SLIVER_DEGREES);
    let least = |t: &u32| shapes.get(*t as usize).map_or(0.0, |shape| shape.least_degrees);
    slivers.sort_by(|a, b| least(a).total_cmp(&least(b)).then(a.cmp(b)));

    let is_whole = |t: usize| mesh.triangles.get(t).is_some_and(|[a, b, c]| a != b && b != c && c != a);
    let whole = mesh.filtered(is_whole);
    let topology = Topology::new(whole.positions.len(), &whole.triangles);
    let pieces = components(whole.positions.len(), &whole.triangles);
    let rims = boundary_loops(&topology);
    let shared = edges(&whole, &topology, lumen_mesh::EdgeUse::is_non_manifold);
    let windings = edges(&whole, &topology, lumen_mesh::EdgeUse::is_flipped);
    let (coincident, duplicates) = (coincident(&whole), duplicates(&whole));
    let (crossing, folds) = (touching(&whole), folds(&whole));
    let volumes = volumes(&whole, &topology, &pieces);
    let inside_out = of_shape(&volumes, |volume| volume.is_some_and(|volume| volume < 0.0));

    let centres = |mesh: &TriMesh, triangles: &[u32]| -> Vec<[f64; 3]> {
        triangles.iter().take(PLACES).map(|&t| middle(&mesh.corners(t as usize)).to_array()).collect()
    };
    let rim_places = rims.iter().take(PLACES).map(|rim| {
        let points: Vec<Vec3> = rim.iter().map(|&v| whole.positions[v as usize]).collect();
        middle(&points).to_array()
    });
    let first_of = |piece: &u32| (0..).zip(&pieces.of_triangle).find(|(_, of)| *of == piece).map(|(t, _)| t);
    let one_each = |pieces: &[u32]| pieces.iter().take(PLACES).filter_map(first_of).collect::<Vec<u32>>();
    let all_pieces: Vec<u32> = (0..pieces.count() as u32).collect();
    let least_degrees = slivers.first().map_or(0.0, least);
    let found = [
        (rims.len(), Fault::OpenRims { count: rims.len() }, rim_places.collect()),
        (crossing.len(), Fault::Crossing { count: crossing.len() }, clusters(&whole, &crossing)),
        (folds.len(), Fault::Folds { count: folds.len() }, clusters(&whole, folds.as_flattened())),
        (shared.len(), Fault::SharedEdges { count: shared.len() }, places(&shared)),
        (duplicates.len(), Fault::Duplicates { count: duplicates.len() }, centres(&whole, &duplicates)),
        (degenerate.len(), Fault::Degenerate { count: degenerate.len() }, centres(mesh, &degenerate)),
        (coincident.len(), Fault::Coincident { count: coincident.len() }, places(&coincident)),
        (windings.len(), Fault::Windings { count: windings.len() }, places(&windings)),
        (inside_out.len(), Fault::InsideOut { count: inside_out.len() }, centres(&whole, &one_each(&inside_out))),
        (slivers.len(), Fault::Slivers { count: slivers.len(), least_degrees }, centres(mesh, &slivers)),
        (
            pieces.count().saturating_sub(1),
            Fault::Pieces { count: pieces.count() },
            centres(&whole, &one_each(&all_pieces)),
        ),
    ];
    let findings =
        found.into_iter().filter(|(count, ..)| *count > 0).map(|(_, fault, places)| Finding { fault, places });
    Fate { findings: findings.collect(), volume_mm3: volumes.iter().copied().sum() }
}

/// How many vertices have no place, and triangles not their vertices.
fn broken(mesh: &TriMesh) -> usize {
    let count = mesh.positions.len();
    let astray = mesh.triangles.iter().filter(|t| t.iter().any(|&v| v as usize >= count)).count();
    astray + mesh.positions.iter().filter(|p| !p.is_finite()).count()
}

/// The shape of a triangle.
struct Shape {
    is_degenerate: bool,
    least_degrees: f64,
}

impl Shape {
    fn of(mesh: &TriMesh, t: usize) -> Self {
        let corners = mesh.corners(t);
        let [a, b, c] = corners.map(Vec3::as_dvec3);
        let longest = [b - a, c - b, a - c].iter().map(|side| side.length_squared()).fold(0.0, f64::max);
        Self {
            // The height over the longest side is twice the area by it.
            is_degenerate: 2.0 * triangle_area(corners) <= FLAT * longest,
            least_degrees: corner_angles(corners).into_iter().fold(180.0, f64::min),
        }
    }
}

/// The numbers of those that are so.
fn of_shape<T>(all: &[T], is_so: impl Fn(&T) -> bool) -> Vec<u32> {
    (0..).zip(all).filter(|(_, one)| is_so(one)).map(|(number, _)| number).collect()
}

/// The middles of the edges that are used so.
fn edges(mesh: &TriMesh, topology: &Topology, is_so: impl Fn(lumen_mesh::EdgeUse) -> bool) -> Vec<DVec3> {
    let found = topology.edges().filter(|&(.., edge)| is_so(edge));
    found.map(|(a, b, _)| middle(&[mesh.positions[a as usize], mesh.positions[b as usize]])).collect()
}

/// The places of vertices that lie where another does.
fn coincident(mesh: &TriMesh) -> Vec<DVec3> {
    // Adding 0 makes one of the two zeros.
    let mut all: Vec<[u32; 3]> = mesh.positions.iter().map(|p| (*p + 0.0).to_array().map(f32::to_bits)).collect();
    all.sort_unstable();
    let doubles = all.windows(2).filter(|pair| pair[0] == pair[1]);
    doubles.map(|pair| Vec3::from_array(pair[0].map(f32::from_bits)).as_dvec3()).collect()
}

/// The triangles over the vertices of an earlier one.
fn duplicates(mesh: &TriMesh) -> Vec<u32> {
    let sorted = |t: &[u32; 3]| {
        let mut t = *t;
        t.sort_unstable();
        t
    };
    let mut all: Vec<([u32; 3], u32)> = mesh.triangles.iter().map(sorted).zip(0..).collect();
    all.sort_unstable();
    let mut doubles: Vec<u32> = all.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| pair[1].1).collect();
    doubles.sort_unstable();
    doubles
}

/// The volume of each piece in mm3; `None` where it is open, or windings disagree.
fn volumes(mesh: &TriMesh, topology: &Topology, pieces: &Components) -> Vec<Option<f64>> {
    let origin = mesh.bounds().centre().as_dvec3();
    let mut volumes = vec![Some(0.0); pieces.count()];
    for (t, &piece) in pieces.of_triangle.iter().enumerate() {
        let [a, b, c] = mesh.corners(t).map(|p| p.as_dvec3() - origin);
        let [u, v, w] = mesh.triangles[t];
        let is_sound = [(u, v), (v, w), (w, u)].into_iter().all(|(from, to)| {
            topology.edge(from, to).is_some_and(|edge| !edge.is_boundary() && edge.forward == edge.backward)
        });
        if let Some(volume) = volumes.get_mut(piece as usize) {
            *volume = volume.filter(|_| is_sound).map(|sum: f64| sum + a.cross(b).dot(c) / 6.0);
        }
    }
    volumes
}

/// The middle of each patch of triangles that hang together.
fn clusters(mesh: &TriMesh, triangles: &[u32]) -> Vec<[f64; 3]> {
    let cut = compacted(&mesh.positions, triangles.iter().map(|&t| mesh.triangles[t as usize]).collect());
    let pieces = components(cut.positions.len(), &cut.triangles);
    let mut sums = vec![DVec3::ZERO; pieces.count()];
    for (t, &piece) in pieces.of_triangle.iter().enumerate() {
        sums[piece as usize] += middle(&cut.corners(t)) / f64::from(pieces.triangle_counts[piece as usize]);
    }
    places(&sums)
}

fn places(all: &[DVec3]) -> Vec<[f64; 3]> {
    all.iter().take(PLACES).map(DVec3::to_array).collect()
}

fn middle(points: &[Vec3]) -> DVec3 {
    points.iter().map(|p| p.as_dvec3()).sum::<DVec3>() / points.len().max(1) as f64
}

#[cfg(test)]
mod tests;
