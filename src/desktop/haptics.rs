//! A haptic device on a thread of its own, at the device's pace: reports in and out, and the trial's hand at the other side of
//! an [`Exchange`].

use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::hid::{Found, HidPort, find};
use crate::app::Devices;
use crate::engine::trial::Exchange;
use crate::haptics::descriptor::ModelError;
use crate::haptics::device::{HapticDevice, Identity};
use crate::haptics::port::{Port, PortError, carry_out};
use crate::haptics::service::{DeviceCommand, DeviceStatus, Service};
use crate::haptics::virtual_feeder::VirtualFeeder;

/// Between two looks at the device: reports come at 1 kHz at most.
const LOOK: Duration = Duration::from_micros(500);
/// Requests that are carried out in a look at most, so that input is never far behind.
const REQUESTS: usize = 4;

/// A device that can be chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Choice {
    /// What it is called.
    name: String,
    /// The system's, or none for the virtual one.
    found: Option<Found>,
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
struct Served {
    commands: Sender<DeviceCommand>,
    status: Arc<Mutex<DeviceStatus>>,
}

/// What can be chosen: the virtual device, then all that the system has. The second is why the system lists none, if so.
fn choices() -> (Vec<Choice>, Option<String>) {
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
    fn new(choice: Choice, exchange: Exchange) -> Self {
        let (commands, inbox) = channel();
        let status = Arc::new(Mutex::new(DeviceStatus { name: choice.name.clone(), ..DeviceStatus::default() }));
        let told = Arc::clone(&status);
        let named = Identity { name: choice.name, ..Identity::default() };
        thread::spawn(move || {
            let ended = match choice.found {
                None => Server::new(VirtualFeeder::default(), named, exchange).map(|server| {
                    let service = server.service.with_virtual_hand();
                    Server { service, ..server }.serve(&inbox, &told, VirtualFeeder::keep_pace)
                }),
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
    fn ask(&self, command: DeviceCommand) {
        // Its status says that it has ended, and why.
        let _ = self.commands.send(command);
    }

    /// How it is now.
    fn status(&self) -> DeviceStatus {
        self.status.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// The desktop's devices, of which one is served.
pub(super) struct HapticDevices {
    exchange: Exchange,
    choices: Vec<Choice>,
    served: Option<Served>,
}

impl HapticDevices {
    /// None is served; whose hand is on the wire, `exchange` says.
    pub(super) fn new(exchange: Exchange) -> Self {
        Self { exchange, choices: Vec::new(), served: None }
    }
}

impl Devices for HapticDevices {
    fn look(&mut self) -> (Vec<String>, Option<String>) {
        let (choices, problem) = choices();
        self.choices = choices;
        (self.choices.iter().map(|choice| choice.name.clone()).collect(), problem)
    }

    fn choose(&mut self, number: Option<usize>) {
        // The one before is let go first.
        self.served = None;
        let choice = number.and_then(|number| self.choices.get(number));
        self.served = choice.map(|choice| Served::new(choice.clone(), self.exchange.clone()));
    }

    fn ask(&mut self, command: DeviceCommand) {
        if let Some(served) = &self.served {
            served.ask(command);
        }
    }

    fn status(&self) -> Option<DeviceStatus> {
        self.served.as_ref().map(Served::status)
    }
}

struct Server<P> {
    port: P,
    service: Service,
    exchange: Exchange,
    since: Instant,
}

impl<P: Port> Server<P> {
    fn new(port: P, identity: Identity, exchange: Exchange) -> Result<Self, ServeError> {
        let device = HapticDevice::from_descriptor(identity, port.descriptor())?;
        Ok(Self { port, service: Service::new(device), exchange, since: Instant::now() })
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
                    Ok(command) => self.service.handle(command),
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => return self.end(),
                }
            }
            let now = self.now_ms();
            pace(&mut self.port, now, self.service.wanted());
            self.look(now, (now - looked_ms) / 1000.0)?;
            looked_ms = now;
            *status.lock().unwrap_or_else(PoisonError::into_inner) = self.service.status();
            thread::sleep(LOOK);
        }
    }

    fn look(&mut self, now: f64, passed_s: f64) -> Result<(), PortError> {
        while let Some(report) = self.port.poll()? {
            self.service.device_mut().input(now, report.id, &report.data);
        }
        self.exchange.moves(self.service.advance(passed_s));
        self.service.feel(now, self.exchange.feels().map(|feels| (feels.felt, feels.stiffness)));
        for _ in 0..REQUESTS {
            let now = self.now_ms();
            let device = self.service.device_mut();
            let Some(request) = device.next(now) else { break };
            carry_out(&mut self.port, &request, |reply| device.reply(now, reply))?;
        }
        Ok(())
    }

    /// The last that a device hears: no force, and what was made for it is given back.
    fn end(mut self) -> Result<(), ServeError> {
        for request in self.service.device_mut().farewell() {
            carry_out(&mut self.port, &request, |_| {})?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::haptics::learning::Ask;
    use crate::haptics::mapping::Mapping;
    use crate::haptics::safety::Halt;

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
        assert!(until(|| served.status().axes[0].part > 0.19), "{:?}", served.status());
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
