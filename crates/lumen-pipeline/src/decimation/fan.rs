//! The triangles around a vertex put in order: one fan where the surface is a disc or half-disc there, several where it
//! is not.
//!
//! Both ends of an edge must agree whether it is a plain one: of a single triangle, or of two that run it in opposite
//! directions. So a walk around a vertex that passes a neighbour twice is no fan, even where it takes in every triangle
//! and closes: the neighbour sees an edge of four triangles there, and is cut.

use std::collections::BTreeMap;

use lumen_mesh::{Topology, opposite};

/// Triangles around a vertex, on their way to a ring: each as the two other corners, in its winding, and its number.
#[derive(Default)]
pub(super) struct Fan {
    pub(super) spokes: Vec<[u32; 3]>,
    pub(super) is_closed: bool,
}

/// Above this many spokes a ring is put in order by sorting.
const FEW: usize = 24;

impl Fan {
    pub(super) fn load(&mut self, v: u32, around: &[u32], triangles: &[[u32; 3]]) {
        self.spokes.clear();
        self.spokes.extend(around.iter().map(|&t| spoke(triangles[t as usize], v, t)));
    }

    /// Puts the spokes in order. Returns false where they do not form one disc or half-disc of consistent winding.
    pub(super) fn order(&mut self) -> bool {
        let spokes = &mut self.spokes;
        let n = spokes.len();
        if n == 0 {
            return false;
        }
        if n > FEW {
            return self.order_many();
        }
        // At a boundary the first spoke is the one that no other leads to.
        let mut firsts = (0..n).filter(|&i| spokes.iter().all(|s| s[1] != spokes[i][0]));
        let first = firsts.next();
        if first.is_some() && firsts.next().is_some() {
            return false;
        }
        drop(firsts);
        self.is_closed = first.is_none();
        spokes.swap(0, first.unwrap_or(0));
        for i in 1..n {
            let wanted = spokes[i - 1][1];
            let mut next = (i..n).filter(|&j| spokes[j][0] == wanted);
            let (Some(found), None) = (next.next(), next.next()) else { return false };
            drop(next);
            spokes.swap(i, found);
        }
        let last = spokes[n - 1][1];
        if !self.is_closed {
            return spokes.iter().all(|s| s[0] != last);
        }
        // Where the first spoke begins no other may; and two triangles back to back are no disc.
        n > 2 && last == spokes[0][0] && spokes[1..].iter().all(|s| s[0] != last)
    }

    /// [`Self::order`] in n log n.
    fn order_many(&mut self) -> bool {
        let spokes = &mut self.spokes;
        spokes.sort_unstable();
        let mut ends: Vec<u32> = spokes.iter().map(|s| s[1]).collect();
        ends.sort_unstable();
        let twice = spokes.windows(2).any(|s| s[0][0] == s[1][0]) || ends.windows(2).any(|e| e[0] == e[1]);
        let mut firsts = spokes.iter().filter(|s| ends.binary_search(&s[0]).is_err());
        let first = firsts.next().copied();
        if twice || firsts.next().is_some() {
            return false;
        }
        self.is_closed = first.is_none();
        let mut ordered = vec![first.unwrap_or(spokes[0])];
        while ordered.len() < spokes.len() {
            let wanted = ordered[ordered.len() - 1][1];
            match spokes.binary_search_by_key(&wanted, |s| s[0]) {
                Ok(next) if spokes[next] != ordered[0] => ordered.push(spokes[next]),
                _ => return false,
            }
        }
        self.spokes = ordered;
        true
    }

    /// The neighbours in order.
    pub(super) fn entries(&self) -> impl Iterator<Item = u32> + '_ {
        let last = self.spokes.last().filter(|_| !self.is_closed).map(|s| s[1]);
        self.spokes.iter().map(|s| s[0]).chain(last)
    }
}

/// The other two corners of a triangle, in its winding, after corner `v`, and its number `t`.
fn spoke(triangle: [u32; 3], v: u32, t: u32) -> [u32; 3] {
    let [next, last] = opposite(triangle, v);
    [next, last, t]
}

/// The fans around a complex vertex, each in order with whether it closes: triangles belong together where they share
/// an edge that just those two use, in opposite directions.
pub(super) fn fans_of(v: u32, topology: &Topology, triangles: &[[u32; 3]]) -> Vec<(Vec<[u32; 3]>, bool)> {
    let mut spokes: Vec<[u32; 3]> = topology.triangles(v).iter().map(|&t| spoke(triangles[t as usize], v, t)).collect();
    spokes.sort_unstable();
    let is_inner = |n: u32| topology.edge(v, n).is_some_and(|edge| edge.forward == 1 && edge.backward == 1);
    let starting_at = |n: u32| spokes.binary_search_by_key(&n, |s| s[0]).ok();
    let ends: BTreeMap<u32, usize> = spokes.iter().enumerate().map(|(i, s)| (s[1], i)).collect();
    let mut taken = vec![false; spokes.len()];
    let mut fans = Vec::new();
    for i in 0..spokes.len() {
        if taken[i] {
            continue;
        }
        // Back to the first spoke of the fan, or once around.
        let mut first = i;
        let mut is_closed = false;
        while is_inner(spokes[first][0]) {
            first = ends[&spokes[first][0]];
            if first == i {
                is_closed = true;
                break;
            }
        }
        let mut fan = Vec::new();
        let mut next = Some(first);
        while let Some(at) = next.filter(|&at| !taken[at]) {
            taken[at] = true;
            fan.push(spokes[at]);
            next = if is_inner(spokes[at][1]) { starting_at(spokes[at][1]) } else { None };
        }
        fans.push((fan, is_closed));
    }
    fans
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The triangles at vertex 0 that have these others, in this order.
    fn fan(others: &[[u32; 2]]) -> (Fan, Vec<[u32; 3]>) {
        let triangles: Vec<[u32; 3]> = others.iter().map(|&[a, b]| [0, a, b]).collect();
        let mut fan = Fan::default();
        fan.load(0, &(0..triangles.len() as u32).collect::<Vec<_>>(), &triangles);
        (fan, triangles)
    }

    #[test]
    fn discs_and_half_discs_are_ordered_from_any_triangle() {
        for sides in [3, 5, 24, 25, 40] {
            for start in 0..sides {
                let mut others: Vec<[u32; 2]> = (0..sides).map(|i| [1 + i, 1 + (i + 1) % sides]).collect();
                others.rotate_left(start as usize);
                let (mut closed, _) = fan(&others);
                assert!(closed.order() && closed.is_closed);
                assert_eq!(closed.entries().count(), sides as usize);
                let (mut open, _) = fan(&others[1..]);
                assert!(open.order() && !open.is_closed);
                assert_eq!(open.entries().next(), Some(others[1][0]));
                assert_eq!(open.entries().count(), sides as usize);
            }
        }
    }

    #[test]
    fn two_discs_that_have_an_edge_in_common_are_no_fan() {
        // The walk 1 2 3 1 4 5 takes in all six triangles and comes back to where it began.
        let pair = [[1, 2], [2, 3], [3, 1], [1, 4], [4, 5], [5, 1]];
        for start in 0..pair.len() {
            let mut others = pair;
            others.rotate_left(start);
            assert!(!fan(&others).0.order(), "{others:?}");
        }
    }

    #[test]
    fn two_triangles_back_to_back_are_no_disc() {
        assert!(!fan(&[[1, 2], [2, 1]]).0.order());
    }

    /// Whether triangles form a fan, straight from the definition: no neighbour is twice first or twice second, three
    /// triangles at least close a disc, and each is reached from any other over common edges.
    fn is_fan(others: &[[u32; 2]]) -> bool {
        let is_single = |side: usize| {
            let mut seen: Vec<u32> = others.iter().map(|pair| pair[side]).collect();
            seen.sort_unstable();
            seen.windows(2).all(|pair| pair[0] != pair[1])
        };
        let mut reached = vec![false; others.len()];
        let mut stack = vec![0];
        while let Some(i) = stack.pop() {
            if !std::mem::replace(&mut reached[i], true) {
                stack.extend(
                    (0..others.len()).filter(|&j| others[i][1] == others[j][0] || others[i][0] == others[j][1]),
                );
            }
        }
        let is_closed = others.iter().all(|pair| others.iter().any(|other| other[0] == pair[1]));
        is_single(0) && is_single(1) && reached.iter().all(|&reached| reached) && (!is_closed || others.len() > 2)
    }

    proptest! {
        #[test]
        fn a_fan_is_what_the_definition_says(
            walks in prop::collection::vec(prop::collection::vec(1u32..9, 2..7), 1..4), turn in 0usize..30, many in any::<bool>(),
        ) {
            // Walks over few vertices, so that they meet; and the same around a hub.
            let mut others: Vec<[u32; 2]> = walks.iter().flat_map(|walk| walk.windows(2).map(|w| [w[0], w[1]])).collect();
            others.retain(|pair| pair[0] != pair[1]);
            if let (true, Some(&[_, last])) = (many, others.last()) {
                others.extend((0..FEW as u32).map(|i| [if i == 0 { last } else { 100 + i }, 101 + i]));
            }
            prop_assume!(!others.is_empty());
            let turn = turn % others.len();
            others.rotate_left(turn);
            let (mut fan, triangles) = fan(&others);
            let expected = is_fan(&others);
            prop_assert_eq!(fan.order(), expected);
            let whole = fans_of(0, &Topology::new(200, &triangles), &triangles);
            // Cut into fans, none is lost and none is there twice.
            let mut found: Vec<u32> = whole.iter().flat_map(|(spokes, _)| spokes.iter().map(|s| s[2])).collect();
            found.sort_unstable();
            prop_assert_eq!(found, (0..triangles.len() as u32).collect::<Vec<_>>());
            prop_assert!(!expected || whole.len() == 1);
        }
    }
}
