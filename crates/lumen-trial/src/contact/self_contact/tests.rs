//! A wire in a sac, and two pieces of a rod that cross.

use std::sync::Arc;

use glam::DVec3;
use lumen_mesh::shapes::tube;

use crate::report::StepKind;
use crate::setup::{Entry, Input};
use crate::simulation::Simulation;
use crate::wall::Wall;
use crate::wire::Wire;

/// How near to each other two segments come.
fn distance([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> f64 {
    // The distance of two points is convex along each: by halves of thirds.
    let least = |p: DVec3| {
        let along = ((p - c).dot(d - c) / c.distance_squared(d)).clamp(0.0, 1.0);
        p.distance(c.lerp(d, along))
    };
    let (mut from, mut to) = (0.0, 1.0);
    for _ in 0..40 {
        let [s, t] = [(2.0 * from + to) / 3.0, (from + 2.0 * to) / 3.0];
        if least(a.lerp(b, s)) < least(a.lerp(b, t)) { to = t } else { from = s }
    }
    least(a.lerp(b, from))
}

/// The least distance of a wire's pieces that are at least five diameters of its length apart, and not next to each other,
/// in diameters.
fn nearest(nodes: &[DVec3], diameter: f64) -> f64 {
    let mut arcs = vec![0.0];
    nodes.windows(2).for_each(|pair| arcs.push(arcs[arcs.len() - 1] + pair[0].distance(pair[1])));
    let edge = |i: usize| [nodes[i], nodes[i + 1]];
    let mut least = f64::INFINITY;
    for i in 0..nodes.len() - 1 {
        for j in i + 2..nodes.len() - 1 {
            let [[a, b], [c, d]] = [edge(i), edge(j)];
            let bound = a.midpoint(b).distance(c.midpoint(d)) - 0.5 * (a.distance(b) + c.distance(d));
            if arcs[j] - arcs[i + 1] >= 5.0 * diameter && bound < least {
                least = least.min(distance([a, b], [c, d]));
            }
        }
    }
    least / diameter
}

/// A sphere of 24 mm behind a tube of 3 mm.
fn sac() -> Arc<Wall> {
    let radius = |z: f32| if z < 8.0 { 1.5 } else { (144.0 - (z - 19.9).powi(2)).max(2.25).sqrt() };
    Arc::new(Wall::new(Arc::new(tube(48, 62, 31.0, radius))))
}

/// What came of feeding a wire into the sac.
#[derive(Debug, Default)]
struct Fed {
    /// The least distance in balanced steps, in diameters.
    least: f64,
    steps: [usize; 5],
    /// The longest run of steps that were held or waited for.
    longest: usize,
    inserted: f64,
    pairs: usize,
}

fn fed(wire: &Wire, steps: usize) -> Fed {
    let name = &wire.name;
    let entry = Entry { at: [0.1, 0.0, 2.0], direction: [0.0, 0.0, 1.0] };
    let mut simulation = Simulation::new(wire, wire.friction, &entry, 0.0, Some(sac())).unwrap();
    let mut fed = Fed { least: f64::INFINITY, ..Fed::default() };
    let mut waits = 0;
    for _ in 0..steps {
        let report = simulation.step(Input { feed: 20.0, roll: 1.0 });
        fed.steps[report.kind as usize] += 1;
        waits = if matches!(report.kind, StepKind::Waited | StepKind::Held) { waits + 1 } else { 0 };
        fed.longest = fed.longest.max(waits);
        assert!(simulation.tip().is_finite());
        let nodes: Vec<DVec3> = simulation.nodes().collect();
        if report.kind == StepKind::Balanced {
            let near = nearest(&nodes, wire.diameter_mm);
            fed.least = fed.least.min(near);
            // The body finds what a search through all edges does, but for what is hardly nearer than a node.
            let (diameter, known) = (wire.diameter_mm, simulation.body().overlap);
            assert!(near >= 1.1 || known >= diameter * (0.99 - near), "{name}: {near} diameters, {known} mm");
        }
        fed.pairs =
            fed.pairs.max(simulation.body().contacts.pairs().iter().filter(|pair| pair.multiplier > 0.0).count());
    }
    fed.inserted = simulation.inserted();
    fed
}

#[test]
fn a_wire_that_coils_in_a_sac_stays_a_diameter_from_itself() {
    for name in ["floppy", "workhorse", "035-j"] {
        let fed = fed(&Wire::preset(name).unwrap(), 4500);
        println!("{name}: {fed:?}");
        assert!(fed.pairs > 5, "{name}: it does not touch itself: {fed:?}");
        assert!(fed.least > 0.95, "{name}: {fed:?}");
        // A fifth of a second; without self-contact the last one waits as long.
        assert!(fed.steps[StepKind::Held as usize] == 0 && fed.longest < 100, "{name}: {fed:?}");
    }
}

#[test]
fn so_does_one_of_short_elements() {
    // As soft all along as at its tip, so that it coils soon.
    let wire = Wire { elements_mm: [0.2; 2], length_mm: 120.0, shaft_ei: 0.05, ..Wire::preset("floppy").unwrap() };
    let fed = fed(&wire, 4500);
    println!("{fed:?}");
    assert!(fed.pairs > 0 && fed.least > 0.95, "{fed:?}");
}
