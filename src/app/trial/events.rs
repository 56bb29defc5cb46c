//! How a trial changes by what the engine says.

use super::state::{Coming, Comparing, Open, Problem, Run, Session, Stage, Trial};
use crate::app::platform::Offer;
use crate::engine::trial::{TrialCommand, TrialEvent, TrialLink, TrialReady};
use crate::mesh::{Bounds, Vec3};
use crate::say;

impl Trial {
    /// Hears what the engine has to say; a saved log and its summary are for the user. What is left of a trial, a run or
    /// a comparison that was given up is passed over: its number is none of those that are known.
    pub fn receive(&mut self, event: TrialEvent, link: &mut TrialLink) -> Option<[Offer; 2]> {
        match event {
            TrialEvent::Preparing { id, fraction } => {
                if let Some(Stage::Preparing(preparing)) = self.stage_mut()
                    && preparing.awaits(id)
                {
                    preparing.fraction = fraction;
                }
            }
            TrialEvent::Ready(ready) => self.receive_ready(*ready, link),
            TrialEvent::Refused { id, message, is_too_thin, at } => {
                self.receive_refusal(id, Problem { text: message, is_too_thin, at: at.map(Vec3::from) });
            }
            TrialEvent::Frame { id, frame } => {
                if let Some(session) = self.session_of(id) {
                    session.run.peaks.take(&frame);
                    if session.at_entry.is_none() && frame.step == 0 {
                        session.at_entry = Some((*frame).clone());
                    }
                    session.run.show(*frame);
                    self.show_wire();
                }
            }
            TrialEvent::Felt { id, touches } => {
                if let Some(session) = self.session_of(id) {
                    session.run.peaks.feel(&touches);
                    session.run.felt.extend(touches);
                }
            }
            TrialEvent::Ended { id, summary, end } => {
                if let Some(session) = self.session_of(id) {
                    let missed = summary.missed_fork_at.map(Vec3::from);
                    session.run.summary = Some(*summary);
                    session.run.end = Some(end);
                    if let (Some(open), Some(missed)) = (&mut self.open, missed) {
                        open.flight = Some(missed);
                    }
                }
            }
            TrialEvent::Saved { csv, json } => {
                let stem = format!("{}-trial", self.name.to_lowercase().replace([' ', '.'], "-"));
                let file = |ending: &str, text: String| Offer { name: format!("{stem}.{ending}"), bytes: text.into() };
                return Some([file("csv", csv), file("json", json)]);
            }
            TrialEvent::Compared { id, comparison } => {
                if let Some(run) = self.run_comparing(id) {
                    run.comparing = None;
                    run.comparison = Some(*comparison);
                }
            }
            TrialEvent::Busy { id, fraction } => {
                if let Some(run) = self.run_comparing(id) {
                    run.comparing = Some(Comparing { id, fraction });
                } else if self.tables.is_measuring(id) {
                    self.tables.progresses(fraction);
                }
            }
            TrialEvent::Measured { id, summary } => self.tables.receive(id, summary),
            TrialEvent::Swept { id, row } => self.tables.receive_sweep(id, row),
            TrialEvent::Failed { message } => self.problem = Some(message.into()),
        }
        None
    }

    /// The session whose run has this number.
    fn session_of(&mut self, id: u64) -> Option<&mut Session> {
        self.session_mut().filter(|session| session.run.id == id)
    }

    /// The run whose comparison has this number.
    fn run_comparing(&mut self, id: u64) -> Option<&mut Run> {
        self.session_mut().map(|session| &mut session.run).filter(|run| run.is_comparing(id))
    }

    /// Shows the numbers of the wire that is in, where it was proposed: after another has failed it is not the first.
    fn show_wire(&mut self) {
        let Some(Open { stage: Stage::Association(session), sent, .. }) = self.open.as_deref_mut() else { return };
        for setup in [Some(&mut self.setup), sent.as_mut()].into_iter().flatten() {
            if setup.proposes_wire && setup.wire != *session.wire() {
                setup.wire.clone_from(session.wire());
            }
        }
    }

    fn receive_ready(&mut self, ready: TrialReady, link: &mut TrialLink) {
        let Some(open) = self.open.as_deref_mut() else { return };
        let Stage::Preparing(preparing) = &mut open.stage else { return };
        // Those before it are over; what was asked for since then is not.
        let Some(at) = preparing.coming.iter().position(|coming| coming.id == ready.id) else { return };
        let Some(Coming { id, subject }) = preparing.coming.drain(..=at).next_back() else { return };
        let way: Vec<Vec3> = ready.route.points.iter().map(|&p| p.into()).collect();
        // The numbers of the wire that was proposed are shown.
        for setup in [Some(&mut self.setup), open.sent.as_mut()].into_iter().flatten() {
            if setup.proposes_wire {
                setup.wire.clone_from(&ready.setup.wire);
            }
        }
        let before = preparing.before.as_deref();
        let before =
            before.filter(|before| before.subject.of.document == subject.of.document).map(|before| &before.run);
        let run = Run::new(id, before);
        let session = Box::new(Session { subject, ready, at_entry: None, run });
        let log = if preparing.coming.is_empty() {
            let log = preparing.log.take();
            open.stage = Stage::Association(session);
            log
        } else {
            preparing.before = Some(session);
            None
        };
        open.carm.centre(&Bounds::of(&way));
        if self.is_on() {
            // The engine begins as fast as time.
            self.tell_pace(link);
        }
        self.reset_controls();
        if let Some(csv) = log
            && let Some(id) = self.begin_run(|session, id| Run::new(id, Some(&session.run)))
        {
            link.send(TrialCommand::Replay { id, csv });
        }
    }

    fn receive_refusal(&mut self, id: u64, problem: Problem) {
        if let Some(open) = self.open.as_deref_mut()
            && let Stage::Preparing(preparing) = &mut open.stage
            && preparing.awaits(id)
        {
            let refused = preparing.coming.iter().find(|coming| coming.id == id);
            let refused = refused.map(|coming| coming.subject.mesh.clone());
            preparing.coming.retain(|coming| coming.id > id);
            if preparing.coming.is_empty() {
                open.stage = preparing.before.take().map_or(Stage::Off(refused), Stage::Association);
            }
            open.flight = problem.at;
            self.problem = Some(problem);
        } else if let Some(run) = self.run_comparing(id) {
            run.comparing = None;
            self.problem = Some(problem.text.into());
        } else if self.tables.is_measuring(id) {
            self.tables.fails(&problem.text);
        }
    }

    /// Hears that the engine has stopped by itself; what is open stands.
    pub fn engine_failed(&mut self, reason: &str, link: &mut TrialLink) -> String {
        link.give_up();
        self.tables.fails(&say!("trial-computation-stopped"));
        self.tables.cancel();
        self.end(self.is_open());
        let text = say!("trial-stopped", reason = reason);
        self.problem = Some(text.clone().into());
        text
    }
}
