//! Friction does not know the triangles: one surface cut finer and finer, and bends of more and more sides.
//!
//! A wire that lies on the floor of a straight tube under a load of `w` on each mm is pushed the harder the farther it is
//! in, by `mu w` on each mm. However the floor is cut, it is the same floor.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::DVec3;
use lumen::mesh::TriMesh;
use lumen::trial::STEP;
use lumen::trial::report::StepKind;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::{Part, Within};
use lumen_test_support::tubes::{curve, tube};

/// Radius of the tubes in mm.
const TUBE: f64 = 2.0;
/// What presses the wire on the floor, in N on each mm.
const LOAD: f64 = 5e-3;
const MU: f64 = 0.06;

/// A wire in a guide at `at` along x.
fn start(wire: &Wire, wall: TriMesh, at: DVec3) -> Simulation {
    let entry = Entry { at: at.as_vec3().to_array(), direction: [1.0, 0.0, 0.0] };
    Simulation::new(wire, [MU; 2], &entry, 0.0, Some(Arc::new(Wall::open(Arc::new(wall))))).unwrap()
}

/// The same, of a wire without a bend that is everywhere as stiff, in N mm2.
fn wire_in(wall: TriMesh, ei: f64, at: DVec3) -> Simulation {
    let wire = Wire { bend_degrees: 0.0, tip_ei: ei, shaft_ei: ei, ..Wire::preset("workhorse").unwrap() };
    start(&wire, wall, at)
}

/// A straight tube of 48 flat sides along x, cut across every so many mm.
fn prism(cut: f64) -> TriMesh {
    const SIDES: usize = 48;
    let rings = (75.0 / cut) as usize;
    let at = |ring: usize, side: usize| (ring * SIDES + side % SIDES) as u32;
    let mut mesh = TriMesh::default();
    for ring in 0..=rings {
        for side in 0..SIDES {
            let (sin, cos) = (side as f64 / SIDES as f64 * TAU).sin_cos();
            mesh.positions.push(DVec3::new(ring as f64 * cut, cos * TUBE, sin * TUBE).as_vec3());
            if ring < rings {
                let (a, b, c, d) = (at(ring, side), at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1));
                mesh.triangles.extend([[a, b, c], [b, d, c]]);
            }
        }
    }
    mesh
}

/// By what the push grows on each mm that is fed along the floor, over `mu w`.
fn growth(cut: f64, speed: f32) -> f64 {
    let at = DVec3::new(3.0, -1.8, 0.0);
    let mut simulation = wire_in(prism(cut), 40.0, at);
    // Not straight down on a corner of the tube, nor on the middle of a side.
    let down = 0.3 / 48.0 * TAU;
    simulation.set_load(DVec3::new(0.0, -down.cos(), down.sin()) * LOAD).unwrap();
    let mut means = [[0.0; 3]; 2];
    while simulation.inserted() < 60.0 {
        let report = simulation.step(Input { feed: speed, roll: 0.0 });
        let at = simulation.inserted();
        let part = usize::from(at >= 50.0);
        if report.kind == StepKind::Balanced && ((30.0..40.0).contains(&at) || part == 1) {
            means[part] = std::array::from_fn(|i| means[part][i] + [report.push_n, at, 1.0][i]);
        }
    }
    let [[from, short], [to, long]] = means.map(|[push, at, times]| [push / times, at / times]);
    (to - from) / (long - short) / (MU * LOAD)
}

#[test]
fn friction_does_not_know_how_a_floor_is_cut() {
    let mut found = Benchmark::new("facets");
    for speed in [2.0, 20.0, 50.0] {
        // No part of an element, so that nodes do not come to new triangles in step.
        for cut in [2.03, 0.53, 0.103, 0.0517] {
            let ours = growth(cut, speed);
            found.compare(
                &format!("push of each mm over μ w cut at {cut} mm and fed at {speed} mm/s"),
                1.0,
                ours,
                Part(0.02),
                0,
            );
            found.point(&format!("{speed} mm/s"), cut, ours);
            found.curve("analytic", cut, 1.0);
        }
    }
    found.finish();
}

/// What of the hand's work behind a bend of a quarter turn goes neither into the wire nor into drag, over `mu` times what
/// presses on the wall for each mm that slides by; and the part of the steps that waited.
fn rubbed_off(sides: usize, ei: f64, speed: f32) -> (f64, f64) {
    let path = |step: f64| curve(&[(10.0, f64::INFINITY), (15.0 * PI, 30.0), (40.0, f64::INFINITY)], step);
    // Triangles about as long as they are wide.
    let mut simulation = wire_in(tube(&path(24.0 / sides as f64), |_| TUBE, sides), ei, DVec3::X * 3.0);
    let (mut before, mut work, mut pressed, mut waited) = (f64::NAN, 0.0, 0.0, 0.0);
    while simulation.inserted() < 90.0 && simulation.steps() < 8000 {
        let report = simulation.step(Input { feed: speed, roll: 0.0 });
        waited += f64::from(u8::from(report.kind == StepKind::Waited));
        let body = simulation.body();
        if simulation.inserted() < 60.0 {
            before = body.rod.energy();
            continue;
        }
        let drag = |i: usize| body.rod.sections[i].drag * body.rod.velocities[i].length_squared();
        work += report.push_n * report.fed_mm - (0..simulation.count()).map(drag).sum::<f64>() * STEP;
        pressed += body.pressure().0 * report.fed_mm;
    }
    let held = simulation.body().rod.energy() - before;
    ((work - held) / (MU * pressed), waited / simulation.steps() as f64)
}

#[test]
fn friction_does_not_know_the_sides_of_a_bend() {
    let mut found = Benchmark::new("sides");
    for (ei, speed) in [(40.0, 20.0), (300.0, 20.0), (300.0, 50.0)] {
        for sides in [12, 24, 48, 96, 192] {
            let (ours, waited) = rubbed_off(sides, ei, speed);
            let what = format!("{sides} sides and EI = {ei} N mm² at {speed} mm/s");
            found.compare(&format!("part of the steps that wait: {what}"), 0.0, waited, Within(0.01), 0);
            if speed < 50.0 {
                found.compare(&format!("work of friction over μ N: {what}"), 1.0, ours, Part(0.06), 0);
                found.point(&format!("EI = {ei} N mm²"), sides as f64, ours);
            }
            found.curve("analytic", sides as f64, 1.0);
        }
    }
    found.finish();
}

#[test]
fn a_stiff_shaft_goes_through_a_bend() {
    let mut found = Benchmark::new("stiff");
    let path = |step: f64| curve(&[(15.0, f64::INFINITY), (17.5 * PI, 35.0), (60.0, f64::INFINITY)], step);
    let mut first = None;
    for ei in [521.0, 895.0, 2005.0, 5000.0] {
        let wire = Wire { bend_degrees: 0.0, tip_ei: ei, shaft_ei: ei, ..Wire::preset("035-angled").unwrap() };
        let mut simulation = start(&wire, tube(&path(0.53), |_| 4.0, 48), DVec3::X * 3.0);
        let (mut push, mut times, mut waited) = (0.0, 0.0, 0.0);
        while simulation.inserted() < 100.0 && simulation.steps() < 8000 {
            let report = simulation.step(Input { feed: 20.0, roll: 0.0 });
            waited += f64::from(u8::from(report.kind == StepKind::Waited));
            if simulation.inserted() > 60.0 && report.kind == StepKind::Balanced {
                push += report.push_n;
                times += 1.0;
            }
        }
        found.compare(
            &format!("how far it comes at EI = {ei} N mm² (mm)"),
            100.0,
            simulation.inserted(),
            Part(0.001),
            0,
        );
        let waited = waited / simulation.steps() as f64;
        found.compare(&format!("part of the steps that wait at EI = {ei} N mm²"), 0.0, waited, Within(0.01), 0);
        // All forces are as the stiffness.
        let over = push / times / ei;
        let exact = *first.get_or_insert(over);
        if ei > 521.0 {
            found.compare(&format!("push over EI at EI = {ei} N mm² (1/mm²)"), exact, over, Part(0.02), 0);
        }
        found.point("ours", ei, over);
        found.curve("as the softest", ei, exact);
    }
    found.finish();
}
