//! The rod against what is known of rods: the elastica, rings, buckling, torsion.
//!
//! Elastica: Bisshopp and Drucker 1945 (the table of `guidewire.md` is its solution by shooting).

use std::f64::consts::PI;

use glam::DVec3;
use lumen::trial::rod::{Held, Rod, Section};

const EI: f64 = 40.0;
const LENGTH: f64 = 50.0;

/// A straight rod along x of `elements`, clamped at its last edge, of which half a cell bends.
fn cantilever(elements: usize) -> Rod {
    let h = LENGTH / elements as f64;
    let count = elements + 2;
    let section = |i: usize| Section {
        length: h,
        cell: if i == elements { h / 2.0 } else { h },
        ei: EI,
        gj: EI / 1.3,
        ea: 1e4,
        ..Section::default()
    };
    let positions = (0..count).map(|i| DVec3::X * (i as f64 * h - LENGTH)).collect();
    let mut rod = Rod::new(positions, (0..count).map(section).collect(), DVec3::Y);
    rod.held[elements] = Held { position: true, angle: true };
    rod.held[elements + 1] = Held { position: true, angle: true };
    rod
}

/// Lets a rod come to rest.
fn settle(rod: &mut Rod) {
    for _ in 0..3000 {
        rod.assemble(f64::INFINITY, 0.0);
        let (moved, _) = rod.solve();
        rod.advance(1.0);
        if moved < 1e-10 {
            rod.finish(f64::INFINITY);
            return;
        }
    }
    panic!("the rod does not come to rest");
}

#[test]
fn a_cantilever_is_an_elastica() {
    for (load, y, x) in [
        (0.5, 0.162_14, 0.984_08),
        (1.0, 0.301_72, 0.943_57),
        (2.0, 0.493_46, 0.839_36),
        (5.0, 0.713_79, 0.612_37),
        (10.0, 0.810_61, 0.445_00),
    ] {
        let mut errors = Vec::new();
        for elements in [20, 40, 80] {
            let mut rod = cantilever(elements);
            let force = DVec3::Y * (load * EI / LENGTH / LENGTH);
            rod.forces.push((0, force));
            settle(&mut rod);
            let tip = rod.positions[0];
            errors.push((tip.y / LENGTH / y - 1.0).abs().max((-tip.x / LENGTH / x - 1.0).abs()));
        }
        println!("{load}: {errors:?}");
        assert!(errors[2] < 2e-3, "{load}: {errors:?}");
    }
}

#[test]
fn an_end_moment_closes_a_ring() {
    // A rest curvature of one turn over the length is what a moment 2 pi EI / L does.
    let elements = 80;
    let mut rod = cantilever(elements);
    let turn = 2.0 * (PI / elements as f64).tan();
    for (i, section) in rod.sections.iter_mut().enumerate() {
        section.rest = if i == elements { [(PI / elements as f64 / 2.0).tan() * 2.0, 0.0] } else { [turn, 0.0] };
    }
    settle(&mut rod);
    println!("{}", rod.positions[0]);
}
