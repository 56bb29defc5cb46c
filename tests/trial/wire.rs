//! A wire that is fed through tubes: it follows them, stays inside, and its tip is bent as its numbers say.

use std::sync::Arc;

use lumen::trial::audit::Audit;
use lumen::trial::report::StepKind;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;
use lumen_test_support::tubes::{curve, tube};

/// Through an S of two bends, coarse and fine, rolling all the way at half a turn a second: the tip arrives where the tube
/// leads, and no capsule reaches farther into the wall than 5 % of the radius, by a measure of its own (`audit`).
#[test]
fn a_wire_follows_bends() {
    for (name, radius, bend, sides) in
        [("workhorse", 1.5, 20.0, 24), ("floppy", 1.0, 12.0, 64), ("stiff", 1.5, 15.0, 8), ("035-j", 4.0, 30.0, 24)]
    {
        let path = curve(&[(20.0, f64::INFINITY), (40.0, bend), (40.0, -bend), (20.0, f64::INFINITY)], 0.5);
        let mesh = Arc::new(tube(&path, |_| radius, sides));
        let audit = Audit::new(&mesh);
        let wall = Arc::new(Wall::open(mesh));
        let entry = Entry { at: [4.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
        let wire = Wire::preset(name).unwrap();
        let mut simulation = Simulation::new(&wire, wire.friction, &entry, 0.0, Some(wall)).unwrap();
        let (mut steps, mut held) = (0, 0);
        while simulation.inserted() < 100.0 && steps < 10_000 {
            held += u32::from(simulation.step(Input { feed: 20.0, roll: 3.0 }).kind == StepKind::Held);
            steps += 1;
            if steps % 100 == 0 {
                let nodes: Vec<_> = simulation.nodes().collect();
                let depth = audit.penetration(&nodes, wire.radius());
                assert!(depth <= 0.05 * wire.radius(), "{name}: {depth} mm into the wall at step {steps}");
            }
        }
        assert!(held == 0 && simulation.inserted() >= 100.0, "{name}: {} mm in, held {held}", simulation.inserted());
        // A wire of 100 mm cannot be behind the middle of the tube by more than its slack, nor far before it.
        let tip = simulation.tip();
        let (nearest, &(at, _)) =
            path.iter().enumerate().min_by(|a, b| a.1.0.distance(tip).total_cmp(&b.1.0.distance(tip))).unwrap();
        let arc = 0.5 * nearest as f64 - 4.0;
        assert!(at.distance(tip) < radius, "{name}: the tip is {} mm off the middle", at.distance(tip));
        assert!((90.0..112.0).contains(&arc), "{name}: the tip is at {arc} mm of the tube");
    }
}

#[test]
fn the_tip_is_bent_to_its_side_by_its_angle() {
    for name in ["workhorse", "035-j"] {
        let wire = Wire::preset(name).unwrap();
        let entry = Entry { at: [0.0; 3], direction: [0.0, 0.0, 1.0] };
        let mut simulation = Simulation::new(&wire, wire.friction, &entry, 0.7, None).unwrap();
        for step in 0..2500 {
            simulation.step(Input { feed: if step < 500 { 30.0 } else { 0.0 }, roll: 0.0 });
        }
        let behind = simulation.grid().partition_point(|&at| at < wire.bend_mm + 1.0);
        let (rod, tip) = (&simulation.body().rod, simulation.tip());
        let (side, shaft) = (rod.director(behind), -rod.tangent(behind));
        let offset = tip - rod.positions[behind];
        assert!(offset.dot(side) > 0.5, "{name}: the tip is bent away from its side");
        // The end of a J bends on over half of the last element, which is straight here.
        let curved = wire.bend_mm - wire.straight_end_mm;
        let lost = (wire.elements_mm[0] / 2.0 - wire.straight_end_mm).max(0.0) / curved * wire.bend_degrees;
        let angle = shaft.angle_between(-rod.tangent(0)).to_degrees();
        assert!((angle - (wire.bend_degrees - lost)).abs() < 0.1, "{name}: {angle} degrees");
    }
}

#[test]
fn numbers_that_make_no_wire_are_named() {
    type Change = fn(&mut Wire);
    let wires: [(&str, Change); 7] = [
        ("diameter", |wire| wire.diameter_mm = -1.0),
        ("stiffness of the tip", |wire| wire.tip_ei = f64::NAN),
        ("kinetic friction", |wire| wire.friction[1] = f64::INFINITY),
        ("length", |wire| wire.length_mm = 10.0),
        ("element at the tip", |wire| wire.elements_mm[0] = 1e-6),
        ("angle of the bend", |wire| (wire.bend_mm, wire.straight_end_mm, wire.bend_degrees) = (3.0, 3.0, 180.0)),
        ("angle of the bend", |wire| wire.bend_degrees = 361.0),
    ];
    for (what, change) in wires {
        let mut wire = Wire::default();
        change(&mut wire);
        assert!(wire.check().unwrap_err().to_string().contains(what), "{what}");
    }
}
