//! Where a wire could enter and where it could go.

use glam::{DVec3, Vec3};

use super::forks::{are_long, straight_on, turn_degrees};
use super::way::between;
use super::{PlaceName, Route, Routes as _, WayEnd, usual_radius};
use crate::setup::Entry;
use lumen_vessel::phantom::{Sample, Vessel, vessels};
use lumen_vessel::{Branch, End, NONE, Tree, direction};

/// A guide's mouth lies this many radii inside of the vessel's end, at least.
const INSIDE: f64 = 1.0;
/// And this far, in mm, unless the branch is too short.
const INSIDE_MM: f64 = 3.0;

/// The nearest target in mm: within 2 mm of one a wire has arrived before it moves.
const NEAREST: f64 = 5.0;

/// An end with less than this part of the widest end's radius is proposed last: in a noisy scan it is no vessel.
const THREAD: f64 = 0.03;

/// A vessel of this diameter in mm is an aorta; a common iliac artery has 10, a carotid 7, a coronary artery 3 to 5.
const AORTA: f64 = 12.0;
/// An artery of at most this diameter in mm that leaves an aorta is entered in its ostium, by a guide catheter; that of a
/// kidney has 6.
const GUIDED: f64 = 5.0;
/// Where a centreline runs on from an aorta into an artery, its width falls from [`AORTA`] to [`GUIDED`] within so many mm:
/// while a ball goes from the middle of the one into the mouth of the other. From an aorta to a femoral artery that takes
/// 200 mm.
const FALL_MM: f64 = 15.0;
/// A wide piece is an aorta if it is so many times as long as it is wide; an aneurysm is not.
const SLENDER: f64 = 2.0;
/// An artery goes on for so many mm behind its ostium; where a flat end is cut square to a vessel the balls shrink, too.
const ARTERY_MM: f64 = 10.0;
/// From an iliac artery a wire turns into the aorta by no more degrees, from the arteries of bowels, kidneys and the neck by
/// more.
const ILIAC: f64 = 45.0;
/// A way that turns by more degrees at a fork turns back.
const BACK: f64 = 90.0;

/// Where a wire comes into an aorta and its branches, in the order of preference.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Access {
    /// From the groin: an artery that the aorta parts into.
    Femoral,
    /// The aorta is cut off: where it is thinner the wire comes from, against the blood.
    Aortic,
    /// From an arm or the neck, or another of its branches.
    Branch,
}

/// A place where a wire could go.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The branch that it lies in, as its place in [`Tree::branches`].
    pub branch: u32,
    /// What is there.
    pub end: WayEnd,
    /// In the middle of the lumen, in mm.
    pub at: Vec3,
    /// Radius of the lumen there, in mm.
    pub radius_mm: f64,
    /// Length of the way there, in mm.
    pub length_mm: f64,
    /// The radius that half of the way is narrower than, in mm.
    pub usual_radius_mm: f64,
}

impl Target {
    /// What it is called.
    pub fn name(&self) -> PlaceName {
        PlaceName::Target {
            branch: self.branch,
            end: self.end,
            diameter_mm: 2.0 * self.radius_mm,
            away_mm: self.length_mm,
        }
    }
}

/// An end of a vessel.
struct Tip<'a> {
    branch: &'a Branch,
    is_first: bool,
    end: End,
    /// The place a little inside.
    at: usize,
    /// Radius there, in mm.
    radius: f64,
}

/// Where a wire could enter a vessel tree, and where it could go.
pub trait Proposals {
    /// Places where a wire could enter, a little inside of the vessels' ends and pointing inwards, best first: those of
    /// the largest tree, open ones, as a clinician comes in. Into an aorta that is against the blood: from the groin by the
    /// widest artery that the aorta parts into, then where it is cut off and thinner, then by its other branches. Other
    /// vessels, as the coronary arteries, are entered where they are widest: there a guide catheter lies in the ostium. Each
    /// with its name.
    fn entries(&self) -> Vec<(PlaceName, Entry)>;

    /// Places in the ostia of thin arteries that leave an aorta, as the coronary ones do: there a guide catheter lies, and
    /// points along the artery. It lies where the artery leaves the aorta's branch, or where that branch itself becomes
    /// abruptly thin: a centreline may run on from the one into the other. By the branch's place in [`Tree::branches`].
    fn ostia(&self) -> Vec<(PlaceName, Entry)>;

    /// That of [`Self::ostia`] which lies on the way from `from` to `to`, nearest to `to`.
    fn ostium_on_way(&self, from: Vec3, to: Vec3) -> Option<(PlaceName, Entry)>;

    /// Places where a wire from `from` could go, best first: far, and thin; last those to which the way turns back at a
    /// fork. Where the lumen on the way becomes thinner than `room_mm` across, the last place before that.
    fn targets(&self, from: Vec3, room_mm: f64) -> Vec<Target>;
}

impl Proposals for Tree {
    fn entries(&self) -> Vec<(PlaceName, Entry)> {
        let mut tips: Vec<(Option<Access>, Tip<'_>)> =
            tips(self).into_iter().map(|tip| (access(self, &tip), tip)).collect();
        tips.sort_by(|(by, a), (other, b)| {
            let key = |by: Option<Access>, tip: &Tip<'_>| (tip.branch.tree, tip.end != End::Open, by);
            let widest = b.radius.total_cmp(&a.radius);
            let width = if *by == Some(Access::Aortic) { widest.reverse() } else { widest };
            key(*by, a).cmp(&key(*other, b)).then(width).then(a.branch.id.cmp(&b.branch.id))
        });
        let name = |tip: &Tip<'_>| PlaceName::Entry { branch: tip.branch.id, diameter_mm: 2.0 * tip.radius };
        tips.iter().map(|(_, tip)| (name(tip), tip.entry())).collect()
    }

    fn ostia(&self) -> Vec<(PlaceName, Entry)> {
        let found = self.branches().iter().flat_map(|branch| {
            let begins = branch.parent.is_some_and(|parent| is_of_aorta(self, &self.branches()[parent as usize]));
            let at_start = (begins && branch.ostium > 0).then_some((branch.ostium, true));
            let within = [true, false].into_iter().filter_map(|is_along| Some((fall(branch, is_along)?, is_along)));
            at_start.into_iter().chain(within).filter_map(|(mouth, is_along)| guided(branch, mouth, is_along))
        });
        // Where walls cross each other, it may be outside of another vessel.
        found.filter(|(_, entry)| self.is_inside(Vec3::from(entry.at))).collect()
    }

    fn ostium_on_way(&self, from: Vec3, to: Vec3) -> Option<(PlaceName, Entry)> {
        let ostia = self.ostia();
        let route = (!ostia.is_empty()).then(|| self.route(from, to).ok()).flatten()?;
        last_passed(&ostia, &route, to).map(|(_, ostium)| *ostium)
    }

    fn targets(&self, from: Vec3, room_mm: f64) -> Vec<Target> {
        let Some(ways) = nearest_ball(self, from).map(|ball| self.graph.ways(ball)) else { return Vec::new() };
        let own = self.locate(from.as_dvec3(), None).map(|located| located.branch);
        let turns_back = |target: u32| {
            own.is_some_and(|own| between(self, own, target).windows(2).any(|pair| is_back(self, [pair[0], pair[1]])))
        };
        let tips = tips(self);
        let widest = tips.iter().map(|tip| tip.radius).fold(0.0, f64::max);
        let mut found: Vec<([bool; 2], f64, Target)> = Vec::new();
        for tip in &tips {
            let end = tip.branch.points[tip.at].at.as_vec3();
            let Some(last) = nearest_ball(self, end).filter(|&ball| ways.length[ball as usize].is_finite()) else {
                continue;
            };
            let mut way: Vec<u32> = std::iter::successors(Some(last), |&ball| {
                Some(ways.before[ball as usize]).filter(|&before| before != NONE)
            })
            .collect();
            way.reverse();
            let ball = |i: usize| &self.graph.balls[way[i] as usize];
            // What fits through between balls is less than what fits through the lumen: an end is rather left out.
            let is_roomy = |i: &usize| {
                let passage = ball(*i).passage(ball(i.saturating_sub(1)));
                2.0 * f64::from(passage.min(ball(*i).radius)) >= room_mm
            };
            let room = (0..way.len()).take_while(is_roomy).count();
            let Some(there) = room.checked_sub(1) else { continue };
            let is_whole = room == way.len();
            let (at, radius) =
                if is_whole { (end, tip.radius) } else { (ball(there).centre, ball(there).radius.into()) };
            if f64::from(from.distance(at)) <= NEAREST.max(2.0 * radius) {
                continue;
            }
            let end = match tip.end {
                _ if !is_whole => WayEnd::Narrow,
                End::Open => WayEnd::Open,
                _ => WayEnd::Closed,
            };
            let length = |i: usize| f64::from(ways.length[way[i] as usize]);
            let pieces = (1..room).map(|i| (f64::from(ball(i).radius), length(i) - length(i - 1))).collect();
            let target = Target {
                branch: tip.branch.id,
                end,
                at,
                radius_mm: radius,
                length_mm: length(there),
                usual_radius_mm: usual_radius(pieces),
            };
            let last = [tip.radius < THREAD * widest, turns_back(target.branch)];
            found.push((last, target.length_mm / radius.sqrt(), target));
        }
        found.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        found.into_iter().map(|(.., target)| target).collect()
    }
}

/// That of some ostia which a route to `to` passes last, with the arc length in mm.
pub(crate) fn last_passed<'a>(
    ostia: &'a [(PlaceName, Entry)],
    route: &Route,
    to: Vec3,
) -> Option<(f64, &'a (PlaceName, Entry))> {
    let passed = ostia.iter().filter_map(|ostium| {
        let (at, way) = (Vec3::from(ostium.1.at), Vec3::from(ostium.1.direction).as_dvec3());
        let on = route.locate(at.as_dvec3());
        let is_on_way = on.distance_mm < on.radius_mm && route.at(on.arc_mm).direction.dot(way) > 0.0;
        (is_on_way && f64::from(at.distance(to)) > NEAREST).then_some((on.arc_mm, ostium))
    });
    passed.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// Whether a way turns back where it leaves one branch for another.
fn is_back(tree: &Tree, pair: [u32; 2]) -> bool {
    turn_degrees(tree, pair).is_some_and(|turn| turn > BACK)
}

/// The radius that half of a branch is narrower than, in mm.
fn usual_radius_of(branch: &Branch) -> f64 {
    let pairs = branch.points.windows(2);
    usual_radius(pairs.map(|pair| (pair[1].radius, pair[0].at.distance(pair[1].at))).collect())
}

/// The entry a little behind the mouth of an artery, along the branch or against it, if it is thin there.
fn guided(branch: &Branch, mouth: usize, is_along: bool) -> Option<(PlaceName, Entry)> {
    let mouth = branch.arcs[mouth];
    let at = if is_along {
        branch.arcs.partition_point(|&arc| arc < mouth + INSIDE_MM)
    } else {
        branch.arcs.partition_point(|&arc| arc <= mouth - INSIDE_MM).checked_sub(1)?
    };
    let place = branch.points.get(at).filter(|place| 2.0 * place.radius <= GUIDED)?;
    let way = direction(&branch.points, at) * if is_along { 1.0 } else { -1.0 };
    let entry = Entry { at: place.at.as_vec3().to_array(), direction: way.as_vec3().to_array() };
    Some((PlaceName::Ostium { branch: branch.id, diameter_mm: 2.0 * place.radius }, entry))
}

/// Where one branch, followed along its points or against them, goes over from an aorta into a thin artery: the first place
/// in the artery. A narrow place behind which it is as wide again is none.
fn fall(branch: &Branch, is_along: bool) -> Option<usize> {
    let count = branch.points.len();
    let place = |i: usize| if is_along { i } else { count - 1 - i };
    let diameter = |i: usize| 2.0 * branch.points[place(i)].radius;
    let between = |i: usize, j: usize| (branch.arcs[place(j)] - branch.arcs[place(i)]).abs();
    let last_wide = (0..count).rfind(|&i| diameter(i) >= AORTA)?;
    let mouth = (last_wide..count).find(|&i| diameter(i) <= GUIDED)?;
    let first_wide = (0..last_wide).rfind(|&i| diameter(i) < AORTA).map_or(0, |i| i + 1);
    let widest = (first_wide..=last_wide).map(diameter).fold(0.0, f64::max);
    let is_one = between(last_wide, mouth) <= FALL_MM
        && between(first_wide, last_wide) >= SLENDER * widest
        && between(mouth, count - 1) >= ARTERY_MM;
    is_one.then_some(place(mouth))
}

fn is_aorta(branch: &Branch) -> bool {
    2.0 * usual_radius_of(branch) >= AORTA && branch.length_mm() >= AORTA
}

/// Whether a branch is an aorta or a piece of one between two ostia, which may be short.
fn is_of_aorta(tree: &Tree, branch: &Branch) -> bool {
    let pieces = |is_reversed: bool| {
        let wide = |piece: &&Branch| 2.0 * usual_radius_of(piece) >= AORTA;
        std::iter::successors(Some(branch), move |piece| straight_on(tree, piece, is_reversed)).take_while(wide)
    };
    let lengths = [true, false].map(|is_reversed| pieces(is_reversed).map(Branch::length_mm).sum::<f64>());
    lengths[0] + lengths[1] - branch.length_mm() >= AORTA
}

/// How a wire that enters at an end comes into an aorta; `None` where its tree has none.
fn access(tree: &Tree, tip: &Tip<'_>) -> Option<Access> {
    let is_near = |branch: &&Branch| branch.tree == tip.branch.tree && is_aorta(branch);
    let aortas: Vec<u32> = tree.branches().iter().filter(is_near).map(|branch| branch.id).collect();
    if aortas.is_empty() {
        return None;
    }
    if 2.0 * tip.radius >= AORTA || aortas.contains(&tip.branch.id) {
        return Some(Access::Aortic);
    }
    // Where it comes into the aorta, it goes on up or down.
    let ways: Vec<Vec<u32>> = aortas.iter().map(|&aorta| between(tree, tip.branch.id, aorta)).collect();
    let nearest = ways.iter().map(Vec::len).min();
    let last = ways.iter().filter(|way| Some(way.len()) == nearest).filter_map(|way| way.last_chunk::<2>());
    // A piece between two ostia that is no longer than wide is no artery, and what leads into one may come from the side.
    let turns = last.filter(|&&pair| are_long(tree, pair)).filter_map(|&pair| turn_degrees(tree, pair));
    let is_iliac = turns.fold(f64::INFINITY, f64::min) <= ILIAC;
    Some(if is_iliac { Access::Femoral } else { Access::Branch })
}

fn tips(tree: &Tree) -> Vec<Tip<'_>> {
    let mut tips = Vec::new();
    for branch in tree.branches().iter().filter(|branch| branch.points.len() > 1) {
        for (is_first, end) in [(true, branch.ends[0]), (false, branch.ends[1])] {
            if end == End::Joint {
                continue;
            }
            let last = branch.points.len() - 1;
            let radius = branch.points[if is_first { 0 } else { last }].radius;
            let inside = (INSIDE * radius).max(INSIDE_MM).min(branch.length_mm() / 2.0);
            let at = if is_first {
                branch.arcs.partition_point(|&arc| arc < inside).min(last)
            } else {
                branch.arcs.partition_point(|&arc| arc < branch.length_mm() - inside)
            };
            tips.push(Tip { branch, is_first, end, at, radius: branch.points[at].radius });
        }
    }
    tips
}

fn nearest_ball(tree: &Tree, p: Vec3) -> Option<u32> {
    let power = |i: usize| {
        let ball = tree.graph.balls[i];
        ball.centre.distance_squared(p) - ball.radius * ball.radius
    };
    let powers = (0..tree.graph.balls.len()).map(|i| (power(i), i as u32));
    powers.reduce(|least, next| if next.0 < least.0 { next } else { least }).map(|(_, ball)| ball)
}

impl Tip<'_> {
    fn entry(&self) -> Entry {
        let along = direction(&self.branch.points, self.at);
        let inward = if self.is_first { along } else { -along };
        Entry { at: self.branch.points[self.at].at.as_vec3().to_array(), direction: inward.as_vec3().to_array() }
    }
}

/// Entry and target of a sample.
///
/// The aorta is entered by a sheath in the right common iliac artery, from the groin; a wire alone goes up past the
/// bifurcation and both renal arteries to the upper end. (Into a renal artery, square to a vessel three times as wide,
/// it is led by a shaped catheter.) The coronary arteries are entered by a guide catheter in the left main artery, 3 mm
/// behind its ostium and in line with it; the target is the distal left anterior descending artery, where it is still
/// 1.8 mm wide.
pub fn phantom_task(sample: Sample) -> (Entry, Vec3) {
    let vessels = vessels(sample);
    let vessel = |name: &str| {
        vessels.iter().find(|vessel| vessel.name == name).unwrap_or_else(|| unreachable!("{sample} has a {name}"))
    };
    match sample {
        Sample::Aorta | Sample::AortaNets => {
            let iliac = vessel("right common iliac artery");
            let last = iliac.stations.len() - 1;
            let at = back(iliac, last, 8.0);
            let aorta = vessel("abdominal aorta");
            (entry(iliac, at, -1.0), aorta.stations[onward(aorta, 0, 6.0)].position.as_vec3())
        }
        Sample::Coronary => {
            let main = vessel("left main coronary artery");
            let lad = vessel("left anterior descending artery");
            let target = lad.stations.iter().rposition(|station| station.diameter >= 1.8).unwrap_or(0);
            (entry(main, onward(main, main.ostium, 3.0), 1.0), lad.stations[target].position.as_vec3())
        }
    }
}

/// The first station at least `mm` behind another, along the vessel.
fn onward(vessel: &Vessel, from: usize, mm: f64) -> usize {
    let start = vessel.stations[from].position;
    (from..vessel.stations.len()).find(|&i| vessel.stations[i].position.distance(start) >= mm).unwrap_or(from)
}

/// The last station at least `mm` before another.
fn back(vessel: &Vessel, from: usize, mm: f64) -> usize {
    let start = vessel.stations[from].position;
    (0..from).rev().find(|&i| vessel.stations[i].position.distance(start) >= mm).unwrap_or(from)
}

fn entry(vessel: &Vessel, station: usize, sense: f64) -> Entry {
    let direction: DVec3 = vessel.direction(station) * sense;
    let at = vessel.stations[station].position.as_vec3();
    Entry { at: at.to_array(), direction: direction.as_vec3().to_array() }
}
