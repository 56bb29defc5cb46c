//! The fork that the wire missed: where its tip left the route, and into which branch. It is what a failure names.

use super::route::Route;
use lumen_message::messages;
use lumen_vessel::{BranchName, Tree};

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
    pub(super) fn words(&self, tree: &Tree, route: &Route) -> MissedForkText {
        let is_known = |branch: u32| (branch as usize) < tree.branches().len();
        let name = |branch: u32| match is_known(branch) {
            true => Taken::Known(BranchName::of_place(branch)),
            false => Taken::Another,
        };
        let (along, into) = (self.arc_mm, name(self.into));
        match self.right(tree, route) {
            Some(right) => MissedForkText::Fork { along, into, instead: name(right) },
            None => MissedForkText::Route { along, into },
        }
    }
}

messages! {
    /// The fork that a wire missed, as a clause.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub enum MissedForkText {
        /// It should have gone into another branch.
        "trial-missed-fork" Fork {
            /// Arc length along the route, in mm.
            along: f64 [0],
            /// The branch that it went into.
            into: Taken,
            /// The branch of the route.
            instead: Taken,
        } => "it missed the fork {along:.0} mm along the route, going into {into} instead of {instead}",
        /// No branch of the route meets the one that it went into.
        "trial-missed-route" Route {
            /// Arc length along the route, in mm.
            along: f64 [0],
            /// The branch that it went into.
            into: Taken,
        } => "it missed the fork {along:.0} mm along the route, going into {into} instead of following the route",
    }
}

messages! {
    /// The branch that a wire took or should have taken.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Taken {
        /// One that has no name.
        "trial-another-branch" Another => "another branch",
    } or {
        /// One of the tree.
        Known(BranchName),
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
            let words = fork.words(&tree, &route).to_string();
            assert!(
                words.starts_with("it missed the fork 40 mm along the route, ") && words.ends_with(&expected),
                "{words}"
            );
            // The lumen is 2 to 4 mm in radius.
            assert!(!fork.is_passed(&route, fork.arc_mm + 3.0) && fork.is_passed(&route, fork.arc_mm + 12.0));
        }
    }
}
