//! A wire that is fed faster comes to the same place: at a hand's fastest feed its inertia and drag are nothing beside its
//! stiffness. No element's length is off by more than
//! OpenEndovascularTrainer publishes of its own wire.

use std::sync::Arc;

use glam::DVec3;
use lumen::trial::report::StepKind;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Within;
use lumen_test_support::tubes::{curve, tube};

/// Their largest length error of an element, as a part of its length (`reports/collision-benchmark.md` at c862eb31).
const PUBLISHED: f64 = 0.00177;

/// What a wire comes to that is fed through an S-shaped tube.
struct Fed {
    tip: DVec3,
    /// The part of the steps that are braked.
    braked: f64,
    /// The largest length error of an element in any step, as a part of its length.
    length_error: f64,
}

fn fed(wire: &Wire, speed: f32) -> Fed {
    let path = curve(&[(20.0, f64::INFINITY), (40.0, 25.0), (40.0, -25.0), (40.0, f64::INFINITY)], 0.5);
    let wall = Arc::new(Wall::open(Arc::new(tube(&path, |_| 1.5, 24))));
    let entry = Entry { at: [4.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
    let mut simulation = Simulation::new(wire, wire.friction, &entry, 0.0, Some(wall)).unwrap();
    let (mut braked, mut length_error) = (0.0, 0.0_f64);
    while simulation.inserted() < 110.0 && simulation.steps() < 8000 {
        let report = simulation.step(Input { feed: speed, roll: 0.0 });
        braked += f64::from(u8::from(report.kind >= StepKind::Braked));
        length_error = length_error.max(simulation.length_errors()[1]);
    }
    Fed { tip: simulation.tip(), braked: braked / simulation.steps() as f64, length_error }
}

#[test]
fn a_wire_comes_to_the_same_place_however_fast_it_is_fed() {
    let mut found = Benchmark::new("feed");
    // The tip of the workhorse is bent by 60 degrees, the others by 45: it sticks and slides on by more.
    for (name, within_mm) in [("floppy", 0.2), ("workhorse", 0.3), ("stiff", 0.2)] {
        let wire = Wire::preset(name).unwrap();
        let slow = fed(&wire, 20.0).tip;
        for speed in [30.0, 40.0, 50.0] {
            let Fed { tip, braked, length_error } = fed(&wire, speed);
            let what = format!("{} at {speed} mm/s", wire.name);
            found.compare(
                &format!("tip from where it comes to at 20 mm/s (mm): {what}"),
                0.0,
                tip.distance(slow),
                Within(within_mm),
                0,
            );
            found.compare(&format!("part of the steps that are braked: {what}"), 0.0, braked, Within(0.02), 0);
            let length = format!("largest length error of an element: {what}");
            found.compare(&length, 0.0, length_error, Within(PUBLISHED), 0);
            found.point(&wire.name, f64::from(speed), tip.distance(slow));
        }
    }
    found.finish();
}
