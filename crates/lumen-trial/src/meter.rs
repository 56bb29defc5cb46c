//! What is measured of a trial while it goes on.

use glam::DVec3;

use super::report::{StepCounts, StepKind, StepReport};
use super::route::Route;
use super::simulation::Simulation;

/// What is at the tip, in mm from it.
const TIP: f64 = 5.0;

/// The forces of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forces {
    /// As in [`StepReport::push_n`].
    pub push_n: f64,
    /// As in [`StepReport::torque_n_mm`].
    pub torque_n_mm: f64,
    /// Places where it presses against the vessel.
    pub contacts: usize,
    /// Sum over the wall of the normal forces, in N.
    pub wall_force_n: f64,
    /// The largest at one place, in N, and where.
    pub max_wall_force_n: f64,
    /// In mm.
    pub max_at: DVec3,
    /// The part within 5 mm of the tip, in N.
    pub tip_force_n: f64,
}

impl Forces {
    fn of(simulation: &Simulation) -> Self {
        let [push_n, torque_n_mm] = simulation.push_and_torque();
        let (mut forces, grid) = (Self { push_n, torque_n_mm, ..Self::default() }, simulation.grid());
        for (node, at, _, force) in simulation.body().touches() {
            forces.contacts += 1;
            forces.wall_force_n += force;
            if force > forces.max_wall_force_n {
                (forces.max_wall_force_n, forces.max_at) = (force, at);
            }
            if grid[node] <= TIP {
                forces.tip_force_n += force;
            }
        }
        forces
    }
}

/// What the steps since the last row of the log came to.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SinceRow {
    /// Their kinds.
    pub counts: StepCounts,
    /// What was to be fed, and what was, in mm.
    pub wanted_mm: f64,
    /// In mm.
    pub fed_mm: f64,
    /// The largest residual, in N.
    pub residual_n: f64,
    /// The largest force at one place of the wall in a balanced step, in N, and where.
    pub max_wall_force_n: f64,
    /// In mm.
    pub max_at: DVec3,
}

/// Running sums and maxima: of forces, by the steps that were balanced alone.
#[derive(Clone, Debug, Default)]
pub struct Meter {
    /// Arc length of each station in mm, and the step at which the tip passed it first.
    pub(super) stations: Vec<(f64, Option<usize>)>,
    /// Steps so far, by kind.
    pub counts: StepCounts,
    /// The forces of the last balanced step.
    pub forces: Forces,
    /// What there was since the last row of the log.
    pub since_row: SinceRow,
    /// Sums over balanced steps.
    pub(super) wall_force_sum: f64,
    pub(super) tip_force_sum: f64,
    /// The sum over all steps of what the last balanced one had.
    pub(super) wall_force_kept_sum: f64,
    pub(super) wanted_mm: f64,
    pub(super) fed_mm: f64,
    pub(super) max_residual_n: f64,
    pub(super) max_wall_force_n: f64,
    pub(super) max_tip_force_n: f64,
    pub(super) max_push_n: f64,
    pub(super) max_torque_n_mm: f64,
    pub(super) max_depth: f64,
    /// As in [`Simulation::length_errors`]: the sum and the largest of the first, the largest of the second.
    pub(super) length_error_sum: f64,
    pub(super) max_length_error: f64,
    pub(super) max_element_error: f64,
    pub(super) max_inserted: f64,
    pub(super) max_nodes: usize,
    pub(super) max_contact_share: f64,
    tip: Option<DVec3>,
    /// Length of the tip's way in mm.
    pub path_mm: f64,
    /// Times withdrawn.
    pub retractions: u32,
    /// Times in a branch off the route.
    pub wrong_branches: u32,
    /// Times turned back on itself.
    pub loops: u32,
    /// Steps that were looked ahead.
    pub looked_ahead: u64,
}

impl Meter {
    pub(super) fn new(route: &Route) -> Self {
        Self { stations: route.stations.iter().map(|&arc| (arc, None)).collect(), ..Self::default() }
    }

    /// Takes a step in.
    pub(super) fn stepped(&mut self, report: &StepReport, simulation: &Simulation) {
        self.counts.count(report.kind);
        self.wanted_mm += report.wanted_mm.abs();
        self.fed_mm += report.fed_mm.abs();
        self.max_depth = self.max_depth.max(simulation.body().depth);
        let [of_wire, of_element] = simulation.length_errors();
        self.length_error_sum += of_wire;
        self.max_length_error = self.max_length_error.max(of_wire);
        self.max_element_error = self.max_element_error.max(of_element);
        let row = &mut self.since_row;
        row.counts.count(report.kind);
        row.wanted_mm += report.wanted_mm;
        row.fed_mm += report.fed_mm;
        row.residual_n = row.residual_n.max(report.residual_n);
        if report.kind == StepKind::Balanced {
            let forces = Forces::of(simulation);
            if forces.max_wall_force_n > row.max_wall_force_n {
                (row.max_wall_force_n, row.max_at) = (forces.max_wall_force_n, forces.max_at);
            }
            self.wall_force_sum += forces.wall_force_n;
            self.tip_force_sum += forces.tip_force_n;
            self.max_residual_n = self.max_residual_n.max(report.residual_n);
            self.max_wall_force_n = self.max_wall_force_n.max(forces.max_wall_force_n);
            self.max_tip_force_n = self.max_tip_force_n.max(forces.tip_force_n);
            self.max_push_n = self.max_push_n.max(forces.push_n);
            self.max_torque_n_mm = self.max_torque_n_mm.max(forces.torque_n_mm.abs());
            self.forces = forces;
        }
        self.wall_force_kept_sum += self.forces.wall_force_n;
    }

    /// Takes in where the tip was found.
    pub(super) fn looked(&mut self, simulation: &Simulation, arc: f64) {
        let step = simulation.steps() as usize;
        for (at, passed) in &mut self.stations {
            if arc >= *at && passed.is_none() {
                *passed = Some(step);
            }
        }
        let tip = simulation.tip();
        self.path_mm += self.tip.map_or(0.0, |before| before.distance(tip));
        self.tip = Some(tip);
        self.max_inserted = self.max_inserted.max(simulation.inserted());
        let nodes = simulation.count();
        self.max_nodes = self.max_nodes.max(nodes);
        let mut touching: Vec<usize> = simulation.body().touches().map(|touch| touch.0).collect();
        touching.dedup();
        touching.sort_unstable();
        touching.dedup();
        self.max_contact_share = self.max_contact_share.max(touching.len() as f64 / nodes.max(1) as f64);
    }
}
