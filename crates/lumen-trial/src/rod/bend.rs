//! Second derivatives of what a rod's bend and twist at a node cost, by its two edges and their angles.
//!
//! Curvature and twist change with the edges as Bergou et al. give it ("Discrete viscous threads", 2010, appendix), so the
//! second derivatives here are all there are: with squares of the first ones alone corrections close in by a factor of 5
//! to 10 each, with these by the square.

use glam::{DMat3, DVec3};

use super::frame::{Edge, Strain};
use super::hessian::Hessian;
use super::section::Section;

/// The first derivatives at a node, by the edges before (`a`) and behind it (`b`).
pub(super) struct Slopes {
    /// Of half the square of the curvature.
    pub bent: [DVec3; 2],
    /// Of the twist; by the angles it is -1 and 1.
    pub twisted: [DVec3; 2],
}

/// Second derivatives by two edges and their angles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Blocks {
    /// By the edge before twice, by both, and by the one behind twice. The first and the last are symmetric.
    pub aa: DMat3,
    pub ab: DMat3,
    pub bb: DMat3,
    /// By an angle, and an edge.
    pub mixed: [[DVec3; 2]; 2],
    /// By the angles: before twice, both, behind twice.
    pub angles: [f64; 3],
}

/// `p q^T`.
#[inline]
fn outer(p: DVec3, q: DVec3) -> DMat3 {
    DMat3::from_cols(p * q.x, p * q.y, p * q.z)
}

/// `p q^T + q p^T`.
#[inline]
fn both(p: DVec3, q: DVec3) -> DMat3 {
    DMat3::from_cols(p * q.x + q * p.x, p * q.y + q * p.y, p * q.z + q * p.z)
}

/// The matrix of the cross product with `p` from the left.
#[inline]
fn crossing(p: DVec3) -> DMat3 {
    DMat3::from_cols(p.cross(DVec3::X), p.cross(DVec3::Y), p.cross(DVec3::Z))
}

impl Slopes {
    #[inline]
    pub(super) fn new(a: &Edge, b: &Edge, strain: &Strain) -> Self {
        let cosine = a.tangent.dot(b.tangent);
        let by_cosine = -4.0 * strain.inverse * strain.inverse;
        Self {
            bent: [
                (b.tangent - a.tangent * cosine) * (by_cosine * a.inverse),
                (a.tangent - b.tangent * cosine) * (by_cosine * b.inverse),
            ],
            twisted: [strain.binormal * (0.5 * a.inverse), strain.binormal * (0.5 * b.inverse)],
        }
    }
}

/// The curvatures towards the director and across. Each is half the binormal's part along one director of each edge:
/// those directors, and what they become when their edges turn.
fn curvatures(a: &Edge, b: &Edge, strain: &Strain) -> [(f64, [DVec3; 2], [DVec3; 2]); 2] {
    [(strain.towards, [a.m2, b.m2], [-a.m1, -b.m1]), (strain.across, [-a.m1, -b.m1], [-a.m2, -b.m2])]
}

/// The first derivatives of the curvatures towards the director and across, by the edges and by their angles.
pub(super) fn curvature_slopes(a: &Edge, b: &Edge, strain: &Strain) -> [([DVec3; 2], [f64; 2]); 2] {
    let middle = (a.tangent + b.tangent) * strain.inverse;
    curvatures(a, b, strain).map(|(curvature, directors, turned)| {
        let mean = (directors[0] + directors[1]) * strain.inverse;
        let by_edges = [
            (b.tangent.cross(mean) - middle * curvature) * a.inverse,
            (mean.cross(a.tangent) - middle * curvature) * b.inverse,
        ];
        (by_edges, turned.map(|turned| 0.5 * strain.binormal.dot(turned)))
    })
}

impl Blocks {
    /// Adds `stiffness g g^T`, `g` by the edges and the angles.
    #[inline]
    fn add_square(&mut self, [a, b]: [DVec3; 2], [angle_a, angle_b]: [f64; 2], stiffness: f64) {
        let (sa, sb) = (a * stiffness, b * stiffness);
        self.aa += outer(sa, a);
        self.ab += outer(sa, b);
        self.bb += outer(sb, b);
        self.mixed[0][0] += sa * angle_a;
        self.mixed[0][1] += sb * angle_a;
        self.mixed[1][0] += sa * angle_b;
        self.mixed[1][1] += sb * angle_b;
        self.angles[0] += stiffness * angle_a * angle_a;
        self.angles[1] += stiffness * angle_a * angle_b;
        self.angles[2] += stiffness * angle_b * angle_b;
    }

    /// Those of the bend and the twist at a node.
    pub(super) fn new(
        a: &Edge,
        b: &Edge,
        section: &Section,
        strain: &Strain,
        slopes: &Slopes,
        hessian: Hessian,
    ) -> Self {
        let (bend, twist) = (section.ei / section.cell, section.gj / section.cell);
        let [r1, r2] = section.rest;
        if hessian == Hessian::Exact {
            let mut blocks = Self::exact(a, b, strain, slopes, bend, twist);
            if section.rest != [0.0; 2] {
                blocks.add_rest(a, b, strain, [-bend * r1, -bend * r2]);
            }
            return blocks;
        }
        let mut blocks =
            Self { aa: DMat3::ZERO, ab: DMat3::ZERO, bb: DMat3::ZERO, mixed: [[DVec3::ZERO; 2]; 2], angles: [0.0; 3] };
        blocks.add_square(slopes.twisted, [-1.0, 1.0], twist);
        // It is the rest shape that turns with the edges, so that nothing holds a straight wire from turning in a bend.
        let [(towards, _), (across, _)] = curvature_slopes(a, b, strain);
        blocks.add_square(towards, [0.5 * r2; 2], bend);
        blocks.add_square(across, [-0.5 * r1; 2], bend);
        blocks
    }

    /// All of them but what a rest shape adds, with the stiffness against bending and twist: of half the square of the
    /// curvature, which is `2 (1 - x) / (1 + x)` with the cosine `x` of the turn, and of half that of the twist.
    #[inline]
    fn exact(a: &Edge, b: &Edge, strain: &Strain, slopes: &Slopes, bend: f64, twist: f64) -> Self {
        let (ta, tb) = (a.tangent, b.tangent);
        let (la, lb) = (a.inverse, b.inverse);
        let x = ta.dot(tb);
        let (inverse, torque) = (strain.inverse, twist * strain.twist);
        let first = -4.0 * inverse * inverse * bend;
        let second = -2.0 * inverse * first;
        let (u, v) = ((tb - ta * x) * la, (ta - tb * x) * lb);
        let middle = (ta + tb) * inverse;
        let [pa, pb] = slopes.twisted;
        // Of one edge twice: bending about it, and its turn out of the plane of the two.
        let twice = [(ta, la, u, pa), (tb, lb, v, pb)].map(|(t, l, u, p)| {
            let (across, q) = (first * x * l * l, (t + middle) * (0.5 * l * torque));
            let by_u = u * second - t * (first * l);
            let by_t = t * across - u * (first * l);
            let by_p = p * twist - q;
            let column = |i: usize| by_u * u[i] + by_t * t[i] + by_p * p[i] - p * q[i];
            DMat3::from_cols(column(0), column(1), column(2)) - DMat3::from_diagonal(DVec3::splat(across))
        });
        let both = first * la * lb;
        let ab = DMat3::from_diagonal(DVec3::splat(both)) + outer(u, v * second)
            - outer(ta, (ta - tb * x) * both)
            - outer(tb, tb * both)
            + outer(pa, pb * twist - middle * (lb * torque))
            + crossing(ta * (la * lb * inverse * torque));
        let mixed = [[pa * -twist, pb * -twist], [pa * twist, pb * twist]];
        Self { aa: twice[0], ab, bb: twice[1], mixed, angles: [twist, -twist, twist] }
    }

    /// Of the curvatures towards the director and across, times a moment each.
    fn add_rest(&mut self, a: &Edge, b: &Edge, strain: &Strain, moments: [f64; 2]) {
        let (ta, tb) = (a.tangent, b.tangent);
        let (la, lb) = (a.inverse, b.inverse);
        let Strain { inverse, binormal, .. } = *strain;
        let middle = (ta + tb) * inverse;
        let one = DMat3::IDENTITY;
        for ((k, [da, db], [ea, eb]), moment) in curvatures(a, b, strain).into_iter().zip(moments) {
            let mean = (da + db) * inverse;
            let (by_a, by_b) = (tb.cross(mean), -ta.cross(mean));
            let twice = outer(middle, middle) * (2.0 * k);
            let across = |t: DVec3| (one - outer(t, t)) * (k * inverse);
            self.aa += (twice - both(by_a, middle) - across(ta) + both(binormal, da) * 0.25) * (moment * la * la);
            self.bb += (twice - both(by_b, middle) - across(tb) + both(binormal, db) * 0.25) * (moment * lb * lb);
            self.ab += (twice
                - outer(by_a, middle)
                - outer(middle, by_b)
                - (one + outer(ta, tb)) * (k * inverse)
                - crossing(mean))
                * (moment * la * lb);
            for (angle, (d, e)) in [(da, ea), (db, eb)].into_iter().enumerate() {
                self.mixed[angle][0] += (tb.cross(e) * inverse - middle * (0.5 * binormal.dot(e))) * (moment * la);
                self.mixed[angle][1] += (-ta.cross(e) * inverse - middle * (0.5 * binormal.dot(e))) * (moment * lb);
                self.angles[2 * angle] -= 0.5 * binormal.dot(d) * moment;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Rod;
    use super::*;

    /// A rod of five nodes, bent and twisted, and bent at rest.
    fn rod() -> Rod {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [1.9, 0.4, 0.2], [2.7, 0.9, 0.1], [3.4, 1.6, -0.3]];
        let rest = [[0.0, 0.0], [0.2, -0.3], [0.0, 0.0], [-0.4, 0.1], [0.0, 0.0]];
        let section = |rest| Section { length: 0.95, cell: 0.9, ei: 1.3, gj: 0.8, ea: 7.0, rest, ..Section::default() };
        let mut rod = Rod::new(positions.map(DVec3::from).to_vec(), rest.map(section).to_vec(), DVec3::Z);
        (0..5).for_each(|i| rod.turn_to(i, 0.3 * (i * i) as f64));
        rod.refresh();
        // Second derivatives are by turns from where the frames are.
        rod.finish(f64::INFINITY);
        rod
    }

    #[test]
    fn second_derivatives_are_the_differences_of_the_first() {
        let rod = rod();
        let slopes = |rod: &mut Rod| {
            rod.refresh();
            rod.assemble(f64::INFINITY, 0.0, Hessian::Exact);
            rod.gradient.clone()
        };
        let mut exact = rod.clone();
        slopes(&mut exact);
        let h = 1e-5;
        let differences = |row: usize| -> Vec<f64> {
            let moved = |by: f64| {
                let mut rod = rod.clone();
                if row % 4 == 3 {
                    rod.spins[row / 4] += by;
                } else {
                    rod.positions[row / 4][row % 4] += by;
                }
                slopes(&mut rod)
            };
            moved(h).iter().zip(moved(-h)).map(|(more, less)| (more - less) / (2.0 * h)).collect()
        };
        let found: Vec<Vec<f64>> = (0..19).map(differences).collect();
        for (row, by_row) in found.iter().enumerate() {
            for (column, by_column) in found.iter().enumerate() {
                // What is carried along two ways comes to two places: a turn about both, which has no symmetric part.
                let expected = f64::midpoint(by_row[column], by_column[row]);
                let entry = exact.band.entry(row, column);
                assert!((entry - expected).abs() < 1e-6, "{row} {column}: {entry} for {expected}");
            }
        }
    }
}
