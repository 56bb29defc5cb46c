//! Rods to be tried, and how they come to rest.

use glam::DVec3;
use lumen::trial::rod::{Fixed, Hessian, Rod, Section};

/// N mm2; about a solid nickel-titanium core of 0.36 mm.
pub(crate) const EI: f64 = 40.0;
/// N mm2.
pub(crate) const GJ: f64 = EI / 1.3;
/// mm.
pub(crate) const LENGTH: f64 = 50.0;

pub(crate) const CLAMPED: Fixed = Fixed { position: true, angle: true };

/// A straight rod along x from `-LENGTH` to its clamp at the origin, which holds the edge beyond; half of the clamped
/// node's cell bends.
pub(crate) fn cantilever(elements: usize) -> Rod {
    let h = LENGTH / elements as f64;
    let section = |i: usize| Section {
        length: h,
        cell: if i == elements { h / 2.0 } else { h },
        ei: EI,
        gj: GJ,
        ea: 1e4,
        ..Section::default()
    };
    let positions = (0..elements + 2).map(|i| DVec3::X * (i as f64 * h - LENGTH)).collect();
    let mut rod = Rod::new(positions, (0..elements + 2).map(section).collect(), DVec3::Y);
    rod.fixed[elements] = CLAMPED;
    rod.fixed[elements + 1] = CLAMPED;
    rod
}

/// Lets a rod come to rest under its loads.
pub(crate) fn settle(rod: &mut Rod) {
    settle_with(rod, |_| (), |_| ());
}

/// Likewise: `load` sets the loads for the shape as it is, `support` adds springs to the equations.
pub(crate) fn settle_with(rod: &mut Rod, load: impl Fn(&mut Rod), support: impl Fn(&mut Rod)) {
    settle_by(1.0, rod, load, support);
}

/// Likewise, going this part of each correction: where twist throws a rod out of its plane the whole of it is too far.
pub(crate) fn settle_by(part: f64, rod: &mut Rod, load: impl Fn(&mut Rod), support: impl Fn(&mut Rod)) {
    // Close to a critical load rounding keeps it from coming nearer than this.
    let (mut least, mut since) = (f64::INFINITY, 0);
    for _ in 0..20_000 {
        load(rod);
        // What is fixed may have been put elsewhere.
        rod.refresh();
        rod.assemble(f64::INFINITY, 0.0, Hessian::Safe);
        support(rod);
        let before: Vec<f64> = (0..rod.len() - 1).map(|edge| rod.spin(edge)).collect();
        rod.begin_change();
        rod.begin_direction();
        let direction = rod.solve(Hessian::Safe).expect("a safe Hessian");
        rod.go(direction.most, std::iter::empty());
        rod.advance(part);
        let spun = before.iter().enumerate().map(|(edge, before)| (rod.spin(edge) - before).abs()).fold(0.0, f64::max);
        let change = direction.moved.max(spun);
        since = if change < least { 0 } else { since + 1 };
        least = least.min(change);
        if change < 1e-10 || (least < 1e-7 && since > 200) {
            rod.finish(f64::INFINITY);
            return;
        }
    }
    panic!("the rod does not come to rest: it still moves by {least:e}");
}
