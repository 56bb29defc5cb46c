//! Reports of physical interface devices byte by byte, as their firmware takes them apart, and when they are sent.

use super::PidDriver;
use super::driver::{DURATION_MS, RESTART_MS};
use super::layout::{Condition, Effect, Layout};
use crate::descriptor::parse;
use crate::feeder;
use crate::fixtures::{chromium, descriptor};
use crate::force::{AxisForce, Coupling, ForceCommand, ForceDriver, ForceError, Reply, Request};
use crate::usage::{Usage, desktop, pid};
use crate::webhid::{self, CollectionInfo};

const BOTH: [Option<Usage>; 2] = [Some(desktop::X), Some(desktop::Y)];

fn layout(name: &str) -> Layout {
    Layout::new(&parse(&descriptor(name)).unwrap(), BOTH).unwrap()
}

fn constant(index: u8, place: usize) -> Effect {
    let direction = Some(if place == 0 { 90.0 } else { 180.0 });
    let axes = [place == 0, place == 1];
    Effect { index, kind: pid::ET_CONSTANT_FORCE, duration_ms: 100.0, axes, direction }
}

#[test]
fn openffboard_takes_these_bytes() {
    // The packed structures of its `ffb_defs.h`: FFB_SetEffect_t, FFB_SetCondition_Data_t, FFB_SetConstantForce_Data_t and on.
    let two = layout("openffboard-2");
    assert_eq!(two.axes(), [Some(0), Some(1)]);
    assert_eq!(
        two.set_effect(&constant(3, 0)),
        (1, vec![3, 1, 100, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 0b101, 0x28, 0x23, 0, 0, 0, 0, 0, 0])
    );
    assert_eq!(
        two.set_effect(&constant(3, 1)).1[12..15],
        [0b110, 0x50, 0x46],
        "18000 hundredths: less its cosine is 1"
    );
    let spring = Effect { index: 2, kind: pid::ET_SPRING, duration_ms: 250.0, axes: [true; 2], direction: None };
    assert_eq!(two.set_effect(&spring).1[..13], [2, 8, 250, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0xFF, 0b011]);
    let condition = Condition { centre: -0.5, coefficient: 1.0, saturation: 0.5 };
    let (id, bytes) = two.set_condition(2, 1, &condition).unwrap();
    assert_eq!(id, 3);
    assert_eq!(bytes[..8], [2, 1, 0x00, 0xC0, 0xFF, 0x7F, 0xFF, 0x7F]);
    assert_eq!(i16::from_le_bytes([bytes[2], bytes[3]]), -16384);
    assert_eq!(bytes.len(), 14);
    assert_eq!(two.set_constant(1, -1.0), Some((5, vec![1, 0x01, 0x80])));
    assert_eq!(two.operate(4, true), (10, vec![4, 1, 1]));
    assert_eq!(two.operate(4, false), (10, vec![4, 3, 0]));
    assert_eq!(two.free(4), Some((11, vec![4])));
    // A bit for each command: on 1, off 2, stop 4, reset 8.
    let commands =
        [pid::DC_ENABLE_ACTUATORS, pid::DC_DISABLE_ACTUATORS, pid::DC_STOP_ALL_EFFECTS, pid::DC_DEVICE_RESET];
    assert_eq!(commands.map(|command| two.control(command)), [1, 2, 4, 8].map(|bits| Some((12, vec![bits]))));
    assert_eq!(two.gain(1.0), Some((13, vec![255])));
    assert_eq!(two.create(pid::ET_SPRING), Some((0x11, vec![8, 0, 0])));
    assert_eq!(two.load(), Some((0x12, 4)));
    // The direction bit is behind those of the axes, wherever that is.
    let one = layout("openffboard-1");
    assert_eq!(one.axes(), [Some(0), None]);
    assert_eq!(one.set_effect(&constant(1, 0)).1[12..15], [0b11, 0x28, 0x23]);
    assert_eq!(layout("openffboard-2-32").set_effect(&constant(3, 0)), two.set_effect(&constant(3, 0)));
}

#[test]
fn the_feeder_takes_these_bytes() {
    let axes = [Some(desktop::X), Some(desktop::RX)];
    let layout = Layout::new(&parse(feeder::DESCRIPTOR).unwrap(), axes).unwrap();
    assert_eq!(layout.axes(), [Some(0), Some(1)]);
    assert_eq!(layout.set_effect(&constant(1, 1)), (1, vec![1, 1, 100, 0, 255, 255, 0b110, 128, 0]));
    // A number for each command.
    let commands = [pid::DC_ENABLE_ACTUATORS, pid::DC_STOP_ALL_EFFECTS, pid::DC_DEVICE_RESET];
    assert_eq!(commands.map(|command| layout.control(command)), [1, 3, 4].map(|number| Some((6, vec![number]))));
    let condition = Condition { centre: 1.0, coefficient: 0.5, saturation: 1.0 };
    let bytes = vec![2, 1, 0xFF, 0x7F, 0x00, 0x40, 0x00, 0x40, 0xFF, 0x7F, 0xFF, 0x7F, 0, 0];
    assert_eq!(layout.set_condition(2, 1, &condition), Some((2, bytes)));
    let turned = Layout::new(&parse(feeder::DESCRIPTOR).unwrap(), [Some(desktop::RX), Some(desktop::X)]).unwrap();
    assert_eq!(turned.axes(), [Some(1), Some(0)], "by usage, not by order");
}

#[test]
fn an_answer_is_read_with_and_without_its_id_before_it() {
    let two = layout("openffboard-2");
    assert_eq!(two.loaded(&[7, 1, 0, 0]), Some(7));
    assert_eq!(two.loaded(&[0x12, 7, 1, 0, 0]), Some(7));
    assert_eq!(two.loaded(&[0x12, 1, 0, 0]), Some(0x12), "of the right length: no id");
    assert_eq!((two.loaded(&[0, 2, 0, 0]), two.loaded(&[7, 2, 0, 0]), two.loaded(&[7, 3, 0, 0])), (None, None, None));
    assert_eq!((two.loaded(&[]), two.loaded(&[0x12])), (None, None));
}

/// Changes the usages of all arrays that a browser tells.
fn change_arrays(collections: &mut [CollectionInfo], change: &impl Fn(&mut Vec<u32>)) {
    for info in collections {
        for report in info.output_reports.iter_mut().chain(&mut info.feature_reports) {
            report.items.iter_mut().filter(|item| item.is_array).for_each(|item| change(&mut item.usages));
        }
        change_arrays(&mut info.children, change);
    }
}

#[test]
fn arrays_that_are_told_backwards_or_as_something_else_are_put_right() {
    let right = layout("openffboard-2");
    let backwards: fn(&mut Vec<u32>) = |usages| usages.reverse();
    let others: fn(&mut Vec<u32>) = |usages| usages.iter_mut().for_each(|usage| *usage = *usage % 0x10 + 0x7700);
    for (i, change) in [backwards, others].into_iter().enumerate() {
        let mut collections = chromium(&descriptor("openffboard-2"));
        change_arrays(&mut collections, &change);
        let layout = Layout::new(&webhid::model(&collections).unwrap(), BOTH).unwrap();
        assert!(layout.offers(pid::ET_SPRING), "{i}");
        assert_eq!(layout.operate(4, false), right.operate(4, false), "{i}");
        assert_eq!(layout.set_effect(&constant(1, 0)), right.set_effect(&constant(1, 0)), "{i}");
        assert_eq!(layout.create(pid::ET_DAMPER), right.create(pid::ET_DAMPER), "{i}");
        assert_eq!(layout.loaded(&[7, 1, 0, 0]), Some(7), "{i}");
    }
}

fn command(force: f64, limit: f64) -> ForceCommand {
    let coupling = Some(Coupling { centre: 0.1, stiffness: 0.5, damping: 0.2 });
    [AxisForce { force, coupling, limit }; 2]
}

/// Lets a driver talk to a device that takes all and numbers effects from 1 on, from one ms to another; gives what was sent.
fn talk(driver: &mut PidDriver, from: u32, to: u32) -> Vec<(u32, Request)> {
    let (mut sent, mut made) = (Vec::new(), 0);
    for now in from..to {
        let Some(request) = driver.next(f64::from(now)) else { continue };
        assert_eq!(driver.next(f64::from(now)), None, "one at a time");
        let answer = [made, 1, 0, 0];
        let reply = match &request {
            Request::GetFeature { .. } => Reply::Feature(&answer),
            Request::SetFeature { .. } => {
                made += 1;
                Reply::Done
            }
            Request::Send { .. } => Reply::Done,
        };
        driver.reply(f64::from(now), reply);
        sent.push((now, request));
    }
    sent
}

fn ids(sent: &[(u32, Request)]) -> Vec<u8> {
    sent.iter()
        .map(|(_, request)| match request {
            Request::Send { id, .. } | Request::SetFeature { id, .. } | Request::GetFeature { id, .. } => *id,
        })
        .collect()
}

#[test]
fn nothing_is_written_before_a_wish_and_all_is_said_before_it_starts() {
    let mut driver = PidDriver::new(&parse(&descriptor("openffboard-2")).unwrap(), BOTH).unwrap();
    assert!(driver.has_coupling() && talk(&mut driver, 0, 100).is_empty());
    driver.command(&command(0.5, 0.5));
    let sent = talk(&mut driver, 100, 400);
    // Reset, on, gain; ask, get, describe for spring and damper; four conditions; two starts.
    assert_eq!(ids(&sent)[..15], [12, 12, 13, 0x11, 0x12, 1, 0x11, 0x12, 1, 3, 3, 3, 3, 10, 10]);
    assert_eq!(sent[0].1, Request::Send { id: 12, data: vec![8] });
    // Afterwards each is started again in time, and nothing that has not changed is said again.
    let starts: Vec<u32> = sent
        .iter()
        .filter(|(_, request)| matches!(request, Request::Send { id: 10, data } if data[0] == 1))
        .map(|(now, _)| *now)
        .collect();
    assert!(starts.len() >= 6 && starts.windows(2).all(|pair| f64::from(pair[1] - pair[0]) <= RESTART_MS + 1.0));
    assert!(ids(&sent)[15..].iter().all(|id| *id == 10));
    let Request::Send { data, .. } = &sent[5].1 else { panic!() };
    assert_eq!(f64::from(u16::from_le_bytes([data[2], data[3]])), DURATION_MS);
}

#[test]
fn a_stop_is_the_next_report_and_what_was_said_before_it_does_not_come_back() {
    let mut driver = PidDriver::new(&parse(&descriptor("openffboard-2")).unwrap(), BOTH).unwrap();
    driver.command(&command(0.5, 0.5));
    talk(&mut driver, 0, 50);
    driver.command(&command(0.6, 0.4));
    driver.stop();
    let sent = talk(&mut driver, 50, 60);
    assert_eq!(sent, [(50, Request::Send { id: 12, data: vec![4] })]);
    driver.command(&command(0.1, 0.05));
    let sent = talk(&mut driver, 60, 70);
    assert_eq!(ids(&sent)[..6], [3, 3, 3, 3, 10, 10], "limits first, then starts");
    // A stop that failed is sent again.
    driver.stop();
    let stop = driver.next(80.0);
    driver.reply(80.0, Reply::Failed);
    assert_eq!(driver.next(81.0), stop);
}

#[test]
fn constant_forces_have_an_effect_for_each_axis() {
    let model = parse(&descriptor("openffboard-2")).unwrap();
    let mut driver = PidDriver::new(&model, BOTH).unwrap().without_coupling();
    driver.command(&command(-0.5, 0.4));
    let sent = talk(&mut driver, 0, 30);
    assert_eq!(ids(&sent)[..13], [12, 12, 13, 0x11, 0x12, 1, 0x11, 0x12, 1, 5, 5, 10, 10]);
    let Request::Send { data, .. } = &sent[9].1 else { panic!() };
    assert_eq!(i16::from_le_bytes([data[1], data[2]]), (-0.4_f64 * 32767.0).round() as i16);
    assert_eq!(driver.farewell().len(), 3);
}

#[test]
fn a_device_without_room_or_that_is_silent_is_given_up() {
    let model = parse(&descriptor("openffboard-2")).unwrap();
    let mut full = PidDriver::new(&model, BOTH).unwrap();
    full.command(&command(0.5, 0.5));
    for now in 0..40 {
        let reply = match full.next(f64::from(now)) {
            Some(Request::GetFeature { .. }) => Reply::Feature(&[0, 2, 0, 0]),
            _ => Reply::Done,
        };
        full.reply(f64::from(now), reply);
    }
    assert_eq!((full.error(), full.next(99.0)), (Some(ForceError::Full), None));
    let mut silent = PidDriver::new(&model, BOTH).unwrap();
    silent.command(&command(0.5, 0.5));
    assert!(silent.next(0.0).is_some() && silent.next(400.0).is_none() && silent.error().is_none());
    assert_eq!((silent.next(600.0), silent.error()), (None, Some(ForceError::Silent)));
    let mut refused = PidDriver::new(&model, BOTH).unwrap();
    refused.command(&command(0.5, 0.5));
    (0..10).for_each(|now| {
        refused.next(f64::from(now));
        refused.reply(f64::from(now), Reply::Failed);
    });
    assert_eq!(refused.error(), Some(ForceError::Silent));
    let none = PidDriver::new(&parse(&descriptor("spacenavigator")).unwrap(), BOTH);
    assert_eq!(none.err(), Some(ForceError::Incomplete));
}

#[test]
fn a_wish_that_is_no_number_is_no_force() {
    let mut driver = PidDriver::new(&parse(&descriptor("openffboard-2")).unwrap(), BOTH).unwrap();
    driver.command(&command(0.5, 0.5));
    talk(&mut driver, 0, 50);
    let coupling = Some(Coupling { centre: f64::NAN, stiffness: 0.5, damping: f64::INFINITY });
    driver.command(&[AxisForce { force: f64::NAN, coupling, limit: 0.5 }; 2]);
    let sent = talk(&mut driver, 60, 70);
    for (_, request) in sent {
        if let Request::Send { id: 3, data } = request {
            assert_eq!(data[4..12], [0; 8], "neither coefficients nor saturations");
        }
    }
}
