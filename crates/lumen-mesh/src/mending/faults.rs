//! The faults of a surface, listed with their places and counted. Nothing is changed.

use serde::{Deserialize, Serialize};

use super::holes::{Hole, Opening, holes};
use super::sides::doubles;
use super::wall::Wall;
use crate::disjoint_sets::union;
use crate::task::{Yielder, at_once, blocks};
use crate::{Topology, TriMesh, opposite};

/// Vertices between two looks at the clock.
const SLICE: usize = 32_768;

/// What is wrong with a surface, and where.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// Edges of more than two triangles, by their vertices.
    pub non_manifold_edges: Vec<[u32; 2]>,
    /// Vertices of more than one fan that are on no such edge: there surfaces touch in a point.
    pub non_manifold_vertices: Vec<u32>,
    /// Triangles over the same three vertices as an earlier one, where they share an edge with a third.
    pub doubles: Vec<u32>,
    /// The openings.
    pub holes: Vec<Hole>,
    /// The wall, where the surface is one with two sides; `None` also where that was not looked for.
    pub wall: Option<Wall>,
}

impl Faults {
    /// Those of `mesh`, but for the wall; `topology` must be that of its triangles.
    pub fn of(mesh: &TriMesh, topology: &Topology) -> Self {
        at_once(Self::of_in_slices(mesh, topology, &Yielder::never()))
    }

    /// As [`Self::of`], resting every few milliseconds; what is listed of openings and of triangles that are there twice is one
    /// piece.
    pub async fn of_in_slices(mesh: &TriMesh, topology: &Topology, yielder: &Yielder) -> Self {
        let count = topology.vertex_count();
        let (mut edges, mut vertices, mut fan) = (Vec::new(), Vec::new(), Fan::default());
        for block in blocks(count, SLICE) {
            let end = block.end;
            for v in block.start as u32..end as u32 {
                let row = topology.neighbours(v).iter().zip(topology.edge_uses(v));
                edges.extend(row.filter(|&(&w, edge)| v < w && edge.is_non_manifold()).map(|(&w, _)| [v, w]));
                if fan.is_crowded(mesh, topology, v) {
                    vertices.push(v);
                }
            }
            yielder.rest(end as f32 / count as f32).await;
        }
        let doubles = if edges.is_empty() { Vec::new() } else { doubles(mesh) };
        Self {
            non_manifold_vertices: vertices,
            doubles: (0..).zip(doubles).filter(|&(_, is_double)| is_double).map(|(t, _)| t).collect(),
            holes: holes(mesh, topology),
            non_manifold_edges: edges,
            wall: None,
        }
    }

    /// Those of `mesh` and its wall, in one go.
    pub fn all(mesh: &TriMesh) -> Self {
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let wall = if topology.is_consistent() { super::wall::find(mesh, false).wall } else { None };
        Self { wall, ..Self::of(mesh, &topology) }
    }

    /// The numbers.
    pub fn counts(&self) -> FaultCounts {
        let of = |opening| self.holes.iter().filter(move |hole| hole.opening == opening);
        let largest = of(Opening::Hole).map(|hole| hole.diameter_mm).reduce(f64::max);
        FaultCounts {
            non_manifold_edges: self.non_manifold_edges.len(),
            non_manifold_vertices: self.non_manifold_vertices.len(),
            holes: of(Opening::Hole).count(),
            largest_hole_mm: largest,
            vessel_ends: of(Opening::VesselEnd).count(),
            sheet_edges: of(Opening::Edge).count(),
            wall: self.wall,
        }
    }
}

/// The faults of a surface in numbers. The names of the fields are public and stay.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FaultCounts {
    /// Edges of more than two triangles.
    pub non_manifold_edges: usize,
    /// Vertices, on no such edge, where fans of triangles touch.
    pub non_manifold_vertices: usize,
    /// Holes in walls.
    pub holes: usize,
    /// The largest distance across one, in mm; null where there is none.
    pub largest_hole_mm: Option<f64>,
    /// Open ends of vessels.
    pub vessel_ends: usize,
    /// Outer edges of sheets.
    pub sheet_edges: usize,
    /// The wall, where the surface is one with two sides.
    pub wall: Option<Wall>,
}

/// The walk around a vertex; keeps its lists.
#[derive(Debug, Default)]
struct Fan {
    /// The two other corners of each triangle, each with the number of the triangle.
    spokes: Vec<(u32, u32)>,
    group: Vec<u32>,
}

impl Fan {
    /// Whether the triangles of `v` are not one fan, though none of its edges has more than two.
    fn is_crowded(&mut self, mesh: &TriMesh, topology: &Topology, v: u32) -> bool {
        let (around, uses) = (topology.triangles(v), topology.edge_uses(v));
        let open = uses.iter().filter(|edge| edge.is_boundary()).count();
        if uses.iter().any(|edge| edge.is_non_manifold()) || (open > 0 && around.len() == 1) {
            return false;
        }
        // Each fan that is not closed has two open ends.
        if open > 2 {
            return true;
        }
        if open == 0 && is_closed_fan(mesh, around, v) {
            return false;
        }
        self.spokes.clear();
        for (i, &t) in (0u32..).zip(around) {
            self.spokes.extend(mesh.triangles[t as usize].into_iter().filter(|&w| w != v).map(|w| (w, i)));
        }
        self.spokes.sort_unstable();
        self.group.clear();
        self.group.extend(0..around.len() as u32);
        let mut groups = around.len();
        for pair in self.spokes.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            if union(&mut self.group, pair[0].1, pair[1].1).is_some() {
                groups -= 1;
            }
        }
        groups > 1
    }
}

/// The most triangles that [`is_closed_fan`] walks around.
const SMALL: usize = 12;

/// Whether a walk from triangle to triangle around `v`, all of one winding and few, comes by all of them, as nearly
/// everywhere.
fn is_closed_fan(mesh: &TriMesh, around: &[u32], v: u32) -> bool {
    if around.is_empty() || around.len() > SMALL {
        return false;
    }
    let mut others = [[0u32; 2]; SMALL];
    for (other, &t) in others.iter_mut().zip(around) {
        *other = opposite(mesh.triangles[t as usize], v);
    }
    let others = &others[..around.len()];
    let (mut at, mut passed) = (others[0][1], 1);
    while at != others[0][0] && passed < others.len() {
        let Some(next) = others.iter().find(|other| other[0] == at) else { return false };
        at = next[1];
        passed += 1;
    }
    at == others[0][0] && passed == others.len()
}

/// A kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum FaultKind {
    /// An edge of more than two triangles.
    Edge,
    /// A vertex where fans touch.
    Vertex,
    /// A hole in a wall.
    Hole,
    /// The open end of a vessel.
    VesselEnd,
}

/// Where a fault is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FaultPlace {
    /// What it is.
    pub kind: FaultKind,
    /// Its middle, in mm.
    pub at_mm: [f32; 3],
    /// How far across it is, in mm; 0 for a point.
    pub size_mm: f32,
    /// What is drawn: a chain of places in mm, closed for openings.
    pub line: Vec<[f32; 3]>,
}

/// Places that are told of each kind, and of a rim.
const TOLD: usize = 200;
const RIM: usize = 96;

impl Faults {
    /// Where they are in `mesh`, in which they were found: of each kind the first `TOLD`, the largest holes first.
    pub fn places(&self, mesh: &TriMesh) -> Vec<FaultPlace> {
        let at = |v: u32| mesh.positions[v as usize];
        let edges = self.non_manifold_edges.iter().take(TOLD).map(|&[a, b]| FaultPlace {
            kind: FaultKind::Edge,
            at_mm: at(a).midpoint(at(b)).to_array(),
            size_mm: at(a).distance(at(b)),
            line: vec![at(a).to_array(), at(b).to_array()],
        });
        let vertices = self.non_manifold_vertices.iter().take(TOLD).map(|&v| FaultPlace {
            kind: FaultKind::Vertex,
            at_mm: at(v).to_array(),
            size_mm: 0.0,
            line: Vec::new(),
        });
        let of = |opening, kind| {
            let mut found: Vec<&Hole> = self.holes.iter().filter(|hole| hole.opening == opening).collect();
            found.sort_by(|a, b| b.diameter_mm.total_cmp(&a.diameter_mm));
            found.truncate(TOLD);
            found.into_iter().map(move |hole| FaultPlace {
                kind,
                at_mm: hole.centre.to_array(),
                size_mm: hole.diameter_mm as f32,
                line: hole.rim.iter().step_by(hole.rim.len().div_ceil(RIM)).map(|&v| at(v).to_array()).collect(),
            })
        };
        let holes = of(Opening::Hole, FaultKind::Hole).chain(of(Opening::VesselEnd, FaultKind::VesselEnd));
        edges.chain(vertices).chain(holes).collect()
    }
}
