//! The elements that a wire is cut into: where its nodes are, and the numbers of each.

use std::f64::consts::PI;

use super::{STEEL, Wire};
use crate::rod::Section;

/// The stiffest that an edge is along itself, in N. Under a push of 1 N it gives by 0.05 %.
const STIFFEST: f64 = 2000.0;
/// Drag of blood on a cylinder that moves across itself in the middle of a lumen, N s/mm2. Stokes' equations have
///
/// ```text
/// 4 pi mu / (ln k - (k2 - 1) / (k2 + 1))
/// ```
///
/// where the lumen is `k` times as wide as the cylinder; this is for 4 mPa s and 14 times: 0.014 in in 5 mm. Nearer to the
/// wall it is more, along the wire less; against what bends the wire both are little.
const BLOOD: f64 = 3e-8;
/// Elements are fine up to here, in mm from the tip, and from there on each is longer than the one before by this factor.
const FINE: (f64, f64) = (10.0, 1.08);
impl Wire {
    /// Where the nodes are, in mm from the tip: fine over the first 10 mm, coarser from there on.
    pub(crate) fn grid(&self) -> Vec<f64> {
        let [fine, coarse] = self.elements_mm;
        let mut grid = vec![0.0];
        let (mut at, mut length) = (0.0, fine);
        while at < self.length_mm {
            at += length;
            grid.push(at);
            if at >= FINE.0.max(self.bend_mm + self.straight_end_mm) {
                length = if coarse > fine { (length * FINE.1).min(coarse) } else { coarse };
            }
        }
        grid
    }

    /// Bending stiffness in N mm2 at a place in mm from the tip.
    fn ei(&self, at: f64) -> f64 {
        let along = (at - self.soft_mm) / (self.taper_mm - self.soft_mm).max(1e-9);
        let logarithm = libm::log(self.shaft_ei / self.tip_ei) * along.clamp(0.0, 1.0);
        self.tip_ei * libm::exp(logarithm)
    }

    /// The numbers of each node of a grid.
    pub(crate) fn sections(&self, grid: &[f64]) -> Vec<Section> {
        let area = PI * self.radius() * self.radius();
        let last = grid.len() - 1;
        let section = |i: usize| {
            let (from, to) = (grid[i.max(1) - 1], grid[(i + 1).min(last)]);
            let (from, to) = (f64::midpoint(from, grid[i]), f64::midpoint(grid[i], to));
            let ei = self.ei(grid[i]);
            // A core of steel with this EI has an EA of sqrt(4 pi E EI).
            let ea = libm::sqrt(4.0 * PI * STEEL.1 * ei).min(STIFFEST);
            let bent = |at: f64| {
                ((at - self.straight_end_mm) / (self.bend_mm - self.straight_end_mm).max(1e-6)).clamp(0.0, 1.0)
            };
            let turn = (bent(to) - bent(from)) * self.bend_degrees.to_radians();
            Section {
                length: if i < last { grid[i + 1] - grid[i] } else { grid[i] - grid[i - 1] },
                cell: to - from,
                ei,
                gj: ei * self.torsion_ratio,
                ea,
                rest: [2.0 * libm::tan(turn / 2.0), 0.0],
                mass: self.density * area * (to - from),
                drag: BLOOD * (to - from),
            }
        };
        (0..grid.len()).map(section).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From the figures of the literature, as `PRESETS` cites them.
    #[test]
    fn a_preset_becomes_sections_of_its_stiffness_mass_and_bend() {
        for (name, diameter, [tip, shaft], [soft, taper], degrees) in [
            ("floppy", 0.356, [0.05, 38.0], [30.0, 300.0], 45.0),
            ("workhorse", 0.356, [0.1, 40.0], [30.0, 300.0], 60.0),
            ("stiff", 0.356, [1.5, 150.0], [20.0, 200.0], 45.0),
            ("035-j", 0.889, [1.0, 291.0], [30.0, 150.0], 180.0),
        ] {
            let wire = Wire::preset(name).unwrap();
            let grid = wire.grid();
            let sections = wire.sections(&grid);
            let at = |mm: f64| &sections[grid.partition_point(|&at| at < mm)];
            let near = |found: f64, expected: f64, what: &str| {
                assert!((found / expected - 1.0).abs() < 0.02, "{name}: {what} of {found} for {expected}");
            };
            near(at(0.5 * soft).ei, tip, "EI of the tip");
            near(at(taper + 20.0).ei, shaft, "EI of the shaft");
            // Half-way along the taper the logarithm is half-way.
            let middle = (tip * shaft).sqrt();
            let found = at(f64::midpoint(soft, taper)).ei;
            // The next node may be an element of 2 or 3 mm farther.
            assert!((found / middle - 1.0).abs() < 0.15, "{name}: EI of {found} in between for {middle}");
            for mm in [5.0, 100.0, 500.0] {
                // A solid round of Poisson's ratio 0.3.
                near(at(mm).gj, at(mm).ei / 1.3, "GJ");
                // 7.9 g/cm3 of steel.
                let mass = 7.9e-9 * PI * (diameter / 2.0_f64).powi(2) * at(mm).cell;
                near(at(mm).mass, mass, "mass");
            }
            // A core of nitinol or steel gives by far less than 1 % under 1 N.
            assert!(sections.iter().all(|section| (100.0..=2000.0).contains(&section.ea)), "{name}");
            let bend: f64 = sections.iter().map(|section| 2.0 * (section.rest[0] / 2.0).atan()).sum();
            near(bend.to_degrees(), degrees, "bend");
            assert!((sections.iter().map(|section| section.cell).sum::<f64>() - grid[grid.len() - 1]).abs() < 1.0);
        }
    }

    #[test]
    fn the_drag_is_what_its_formula_says() {
        // 4 mPa s is 4e-9 N s/mm2.
        let (viscosity, radius, lumen) = (4e-9, 0.178_f64, 2.5_f64);
        let (k, squared) = (lumen / radius, (lumen / radius).powi(2));
        let drag = 4.0 * PI * viscosity / (k.ln() - (squared - 1.0) / (squared + 1.0));
        assert!((BLOOD / drag - 1.0).abs() < 0.02, "{BLOOD} for {drag}");
        let wire = Wire::preset("workhorse").unwrap();
        let sections = wire.sections(&wire.grid());
        assert!(sections.iter().all(|section| (section.drag / section.cell / drag - 1.0).abs() < 0.02));
    }
}
