//! What a trial shows of itself, at any moment and at its end.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

use super::press::Press;
use super::report::{StepCounts, StepReport};
use super::setup::Entry;

/// A place where the wire lies against the wall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable, Serialize, Deserialize)]
#[repr(C)]
pub struct Touch {
    /// On the wall, in mm.
    pub at: [f32; 3],
    /// The triangle.
    pub triangle: u32,
    /// What the wire does to the wall, in N: the normal part.
    pub force: f32,
}

/// How far a trial is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Progress {
    /// It goes on.
    #[default]
    Running,
    /// The tip is within 2 mm of the target's cross-section, in the right branch.
    Arrived,
    /// The autopilot's time is over: 3 times what the way takes at its feed, and 30 s. A hand has all the time.
    TimedOut,
    /// The autopilot has tried all it knows.
    GaveUp,
    /// A replayed input is over.
    Over,
}

/// The wire and all that is told of it at one moment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Steps since the start.
    pub step: u64,
    /// Simulated seconds since the start.
    pub time_s: f64,
    /// The wire outside the guide, from its tip to the mouth of the guide, in mm.
    #[serde(with = "crate::transfer::bulk")]
    pub nodes: Vec<[f32; 3]>,
    /// What came of the last step. The forces below are those of the last one that was balanced.
    pub report: StepReport,
    /// Steps so far, by kind.
    pub step_kinds: StepCounts,
    /// Places where it presses against the vessel.
    pub contacts: usize,
    /// Direction of the tip, of length 1.
    pub tip_direction: [f32; 3],
    /// The side to which the tip is bent, of length 1 and at right angles to the direction.
    pub tip_side: [f32; 3],
    /// Length outside the guide, in mm.
    pub inserted_mm: f64,
    /// Roll at the guide, in radians.
    pub roll: f64,
    /// Speed of the feed that the input asks for now, in mm/s.
    pub feed: f32,
    /// What it takes to hold the wire at the guide against its way in, in N: positive when it pushes back.
    pub push_n: f64,
    /// The moment about its axis at the guide, in N mm.
    pub torque_n_mm: f64,
    /// Sum over the wall of the normal forces, in N.
    pub wall_force_n: f64,
    /// The largest at one place, in N.
    pub max_wall_force_n: f64,
    /// The part within 5 mm of the tip, in N.
    pub tip_force_n: f64,
    /// Arc length along the route of the place next to the tip, in mm.
    pub arc_mm: f64,
    /// Distance of the tip from the target's cross-section, in mm.
    pub target_mm: f64,
    /// The branch of the vessel tree that the tip is in.
    pub branch: u32,
    /// Whether that branch is off the route.
    pub is_wrong_branch: bool,
    /// Whether the wire has turned back on itself: a loop or a prolapse.
    pub is_looped: bool,
    /// How far it is.
    pub progress: Progress,
    /// What the autopilot is doing; empty by hand.
    pub doing: String,
    /// Steps a second of the clock that the simulation could do, over the last half second.
    pub steps_per_second: f32,
    /// Whether the machine is behind by more than 50 ms, so that the trial runs slower than time.
    pub is_behind: bool,
}

/// The times of single steps, in ms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StepTimes {
    /// Mean.
    pub mean: f64,
    /// Median.
    pub p50: f64,
    /// 99th percentile.
    pub p99: f64,
    /// The longest.
    pub max: f64,
}

/// What was measured where the tip passed one of the five stations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StationResult {
    /// Arc length along the route, in mm.
    pub arc_mm: f64,
    /// When the tip passed it first, in simulated seconds; `None` if it never did.
    pub time_s: Option<f64>,
    /// Steps a second over the second of simulated time around it.
    pub steps_per_second: Option<f64>,
    /// Mean milliseconds of 1/60 s of simulated time around it.
    pub simulation_ms: Option<f64>,
}

/// What came of a trial.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// Version of this list of fields.
    pub schema: u32,
    /// Whether the tip arrived.
    pub success: bool,
    /// Why it ended, as a sentence.
    pub reason: String,
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
    /// The wire's name.
    pub wire: String,
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
    /// Steps by kind. The forces below are of those that were balanced.
    pub step_kinds: StepCounts,
    /// The part of the steps that was not balanced.
    pub unbalanced_share: f64,
    /// The way that the input asked the feed to go, there and back, in mm.
    pub wanted_feed_mm: f64,
    /// What of it was fed: the rest was asked for while the guide waited, held back or was at an end of the wire.
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
    /// Largest length outside the guide, in mm.
    pub max_inserted_mm: f64,
    /// Largest number of nodes outside the guide.
    pub max_nodes: usize,
    /// Largest part of them against the wall.
    pub max_contact_share: f64,
    /// The sentence that stands in every report.
    pub notice: String,
}
