//! Where each end of a surface is cut, by what is asked of all ends and of single ones, and what goes.

use glam::DVec3;
use lumen_mesh::task::Yielder;
use lumen_mesh::{FlatCap, Topology, TriMesh, components, flat_caps};
use lumen_vessel::{Branch, End, Place};
use serde::{Deserialize, Serialize};

use super::clip::{ClipError, Clipped, clip};
use super::ends::{EndError, EndPlane, EndPlanes, Length, check_surface, free_ends, is_spicule, skeleton};
use super::notes::{Note, PrepareError, Reason, grouped};
use super::prepare::{Plan, vessel, wrapped};

/// A place is that of an end at most so many of its radii away.
pub const NEAR: f64 = 8.0;
/// An end with less than this part of the radius of one that it would go with is a thorn on it.
const THORN: f64 = 0.3;
/// A model has so many flat caps. Of its other ends those that are this much wider than a neck which is at most so many radii
/// away are sacs: aneurysms.
const MODEL: usize = 2;
const WIDER_THAN_NECK: f64 = 1.5;
const NECK: f64 = 5.0;

/// Where vessels are cut.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ClipAt {
    /// As near to each end as the vessel is round there.
    Round,
    /// At this distance from each end.
    Distance(Length),
}

/// Where one end is cut, whatever is asked of all.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cut {
    /// The end, by a place in mm that is nearer to it than to any other, and within eight radii of it.
    pub end_mm: [f64; 3],
    /// Where; `None` leaves the end as it is.
    pub at: Option<ClipAt>,
}

/// An end of a vessel, and where it is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct PlannedEnd {
    /// The centreline from the end inwards, as far as a plane may stand: places in mm, with radii.
    pub way: Vec<Place>,
    /// Whether it is to be cut.
    pub is_asked: bool,
    /// The plane; `None` where none is asked for, or none can be.
    pub plane: Option<EndPlane>,
    /// Why it cannot be cut as asked.
    pub why: Option<Reason>,
}

impl PlannedEnd {
    /// The last point of the centreline, in mm.
    pub fn tip(&self) -> DVec3 {
        self.way.first().map_or(DVec3::ZERO, |place| place.at)
    }

    pub(crate) fn not_cut(&self, why: Reason) -> Note {
        Note::NotCut { at: self.tip().as_vec3().to_array(), why }
    }
}

/// The ends of a surface, and what their planes cut off.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cuts {
    /// The largest piece of the surface, or the lumen of a wall.
    pub mesh: TriMesh,
    /// The ends.
    pub ends: Vec<PlannedEnd>,
    /// For each triangle of `mesh` 0 where some of it stays, or 1 more than the place of the end whose plane cuts it off.
    pub of_triangle: Vec<u32>,
    /// What cannot be cut as asked.
    pub notes: Vec<Note>,
}

/// What [`prepare`](super::prepare::prepare) would cut off by `plan`, but for what it uncrosses before, and uneven rims that
/// it trims after.
///
/// # Errors
/// [`PrepareError`], as there. A single end that cannot be cut is a [`Note`].
pub async fn cuts(mesh: &TriMesh, plan: &Plan, yielder: &Yielder) -> Result<Cuts, PrepareError> {
    plan.check()?;
    check_surface(mesh)?;
    let mut notes = Vec::new();
    let wrapped = wrapped(mesh, plan, &mut notes, &yielder.part(0.0..0.05)).await?;
    let mesh = vessel(wrapped.as_ref().unwrap_or(mesh), true, &mut notes, &yielder.part(0.05..0.1)).await?;
    yielder.rest(0.1).await;
    let (mut ends, strays) = planned(&mesh, plan, &yielder.part(0.1..0.9)).await?;
    notes.extend(strays);
    let planes: Vec<EndPlane> = ends.iter().filter_map(|end| end.plane.clone()).collect();
    let mut refused = Vec::new();
    let (_, from) = cut_at(mesh.clone(), &planes, &mut refused);
    for note in refused {
        // What is told of a plane is told of its end.
        let end = ends.iter_mut().find(|end| {
            end.plane.as_ref().is_some_and(|plane| matches!(&note, Note::NotCut { at, .. } if *at == place_of(plane)))
        });
        match (end, note) {
            (Some(end), Note::NotCut { why, .. }) => (end.plane, end.why) = (None, Some(why)),
            (_, note) => notes.push(note),
        }
    }
    let of_triangle = cut_off_by(&mesh, &from, &ends);
    Ok(Cuts { mesh, ends, of_triangle, notes: grouped(notes) })
}

/// For each triangle 0 where it is among those that stay, or 1 more than the place of the end whose plane cuts it off: each
/// piece of what goes is that of the end whose tip is nearest to it.
fn cut_off_by(mesh: &TriMesh, stay: &[u32], ends: &[PlannedEnd]) -> Vec<u32> {
    let mut goes = vec![true; mesh.triangles.len()];
    stay.iter().for_each(|&t| goes[t as usize] = false);
    let gone: Vec<usize> = (0..goes.len()).filter(|&t| goes[t]).collect();
    let triangles: Vec<[u32; 3]> = gone.iter().map(|&t| mesh.triangles[t]).collect();
    let pieces = components(mesh.positions.len(), &triangles);
    // For each piece the nearest tip, by its squared distance, and its end.
    let mut nearest = vec![(f64::INFINITY, 0); pieces.count()];
    for (triangle, &piece) in triangles.iter().zip(&pieces.of_triangle) {
        for (i, end) in ends.iter().enumerate().filter(|(_, end)| end.plane.is_some()) {
            let far = triangle.map(|v| end.tip().distance_squared(mesh.positions[v as usize].as_dvec3()));
            let far = far.into_iter().fold(f64::INFINITY, f64::min);
            let nearest = &mut nearest[piece as usize];
            if far < nearest.0 {
                *nearest = (far, i as u32 + 1);
            }
        }
    }
    let mut of_triangle = vec![0; mesh.triangles.len()];
    gone.iter().zip(&pieces.of_triangle).for_each(|(&t, &piece)| of_triangle[t] = nearest[piece as usize].1);
    of_triangle
}

/// The ends of a surface with their planes, and a note on each place of `plan` that is that of none.
pub(crate) async fn planned(
    mesh: &TriMesh,
    plan: &Plan,
    yielder: &Yielder,
) -> Result<(Vec<PlannedEnd>, Vec<Note>), PrepareError> {
    let tree = skeleton(mesh, &yielder.part(0.0..0.9)).await?;
    let planes = EndPlanes::new(mesh, &tree)?;
    yielder.rest(0.9).await;
    let free: Vec<_> = free_ends(&tree).collect();
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    let caps = flat_caps(mesh, &topology);
    let ways: Vec<Vec<Place>> = free.iter().map(|&(branch, at_end)| planes.way(branch, at_end)).collect();
    let mut cut_of = vec![None; free.len()];
    let mut strays = Vec::new();
    for (number, cut) in plan.cuts.iter().enumerate() {
        let asked = DVec3::from_array(cut.end_mm);
        let tips = ways.iter().enumerate().filter_map(|(i, way)| Some((i, way.first()?)));
        let nearest = tips.map(|(i, tip)| (tip.at.distance(asked), i, tip.radius));
        let nearest = nearest.reduce(|least, next| if next.0 < least.0 { next } else { least });
        match nearest.filter(|(distance, _, radius)| *distance <= NEAR * radius) {
            Some((_, i, _)) => cut_of[i] = Some(number),
            None => strays.push(Note::NoEndThere { at: asked.as_vec3().to_array() }),
        }
    }
    let mut ends = Vec::with_capacity(free.len());
    for (i, ((branch, at_end), way)) in free.into_iter().zip(ways).enumerate() {
        let at = cut_of[i].map_or(plan.clip, |cut: usize| plan.cuts[cut].at);
        let is_sac = cut_of[i].is_none() && caps.len() >= MODEL && is_sac(branch, at_end, &caps);
        let is_spicule = || cut_of[i].is_none() && at_end && is_spicule(mesh, &topology, &tree, branch);
        let found = match at {
            None => None,
            Some(_) if is_sac => Some(Err(EndError::Sac { branch: branch.id })),
            Some(_) if is_spicule() => Some(Err(EndError::Spicule { branch: branch.id })),
            Some(ClipAt::Round) => Some(planes.round(branch, at_end)),
            Some(ClipAt::Distance(distance)) => Some(planes.at(branch, at_end, distance)),
        };
        let (plane, why) = match found.transpose() {
            Ok(plane) => (plane, None),
            Err(error) => (None, Some(Reason::from(&error))),
        };
        ends.push(PlannedEnd { way, is_asked: at.is_some(), plane, why });
        yielder.rest(0.9 + 0.1 * i as f32 / cut_of.len() as f32).await;
    }
    Ok((ends, strays))
}

/// Whether a closed end without one of these caps is that of a sac: wider than its neck.
fn is_sac(branch: &Branch, at_end: bool, caps: &[FlatCap]) -> bool {
    if branch.ends[usize::from(at_end)] != End::Closed {
        return false;
    }
    let mut inwards: Vec<usize> = (branch.ostium..branch.points.len()).collect();
    if at_end {
        inwards.reverse();
    }
    let Some(&first) = inwards.first() else { return false };
    let mut widest = 0.0f64;
    for i in inwards {
        let Place { radius, .. } = branch.points[i];
        widest = widest.max(radius);
        if (branch.arcs[i] - branch.arcs[first]).abs() > NECK * widest {
            return false;
        }
        if radius * WIDER_THAN_NECK < widest {
            let at = branch.points[first].at;
            return caps.iter().all(|cap| cap.centre.distance(at) > widest + cap.radius_mm());
        }
    }
    false
}

fn place_of(plane: &EndPlane) -> [f32; 3] {
    plane.centre.as_vec3().to_array()
}

/// The surface cut at those planes that cut it, and for each of its triangles the one of `mesh` that it is a part of.
pub(crate) fn cut_at(mesh: TriMesh, planes: &[EndPlane], notes: &mut Vec<Note>) -> (TriMesh, Vec<u32>) {
    let (first, error) = match (clip(&mesh, planes), planes) {
        (_, []) => {
            let all = (0..mesh.triangles.len() as u32).collect();
            return (mesh, all);
        }
        (Ok(Clipped { mesh, from, .. }), _) => return (mesh, from),
        (Err(error), [first, ..]) => (first, error),
    };
    let one_by_one = |parts: &[&[EndPlane]], notes: &mut Vec<Note>| {
        let all = (0..mesh.triangles.len() as u32).collect();
        parts.iter().fold((mesh.clone(), all), |(mesh, from): (TriMesh, Vec<u32>), part| {
            let (mesh, of) = cut_at(mesh, part, notes);
            (mesh, of.into_iter().map(|t| from[t as usize]).collect())
        })
    };
    let failed = match error {
        // What stands on an end of a vessel and is much thinner is no other end.
        ClipError::OtherEnd { end, other } if planes[other].radius_mm < THORN * planes[end].radius_mm => Some(other),
        _ => error.end(),
    };
    match failed.filter(|&end| end < planes.len()) {
        // The others are cut without it.
        Some(failed) => {
            notes.push(Note::NotCut { at: place_of(&planes[failed]), why: (&error).into() });
            one_by_one(&[&planes[..failed], &planes[failed + 1..]], notes)
        }
        // It is one of them: each by itself shows which.
        None if planes.len() > 1 => one_by_one(&planes.chunks(1).collect::<Vec<_>>(), notes),
        None => {
            notes.push(Note::NotCut { at: place_of(first), why: (&error).into() });
            one_by_one(&[], notes)
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3Swizzles as _;
    use lumen_mesh::shapes::{fork, isosurface, tube};
    use lumen_mesh::task::at_once;

    use super::*;
    use crate::cap::CapKind;
    use crate::prepare::prepare;

    fn planned_by(mesh: &TriMesh, clip: Option<ClipAt>, cuts: Vec<Cut>) -> Cuts {
        at_once(super::cuts(mesh, &Plan { clip, cuts, ..Plan::default() }, &Yielder::never())).unwrap()
    }

    fn mm(mm: f64) -> Option<ClipAt> {
        Some(ClipAt::Distance(Length::Mm(mm)))
    }

    /// The area of the triangles that go with the end nearest to `tip`, in mm2.
    fn cut_off(cuts: &Cuts, tip: DVec3) -> f64 {
        let nearest =
            |&a: &usize, &b: &usize| cuts.ends[a].tip().distance(tip).total_cmp(&cuts.ends[b].tip().distance(tip));
        let end = (0..cuts.ends.len()).min_by(nearest).unwrap() as u32 + 1;
        let of_end = cuts.of_triangle.iter().enumerate().filter(|(_, of)| **of == end);
        of_end.map(|(t, _)| lumen_mesh::triangle_area(cuts.mesh.corners(t))).sum()
    }

    #[test]
    fn one_end_of_a_tube_is_cut_elsewhere_and_one_is_left() {
        let mesh = tube(64, 160, 40.0, |_| 2.0);
        let (low, high) = (DVec3::ZERO, DVec3::Z * 40.0);
        let around = 2.0 * std::f64::consts::PI * 2.0;
        let all = planned_by(&mesh, mm(4.0), Vec::new());
        // Rings stand a quarter of a mm apart, and those that are cut stay in part.
        assert!((cut_off(&all, low) - 4.0 * around).abs() < 0.26 * around, "{}", cut_off(&all, low));
        let one = planned_by(&mesh, mm(4.0), vec![Cut { end_mm: [0.5, 0.5, 38.0], at: mm(10.0) }]);
        assert!((cut_off(&one, high) - 10.0 * around).abs() < 0.26 * around, "{}", cut_off(&one, high));
        assert_eq!(cut_off(&one, low), cut_off(&all, low));
        let left = planned_by(&mesh, mm(4.0), vec![Cut { end_mm: [0.0, 0.0, 38.0], at: None }]);
        assert_eq!((cut_off(&left, high), cut_off(&left, low)), (0.0, cut_off(&all, low)));
        let only = planned_by(&mesh, None, vec![Cut { end_mm: [0.0, 0.0, 38.0], at: mm(10.0) }]);
        assert_eq!((cut_off(&only, low), cut_off(&only, high)), (0.0, cut_off(&one, high)));
    }

    #[test]
    fn the_way_leads_from_the_tip_to_where_a_fork_is_too_near() {
        let (mesh, [trunk, ..]) = fork();
        let found = planned_by(&mesh, Some(ClipAt::Round), Vec::new());
        assert_eq!(found.ends.len(), 3);
        for end in &found.ends {
            assert!(end.plane.is_some() && end.why.is_none());
            // A plane may stand all along it, and no farther.
            let length: f64 = end.way.windows(2).map(|pair| pair[0].at.distance(pair[1].at)).sum();
            for (further, is_cut) in [(-0.01, true), (0.5, false)] {
                let cut = Cut { end_mm: end.tip().to_array(), at: mm(length + further) };
                let alone = planned_by(&mesh, None, vec![cut]);
                let end = alone.ends.iter().find(|end| end.is_asked).unwrap();
                assert_eq!(end.plane.is_some(), is_cut, "{length} {further}: {:?}", end.why);
            }
        }
        let far = planned_by(&mesh, None, vec![Cut { end_mm: trunk.to_array(), at: mm(1000.0) }]);
        assert!(far.ends.iter().any(|end| matches!(end.why, Some(Reason::Fork { .. }))), "{:?}", far.ends);
        assert!(far.of_triangle.iter().all(|&of| of == 0));
    }

    #[test]
    fn a_place_far_from_any_end_is_told() {
        let mesh = tube(32, 80, 40.0, |_| 2.0);
        let found = planned_by(&mesh, None, vec![Cut { end_mm: [0.0, 30.0, 0.0], at: mm(1.0) }]);
        assert_eq!(found.notes, [Note::NoEndThere { at: [0.0, 30.0, 0.0] }]);
        assert!(found.ends.iter().all(|end| end.plane.is_none()));
    }

    #[test]
    fn a_thorn_on_an_end_is_cut_off_with_it() {
        let mesh = tube(64, 160, 40.0, |_| 2.0);
        let at = |z: f64, radius_mm: f64| EndPlane {
            branch: None,
            at_end: true,
            centre: DVec3::Z * z,
            normal: DVec3::Z,
            radius_mm,
            roundness: 1.0,
            arc_mm: 40.0 - z,
        };
        let cut = |thorn_mm: f64| {
            let mut notes = Vec::new();
            let (cut, _) = cut_at(mesh.clone(), &[at(30.0, 2.0), at(35.0, thorn_mm)], &mut notes);
            let [Note::NotCut { at, why: Reason::OtherEnd }] = notes[..] else { panic!("{notes:?}") };
            (cut.bounds().max[2], at[2])
        };
        assert_eq!(cut(0.3), (30.0, 35.0));
        // An end of about that width is one.
        assert_eq!(cut(1.5), (35.0, 30.0));
    }

    #[test]
    fn the_dome_of_an_aneurysm_on_a_model_with_caps_is_no_end() {
        // A tube of 4 mm with a sac of 7, longer than wide, between two flat caps.
        let inside = |p: DVec3| {
            let sac = (p - DVec3::Y * 25.0) / DVec3::new(7.0, 24.0, 7.0);
            (4.0 - p.xy().length()).min(61.0 - p.z.abs()).max(7.0 * (1.0 - sac.length()))
        };
        let mesh = isosurface(DVec3::new(-8.0, -5.0, -62.0), DVec3::new(8.0, 51.0, 62.0), 0.6, inside);
        let at = |z: f64| Cut { end_mm: [0.0, 0.0, z], at: mm(6.0) };
        let plan = Plan { cuts: vec![at(-58.0), at(58.0)], cap: Some(CapKind::Planar), ..Plan::default() };
        let model = at_once(prepare(&mesh, &plan, &Yielder::never())).unwrap();
        assert_eq!(model.surface.patches.len(), 3, "{:?}", model.notes);
        let model = model.surface.mesh;
        let found = planned_by(&model, Some(ClipAt::Distance(Length::Radii(1.0))), Vec::new());
        let (sacs, others): (Vec<_>, Vec<_>) = found.ends.iter().partition(|end| end.tip().y > 10.0);
        assert_eq!((sacs.len(), others.len()), (1, 2), "{sacs:?}");
        assert_eq!((&sacs[0].plane, &sacs[0].why), (&None, &Some(Reason::Sac)));
        assert!(others.iter().all(|end| end.plane.is_some()), "{others:?}");
        // Who asks for that very end has it cut.
        let asked = Cut { end_mm: sacs[0].tip().to_array(), at: mm(3.0) };
        let found = planned_by(&model, None, vec![asked]);
        assert_eq!(found.ends.iter().filter(|end| end.plane.is_some()).count(), 1);
    }
}
