//! Two pieces of one wire that cross: what is laid on the upper one they share by their stiffness.

use std::f64::consts::PI;

use glam::DVec3;
use lumen::trial::body::Body;
use lumen::trial::report::StepKind;
use lumen::trial::rod::{Fixed, Rod, Section};

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Part;

/// mm, N mm2, N.
const RADIUS: f64 = 0.178;
const ELEMENT: f64 = 2.0;
const EI: f64 = 40.0;
const LOAD: f64 = 0.01;
/// Elements of the loop between the pieces.
const LOOP: usize = 24;

/// A rod whose first piece, of `count` nodes along x, is crossed a diameter above it by its last, along y, of `part` times its
/// stiffness. Between them a loop hardly has any. Each piece is clamped at both ends.
fn crossing(count: usize, part: f64) -> Body {
    let half = ELEMENT * (count - 1) as f64 / 2.0;
    let at = |i: usize| ELEMENT * i as f64 - half;
    let mut positions: Vec<DVec3> = (0..count).map(|i| DVec3::X * at(i)).collect();
    // Three quarters of a circle to the right, and up.
    positions.extend((1..LOOP).map(|i| {
        let along = i as f64 / LOOP as f64;
        let angle = PI * (0.5 - 1.5 * along);
        DVec3::new(half * (1.0 + angle.cos()), half * (angle.sin() - 1.0), 2.0 * RADIUS * along)
    }));
    positions.extend((0..count).map(|i| DVec3::new(0.0, at(i), 2.0 * RADIUS)));
    let all = positions.len();
    let section = |i: usize| {
        let length = if i + 1 < all { positions[i].distance(positions[i + 1]) } else { ELEMENT };
        let ei = if i < count - 1 {
            EI
        } else if i > all - count {
            part * EI
        } else {
            1e-7
        };
        Section { length, cell: ELEMENT, ei, gj: ei / 1.3, ea: 2000.0, mass: 1e-9, drag: 1e-7, rest: [0.0; 2] }
    };
    let sections = (0..all).map(section).collect();
    let mut rod = Rod::new(positions, sections, DVec3::Z);
    for node in [0, 1, count - 2, count - 1].into_iter().flat_map(|node| [node, all - 1 - node]) {
        rod.fixed[node] = Fixed { position: true, angle: true };
    }
    let middle = all - 1 - (count - 1) / 2;
    let nodes = if count % 2 == 1 { vec![middle] } else { vec![middle - 1, middle] };
    rod.forces = nodes.iter().map(|&node| (node, DVec3::NEG_Z * LOAD / nodes.len() as f64)).collect();
    Body::new(rod, RADIUS, [0.06, 0.04], None)
}

#[test]
fn two_pieces_that_cross_share_a_load_by_their_stiffness() {
    let mut found = Benchmark::new("self-contact");
    // With a node at the crossing, and with none.
    for (count, place) in [(11, "nodes"), (12, "edges")] {
        for part in [0.1, 0.5, 1.0, 4.0] {
            let mut body = crossing(count, part);
            let all = body.rod.len();
            body.detect(all);
            for _ in 0..500 {
                assert_ne!(body.step(0.002, all, |_| ()), StepKind::Held);
            }
            let pressed: f64 = body.contacts.pairs().iter().map(|pair| pair.multiplier).sum();
            // Two beams clamped alike give way to a load in their middle by 1 / EI.
            found.compare(&format!("{part} EI across {place}: force"), LOAD / (1.0 + part), pressed, Part(1e-3), count);
            let height = |first: usize| {
                let [low, high] = [first + (count - 1) / 2, first + count / 2];
                body.rod.positions[low].midpoint(body.rod.positions[high]).z
            };
            let apart = height(all - count) - height(0);
            found.compare(&format!("{part} EI across {place}: distance"), 2.0 * RADIUS, apart, Part(1e-4), count);
            // What the one feels the other feels the other way; the clamps of the lower piece bear it.
            assert!(body.contacts.total_of_pairs(all).length() < 1e-15);
            body.rod.assemble_from(0);
            let borne: DVec3 = [0, 1, count - 2, count - 1].iter().map(|&i| body.rod.reaction_force(i)).sum();
            found.compare(&format!("{part} EI across {place}: clamps"), pressed, borne.z, Part(1e-4), count);
        }
    }
    found.finish();
}
