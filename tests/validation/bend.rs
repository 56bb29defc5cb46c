//! A wire in a bent tube with friction: pushed through it, and rolled in it.
//!
//! Pushed, it lies on the outside of the bend, where the wall's forces turn the push, so that it grows as a pull along
//! the inside does: `F / F0 = e^(mu angle)`. Where the bend begins and ends the wire lifts off over about
//! `2 sqrt(EI / F)`, and lands with single forces that come nearly to what the wall between them would have given: bending
//! adds little, as long as the inside is not reached and `F` is less than the `4 EI / r R` from which on it buckles.
//!
//! Rolled, all of it slides across itself, and climbs until its friction carries it: the wall's force is at `atan mu` to
//! the bend's plane, and the torque at the guide is `r_w mu / sqrt(1 + mu^2)` for each N of `F angle`.

use std::f64::consts::PI;

use glam::DVec3;
use lumen::trial::report::StepKind;
use lumen::trial::rod::{Hessian, Section};

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Part;
use crate::friction::{RADIUS, STEP, TUBE, threaded};
use lumen_test_support::tubes::{Place, curve, tube};

/// Radius of the bend in mm.
const BEND: f64 = 20.0;

/// Half a turn between two straight parts of a length in mm.
fn half_turn(straight: f64, step: f64) -> Vec<Place> {
    curve(&[(straight, f64::INFINITY), (PI * BEND, BEND), (straight, f64::INFINITY)], step)
}

/// What it takes at the one end to push a wire of this friction and stiffness through half a turn, over what it gives at
/// the other. Both ends are guided, before and behind straight parts of a length in mm; the tip goes the faster the more
/// it gives above 1 N.
fn push(mu: f64, ei: f64, straight: f64) -> f64 {
    let path = half_turn(straight, 1.0);
    // No part of an element, so that nodes do not ride over ridges in step.
    let wall = tube(&half_turn(straight, 0.23), |_| TUBE, 48);
    // Along the outside of the bend.
    let offset = |i: usize| path[i].1.cross(DVec3::Z) * (TUBE - RADIUS) * 0.99;
    let section = Section { ei, gj: ei / 1.3, ea: 2000.0, mass: 1e-9, drag: 1e-6, ..Section::default() };
    let mut body = threaded(&path, offset, section, [mu, mu], wall);
    let count = body.rod.len();
    (0..2).for_each(|i| body.rod.fixed[i].position = true);
    let [out, back] = [-path[0].1, -path[count - 1].1];
    let (mut gives, mut pushes, mut given) = (0.0, 0.0, 0.0);
    for i in 0..1000 {
        let tip = out * (0.002 + 0.01 * (gives - 1.0));
        let ends = [(0, tip), (1, tip), (count - 2, back * 0.002), (count - 1, back * 0.002)];
        let ends = ends.map(|(i, way)| (i, body.rod.positions[i] + way));
        let stepped = body.step(STEP, count - 2, |rod| ends.iter().for_each(|&(i, p)| rod.positions[i] = p));
        assert_ne!(stepped, StepKind::Held);
        let mut rod = body.rod.clone();
        rod.assemble(f64::INFINITY, 0.0, Hessian::Safe);
        gives = -(rod.reaction_force(0) + rod.reaction_force(1)).dot(out);
        if i >= 500 {
            given += gives;
            pushes += (rod.reaction_force(count - 2) + rod.reaction_force(count - 1)).dot(back);
        }
    }
    pushes / given
}

#[test]
fn a_push_through_a_bend_grows_like_a_pull() {
    let mut found = Benchmark::new("push");
    // Straight parts of 4 mm are shorter than the wire lifts off over, and take some of its forces from the wall.
    let short = [(0.0, 40.0), (0.05, 40.0), (0.1, 40.0), (0.2, 40.0), (0.3, 40.0), (0.1, 20.0), (0.1, 80.0)];
    let long =
        [(0.0, 20.0), (0.05, 20.0), (0.1, 20.0), (0.15, 20.0), (0.2, 20.0), (0.3, 20.0), (0.1, 15.0), (0.1, 30.0)];
    let cases = short.map(|(mu, ei)| (mu, ei, 8.0)).into_iter().chain(long.map(|(mu, ei)| (mu, ei, 12.0)));
    for (mu, ei, straight) in cases {
        let ours = push(mu, ei, straight);
        let what = format!("F/F₀ over 180° at μ = {mu} and EI = {ei} N mm² behind {straight} mm");
        found.compare(&what, (mu * PI).exp(), ours, Part(0.02), (PI * BEND + 2.0 * straight).ceil() as usize);
        found.point("ours", mu, ours);
    }
    for i in 0..=30 {
        let mu = f64::from(i) / 100.0;
        found.curve("e^μθ", mu, (mu * PI).exp());
    }
    found.finish();
}

/// The torque at the held end that rolls a wire which is pulled around half a turn with 1 N, in N mm; the tube is cut
/// into so many sides.
fn roll(mu: f64, sides: usize) -> f64 {
    let straight = 8.0;
    let path = half_turn(straight, 0.5);
    // Triangles about as long as they are wide.
    let wall = tube(&half_turn(straight, 11.0 / sides as f64), |_| TUBE, sides);
    let offset = |i: usize| DVec3::Z.cross(path[i].1) * (TUBE - RADIUS) * 0.98;
    // It winds up by a fifth of a turn before its tip turns.
    let section = Section { ei: 5.0, gj: 10.0, ea: 2000.0, mass: 1e-9, drag: 1e-6, ..Section::default() };
    let mut body = threaded(&path, offset, section, [mu, mu], wall);
    let count = body.rod.len();
    body.rod.forces.push((0, -path[0].1));
    let mut torques = Vec::new();
    for i in 0..1200 {
        let stepped = body.step(STEP, count - 2, |rod| rod.turn_to(count - 2, -0.002));
        assert_ne!(stepped, StepKind::Held);
        let mut rod = body.rod.clone();
        rod.assemble_from(count - 5);
        if i >= 800 {
            torques.push(-rod.reaction_moment(count - 2));
        }
    }
    torques.iter().sum::<f64>() / torques.len() as f64
}

#[test]
fn a_wire_is_rolled_against_what_presses_it() {
    let mut found = Benchmark::new("roll");
    let mu = 0.1;
    let exact = RADIUS * PI * mu / 1f64.hypot(mu);
    for (sides, part) in [(12, 0.08), (24, 0.02), (48, 0.02), (96, 0.02)] {
        let ours = roll(mu, sides);
        found.compare(&format!("torque in a tube of {sides} sides (N mm)"), exact, ours, Part(part), 157);
        found.point("ours", sides as f64, ours);
        found.curve("analytic", sides as f64, exact);
    }
    found.finish();
}
