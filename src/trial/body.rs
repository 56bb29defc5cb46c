//! A rod in a vessel, from one step to the next.

use std::sync::Arc;

use glam::DVec3;

use super::contact::Contacts;
use super::rod::Rod;
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
/// A correction of less than this, in mm, is the last. What is left over is a force of [`super::contact`]'s stiffness
/// times it in each contact: it must be small against what a floppy wire presses with, or nothing slides as it should.
const SETTLED: f64 = 1e-5;
/// At this, in mm, a step can still be taken as done.
const ALMOST: f64 = 2e-2;
/// The least drag of each node when something snaps, in N s/mm.
const BRAKE: f64 = 1e-6;
/// By what it grows when that is too little, and falls when it was enough.
const HARDER: f64 = 4.0;
/// Times it may grow in a step.
const ATTEMPTS: usize = 9;

/// What came of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stepped {
    /// All is well.
    Done,
    /// The rod had to be braked: something snapped.
    Braked,
    /// There was no way: the rod is where it was.
    Held,
}

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
    /// Drag of each node beyond its own in the last step, in N s/mm.
    brake: f64,
}

impl Body {
    /// A rod of a radius in mm in a vessel, or without one.
    pub fn new(rod: Rod, radius: f64, friction: [f64; 2], wall: Option<Arc<Wall>>) -> Self {
        Self { rod, contacts: Contacts::new(radius, friction), depth: f64::NEG_INFINITY, wall, brake: 0.0 }
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
    /// should be at the end of the step.
    pub fn step(&mut self, dt: f64, count: usize, prepare: impl Fn(&mut Rod)) -> Stepped {
        let mut brake = self.brake / HARDER;
        if brake < BRAKE {
            brake = 0.0;
        }
        for _ in 0..ATTEMPTS {
            prepare(&mut self.rod);
            self.rod.refresh();
            if self.try_step(dt, count, brake) {
                self.contacts.finish(&self.rod);
                self.rod.finish(dt);
                self.brake = brake;
                return if brake > 0.0 { Stepped::Braked } else { Stepped::Done };
            }
            brake = (brake * HARDER).max(BRAKE);
            self.rod.undo();
            self.look(count);
        }
        self.brake = 0.0;
        Stepped::Held
    }

    fn try_step(&mut self, dt: f64, count: usize, brake: f64) -> bool {
        let radius = self.contacts.radius;
        let stride = if self.wall.is_some() { STRIDE * radius } else { f64::INFINITY };
        let strides: Vec<f64> =
            (0..self.rod.len()).map(|i| stride.max(STRIDE * self.contacts.clearance(&self.rod, i))).collect();
        let is_too_far = |rod: &Rod| (0..rod.len()).any(|i| rod.positions[i].distance(rod.start(i)) > strides[i]);
        for _ in 0..ROUNDS {
            self.contacts.set_grip(&self.rod);
            let (mut moved, mut potential) = (f64::INFINITY, None);
            for _ in 0..CORRECTIONS {
                moved = self.correct(dt, brake, &mut potential);
                if moved < SETTLED {
                    break;
                }
            }
            if !moved.is_finite() || is_too_far(&self.rod) {
                return false;
            }
            self.contacts.balance(&self.rod);
            self.look(count);
            if moved < ALMOST && self.depth <= DEPTH * radius {
                return true;
            }
        }
        false
    }

    /// One step of Newton's method, made shorter until the potential falls. `known` is the potential before, if it is
    /// known, and then that after. Returns the largest move of a node in mm.
    fn correct(&mut self, dt: f64, brake: f64, known: &mut Option<f64>) -> f64 {
        let potential = |body: &Self| body.rod.potential(dt, brake) + body.contacts.potential(&body.rod);
        self.rod.assemble(dt, brake);
        self.contacts.apply(&mut self.rod);
        let before = known.unwrap_or_else(|| potential(self));
        let (moved, slope) = self.rod.solve();
        if !moved.is_finite() {
            return moved;
        }
        let mut part = 1.0;
        loop {
            self.rod.advance(part);
            let after = potential(self);
            // What rounding leaves of the potential is no reason to stop.
            if moved * part < SETTLED || after <= before + FALL * part * slope + 1e-12 * before.abs() {
                *known = Some(after);
                return moved * part;
            }
            part /= 2.0;
        }
    }

    /// Sum over the wall of normal forces, in N, and the largest.
    pub fn pressure(&self) -> (f64, f64) {
        self.contacts
            .pressing()
            .fold((0.0, 0.0), |(sum, most), (_, contact)| (sum + contact.force, contact.force.max(most)))
    }

    /// Where the wire touches: node, place, force.
    pub fn touches(&self) -> impl Iterator<Item = (usize, DVec3, u32, f64)> {
        self.contacts.pressing().map(|(node, contact)| (node, contact.point, contact.triangle, contact.force))
    }
}
