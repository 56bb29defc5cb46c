//! What the app knows of a trial.
//!
//! [`Trial`] holds what outlives a trial, and while its views are shown what is [`Open`] there, with a [`Stage`]. A
//! [`Session`] is a trial in one surface, a [`Run`] in it one way of the wire from its entry: what belongs to any of them
//! goes with it when another takes its place.

use std::sync::Arc;

use lumen_message::Told;

use super::action::Pick;
use super::carm::CArm;
use super::device::Device;
use super::drive::Hand;
use super::largest::Largest;
use super::rumble::Rumble;
use super::sound::Sound;
use super::tables::Tables;
use crate::app::document::{Document, Revision};
use crate::engine::trial::{TrialComparison, TrialReady};
use crate::language::Key;
use crate::mesh::{TriMesh, Vec3};
use crate::pipeline::progressive::ProgressiveMesh;
use crate::pipeline::settings::Smoothing;
use crate::trial::frame::{Frame, Progress, Touch};
use crate::trial::setup::Setup;
use crate::trial::summary::Summary;
use crate::trial::wire::Wire;

/// What is said until a smoother level is there.
pub(super) const AWAITS: Key = Key("trial-awaits");

/// What the app knows of the trial.
#[derive(Default)]
pub struct Trial {
    /// All that decides it, as the controls have it.
    pub setup: Setup,
    /// The paper's tables.
    pub tables: Tables,
    /// The haptic device. It is served, and its force ends, whether a trial is open or not.
    pub(super) device: Device,
    /// Why the last thing asked for could not be done.
    pub(super) problem: Option<Problem>,
    /// The number of the newest command that has one.
    pub(super) number: u64,
    /// The name of the surface, and what it is called in the language that is spoken.
    pub(super) name: String,
    pub(super) title: String,
    /// While the trial's views are shown: all that means nothing without them.
    pub(super) open: Option<Box<Open>>,
}

/// A trial whose views are shown.
#[derive(Default)]
pub struct Open {
    /// What the next click on the vessel chooses.
    pub pick: Option<Pick>,
    /// The fluoroscope.
    pub carm: CArm,
    /// Whether it is in slow motion.
    pub is_slow: bool,
    /// The operator's hand.
    pub(super) hand: Hand,
    /// A gamepad's motors.
    pub(super) rumble: Rumble,
    /// A tone in place of a force.
    pub(super) sound: Sound,
    /// A place that the camera flies to from the next picture on, in mm: where it is too thin, the fork that was missed.
    pub(super) flight: Option<Vec3>,
    /// The smoothing whose level is awaited: it begins with that.
    pub(super) awaits: Option<Smoothing>,
    /// The setup of the newest start, as the controls had it.
    pub(super) sent: Option<Setup>,
    pub(super) stage: Stage,
}

/// How far a trial is.
pub enum Stage {
    /// None is on. The surface in which one was refused is shown then.
    Off(Option<Arc<TriMesh>>),
    /// The wall and the route are being found.
    Preparing(Preparing),
    /// The wire is in the vessel.
    Association(Box<Session>),
}

impl Default for Stage {
    fn default() -> Self {
        Self::Off(None)
    }
}

/// Starts that the engine has not answered yet.
#[derive(Default)]
pub struct Preparing {
    /// The part of it that is done.
    pub fraction: f32,
    /// Those on their way in, in order.
    pub(super) coming: Vec<Coming>,
    /// A log to be replayed once the last of them is in.
    pub(super) log: Option<Arc<Vec<u8>>>,
    /// The trial before, which stands until one of them is in.
    pub(super) before: Option<Box<Session>>,
}

/// A trial on its way in.
pub(super) struct Coming {
    /// The number of its command.
    pub(super) id: u64,
    pub(super) subject: Subject,
}

/// The surface of a trial.
pub(super) struct Subject {
    /// The level that the wire is in.
    pub(super) mesh: Arc<TriMesh>,
    /// All levels.
    pub(super) levels: Arc<ProgressiveMesh>,
    /// What they were taken from.
    pub(super) of: Revision,
}

/// A trial in one surface.
pub struct Session {
    pub(super) subject: Subject,
    /// The way and the places that can be chosen.
    pub ready: TrialReady,
    /// The wire at its entry, once it is told: what a restart shows until the engine has answered.
    pub(super) at_entry: Option<Frame>,
    /// What goes on in it.
    pub run: Run,
}

/// One way of the wire from its entry: a restart, a replay and a step back begin another.
#[derive(Default)]
pub struct Run {
    /// The number of the command that began it: frames of other numbers are not shown.
    pub(super) id: u64,
    /// Whether the autopilot steers.
    pub autopilot: bool,
    /// Whether it stands still.
    pub is_paused: bool,
    /// The wire now.
    pub(super) frame: Option<Frame>,
    /// Counts up with every frame in which the wire is another than in the one before.
    pictures: u64,
    /// The largest force in N and torque in N mm at the guide since they were last asked for: several frames may come between
    /// two pictures.
    strongest: [f64; 2],
    /// What the wall has felt, in the order in which it was told.
    pub(super) felt: Vec<Touch>,
    /// The largest forces, of the runs before on the same surface too, and those of these alone.
    pub(super) peaks: Largest,
    peaks_before: Largest,
    /// What came of it, once it is over.
    pub summary: Option<Summary>,
    /// Why it ended, once it has.
    pub(super) end: Option<Told>,
    /// What the unreduced surface makes of it.
    pub comparison: Option<TrialComparison>,
    /// A comparison that is under way.
    pub(super) comparing: Option<Comparing>,
}

/// A comparison that is under way.
#[derive(Clone, Copy)]
pub(super) struct Comparing {
    /// The number of its command.
    pub(super) id: u64,
    /// The part that is done, 0 to 1.
    pub(super) fraction: f32,
}

/// Why something could not be done.
pub(super) struct Problem {
    pub(super) text: String,
    /// Whether a lumen is thinner than the wire: less smoothing may help.
    pub(super) is_too_thin: bool,
    /// The place that is the reason, in mm.
    pub(super) at: Option<Vec3>,
}

impl From<String> for Problem {
    fn from(text: String) -> Self {
        Self { text, is_too_thin: false, at: None }
    }
}

impl Trial {
    /// Takes what its surface is called, which changes with the language: as long as that surface is open.
    pub(super) fn take_title(&mut self, document: Option<&Document>) {
        if let Some(document) = document.filter(|document| document.name == self.name) {
            self.title = document.title().into_owned();
        }
    }

    /// None is on; the wire is to be the one that is proposed.
    pub(in crate::app) fn new() -> Self {
        Self { setup: Setup { proposes_wire: true, ..Setup::default() }, ..Self::default() }
    }

    /// What is open while its views are shown.
    pub fn open(&self) -> Option<&Open> {
        self.open.as_deref()
    }

    /// How far it is; `None` while its views are not shown.
    pub(super) fn stage(&self) -> Option<&Stage> {
        Some(&self.open()?.stage)
    }

    pub(super) fn stage_mut(&mut self) -> Option<&mut Stage> {
        Some(&mut self.open.as_deref_mut()?.stage)
    }

    /// Whether its views are shown.
    pub fn is_open(&self) -> bool {
        self.open.is_some()
    }

    /// Whether its fluoroscopy is the large picture.
    pub(super) fn is_large(&self) -> bool {
        self.open().is_some_and(|open| open.carm.is_large)
    }

    /// Whether the wire is in the vessel, and nothing else on its way in.
    pub fn is_on(&self) -> bool {
        self.session_on().is_some()
    }

    /// The trial whose wire is in the vessel.
    fn session_on(&self) -> Option<&Session> {
        if let Stage::Association(session) = self.stage()? { Some(session) } else { None }
    }

    pub(super) fn session_on_mut(&mut self) -> Option<&mut Session> {
        if let Stage::Association(session) = self.stage_mut()? { Some(session) } else { None }
    }

    /// The trial that is shown: the one that is on, or that stands until the next is ready.
    pub fn session(&self) -> Option<&Session> {
        self.stage()?.session()
    }

    pub(super) fn session_mut(&mut self) -> Option<&mut Session> {
        match self.stage_mut()? {
            Stage::Off(_) => None,
            Stage::Preparing(preparing) => preparing.before.as_deref_mut(),
            Stage::Association(session) => Some(session),
        }
    }

    /// The way of the wire that is shown.
    pub fn run(&self) -> Option<&Run> {
        self.session().map(|session| &session.run)
    }

    /// The wire as it is shown.
    pub fn frame(&self) -> Option<&Frame> {
        self.run()?.frame.as_ref()
    }

    /// The largest forces on the surface that is shown.
    pub(super) fn peaks(&self) -> Largest {
        self.run().map(|run| run.peaks).unwrap_or_default()
    }

    /// The surface that the wire is in, or was refused in.
    pub(super) fn mesh(&self) -> Option<&Arc<TriMesh>> {
        match self.stage()? {
            Stage::Off(refused) => refused.as_ref(),
            stage => stage.session().map(|session| &session.subject.mesh),
        }
    }

    /// Whether a hand can move the wire: then it is looked after, as a gamepad tells nothing by itself.
    pub fn is_in_hand(&self) -> bool {
        let Some(Session { run, .. }) = self.session_on() else { return false };
        let is_over = run.frame.as_ref().is_some_and(|frame| frame.progress != Progress::Running);
        !(run.is_paused || is_over || run.summary.is_some())
    }

    /// Whether frames come by themselves: at its entry the wire waits for the first input, and asks for none.
    pub fn is_moving(&self) -> bool {
        self.is_in_hand() && self.frame().is_some_and(|frame| frame.step > 0)
    }

    /// Whether a comparison is under way.
    pub fn is_comparing(&self) -> bool {
        self.run().is_some_and(|run| run.comparing.is_some())
    }

    /// Whether something is being computed for it.
    pub fn is_busy(&self) -> bool {
        matches!(self.stage(), Some(Stage::Preparing(_))) || self.is_comparing() || self.tables.is_busy()
    }

    /// The setup in force, with its entry and its target.
    pub fn setup_in_force(&self) -> Option<&Setup> {
        self.session().map(|session| &session.ready.setup)
    }

    /// Whether the controls say other than what the wire is in for.
    pub fn has_changed(&self) -> bool {
        let is_proposed = |sent: &Setup| sent.proposes_wire && self.setup.proposes_wire;
        let as_now = |sent: &Setup| Setup {
            wire: if is_proposed(sent) { self.setup.wire.clone() } else { sent.wire.clone() },
            ..sent.clone()
        };
        self.sent().is_some_and(|sent| as_now(sent) != self.setup)
    }

    /// The setup of the newest start, as the controls had it.
    fn sent(&self) -> Option<&Setup> {
        self.open()?.sent.as_ref()
    }

    /// The wire that is proposed for the way that is shown, where one was.
    pub(super) fn proposed_wire(&self) -> Option<&Wire> {
        let is_proposed = self.is_on() && self.sent().is_some_and(|sent| sent.proposes_wire);
        self.session().filter(|_| is_proposed).map(Session::wire)
    }

    /// The smoothing that is offered in place of `smoothing`, where the lumen is too thin for the wire.
    pub(super) fn gentler(&self, smoothing: &Smoothing) -> Option<Smoothing> {
        let is_too_thin = self.problem.as_ref().is_some_and(|problem| problem.is_too_thin);
        let takes_calibre = smoothing.iterations > 0 && !smoothing.adapt;
        (is_too_thin && takes_calibre).then_some(Smoothing { adapt: true, ..*smoothing })
    }

    /// A number for a command.
    pub(super) fn next_number(&mut self) -> u64 {
        self.number += 1;
        self.number
    }

    /// Begins another run in the trial that is on, if one is, with what `begin` makes of it and its number.
    pub(super) fn begin_run(&mut self, begin: impl FnOnce(&Session, u64) -> Run) -> Option<u64> {
        let id = self.number + 1;
        let session = self.session_on_mut()?;
        session.run = begin(session, id);
        self.number = id;
        Some(id)
    }

    /// The wire is at its entry: no hand is on it, and no time of the beam has passed.
    pub(super) fn reset_controls(&mut self) {
        if let Some(open) = &mut self.open {
            open.carm.reset();
            open.hand.forget_told();
        }
    }

    /// Ends whatever is on, and closes the views unless they are to stay. What was chosen stands, and so do the tables.
    pub(super) fn end(&mut self, stays_open: bool) {
        self.open = stays_open.then(Box::default);
        self.problem = None;
        self.device.forget_trial();
    }

    /// Hears that the window's clock begins anew.
    pub(in crate::app) fn restart_clock(&mut self) {
        if let Some(open) = &mut self.open {
            open.carm.restart_clock();
            open.hand.restart_clock();
        }
    }
}

impl Stage {
    /// The trial that is shown: the one that is on, or that stands until the next is ready.
    pub(super) fn session(&self) -> Option<&Session> {
        match self {
            Self::Off(_) => None,
            Self::Preparing(preparing) => preparing.before.as_deref(),
            Self::Association(session) => Some(session),
        }
    }
}

impl Preparing {
    /// Whether the trial of this number is on its way in.
    pub(super) fn awaits(&self, id: u64) -> bool {
        self.coming.iter().any(|coming| coming.id == id)
    }
}

impl Session {
    /// The wire that is in.
    pub(super) fn wire(&self) -> &Wire {
        let setup = &self.ready.setup;
        self.run.frame.as_ref().and_then(|frame| setup.nth_wire(frame.wire)).unwrap_or(&setup.wire)
    }

    /// Along the way where it passes; else towards the target.
    pub(super) fn direction_at(&self, at: Vec3) -> Option<Vec3> {
        let points = &self.ready.route.points;
        let away = |p: &[f32; 3]| Vec3::from(*p).distance(at);
        let nearest = (0..points.len()).min_by(|&a, &b| away(&points[a]).total_cmp(&away(&points[b])));
        let along = nearest.filter(|&i| away(&points[i]) < 10.0).map(|i| {
            let (before, after) = (i.saturating_sub(2), (i + 2).min(points.len() - 1));
            Vec3::from(points[after]) - Vec3::from(points[before])
        });
        along.or_else(|| Some(Vec3::from(self.ready.setup.target?) - at))
    }
}

impl Run {
    /// One that nothing is known of yet. On the surface of the one before, bars and colours keep their scale: what is weaker
    /// looks weaker.
    pub(super) fn new(id: u64, before: Option<&Self>) -> Self {
        let peaks = before.map(|before| before.peaks).unwrap_or_default();
        Self { id, peaks, peaks_before: peaks, ..Self::default() }
    }

    /// From the entry: the wire is shown there until more is told.
    pub(super) fn from_entry(session: &Session, id: u64) -> Self {
        Self { frame: session.at_entry.clone(), ..Self::new(id, Some(&session.run)) }
    }

    /// From a second before, standing still. What was felt up to there is told again.
    pub(super) fn stepped_back(&self, id: u64) -> Self {
        let (autopilot, frame, peaks) = (self.autopilot, self.frame.clone(), self.peaks_before);
        Self { id, autopilot, frame, is_paused: true, peaks, peaks_before: peaks, ..Self::default() }
    }

    /// Differs wherever the wire may lie otherwise, in this run or another.
    pub(super) fn picture(&self) -> (u64, u64) {
        (self.id, self.pictures)
    }

    /// Whether this is the number of the comparison that is awaited.
    pub(super) fn is_comparing(&self, id: u64) -> bool {
        self.comparing.is_some_and(|comparing| comparing.id == id)
    }

    /// Shows the wire as it is in `frame`.
    pub(super) fn show(&mut self, frame: Frame) {
        let is_same = |before: &Frame| (before.step, &before.nodes) == (frame.step, &frame.nodes);
        self.pictures += u64::from(!self.frame.as_ref().is_some_and(is_same));
        for (most, force) in self.strongest.iter_mut().zip([frame.push_n, frame.torque_n_mm]) {
            // What is no number stays, for the guard to see.
            if !(*most >= force.abs() || most.is_nan()) {
                *most = force.abs();
            }
        }
        self.frame = Some(frame);
    }

    /// The largest force in N and torque in N mm at the guide since this was last asked, or those of now.
    pub(super) fn take_strongest(&mut self) -> [f64; 2] {
        let now = self.frame.as_ref().map_or([0.0; 2], |frame| [frame.push_n.abs(), frame.torque_n_mm.abs()]);
        std::mem::replace(&mut self.strongest, now)
    }
}

/// What of a document its level comes from.
pub(super) fn taken_from(document: &Document) -> Revision {
    Revision { measured: 0, opened: 0, ..document.revision }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_felt_between_two_pictures_is_the_most_that_came() {
        let mut run = Run::default();
        let mut feel = |forces: &[[f64; 2]]| {
            forces.iter().for_each(|&[push_n, torque_n_mm]| {
                run.show(Frame { push_n, torque_n_mm, ..Frame::default() });
            });
            run.take_strongest()
        };
        assert_eq!(feel(&[]), [0.0; 2]);
        assert_eq!(feel(&[[0.01, 0.0], [-0.03, 0.2], [0.02, -0.1]]), [0.03, 0.2], "a pull is felt as well as a push");
        assert_eq!(feel(&[]), [0.02, 0.1], "what was last holds on");
        assert_eq!(feel(&[[0.001, 0.0]]), [0.02, 0.1], "from then on");
        assert_eq!(feel(&[]), [0.001, 0.0]);
        assert!(feel(&[[f64::NAN, 0.0], [0.01, 0.0]])[0].is_nan(), "what is no number is not passed over");
        assert_eq!(feel(&[]), [0.01, 0.0]);
    }
}
