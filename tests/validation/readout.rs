//! Push and torque as they are told: by [`Simulation::push_and_torque`], of a wire that grows out of its guide. What the
//! other benchmarks ask of rods and contacts is asked here of all of it together, and in newtons.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use lumen::trial::report::StepKind;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::{Part, Within};
use crate::friction::{RADIUS, TUBE};
use crate::torsion::base_angle;
use crate::tube_buckling::{GROWTH, uneven};
use lumen_test_support::tubes::{Place, curve, tube};

/// Radius of the bends in mm.
const BEND: f64 = 20.0;
/// Radial clearance in mm.
const CLEARANCE: f64 = TUBE - RADIUS;
/// Steps in which what pulls or pushes at the tip grows: what comes all at once throws it about.
const RISE: usize = 400;

/// A straight wire of one stiffness in N mm2, its elements 1 mm long.
fn plain(ei: f64) -> Wire {
    Wire {
        tip_ei: ei,
        shaft_ei: ei,
        bend_degrees: 0.0,
        elements_mm: [1.0; 2],
        length_mm: 400.0,
        ..Wire::preset("workhorse").unwrap()
    }
}

fn entry(at: DVec3) -> Entry {
    Entry { at: at.as_vec3().to_array(), direction: [1.0, 0.0, 0.0] }
}

/// Feeds until this much is in.
fn feed(simulation: &mut Simulation, to: f64) {
    for _ in 0..20_000 {
        if simulation.inserted() >= to {
            return;
        }
        simulation.step(Input { feed: 30.0, roll: 0.0 });
    }
    panic!("{} mm of {to} are in", simulation.inserted());
}

/// A force at the tip, in N.
fn at_tip(simulation: &mut Simulation, force: DVec3) {
    let cell = simulation.body().rod.sections[0].cell;
    simulation.set_loads(vec![force / cell]);
}

/// Push and torque, as means of what balanced steps tell while the input lasts.
fn told(simulation: &mut Simulation, input: Input, steps: usize) -> [f64; 2] {
    let (mut sum, mut times) = ([0.0; 2], 0.0);
    for _ in 0..steps {
        if simulation.step(input).kind == StepKind::Balanced {
            let [push, torque] = simulation.push_and_torque();
            sum = [sum[0] + push, sum[1] + torque];
            times += 1.0;
        }
    }
    assert!(times > 0.25 * steps as f64, "{times} of {steps} steps are balanced");
    sum.map(|sum| sum / times)
}

/// Half a turn between two straight parts of 14 mm.
fn half_turn(step: f64) -> Vec<Place> {
    curve(&[(14.0, f64::INFINITY), (PI * BEND, BEND), (14.0, f64::INFINITY)], step)
}

/// What it takes at the guide to draw a wire through half a turn against a force at its tip in N, or to push it there.
fn bent(mu: f64, ei: f64, force: f64, is_pushed: bool) -> f64 {
    // A free tip that is pushed leans from wall to wall, and is held by friction there: in a narrow tube by little.
    let clearance = if is_pushed { 0.2 } else { CLEARANCE };
    let wall = Arc::new(Wall::open(Arc::new(tube(&half_turn(0.23), |_| clearance + RADIUS, 48))));
    // On the inside of the bend, which is to the left, or on the outside.
    let side = if is_pushed { -1.0 } else { 1.0 };
    let at = DVec3::new(3.0, side * clearance * 0.95, 0.0);
    let mut simulation = Simulation::new(&plain(ei), [mu; 2], &entry(at), 0.0, Some(wall)).unwrap();
    feed(&mut simulation, 11.0 + PI * (BEND - side * clearance) + 11.0);
    // The tube comes back on its way: out is to -x there.
    let way = if is_pushed { DVec3::X } else { DVec3::NEG_X };
    let input = Input { feed: if is_pushed { 1.0 } else { -1.0 }, roll: 0.0 };
    for i in 0..RISE {
        at_tip(&mut simulation, way * force * (i + 1) as f64 / RISE as f64);
        simulation.step(input);
    }
    (0..600).for_each(|_| _ = simulation.step(input));
    let [push, _] = told(&mut simulation, input, 300);
    if is_pushed { push } else { -push }
}

#[test]
fn push_through_a_bend_is_told_as_the_capstan_has_it() {
    let mut found = Benchmark::new("readout-bend");
    for (name, ei, force, is_pushed) in [("pull", 0.5, 1.0, false), ("push", 1.0, 0.05, true)] {
        // What bending takes without friction is subtracted.
        let free = bent(0.0, ei, force, is_pushed) - force;
        found.compare(&format!("{name} without friction (N)"), force, free + force, Part(0.03), 85);
        for mu in [0.1, 0.2] {
            let ours = bent(mu, ei, force, is_pushed) - free;
            found.compare(&format!("{name} at μ = {mu} (N)"), (mu * PI).exp() * force, ours, Part(0.03), 85);
            found.point(name, mu, ours / force);
        }
    }
    for i in 0..=20 {
        let mu = f64::from(i) / 100.0;
        found.curve("e^μθ", mu, (mu * PI).exp());
    }
    found.finish();
}

#[test]
fn a_weight_along_the_wire_is_what_it_pushes_with() {
    let mut found = Benchmark::new("readout-weight");
    let load = 1e-4;
    for (name, way) in [("against its way in", -1.0), ("on its way in", 1.0)] {
        let mut simulation = Simulation::new(&plain(40.0), [0.0; 2], &entry(DVec3::ZERO), 0.0, None).unwrap();
        simulation.set_load(DVec3::X * way * load).unwrap();
        feed(&mut simulation, 30.0);
        let [push, torque] = told(&mut simulation, Input::default(), 200);
        // What is outside the guide, and half an element that the tip has in common with nothing.
        let what = format!("push with 0.1 mN on each mm {name} (N)");
        found.compare(&what, -way * load * simulation.inserted(), push, Part(0.005), 30);
        found.compare(&format!("torque beside it {name} (N mm)"), 0.0, torque, Within(1e-9), 30);
        // The element that crosses the mouth bears all of the load, inside the guide as well.
        let (outside, length) = (simulation.inserted(), simulation.grid()[simulation.count()]);
        let ea = simulation.body().rod.sections[0].ea;
        let mean = load * outside * (length - outside / 2.0) / (ea * length);
        let [stretch, _] = simulation.length_errors();
        found.compare(&format!("stretch by it {name} over the length"), mean, stretch, Part(0.005), 30);
    }
    found.finish();
}

#[test]
fn a_wire_that_is_bent_at_the_mouth_comes_out_by_itself() {
    let mut found = Benchmark::new("readout-sleeve");
    let (ei, load) = (5.0, 2e-3);
    let mut simulation = Simulation::new(&plain(ei), [0.0; 2], &entry(DVec3::ZERO), 0.0, None).unwrap();
    for to in [15.0, 20.0, 25.0, 30.0, 35.0] {
        at_tip(&mut simulation, DVec3::Y * load);
        feed(&mut simulation, to);
        told(&mut simulation, Input::default(), 1500);
        let [push, _] = told(&mut simulation, Input::default(), 300);
        // The load does not act along the way in: what holds the wire back is the moment at the mouth alone.
        let moment = load * simulation.tip().x;
        let exact = -moment * moment / (2.0 * ei);
        found.compare(&format!("push with {to} mm outside (N)"), exact, push, Part(0.02), to as usize);
        found.point("ours", to, push);
        found.curve("analytic", to, exact);
    }
    found.finish();
}

#[test]
fn what_the_hand_does_is_what_the_wire_holds() {
    let mut found = Benchmark::new("readout-work");
    // The guide ends where the bend begins.
    let path = |step: f64| curve(&[(4.0, f64::INFINITY), (0.5 * PI * BEND, BEND), (40.0, f64::INFINITY)], step);
    for ei in [2.0, 40.0] {
        let wall = Arc::new(Wall::open(Arc::new(tube(&path(0.23), |_| TUBE, 48))));
        let mut simulation = Simulation::new(&plain(ei), [0.0; 2], &entry(DVec3::X * 3.0), 0.0, Some(wall)).unwrap();
        feed(&mut simulation, 15.0);
        told(&mut simulation, Input::default(), 300);
        let (before, mut work) = (simulation.body().rod.energy(), 0.0);
        while simulation.inserted() < 55.0 {
            let report = simulation.step(Input { feed: 5.0, roll: 0.0 });
            work += report.push_n * report.fed_mm;
            found.point(&format!("EI = {ei} N mm²"), simulation.inserted(), report.push_n / ei);
        }
        told(&mut simulation, Input::default(), 300);
        let held = simulation.body().rod.energy() - before;
        found.compare(&format!("work from 15 to 55 mm at EI = {ei} N mm² (N mm)"), held, work, Part(0.03), 55);
    }
    found.finish();
}

#[test]
fn the_push_at_which_a_wire_snakes_is_told() {
    let mut found = Benchmark::new("readout-snaking");
    let (length, load, ei) = (150.0, 0.001, 0.1);
    let unit = (ei * load / CLEARANCE).sqrt();
    // A straight tube needs no rings.
    let wall =
        Arc::new(Wall::open(Arc::new(tube(&curve(&[(length + 20.0, f64::INFINITY)], length + 20.0), |_| TUBE, 384))));
    let at = DVec3::new(3.0, -CLEARANCE * 0.99, 0.0);
    let mut simulation = Simulation::new(&plain(ei), [0.0; 2], &entry(at), 0.0, Some(wall)).unwrap();
    simulation.set_load(DVec3::NEG_Y * load).unwrap();
    feed(&mut simulation, length);
    let count = simulation.count();
    // A tip that is free to the side would give at half of it: 25 mm of it weigh eight times as much.
    let weights = |push: f64, part: f64| -> Vec<DVec3> {
        let along = |i: usize| if i == 0 { DVec3::NEG_X * push / 0.5 } else { DVec3::ZERO };
        let down = |i: usize| if i < 25 { DVec3::NEG_Y * 7.0 * part * load } else { DVec3::ZERO };
        (0..count).map(|i| along(i) + down(i) + DVec3::Z * 0.02 * load * uneven(i)).collect()
    };
    let mut onsets = Vec::new();
    for i in 0..RISE {
        let part = (i + 1) as f64 / RISE as f64;
        simulation.set_loads(weights(unit * 1.8 * part, part));
        simulation.step(Input::default());
    }
    for i in 0..3000 {
        simulation.set_loads(weights(unit * (1.8 + 0.6 * f64::from(i) / 3000.0), 1.0));
        let report = simulation.step(Input::default());
        let nodes: Vec<DVec3> = simulation.nodes().collect();
        let middle = &nodes[count / 3..2 * count / 3];
        let square = 2.0 * middle.iter().map(|p| p.z.atan2(-p.y).powi(2)).sum::<f64>() / middle.len() as f64;
        let push = simulation.push_and_torque()[0] / unit;
        if i % 60 == 59 {
            found.point("ours", push, square.sqrt());
        }
        if report.kind == StepKind::Balanced && (0.25..0.5).contains(&square.sqrt()) {
            onsets.push(push - GROWTH * square);
        }
    }
    assert!(onsets.len() > 20, "{} steps on the way up", onsets.len());
    let onset = onsets.iter().sum::<f64>() / onsets.len() as f64;
    found.compare("push at which it snakes over √(EI w/r)", 2.0, onset, Part(0.03), 150);
    for i in 0..=20 {
        let angle = 0.03 * f64::from(i);
        found.curve("analytic", 2.0 + GROWTH * angle * angle, angle);
    }
    found.finish();
}

#[test]
fn the_torque_of_a_bent_wire_in_a_bent_tube_is_told() {
    let mut found = Benchmark::new("readout-whip");
    // L √(EI own tube / GJ) below π/2: it does not snap.
    let (number, length, bend, ei) = (1.2f64, 40.0, 40.0, 20.0);
    let gj = ei / 1.3;
    // Half an element at the tip bends and twists with no cell of its own.
    let element = 0.5;
    let inside = number * (1.0 - element / 2.0 / length);
    let own = (number / length).powi(2) * gj / ei * bend;
    let radius = RADIUS + 0.03;
    let path = |step: f64| curve(&[(5.0, f64::INFINITY), (length + 15.0, bend)], step);
    let wall = Arc::new(Wall::open(Arc::new(tube(&path(0.37), |_| radius, 48))));
    let wire = Wire {
        bend_mm: length,
        straight_end_mm: 0.0,
        bend_degrees: (own * length).to_degrees(),
        elements_mm: [element; 2],
        ..plain(ei)
    };
    // Its side, to which it is bent, is the inside of the tube's bend, as the wire would have it.
    let side = DVec3::X.any_orthonormal_vector();
    let roll = side.cross(DVec3::Y).dot(DVec3::X).atan2(side.dot(DVec3::Y));
    let at = DVec3::new(5.0, 0.0, 0.0);
    let mut simulation = Simulation::new(&wire, [0.0; 2], &entry(at), roll, Some(wall)).unwrap();
    feed(&mut simulation, length);
    let [_, rest] = told(&mut simulation, Input::default(), 300);
    found.compare("torque before it is rolled (N mm)", 0.0, rest, Within(0.01), 80);
    let start = simulation.roll();
    for degrees in [45.0, 90.0, 135.0, -135.0, -90.0] {
        let to = f64::to_radians(degrees);
        while (to - (simulation.roll() - start)).abs() > 0.002 {
            let way = to - (simulation.roll() - start);
            simulation.step(Input { feed: 0.0, roll: (way / 0.002).clamp(-1.5, 1.5) as f32 });
        }
        told(&mut simulation, Input::default(), 300);
        let [_, ours] = told(&mut simulation, Input::default(), 100);
        // The tip's angle at which the base has this one.
        let (mut low, mut high) = (0.0, to.abs());
        for _ in 0..50 {
            let middle = f64::midpoint(low, high);
            if base_angle(inside, middle) < to.abs() { low = middle } else { high = middle }
        }
        let exact = to.signum() * gj * number / length * (2.0 * (low.cos() - to.cos())).sqrt();
        // Less by what room the tube leaves, and by the end that no moment bends to the tube.
        found.compare(&format!("torque at {degrees}° (N mm)"), exact, ours, Part(0.05), 80);
        found.point("ours", degrees, ours);
        found.mark("analytic", degrees, exact);
    }
    found.finish();
}

#[test]
fn what_bends_grows_with_the_feed_and_not_by_elements() {
    let mut found = Benchmark::new("readout-mouth");
    let (ei, load) = (5.0, 1e-4);
    let mut simulation = {
        let wire = Wire { elements_mm: [2.0; 2], ..plain(ei) };
        Simulation::new(&wire, [0.0; 2], &entry(DVec3::ZERO), 0.0, None).unwrap()
    };
    simulation.set_load(DVec3::Y * load).unwrap();
    feed(&mut simulation, 19.0);
    // Over two elements of 2 mm, from one to the next and the next.
    for tenths in 0..9 {
        let to = 20.0 + 0.5 * f64::from(tenths);
        while simulation.inserted() < to - 1e-6 {
            let left = (to - simulation.inserted()) / 0.002;
            simulation.step(Input { feed: left.min(10.0) as f32, roll: 0.0 });
        }
        told(&mut simulation, Input::default(), 1500);
        let long = simulation.inserted();
        // Euler and Bernoulli: w L⁴ / 8 EI.
        let exact = load * long.powi(4) / (8.0 * ei);
        found.compare(&format!("deflection of {to} mm (mm)"), exact, simulation.tip().y, Part(0.02), 10);
        found.point("ours", long, simulation.tip().y);
        found.curve("analytic", long, exact);
    }
    found.finish();
}
