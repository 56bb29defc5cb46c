//! Reports by the places of their bytes, against the arithmetic of PID 1.0.

use super::*;

const STILL: [Motion; 2] = [Motion { part: 0.0, part_per_s: 0.0 }; 2];

/// Motors on, gain of all one, an effect of this type on both axes that lasts so many ms.
fn played(number: u8, duration_ms: u16) -> Effects {
    let mut effects = Effects::new();
    effects.take(id::CONTROL, &[4]).unwrap();
    effects.take(id::CONTROL, &[1]).unwrap();
    effects.take_feature(id::CREATE, &[number, 0, 0]).unwrap();
    let [low, high] = duration_ms.to_le_bytes();
    effects.take(id::EFFECT, &[1, number, low, high, 255, 0, 3, 0, 0]).unwrap();
    effects.take(id::OPERATION, &[1, 1, 1]).unwrap();
    effects
}

fn near(forces: [f32; 2], wanted: [f32; 2]) -> bool {
    (0..2).all(|axis| (forces[axis] - wanted[axis]).abs() < 1e-4)
}

fn at(part: f32, part_per_s: f32) -> [Motion; 2] {
    [Motion { part, part_per_s }, Motion::default()]
}

#[test]
fn a_spring_pulls_to_its_centre_up_to_its_saturation() {
    let mut effects = played(2, 0);
    // Centre 0.25, coefficients 1 above and 0.5 below, saturations 0.5 and 0.125, no dead band.
    effects.take(id::CONDITION, &[1, 0, 0, 0x20, 0xFF, 0x7F, 0, 0x40, 0, 0x40, 0, 0x10, 0, 0]).unwrap();
    for (place, force) in [(0.25, 0.0), (0.5, -0.25), (1.0, -0.5), (0.15, 0.05), (-1.0, 0.125)] {
        let forces = effects.advance(&at(place, 3.0));
        assert!(near(forces, [force, 0.0]), "{forces:?} at {place}");
    }
}

#[test]
fn a_spring_is_slack_in_its_dead_band() {
    let mut effects = played(2, 0);
    effects.take(id::CONDITION, &[1, 0, 0, 0, 0xFF, 0x7F, 0xFF, 0x7F, 0xFF, 0x7F, 0xFF, 0x7F, 0, 0x10]).unwrap();
    for (place, force) in [(0.1, 0.0), (-0.125, 0.0), (0.225, -0.1), (-0.225, 0.1)] {
        let forces = effects.advance(&at(place, 0.0));
        assert!(near(forces, [force, 0.0]), "{forces:?} at {place}");
    }
}

#[test]
fn a_damper_brakes_whichever_way() {
    let mut effects = played(3, 0);
    effects.take(id::CONDITION, &[1, 0, 0, 0, 0xFF, 0x7F, 0xFF, 0x7F, 0xFF, 0x7F, 0xFF, 0x7F, 0, 0]).unwrap();
    assert!(near(effects.advance(&at(0.9, 5.0)), [-0.5, 0.0]));
    assert!(near(effects.advance(&at(0.9, -20.0)), [1.0, 0.0]));
}

#[test]
fn a_constant_force_goes_along_its_axes_or_where_its_angle_says() {
    let mut effects = played(1, 0);
    effects.take(id::CONSTANT, &[1, 0, 0x20]).unwrap();
    assert!(near(effects.advance(&STILL), [0.25, 0.25]));
    // A quarter of a turn is the first axis, a half the second (255 counts have no exact quarter: 64 are 90.4 degrees).
    effects.take(id::EFFECT, &[1, 1, 0, 0, 255, 0, 4, 64, 0]).unwrap();
    assert!((effects.advance(&STILL)[0] - 0.25).abs() < 1e-3);
    effects.take(id::EFFECT, &[1, 1, 0, 0, 255, 0, 4, 128, 0]).unwrap();
    assert!((effects.advance(&STILL)[1] - 0.25).abs() < 1e-3);
    // Half the effect's gain, half that of all.
    effects.take(id::EFFECT, &[1, 1, 0, 0, 51, 0, 1, 0, 0]).unwrap();
    effects.take(id::GAIN, &[51]).unwrap();
    assert!(near(effects.advance(&STILL), [0.01, 0.0]));
}

#[test]
fn forces_add_up_to_one_and_no_further() {
    let mut effects = played(1, 0);
    effects.take(id::CONSTANT, &[1, 0xFF, 0x7F]).unwrap();
    effects.take_feature(id::CREATE, &[1, 0, 0]).unwrap();
    effects.take(id::EFFECT, &[2, 1, 0, 0, 255, 0, 1, 0, 0]).unwrap();
    effects.take(id::CONSTANT, &[2, 0, 0x40]).unwrap();
    effects.take(id::OPERATION, &[2, 1, 1]).unwrap();
    assert!(near(effects.advance(&STILL), [1.0, 1.0]));
    // Alone.
    effects.take(id::OPERATION, &[2, 2, 1]).unwrap();
    assert!(near(effects.advance(&STILL), [0.5, 0.0]));
}

#[test]
fn an_effect_ends_by_itself_and_a_host_that_falls_silent_is_not_felt() {
    let mut effects = played(1, 40);
    effects.take(id::CONSTANT, &[1, 0, 0x40]).unwrap();
    let lasted = (0..200).filter(|_| effects.advance(&STILL)[0] != 0.0).count();
    assert_eq!(lasted, 40);
    assert!(!effects.is_playing());
    // A longer duration does not bring back what is over.
    effects.take(id::EFFECT, &[1, 1, 0, 0, 255, 0, 3, 0, 0]).unwrap();
    assert_eq!(effects.advance(&STILL), [0.0; 2]);
    effects.take(id::OPERATION, &[1, 1, 1]).unwrap();
    let lasted = (0..1000).filter(|_| effects.advance(&STILL)[0] != 0.0).count();
    assert_eq!(lasted, 100);
}

#[test]
fn commands_to_the_whole_device() {
    let forces_after = |commands: &[u8]| {
        let mut effects = played(1, 0);
        effects.take(id::CONSTANT, &[1, 0, 0x40]).unwrap();
        commands.iter().for_each(|&command| effects.take(id::CONTROL, &[command]).unwrap());
        effects.advance(&STILL)[0]
    };
    assert!(forces_after(&[]) > 0.4);
    for commands in [&[2][..], &[3], &[4], &[5], &[3, 1], &[4, 1]] {
        assert_eq!(forces_after(commands), 0.0, "{commands:?}");
    }
    assert!(forces_after(&[2, 1]) > 0.4 && forces_after(&[5, 6]) > 0.4);
}

#[test]
fn effects_are_given_until_there_are_none_and_come_back() {
    let mut effects = Effects::new();
    for index in 1..=4 {
        effects.take_feature(id::CREATE, &[2, 0, 0]).unwrap();
        assert_eq!(effects.feature(id::LOAD), Some([index, 1, 0, 0]));
    }
    effects.take_feature(id::CREATE, &[2, 0, 0]).unwrap();
    assert_eq!(effects.feature(id::LOAD), Some([0, 2, 0, 0]));
    effects.take_feature(id::CREATE, &[4, 0, 0]).unwrap();
    assert_eq!(effects.feature(id::LOAD), Some([0, 3, 0, 0]));
    effects.take(id::FREE, &[3]).unwrap();
    assert_eq!(effects.take(id::FREE, &[3]), Err(Refusal::Meaningless { id: id::FREE }));
    effects.take_feature(id::CREATE, &[3, 0, 0]).unwrap();
    assert_eq!(effects.feature(id::LOAD), Some([3, 1, 0, 0]));
    assert_eq!(effects.feature(id::POOL), Some([0, 0, 4, 1]));
    assert_eq!(effects.feature(id::CREATE), None);
}

#[test]
fn whatever_comes_is_taken_or_refused() {
    let mut effects = played(1, 0);
    for byte in [0x00, 0x01, 0x7F, 0x80, 0xFF] {
        for id in 0..=255 {
            for length in 0..20 {
                let data = [byte; 20];
                _ = (effects.take(id, &data[..length]), effects.take_feature(id, &data[..length]), effects.feature(id));
                let forces = effects.advance(&at(f32::from(byte) / 255.0, f32::from(byte)));
                assert!(forces.into_iter().all(|force| (-1.0..=1.0).contains(&force)));
            }
        }
    }
    assert_eq!(effects.take(id::GAIN, &[]), Err(Refusal::Unknown { id: id::GAIN, bytes: 0 }));
}
