//! The virtual feeder beside the firmware's own code (`firmware/feeder`), which was written without it: the same reports, the
//! same answers, the same forces.

use lumen_feeder::device::{Device, FEED_HALF_WAY, Seen};
use lumen_feeder::effects::{Effects, Motion};
use proptest::prelude::*;

use super::VirtualFeeder;
use crate::device::{HapticDevice, Resistance};
use crate::feeder::{DESCRIPTOR, id};
use crate::identity::Identity;
use crate::port::{InputReport, Port, PortError, carry_out};

/// What a host may do with a feeder, and how many ms later it does the next.
#[derive(Clone, Debug)]
enum Said {
    Output(u8, Vec<u8>),
    Create(u8),
    Nothing(u32),
}

fn said() -> impl Strategy<Value = Said> {
    // An index or a number too many, too.
    let index = 0..6_u8;
    let effect = (index.clone(), 0..5_u8, prop_oneof![Just(0), 1..200_u16], any::<u8>(), 0..8_u8, any::<u8>());
    let effect = effect.prop_map(|(index, kind, duration, gain, axes, direction)| {
        let [low, high] = duration.to_le_bytes();
        Said::Output(id::EFFECT, vec![index, kind, low, high, gain, 0, axes, direction, 0])
    });
    let condition = (index.clone(), 0..3_u8, any::<[u8; 12]>());
    let condition =
        condition.prop_map(|(index, axis, rest)| Said::Output(id::CONDITION, [&[index, axis][..], &rest].concat()));
    let constant =
        (index.clone(), any::<[u8; 2]>()).prop_map(|(index, [a, b])| Said::Output(id::CONSTANT, vec![index, a, b]));
    let operation = (index.clone(), prop_oneof![3 => Just(1_u8), 1 => 0..5_u8])
        .prop_map(|(index, what)| Said::Output(id::OPERATION, vec![index, what, 1]));
    prop_oneof![
        3 => (0..5_u8).prop_map(Said::Create),
        4 => effect,
        4 => condition,
        4 => constant,
        4 => operation,
        1 => index.prop_map(|index| Said::Output(id::FREE, vec![index])),
        // On is what it is most often told.
        3 => prop_oneof![3 => Just(1_u8), 1 => 0..8_u8].prop_map(|command| Said::Output(id::CONTROL, vec![command])),
        1 => any::<u8>().prop_map(|gain| Said::Output(id::GAIN, vec![gain])),
        4 => (1..150_u32).prop_map(Said::Nothing),
    ]
}

fn motions(feeder: &VirtualFeeder) -> [Motion; 2] {
    feeder.hands.map(|hand| Motion { part: hand.part() as f32, part_per_s: hand.part_per_s() as f32 })
}

proptest! {
    #[test]
    fn both_do_the_same_with_the_same_reports(host in prop::collection::vec(said(), 1..120), wanted in -60.0..60.0) {
        let (mut feeder, mut firmware) = (VirtualFeeder::default(), Effects::new());
        feeder.hands[0].wanted = wanted;
        feeder.hands[1].wanted = 0.1 * wanted;
        let begun = [(id::CONTROL, vec![4]), (id::CONTROL, vec![1])].map(|(id, data)| Said::Output(id, data));
        for said in begun.into_iter().chain(host) {
            let mut ms = 1;
            match &said {
                Said::Output(id, data) => {
                    let (a, b) = (feeder.send(*id, data), firmware.take(*id, data));
                    prop_assert_eq!(a.is_ok(), b.is_ok(), "{:?}", said);
                }
                Said::Create(kind) => {
                    let data = [*kind, 0, 0];
                    prop_assert!(feeder.set_feature(id::CREATE, &data).is_ok());
                    prop_assert!(firmware.take_feature(id::CREATE, &data).is_ok());
                }
                Said::Nothing(pause) => ms = *pause,
            }
            for id in [id::LOAD, id::POOL] {
                let answer = firmware.feature(id).unwrap();
                prop_assert_eq!(&feeder.get_feature(id, 4).unwrap()[1..], &answer[..]);
            }
            for _ in 0..ms {
                let forces = firmware.advance(&motions(&feeder));
                feeder.advance();
                for (axis, force) in forces.into_iter().enumerate() {
                    let part = feeder.forces()[axis] / feeder.hands[axis].most_force;
                    prop_assert!((part - f64::from(force)).abs() < 1e-4, "{:?}: {} {}", said, part, force);
                }
            }
        }
    }
}

/// The firmware's device as a port: what a transport does with it, and steps of its feed.
struct Board {
    device: Device,
    steps: i32,
    force: f32,
    report: Option<InputReport>,
}

impl Board {
    fn advance(&mut self) {
        let mut seen = Seen { has_power: true, ..Seen::default() };
        seen.steps[0].counts = std::mem::take(&mut self.steps);
        self.force = self.device.advance(&seen)[0];
        let [id, data @ ..] = self.device.state();
        self.report = Some(InputReport { id, data: data.to_vec() });
    }
}

impl Port for Board {
    fn descriptor(&self) -> &[u8] {
        DESCRIPTOR
    }

    fn send(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
        self.device.take(id, data).map_err(|refusal| PortError::Refused { id, reason: refusal.to_string() })
    }

    fn set_feature(&mut self, id: u8, data: &[u8]) -> Result<(), PortError> {
        self.device.take_feature(id, data).map_err(|refusal| PortError::Refused { id, reason: refusal.to_string() })
    }

    fn get_feature(&mut self, id: u8, _bytes: usize) -> Result<Vec<u8>, PortError> {
        let answer = self.device.feature(id).map(|answer| answer.to_vec());
        answer.ok_or_else(|| PortError::Refused { id, reason: "it cannot be got".to_owned() })
    }

    fn poll(&mut self) -> Result<Option<InputReport>, PortError> {
        Ok(self.report.take())
    }
}

#[test]
fn lumen_drives_the_firmware_without_a_change() {
    let mut board = Board { device: Device::new(), steps: 0, force: 0.0, report: None };
    let mut host = HapticDevice::from_descriptor(Identity::default(), board.descriptor()).unwrap();
    let mut moved = 0.0;
    let mut run = |board: &mut Board, host: &mut HapticDevice, ms: std::ops::Range<u32>, wall: f64| {
        for now in ms.map(f64::from) {
            board.advance();
            if let Some(report) = board.poll().unwrap() {
                host.input(now, report.id, &report.data);
            }
            moved += host.advance(1e-3)[0];
            let beyond: f64 = f64::max(moved - wall, 0.0);
            host.resist(now, &Resistance { part: [0.02 * beyond, 0.0], slope: [0.02, 0.0] });
            if let Some(request) = host.next(now) {
                carry_out(board, &request, |reply| host.reply(now, reply)).unwrap();
            }
        }
        moved
    };
    run(&mut board, &mut host, 1..200, 5.0);
    host.arm();
    run(&mut board, &mut host, 200..600, 5.0);
    assert_eq!(board.force, 0.0, "free");
    // Over 10 mm in 0.3 s, and a second later.
    for ms in 600..900 {
        let place = |ms: i32| FEED_HALF_WAY / 5 * ms / 300;
        board.steps = place(ms - 599) - place(ms - 600);
        run(&mut board, &mut host, ms as u32..ms as u32 + 1, 5.0);
    }
    let fed = run(&mut board, &mut host, 900..1900, 5.0);
    assert!((fed - 10.0).abs() < 0.5, "{fed} mm");
    assert!(board.force < -0.05, "it pushes back: {}", board.force);
    assert!(host.force_error().is_none());
    // The host falls silent.
    (0..150).for_each(|_| board.advance());
    assert_eq!(board.force, 0.0);
}
