//! What came of a trial.

use serde::{Deserialize, Serialize};

use super::STEP;
use super::frame::Progress;
use super::log::SCHEMA;
use super::missed::MissedForkText;
use super::report::StepCounts;
use super::session::Trial;
use super::setup::{Entry, Press};
use super::stopwatch::{StationResult, StepTimes};
use lumen_message::{grouped, messages};

/// What came of a trial.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Version of this list of fields.
    pub schema: u32,
    /// Whether the tip arrived.
    pub success: bool,
    /// Why it ended, as a clause in English: see [`Trial::end`].
    pub reason: String,
    /// The fork that was missed, where it did not arrive for that: where the tip left the route, in mm.
    pub missed_fork_at: Option<[f32; 3]>,
    /// Simulated seconds.
    pub time_s: f64,
    /// Steps.
    pub steps: u64,
    /// Steps a second of the clock, over all of it.
    pub steps_per_second: f64,
    /// Times of single steps.
    pub step_ms: StepTimes,
    /// Five places at equal arc length.
    pub stations: Vec<StationResult>,
    /// Milliseconds of 1/60 s of simulated time, over the first simulated second.
    pub initial_simulation_ms: f64,
    /// Milliseconds to build the hierarchy of boxes over the wall.
    pub wall_build_ms: f64,
    /// Milliseconds to find the vessel tree and the route.
    pub route_build_ms: f64,
    /// Triangles of the wall.
    pub triangles: usize,
    /// A number that differs where surfaces do, in hexadecimal.
    pub surface: String,
    /// The wire's name: of the last one that was in, where others went in before it.
    pub wire: String,
    /// The names of the wires that failed before it, in turn.
    pub failed_wires: Vec<String>,
    /// What the tip of the first of them does not reach, as a sentence in English.
    pub reach: Option<String>,
    /// Where it entered, before the seed varies that.
    pub entry: Option<Entry>,
    /// Where it should go, in mm.
    pub target: Option<[f32; 3]>,
    /// Load on each mm of the wire, in N.
    pub load_n_per_mm: [f32; 3],
    /// What pressed it to the wall.
    pub press: Press,
    /// The seed.
    pub seed: u64,
    /// Static and kinetic coefficient of friction, after the seed's variation.
    pub friction: [f64; 2],
    /// Length of the route in mm.
    pub route_length_mm: f64,
    /// The smallest radius of the lumen along the route, in mm.
    pub route_smallest_radius_mm: f64,
    /// Length over the straight distance between its ends.
    pub route_tortuosity: f64,
    /// Branches that the route passes.
    pub branches_passed: usize,
    /// Distance of the tip from the target at the end, in mm.
    pub tip_distance_mm: f64,
    /// Length of the tip's way over the route's length.
    pub path_ratio: f64,
    /// Times the wire was withdrawn.
    pub retractions: u32,
    /// Times the tip entered a branch off the route.
    pub wrong_branches: u32,
    /// Times the wire turned back on itself.
    pub loops: u32,
    /// Steps that were looked ahead, beside those of the trial.
    #[serde(default)]
    pub steps_looked_ahead: u64,
    /// Steps by kind. The forces below are of those that were balanced.
    pub step_kinds: StepCounts,
    /// The part of the steps that was not balanced.
    pub unbalanced_share: f64,
    /// The way that the input asked the feed to go, there and back, in mm.
    pub wanted_feed_mm: f64,
    /// What of it was fed: the rest was asked for while the guide waited, was at the limit of its push or at an end of the wire.
    pub fed_mm: f64,
    /// By how much Newton's second law was missed at most in a balanced step, in N.
    pub max_residual_n: f64,
    /// Largest normal force at one place of the wall, in N.
    pub max_wall_force_n: f64,
    /// Mean over the balanced steps of the sum of normal forces, in N.
    pub mean_wall_force_n: f64,
    /// Integral over time of that sum, in N s; while a step is not balanced, that of the last one which was counts.
    pub wall_impulse_n_s: f64,
    /// Largest and mean force within 5 mm of the tip, in N.
    pub max_tip_force_n: f64,
    /// Mean of it.
    pub mean_tip_force_n: f64,
    /// Largest push at the guide, in N.
    pub max_push_n: f64,
    /// Largest moment at the guide, in N mm.
    pub max_torque_n_mm: f64,
    /// How far the wire ever reached into the wall, in mm.
    pub max_penetration_mm: f64,
    /// How far the wire outside the guide differed from its length at rest, in percent: mean over all steps.
    #[serde(default)]
    pub mean_length_error_percent: f64,
    /// And at most.
    #[serde(default)]
    pub max_length_error_percent: f64,
    /// The same of a single element, at most.
    #[serde(default)]
    pub max_element_error_percent: f64,
    /// Largest length outside the guide, in mm.
    pub max_inserted_mm: f64,
    /// Largest number of nodes outside the guide.
    pub max_nodes: usize,
    /// Largest part of them against the wall.
    pub max_contact_share: f64,
    /// The sentence that stands in every report.
    pub notice: String,
}

messages! {
    /// How a trial ended, as a clause.
    #[derive(Clone, Debug, PartialEq)]
    pub enum TrialEnd {
        /// It goes on.
        "trial-end-running" Running {
            /// From the tip to the target, in mm.
            away: f64 [1],
        } => "not over yet: the tip is {away:.1} mm from the target",
        /// The tip arrived.
        "trial-end-arrived" Arrived {
            /// Simulated seconds.
            time: f64 [1],
        } => "the tip arrived after {time:.1} s",
        /// The autopilot's time was over.
        "trial-end-timed-out" TimedOut {
            /// That time, in simulated seconds.
            limit: f64 [0],
            /// From the tip to the target, in mm.
            away: f64 [1],
        } => "the autopilot's time of {limit:.0} s was over with the tip {away:.1} mm from the target",
        /// The recorded input was over.
        "trial-end-over" Over {
            /// From the tip to the target, in mm.
            away: f64 [1],
        } => "the recorded input was over with the tip {away:.1} mm from the target",
        /// The autopilot gave up.
        "trial-end-gave-up" GaveUp {
            /// Times that it withdrew the wire.
            count: u32,
            /// From the tip to the target, in mm.
            away: f64 [1],
        } => {
            let times = if *count == 1 { "1 retraction".to_owned() } else { format!("{} retractions", grouped(count)) };
            format!("the autopilot gave up after {times} with the tip {away:.1} mm from the target")
        },
        /// It failed for a fork that was missed.
        "trial-end-missed" Missed {
            /// How it ended.
            why: Box<TrialEnd>,
            /// The fork.
            missed: MissedForkText,
        } => "{why}: {missed}",
    }
}

impl Trial {
    fn has_failed(&self) -> bool {
        !matches!(self.progress(), Progress::Running | Progress::Arrived)
    }

    /// Why it ended, up to now; with the fork that was missed, where one was.
    pub fn end(&self) -> TrialEnd {
        let away = self.course().route.distance_to_target(self.simulation().tip());
        let why = match self.progress() {
            Progress::Running => TrialEnd::Running { away },
            Progress::Arrived => TrialEnd::Arrived { time: self.simulation().steps() as f64 * STEP },
            Progress::TimedOut => TrialEnd::TimedOut { limit: self.limit_s(), away },
            Progress::Over => TrialEnd::Over { away },
            Progress::GaveUp => TrialEnd::GaveUp { count: self.meter().retractions, away },
        };
        match self.missed_fork().filter(|_| self.has_failed()) {
            Some(missed) => TrialEnd::Missed { why: Box::new(why), missed },
            None => why,
        }
    }

    /// What came of it, up to now.
    pub fn summary(&self) -> Summary {
        let (meter, clock, course) = (self.meter(), self.stopwatch(), self.course());
        let simulation = self.simulation();
        let steps = simulation.steps();
        let route = &course.route;
        let tip_distance_mm = route.distance_to_target(simulation.tip());
        let time_s = steps as f64 * STEP;
        let per = |sum: f64, count: u64| sum / count.max(1) as f64;
        Summary {
            schema: SCHEMA,
            success: self.progress() == Progress::Arrived,
            reason: self.end().to_string(),
            missed_fork_at: self.missed_fork_at().filter(|_| self.has_failed()).map(|at| at.as_vec3().to_array()),
            time_s,
            steps,
            steps_per_second: 1e3 * steps as f64 / clock.total_ms().max(1e-6),
            step_ms: clock.times(),
            stations: meter.stations.iter().map(|&(arc, passed)| clock.station(arc, passed)).collect(),
            initial_simulation_ms: clock.first_frame_ms(),
            wall_build_ms: course.wall_ms,
            route_build_ms: course.route_ms,
            triangles: course.wall.mesh().triangles.len(),
            surface: format!("{:016x}", course.fingerprint),
            wire: self.wire().name.clone(),
            failed_wires: self.failed_wires().into_iter().map(str::to_owned).collect(),
            reach: course.reach.map(|reach| reach.to_string()),
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
            steps_looked_ahead: meter.looked_ahead,
            max_wall_force_n: meter.max_wall_force_n,
            mean_wall_force_n: per(meter.wall_force_sum, meter.counts.balanced),
            wall_impulse_n_s: meter.wall_force_kept_sum * STEP,
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
            mean_length_error_percent: 100.0 * per(meter.length_error_sum, steps),
            max_length_error_percent: 100.0 * meter.max_length_error,
            max_element_error_percent: 100.0 * meter.max_element_error,
            max_inserted_mm: meter.max_inserted,
            max_nodes: meter.max_nodes,
            max_contact_share: meter.max_contact_share,
            notice: "Not for clinical decisions.".to_owned(),
        }
    }
}
