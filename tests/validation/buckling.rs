//! Buckling under an end load: Euler's four cases, by Southwell's plot. Buckling under a twist, with a load and without:
//! Greenhill's.
//!
//! A small force across makes a column give by `w`. Near its critical load `w = w_0 + w P / P_c` (Southwell 1932), so
//! that two loads give `P_c`; two closer to that give it better. A twist to the other side gives by as much, so that for
//! the twisting moment it is the square that counts.

use std::f64::consts::PI;

use glam::DVec3;
use lumen::trial::rod::{Fixed, Rod, Section};

use crate::benchmark::Benchmark;
use crate::benchmark::Tolerance::Part;
use crate::rods::{CLAMPED, EI, GJ, LENGTH, settle_by, settle_with};

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
/// In how many parts a column is turned.
const TURNS: u32 = 20;

/// A column along x; the load is on the end of node `first`, the other end is that of node `last`.
struct Column {
    rod: Rod,
    first: usize,
    last: usize,
    loaded: End,
    other: End,
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
        rod.fixed[last] = Fixed { position: true, angle: true };
        rod.fixed[count - 1] = CLAMPED;
        rod.fixed[0].angle = true;
        Self { rod, first, last, loaded, other }
    }

    /// How far it gives across under a load along it in N: the most of any node, in mm.
    fn gives(&self, load: f64, across: f64) -> f64 {
        self.gives_twisted(load, 0.0, across)
    }

    /// Likewise, twisted by a moment in N mm.
    fn gives_twisted(&self, load: f64, moment: f64, across: f64) -> f64 {
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
        if moment == 0.0 {
            settle_with(&mut rod, |_| (), guide);
        } else {
            // Little by little: the turn of a step is found from where it began.
            let [from, to] = [0, if self.other == Clamped { self.last } else { self.last - 1 }];
            rod.fixed[to].angle = true;
            let loads = rod.forces.clone();
            // Edges pass on moments about themselves: at an end that is free to tilt the rest of an axial one is a couple.
            let couples = |rod: &mut Rod, moment: f64| {
                rod.forces.clone_from(&loads);
                for (edge, moment) in [(from, -moment), (to, moment)] {
                    let along = rod.positions[edge + 1] - rod.positions[edge];
                    let force = (DVec3::X * moment).cross(along) / along.length_squared();
                    rod.forces.extend([(edge + 1, force), (edge, -force)]);
                }
            };
            let turn = moment / GJ * rod.sections[from + 1..=to].iter().map(|section| section.cell).sum::<f64>();
            for i in 1..=TURNS {
                let part = f64::from(i) / f64::from(TURNS);
                rod.turn_to(to, turn / f64::from(TURNS));
                settle_by(
                    0.5,
                    &mut rod,
                    |rod| {
                        if self.other == Pinned {
                            couples(rod, part * moment);
                        }
                    },
                    guide,
                );
            }
        }
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

/// What is 0 where a clamped column under this moment over `EI / L` and this load over `EI / L2` buckles: where
/// `EI w'''' - i M w''' + P w'' = 0` has an answer other than 0 with `w = w' = 0` at both ends. Its waves have the
/// numbers `k` of `EI k2 = M k + P`. Over the load, for without one it would be 0 for every moment.
fn unbalance(moment: f64, load: f64) -> f64 {
    let load = if load == 0.0 { 1e-6 } else { load };
    let root = (moment * moment / 4.0 + load).sqrt();
    let (a, b) = (moment / 2.0 + root, moment / 2.0 - root);
    let sinc = |x: f64| if x.abs() < 1e-9 { 1.0 } else { x.sin() / x };
    (sinc(a / 2.0) * sinc(b / 2.0) - sinc(root)) / load
}

/// The moment over `EI / L` at which a column with two such ends buckles under this load over `EI / L2`. Pinned, with a
/// moment about the axis, it is `(M / 2)^2 + P = pi^2` (Greenhill 1883).
fn greenhill(end: End, load: f64) -> f64 {
    if end == Pinned {
        return 2.0 * (PI * PI - load).sqrt();
    }
    // Under a pull there are no waves below this.
    let mut low = 2.0 * (-load).max(0.0).sqrt() + 1e-3;
    let before = unbalance(low, load);
    let mut high = low;
    while unbalance(high, load) * before > 0.0 {
        (low, high) = (high, high + 0.01);
    }
    for _ in 0..50 {
        let middle = f64::midpoint(low, high);
        if unbalance(middle, load) * before > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// Ours.
fn critical_moment(end: End, load: f64, elements: usize) -> f64 {
    let column = Column::new(elements, end, end);
    let gives = |moment: f64| column.gives_twisted(load * EI / LENGTH / LENGTH, moment * EI / LENGTH, 1e-6);
    let mut critical = greenhill(end, load);
    for parts in [[0.8, 0.86], [0.92, 0.96], [0.98, 0.99]] {
        let [a, b] = parts.map(|part| ((part * critical).powi(2), gives(part * critical)));
        critical = ((b.1 * b.0 - a.1 * a.0) / (b.1 - a.1)).sqrt();
    }
    critical
}

#[test]
fn twisted_columns_buckle_at_greenhills_moments() {
    // tan x = x at 4.493409, which is half of it.
    assert!((greenhill(Clamped, 0.0) - 2.0 * 4.493_409_457_909_064).abs() < 1e-5);
    let mut found = Benchmark::new("greenhill");
    for (name, end, loads) in [("pinned", Pinned, [-20.0, 0.0, 5.0]), ("clamped", Clamped, [-20.0, 0.0, 20.0])] {
        for load in loads {
            let critical = critical_moment(end, load, 80);
            let what = format!("{name} M L/EI at P L²/EI = {load}");
            found.compare(&what, greenhill(end, load), critical, Part(0.01), 80);
            found.point(&format!("{name} ours"), load, critical);
        }
        let most = if end == Pinned { PI * PI } else { 4.0 * PI * PI };
        for i in 0..=100 {
            let load = -25.0 + (most + 25.0) * f64::from(i) / 100.0 - 1e-3;
            found.curve(&format!("{name} Greenhill"), load, greenhill(end, load));
        }
    }
    found.finish();

    let mut found = Benchmark::new("greenhill-order");
    let exact = greenhill(Clamped, 0.0);
    let errors = [10, 20, 40].map(|elements| (elements, critical_moment(Clamped, 0.0, elements) / exact - 1.0));
    found.order(&errors, 1.8);
    found.finish();
}
