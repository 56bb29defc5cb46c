//! A rod in a vessel, from one step to the next.

use std::sync::Arc;

use glam::DVec3;

use super::contact::{Contacts, Springs};
use super::descent::{Descent, descend};
use super::report::StepKind;
use super::rod::{Hessian, Rod};
use super::wall::Wall;

/// The part of the radius that the wire may reach into the wall when a step is done, and of the diameter into itself.
const DEPTH: f64 = 0.035;
/// The part of the radius that a node may move in a step: its middle then cannot pass the wall unseen.
const STRIDE: f64 = 0.9;
/// The part of its slope by which the potential must fall in a line search (Armijo).
const FALL: f64 = 1e-4;
/// Corrections before the gaps are measured again.
const CORRECTIONS: usize = 8;
/// Times the gaps are measured in a step.
const ROUNDS: usize = 6;
/// Where the next correction would be less than this, in mm, this one is the last. What is left over is a force of
/// a contact's penalty times it in each contact: it must be small against what a floppy wire presses with, or
/// nothing slides as it should.
const CONVERGED_CORRECTION: f64 = 3e-6;
/// At this, in mm, a step can still be taken as done.
const ACCEPTED_CORRECTION: f64 = 2e-2;
/// Artificial damping, which is drag of each node when something snaps: the least, in N s/mm.
const DAMPING: f64 = 1e-6;
/// By what it grows when that is too little, and falls when it was enough.
const DAMPING_GROWTH: f64 = 4.0;
/// Dampings that are tried in a step.
const ATTEMPTS: usize = 12;
/// The damping above which what is fixed waits: else it would be torn away from what cannot follow.
const PATIENCE: f64 = 1e-5;
/// Slower than this is stillness, in mm/s.
const STILL: f64 = 2.5;
/// What a contact's force can rise by while the rod is damped, in N/s: the rest is what the damping does.
const DAMPED_RISE: f64 = 2.5;

/// A rod, its contacts, and the wall.
#[derive(Clone, Debug)]
pub struct Body {
    /// The rod.
    pub rod: Rod,
    /// Where it touches.
    pub contacts: Contacts,
    /// How far it reaches into the wall, in mm; negative when it is clear.
    pub depth: f64,
    /// How far it reaches into itself, in mm; negative when it does not.
    pub overlap: f64,
    wall: Option<Arc<Wall>>,
    /// The contacts of the correction under way.
    springs: Springs,
    /// Artificial damping in the last step, in N s/mm.
    damping: f64,
    /// Whether nothing moved much in the last step: then waiting has no end, and what is fixed goes on.
    is_still: bool,
    /// Whether there was no way in the last step: in the next what is fixed waits.
    is_stuck: bool,
    /// Whether all forces were let go of since: friction is then found in a second round only.
    has_let_go: bool,
}

impl Body {
    /// A rod of a radius in mm in a vessel, or without one.
    pub fn new(rod: Rod, radius: f64, friction: [f64; 2], wall: Option<Arc<Wall>>) -> Self {
        Self {
            rod,
            contacts: Contacts::new(radius, friction),
            depth: f64::NEG_INFINITY,
            overlap: f64::NEG_INFINITY,
            wall,
            springs: Springs::default(),
            damping: 0.0,
            is_still: false,
            is_stuck: false,
            has_let_go: false,
        }
    }

    /// The wall.
    pub fn wall(&self) -> Option<&Arc<Wall>> {
        self.wall.as_ref()
    }

    /// Measures the gaps of the first `count` nodes.
    pub fn detect(&mut self, count: usize) {
        self.depth = match &self.wall {
            Some(wall) => self.contacts.detect(&self.rod, count, wall),
            None => f64::NEG_INFINITY,
        };
        self.overlap = self.contacts.detect_self(&self.rod, count);
    }

    /// A step of `dt` seconds, in which the first `count` nodes can touch the wall. `prepare` puts what is fixed where it
    /// should be at the end of the step; while something snaps it may have to wait where it is.
    pub fn step(&mut self, dt: f64, count: usize, prepare: impl Fn(&mut Rod)) -> StepKind {
        // What has gone back into the guide touches nothing.
        self.contacts.keep(count);
        self.contacts.begin();
        let kind = self.attempts(dt, count, prepare);
        self.is_stuck = kind == StepKind::Held && !self.is_stuck;
        kind
    }

    fn attempts(&mut self, dt: f64, count: usize, prepare: impl Fn(&mut Rod)) -> StepKind {
        let mut damping = self.damping / DAMPING_GROWTH;
        if damping < DAMPING {
            damping = 0.0;
        }
        for _ in 0..ATTEMPTS {
            let waits = self.is_stuck || damping > PATIENCE && !self.is_still;
            if !waits {
                prepare(&mut self.rod);
            }
            self.rod.refresh();
            if self.try_step(dt, count, damping) {
                let moved = (0..self.rod.len()).map(|i| self.rod.positions[i].distance(self.rod.start(i)));
                self.is_still = moved.fold(0.0, f64::max) < STILL * dt;
                self.contacts.finish(&self.rod, if damping > 0.0 { DAMPED_RISE * dt } else { f64::INFINITY });
                self.rod.finish(dt);
                self.damping = damping;
                self.has_let_go = false;
                return match damping {
                    _ if waits => StepKind::Waited,
                    0.0 => StepKind::Balanced,
                    _ => StepKind::Braked,
                };
            }
            damping = (damping * DAMPING_GROWTH).max(DAMPING);
            self.rod.undo();
            self.contacts.undo();
            self.detect(count);
        }
        self.damping = 0.0;
        if self.is_stuck {
            // Not even waiting helps: what forces and friction have wound up comes loose.
            self.contacts.forget();
            self.has_let_go = true;
        }
        StepKind::Held
    }

    fn try_step(&mut self, dt: f64, count: usize, damping: f64) -> bool {
        let radius = self.contacts.radius;
        let room = |i: usize| {
            let wall = if self.wall.is_some() { self.contacts.clearance(&self.rod, i) } else { f64::INFINITY };
            // Two pieces of the rod may come towards each other.
            wall.min(0.5 * self.contacts.room(i))
        };
        let strides: Vec<f64> = (0..self.rod.len()).map(|i| STRIDE * room(i).max(radius)).collect();
        let is_too_far = |rod: &Rod| {
            // What is fixed is inside the guide.
            (0..rod.len()).any(|i| !rod.fixed[i].position && rod.positions[i].distance(rod.start(i)) > strides[i])
        };
        if damping == 0.0 {
            self.predict(dt, count);
        }
        for round in 0..ROUNDS {
            self.contacts.set_limits();
            let (mut moved, mut potential) = (f64::INFINITY, None);
            for _ in 0..CORRECTIONS {
                let before = moved;
                let is_whole;
                (moved, is_whole) = self.correct(dt, damping, &mut potential);
                if !moved.is_finite() || is_too_far(&self.rod) {
                    return false;
                }
                // The one after a whole one would be shorter by as much again, at least.
                let shorter = if is_whole && before.is_finite() { (moved / before).min(1.0) } else { 1.0 };
                if moved * shorter < CONVERGED_CORRECTION {
                    break;
                }
            }
            self.contacts.note_forces(&self.rod);
            self.detect(count);
            let is_deep = self.depth > DEPTH * radius || self.overlap > DEPTH * 2.0 * radius;
            if moved < ACCEPTED_CORRECTION && !is_deep && (round > 0 || !self.has_let_go) {
                return true;
            }
            if moved < ACCEPTED_CORRECTION && is_deep {
                // It rests too deep: the forces that it needs are more than the corrections may find at once.
                self.contacts.update_multipliers();
            }
        }
        false
    }

    /// Begins where the rod would be if it went on as in the step before, if that is nearer to the step's end.
    fn predict(&mut self, dt: f64, count: usize) {
        let before = self.potential(dt, 0.0);
        self.rod.predict(dt);
        if self.potential(dt, 0.0) < before {
            self.detect(count);
        } else {
            self.rod.predict(0.0);
        }
    }

    /// What a step makes least, in N mm.
    fn potential(&self, dt: f64, damping: f64) -> f64 {
        self.rod.potential(dt, damping) + self.contacts.potential(&self.rod)
    }

    /// One step of Newton's method with contacts in it, made shorter until the potential falls (a backtracking line search).
    /// `potential` is what it is now, if that is known. Returns the largest move of a node in mm, and whether the step was all that it should be.
    fn correct(&mut self, dt: f64, damping: f64, potential: &mut Option<f64>) -> (f64, bool) {
        let before = potential.unwrap_or_else(|| self.potential(dt, damping));
        let mut hessian = Hessian::Exact;
        let Descent { moved, fall, is_settled } = loop {
            self.rod.assemble(dt, damping, hessian);
            self.contacts.linearise(&self.rod, &mut self.springs);
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
            let after = self.potential(dt, damping);
            // What rounding leaves of the potential is no reason to stop.
            if moved * part < CONVERGED_CORRECTION || after <= before + FALL * part * fall + 1e-12 * before.abs() {
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
            .map(|(node, contact)| (node, contact.point, contact.triangle, contact.multiplier))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rod::{Fixed, Section};
    use lumen_mesh::{TriMesh, Vec3};

    const DT: f64 = 0.002;
    const RADIUS: f64 = 0.178;

    /// A box of 40 x 4 x 4 mm around the origin, to be touched from inside.
    fn room() -> Arc<Wall> {
        let at = |i: u32| {
            let side = |bit: u32, half: f32| if i & bit > 0 { half } else { -half };
            Vec3::new(side(1, 20.0), side(2, 2.0), side(4, 2.0))
        };
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Arc::new(Wall::new(Arc::new(TriMesh { positions: (0..8).map(at).collect(), triangles })))
    }

    /// A piece of wire along x, 12 nodes from -11 mm on, at this height.
    fn piece(y: f64) -> Rod {
        let section =
            Section { length: 2.0, cell: 2.0, ei: 40.0, gj: 30.0, ea: 2000.0, mass: 1e-9, drag: 1e-7, rest: [0.0; 2] };
        Rod::new((0..12).map(|i| DVec3::new(2.0 * f64::from(i) - 11.0, y, 0.0)).collect(), vec![section; 12], DVec3::Y)
    }

    #[test]
    fn nothing_goes_through_a_wall_however_hard_it_is_thrown() {
        for force in [1e-4, 1e-3, 0.1] {
            let mut rod = piece(0.0);
            // Without a wall a step would take it 0.4 to 400 mm to the side. The last node touches nothing.
            rod.forces.extend((0..11).map(|i| (i, DVec3::new(0.0, -1.0, 0.3) * force)));
            let mut body = Body::new(rod, RADIUS, [0.06, 0.04], Some(room()));
            body.detect(11);
            let mut went = 0.0_f64;
            for step in 0..150 {
                let kind = body.step(DT, 11, |_| ());
                for (i, p) in body.rod.positions[..11].iter().enumerate() {
                    let is_inside = p.y.abs() < 2.0 && p.z.abs() < 2.0 && p.x.abs() < 20.0;
                    assert!(is_inside, "node {i} at {p} after step {step}, {kind:?}, thrown by {force} N");
                }
                went = went.max(-body.rod.positions[5].y);
            }
            // It comes to the wall, and is stopped there.
            assert!(went > 1.7, "{went} mm by {force} N");
        }
    }

    #[test]
    fn what_sticks_goes_on_sticking_after_a_step_without_a_way() {
        // 0.5 N on the floor, and four fifths of what friction can hold along it.
        let (weight, pull) = (0.5, 0.8 * 0.06 * 0.5);
        let mut rod = piece(-2.0 + RADIUS);
        rod.fixed[0] = Fixed { position: false, angle: true };
        rod.forces.extend((0..11).map(|i| (i, DVec3::new(pull, -weight, 0.0) / 11.0)));
        let mut body = Body::new(rod, RADIUS, [0.06, 0.04], Some(room()));
        body.detect(11);
        // The pull comes once it lies.
        let pulled =
            std::mem::replace(&mut body.rod.forces, (0..11).map(|i| (i, DVec3::NEG_Y * weight / 11.0)).collect());
        (0..50).for_each(|_| assert_ne!(body.step(DT, 11, |_| ()), StepKind::Held));
        body.rod.forces = pulled;
        (0..200).for_each(|_| assert_ne!(body.step(DT, 11, |_| ()), StepKind::Held));
        for times in 1..=3 {
            let there = body.rod.positions[5];
            for time in 0..times {
                let kind = body.step(DT, 11, |rod| rod.turn_to(0, f64::NAN));
                // No number has no way; after it what is fixed waits once.
                assert_eq!(kind == StepKind::Held, time % 2 == 0, "{kind:?}");
            }
            (0..20).for_each(|_| assert_ne!(body.step(DT, 11, |_| ()), StepKind::Held));
            let slid = body.rod.positions[5].distance(there);
            assert!(slid < 1e-3, "{slid} mm after {times} steps without a way");
        }
    }
}
