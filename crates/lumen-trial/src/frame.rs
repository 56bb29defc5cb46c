//! What a trial shows of itself at any moment.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

use super::autopilot::AutopilotTask;
use super::report::{StepCounts, StepReport};

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
    /// The wire that is in: see [`Setup::nth_wire`](super::setup::Setup::nth_wire).
    pub wire: usize,
    /// The wire outside the guide, from its tip to the mouth of the guide, in mm.
    #[serde(with = "lumen_transfer::bulk")]
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
    /// As in [`StepReport::push_n`].
    pub push_n: f64,
    /// As in [`StepReport::torque_n_mm`].
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
    /// What the autopilot is doing; `None` by hand.
    pub doing: Option<AutopilotTask>,
    /// Steps a second of the clock that the simulation could do, over the last half second.
    pub steps_per_second: f32,
    /// Whether the machine is behind by more than 50 ms, so that the trial runs slower than time.
    pub is_behind: bool,
}
