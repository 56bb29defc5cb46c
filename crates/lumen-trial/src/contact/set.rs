//! All contacts of a rod, from the beginning of a step to its end.

use glam::DVec3;

use super::detection::Manifold;
use super::law::Contact;
use super::self_contact::{Pair, SelfContacts};
use super::spring::{Open, Spring, Springs, spread};
use crate::rod::Rod;
use crate::wall::Wall;

/// By what the penalty grows where multipliers are updated within a step.
const STIFFER: f64 = 4.0;

/// The contacts of a rod.
#[derive(Clone, Debug)]
pub struct Contacts {
    manifold: Manifold,
    /// Where it touches itself.
    own: SelfContacts,
    /// Radius of the rod in mm.
    pub radius: f64,
    /// Coefficients of friction, sticking and sliding.
    pub friction: [f64; 2],
    /// How many times its own the penalty of each contact is in the corrections that follow.
    stiffer: f64,
}

impl Contacts {
    /// None yet, for a rod of this radius in mm and these coefficients of friction.
    pub fn new(radius: f64, friction: [f64; 2]) -> Self {
        Self { manifold: Manifold::default(), own: SelfContacts::new(), radius, friction, stiffer: 1.0 }
    }

    /// Measures the gaps of the first `count` nodes, the last one excepted, and of the edges between them. Returns how far
    /// the rod reaches into the wall, in mm; less than 0 where it is clear of it by more.
    pub fn detect(&mut self, rod: &Rod, count: usize, wall: &Wall) -> f64 {
        self.manifold.detect(rod, count, wall, self.radius)
    }

    /// Lets go of the contacts of all but the first `count` nodes and the edges between them.
    pub fn keep(&mut self, count: usize) {
        self.manifold.keep(count);
        self.own.keep(count);
    }

    /// Measures the gaps between pieces of the rod, for the first `count` nodes and the edges behind them. Returns how far
    /// the rod reaches into itself, in mm; less than 0 where it does not.
    pub fn detect_self(&mut self, rod: &Rod, count: usize) -> f64 {
        self.own.detect(rod, count, self.radius)
    }

    /// How far a node and the edges beside it are from other pieces of the rod at least, in mm.
    pub fn room(&self, node: usize) -> f64 {
        self.own.room(node)
    }

    /// Where the rod touches itself, or nearly does.
    pub fn pairs(&self) -> &[Pair] {
        &self.own.pairs
    }

    /// What the rod's pieces do to each other, in N, summed over its first `count` nodes: nothing, but for what the others
    /// bear.
    pub fn total_of_pairs(&self, count: usize) -> DVec3 {
        let forces = self.own.pairs.iter().flat_map(Pair::forces);
        forces.filter(|&(node, _)| node < count).map(|(_, force)| force).sum()
    }

    /// How far the wall is at least from a node and the edges beside it, in mm; 0 where that is not known.
    pub fn clearance(&self, rod: &Rod, node: usize) -> f64 {
        self.manifold.clearance(rod, node)
    }

    /// Every contact that takes part in the step, with the node at which its edge begins.
    pub fn near(&self) -> impl Iterator<Item = (usize, &Contact)> {
        self.manifold.near()
    }

    /// The contacts that press, each with its node.
    pub fn pressing(&self) -> impl Iterator<Item = (usize, &Contact)> {
        self.near().filter(|(_, contact)| contact.multiplier > 0.0)
    }

    /// Begins a step.
    pub fn begin(&mut self) {
        self.stiffer = 1.0;
        self.manifold.each(|_, contact| contact.begin());
        self.own.begin();
    }

    /// Sets what friction can give in the corrections that follow: Coulomb's limit.
    pub fn set_limits(&mut self) {
        let friction = self.friction;
        self.manifold.each(|_, contact| contact.set_limit(friction));
    }

    /// The energy of all contacts, in N mm.
    pub fn potential(&self, rod: &Rod) -> f64 {
        let of_wall: f64 =
            self.near().map(|(node, contact)| contact.potential(rod, node, self.radius, self.stiffer)).sum();
        of_wall + self.pairs().iter().map(|pair| pair.potential(rod, self.stiffer)).sum::<f64>()
    }

    /// The contacts as they are along a straight change of the rod from where it is now.
    pub(crate) fn linearise(&self, rod: &Rod, springs: &mut Springs) {
        springs.clear();
        springs.links.extend(self.pairs().iter().map(|pair| pair.link(rod, self.stiffer)));
        for (node, contact) in self.near() {
            let penalty = self.stiffer * contact.penalty;
            let force = contact.multiplier - penalty * contact.gap_now(rod, node);
            if contact.limit <= 0.0 && contact.hold <= 0.0 && force <= 0.0 {
                springs.open.push(Open::new(node, contact.along, contact.normal, force, penalty));
                continue;
            }
            let spring = Spring::new(node, spread(contact.normal, 0.0, contact.along), force, penalty).with_hold(
                contact.hold,
                contact.moved_across(rod, node),
                spread(contact.across, 0.0, contact.along),
            );
            springs.closed.push(if contact.limit > 0.0 {
                self.with_friction(spring, rod, node, contact)
            } else {
                spring
            });
        }
    }

    fn with_friction(&self, spring: Spring, rod: &Rod, node: usize, contact: &Contact) -> Spring {
        let (slip, roll) = contact.trial_slip(rod, node, self.radius);
        let first = contact.smooth.any_orthonormal_vector();
        let sides = [first, contact.smooth.cross(first)];
        let by_sides = sides.map(|side| spread(side, side.dot(roll), contact.along));
        spring.with_friction(contact.limit, sides.map(|side| side.dot(slip)), by_sides)
    }

    /// Notes the forces that the corrections have come to.
    pub fn note_forces(&mut self, rod: &Rod) {
        let stiffer = self.stiffer;
        self.manifold.each(|node, contact| contact.note_force(rod, node, stiffer));
        self.own.pairs.iter_mut().for_each(|pair| pair.note_force(rod, stiffer));
    }

    /// Lets the corrections that follow begin with the forces that those before have come to, and be stiffer: what is
    /// pushed hard into the wall would come out of it too slowly.
    pub fn update_multipliers(&mut self) {
        self.stiffer *= STIFFER;
        self.manifold.each(|_, contact| contact.update_multiplier());
        self.own.pairs.iter_mut().for_each(Pair::update_multiplier);
    }

    /// Goes back to the multipliers at the beginning of the step.
    pub fn undo(&mut self) {
        self.stiffer = 1.0;
        self.manifold.each(|_, contact| contact.undo());
        self.own.pairs.iter_mut().for_each(Pair::undo);
    }

    /// Lets go of all forces: the next step finds them anew.
    pub fn forget(&mut self) {
        self.manifold.each(|_, contact| contact.forget());
        self.own.pairs.iter_mut().for_each(Pair::forget);
    }

    /// Ends a step: the forces it has come to are the multipliers of the next, none by more than `rise` N above what it
    /// was.
    pub fn finish(&mut self, rod: &Rod, rise: f64) {
        let (radius, friction) = (self.radius, self.friction);
        self.manifold.each(|node, contact| contact.finish(rod, node, radius, friction, rise));
        self.own.pairs.iter_mut().for_each(|pair| pair.finish(rise));
    }

    /// What the wall does to each of the first `count` nodes, in N.
    pub fn forces(&self, count: usize) -> Vec<DVec3> {
        let mut forces = vec![DVec3::ZERO; count];
        for (node, contact) in self.near() {
            let force = contact.force();
            if let Some(entry) = forces.get_mut(node) {
                *entry += force * (1.0 - contact.along);
            }
            if let Some(entry) = forces.get_mut(node + 1) {
                *entry += force * contact.along;
            }
        }
        forces
    }

    /// What the wall does to the rod in all, in N.
    pub fn total(&self) -> DVec3 {
        self.near().map(|(_, contact)| contact.force()).sum()
    }
}
