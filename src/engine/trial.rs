//! The trial as work beside the app: commands in, frames out, in a worker of its own.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::mesh::TriMesh;
use crate::phantom::Sample;
pub use crate::trial::compare::TrialComparison;
use crate::trial::frame::{Frame, Touch};
use crate::trial::route::{Route, RoutePoint};
use crate::trial::setup::{Entry, Input, Setup};
use crate::trial::summary::Summary;

/// The app's end of the line to a trial.
pub type TrialLink = dyn super::Link<TrialCommand, TrialEvent>;

/// Seconds of the clock for which an input by hand holds.
pub const HAND: f64 = 0.5;

/// What the trial is asked to do.
#[derive(Clone, Debug, PartialEq)]
pub enum TrialCommand {
    /// Build the wall and the route, and put the wire at the entry; the trial before is over then.
    Start {
        /// Comes back with all that belongs to this trial.
        id: u64,
        /// The surface: the level that is shown.
        mesh: Arc<TriMesh>,
        /// The sample that it was made from, if it was one: samples bring entry and target with them.
        sample: Option<Sample>,
        /// All else.
        setup: Setup,
    },
    /// Goes on with this input until the next, or until [`HAND`] is over and it was not told again.
    Drive(Input),
    /// Steers by itself, or no longer.
    Autopilot(bool),
    /// Stands still, or goes on.
    Pause(bool),
    /// Simulated seconds a second of the clock: 1, or less for slow motion.
    Pace(f32),
    /// Begins again with the same setup.
    Restart {
        /// Comes back with the frames from then on: those that are under way still belong to what was before.
        id: u64,
    },
    /// Goes back by a second of simulated time, and stands still.
    StepBack {
        /// As for `Restart`.
        id: u64,
    },
    /// Asks for the log.
    Save,
    /// Plays a saved log on the same surface, from the start.
    Replay {
        /// As for `Restart`.
        id: u64,
        /// The log, as it was saved.
        csv: Arc<Vec<u8>>,
    },
    /// Replays the present trial's input on another surface, to the end, and compares the two.
    Compare {
        /// Comes back with what is told of it.
        id: u64,
        /// That surface: the one that was not reduced.
        mesh: Arc<TriMesh>,
    },
    /// Runs the autopilot to the end as fast as it goes, on a surface of its own, and tells the summary alone; what is
    /// being shown goes on afterwards.
    Measure {
        /// Comes back with the summary.
        id: u64,
        /// The surface.
        mesh: Arc<TriMesh>,
        /// The sample, as for `Start`.
        sample: Option<Sample>,
        /// All else.
        setup: Setup,
    },
    /// Gives up the comparison or measurement of this number; the trial stands.
    Cancel {
        /// That of its command.
        id: u64,
    },
    /// Ends the trial and lets go of its surface; measurements go on.
    Stop,
}

/// The way from the entry to the target, as it is shown.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RouteShown {
    /// Places along the middle of the lumen, in mm.
    pub points: Vec<[f32; 3]>,
    /// The radius of the lumen at each, in mm.
    pub radii: Vec<f32>,
    /// The five stations.
    pub stations: Vec<[f32; 3]>,
    /// Its length in mm.
    pub length_mm: f64,
    /// Length over the straight distance.
    pub tortuosity: f64,
    /// The smallest radius in mm, and where.
    pub smallest_radius_mm: f64,
    /// That place.
    pub smallest_at: [f32; 3],
    /// Branches passed on the way.
    pub branches_passed: usize,
}

impl From<&Route> for RouteShown {
    fn from(route: &Route) -> Self {
        let place = |point: RoutePoint| point.at.as_vec3().to_array();
        Self {
            points: route.points.iter().copied().map(place).collect(),
            radii: route.points.iter().map(|point| point.radius as f32).collect(),
            stations: route.stations.iter().map(|&arc| place(route.at(arc))).collect(),
            length_mm: route.length_mm,
            tortuosity: route.tortuosity,
            smallest_radius_mm: route.smallest_radius_mm,
            smallest_at: place(route.points[route.smallest_at]),
            branches_passed: route.branches_passed,
        }
    }
}

/// A trial that is ready to go.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TrialReady {
    /// That of the command.
    pub id: u64,
    /// The setup with its entry and target filled in.
    pub setup: Setup,
    /// The way.
    pub route: RouteShown,
    /// Other places where a wire could enter.
    pub entries: Vec<Entry>,
    /// Other places where it could go, with names.
    pub targets: Vec<(String, [f32; 3])>,
    /// Milliseconds to build the hierarchy of boxes over the wall.
    pub wall_ms: f64,
    /// Milliseconds to find tree and route.
    pub route_ms: f64,
}

/// What the trial tells.
#[derive(Clone, Debug, PartialEq)]
pub enum TrialEvent {
    /// The wall is being built; the part that is done.
    Preparing {
        /// That of the command.
        id: u64,
        /// 0 to 1.
        fraction: f32,
    },
    /// The wire stands at the entry.
    Ready(Box<TrialReady>),
    /// It cannot be tried, measured or compared, and why; the trial before stands.
    Refused {
        /// That of the command.
        id: u64,
        /// One sentence.
        message: String,
        /// Whether the reason is a lumen thinner than the wire.
        is_too_thin: bool,
    },
    /// The wire now.
    Frame {
        /// That of the command which began this: a start, a restart, a step back or a replay.
        id: u64,
        /// What is to be shown.
        frame: Box<Frame>,
    },
    /// What the wall has felt more than before, in all steps up to the frame that follows; frames may be left out, this
    /// is not.
    Felt {
        /// As for `Frame`.
        id: u64,
        /// Each place with its largest force since `id` began.
        touches: Vec<Touch>,
    },
    /// The trial is over.
    Ended {
        /// As for `Frame`.
        id: u64,
        /// What came of it.
        summary: Box<Summary>,
    },
    /// The log.
    Saved {
        /// Sample by sample.
        csv: String,
        /// The summary.
        json: String,
    },
    /// What `Compare` was asked for.
    Compared {
        /// That of the command.
        id: u64,
        /// What came of it.
        comparison: Box<TrialComparison>,
    },
    /// How far a comparison or a measurement is.
    Busy {
        /// That of the command.
        id: u64,
        /// 0 to 1.
        fraction: f32,
    },
    /// What `Measure` was asked for.
    Measured {
        /// That of the command.
        id: u64,
        /// What came of it.
        summary: Box<Summary>,
    },
    /// Something else could not be done, and why.
    Failed {
        /// One sentence.
        message: String,
    },
}
