//! Where a cross-section is that of one vessel, so that it can be compared with another surface's.
//!
//! It is not within one radius of an open end or two of a cap, where smoothing draws in rims and rounds caps, nor at a
//! fork, where the plane across one vessel cuts the wall of another. A fork goes as far as the two vessels are attached
//! to each other and one radius of the side branch beyond (one diameter, along the vessel that it comes out of): from
//! where it leaves, place by place, while its cross-section does not close or is more than half as wide again as the
//! ball in it, or the plane of one of the two vessels meets the balls of the other. A branch that comes back to the
//! tree at its far end, as around a loop, is attached there in the same way.

use super::stations::{Station, Stations};
use super::tree::{Branch, End};

/// Left free at an end and beyond a fork, in radii of the vessel there,
const BESIDE: f64 = 1.0;
/// and along the vessel that a side branch comes out of, in radii of the side branch: before it leaves, that is wider.
const BESIDE_OSTIUM: f64 = 2.0;
/// Left free at a cap, in radii of the vessel: smoothing rounds a flat one over as much.
const BESIDE_CAP: f64 = 2.0;
/// Two vessels are attached while the plane across one meets a ball of the other, with this part of the smaller radius to
/// spare in all directions,
const SPARE: f64 = 0.25;
/// or while the cross-section of the side branch is that of a circle of more than this many times the inscribed radius.
const ROUND: f64 = 1.5;

/// What a station lies at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zone {
    /// One vessel.
    Vessel,
    /// An open or closed end.
    End,
    /// Where vessels meet.
    Fork,
}

/// A chain of branches each of which goes straight on from the last.
struct Path {
    /// Its stations in order.
    stations: Vec<usize>,
    /// The first that is out of the lumen of what it leaves.
    ostium: usize,
    parent: Option<usize>,
    ends: [End; 2],
    /// The vessel's radius at both ends, where that is at a cap.
    caps: [Option<f64>; 2],
}

/// The zone of each station; `radii` are those of the circles of the cross-sections' areas, in mm, of the same surface.
pub(super) fn zones(branches: &[Branch], stations: &Stations, radii: &[Option<f64>]) -> Vec<Zone> {
    let all = &stations.all;
    let is_round = |i: usize| radii[i].is_some_and(|radius| radius <= ROUND * all[i].radius_mm);
    let mut zones = vec![Zone::Vessel; all.len()];
    let paths = paths(branches, stations);
    for path in &paths {
        mark_ends(path, all, &mut zones);
    }
    for (own, path) in paths.iter().enumerate() {
        if let Some(parent) = path.parent {
            let (inner, outer) = path.stations.split_at(path.ostium);
            attach(inner, outer, &paths[parent].stations, all, &is_round, &mut zones);
        }
        // What ends beside another vessel without an end of its own goes on in it.
        let Some(&last) = path.stations.last().filter(|_| path.ends[1] == End::Closed) else { continue };
        for (other, beside) in paths.iter().enumerate() {
            let is_near = |&i: &usize| all[i].at.distance(all[last].at) < all[i].radius_mm + all[last].radius_mm;
            if other != own && beside.stations.iter().any(is_near) {
                let back: Vec<usize> = path.stations[path.ostium..].iter().rev().copied().collect();
                attach(&[], &back, &beside.stations, all, &is_round, &mut zones);
            }
        }
    }
    zones
}

fn paths(branches: &[Branch], stations: &Stations) -> Vec<Path> {
    let mut paths: Vec<Path> = Vec::new();
    let mut path_of = Vec::with_capacity(branches.len());
    for ((branch, range), &caps) in branches.iter().zip(&stations.of).zip(&stations.caps) {
        let goes_on = branch.parent.filter(|_| branch.goes_straight_on()).map(|parent| path_of[parent as usize]);
        match goes_on {
            Some(path) => {
                let whole: &mut Path = &mut paths[path];
                whole.stations.extend(range.clone());
                whole.ends[1] = branch.ends[1];
                whole.caps[1] = caps[1];
                path_of.push(path);
            }
            None => {
                let out = branch.arcs.get(branch.ostium).copied().unwrap_or(0.0);
                let own = &stations.all[range.clone()];
                path_of.push(paths.len());
                paths.push(Path {
                    stations: range.clone().collect(),
                    ostium: own.partition_point(|station| station.abscissa_mm < out),
                    parent: branch.parent.map(|parent| path_of[parent as usize]),
                    ends: branch.ends,
                    caps,
                });
            }
        }
    }
    paths
}

/// Marks what is within a radius of an end, or within two of a cap.
fn mark_ends(path: &Path, all: &[Station], zones: &mut [Zone]) {
    let mut mark = |order: &mut dyn Iterator<Item = &usize>, cap: Option<f64>| {
        let (mut arc, mut last) = (0.0, None::<&Station>);
        let mut reach = 0.0;
        for &i in order {
            match last {
                None => reach = cap.map_or(BESIDE * all[i].radius_mm, |radius| BESIDE_CAP * radius),
                Some(last) => arc += last.at.distance(all[i].at),
            }
            if arc > reach {
                break;
            }
            zones[i] = Zone::End;
            last = Some(&all[i]);
        }
    };
    if path.ends[0] != End::Joint {
        mark(&mut path.stations.iter(), path.caps[0]);
    }
    if path.ends[1] != End::Joint {
        mark(&mut path.stations.iter().rev(), path.caps[1]);
    }
}

/// Marks, from the first station of `from` on, those that are attached to `to` and those within a radius beyond, and those
/// of `to` that they are attached to, likewise, or that are next to one of `inner`, where the one runs within the other.
fn attach(
    inner: &[usize],
    from: &[usize],
    to: &[usize],
    all: &[Station],
    is_round: &impl Fn(usize) -> bool,
    zones: &mut [Zone],
) {
    let is_met = |p: &Station, q: &Station| {
        let way = q.at - p.at;
        let along = way.dot(p.direction);
        let across = (way - p.direction * along).length();
        let spare = SPARE * p.radius_mm.min(q.radius_mm);
        along.abs() < q.radius_mm + spare && across < p.radius_mm + q.radius_mm + spare
    };
    let is_attached = |&&i: &&usize| !is_round(i) || to.iter().any(|&k| is_met(&all[i], &all[k]));
    let attached = &from[..from.iter().take_while(is_attached).count()];
    let Some(&last) = attached.last().or(from.first()).or(inner.last()) else { return };
    // That of the side branch itself, not of the mouth.
    let free = from.get(attached.len()).copied().unwrap_or(last);
    let radius = all[free].radius_mm;
    let beside = BESIDE * radius;
    let within = |&&i: &&usize| all[i].at.distance(all[free].at) <= beside;
    let beyond = from[attached.len()..].iter().take_while(within);
    let mut is_at = vec![false; to.len()];
    for (at, &k) in is_at.iter_mut().zip(to) {
        *at = attached.iter().any(|&i| is_met(&all[k], &all[i]));
    }
    for &i in inner {
        zones[i] = Zone::Fork;
        let squared = |m: &usize| all[to[*m]].at.distance_squared(all[i].at);
        if let Some(next) = (0..to.len()).min_by(|one, other| squared(one).total_cmp(&squared(other))) {
            is_at[next] = true;
        }
    }
    for (n, &k) in to.iter().enumerate() {
        let within = |&&m: &&usize| all[to[m]].at.distance(all[k].at) <= BESIDE_OSTIUM * radius;
        let (before, after) = ((0..n).rev(), n..to.len());
        let reaches = |m: usize| Some(m).filter(|m| within(&m)).map(|m| is_at[m]);
        let is_near = before.map_while(reaches).any(|at| at) || after.map_while(reaches).any(|at| at);
        if is_near {
            zones[k] = Zone::Fork;
        }
    }
    attached.iter().chain(beyond).for_each(|&i| zones[i] = Zone::Fork);
}
