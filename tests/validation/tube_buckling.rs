//! A wire that is pushed in a tube wider than itself: it leaves the floor to the side and snakes.

use glam::DVec3;
use lumen::trial::body::Stepped;
use lumen::trial::rod::Section;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Part;
use crate::friction::{RADIUS, STEP, TUBE, threaded};
use crate::tubes::{curve, tube};

/// Radial clearance in mm.
const CLEARANCE: f64 = TUBE - RADIUS;
/// N mm2.
const EI: f64 = 1.0;

/// A little to the side, never the same, so that every way of buckling is begun.
fn uneven(i: usize) -> f64 {
    let mut state = i as u32 ^ 0x9e37_79b9;
    for _ in 0..3 {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
    }
    f64::from(state >> 8) / f64::from(1 << 23) - 1.0
}

#[test]
fn a_pushed_wire_snakes_in_its_tube() {
    let mut found = Benchmark::new("snaking");
    let (length, h, load) = (150.0, 1.0, 0.01);
    let unit = (EI * load / CLEARANCE).sqrt();
    let path = curve(&[(length, f64::INFINITY)], h);
    let wall = tube(&curve(&[(length + 10.0, f64::INFINITY)], 0.73), |_| TUBE, 384);
    let section = Section { ei: EI, gj: EI / 1.3, ea: 2000.0, mass: 1e-9, drag: 1e-6, ..Section::default() };
    let mut body = threaded(&path, |_| DVec3::NEG_Y * CLEARANCE + DVec3::X * 5.0, section, [0.0; 2], wall);
    let count = body.rod.len();
    // The tip is held, the other end is pushed.
    body.rod.held[0].position = true;
    body.rod.forces.extend((0..count - 2).map(|i| (i, (DVec3::NEG_Y + DVec3::Z * 0.02 * uneven(i)) * load * h)));
    let mut snaking = Vec::new();
    for i in 0..1000 {
        let ends = [count - 2, count - 1].map(|i| (i, body.rod.positions[i] + DVec3::NEG_X * 0.0025));
        let stepped = body.step(STEP, count - 2, |rod| ends.iter().for_each(|&(i, p)| rod.positions[i] = p));
        assert_ne!(stepped, Stepped::Held);
        if i % 40 != 39 {
            continue;
        }
        let mut rod = body.rod.clone();
        rod.assemble_from(count - 5);
        let push = -(count - 2..count).map(|i| rod.holding_force(i)).sum::<DVec3>().x / unit;
        let middle = &body.rod.positions[count / 3..2 * count / 3];
        let widest = middle.iter().map(|p| p.z.abs() / CLEARANCE).fold(f64::MIN, f64::max);
        found.point("ours", push, widest);
        if (0.25..0.5).contains(&widest) {
            snaking.push((push, widest * widest));
        }
    }
    // Beyond its onset the square of the width grows with the load.
    let count = snaking.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| snaking.iter().map(of).sum::<f64>() / count;
    let (load_mean, square_mean) = (mean(|p| p.0), mean(|p| p.1));
    let slope = mean(|p| p.0 * p.1) - load_mean * square_mean;
    let slope = slope / (mean(|p| p.0 * p.0) - load_mean * load_mean);
    let onset = load_mean - square_mean / slope;
    found.compare("load at which it snakes over √(EI w/r)", 2.0, onset, Part(0.02), 150);
    found.mark("Dawson and Paslay", 2.0, 0.0);
    found.finish();
}
