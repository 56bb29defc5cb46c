//! Hand, device and host together: what a hand is given, whatever the host's rate.

use super::VirtualFeeder;
use crate::device::{HapticDevice, Resistance};
use crate::feeder::HALF_WAY;
use crate::force::pid::PidDriver;
use crate::identity::Identity;
use crate::mapping::Mapping;
use crate::port::{Port, carry_out};
use crate::safety::{Halt, Limits};

/// Hosts, in ms between two looks at the device.
const PERIODS: [f64; 5] = [1000.0 / 60.0, 8.0, 4.0, 2.0, 1.0];
const JITTERS: [f64; 2] = [0.0, 30.0];
/// What a device may give a hand in closed cycles beyond what it took, in N mm: a thousandth of what 5 N over 50 mm are.
const EPSILON: f64 = 0.25;

/// A feeder, its host, and a wire that stands at a wall.
struct Rig {
    feeder: VirtualFeeder,
    device: HapticDevice,
    commanded: [f64; 2],
    /// How far the wire goes, in mm and radians.
    walls: [f64; 2],
    period: f64,
    jitter: f64,
    looks_at: f64,
    looked_at: f64,
    noise: u64,
    is_stalled: bool,
}

impl Rig {
    fn new(period: f64, jitter: f64) -> Self {
        let feeder = VirtualFeeder::default();
        let mut device = HapticDevice::from_descriptor(Identity::default(), feeder.descriptor()).unwrap();
        device.set_limits(Limits { cap: 0.6, ..Limits::default() });
        Self {
            feeder,
            device,
            commanded: [0.0; 2],
            walls: [5.0, 0.5],
            period,
            jitter,
            looks_at: 1.0,
            looked_at: 0.0,
            noise: 1,
            is_stalled: false,
        }
    }

    /// 0 to 1, the same in each run (the generator of Knuth's MMIX).
    fn random(&mut self) -> f64 {
        self.noise = self.noise.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.noise >> 40) as f64 / (1_u64 << 24) as f64
    }

    /// A ms: the device, then what the host does in it. A report is one ms under way.
    fn advance(&mut self) {
        self.feeder.advance();
        if self.is_stalled {
            return;
        }
        let now = f64::from(self.feeder.now_ms());
        if now >= self.looks_at {
            while let Ok(Some(report)) = self.feeder.poll() {
                self.device.input(now, report.id, &report.data);
            }
            let moved = self.device.advance((now - self.looked_at) / 1000.0);
            // As stiff as the device's own spring at its stiffest.
            let slope = HALF_WAY.map(f64::recip);
            let part = std::array::from_fn(|axis| {
                self.commanded[axis] += moved[axis];
                (self.commanded[axis] - self.walls[axis]).max(0.0) * slope[axis]
            });
            self.device.resist(now, &Resistance { part, slope });
            self.looked_at = now;
            self.looks_at = now + self.period + self.jitter * self.random();
        }
        if let Some(request) = self.device.next(now) {
            let device = &mut self.device;
            _ = carry_out(&mut self.feeder, &request, |reply| device.reply(now, reply));
        }
    }

    fn run(&mut self, ms: u32) -> Vec<[f64; 2]> {
        let each = (0..ms).map(|_| {
            self.advance();
            self.feeder.forces()
        });
        each.collect()
    }
}

fn peak(forces: &[[f64; 2]]) -> f64 {
    forces.iter().flatten().fold(0.0, |peak: f64, force| peak.max(force.abs()))
}

/// Rigs of all rates, with the device's own springs and with constant forces from the host.
fn rigs() -> impl Iterator<Item = (String, Rig)> {
    let rates = PERIODS.into_iter().flat_map(|period| JITTERS.map(|jitter| (period, jitter)));
    rates.flat_map(|(period, jitter)| {
        [true, false].map(|has_coupling| {
            let mut rig = Rig::new(period, jitter);
            if !has_coupling {
                let usages = [crate::usage::desktop::X, crate::usage::desktop::RX].map(Some);
                let driver = PidDriver::new(rig.device.model(), usages).unwrap().without_coupling();
                rig.device.set_driver(Box::new(driver));
            }
            (format!("{period:.1} ms + {jitter} ms, spring {has_coupling}"), rig)
        })
    })
}

#[test]
fn a_wall_is_felt_and_nothing_before_it() {
    for (name, mut rig) in rigs() {
        assert_eq!(peak(&rig.run(200)), 0.0, "{name}: not armed");
        rig.device.arm();
        rig.feeder.hands[0].wanted = 3.0;
        assert!(peak(&rig.run(1000)) < 0.3, "{name}: free but for the damper");
        rig.feeder.hands[0].wanted = 25.0;
        let pressed = rig.run(2000);
        let (force, place) = (pressed[1999][0], rig.feeder.hands[0].place);
        // Grip 0.3 N/mm against 0.1 N/mm from 5 mm on: the hand ends at 20 mm, the motor at -1.5 N. What a slow host
        // computes is softer.
        assert!((force + 0.3 * (25.0 - place)).abs() < 0.02, "{name}: {force} N at {place} mm");
        let least = if name.ends_with("true") { 1.45 } else { 0.15 };
        assert!((least..1.55).contains(&-force), "{name}: {force} N at {place} mm");
        rig.feeder.hands[1].wanted = 3.0;
        let turned = rig.run(2000);
        assert!(turned[1999][1] < -1.0, "{name}: {} N mm", turned[1999][1]);
        assert!(rig.device.force_error().is_none() && rig.device.latency().count > 100, "{name}");
    }
}

#[test]
fn a_hand_that_goes_in_and_out_gets_no_more_than_it_gave() {
    for (name, mut rig) in rigs() {
        rig.run(100);
        rig.device.arm();
        rig.run(200);
        for hand in &mut rig.feeder.hands {
            hand.work = 0.0;
        }
        for cycle in 0..8 {
            // A cycle of 0.8 s, and a rest in which all comes back to where it was.
            for ms in 0..1200 {
                let phase = (f64::from(ms) / 800.0).min(1.0) * std::f64::consts::PI;
                let way = libm::sin(phase) * libm::sin(phase);
                rig.feeder.hands[0].wanted = 30.0 * way;
                rig.feeder.hands[1].wanted = 2.0 * way;
                rig.advance();
            }
            for hand in &rig.feeder.hands {
                // The other axis's unit is N mm a radian: its most is 50 N mm over 2 pi.
                assert!(hand.work <= EPSILON, "{name}: {} N mm after cycle {cycle}", hand.work);
                assert!(hand.place.abs() < 0.5, "{name}");
            }
        }
    }
}

#[test]
fn a_hand_that_holds_still_is_left_still() {
    for (name, mut rig) in rigs() {
        rig.run(100);
        rig.device.arm();
        for (grip, calm) in [(0.3, 0.003), (0.1, 0.002)] {
            (rig.feeder.hands[0].grip, rig.feeder.hands[0].calm) = (grip, calm);
            rig.feeder.hands[0].wanted = 18.0;
            rig.run(3000);
            let (mut least, mut greatest) = (f64::INFINITY, f64::NEG_INFINITY);
            for _ in 0..1000 {
                rig.advance();
                let place = rig.feeder.hands[0].place;
                (least, greatest) = (least.min(place), greatest.max(place));
            }
            assert!(greatest - least < 0.1, "{name}, grip {grip}: swings by {} mm", greatest - least);
        }
    }
}

/// A rig whose hand is pressed against the wall.
fn pressed(mut rig: Rig) -> Rig {
    rig.run(100);
    rig.device.arm();
    rig.feeder.hands[0].wanted = 25.0;
    assert!(peak(&rig.run(2000)) > 0.15);
    rig
}

#[test]
fn the_force_is_gone_150_ms_after_the_host_falls_silent() {
    for (name, rig) in rigs() {
        let mut rig = pressed(rig);
        rig.is_stalled = true;
        rig.run(150);
        assert_eq!(peak(&rig.run(500)), 0.0, "{name}");
    }
}

#[test]
fn the_force_is_gone_150_ms_after_the_trial_falls_silent() {
    // The host still writes; only what resists is no longer told.
    for (name, rig) in rigs() {
        let mut rig = pressed(rig);
        rig.looks_at = f64::INFINITY;
        rig.run(150);
        assert_eq!(peak(&rig.run(500)), 0.0, "{name}");
    }
}

#[test]
fn the_force_is_gone_20_ms_after_blur_pause_and_unplugging() {
    for (name, rig) in rigs() {
        let mut rig = pressed(rig);
        rig.device.halt(Halt::Hidden);
        rig.run(20);
        assert_eq!(peak(&rig.run(500)), 0.0, "{name}: hidden");
        rig.device.arm();
        assert!(peak(&rig.run(1000)) > 0.15, "{name}: armed again");
        rig.device.pause(true);
        rig.run(20);
        assert_eq!(peak(&rig.run(500)), 0.0, "{name}: paused");
        rig.device.pause(false);
        assert!(peak(&rig.run(1000)) > 0.15, "{name}: goes on");
        rig.feeder.unplug();
        rig.run(1);
        assert_eq!(peak(&rig.run(100)), 0.0, "{name}: unplugged");
        rig.feeder.plug_in();
        assert_eq!(peak(&rig.run(500)), 0.0, "{name}: plugged in again, and not armed");
    }
}

#[test]
fn a_mapping_is_armed_anew() {
    let mut rig = pressed(Rig::new(4.0, 0.0));
    let mapping = Mapping { roll: None, ..*rig.device.mapping() };
    rig.device.set_mapping(mapping);
    assert_eq!(rig.device.halted(), Some(Halt::NotArmed));
    // What the device was playing is stopped, and would end by itself.
    rig.run(20);
    assert_eq!(peak(&rig.run(300)), 0.0);
}

#[test]
fn the_firmware_takes_nothing_that_is_not_a_report_of_its_own() {
    let mut feeder = VirtualFeeder::default();
    for id in 0..=255 {
        for length in 0..20 {
            let data = vec![0xFF; length];
            _ = (feeder.send(id, &data), feeder.set_feature(id, &data), feeder.get_feature(id, length));
        }
    }
    feeder.advance();
    assert_eq!(feeder.forces(), [0.0; 2]);
}
