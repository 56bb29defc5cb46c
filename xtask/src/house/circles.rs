//! Circles of files: those that use each other, directly or round about.

use std::collections::{BTreeMap, BTreeSet};

use super::program::Uses;

/// The files that lie on circles: each set of those that all reach each other.
pub(super) fn circles(uses: &Uses) -> Vec<BTreeSet<String>> {
    let reached: Vec<(&String, BTreeSet<&String>)> = uses.keys().map(|file| (file, reach(uses, file))).collect();
    let mut circles: Vec<BTreeSet<String>> = Vec::new();
    for (file, from) in &reached {
        if !from.contains(file) || circles.iter().any(|circle| circle.contains(*file)) {
            continue;
        }
        let back = reached.iter().filter(|(other, others)| from.contains(other) && others.contains(file));
        circles.push(back.map(|(other, _)| (*other).clone()).collect());
    }
    circles
}

/// What a file uses, and what that uses, and so on.
fn reach<'a>(uses: &'a Uses, file: &String) -> BTreeSet<&'a String> {
    let mut reached = BTreeSet::new();
    let mut open: Vec<&String> = uses.get(file).into_iter().flat_map(BTreeMap::keys).collect();
    while let Some(next) = open.pop() {
        if reached.insert(next) {
            open.extend(uses.get(next).into_iter().flat_map(BTreeMap::keys));
        }
    }
    reached
}
