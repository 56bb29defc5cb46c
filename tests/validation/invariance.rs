//! What must not matter, and what must come back: where a rod lies, that a run is run again, and a way in and out.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use lumen::mesh::TriMesh;
use lumen::trial::report::StepKind;
use lumen::trial::rod::Rod;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Within;
use crate::rods::{CLAMPED, EI, LENGTH, cantilever, settle};
use lumen_test_support::tubes::{curve, tube};

/// A bent vessel.
fn vessel() -> TriMesh {
    let path = curve(&[(20.0, f64::INFINITY), (40.0, 25.0), (20.0, f64::INFINITY)], 0.5);
    tube(&path, |_| 1.5, 48)
}

/// A wire at the mouth of that vessel, its guide a little out of the plane of the bend; all of it turned.
fn entered_in(vessel: TriMesh, turn: DQuat) -> Simulation {
    let wall = Arc::new(Wall::open(Arc::new(vessel)));
    // Too stiff to buckle: what buckles does so to any side.
    let wire = Wire { bend_degrees: 0.0, tip_ei: 5.0, ..Wire::preset("workhorse").unwrap() };
    let turned = |v: DVec3| (turn * v).as_vec3().to_array();
    let entry = Entry { at: turned(DVec3::X * 4.0), direction: turned(DVec3::new(1.0, 0.0, 0.012)) };
    Simulation::new(&wire, wire.friction, &entry, 0.0, Some(wall)).unwrap()
}

/// The same as it is.
fn entered() -> Simulation {
    entered_in(vessel(), DQuat::IDENTITY)
}

/// The same surface with its vertices and triangles in another order, each triangle from another corner on.
fn shuffled(mesh: &TriMesh) -> TriMesh {
    let shuffle = |count: usize, by: usize| -> Vec<usize> {
        // A prime that does not divide the count goes through all of them.
        assert!(!count.is_multiple_of(by));
        (0..count).map(|i| i * by % count).collect()
    };
    let order = shuffle(mesh.positions.len(), 7919);
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(to, &from)| place[from] = to as u32);
    let triangle = |(i, t): (usize, usize)| {
        let [a, b, c] = mesh.triangles[t].map(|v| place[v as usize]);
        [[a, b, c], [b, c, a], [c, a, b]][i % 3]
    };
    TriMesh {
        positions: order.iter().map(|&v| mesh.positions[v]).collect(),
        triangles: shuffle(mesh.triangles.len(), 7907).into_iter().enumerate().map(triangle).collect(),
    }
}

/// Feeds until this much is in, at this speed in mm/s, rolling at this one in rad/s; where the tip is after each step.
fn fed(simulation: &mut Simulation, to: f64, feed: f32, roll: f32) -> Vec<DVec3> {
    let way = f64::from(feed) * lumen::trial::STEP;
    let mut tips = Vec::new();
    // While something snaps the guide waits.
    while (to - simulation.inserted()) / way > 0.5 && tips.len() < 100_000 {
        assert_ne!(simulation.step(Input { feed, roll }).kind, StepKind::Held);
        tips.push(simulation.tip());
    }
    tips
}

#[test]
fn what_goes_in_comes_out_as_it_was() {
    let mut found = Benchmark::new("return");
    let start = entered();
    let mut round = start.clone();
    let there = fed(&mut round, 60.0, 20.0, 0.0);
    let back = fed(&mut round, start.inserted(), -20.0, 0.0);
    let apart = round.tip().distance(start.tip());
    found.compare("distance of the tip from where it began (mm)", 0.0, apart, Within(1e-6), 0);
    for (name, tips) in [("in", &there), ("out", &back)] {
        for tip in tips.iter().step_by(60) {
            found.point(name, tip.x, tip.y);
        }
    }
    found.finish();
}

#[test]
fn neither_the_order_of_triangles_nor_the_way_it_all_lies_matters() {
    let mut found = Benchmark::new("vessel");
    let run = |mut simulation: Simulation| fed(&mut simulation, 60.0, 20.0, 1.0);
    let plain = run(entered());
    let turn = DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 1.1);
    let mut turned = vessel();
    turned.positions.iter_mut().for_each(|p| *p = (turn * p.as_dvec3()).as_vec3());
    for (name, other, back) in [
        ("shuffled", run(entered_in(shuffled(&vessel()), DQuat::IDENTITY)), DQuat::IDENTITY),
        ("turned", run(entered_in(turned, turn)), turn.inverse()),
    ] {
        assert_eq!(plain.len(), other.len());
        let apart = plain.iter().zip(&other).map(|(p, &q)| p.distance(back * q));
        let what = format!("largest distance of the tip on the way into a vessel that is {name} (mm)");
        found.compare(&what, 0.0, apart.fold(0.0, f64::max), Within(0.01), 0);
    }
    found.finish();
}

/// Feeds and rolls as above; tip, wall force and push of each step, in mm and N.
fn felt(mut simulation: Simulation) -> Vec<(DVec3, [f64; 2])> {
    let mut all = Vec::new();
    while simulation.inserted() < 60.0 && all.len() < 10_000 {
        let report = simulation.step(Input { feed: 20.0, roll: 1.0 });
        all.push((simulation.tip(), [simulation.body().pressure().0, report.push_n]));
    }
    all
}

#[test]
fn forces_do_not_depend_on_the_order_of_triangles() {
    let mut found = Benchmark::new("orders");
    let plain = felt(entered());
    let mean = |k: usize| plain.iter().map(|step| step.1[k].abs()).sum::<f64>() / plain.len() as f64;
    let (mut tip, mut off) = (0.0_f64, [0.0_f64; 2]);
    for seed in 1..=5 {
        let other = felt(entered_in(lumen::mesh::shuffled(&vessel(), seed), DQuat::IDENTITY));
        assert_eq!(plain.len(), other.len());
        let apart = plain.iter().zip(&other).map(|(a, b)| a.0.distance(b.0));
        tip = tip.max(apart.fold(0.0, f64::max));
        for (k, off) in off.iter_mut().enumerate() {
            let squares = plain.iter().zip(&other).map(|(a, b)| (a.1[k] - b.1[k]).powi(2)).sum::<f64>();
            *off = off.max((squares / plain.len() as f64).sqrt() / mean(k));
        }
    }
    found.compare("largest distance of the tip in five other orders (mm)", 0.0, tip, Within(0.01), 0);
    for (what, off) in ["wall force", "push"].iter().zip(off) {
        let what = format!("root mean square of the difference over the mean in the worst of five orders: {what}");
        found.compare(&what, 0.0, off, Within(0.002), 0);
    }
    found.finish();
}

#[test]
fn a_run_is_the_same_to_the_bit_when_it_is_run_again() {
    let run = || {
        let mut simulation = entered();
        fed(&mut simulation, 40.0, 25.0, 2.0)
    };
    let bits = |tips: Vec<DVec3>| -> Vec<[u64; 3]> { tips.iter().map(|p| p.to_array().map(f64::to_bits)).collect() };
    assert_eq!(bits(run()), bits(run()));
}

/// A cantilever that is bent at rest and loaded at its tip, all of it turned.
fn loaded(turn: DQuat) -> Rod {
    let plain = cantilever(40);
    let positions = plain.positions.iter().map(|&p| turn * p).collect();
    let mut rod = Rod::new(positions, plain.sections.clone(), turn * DVec3::Y);
    rod.fixed[40] = CLAMPED;
    rod.fixed[41] = CLAMPED;
    rod.sections.iter_mut().for_each(|section| section.rest = [0.02, 0.01]);
    rod.forces.push((0, turn * DVec3::new(0.2, 0.5, -1.0) * (EI / LENGTH / LENGTH)));
    settle(&mut rod);
    rod
}

#[test]
fn it_does_not_matter_which_way_a_rod_lies() {
    let mut found = Benchmark::new("turned");
    let plain = loaded(DQuat::IDENTITY);
    for (i, axis) in [DVec3::X, DVec3::Z, DVec3::new(0.3, -0.5, 0.8)].into_iter().enumerate() {
        let turn = DQuat::from_axis_angle(axis.normalize(), 1.1 + i as f64);
        let other = loaded(turn);
        let apart = plain.positions.iter().zip(&other.positions).map(|(&p, &q)| (turn * p).distance(q));
        let what = format!("largest distance of a node about axis {} (mm)", i + 1);
        found.compare(&what, 0.0, apart.fold(0.0, f64::max), Within(1e-6), 40);
    }
    found.finish();
}
