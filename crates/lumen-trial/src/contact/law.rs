//! What a contact does to the rod, by its gap and its slip.
//!
//! Its normal force is found with the step itself, as an augmented Lagrangian (Hestenes 1969; Powell 1969) with a
//! multiplier for each contact:
//!
//! ```text
//! N = max(0, multiplier - penalty gap)
//! ```
//!
//! and what a step comes to is the multiplier of the next, so that what lies still against the wall lies at a gap of 0,
//! however hard it is pressed. The force acts the way the gap grows: a force along an interpolated normal would do work
//! as the wire slides over a facet, and never settle.
//!
//! The wall of a lumen comes round the wire, with a curvature k where the wire's middle goes. To a wire that moves across
//! itself by u from where the gap was measured, that is an energy of `N k u^2 / 2`: within a step a plane would give a
//! pushed wire no hold to the side, and it would be on another plane after each.
//!
//! Friction is a spring across the normal that begins where the contact last stuck and gives no more than Coulomb's
//! limit, `mu N`: the slip since then is brought back to what that limit can hold (return mapping, as in plasticity: Simo
//! and Laursen 1992). The roll of the wire's surface is part of the slip, so that turning and pushing share one cone.

use glam::DVec3;

use crate::rod::Rod;

/// The least penalty of a contact in N/mm: how much its force changes before the next step corrects the gap. An element
/// of a wire gives way across itself by about `EI / length^3`, and that is the penalty where it is more, so that stiff
/// wires settle as floppy ones do. The farther above what the wire gives way by it is, the more search directions a
/// correction takes, and what is left unsettled is felt as force (`tests/validation/balance.rs`).
pub(super) const PENALTY: f64 = 4.0;
/// The penalty of slip where a contact sticks, in N/mm.
pub(super) const SLIP_PENALTY: f64 = 4.0;

/// A place where the rod touches, or nearly does: what detection found there, and the state of the law.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Whether it takes part in the step.
    pub(super) is_near: bool,
    /// The leaf of the index that it is with.
    pub(super) slot: u32,
    /// Where on the edge that begins at its node: 0 at the node.
    pub(super) along: f64,
    /// The nearest point of the wall, in mm.
    pub point: DVec3,
    /// Its triangle.
    pub triangle: u32,
    /// From the wall to the rod, of length 1.
    pub normal: DVec3,
    /// The interpolated normal of the wall: friction acts at right angles to it, so that facets do not change it.
    pub(super) smooth: DVec3,
    /// Distance from the flat triangles less the rod's radius, in mm, when it was measured.
    pub(super) gap: f64,
    /// The penalty in N/mm.
    pub(super) penalty: f64,
    /// Where the rod was then.
    pub(super) at: DVec3,
    /// Along the wall at right angles to the rod, and the curvature of the wall there in 1/mm.
    pub(super) across: DVec3,
    pub(super) curvature: f64,
    /// What the wall's curvature holds the rod with as it moves across itself, in N/mm.
    pub(super) hold: f64,
    /// The multiplier: the normal force in N at the end of the last step, or what `Self::update_multiplier` has made of it
    /// in this one.
    pub multiplier: f64,
    /// The same, at the beginning of the step.
    first: f64,
    /// The normal force that the corrections have come to, from the gap as it was measured before them; before the first,
    /// that of the step's beginning.
    pub(super) found: f64,
    /// The elastic part of its slip, in mm: how far the spring that friction is while it sticks is stretched.
    slip: DVec3,
    /// What friction does to the rod, in N.
    pub friction: DVec3,
    /// Whether it slides.
    pub is_sliding: bool,
    /// Coulomb's limit in the step: what friction can give, in N.
    pub(super) limit: f64,
}

impl Contact {
    pub(super) const NONE: Self = Self {
        is_near: false,
        slot: u32::MAX,
        along: 0.0,
        point: DVec3::ZERO,
        triangle: 0,
        normal: DVec3::Z,
        smooth: DVec3::Z,
        gap: 0.0,
        penalty: PENALTY,
        at: DVec3::ZERO,
        across: DVec3::ZERO,
        curvature: 0.0,
        hold: 0.0,
        multiplier: 0.0,
        first: 0.0,
        found: 0.0,
        slip: DVec3::ZERO,
        friction: DVec3::ZERO,
        is_sliding: false,
        limit: 0.0,
    };

    /// What the wall does to the rod there, in N.
    #[inline]
    pub(super) fn force(&self) -> DVec3 {
        self.normal * self.multiplier + self.friction
    }

    /// Where the contact is on the rod now.
    #[inline]
    fn place(&self, rod: &Rod, node: usize) -> DVec3 {
        let a = rod.positions[node];
        if self.along > 0.0 { a.lerp(rod.positions[node + 1], self.along) } else { a }
    }

    /// The gap as the rod is now, if the wall is flat there.
    #[inline]
    pub(super) fn gap_now(&self, rod: &Rod, node: usize) -> f64 {
        self.gap + self.normal.dot(self.place(rod, node) - self.at)
    }

    /// How far it has moved across itself since the gap was measured.
    #[inline]
    pub(super) fn moved_across(&self, rod: &Rod, node: usize) -> f64 {
        self.across.dot(self.place(rod, node) - self.at)
    }

    /// The normal force in the step, as the rod is now.
    #[inline]
    fn pressure(&self, rod: &Rod, node: usize, stiffer: f64) -> f64 {
        (self.multiplier - stiffer * self.penalty * self.gap_now(rod, node)).max(0.0)
    }

    /// The slip as it would be now if the contact stuck, and the direction in which the wire's surface goes when it
    /// rolls.
    #[inline]
    pub(super) fn trial_slip(&self, rod: &Rod, node: usize, radius: f64) -> (DVec3, DVec3) {
        let edge = node.min(rod.len() - 2);
        let mut start = rod.start(node);
        if self.along > 0.0 {
            start = start.lerp(rod.start(node + 1), self.along);
        }
        let roll = rod.tangent(edge).cross(self.smooth) * -radius;
        let moved = self.place(rod, node) - start + roll * rod.spin(edge);
        ((self.slip + moved).reject_from_normalized(self.smooth), roll)
    }

    /// The energy of the contact, in N mm: what the normal force and friction are the derivatives of.
    #[inline]
    pub(super) fn potential(&self, rod: &Rod, node: usize, radius: f64, stiffer: f64) -> f64 {
        let (force, across) = (self.pressure(rod, node, stiffer), self.moved_across(rod, node));
        let pressed = 0.5 * (force * force / (stiffer * self.penalty) + self.hold * across * across);
        if self.limit <= 0.0 {
            return pressed;
        }
        let length = self.trial_slip(rod, node, radius).0.length();
        let most = self.limit / SLIP_PENALTY;
        pressed + if length > most { self.limit * (length - 0.5 * most) } else { 0.5 * SLIP_PENALTY * length * length }
    }

    /// Begins a step.
    pub(super) fn begin(&mut self) {
        (self.first, self.found) = (self.multiplier, self.multiplier);
    }

    /// Sets Coulomb's limit in the corrections that follow: by the force that those before have come to, as that where
    /// the rod is now may be far from balanced.
    #[inline]
    pub(super) fn set_limit(&mut self, friction: [f64; 2]) {
        self.limit = friction[usize::from(self.is_sliding)] * self.found;
        self.hold = self.curvature * self.found;
    }

    /// Notes the force that the corrections have come to.
    #[inline]
    pub(super) fn note_force(&mut self, rod: &Rod, node: usize, stiffer: f64) {
        self.found = self.pressure(rod, node, stiffer);
    }

    /// Makes the force that the corrections have come to the multiplier of those that follow.
    pub(super) fn update_multiplier(&mut self) {
        self.multiplier = self.found;
    }

    /// Goes back to the multiplier at the beginning of the step.
    pub(super) fn undo(&mut self) {
        (self.multiplier, self.found) = (self.first, self.first);
    }

    /// Lets go of all force: the next step finds it anew.
    pub(super) fn forget(&mut self) {
        (self.multiplier, self.slip, self.friction) = (0.0, DVec3::ZERO, DVec3::ZERO);
    }

    /// Takes on what another contact holds.
    pub(super) fn join(&mut self, other: &Self) {
        self.multiplier += other.multiplier;
        self.first += other.first;
        self.found += other.found;
        self.slip += other.slip;
        self.friction += other.friction;
        self.limit += other.limit;
        self.hold += other.hold;
        self.is_sliding |= other.is_sliding;
    }

    /// Ends a step: the multiplier is now that of the next step's start, no more than `rise` N above what it was, and the
    /// slip is brought back to Coulomb's limit.
    pub(super) fn finish(&mut self, rod: &Rod, node: usize, radius: f64, friction: [f64; 2], rise: f64) {
        let force = self.found.min(self.first + rise);
        if force <= 0.0 {
            self.multiplier = 0.0;
            self.slip = DVec3::ZERO;
            self.friction = DVec3::ZERO;
            self.is_sliding = false;
            return;
        }
        let (trial, _) = self.trial_slip(rod, node, radius);
        let most = friction[usize::from(self.is_sliding)] * force / SLIP_PENALTY;
        let length = trial.length();
        self.is_sliding = length > most;
        self.slip = if length > most { trial * (most / length) } else { trial };
        self.friction = self.slip * -SLIP_PENALTY;
        self.multiplier = force;
    }
}
