//! A contact along a straight change of the rod: the gap and the slip are linear in it, the law is as it is.

use glam::DVec3;

use super::law::SLIP_PENALTY;
use super::self_contact::Link;
use crate::rod::Rod;

/// A contact and its friction along a straight change of the rod.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Spring {
    /// The node at which its edge begins.
    node: usize,
    /// Derivative of the gap by the node, its angle and the next node.
    normal: [f64; 7],
    /// What presses, in N; open where it is less than 0.
    force: f64,
    /// The penalty: by what that grows with less of a gap, in N/mm.
    penalty: f64,
    /// Coulomb's limit: what friction can give, in N.
    limit: f64,
    /// The elastic part of the slip, in mm, in two directions across the normal.
    slip: [f64; 2],
    /// Derivatives of that.
    sides: [[f64; 7]; 2],
    /// What the wall's curvature holds it with, in N/mm, how far it has moved across itself, and the derivative of that.
    hold: f64,
    moved: f64,
    across: [f64; 7],
    /// By what force, slip and way across change on the whole search direction.
    change: (f64, [f64; 2]),
    moves: f64,
    /// Stiffness that the search direction was found with: of the normal, and across.
    added_stiffness: (f64, [[f64; 2]; 2]),
}

#[inline]
fn dot(a: &[f64; 7], b: &[f64; 7]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Spring {
    /// A contact at a node and on the edge behind it: the derivative of its gap by the node, its angle and the next node,
    /// what presses in N, less than 0 where it is open, and the penalty in N/mm.
    #[inline]
    pub(crate) fn new(node: usize, normal: [f64; 7], force: f64, penalty: f64) -> Self {
        Self { node, normal, force, penalty, ..Self::default() }
    }

    /// The same with friction: Coulomb's limit in N, the elastic part of the slip in mm in two directions across the
    /// normal, and the derivatives of that.
    #[inline]
    #[must_use]
    pub(crate) fn with_friction(self, limit: f64, slip: [f64; 2], sides: [[f64; 7]; 2]) -> Self {
        Self { limit, slip, sides, ..self }
    }

    /// The same on a wall that comes round the lumen: what that holds it with in N/mm, how far it has moved across itself in
    /// mm, and the derivative of that.
    #[inline]
    #[must_use]
    pub(crate) fn with_hold(self, hold: f64, moved: f64, across: [f64; 7]) -> Self {
        Self { hold, moved, across, ..self }
    }

    /// Whether it presses.
    #[inline]
    pub(crate) fn is_closed(&self) -> bool {
        self.force > 0.0
    }

    #[inline]
    fn length(slip: [f64; 2]) -> f64 {
        (slip[0] * slip[0] + slip[1] * slip[1]).sqrt()
    }

    /// Adds it to the equations of the next search direction.
    #[inline]
    pub(crate) fn add(&mut self, rod: &mut Rod) {
        self.added_stiffness = (0.0, [[0.0; 2]; 2]);
        if self.is_closed() {
            self.added_stiffness.0 = self.penalty;
            rod.add_spring(self.node, &self.normal, -self.force, self.penalty);
        }
        if self.hold > 0.0 {
            rod.add_spring(self.node, &self.across, self.hold * self.moved, self.hold);
        }
        if self.limit <= 0.0 {
            return;
        }
        let length = Self::length(self.slip);
        if length * SLIP_PENALTY <= self.limit {
            self.added_stiffness.1 = [[SLIP_PENALTY, 0.0], [0.0, SLIP_PENALTY]];
            for (side, slip) in self.sides.iter().zip(self.slip) {
                rod.add_spring(self.node, side, SLIP_PENALTY * slip, SLIP_PENALTY);
            }
            return;
        }
        // Sliding friction does not change along its way.
        let [x, y] = self.slip.map(|slip| slip / length);
        let stiff = self.limit / length;
        self.added_stiffness.1 = [[stiff * y * y, -stiff * x * y], [-stiff * x * y, stiff * x * x]];
        let mix = |a: f64, b: f64| std::array::from_fn(|i| a * self.sides[0][i] + b * self.sides[1][i]);
        rod.add_spring(self.node, &mix(x, y), self.limit, 0.0);
        rod.add_spring(self.node, &mix(-y, x), 0.0, stiff);
    }

    /// Notes how it changes along the search direction that was found.
    #[inline]
    pub(crate) fn look_ahead(&mut self, rod: &Rod) {
        let by = rod.direction(self.node);
        let sides = if self.limit > 0.0 { [dot(&self.sides[0], by), dot(&self.sides[1], by)] } else { [0.0; 2] };
        self.change = (-self.penalty * dot(&self.normal, by), sides);
        self.moves = if self.hold > 0.0 { dot(&self.across, by) } else { 0.0 };
    }

    /// Whether it does anything between here and a part of the direction.
    #[inline]
    pub(crate) fn is_live(&self, part: f64) -> bool {
        self.force > 0.0 || self.limit > 0.0 || self.hold > 0.0 || self.force + part * self.change.0 > 0.0
    }

    /// The slope of its energy by the part of the direction, at a part.
    #[inline]
    pub(crate) fn slope(&self, part: f64) -> f64 {
        let (change, [dx, dy]) = self.change;
        let pressed = (self.force + part * change).max(0.0) * change / self.penalty
            + self.hold * (self.moved + part * self.moves) * self.moves;
        if self.limit <= 0.0 {
            return pressed;
        }
        let [x, y] = [self.slip[0] + part * dx, self.slip[1] + part * dy];
        let length = Self::length([x, y]);
        let pull = if length * SLIP_PENALTY <= self.limit { SLIP_PENALTY } else { self.limit / length };
        pressed + pull * (x * dx + y * dy)
    }

    /// By what the slope would change on the whole direction if it stayed as it was added.
    #[inline]
    pub(crate) fn added(&self) -> f64 {
        let (change, [dx, dy]) = self.change;
        let (normal, [[xx, xy], [yx, yy]]) = self.added_stiffness;
        let pressed = if normal > 0.0 { change * change / self.penalty } else { 0.0 };
        pressed + self.hold * self.moves * self.moves + dx * (xx * dx + xy * dy) + dy * (yx * dx + yy * dy)
    }

    /// What the springs that were added for the direction change by on it: node, derivative, force.
    #[inline]
    pub(crate) fn changed(&self) -> impl Iterator<Item = (usize, [f64; 7], f64)> {
        let (change, [dx, dy]) = self.change;
        let (normal, [[xx, xy], [yx, yy]]) = self.added_stiffness;
        let by = [xx * dx + xy * dy, yx * dx + yy * dy];
        let pressed = (normal > 0.0).then_some((self.node, self.normal, -change));
        let stuck =
            (self.limit > 0.0).then(|| (0..2).map(move |i| (self.node, self.sides[i], by[i]))).into_iter().flatten();
        let held = (self.hold > 0.0).then_some((self.node, self.across, self.hold * self.moves));
        pressed.into_iter().chain(held).chain(stuck)
    }

    /// Goes a part of the direction. Returns whether it opened, closed, stuck or slid there.
    #[inline]
    pub(crate) fn go(&mut self, part: f64) -> bool {
        let state = |spring: &Self| (spring.force > 0.0, Self::length(spring.slip) * SLIP_PENALTY <= spring.limit);
        let before = state(self);
        let (force, slip) = self.change;
        self.force += part * force;
        self.moved += part * self.moves;
        for (slip, change) in self.slip.iter_mut().zip(slip) {
            *slip += part * change;
        }
        state(self) != before
    }
}

/// A contact that is open, and stays so unless a search direction closes it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Open {
    /// The node at which its edge begins, and where on it.
    node: usize,
    along: f64,
    /// The way its gap grows.
    normal: DVec3,
    /// What presses where the change begins, in N: at most 0; and the penalty in N/mm.
    force: f64,
    penalty: f64,
}

impl Open {
    /// A contact at a part of the edge behind a node, whose gap grows along `normal`; `force` and `penalty` as in
    /// [`Spring::new`].
    #[inline]
    pub(crate) fn new(node: usize, along: f64, normal: DVec3, force: f64, penalty: f64) -> Self {
        Self { node, along, normal, force, penalty }
    }

    /// By what its force changes when its edge moves so.
    #[inline]
    fn change(&self, [ax, ay, az, _, bx, by, bz]: &[f64; 7]) -> f64 {
        let moved = DVec3::new(*ax, *ay, *az).lerp(DVec3::new(*bx, *by, *bz), self.along);
        -self.penalty * self.normal.dot(moved)
    }

    #[inline]
    fn spring(&self, force: f64) -> Spring {
        Spring::new(self.node, spread(self.normal, 0.0, self.along), force, self.penalty)
    }
}

/// The derivatives by a node, its angle and the next node of what moves with a place of the edge between them along `v`,
/// and turns with the angle.
#[inline]
pub(crate) fn spread(v: DVec3, angle: f64, along: f64) -> [f64; 7] {
    let (a, b) = (v * (1.0 - along), v * along);
    [a.x, a.y, a.z, angle, b.x, b.y, b.z]
}

/// The contacts of a correction. Most of them are open and stay so: on a fine surface a node has several facets in
/// reach. They cost a look until a search direction closes them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Springs {
    pub(crate) closed: Vec<Spring>,
    pub(crate) open: Vec<Open>,
    /// Where the rod touches itself, or nearly does.
    pub(crate) links: Vec<Link>,
}

impl Springs {
    #[inline]
    pub(crate) fn clear(&mut self) {
        self.closed.clear();
        self.open.clear();
        self.links.clear();
    }

    /// Closes those that press at the end of the search direction that was found; on those before it no node has moved by
    /// more than `gone` mm, on all of it none by more than `moved`.
    #[inline]
    pub(crate) fn close(&mut self, rod: &Rod, gone: f64, moved: f64) {
        let Self { closed, open, .. } = self;
        let reach = gone + moved;
        open.retain(|open| {
            if open.force + open.penalty * reach <= 0.0 {
                return true;
            }
            let force = open.force + open.change(rod.change(open.node));
            let is_open = force + open.change(rod.direction(open.node)) <= 0.0;
            if !is_open {
                closed.push(open.spring(force));
            }
            is_open
        });
    }
}
