//! Disjoint sets of numbers: who is in one set with whom (union by the smaller number, paths halved on the way; Tarjan 1975).
//!
//! A set is known by its smallest number, so the result does not depend on the order of the unions.

/// `count` sets of one number each: the parent of every number, which is itself.
pub(crate) fn singles(count: usize) -> Vec<u32> {
    (0..count as u32).collect()
}

/// The smallest number in the set of `of`.
pub fn root(parent: &mut [u32], mut of: u32) -> u32 {
    while parent[of as usize] != of {
        let up = parent[parent[of as usize] as usize];
        parent[of as usize] = up;
        of = up;
    }
    of
}

/// Joins the sets of `a` and `b`; the root of both, or `None` where they were one already.
pub fn union(parent: &mut [u32], a: u32, b: u32) -> Option<u32> {
    let (a, b) = (root(parent, a), root(parent, b));
    parent[a.max(b) as usize] = a.min(b);
    (a != b).then_some(a.min(b))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_are_known_by_their_smallest_number() {
        let mut parent = singles(6);
        assert_eq!(union(&mut parent, 5, 3), Some(3));
        assert_eq!(union(&mut parent, 4, 5), Some(3));
        assert_eq!(union(&mut parent, 3, 4), None);
        assert_eq!(union(&mut parent, 1, 4), Some(1));
        let roots: Vec<u32> = (0..6).map(|i| root(&mut parent, i)).collect();
        assert_eq!(roots, [0, 1, 2, 1, 1, 1]);
    }
}
