//! A wire that is pushed in a straight tube without friction: past its snaking it winds itself into a helix.
//!
//! A helix of angle `a` to the axis, at the distance `r` of it, whose ends are free to turn about it: its bending energy
//! and the way of its load are least for
//!
//! ```text
//! F = 2 EI / r2 sin2 a cos a      n = EI / r3 sin4 a
//! ```
//!
//! with `n` what it presses on each mm of itself on the wall. Of slender helices, whose pitch is `p = 2 pi r / a`, that
//! is `F = 8 pi2 EI / p2` (Lubinski, Althouse and Logan 1962) and `n = r F2 / 4 EI`.

use std::f64::consts::TAU;

use glam::DVec3;
use lumen::trial::report::StepKind;
use lumen::trial::rod::Section;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Part;
use crate::friction::{RADIUS, STEP, TUBE, threaded};
use lumen_test_support::tubes::{Place, curve, tube};

/// Radial clearance in mm.
const CLEARANCE: f64 = TUBE - RADIUS;
/// N mm2.
const EI: f64 = 1.0;
/// How long a helix is given to come to rest, in steps.
const STEPS: usize = 500;

/// The angle of the helix under this load in N.
fn helix_angle(load: f64) -> f64 {
    let (mut low, mut high) = (0.0f64, 0.9f64);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        let less = 2.0 * EI / CLEARANCE.powi(2) * middle.sin().powi(2) * middle.cos() < load;
        if less { low = middle } else { high = middle }
    }
    low
}

/// The angle to the axis, and what a mm of it presses on the wall in N, of a wire under this load.
fn helix(load: f64) -> [f64; 2] {
    let angle = helix_angle(load);
    let pitch = TAU * CLEARANCE / angle.tan();
    let h = pitch / angle.cos() / 40.0;
    // Six turns.
    let places: Vec<Place> = (0..240)
        .map(|i| {
            let s = h * f64::from(i);
            let (sine, cosine) = (s * angle.sin() / CLEARANCE).sin_cos();
            let at = DVec3::new(s * angle.cos(), CLEARANCE * 0.99 * cosine, CLEARANCE * 0.99 * sine);
            (at, DVec3::X)
        })
        .collect();
    let long = 240.0 * h * angle.cos();
    // A straight tube needs no rings.
    let wall = tube(&curve(&[(long + 20.0, f64::INFINITY)], long + 20.0), |_| TUBE, 384);
    let section = Section { ei: EI, gj: EI / 1.3, ea: 2000.0, mass: 1e-9, drag: 1e-4, ..Section::default() };
    let mut body = threaded(&places, |_| DVec3::X * 5.0, section, [0.0; 2], wall);
    let count = body.rod.len();
    body.rod.forces.push((0, DVec3::X * load));
    let (mut angle, mut force, mut times) = (0.0, 0.0, 0.0);
    for i in 0..STEPS {
        assert_ne!(body.step(STEP, count - 2, |_| ()), StepKind::Held);
        // The ends bend away from the helix, by less and less over half a turn.
        if i >= STEPS / 2 {
            let [from, to] = [80, 160];
            let way: f64 = body.rod.sections[from..to].iter().map(|section| section.length).sum();
            angle += ((body.rod.positions[to].x - body.rod.positions[from].x) / way).acos();
            let pressing = body.touches().filter(|touch| (from..to).contains(&touch.0));
            force += pressing.map(|touch| touch.3).sum::<f64>() / way;
            times += 1.0;
        }
    }
    [angle / times, force / times]
}

#[test]
fn a_pushed_wire_winds_itself_into_lubinskis_helix() {
    let mut found = Benchmark::new("helix");
    let mut pressed = Benchmark::new("helix-wall");
    let units = [CLEARANCE.powi(2) / EI, CLEARANCE.powi(3) / EI];
    let pitch = |angle: f64| TAU / angle.tan();
    for load in [0.02, 0.05, 0.1, 0.2] {
        let exact = helix_angle(load);
        let [angle, force] = helix(load);
        let number = load * units[0];
        found.compare(&format!("pitch over r at F r²/EI = {number:.3}"), pitch(exact), pitch(angle), Part(0.01), 240);
        found.point("ours", number, pitch(angle));
        let (exact, ours) = (exact.sin().powi(4), force * units[1]);
        pressed.compare(&format!("n r³/EI at F r²/EI = {number:.3}"), exact, ours, Part(0.02), 240);
        pressed.point("ours", number, ours);
    }
    for i in 1..=40 {
        let load = 0.005 * f64::from(i) + 0.01;
        let (number, angle) = (load * units[0], helix_angle(load));
        found.curve("helix", number, pitch(angle));
        found.curve("Lubinski's", number, TAU * (2.0 / number).sqrt());
        pressed.curve("helix", number, angle.sin().powi(4));
        pressed.curve("Lubinski's", number, number * number / 4.0);
    }
    found.finish();
    pressed.finish();
}
