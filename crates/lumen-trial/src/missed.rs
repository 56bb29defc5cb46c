//! The fork that the wire missed: where its tip left the route, and into which branch. It is what a failure names.

use super::route::{Route, called};
use lumen_language::decimal;
use lumen_language::say;
use lumen_vessel::Tree;

/// A tip on the route is past a fork this many radii of the lumen behind it.
const PAST: f64 = 2.0;

/// Where the tip left the route.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct MissedFork {
    /// Arc length along the route, in mm.
    pub(super) arc_mm: f64,
    /// The branch that it went into: its place in [`Tree::branches`].
    pub(super) into: u32,
}

impl MissedFork {
    /// Whether a tip on the route, at an arc length in mm, has found its way past it.
    pub(super) fn is_passed(&self, route: &Route, arc_mm: f64) -> bool {
        arc_mm > self.arc_mm + PAST * route.at(self.arc_mm).radius
    }

    /// The branch that it should have gone into: the last of the route that meets the wrong one in a fork.
    fn right(&self, tree: &Tree, route: &Route) -> Option<u32> {
        let parent = |branch: u32| tree.branches().get(branch as usize)?.parent;
        let of_wrong = parent(self.into);
        let meets = |&branch: &u32| {
            let own = parent(branch);
            own == Some(self.into) || of_wrong == Some(branch) || of_wrong.is_some() && own == of_wrong
        };
        route.branches.iter().rev().copied().find(meets)
    }

    /// What is said of it, without a full stop.
    pub(super) fn words(&self, tree: &Tree, route: &Route) -> String {
        let is_known = |branch: u32| (branch as usize) < tree.branches().len();
        let name = |branch: u32| if is_known(branch) { called(branch) } else { say!("trial-another-branch") };
        let (along, into) = (decimal(self.arc_mm, 0), name(self.into));
        match self.right(tree, route) {
            Some(right) => say!("trial-missed-fork", along = along, into = into, instead = name(right)),
            None => say!("trial-missed-route", along = along, into = into),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::route::Routes as _;
    use lumen_mesh::shapes::fork;

    #[test]
    fn a_missed_fork_is_named_by_the_branch_that_was_taken_and_the_one_that_was_not() {
        let (mesh, [bottom, joint, left, right]) = fork();
        let tree = Tree::new(&mesh).unwrap();
        let of = |end: glam::DVec3| tree.locate(joint.lerp(end, 0.8), None).unwrap().branch;
        let name = |end| tree.branches()[of(end) as usize].name.clone();
        for (from, to, wrong) in [(bottom, left, right), (bottom, right, left), (right, left, bottom)] {
            let route = tree.route(from.as_vec3(), to.as_vec3()).unwrap();
            let fork = MissedFork { arc_mm: joint.distance(from), into: of(wrong) };
            let expected = format!("going into {} instead of {}", name(wrong), name(to));
            let words = fork.words(&tree, &route);
            assert!(
                words.starts_with("it missed the fork 40 mm along the route, ") && words.ends_with(&expected),
                "{words}"
            );
            // The lumen is 2 to 4 mm in radius.
            assert!(!fork.is_passed(&route, fork.arc_mm + 3.0) && fork.is_passed(&route, fork.arc_mm + 12.0));
        }
    }
}
