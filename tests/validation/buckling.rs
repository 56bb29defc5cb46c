//! Buckling under an end load: Euler's four cases, by Southwell's plot.
//!
//! A small force across makes a column give by `w`. Near its critical load `w = w_0 + w P / P_c` (Southwell 1932), so
//! that two loads give `P_c`; two closer to that give it better.

use std::f64::consts::PI;

use glam::DVec3;
use lumen::trial::rod::{Held, Rod, Section};

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Part;
use crate::rods::{EI, GJ, HELD, LENGTH, settle_with};

/// What an end of a column is held by.
#[derive(Clone, Copy, PartialEq)]
enum End {
    Free,
    Pinned,
    Clamped,
}

use End::{Clamped, Free, Pinned};

/// Stiffness of what keeps the loaded end on the axis, in N/mm.
const GUIDE: f64 = 1e5;

/// A column along x; the load is on the end of node `first`, the other end is that of node `last`.
struct Column {
    rod: Rod,
    first: usize,
    last: usize,
    loaded: End,
}

impl Column {
    fn new(elements: usize, loaded: End, other: End) -> Self {
        let h = LENGTH / elements as f64;
        let first = usize::from(loaded == Clamped);
        let (last, count) = (first + elements, first + elements + 1 + usize::from(other == Clamped));
        let section = |i: usize| Section {
            length: h,
            cell: if i == first || i == last { h / 2.0 } else { h },
            ei: EI,
            gj: GJ,
            ea: 1e5,
            ..Section::default()
        };
        let positions = (0..count).map(|i| DVec3::X * ((i as f64 - first as f64) * h)).collect();
        let mut rod = Rod::new(positions, (0..count).map(section).collect(), DVec3::Y);
        rod.held[last] = Held { position: true, angle: true };
        rod.held[count - 1] = HELD;
        rod.held[0].angle = true;
        Self { rod, first, last, loaded }
    }

    /// How far it gives across under a load along it in N: the most of any node, in mm.
    fn gives(&self, load: f64, across: f64) -> f64 {
        let mut rod = self.rod.clone();
        rod.forces.push((self.first, DVec3::X * load));
        let middle = if self.loaded == Free { self.first } else { (self.first + self.last) / 2 };
        rod.forces.push((middle, DVec3::Y * across));
        let guided = match self.loaded {
            Free => 0..0,
            Pinned => self.first..self.first + 1,
            Clamped => self.first - 1..self.first + 1,
        };
        let guide = |rod: &mut Rod| {
            for node in guided.clone() {
                let p = rod.positions[node];
                rod.add_spring(node, &[0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0], GUIDE * p.y, GUIDE);
                rod.add_spring(node, &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0], GUIDE * p.z, GUIDE);
            }
        };
        settle_with(&mut rod, |_| (), guide);
        rod.positions.iter().map(|p| p.y.abs()).fold(0.0, f64::max)
    }

    /// The critical load in N, which is about `near`.
    fn critical(&self, near: f64) -> f64 {
        let mut critical = near;
        for parts in [[0.7, 0.8], [0.95, 0.97], [0.99, 0.996]] {
            let [a, b] = parts.map(|part| (part * critical, self.gives(part * critical, 1e-6)));
            critical = (b.1 * b.0 - a.1 * a.0) / (b.1 - a.1);
        }
        critical
    }
}

#[test]
fn columns_buckle_at_eulers_loads() {
    let mut found = Benchmark::new("euler");
    let unit = EI / LENGTH / LENGTH;
    // tan x = x at 4.493409, clamped and pinned.
    let cases = [
        ("clamped-free", Free, Clamped, PI * PI / 4.0),
        ("pinned-pinned", Pinned, Pinned, PI * PI),
        ("clamped-pinned", Pinned, Clamped, 4.493_409_457_909_064_f64.powi(2)),
        ("clamped-clamped", Clamped, Clamped, 4.0 * PI * PI),
    ];
    for (name, loaded, other, exact) in cases {
        let column = Column::new(80, loaded, other);
        let critical = column.critical(exact * unit);
        found.compare(&format!("{name} P L²/EI"), exact, critical / unit, Part(0.01), 80);
        let across = 1e-6;
        let unloaded = column.gives(0.0, across);
        for i in 0..=10 {
            let part = 0.98 * f64::from(i) / 10.0;
            found.point(name, part * exact, unloaded / column.gives(part * exact * unit, across));
        }
        found.mark("Euler's loads", exact, 0.0);
    }
    found.finish();

    let mut found = Benchmark::new("euler-order");
    let exact = 4.0 * PI * PI;
    let errors = [10, 20, 40].map(|elements| {
        (elements, Column::new(elements, Clamped, Clamped).critical(exact * unit) / unit / exact - 1.0)
    });
    found.order(&errors, 1.8);
    found.finish();
}
