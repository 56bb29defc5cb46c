//! What must not matter: where the vessel lies, the order of its triangles, the size of elements and steps; and what
//! must come back.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use lumen::mesh::{TriMesh, Vec3};
use lumen::trial::body::Stepped;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Within;
use crate::tubes::{curve, tube};

/// A wire with a straight end, so that its roll does not matter, and too stiff to buckle: what buckles does so by chance.
fn straight() -> Wire {
    Wire { bend_degrees: 0.0, tip_ei: 5.0, ..Wire::preset("workhorse").unwrap() }
}

fn vessel() -> TriMesh {
    let path = curve(&[(20.0, f64::INFINITY), (40.0, 25.0), (20.0, f64::INFINITY)], 0.5);
    tube(&path, |_| 1.5, 48)
}

/// A wire at the mouth of a vessel that was moved by `place`.
fn entered(wire: &Wire, mesh: TriMesh, place: impl Fn(DVec3) -> DVec3) -> Simulation {
    let mouth = place(DVec3::X * 4.0);
    // Not in the plane of the bend, where only chance says to which side the wire goes.
    let way = place(DVec3::new(5.0, 0.0, 0.06)) - mouth;
    let entry = Entry { at: mouth.as_vec3().to_array(), direction: way.as_vec3().to_array() };
    Simulation::new(wire, wire.friction, &entry, Some(Arc::new(Wall::new(Arc::new(mesh))))).unwrap()
}

/// Feeds until this much is in, at this speed.
fn fed(simulation: &mut Simulation, to: f64, speed: f32) -> Vec<DVec3> {
    let mut tips = Vec::new();
    let steps = ((to - simulation.inserted()) / f64::from(speed) / 0.002).round() as usize;
    for _ in 0..steps {
        assert_ne!(simulation.step(Input { feed: speed, roll: 0.0 }), Stepped::Held);
        tips.push(simulation.tip());
    }
    tips
}

#[test]
fn place_order_and_speed_do_not_matter() {
    let wire = straight();
    let mut plain = entered(&wire, vessel(), |p| p);
    let tips = fed(&mut plain, 60.0, 20.0);
    let apart = |other: &[DVec3], back: &dyn Fn(DVec3) -> DVec3| {
        tips.iter().zip(other).map(|(a, &b)| a.distance(back(b))).fold(0.0, f64::max)
    };

    let mut again = entered(&wire, vessel(), |p| p);
    let same = fed(&mut again, 60.0, 20.0);
    println!("again {}", tips == same);

    let mut shuffled = vessel();
    let count = shuffled.triangles.len();
    shuffled.triangles = (0..count).map(|i| shuffled.triangles[(i * 7919 + 13) % count]).collect();
    for (i, triangle) in shuffled.triangles.iter_mut().enumerate() {
        triangle.rotate_left(i % 3);
    }
    let mut other = entered(&wire, shuffled, |p| p);
    let o = fed(&mut other, 60.0, 20.0);
    for (i, (a, b)) in tips.iter().zip(&o).enumerate() { if i % 200 == 0 { println!("{i} {a:?} {:e}", a.distance(*b)); } }
    println!("shuffled {:e}", apart(&o, &|p| p));

    let turn = DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 1.1);
    let moved = DVec3::new(12.0, -30.0, 7.0);
    let place = |p: DVec3| turn * p + moved;
    let mut mesh = vessel();
    mesh.positions.iter_mut().for_each(|p| *p = place(p.as_dvec3()).as_vec3());
    let mut other = entered(&wire, mesh, place);
    println!("moved {:e}", apart(&fed(&mut other, 60.0, 20.0), &|p| turn.inverse() * (p - moved)));

    for speed in [5.0, 10.0, 40.0] {
        let mut other = entered(&wire, vessel(), |p| p);
        fed(&mut other, 60.0, speed);
        println!("speed {speed} {} {:?} {}", other.inserted(), other.tip(), other.tip().distance(plain.tip()));
    }
    for part in [4.0, 2.0, 1.0, 0.5, 0.25] {
        let wire = Wire { elements_mm: [0.5 * part, 2.0 * part], ..straight() };
        let mut other = entered(&wire, vessel(), |p| p);
        fed(&mut other, 60.0, 20.0);
        println!("elements {part} {} {:?} {} push {:?}", other.inserted(), other.tip(), other.tip().distance(plain.tip()), other.push_and_torque());
    }
    let start = entered(&wire, vessel(), |p| p);
    let mut round = start.clone();
    fed(&mut round, 60.0, 20.0);
    fed(&mut round, start.inserted(), -20.0);
    println!("return {} {} {}", round.inserted(), start.inserted(), round.tip().distance(start.tip()));
}
