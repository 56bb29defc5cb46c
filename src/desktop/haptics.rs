//! A haptic device on a thread of its own, at the device's pace: reports in and out, and the trial's hand at the other side of
//! an [`HapticChannel`].

use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use super::haply::HaplyPort;
use super::hid::{Found, HidPort, OpenError, find, open};
use super::{lock, speech};
use crate::app::{Devices, Listing};
use crate::engine::trial::HapticChannel;
use crate::haptics::descriptor::ModelError;
use crate::haptics::device::HapticDevice;
use crate::haptics::identity::Identity;
use crate::haptics::joining::JoinedPort;
use crate::haptics::port::{Port, PortError, carry_out};
use crate::haptics::service::{DeviceCommand, DeviceStatus, Service};
use crate::haptics::virtual_feeder::VirtualFeeder;
use crate::language::tell;
use crate::say;

/// Between two looks at the device: reports come at 1 kHz at most.
const LOOK: Duration = Duration::from_micros(500);
/// Between two looks for a device that was pulled out.
const AGAIN: Duration = Duration::from_millis(250);
/// Requests that are carried out in a look at most, so that input is never far behind.
const REQUESTS: usize = 4;
/// Reports that are taken in a look at most: what comes without end is not to keep what is asked waiting.
const REPORTS: usize = 64;
/// How long a device may take to be let go when the program ends.
const FAREWELL: Duration = Duration::from_millis(300);

/// A device that can be chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Choice {
    /// The one that is made here.
    Virtual,
    /// The arm behind Haply's service. Whether that is there is seen once it is chosen: no line is opened before.
    Haply,
    /// One of the system's.
    Found(Found),
}

impl Choice {
    /// What it is called in a list, in the language that is spoken.
    fn label(&self) -> String {
        match self {
            Self::Virtual => say!("app-virtual-device"),
            Self::Haply | Self::Found(_) => self.name(),
        }
    }

    /// What it is called in tables, which are the same in every language.
    fn name(&self) -> String {
        match self {
            Self::Virtual => "Virtual device".to_owned(),
            Self::Haply => "Haply Inverse3".to_owned(),
            Self::Found(found) => found.identity.name.clone(),
        }
    }
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

impl ServeError {
    /// In the language that is spoken.
    fn said(&self) -> String {
        match self {
            Self::Open(error) => error.to_string(),
            Self::Model(error) => tell(error),
            Self::Port(error) => tell(error),
        }
    }
}

/// A device that is served.
struct Served {
    commands: Sender<DeviceCommand>,
    status: Arc<Mutex<DeviceStatus>>,
    thread: JoinHandle<()>,
}

impl Served {
    /// Serves a device until this is dropped: its hand is the one of `exchange`.
    fn new(choice: Choice, exchange: HapticChannel) -> Self {
        let (commands, inbox) = channel();
        let name = choice.name();
        let status = Arc::new(Mutex::new(DeviceStatus { name: name.clone(), ..DeviceStatus::default() }));
        let told = Arc::clone(&status);
        let named = Identity { name, ..Identity::default() };
        let thread = thread::spawn(move || {
            speech::follow();
            let ended = match choice {
                Choice::Virtual => Server::new(VirtualFeeder::default(), named, exchange).map(|server| {
                    let service = server.service.with_virtual_hand();
                    Server { service, ..server }.serve(&inbox, &told, VirtualFeeder::keep_pace)
                }),
                Choice::Haply => HaplyPort::open()
                    .map_err(ServeError::from)
                    .map(|port| keep_serving(port, &named, &exchange, &inbox, &told, |_, _| HaplyPort::open().ok())),
                Choice::Found(found) => open(&found).map_err(ServeError::from).map(|port| {
                    let again =
                        |descriptor: &[u8], force: Option<&[u8]>| find_again(&found.identity, descriptor, force);
                    keep_serving(port, &found.identity, &exchange, &inbox, &told, again)
                }),
            };
            if let Ok(Err(error)) | Err(error) = ended {
                end(&told, &error);
            }
        });
        Self { commands, status, thread }
    }

    /// Asks for something; a device that is no longer served does nothing.
    fn ask(&self, command: DeviceCommand) {
        // Its status says that it has ended, and why.
        let _ = self.commands.send(command);
    }

    /// How it is now.
    fn status(&self) -> DeviceStatus {
        lock(&self.status).clone()
    }
}

/// Tells why a device is no longer served.
fn end(told: &Mutex<DeviceStatus>, why: &ServeError) {
    speech::follow();
    lock(told).ended = Some(why.said());
}

/// Opens the device that has these numbers, this name and these descriptors, where it is plugged in: of one that has two
/// interfaces both, which come one after the other.
fn find_again(identity: &Identity, descriptor: &[u8], force: Option<&[u8]>) -> Option<JoinedPort<HidPort>> {
    let same = find().ok()?.into_iter().filter(|found| found.identity == *identity);
    let is_it = |port: &JoinedPort<HidPort>| (port.descriptor(), port.force_descriptor()) == (descriptor, force);
    same.filter_map(|found| open(&found).ok()).find(is_it)
}

/// Serves a device, and serves it again, without a force, each time that it was pulled out and is there again: `again` opens
/// the one that has the descriptors which it is given, once there is one: that of what is held, and that of another interface
/// which takes forces.
///
/// # Errors
/// When it ends in another way than by its plug.
fn keep_serving<P: Port>(
    mut port: P,
    identity: &Identity,
    exchange: &HapticChannel,
    inbox: &Receiver<DeviceCommand>,
    told: &Mutex<DeviceStatus>,
    again: impl Fn(&[u8], Option<&[u8]>) -> Option<P>,
) -> Result<(), ServeError> {
    let (descriptor, force) = (port.descriptor().to_vec(), port.force_descriptor().map(<[u8]>::to_vec));
    loop {
        let server = Server::new(port, identity.clone(), exchange.clone())?;
        match server.serve(inbox, told, |_, _, _| {}) {
            Err(gone @ ServeError::Port(PortError::Gone)) => end(told, &gone),
            ended => return ended,
        }
        port = loop {
            thread::sleep(AGAIN);
            // What is asked meanwhile is asked of one that is gone: nothing of it, and no force, waits for the next.
            loop {
                match inbox.try_recv() {
                    Ok(_) => {}
                    Err(TryRecvError::Empty) => break,
                    Err(TryRecvError::Disconnected) => return Ok(()),
                }
            }
            if let Some(port) = again(&descriptor, force.as_deref()) {
                break port;
            }
        };
    }
}

/// The desktop's devices, of which one is served.
pub(super) struct HapticDevices {
    exchange: HapticChannel,
    choices: Vec<Choice>,
    /// Why the system lists none.
    problem: Option<OpenError>,
    /// The place of the one that is served.
    chosen: Option<usize>,
    served: Option<Served>,
    /// Whether what was listed is called otherwise by now.
    has_changed: bool,
}

impl HapticDevices {
    /// None is served; whose hand is on the wire, `exchange` says.
    pub(super) fn new(exchange: HapticChannel) -> Self {
        Self { exchange, choices: Vec::new(), problem: None, chosen: None, served: None, has_changed: false }
    }

    /// Another language is spoken now.
    pub(super) fn speak(&mut self) {
        // Nothing was listed before the first look.
        self.has_changed = !self.choices.is_empty();
    }

    fn listing(&self) -> Listing {
        Listing {
            names: self.choices.iter().map(Choice::label).collect(),
            problem: self.problem.as_ref().map(ToString::to_string),
            chosen: self.chosen,
        }
    }
}

impl Drop for HapticDevices {
    /// The program ends, and its threads with it: not before the device has heard its last.
    fn drop(&mut self) {
        let Some(Served { commands, thread, .. }) = self.served.take() else { return };
        drop(commands);
        let until = Instant::now() + FAREWELL;
        while !thread.is_finished() && Instant::now() < until {
            thread::sleep(LOOK);
        }
    }
}

impl Devices for HapticDevices {
    fn look(&mut self) -> (Vec<String>, Option<String>) {
        let (found, problem) = match find() {
            Ok(found) => (found, None),
            Err(error) => (Vec::new(), Some(error)),
        };
        self.choices =
            [Choice::Virtual, Choice::Haply].into_iter().chain(found.into_iter().map(Choice::Found)).collect();
        self.problem = problem;
        let Listing { names, problem, .. } = self.listing();
        (names, problem)
    }

    fn changed(&mut self) -> Option<Listing> {
        std::mem::take(&mut self.has_changed).then(|| self.listing())
    }

    fn choose(&mut self, number: Option<usize>) {
        // The one before is let go first.
        self.served = None;
        self.chosen = number.filter(|&number| number < self.choices.len());
        self.served = self.chosen.map(|number| Served::new(self.choices[number].clone(), self.exchange.clone()));
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
    exchange: HapticChannel,
    since: Instant,
}

impl<P: Port> Server<P> {
    fn new(port: P, identity: Identity, exchange: HapticChannel) -> Result<Self, ServeError> {
        let device = HapticDevice::from_port(identity, &port)?;
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
            *lock(status) = self.service.status();
            thread::sleep(LOOK);
        }
    }

    fn look(&mut self, now: f64, passed_s: f64) -> Result<(), PortError> {
        for _ in 0..REPORTS {
            let Some(report) = self.port.poll()? else { break };
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
    use crate::haptics::feeder::DESCRIPTOR;
    use crate::haptics::learning::Ask;
    use crate::haptics::mapping::Mapping;
    use crate::haptics::port::InputReport;
    use crate::haptics::safety::Halt;
    use crate::language::{self, Language};

    /// A feeder on a cable that can be pulled.
    struct Cable(Arc<Mutex<VirtualFeeder>>);

    impl Cable {
        fn feeder(&self) -> std::sync::MutexGuard<'_, VirtualFeeder> {
            self.0.lock().unwrap()
        }
    }

    impl Port for Cable {
        fn descriptor(&self) -> &[u8] {
            DESCRIPTOR
        }

        fn send(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
            self.feeder().send(id, data)
        }

        fn set_feature(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
            self.feeder().set_feature(id, data)
        }

        fn get_feature(&mut self, id: u8, bytes: usize) -> Result<Vec<u8>, PortError> {
            self.feeder().get_feature(id, bytes)
        }

        fn poll(&mut self) -> Result<Option<InputReport>, PortError> {
            self.feeder().poll()
        }
    }

    /// Waits until something is so, or too long.
    fn until(mut is_so: impl FnMut() -> bool) -> bool {
        (0..400).any(|_| {
            thread::sleep(Duration::from_millis(5));
            is_so()
        })
    }

    #[test]
    fn the_virtual_device_is_served_and_its_hand_moves_the_wire() {
        let exchange = HapticChannel::default();
        let served = Served::new(Choice::Virtual, exchange.clone());
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
    fn what_is_listed_is_called_as_the_language_of_the_moment_has_it() {
        let mut devices = HapticDevices::new(HapticChannel::default());
        devices.speak();
        assert_eq!(devices.changed(), None, "nothing was listed");
        devices.look();
        devices.choose(Some(0));
        language::speak(Language::German, language::built_in(Language::German).unwrap());
        devices.speak();
        let listing = devices.changed().unwrap();
        assert_eq!((listing.names[0].as_str(), listing.chosen), ("Virtuelles Gerät", Some(0)));
        assert_eq!(devices.changed(), None);
        assert_eq!(devices.status().unwrap().name, "Virtual device", "as tables have it");
        language::speak(Language::English, &[]);
    }

    #[test]
    fn a_mapping_is_learnt_by_a_push_and_a_turn() {
        let served = Served::new(Choice::Virtual, HapticChannel::default());
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

    #[test]
    fn a_device_that_is_plugged_in_again_is_served_again_without_its_force() {
        let feeder = Arc::new(Mutex::new(VirtualFeeder::default()));
        let (commands, inbox) = channel();
        let status = Arc::new(Mutex::new(DeviceStatus::default()));
        let (told, cable) = (Arc::clone(&status), Arc::clone(&feeder));
        let serving = thread::spawn(move || {
            let again = |descriptor: &[u8], force: Option<&[u8]>| {
                assert_eq!((descriptor, force), (DESCRIPTOR, None));
                let is_there = cable.lock().unwrap().poll().is_ok();
                is_there.then(|| Cable(Arc::clone(&cable)))
            };
            let first = Cable(Arc::clone(&cable));
            keep_serving(first, &Identity::default(), &HapticChannel::default(), &inbox, &told, again)
        });
        let now = || status.lock().unwrap().clone();
        commands.send(DeviceCommand::Arm).unwrap();
        assert!(until(|| now().axes.len() == 2 && now().halted.is_none()), "{:?}", now());
        for _ in 0..2 {
            feeder.lock().unwrap().unplug();
            assert!(until(|| now().ended.is_some_and(|why| why.contains("no longer there"))), "{:?}", now());
            // What is asked of a device that is gone is not kept for the next.
            commands.send(DeviceCommand::Arm).unwrap();
            thread::sleep(2 * AGAIN);
            feeder.lock().unwrap().plug_in();
            assert!(until(|| now().ended.is_none()), "{:?}", now());
            assert_eq!((now().halted, now().has_force), (Some(Halt::NotArmed), true));
        }
        drop(commands);
        assert!(matches!(serving.join(), Ok(Ok(()))));
    }
}
