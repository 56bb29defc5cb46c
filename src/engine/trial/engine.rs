//! The trial as commands and events.

use std::collections::VecDeque;
use std::time::Duration;

use super::haptic_channel::HapticChannel;
use super::jobs::Jobs;
use super::message::{TrialCommand, TrialEvent, TrialReady};
use super::shown::Shown;
use super::start::start;
use crate::engine::machine::{Machine, SLICE};
use crate::language::tell;
use crate::say;
use crate::trial::session::Trial;

/// The trial as commands and events.
#[derive(Default)]
pub struct TrialEngine {
    pub(super) shown: Option<Shown>,
    pub(super) jobs: Jobs,
    events: VecDeque<TrialEvent>,
    exchange: Option<HapticChannel>,
}

impl TrialEngine {
    /// Without a trial.
    pub fn new() -> Self {
        Self::default()
    }

    /// Without a trial; the wire of each that comes is held by whoever is at the other side of `exchange`, beside keys and
    /// pads.
    pub fn with_hand(exchange: HapticChannel) -> Self {
        Self { exchange: Some(exchange), ..Self::default() }
    }

    /// Takes a command.
    pub fn handle(&mut self, command: TrialCommand) {
        match command {
            TrialCommand::Start { id, mesh, sample, setup } => {
                self.events.push_back(TrialEvent::Preparing { id, fraction: 0.0 });
                match start(&mesh, sample, setup, true) {
                    Ok(trial) => {
                        let ready = TrialReady::new(id, trial.setup(), trial.course());
                        self.events.push_back(TrialEvent::Ready(Box::new(ready)));
                        self.jobs.drop_comparisons();
                        self.shown = Some(Shown::new(id, trial, self.exchange.clone()));
                    }
                    Err(error) => self.events.push_back(TrialEvent::refused(id, &error)),
                }
            }
            TrialCommand::Measure { id, mesh, sample, setup } => {
                if let Err(error) = self.jobs.measure(id, &mesh, sample, setup) {
                    self.events.push_back(TrialEvent::refused(id, &error));
                }
            }
            TrialCommand::Sweep { id, mesh, original, setup, seeds } => {
                if let Err(error) = self.jobs.sweep(id, [mesh, original], setup, seeds) {
                    self.events.push_back(TrialEvent::refused(id, &error));
                }
            }
            TrialCommand::Cancel { id } => self.jobs.cancel(id),
            TrialCommand::Stop => {
                self.shown = None;
                self.jobs.drop_comparisons();
            }
            of_shown => self.handle_shown(of_shown),
        }
    }

    /// Takes a command that acts on the trial that is shown.
    fn handle_shown(&mut self, command: TrialCommand) {
        let Some(shown) = &mut self.shown else {
            self.events.push_back(match command {
                TrialCommand::Compare { id, .. } => TrialEvent::refused_without_trial(id),
                _ => TrialEvent::failed_without_trial(),
            });
            return;
        };
        let begun = match &command {
            TrialCommand::Restart { id } | TrialCommand::StepBack { id } | TrialCommand::Replay { id, .. } => Some(*id),
            _ => None,
        };
        if let Some(id) = begun {
            shown.begin(id);
            self.jobs.drop_comparisons();
        }
        match command {
            TrialCommand::Drive(input) => shown.drive(input),
            TrialCommand::Autopilot(on) => shown.set_autopilot(on),
            TrialCommand::Pause(on) => shown.pause(on),
            TrialCommand::Pace(pace) => shown.set_pace(pace),
            TrialCommand::Restart { .. } => {
                if let Err(error) = shown.restart() {
                    self.events.push_back(TrialEvent::failed(&tell(&error)));
                }
            }
            TrialCommand::StepBack { .. } => shown.step_back(),
            TrialCommand::Save => self.events.push_back(saved(shown.trial())),
            TrialCommand::Replay { csv, .. } => {
                if let Err(message) = shown.replay(&csv) {
                    self.events.push_back(TrialEvent::failed(&message));
                }
            }
            TrialCommand::Compare { id, mesh } => {
                if let Err(error) = self.jobs.compare(id, shown.trial(), mesh) {
                    self.events.push_back(TrialEvent::refused(id, &error));
                }
            }
            TrialCommand::Start { .. }
            | TrialCommand::Measure { .. }
            | TrialCommand::Sweep { .. }
            | TrialCommand::Cancel { .. }
            | TrialCommand::Stop => {}
        }
        if begun.is_some() {
            shown.tell_felt_again();
        }
        shown.needs_frame();
    }

    /// Works for a slice at `now_s` seconds by any clock; says after what time it wants to go on, `None` for not before the
    /// next command.
    pub fn advance(&mut self, now_s: f64, slice: Duration) -> Option<Duration> {
        if let Some(shown) = &mut self.shown {
            shown.look_after_hand(now_s);
        }
        if !self.jobs.is_empty() {
            self.jobs.work(slice, self.shown.as_ref().map(Shown::trial), &mut self.events);
            if let Some(shown) = &mut self.shown {
                shown.wait(now_s);
            }
            return Some(Duration::ZERO);
        }
        self.shown.as_mut()?.advance(now_s, slice, &mut self.events)
    }

    /// What it has to tell.
    pub fn poll(&mut self) -> Option<TrialEvent> {
        self.events.pop_front()
    }
}

/// The log of a trial and its summary.
fn saved(trial: &Trial) -> TrialEvent {
    let summary = trial.summary();
    match (trial.log().csv(summary.steps), serde_json::to_string_pretty(&summary)) {
        (Ok(csv), Ok(json)) => TrialEvent::Saved { csv, json },
        (Err(error), _) | (_, Err(error)) => {
            TrialEvent::failed(&say!("devices-log-not-written", error = error.to_string()))
        }
    }
}

impl Machine for TrialEngine {
    type Command = TrialCommand;
    type Event = TrialEvent;

    fn handle(&mut self, command: TrialCommand) {
        self.handle(command);
    }

    fn advance(&mut self, now_s: f64) -> Option<Duration> {
        self.advance(now_s, SLICE)
    }

    fn poll(&mut self) -> Option<TrialEvent> {
        self.poll()
    }

    fn is_passing(event: &TrialEvent) -> bool {
        matches!(event, TrialEvent::Frame { .. })
    }
}
