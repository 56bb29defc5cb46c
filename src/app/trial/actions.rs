//! How a trial does what the user asks for, and follows the hand, the level and the tables.

use std::sync::Arc;

use super::action::{Action, DeviceAsk, Pick};
use super::device::TrialState;
use super::rumble::Felt;
use super::state::{Coming, Comparing, Open, Preparing, Run, Stage, Subject, Trial, taken_from};
use super::tables::{Next, SEEDS, Tables};
use crate::app::document::Document;
use crate::app::keys::Keys;
use crate::app::platform::{Devices, Gamepad, Tone};
use crate::engine::Source;
use crate::engine::trial::{TrialCommand, TrialLink};
use crate::haptics::known::KnownMappings;
use crate::haptics::safety::Halt;
use crate::haptics::service::DeviceCommand;
use crate::mesh::Vec3;
use crate::phantom::Sample;
use crate::pipeline::settings::{Smoothing, Target};
use crate::say;
use crate::trial::log::Log;
use crate::trial::setup::{Entry, Input, Setup};

/// Simulated seconds a second in slow motion.
const SLOW: f32 = 0.25;

impl Trial {
    /// Does what the user asks for. What needs a platform or the settings ([`Action::OpenLog`],
    /// [`Action::AdaptSmoothing`], [`Action::Device`]) is not for here.
    pub fn act(&mut self, action: Action, document: Option<&Document>, link: &mut TrialLink) {
        if action.is_attempt() {
            self.problem = None;
        }
        match action {
            Action::Start => self.start(None, document, link),
            Action::Restart => self.restart(document, link),
            Action::Autopilot => self.set_autopilot(!self.run().is_some_and(|run| run.autopilot), link),
            Action::Pause => {
                if let Some(session) = self.session_on_mut() {
                    session.run.is_paused = !session.run.is_paused;
                    link.send(TrialCommand::Pause(session.run.is_paused));
                }
            }
            Action::Slow => {
                if let Some(open) = &mut self.open {
                    open.is_slow = !open.is_slow;
                    link.send(TrialCommand::Pace(self.pace()));
                }
            }
            Action::StepBack => {
                if let Some(id) = self.begin_run(|session, id| session.run.stepped_back(id)) {
                    link.send(TrialCommand::StepBack { id });
                }
            }
            Action::Save => link.send(TrialCommand::Save),
            Action::Compare => self.compare(link),
            Action::CancelComparison => {
                if let Some(comparing) = self.session_mut().and_then(|session| session.run.comparing.take()) {
                    link.send(TrialCommand::Cancel { id: comparing.id });
                }
            }
            Action::Close => {
                link.send(TrialCommand::Stop);
                self.end(false);
            }
            Action::Set(setup) => self.setup = *setup,
            Action::Pick(pick) => {
                if let Some(open) = &mut self.open {
                    open.pick = pick;
                }
            }
            Action::Place(pick, at) => self.place(pick, at, document, link),
            Action::Arm(arm) => {
                if let Some(open) = &mut self.open {
                    open.carm.act(arm);
                }
            }
            Action::Tables => self.show_tables(document),
            Action::RepeatTables => self.tables.again(),
            Action::Sweep => self.tables.sweep(),
            Action::CancelTables => self.cancel_tables(link),
            Action::CloseTables => self.tables.is_open = false,
            // Files, smoothing and devices are the app's.
            Action::OpenLog | Action::AdaptSmoothing | Action::Device(_) => {}
        }
    }

    /// Starts with the level that is shown, and with a log to be replayed once the wire is in.
    fn start(&mut self, log: Option<Arc<Vec<u8>>>, document: Option<&Document>, link: &mut TrialLink) {
        let level = document.and_then(|d| Some((d, d.shown_mesh()?, d.levels.as_ref()?.1.clone())));
        let Some((document, mesh, levels)) = level else {
            self.problem = Some(say!("trial-no-surface").into());
            return;
        };
        let (id, mesh) = (self.next_number(), Arc::new(mesh));
        document.name.clone_into(&mut self.name);
        let (sample, setup) = (sample_of(document), self.setup.clone());
        let open = self.open.get_or_insert_default();
        (open.awaits, open.flight) = (None, None);
        open.sent = Some(setup.clone());
        let mut preparing = match std::mem::take(&mut open.stage) {
            Stage::Off(_) => Preparing::default(),
            Stage::Preparing(preparing) => Preparing { fraction: 0.0, ..preparing },
            Stage::Association(session) => Preparing { before: Some(session), ..Preparing::default() },
        };
        let subject = Subject { mesh: mesh.clone(), levels, of: taken_from(document) };
        preparing.coming.push(Coming { id, subject });
        preparing.log = log.or(preparing.log);
        open.stage = Stage::Preparing(preparing);
        link.send(TrialCommand::Start { id, mesh, sample, setup });
    }

    fn restart(&mut self, document: Option<&Document>, link: &mut TrialLink) {
        let of = self.session().map(|session| session.subject.of);
        let is_other = document.is_some_and(|document| Some(taken_from(document)) != of);
        if self.has_changed() || is_other {
            self.start(None, document, link);
        } else if let Some(id) = self.begin_run(Run::from_entry) {
            // What is on its way in begins at its entry.
            self.reset_controls();
            link.send(TrialCommand::Restart { id });
        }
    }

    /// Starts with a saved log: what was done then is done again.
    pub fn replay(&mut self, bytes: Vec<u8>, document: Option<&Document>, link: &mut TrialLink) {
        let recorded = Log::read(&bytes).map(|recorded| recorded.setup);
        let csv = Arc::new(bytes);
        let is_same = |setup: &Setup| {
            self.setup_in_force().is_some_and(|force| {
                (force.entry, force.target, &force.wire, &force.next_wires)
                    == (setup.entry, setup.target, &setup.wire, &setup.next_wires)
            })
        };
        match recorded {
            // With another wire another target is proposed: the log's own way is taken.
            Ok(setup) if !(self.is_on() && is_same(&setup)) => {
                self.setup = Setup { proposes_wire: false, ..setup };
                self.start(Some(csv), document, link);
            }
            // What is no log is refused by the engine.
            _ => match self.begin_run(|session, id| Run::new(id, Some(&session.run))) {
                // The log's wire may enter a little otherwise than the one that is shown.
                Some(id) => {
                    self.reset_controls();
                    link.send(TrialCommand::Replay { id, csv });
                }
                None => self.start(Some(csv), document, link),
            },
        }
    }

    fn set_autopilot(&mut self, on: bool, link: &mut TrialLink) {
        let Some(session) = self.session_on_mut() else { return };
        session.run.autopilot = on;
        link.send(TrialCommand::Autopilot(on));
        if on && std::mem::take(&mut session.run.is_paused) {
            link.send(TrialCommand::Pause(false));
        }
    }

    fn pace(&self) -> f32 {
        if self.open().is_some_and(|open| open.is_slow) { SLOW } else { 1.0 }
    }

    /// Tells an engine that has just begun, as fast as time, where it is to be slower.
    pub(super) fn tell_pace(&self, link: &mut TrialLink) {
        if self.open().is_some_and(|open| open.is_slow) {
            link.send(TrialCommand::Pace(self.pace()));
        }
    }

    fn compare(&mut self, link: &mut TrialLink) {
        let id = self.next_number();
        let Some(session) = self.session_on_mut() else { return };
        let levels = &session.subject.levels;
        let whole = levels.extract(&levels.level(Target::Reduction(0)).triangles);
        session.run.comparing = Some(Comparing { id, fraction: 0.0 });
        link.send(TrialCommand::Compare { id, mesh: Arc::new(whole) });
    }

    /// Begins with a place that was picked: where the wire enters, or where it should go.
    fn place(&mut self, pick: Pick, at: Vec3, document: Option<&Document>, link: &mut TrialLink) {
        if let Some(open) = &mut self.open {
            open.pick = None;
        }
        match pick {
            Pick::Target => self.setup.target = Some(at.to_array()),
            Pick::Entry => {
                let direction = self.session().and_then(|session| session.direction_at(at)).unwrap_or(Vec3::Z);
                let direction = direction.normalize_or(Vec3::Z).to_array();
                self.setup.entry = Some(Entry { at: at.to_array(), direction });
            }
        }
        self.start(None, document, link);
    }

    /// Another surface has a level: what was begun or chosen in the one before is no more.
    pub(in crate::app) fn leave_surface(&mut self, link: &mut TrialLink) {
        self.cancel_tables(link);
        if self.is_open() {
            link.send(TrialCommand::Stop);
        }
        self.end(false);
        self.tables = Tables::default();
        // Places in one vessel are nowhere in another.
        (self.setup.entry, self.setup.target) = (None, None);
    }

    fn show_tables(&mut self, document: Option<&Document>) {
        self.tables.is_open = true;
        if let Some(document) = document.filter(|document| self.tables.can_start(document)) {
            // The wire, entry and target of the trial that is on, if one is in this surface.
            let is_on = self.is_on() && self.name == document.name && !self.has_changed();
            let setup = self.setup_in_force().filter(|_| is_on).unwrap_or(&self.setup).clone();
            self.tables.begin(document, sample_of(document), &setup);
        }
    }

    /// Asks for the next row of the tables, or its sweep, if there is one and none is being run.
    pub(in crate::app) fn next_row(&mut self, link: &mut TrialLink) {
        let id = self.number + 1;
        let Some(next) = self.tables.next(id) else { return };
        self.number = id;
        link.send(match next {
            Next::Measure(mesh, sample, setup) => TrialCommand::Measure { id, mesh, sample, setup },
            Next::Sweep([mesh, original], setup) => TrialCommand::Sweep { id, mesh, original, setup, seeds: SEEDS },
        });
    }

    /// Stops the tables; the trial stands.
    fn cancel_tables(&mut self, link: &mut TrialLink) {
        if let Some(id) = self.tables.cancel() {
            link.send(TrialCommand::Cancel { id });
        }
    }

    /// Sets the gentler smoothing; the trial begins once its level is there.
    pub(in crate::app) fn adapt_smoothing(&mut self, smoothing: &mut Smoothing) {
        if let Some(gentler) = self.gentler(smoothing)
            && let Some(open) = &mut self.open
        {
            *smoothing = gentler;
            (self.problem, open.awaits) = (None, Some(gentler));
        }
    }

    /// Begins with the level that was awaited, if it is there: `has_level` says whether the level that is shown is that
    /// of the settings. Where smoothing was set to something else meanwhile, nothing is awaited any more.
    pub(in crate::app) fn follow_level(
        &mut self,
        smoothing: &Smoothing,
        has_level: bool,
        document: Option<&Document>,
        link: &mut TrialLink,
    ) {
        let Some(open) = &mut self.open else { return };
        open.awaits.take_if(|awaited| awaited != smoothing);
        if open.awaits.is_some() && has_level {
            self.start(None, document, link);
        }
    }

    /// Sends what the hand does where that is news. A hand on the wire takes it from the autopilot.
    pub(in crate::app) fn follow_hand(
        &mut self,
        ctx: &egui::Context,
        keys: Keys,
        gamepad: Option<Gamepad>,
        link: &mut TrialLink,
    ) {
        let (is_on, steers_itself) = (self.is_on(), self.run().is_some_and(|run| run.autopilot));
        let Some(Open { hand, .. }) = self.open.as_deref_mut() else { return };
        let held = hand.input(ctx, keys, gamepad);
        let input = if is_on { held } else { Input::default() };
        let is_other = input != hand.told();
        if !hand.tell(input, ctx.input(|input| input.time), steers_itself) {
            return;
        }
        if is_other && steers_itself && input != Input::default() {
            self.set_autopilot(false, link);
        }
        link.send(TrialCommand::Drive(input));
    }

    /// Does what is asked of the haptic device.
    pub(in crate::app) fn act_on_device(&mut self, ask: DeviceAsk, devices: Option<&mut dyn Devices>) {
        match (ask, self.open.as_deref_mut()) {
            (DeviceAsk::Rumble(ask), Some(open)) => return open.rumble.act(ask),
            (DeviceAsk::Sound(on), Some(open)) => return open.sound.turn(on),
            (DeviceAsk::Command(DeviceCommand::Halt(why)), Some(open)) => open.rumble.halt(why),
            _ => {}
        }
        self.device.act(ask, devices);
    }

    /// How strongly a gamepad is to shake from `now_ms` on, 0 to 1, and what is to sound (where `has_sound`), each where it
    /// has to be told; in a hidden window a gamepad is still and nothing sounds.
    pub(in crate::app) fn follow_force(
        &mut self,
        now_ms: f64,
        gamepad: Option<Gamepad>,
        has_sound: bool,
        is_hidden: bool,
    ) -> (Option<f64>, Option<Tone>) {
        let felt = self.take_felt();
        let Some(Open { rumble, sound, .. }) = self.open.as_deref_mut() else { return (None, None) };
        if is_hidden {
            rumble.halt(Halt::Hidden);
        }
        let shake = rumble.follow(now_ms, gamepad.is_some_and(|pad| pad.can_rumble), felt);
        (shake, sound.follow(now_ms, has_sound, felt.filter(|_| !is_hidden)))
    }

    /// The most that the hand has held at the guide since it was last asked, while one does.
    fn take_felt(&mut self) -> Option<Felt> {
        let is_by_hand = self.is_in_hand() && self.run().is_some_and(|run| !run.autopilot);
        let run = &mut self.session_mut()?.run;
        let force = run.take_strongest();
        let step = run.frame.as_ref().filter(|_| is_by_hand)?.step;
        Some(Felt { step, force })
    }

    /// Hears how the haptic device is; in a hidden window its force ends. Says whether the trial has to be paused, or has to go
    /// on ([`Action::Pause`]).
    pub(in crate::app) fn follow_device(&mut self, devices: Option<&mut dyn Devices>, is_hidden: bool) -> bool {
        let run = self.run().filter(|_| self.is_on());
        let state = TrialState {
            is_open: self.is_open(),
            is_driven: run.is_some_and(|run| !run.autopilot),
            is_paused: run.is_some_and(|run| run.is_paused),
        };
        self.device.follow(devices, is_hidden, state)
    }

    /// What feeds and rolls by haptic devices that were used before.
    pub(in crate::app) fn known_mappings(&self) -> &KnownMappings {
        self.device.known()
    }

    /// The same, as it was kept.
    pub(in crate::app) fn set_known_mappings(&mut self, known: KnownMappings) {
        self.device.set_known(known);
    }

    /// How long the haptic device takes from report to report, as a table; `None` before it is known.
    pub(in crate::app) fn latency_table(&self) -> Option<String> {
        self.device.latency_table()
    }

    /// Whether a haptic device is served, and whether its force, or a gamepad's, is armed.
    pub(in crate::app) fn has_device(&self) -> (bool, bool) {
        let rumbles = self.open().is_some_and(|open| open.rumble.is_armed());
        (self.device.is_served(), self.device.is_armed() || rumbles)
    }

    /// Whether the hand is on the wire: then the engine has to be told of it.
    pub(in crate::app) fn is_driven(&self) -> bool {
        self.open().is_some_and(|open| open.hand.told() != Input::default())
    }

    /// Shows the pads for a finger or the mouse.
    pub(in crate::app) fn pads(&mut self, ui: &mut egui::Ui) {
        if let Some(open) = &mut self.open {
            open.hand.pads(ui);
        }
    }
}

/// The sample that a document was made from.
fn sample_of(document: &Document) -> Option<Sample> {
    match document.source {
        Source::Sample { sample, .. } => Some(sample),
        Source::File { .. } | Source::Made { .. } => None,
    }
}
