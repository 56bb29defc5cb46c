//! What moves freely, and what the length of a step does to a trial.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;
use lumen::trial::body::Body;
use lumen::trial::report::StepKind;
use lumen::trial::rod::{Hessian, Rod, Section};
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::{Part, Within};
use lumen_test_support::tubes::{curve, tube};

const NODES: usize = 41;
/// mm, N mm2, t/mm: about steel of 0.36 mm.
const LENGTH: f64 = 50.0;
const EI: f64 = 40.0;
const MASS: f64 = 8e-10;

/// A bar that nothing holds, with this drag in N s/mm2.
fn bar(drag: f64) -> Body {
    let h = LENGTH / (NODES - 1) as f64;
    let section = |i: usize| {
        let cell = if i == 0 || i == NODES - 1 { h / 2.0 } else { h };
        Section {
            length: h,
            cell,
            ei: EI,
            gj: EI / 1.3,
            ea: 2000.0,
            mass: MASS * cell,
            drag: drag * cell,
            rest: [0.0; 2],
        }
    };
    let positions = (0..NODES).map(|i| DVec3::X * (h * i as f64)).collect();
    Body::new(Rod::new(positions, (0..NODES).map(section).collect(), DVec3::Y), 0.178, [0.0; 2], None)
}

fn momentum(body: &Body) -> DVec3 {
    body.rod.velocities.iter().zip(&body.rod.sections).map(|(&v, section)| v * section.mass).sum()
}

#[test]
fn a_free_bar_moves_as_newton_has_it() {
    let mut found = Benchmark::new("free-bar");
    // A force of 1 mN for 0.1 s, off its middle and across.
    let mut body = bar(0.0);
    let force = DVec3::new(2e-4, 1e-3, -5e-4);
    body.rod.forces.push((9, force));
    for _ in 0..50 {
        assert_eq!(body.step(0.002, 0, |_| ()), StepKind::Balanced);
    }
    let exact = force * 0.1;
    let off = momentum(&body).distance(exact) / exact.length();
    found.compare("momentum after 0.1 s: part that is missing", 0.0, off, Within(1e-6), NODES - 1);
    body.rod.forces.clear();
    let before = momentum(&body);
    for _ in 0..500 {
        body.step(0.002, 0, |_| ());
    }
    let off = momentum(&body).distance(before) / before.length();
    found.compare(
        "momentum after another second without a force: part that is missing",
        0.0,
        off,
        Within(1e-6),
        NODES - 1,
    );

    // Blood slows it by e^(-drag t / mass).
    let drag = 3e-8;
    let mut body = bar(drag);
    body.rod.velocities.fill(DVec3::Y * 100.0);
    for _ in 0..200 {
        body.step(0.0001, 0, |_| ());
    }
    let slowed = momentum(&body).y / (MASS * LENGTH * 100.0);
    found.compare(
        "part of its speed that drag leaves after 0.02 s",
        (-drag / MASS * 0.02).exp(),
        slowed,
        Part(0.005),
        NODES - 1,
    );

    // The first way in which it swings: its angle is 4.7300² √(EI / m L⁴).
    let exact = TAU / (4.730_040_74_f64.powi(2) * (EI / MASS / LENGTH.powi(4)).sqrt());
    let mut body = bar(0.0);
    let shape = |x: f64| {
        let (b, s) = (4.730_040_74_f64, 0.982_502_215_f64);
        let z = b * x;
        z.cosh() + z.cos() - s * (z.sinh() + z.sin())
    };
    for i in 0..NODES {
        body.rod.velocities[i] = DVec3::Y * 50.0 * shape(i as f64 / (NODES - 1) as f64);
    }
    let dt = exact / 2000.0;
    let (mut crossings, mut last) = (Vec::new(), 0.0_f64);
    for step in 0..5000_u32 {
        body.step(dt, 0, |_| ());
        let ends = f64::midpoint(body.rod.positions[0].y, body.rod.positions[NODES - 1].y);
        let bow = ends - body.rod.positions[NODES / 2].y;
        if last < 0.0 && bow >= 0.0 || last > 0.0 && bow <= 0.0 {
            crossings.push((f64::from(step) + last / (last - bow)) * dt);
        }
        last = bow;
        if step % 40 == 0 {
            found.point("ours", f64::from(step) * dt / exact, bow);
        }
    }
    let halves = crossings.len() - 1;
    let period = 2.0 * (crossings[halves] - crossings[0]) / halves as f64;
    found.compare("period of its first swing (ms)", 1e3 * exact, 1e3 * period, Part(0.01), NODES - 1);
    found.finish();
}

#[test]
fn a_step_leaves_next_to_nothing_over() {
    let mut found = Benchmark::new("settled");
    let mut most = 0.0_f64;
    // Of many sizes and directions: where the last correction ends short of a bound is chance.
    let ways = [[0.1, 1.0, 0.3], [-0.2, 0.4, -1.0], [0.5, -1.0, 0.2], [0.0, 0.0, 1.0], [-0.1, -0.7, 0.7]];
    for (case, way) in (0..37).flat_map(|case| ways.map(|way| (case, way))) {
        // Without inertia, what does not hold the force at its end is left over.
        let mut body = bar(1e-18);
        for (i, section) in body.rod.sections.iter_mut().enumerate() {
            section.mass = 1e-20;
            body.rod.fixed[i].position = i + 2 >= NODES;
            body.rod.fixed[i].angle = i + 2 >= NODES;
        }
        let size = EI / LENGTH / LENGTH * 2e-3 * f64::from(1 + case);
        body.rod.forces.push((0, DVec3::from(way) * size));
        if body.step(0.002, 0, |_| ()) != StepKind::Balanced {
            continue;
        }
        let mut rod = body.rod.clone();
        rod.assemble(f64::INFINITY, 0.0, Hessian::Safe);
        let left = (0..NODES - 2).map(|i| rod.reaction_force(i).length()).fold(0.0, f64::max);
        most = most.max(left);
    }
    found.compare("largest force that a step leaves over at a node (N)", 0.0, most, Within(1e-6), NODES - 1);
    found.finish();
}

/// Means over the way of a wire into a bent vessel, in steps of this length: of the wall's forces and the push in N, and
/// the torque in N mm; and where its tip is at the end.
fn way(dt: f64, wall: &Arc<Wall>) -> ([f64; 3], DVec3) {
    // Too stiff to buckle: what buckles does so to any side.
    let wire = Wire { tip_ei: 5.0, ..Wire::preset("workhorse").unwrap() };
    let entry = Entry { at: [4.0, 0.0, 0.0], direction: DVec3::new(1.0, 0.0, 0.012).as_vec3().to_array() };
    let mut simulation = Simulation::new(&wire, wire.friction, &entry, 0.0, Some(wall.clone())).unwrap();
    let (mut sums, mut times) = ([0.0; 3], 0.0);
    while simulation.inserted() < 50.0 {
        assert!(simulation.steps() < 30_000, "the wire does not go in");
        let roll = if simulation.inserted() > 25.0 { 1.0 } else { 0.0 };
        let report = simulation.step_by(dt, Input { feed: 10.0, roll });
        if simulation.inserted() > 15.0 && report.kind == StepKind::Balanced {
            let wall = simulation.body().pressure().0;
            for (sum, found) in sums.iter_mut().zip([wall, report.push_n, report.torque_n_mm]) {
                *sum += found;
            }
            times += 1.0;
        }
    }
    (sums.map(|sum| sum / times), simulation.tip())
}

#[test]
fn the_length_of_a_step_hardly_matters() {
    let mut found = Benchmark::new("step-size");
    let path = curve(&[(20.0, f64::INFINITY), (40.0, 25.0), (20.0, f64::INFINITY)], 0.5);
    let wall = Arc::new(Wall::open(Arc::new(tube(&path, |_| 1.5, 48))));
    let ([wall_n, push, torque], tip) = way(0.0005, &wall);
    for ms in [4.0, 2.0, 1.0] {
        let (ours, at) = way(ms / 1e3, &wall);
        found.compare(&format!("wall force in steps of {ms} ms (N)"), wall_n, ours[0], Part(0.01), 0);
        // What comes to the wall anew is held by no friction in its first step.
        found.compare(&format!("push in steps of {ms} ms (N)"), push, ours[1], Part(0.02 * ms.max(2.0)), 0);
        found.compare(&format!("torque in steps of {ms} ms (N mm)"), torque, ours[2], Part(0.02), 0);
        found.compare(&format!("tip in steps of {ms} ms (mm)"), 0.0, at.distance(tip), Within(0.1), 0);
    }
    found.finish();
}
