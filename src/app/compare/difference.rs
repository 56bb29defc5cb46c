//! How far the other surfaces of a comparison are from the first, as the engine finds it for one after another. It draws
//! nothing.

use std::sync::Arc;

use crate::engine::Differed;
use crate::mesh::{TriMesh, Vec3};
use crate::pipeline::deviation::Deviation;

/// The first surface and another.
pub(super) type Pair = [Arc<TriMesh>; 2];

/// Surfaces that differ by no more are the same but for rounding, in mm.
const NOTHING_MM: f64 = 1e-3;

/// How many diameters of the vessel are seen where surfaces differ, how much at least and at most, in mm, and where the
/// diameter is not known.
const DIAMETERS: f32 = 3.0;
const SEEN_MM: [f32; 2] = [8.0, 120.0];
const UNKNOWN_MM: f32 = 20.0;

/// How far a surface is from the first.
#[derive(Clone, Debug)]
pub struct Difference {
    pair: Pair,
    /// For each of its vertices the mean distance around it, in mm; empty where one of the two has no area.
    pub by_vertex: Arc<Vec<f32>>,
    /// The numbers, where both have an area.
    pub deviation: Option<Deviation>,
    /// The diameter of the first one's lumen where they are farthest apart, in mm, where it has one there.
    pub width_mm: Option<f32>,
}

impl Difference {
    /// The largest distance in mm.
    pub fn most_mm(&self) -> f64 {
        self.deviation.map_or(0.0, |deviation| deviation.max)
    }

    /// Where it is, and how much to see there, in mm: a few diameters of the vessel. `None` where they do not differ.
    pub fn patch(&self) -> Option<(Vec3, f32)> {
        let deviation = self.deviation.filter(|deviation| deviation.max > NOTHING_MM)?;
        let seen = self.width_mm.map_or(UNKNOWN_MM, |width| DIAMETERS * width);
        Some((deviation.max_at_mm[0].into(), seen.clamp(SEEN_MM[0], SEEN_MM[1])))
    }
}

/// What is known, and what the engine was asked.
#[derive(Debug, Default)]
pub(super) struct Differences {
    found: Vec<Difference>,
    asked: Option<(u64, Pair)>,
    is_stopped: bool,
}

impl Differences {
    /// What is known of a pair.
    pub(super) fn of(&self, first: &Arc<TriMesh>, other: &Arc<TriMesh>) -> Option<&Difference> {
        self.found.iter().find(|found| Arc::ptr_eq(&found.pair[0], first) && Arc::ptr_eq(&found.pair[1], other))
    }

    /// The one of `pairs` that the engine is to measure now, as number `id`, if it is to be asked; others are forgotten.
    pub(super) fn next(&mut self, pairs: &[Pair], id: u64) -> Option<Pair> {
        let is_there = |of: &Pair| pairs.iter().any(|pair| pair.iter().zip(of).all(|(a, b)| Arc::ptr_eq(a, b)));
        self.found.retain(|found| is_there(&found.pair));
        self.asked.take_if(|(_, pair)| !is_there(pair));
        if self.is_stopped || self.asked.is_some() {
            return None;
        }
        let next = pairs.iter().find(|[first, other]| self.of(first, other).is_none())?.clone();
        self.asked = Some((id, next.clone()));
        Some(next)
    }

    /// Takes an answer; one to an older question is passed over.
    pub(super) fn receive(&mut self, differed: Differed) {
        let Differed { id, by_vertex, deviation, width_mm } = differed;
        if let Some((_, pair)) = self.asked.take_if(|(asked, _)| *asked == id) {
            self.found.push(Difference { pair, by_vertex: Arc::new(by_vertex), deviation, width_mm });
        }
    }

    /// Whether the engine owes an answer.
    pub(super) fn is_busy(&self) -> bool {
        self.asked.is_some()
    }

    /// The engine knows nothing of what it was asked for.
    pub(super) fn forget_request(&mut self) {
        self.asked = None;
    }

    /// Asks for nothing more, or goes on.
    pub(super) fn set_stopped(&mut self, is_stopped: bool) {
        self.is_stopped = is_stopped;
        if is_stopped {
            self.asked = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(id: u64, most: f64) -> Differed {
        let deviation = Deviation { mean: 0.1, rms: 0.1, p95: 0.2, max: most, max_at_mm: [[1.0; 3]; 2] };
        Differed { id, by_vertex: vec![0.1], deviation: Some(deviation), width_mm: Some(5.0) }
    }

    #[test]
    fn each_pair_is_asked_for_once_and_anew_when_the_first_is_another() {
        let [a, b, c] = [(); 3].map(|()| Arc::new(TriMesh::default()));
        let pairs = [[a.clone(), b.clone()], [a.clone(), c.clone()]];
        let mut differences = Differences::default();
        assert!(Arc::ptr_eq(&differences.next(&pairs, 1).unwrap()[1], &b));
        assert!(differences.next(&pairs, 2).is_none(), "one at a time");
        differences.receive(answer(7, 1.0));
        assert!(differences.is_busy(), "an answer to another question");
        differences.receive(answer(1, 1.0));
        assert!(Arc::ptr_eq(&differences.next(&pairs, 2).unwrap()[1], &c));
        differences.receive(answer(2, 1.0));
        assert!(differences.next(&pairs, 3).is_none() && differences.of(&a, &b).and(differences.of(&a, &c)).is_some());
        let turned = [[b.clone(), c.clone()]];
        assert!(differences.next(&turned, 3).is_some() && differences.of(&a, &b).is_none());
        differences.set_stopped(true);
        assert!(differences.next(&turned, 4).is_none() && !differences.is_busy());
    }

    #[test]
    fn a_few_diameters_are_seen_and_nothing_where_there_is_no_difference() {
        let [a, b] = [(); 2].map(|()| Arc::new(TriMesh::default()));
        let of = |most| {
            let mut differences = Differences::default();
            differences.next(&[[a.clone(), b.clone()]], 1);
            differences.receive(answer(1, most));
            differences.of(&a, &b).unwrap().patch()
        };
        assert_eq!(of(0.3), Some((Vec3::ONE, 15.0)));
        assert_eq!(of(1e-5), None);
    }
}
