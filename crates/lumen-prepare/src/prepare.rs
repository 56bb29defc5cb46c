//! All of it in one call: the largest piece, uncross, clip, extend, cap, remesh, check.

use glam::DVec3;
use thiserror::Error;

use super::cap::{CapError, CapKind, cap};
use super::check::{Fate, check};
use super::clip::{ClipError, Clipped, clip};
use super::ends::{
    EndError, EndPlane, Length, OpenEnd, RimError, SurfaceError, check_surface, open_ends, place,
    planes_of_uneven_openings, propose,
};
use super::extend::{ExtendError, Extended, extend};
use super::remesh::{Deviation, Quality, RemeshError, Remeshed, Sizing, remesh};
use super::uncross::{UncrossError, Uncrossed, uncross};
use super::{Patch, PatchKind, Patched};
use lumen_mesh::mending::fill::fill;
use lumen_mesh::mending::split::split;
use lumen_mesh::task::{Yielder, at_once};
use lumen_mesh::{Topology, TriMesh, Vec3, boundary_loops, compacted, components, flat_caps, triangle_area};
use lumen_vessel::width::widths;
use lumen_vessel::{End, Tree, TreeError};

/// An extension that would run into something is as long as this part of what is free.
const OF_FREE: f64 = 0.9;

/// An end is flat where no vertex of it is farther than this part of its radius from its plane; what is opened may be a
/// hundredth off.
const FLAT: f64 = 0.011;
/// Times for each end that extensions are tried.
const ROUNDS: usize = 4;

/// Where vessels are cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClipAt {
    /// As near to each end as the vessel is round there.
    Round,
    /// At this distance from each end.
    Distance(Length),
}

/// What is done to a surface, from top to bottom.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Plan {
    /// Whether triangles that cross are taken apart first.
    pub uncross: bool,
    /// Where ends are cut square to the vessel; `None` leaves them.
    pub clip: Option<ClipAt>,
    /// How long the extensions are; `None` for none.
    pub extend: Option<Length>,
    /// How ends are closed; `None` leaves them open.
    pub cap: Option<CapKind>,
    /// How large triangles are; `None` leaves them as they are.
    pub remesh: Option<Sizing>,
}

/// Something that was done otherwise than asked for.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Note {
    /// Pieces are left out.
    #[error("of {} pieces the largest is taken", others + 1)]
    LeftOut {
        /// How many others there were.
        others: usize,
    },
    /// An end has no plane.
    #[error("an end is not cut: {0}")]
    NoPlane(#[from] EndError),
    /// A plane does not cut.
    #[error("the end at ({:.1}, {:.1}, {:.1}) is not cut: {why}", at[0], at[1], at[2])]
    NotCut {
        /// The middle of the plane, in mm.
        at: [f64; 3],
        /// Why not.
        why: ClipError,
    },
    /// Nothing is extended or closed.
    #[error("no end was found that could be extended or closed: cut the ends first (--clip)")]
    NoEnds,
    /// Holes of the wall are filled.
    #[error("{count} holes of the wall are filled")]
    Filled {
        /// How many.
        count: usize,
    },
    /// A loop is no end.
    #[error("an opening is closed as a part of the wall: {0}")]
    NoEnd(#[from] RimError),
    /// An extension is shorter.
    #[error("the extension of {name} is only {mm:.1} mm long: farther on it would run into something")]
    Shortened {
        /// The end.
        name: String,
        /// How long it is, in mm.
        mm: f64,
    },
    /// An end is not extended.
    #[error("{name} is not extended: {why}")]
    NotExtended {
        /// The end.
        name: String,
        /// Why not.
        why: ExtendError,
    },
}

/// Why a surface cannot be prepared.
#[derive(Debug, Error)]
pub enum PrepareError {
    /// The surface is broken.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// Ends are to be cut and there is no vessel.
    #[error("no end can be found: {0}")]
    Tree(#[from] TreeError),
    /// Crossing triangles cannot be taken apart.
    #[error(transparent)]
    Uncross(#[from] UncrossError),
    /// An end cannot be closed.
    #[error(transparent)]
    Cap(#[from] CapError),
    /// Its triangles cannot be made anew.
    #[error(transparent)]
    Remesh(#[from] RemeshError),
}

/// A surface that was prepared.
#[derive(Clone, Debug)]
pub struct Prepared {
    /// The surface in patches, with their areas.
    pub surface: Patched,
    /// What a volume mesher would say.
    pub fate: Fate,
    /// What was done otherwise than asked for.
    pub notes: Vec<Note>,
    /// What became of triangles that crossed, where that was asked for.
    pub uncrossed: Option<Uncrossed>,
    /// How well the triangles are shaped, and how far they went before ends were brought back to their areas, where they were
    /// made anew.
    pub remeshed: Option<(Quality, Deviation)>,
}

/// Prepares a surface.
///
/// # Errors
/// [`PrepareError`]. A single end that cannot be cut or extended is a [`Note`].
pub fn prepare(mesh: &TriMesh, plan: &Plan) -> Result<Prepared, PrepareError> {
    check_surface(mesh)?;
    let mut notes = Vec::new();
    // Edges of more than two triangles are no place to part surfaces at, and no mesher takes them.
    let (mesh, others) = largest_piece(split(mesh).mesh);
    if others > 0 {
        notes.push(Note::LeftOut { others });
    }
    let (mut mesh, uncrossed) = if plan.uncross {
        let mut found = uncross(&mesh)?;
        (largest_piece(std::mem::take(&mut found.mesh)).0, Some(found))
    } else {
        (mesh, None)
    };
    if let Some(at) = plan.clip {
        mesh = clipped(mesh, at, &mut notes)?;
    }
    let mut surface = if plan.extend.is_some() || plan.cap.is_some() {
        // What is flat and closed is an end like those that are open.
        let (walls, had_caps) = opened(&mesh);
        let (mesh, ends) = without_holes(&largest_piece(walls).0, &mut notes)?;
        if ends.is_empty() {
            notes.push(Note::NoEnds);
        }
        let (mesh, ends) = match plan.extend.filter(|_| !ends.is_empty()) {
            Some(length) => extended(mesh, ends, length, &mut notes),
            None => (mesh, ends),
        };
        // What was closed is closed again.
        match plan.cap.or(had_caps.then_some(CapKind::Planar)).filter(|_| !ends.is_empty()) {
            Some(kind) => cap(&mesh, &ends, kind)?,
            None => Patched::wall(mesh),
        }
    } else {
        in_patches(mesh)
    };
    measure(&mut surface);
    let mut remeshed = None;
    if let Some(sizing) = &plan.remesh {
        let radii = radii(&surface);
        let Remeshed { surface: new, deviation, .. } = remesh(&surface, &radii, sizing)?;
        surface = new;
        hold_areas(&mut surface);
        remeshed = Some((Quality::of(&surface.mesh), deviation));
        measure(&mut surface);
    }
    let fate = check(&surface);
    Ok(Prepared { surface, fate, notes, uncrossed, remeshed })
}

/// The surface cut at its ends, as many of them as can be.
fn clipped(mesh: TriMesh, at: ClipAt, notes: &mut Vec<Note>) -> Result<TriMesh, PrepareError> {
    let tree = Tree::new(&mesh)?;
    let planes = match at {
        ClipAt::Round => {
            let proposal = propose(&mesh, &tree)?;
            notes.extend(proposal.refused.into_iter().map(Note::NoPlane));
            proposal.planes
        }
        ClipAt::Distance(distance) => {
            let mut planes = Vec::new();
            for branch in tree.branches() {
                for at_end in [false, true].into_iter().filter(|&at| branch.ends[usize::from(at)] != End::Joint) {
                    match place(&mesh, &tree, branch.id, at_end, distance) {
                        Ok(plane) => planes.push(plane),
                        Err(error) => notes.push(error.into()),
                    }
                }
            }
            planes
        }
    };
    let mesh = cut_at(mesh, &planes, notes);
    // An end that is too near a fork for such a plane is cut just inside of its rim, where that is uneven.
    let planes = planes_of_uneven_openings(&mesh)?;
    Ok(cut_at(mesh, &planes, notes))
}

/// The surface cut at those planes that cut it.
fn cut_at(mesh: TriMesh, planes: &[EndPlane], notes: &mut Vec<Note>) -> TriMesh {
    let (first, error) = match (clip(&mesh, planes), planes) {
        (_, []) => return mesh,
        (Ok(Clipped { mesh, .. }), _) => return mesh,
        (Err(error), [first, ..]) => (first, error),
    };
    let failed = error.end().filter(|&end| end < planes.len());
    match failed {
        // The others are cut without it.
        Some(failed) => {
            notes.push(Note::NotCut { at: planes[failed].centre.to_array(), why: error });
            let mesh = cut_at(mesh, &planes[..failed], notes);
            cut_at(mesh, &planes[failed + 1..], notes)
        }
        // It is one of them: each by itself shows which.
        None if planes.len() > 1 => {
            planes.iter().fold(mesh, |mesh, plane| cut_at(mesh, std::slice::from_ref(plane), notes))
        }
        None => {
            notes.push(Note::NotCut { at: first.centre.to_array(), why: error });
            mesh
        }
    }
}

/// The largest piece of a surface, and how many others there were.
fn largest_piece(mesh: TriMesh) -> (TriMesh, usize) {
    let pieces = components(mesh.positions.len(), &mesh.triangles);
    match pieces.largest().filter(|_| pieces.count() > 1) {
        Some(largest) => (mesh.filtered(|t| pieces.of_triangle[t] == largest), pieces.count() - 1),
        None => (mesh, 0),
    }
}

/// The surface without its flat caps, and whether it had some.
fn opened(mesh: &TriMesh) -> (TriMesh, bool) {
    let caps = flat_caps(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
    let mut is_cap = vec![false; mesh.triangles.len()];
    caps.iter().flat_map(|cap| &cap.triangles).for_each(|&t| is_cap[t as usize] = true);
    let walls = mesh.triangles.iter().zip(&is_cap).filter(|(_, is_cap)| !**is_cap).map(|(&t, _)| t).collect();
    (compacted(&mesh.positions, walls), !caps.is_empty())
}

/// The surface and its ends with extensions, as long as there is room for.
fn extended(mesh: TriMesh, ends: Vec<OpenEnd>, length: Length, notes: &mut Vec<Note>) -> (TriMesh, Vec<OpenEnd>) {
    let mut lengths = vec![Some(length); ends.len()];
    // Each time at least one is shorter, or left as it is.
    for _ in 0..=ROUNDS * ends.len() {
        let (with, of): (Vec<OpenEnd>, Vec<Length>) =
            ends.iter().zip(&lengths).filter_map(|(end, length)| Some((end.clone(), (*length)?))).unzip();
        if with.is_empty() {
            break;
        }
        let free = match extend(&mesh, &with, &of) {
            Ok(Extended { mesh, ends: mut done, .. }) => {
                let without = ends.iter().zip(&lengths).filter(|(_, length)| length.is_none());
                done.extend(without.map(|(end, _)| end.clone()));
                done.sort_by_key(|end| ends.iter().position(|before| before.name == end.name));
                return (mesh, done);
            }
            Err(ExtendError::Collides { free }) => free,
            Err(error) => {
                // Each by itself shows which.
                let mut is_found = false;
                for (i, end) in ends.iter().enumerate() {
                    let alone = lengths[i].map(|length| extend(&mesh, std::slice::from_ref(end), &[length]));
                    if let Some(Err(error)) = alone
                        && !matches!(error, ExtendError::Collides { .. })
                    {
                        (lengths[i], is_found) = (None, true);
                        notes.push(Note::NotExtended { name: end.name.clone(), why: error });
                    }
                }
                if !is_found {
                    notes.push(Note::NotExtended { name: "every end".to_owned(), why: error });
                    break;
                }
                continue;
            }
        };
        for (name, mm) in free {
            let Some(i) = ends.iter().position(|end| end.name == name) else { continue };
            // Less than a tenth of the radius is none.
            let mm = if OF_FREE * mm > 0.1 * ends[i].radius_mm() { OF_FREE * mm } else { 0.0 };
            lengths[i] = (mm > 0.0).then_some(Length::Mm(mm));
            notes.retain(|note| !matches!(note, Note::Shortened { name: known, .. } if *known == name));
            notes.push(Note::Shortened { name, mm });
        }
    }
    // None is made: whatever was to be shorter is not there.
    for note in notes.iter_mut() {
        if let Note::Shortened { mm, .. } = note {
            *mm = 0.0;
        }
    }
    (mesh, ends)
}

/// Fills the holes of the wall; openings that are neither holes nor among `ends` are closed by a fan.
fn without_holes(mesh: &TriMesh, notes: &mut Vec<Note>) -> Result<(TriMesh, Vec<OpenEnd>), PrepareError> {
    let filled = fill(mesh, f64::INFINITY);
    if filled.filled > 0 {
        notes.push(Note::Filled { count: filled.filled });
    }
    let mut mesh = filled.mesh;
    let (mut ends, refused) = open_ends(&mesh)?;
    ends.sort_by(|a, b| b.area_mm2.total_cmp(&a.area_mm2));
    if refused.is_empty() {
        return Ok((mesh, ends));
    }
    notes.extend(refused.into_iter().map(Note::NoEnd));
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    for rim in boundary_loops(&topology) {
        if ends.iter().any(|end| end.rim.iter().all(|v| rim.contains(v))) {
            continue;
        }
        let middle = rim.iter().map(|&v| mesh.positions[v as usize]).sum::<Vec3>() / rim.len() as f32;
        let apex = mesh.positions.len() as u32;
        mesh.positions.push(middle);
        mesh.triangles.extend((0..rim.len()).map(|i| [rim[(i + 1) % rim.len()], rim[i], apex]));
    }
    Ok((mesh, ends))
}

/// The surface with a patch for each flat cap.
fn in_patches(mesh: TriMesh) -> Patched {
    let mut caps = flat_caps(&mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
    caps.sort_by(|a, b| b.area_mm2.total_cmp(&a.area_mm2));
    let mut surface = Patched::wall(mesh);
    for (i, cap) in caps.into_iter().enumerate() {
        let (kind, name) = match i {
            0 => (PatchKind::Inlet, "inlet".to_owned()),
            _ => (PatchKind::Outlet, format!("outlet_{i}")),
        };
        cap.triangles.iter().for_each(|&t| surface.of_triangle[t as usize] = i as u32 + 1);
        let (centre, normal) = (cap.centre.to_array(), cap.normal.to_array());
        surface.patches.push(Patch { id: i as u32 + 2, name, kind, centre, normal, area_mm2: cap.area_mm2 });
    }
    surface
}

/// The radius of the vessel at each vertex, in mm: of the wall alone, as balls in the corner of a cap are small.
fn radii(surface: &Patched) -> Vec<f32> {
    let Patched { mesh, of_triangle, .. } = surface;
    let walls: Vec<[u32; 3]> =
        mesh.triangles.iter().zip(of_triangle).filter(|(_, patch)| **patch == 0).map(|(&t, _)| t).collect();
    let wall = TriMesh { positions: mesh.positions.clone(), triangles: walls };
    let topology = Topology::new(wall.positions.len(), &wall.triangles);
    let (mut radii, _) = at_once(widths(&wall, &topology, None, &Yielder::never()));
    // What is of a cap alone is as its patch.
    for (triangle, &patch) in mesh.triangles.iter().zip(of_triangle) {
        let Some(patch) = surface.patches.get(patch as usize).filter(|patch| patch.kind != PatchKind::Wall) else {
            continue;
        };
        for v in triangle {
            let known = &mut radii[*v as usize];
            *known = known.min(patch.radius_mm() as f32);
        }
    }
    radii
}

/// Brings each flat inlet and outlet to the area that its patch has: fewer edges around a circle hold less.
fn hold_areas(surface: &mut Patched) {
    for (number, patch) in surface.patches.iter().enumerate().filter(|(_, patch)| patch.kind != PatchKind::Wall) {
        let (centre, normal) = (DVec3::from_array(patch.centre), DVec3::from_array(patch.normal));
        let of = |t: &usize| surface.of_triangle[*t] as usize == number;
        let triangles: Vec<usize> = (0..surface.mesh.triangles.len()).filter(of).collect();
        let area: f64 = triangles.iter().map(|&t| triangle_area(surface.mesh.corners(t))).sum();
        let mut vertices: Vec<u32> = triangles.iter().flat_map(|&t| surface.mesh.triangles[t]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let off = |&v: &u32| (surface.mesh.positions[v as usize].as_dvec3() - centre).dot(normal).abs();
        let is_flat = vertices.iter().map(off).fold(0.0, f64::max) < FLAT * patch.radius_mm();
        if !is_flat || area <= 0.0 {
            continue;
        }
        let scale = libm::sqrt(patch.area_mm2 / area);
        for v in vertices {
            let p = &mut surface.mesh.positions[v as usize];
            *p = (centre + (p.as_dvec3() - centre) * scale).as_vec3();
        }
    }
}

/// Measures the areas of the patches.
fn measure(surface: &mut Patched) {
    let mut areas = vec![0.0; surface.patches.len()];
    for (t, &patch) in surface.of_triangle.iter().enumerate() {
        areas[patch as usize] += triangle_area(surface.mesh.corners(t));
    }
    for (patch, area) in surface.patches.iter_mut().zip(areas) {
        patch.area_mm2 = area;
    }
}
