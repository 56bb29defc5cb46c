//! The guidewire trial in the window.
//!
//! - [`Trial`]: what the app knows of it, and how that changes by the user's hand and by what the engine says. It draws
//!   nothing.
//! - [`Ask`]: what the user asks for. `panel`, `setup`, `readout`, `outcome`, `drive`: the controls and the numbers;
//!   `tables`: the paper's Tables III and IV.
//! - `view`, `marks`: the three views and what is written over them; `scene`: what stands in GPU memory; `carm`,
//!   `peaks`: the C-arm, the largest forces.

mod ask;
mod carm;
mod drive;
mod marks;
mod outcome;
mod panel;
mod peaks;
mod readout;
mod scene;
mod setup;
mod tables;
mod view;

use std::sync::Arc;

pub use self::ask::{Ask, Offer, Pick, Stage};
pub use self::carm::CArm;
pub(super) use self::panel::{keys, show as panel};
pub use self::tables::Tables;
pub(super) use self::view::TrialView;
use super::document::{Document, Revision};
use super::keys::Keys;
use super::platform::Gamepad;
use crate::engine::Source;
use crate::engine::trial::{HAND, TrialCommand, TrialComparison, TrialEvent, TrialLink, TrialReady};
use crate::mesh::{TriMesh, Vec3};
use crate::phantom::Sample;
use crate::pipeline::progressive::ProgressiveMesh;
use crate::pipeline::settings::{Smoothing, Target};
use crate::trial::frame::{Frame, Progress, Touch};
use crate::trial::log::Log;
use crate::trial::setup::{Entry, Input, Setup};
use crate::trial::summary::Summary;
use crate::trial::wire::Wire;

/// Simulated seconds a second in slow motion.
const SLOW: f32 = 0.25;

/// The pass band and the iterations that are offered where smoothing leaves no room for the wire.
const GENTLE: (f64, u32) = (0.1, 30);

/// What is said until that level is there.
const AWAITS: &str = "Smoothing less: the trial starts when the new level is there.";

/// The surface of a trial.
struct Subject {
    /// The level that the wire is in.
    mesh: Arc<TriMesh>,
    /// All levels.
    levels: Arc<ProgressiveMesh>,
    /// What they were taken from.
    of: Revision,
}

/// What the app knows of the trial.
#[derive(Default)]
pub struct Trial {
    /// All that decides it, as the controls have it.
    pub setup: Setup,
    /// How far it is.
    pub stage: Stage,
    /// Whether its views are shown.
    pub is_open: bool,
    /// The surface, the way and the places that can be chosen.
    pub ready: Option<TrialReady>,
    /// The wire now.
    pub frame: Option<Frame>,
    /// What came of it, once it is over.
    pub summary: Option<Summary>,
    /// What the unreduced surface makes of it.
    pub comparison: Option<TrialComparison>,
    /// How far a comparison is, 0 to 1.
    pub comparing: Option<f32>,
    /// The paper's tables.
    pub tables: Tables,
    /// Whether the autopilot steers.
    pub autopilot: bool,
    /// Whether it stands still.
    pub is_paused: bool,
    /// Whether it is in slow motion.
    pub is_slow: bool,
    /// What the next click on the vessel chooses.
    pub pick: Option<Pick>,
    /// The fluoroscope.
    pub carm: CArm,
    /// Why the last thing asked for could not be done.
    pub problem: Option<String>,
    /// Whether that is a lumen thinner than the wire.
    is_too_thin: bool,
    /// The smoothing whose level is awaited: it begins with that.
    awaits: Option<Smoothing>,
    /// What the wall has felt since the wire was at the entry, in the order in which it was told.
    felt: Vec<Touch>,
    /// The largest forces since then.
    peaks: readout::Largest,
    drive: drive::Drive,
    /// The input that the engine has, and when it was told, by the window's clock.
    driven: Input,
    told_s: f64,
    /// The wire at its entry: what a restart shows until the engine has answered.
    at_entry: Option<Frame>,
    /// Counts up with every frame in which the wire is another than in the one before: a beginning has a step of the same
    /// number.
    pictures: u64,
    /// The surface of the trial, once it is on.
    subject: Option<Subject>,
    /// The numbers and the surfaces of those that are on their way in, in order.
    coming: Vec<(u64, Subject)>,
    /// The setup that the engine has, as the controls had it.
    sent: Option<Setup>,
    /// The number of the newest command that has one.
    number: u64,
    /// That of the last start, restart, step back or replay: frames of those before are not shown.
    begun: u64,
    /// That of the newest comparison.
    compared: u64,
    /// A log to be replayed once the wire is in.
    log: Option<Arc<Vec<u8>>>,
    /// Counts up with every trial, every beginning and every step back: forces that were felt before are forgotten.
    runs: u64,
    /// The name of the surface.
    name: String,
}

impl Trial {
    /// None is on; the wire is to be the one that is proposed.
    pub(super) fn new() -> Self {
        Self { setup: Setup { proposes_wire: true, ..Setup::default() }, ..Self::default() }
    }

    /// Whether a hand can move the wire: then it is looked after, as a gamepad tells nothing by itself.
    pub fn is_in_hand(&self) -> bool {
        let is_over = self.frame.as_ref().is_some_and(|frame| frame.progress != Progress::Running);
        self.stage == Stage::On && !(self.is_paused || is_over || self.summary.is_some())
    }

    /// Whether frames come by themselves: at its entry the wire waits for the first input, and asks for none.
    pub fn is_moving(&self) -> bool {
        self.is_in_hand() && self.frame.as_ref().is_some_and(|frame| frame.step > 0)
    }

    /// Whether something is being computed for it.
    pub fn is_busy(&self) -> bool {
        matches!(self.stage, Stage::Preparing(_)) || self.comparing.is_some() || self.tables.is_busy()
    }

    /// The setup in force, with its entry and its target.
    pub fn setup_in_force(&self) -> Option<&Setup> {
        self.ready.as_ref().map(|ready| &ready.setup)
    }

    /// The wire that is proposed for the way that is shown, where one was.
    fn proposed_wire(&self) -> Option<&Wire> {
        let is_proposed = self.coming.is_empty() && self.sent.as_ref().is_some_and(|sent| sent.proposes_wire);
        self.setup_in_force().filter(|_| is_proposed).map(|setup| &setup.wire)
    }

    /// The smoothing that is offered in place of `smoothing`, where the lumen is too thin for the wire.
    fn gentler(&self, smoothing: &Smoothing) -> Option<Smoothing> {
        let (pass_band, iterations) = GENTLE;
        let is_stronger = smoothing.iterations > 0 && smoothing.pass_band < pass_band;
        (self.is_too_thin && is_stronger).then_some(Smoothing { pass_band, iterations, ..*smoothing })
    }

    /// Sets the gentler smoothing; the trial begins once its level is there.
    pub(super) fn smooth_less(&mut self, smoothing: &mut Smoothing) {
        if let Some(gentler) = self.gentler(smoothing) {
            *smoothing = gentler;
            (self.problem, self.is_too_thin, self.awaits) = (None, false, Some(gentler));
        }
    }

    /// Begins with the level that was awaited, if it is there: `has_level` says whether the level that is shown is that
    /// of the settings. Where smoothing was set to something else meanwhile, nothing is awaited any more.
    pub(super) fn follow_level(
        &mut self,
        smoothing: &Smoothing,
        has_level: bool,
        document: Option<&Document>,
        link: &mut TrialLink,
    ) {
        self.awaits.take_if(|awaited| awaited != smoothing);
        if self.awaits.is_some() && has_level {
            self.start(document, link);
        }
    }

    /// Whether the controls say other than what the wire is in for.
    pub fn has_changed(&self) -> bool {
        let is_proposed = |sent: &Setup| sent.proposes_wire && self.setup.proposes_wire;
        let as_now = |sent: &Setup| Setup {
            wire: if is_proposed(sent) { self.setup.wire.clone() } else { sent.wire.clone() },
            ..sent.clone()
        };
        self.sent.as_ref().is_some_and(|sent| as_now(sent) != self.setup)
    }

    /// Does what the user asks for. What needs a platform or the settings ([`Ask::OpenLog`],
    /// [`Ask::SmoothLess`]) is not for here.
    pub fn act(&mut self, ask: &Ask, document: Option<&Document>, link: &mut TrialLink) {
        (self.problem, self.is_too_thin) = (None, false);
        match ask {
            Ask::Start => self.start(document, link),
            Ask::Restart => {
                let of = self.subject.as_ref().map(|subject| subject.of);
                let is_other = document.is_some_and(|document| Some(taken_from(document)) != of);
                if self.has_changed() || is_other {
                    self.start(document, link);
                } else if self.coming.is_empty() {
                    // What is on its way in begins at its entry.
                    let id = self.next_begun();
                    self.begin_again();
                    self.show(self.at_entry.clone());
                    link.send(TrialCommand::Restart { id });
                }
            }
            Ask::Autopilot => self.set_autopilot(!self.autopilot, link),
            Ask::Pause => {
                self.is_paused = !self.is_paused;
                link.send(TrialCommand::Pause(self.is_paused));
            }
            Ask::Slow => {
                self.is_slow = !self.is_slow;
                link.send(TrialCommand::Pace(if self.is_slow { SLOW } else { 1.0 }));
            }
            Ask::StepBack => {
                self.is_paused = true;
                (self.summary, self.comparison, self.comparing) = (None, None, None);
                // What was felt up to there is told again.
                self.forget_felt();
                link.send(TrialCommand::StepBack { id: self.next_begun() });
            }
            Ask::Save => link.send(TrialCommand::Save),
            Ask::Compare => {
                if let Some(Subject { levels, .. }) = &self.subject {
                    let whole = levels.extract(&levels.level(Target::Reduction(0)).triangles);
                    self.number += 1;
                    (self.compared, self.comparing) = (self.number, Some(0.0));
                    link.send(TrialCommand::Compare { id: self.number, mesh: Arc::new(whole) });
                }
            }
            Ask::CancelComparison => {
                if self.comparing.take().is_some() {
                    link.send(TrialCommand::Cancel { id: self.compared });
                }
            }
            Ask::Tables => {
                self.tables.is_open = true;
                if let Some(document) = document.filter(|document| self.tables.can_start(document)) {
                    // The wire, entry and target of the trial that is on, if one is in this surface.
                    let is_on = self.stage == Stage::On && self.name == document.name && !self.has_changed();
                    let setup = self.setup_in_force().filter(|_| is_on).unwrap_or(&self.setup).clone();
                    self.tables.begin(document, sample_of(document), &setup);
                }
            }
            Ask::Close => self.close(link),
            // Smoothing is the app's.
            Ask::OpenLog | Ask::SmoothLess => {}
        }
    }

    /// Asks for the next row of the tables, if there is one and none is being run.
    pub(super) fn next_row(&mut self, link: &mut TrialLink) {
        if let Some((mesh, sample, setup)) = self.tables.next() {
            self.number += 1;
            self.tables.started(self.number, mesh.triangles.len());
            link.send(TrialCommand::Measure { id: self.number, mesh, sample, setup });
        }
    }

    fn start(&mut self, document: Option<&Document>, link: &mut TrialLink) {
        let level = document.and_then(|d| Some((d, d.shown_mesh()?, d.levels.as_ref()?.1.clone())));
        let Some((document, mesh, levels)) = level else {
            self.problem = Some("There is no surface to steer through yet.".to_owned());
            return;
        };
        self.awaits = None;
        self.number += 1;
        let (id, mesh) = (self.number, Arc::new(mesh));
        document.name.clone_into(&mut self.name);
        let (sample, setup) = (sample_of(document), self.setup.clone());
        self.sent = Some(setup.clone());
        self.coming.push((id, Subject { mesh: mesh.clone(), levels, of: taken_from(document) }));
        self.stage = Stage::Preparing(0.0);
        self.is_open = true;
        link.send(TrialCommand::Start { id, mesh, sample, setup });
    }

    /// Starts with a saved log: what was done then is done again.
    pub fn replay(&mut self, bytes: Vec<u8>, document: Option<&Document>, link: &mut TrialLink) {
        let recorded = Log::read(&bytes).map(|recorded| recorded.setup);
        let csv = Arc::new(bytes);
        let same = |setup: &&Setup| {
            self.setup_in_force().is_some_and(|force| (force.entry, force.target) == (setup.entry, setup.target))
        };
        match recorded {
            // With another wire another target is proposed: the log's own way is taken.
            Ok(setup) if self.stage != Stage::On || Some(&setup).filter(same).is_none() => {
                self.setup = Setup { proposes_wire: false, ..setup };
                self.log = Some(csv);
                self.start(document, link);
            }
            // What is no log is refused by the engine.
            _ if self.stage == Stage::On => {
                let id = self.next_begun();
                self.begin_again();
                // The log's wire may enter a little otherwise.
                self.show(None);
                link.send(TrialCommand::Replay { id, csv });
            }
            _ => {
                self.log = Some(csv);
                self.start(document, link);
            }
        }
    }

    /// A number for what begins now.
    fn next_begun(&mut self) -> u64 {
        self.number += 1;
        self.begun = self.number;
        self.begun
    }

    fn begin_again(&mut self) {
        (self.summary, self.comparison, self.comparing) = (None, None, None);
        self.forget_felt();
        self.carm.reset();
        (self.autopilot, self.is_paused) = (false, false);
        self.driven = Input::default();
    }

    /// Nothing was felt yet.
    fn forget_felt(&mut self) {
        self.felt.clear();
        self.runs += 1;
        self.peaks = readout::Largest::default();
    }

    /// Shows the wire as it is in `frame`.
    fn show(&mut self, frame: Option<Frame>) {
        let is_same = match (&self.frame, &frame) {
            (Some(before), Some(frame)) => (before.step, &before.nodes) == (frame.step, &frame.nodes),
            (before, frame) => before.is_none() && frame.is_none(),
        };
        self.pictures += u64::from(!is_same);
        self.frame = frame;
    }

    fn set_autopilot(&mut self, on: bool, link: &mut TrialLink) {
        self.autopilot = on;
        link.send(TrialCommand::Autopilot(on));
        if on && self.is_paused {
            self.is_paused = false;
            link.send(TrialCommand::Pause(false));
        }
    }

    /// Back to the surface; the trial ends.
    fn close(&mut self, link: &mut TrialLink) {
        link.send(TrialCommand::Stop);
        self.forget();
    }

    fn forget(&mut self) {
        let (setup, tables, number) = (std::mem::take(&mut self.setup), std::mem::take(&mut self.tables), self.number);
        let (name, runs, pictures) = (std::mem::take(&mut self.name), self.runs + 1, self.pictures + 1);
        *self = Self { setup, tables, number, name, runs, pictures, ..Self::default() };
    }

    /// Another surface was opened: what was begun or chosen in the one before is no more.
    pub(super) fn leave_surface(&mut self, link: &mut TrialLink) {
        self.cancel_tables(link);
        if self.is_open {
            link.send(TrialCommand::Stop);
        }
        self.forget();
        self.tables = Tables::default();
        // Places in one vessel are nowhere in another.
        (self.setup.entry, self.setup.target) = (None, None);
    }

    /// Sends what the hand does where it has changed, and again and again while it is on the wire: the engine lets go of
    /// what it does not hear of any more. A hand on the wire takes it from the autopilot.
    pub(super) fn follow_hand(
        &mut self,
        ctx: &egui::Context,
        keys: Keys,
        gamepad: Option<Gamepad>,
        link: &mut TrialLink,
    ) {
        let hand = self.drive.input(ctx, keys, gamepad);
        let input = if self.stage == Stage::On { hand } else { Input::default() };
        let is_on = input != Input::default();
        let now_s = ctx.input(|input| input.time);
        if input == self.driven {
            let is_due = now_s - self.told_s >= HAND / 5.0;
            if !is_on || self.autopilot || !is_due {
                return;
            }
        } else if self.autopilot && is_on {
            self.set_autopilot(false, link);
        }
        (self.driven, self.told_s) = (input, now_s);
        link.send(TrialCommand::Drive(input));
    }

    /// Whether the hand is on the wire: then the engine has to be told of it.
    pub(super) fn is_driven(&self) -> bool {
        self.driven != Input::default()
    }

    /// Shows the pads for a finger or the mouse.
    pub(super) fn pads(&mut self, ui: &mut egui::Ui) {
        self.drive.pads(ui);
    }

    /// Chooses a place: where the wire enters, or where it should go.
    pub(super) fn choose(&mut self, pick: Pick, at: Vec3, document: Option<&Document>, link: &mut TrialLink) {
        self.pick = None;
        match pick {
            Pick::Target => self.setup.target = Some(at.to_array()),
            Pick::Entry => {
                let direction = self.direction_at(at).to_array();
                self.setup.entry = Some(Entry { at: at.to_array(), direction });
            }
        }
        self.start(document, link);
    }

    /// Along the way where it passes; else towards the target.
    fn direction_at(&self, at: Vec3) -> Vec3 {
        let points = self.ready.as_ref().map_or(&[][..], |ready| &ready.route.points);
        let away = |p: &[f32; 3]| Vec3::from(*p).distance(at);
        let nearest = (0..points.len()).min_by(|&a, &b| away(&points[a]).total_cmp(&away(&points[b])));
        let along = nearest.filter(|&i| away(&points[i]) < 10.0).map(|i| {
            let (before, after) = (i.saturating_sub(2), (i + 2).min(points.len() - 1));
            Vec3::from(points[after]) - Vec3::from(points[before])
        });
        let target = self.setup_in_force().and_then(|setup| setup.target);
        along.or_else(|| Some(Vec3::from(target?) - at)).unwrap_or(Vec3::Z).normalize_or(Vec3::Z)
    }

    /// Hears what the engine has to say; a saved log and its summary are for the user.
    pub fn receive(&mut self, event: TrialEvent, link: &mut TrialLink) -> Option<[Offer; 2]> {
        match event {
            TrialEvent::Preparing { id, fraction } if self.is_coming(id) => self.stage = Stage::Preparing(fraction),
            TrialEvent::Ready(ready) if self.is_coming(ready.id) => self.receive_ready(*ready, link),
            TrialEvent::Refused { id, message, is_too_thin } if self.is_coming(id) => {
                self.coming.retain(|(coming, _)| *coming > id);
                (self.problem, self.is_too_thin) = (Some(message), is_too_thin);
                if self.coming.is_empty() {
                    self.log = None;
                    self.stage = if self.subject.is_some() { Stage::On } else { Stage::Off };
                }
            }
            TrialEvent::Refused { id, message, .. } if self.is_compared(id) => {
                self.comparing = None;
                self.problem = Some(message);
            }
            TrialEvent::Refused { id, message, .. } if self.tables.is_measuring(id) => self.tables.fails(&message),
            // What is left of a trial that was given up.
            TrialEvent::Preparing { .. } | TrialEvent::Ready(_) | TrialEvent::Refused { .. } => {}
            TrialEvent::Frame { id, frame } if id == self.begun => {
                self.peaks.take(&frame);
                if self.at_entry.is_none() && frame.step == 0 {
                    self.at_entry = Some((*frame).clone());
                }
                self.show(Some(*frame));
            }
            TrialEvent::Felt { id, touches } if id == self.begun => {
                self.peaks.feel(&touches);
                self.felt.extend(touches);
            }
            TrialEvent::Ended { id, summary } if id == self.begun => self.summary = Some(*summary),
            TrialEvent::Frame { .. } | TrialEvent::Felt { .. } | TrialEvent::Ended { .. } => {}
            TrialEvent::Saved { csv, json } => {
                let stem = format!("{}-trial", self.name.to_lowercase().replace([' ', '.'], "-"));
                let file = |ending: &str, text: String| Offer { name: format!("{stem}.{ending}"), bytes: text.into() };
                return Some([file("csv", csv), file("json", json)]);
            }
            TrialEvent::Compared { id, comparison } if self.is_compared(id) => {
                self.comparing = None;
                self.comparison = Some(*comparison);
            }
            TrialEvent::Busy { id, fraction } if self.is_compared(id) => self.comparing = Some(fraction),
            TrialEvent::Busy { id, fraction } if self.tables.is_measuring(id) => self.tables.progresses(fraction),
            // Of one that was cancelled.
            TrialEvent::Compared { .. } | TrialEvent::Busy { .. } => {}
            TrialEvent::Measured { id, summary } => {
                self.tables.receive(id, summary);
            }
            TrialEvent::Failed { message } => {
                self.problem = Some(message);
            }
        }
        None
    }

    /// The surface that the wire is in.
    pub(super) fn mesh(&self) -> Option<&Arc<TriMesh>> {
        self.subject.as_ref().map(|subject| &subject.mesh)
    }

    fn is_coming(&self, id: u64) -> bool {
        self.coming.iter().any(|(coming, _)| *coming == id)
    }

    /// Whether this is the number of the comparison that is awaited.
    fn is_compared(&self, id: u64) -> bool {
        self.comparing.is_some() && self.compared == id
    }

    fn receive_ready(&mut self, ready: TrialReady, link: &mut TrialLink) {
        // Those before it are over; what was asked for since then is not.
        let Some(at) = self.coming.iter().position(|(id, _)| *id == ready.id) else { return };
        self.subject = self.coming.drain(..=at).next_back().map(|(_, subject)| subject);
        self.begun = self.begun.max(ready.id);
        self.begin_again();
        self.at_entry = None;
        self.show(None);
        let way: Vec<Vec3> = ready.route.points.iter().map(|&p| p.into()).collect();
        self.carm.centre(&crate::mesh::Bounds::of(&way));
        // The numbers of the wire that was proposed are shown.
        for setup in [Some(&mut self.setup), self.sent.as_mut()].into_iter().flatten() {
            if setup.proposes_wire {
                setup.wire.clone_from(&ready.setup.wire);
            }
        }
        self.ready = Some(ready);
        if !self.coming.is_empty() {
            return;
        }
        self.stage = Stage::On;
        // The engine begins as fast as time.
        if self.is_slow {
            link.send(TrialCommand::Pace(SLOW));
        }
        if let Some(csv) = self.log.take() {
            link.send(TrialCommand::Replay { id: self.next_begun(), csv });
        }
    }

    /// Stops the tables; the trial stands.
    pub fn cancel_tables(&mut self, link: &mut TrialLink) {
        if let Some(id) = self.tables.cancel() {
            link.send(TrialCommand::Cancel { id });
        }
    }

    /// Hears that the window's clock begins anew.
    pub(super) fn restart_clock(&mut self) {
        self.carm.restart_clock();
        // The fingers were on another canvas, and the clock is another window's.
        self.drive.let_go();
        self.told_s = f64::NEG_INFINITY;
    }

    /// Hears that the engine has stopped by itself; what is open stands.
    pub fn engine_failed(&mut self, reason: &str, link: &mut TrialLink) -> String {
        link.give_up();
        let is_open = self.is_open;
        self.tables.fails("The computation stopped.");
        self.tables.cancel();
        self.forget();
        self.is_open = is_open;
        let text = format!("The trial stopped ({reason}). The surface is still open; start again.");
        self.problem = Some(text.clone());
        text
    }
}

/// The sample that a document was made from.
fn sample_of(document: &Document) -> Option<Sample> {
    match document.source {
        Source::Sample { sample, .. } => Some(sample),
        Source::File { .. } => None,
    }
}

/// What of a document its level comes from.
fn taken_from(document: &Document) -> Revision {
    Revision { measured: 0, opened: 0, ..document.revision }
}
