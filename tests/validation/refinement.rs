//! Elements made shorter: the way of the tip and the wall's force come to something.

use std::sync::Arc;

use glam::DVec3;
use lumen::trial::setup::{Entry, Input};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::{Part, Within};
use lumen_test_support::tubes::{curve, tube};

/// Lengths in mm between which a way is looked at, and from which on it is rolled.
const FROM: usize = 10;
const TO: usize = 55;
const ROLLED: f64 = 30.0;

/// What was found while a mm was fed in: means of the tip's place, and of the sum of the wall's forces in N.
#[derive(Clone, Copy, Default)]
struct Station {
    tip: DVec3,
    force: f64,
    count: f64,
}

/// The way of a wire with a bent tip into a bent vessel, its elements shorter by this factor.
fn way(finer: f64, wall: &Arc<Wall>) -> Vec<Station> {
    // Too stiff to buckle: what buckles does so to any side.
    let wire = Wire { tip_ei: 5.0, ..Wire::preset("workhorse").unwrap() };
    let wire = Wire { elements_mm: wire.elements_mm.map(|mm| mm / finer), ..wire };
    let entry = Entry { at: [4.0, 0.0, 0.0], direction: DVec3::new(1.0, 0.0, 0.012).as_vec3().to_array() };
    let mut simulation = Simulation::new(&wire, wire.friction, &entry, 0.0, Some(wall.clone())).unwrap();
    let mut stations = vec![Station::default(); TO - FROM];
    while simulation.inserted() < TO as f64 {
        assert!(simulation.steps() < 20_000, "the wire does not go in");
        let roll = if simulation.inserted() > ROLLED { 0.5 } else { 0.0 };
        simulation.step(Input { feed: 5.0, roll });
        let at = simulation.inserted() - FROM as f64;
        if let Some(station) = stations.get_mut(at as usize).filter(|_| at >= 0.0) {
            station.tip += simulation.tip();
            station.force += simulation.body().pressure().0;
            station.count += 1.0;
        }
    }
    let mean = |Station { tip, force, count }| Station { tip: tip / count, force: force / count, count };
    stations.into_iter().map(mean).collect()
}

#[test]
fn shorter_elements_come_to_one_way() {
    let mut found = Benchmark::new("refinement");
    let path = curve(&[(20.0, f64::INFINITY), (40.0, 25.0), (20.0, f64::INFINITY)], 0.5);
    let wall = Arc::new(Wall::open(Arc::new(tube(&path, |_| 1.5, 48))));
    let ways = [1.0, 2.0, 4.0].map(|finer| way(finer, &wall));
    let force = |way: &[Station]| way.iter().map(|station| station.force).sum::<f64>() / way.len() as f64;
    let finest = &ways[2];
    for (way, mm, most, part) in [(&ways[0], 0.5, 0.1, 0.03), (&ways[1], 0.25, 0.05, 0.015)] {
        let apart = way.iter().zip(finest).map(|(a, b)| a.tip.distance(b.tip)).fold(0.0, f64::max);
        found.compare(&format!("tip with elements of {mm} mm from that of 0.125 mm (mm)"), 0.0, apart, Within(most), 0);
        let what = format!("wall force with elements of {mm} mm (N)");
        found.compare(&what, force(finest), force(way), Part(part), 0);
    }
    for (name, way) in ["0.5 mm", "0.25 mm", "0.125 mm"].iter().zip(&ways) {
        for (i, station) in way.iter().enumerate() {
            let at = (FROM + i) as f64 + 0.5;
            if *name == "0.125 mm" {
                found.curve(name, at, 1000.0 * station.force);
            } else {
                found.point(name, at, 1000.0 * station.force);
            }
        }
    }
    found.finish();
}
