//! The trial that keeps pace with the clock, and what else is asked of it.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use web_time::Instant;

use super::trial::{HAND, RouteShown, TrialCommand, TrialComparison, TrialEvent, TrialReady};
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::trial::STEP;
use crate::trial::compare::{Noise, SHUFFLES};
use crate::trial::course::{Course, TrialError};
use crate::trial::frame::Progress;
use crate::trial::log::Log;
use crate::trial::route::RouteError;
use crate::trial::session::Trial;
use crate::trial::setup::{Input, Setup};

/// Seconds by which the trial may be behind the clock before it slows down.
const BEHIND: f64 = 0.05;
/// Seconds between two frames.
const FRAME: f64 = 1.0 / 60.0;
/// Seconds over which the speed is told, and between two words on how far long work is.
const TELL: f64 = 0.5;

/// Why what acts on the trial that is shown cannot be done.
const NO_TRIAL: &str = "no trial is on";

/// What runs to its end as fast as it goes, while the trial that is shown waits.
struct Job {
    id: u64,
    trial: Box<Trial>,
    kind: JobKind,
    told: Instant,
}

enum JobKind {
    Measure,
    Compare(Comparing),
}

/// A comparison: the trial runs on the unreduced surface, then on the same in other orders.
struct Comparing {
    mesh: Arc<TriMesh>,
    /// The run on the surface as it is, once it is over.
    original: Option<Box<Trial>>,
    noise: Noise,
    /// Orders that were tried.
    orders: u64,
}

impl Job {
    /// The part that is done.
    fn fraction(&self) -> f32 {
        let steps = self.trial.simulation().steps() as f64;
        let all = self.trial.replayed_steps().map_or(self.trial.limit_s() / STEP, |all| all as f64);
        let part = steps / all.max(1.0);
        match &self.kind {
            JobKind::Measure => part as f32,
            JobKind::Compare(comparing) => {
                let before = comparing.orders + u64::from(comparing.original.is_some());
                ((before as f64 + part) / (SHUFFLES + 1) as f64) as f32
            }
        }
    }
}

/// The hand on the wire. Whoever holds it tells so again and again; one that is not heard of any more (its window is
/// hidden, its page has stopped) is off.
#[derive(Clone, Copy, PartialEq)]
enum Hand {
    /// None is on it.
    Off,
    /// It was heard of since the clock was looked at last.
    Heard,
    /// It is on the wire until then, in seconds by the clock.
    Until(f64),
}

/// The trial that is shown.
struct Shown {
    /// That of the command which began what is shown now.
    id: u64,
    trial: Box<Trial>,
    /// Whether a hand, the autopilot or a log has moved the wire yet: until then it lies at its entry, and its time does
    /// not run.
    has_begun: bool,
    hand: Hand,
    is_paused: bool,
    pace: f64,
    /// Simulated seconds that the clock has asked for and that are not done.
    owed: f64,
    clock: Option<f64>,
    framed: f64,
    is_behind: bool,
    is_told: bool,
    /// Steps and the clock's milliseconds for them since the speed was told last, and that speed.
    counted: (u64, f64),
    speed: f32,
    needs_frame: bool,
}

impl Shown {
    fn new(id: u64, trial: Trial) -> Self {
        Self {
            id,
            trial: Box::new(trial),
            has_begun: false,
            hand: Hand::Off,
            is_paused: false,
            pace: 1.0,
            owed: 0.0,
            clock: None,
            framed: f64::NEG_INFINITY,
            is_behind: false,
            is_told: false,
            counted: (0, 0.0),
            speed: 0.0,
            needs_frame: true,
        }
    }

    /// Begins again on the same course, by hand.
    fn restart(&mut self) -> Result<(), TrialError> {
        let trial = Trial::new(self.trial.course().clone(), self.trial.setup().clone())?;
        *self = Self { pace: self.pace, ..Self::new(self.id, trial) };
        Ok(())
    }

    /// What was to begin anew could not: it goes on, but in the hand of whoever asked.
    fn hand_over(&mut self) {
        self.trial.set_autopilot(false);
        (self.is_paused, self.is_told) = (false, false);
    }

    /// Lets go of the wire where the hand was not heard of for too long. The autopilot and a log need none.
    fn look_after_hand(&mut self, now_s: f64) {
        match self.hand {
            Hand::Heard => self.hand = Hand::Until(now_s + HAND),
            Hand::Until(end) if now_s > end => {
                self.trial.drive(Input::default());
                self.hand = Hand::Off;
            }
            Hand::Off | Hand::Until(_) => {}
        }
    }

    /// Whether it stands, whatever the clock says.
    fn stands(&self) -> bool {
        self.is_paused || !self.has_begun
    }
}

/// The trial as commands and events.
#[derive(Default)]
pub struct TrialEngine {
    shown: Option<Shown>,
    jobs: VecDeque<Job>,
    events: VecDeque<TrialEvent>,
}

impl TrialEngine {
    /// Without a trial.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes a command.
    pub fn handle(&mut self, command: TrialCommand) {
        match command {
            TrialCommand::Start { id, mesh, sample, setup } => self.start(id, &mesh, sample, setup),
            TrialCommand::Measure { id, mesh, sample, setup } => {
                let job = begin(&mesh, sample, setup).map(|(trial, _)| trial);
                self.add_job(id, job, JobKind::Measure);
            }
            TrialCommand::Cancel { id } => self.jobs.retain(|job| job.id != id),
            TrialCommand::Stop => {
                self.shown = None;
                self.drop_comparisons();
            }
            other => match self.shown.take() {
                None => match other {
                    TrialCommand::Compare { id, .. } => self.refuse(id, NO_TRIAL, false),
                    _ => self.fail(NO_TRIAL),
                },
                Some(mut shown) => {
                    let begun = match &other {
                        TrialCommand::Restart { id }
                        | TrialCommand::StepBack { id }
                        | TrialCommand::Replay { id, .. } => Some(*id),
                        _ => None,
                    };
                    if let Some(id) = begun {
                        // Whether or not it can be done: the frames that follow are those after it.
                        shown.id = id;
                        self.drop_comparisons();
                    }
                    self.handle_shown(other, &mut shown);
                    if begun.is_some() {
                        // What the wall has felt up to where the wire is now, to whoever has forgotten all.
                        shown.trial.felt_mut().tell_again();
                    }
                    shown.needs_frame = true;
                    self.shown = Some(shown);
                }
            },
        }
    }

    fn handle_shown(&mut self, command: TrialCommand, shown: &mut Shown) {
        let trial = &mut shown.trial;
        match command {
            TrialCommand::Drive(input) => {
                trial.drive(input);
                let is_on = input != Input::default();
                shown.hand = if is_on { Hand::Heard } else { Hand::Off };
                shown.has_begun |= is_on;
            }
            TrialCommand::Autopilot(on) => {
                trial.set_autopilot(on);
                shown.has_begun |= on;
            }
            TrialCommand::Pause(on) => shown.is_paused = on,
            TrialCommand::Pace(pace) => {
                shown.pace = if pace.is_finite() { f64::from(pace).clamp(0.01, 1.0) } else { 1.0 };
            }
            TrialCommand::Restart { .. } => {
                if let Err(error) = shown.restart() {
                    shown.hand_over();
                    self.fail(&error.to_string());
                }
            }
            TrialCommand::StepBack { .. } => {
                trial.step_back();
                (shown.is_paused, shown.owed, shown.is_told) = (true, 0.0, false);
            }
            TrialCommand::Save => self.save(trial),
            TrialCommand::Replay { csv, .. } => {
                if let Err(message) = replay(shown, &csv) {
                    shown.hand_over();
                    self.fail(&message);
                }
            }
            TrialCommand::Compare { id, mesh } => {
                let job = trial.on(&mesh);
                let comparing = Comparing { mesh, original: None, noise: Noise::default(), orders: 0 };
                self.add_job(id, job, JobKind::Compare(comparing));
            }
            TrialCommand::Start { .. }
            | TrialCommand::Measure { .. }
            | TrialCommand::Cancel { .. }
            | TrialCommand::Stop => {}
        }
    }

    /// Gives up comparing a trial that is no longer what it was.
    fn drop_comparisons(&mut self) {
        self.jobs.retain(|job| matches!(job.kind, JobKind::Measure));
    }

    fn fail(&mut self, message: &str) {
        self.events.push_back(TrialEvent::Failed { message: sentence(message) });
    }

    fn start(&mut self, id: u64, mesh: &Arc<TriMesh>, sample: Option<Sample>, setup: Setup) {
        self.events.push_back(TrialEvent::Preparing { id, fraction: 0.0 });
        match begin(mesh, sample, setup) {
            Ok((trial, course)) => {
                let ready = ready(id, trial.setup(), &course);
                self.events.push_back(TrialEvent::Ready(Box::new(ready)));
                self.drop_comparisons();
                self.shown = Some(Shown::new(id, trial));
            }
            Err(error) => self.refuse_for(id, &error),
        }
    }

    fn save(&mut self, trial: &Trial) {
        let summary = trial.summary();
        match (trial.log().csv(summary.steps), serde_json::to_string_pretty(&summary)) {
            (Ok(csv), Ok(json)) => self.events.push_back(TrialEvent::Saved { csv, json }),
            (Err(error), _) | (_, Err(error)) => self.fail(&format!("the log cannot be written: {error}")),
        }
    }

    fn add_job(&mut self, id: u64, trial: Result<Trial, TrialError>, kind: JobKind) {
        match trial {
            Ok(mut trial) => {
                if matches!(kind, JobKind::Measure) {
                    trial.set_autopilot(true);
                }
                self.jobs.push_back(Job { id, trial: Box::new(trial), kind, told: Instant::now() });
            }
            Err(error) => self.refuse_for(id, &error),
        }
    }

    fn refuse_for(&mut self, id: u64, error: &TrialError) {
        let is_too_thin = matches!(error, TrialError::Route(RouteError::TooThin { .. }));
        self.refuse(id, &error.to_string(), is_too_thin);
    }

    fn refuse(&mut self, id: u64, message: &str, is_too_thin: bool) {
        self.events.push_back(TrialEvent::Refused { id, message: sentence(message), is_too_thin });
    }

    /// Works for a slice at `now_s` seconds by any clock; says after what time it wants to go on, `None` for not before the
    /// next command.
    pub fn advance(&mut self, now_s: f64, slice: Duration) -> Option<Duration> {
        if let Some(shown) = &mut self.shown {
            shown.look_after_hand(now_s);
        }
        if !self.jobs.is_empty() {
            self.work(slice);
            if let Some(shown) = &mut self.shown {
                (shown.clock, shown.owed) = (Some(now_s), 0.0);
            }
            return Some(Duration::ZERO);
        }
        let shown = self.shown.as_mut()?;
        // Time that has passed while it stood is not owed.
        let before = shown.clock.replace(now_s);
        let passed = before.map_or(0.0, |before| (now_s - before).max(0.0));
        let is_over = shown.trial.progress() != Progress::Running;
        if shown.stands() || is_over {
            shown.clock = None;
        } else {
            run(shown, passed, slice);
        }
        let is_over = shown.trial.progress() != Progress::Running;
        let is_end = is_over && !shown.is_told;
        if shown.needs_frame || is_end || now_s - shown.framed >= FRAME && !shown.stands() {
            shown.framed = now_s;
            shown.needs_frame = false;
            let touches = shown.trial.felt_mut().news();
            if !touches.is_empty() {
                self.events.push_back(TrialEvent::Felt { id: shown.id, touches });
            }
            let mut frame = shown.trial.frame();
            (frame.steps_per_second, frame.is_behind) = (shown.speed, shown.is_behind);
            self.events.push_back(TrialEvent::Frame { id: shown.id, frame: Box::new(frame) });
        }
        if is_end {
            shown.is_told = true;
            let summary = Box::new(shown.trial.summary());
            self.events.push_back(TrialEvent::Ended { id: shown.id, summary });
        }
        if is_over || shown.stands() {
            return None;
        }
        let next = if shown.owed >= STEP { 0.0 } else { 2.0 * STEP };
        Some(Duration::from_secs_f64(next))
    }

    /// What it has to tell.
    pub fn poll(&mut self) -> Option<TrialEvent> {
        self.events.pop_front()
    }

    /// Goes on with what runs as fast as it goes.
    fn work(&mut self, slice: Duration) {
        let Some(job) = self.jobs.front_mut() else { return };
        let start = Instant::now();
        while job.trial.progress() == Progress::Running && start.elapsed() < slice {
            job.trial.step();
        }
        if job.trial.progress() == Progress::Running {
            if job.told.elapsed().as_secs_f64() > TELL {
                job.told = Instant::now();
                self.events.push_back(TrialEvent::Busy { id: job.id, fraction: job.fraction() });
            }
            return;
        }
        let Some(Job { id, trial, kind, told }) = self.jobs.pop_front() else { return };
        match (kind, &self.shown) {
            (JobKind::Measure, _) => {
                self.events.push_back(TrialEvent::Measured { id, summary: Box::new(trial.summary()) });
            }
            (JobKind::Compare(mut comparing), Some(shown)) => {
                if let Some(comparison) = comparing.ran(trial, &shown.trial) {
                    self.events.push_back(TrialEvent::Compared { id, comparison: Box::new(comparison) });
                    return;
                }
                match shown.trial.on_shuffled(&comparing.mesh, comparing.orders + 1) {
                    Ok(trial) => self.jobs.push_front(Job {
                        id,
                        trial: Box::new(trial),
                        kind: JobKind::Compare(comparing),
                        told,
                    }),
                    Err(error) => self.refuse_for(id, &error),
                }
            }
            (JobKind::Compare(_), None) => {}
        }
    }
}

impl Comparing {
    /// Takes in a run that is over. Returns what comes of all of them, once none is left to be made.
    fn ran(&mut self, trial: Box<Trial>, shown: &Trial) -> Option<TrialComparison> {
        match &self.original {
            None => self.original = Some(trial),
            Some(original) => {
                self.noise.take(original, &trial);
                self.orders += 1;
            }
        }
        let original = self.original.as_ref().filter(|_| self.orders == SHUFFLES)?;
        Some(TrialComparison::new(shown, original, &self.noise))
    }
}

/// Makes as many steps as the clock asks for, and the slice allows.
fn run(shown: &mut Shown, passed: f64, slice: Duration) {
    shown.owed += passed * shown.pace;
    // After a pause of the machine it goes on, and does not hurry after it.
    shown.is_behind = shown.owed > BEHIND;
    shown.owed = shown.owed.min(BEHIND);
    let start = Instant::now();
    let mut steps = 0;
    while shown.owed >= STEP && start.elapsed() < slice && shown.trial.progress() == Progress::Running {
        shown.trial.step();
        shown.owed -= STEP;
        steps += 1;
    }
    shown.counted.0 += steps;
    shown.counted.1 += start.elapsed().as_secs_f64();
    if shown.counted.0 as f64 * STEP > TELL * shown.pace && shown.counted.1 > 0.0 {
        shown.speed = (shown.counted.0 as f64 / shown.counted.1) as f32;
        shown.counted = (0, 0.0);
    }
}

/// A trial on a surface, and its course.
fn begin(mesh: &Arc<TriMesh>, sample: Option<Sample>, mut setup: Setup) -> Result<(Trial, Arc<Course>), TrialError> {
    let course = Arc::new(Course::new(mesh, sample, &mut setup)?);
    Ok((Trial::new(course.clone(), setup)?, course))
}

/// Begins again with what a log says.
fn replay(shown: &mut Shown, csv: &[u8]) -> Result<(), String> {
    let recorded = Log::read(csv).map_err(|error| error.to_string())?;
    let course = shown.trial.course().clone();
    if recorded.surface != format!("{:016x}", course.fingerprint) {
        return Err("the log is of another surface, or of another level: open that first".to_owned());
    }
    let route = &course.route;
    let is_same =
        recorded.setup.entry == shown.trial.setup().entry && recorded.setup.target == shown.trial.setup().target;
    if !is_same {
        return Err(format!(
            "the log has another entry or target than the route of {:.0} mm that is shown: start a trial with those first",
            route.length_mm
        ));
    }
    let mut trial = Trial::new(course.clone(), recorded.setup).map_err(|error| error.to_string())?;
    trial.replay(recorded.inputs, recorded.steps);
    let pace = shown.pace;
    *shown = Shown { pace, has_begun: true, ..Shown::new(shown.id, trial) };
    Ok(())
}

fn ready(id: u64, setup: &Setup, course: &Course) -> TrialReady {
    TrialReady {
        id,
        setup: setup.clone(),
        route: RouteShown::from(&course.route),
        entries: course.entries.clone(),
        targets: course.targets.clone(),
        wall_ms: course.wall_ms,
        route_ms: course.route_ms,
    }
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
    use crate::trial::frame::Frame;

    const SLICE: Duration = Duration::from_millis(1);

    fn aorta() -> Arc<TriMesh> {
        Arc::new(crate::io::import_mesh(crate::phantom::generate(Sample::Aorta, 20_000).unwrap(), "sample").mesh)
    }

    fn events(engine: &mut TrialEngine) -> Vec<TrialEvent> {
        std::iter::from_fn(|| engine.poll()).collect()
    }

    /// The newest frame, asked for by standing still.
    fn frame(engine: &mut TrialEngine, now_s: f64) -> Frame {
        engine.handle(TrialCommand::Pause(true));
        while engine.advance(now_s, SLICE).is_some() {}
        frames(engine).pop().unwrap().1
    }

    /// What frames were told, each with its number.
    fn frames(engine: &mut TrialEngine) -> Vec<(u64, Frame)> {
        let frame = |event| match event {
            TrialEvent::Frame { id, frame } => Some((id, *frame)),
            _ => None,
        };
        events(engine).into_iter().filter_map(frame).collect()
    }

    /// The frames of 0.4 s of the clock.
    fn run_from(engine: &mut TrialEngine, now_s: f64) -> Vec<(u64, Frame)> {
        (0..20).for_each(|i| _ = engine.advance(now_s + f64::from(i) * 0.02, Duration::from_millis(50)));
        frames(engine)
    }

    #[test]
    fn a_comparison_that_is_cancelled_leaves_the_trial_as_it_stands() {
        let mesh = aorta();
        let mut engine = TrialEngine::new();
        let (sample, setup) = (Some(Sample::Aorta), Setup::default());
        engine.handle(TrialCommand::Start { id: 1, mesh: mesh.clone(), sample, setup: setup.clone() });
        assert!(matches!(events(&mut engine)[..], [TrialEvent::Preparing { id: 1, .. }, TrialEvent::Ready(_)]));
        engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
        for i in 0..200 {
            engine.advance(f64::from(i) * 0.02, Duration::from_millis(50));
        }
        let before = frame(&mut engine, 5.0);
        assert!(before.step > 200, "{}", before.step);
        engine.handle(TrialCommand::Compare { id: 2, mesh: mesh.clone() });
        engine.handle(TrialCommand::Measure { id: 3, mesh, sample, setup });
        assert_eq!(engine.advance(6.0, SLICE), Some(Duration::ZERO), "a job goes on");
        engine.handle(TrialCommand::Cancel { id: 2 });
        assert_eq!(engine.jobs.len(), 1, "the measurement is another's");
        engine.handle(TrialCommand::Cancel { id: 3 });
        let after = frame(&mut engine, 7.0);
        assert_eq!((after.step, &after.nodes), (before.step, &before.nodes));
        engine.handle(TrialCommand::Pause(false));
        for i in 0..10 {
            engine.advance(7.0 + f64::from(i) * 0.02, Duration::from_millis(50));
        }
        assert!(frame(&mut engine, 8.0).step > before.step);
        assert!(!events(&mut engine).iter().any(|event| matches!(event, TrialEvent::Compared { .. })));
    }

    #[test]
    fn time_runs_from_the_first_input_on_and_a_restart_is_by_hand() {
        let mut engine = TrialEngine::new();
        let (sample, setup) = (Some(Sample::Aorta), Setup::default());
        engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
        events(&mut engine);
        assert!(
            matches!(&run_from(&mut engine, 0.0)[..], [(_, frame)] if frame.step == 0),
            "the wire at its entry, once"
        );
        engine.handle(TrialCommand::Save);
        let Some(TrialEvent::Saved { csv, json }) = engine.poll() else { panic!("no log") };
        assert_eq!(Log::read(csv.as_bytes()).unwrap().steps, 0);
        assert!(json.contains("\"steps\": 0"), "{json}");
        engine.handle(TrialCommand::Drive(Input::default()));
        assert_eq!(run_from(&mut engine, 100.0).last().unwrap().1.step, 0, "no input");
        engine.handle(TrialCommand::Autopilot(true));
        let steered = run_from(&mut engine, 300.0);
        let (_, last) = steered.last().unwrap();
        assert!(last.step > 0 && last.time_s < 0.5 && !last.doing.is_empty(), "{last:?}");
        assert!(!steered.iter().any(|(_, frame)| frame.is_behind), "what has passed while it stood is not owed");
        engine.handle(TrialCommand::Restart { id: 2 });
        assert_eq!(run_from(&mut engine, 400.0).last().unwrap().1.step, 0);
        engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
        let (_, by_hand) = run_from(&mut engine, 500.0).pop().unwrap();
        assert!(by_hand.feed == 20.0 && by_hand.doing.is_empty(), "{by_hand:?}");
    }

    #[test]
    fn frames_tell_what_they_belong_to() {
        let mut engine = TrialEngine::new();
        let (sample, setup) = (Some(Sample::Aorta), Setup::default());
        engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
        engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
        let is_of = |frames: &[(u64, Frame)], id| frames.len() > 5 && frames.iter().all(|frame| frame.0 == id);
        let first = run_from(&mut engine, 0.0);
        assert!(is_of(&first, 1), "{first:?}");
        engine.handle(TrialCommand::Restart { id: 5 });
        engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
        let second = run_from(&mut engine, 0.4);
        assert!(is_of(&second, 5) && second[0].1.step < first.last().unwrap().1.step, "{second:?}");
        // What is refused leaves the trial as it stands, and is answered all the same.
        engine.handle(TrialCommand::Replay { id: 6, csv: Arc::new(b"no log".to_vec()) });
        let third = run_from(&mut engine, 0.8);
        assert!(is_of(&third, 6), "{third:?}");
        engine.handle(TrialCommand::StepBack { id: 7 });
        engine.advance(2.0, SLICE);
        assert!(matches!(events(&mut engine)[..], [TrialEvent::Frame { id: 7, .. }]));
    }

    /// Drives for so many seconds of the clock by an input that is told every so many; gives the length that is in the
    /// vessel after each tenth of a second.
    fn inserted(engine: &mut TrialEngine, from_s: f64, seconds: f64, told_every: Option<f64>) -> Vec<f64> {
        let mut lengths = Vec::new();
        let mut due = told_every;
        for i in 0..(seconds * 100.0) as u32 {
            let passed = f64::from(i) / 100.0;
            if due.is_some_and(|due| passed >= due) {
                engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
                due = due.zip(told_every).map(|(due, every)| due + every);
            }
            engine.advance(from_s + passed, Duration::from_millis(50));
            if i % 10 == 9 {
                lengths.extend(engine.shown.as_ref().map(|shown| shown.trial.simulation().inserted()));
            }
        }
        lengths
    }

    #[test]
    fn an_input_that_is_not_told_again_is_let_go() {
        let mut engine = TrialEngine::new();
        let (sample, setup) = (Some(Sample::Aorta), Setup::default());
        engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
        engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
        let told_once = inserted(&mut engine, 0.0, 3.0, None);
        let (first, last) = (told_once[0], told_once[29]);
        // 20 mm/s for as long as an input holds, and for the row of the log that it ends in.
        let most = 20.0 * (HAND + 0.02);
        assert!(first > 1.0 && last <= most + 0.5 && last >= 0.8 * most, "{last} mm of {most}");
        assert!(told_once[10..].iter().all(|&length| (length - last).abs() < 1e-9), "{told_once:?}");
        let told_again = inserted(&mut engine, 3.0, 2.0, Some(0.1));
        let fed = told_again[19] - last;
        assert!((fed - 40.0).abs() < 4.0, "{fed} mm in two seconds");
        // By the clock, whatever the pace: the hand is as far from the simulated time as the user is.
        engine.handle(TrialCommand::Pace(0.25));
        engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
        let slow = inserted(&mut engine, 5.0, 3.0, None);
        let fed = slow[29] - told_again[19];
        assert!(fed > 0.5 * HAND * 5.0 && fed < 5.0 * (HAND + 0.1) + 1.0, "{fed} mm");
        // A machine that slept has no hand on it when it wakes.
        engine.handle(TrialCommand::Pace(1.0));
        engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
        engine.advance(8.0, Duration::from_millis(50));
        let before = inserted(&mut engine, 8.0, 0.1, None)[0];
        let after = inserted(&mut engine, 3600.0, 2.0, None)[19];
        assert!((after - before).abs() < 0.5, "{before} {after}");
    }

    #[test]
    fn the_autopilot_and_a_log_need_no_hand() {
        let mut engine = TrialEngine::new();
        let (sample, setup) = (Some(Sample::Aorta), Setup::default());
        engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
        engine.handle(TrialCommand::Autopilot(true));
        let steered = inserted(&mut engine, 0.0, 3.0, None);
        assert!(steered[29] > 1.5 * 20.0 * HAND && steered[29] > steered[20], "{steered:?}");
        engine.handle(TrialCommand::Save);
        let csv = events(&mut engine).into_iter().find_map(|event| match event {
            TrialEvent::Saved { csv, .. } => Some(csv),
            _ => None,
        });
        let csv = Arc::new(csv.unwrap().into_bytes());
        engine.handle(TrialCommand::Replay { id: 2, csv });
        let replayed = inserted(&mut engine, 10.0, 2.5, None);
        assert!((replayed[20] - steered[20]).abs() < 1.0, "{} {}", replayed[20], steered[20]);
    }

    #[test]
    fn what_the_wall_feels_between_frames_is_told() {
        let mut engine = TrialEngine::new();
        let (sample, setup) = (Some(Sample::Aorta), Setup { proposes_wire: true, ..Setup::default() });
        engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
        engine.handle(TrialCommand::Autopilot(true));
        let (mut felt, mut framed, mut most) = (0.0_f64, 0.0_f64, None);
        let mut last = Progress::Running;
        for i in 0..20_000 {
            // A frame in 25 steps at first, where the largest force is; then as the engine asks for.
            let now_s = if i < 40 { f64::from(i) * BEHIND } else { 40.0 * BEHIND + f64::from(i) * 2.0 * STEP };
            engine.advance(now_s, Duration::from_secs(1));
            for event in events(&mut engine) {
                match event {
                    TrialEvent::Felt { id: 1, touches } => {
                        felt = touches.iter().fold(felt, |most, touch| most.max(f64::from(touch.force)));
                    }
                    TrialEvent::Frame { frame, .. } => {
                        (framed, last) = (framed.max(frame.max_wall_force_n), frame.progress);
                    }
                    TrialEvent::Ended { summary, .. } => most = Some(summary.max_wall_force_n),
                    _ => {}
                }
            }
            if most.is_some() {
                break;
            }
        }
        let most = most.expect("an end");
        assert!((felt / most - 1.0).abs() < 1e-6, "{felt} of {most}");
        assert!(framed < most, "no frame has shown it: {framed} of {most}");
        assert_eq!(last, Progress::Arrived, "the end is shown");
    }

    #[test]
    fn closing_the_trial_lets_measurements_go_on() {
        let mut engine = TrialEngine::new();
        let (sample, setup) = (Some(Sample::Aorta), Setup::default());
        engine.handle(TrialCommand::Measure { id: 7, mesh: aorta(), sample, setup });
        engine.handle(TrialCommand::Stop);
        assert_eq!(engine.advance(0.0, SLICE), Some(Duration::ZERO));
        engine.handle(TrialCommand::Compare { id: 8, mesh: Arc::default() });
        assert!(matches!(events(&mut engine)[..], [TrialEvent::Refused { id: 8, .. }]), "without a trial");
    }
}
