//! A watertight wrap: a closed surface within a tolerance of what can be anything, in place of it.
//!
//! What is wrapped may be a soup of triangles that cross, of sheets that share edges or lie double, with gaps and with pieces
//! inside. As alpha wrapping does (Portaneri, Rouxel-Labbé, Hemmer, Cohen-Steiner and Alliez, "Alpha wrapping with an offset",
//! 2022), a flood from outside is stopped where it is near to the surface, so that it passes no gap narrower than the
//! tolerance; here it runs on a sparse grid (`grid`), and the border of what it reached, which marching cubes make, is laid
//! back onto the surface (`fit`). Alpha wrapping leaves it an offset away. With a tolerance of T,
//!
//! ```text
//! points are blocked within T / 2 of the surface
//! points are T / sqrt(3) apart
//! so the border is within T / 2 + sqrt(3) / 2 T / sqrt(3) = T of it
//! ```
//!
//! and no vessel end may let the flood in: rims are welded within the tolerance first, holes filled
//! (`lumen_mesh::mending`), and each open end of a vessel gets a lid for as long as the flood runs. An end that lies in a plane,
//! within half of the tolerance, is cut open again just inside of its rim; of any other the lid is taken off where ends are
//! cut after.
//!
//! What lies inside is gone, and gaps and crevices narrower than the tolerance are closed. A wall with two sides whose lumen can
//! be reached keeps both. An open end of a soup whose triangles are farther apart than the tolerance is not known for one: the
//! flood goes in, and what is wrapped is the wall; where a lid shows that, a note says so.

mod fit;
mod grid;

use std::ops::Range;

use glam::DVec3;
use lumen_mesh::cut::area_and_middle;
use lumen_mesh::mending::Faults;
use lumen_mesh::mending::fill::fill_in_slices;
use lumen_mesh::mending::holes::{Hole, Opening, holes};
use lumen_mesh::mending::split::split;
use lumen_mesh::mending::weld::weld_in_slices;
use lumen_mesh::task::Yielder;
use lumen_mesh::winding::make_consistent;
use lumen_mesh::{SurfaceIndex, Topology, TriMesh, Vec3, boundary_loops, components, reach, surface_area};
use lumen_volume::MarchingCubes;

use self::fit::fit;
use self::grid::{Inside, Outside, least_step};
use crate::cuts::cut_at;
use crate::ends::{EndPlane, plane};
use crate::notes::{Note, PrepareError, Reason};

/// The part of the tolerance within which the flood is stopped, and the distance between the points of its grid.
const REACH: f64 = 0.5;
const STEP: f64 = 0.577;
/// The parts of the tolerance within which the rim of an end lies in a plane, and by which it is cut inside of that.
const FLAT: f64 = 0.5;
const INSIDE: f64 = 0.35;
/// The tolerance may be this part of the width of the whole, which is the second largest of its extents.
const MOST_OF_WIDTH: f64 = 0.5;
/// Triangles of a wrap, at most.
pub const MOST_TRIANGLES: usize = 6_000_000;

/// The rim of a vessel's end with its lid.
struct Lid {
    centre: DVec3,
    /// Out of the vessel, of length 1.
    normal: DVec3,
    area_mm2: f64,
    /// How far the rim reaches to either side of its plane, in mm.
    inwards_mm: f64,
    outwards_mm: f64,
    /// Its triangles.
    triangles: Range<u32>,
}

impl Lid {
    fn radius_mm(&self) -> f64 {
        (self.area_mm2 / std::f64::consts::PI).sqrt()
    }

    /// Whether `other` lies on it, within `tolerance`.
    fn covers(&self, other: &Self, tolerance: f64) -> bool {
        let from = other.centre - self.centre;
        let across = from.dot(self.normal);
        across.abs() < 2.0 * tolerance && (from - self.normal * across).length() < self.radius_mm()
    }
}

/// A closed surface within `tolerance_mm` of `mesh`, open at the ends of vessels: at those that lie in no plane only where
/// they `are_cut` after, else they stay closed.
///
/// # Errors
/// [`PrepareError::Wrap`], where that takes too many points or triangles; [`PrepareError::WrapCoarse`].
pub async fn wrap(
    mesh: &TriMesh,
    tolerance_mm: f64,
    are_cut: bool,
    notes: &mut Vec<Note>,
    yielder: &Yielder,
) -> Result<TriMesh, PrepareError> {
    let step = STEP * tolerance_mm;
    let extent = mesh.bounds().size().as_dvec3();
    let mut sides = extent.to_array();
    sides.sort_unstable_by(f64::total_cmp);
    let most_mm = MOST_OF_WIDTH * sides[1];
    if tolerance_mm > most_mm {
        return Err(PrepareError::WrapCoarse { tolerance_mm, most_mm });
    }
    let least_step = least_step(extent);
    let too_fine = |least_mm: f64| PrepareError::Wrap { tolerance_mm, least_mm: rounded_up(least_mm) };
    // Marching cubes make two triangles for each square of the grid where the surface is level, and more where it is not.
    let by_area = (3.5 * surface_area(mesh) / MOST_TRIANGLES as f64).sqrt() / STEP;
    if step < least_step {
        return Err(too_fine(by_area.max(least_step / STEP)));
    }
    let Closed { mesh: closed, lids } = closed(mesh, tolerance_mm, notes, &yielder.part(0.0..0.2)).await;
    let outside = Outside::of(&closed, step, REACH * tolerance_mm, &yielder.part(0.2..0.4)).await;
    let cubes = MarchingCubes::new(&outside.geometry(), Inside { of: &outside, slice: 0 });
    let Some(mut mesh) = cubes.surface(MOST_TRIANGLES, &yielder.part(0.4..0.5)).await else {
        return Err(too_fine(by_area.max(1.5 * tolerance_mm)));
    };
    let index = SurfaceIndex::build(&closed.positions, &closed.triangles, &yielder.part(0.5..0.55)).await;
    fit(&mut mesh, &index, &outside, tolerance_mm, &yielder.part(0.55..0.9)).await;
    let found = reach(&mesh, &index, 0.0, &yielder.part(0.9..0.98)).await;
    let deviation_mm = found.map_or(0.0, |found| found.farthest.distance);
    notes.push(Note::Wrapped { deviation_mm });
    if let Some(lid) = lids.iter().find(|lid| lid.is_flooded(&outside, tolerance_mm)) {
        notes.push(Note::WrapHollow { at: lid.centre.as_vec3().to_array() });
    }
    let seen = |lid: &Lid| lid.plane(&outside, tolerance_mm);
    let (flat, ragged): (Vec<_>, Vec<_>) =
        lids.iter().filter_map(|lid| Some((lid, seen(lid)?))).partition(|(lid, _)| lid.is_flat(tolerance_mm));
    let planes: Vec<EndPlane> = flat.into_iter().map(|(_, plane)| plane).collect();
    let mesh = cut_at(mesh, &planes, notes).0;
    if !are_cut {
        let at = |lid: &Lid| lid.centre.as_vec3().to_array();
        notes.extend(ragged.iter().map(|(lid, _)| Note::AsWall { at: at(lid), why: Reason::NotFlat }));
    }
    if !are_cut || ragged.is_empty() {
        return Ok(mesh);
    }
    // Where a plane would take more than the tolerance the lid itself comes off.
    let is_of_lid = |t: usize| {
        let middle = mesh.corners(t).iter().sum::<Vec3>() / 3.0;
        let nearest = index.nearest(middle);
        nearest.is_some_and(|nearest| ragged.iter().any(|(lid, _)| lid.triangles.contains(&nearest.triangle)))
    };
    Ok(without(&mesh, is_of_lid))
}

/// The next number of two digits.
fn rounded_up(mm: f64) -> f64 {
    let unit = libm::pow(10.0, libm::floor(libm::log10(mm)) - 1.0);
    libm::ceil(mm / unit) * unit
}

/// The surface without some of its triangles, those at vertices where what is left would only touch, and crumbs.
fn without(mesh: &TriMesh, goes: impl Fn(usize) -> bool) -> TriMesh {
    let mut stay: Vec<usize> = (0..mesh.triangles.len()).filter(|&t| !goes(t)).collect();
    let triangles = |stay: &[usize]| stay.iter().map(|&t| mesh.triangles[t]).collect::<Vec<_>>();
    let mut open = TriMesh { positions: mesh.positions.clone(), triangles: triangles(&stay) };
    loop {
        let topology = Topology::new(open.positions.len(), &open.triangles);
        let touching = Faults::of(&open, &topology).non_manifold_vertices;
        if touching.is_empty() {
            break;
        }
        stay.retain(|&t| mesh.triangles[t].iter().all(|v| touching.binary_search(v).is_err()));
        open.triangles = triangles(&stay);
    }
    let before = components(mesh.positions.len(), &mesh.triangles);
    let after = components(open.positions.len(), &open.triangles);
    // For each piece of before its largest part.
    let mut largest = vec![u32::MAX; before.count()];
    let size = |part: u32| after.triangle_counts.get(part as usize).copied().unwrap_or(0);
    for (&t, &part) in stay.iter().zip(&after.of_triangle) {
        let largest = &mut largest[before.of_triangle[t] as usize];
        if size(part) > size(*largest) {
            *largest = part;
        }
    }
    open.filtered(|t| largest.contains(&after.of_triangle[t]))
}

/// What is to be wrapped, without openings wider than the tolerance.
struct Closed {
    mesh: TriMesh,
    /// The ends of vessels, the widest first.
    lids: Vec<Lid>,
}

/// Fills the holes of `mesh` and puts lids on the ends of vessels.
async fn closed(mesh: &TriMesh, tolerance_mm: f64, notes: &mut Vec<Note>, yielder: &Yielder) -> Closed {
    let mesh = weld_in_slices(&split(mesh).mesh, tolerance_mm, &yielder.part(0.0..0.4)).await.mesh;
    let mut mesh = split(&mesh).mesh;
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let pieces = components(mesh.positions.len(), &mesh.triangles);
    make_consistent(&mut mesh.triangles, &topology, &pieces);
    let found = holes(&mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
    yielder.rest(0.5).await;
    // What is narrower than the tolerance is closed by the flood, and needs no more than to be no hole.
    for hole in found.iter().filter(|hole| hole.diameter_mm <= tolerance_mm) {
        fan(&mut mesh, &hole.rim, hole.centre.as_dvec3());
    }
    let filled = fill_in_slices(&mesh, f64::INFINITY, &yielder.part(0.5..1.0)).await;
    if filled.filled > 0 {
        notes.push(Note::Filled { count: filled.filled });
    }
    let mut mesh = filled.mesh;
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let is_edge = |hole: &Hole| hole.opening == Opening::Edge;
    let edges: Vec<Vec<u32>> = holes(&mesh, &topology).into_iter().filter(is_edge).map(|hole| hole.rim).collect();
    let mut lids = Vec::new();
    // A ragged rim that passes a vertex twice is no hole, and lets the flood in.
    for rim in boundary_loops(&topology).iter().filter(|rim| !edges.contains(rim)) {
        let points: Vec<DVec3> = rim.iter().map(|&v| mesh.positions[v as usize].as_dvec3()).collect();
        let first = mesh.triangles.len() as u32;
        fan(&mut mesh, rim, points.iter().sum::<DVec3>() / points.len() as f64);
        lids.extend(Lid::of(&points, first..mesh.triangles.len() as u32));
    }
    lids.sort_by(|a, b| b.area_mm2.total_cmp(&a.area_mm2));
    let mut kept: Vec<Lid> = Vec::new();
    for lid in lids {
        // Of two layers the inner one ends at the same place.
        if !kept.iter().any(|known| known.covers(&lid, tolerance_mm)) {
            kept.push(lid);
        }
    }
    Closed { mesh, lids: kept }
}

/// Closes a rim by triangles around a point.
fn fan(mesh: &mut TriMesh, rim: &[u32], middle: DVec3) {
    let apex = mesh.positions.len() as u32;
    mesh.positions.push(middle.as_vec3());
    mesh.triangles.extend((0..rim.len()).map(|i| [rim[(i + 1) % rim.len()], rim[i], apex]));
}

impl Lid {
    /// The lid of these triangles on a rim through these points; `None` where it encloses no area.
    fn of(points: &[DVec3], triangles: Range<u32>) -> Option<Self> {
        let (mean, normal) = plane(points)?;
        let (area, centre) = area_and_middle(points, mean, normal);
        let heights = points.iter().map(|&p| (p - centre).dot(normal));
        let (low, high) = heights.fold((0.0f64, 0.0f64), |(low, high), height| (low.min(height), high.max(height)));
        Some(Self { centre, normal, area_mm2: area.abs(), inwards_mm: -low, outwards_mm: high, triangles })
    }

    fn is_flat(&self, tolerance_mm: f64) -> bool {
        self.inwards_mm + self.outwards_mm <= FLAT * tolerance_mm
    }

    /// Whether the end is outside on both sides: the flood went in.
    fn is_flooded(&self, outside: &Outside, tolerance_mm: f64) -> bool {
        self.is_outside(outside, tolerance_mm) == [true; 2]
    }

    /// Whether what lies before and behind the lid is outside.
    fn is_outside(&self, outside: &Outside, tolerance_mm: f64) -> [bool; 2] {
        let before = |normal: DVec3, mm: f64| outside.has(self.centre + normal * (mm + 2.0 * tolerance_mm));
        [before(self.normal, self.outwards_mm), before(-self.normal, self.inwards_mm)]
    }

    /// Where the end is cut open; `None` where it is not seen from outside on one side alone.
    fn plane(&self, outside: &Outside, tolerance_mm: f64) -> Option<EndPlane> {
        let (normal, inwards_mm) = match self.is_outside(outside, tolerance_mm) {
            [true, false] => (self.normal, self.inwards_mm),
            [false, true] => (-self.normal, self.outwards_mm),
            _ => return None,
        };
        let arc_mm = inwards_mm + INSIDE * tolerance_mm;
        let (centre, radius_mm) = (self.centre - normal * arc_mm, self.radius_mm());
        Some(EndPlane { branch: None, at_end: false, centre, normal, radius_mm, roundness: 1.0, arc_mm })
    }
}

#[cfg(test)]
mod tests;
