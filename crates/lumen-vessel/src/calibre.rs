//! The calibre of a surface along given centrelines: the area of its cross-section and its inscribed radius at each
//! station, in slices.

use std::sync::Arc;

use glam::DVec3;

use super::section::{Found, Shell, Wall};
use super::space::Space;
use super::stations::Station;
use lumen_mesh::parallel;
use lumen_mesh::task::{Yielder, blocks};
use lumen_mesh::{SurfaceIndex, Topology, TriMesh};

/// Stations that are measured between two looks at the clock, and in one piece.
const BATCH: usize = 64;
const PIECE: usize = 8;

/// A surface that is measured.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The surface.
    pub mesh: Arc<TriMesh>,
    /// Adjacency of its triangles.
    pub topology: Arc<Topology>,
    /// An index of it; built where there is none.
    pub index: Option<Arc<SurfaceIndex>>,
}

impl Subject {
    /// Of a surface by itself. Triangles that repeat a vertex are left out.
    pub fn new(mesh: &Arc<TriMesh>) -> Self {
        let is_whole = |&[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
        let mesh = if mesh.triangles.iter().all(is_whole) {
            mesh.clone()
        } else {
            Arc::new(mesh.filtered(|t| is_whole(&mesh.triangles[t])))
        };
        let topology = Arc::new(Topology::new(mesh.positions.len(), &mesh.triangles));
        Self { mesh, topology, index: None }
    }

    /// The space that it bounds.
    pub(super) async fn space(&self, yielder: &Yielder) -> Space {
        let index = SurfaceIndex::known_or_built(self.index.clone(), &self.mesh, yielder).await;
        Space::new(&self.mesh, &self.topology, index)
    }
}

/// What is asked for at a station.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// The cross-section, which alone verdicts are made of.
    Section,
    /// The largest ball inside there, too: more than half of the time.
    SectionAndBall,
}

/// What a surface has at a station.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Calibre {
    /// Area of the cross-section in mm2: 0 where the vessel is gone, `None` where the cut does not close.
    pub area_mm2: Option<f64>,
    /// Radius of the largest ball inside there, in mm: 0 where the vessel is gone, `None` also where it was not asked for.
    pub inscribed_mm: Option<f64>,
    /// Centroid of the cross-section in mm.
    pub middle_mm: Option<DVec3>,
    /// A triangle that the cross-section goes through.
    pub(super) triangle: Option<u32>,
    /// Whether the cross-section is another loop than on the surface that this one was made from.
    pub(super) is_another_loop: bool,
}

/// What is known of the vessels when a surface is measured that was made from one that is measured already.
#[derive(Clone, Copy)]
pub(super) struct Known<'a> {
    /// What the vessel has at each station of the opened surface, in mm.
    pub(super) radii: &'a [f64],
    /// The surface that it was made from, and what that has there.
    pub(super) before: &'a Subject,
    pub(super) calibres: &'a [Calibre],
}

/// Measures `subject`, which bounds `space`, at the stations. Nothing is known if the stations are of this surface.
pub(super) async fn measure(
    subject: &Subject,
    space: &Space,
    stations: &[Station],
    (asked, known): (Asked, Option<Known<'_>>),
    yielder: &Yielder,
) -> Vec<Calibre> {
    let wall = Wall { shell: Shell { mesh: &subject.mesh, topology: &subject.topology }, index: &space.index };
    let mut found = Vec::with_capacity(stations.len());
    for block in blocks(stations.len(), BATCH) {
        let first = block.start;
        let one = |i: usize| at_station(wall, space, &stations[first + i], (asked, known), first + i);
        let measured = parallel::map_ranges(block.len(), PIECE, |piece| piece.map(one).collect::<Vec<_>>());
        found.extend(measured.into_iter().flatten());
        yielder.rest(found.len() as f32 / stations.len() as f32).await;
    }
    found
}

/// Radius in mm of the ball in the middle of the vessel, wherever that has moved to; `may_move` on a surface that was made from
/// the one of the stations.
fn inscribed(space: &Space, at: DVec3, found: &Found, may_move: bool) -> Option<f64> {
    let middle = match found {
        Found::Closed(section) if may_move && !space.is_inside(at.as_vec3()) => section.middle,
        Found::Gone => return Some(0.0),
        _ => at,
    };
    if !space.is_inside(middle.as_vec3()) {
        return None;
    }
    space.largest(middle).map(|ball| f64::from(ball.radius))
}

/// What the surface has at one of the stations, which has this `number`.
fn at_station(
    wall: Wall<'_>,
    space: &Space,
    station: &Station,
    (asked, known): (Asked, Option<Known<'_>>),
    number: usize,
) -> Calibre {
    let Station { at, direction, .. } = *station;
    let found = match known {
        None => wall.section(at, direction).map_or(Found::Open, Found::Closed),
        Some(known) => wall.follow(space, at, direction, known.radii[number]),
    };
    let inscribed = match asked {
        Asked::Section => None,
        Asked::SectionAndBall => inscribed(space, at, &found, known.is_some()),
    };
    let section = match found {
        Found::Closed(section) => Some(section),
        Found::Open | Found::Gone => None,
    };
    let is_another_loop = known.zip(section).is_some_and(|(known, section)| {
        let Subject { mesh, topology, .. } = known.before;
        let before = &known.calibres[number];
        let has_another = |loop_before| {
            Shell { mesh, topology }.has_another_loop(loop_before, at, direction, &space.index, section.area)
        };
        before.triangle.zip(before.area_mm2).is_some_and(has_another)
    });
    Calibre {
        area_mm2: found.area(),
        inscribed_mm: inscribed,
        middle_mm: section.map(|section| section.middle),
        triangle: section.map(|section| section.triangle),
        is_another_loop,
    }
}
