//! Where a rod is near the wall, kept from step to step: the manifold of its contacts.
//!
//! A node touches the wall where it is nearest, and where it was nearest before as long as that is another facet at hand:
//! in a corner it rests on both, and slides from the one to the other without a jolt. A contact belongs to the wall and
//! not to a triangle: multiplier, slip and limit go on with it to the next triangle, so that neither friction nor the way
//! in which the wall presses depends on how the wall is cut. The inside of an edge touches it where that comes nearer than
//! both of its ends: at a ridge or on the inside of a bend. The gap is the distance from the flat triangles less the
//! radius.

use glam::DVec3;

use super::law::{Contact, PENALTY};
use crate::rod::{Rod, Section};
use crate::wall::Wall;
use lumen_mesh::{PointProjection, SegmentProjection};

/// A gap of less than this, in mm, is looked after in the step from its beginning; others once they have closed.
const REACH: f64 = 0.1;
/// A gap that is looked after is measured anew once less than this part of it may be left. Until then what was measured
/// stands: nothing can have closed it.
const FRESH: f64 = 0.25;
/// Below this gap in mm the inside of an edge is looked after.
const EDGE_REACH: f64 = 0.05;
/// What is not nearest, but was, is looked after as long as its gap is less than this, in mm: on a fine surface a wire
/// that slides leaves many facets behind. What closes a wider gap within a step is found after it, as nearest then.
const CORNER: f64 = 0.02;
/// The part of the radius by which the inside of an edge must be nearer than its ends to be a contact of its own.
const DEEPER: f64 = 0.01;

/// Cosine of the turn below which two triangles are one facet: a degree.
const SAME: f64 = 0.99985;
/// The wall's curvature times the distance of the wire's middle from it is at most this.
const ROUNDEST: f64 = 0.5;
/// A contact passes over at most this many triangles in a step.
const TRIANGLES: usize = 8;
/// A node is above a triangle where the cosine between its way from the wall and the triangle's normal is more than this.
const ABOVE: f64 = 1.0 - 1e-9;
/// Facets that a node can touch at once.
const FACETS: usize = 3;
/// Ridges that an edge can touch at once.
const RIDGES: usize = 3;
/// Cosine of the turn below which an edge lies against the same side of a ridge.
const ONE_SIDE: f64 = 0.9994;
/// Places of an edge that are nearer than this part of it are one.
const APART: f64 = 0.2;

/// How far a node is from the wall.
#[derive(Clone, Copy, Debug)]
struct Clearance {
    /// The distance that was measured last, in mm, and from where.
    distance: f64,
    from: DVec3,
    /// The leaf of the index in which the nearest point was.
    hint: u32,
}

impl Clearance {
    const UNKNOWN: Self = Self { distance: 0.0, from: DVec3::ZERO, hint: u32::MAX };

    /// A bound below which the distance of `p` cannot be.
    fn at_least(&self, p: DVec3) -> f64 {
        self.distance - p.distance(self.from)
    }
}

/// How far the inside of an edge is from the wall, at least: in mm, and where its ends were when that was found.
#[derive(Clone, Copy, Debug)]
struct Inside {
    distance: f64,
    ends: [DVec3; 2],
}

impl Inside {
    const UNKNOWN: Self = Self { distance: 0.0, ends: [DVec3::ZERO; 2] };

    /// A bound below which the distance cannot be with its ends at `a` and `b`.
    fn at_least(&self, a: DVec3, b: DVec3) -> f64 {
        self.distance - a.distance(self.ends[0]).max(b.distance(self.ends[1]))
    }
}

/// Of which node or edge a contact is, and which of its contacts.
#[derive(Clone, Copy, Debug)]
enum Place {
    Node(usize, usize),
    Edge(usize, usize),
}

/// The contacts of a rod, each in its slot from when it comes near until it is let go of.
#[derive(Clone, Debug, Default)]
pub(super) struct Manifold {
    clearances: Vec<Clearance>,
    /// How far the inside of each edge is.
    insides: Vec<Inside>,
    /// Of each node. In a corner between facets it touches several.
    nodes: Vec<[Contact; FACETS]>,
    /// Of the inside of each edge.
    edges: Vec<[Contact; RIDGES]>,
    /// Those of them that take part in the step.
    places: Vec<Place>,
}

impl Contact {
    /// Is with this foot from now on, with the force that it had.
    fn meet(&mut self, rod: &Rod, node: usize, along: f64, wall: &Wall, projection: &PointProjection, radius: f64) {
        let a = rod.positions[node];
        let p = if along > 0.0 { a.lerp(rod.positions[node + 1], along) } else { a };
        if !self.is_near || (along - self.along).abs() > 0.3 {
            *self = Self::NONE;
        }
        self.is_near = true;
        self.slot = projection.slot;
        self.along = along;
        self.point = projection.point;
        self.triangle = projection.triangle;
        self.smooth = wall.inward(p, projection);
        self.normal = (p - projection.point).normalize_or(self.smooth);
        self.gap = projection.distance - radius;
        self.at = p;
        let Section { length, ei, .. } = rod.sections[node];
        self.penalty = PENALTY.max(ei / (length * length * length));
        self.across = self.normal.cross(rod.tangent(node)).normalize_or_zero();
        // As the middle of the wire feels it, which is nearer to the middle of the lumen.
        let curvature =
            wall.curvature(projection.triangle, self.across).clamp(0.0, ROUNDEST / projection.distance.max(radius));
        self.curvature = curvature / (1.0 - curvature * projection.distance);
    }
}

impl Manifold {
    /// Measures the gaps of the first `count` nodes, the last one excepted, and of the edges between them. Returns how far
    /// the rod, of this radius in mm, reaches into the wall, in mm; less than 0 where it is clear of it by more.
    pub(super) fn detect(&mut self, rod: &Rod, count: usize, wall: &Wall, radius: f64) -> f64 {
        // A contact pulls at the edge behind its node, and the last has none.
        let count = count.min(rod.len() - 1);
        self.clearances.resize(count, Clearance::UNKNOWN);
        self.nodes.resize(count, [Contact::NONE; FACETS]);
        self.edges.resize(count.saturating_sub(1), [Contact::NONE; RIDGES]);
        self.insides.resize(count.saturating_sub(1), Inside::UNKNOWN);
        let mut deepest = f64::NEG_INFINITY;
        // An edge right after its ends, whose triangles are at hand then.
        for i in 0..count {
            let mut distance = self.detect_at_node(rod, i, wall, radius);
            if i > 0 {
                distance = distance.min(self.detect_at_edge(rod, i - 1, wall, radius));
            }
            deepest = deepest.max(radius - distance);
        }
        self.list();
        deepest
    }

    /// Lets go of the contacts of all but the first `count` nodes and the edges between them.
    pub(super) fn keep(&mut self, count: usize) {
        if count < self.nodes.len() {
            self.clearances.truncate(count);
            self.nodes.truncate(count);
            self.edges.truncate(count.saturating_sub(1));
            self.insides.truncate(count.saturating_sub(1));
            self.list();
        }
    }

    /// Measures the gaps of a node. Returns a distance from the wall that it has at least, in mm.
    fn detect_at_node(&mut self, rod: &Rod, i: usize, wall: &Wall, radius: f64) -> f64 {
        let p = rod.positions[i];
        let (known, contacts) = (&mut self.clearances[i], &mut self.nodes[i]);
        if stands(known.distance - radius, known.at_least(p) - radius, REACH) {
            return known.at_least(p);
        }
        let Some(projection) = wall.index().project_point(p, f64::INFINITY, known.hint) else { return f64::INFINITY };
        *known = Clearance { distance: projection.distance, from: p, hint: projection.slot };
        if projection.distance >= radius + REACH {
            *contacts = [Contact::NONE; FACETS];
            return projection.distance;
        }
        let away = (p - projection.point).normalize_or_zero();
        let mut same = None;
        for k in 0..FACETS {
            let mut contact = std::mem::replace(&mut contacts[k], Contact::NONE);
            let followed = if contact.is_near { follow(wall, p, &contact, away, &projection) } else { None };
            let Some((own, is_same)) = followed else { continue };
            let is_with = |&j: &usize| contacts[j].is_near && contacts[j].slot == own.slot && same != Some(j);
            if let Some(before) = if is_same { same } else { (0..k).find(is_with) } {
                // Two that have come together are one.
                contacts[before].join(&contact);
            } else if is_same {
                same = Some(k);
                contacts[k] = contact;
            } else if own.distance < radius + CORNER {
                // What is not nearest is let go of sooner.
                contact.meet(rod, i, 0.0, wall, &own, radius);
                contacts[k] = contact;
            }
        }
        // A new facet takes the place of what matters least.
        let least = || (0..FACETS).min_by(|&a, &b| rank(&contacts[a]).total_cmp(&rank(&contacts[b])));
        if let Some(k) = same.or_else(least) {
            if same.is_none() {
                contacts[k] = Contact::NONE;
            }
            contacts[k].meet(rod, i, 0.0, wall, &projection, radius);
        }
        projection.distance
    }

    /// Measures the gap of the inside of an edge. Returns a distance from the wall that it has at least, in mm, unless
    /// its ends are nearer.
    fn detect_at_edge(&mut self, rod: &Rod, i: usize, wall: &Wall, radius: f64) -> f64 {
        let (a, b) = (rod.positions[i], rod.positions[i + 1]);
        let known = &self.insides[i];
        if stands(known.distance - radius, known.at_least(a, b) - radius, EDGE_REACH) {
            return known.at_least(a, b);
        }
        let (near_a, near_b) = (self.clearances[i].at_least(a), self.clearances[i + 1].at_least(b));
        let within = (near_a.min(near_b) - DEEPER * radius).min(radius + EDGE_REACH);
        let bound = between(near_a, near_b, a.distance(b));
        let contacts = &mut self.edges[i];
        let mut least = f64::INFINITY;
        for contact in contacts.iter_mut().filter(|contact| contact.is_near) {
            match wall.index().project_segment_in(contact.slot, a, b, radius + EDGE_REACH) {
                Some(own) => {
                    contact.meet(rod, i, own.along, wall, &own.projection, radius);
                    least = least.min(own.projection.distance);
                }
                None => *contact = Contact::NONE,
            }
        }
        let found = if bound < within { wall.index().project_segment(a, b, within.min(least)) } else { None };
        let distance = found.map_or(within.max(bound), |found| found.projection.distance).min(least);
        self.insides[i] = Inside { distance, ends: [a, b] };
        let Some(SegmentProjection { along, projection }) = found else {
            let nearest = least - radius;
            leave(contacts, |_, contact| contact.gap <= nearest);
            return least;
        };
        let away = (a.lerp(b, along) - projection.point).normalize_or_zero();
        let is_same = |contact: &Contact| {
            contact.is_near && (contact.along - along).abs() < APART && contact.normal.dot(away) > ONE_SIDE
        };
        let same = contacts.iter().position(is_same);
        leave(contacts, |k, _| same == Some(k));
        let free = || (0..RIDGES).min_by(|&a, &b| rank(&contacts[a]).total_cmp(&rank(&contacts[b])));
        if let Some(k) = same.or_else(free) {
            if same.is_none() {
                contacts[k] = Contact::NONE;
            }
            contacts[k].meet(rod, i, along, wall, &projection, radius);
        }
        least.min(projection.distance)
    }

    /// How far the wall is at least from a node and the edges beside it, in mm; 0 where that is not known.
    pub(super) fn clearance(&self, rod: &Rod, node: usize) -> f64 {
        let at_least = |i: usize| self.clearances.get(i).map_or(0.0, |known| known.at_least(rod.start(i)));
        let edge = |i: usize| (at_least(i) + at_least(i + 1) - rod.start(i).distance(rod.start(i + 1))) / 2.0;
        let before = if node > 0 { edge(node - 1) } else { f64::INFINITY };
        let after = if node + 1 < rod.len() { edge(node) } else { f64::INFINITY };
        before.min(after).min(at_least(node)).max(0.0)
    }

    /// Every contact that takes part in the step, with the node at which its edge begins.
    pub(super) fn near(&self) -> impl Iterator<Item = (usize, &Contact)> {
        let contact = |place: &Place| match *place {
            Place::Node(i, k) => (i, &self.nodes[i][k]),
            Place::Edge(i, k) => (i, &self.edges[i][k]),
        };
        self.places.iter().map(contact).filter(|(_, contact)| contact.is_near)
    }

    /// Does something to each of those.
    pub(super) fn each(&mut self, mut visit: impl FnMut(usize, &mut Contact)) {
        for place in &self.places {
            let (node, contact) = match *place {
                Place::Node(i, k) => (i, &mut self.nodes[i][k]),
                Place::Edge(i, k) => (i, &mut self.edges[i][k]),
            };
            if contact.is_near {
                visit(node, contact);
            }
        }
    }

    /// Lists where contacts are.
    fn list(&mut self) {
        self.places.clear();
        for (i, contacts) in self.nodes.iter().enumerate() {
            let near = (0..FACETS).filter(|&k| contacts[k].is_near);
            self.places.extend(near.map(|k| Place::Node(i, k)));
        }
        for (i, contacts) in self.edges.iter().enumerate() {
            let near = (0..RIDGES).filter(|&k| contacts[k].is_near);
            self.places.extend(near.map(|k| Place::Edge(i, k)));
        }
    }
}

/// Where the contact is for a node at `p`, and whether that is where the wall is nearest to the node; `None` where its leaf is
/// none of the index. `away` is the way from the nearest point of the wall to the node.
///
/// As long as the node is above its triangle, it is with that. Once the node has left that, over a side from which the
/// wall goes straight on or falls away, it goes on to the next one; over a valley it stays with its plane, which lies
/// behind the wall there: a node in the valley is between both.
fn follow(
    wall: &Wall,
    p: DVec3,
    contact: &Contact,
    away: DVec3,
    nearest: &PointProjection,
) -> Option<(PointProjection, bool)> {
    let mut own = wall.index().project_point_in(contact.slot, p)?;
    for _ in 0..TRIANGLES {
        let way = (p - own.point).normalize_or_zero();
        if own.triangle == nearest.triangle || way.dot(away) > SAME {
            return Some((own, true));
        }
        let normal = wall.normal(own.triangle).map_or(way, |normal| normal * normal.dot(way).signum());
        if normal.dot(way) > ABOVE {
            break;
        }
        if normal.dot(away) > SAME {
            return Some((own, true));
        }
        // Half-way down to its side the wall is nearer than its plane behind a valley, and farther behind a ridge.
        let middle = own.point.midpoint(p);
        let height = normal.dot(middle - own.point);
        let next = wall.index().project_point(middle, f64::INFINITY, own.slot)?;
        if next.slot == own.slot {
            break;
        }
        let is_on = wall.normal(next.triangle).is_some_and(|next| next.dot(normal).abs() > SAME);
        if next.distance < height && !is_on {
            let distance = 2.0 * height;
            return Some((PointProjection { point: p - normal * distance, distance, ..own }, false));
        }
        own = wall.index().project_point_in(next.slot, p)?;
    }
    Some((own, false))
}

/// Whether a gap of `gap` mm need not be measured anew while at least `left` mm of it are left: what is looked after from
/// `reach` on has been found.
fn stands(gap: f64, left: f64, reach: f64) -> bool {
    left > if gap < reach { FRESH * gap } else { reach }
}

/// Lets go of what is not nearest, and farther than what is looked after in a corner.
fn leave(contacts: &mut [Contact], is_nearest: impl Fn(usize, &Contact) -> bool) {
    for (k, contact) in contacts.iter_mut().enumerate() {
        if contact.gap >= CORNER && !is_nearest(k, contact) {
            *contact = Contact::NONE;
        }
    }
}

/// How near to a segment of this length something can be that is at least `a` from its one end and `b` from the other.
fn between(a: f64, b: f64, length: f64) -> f64 {
    let (a, b) = (a.max(0.0), b.max(0.0));
    // Where both distances are what they are at least, along the segment.
    let along = (a * a - b * b + length * length) / (2.0 * length);
    if along <= 0.0 || along >= length { a.min(b) } else { (a * a - along * along).max(0.0).sqrt() }
}

/// How much a contact matters, in N: by what it presses with and how near it is; none at all the least.
fn rank(contact: &Contact) -> f64 {
    if contact.is_near { contact.found - contact.penalty * contact.gap } else { f64::NEG_INFINITY }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use lumen_mesh::{TriMesh, Vec3};

    /// A room of 4 x 4 x 4 mm around the origin, to be touched from inside.
    fn room() -> Wall {
        let at = |i: u32| {
            Vec3::new(
                if i & 1 > 0 { 2.0 } else { -2.0 },
                if i & 2 > 0 { 2.0 } else { -2.0 },
                if i & 4 > 0 { 2.0 } else { -2.0 },
            )
        };
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        Wall::new(Arc::new(TriMesh { positions: (0..8).map(at).collect(), triangles }))
    }

    /// A ridge along z, from which the wall falls away to both sides, to be touched from above.
    fn ridge() -> Wall {
        let positions = [(0.0, 0.0), (1.0, -1.0), (-1.0, -1.0)]
            .into_iter()
            .flat_map(|(x, y)| [Vec3::new(x, y, -2.0), Vec3::new(x, y, 2.0)])
            .collect();
        Wall::new(Arc::new(TriMesh { positions, triangles: vec![[0, 2, 1], [1, 2, 3], [0, 1, 4], [1, 5, 4]] }))
    }

    /// A rod of one edge, 1 mm along x, beginning here.
    fn rod_from(start: DVec3) -> Rod {
        let section = Section { length: 1.0, cell: 1.0, ..Section::default() };
        Rod::new(vec![start, start + DVec3::X, start + 2.0 * DVec3::X], vec![section; 3], DVec3::Y)
    }

    /// The forces of the contacts at these places, in N.
    fn forces(contacts: &[Contact]) -> Vec<f64> {
        contacts.iter().filter(|contact| contact.is_near).map(|contact| contact.multiplier).collect()
    }

    #[test]
    fn the_nearest_contact_of_a_node_keeps_its_force_as_it_opens() {
        let wall = room();
        let mut contacts = Manifold::default();
        contacts.detect(&rod_from(DVec3::new(0.0, 1.8, 0.0)), 1, &wall, 0.2);
        contacts.each(|_, contact| contact.multiplier = 0.25);
        // Farther than what is kept in a corner, and so far that it is measured again.
        let opened = CORNER + 0.03;
        contacts.detect(&rod_from(DVec3::new(0.0, 1.8 - opened, 0.0)), 1, &wall, 0.2);
        assert_eq!(forces(&contacts.nodes[0]), [0.25]);
        assert!((contacts.nodes[0][0].gap - opened).abs() < 1e-6);
    }

    #[test]
    fn a_contact_goes_on_to_the_next_triangle_with_its_force() {
        let wall = room();
        let mut contacts = Manifold::default();
        // Over the diagonal of the side +y, in a step of 0.1 mm.
        for (x, triangle) in [(0.05, 7), (-0.05, 6)] {
            contacts.detect(&rod_from(DVec3::new(x, 1.8, 0.0)), 1, &wall, 0.2);
            if x > 0.0 {
                contacts.each(|_, contact| contact.multiplier = 0.25);
            }
            assert_eq!(forces(&contacts.nodes[0]), [0.25]);
            let contact = contacts.nodes[0].iter().find(|contact| contact.is_near).unwrap();
            assert_eq!((contact.triangle, contact.normal.round()), (triangle, DVec3::NEG_Y));
        }
    }

    #[test]
    fn behind_a_valley_the_plane_of_the_triangle_stays() {
        let wall = room();
        let mut contacts = Manifold::default();
        // From the side +y, in a corner of it with +z, to where that is nearer.
        contacts.detect(&rod_from(DVec3::new(0.5, 1.81, 1.79)), 1, &wall, 0.2);
        contacts.each(|_, contact| contact.multiplier = 0.25);
        contacts.detect(&rod_from(DVec3::new(0.4, 1.79, 1.81)), 1, &wall, 0.2);
        let found: Vec<_> = contacts.near().map(|(_, contact)| (contact.normal.round(), contact.multiplier)).collect();
        assert_eq!(found, [(DVec3::NEG_Y, 0.25), (DVec3::NEG_Z, 0.0)]);
    }

    #[test]
    fn the_nearest_contact_of_an_edge_keeps_its_force_as_it_opens() {
        let wall = ridge();
        let mut contacts = Manifold::default();
        contacts.detect(&rod_from(DVec3::new(-0.5, 0.2, 0.0)), 2, &wall, 0.2);
        contacts.each(|_, contact| contact.multiplier = 0.25);
        assert_eq!(forces(&contacts.edges[0]), [0.25]);
        let opened = CORNER + 0.02;
        contacts.detect(&rod_from(DVec3::new(-0.5, 0.2 + opened, 0.0)), 2, &wall, 0.2);
        assert_eq!(forces(&contacts.edges[0]), [0.25]);
        assert!((contacts.edges[0][0].gap - opened).abs() < 1e-6);
    }

    #[test]
    fn what_is_deep_in_the_wall_stays_a_contact_when_another_is_found() {
        let wall = room();
        let section = Section { length: 1.0, cell: 1.0, ..Section::default() };
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
        let mut contacts = Manifold::default();
        // Nearest to the sides +y, -x, +z and +x: all four are at hand in the end, and three can be kept.
        for tip in [at(0.0, 0.05, 0.0), at(-0.06, 0.05, 0.0), at(0.0, 0.05, 0.055), at(0.06, 0.05, 0.04)] {
            let rod = Rod::new(vec![tip, tip + DVec3::X * 0.1], vec![section; 2], DVec3::Y);
            contacts.detect(&rod, 1, &wall, 1.97);
        }
        let near = contacts.nodes[0].iter().filter(|contact| contact.is_near);
        let gaps: Vec<f64> = near.map(|contact| contact.gap).collect();
        for expected in [-0.02, -0.01, -0.03] {
            assert!(gaps.iter().any(|gap| (gap - expected).abs() < 1e-3), "{expected} is not among {gaps:?}");
        }
    }
}
