//! Large bending: the cantilever under an end load, and the ring that an end moment closes.
//!
//! Elastica: Bisshopp and Drucker, "Large deflection of cantilever beams", 1945; here `EI theta'' = -P cos theta` is
//! integrated from the tip, whose slope is found by bisection.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::{Part, Within};
use crate::rods::{EI, LENGTH, cantilever, settle, settle_with};

/// Tip of the elastica of length 1 under `PL2/EI`: across, along, slope in radians.
fn elastica(load: f64) -> [f64; 3] {
    const STEPS: usize = 4000;
    let h = 1.0 / STEPS as f64;
    // From the tip: slope, its change, and the way to the tip.
    let shoot = |tip: f64| {
        let (mut slope, mut bend, mut way) = (tip, 0.0f64, [0.0f64; 2]);
        let change = |slope: f64, bend: f64| [-bend, load * slope.cos(), slope.sin(), slope.cos()];
        for _ in 0..STEPS {
            let a = change(slope, bend);
            let b = change(slope + a[0] * h / 2.0, bend + a[1] * h / 2.0);
            let c = change(slope + b[0] * h / 2.0, bend + b[1] * h / 2.0);
            let d = change(slope + c[0] * h, bend + c[1] * h);
            let sum = |k: usize| (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]) * h / 6.0;
            slope += sum(0);
            bend += sum(1);
            way = [way[0] + sum(2), way[1] + sum(3)];
        }
        (slope, way)
    };
    let (mut low, mut high) = (0.0, PI / 2.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if shoot(middle).0 < 0.0 { low = middle } else { high = middle }
    }
    let [across, along] = shoot(low).1;
    [across, along, low]
}

/// Tip of our cantilever, likewise; `stretch` is how many times softer than a wire's it is along itself.
fn tip(load: f64, elements: usize, stretch: f64) -> [f64; 2] {
    let mut rod = cantilever(elements);
    rod.sections.iter_mut().for_each(|section| section.ea /= stretch);
    rod.forces.push((0, DVec3::Y * (load * EI / LENGTH / LENGTH)));
    settle(&mut rod);
    [rod.positions[0].y / LENGTH, -rod.positions[0].x / LENGTH]
}

#[test]
fn a_cantilever_is_an_elastica() {
    let mut found = Benchmark::new("cantilever");
    for (load, across, along, degrees) in [
        (0.5, 0.162_14, 0.984_08, 14.011),
        (1.0, 0.301_72, 0.943_57, 26.434),
        (2.0, 0.493_46, 0.839_36, 44.791),
        (5.0, 0.713_79, 0.612_37, 69.635),
        (10.0, 0.810_61, 0.445_00, 81.949),
    ] {
        let exact = elastica(load);
        let is_known = [(exact[0], across, 6e-6), (exact[1], along, 6e-6), (exact[2].to_degrees(), degrees, 6e-4)];
        assert!(is_known.iter().all(|(a, b, most)| (a - b).abs() < *most), "{load}: {exact:?}");
        let ours = tip(load, 80, 1.0);
        found.compare(&format!("y/L at PL²/EI = {load}"), exact[0], ours[0], Part(2e-3), 80);
        found.compare(&format!("x/L at PL²/EI = {load}"), exact[1], ours[1], Part(2e-3), 80);
        found.point("ours y/L", load, ours[0]);
        found.point("ours x/L", load, ours[1]);
    }
    for i in 0..=40 {
        let load = f64::from(i) / 4.0;
        let [across, along, _] = elastica(load);
        found.curve("elastica y/L", load, across);
        found.curve("elastica x/L", load, along);
    }
    found.finish();

    // The elastica does not stretch: what is left of that must not hide the order.
    let mut found = Benchmark::new("cantilever-order");
    let [across, along, _] = elastica(2.0);
    let errors = [10, 20, 40, 80].map(|elements| {
        let [y, x] = tip(2.0, elements, 1e-3);
        (elements, (y - across).hypot(x - along))
    });
    found.order(&errors, 1.8);
    found.finish();
}

/// The ends' distance in parts of the length, when an end moment of `2 pi EI / L` has bent the rod, and its shape.
fn ring(elements: usize) -> (f64, Vec<DVec3>) {
    let mut rod = cantilever(elements);
    const TURNS: usize = 20;
    for part in 1..=TURNS {
        let moment = TAU * EI / LENGTH * part as f64 / TURNS as f64;
        // A couple on the first edge, always across it.
        let couple = |rod: &mut lumen::trial::rod::Rod| {
            let along = rod.positions[1] - rod.positions[0];
            let force = DVec3::Z.cross(along) * (moment / along.length_squared());
            rod.forces.clear();
            rod.forces.extend([(0, force), (1, -force)]);
        };
        settle_with(&mut rod, couple, |_| ());
    }
    let ends = rod.positions[0].distance(rod.positions[elements]);
    (ends / LENGTH, rod.positions)
}

#[test]
fn an_end_moment_closes_a_ring() {
    let mut found = Benchmark::new("ring");
    let mut errors = Vec::new();
    for elements in [20, 40, 80] {
        let (gap, shape) = ring(elements);
        errors.push((elements, gap));
        if elements == 80 {
            found.compare("distance of the ends over L", 0.0, gap, Within(0.01), elements);
            let radius = LENGTH / TAU;
            let worst = shape[..=elements].iter().map(|p| (p.distance(DVec3::Y * radius) / radius - 1.0).abs());
            found.compare("worst error of the radius over it", 0.0, worst.fold(0.0, f64::max), Within(0.01), elements);
            for p in &shape[..=elements] {
                found.point("ours", p.x / LENGTH, p.y / LENGTH);
            }
            for i in 0..=90 {
                let angle = f64::from(i) / 90.0 * TAU;
                let radius = 1.0 / TAU;
                found.curve("circle of circumference L", radius * angle.sin(), radius * (1.0 - angle.cos()));
            }
        }
    }
    found.finish();

    let mut found = Benchmark::new("ring-order");
    found.order(&errors, 1.8);
    found.finish();
}
