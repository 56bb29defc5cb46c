//! What passes between the app and a trial: it can cross between threads that share no memory.

use std::sync::Arc;

use lumen_message::{Message, Told};
use serde::{Deserialize, Serialize};

use crate::engine::link::Link;
use crate::engine::surfaces::surface;
use crate::language::tell;
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::say;
use crate::transfer::bulk;
use crate::trial::compare::TrialComparison;
use crate::trial::course::{Course, TrialError};
use crate::trial::frame::{Frame, Touch};
use crate::trial::route::{PlaceName, Route, RouteError, RoutePoint};
use crate::trial::setup::{Entry, Input, Setup};
use crate::trial::summary::Summary;
use crate::trial::sweep::SweepRow;

/// The app's end of the line to a trial.
pub type TrialLink = dyn Link<TrialCommand, TrialEvent>;

/// Seconds of the clock for which an input by hand holds.
pub const HAND: f64 = 0.5;

/// What the trial is asked to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum TrialCommand {
    /// Build the wall and the route, and put the wire at the entry; the trial before is over then.
    Start {
        /// Comes back with all that belongs to this trial.
        id: u64,
        /// The surface: the level that is shown.
        #[serde(with = "surface")]
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
        #[serde(with = "bulk")]
        csv: Arc<Vec<u8>>,
    },
    /// Replays the present trial's input on another surface, to the end, and compares the two.
    Compare {
        /// Comes back with what is told of it.
        id: u64,
        /// That surface: the one that was not reduced.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
    },
    /// Runs the autopilot to the end as fast as it goes, on a surface of its own, and tells the summary alone; what is
    /// being shown goes on afterwards.
    Measure {
        /// Comes back with the summary.
        id: u64,
        /// The surface.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
        /// The sample, as for `Start`.
        sample: Option<Sample>,
        /// All else.
        setup: Setup,
    },
    /// Runs the autopilot on a surface by the seeds 1 to `seeds`, and with the same input on the unreduced surface.
    Sweep {
        /// Comes back with what is told of it.
        id: u64,
        /// The surface.
        #[serde(with = "surface")]
        mesh: Arc<TriMesh>,
        /// The one that was not reduced.
        #[serde(with = "surface")]
        original: Arc<TriMesh>,
        /// All else.
        setup: Setup,
        /// How many.
        seeds: u64,
    },
    /// Gives up the comparison, measurement or sweep of this number; the trial stands.
    Cancel {
        /// That of its command.
        id: u64,
    },
    /// Ends the trial and lets go of its surface; measurements and sweeps go on.
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
    /// Other places where a wire could enter, with their names.
    pub entries: Vec<(PlaceName, Entry)>,
    /// Other places where it could go, with their names.
    pub targets: Vec<(PlaceName, [f32; 3])>,
    /// Milliseconds to build the hierarchy of boxes over the wall.
    pub wall_ms: f64,
    /// Milliseconds to find tree and route.
    pub route_ms: f64,
    /// What the tip of the wire does not reach: a sentence.
    pub reach: Option<Told>,
}

impl TrialReady {
    /// The trial of this number, on its course.
    pub(super) fn new(id: u64, setup: &Setup, course: &Course) -> Self {
        Self {
            id,
            setup: setup.clone(),
            route: RouteShown::from(&course.route),
            entries: course.entries.clone(),
            targets: course.targets.clone(),
            wall_ms: course.wall_ms,
            route_ms: course.route_ms,
            reach: course.reach.as_ref().map(Message::told),
        }
    }
}

/// What the trial tells.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
        /// The place that is the reason, in mm, where there is one.
        at: Option<[f32; 3]>,
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
        #[serde(with = "bulk")]
        touches: Vec<Touch>,
    },
    /// The trial is over.
    Ended {
        /// As for `Frame`.
        id: u64,
        /// What came of it.
        summary: Box<Summary>,
        /// Why it ended: a clause.
        end: Told,
    },
    /// The log.
    Saved {
        /// Sample by sample.
        #[serde(with = "bulk")]
        csv: String,
        /// The summary.
        #[serde(with = "bulk")]
        json: String,
    },
    /// What `Compare` was asked for.
    Compared {
        /// That of the command.
        id: u64,
        /// What came of it.
        comparison: Box<TrialComparison>,
    },
    /// How far a comparison, a measurement or a sweep is.
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
    /// What `Sweep` was asked for.
    Swept {
        /// That of the command.
        id: u64,
        /// What came of it.
        row: SweepRow,
    },
    /// Something else could not be done, and why.
    Failed {
        /// One sentence.
        message: String,
    },
}

impl TrialEvent {
    /// That what was asked for under this number cannot be done.
    pub(super) fn refused(id: u64, error: &TrialError) -> Self {
        let is_too_thin = matches!(error, TrialError::Route(RouteError::TooThin { .. }));
        Self::Refused { id, message: sentence(&tell(error)), is_too_thin, at: error.place() }
    }

    /// That what acts on a trial cannot be done without one.
    pub(super) fn refused_without_trial(id: u64) -> Self {
        Self::Refused { id, message: sentence(&say!("devices-no-trial")), is_too_thin: false, at: None }
    }

    /// That something else cannot be done.
    pub(super) fn failed(why: &str) -> Self {
        Self::Failed { message: sentence(why) }
    }

    /// The same, without a trial.
    pub(super) fn failed_without_trial() -> Self {
        Self::failed(&say!("devices-no-trial"))
    }
}

/// Whether this is the head of a frame, which the next frame makes useless: a message begins with the place of its variant.
pub fn is_frame(head: &[u8]) -> bool {
    head.first() == Some(&3)
}

/// With a capital letter and a full stop.
fn sentence(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|letter| letter.to_uppercase().to_string()).unwrap_or_default();
    let stop = if text.ends_with('.') { "" } else { "." };
    format!("{first}{}{stop}", letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::sent;

    use crate::trial::autopilot::AutopilotTask;
    use crate::trial::frame::Progress;
    use crate::trial::report::{StepCounts, StepKind, StepReport};
    use crate::trial::route::WayEnd;
    use crate::trial::summary::TrialEnd;
    use crate::trial::sweep::Spread;

    #[test]
    fn every_command_comes_through_unchanged() {
        let mesh = Arc::new(TriMesh { positions: vec![glam::Vec3::X; 3], triangles: vec![[0, 1, 2]] });
        let setup = Setup { target: Some([1.0, 2.0, 3.5]), seed: 7, ..Setup::default() };
        let (sample, id) = (Some(Sample::Coronary), 5);
        let commands = [
            TrialCommand::Start { id, mesh: mesh.clone(), sample, setup: setup.clone() },
            TrialCommand::Drive(Input { feed: -3.5, roll: 0.25 }),
            TrialCommand::Autopilot(true),
            TrialCommand::Pause(false),
            TrialCommand::Pace(0.25),
            TrialCommand::Restart { id },
            TrialCommand::StepBack { id },
            TrialCommand::Save,
            TrialCommand::Replay { id, csv: Arc::new(b"time_s\n0\n".to_vec()) },
            TrialCommand::Compare { id, mesh: mesh.clone() },
            TrialCommand::Measure { id, mesh: mesh.clone(), sample: None, setup: setup.clone() },
            TrialCommand::Sweep { id, original: mesh.clone(), mesh, setup, seeds: 10 },
            TrialCommand::Cancel { id },
            TrialCommand::Stop,
        ];
        for command in commands {
            assert_eq!(sent(&command).1.unwrap(), command);
        }
    }

    #[test]
    fn every_event_comes_through_unchanged() {
        let touch = Touch { at: [1.0, 2.0, 3.0], triangle: 9, force: 0.25 };
        let frame = Frame {
            nodes: vec![[0.1, 0.2, 0.3]; 4],
            contacts: 2,
            report: StepReport { kind: StepKind::Waited, wanted_mm: 0.04, push_n: -0.1, ..StepReport::default() },
            step_kinds: StepCounts { balanced: 40, held: 2, ..StepCounts::default() },
            time_s: 0.1,
            progress: Progress::Arrived,
            doing: Some(AutopilotTask::Following),
            ..Frame::default()
        };
        let route = RouteShown { points: vec![[1.0; 3]; 2], radii: vec![2.0; 2], ..RouteShown::default() };
        let left = PlaceName::Target { branch: 3, end: WayEnd::Closed, diameter_mm: 1.7, away_mm: 80.5 };
        let ready = TrialReady { id: 1, route, targets: vec![(left, [0.0; 3])], ..TrialReady::default() };
        let end = TrialEnd::Arrived { time: 23.4 }.told();
        let comparison = TrialComparison {
            verdict: end.clone(),
            inserted_mm: vec![1.0, 2.0],
            deviation_mm: vec![0.0, 0.5],
            noise_mm: vec![0.1, 0.2],
            orders: [3, 2],
            tip: vec![[1.0; 3]; 2],
            other_tip: vec![[1.5; 3]; 2],
            force_differences: vec![([1.0; 3], 0.5)],
            ..TrialComparison::default()
        };
        let summary = Box::new(Summary { success: true, friction: [0.06, 0.04], ..Summary::default() });
        let spread = Spread { median: 0.5, largest: 1.25 };
        let row = SweepRow { seeds: 10, arrived: 9, deviation_mm: Some(spread), ..SweepRow::default() };
        let message = "no way".to_owned();
        let events = [
            TrialEvent::Preparing { id: 1, fraction: 0.5 },
            TrialEvent::Ready(Box::new(ready)),
            TrialEvent::Refused { id: 1, message: message.clone(), is_too_thin: true, at: Some([1.0, 2.5, 3.0]) },
            TrialEvent::Frame { id: 4, frame: Box::new(frame) },
            TrialEvent::Felt { id: 4, touches: vec![touch; 3] },
            TrialEvent::Ended { id: 4, summary: summary.clone(), end },
            TrialEvent::Saved { csv: "a,b\n1,2\n".to_owned(), json: "{}".to_owned() },
            TrialEvent::Compared { id: 2, comparison: Box::new(comparison) },
            TrialEvent::Busy { id: 2, fraction: 0.25 },
            TrialEvent::Measured { id: 3, summary },
            TrialEvent::Swept { id: 3, row },
            TrialEvent::Failed { message },
        ];
        for event in events {
            let (head, arrived) = sent(&event);
            assert_eq!(is_frame(&head), matches!(event, TrialEvent::Frame { .. }));
            assert_eq!(arrived.unwrap(), event);
        }
    }
}
