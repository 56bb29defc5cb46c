//! What two places of a rod do to each other where its surface touches itself: the augmented Lagrangian of a contact with the
//! wall (`law`), with the gap between both, and without friction.
//!
//! The force is a derivative of one energy by both places, so what the one feels the other feels the other way.

use glam::DVec3;

use super::super::law::PENALTY;
use super::super::spring::spread;
use super::link::Link;
use crate::rod::{Rod, Section};

/// A place of a rod: the edge, and where on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub(super) edge: usize,
    pub(super) along: f64,
}

impl Place {
    /// Where it is now.
    #[inline]
    pub(super) fn at(&self, rod: &Rod) -> DVec3 {
        rod.positions[self.edge].lerp(rod.positions[self.edge + 1], self.along)
    }

    /// Its number from the tip, in edges.
    #[inline]
    pub(super) fn number(&self) -> f64 {
        self.edge as f64 + self.along
    }
}

/// Two places of a rod that touch, or nearly do.
#[derive(Clone, Copy, Debug)]
pub struct Pair {
    pub(super) places: [Place; 2],
    /// From the second place to the first, of length 1.
    pub normal: DVec3,
    /// Distance of the surfaces in mm, and the way from the second place to the first, when they were measured.
    pub gap: f64,
    pub(super) way: DVec3,
    penalty: f64,
    /// The multiplier: the force in N at the end of the last step, or what `Self::update_multiplier` has made of it.
    pub multiplier: f64,
    /// The same, at the beginning of the step.
    first: f64,
    /// The force that the corrections have come to.
    found: f64,
    /// Whether it goes on from one of the detection before.
    pub(super) is_known: bool,
}

impl Pair {
    /// Two places with this normal and gap, without a force.
    pub(super) fn new(rod: &Rod, places: [Place; 2], normal: DVec3, gap: f64) -> Self {
        let penalty = places.iter().map(|place| {
            let Section { length, ei, .. } = rod.sections[place.edge];
            ei / (length * length * length)
        });
        Self {
            places,
            normal,
            gap,
            way: places[0].at(rod) - places[1].at(rod),
            penalty: penalty.fold(PENALTY, f64::max),
            multiplier: 0.0,
            first: 0.0,
            found: 0.0,
            is_known: false,
        }
    }

    /// Goes on with the force of one of the detection before.
    pub(super) fn goes_on_from(&mut self, other: &Self) {
        self.is_known = true;
        (self.multiplier, self.first, self.found) = (other.multiplier, other.first, other.found);
    }

    /// The gap as the rod is now.
    #[inline]
    fn gap_now(&self, rod: &Rod) -> f64 {
        let way = self.places[0].at(rod) - self.places[1].at(rod);
        self.gap + self.normal.dot(way - self.way)
    }

    #[inline]
    fn pressure(&self, rod: &Rod, stiffer: f64) -> f64 {
        self.multiplier - stiffer * self.penalty * self.gap_now(rod)
    }

    /// Its energy in N mm.
    #[inline]
    pub(in crate::contact) fn potential(&self, rod: &Rod, stiffer: f64) -> f64 {
        let force = self.pressure(rod, stiffer).max(0.0);
        0.5 * force * force / (stiffer * self.penalty)
    }

    /// The pair along a straight change of the rod from where it is now.
    pub(in crate::contact) fn link(&self, rod: &Rod, stiffer: f64) -> Link {
        let [a, b] = self.places;
        let pulls = [(a.edge, spread(self.normal, 0.0, a.along)), (b.edge, spread(-self.normal, 0.0, b.along))];
        Link::new(pulls, self.pressure(rod, stiffer), stiffer * self.penalty)
    }

    /// What it does to a node in N.
    pub(in crate::contact) fn forces(&self) -> [(usize, DVec3); 4] {
        let force = self.normal * self.multiplier;
        let [a, b] = self.places;
        [
            (a.edge, force * (1.0 - a.along)),
            (a.edge + 1, force * a.along),
            (b.edge, -force * (1.0 - b.along)),
            (b.edge + 1, -force * b.along),
        ]
    }

    /// Begins a step.
    pub(in crate::contact) fn begin(&mut self) {
        (self.first, self.found) = (self.multiplier, self.multiplier);
    }

    /// Notes the force that the corrections have come to.
    pub(in crate::contact) fn note_force(&mut self, rod: &Rod, stiffer: f64) {
        self.found = self.pressure(rod, stiffer).max(0.0);
    }

    /// Makes the force that the corrections have come to the multiplier of those that follow.
    pub(in crate::contact) fn update_multiplier(&mut self) {
        self.multiplier = self.found;
    }

    /// Goes back to the multiplier at the beginning of the step.
    pub(in crate::contact) fn undo(&mut self) {
        (self.multiplier, self.found) = (self.first, self.first);
    }

    /// Lets go of all force.
    pub(in crate::contact) fn forget(&mut self) {
        self.multiplier = 0.0;
    }

    /// Ends a step: the multiplier is now that of the next step's start, no more than `rise` N above what it was.
    pub(in crate::contact) fn finish(&mut self, rise: f64) {
        self.multiplier = self.found.min(self.first + rise);
    }
}
