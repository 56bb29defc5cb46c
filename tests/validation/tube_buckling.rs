//! A wire that is pushed in a tube wider than itself: it leaves the floor to the side, then winds.

use std::f64::consts::PI;

use glam::DVec3;
use lumen::trial::body::{Body, Stepped};
use lumen::trial::rod::Section;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Band;
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

fn wait(body: &mut Body, count: usize, steps: usize) {
    for _ in 0..steps {
        assert_ne!(body.step(STEP, count, |_| ()), Stepped::Held);
    }
}

#[test]
fn a_pushed_wire_winds_in_its_tube() {
    let mut found = Benchmark::new("helix");
    let (length, h, load) = (150.0, 1.0, 0.01);
    let unit = (EI * load / CLEARANCE).sqrt();
    let path = curve(&[(length, f64::INFINITY)], h);
    let wall = tube(&curve(&[(length + 10.0, f64::INFINITY)], 0.73), |_| TUBE, 96);
    let section = Section { ei: EI, gj: EI / 1.3, ea: 2000.0, mass: 1e-9, drag: 1e-6, ..Section::default() };
    let mut body = threaded(&path, |_| DVec3::NEG_Y * CLEARANCE + DVec3::X * 5.0, section, [0.0; 2], wall);
    let count = body.rod.len();
    // The tip is held, the other end is pushed.
    body.rod.held[0].position = true;
    body.rod.held[count - 1].position = false;
    body.rod.held[count - 2].position = false;
    let count = count - 1;
    body.look(count);
    body.rod.forces.extend((0..count).map(|i| (i, (DVec3::NEG_Y + DVec3::Z * 0.02 * uneven(i)) * load * h)));
    let start = std::time::Instant::now();
    for i in 0..100 {
        let part = 1.6 + 0.03 * f64::from(i);
        body.rod.forces.truncate(count);
        body.rod.forces.push((count - 1, DVec3::NEG_X * part * unit));
        wait(&mut body, count, 20);
        let highest = body.rod.positions[10..count - 10].iter().map(|p| p.y).fold(f64::MIN, f64::max);
        let widest = body.rod.positions[10..count - 10].iter().map(|p| p.z.abs()).fold(f64::MIN, f64::max);
        println!("{part:.2} widest {widest:.3} highest {highest:.3} end {:.3} {:?}", body.rod.positions[count - 1].x, start.elapsed());
        if highest > 0.95 * CLEARANCE { break; }
    }
    found.finish();
}
