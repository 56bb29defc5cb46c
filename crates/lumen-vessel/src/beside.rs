//! What a vessel is beside a place of its wall that a user has pointed at: its cross-section there, and the angle of the
//! fork next to it. Both rest on the centrelines of the certificate, which are of the surface as it was opened.
//!
//! The place on a centreline is the one whose ball holds the point deepest (least power `d^2 - r^2`), so that a point on the
//! wall of a wide vessel is not taken for one of a thin branch that begins near by; wherever around the wall it lies, it has
//! the same place. The plane of the section is across the chord of one radius either way. The angle of a fork is that of
//! the chords of two branches over twice their radius, from where the certificate finds each to be one vessel: within the
//! fork itself a centreline is a matter of its construction.

use glam::{DVec3, Vec3};

use super::certificate::{BranchCalibre, StationStatus};
use super::{Place, power};
use lumen_mesh::{Outline, cut};
use lumen_message::messages;

/// A place on a branch's centreline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BranchPlace<'a> {
    /// The branch.
    pub branch: &'a BranchCalibre,
    /// Arc length from its first point, in mm.
    pub abscissa_mm: f64,
    /// The place, in mm.
    pub at: DVec3,
    /// The way of the centreline there, of length 1.
    pub direction: DVec3,
    /// Radius of the vessel as opened, in mm.
    pub radius_mm: f64,
    /// What the place lies at.
    pub standing: StationStatus,
}

/// The cross-section of a vessel.
#[derive(Clone, Debug, PartialEq)]
pub struct CrossSection {
    /// Its outline.
    pub outline: Outline,
    /// Its centroid, in mm.
    pub middle: DVec3,
    /// Area in mm2.
    pub area_mm2: f64,
    /// Least and largest distance in mm of two parallel lines that hold it.
    pub widths_mm: [f64; 2],
}

/// The angle between two branches at a fork.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForkAngle<'a> {
    /// Where the vessel divides, in mm.
    pub at: DVec3,
    /// The two branches.
    pub branches: [&'a BranchCalibre; 2],
    /// The way of each, of length 1.
    pub directions: [DVec3; 2],
}

messages! {
    /// Why nothing was measured.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum NotMeasured {
        /// There are no stations.
        "vessels-error-no-centreline" NoCentreline => "there is no centreline to be square to",
        /// The plane cuts no closed loop around the centreline.
        "vessels-error-not-closed" NotClosed =>
            "the wall is not closed around the centreline there: the surface is open or folded in that plane",
        /// No branch divides.
        "vessels-error-no-fork" NoFork => "no vessel divides: an angle can be measured between three places",
        /// A branch is nowhere one vessel of its own.
        "vessels-error-short" Short => "a branch of this fork is too short to have a direction of its own",
    }
}

/// The place beside `p`.
///
/// # Errors
/// When no branch has a centreline.
pub fn beside(branches: &[BranchCalibre], p: DVec3) -> Result<BranchPlace<'_>, NotMeasured> {
    let mut best: Option<(f64, &BranchCalibre, usize, f64)> = None;
    for branch in branches {
        for i in 0..branch.at_mm.len() {
            // A branch of one station has that place alone.
            let k = (i + 1).min(branch.at_mm.len() - 1);
            if k == i && i > 0 {
                break;
            }
            let place = |i: usize| Place { at: station(branch, i), radius: radius(branch, i) };
            let found = power(place(i), place(k), p);
            if best.is_none_or(|(least, ..)| found.power < least) {
                best = Some((found.power, branch, i, found.part));
            }
        }
    }
    let (_, branch, i, part) = best.ok_or(NotMeasured::NoCentreline)?;
    let k = (i + 1).min(branch.at_mm.len() - 1);
    let arc = |i: usize| f64::from(branch.abscissas_mm.get(i).copied().unwrap_or(0.0));
    along(branch, arc(i) + (arc(k) - arc(i)) * part).ok_or(NotMeasured::NoCentreline)
}

/// The place on a branch at an arc length in mm, or at the end that is nearer; `None` where it has no stations.
pub fn along(branch: &BranchCalibre, abscissa_mm: f64) -> Option<BranchPlace<'_>> {
    if branch.at_mm.is_empty() || branch.abscissas_mm.len() != branch.at_mm.len() {
        return None;
    }
    let (at, i) = at_arc(branch, abscissa_mm);
    let radius_mm = radius(branch, i);
    let chord = at_arc(branch, abscissa_mm + radius_mm).0 - at_arc(branch, abscissa_mm - radius_mm).0;
    Some(BranchPlace {
        branch,
        abscissa_mm: abscissa_mm.clamp(0.0, branch.abscissas_mm.last().map_or(0.0, |&arc| f64::from(arc))),
        at,
        direction: chord.normalize_or(DVec3::Z),
        radius_mm,
        standing: branch.standings.get(i).copied().unwrap_or(StationStatus::Counts),
    })
}

/// The cross-section of the vessel of `triangles` at a place of its centreline: the closed outline that goes around it
/// once, the least of several; where none does, as on a surface that has moved, the one whose middle is nearest, if that
/// is no farther than a radius.
///
/// # Errors
/// When there is no such outline.
pub fn cross_section(
    positions: &[Vec3],
    triangles: &[[u32; 3]],
    place: &BranchPlace<'_>,
) -> Result<CrossSection, NotMeasured> {
    let (at, normal) = (place.at, place.direction);
    let sections = cut(positions, triangles, at, normal).into_iter().filter_map(|outline| {
        let area_mm2 = outline.area(normal);
        (area_mm2 > 0.0).then(|| (outline.middle(normal), area_mm2, outline))
    });
    let (around, others): (Vec<_>, Vec<_>) = sections.partition(|(.., outline)| outline.winding(at, normal) == 1);
    let near = |(middle, ..): &(DVec3, f64, Outline)| middle.distance(at);
    let (middle, area_mm2, outline) = around
        .into_iter()
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .or_else(|| {
            others.into_iter().min_by(|a, b| near(a).total_cmp(&near(b))).filter(|it| near(it) <= place.radius_mm)
        })
        .ok_or(NotMeasured::NotClosed)?;
    Ok(CrossSection { middle, area_mm2, widths_mm: outline.widths(normal), outline })
}

/// The angle of the fork that is nearest to `p`, between the two branches that the widest of its vessels divides into:
/// the one that is nearest to `p` and the widest of the others. Which of them the tree begins with does not matter.
///
/// # Errors
/// When there is no fork, or one of the two branches is too short.
pub fn fork(branches: &[BranchCalibre], p: DVec3) -> Result<ForkAngle<'_>, NotMeasured> {
    let next_of = |parent: &BranchCalibre| {
        let is_next = |branch: &&BranchCalibre| branch.parent == Some(parent.number) && !branch.at_mm.is_empty();
        branches.iter().filter(is_next).collect::<Vec<_>>()
    };
    let forks = branches.iter().filter(|branch| !branch.at_mm.is_empty()).map(|parent| (parent, next_of(parent)));
    let joint = |parent: &BranchCalibre| station(parent, parent.at_mm.len() - 1);
    let (parent, mut around) = forks
        .filter(|(_, next)| next.len() > 1)
        .min_by(|(a, _), (b, _)| joint(a).distance_squared(p).total_cmp(&joint(b).distance_squared(p)))
        .ok_or(NotMeasured::NoFork)?;
    around.push(parent);
    let middle = |branch: &BranchCalibre| radius(branch, branch.at_mm.len() / 2);
    around.sort_by(|a, b| middle(b).total_cmp(&middle(a)));
    // The first is what divides.
    let parts = &around[1..];
    let distance = |branch: &BranchCalibre| {
        let squared = |i: usize| station(branch, i).distance_squared(p) - radius(branch, i) * radius(branch, i);
        (0..branch.at_mm.len()).map(squared).fold(f64::INFINITY, f64::min)
    };
    let nearest =
        parts.iter().copied().min_by(|a, b| distance(a).total_cmp(&distance(b))).ok_or(NotMeasured::NoFork)?;
    let widest = parts.iter().copied().find(|branch| branch.number != nearest.number).ok_or(NotMeasured::NoFork)?;
    let way = |branch: &BranchCalibre| if branch.number == parent.number { way_back(branch) } else { way(branch) };
    let directions = [way(nearest)?, way(widest)?];
    Ok(ForkAngle { at: joint(parent), branches: [nearest, widest], directions })
}

impl ForkAngle<'_> {
    /// In degrees, 0 to 180.
    pub fn degrees(&self) -> f64 {
        let [one, other] = self.directions;
        libm::acos(one.dot(other).clamp(-1.0, 1.0)).to_degrees()
    }
}

/// The way of a branch from where it is a vessel of its own.
fn way(branch: &BranchCalibre) -> Result<DVec3, NotMeasured> {
    let is_own = |standing: &StationStatus| !matches!(standing, StationStatus::Fork);
    let first = branch.standings.iter().position(is_own).ok_or(NotMeasured::Short)?;
    let arc = f64::from(branch.abscissas_mm[first]);
    let chord = at_arc(branch, arc + 2.0 * radius(branch, first)).0 - station(branch, first);
    chord.try_normalize().ok_or(NotMeasured::Short)
}

/// The way back along a branch from where it ends as a vessel of its own.
fn way_back(branch: &BranchCalibre) -> Result<DVec3, NotMeasured> {
    let is_own = |standing: &StationStatus| !matches!(standing, StationStatus::Fork);
    let last = branch.standings.iter().rposition(is_own).ok_or(NotMeasured::Short)?;
    let arc = f64::from(branch.abscissas_mm[last]);
    let chord = at_arc(branch, arc - 2.0 * radius(branch, last)).0 - station(branch, last);
    chord.try_normalize().ok_or(NotMeasured::Short)
}

/// The point at an arc length, and the station next to it.
fn at_arc(branch: &BranchCalibre, arc_mm: f64) -> (DVec3, usize) {
    let arcs = &branch.abscissas_mm;
    let last = branch.at_mm.len().saturating_sub(1);
    let i = arcs.partition_point(|&arc| f64::from(arc) <= arc_mm).saturating_sub(1).min(last);
    let k = (i + 1).min(last);
    let (from, to) = (f64::from(arcs[i]), f64::from(arcs[k]));
    let part = ((arc_mm - from) / (to - from).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (station(branch, i).lerp(station(branch, k), part), if part < 0.5 { i } else { k })
}

fn station(branch: &BranchCalibre, i: usize) -> DVec3 {
    Vec3::from(branch.at_mm[i]).as_dvec3()
}

/// Radius of the vessel as opened beside a station, in mm: of the ball inside, or of the circle of the same area.
fn radius(branch: &BranchCalibre, i: usize) -> f64 {
    let of = |radii: &[Option<f32>]| radii.get(i).copied().flatten().filter(|&radius| radius > 0.0);
    of(&branch.opened.inscribed_radii_mm).or_else(|| of(&branch.opened.radii_mm)).map_or(0.0, f64::from)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;
    use std::sync::Arc;

    use super::*;
    use crate::Subject;
    use crate::certificate::{Certificate, TOLERANCE_PERCENT};
    use lumen_mesh::TriMesh;
    use lumen_mesh::shapes::{fork as forked, tube};
    use lumen_mesh::task::{Yielder, at_once};

    fn branches(mesh: &TriMesh) -> Vec<BranchCalibre> {
        let subject = || Subject::new(&Arc::new(mesh.clone()));
        let subjects = [subject(), subject(), subject()];
        at_once(Certificate::of(subjects, TOLERANCE_PERCENT, &Yielder::never())).unwrap().branches
    }

    #[test]
    fn wherever_around_a_tube_one_points_its_section_is_the_circle() {
        let mesh = tube(96, 120, 40.0, |_| 3.0);
        let branches = branches(&mesh);
        for angle in [0.0, 1.0, 2.5, 4.0] {
            let (sin, cos) = libm::sincos(angle);
            let place = beside(&branches, DVec3::new(3.0 * cos, 3.0 * sin, 17.3)).unwrap();
            assert!(place.at.distance(DVec3::Z * 17.3) < 0.1, "{place:?}");
            assert!(place.direction.z.abs() > 0.9999 && (place.radius_mm / 3.0 - 1.0).abs() < 0.01);
            let section = cross_section(&mesh.positions, &mesh.triangles, &place).unwrap();
            assert!((section.area_mm2 / (9.0 * PI) - 1.0).abs() < 0.003, "{section:?}");
            assert!(section.widths_mm.iter().all(|width| (width / 6.0 - 1.0).abs() < 0.003));
            assert!(section.middle.distance(DVec3::Z * 17.3) < 0.1);
        }
        // Where the tube is open, the plane still is across it.
        let end = beside(&branches, DVec3::new(3.0, 0.0, -1.0)).unwrap();
        assert!(end.abscissa_mm == 0.0 || (end.abscissa_mm - end.branch.length_mm).abs() < 0.1);
    }

    #[test]
    fn the_section_is_of_the_vessel_that_is_pointed_at_and_the_angle_that_of_the_branches() {
        let (mesh, [root, joint, left, right]) = forked();
        let branches = branches(&mesh);
        let across = |from: DVec3, to: DVec3, part: f64, radius: f64| {
            from.lerp(to, part) + (to - from).any_orthogonal_vector().normalize() * radius
        };
        for (from, to, radius) in [(root, joint, 4.0), (joint, left, 3.0), (joint, right, 2.0)] {
            let place = beside(&branches, across(from, to, 0.6, radius)).unwrap();
            assert!(place.at.distance(from.lerp(to, 0.6)) < 0.3, "{place:?}");
            let section = cross_section(&mesh.positions, &mesh.triangles, &place).unwrap();
            assert!((section.area_mm2 / (PI * radius * radius) - 1.0).abs() < 0.04, "{}", section.area_mm2);
        }
        for p in [across(joint, left, 0.2, 3.0), across(joint, right, 0.9, 2.0), root] {
            let found = fork(&branches, p).unwrap();
            assert!((found.degrees() - 80.0).abs() < 2.0, "{}", found.degrees());
            assert!(found.at.distance(joint) < 4.0, "{found:?}");
        }
    }

    #[test]
    fn what_cannot_be_measured_is_told_why() {
        assert_eq!(beside(&[], DVec3::ZERO).unwrap_err(), NotMeasured::NoCentreline);
        let mesh = tube(48, 60, 40.0, |_| 3.0);
        let branches = branches(&mesh);
        assert_eq!(fork(&branches, DVec3::ZERO).unwrap_err(), NotMeasured::NoFork);
        let place = BranchPlace { direction: DVec3::X, ..beside(&branches, DVec3::Z * 20.0).unwrap() };
        let along = cross_section(&mesh.positions, &mesh.triangles, &place);
        assert_eq!(along.unwrap_err(), NotMeasured::NotClosed);
        assert!(NotMeasured::NotClosed.to_string().contains("open"));
    }
}
