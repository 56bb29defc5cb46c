//! Where the ends of a vessel surface are cut: planes square to the centreline, near each end of each branch.
//!
//! From the end of a branch inwards, the first place is taken where the section is round (the least over the largest
//! Feret width is at least [`ROUND`]), where the rim of an open end lies wholly beyond the plane, and which is at least
//! one local radius away from the fork that the branch comes from. A closed end is cut no nearer to its tip than about
//! one and a half radii. The plane stands across the chord of the centreline from one radius before the place to one
//! radius after it. Where a closed end is askew the centreline runs into its corner: radii, and the search, begin where the
//! vessel is whole.
//!
//! It does not look at what a solver needs of the flow: a vessel that bends sharply at its end is cut where it is round.

mod rim;
mod skeleton;
mod spicule;
mod unfold;

use glam::DVec3;
use lumen_mesh::cut::{Outline, cut};
use lumen_mesh::{SurfaceIndex, Topology, TriMesh, boundary_loops};
use lumen_vessel::{Branch, End, Place, Tree};
use serde::{Deserialize, Serialize};
use thiserror::Error;

pub use rim::{OpenEnd, RimError, SurfaceError, check_surface, names, open_ends, planes_of_uneven_openings};
pub(crate) use rim::{edges, forwards, plane};
pub use skeleton::skeleton;
pub(crate) use spicule::is_spicule;
pub use unfold::unfold;

/// The least over the largest width of a section that counts as round.
pub const ROUND: f64 = 0.8;
/// Radii from the centreline's last point at which the search begins: in an open end, and in a closed one, where that
/// point is about one radius from the tip.
const FIRST_OPEN: f64 = 0.1;
const FIRST_CLOSED: f64 = 0.5;
/// Steps of the search, in radii, and their largest number.
const STEP: f64 = 0.1;
const STEPS: usize = 1000;
/// Radii from a fork that are left alone.
const FROM_FORK: f64 = 1.0;
/// A section is sought within so many radii of the centreline before the whole surface is cut.
const REACH: f64 = 3.0;
/// The rim of an open end is sought within so many radii of the centreline's end.
const RIM_REACH: f64 = 2.5;

/// A plane at which an end of a vessel is cut.
#[derive(Clone, Debug, PartialEq)]
pub struct EndPlane {
    /// The place of the branch in [`Tree::branches`]; `None` where it is known by its opening alone, as are the end and the
    /// distance then.
    pub branch: Option<u32>,
    /// Whether it is at the last point of the branch, and not at the first.
    pub at_end: bool,
    /// The centroid of the section, in mm.
    pub centre: DVec3,
    /// Unit normal, out of the vessel.
    pub normal: DVec3,
    /// The radius of a circle of the section's area, in mm.
    pub radius_mm: f64,
    /// The least over the largest Feret width of the section: 1 for a circle.
    pub roundness: f64,
    /// How far it is from the end of the centreline, along it, in mm.
    pub arc_mm: f64,
}

/// A distance along a vessel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Length {
    /// In mm.
    Mm(f64),
    /// In radii of the vessel at its end.
    Radii(f64),
}

impl Length {
    /// In mm, where the radius is `radius_mm`; `None` for what is negative or not finite.
    pub fn mm(self, radius_mm: f64) -> Option<f64> {
        let mm = match self {
            Self::Mm(mm) => mm,
            Self::Radii(radii) => radii * radius_mm,
        };
        (mm >= 0.0 && mm.is_finite()).then_some(mm)
    }
}

/// Why an end of a branch has no plane. Branches count from 1 in the texts, as in their names.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum EndError {
    /// The surface is broken.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The branch goes on there.
    #[error("branch {} does not end at its {}: other branches go on there", branch + 1, side(*at_end))]
    Joint {
        /// Its place.
        branch: u32,
        /// Whether the last point is meant.
        at_end: bool,
    },
    /// It is no end of the vessel.
    #[error("branch {} ends in a sac", branch + 1)]
    Sac {
        /// Its place.
        branch: u32,
    },
    /// It is no end of the vessel either.
    #[error("branch {} is a spike of a rough wall", branch + 1)]
    Spicule {
        /// Its place.
        branch: u32,
    },
    /// The distance is negative or no number.
    #[error("the distance from the end of branch {} is not a positive number of mm", branch + 1)]
    Distance {
        /// Its place.
        branch: u32,
    },
    /// A fork is too near.
    #[error(
        "branch {} cannot be cut {asked_mm:.2} mm from its {}: the fork leaves {room_mm:.2} mm",
        branch + 1,
        side(*at_end)
    )]
    TooNearFork {
        /// Its place.
        branch: u32,
        /// Whether the last point is meant.
        at_end: bool,
        /// Distance from the end, in mm: the one asked for, or the least at which an end is cut.
        asked_mm: f64,
        /// The largest distance from the end that keeps clear of the fork, in mm.
        room_mm: f64,
    },
    /// No section is round.
    #[error(
        "branch {} has no round section in the {room_mm:.2} mm next to its {}: the best has a width ratio of {roundness:.2}",
        branch + 1,
        side(*at_end)
    )]
    NotRound {
        /// Its place.
        branch: u32,
        /// Whether the last point is meant.
        at_end: bool,
        /// The best that was found; 0 where no section was closed.
        roundness: f64,
        /// How far from the end was looked, in mm.
        room_mm: f64,
    },
    /// The plane does not cut the vessel in a closed outline.
    #[error("{arc_mm:.2} mm from the {} of branch {} the surface has no closed section", side(*at_end), branch + 1)]
    NoSection {
        /// Its place.
        branch: u32,
        /// Whether the last point is meant.
        at_end: bool,
        /// Distance from the end, in mm.
        arc_mm: f64,
    },
}

fn side(at_end: bool) -> &'static str {
    if at_end { "last point" } else { "first point" }
}

/// The ends of the branches of `tree` at which none goes on: the branch, and whether its last point is meant; the first point
/// before the last.
pub fn free_ends(tree: &Tree) -> impl Iterator<Item = (&Branch, bool)> {
    let both = tree.branches().iter().flat_map(|branch| [(branch, false), (branch, true)]);
    both.filter(|(branch, at_end)| branch.ends[usize::from(*at_end)] != End::Joint)
}

/// Finds planes at the ends of a surface.
pub struct EndPlanes<'a> {
    mesh: &'a TriMesh,
    tree: &'a Tree,
    /// Its boundary loops.
    rims: Vec<Vec<DVec3>>,
}

impl<'a> EndPlanes<'a> {
    /// Those of `tree`, that of `mesh`.
    ///
    /// # Errors
    /// [`SurfaceError`].
    pub fn new(mesh: &'a TriMesh, tree: &'a Tree) -> Result<Self, SurfaceError> {
        check_surface(mesh)?;
        let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
        let points = |rim: Vec<u32>| rim.into_iter().map(|v| mesh.positions[v as usize].as_dvec3()).collect();
        Ok(Self { mesh, tree, rims: boundary_loops(&topology).into_iter().map(points).collect() })
    }

    fn end(&self, branch: &'a Branch, at_end: bool) -> VesselEnd<'a> {
        VesselEnd { mesh: self.mesh, index: &self.tree.space.index, branch, at_end }
    }

    /// The same of an end at which no branch goes on.
    fn free(&self, branch: &'a Branch, at_end: bool) -> Result<VesselEnd<'a>, EndError> {
        let is_free = branch.ends[usize::from(at_end)] != End::Joint;
        if is_free { Ok(self.end(branch, at_end)) } else { Err(EndError::Joint { branch: branch.id, at_end }) }
    }

    /// The plane nearest to a free end at which the vessel is round.
    ///
    /// # Errors
    /// [`EndError`], where the branch does not end there, or no place is round and clear of the fork.
    pub fn round(&self, branch: &'a Branch, at_end: bool) -> Result<EndPlane, EndError> {
        self.free(branch, at_end)?.nearest_plane(branch.ends[usize::from(at_end)], &self.rims)
    }

    /// The plane at `distance` from a free end along the centreline. The section need not be round:
    /// [`EndPlane::roundness`] says how round it is.
    ///
    /// # Errors
    /// [`EndError`], where the branch does not end there, a fork is too near or the section is not closed.
    pub fn at(&self, branch: &'a Branch, at_end: bool, distance: Length) -> Result<EndPlane, EndError> {
        self.free(branch, at_end)?.at_distance(distance)
    }

    /// The centreline from a free end inwards, as far as a plane may stand.
    pub fn way(&self, branch: &'a Branch, at_end: bool) -> Vec<Place> {
        let end = self.end(branch, at_end);
        let (length, room) = (branch.length_mm(), end.room());
        let from_end = |i: usize| if at_end { length - branch.arcs[i] } else { branch.arcs[i] };
        let mut inside: Vec<usize> = (0..branch.points.len()).filter(|&i| from_end(i) <= room).collect();
        if at_end {
            inside.reverse();
        }
        inside.into_iter().map(|i| branch.points[i]).collect()
    }
}

/// An end of a branch, of a surface and its index.
struct VesselEnd<'a> {
    mesh: &'a TriMesh,
    index: &'a SurfaceIndex,
    branch: &'a Branch,
    at_end: bool,
}

impl VesselEnd<'_> {
    /// The centreline at a distance from the end, in mm.
    fn at(&self, from_end: f64) -> Place {
        let Branch { points, arcs, .. } = self.branch;
        let arc = if self.at_end { self.branch.length_mm() - from_end } else { from_end };
        let next = arcs.partition_point(|&a| a < arc).min(points.len().saturating_sub(1));
        let before = next.saturating_sub(1);
        let (Some(p), Some(q)) = (points.get(before), points.get(next)) else { return Place::default() };
        let span = arcs[next] - arcs[before];
        let part = if span > 0.0 { ((arc - arcs[before]) / span).clamp(0.0, 1.0) } else { 0.0 };
        Place { at: p.at.lerp(q.at, part), radius: p.radius + (q.radius - p.radius) * part }
    }

    /// The largest distance from the end that keeps clear of the fork, or of the other end, in mm.
    fn room(&self) -> f64 {
        let Branch { points, arcs, ostium, ends, .. } = self.branch;
        let length = self.branch.length_mm();
        let other = usize::from(!self.at_end);
        if ends[other] != End::Joint {
            return length / 2.0;
        }
        let fork = if self.at_end { *ostium } else { points.len().saturating_sub(1) };
        let Some(&fork_arc) = arcs.get(fork) else { return 0.0 };
        let clear = (0..points.len()).filter(|&i| (arcs[i] - fork_arc).abs() >= FROM_FORK * points[i].radius);
        let from_end = |i: usize| if self.at_end { length - arcs[i] } else { arcs[i] };
        let is_before = |i: &usize| if self.at_end { *i > fork } else { *i < fork };
        clear.filter(is_before).map(from_end).fold(0.0, f64::max)
    }

    /// The plane at a distance from the end, in mm; `None` where it has no closed section about the centreline.
    fn plane(&self, from_end: f64) -> Option<EndPlane> {
        let place = self.at(from_end);
        let length = self.branch.length_mm();
        let outer = self.at((from_end - place.radius).max(0.0)).at;
        let inner = self.at((from_end + place.radius).min(length)).at;
        let normal = (outer - inner).try_normalize()?;
        let outline = self.section(place, normal)?;
        let [least, largest] = outline.widths(normal);
        let area = outline.area(normal).abs();
        Some(EndPlane {
            branch: Some(self.branch.id),
            at_end: self.at_end,
            centre: outline.middle(normal),
            normal,
            radius_mm: (area / std::f64::consts::PI).sqrt(),
            roundness: if largest > 0.0 { least / largest } else { 0.0 },
            arc_mm: from_end,
        })
    }

    /// The radius of the vessel at the end, and how far from the end of the line it is whole, in mm: before that the line runs
    /// into the corner of an end that is closed askew.
    fn whole(&self) -> (f64, f64) {
        self.branch.radius_at_end(self.at_end).unwrap_or_default()
    }

    fn at_distance(&self, distance: Length) -> Result<EndPlane, EndError> {
        let (branch, at_end) = (self.branch.id, self.at_end);
        let room_mm = self.room();
        let (radius_mm, whole_mm) = self.whole();
        let whole = distance.mm(radius_mm).map(|mm| whole_mm + mm).filter(|&mm| mm <= room_mm);
        let asked_mm = match (distance, whole) {
            (Length::Radii(_), Some(whole)) => whole,
            _ => distance.mm(self.at(0.0).radius).ok_or(EndError::Distance { branch })?,
        };
        if asked_mm > room_mm {
            return Err(EndError::TooNearFork { branch, at_end, asked_mm, room_mm });
        }
        self.plane(asked_mm).ok_or(EndError::NoSection { branch, at_end, arc_mm: asked_mm })
    }

    /// The closed outline about a place in the plane across `normal`; of several the smallest.
    fn section(&self, place: Place, normal: DVec3) -> Option<Outline> {
        let TriMesh { positions, triangles } = self.mesh;
        let about = |triangles: &[[u32; 3]]| {
            let outlines = cut(positions, triangles, place.at, normal).into_iter();
            let around = outlines.filter(|line| line.is_closed && line.winding(place.at, normal) != 0);
            let size = |line: &Outline| line.area(normal).abs();
            around.reduce(|least, next| if size(&next) < size(&least) { next } else { least })
        };
        let reach = glam::Vec3::splat((REACH * place.radius) as f32);
        let at = place.at.as_vec3();
        let mut near = Vec::new();
        self.index.for_each_near(at - reach, at + reach, |t| near.push(t));
        near.sort_unstable();
        near.dedup();
        let near: Vec<[u32; 3]> = near.iter().filter_map(|&t| triangles.get(t as usize).copied()).collect();
        about(&near).or_else(|| about(triangles))
    }

    /// The nearest plane to the end that is round, lies inside of the rim and keeps clear of the fork.
    fn nearest_plane(&self, end: End, rims: &[Vec<DVec3>]) -> Result<EndPlane, EndError> {
        let (branch, at_end) = (self.branch.id, self.at_end);
        let tip = self.at(0.0);
        let rim = if end == End::Open { self.rim(tip, rims) } else { &[] };
        let first = if end == End::Open { FIRST_OPEN } else { FIRST_CLOSED };
        let room_mm = self.room();
        let (radius_mm, whole_mm) = self.whole();
        let mut from_end = whole_mm + first * radius_mm;
        if from_end > room_mm {
            from_end = first * tip.radius;
        }
        if from_end > room_mm {
            return Err(EndError::TooNearFork { branch, at_end, asked_mm: from_end, room_mm });
        }
        let mut best = 0.0f64;
        for _ in 0..STEPS {
            if let Some(plane) = self.plane(from_end) {
                let is_beyond = |p: &DVec3| (*p - plane.centre).dot(plane.normal) > 0.0;
                if plane.roundness >= ROUND && rim.iter().all(is_beyond) {
                    return Ok(plane);
                }
                best = best.max(plane.roundness);
            }
            let step = (STEP * self.at(from_end).radius).max(self.branch.length_mm() / STEPS as f64);
            // Also what is no number ends the search.
            if !(0.0..=room_mm).contains(&(from_end + step)) {
                break;
            }
            from_end += step;
        }
        Err(EndError::NotRound { branch, at_end, roundness: best, room_mm })
    }

    /// The boundary loop whose middle is nearest to the end of the centreline.
    fn rim<'a>(&self, tip: Place, rims: &'a [Vec<DVec3>]) -> &'a [DVec3] {
        let distance = |rim: &[DVec3]| (rim.iter().sum::<DVec3>() / rim.len().max(1) as f64).distance(tip.at);
        let nearest = rims.iter().map(|rim| (distance(rim), rim));
        let nearest = nearest.reduce(|least, next| if next.0 < least.0 { next } else { least });
        nearest.filter(|(distance, _)| *distance <= RIM_REACH * tip.radius).map_or(&[], |(_, rim)| rim)
    }
}

/// The plane at each end where it is round, and why others have none.
#[cfg(test)]
pub(crate) fn proposed(mesh: &TriMesh, tree: &Tree) -> (Vec<EndPlane>, Vec<EndError>) {
    let planes = EndPlanes::new(mesh, tree).unwrap();
    let (mut found, mut refused) = (Vec::new(), Vec::new());
    for (branch, at_end) in free_ends(tree) {
        match planes.round(branch, at_end) {
            Ok(plane) => found.push(plane),
            Err(error) => refused.push(error),
        }
    }
    (found, refused)
}

#[cfg(test)]
mod tests {
    use lumen_mesh::shapes::{fork, isosurface, tube};

    use super::*;

    #[test]
    fn a_tube_is_cut_square_at_both_ends_just_inside_of_its_rims() {
        let mesh = tube(32, 80, 40.0, |_| 2.0);
        let tree = Tree::new(&mesh).unwrap();
        let (planes, refused) = proposed(&mesh, &tree);
        assert!(refused.is_empty() && planes.len() == 2, "{refused:?}");
        for plane in &planes {
            let inside = if plane.normal.z > 0.0 { 40.0 - plane.centre.z } else { plane.centre.z };
            assert!((0.05..1.0).contains(&inside), "{plane:?}");
            assert!(plane.normal.z.abs() > 0.9998, "{plane:?}");
            assert!((plane.radius_mm / 2.0 - 1.0).abs() < 0.01 && plane.roundness > 0.97, "{plane:?}");
        }
        assert!(planes[0].normal.dot(planes[1].normal) < -0.999);
    }

    #[test]
    fn the_whole_rim_of_a_slanted_end_lies_beyond_the_plane() {
        let mut mesh = tube(32, 80, 40.0, |_| 2.0);
        // The last 4 mm are sheared: the rim stands from 38 to 42 mm.
        for p in &mut mesh.positions {
            p.z += p.x * ((p.z - 36.0) / 4.0).clamp(0.0, 1.0);
        }
        let tree = Tree::new(&mesh).unwrap();
        let (planes, _) = proposed(&mesh, &tree);
        let plane = planes.iter().find(|plane| plane.normal.z > 0.5).unwrap();
        let rim = mesh.positions.len() - 32;
        assert!(mesh.positions[rim..].iter().all(|p| (p.as_dvec3() - plane.centre).dot(plane.normal) > 0.0));
    }

    #[test]
    fn the_closed_ends_of_a_fork_are_cut_one_to_two_radii_from_their_tips() {
        let (mesh, [trunk, joint, left, right]) = fork();
        let tree = Tree::new(&mesh).unwrap();
        let (planes, refused) = proposed(&mesh, &tree);
        assert!(refused.is_empty() && planes.len() == 3, "{refused:?} {planes:?}");
        for (end, radius) in [(trunk, 4.0), (left, 3.0), (right, 2.0)] {
            let out = (end - joint).normalize();
            let nearest = |a: &&EndPlane, b: &&EndPlane| a.centre.distance(end).total_cmp(&b.centre.distance(end));
            let plane = planes.iter().min_by(nearest).unwrap();
            // The centres of the round ends are one radius from the tips.
            let from_tip = radius - (plane.centre - end).dot(out);
            assert!((radius..2.0 * radius).contains(&from_tip), "{from_tip} of {radius}");
            assert!(plane.normal.dot(out) > 0.995, "{plane:?}");
            assert!((plane.radius_mm / radius - 1.0).abs() < 0.03, "{plane:?}");
        }
    }

    #[test]
    fn an_end_that_is_closed_askew_is_cut_where_the_vessel_is_whole() {
        // Closed at 30 and 45 degrees: the centreline runs into the corner, where a ball is a small part of the vessel.
        for normal in [DVec3::new(1.0, 0.0, 3.0f64.sqrt()), DVec3::new(1.0, 0.0, 1.0)].map(DVec3::normalize) {
            let inside = |p: DVec3| {
                let wall = 8.0 - p.truncate().length();
                wall.min((DVec3::Z * 70.0 - p).dot(normal)).min(p.z + 10.0)
            };
            let mesh = isosurface(DVec3::new(-9.0, -9.0, -12.0), DVec3::new(9.0, 9.0, 82.0), 0.7, inside);
            let tree = Tree::new(&mesh).unwrap();
            let planes = EndPlanes::new(&mesh, &tree).unwrap();
            let (branch, at_end) = free_ends(&tree).max_by(|a, b| tip(*a).z.total_cmp(&tip(*b).z)).unwrap();
            let one_radius = planes.at(branch, at_end, Length::Radii(1.0)).unwrap();
            for plane in [one_radius, planes.round(branch, at_end).unwrap()] {
                assert!((plane.radius_mm / 8.0 - 1.0).abs() < 0.02 && plane.normal.z > 0.98, "{normal}: {plane:?}");
            }
        }
    }

    fn tip((branch, at_end): (&Branch, bool)) -> DVec3 {
        branch.points[if at_end { branch.points.len() - 1 } else { 0 }].at
    }

    #[test]
    fn an_explicit_distance_is_kept_or_refused_with_the_room_there_is() {
        let (mesh, _) = fork();
        let tree = Tree::new(&mesh).unwrap();
        let planes = EndPlanes::new(&mesh, &tree).unwrap();
        let branch = tree.branches().iter().find(|branch| branch.ends[1] != End::Joint).unwrap();
        let plane = planes.at(branch, true, Length::Mm(10.0)).unwrap();
        assert!((plane.centre.distance(branch.points[branch.points.len() - 1].at) - 10.0).abs() < 0.3, "{plane:?}");
        let by_radii = planes.at(branch, true, Length::Radii(2.0)).unwrap();
        let radius = branch.points[branch.points.len() - 1].radius;
        assert!((by_radii.arc_mm - 2.0 * radius).abs() < 1e-9);
        let far = planes.at(branch, true, Length::Mm(branch.length_mm() - 0.5));
        assert!(matches!(far, Err(EndError::TooNearFork { room_mm, .. }) if room_mm > 20.0), "{far:?}");
        let bad = planes.at(branch, true, Length::Mm(f64::NAN));
        assert!(matches!(bad, Err(EndError::Distance { .. })));
        assert!(matches!(planes.at(branch, false, Length::Mm(1.0)), Err(EndError::Joint { .. })));
    }
}
