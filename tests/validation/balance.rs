//! Newton's second law while a wire is steered: what the wall and the guide do to it is what its mass and the blood's drag
//! take. What is left over is what a step has not settled; no force that is shown or logged is better than that. All steps
//! are counted, those in which the solver braked or the guide waited too; what is shown is that of balanced steps alone.

use std::sync::Arc;

use glam::DVec3;
use lumen::trial::STEP;
use lumen::trial::report::StepKind;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Within;
use lumen_test_support::tubes::{curve, tube};

/// The part of the wall's forces that is left over in each step in which the wall presses, in order; and how many of
/// these steps are not balanced, as a part.
fn left_over(wire: &str, found: &mut Benchmark) -> (Vec<f64>, f64) {
    let path = curve(&[(20.0, f64::INFINITY), (40.0, 25.0), (40.0, -25.0), (40.0, f64::INFINITY)], 0.5);
    let wall = Arc::new(Wall::open(Arc::new(tube(&path, |_| 1.5, 24))));
    let entry = Entry { at: [4.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
    let wire = Wire::preset(wire).unwrap();
    let mut simulation = Simulation::new(&wire, wire.friction, &entry, 0.0, Some(wall)).unwrap();
    let (mut parts, mut unbalanced) = (Vec::new(), 0.0);
    while simulation.inserted() < 110.0 {
        let roll = if (simulation.steps() / 500).is_multiple_of(2) { 3.0 } else { -3.0 };
        let before = simulation.body().rod.velocities.clone();
        let report = simulation.step(Input { feed: 20.0, roll });
        assert_ne!(report.kind, StepKind::Held);
        let body = simulation.body();
        let mut rod = body.rod.clone();
        let (first, count) = (simulation.count(), rod.len());
        let taken = |i: usize| {
            let now = rod.velocities[i];
            let change = now - before.get(i).copied().unwrap_or_default();
            change * (rod.sections[i].mass / STEP) + now * rod.sections[i].drag
        };
        let taken: DVec3 = (0..first).map(taken).sum();
        rod.assemble_from(first - 2);
        let guide: DVec3 = (first..count).map(|i| rod.reaction_force(i)).sum();
        let wall: DVec3 = body.contacts.forces(count).into_iter().sum();
        let (pressed, _) = body.pressure();
        let left = (wall + guide - taken).length();
        if pressed > 1e-4 {
            parts.push(left / pressed);
            unbalanced += f64::from(u8::from(report.kind != StepKind::Balanced));
        }
        // The step says so itself; a node that the guide took back has taken its momentum along.
        if report.kind == StepKind::Balanced {
            assert!((report.residual_n - left).abs() < 1e-6 + 1e-6 * pressed, "{report:?}: {left} N are left over");
        }
        if simulation.steps().is_multiple_of(25) {
            found.point(&format!("wall: {}", wire.name), simulation.steps() as f64 * STEP, pressed * 1e3);
        }
    }
    parts.sort_by(f64::total_cmp);
    let share = unbalanced / parts.len() as f64;
    (parts, share)
}

#[test]
fn what_the_wall_and_the_guide_do_adds_up_to_nothing() {
    let mut found = Benchmark::new("balance");
    for wire in ["floppy", "workhorse", "stiff"] {
        let (parts, unbalanced) = left_over(wire, &mut found);
        let at = |part: f64| parts[(part * parts.len() as f64) as usize];
        for (part, most) in [(0.5, 0.002), (0.9, 0.03), (0.95, 0.06)] {
            let percent = 100.0 * part;
            let what = format!("part of the wall's forces left over at most in {percent} % of the steps: {wire}");
            found.compare(&what, 0.0, at(part), Within(most), 0);
        }
        found.compare(&format!("part of the steps that is not balanced: {wire}"), 0.0, unbalanced, Within(0.05), 0);
    }
    found.finish();
}
