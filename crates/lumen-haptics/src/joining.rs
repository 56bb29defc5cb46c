//! Several interfaces of one device as one: where one has the axes and another takes the forces, the hand's reports come from
//! the first and requests go to the second.
//!
//! A system lists a device by its interfaces, each with reports of its own; Windows lists even the collections at the top of
//! one by themselves. What belongs together has the same numbers and the same name. Where two interfaces describe the same,
//! there are two devices of a kind, and which interface is of which is not known: then none are joined, lest one is held and
//! the other moves.

use super::descriptor::parse;
use super::device::HapticDevice;
use super::identity::Identity;
use super::model::DeviceModel;
use super::port::{InputReport, Port, PortError};

/// Reports of the interface that takes forces which are passed over between two looks, at most.
const PASSED_OVER: usize = 64;

/// Which of a device's interfaces are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Parts {
    /// The one by which it is held.
    pub axes: usize,
    /// The one by which it pushes back, where that is another.
    pub force: Option<usize>,
}

/// Which of the interfaces of these reports are used; `None` where none has axes. One that has axes and a force goes before
/// two that have one each, and those before one that can only be moved.
pub fn parts(identity: &Identity, interfaces: &[DeviceModel]) -> Option<Parts> {
    let device = |model: &DeviceModel| HapticDevice::new(identity.clone(), model.clone());
    let alone: Vec<HapticDevice> = interfaces.iter().map(device).collect();
    let axes_of = |i: usize| alone[i].controls().axes.len();
    let mut held: Vec<usize> = (0..interfaces.len()).filter(|&i| axes_of(i) > 0).collect();
    held.sort_by_key(|&i| std::cmp::Reverse(axes_of(i)));
    if let Some(&axes) = held.iter().find(|&&i| alone[i].has_force()) {
        return Some(Parts { axes, force: None });
    }
    let are_of_one = (1..interfaces.len()).all(|i| !interfaces[..i].contains(&interfaces[i]));
    let pairs = held.iter().flat_map(|&axes| (0..interfaces.len()).map(move |force| (axes, force)));
    let joined = pairs
        .filter(|(axes, force)| are_of_one && axes != force)
        .find(|&(axes, force)| device(&interfaces[axes]).with_force_by(interfaces[force].clone()).has_force());
    match joined {
        Some((axes, force)) => Some(Parts { axes, force: Some(force) }),
        None => held.first().map(|&axes| Parts { axes, force: None }),
    }
}

/// A device by those of its interfaces that are used.
pub struct JoinedPort<P> {
    axes: P,
    force: Option<P>,
    has_axes: bool,
}

impl<P: Port> JoinedPort<P> {
    /// Of a device's interfaces, all that could be opened; `None` where there are none. One without axes stands for itself.
    pub fn new(identity: &Identity, interfaces: Vec<P>) -> Option<Self> {
        // What makes no sense has neither axes nor a force.
        let models: Vec<DeviceModel> =
            interfaces.iter().map(|port| parse(port.descriptor()).unwrap_or_default()).collect();
        let found = parts(identity, &models);
        let Parts { axes, force } = found.unwrap_or(Parts { axes: 0, force: None });
        let mut interfaces: Vec<Option<P>> = interfaces.into_iter().map(Some).collect();
        let axes = interfaces.get_mut(axes)?.take()?;
        let force = force.and_then(|force| interfaces.get_mut(force)?.take());
        Some(Self { axes, force, has_axes: found.is_some() })
    }

    /// Whether one of them has axes.
    pub fn has_axes(&self) -> bool {
        self.has_axes
    }

    fn takes_forces(&mut self) -> &mut P {
        self.force.as_mut().unwrap_or(&mut self.axes)
    }
}

impl<P: Port> Port for JoinedPort<P> {
    fn descriptor(&self) -> &[u8] {
        self.axes.descriptor()
    }

    fn force_descriptor(&self) -> Option<&[u8]> {
        self.force.as_ref().map(Port::descriptor)
    }

    fn send(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
        self.takes_forces().send(id, data)
    }

    fn set_feature(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
        self.takes_forces().set_feature(id, data)
    }

    fn get_feature(&mut self, id: u8, bytes: usize) -> Result<Vec<u8>, PortError> {
        self.takes_forces().get_feature(id, bytes)
    }

    fn poll(&mut self) -> Result<Option<InputReport>, PortError> {
        if let Some(force) = &mut self.force {
            // What it tells of its effects is of no use here, and must not be taken for what the hand does: its ids are its
            // own. That it is gone is of use.
            for _ in 0..PASSED_OVER {
                if force.poll()?.is_none() {
                    break;
                }
            }
        }
        self.axes.poll()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use super::*;
    use crate::device::Resistance;
    use crate::feeder::DESCRIPTOR;
    use crate::fixtures::descriptor;
    use crate::port::carry_out;
    use crate::virtual_feeder::VirtualFeeder;

    /// The feeder's descriptor as one of its axes, and one of its effects.
    fn halves() -> [Vec<u8>; 2] {
        let at = DESCRIPTOR.windows(2).position(|pair| pair == [0x05, 0x0F]).unwrap();
        let (axes, effects) = DESCRIPTOR.split_at(at);
        [[axes, &[0xC0]].concat(), [&[0x05, 0x0F, 0x09, 0x01, 0xA1, 0x01], effects].concat()]
    }

    fn model(bytes: &[u8]) -> DeviceModel {
        parse(bytes).unwrap()
    }

    fn identity() -> Identity {
        Identity { vendor: 0x1209, product: 0x0001, name: "Split feeder".to_owned() }
    }

    /// One of two interfaces of one feeder: that of its axes takes no reports, that of its effects tells each ms what would be
    /// read as axes at their ends.
    struct Interface {
        feeder: Arc<Mutex<VirtualFeeder>>,
        descriptor: Vec<u8>,
        has_effects: bool,
        told_ms: u32,
    }

    impl Interface {
        fn of(feeder: &Arc<Mutex<VirtualFeeder>>, descriptor: &[u8], has_effects: bool) -> Self {
            Self { feeder: Arc::clone(feeder), descriptor: descriptor.to_vec(), has_effects, told_ms: 0 }
        }

        fn ask<T>(&self, id: u8, ask: impl FnOnce(&mut VirtualFeeder) -> Result<T, PortError>) -> Result<T, PortError> {
            if !self.has_effects {
                return Err(PortError::Refused { id, reason: "it has no such report".to_owned() });
            }
            ask(&mut self.feeder.lock().unwrap())
        }
    }

    impl Port for Interface {
        fn descriptor(&self) -> &[u8] {
            &self.descriptor
        }

        fn send(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
            self.ask(id, |feeder| feeder.send(id, data))
        }

        fn set_feature(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
            self.ask(id, |feeder| feeder.set_feature(id, data))
        }

        fn get_feature(&mut self, id: u8, bytes: usize) -> Result<Vec<u8>, PortError> {
            self.ask(id, |feeder| feeder.get_feature(id, bytes))
        }

        fn poll(&mut self) -> Result<Option<InputReport>, PortError> {
            let mut feeder = self.feeder.lock().unwrap();
            if !self.has_effects {
                return feeder.poll();
            }
            let is_due = std::mem::replace(&mut self.told_ms, feeder.now_ms()) != feeder.now_ms();
            Ok(is_due.then(|| InputReport { id: 1, data: vec![0xFF, 0xFF, 0x7F, 0xFF, 0x7F] }))
        }
    }

    #[test]
    fn what_is_left_of_a_device_whose_axes_cannot_be_opened_says_so() {
        let feeder = Arc::new(Mutex::new(VirtualFeeder::default()));
        let [axes, effects] = halves();
        let interface = |descriptor: &[u8], has_effects| Interface::of(&feeder, descriptor, has_effects);
        let has_axes = |interfaces| JoinedPort::new(&identity(), interfaces).map(|port| port.has_axes());
        assert_eq!(has_axes(vec![interface(&effects, true), interface(&axes, false)]), Some(true));
        assert_eq!(has_axes(vec![interface(&axes, false)]), Some(true));
        assert_eq!(has_axes(vec![interface(&effects, true)]), Some(false));
        // Cut off within its first collection.
        assert_eq!(has_axes(vec![interface(&axes[..3], false)]), Some(false));
        assert_eq!(has_axes(Vec::new()), None);
    }

    #[test]
    fn a_device_whose_axes_and_effects_are_apart_is_held_and_pushes_back() {
        for effects_first in [false, true] {
            let feeder = Arc::new(Mutex::new(VirtualFeeder::default()));
            let [axes, effects] = halves();
            let mut interfaces = vec![Interface::of(&feeder, &axes, false), Interface::of(&feeder, &effects, true)];
            if effects_first {
                interfaces.reverse();
            }
            let mut port = JoinedPort::new(&identity(), interfaces).unwrap();
            assert_eq!((port.descriptor(), port.force_descriptor()), (&*axes, Some(&*effects)));
            let mut device = HapticDevice::from_port(identity(), &port).unwrap();
            assert!(device.has_force() && device.controls().axes.len() == 2);
            // Its mapping is remembered by what it is held by.
            let held = HapticDevice::from_descriptor(identity(), &axes).unwrap();
            assert!(!held.has_force());
            assert_eq!(device.key(), held.key());

            device.arm();
            let mut most = 0.0_f64;
            for ms in 0..600 {
                let now = f64::from(ms);
                feeder.lock().unwrap().advance();
                while let Some(report) = port.poll().unwrap() {
                    device.input(now, report.id, &report.data);
                }
                device.advance(0.001);
                device.resist(now, &Resistance { part: [0.2, 0.0], slope: [0.01, 0.0] });
                if let Some(request) = device.next(now) {
                    carry_out(&mut port, &request, |reply| device.reply(now, reply)).unwrap();
                }
                most = most.max(feeder.lock().unwrap().forces()[0].abs());
            }
            assert!(device.force_error().is_none() && most > 0.1, "{most} N");
            assert!(device.state().axes.iter().all(|axis| axis.raw.is_some_and(|raw| raw.abs() < 30_000)));
            feeder.lock().unwrap().unplug();
            assert!(matches!(port.poll(), Err(PortError::Gone)));
        }
    }

    #[test]
    fn one_interface_that_has_both_goes_first_and_two_of_a_kind_are_not_joined() {
        let [axes, effects] = halves().map(|bytes| model(&bytes));
        let whole = model(DESCRIPTOR);
        let stick = model(&descriptor("logitech-g29"));
        let of = |interfaces: &[&DeviceModel]| {
            parts(&identity(), &interfaces.iter().map(|&of| of.clone()).collect::<Vec<_>>())
        };
        let alone = |axes| Some(Parts { axes, force: None });
        assert_eq!(of(&[&axes, &effects, &whole]), alone(2));
        assert_eq!(of(&[&effects, &axes]), Some(Parts { axes: 1, force: Some(0) }));
        assert_eq!(of(&[&axes]), alone(0));
        assert_eq!(of(&[&stick, &axes]), alone(0), "the most axes");
        assert_eq!(of(&[&effects]), None);
        assert_eq!(of(&[]), None);
        // Two such devices: one could be held and the other pushed.
        assert_eq!(of(&[&axes, &effects, &axes, &effects]), alone(0));
    }
}
