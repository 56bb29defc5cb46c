//! The rod as it is: nodes, the frames of its edges, and what a step and a change of it have come to.

use glam::DVec3;

use super::band::Band;
use super::coupling::Coupled;
use super::frame::{Edge, Strain, carried};
use super::section::{Fixed, Section};

/// A rod, at rest or on its way through a time step.
#[derive(Clone, Debug, Default)]
pub struct Rod {
    /// Position of each node in mm.
    pub positions: Vec<DVec3>,
    /// Velocities in mm/s.
    pub velocities: Vec<DVec3>,
    /// Stiffness and rest shape.
    pub sections: Vec<Section>,
    /// What is fixed.
    pub fixed: Vec<Fixed>,
    /// Forces on nodes, in N.
    pub forces: Vec<(usize, DVec3)>,
    /// Moments about the tangents of edges, in N mm.
    pub moments: Vec<(usize, f64)>,
    /// Where the nodes were at the start of the step.
    pub(super) start: Vec<DVec3>,
    /// Tangent and director of each edge at the start of the step.
    pub(super) frames: Vec<[DVec3; 2]>,
    /// How far each edge has turned about its tangent in the step, in radians.
    pub(super) spins: Vec<f64>,
    /// How fast each edge turned in the step before, in rad/s.
    pub(super) turns: Vec<f64>,
    /// The twist at each node when it was last looked at: it may pass half a turn.
    pub(super) twists: Vec<f64>,
    pub(super) edges: Vec<Edge>,
    /// Of each inner node.
    pub(super) strains: Vec<Strain>,
    pub(super) gradient: Vec<f64>,
    pub(super) band: Band,
    /// The model: the equations without springs, and their gradient at the change so far; where rows are fixed, nothing.
    pub(super) model: Band,
    pub(super) model_gradient: Vec<f64>,
    /// The search direction that was found last, and the change that has come of them so far.
    pub(super) direction: Vec<f64>,
    pub(super) change: Vec<f64>,
    /// Working memory of couplings.
    pub(super) coupled: Coupled,
    /// Positions and spins from which the change leads on.
    pub(super) base: (Vec<DVec3>, Vec<f64>),
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
            fixed: vec![Fixed::default(); count],
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
        self.fixed.push(Fixed::default());
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
        self.fixed.truncate(count);
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

    /// Length of an edge as it is now, in mm.
    pub fn length(&self, edge: usize) -> f64 {
        self.edges[edge].length
    }

    /// Where a node was at the start of the step.
    pub fn start(&self, node: usize) -> DVec3 {
        self.start[node]
    }

    /// How far an edge has turned about its tangent since the start of the step, in radians.
    pub fn spin(&self, edge: usize) -> f64 {
        self.spins[edge]
    }

    /// Sets how far the frame of an edge whose angle is fixed turns in this step, in radians.
    pub fn turn_to(&mut self, edge: usize, angle: f64) {
        self.spins[edge] = angle;
    }

    /// Works out edges and frames from the positions.
    pub fn refresh(&mut self) {
        self.edges.resize(self.len() - 1, Edge::default());
        for (i, edge) in self.edges.iter_mut().enumerate() {
            *edge = Edge::new(self.positions[i], self.positions[i + 1], self.frames[i], self.spins[i]);
        }
        self.strains.resize(self.len(), Strain::default());
        for i in 1..self.edges.len() {
            self.strains[i] = Strain::new(&self.edges[i - 1], &self.edges[i], self.twists[i]);
        }
    }

    /// The twist at an inner node, in radians.
    pub fn twist(&self, node: usize) -> f64 {
        self.strains[node].twist
    }

    /// At least the angle between the edges at a node, in radians; 0 at the ends.
    pub fn turn(&self, node: usize) -> f64 {
        self.strains[node].squared.sqrt()
    }

    /// The discrete curvature at an inner node: towards the director, and across.
    pub fn curvature(&self, node: usize) -> [f64; 2] {
        [self.strains[node].towards, self.strains[node].across]
    }
}
