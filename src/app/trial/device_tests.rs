//! What the panel makes of a device that comes and goes, and what it remembers of it.

use super::action::DeviceAsk;
use super::device::{Device, TrialState};
use super::state::Trial;
use crate::app::platform::Devices;
use crate::haptics::controls::Motion;
use crate::haptics::known::KnownMappings;
use crate::haptics::learning::Ask;
use crate::haptics::mapping::{AxisMapping, Mapping};
use crate::haptics::safety::Halt;
use crate::haptics::service::{AxisStatus, DeviceCommand, DeviceStatus};

const DRIVEN: TrialState = TrialState { is_open: true, is_driven: true, is_paused: false };
const PAUSED: TrialState = TrialState { is_paused: true, ..DRIVEN };

/// A platform with one device, as it is told to be.
#[derive(Default)]
struct Desk {
    status: Option<DeviceStatus>,
    asked: Vec<DeviceCommand>,
}

impl Devices for Desk {
    fn look(&mut self) -> (Vec<String>, Option<String>) {
        (vec!["Feeder".to_owned()], None)
    }

    fn choose(&mut self, number: Option<usize>) {
        self.asked.clear();
        self.status = number.map(|_| served());
    }

    fn ask(&mut self, command: DeviceCommand) {
        self.asked.push(command);
    }

    fn status(&self) -> Option<DeviceStatus> {
        self.status.clone()
    }
}

/// A device of two axes that has just been opened.
fn served() -> DeviceStatus {
    DeviceStatus {
        key: "1209:0001:0".to_owned(),
        axes: vec![AxisStatus::default(); 2],
        mapping: by(0),
        has_force: true,
        halted: Some(Halt::NotArmed),
        factor: [0.5, 0.05],
        ..DeviceStatus::default()
    }
}

fn by(axis: usize) -> Mapping {
    Mapping { feed: Some(AxisMapping::new(axis, Motion::Place, 100.0)), ..Mapping::default() }
}

fn held() -> (Device, Desk) {
    let (mut device, mut desk) = (Device::default(), Desk::default());
    device.follow(Some(&mut desk), false, DRIVEN);
    choose(&mut device, &mut desk);
    (device, desk)
}

fn choose(device: &mut Device, desk: &mut Desk) {
    device.act(DeviceAsk::Choose(Some(0)), Some(&mut *desk));
    device.follow(Some(&mut *desk), false, DRIVEN);
}

fn maps(desk: &Desk) -> Vec<Mapping> {
    let map = |command: &DeviceCommand| if let DeviceCommand::Map(mapping) = command { Some(*mapping) } else { None };
    desk.asked.iter().filter_map(map).collect()
}

#[test]
fn a_trial_waits_for_its_device_and_goes_on_unarmed() {
    let (mut device, mut desk) = held();
    desk.status = Some(DeviceStatus { halted: None, factor: [0.1, 0.01], ..served() });
    assert!(!device.follow(Some(&mut desk), false, DRIVEN));
    assert!(device.is_armed());

    desk.status = Some(DeviceStatus { ended: Some("gone".to_owned()), ..DeviceStatus::default() });
    assert!(device.follow(Some(&mut desk), false, DRIVEN), "it is paused");
    assert!(!device.follow(Some(&mut desk), false, PAUSED), "once");
    assert!(!device.is_served());

    desk.asked.clear();
    desk.status = Some(served());
    assert!(device.follow(Some(&mut desk), false, PAUSED), "it goes on");
    assert!(!device.follow(Some(&mut desk), false, DRIVEN), "once");
    assert!(!device.is_armed() && !desk.asked.contains(&DeviceCommand::Arm));
    assert!(desk.asked.contains(&DeviceCommand::Factor([0.1, 0.01])), "as faint as it was: {:?}", desk.asked);
}

#[test]
fn a_mapping_that_was_chosen_comes_back_with_its_device_until_it_is_forgotten() {
    let (mut device, mut desk) = held();
    assert!(maps(&desk).is_empty(), "nothing is known of it");
    device.act(DeviceAsk::Command(DeviceCommand::Map(by(1))), Some(&mut desk));
    choose(&mut device, &mut desk);
    assert_eq!(maps(&desk), [by(1)]);

    // With another descriptor it is another device.
    desk.asked.clear();
    desk.status = Some(DeviceStatus { key: "1209:0001:1".to_owned(), ..served() });
    device.follow(Some(&mut desk), false, DRIVEN);
    assert!(maps(&desk).is_empty());

    // What is kept is enough for another window.
    let text = serde_json::to_string(device.known()).unwrap();
    let (mut other, mut desk) = (Device::default(), Desk::default());
    other.set_known(serde_json::from_str(&text).unwrap());
    other.follow(Some(&mut desk), false, DRIVEN);
    choose(&mut other, &mut desk);
    assert_eq!(maps(&desk), [by(1)]);
    other.act(DeviceAsk::Forget, Some(&mut desk));
    assert!(desk.asked.contains(&DeviceCommand::Propose));
    choose(&mut other, &mut desk);
    assert!(maps(&desk).is_empty());
}

#[test]
fn what_was_learnt_is_remembered_and_what_was_broken_off_is_not() {
    let (mut device, mut desk) = held();
    let learns = DeviceStatus { asks: Some(Ask::Push), ..served() };
    desk.status = Some(learns.clone());
    device.follow(Some(&mut desk), false, DRIVEN);
    device.act(DeviceAsk::Command(DeviceCommand::Map(by(0))), Some(&mut desk));
    desk.status = Some(served());
    device.follow(Some(&mut desk), false, DRIVEN);
    assert!(!device.known().has("1209:0001:0"));

    desk.status = Some(learns);
    device.follow(Some(&mut desk), false, DRIVEN);
    desk.status = Some(DeviceStatus { mapping: by(1), ..served() });
    device.follow(Some(&mut desk), false, DRIVEN);
    assert_eq!(device.known().get("1209:0001:0", 2), Some(by(1)));
}

#[test]
fn the_end_of_a_trial_forgets_no_device() {
    let (mut trial, mut known) = (Trial::default(), KnownMappings::default());
    known.remember("1209:0001:0", 2, by(1));
    trial.set_known_mappings(known.clone());
    trial.end(false);
    assert_eq!(trial.known_mappings(), &known);
}
