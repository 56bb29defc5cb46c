//! A haptic device on a thread of its own, at the device's pace: reports in and out, and the trial's hand at the other side of
//! an [`Exchange`].

use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::hid::{Found, HidPort, find};
use crate::engine::trial::Exchange;
use crate::haptics::descriptor::ModelError;
use crate::haptics::device::{HapticDevice, Identity, Resistance};
use crate::haptics::latency::Percentiles;
use crate::haptics::learning::{Ask, Learning};
use crate::haptics::mapping::Mapping;
use crate::haptics::port::{Port, PortError, carry_out};
use crate::haptics::safety::Halt;
use crate::haptics::virtual_feeder::VirtualFeeder;

/// Between two looks at the device: reports come at 1 kHz at most.
const LOOK: Duration = Duration::from_micros(500);
/// Requests that are carried out in a look at most, so that input is never far behind.
const REQUESTS: usize = 4;

/// A device that can be chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Choice {
    /// What it is called.
    pub name: String,
    /// The system's, or none for the virtual one.
    found: Option<Found>,
}

/// What a device is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DeviceCommand {
    /// The user has seen what will move, and lets it.
    Arm,
    /// Force ends until it is armed again.
    Halt(Halt),
    /// Force ends while the trial is paused.
    Pause(bool),
    /// Other axes feed and roll.
    Map(Mapping),
    /// Learns which axes those are: a push, then a turn.
    Learn,
    /// The part of the device's most force that 1 N, and 1 N mm, are felt as.
    Factor([f64; 2]),
    /// Where the hand on the virtual device wants it, in mm and radians.
    Want([f64; 2]),
}

/// How a device is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviceStatus {
    /// What it is called.
    pub name: String,
    /// Of each axis its name and where it is, -1 to 1, and its last number.
    pub axes: Vec<(String, f64, i64)>,
    /// Which feed and roll.
    pub mapping: Mapping,
    /// What the user is asked for while a mapping is learnt.
    pub asks: Option<Ask>,
    /// Whether it can give a force, and why it does not now.
    pub has_force: bool,
    /// Why there is no force now; `None` where it is armed.
    pub halted: Option<Halt>,
    /// What is felt now, in N and N mm; none without a trial.
    pub felt: Option<[f64; 2]>,
    /// From input report to output report.
    pub latency: Percentiles,
    /// Why it is no longer served, in one sentence.
    pub ended: Option<String>,
}

/// Why a device is no longer served.
#[derive(Debug, thiserror::Error)]
enum ServeError {
    #[error(transparent)]
    Open(#[from] super::hid::OpenError),
    #[error(transparent)]
    Model(#[from] ModelError),
    #[error(transparent)]
    Port(#[from] PortError),
}

/// A device that is served.
pub struct Served {
    commands: Sender<DeviceCommand>,
    status: Arc<Mutex<DeviceStatus>>,
}

/// What can be chosen: the virtual device, then all that the system has. The second is why the system lists none, if so.
pub fn choices() -> (Vec<Choice>, Option<String>) {
    let mut choices = vec![Choice { name: "Virtual device".to_owned(), found: None }];
    match find() {
        Ok(found) => {
            choices.extend(
                found.into_iter().map(|found| Choice { name: found.identity.name.clone(), found: Some(found) }),
            );
            (choices, None)
        }
        Err(error) => (choices, Some(error.to_string())),
    }
}

impl Served {
    /// Serves a device until this is dropped: its hand is the one of `exchange`.
    pub fn new(choice: Choice, exchange: Exchange) -> Self {
        let (commands, inbox) = channel();
        let status = Arc::new(Mutex::new(DeviceStatus { name: choice.name.clone(), ..DeviceStatus::default() }));
        let told = Arc::clone(&status);
        thread::spawn(move || {
            let ended = match choice.found {
                None => Server::new(VirtualFeeder::default(), Identity::default(), exchange)
                    .map(|server| server.serve(&inbox, &told, VirtualFeeder::keep_pace)),
                Some(found) => HidPort::open(&found).map_err(ServeError::from).and_then(|port| {
                    Server::new(port, found.identity, exchange).map(|server| server.serve(&inbox, &told, |_, _, _| {}))
                }),
            };
            if let Ok(Err(error)) | Err(error) = ended {
                told.lock().unwrap_or_else(PoisonError::into_inner).ended = Some(error.to_string());
            }
        });
        Self { commands, status }
    }

    /// Asks for something; a device that is no longer served does nothing.
    pub fn ask(&self, command: DeviceCommand) {
        // Its status says that it has ended, and why.
        let _ = self.commands.send(command);
    }

    /// How it is now.
    pub fn status(&self) -> DeviceStatus {
        self.status.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// What the virtual device is told beside reports: the time in ms, and where its hand wants it.
trait Paced {
    fn keep_pace(&mut self, now_ms: f64, wanted: [f64; 2]);
}

impl Paced for VirtualFeeder {
    fn keep_pace(&mut self, now_ms: f64, wanted: [f64; 2]) {
        // After a pause of the machine it goes on, and does not hurry after it.
        let due = (now_ms as u32).saturating_sub(self.now_ms());
        (0..2).for_each(|axis| self.hands[axis].wanted = wanted[axis]);
        (0..due.min(50)).for_each(|_| self.advance());
    }
}

struct Server<P> {
    port: P,
    device: HapticDevice,
    exchange: Exchange,
    factor: [f64; 2],
    wanted: [f64; 2],
    learning: Option<Learning>,
    since: Instant,
}

impl<P: Port> Server<P> {
    fn new(port: P, identity: Identity, exchange: Exchange) -> Result<Self, ServeError> {
        let device = HapticDevice::from_descriptor(identity, port.descriptor())?;
        // 1 N, and 10 N mm, are half of what the device gives.
        let factor = [0.5, 0.05];
        Ok(Self { port, device, exchange, factor, wanted: [0.0; 2], learning: None, since: Instant::now() })
    }

    fn now_ms(&self) -> f64 {
        self.since.elapsed().as_secs_f64() * 1000.0
    }

    /// Until whoever asks is gone, or the device.
    fn serve(
        mut self,
        inbox: &Receiver<DeviceCommand>,
        status: &Mutex<DeviceStatus>,
        pace: impl Fn(&mut P, f64, [f64; 2]),
    ) -> Result<(), ServeError> {
        let mut looked_ms = self.now_ms();
        loop {
            loop {
                match inbox.try_recv() {
                    Ok(command) => self.handle(command),
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => return self.end(),
                }
            }
            let now = self.now_ms();
            pace(&mut self.port, now, self.wanted);
            self.look(now, (now - looked_ms) / 1000.0)?;
            looked_ms = now;
            self.tell(status);
            thread::sleep(LOOK);
        }
    }

    fn handle(&mut self, command: DeviceCommand) {
        match command {
            DeviceCommand::Arm => self.device.arm(),
            DeviceCommand::Halt(why) => self.device.halt(why),
            DeviceCommand::Pause(on) => self.device.pause(on),
            DeviceCommand::Map(mapping) => self.device.set_mapping(mapping),
            DeviceCommand::Learn => {
                self.device.halt(Halt::NotArmed);
                self.learning = Some(Learning::default());
            }
            DeviceCommand::Factor(factor) => self.factor = factor,
            DeviceCommand::Want(wanted) => self.wanted = wanted,
        }
    }

    fn look(&mut self, now: f64, passed_s: f64) -> Result<(), PortError> {
        while let Some(report) = self.port.poll()? {
            self.device.input(now, report.id, &report.data);
        }
        if let Some(learning) = &mut self.learning {
            learning.observe(self.device.controls(), self.device.state());
            if learning.ask() == Ask::Done {
                let clutch = self.device.mapping().clutch;
                self.device.set_mapping(Mapping { clutch, ..learning.mapping() });
                self.learning = None;
            }
        }
        let moved = self.device.advance(passed_s);
        // While it is learnt what moves, nothing does.
        self.exchange.moves(if self.learning.is_some() { [0.0; 2] } else { moved });
        if let Some(feels) = self.exchange.feels() {
            let scaled = |values: [f64; 2]| std::array::from_fn(|i| values[i] * self.factor[i]);
            let resistance = Resistance { part: scaled(feels.felt), slope: scaled(feels.stiffness) };
            self.device.resist(now, &resistance);
        }
        for _ in 0..REQUESTS {
            let now = self.now_ms();
            let Some(request) = self.device.next(now) else { break };
            let (port, device) = (&mut self.port, &mut self.device);
            carry_out(port, &request, |reply| device.reply(now, reply))?;
        }
        Ok(())
    }

    /// The last that a device hears: no force, and what was made for it is given back.
    fn end(mut self) -> Result<(), ServeError> {
        for request in self.device.farewell() {
            carry_out(&mut self.port, &request, |_| {})?;
        }
        Ok(())
    }

    fn tell(&self, status: &Mutex<DeviceStatus>) {
        let (device, mut status) = (&self.device, status.lock().unwrap_or_else(PoisonError::into_inner));
        let axes = device.controls().axes.iter().zip(&device.state().axes);
        status.axes = axes.map(|(axis, at)| (axis.name(), axis.part(at), at.raw.unwrap_or_default())).collect();
        status.mapping = *device.mapping();
        status.asks = self.learning.as_ref().map(Learning::ask);
        (status.has_force, status.halted) = (device.has_force(), device.halted());
        status.felt = self.exchange.feels().map(|feels| feels.felt);
        status.latency = device.latency();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Waits until something is so, or too long.
    fn until(mut is_so: impl FnMut() -> bool) -> bool {
        (0..400).any(|_| {
            thread::sleep(Duration::from_millis(5));
            is_so()
        })
    }

    #[test]
    fn the_virtual_device_is_served_and_its_hand_moves_the_wire() {
        let exchange = Exchange::default();
        let served = Served::new(Choice { name: "Virtual device".to_owned(), found: None }, exchange.clone());
        assert!(until(|| served.status().axes.len() == 2));
        let status = served.status();
        assert!(status.has_force && status.halted == Some(Halt::NotArmed) && status.ended.is_none());
        served.ask(DeviceCommand::Arm);
        served.ask(DeviceCommand::Want([10.0, 0.0]));
        assert!(until(|| served.status().axes[0].1 > 0.19), "{:?}", served.status());
        assert_eq!(served.status().halted, None);
        served.ask(DeviceCommand::Halt(Halt::Stopped));
        assert!(until(|| served.status().halted == Some(Halt::Stopped)));
    }

    #[test]
    fn a_mapping_is_learnt_by_a_push_and_a_turn() {
        let served = Served::new(Choice { name: "Virtual device".to_owned(), found: None }, Exchange::default());
        served.ask(DeviceCommand::Learn);
        assert!(until(|| served.status().asks == Some(Ask::Push)));
        served.ask(DeviceCommand::Want([0.0, -4.0]));
        assert!(until(|| served.status().asks == Some(Ask::Turn)));
        served.ask(DeviceCommand::Want([-30.0, -4.0]));
        assert!(until(|| served.status().asks.is_none()));
        let Mapping { feed, roll, .. } = served.status().mapping;
        assert!(feed.is_some_and(|feed| feed.axis == 1 && feed.is_inverted));
        assert!(roll.is_some_and(|roll| roll.axis == 0 && roll.is_inverted));
    }
}
