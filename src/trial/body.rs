//! A rod in a vessel, from one step to the next.

use std::sync::Arc;

use glam::DVec3;

use super::contact::Contacts;
use super::descent::{Descent, Springs, descend};
use super::report::StepKind;
use super::rod::{Hessian, Rod};
use super::wall::Wall;

/// The part of the radius that the wire may reach into the wall when a step is done.
const DEPTH: f64 = 0.035;
/// The part of the radius that a node may move in a step: its middle then cannot pass the wall unseen.
const STRIDE: f64 = 0.9;
/// The part of its slope by which the potential must fall.
const FALL: f64 = 1e-4;
/// Corrections before the gaps are measured again.
const CORRECTIONS: usize = 8;
/// Times the gaps are measured in a step.
const ROUNDS: usize = 6;
/// Where the next correction would be less than this, in mm, this one is the last. What is left over is a force of
/// [`super::contact`]'s stiffness times it in each contact: it must be small against what a floppy wire presses with, or
/// nothing slides as it should.
const SETTLED: f64 = 3e-6;
/// At this, in mm, a step can still be taken as done.
const ALMOST: f64 = 2e-2;
/// The brake, which is drag of each node when something snaps: the least, in N s/mm.
const BRAKE: f64 = 1e-6;
/// By what it grows when that is too little, and falls when it was enough.
const HARDER: f64 = 4.0;
/// Brakes that are tried in a step.
const ATTEMPTS: usize = 12;
/// The brake above which what is held waits: else it would be torn away from what cannot follow.
const PATIENCE: f64 = 1e-5;
/// Slower than this is stillness, in mm/s.
const STILL: f64 = 2.5;
/// What a contact's force can rise by while the rod is braked, in N/s: the rest is what the brake does.
const BRAKED_RISE: f64 = 2.5;

/// A rod, its contacts, and the wall.
#[derive(Clone, Debug)]
pub struct Body {
    /// The rod.
    pub rod: Rod,
    /// Where it touches.
    pub contacts: Contacts,
    /// How far it reaches into the wall, in mm; negative when it is clear.
    pub depth: f64,
    wall: Option<Arc<Wall>>,
    /// The contacts of the correction under way.
    springs: Springs,
    /// Drag of each node beyond its own in the last step, in N s/mm.
    brake: f64,
    /// Whether nothing moved much in the last step: then waiting has no end, and what is held goes on.
    is_still: bool,
    /// Whether there was no way in the last step.
    is_stuck: bool,
}

impl Body {
    /// A rod of a radius in mm in a vessel, or without one.
    pub fn new(rod: Rod, radius: f64, friction: [f64; 2], wall: Option<Arc<Wall>>) -> Self {
        Self {
            rod,
            contacts: Contacts::new(radius, friction),
            depth: f64::NEG_INFINITY,
            wall,
            springs: Springs::default(),
            brake: 0.0,
            is_still: false,
            is_stuck: false,
        }
    }

    /// The wall.
    pub fn wall(&self) -> Option<&Arc<Wall>> {
        self.wall.as_ref()
    }

    /// Measures the gaps of the first `count` nodes.
    pub fn look(&mut self, count: usize) {
        self.depth = match &self.wall {
            Some(wall) => self.contacts.look(&self.rod, count, wall),
            None => f64::NEG_INFINITY,
        };
    }

    /// A step of `dt` seconds, in which the first `count` nodes can touch the wall. `prepare` puts what is held where it
    /// should be at the end of the step; while something snaps it may have to wait where it is.
    pub fn step(&mut self, dt: f64, count: usize, prepare: impl Fn(&mut Rod)) -> StepKind {
        // What has gone back into the guide touches nothing.
        self.contacts.keep(count);
        self.contacts.begin();
        let kind = self.attempts(dt, count, prepare);
        // There was no way on: in the next step what is held waits.
        self.is_stuck = kind == StepKind::Held && !self.is_stuck;
        kind
    }

    fn attempts(&mut self, dt: f64, count: usize, prepare: impl Fn(&mut Rod)) -> StepKind {
        let mut brake = self.brake / HARDER;
        if brake < BRAKE {
            brake = 0.0;
        }
        for _ in 0..ATTEMPTS {
            let waits = self.is_stuck || brake > PATIENCE && !self.is_still;
            if !waits {
                prepare(&mut self.rod);
            }
            self.rod.refresh();
            if self.try_step(dt, count, brake) {
                let moved = (0..self.rod.len()).map(|i| self.rod.positions[i].distance(self.rod.start(i)));
                self.is_still = moved.fold(0.0, f64::max) < STILL * dt;
                self.contacts.finish(&self.rod, if brake > 0.0 { BRAKED_RISE * dt } else { f64::INFINITY });
                self.rod.finish(dt);
                self.brake = brake;
                return match brake {
                    _ if waits => StepKind::Waited,
                    0.0 => StepKind::Balanced,
                    _ => StepKind::Braked,
                };
            }
            brake = (brake * HARDER).max(BRAKE);
            self.rod.undo();
            self.contacts.undo();
            self.look(count);
        }
        self.brake = 0.0;
        self.contacts.forget();
        StepKind::Held
    }

    fn try_step(&mut self, dt: f64, count: usize, brake: f64) -> bool {
        let radius = self.contacts.radius;
        let stride = if self.wall.is_some() { STRIDE * radius } else { f64::INFINITY };
        let strides: Vec<f64> =
            (0..self.rod.len()).map(|i| stride.max(STRIDE * self.contacts.clearance(&self.rod, i))).collect();
        let is_too_far = |rod: &Rod| {
            // What is held is inside the guide.
            (0..rod.len()).any(|i| !rod.held[i].position && rod.positions[i].distance(rod.start(i)) > strides[i])
        };
        if brake == 0.0 {
            self.predict(dt, count);
        }
        for _ in 0..ROUNDS {
            self.contacts.set_grip();
            let (mut moved, mut potential) = (f64::INFINITY, None);
            for _ in 0..CORRECTIONS {
                let before = moved;
                let is_whole;
                (moved, is_whole) = self.correct(dt, brake, &mut potential);
                if !moved.is_finite() || is_too_far(&self.rod) {
                    return false;
                }
                // The one after a whole one would be shorter by as much again, at least.
                let shorter = if is_whole && before.is_finite() { (moved / before).min(1.0) } else { 1.0 };
                if moved * shorter < SETTLED {
                    break;
                }
            }
            self.contacts.balance(&self.rod);
            self.look(count);
            if moved < ALMOST && self.depth <= DEPTH * radius {
                return true;
            }
            if moved < ALMOST {
                // It rests too deep: the forces that it needs are more than the corrections may find at once.
                self.contacts.raise();
            }
        }
        false
    }

    /// Begins where the rod would be if it went on as in the step before, if that is nearer to the step's end.
    fn predict(&mut self, dt: f64, count: usize) {
        let before = self.potential(dt, 0.0);
        self.rod.predict(dt);
        if self.potential(dt, 0.0) < before {
            self.look(count);
        } else {
            self.rod.predict(0.0);
        }
    }

    /// What a step makes least, in N mm.
    fn potential(&self, dt: f64, brake: f64) -> f64 {
        self.rod.potential(dt, brake) + self.contacts.potential(&self.rod)
    }

    /// One step of Newton's method with contacts in it, made shorter until the potential falls. `potential` is what it is
    /// now, if that is known. Returns the largest move of a node in mm, and whether the step was all that it should be.
    fn correct(&mut self, dt: f64, brake: f64, potential: &mut Option<f64>) -> (f64, bool) {
        let before = potential.unwrap_or_else(|| self.potential(dt, brake));
        let mut hessian = Hessian::Exact;
        let Descent { moved, fall, is_settled } = loop {
            self.rod.assemble(dt, brake, hessian);
            self.contacts.along(&self.rod, &mut self.springs);
            match descend(&mut self.rod, &mut self.springs, hessian) {
                Some(found) => break found,
                None => hessian = hessian.safer(),
            }
        };
        if !moved.is_finite() {
            return (moved, false);
        }
        let mut part = 1.0;
        loop {
            self.rod.advance(part);
            let after = self.potential(dt, brake);
            // What rounding leaves of the potential is no reason to stop.
            if moved * part < SETTLED || after <= before + FALL * part * fall + 1e-12 * before.abs() {
                *potential = Some(after);
                return (moved * part, is_settled && part == 1.0);
            }
            part /= 4.0;
        }
    }

    /// Sum over the wall of normal forces, in N, and the largest.
    pub fn pressure(&self) -> (f64, f64) {
        self.touches().fold((0.0, 0.0), |(sum, most), (_, _, _, force)| (sum + force, force.max(most)))
    }

    /// Where the wire touches the vessel: node, place, triangle, force. The fans over its open ends hold the wire, but are
    /// no wall.
    pub fn touches(&self) -> impl Iterator<Item = (usize, DVec3, u32, f64)> {
        let is_vessel = |triangle| self.wall.as_ref().is_none_or(|wall| wall.is_vessel(triangle));
        self.contacts
            .pressing()
            .filter(move |(_, contact)| is_vessel(contact.triangle))
            .map(|(node, contact)| (node, contact.point, contact.triangle, contact.force))
    }
}
