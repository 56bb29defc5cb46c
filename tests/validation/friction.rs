//! Coulomb friction: the wire around a bend as a rope around a capstan, and sticking.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use lumen::mesh::TriMesh;
use lumen::trial::body::Body;
use lumen::trial::report::StepKind;
use lumen::trial::rod::{Fixed, Rod, Section};
use lumen::trial::wall::Wall;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::{Part, Within};
use lumen_test_support::tubes::{Place, curve, tube};

/// Radius of the wire in mm.
pub(crate) const RADIUS: f64 = 0.178;
/// Radius of the tubes in mm.
pub(crate) const TUBE: f64 = 1.5;
/// Distance of the tubes' rings in mm; no part of an element, so that nodes do not ride over ridges in step.
const RINGS: f64 = 0.23;
/// Seconds.
pub(crate) const STEP: f64 = 0.002;

/// A wire through all of `path`, moved to the side by `offset`, in its tube; its last two nodes are held.
pub(crate) fn threaded(
    path: &[Place],
    offset: impl Fn(usize) -> DVec3,
    section: Section,
    friction: [f64; 2],
    wall: TriMesh,
) -> Body {
    let wall = Arc::new(Wall::open(Arc::new(wall)));
    let positions: Vec<DVec3> = path.iter().enumerate().map(|(i, place)| place.0 + offset(i)).collect();
    let count = positions.len();
    let lengths: Vec<f64> = positions.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    let section = |i: usize| Section { length: lengths[i.min(count - 2)], cell: lengths[i.min(count - 2)], ..section };
    let mut rod = Rod::new(positions.clone(), (0..count).map(section).collect(), DVec3::Z);
    for node in [count - 2, count - 1] {
        rod.fixed[node] = Fixed { position: true, angle: true };
    }
    let mut body = Body::new(rod, RADIUS, friction, Some(wall));
    body.detect(count - 2);
    body
}

/// What it takes at the held end to pull a wire of this friction through half a turn, against a pull of 1 N at its tip;
/// `step` is the length of an element.
fn capstan(mu: f64, step: f64) -> f64 {
    let bend = 20.0;
    let parts = [(8.0, f64::INFINITY), (PI * bend, bend), (8.0, f64::INFINITY)];
    let path = curve(&parts, step);
    let wall = tube(&curve(&parts, RINGS), |_| TUBE, 48);
    // Along the inside of the bend, which is to the left.
    let offset = |i: usize| DVec3::Z.cross(path[i].1) * (TUBE - RADIUS) * 0.98;
    let section = Section { ei: 0.5, gj: 0.4, ea: 2000.0, mass: 1e-9, drag: 1e-6, ..Section::default() };
    let mut body = threaded(&path, offset, section, [mu, mu], wall);
    let count = body.rod.len();
    body.rod.forces.push((0, -path[0].1));
    let way = path[count - 1].1 * 0.002;
    let mut pulls = Vec::new();
    for i in 0..1000 {
        let ends = [count - 2, count - 1].map(|i| (i, body.rod.positions[i] + way));
        let stepped = body.step(STEP, count - 2, |rod| ends.iter().for_each(|&(i, p)| rod.positions[i] = p));
        assert_ne!(stepped, StepKind::Held);
        let mut rod = body.rod.clone();
        rod.assemble_from(count - 5);
        let pull = (count - 2..count).map(|i| rod.reaction_force(i)).sum::<DVec3>().dot(path[count - 1].1);
        if i >= 500 {
            pulls.push(pull);
        }
    }
    pulls.iter().sum::<f64>() / pulls.len() as f64
}

#[test]
fn a_bend_holds_like_a_capstan() {
    let mut found = Benchmark::new("capstan");
    let free = capstan(0.0, 1.0);
    for mu in [0.05, 0.1, 0.2, 0.3] {
        let pull = capstan(mu, 1.0) - free + 1.0;
        found.compare(&format!("F/F₀ over 180° at μ = {mu}"), (mu * PI).exp(), pull, Part(0.02), 80);
        found.point("ours", mu, pull);
    }
    for i in 0..=30 {
        let mu = f64::from(i) / 100.0;
        found.curve("e^μθ", mu, (mu * PI).exp());
    }
    found.finish();
}

/// A flat floor in the xz plane, below what lies on it.
fn floor() -> TriMesh {
    let at = |x: f32, z: f32| lumen::mesh::Vec3::new(x, 0.0, z);
    let positions = vec![at(-50.0, -50.0), at(50.0, -50.0), at(50.0, 50.0), at(-50.0, 50.0)];
    TriMesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3]] }
}

const NODES: usize = 11;
/// Sticking and sliding.
const MU: [f64; 2] = [0.06, 0.04];
/// What presses all of it on the floor, in N.
const WEIGHT: f64 = 0.5;

/// A piece of wire along x, pressed on a floor.
fn block() -> Body {
    let section =
        Section { length: 2.0, cell: 2.0, ei: 40.0, gj: 30.0, ea: 2000.0, mass: 1e-9, drag: 1e-7, rest: [0.0; 2] };
    // The last node of a rod has no contact: here it sticks out.
    let positions = (0..NODES + 1).map(|i| DVec3::new(2.0 * i as f64 - 10.0, RADIUS, 0.0)).collect();
    let mut rod = Rod::new(positions, vec![section; NODES + 1], DVec3::Y);
    rod.fixed[0].angle = true;
    rod.forces.extend((0..NODES).map(|i| (i, DVec3::NEG_Y * (WEIGHT / NODES as f64))));
    let mut body = Body::new(rod, RADIUS, MU, Some(Arc::new(Wall::open(Arc::new(floor())))));
    body.detect(NODES);
    for _ in 0..50 {
        assert_ne!(body.step(STEP, NODES, |_| ()), StepKind::Held);
    }
    body
}

/// Pushes it along x with this force for this many steps, everywhere alike, so that all of it slides at once; how far
/// that has moved it, in mm.
fn pushed(body: &mut Body, force: f64, steps: usize) -> f64 {
    let before = body.rod.positions[NODES / 2].x;
    body.rod.forces.truncate(NODES);
    body.rod.forces.extend((0..NODES).map(|i| (i, DVec3::X * (force / NODES as f64))));
    for _ in 0..steps {
        assert_ne!(body.step(STEP, NODES, |_| ()), StepKind::Held);
    }
    body.rod.positions[NODES / 2].x - before
}

#[test]
fn what_sticks_stays_and_what_slides_is_held_back() {
    let mut found = Benchmark::new("stick-slip");
    let most = MU[0] * WEIGHT;
    // By half a per cent more at a time, which is 3e-7 mm where it sticks.
    let mut body = block();
    let mut part = 0.0;
    while pushed(&mut body, part * most, 20) < 1e-5 && part < 2.0 {
        part += 0.005;
    }
    found.compare("push at which it slides over μ_s N", 1.0, part, Part(0.01), NODES);

    let mut body = block();
    let _ = pushed(&mut body, 0.9 * most, 500);
    let drift = pushed(&mut body, 0.9 * most, 30_000);
    found.compare("drift in 60 s at 0.9 μ_s N (mm)", 0.0, drift, Within(1e-6), NODES);

    // To and fro by hand, half a millimetre each way.
    let mut body = block();
    body.rod.fixed[0].position = true;
    let start = body.rod.positions[0];
    let (mut way, mut at) = (0.002, 0.0f64);
    let (mut there, mut back, mut loops) = (Vec::new(), Vec::new(), 0);
    while loops < 4 {
        at += way;
        if at.abs() > 0.5 {
            way = -way;
            loops += 1;
        }
        assert_ne!(body.step(STEP, NODES, |rod| rod.positions[0] = start + DVec3::X * at), StepKind::Held);
        let mut rod = body.rod.clone();
        rod.assemble_from(0);
        let force = rod.reaction_force(0).x;
        if loops > 1 {
            found.point("ours", at, force * NODES as f64 / (NODES - 1) as f64 / WEIGHT);
            if at.abs() < 0.1 {
                if way > 0.0 { there.push(force) } else { back.push(force) }
            }
        }
    }
    let mean = |forces: &[f64]| forces.iter().sum::<f64>() / forces.len() as f64;
    // The held node's own friction is not in what holds it.
    let felt = WEIGHT * (NODES - 1) as f64 / NODES as f64;
    found.compare("push while it slides over N", MU[1], mean(&there) / felt, Part(0.01), NODES);
    found.compare("push while it slides back over N", -MU[1], mean(&back) / felt, Part(0.01), NODES);
    for (x, y) in [(-0.5, MU[1]), (0.5, MU[1]), (0.5, -MU[1]), (-0.5, -MU[1]), (-0.5, MU[1])] {
        found.curve("Coulomb sliding", x, y);
    }
    found.finish();
}
