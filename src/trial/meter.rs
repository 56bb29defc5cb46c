//! What is measured of a trial while it goes on, and its summary.

use glam::DVec3;

use super::STEP;
use super::frame::{Progress, StationResult, StepTimes, Summary};
use super::report::{StepCounts, StepKind, StepReport};
use super::route::Route;
use super::session::Trial;
use super::simulation::Simulation;

/// Version of the fields of [`Summary`] and of the columns of the log.
pub const SCHEMA: u32 = 2;
/// Steps in a second of simulated time.
const SECOND: usize = (1.0 / STEP + 0.5) as usize;
/// Steps in 1/60 s of simulated time.
const FRAME_STEPS: f64 = 1.0 / 60.0 / STEP;

/// What is at the tip, in mm from it.
const TIP: f64 = 5.0;

/// The forces of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forces {
    /// At the guide: in N, and in N mm.
    pub push_n: f64,
    /// About the way in.
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
#[derive(Clone, Debug)]
pub struct Meter {
    /// Milliseconds of each step.
    step_ms: Vec<f32>,
    stations: Vec<(f64, Option<usize>)>,
    /// Steps so far, by kind.
    pub counts: StepCounts,
    /// The forces of the last balanced step.
    pub forces: Forces,
    /// What there was since the last row of the log.
    pub since_row: SinceRow,
    /// Sums over balanced steps.
    wall_force_sum: f64,
    tip_force_sum: f64,
    /// The sum over all steps of what the last balanced one had.
    wall_force_held_sum: f64,
    wanted_mm: f64,
    fed_mm: f64,
    max_residual_n: f64,
    max_wall_force_n: f64,
    max_tip_force_n: f64,
    max_push_n: f64,
    max_torque_n_mm: f64,
    max_depth: f64,
    max_inserted: f64,
    max_nodes: usize,
    max_contact_share: f64,
    tip: Option<DVec3>,
    /// Length of the tip's way in mm.
    pub path_mm: f64,
    /// Times withdrawn.
    pub retractions: u32,
    /// Times in a branch off the route.
    pub wrong_branches: u32,
    /// Times turned back on itself.
    pub loops: u32,
}

impl Meter {
    pub(super) fn new(route: &Route) -> Self {
        Self {
            step_ms: Vec::new(),
            stations: route.stations.iter().map(|&arc| (arc, None)).collect(),
            counts: StepCounts::default(),
            forces: Forces::default(),
            since_row: SinceRow::default(),
            wall_force_sum: 0.0,
            tip_force_sum: 0.0,
            wall_force_held_sum: 0.0,
            wanted_mm: 0.0,
            fed_mm: 0.0,
            max_residual_n: 0.0,
            max_wall_force_n: 0.0,
            max_tip_force_n: 0.0,
            max_push_n: 0.0,
            max_torque_n_mm: 0.0,
            max_depth: 0.0,
            max_inserted: 0.0,
            max_nodes: 0,
            max_contact_share: 0.0,
            tip: None,
            path_mm: 0.0,
            retractions: 0,
            wrong_branches: 0,
            loops: 0,
        }
    }

    pub(super) fn stepped(&mut self, ms: f64, report: &StepReport, simulation: &Simulation) {
        self.step_ms.push(ms as f32);
        self.counts.count(report.kind);
        self.wanted_mm += report.wanted_mm.abs();
        self.fed_mm += report.fed_mm.abs();
        self.max_depth = self.max_depth.max(simulation.body().depth);
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
        self.wall_force_held_sum += self.forces.wall_force_n;
    }

    pub(super) fn looked(&mut self, simulation: &Simulation, arc: f64) {
        let step = self.step_ms.len();
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

    /// The milliseconds of each step, which this then has no more.
    pub(super) fn take_step_ms(&mut self) -> Vec<f32> {
        std::mem::take(&mut self.step_ms)
    }

    /// Takes back the milliseconds of each step, as far as this has counted steps.
    pub(super) fn give_step_ms(&mut self, mut step_ms: Vec<f32>) {
        step_ms.truncate(self.counts.all() as usize);
        self.step_ms = step_ms;
    }

    /// Mean milliseconds of the last `count` steps.
    pub(super) fn last_ms(&self, count: usize) -> f64 {
        mean(&self.step_ms[self.step_ms.len().saturating_sub(count)..])
    }

    /// Milliseconds of all steps together.
    pub fn total_ms(&self) -> f64 {
        self.step_ms.iter().map(|&ms| f64::from(ms)).sum()
    }

    fn times(&self) -> StepTimes {
        let mut sorted = self.step_ms.clone();
        sorted.sort_by(f32::total_cmp);
        let at = |part: f64| sorted.get(((sorted.len() as f64 * part) as usize).min(sorted.len().max(1) - 1));
        let at = |part: f64| at(part).map_or(0.0, |&ms| f64::from(ms));
        StepTimes { mean: mean(&self.step_ms), p50: at(0.5), p99: at(0.99), max: at(1.0) }
    }

    fn station(&self, arc_mm: f64, passed: Option<usize>) -> StationResult {
        let around = passed.map(|step| {
            let from = step.saturating_sub(SECOND / 2);
            let to = (step + SECOND / 2).min(self.step_ms.len());
            mean(&self.step_ms[from..to])
        });
        StationResult {
            arc_mm,
            time_s: passed.map(|step| step as f64 * STEP),
            steps_per_second: around.map(|ms| 1e3 / ms.max(1e-6)),
            simulation_ms: around.map(|ms| ms * FRAME_STEPS),
        }
    }
}

fn mean(values: &[f32]) -> f64 {
    values.iter().map(|&value| f64::from(value)).sum::<f64>() / values.len().max(1) as f64
}

impl Trial {
    /// What came of it, up to now.
    pub fn summary(&self) -> Summary {
        let (meter, course, simulation) = (self.meter(), self.course(), self.simulation());
        let steps = simulation.steps();
        let route = &course.route;
        let tip_distance_mm = route.distance_to_target(simulation.tip());
        let time_s = steps as f64 * STEP;
        let per = |sum: f64, count: u64| sum / count.max(1) as f64;
        Summary {
            schema: SCHEMA,
            success: self.progress() == Progress::Arrived,
            reason: match self.progress() {
                Progress::Running => format!("not over yet: the tip is {tip_distance_mm:.1} mm from the target"),
                Progress::Arrived => format!("the tip arrived after {time_s:.1} s"),
                Progress::TimedOut => format!(
                    "the autopilot's time of {:.0} s was over with the tip {tip_distance_mm:.1} mm from the target",
                    self.limit_s()
                ),
                Progress::Over => {
                    format!("the recorded input was over with the tip {tip_distance_mm:.1} mm from the target")
                }
                Progress::GaveUp => format!(
                    "the autopilot gave up after {} retractions with the tip {tip_distance_mm:.1} mm from the target",
                    meter.retractions
                ),
            },
            time_s,
            steps,
            steps_per_second: 1e3 * steps as f64 / meter.total_ms().max(1e-6),
            step_ms: meter.times(),
            stations: meter.stations.iter().map(|&(arc, passed)| meter.station(arc, passed)).collect(),
            initial_simulation_ms: mean(&meter.step_ms[..meter.step_ms.len().min(SECOND)]) * FRAME_STEPS,
            wall_build_ms: course.wall_ms,
            route_build_ms: course.route_ms,
            triangles: course.wall.mesh().triangles.len(),
            surface: format!("{:016x}", course.fingerprint),
            wire: self.setup().wire.name.clone(),
            entry: self.setup().entry,
            target: self.setup().target,
            load_n_per_mm: self.setup().load,
            press: self.setup().press,
            seed: self.setup().seed,
            friction: self.friction(),
            route_length_mm: route.length_mm,
            route_smallest_radius_mm: route.smallest_radius_mm,
            route_tortuosity: route.tortuosity,
            branches_passed: route.branches_passed,
            tip_distance_mm,
            path_ratio: meter.path_mm / route.length_mm,
            retractions: meter.retractions,
            wrong_branches: meter.wrong_branches,
            loops: meter.loops,
            max_wall_force_n: meter.max_wall_force_n,
            mean_wall_force_n: per(meter.wall_force_sum, meter.counts.balanced),
            wall_impulse_n_s: meter.wall_force_held_sum * STEP,
            max_tip_force_n: meter.max_tip_force_n,
            mean_tip_force_n: per(meter.tip_force_sum, meter.counts.balanced),
            max_push_n: meter.max_push_n,
            max_torque_n_mm: meter.max_torque_n_mm,
            step_kinds: meter.counts,
            unbalanced_share: meter.counts.unbalanced_share(),
            wanted_feed_mm: meter.wanted_mm,
            fed_mm: meter.fed_mm,
            max_residual_n: meter.max_residual_n,
            max_penetration_mm: meter.max_depth.max(0.0),
            max_inserted_mm: meter.max_inserted,
            max_nodes: meter.max_nodes,
            max_contact_share: meter.max_contact_share,
            notice: "Not for clinical decisions.".to_owned(),
        }
    }
}
