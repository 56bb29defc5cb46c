//! The way down in a step: the change of the rod at which the quadratic model of its energy, and contacts and friction as
//! they are along it, come to rest.
//!
//! Elastic energy is nearly quadratic over a step, and contacts are anything but: most of what a step must find out is
//! which contacts press and which stick. So a correction solves the whole problem with contacts in it, for the one
//! model, before it looks at the rod again: the convex problem within an augmented Lagrangian's round (Nocedal and
//! Wright, "Numerical optimization", 2006, section 17.4), by Newton's method with a search along each way. A way costs
//! one factorisation; nothing of the rod is worked out anew. Where only the rod knew of contacts, each new one on the way
//! cut a correction short, down to a hundredth, and the next began with the same direction but for that one.

use glam::DVec3;

use super::contact::GRIP;
use super::rod::{Hessian, Rod};

/// Ways in a correction.
const WAYS: usize = 8;
/// What may be left of the slope at the end of a way.
const LEVEL: f64 = 0.1;
/// Looks at a way for where it is level.
const LOOKS: usize = 60;

/// A contact and its friction along a straight change of the rod.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spring {
    /// The node at which its edge begins.
    node: usize,
    /// Derivative of the gap by the node, its angle and the next node.
    normal: [f64; 7],
    /// What presses, in N; open where it is less than 0.
    force: f64,
    /// By what that grows with less of a gap, in N/mm.
    stiff: f64,
    /// What friction can give, in N.
    grip: f64,
    /// How far what sticks is stretched, in mm, in two directions across the normal.
    stretch: [f64; 2],
    /// Derivatives of that.
    sides: [[f64; 7]; 2],
    /// By what force and stretch change on the whole way.
    change: (f64, [f64; 2]),
    /// Stiffness that the way was found with: of the normal, and across.
    added_stiffness: (f64, [[f64; 2]; 2]),
}

fn dot(a: &[f64; 7], b: &[f64; 7]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Spring {
    /// A contact at a node and on the edge behind it: the derivative of its gap by the node, its angle and the next node,
    /// what presses in N, less than 0 where it is open, and by what that grows with less of a gap, in N/mm.
    pub(super) fn new(node: usize, normal: [f64; 7], force: f64, stiff: f64) -> Self {
        Self { node, normal, force, stiff, ..Self::default() }
    }

    /// The same with friction: what it can give in N, how far what sticks is stretched in mm in two directions across the
    /// normal, and the derivatives of that.
    #[must_use]
    pub(super) fn with_friction(self, grip: f64, stretch: [f64; 2], sides: [[f64; 7]; 2]) -> Self {
        Self { grip, stretch, sides, ..self }
    }

    fn length(stretch: [f64; 2]) -> f64 {
        (stretch[0] * stretch[0] + stretch[1] * stretch[1]).sqrt()
    }

    /// Adds it to the equations of the way on.
    fn add(&mut self, rod: &mut Rod) {
        self.added_stiffness = (0.0, [[0.0; 2]; 2]);
        if self.force > 0.0 {
            self.added_stiffness.0 = self.stiff;
            rod.add_spring(self.node, &self.normal, -self.force, self.stiff);
        }
        if self.grip <= 0.0 {
            return;
        }
        let length = Self::length(self.stretch);
        if length * GRIP <= self.grip {
            self.added_stiffness.1 = [[GRIP, 0.0], [0.0, GRIP]];
            for (side, stretch) in self.sides.iter().zip(self.stretch) {
                rod.add_spring(self.node, side, GRIP * stretch, GRIP);
            }
            return;
        }
        // Sliding friction does not change along its way.
        let [x, y] = self.stretch.map(|stretch| stretch / length);
        let stiff = self.grip / length;
        self.added_stiffness.1 = [[stiff * y * y, -stiff * x * y], [-stiff * x * y, stiff * x * x]];
        let mix = |a: f64, b: f64| std::array::from_fn(|i| a * self.sides[0][i] + b * self.sides[1][i]);
        rod.add_spring(self.node, &mix(x, y), self.grip, 0.0);
        rod.add_spring(self.node, &mix(-y, x), 0.0, stiff);
    }

    /// Notes how it changes on the way that was found.
    fn look_ahead(&mut self, rod: &Rod) {
        let way = rod.way(self.node);
        let sides = if self.grip > 0.0 { [dot(&self.sides[0], way), dot(&self.sides[1], way)] } else { [0.0; 2] };
        self.change = (-self.stiff * dot(&self.normal, way), sides);
    }

    /// Whether it does anything between here and a part of the way.
    fn is_live(&self, part: f64) -> bool {
        self.force > 0.0 || self.grip > 0.0 || self.force + part * self.change.0 > 0.0
    }

    /// The slope of its energy by the part of the way, at a part.
    fn slope(&self, part: f64) -> f64 {
        let (change, [dx, dy]) = self.change;
        let pressed = (self.force + part * change).max(0.0) * change / self.stiff;
        if self.grip <= 0.0 {
            return pressed;
        }
        let [x, y] = [self.stretch[0] + part * dx, self.stretch[1] + part * dy];
        let length = Self::length([x, y]);
        let pull = if length * GRIP <= self.grip { GRIP } else { self.grip / length };
        pressed + pull * (x * dx + y * dy)
    }

    /// By what the slope would change on the whole way if it stayed as it was added.
    fn added(&self) -> f64 {
        let (change, [dx, dy]) = self.change;
        let (normal, [[xx, xy], [yx, yy]]) = self.added_stiffness;
        let pressed = if normal > 0.0 { change * change / self.stiff } else { 0.0 };
        pressed + dx * (xx * dx + xy * dy) + dy * (yx * dx + yy * dy)
    }

    /// What the springs that were added for the way change by on it: node, derivative, force.
    fn changed(&self) -> impl Iterator<Item = (usize, [f64; 7], f64)> {
        let (change, [dx, dy]) = self.change;
        let (normal, [[xx, xy], [yx, yy]]) = self.added_stiffness;
        let by = [xx * dx + xy * dy, yx * dx + yy * dy];
        let pressed = (normal > 0.0).then_some((self.node, self.normal, -change));
        let held =
            (self.grip > 0.0).then(|| (0..2).map(move |i| (self.node, self.sides[i], by[i]))).into_iter().flatten();
        pressed.into_iter().chain(held)
    }

    /// Goes a part of the way. Returns whether it opened, closed, stuck or slid there.
    fn go(&mut self, part: f64) -> bool {
        let state = |spring: &Self| (spring.force > 0.0, Self::length(spring.stretch) * GRIP <= spring.grip);
        let before = state(self);
        let (force, stretch) = self.change;
        self.force += part * force;
        for (stretch, change) in self.stretch.iter_mut().zip(stretch) {
            *stretch += part * change;
        }
        state(self) != before
    }
}

/// A contact that is open, and stays so unless a way closes it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Open {
    /// The node at which its edge begins, and where on it.
    node: usize,
    along: f64,
    /// The way its gap grows.
    normal: DVec3,
    /// What presses where the change begins, in N: at most 0; and by what it grows with less of a gap, in N/mm.
    force: f64,
    stiff: f64,
}

impl Open {
    /// A contact at a part of the edge behind a node, whose gap grows along `normal`; `force` and `stiff` as in
    /// [`Spring::new`].
    pub(super) fn new(node: usize, along: f64, normal: DVec3, force: f64, stiff: f64) -> Self {
        Self { node, along, normal, force, stiff }
    }

    /// By what its force changes when its edge moves so.
    fn change(&self, [ax, ay, az, _, bx, by, bz]: &[f64; 7]) -> f64 {
        let moved = DVec3::new(*ax, *ay, *az).lerp(DVec3::new(*bx, *by, *bz), self.along);
        -self.stiff * self.normal.dot(moved)
    }

    fn spring(&self, force: f64) -> Spring {
        Spring::new(self.node, spread(self.normal, 0.0, self.along), force, self.stiff)
    }
}

/// The derivatives by a node, its angle and the next node of what moves with a place of the edge between them along `v`,
/// and turns with the angle.
pub(super) fn spread(v: DVec3, angle: f64, along: f64) -> [f64; 7] {
    let (a, b) = (v * (1.0 - along), v * along);
    [a.x, a.y, a.z, angle, b.x, b.y, b.z]
}

/// The contacts of a correction. Most of them are open and stay so: on a fine surface a node has several facets in
/// reach. They cost a look until a way closes them.
#[derive(Clone, Debug, Default)]
pub(super) struct Springs {
    pub(super) closed: Vec<Spring>,
    pub(super) open: Vec<Open>,
}

impl Springs {
    pub(super) fn clear(&mut self) {
        self.closed.clear();
        self.open.clear();
    }

    /// Takes those among the others that press at the end of the way that was found; on the ways before it no node has
    /// moved by more than `gone` mm, on all of it none by more than `moved`.
    fn close(&mut self, rod: &Rod, gone: f64, moved: f64) {
        let Self { closed, open } = self;
        let reach = gone + moved;
        open.retain(|open| {
            if open.force + open.stiff * reach <= 0.0 {
                return true;
            }
            let force = open.force + open.change(rod.change(open.node));
            let is_open = force + open.change(rod.way(open.node)) <= 0.0;
            if !is_open {
                closed.push(open.spring(force));
            }
            is_open
        });
    }
}

/// What came of a descent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Descent {
    /// The largest move of a node in the change, in mm; infinite when there is no answer.
    pub(super) moved: f64,
    /// At most by what the potential should fall, as a negative number of N mm.
    pub(super) fall: f64,
    /// Whether the model and its contacts are at rest there.
    pub(super) is_settled: bool,
}

/// Finds the change of an assembled rod, for [`Rod::advance`]. `None` when the matrix is not positive definite.
pub(super) fn descend(rod: &mut Rod, springs: &mut Springs, hessian: Hessian) -> Option<Descent> {
    rod.begin_change();
    let mut live: Vec<Spring> = Vec::with_capacity(springs.closed.len());
    let (mut fall, mut gone, mut is_settled) = (0.0, 0.0, false);
    for _ in 0..WAYS {
        rod.begin_way();
        springs.closed.iter_mut().for_each(|spring| spring.add(rod));
        let way = rod.solve(hessian)?;
        springs.close(rod, gone, way.moved);
        springs.closed.iter_mut().for_each(|spring| spring.look_ahead(rod));
        live.clear();
        live.extend(springs.closed.iter().filter(|spring| spring.is_live(way.part)));
        // Of the rod alone: its slope where the way begins, and by what that changes on the whole of it.
        let springs_at = |part: f64| live.iter().map(|spring| spring.slope(part)).sum::<f64>();
        let first = way.slope - springs_at(0.0);
        let rise = -way.slope - live.iter().map(Spring::added).sum::<f64>();
        let part = level(way.part, |part| first + part * rise + springs_at(part));
        if !(way.moved.is_finite() && part.is_finite()) {
            return Some(Descent { moved: f64::INFINITY, fall: 0.0, is_settled: false });
        }
        fall += part * way.slope;
        rod.go(part, live.iter().flat_map(Spring::changed));
        is_settled = part >= 1.0;
        gone += part * way.moved;
        for spring in &mut springs.closed {
            is_settled &= !spring.go(part);
        }
        // A way that is too long for the model ends the correction.
        if is_settled || (way.part < 1.0 && part >= way.part) {
            break;
        }
    }
    Some(Descent { moved: rod.largest_move(), fall, is_settled })
}

/// Where the slope along a way is level, at most at `most`; by false position and by halves in turn, as the one alone
/// stalls before a stiff contact.
fn level(most: f64, slope: impl Fn(f64) -> f64) -> f64 {
    let (mut from, mut at_from) = (0.0, slope(0.0));
    let (mut to, mut at_to) = (most, slope(most));
    let enough = LEVEL * at_from.abs();
    if at_to <= enough {
        return most;
    }
    for look in 0..LOOKS {
        let part =
            if look % 2 == 0 { (from * at_to - to * at_from) / (at_to - at_from) } else { f64::midpoint(from, to) };
        let here = slope(part);
        if here.abs() <= enough {
            return part;
        }
        if here > 0.0 {
            (to, at_to) = (part, here);
        } else {
            (from, at_from) = (part, here);
        }
    }
    from
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::rod::{Held, Section};

    /// Where a cantilever of 20 nodes comes to that is pushed on a floor below it, whose contacts are all looked at from
    /// the start, or once a way closes them; and how many press.
    fn rest(is_open: bool) -> (Vec<DVec3>, usize) {
        let section =
            Section { length: 0.5, cell: 0.5, ei: 1.0, gj: 1.0, ea: 1000.0, drag: 1e-6, ..Section::default() };
        let positions: Vec<DVec3> = (0..20).map(|i| DVec3::X * (0.5 * f64::from(i))).collect();
        let mut rod = Rod::new(positions, vec![section; 20], DVec3::Y);
        (18..20).for_each(|i| rod.held[i] = Held { position: true, angle: true });
        rod.forces = (0..18).map(|i| (i, DVec3::Z * -2e-3)).collect();
        rod.assemble(f64::INFINITY, 0.0, Hessian::Exact);
        let mut springs = Springs::default();
        for i in 0..19 {
            // A floor that rises towards the tip, and more of it out of reach.
            for gap in [0.02 + 0.002 * i as f64, 0.5, 20.0] {
                let (force, stiff) = (-4.0 * gap, 4.0);
                if is_open {
                    springs.open.push(Open::new(i, 0.25, DVec3::Z, force, stiff));
                } else {
                    springs.closed.push(Spring::new(i, spread(DVec3::Z, 0.0, 0.25), force, stiff));
                }
            }
        }
        let descent = descend(&mut rod, &mut springs, Hessian::Exact).unwrap();
        assert!(descent.is_settled && descent.fall < 0.0, "{descent:?}");
        rod.advance(1.0);
        (rod.positions, springs.closed.iter().filter(|spring| spring.force > 0.0).count())
    }

    #[test]
    fn a_contact_that_a_way_closes_counts_as_if_it_had_been_looked_at_all_along() {
        let ((all, pressing), (found, as_many)) = (rest(false), rest(true));
        assert!(pressing > 1 && pressing == as_many, "{pressing} {as_many}");
        for (a, b) in all.iter().zip(&found) {
            assert!(a.distance(*b) < 1e-12, "{a} {b}");
        }
        // 0.036 N on a floor of 4 N/mm.
        assert!(found[0].z < -0.02 && found[0].z > -0.05, "{}", found[0].z);
    }
}
