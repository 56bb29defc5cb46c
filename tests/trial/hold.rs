//! What a hand feels of a real trial: no jump when an element is born or a contact changes, and no more work than it did.

use crate::steps::{in_an_s, in_the_aorta};
use lumen::haptics::device::HapticDevice;
use lumen::haptics::identity::Identity;
use lumen::haptics::port::{Port as _, carry_out};
use lumen::haptics::service::Service;
use lumen::haptics::virtual_feeder::VirtualFeeder;
use lumen::trial::STEP;
use lumen::trial::report::StepKind;
use lumen::trial::session::{ROW_STEPS, Trial};
use lumen::trial::virtual_coupling::{CouplingGains, VirtualCoupling};

/// A step as the hand saw it.
struct Step {
    felt: [f64; 2],
    /// The guide's push and torque.
    reaction: [f64; 2],
    kind: StepKind,
}

/// A trial in the hand of somebody.
struct Held {
    trial: Trial,
    hold: VirtualCoupling,
    /// The hand's work, in N mm along the wire and about it.
    work: [f64; 2],
    steps: Vec<Step>,
}

impl Held {
    fn new(trial: Trial) -> Self {
        Self { trial, hold: VirtualCoupling::default(), work: [0.0; 2], steps: Vec::new() }
    }

    /// A step in which the hand moves so far, in mm and radians.
    fn step(&mut self, by: [f64; 2]) {
        if self.trial.simulation().steps().is_multiple_of(ROW_STEPS) {
            let input = self.hold.input();
            self.trial.drive(input);
        }
        let before = self.hold.felt();
        self.hold.moves(by);
        self.trial.step();
        let report = self.trial.simulation().report();
        self.hold.stepped(&report);
        let felt = self.hold.felt();
        (0..2).for_each(|i| self.work[i] += 0.5 * (before[i] + felt[i]) * by[i]);
        self.steps.push(Step { felt, reaction: [report.push_n, report.torque_n_mm], kind: report.kind });
    }

    /// Moves at these speeds, in mm/s and rad/s, for so many seconds.
    fn go(&mut self, speeds: [f64; 2], seconds: f64) {
        (0..(seconds / STEP) as u32).for_each(|_| self.step(speeds.map(|speed| speed * STEP)));
    }
}

/// The greatest change from one step to the next.
fn jump(values: impl Iterator<Item = f64>) -> f64 {
    let values: Vec<f64> = values.collect();
    values.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max)
}

#[test]
fn nothing_jumps_while_elements_are_born_and_contacts_change() {
    for (name, trial) in [("aorta", in_the_aorta("stiff")), ("narrow S", in_an_s())] {
        let mut held = Held::new(trial);
        held.go([20.0, 0.0], 3.0);
        held.go([15.0, 3.0], 2.0);
        held.go([-15.0, -3.0], 1.5);
        held.go([0.0, 0.0], 0.5);
        held.go([20.0, 1.0], 1.5);
        let push = held.steps.iter().map(|step| step.reaction[0].abs()).fold(0.0, f64::max);
        assert!(held.trial.simulation().count() > 20 && push > 1e-3, "{name}: nothing was met, {push} N");
        for (i, grip) in [CouplingGains::FEED, CouplingGains::ROLL].into_iter().enumerate() {
            let felt = jump(held.steps.iter().map(|step| step.felt[i]));
            let raw = jump(held.steps.iter().map(|step| step.reaction[i]));
            let own = grip.stiffness * STEP * [20.0, 3.0][i];
            assert!(felt <= grip.slew * STEP + 1e-9, "{name}: {felt} felt");
            // What the hand itself does in a step, and the wire's fastest answer, are felt at once; beyond that a jump of
            // the guide's reaction is spread over more than ten steps, but for what has stood still before.
            let is_frozen = held.steps.iter().any(|step| step.kind != StepKind::Balanced);
            assert!(
                is_frozen || felt <= 2.0 * own + 0.1 * raw,
                "{name}: {felt} felt, {raw} of the guide, {own} of the hand"
            );
        }
        assert!(
            held.steps.windows(2).all(|pair| pair[1].kind == StepKind::Balanced || pair[1].felt == pair[0].felt),
            "frozen"
        );
    }
}

#[test]
fn over_closed_cycles_the_hand_gives_and_is_given_nothing() {
    for (name, trial) in [("aorta", in_the_aorta("stiff")), ("narrow S", in_an_s())] {
        let mut held = Held::new(trial);
        held.go([20.0, 0.0], 3.0);
        held.go([0.0, 0.0], 1.0);
        held.work = [0.0; 2];
        for cycle in 0..4 {
            for direction in [1.0, -1.0] {
                held.go([10.0 * direction, 2.0 * direction], 0.5);
            }
            held.go([0.0, 0.0], 0.3);
            // A hundredth of what 0.1 N over 5 mm, and 1 N mm over a radian, are.
            assert!(held.work[0] > -0.005 && held.work[1] > -0.01, "{name}: {:?} N mm after cycle {cycle}", held.work);
        }
    }
}

/// A feeder of 5 N, and a host that looks at it each ms.
#[test]
fn a_push_of_50_mn_is_felt_as_three_times_as_much_on_the_feeder() {
    let mut feeder = VirtualFeeder::default();
    let device = HapticDevice::from_descriptor(Identity::default(), feeder.descriptor()).unwrap();
    let mut service = Service::new(device);
    service.device_mut().arm();
    let (push, stiffness) = ([0.05, 0.0], VirtualCoupling::default().stiffness());
    for _ in 0..2000 {
        feeder.advance();
        let now = f64::from(feeder.now_ms());
        while let Ok(Some(report)) = feeder.poll() {
            service.device_mut().input(now, report.id, &report.data);
        }
        service.advance(1e-3);
        service.feel(now, Some((push, stiffness)));
        if let Some(request) = service.device_mut().next(now) {
            _ = carry_out(&mut feeder, &request, |reply| service.device_mut().reply(now, reply));
        }
    }
    // What slides at the feeder's own friction takes a part of it.
    let felt = -feeder.forces()[0];
    assert!((0.15..0.25).contains(&felt), "{felt} N");
}
