//! Steers the wire along the route, by a stated policy without chance:
//!
//! 1. Feed at [`FEED`]. Where the route turns, turn the side to which the tip is bent towards where the route goes a
//!    little ahead, and feed slowly while it looks another way. Where the route goes straight on, leave the tip as it is:
//!    a bent tip lies on one side of the lumen, and would turn for ever to look at the middle.
//! 2. When the tip is off the route, when it has not come on for a while, or when the wire has turned back on itself:
//!    withdraw along the route by one of `BY`, and a little more while the tip does not look where it should.
//! 3. Try again, at the fastest feed that a hand gives. The first time at a place, come to it with the tip turned from
//!    the wrong branch towards the right one; then as in 1, turned more and more to the one side or the other by
//!    `OFFSETS`. After `ATTEMPTS` give up.
//!
//! Which of these attempts gets past the place a [`Trial`](super::session::Trial) finds out by simulation, from the second
//! on; those that do not are left out.
//!
//! The tip reaches no farther to the side than its bend is long: a branch on the far side of a wide lumen, from where the
//! shaft lies, takes many tries, or a wire with a longer bend.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::route::Route;
use super::setup::Input;
use lumen_message::messages;

/// Speed of the feed in mm/s.
pub const FEED: f64 = 20.0;
/// Speed of the feed where it is tried again, in mm/s: most of the time goes by there, and at 20 and 40 mm/s more
/// forks are missed.
const AGAIN: f64 = Input::MAX_FEED as f64;
/// Speed of withdrawal in mm/s.
pub(super) const BACK: f64 = 30.0;
/// Feed and withdrawal while the tip looks the wrong way, in mm/s.
const CAREFUL: f64 = 6.0;
/// The fastest roll in rad/s, and the roll for each radian that the tip should turn, in rad/s.
const ROLL: (f64, f64) = (6.0, 4.0);
/// How far ahead the route is looked at, in mm, and in radii of the lumen.
const AHEAD: (f64, f64) = (4.0, 1.5);
/// Cosine between the route's way here and ahead above which it goes straight on: ten degrees.
const STRAIGHT: f64 = 0.985;
/// The sine of less than four degrees is no side.
const MIN_SIDE: f64 = 0.07;
/// The tip looks the wrong way beyond this, in radians, and the right way again within this.
const WRONG: f64 = 1.0;
const RIGHT: f64 = 0.5;
/// Seconds off the route before the wire is withdrawn.
const ASTRAY: f64 = 0.15;
/// Seconds without progress along the route, and turned back on itself, likewise.
const STUCK: f64 = 1.2;
const LOOPED: f64 = 0.5;
/// Times that it tries again.
const ATTEMPTS: u32 = 60;
/// The tries at one place, after the first, that are not the same as one before.
const PLAN: usize = BY.len() * OFFSETS.len();
/// Millimetres by which it is withdrawn, one attempt at a place after another.
const BY: [f64; 3] = [6.0, 10.0, 16.0];
/// Millimetres more at most for the tip to turn.
const TURNING: f64 = 8.0;
/// The angles by which attempts at a place are turned, from the second on, in radians.
const OFFSETS: [f64; 7] = [0.0, -0.6, 0.6, -1.2, 1.2, -1.8, 1.8];
/// Millimetres before a place where it went wrong from which on that counts, and behind it until it is forgotten.
const BEFORE: f64 = 16.0;
const PASSED: f64 = 6.0;
/// Radii of the lumen behind a place where it went wrong at which the right branch is.
const INTO: f64 = 2.0;
/// Seconds between two decisions: ten steps.
pub const DECISION: f64 = 0.02;

/// What the autopilot sees.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Where the tip is, in mm.
    pub tip: DVec3,
    /// Direction of the shaft behind the bend.
    pub shaft: DVec3,
    /// The side to which the tip is bent.
    pub side: DVec3,
    /// Arc length of the tip along the route, in mm.
    pub arc: f64,
    /// Length outside the guide, in mm.
    pub inserted: f64,
    /// Whether the tip is off the route.
    pub is_off: bool,
    /// Whether the wire has turned back on itself.
    pub is_looped: bool,
    /// Whether the push is at its limit: it would take too much force.
    pub is_hard: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Doing {
    /// On along the route.
    Advancing,
    /// Back to an arc length of the route and a length outside the guide.
    Withdrawing { arc: f64, inserted: f64 },
}

/// Where it went wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Trouble {
    /// Arc length along the route, in mm.
    arc: f64,
    /// From the wrong branch to the right one, if it was in a wrong one.
    away: Option<DVec3>,
    /// Times that it went wrong there.
    times: usize,
    /// The attempt that is made, of those that differ: 1 for the first.
    attempt: usize,
    /// Whether it was looked ahead there.
    has_looked: bool,
}

/// The autopilot's mind.
#[derive(Clone, Debug, PartialEq)]
pub struct Autopilot {
    doing: Doing,
    trouble: Option<Trouble>,
    /// The largest arc since the last attempt began, and the seconds since.
    best: f64,
    since_best: f64,
    astray: f64,
    looped: f64,
    /// The attempt that is made when the wire is withdrawn next, where that is settled.
    settled: Option<usize>,
    /// Times the wire was withdrawn.
    pub retractions: u32,
}

impl Default for Autopilot {
    fn default() -> Self {
        Self {
            doing: Doing::Advancing,
            trouble: None,
            best: f64::NEG_INFINITY,
            since_best: 0.0,
            astray: 0.0,
            looped: 0.0,
            settled: None,
            retractions: 0,
        }
    }
}

impl Autopilot {
    /// What to do until the next decision; `None` when it gives up.
    pub fn decide(&mut self, route: &Route, seen: &Seen) -> Option<Input> {
        let timed = |time: &mut f64, is: bool| *time = if is { *time + DECISION } else { 0.0 };
        timed(&mut self.astray, seen.is_off);
        timed(&mut self.looped, seen.is_looped);
        let error = self.turn(route, seen);
        match self.doing {
            Doing::Advancing => {
                self.trouble = self.trouble.filter(|trouble| seen.is_off || seen.arc <= trouble.arc + PASSED);
                if seen.arc > self.best + 0.2 && !seen.is_off {
                    self.best = seen.arc;
                    self.since_best = 0.0;
                } else {
                    self.since_best += DECISION;
                }
                let is_stuck = self.since_best > STUCK || seen.is_hard;
                if self.astray > ASTRAY || is_stuck || self.looped > LOOPED {
                    self.withdraw(route, seen)?;
                }
            }
            Doing::Withdrawing { arc, inserted } => {
                let is_back = !seen.is_off && !seen.is_looped && seen.arc <= arc && seen.inserted <= inserted;
                let is_turned = error.abs() < RIGHT || seen.arc <= arc - TURNING;
                if (is_back && is_turned) || seen.inserted <= 5.0 {
                    self.doing = Doing::Advancing;
                    self.best = seen.arc;
                    self.since_best = 0.0;
                }
            }
        }
        let feed = match self.doing {
            Doing::Withdrawing { arc, .. } if seen.is_off || seen.arc > arc => -BACK,
            Doing::Withdrawing { .. } => -CAREFUL,
            Doing::Advancing if error.abs() > WRONG => CAREFUL,
            Doing::Advancing if self.trouble.is_some() => AGAIN,
            Doing::Advancing => FEED,
        };
        let roll = (ROLL.1 * error).clamp(-ROLL.0, ROLL.0);
        Some(Input { feed: feed as f32, roll: roll as f32 })
    }

    /// Whether it has tried all it knows at a place.
    pub(super) fn has_failed_at_a_place(&self) -> bool {
        // The first time has a way of its own.
        self.trouble.is_some_and(|trouble| trouble.times > PLAN + 1)
    }

    /// The attempts at a place that are not the same as one before, after the first, in turn.
    pub(super) fn plan() -> impl Iterator<Item = usize> {
        2..PLAN + 2
    }

    /// It was looked ahead at the place where it would withdraw the wire next: makes this attempt then, if one was found.
    pub(super) fn looked_ahead(&mut self, found: Option<usize>) {
        self.settled = found;
        if let Some(trouble) = &mut self.trouble {
            trouble.has_looked = true;
        }
    }

    /// The place, as arc length in mm, at which it has withdrawn the wire again since it was as `before`, if it was not
    /// looked ahead there.
    pub(super) fn failed_again_since(&self, before: &Self) -> Option<f64> {
        let trouble = self.trouble.filter(|trouble| trouble.times > 1 && !trouble.has_looked)?;
        (self.retractions > before.retractions).then_some(trouble.arc)
    }

    /// Whether it is past a place, by so much that what goes wrong next does so at another.
    pub(super) fn is_past(&self, place: f64, seen: &Seen) -> bool {
        self.trouble.is_none() && !seen.is_off && seen.arc > place + BEFORE
    }

    fn withdraw(&mut self, route: &Route, seen: &Seen) -> Option<()> {
        if self.retractions == ATTEMPTS {
            return None;
        }
        self.retractions += 1;
        // The same place again, or another.
        let known = self.trouble.filter(|trouble| self.best > trouble.arc - BEFORE);
        let times = known.map_or(0, |trouble| trouble.times);
        let arc = known.map_or(self.best, |trouble| trouble.arc.max(self.best));
        let right = route.at(arc + INTO * route.at(arc).radius).at;
        let away = if seen.is_off { Some(right - seen.tip) } else { known.and_then(|trouble| trouble.away) };
        let attempt = self.settled.take().unwrap_or(times + 1);
        let has_looked = known.is_some_and(|trouble| trouble.has_looked);
        self.trouble = Some(Trouble { arc, away, times: times + 1, attempt, has_looked });
        let by = BY[(attempt - 1) % BY.len()];
        self.doing = Doing::Withdrawing { arc: self.best - by, inserted: (seen.inserted - by).max(5.0) };
        (self.astray, self.looped) = (0.0, 0.0);
        Some(())
    }

    /// The angle by which the tip should turn about the shaft, in radians; 0 where the route goes straight on.
    fn turn(&self, route: &Route, seen: &Seen) -> f64 {
        let here = route.at(seen.arc);
        let ahead = route.at(seen.arc + AHEAD.0 + AHEAD.1 * here.radius);
        let on = ahead.at - seen.tip;
        let trouble = self.trouble.filter(|trouble| seen.arc > trouble.arc - BEFORE);
        let (to, offset) = match trouble {
            None if here.direction.dot(ahead.direction) > STRAIGHT => return 0.0,
            None => (on, 0.0),
            Some(Trouble { away: Some(away), attempt: 1, .. }) => (away, 0.0),
            Some(Trouble { attempt, .. }) => (on, OFFSETS[attempt.saturating_sub(2) % OFFSETS.len()]),
        };
        let wanted = to.normalize_or(here.direction).reject_from(seen.shaft);
        let side = seen.side.reject_from(seen.shaft);
        // An offset means to try another way.
        if wanted.length() < MIN_SIDE && offset == 0.0 || side.length() < 1e-3 {
            return 0.0;
        }
        let angle = libm::atan2(seen.shaft.dot(side.cross(wanted)), side.dot(wanted)) + offset;
        let turns = std::f64::consts::TAU;
        angle - turns * (angle / turns).round()
    }

    /// What it is doing, to a user.
    pub fn task(&self) -> AutopilotTask {
        match self.doing {
            Doing::Advancing if self.trouble.is_none() => AutopilotTask::Following,
            Doing::Advancing => AutopilotTask::TryingAgain,
            Doing::Withdrawing { .. } => AutopilotTask::Withdrawing,
        }
    }
}

messages! {
    /// What the autopilot is doing.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    pub enum AutopilotTask {
        /// It follows the route.
        "trial-doing-following" Following => "Following the route",
        /// It tries again where it failed, turned.
        "trial-doing-again" TryingAgain => "Trying again, turned",
        /// It withdraws the wire.
        "trial-doing-withdrawing" Withdrawing => "Withdrawing",
        /// It withdraws the wire to put in another.
        "trial-doing-exchanging" Exchanging => "Taking the wire out for another",
        /// It waits while attempts are simulated.
        "trial-doing-looking-ahead" LookingAhead {
            /// Which of them, counted from 1.
            attempt: u32,
            /// How many there are.
            attempts: u32,
        } => "Looking ahead, attempt {attempt} of {attempts}",
    }
}
