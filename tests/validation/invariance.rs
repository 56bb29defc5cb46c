//! What must not matter, and what must come back: where a rod lies, that a run is run again, and a way in and out.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use lumen::trial::body::Stepped;
use lumen::trial::rod::Rod;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Within;
use crate::rods::{EI, HELD, LENGTH, cantilever, settle};
use crate::tubes::{curve, tube};

/// A wire at the mouth of a bent vessel, its guide a little out of the plane of the bend.
fn entered() -> Simulation {
    let path = curve(&[(20.0, f64::INFINITY), (40.0, 25.0), (20.0, f64::INFINITY)], 0.5);
    let wall = Arc::new(Wall::open(Arc::new(tube(&path, |_| 1.5, 48))));
    // Too stiff to buckle: what buckles does so to any side.
    let wire = Wire { bend_degrees: 0.0, tip_ei: 5.0, ..Wire::preset("workhorse").unwrap() };
    let way = DVec3::new(1.0, 0.0, 0.012).as_vec3();
    let entry = Entry { at: [4.0, 0.0, 0.0], direction: way.to_array() };
    Simulation::new(&wire, wire.friction, &entry, 0.0, Some(wall)).unwrap()
}

/// Feeds until this much is in, at this speed in mm/s, rolling at this one in rad/s; where the tip is after each step.
fn fed(simulation: &mut Simulation, to: f64, feed: f32, roll: f32) -> Vec<DVec3> {
    let way = f64::from(feed) * lumen::trial::STEP;
    let mut tips = Vec::new();
    // While something snaps the guide waits.
    while (to - simulation.inserted()) / way > 0.5 && tips.len() < 100_000 {
        assert_ne!(simulation.step(Input { feed, roll }), Stepped::Held);
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
    rod.held[40] = HELD;
    rod.held[41] = HELD;
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
