//! The triangles around a vertex put in order: one fan where the surface is a disc or half-disc there, several where it
//! is not.

use std::collections::BTreeMap;

use crate::mesh::Topology;

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
        if self.is_closed { last == spokes[0][0] } else { spokes.iter().all(|s| s[0] != last) }
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
    let [a, b, c] = triangle;
    if a == v {
        [b, c, t]
    } else if b == v {
        [c, a, t]
    } else {
        [a, b, t]
    }
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
