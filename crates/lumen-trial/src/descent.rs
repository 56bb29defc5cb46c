//! The way down in a step: the change of the rod at which the quadratic model of its energy, and contacts and friction as
//! they are along it, come to rest.
//!
//! Elastic energy is nearly quadratic over a step, and contacts are anything but: most of what a step must find out is
//! which contacts press and which stick. So a correction solves the whole problem with contacts in it, for the one
//! model, before it looks at the rod again: the convex problem within an augmented Lagrangian's round (Nocedal and
//! Wright, "Numerical optimization", 2006, section 17.4), by Newton's method with a line search along each search direction.
//! A direction costs one factorisation; nothing of the rod is worked out anew. Where only the rod knew of contacts, each
//! new one on the way cut a correction short, down to a hundredth, and the next began with the same direction but for
//! that one.

use super::contact::{Link, Spring, Springs};
use super::rod::{Coupling, Hessian, Rod};

/// Search directions in a correction.
const DIRECTIONS: usize = 8;
/// The part of the slope that the line search may leave at its end.
const LEVEL: f64 = 0.1;
/// Looks of a line search.
const LOOKS: usize = 60;

/// What came of a descent.
#[derive(Clone, Copy, Debug)]
pub(super) struct Descent {
    /// The largest move of a node in the change, in mm; infinite when there is no answer.
    pub(super) moved: f64,
    /// At most by what the potential should fall, as a negative number of N mm.
    pub(super) fall: f64,
    /// Whether the model and its contacts are at rest there.
    pub(super) is_settled: bool,
}

/// Finds the change of an assembled rod, for [`Rod::advance`]. `None` when the matrix is not positive definite.
pub(super) fn descend(rod: &mut Rod, springs: &mut Springs, hessian: Hessian) -> Option<Descent> {
    rod.begin_change();
    let mut live: Vec<Spring> = Vec::with_capacity(springs.closed.len());
    let (mut fall, mut gone, mut is_settled) = (0.0, 0.0, false);
    for _ in 0..DIRECTIONS {
        rod.begin_direction();
        springs.closed.iter_mut().for_each(|spring| spring.add(rod));
        let couplings: Vec<Coupling> = springs.links.iter_mut().filter_map(|link| link.add(rod)).collect();
        let direction = rod.solve_coupled(hessian, &couplings)?;
        springs.close(rod, gone, direction.moved);
        springs.closed.iter_mut().for_each(|spring| spring.look_ahead(rod));
        springs.links.iter_mut().for_each(|link| link.look_ahead(rod));
        let links = &springs.links;
        live.clear();
        live.extend(springs.closed.iter().filter(|spring| spring.is_live(direction.most)));
        // Of the rod alone: its slope where the direction begins, and by what that changes on the whole of it.
        let springs_at = |part: f64| {
            let of_links: f64 = links.iter().map(|link| link.slope(part)).sum();
            live.iter().map(|spring| spring.slope(part)).sum::<f64>() + of_links
        };
        let first = direction.slope - springs_at(0.0);
        let added = live.iter().map(Spring::added).sum::<f64>() + links.iter().map(Link::added).sum::<f64>();
        let rise = -direction.slope - added;
        let part = line_search(direction.most, |part| first + part * rise + springs_at(part));
        if !(direction.moved.is_finite() && part.is_finite()) {
            return Some(Descent { moved: f64::INFINITY, fall: 0.0, is_settled: false });
        }
        fall += part * direction.slope;
        rod.go(part, live.iter().flat_map(Spring::changed).chain(links.iter().flat_map(Link::changed)));
        is_settled = part >= 1.0;
        gone += part * direction.moved;
        for spring in &mut springs.closed {
            is_settled &= !spring.go(part);
        }
        for link in &mut springs.links {
            is_settled &= !link.go(part);
        }
        // A direction that is too long for the model ends the correction.
        if is_settled || (direction.most < 1.0 && part >= direction.most) {
            break;
        }
    }
    Some(Descent { moved: rod.largest_move(), fall, is_settled })
}

/// Where the slope along a search direction is level, at most at `most`; by false position and by halves in turn, as the
/// one alone stalls before a stiff contact.
fn line_search(most: f64, slope: impl Fn(f64) -> f64) -> f64 {
    let (mut from, mut at_from) = (0.0, slope(0.0));
    let (mut to, mut at_to) = (most, slope(most));
    let enough = LEVEL * at_from.abs();
    if at_to <= enough {
        return most;
    }
    for look in 0..LOOKS {
        let part =
            if look % 2 == 0 { (from * at_to - to * at_from) / (at_to - at_from) } else { f64::midpoint(from, to) };
        let here = slope(part);
        if here.abs() <= enough {
            return part;
        }
        if here > 0.0 {
            (to, at_to) = (part, here);
        } else {
            (from, at_from) = (part, here);
        }
    }
    from
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::contact::{Open, spread};
    use crate::rod::{Fixed, Section};

    /// Where a cantilever of 20 nodes comes to that is pushed on a floor below it, whose contacts are all looked at from
    /// the start, or once a search direction closes them; and how many press.
    fn rest(is_open: bool) -> (Vec<DVec3>, usize) {
        let section =
            Section { length: 0.5, cell: 0.5, ei: 1.0, gj: 1.0, ea: 1000.0, drag: 1e-6, ..Section::default() };
        let positions: Vec<DVec3> = (0..20).map(|i| DVec3::X * (0.5 * f64::from(i))).collect();
        let mut rod = Rod::new(positions, vec![section; 20], DVec3::Y);
        (18..20).for_each(|i| rod.fixed[i] = Fixed { position: true, angle: true });
        rod.forces = (0..18).map(|i| (i, DVec3::Z * -2e-3)).collect();
        rod.assemble(f64::INFINITY, 0.0, Hessian::Exact);
        let mut springs = Springs::default();
        for i in 0..19 {
            // A floor that rises towards the tip, and more of it out of reach.
            for gap in [0.02 + 0.002 * i as f64, 0.5, 20.0] {
                let (force, stiff) = (-4.0 * gap, 4.0);
                if is_open {
                    springs.open.push(Open::new(i, 0.25, DVec3::Z, force, stiff));
                } else {
                    springs.closed.push(Spring::new(i, spread(DVec3::Z, 0.0, 0.25), force, stiff));
                }
            }
        }
        let descent = descend(&mut rod, &mut springs, Hessian::Exact).unwrap();
        assert!(descent.is_settled && descent.fall < 0.0, "{descent:?}");
        rod.advance(1.0);
        (rod.positions, springs.closed.iter().filter(|spring| spring.is_closed()).count())
    }

    #[test]
    fn a_contact_that_a_direction_closes_counts_as_if_it_had_been_looked_at_all_along() {
        let ((all, pressing), (found, as_many)) = (rest(false), rest(true));
        assert!(pressing > 1 && pressing == as_many, "{pressing} {as_many}");
        for (a, b) in all.iter().zip(&found) {
            assert!(a.distance(*b) < 1e-12, "{a} {b}");
        }
        // 0.036 N on a floor of 4 N/mm.
        assert!(found[0].z < -0.02 && found[0].z > -0.05, "{}", found[0].z);
    }
}
