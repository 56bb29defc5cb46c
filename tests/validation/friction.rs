//! Coulomb friction: the wire around a bend as a rope around a capstan, torque along a wall, and sticking.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use lumen::mesh::TriMesh;
use lumen::trial::body::{Body, Stepped};
use lumen::trial::rod::{Held, Rod, Section};
use lumen::trial::wall::Wall;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Part;
use crate::tubes::{Place, curve, tube};

/// Radius of the wire in mm.
const RADIUS: f64 = 0.178;
/// Radius of the tubes in mm.
const TUBE: f64 = 1.5;
/// Distance of the tubes' rings in mm; no part of an element, so that nodes do not ride over ridges in step.
const RINGS: f64 = 0.23;
/// Seconds.
const STEP: f64 = 0.002;

/// A wire through all of `path`, moved to the side by `offset`, in its tube; its last two nodes are held.
fn threaded(path: &[Place], offset: impl Fn(usize) -> DVec3, section: Section, friction: [f64; 2], wall: TriMesh) -> Body {
    let wall = Arc::new(Wall::new(Arc::new(wall)));
    let positions: Vec<DVec3> = path.iter().enumerate().map(|(i, place)| place.0 + offset(i)).collect();
    let count = positions.len();
    let lengths: Vec<f64> = positions.windows(2).map(|pair| pair[0].distance(pair[1])).collect();
    let section = |i: usize| Section { length: lengths[i.min(count - 2)], cell: lengths[i.min(count - 2)], ..section };
    let mut rod = Rod::new(positions.clone(), (0..count).map(section).collect(), DVec3::Z);
    for node in [count - 2, count - 1] {
        rod.held[node] = Held { position: true, angle: true };
    }
    let mut body = Body::new(rod, RADIUS, friction, Some(wall));
    body.look(count - 2);
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
        assert_ne!(stepped, Stepped::Held);
        let mut rod = body.rod.clone();
        rod.assemble_from(count - 5);
        let pull = (count - 2..count).map(|i| rod.holding_force(i)).sum::<DVec3>().dot(path[count - 1].1);
        if i % 50 == 0 {print!("{pull:.4} ");}
        if i >= 500 {
            pulls.push(pull);
        }
    }
    println!();
    pulls.iter().sum::<f64>() / pulls.len() as f64
}

#[test]
fn a_bend_holds_like_a_capstan() {
    let mut found = Benchmark::new("capstan");
    let start = std::time::Instant::now();
    let free = capstan(0.0, 1.0);
    println!("free {free} {:?}", start.elapsed());
    for mu in [0.05, 0.1, 0.2, 0.3] {
        let pull = capstan(mu, 1.0) - free + 1.0;
        found.compare(&format!("F/F₀ over 180° at μ = {mu}"), (mu * PI).exp(), pull, Part(0.02), 80);
        found.point("ours", mu, pull);
    }
    for i in 0..=30 {
        let mu = f64::from(i) / 100.0;
        found.curve("e^μθ", mu, (mu * PI).exp());
    }
    println!("{:?}", start.elapsed());
    found.finish();
}
