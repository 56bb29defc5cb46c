//! The guard over surfaces made for it: what a leaf asks, what it does not, and what it costs where everything is near
//! everything.

use glam::{Vec3, Vec3A};

use super::*;
use lumen_mesh::Topology;
use lumen_mesh::shapes::{icosphere, joined, square};

fn rings_of(mesh: &TriMesh) -> Rings {
    let mut rings = Rings::new(mesh);
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    assert!(rings.link(mesh, &topology, usize::MAX / 2));
    rings.compact();
    rings
}

fn guard_of(rings: &Rings, is_closed: bool) -> Guard {
    let (mut guard, mut star) = (Guard::default(), OneRing::new());
    guard.start(rings, is_closed);
    while !guard.advance(rings, &mut star) {}
    guard
}

/// The guard's word on `v` going to its `to`-th neighbour.
fn allows(guard: &mut Guard, rings: &Rings, mesh: &TriMesh, v: u32, to: usize) -> bool {
    let mut star = OneRing::new();
    star.load(rings, v);
    star.span();
    let u = neighbour(star.entries()[to]);
    guard.allows(rings, mesh, &Planned { v, u, to, end: rings.at(u), star: &star, other: None })
}

fn slot_of(rings: &Rings, node: u32) -> u32 {
    (0..rings.len() as u32).find(|&slot| rings.nodes[slot as usize] == node).unwrap()
}

#[test]
fn each_slot_is_in_one_leaf_and_each_box_holds_its_triangles() {
    let mesh = joined(&[icosphere(3, 10.0, Vec3::ZERO), icosphere(3, 9.8, Vec3::ZERO)]);
    let rings = rings_of(&mesh);
    for is_closed in [true, false] {
        let guard = guard_of(&rings, is_closed);
        let mut seen = vec![0; rings.len()];
        for leaf in 0..guard.leaves.len() as u32 {
            for &slot in guard.leaves.slots(leaf) {
                seen[slot as usize] += 1;
                assert_eq!(guard.leaves.of(slot), leaf);
                let [low, high] = guard.boxes[leaf as usize];
                let corners = rings.around(slot).iter().map(|&entry| rings.at(neighbour(entry)));
                for p in corners.chain([rings.at(slot)]) {
                    // In units of a hundredth of a millimetre; sums are rounded.
                    assert!((p.cmpge(low - 1e-3) & p.cmple(high + 1e-3)).all());
                }
            }
        }
        assert!(seen.iter().all(|&count| count == 1));
    }
}

#[test]
fn where_pieces_lie_upon_each_other_a_leaf_is_of_one_piece_and_asks_the_other() {
    let (outer, inner) = (icosphere(4, 10.0, Vec3::ZERO), icosphere(4, 9.8, Vec3::ZERO));
    let first = outer.positions.len() as u32;
    let rings = rings_of(&joined(&[outer, inner]));
    let piece = |slot: u32| rings.nodes[slot as usize] >= first;
    let guard = guard_of(&rings, false);
    let piece_of = |leaf: u32| piece(guard.leaves.slots(leaf)[0]);
    for leaf in 0..guard.leaves.len() as u32 {
        assert!(guard.leaves.slots(leaf).iter().all(|&slot| piece(slot) == piece_of(leaf)));
        assert!(!guard.pairs.is_crowded(leaf));
        let mut asked: Vec<u32> = guard.pairs.of(leaf).collect();
        asked.sort_unstable();
        // All of the other piece whose boxes overlap, and none of its own: a sphere of this size does not fold there.
        let patch = guard.tree.leaf(leaf);
        let all = 0..guard.leaves.len() as u32;
        let near: Vec<u32> = all
            .filter(|&other| {
                piece_of(other) != piece_of(leaf) && guard.tree.leaf(other).overlaps(patch.low, patch.high)
            })
            .collect();
        assert!(!near.is_empty());
        assert_eq!(asked.into_iter().filter(|&other| piece_of(other) != piece_of(leaf)).collect::<Vec<_>>(), near);
    }
    let own = (0..guard.leaves.len() as u32)
        .flat_map(|leaf| guard.pairs.of(leaf).map(move |other| (leaf, other)))
        .filter(|&(leaf, other)| piece_of(leaf) == piece_of(other))
        .count();
    assert!(own < guard.leaves.len(), "{own} pairs of {} leaves within one piece", guard.leaves.len());
}

#[test]
fn the_leaves_of_one_closed_sphere_ask_nobody() {
    let rings = rings_of(&icosphere(6, 10.0, Vec3::ZERO));
    let guard = guard_of(&rings, true);
    let asking = (0..guard.leaves.len() as u32).filter(|&leaf| guard.pairs.of(leaf).count() > 0).count();
    // But for the few that lie across two parts of the curve.
    assert!(asking * 20 < guard.leaves.len(), "{asking} of {}", guard.leaves.len());
}

/// The outer vertices of two spheres, and into how many of their neighbours the guard lets them go; both spheres look
/// outward. Without a vertex, the outer sphere comes 0.38 mm farther in.
fn let_go(inner: f32) -> (usize, usize) {
    let outer = icosphere(2, 10.0, Vec3::ZERO);
    let first = outer.positions.len() as u32;
    let mesh = joined(&[outer, icosphere(2, inner, Vec3::ZERO)]);
    let rings = rings_of(&mesh);
    let mut guard = guard_of(&rings, false);
    let outside = (0..rings.len() as u32).filter(|&slot| rings.nodes[slot as usize] < first);
    let ways = outside.flat_map(|v| (0..rings.around(v).len()).map(move |to| (v, to)));
    let words: Vec<bool> = ways.map(|(v, to)| allows(&mut guard, &rings, &mesh, v, to)).collect();
    (words.iter().filter(|&&word| word).count(), words.len())
}

#[test]
fn a_sphere_is_not_drawn_through_the_one_inside_that_looks_the_same_way() {
    assert_eq!(let_go(9.9).0, 0);
    let (free, all) = let_go(9.0);
    assert_eq!(free, all);
}

#[test]
fn the_sheet_around_a_vertex_is_its_own_piece_as_far_as_it_looks_the_same_way() {
    let mesh = joined(&[square(6, 6.0, 0.0), square(6, 6.0, 0.1)]);
    let rings = rings_of(&mesh);
    let v = slot_of(&rings, 3 * 7 + 3);
    let [low, high] = [Vec3A::splat(-1e4), Vec3A::splat(1e4)];
    let mut all: Vec<[u32; 3]> =
        (0..rings.len() as u32).flat_map(|s| rings.pairs(s).map(move |[a, b]| turned([s, a, b]))).collect();
    all.sort_unstable();
    all.dedup();
    let mut sheet = Sheet::default();
    let mut rest = all.clone();
    sheet.follow(&rings, [v, v], Vec3A::Z, (low, high), &mut rest);
    let found: Vec<[u32; 3]> = all.iter().filter(|triangle| !rest.contains(triangle)).copied().collect();
    assert!(found.len() > 60);
    assert!(found.iter().flatten().all(|&slot| rings.nodes[slot as usize] < 49));
    assert!(found.iter().all(|triangle| !triangle.contains(&v)));
    // Seen from below, nothing is of the sheet.
    let mut rest = found.clone();
    sheet.follow(&rings, [v, v], Vec3A::NEG_Z, (low, high), &mut rest);
    assert_eq!(rest, found);
}

#[test]
fn where_everything_is_near_everything_the_lists_stay_small() {
    // Three hundred strips through one place, each turned by a little.
    let strips: Vec<TriMesh> = (0..300)
        .map(|i| {
            let turn = glam::Quat::from_euler(glam::EulerRot::XYZ, i as f32 * 0.37, i as f32 * 0.11, i as f32 * 0.73);
            let mut strip = square(3, 6.0, 0.0);
            strip.positions.iter_mut().for_each(|p| *p = turn * (*p - Vec3::new(3.0, 3.0, 0.0)));
            strip
        })
        .collect();
    let mesh = joined(&strips);
    let rings = rings_of(&mesh);
    let mut guard = guard_of(&rings, false);
    let leaves = guard.leaves.len() as u32;
    let crowded = (0..leaves).filter(|&leaf| guard.pairs.is_crowded(leaf)).count();
    assert!(crowded * 2 > leaves as usize, "{crowded} of {leaves}");
    // It still knows what it asks: the inner vertices of a strip go nowhere without being tested.
    let inner = slot_of(&rings, 5);
    guard.take_effort();
    let _ = allows(&mut guard, &rings, &mesh, inner, 0);
    assert!(guard.take_effort() > 1000);
}
