//! What wire and target are proposed where nobody has said any.

use super::route::{Proposals as _, Routes as _, Target};
use super::wire::Wire;
use lumen_mesh::Vec3;
use lumen_vessel::Tree;

/// The lumen is so many times as wide as the wire all along to a target that is proposed.
const ROOM: f64 = 1.5;
/// A wire of 0.035 in is proposed for a way of at least this usual radius, in mm, and as far as it comes: past small
/// branches it goes straight on, and at forks its long bend reaches to the other side of a wide lumen.
const WIDE: f64 = 2.0;
/// Unless it comes less far than this part of where one of 0.014 in comes.
const PART: f64 = 0.5;

/// The best target that a wire can reach.
pub(super) fn reached(tree: &Tree, from: Vec3, wire: &Wire) -> Option<Target> {
    tree.targets(from, ROOM * wire.diameter_mm).into_iter().next()
}

/// The wire for the way to a target; without one, for the best that it can reach, and that.
pub(super) fn proposed(tree: &Tree, from: Vec3, target: Option<Vec3>) -> (Wire, Option<Target>) {
    let [thick, thin] = [Wire::LONG_BEND, Wire::USUAL].map(Wire::named);
    if let Some(target) = target {
        // That there is no route is said when it is asked for.
        let is_wide = tree
            .route(from, target)
            .is_ok_and(|route| route.usual_radius_mm() >= WIDE && route.clearance(ROOM * thick.diameter_mm).is_ok());
        return (if is_wide { thick } else { thin }, None);
    }
    let [by_thick, by_thin] = [&thick, &thin].map(|wire| reached(tree, from, wire));
    let is_far = |target: &Target| by_thin.as_ref().is_none_or(|other| target.length_mm >= PART * other.length_mm);
    match by_thick.filter(|target| target.usual_radius_mm >= WIDE && is_far(target)) {
        Some(target) => (thick, Some(target)),
        None => (thin, by_thin),
    }
}
