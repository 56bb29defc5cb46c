//! Twist: a torque at the tip, friction along the wall, the ring that twist throws out of its plane, the column that it
//! buckles, and the whip of a bent tip in a bent tube.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use lumen::trial::rod::{Fixed, Rod, Section};

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Part;
use crate::rods::{EI, GJ, LENGTH, cantilever, settle, settle_by};

#[test]
fn a_torque_turns_by_t_l_over_gj_and_friction_by_half() {
    let mut found = Benchmark::new("torsion");
    let elements = 80;
    let h = LENGTH / elements as f64;
    // The first edge's middle is half an element from the tip.
    let long = LENGTH - h / 2.0;
    for turns in [0.1, 1.0, 4.0] {
        let torque = turns * TAU * GJ / LENGTH;
        let mut rod = cantilever(elements);
        rod.moments.push((0, torque));
        found.compare(
            &format!("turn at T L/GJ = {turns} turns (rad)"),
            torque * long / GJ,
            turned(&mut rod),
            Part(0.01),
            elements,
        );
        for i in (0..elements).step_by(4) {
            found.point("end torque", (i as f64 + 0.5) * h / LENGTH, spread(&rod, i) / (turns * TAU));
        }
    }
    // The same torque q along the wire, as wall friction has it: the guide leads the tip by q L2 / 2 GJ.
    let q = 2.0 * GJ / LENGTH / LENGTH;
    let mut rod = cantilever(elements);
    rod.moments.extend((0..elements).map(|i| (i, q * h)));
    let ours = turned(&mut rod);
    found.compare("lag at q L²/2GJ = 1 (rad)", 1.0, ours, Part(0.01), elements);
    for i in (0..elements).step_by(4) {
        found.point("friction along it", (i as f64 + 0.5) * h / LENGTH, spread(&rod, i));
    }
    for i in 0..=20 {
        let x = f64::from(i) / 20.0;
        found.curve("1 - x", x, 1.0 - x);
        found.curve("1 - x²", x, 1.0 - x * x);
    }
    found.finish();
}

/// Lets the rod come to rest; the turn of its tip in radians.
fn turned(rod: &mut Rod) -> f64 {
    settle(rod);
    spread(rod, 0)
}

/// The twist between an edge and the clamp, in radians.
fn spread(rod: &Rod, edge: usize) -> f64 {
    -(edge + 1..rod.len() - 1).map(|i| rod.twist(i)).sum::<f64>()
}

/// A closed ring of this many edges, of which the first and the last lie on each other, turned against each other by
/// `angle`; pushed out of its plane where Michell's instability would go.
fn ring(elements: usize, angle: f64) -> f64 {
    let h = LENGTH / elements as f64;
    let radius = h / 2.0 / (PI / elements as f64).sin();
    let at = |i: usize| TAU * i as f64 / elements as f64;
    let positions = (0..elements + 2).map(|i| DVec3::new(at(i).cos(), at(i).sin(), 0.0) * radius).collect();
    let section = Section { length: h, cell: h, ei: EI, gj: GJ, ea: 1e5, ..Section::default() };
    let mut rod = Rod::new(positions, vec![section; elements + 2], DVec3::Z);
    for node in [0, 1, elements, elements + 1] {
        rod.fixed[node] = Fixed { position: true, angle: node != 1 };
    }
    rod.fixed[elements].angle = true;
    // Little by little: the turn of a step is found from where it began.
    for _ in 0..20 {
        rod.turn_to(elements, angle / 20.0);
        settle_by(0.5, &mut rod, |_| (), |_| ());
    }
    let flat = rod.positions.clone();
    rod.forces.extend((2..elements).map(|i| (i, DVec3::Z * 1e-5 * (2.0 * at(i)).cos())));
    settle_by(0.5, &mut rod, |_| (), |_| ());
    // The work of the push: what does not move the ring as a whole.
    let pushed = rod.positions.iter().zip(&flat).enumerate().skip(2).take(elements - 2);
    pushed.map(|(i, (p, flat))| (p.z - flat.z) * (2.0 * at(i)).cos()).sum()
}

#[test]
fn a_twisted_ring_leaves_its_plane() {
    let mut found = Benchmark::new("michell");
    let exact = TAU * 3f64.sqrt() * EI / GJ;
    // What it gives by is over 1 - (angle / critical)2.
    let critical = |elements: usize| {
        let mut critical = exact;
        for parts in [[0.8, 0.86], [0.92, 0.96]] {
            let [a, b] = parts.map(|part| ((part * critical).powi(2), ring(elements, part * critical)));
            critical = ((b.1 * b.0 - a.1 * a.0) / (b.1 - a.1)).sqrt();
        }
        critical
    };
    found.compare("critical turn (rad)", exact, critical(80), Part(0.01), 80);
    let unturned = ring(40, 0.0);
    for i in 0..=12 {
        let angle = exact * 0.08 * f64::from(i);
        found.point("ours", angle, unturned / ring(40, angle));
    }
    found.mark("Michell", exact, 0.0);
    found.finish();

    let mut found = Benchmark::new("michell-order");
    let errors = [20, 40, 80].map(|elements| (elements, critical(elements) / exact - 1.0));
    found.order(&errors, 1.8);
    found.finish();
}

/// A wire held along an arc whose curvature is `tube`, free to turn in it, with the rest curvature `own`; the last edge
/// is the one that is turned. Cells are curved, and half an element at the tip belongs to none: without it the length is
/// [`LENGTH`].
fn whip(elements: usize, own: f64, tube: f64) -> Rod {
    let h = LENGTH / (elements as f64 - 0.5);
    let step = 2.0 * (h * tube / 2.0).asin();
    let at = |i: usize| DVec3::new((step * i as f64).sin() / tube, (1.0 - (step * i as f64).cos()) / tube, 0.0);
    let section = |i: usize| {
        let cell = if i == elements { h / 2.0 } else { h };
        Section { length: h, cell, ei: EI, gj: GJ, ea: 1e4, rest: [own * cell, 0.0], ..Section::default() }
    };
    let positions: Vec<DVec3> = (0..elements + 2).map(at).collect();
    let side = DVec3::Y;
    let mut rod = Rod::new(positions, (0..elements + 2).map(section).collect(), side);
    for fixed in &mut rod.fixed {
        fixed.position = true;
    }
    rod.fixed[elements].angle = true;
    rod.fixed[elements + 1].angle = true;
    rod
}

/// Curvatures at which `L sqrt(EI own tube / GJ)` is this.
fn curvatures(number: f64) -> [f64; 2] {
    let tube = 1.0 / 20.0;
    [(number / LENGTH).powi(2) * GJ / EI / tube, tube]
}

/// The base's angle at which a shape with this tip angle stands: `GJ phi'' = EI own tube sin phi`, without torque at the
/// tip, over a length at which the number of the whip is `number`.
pub(crate) fn base_angle(number: f64, tip: f64) -> f64 {
    const STEPS: usize = 400;
    let h = number / STEPS as f64;
    let (mut angle, mut rate) = (tip, 0.0f64);
    for _ in 0..STEPS {
        let a = [rate, angle.sin()];
        let b = [rate + a[1] * h / 2.0, (angle + a[0] * h / 2.0).sin()];
        let c = [rate + b[1] * h / 2.0, (angle + b[0] * h / 2.0).sin()];
        let d = [rate + c[1] * h, (angle + c[0] * h).sin()];
        angle += (a[0] + 2.0 * b[0] + 2.0 * c[0] + d[0]) * h / 6.0;
        rate += (a[1] + 2.0 * b[1] + 2.0 * c[1] + d[1]) * h / 6.0;
    }
    angle
}

/// Turns the base of a wire of this number once round, in steps of 1 degree; the tip's angle at each.
fn turned_round(number: f64) -> Vec<f64> {
    let [own, tube] = curvatures(number);
    let mut rod = whip(80, own, tube);
    settle(&mut rod);
    let base = rod.len() - 2;
    (1..=360)
        .map(|degrees| {
            rod.turn_to(base, 1f64.to_radians());
            settle(&mut rod);
            f64::from(degrees).to_radians() + spread(&rod, 0)
        })
        .collect()
}

/// How far the tip turns for a small turn of the base where the wire looks the wrong way, one over it: 0 where it snaps.
fn reluctance(number: f64, elements: usize) -> f64 {
    let [own, tube] = curvatures(number);
    let mut rod = whip(elements, own, tube);
    // Turned as a whole, the wire stands there by symmetry, if not stably.
    for edge in 0..=elements {
        rod.turn_to(edge, PI);
    }
    settle(&mut rod);
    let before = spread(&rod, 0);
    let turn = 1e-5;
    rod.turn_to(elements, turn);
    settle(&mut rod);
    turn / (turn + spread(&rod, 0) - before)
}

/// The number of the whip from which on a wire snaps.
fn critical_number(elements: usize) -> f64 {
    let towards = |[a, b]: [(f64, f64); 2]| b.0 - b.1 * (b.0 - a.0) / (b.1 - a.1);
    let measured = |number: f64| (number, reluctance(number, elements));
    let [a, b] = [1.40, 1.45].map(measured);
    // Once more from below, where the rest is stable, and nearer.
    towards([b, measured(b.0 + 0.9 * (towards([a, b]) - b.0))])
}

#[test]
fn a_bent_tip_whips_in_a_bent_tube() {
    let mut found = Benchmark::new("whip");
    found.compare("number from which on it snaps", FRAC_PI_2, critical_number(80), Part(0.01), 80);
    let turns = 1.0 / reluctance(1.2, 80);
    found.compare(
        "turn of the tip over that of the base at 180° and number 1.2",
        1.0 / 1.2f64.cos(),
        turns,
        Part(0.01),
        80,
    );
    for number in [1.2, 2.5] {
        let tips = turned_round(number);
        for (i, tip) in tips.iter().enumerate().step_by(6) {
            found.point(&format!("number {number}"), i as f64 + 1.0, tip.to_degrees());
        }
        for i in 0..=180 {
            let tip = TAU * f64::from(i) / 180.0;
            let base = base_angle(number, tip).to_degrees();
            found.curve(&format!("number {number} analytic"), base, tip.to_degrees());
        }
        let jumps = tips.windows(2).map(|pair| pair[1] - pair[0]).enumerate();
        let (before, jump) = jumps.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
        if number > FRAC_PI_2 {
            assert!(jump > 1.0, "no snap at {number}");
            let tip = (0..10_000).map(|i| base_angle(number, PI * f64::from(i) / 10_000.0).to_degrees());
            // The base turns by one degree at a time: it snaps between two of them.
            let at = before as f64 + 1.5;
            found.compare("base at the snap of number 2.5 (degrees)", tip.fold(0.0, f64::max), at, Part(0.01), 80);
        } else {
            assert!(jump < 0.2, "a snap at {number}");
        }
    }
    found.finish();

    let mut found = Benchmark::new("whip-order");
    let errors = [10, 20, 40].map(|elements| (elements, critical_number(elements) / FRAC_PI_2 - 1.0));
    found.order(&errors, 1.8);
    found.finish();
}
