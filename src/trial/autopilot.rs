//! Steers the wire along the route, by a stated policy without chance:
//!
//! 1. Feed at [`FEED`], and turn the side to which the tip is bent towards where the route goes a little ahead; slower
//!    while it looks the other way and the route turns.
//! 2. When the tip is off the route, when it has not come on for a while, or when the wire has turned back on itself:
//!    withdraw: out of a wrong branch slowly, with the tip turned to the right one, for it to fall in there; every third
//!    time back to the guide, and turned a little more to the one side or the other of where the route goes.
//! 3. Try again, slowly where it went wrong; after [`ATTEMPTS`] give up.

use super::route::Route;
use super::setup::Input;
use glam::DVec3;

/// Speed of the feed in mm/s.
pub const FEED: f64 = 20.0;
/// Speed of withdrawal in mm/s.
const BACK: f64 = 30.0;
/// Feed while the tip looks the wrong way, in mm/s.
const CAREFUL: f64 = 6.0;
/// The fastest roll in rad/s.
const ROLL: f64 = 6.0;
/// How far ahead the route is looked at, in mm, and in radii of the lumen.
const AHEAD: (f64, f64) = (4.0, 1.5);
/// Seconds off the route before the wire is withdrawn.
const ASTRAY: f64 = 0.15;
/// Seconds without progress along the route, and turned back on itself, likewise.
const STUCK: f64 = 1.2;
const LOOPED: f64 = 0.5;
/// Times that it tries again.
const ATTEMPTS: u32 = 60;
/// The angles by which attempts are turned, one after another, in radians.
const OFFSETS: [f64; 10] = [0.0, 0.6, -0.6, 1.2, -1.2, 1.8, -1.8, 2.4, -2.4, 3.1];
/// Millimetres before a place where it went wrong from which on the feed is slow.
const BEFORE: f64 = 8.0;
/// Millimetres behind a place where it went wrong at which that is forgotten.
const PASSED: f64 = 6.0;
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
    /// Whether the guide holds back: it would take too much force.
    pub is_hard: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Doing {
    /// On along the route.
    Advancing,
    /// Back to an arc length of the route, or a length outside the guide.
    Withdrawing { arc: f64, inserted: f64, speed: f64 },
}

/// The autopilot's mind.
#[derive(Clone, Debug, PartialEq)]
pub struct Autopilot {
    doing: Doing,
    /// Angle by which the tip is turned away from where the route goes.
    offset: f64,
    /// The largest arc since the last attempt began, and the seconds since.
    best: f64,
    since_best: f64,
    astray: f64,
    looped: f64,
    attempts: u32,
    /// The largest arc at which it went wrong.
    failed_at: f64,
    /// Times the wire was withdrawn.
    pub retractions: u32,
}

impl Default for Autopilot {
    fn default() -> Self {
        Self {
            doing: Doing::Advancing,
            offset: 0.0,
            best: f64::NEG_INFINITY,
            since_best: 0.0,
            astray: 0.0,
            looped: 0.0,
            attempts: 0,
            failed_at: f64::NEG_INFINITY,
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
        match self.doing {
            Doing::Advancing => {
                if seen.arc > self.failed_at + PASSED {
                    self.offset = 0.0;
                }
                if seen.arc > self.best + 0.2 && !seen.is_off {
                    self.best = seen.arc;
                    self.since_best = 0.0;
                } else {
                    self.since_best += DECISION;
                }
                let is_stuck = self.since_best > STUCK || seen.is_hard;
                if self.astray > ASTRAY || is_stuck || self.looped > LOOPED {
                    self.withdraw(seen)?;
                }
            }
            Doing::Withdrawing { arc, inserted, .. } => {
                let is_back = !seen.is_off && !seen.is_looped && seen.arc <= arc;
                if (is_back && seen.inserted <= inserted) || seen.inserted <= 5.0 {
                    self.doing = Doing::Advancing;
                    self.best = seen.arc;
                    self.since_best = 0.0;
                }
            }
        }
        let error = self.turn(route, seen);
        let roll = (4.0 * error).clamp(-ROLL, ROLL);
        let feed = match self.doing {
            Doing::Withdrawing { speed, .. } => -speed,
            Doing::Advancing if error.abs() > 1.0 || self.is_slow(seen.arc) => CAREFUL,
            Doing::Advancing => FEED,
        };
        Some(Input { feed: feed as f32, roll: roll as f32 })
    }

    /// Whether it goes slowly because it went wrong here: two times of three.
    fn is_slow(&self, arc: f64) -> bool {
        !self.attempts.is_multiple_of(3) && (self.failed_at - BEFORE..self.failed_at + PASSED).contains(&arc)
    }

    fn withdraw(&mut self, seen: &Seen) -> Option<()> {
        self.attempts += 1;
        if self.attempts > ATTEMPTS {
            return None;
        }
        self.retractions += 1;
        self.offset = OFFSETS[(self.attempts as usize / 3) % OFFSETS.len()];
        self.failed_at = self.failed_at.max(self.best);
        self.doing = if seen.is_off && !self.attempts.is_multiple_of(3) {
            // Slowly over the edge between the branches, for the tip to fall into the right one.
            Doing::Withdrawing { arc: f64::INFINITY, inserted: seen.inserted, speed: CAREFUL }
        } else {
            // Back to the guide every third time: it comes another way then.
            let by = if self.attempts.is_multiple_of(3) { f64::INFINITY } else { 8.0 };
            Doing::Withdrawing { arc: self.best - by.min(8.0), inserted: (seen.inserted - by).max(5.0), speed: BACK }
        };
        (self.astray, self.looped) = (0.0, 0.0);
        Some(())
    }

    /// The angle by which the tip should turn about the shaft, in radians; 0 where the route goes straight on.
    fn turn(&self, route: &Route, seen: &Seen) -> f64 {
        let here = route.at(seen.arc);
        let ahead = route.at(seen.arc + AHEAD.0 + AHEAD.1 * here.radius);
        let to = (ahead.at - seen.tip).normalize_or(here.direction);
        let wanted = to.reject_from(seen.shaft);
        let side = seen.side.reject_from(seen.shaft);
        // Less than four degrees are no turn, but an offset means to try another way.
        if wanted.length() < 0.07 && self.offset == 0.0 || side.length() < 1e-3 {
            return 0.0;
        }
        let angle = libm::atan2(seen.shaft.dot(side.cross(wanted)), side.dot(wanted)) + self.offset;
        let turns = std::f64::consts::TAU;
        angle - turns * (angle / turns).round()
    }

    /// What it is doing, in words.
    pub fn words(&self) -> &'static str {
        match self.doing {
            Doing::Advancing if self.offset == 0.0 => "Following the route",
            Doing::Advancing => "Trying again, turned",
            Doing::Withdrawing { .. } => "Withdrawing",
        }
    }
}
