//! All of it in one call: wrap, the lumen of a wall, the largest piece, uncross, clip, extend, cap, remesh, check.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::cap::{CapKind, cap};
use super::check::{Fate, check};
use super::cuts::{ClipAt, Cut, PlannedEnd, cut_at, planned};
use super::ends::{EndPlane, Length, OpenEnd, check_surface, names, open_ends, planes_of_uneven_openings, unfold};
use super::extend::{ExtendError, Extended, extend};
use super::notes::{Note, PrepareError, Reason, grouped};
use super::remesh::{Deviation, Quality, Remeshed, Sizing, remesh_in_slices};
use super::uncross::{Uncrossed, uncross_in_slices};
use super::wrap::wrap;
use super::{Patch, PatchKind, Patched};
use lumen_mesh::mending::fill::fill;
use lumen_mesh::mending::split::split;
use lumen_mesh::mending::wall::{Wall, WallFound, find_in_slices};
use lumen_mesh::task::Yielder;
use lumen_mesh::{FlatCap, Topology, TriMesh, Vec3, boundary_loops, compacted, components, flat_caps, without_caps};
use lumen_vessel::width::widths;

/// An extension that would run into something is as long as this part of what is free.
const OF_FREE: f64 = 0.9;

/// An end is flat where no vertex of it is farther than this part of its radius from its plane; what is opened may be a
/// hundredth off.
const FLAT: f64 = 0.011;
/// Times for each end that extensions are tried.
const ROUNDS: usize = 4;
/// The part of the work that a wrap is.
const WRAPPED: f32 = 0.5;

/// What is done to a surface, from top to bottom.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Whether triangles that cross are taken apart first.
    pub uncross: bool,
    /// Where ends are cut square to the vessel; `None` leaves them.
    pub clip: Option<ClipAt>,
    /// Ends that are cut elsewhere, or left.
    pub cuts: Vec<Cut>,
    /// How long the extensions are; `None` for none.
    pub extend: Option<Length>,
    /// How ends are closed; `None` leaves them open.
    pub cap: Option<CapKind>,
    /// How large triangles are; `None` leaves them as they are.
    pub remesh: Option<Sizing>,
    /// In place of the surface a closed one is taken, within this distance of it in mm; `None` takes the surface itself.
    pub wrap: Option<f64>,
}

impl Plan {
    /// What flow solvers ask for: ends cut where they are round, extended by five radii and closed evenly, 12 edges around.
    pub fn flow() -> Self {
        let (clip, extend) = (Some(ClipAt::Round), Some(Length::Radii(5.0)));
        let (cap, remesh) = (Some(CapKind::Planar), Some(Sizing::default()));
        Self { uncross: true, clip, cuts: Vec::new(), extend, cap, remesh, wrap: None }
    }

    /// Whether any end is cut.
    pub fn clips(&self) -> bool {
        self.clip.is_some() || self.cuts.iter().any(|cut| cut.at.is_some())
    }

    /// Whether something is asked for that only a vessel has: ends.
    fn is_of_vessels(&self) -> bool {
        self.clips() || self.extend.is_some() || self.cap.is_some()
    }

    /// Refuses lengths that make no sense.
    ///
    /// # Errors
    /// [`PrepareError::Sizes`].
    pub fn check(&self) -> Result<(), PrepareError> {
        let is_length = |length: Length| length.mm(1.0).is_some();
        let all = self.cuts.iter().map(|cut| cut.at).chain([self.clip]);
        let are_places = self.cuts.iter().flat_map(|cut| cut.end_mm).all(f64::is_finite);
        let are_right = are_places
            && all.flatten().all(|at| if let ClipAt::Distance(length) = at { is_length(length) } else { true })
            && self.extend.is_none_or(is_length)
            && self.wrap.is_none_or(|mm| mm > 0.0 && mm.is_finite());
        self.remesh.as_ref().map_or(Ok(()), Sizing::check)?;
        if are_right { Ok(()) } else { Err(PrepareError::Sizes) }
    }
}

/// A surface that was prepared.
#[derive(Clone, Debug, PartialEq)]
pub struct Prepared {
    /// The surface in patches, with their areas. Every vertex is of a triangle.
    pub surface: Patched,
    /// What a volume mesher would say.
    pub fate: Fate,
    /// What was done otherwise than asked for.
    pub notes: Vec<Note>,
    /// Triangles that crossed before and after they were taken apart, where that was asked for.
    pub crossing: Option<[usize; 2]>,
    /// How well the triangles are shaped, and how far they went before new crossings were mended and ends brought back to their
    /// areas, where they were made anew.
    pub remeshed: Option<(Quality, Deviation)>,
}

/// Prepares a surface. Rests between its steps, and within those that take longest.
///
/// # Errors
/// [`PrepareError`]. A single end that cannot be cut or extended is a [`Note`].
pub async fn prepare(mesh: &TriMesh, plan: &Plan, yielder: &Yielder) -> Result<Prepared, PrepareError> {
    plan.check()?;
    check_surface(mesh)?;
    let mut notes = Vec::new();
    let wrapped = wrapped(mesh, plan, &mut notes, &yielder.part(0.0..WRAPPED)).await?;
    let mesh = wrapped.as_ref().unwrap_or(mesh);
    let yielder = &yielder.part(if wrapped.is_some() { WRAPPED } else { 0.0 }..1.0);
    let mesh = vessel(mesh, plan.is_of_vessels(), &mut notes, &yielder.part(0.0..0.05)).await?;
    yielder.rest(0.05).await;
    let (mut mesh, crossing) = if plan.uncross {
        let part = yielder.part(0.05..0.3);
        let Uncrossed { mesh, crossing_before, .. } = uncross_in_slices(&mesh, &part).await?;
        (largest_piece(mesh).0, Some(crossing_before))
    } else {
        (mesh, None)
    };
    if plan.clips() {
        mesh = clipped(mesh, plan, &mut notes, &yielder.part(0.3..0.5)).await?;
    }
    yielder.rest(0.5).await;
    let mut surface = if plan.extend.is_some() || plan.cap.is_some() || plan.wrap.is_some() {
        // What is flat and closed is an end like those that are open.
        let (walls, had_caps) = opened(&mesh);
        let (mut mesh, ends) = without_holes(&largest_piece(walls).0, &mut notes)?;
        unfold(&mut mesh, &ends);
        if ends.is_empty() && (plan.extend.is_some() || plan.cap.is_some()) {
            notes.push(Note::NoEnds);
        }
        let (mesh, ends) = match plan.extend.filter(|_| !ends.is_empty()) {
            Some(length) => extended(mesh, ends, length, &mut notes),
            None => (mesh, ends),
        };
        // What was closed is closed again.
        let is_closed = had_caps || plan.wrap.is_some();
        match plan.cap.or(is_closed.then_some(CapKind::Planar)).filter(|_| !ends.is_empty()) {
            Some(kind) => cap(&mesh, &ends, kind)?,
            None => Patched::wall(mesh),
        }
    } else {
        in_patches(mesh)
    };
    yielder.rest(0.55).await;
    measure(&mut surface);
    let mut remeshed = None;
    if let Some(sizing) = &plan.remesh {
        let radii = radii(&surface, &yielder.part(0.55..0.65)).await;
        let part = yielder.part(0.65..0.9);
        let found = remesh_in_slices(&surface, &radii, sizing, &part).await?;
        let deviation = found.deviation();
        let Remeshed { surface: new, crossing, .. } = found;
        surface = new;
        // Where two walls are nearer than a triangle is long, new ones may cross.
        if plan.uncross && !crossing.is_empty() {
            let Uncrossed { mesh, triangle_of, .. } =
                uncross_in_slices(&surface.mesh, &yielder.part(0.9..0.95)).await?;
            surface.of_triangle = triangle_of.iter().map(|&t| surface.of_triangle[t as usize]).collect();
            surface.mesh = mesh;
        }
        hold_areas(&mut surface);
        remeshed = Some((Quality::of(&surface.mesh), deviation));
        measure(&mut surface);
    }
    yielder.rest(0.95).await;
    surface.mesh = compacted(&surface.mesh.positions, surface.mesh.triangles);
    let fate = check(&surface);
    // What was left is mended with the triangles that are made anew.
    let crossing = crossing.map(|before| [before, fate.crossing()]);
    Ok(Prepared { surface, fate, notes: grouped(notes), crossing, remeshed })
}

/// The wrap of a surface, where one is asked for: of a wall that of its lumen, where that can be told.
pub(crate) async fn wrapped(
    mesh: &TriMesh,
    plan: &Plan,
    notes: &mut Vec<Note>,
    yielder: &Yielder,
) -> Result<Option<TriMesh>, PrepareError> {
    let Some(tolerance_mm) = plan.wrap else { return Ok(None) };
    let mut told = Vec::new();
    let lumen = match without_wall(split(mesh).mesh, &mut told, &yielder.part(0.0..0.1)).await {
        Err(PrepareError::Wall { thickness_mm }) => {
            told.push(Note::WrapWall { thickness_mm });
            None
        }
        found => found.ok(),
    };
    notes.extend(told.into_iter().map(|note| match note {
        Note::Lumen { thickness_mm } => Note::WrapLumen { thickness_mm },
        note => note,
    }));
    let part = yielder.part(0.1..1.0);
    wrap(lumen.as_ref().unwrap_or(mesh), tolerance_mm, plan.clips(), notes, &part).await.map(Some)
}

/// What of a surface is prepared: its largest piece, of a wall the lumen where it `is_of_vessels`.
pub(crate) async fn vessel(
    mesh: &TriMesh,
    is_of_vessels: bool,
    notes: &mut Vec<Note>,
    yielder: &Yielder,
) -> Result<TriMesh, PrepareError> {
    // Edges of more than two triangles are no place to part surfaces at, and no mesher takes them.
    let mut mesh = split(mesh).mesh;
    if is_of_vessels {
        mesh = without_wall(mesh, notes, yielder).await?;
    }
    let (mesh, others) = largest_piece(mesh);
    if others > 0 {
        notes.push(Note::LeftOut { others });
    }
    Ok(mesh)
}

/// The lumen of a wall with two sides; any other surface as it is.
async fn without_wall(mesh: TriMesh, notes: &mut Vec<Note>, yielder: &Yielder) -> Result<TriMesh, PrepareError> {
    if !Topology::new(mesh.positions.len(), &mesh.triangles).is_consistent() {
        return Ok(mesh);
    }
    let WallFound { wall, lumen } = find_in_slices(&mesh, None, true, yielder).await;
    match (wall, lumen) {
        (None, _) => Ok(mesh),
        (Some(Wall { thickness_mm, .. }), None) => Err(PrepareError::Wall { thickness_mm }),
        (Some(Wall { thickness_mm, .. }), Some(lumen)) => {
            notes.push(Note::Lumen { thickness_mm });
            Ok(lumen.mesh)
        }
    }
}

/// The surface cut at its ends, as many of them as can be.
async fn clipped(
    mesh: TriMesh,
    plan: &Plan,
    notes: &mut Vec<Note>,
    yielder: &Yielder,
) -> Result<TriMesh, PrepareError> {
    let (ends, strays) = planned(&mesh, plan, &yielder.part(0.0..0.8)).await?;
    notes.extend(strays);
    notes.extend(ends.iter().filter_map(|end| Some(end.not_cut(end.why.clone()?))));
    let planes: Vec<EndPlane> = ends.iter().filter_map(|end| end.plane.clone()).collect();
    let (mesh, _) = cut_at(mesh, &planes, notes);
    // An end that is too near a fork for such a plane is cut just inside of its rim, where that is uneven.
    let is_asked = |plane: &EndPlane| {
        let far = |end: &&PlannedEnd| end.tip().distance_squared(plane.centre);
        ends.iter()
            .min_by(|a, b| far(a).total_cmp(&far(b)))
            .is_none_or(|end| end.is_asked && end.why != Some(Reason::Spicule))
    };
    let mut planes = planes_of_uneven_openings(&mesh)?;
    planes.retain(is_asked);
    Ok(cut_at(mesh, &planes, notes).0)
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
    (compacted(&mesh.positions, without_caps(&mesh.triangles, &caps)), !caps.is_empty())
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
                        notes.push(Note::NotExtended { name: end.name.clone(), why: (&error).into() });
                    }
                }
                if !is_found {
                    let why = Reason::from(&error);
                    notes.extend(with.iter().map(|end| Note::NotExtended { name: end.name.clone(), why: why.clone() }));
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
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    for rim in boundary_loops(&topology) {
        if ends.iter().any(|end| end.rim.iter().all(|v| rim.contains(v))) {
            continue;
        }
        let middle = rim.iter().map(|&v| mesh.positions[v as usize]).sum::<Vec3>() / rim.len() as f32;
        let end = OpenEnd::new(&mesh, &topology, rim.clone(), String::new(), PatchKind::Outlet);
        let why = end.as_ref().err().map_or(Reason::Unsound, Reason::from);
        notes.push(Note::AsWall { at: middle.to_array(), why });
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
    let radii: Vec<f64> = caps.iter().map(FlatCap::radius_mm).collect();
    for (i, (cap, (kind, name))) in caps.into_iter().zip(names(&radii)).enumerate() {
        cap.triangles.iter().for_each(|&t| surface.of_triangle[t as usize] = i as u32 + 1);
        let (centre, normal) = (cap.centre.to_array(), cap.normal.to_array());
        surface.patches.push(Patch { id: i as u32 + 2, name, kind, centre, normal, area_mm2: cap.area_mm2 });
    }
    surface
}

/// The radius of the vessel at each vertex, in mm: of the wall alone, as balls in the corner of a cap are small.
async fn radii(surface: &Patched, yielder: &Yielder) -> Vec<f32> {
    let Patched { mesh, of_triangle, .. } = surface;
    let walls: Vec<[u32; 3]> =
        mesh.triangles.iter().zip(of_triangle).filter(|(_, patch)| **patch == 0).map(|(&t, _)| t).collect();
    let wall = TriMesh { positions: mesh.positions.clone(), triangles: walls };
    let topology = Topology::new(wall.positions.len(), &wall.triangles);
    let (mut radii, _) = widths(&wall, &topology, None, yielder).await;
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
    let areas = surface.areas_mm2();
    let mut vertices_of = vec![Vec::new(); surface.patches.len()];
    for (triangle, &patch) in surface.mesh.triangles.iter().zip(&surface.of_triangle) {
        vertices_of[patch as usize].extend(triangle);
    }
    for ((patch, area), mut vertices) in surface.patches.iter().zip(areas).zip(vertices_of) {
        if patch.kind == PatchKind::Wall {
            continue;
        }
        let (centre, normal) = (DVec3::from_array(patch.centre), DVec3::from_array(patch.normal));
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
    let areas = surface.areas_mm2();
    surface.patches.iter_mut().zip(areas).for_each(|(patch, area)| patch.area_mm2 = area);
}

#[cfg(test)]
mod tests;
