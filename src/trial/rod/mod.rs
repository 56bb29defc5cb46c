//! An elastic rod with stretch, bending, twist and a curved rest shape: discrete elastic rods (Bergou et al., "Discrete
//! elastic rods", 2008, and "Discrete viscous threads", 2010, for the derivatives).
//!
//! Nodes have positions, the edges between them a material frame: the tangent and a director `m` across it. At an inner
//! node the discrete curvature `2 tan(turn / 2)` has a component about each director; its twist is the angle between
//! one director, carried over the bend without turning, and the other. Energies are
//!
//! ```text
//! bend   EI / 2c |kappa - rest|^2     twist   GJ / 2c tau^2     stretch   EA / 2 l (|e| / l - 1)^2
//! ```
//!
//! where the bend is the mean of what it is in the frames of the two edges, so that twist does not soften it, and `c` is
//! the length of the node's cell, which reaches half-way to its neighbours. A time step is implicit (backward Euler): it
//! is found by Newton's method with all second derivatives (`bend`), and with fewer where those are not positive definite
//! ([`Hessian`]). The matrix has a half bandwidth of 10 (`band`). The gradient is exact, so what a step comes to, and what
//! stands still, are too.
//!
//! Nodes are numbered from the tip; tangents point away from it.

mod band;
mod bend;
mod change;

use glam::{DMat3, DVec3};

use self::band::{Band, PER_NODE};
use self::bend::{Blocks, Slopes, curvature_slopes};
pub use self::change::Way;

/// Numbers of a node, its cell and the edge that begins there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Section {
    /// Rest length of the edge to the next node, in mm; of the last node unused.
    pub length: f64,
    /// Length of the cell that bends and twists at the node, in mm.
    pub cell: f64,
    /// Bending stiffness EI in N mm2.
    pub ei: f64,
    /// Torsional stiffness GJ in N mm2.
    pub gj: f64,
    /// Axial stiffness EA of the edge in N.
    pub ea: f64,
    /// Discrete curvature at rest: towards the director, and across.
    pub rest: [f64; 2],
    /// Mass of the node in t.
    pub mass: f64,
    /// Viscous drag of the node in N s/mm.
    pub drag: f64,
}

/// What is held of a node and of the edge that begins there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Held {
    /// Its position.
    pub position: bool,
    /// The angle of the edge's frame.
    pub angle: bool,
}

/// An edge as it is now.
#[derive(Clone, Copy, Debug, Default)]
struct Edge {
    length: f64,
    /// 1 / length.
    inverse: f64,
    tangent: DVec3,
    /// The directors, at right angles to the tangent and each other.
    m1: DVec3,
    m2: DVec3,
}

/// The bend and the twist at a node as they are now.
#[derive(Clone, Copy, Debug, Default)]
struct Strain {
    /// Discrete curvature towards the director, and across: means of the two edges' frames.
    towards: f64,
    across: f64,
    /// Twist in radians.
    twist: f64,
    /// The vector of the discrete curvature, and its square.
    binormal: DVec3,
    squared: f64,
    /// 1 / (1 + cos) of the turn.
    inverse: f64,
}

/// What stands for the second derivatives of the energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hessian {
    /// Squares of first derivatives, and what tension adds: always positive definite.
    Safe,
    /// The same, and what pressure takes away: nearer to the truth, and not positive definite beyond the load at which
    /// the rod buckles.
    Pressed,
    /// All of them.
    Exact,
}

impl Hessian {
    /// The one to be tried when this one is not positive definite.
    #[must_use]
    pub fn safer(self) -> Self {
        if self == Self::Exact { Self::Pressed } else { Self::Safe }
    }
}

/// A rod, at rest or on its way through a time step.
#[derive(Clone, Debug, Default)]
pub struct Rod {
    /// Position of each node in mm.
    pub positions: Vec<DVec3>,
    /// Velocities in mm/s.
    pub velocities: Vec<DVec3>,
    /// Stiffness and rest shape.
    pub sections: Vec<Section>,
    /// What is held.
    pub held: Vec<Held>,
    /// Forces on nodes, in N.
    pub forces: Vec<(usize, DVec3)>,
    /// Moments about the tangents of edges, in N mm.
    pub moments: Vec<(usize, f64)>,
    /// Where the nodes were at the start of the step.
    start: Vec<DVec3>,
    /// Tangent and director of each edge at the start of the step.
    frames: Vec<[DVec3; 2]>,
    /// How far each edge has turned about its tangent in the step, in radians.
    spins: Vec<f64>,
    /// How fast each edge turned in the step before, in rad/s.
    turns: Vec<f64>,
    /// The twist at each node when it was last looked at: it may pass half a turn.
    twists: Vec<f64>,
    edges: Vec<Edge>,
    /// Of each inner node.
    strains: Vec<Strain>,
    gradient: Vec<f64>,
    band: Band,
    /// The equations without springs, and the gradient without them at the change so far; where rows are held, nothing.
    model: Band,
    residual: Vec<f64>,
    /// The way that was found last, and the change that has come of ways so far.
    way: Vec<f64>,
    change: Vec<f64>,
    /// Positions and spins from which the change leads on.
    base: (Vec<DVec3>, Vec<f64>),
}

/// `v`, at right angles to `from`, carried to where `from` becomes `to` by the shortest turn; both of length 1.
fn carried(v: DVec3, from: DVec3, to: DVec3) -> DVec3 {
    v - (from + to) * (to.dot(v) / chi(from, to))
}

/// The angle of a sine and a cosine, in radians.
fn angle(sine: f64, cosine: f64) -> f64 {
    if cosine < 0.87 {
        return libm::atan2(sine, cosine);
    }
    // Twice the arc tangent of the half angle's tangent, which is at most 0.27: the rest of the series is below 1e-10.
    let t = sine / (1.0 + cosine);
    let s = t * t;
    let tail = 1.0 / 9.0 - s * (1.0 / 11.0 - s * (1.0 / 13.0 - s / 15.0));
    2.0 * t * (1.0 - s * (1.0 / 3.0 - s * (0.2 - s * (1.0 / 7.0 - s * tail))))
}

/// `angle` plus the number of whole turns that brings it next to `near`.
fn unwrapped(angle: f64, near: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    if (near - angle).abs() <= PI { angle } else { angle + TAU * ((near - angle) / TAU).round() }
}

impl Rod {
    /// A straight or bent rod through `positions`, without twist; `side` is the first edge's director, made to be at
    /// right angles to it.
    ///
    /// # Panics
    /// When there are fewer than two nodes, or not a section for each.
    pub fn new(positions: Vec<DVec3>, sections: Vec<Section>, side: DVec3) -> Self {
        assert!(positions.len() >= 2 && positions.len() == sections.len(), "a rod has a section for each of its nodes");
        let count = positions.len();
        let mut rod = Self {
            velocities: vec![DVec3::ZERO; count],
            held: vec![Held::default(); count],
            start: positions.clone(),
            spins: vec![0.0; count],
            turns: vec![0.0; count],
            twists: vec![0.0; count],
            positions,
            sections,
            ..Self::default()
        };
        let mut director = side;
        let mut before = None;
        for i in 0..count - 1 {
            let tangent = (rod.positions[i + 1] - rod.positions[i]).normalize_or(DVec3::Z);
            director = match before {
                None => director.reject_from_normalized(tangent).try_normalize(),
                Some(before) => Some(carried(director, before, tangent)),
            }
            .unwrap_or_else(|| tangent.any_orthonormal_vector());
            rod.frames.push([tangent, director]);
            before = Some(tangent);
        }
        rod.refresh();
        rod
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Adds a node after the last, on from it; `director` is that of the new edge.
    pub fn push(&mut self, position: DVec3, section: Section, director: DVec3) {
        let last = self.positions[self.len() - 1];
        let tangent = (position - last).normalize_or(DVec3::Z);
        self.positions.push(position);
        self.velocities.push(DVec3::ZERO);
        self.sections.push(section);
        self.held.push(Held::default());
        self.start.push(position);
        self.spins.push(0.0);
        self.turns.push(0.0);
        self.twists.push(0.0);
        let across = director.reject_from_normalized(tangent).try_normalize();
        self.frames.push([tangent, across.unwrap_or_else(|| tangent.any_orthonormal_vector())]);
        self.refresh();
        self.twists[self.positions.len() - 2] = self.twist(self.positions.len() - 2);
    }

    /// Takes the last node off.
    pub fn pop(&mut self) {
        let count = self.len() - 1;
        self.positions.truncate(count);
        self.velocities.truncate(count);
        self.sections.truncate(count);
        self.held.truncate(count);
        self.start.truncate(count);
        self.spins.truncate(count);
        self.turns.truncate(count);
        self.twists.truncate(count);
        self.frames.truncate(count - 1);
        self.refresh();
    }

    /// The director of an edge as it is now.
    pub fn director(&self, edge: usize) -> DVec3 {
        self.edges[edge].m1
    }

    /// The tangent of an edge as it is now, away from the tip.
    pub fn tangent(&self, edge: usize) -> DVec3 {
        self.edges[edge].tangent
    }

    /// Where a node was at the start of the step.
    pub fn start(&self, node: usize) -> DVec3 {
        self.start[node]
    }

    /// How far an edge has turned about its tangent since the start of the step, in radians.
    pub fn spin(&self, edge: usize) -> f64 {
        self.spins[edge]
    }

    /// Sets how far the frame of an edge whose angle is held turns in this step, in radians.
    pub fn turn_to(&mut self, edge: usize, angle: f64) {
        self.spins[edge] = angle;
    }

    /// Works out edges and frames from the positions.
    pub fn refresh(&mut self) {
        self.edges.resize(self.len() - 1, Edge::default());
        for (i, edge) in self.edges.iter_mut().enumerate() {
            let along = self.positions[i + 1] - self.positions[i];
            let length = along.length();
            let [before, director] = self.frames[i];
            let tangent = if length > 0.0 { along / length } else { before };
            let across = carried(director, before, tangent);
            let m1 = if self.spins[i] == 0.0 {
                across
            } else {
                let (sine, cosine) = libm::sincos(self.spins[i]);
                across * cosine + tangent.cross(across) * sine
            };
            *edge = Edge { length, inverse: 1.0 / length, tangent, m1, m2: tangent.cross(m1) };
        }
        self.strains.resize(self.len(), Strain::default());
        for i in 1..self.edges.len() {
            let (a, b) = (&self.edges[i - 1], &self.edges[i]);
            let inverse = 1.0 / chi(a.tangent, b.tangent);
            let binormal = a.tangent.cross(b.tangent) * (2.0 * inverse);
            let director = carried(a.m1, a.tangent, b.tangent);
            let twist = unwrapped(angle(-director.dot(b.m2), director.dot(b.m1)), self.twists[i]);
            self.strains[i] = Strain {
                towards: 0.5 * binormal.dot(a.m2 + b.m2),
                across: -0.5 * binormal.dot(a.m1 + b.m1),
                binormal,
                squared: binormal.length_squared(),
                inverse,
                twist,
            };
        }
    }

    /// The twist at an inner node, in radians.
    pub fn twist(&self, node: usize) -> f64 {
        self.strains[node].twist
    }

    /// The discrete curvature at an inner node: towards the director, and across.
    pub fn curvature(&self, node: usize) -> [f64; 2] {
        [self.strains[node].towards, self.strains[node].across]
    }

    /// Elastic energy in N mm.
    pub fn energy(&self) -> f64 {
        let stretch = |i: usize| {
            let section = &self.sections[i];
            let strain = self.edges[i].length / section.length - 1.0;
            0.5 * section.ea * section.length * strain * strain
        };
        let bend = |i: usize| {
            let section = &self.sections[i];
            let [r1, r2] = section.rest;
            let Strain { towards, across, twist, squared, .. } = self.strains[i];
            let bend = squared - 2.0 * (r1 * towards + r2 * across) + r1 * r1 + r2 * r2;
            0.5 / section.cell * (section.ei * bend + section.gj * twist * twist)
        };
        (0..self.len() - 1).map(stretch).sum::<f64>() + (1..self.len() - 1).map(bend).sum::<f64>()
    }

    /// Sets up the equations of a step of `dt` seconds at the present positions; an infinite `dt` asks for rest.
    /// `brake` is drag beyond that of the nodes, in N s/mm each.
    pub fn assemble(&mut self, dt: f64, brake: f64, hessian: Hessian) {
        let rows = self.len() * PER_NODE;
        self.band.reset(self.positions.len());
        self.gradient.clear();
        self.gradient.resize(rows, 0.0);
        self.add_inertia(dt, brake);
        for &(node, force) in &self.forces {
            for axis in 0..3 {
                self.gradient[node * PER_NODE + axis] -= force[axis];
            }
        }
        for &(edge, moment) in &self.moments {
            self.gradient[edge * PER_NODE + 3] -= moment;
        }
        (0..self.edges.len()).for_each(|i| self.add_stretch(i, hessian));
        (1..self.edges.len()).for_each(|i| self.add_bend(i, hessian));
    }

    /// Works out the elastic part of the gradient anew from node `first + 2` on, for [`Self::holding_force`] and
    /// [`Self::holding_moment`] there.
    pub fn assemble_from(&mut self, first: usize) {
        let rows = self.len() * PER_NODE;
        self.band.reset(self.positions.len());
        self.gradient.clear();
        self.gradient.resize(rows, 0.0);
        (first..self.edges.len()).for_each(|i| self.add_stretch(i, Hessian::Safe));
        (first.max(1)..self.edges.len()).for_each(|i| self.add_bend(i, Hessian::Safe));
    }

    fn add_inertia(&mut self, dt: f64, brake: f64) {
        let inverse = if dt.is_finite() { 1.0 / dt } else { 0.0 };
        for i in 0..self.len() {
            let Section { mass, drag, .. } = self.sections[i];
            let (inertia, drag) = (mass * inverse * inverse, (drag + brake) * inverse);
            let moved = self.positions[i] - self.start[i];
            let way = if dt.is_finite() { self.velocities[i] * dt } else { DVec3::ZERO };
            let force = (moved - way) * inertia + moved * drag;
            for axis in 0..3 {
                self.gradient[i * PER_NODE + axis] += force[axis];
                self.band.add(i, axis, inertia + drag);
            }
        }
        // The last node has no edge.
        self.band.add(self.len() - 1, 3, 1.0);
    }

    fn add_stretch(&mut self, i: usize, hessian: Hessian) {
        let Section { length, ea, .. } = self.sections[i];
        let edge = self.edges[i];
        let tension = ea * (edge.length / length - 1.0);
        let t = edge.tangent;
        let first = i * PER_NODE;
        let pull = t * tension;
        for (axis, pull) in pull.to_array().into_iter().enumerate() {
            self.gradient[first + axis] -= pull;
            self.gradient[first + PER_NODE + axis] += pull;
        }
        // Under tension it is stiff across, too, and under pressure it gives way.
        let across = if tension > 0.0 || hessian != Hessian::Safe { tension / edge.length } else { 0.0 };
        let along = t * (ea / length - across);
        let stiffness = DMat3::from_cols(along * t.x, along * t.y, along * t.z);
        self.band.add_edge(i, &(stiffness + DMat3::from_diagonal(DVec3::splat(across))));
    }

    fn add_bend(&mut self, i: usize, hessian: Hessian) {
        let (section, strain) = (self.sections[i], self.strains[i]);
        let (a, b) = (self.edges[i - 1], self.edges[i]);
        let slopes = Slopes::new(&a, &b, &strain);
        let (bend, twist) = (section.ei / section.cell, section.gj / section.cell * strain.twist);
        let mut by_edges = [0, 1].map(|e| slopes.bent[e] * bend + slopes.twisted[e] * twist);
        let mut by_angles = [-twist, twist];
        if section.rest != [0.0; 2] {
            for ((by_edge, by_angle), rest) in curvature_slopes(&a, &b, &strain).into_iter().zip(section.rest) {
                by_edges = [0, 1].map(|e| by_edges[e] - by_edge[e] * (bend * rest));
                by_angles = [0, 1].map(|e| by_angles[e] - by_angle[e] * (bend * rest));
            }
        }
        let first = (i - 1) * PER_NODE;
        let [before, behind] = by_edges;
        let middle = before - behind;
        let [angle_a, angle_b] = by_angles;
        let pulls = [
            -before.x, -before.y, -before.z, angle_a, middle.x, middle.y, middle.z, angle_b, behind.x, behind.y,
            behind.z,
        ];
        for (entry, pull) in self.gradient[first..].iter_mut().zip(pulls) {
            *entry += pull;
        }
        self.band.add_bend(i - 1, &Blocks::new(&a, &b, &section, &strain, &slopes, hessian));
    }

    /// Adds a spring to the equations: `pull` is its derivative by positions and angle of node `node` and by the position
    /// of the next, `force` what it pulls with along that, `stiffness` its stiffness.
    pub fn add_spring(&mut self, node: usize, pull: &[f64; 7], force: f64, stiffness: f64) {
        let first = node * PER_NODE;
        for (entry, pull) in self.gradient[first..].iter_mut().zip(pull) {
            *entry += force * pull;
        }
        self.band.add_square(node, pull, stiffness);
    }

    /// What it takes to hold a node where it is, in N: the gradient of all that was assembled.
    pub fn holding_force(&self, node: usize) -> DVec3 {
        DVec3::from_slice(&self.gradient[node * PER_NODE..node * PER_NODE + 3])
    }

    /// The moment that it takes to hold an edge's frame, in N mm about the tangent.
    pub fn holding_moment(&self, edge: usize) -> f64 {
        self.gradient[edge * PER_NODE + 3]
    }

    /// What a step makes least: elastic energy, loads, and what stands for inertia and drag, in N mm.
    pub fn potential(&self, dt: f64, brake: f64) -> f64 {
        let inverse = if dt.is_finite() { 1.0 / dt } else { 0.0 };
        let motion = |i: usize| {
            let Section { mass, drag, .. } = self.sections[i];
            let moved = self.positions[i] - self.start[i];
            let way = if dt.is_finite() { self.velocities[i] * dt } else { DVec3::ZERO };
            0.5 * (mass * inverse * inverse * (moved - way).length_squared()
                + (drag + brake) * inverse * moved.length_squared())
        };
        let pulled: f64 = self.forces.iter().map(|&(node, force)| force.dot(self.positions[node])).sum();
        let turned: f64 = self.moments.iter().map(|&(edge, moment)| moment * self.spins[edge]).sum();
        self.energy() + (0..self.len()).map(motion).sum::<f64>() - pulled - turned
    }

    /// Goes on from the start of the step for `dt` seconds as in the step before; what is held stays.
    pub fn predict(&mut self, dt: f64) {
        for i in (0..self.len()).filter(|&i| !self.held[i].position) {
            self.positions[i] = self.start[i] + self.velocities[i] * dt;
        }
        for i in (0..self.len()).filter(|&i| !self.held[i].angle) {
            self.spins[i] = self.turns[i] * dt;
        }
        self.refresh();
    }

    /// Ends a time step: what is now becomes the start of the next.
    pub fn finish(&mut self, dt: f64) {
        for i in 0..self.len() {
            let moved = self.positions[i] - self.start[i];
            self.velocities[i] = if dt.is_finite() { moved / dt } else { DVec3::ZERO };
        }
        for i in 1..self.len() - 1 {
            self.twists[i] = self.twist(i);
        }
        for (frame, edge) in self.frames.iter_mut().zip(&self.edges) {
            // Rounding adds up over many steps.
            *frame = [edge.tangent, edge.m1.reject_from_normalized(edge.tangent).normalize_or(edge.m1)];
        }
        self.start.clone_from(&self.positions);
        for (turn, spin) in self.turns.iter_mut().zip(&self.spins) {
            *turn = if dt.is_finite() { spin / dt } else { 0.0 };
        }
        self.spins.fill(0.0);
        self.refresh();
    }

    /// Goes back to the start of the step, where everything stands still.
    pub fn undo(&mut self) {
        self.positions.clone_from(&self.start);
        self.velocities.fill(DVec3::ZERO);
        self.turns.fill(0.0);
        self.spins.fill(0.0);
        self.refresh();
    }
}

/// `1 + cos` of the turn; never 0.
fn chi(a: DVec3, b: DVec3) -> f64 {
    (1.0 + a.dot(b)).max(1e-6)
}
