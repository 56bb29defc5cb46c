//! What a hand feels of a real trial: no jump when an element is born or a contact changes, and no more work than it did.

use std::sync::Arc;

use lumen::io::import_mesh;
use lumen::phantom::{Sample, generate};
use lumen::trial::STEP;
use lumen::trial::course::Course;
use lumen::trial::hold::{Grip, Hold};
use lumen::trial::report::StepKind;
use lumen::trial::session::{ROW_STEPS, Trial};
use lumen::trial::setup::Setup;
use lumen::trial::wire::Wire;

/// A trial in the hand of somebody.
struct Held {
    trial: Trial,
    hold: Hold,
    /// The hand's work, in N mm along the wire and about it.
    work: [f64; 2],
    /// Of each step: what is felt, the guide's reaction, how far the hand moved, and of which kind it was.
    steps: Vec<([f64; 2], [f64; 2], [f64; 2], StepKind)>,
}

impl Held {
    fn new(wire: &str) -> Self {
        let mesh = Arc::new(import_mesh(generate(Sample::Aorta, 20_000).unwrap(), "sample").mesh);
        let mut setup = Setup { wire: Wire::preset(wire).unwrap(), ..Setup::default() };
        let course = Course::new(&mesh, Some(Sample::Aorta), &mut setup).unwrap();
        let trial = Trial::new(Arc::new(course), setup).unwrap();
        Self { trial, hold: Hold::default(), work: [0.0; 2], steps: Vec::new() }
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
        self.steps.push((felt, [report.push_n, report.torque_n_mm], by, report.kind));
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
    for wire in ["workhorse-j", "stiff"] {
        let mut held = Held::new(wire);
        held.go([20.0, 0.0], 5.0);
        held.go([15.0, 3.0], 3.0);
        held.go([-15.0, -3.0], 2.0);
        held.go([0.0, 0.0], 0.5);
        held.go([20.0, 1.0], 3.0);
        let (nodes, push) =
            (held.trial.simulation().count(), held.steps.iter().map(|step| step.1[0].abs()).fold(0.0, f64::max));
        assert!(nodes > 20 && push > 0.01, "{nodes} nodes and {push} N: nothing was met");
        for (i, grip) in [Grip::FEED, Grip::ROLL].into_iter().enumerate() {
            let felt = jump(held.steps.iter().map(|step| step.0[i]));
            let raw = jump(held.steps.iter().map(|step| step.1[i]));
            // What the hand itself does in a step, and the wire's fastest answer, are felt at once; beyond that a jump of
            // the guide's reaction is spread over more than ten steps.
            let own = grip.stiffness * STEP * [20.0, 3.0][i];
            println!("{wire} {i}: felt {felt}, raw {raw}, own {own}");
            assert!(felt <= 2.0 * own + 0.1 * raw, "{wire}: {felt} felt, {raw} of the guide, {own} of the hand");
            assert!(felt <= grip.slew * STEP + 1e-9);
        }
        assert!(held.steps.windows(2).all(|pair| pair[1].3 == StepKind::Balanced || pair[1].0 == pair[0].0), "frozen");
    }
}

#[test]
fn over_closed_cycles_the_hand_gives_and_is_given_nothing() {
    for wire in ["workhorse-j", "stiff"] {
        let mut held = Held::new(wire);
        held.go([20.0, 0.0], 6.0);
        held.go([0.0, 0.0], 1.0);
        held.work = [0.0; 2];
        for cycle in 0..4 {
            for direction in [1.0, -1.0] {
                held.go([10.0 * direction, 2.0 * direction], 0.5);
            }
            held.go([0.0, 0.0], 0.3);
            println!("{wire} {cycle}: {:?}", held.work);
            // A hundredth of what 0.1 N over 5 mm, and 1 N mm over a radian, are.
            assert!(held.work[0] > -0.005 && held.work[1] > -0.01, "{wire}: {:?} N mm after cycle {cycle}", held.work);
        }
    }
}
