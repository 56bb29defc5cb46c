//! A wire that is fed into tubes.

#[path = "common/tubes.rs"]
mod tubes;

use std::sync::Arc;

use lumen::trial::body::Stepped;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use tubes::{curve, tube};

#[test]
fn a_wire_follows_a_bend() {
    for (name, radius, bend, sides) in
        [("workhorse", 1.5, 20.0, 24), ("floppy", 1.0, 12.0, 64), ("stiff", 1.5, 15.0, 8), ("035-j", 4.0, 30.0, 24)]
    {
        let path = curve(&[(20.0, f64::INFINITY), (40.0, bend), (40.0, -bend), (20.0, f64::INFINITY)], 0.5);
        let wall = Arc::new(Wall::new(Arc::new(tube(&path, |_| radius, sides))));
        let entry = Entry { at: [4.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
        let wire = Wire::preset(name).unwrap();
        let mut simulation = Simulation::new(&wire, wire.friction, &entry, 0.0, Some(wall)).unwrap();
        let start = std::time::Instant::now();
        let (mut braked, mut held, mut deepest, mut most, mut push) = (0, 0, f64::NEG_INFINITY, 0.0f64, 0.0f64);
        let mut steps = 0;
        while simulation.inserted() < 100.0 && steps < 6000 {
            let stepped =
                simulation.step(Input { feed: 20.0, roll: std::env::var("ROLL").map_or(3.0, |r| r.parse().unwrap()) });
            braked += u32::from(stepped == Stepped::Braked);
            held += u32::from(stepped == Stepped::Held);
            deepest = deepest.max(simulation.body().depth);
            most = most.max(simulation.body().pressure().1);
            push = push.max(simulation.push_and_torque()[0]);
            steps += 1;
            if steps % 500 == 0 {
                println!(
                    "{steps} {:.1} tip {:.2} nodes {} push {:.3} torque {:.4} wall {:.3?}",
                    simulation.inserted(),
                    simulation.tip(),
                    simulation.count(),
                    simulation.push_and_torque()[0],
                    simulation.push_and_torque()[1],
                    simulation.body().pressure()
                );
            }
        }
        println!(
            "{name}: {steps} steps, {:.0} per s, braked {braked}, held {held}, deepest {:.2} % of radius, most {most:.3} N, push {push:.3} N, tip {:.2}",
            f64::from(steps) / start.elapsed().as_secs_f64(),
            100.0 * deepest / wire.radius(),
            simulation.tip()
        );
    }
}

#[test]
fn the_tip_is_bent_to_its_side_by_its_angle() {
    for (name, straight) in [("workhorse", 1.5), ("035-j", 0.0)] {
        let wire = Wire::preset(name).unwrap();
        let entry = Entry { at: [0.0; 3], direction: [0.0, 0.0, 1.0] };
        let mut simulation = Simulation::new(&wire, wire.friction, &entry, 0.7, None).unwrap();
        for _ in 0..500 {
            simulation.step(Input { feed: 30.0, roll: 0.0 });
        }
        for _ in 0..2000 {
            simulation.step(Input::default());
        }
        let behind = simulation.grid().partition_point(|&at| at < wire.bend_mm + 1.0);
        let (rod, tip) = (&simulation.body().rod, simulation.tip());
        let side = rod.director(behind);
        let shaft = -rod.tangent(behind);
        let offset = tip - rod.positions[behind];
        let angle = shaft.angle_between(-rod.tangent(0)).to_degrees();
        println!("{name}: {side} {offset} {angle}");
        assert!(offset.dot(side) > 0.5, "{name}: the tip is bent away from its side");
        assert!((angle - wire.bend_degrees).abs() < 2.0, "{name}: {angle} degrees");
        assert!(straight == wire.straight_end_mm);
    }
}
