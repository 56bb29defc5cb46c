//! A wire that grows out of its guide into a vessel, step by step.
//!
//! The wire is cut into elements once, fine at the tip; element and node keep their place in the material. The part
//! outside the guide is the rod; two nodes inside follow the guide's axis. The cell of a node ends at the guide's
//! mouth, so that the length which bends grows with the feed and does not jump from element to element.

use std::sync::Arc;

use glam::DVec3;

use super::STEP;
use super::body::Body;
use super::placement::{PlacementError, check_load, rotation};
use super::report::{StepKind, StepReport};
use super::rod::{Fixed, Rod, Section};
use super::setup::{Entry, Input};
use super::wall::Wall;
use super::wire::Wire;

/// Length outside the guide at the start, in elements.
const FIRST: usize = 2;
/// The least part of an element that a cell has: what is still inside the guide hardly bends.
const MIN_CELL: f64 = 0.02;
/// How far the wire is fed in a part of a step at most, in mm: beyond that what snaps has no time to settle, and a bent tip
/// falls behind.
const FARTHEST: f64 = 0.05;
/// A step is balanced where Newton's second law is missed by less than this part of all that presses on the wall and the
/// guide, and by less than this many N where nothing does.
const SETTLED: (f64, f64) = (0.05, 1e-5);

/// Of the first `count` nodes, in N s.
fn momentum(rod: &Rod, count: usize) -> DVec3 {
    (0..count).map(|i| rod.velocities[i] * rod.sections[i].mass).sum()
}

/// A wire on its way.
#[derive(Clone, Debug)]
pub struct Simulation {
    body: Body,
    /// Place of each node in the material, in mm from the tip.
    grid: Vec<f64>,
    sections: Vec<Section>,
    /// On each mm outside the guide, in N: everywhere, and at each node from the tip.
    load: DVec3,
    loads: Vec<DVec3>,
    mouth: DVec3,
    /// Into the vessel.
    way: DVec3,
    inserted: f64,
    roll: f64,
    steps: u64,
    /// What came of the last step.
    report: StepReport,
    most_push: f64,
}

impl Simulation {
    /// A wire whose tip looks out of the guide, rolled by an angle in radians.
    ///
    /// # Errors
    /// When the wire's numbers make no sense, or it does not fit.
    pub fn new(
        wire: &Wire,
        friction: [f64; 2],
        entry: &Entry,
        roll: f64,
        wall: Option<Arc<Wall>>,
    ) -> Result<Self, PlacementError> {
        wire.check()?;
        let grid = wire.grid();
        let sections = wire.sections(&grid);
        let mouth = DVec3::from(entry.at.map(f64::from));
        let way = DVec3::from(entry.direction.map(f64::from)).try_normalize().ok_or(PlacementError::Direction)?;
        if !mouth.is_finite() {
            return Err(PlacementError::Outside);
        }
        if let Some(wall) = &wall {
            let (radius_mm, index) = (wire.radius(), wall.index());
            let reach = grid[FIRST];
            let ends = [mouth, mouth + way * (reach + radius_mm)];
            for p in ends {
                let distance_mm = index
                    .project_point(p, f64::INFINITY, u32::MAX)
                    .map_or(f64::INFINITY, |projection| projection.distance);
                if distance_mm < radius_mm * 1.02 {
                    return Err(PlacementError::Tight { distance_mm, radius_mm });
                }
            }
        }
        let inserted = grid[FIRST] + 0.5 * (grid[FIRST + 1] - grid[FIRST]);
        let count = FIRST + 3;
        let positions = grid[..count].iter().map(|s| mouth + way * (inserted - s)).collect();
        let rod = Rod::new(positions, sections[..count].to_vec(), rotation(way, roll) * way.any_orthonormal_vector());
        let mut simulation = Self {
            body: Body::new(rod, wire.radius(), friction, wall),
            grid,
            sections,
            load: DVec3::ZERO,
            loads: Vec::new(),
            mouth,
            way,
            inserted,
            roll,
            steps: 0,
            report: StepReport::default(),
            // More than a hand gives without noticing: 20 times the load under which a floppy tip buckles.
            most_push: if wire.diameter_mm < 0.6 { 3.0 } else { 10.0 },
        };
        simulation.place();
        simulation.body.detect(simulation.outside());
        Ok(simulation)
    }

    /// Puts a load on each mm outside the guide, in N.
    ///
    /// # Errors
    /// When it is more than 0.1 N, or no number.
    pub fn set_load(&mut self, load: DVec3) -> Result<(), PlacementError> {
        check_load(load.length())?;
        self.load = load;
        self.place();
        Ok(())
    }

    /// Puts these loads on each mm at the nodes from the tip, in N, beside the load that is everywhere, from the next
    /// step on.
    pub fn set_loads(&mut self, loads: Vec<DVec3>) {
        self.loads = loads;
    }

    /// The first node inside the guide.
    fn outside(&self) -> usize {
        self.body.rod.len() - 2
    }

    /// Ends cells at the guide's mouth, and fixes what is inside.
    fn place(&mut self) {
        let (first, inserted) = (self.outside(), self.inserted);
        let rod = &mut self.body.rod;
        for i in 0..rod.len() {
            rod.fixed[i] = Fixed { position: i >= first, angle: i >= first };
            if i + 3 < first || i == 0 {
                continue;
            }
            let half = |a: usize, b: usize| f64::midpoint(self.grid[a], self.grid[b]);
            let (from, to) = (half(i - 1, i), half(i, i + 1));
            let part = ((to.min(inserted) - from) / (to - from)).max(MIN_CELL);
            rod.sections[i].cell = part * (to - from);
            rod.sections[i].rest = self.sections[i].rest.map(|rest| rest * part);
        }
        rod.forces.clear();
        if self.load != DVec3::ZERO || !self.loads.is_empty() {
            let load = |i: usize| self.load + self.loads.get(i).copied().unwrap_or_default();
            rod.forces.extend((0..first).map(|i| (i, load(i) * rod.sections[i].cell)));
        }
    }

    /// A step of [`STEP`] seconds. One that feeds farther than `FARTHEST` is made of equal parts; what the wall bears is that
    /// of the last one.
    pub fn step(&mut self, input: Input) -> StepReport {
        let parts = (f64::from(input.limited().feed.abs()) * STEP / FARTHEST).ceil().max(1.0);
        let mut report = self.step_by(STEP / parts, input);
        for _ in 1..parts as u32 {
            report = report.followed_by(&self.step_by(STEP / parts, input));
        }
        self.steps -= parts as u64 - 1;
        self.report = report;
        report
    }

    /// A step of `dt` seconds. A trial's are of [`STEP`], or equal parts of it where the feed is fast; what they find hardly
    /// depends on that.
    pub fn step_by(&mut self, dt: f64, input: Input) -> StepReport {
        let input = input.limited();
        let (wanted_mm, turn) = (f64::from(input.feed) * dt, f64::from(input.roll) * dt);
        // What would ask for more force than a hand gives is not fed; the other way it may go.
        let is_refused = self.is_at_limit() && wanted_mm * self.report.push_n > 0.0;
        let feed = if is_refused { 0.0 } else { wanted_mm };
        let least = f64::midpoint(self.grid[FIRST], self.grid[FIRST + 1]);
        let most = self.grid[self.grid.len() - 4];
        let before = self.inserted;
        self.inserted = (before + feed).clamp(least, most);
        self.renumber();
        self.place();
        let (first, inserted) = (self.outside(), self.inserted);
        let (mouth, way, grid) = (self.mouth, self.way, &self.grid);
        let prepare = |rod: &mut Rod| {
            for (position, at) in rod.positions.iter_mut().zip(grid).skip(first) {
                *position = mouth + way * (inserted - at);
            }
            // Tangents look back to the guide.
            (first..rod.len()).for_each(|i| rod.turn_to(i, if i == first { -turn } else { 0.0 }));
        };
        let before_step = momentum(&self.body.rod, first);
        let kind = self.body.step(dt, first, prepare);
        self.steps += 1;
        let waits = matches!(kind, StepKind::Held | StepKind::Waited);
        if waits {
            self.inserted = before;
            self.renumber();
            self.place();
        } else {
            self.roll += turn;
        }
        let (reaction, torque_n_mm) = self.reaction();
        let residual_n = self.residual(reaction, before_step, dt).length();
        let pressed: f64 = self.body.contacts.pressing().map(|(_, contact)| contact.multiplier).sum();
        let is_settled = residual_n <= SETTLED.0 * (pressed + reaction.length()) + SETTLED.1;
        self.report = StepReport {
            kind: if kind == StepKind::Balanced && !is_settled { StepKind::Unsettled } else { kind },
            wanted_mm,
            fed_mm: self.inserted - before,
            wanted_rad: turn,
            rolled_rad: if waits { 0.0 } else { turn },
            residual_n,
            push_n: reaction.dot(self.way) - self.sleeve_force(),
            torque_n_mm,
        };
        self.report
    }

    /// Adds the nodes that come out of the guide, and takes off those that went back.
    fn renumber(&mut self) {
        let rod = &mut self.body.rod;
        let before = rod.len();
        while self.grid[rod.len() - 2] < self.inserted {
            let i = rod.len();
            let director = rod.director(i - 2);
            rod.push(self.mouth + self.way * (self.inserted - self.grid[i]), self.sections[i], director);
        }
        while rod.len() > FIRST + 3 && self.grid[rod.len() - 3] >= self.inserted {
            rod.pop();
        }
        // A node that was inside had its cell cut.
        let count = rod.len();
        let first = before.min(count).saturating_sub(6);
        rod.sections[first..].copy_from_slice(&self.sections[first..count]);
    }

    /// The reaction of the guide, now that the wire is where it is: what it does to the wire, as a force in N, and as a
    /// moment about the way in, in N mm. The rod's tangents point out of the vessel, so its moments have the other sign.
    fn reaction(&mut self) -> (DVec3, f64) {
        let first = self.outside();
        let rod = &mut self.body.rod;
        rod.assemble_from(first.saturating_sub(2));
        ((first..rod.len()).map(|i| rod.reaction_force(i)).sum(), -rod.reaction_moment(first))
    }

    /// What the guide's mouth pushes the wire out with by itself, in N: a wire that is bent or twisted there gives way to
    /// that by coming out, as a longer piece holds the same bend with less energy (Bigoni, Dal Corso, Bosi and Misseroni
    /// 2015):
    ///
    /// ```text
    /// (EI k^2 + GJ t^2) / 2
    /// ```
    ///
    /// with the curvature k and the twist t at the mouth. It is part of the guide's reaction, and is not done by the hand.
    fn sleeve_force(&self) -> f64 {
        let (rod, first) = (&self.body.rod, self.outside());
        let node = first - usize::from(self.inserted < f64::midpoint(self.grid[first - 1], self.grid[first]));
        let Section { cell, ei, gj, .. } = rod.sections[node];
        let ([towards, across], twist) = (rod.curvature(node), rod.twist(node));
        0.5 * (ei * (towards * towards + across * across) + gj * twist * twist) / (cell * cell)
    }

    /// What is left over of all forces on the wire outside the guide, in N, with the guide's reaction and the momentum that
    /// it had before a step of `dt` seconds.
    fn residual(&self, reaction: DVec3, before: DVec3, dt: f64) -> DVec3 {
        let (rod, first) = (&self.body.rod, self.outside());
        let loads: DVec3 = rod.forces.iter().map(|&(_, force)| force).sum();
        let drag: DVec3 = (0..first).map(|i| rod.velocities[i] * rod.sections[i].drag).sum();
        let contacts = self.body.contacts.total() + self.body.contacts.total_of_pairs(first);
        reaction + contacts + loads - drag - (momentum(rod, first) - before) / dt
    }

    /// The rod and its contacts.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Nodes outside the guide, from the tip, and the mouth.
    pub fn nodes(&self) -> impl DoubleEndedIterator<Item = DVec3> {
        self.body.rod.positions[..self.outside()].iter().copied().chain([self.mouth])
    }

    /// Number of nodes outside the guide.
    pub fn count(&self) -> usize {
        self.outside()
    }

    /// Position of the tip in mm.
    pub fn tip(&self) -> DVec3 {
        self.body.rod.positions[0]
    }

    /// Direction of the tip.
    pub fn tip_direction(&self) -> DVec3 {
        -self.body.rod.tangent(0)
    }

    /// Length outside the guide in mm.
    pub fn inserted(&self) -> f64 {
        self.inserted
    }

    /// How far the wire outside the guide differs from its length at rest, as a part of that; and the element that differs most.
    /// The element that crosses the mouth counts whole.
    pub fn length_errors(&self) -> [f64; 2] {
        let rod = &self.body.rod;
        let (mut length, mut at_rest, mut most) = (0.0, 0.0, 0.0_f64);
        for edge in 0..self.outside() {
            let (now, rest) = (rod.length(edge), rod.sections[edge].length);
            length += now;
            at_rest += rest;
            most = most.max((now / rest - 1.0).abs());
        }
        [(length / at_rest - 1.0).abs(), most]
    }

    /// Roll at the guide in radians.
    pub fn roll(&self) -> f64 {
        self.roll
    }

    /// Whether it is back in its guide, as it was at the start.
    pub(super) fn is_back(&self) -> bool {
        self.inserted <= f64::midpoint(self.grid[FIRST], self.grid[FIRST + 1])
    }

    /// Counts its steps on from so many.
    pub(super) fn count_from(&mut self, steps: u64) {
        self.steps = steps;
    }

    /// Steps so far.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// What came of the last step.
    pub fn report(&self) -> StepReport {
        self.report
    }

    /// [`StepReport::push_n`] and [`StepReport::torque_n_mm`] of the last step.
    pub fn push_and_torque(&self) -> [f64; 2] {
        [self.report.push_n, self.report.torque_n_mm]
    }

    /// Whether the push is at its limit: more force would be needed than a hand gives.
    pub fn is_at_limit(&self) -> bool {
        self.report.push_n.abs() > self.most_push
    }

    /// Material places of the nodes, in mm from the tip.
    pub fn grid(&self) -> &[f64] {
        &self.grid
    }
}
