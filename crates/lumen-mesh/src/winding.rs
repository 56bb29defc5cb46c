//! Winding: triangles that are neighbours should agree, and the surface should face outwards.
//!
//! Agreement goes breadth-first over the edges of two triangles; within a patch reached so, the winding that most of
//! its triangles have is kept. A component is left as it is where one of its patches cannot be oriented (a Möbius
//! band). Facing is then decided for a component as a whole, by the sign of the volume it encloses with each open
//! end capped by a fan to its middle.

use glam::{DVec3, Vec3};

use super::{Components, EdgeUse, Topology, TriMesh, components};

/// The result of [`make_consistent`].
pub struct Consistency {
    /// Whether each component can be oriented.
    pub orientable: Vec<bool>,
    /// Triangles that were reversed.
    pub reversed: usize,
}

/// Reverses triangles so that neighbours agree, in every component where that is possible.
pub fn make_consistent(triangles: &mut [[u32; 3]], topology: &Topology, pieces: &Components) -> Consistency {
    let mut orientable = vec![true; pieces.count()];
    // Whether a triangle differs from the first of its patch.
    let mut differs = vec![false; triangles.len()];
    let mut seen = vec![false; triangles.len()];
    // Triangles in the order they are reached, patch after patch.
    let mut order: Vec<usize> = Vec::with_capacity(triangles.len());
    let mut patches: Vec<(usize, usize)> = Vec::new();
    for first in 0..triangles.len() {
        if seen[first] {
            continue;
        }
        seen[first] = true;
        let start = order.len();
        order.push(first);
        let mut at = start;
        while at < order.len() {
            let t = order[at];
            at += 1;
            for (from, to) in sides(triangles[t]) {
                let Some(other) = across(triangles, topology, t, from, to) else {
                    continue;
                };
                // Neighbours that agree run their common edge in opposite directions.
                let agrees = sides(triangles[other]).contains(&(to, from));
                let expected = differs[t] == agrees;
                if !seen[other] {
                    seen[other] = true;
                    differs[other] = expected;
                    order.push(other);
                } else if differs[other] != expected {
                    orientable[pieces.of_triangle[t] as usize] = false;
                }
            }
        }
        patches.push((start, order.len()));
    }
    let mut reversed = 0;
    for (start, end) in patches {
        let patch = &order[start..end];
        if !orientable[pieces.of_triangle[patch[0]] as usize] {
            continue;
        }
        let differing = patch.iter().filter(|&&t| differs[t]).count();
        let to_reverse = differing * 2 <= patch.len();
        for &t in patch.iter().filter(|&&t| differs[t] == to_reverse) {
            triangles[t].swap(1, 2);
            reversed += 1;
        }
    }
    Consistency { orientable, reversed }
}

/// The directed edges of a triangle.
fn sides([a, b, c]: [u32; 3]) -> [(u32, u32); 3] {
    [(a, b), (b, c), (c, a)]
}

/// The other triangle on an edge of `t`, if exactly two are there.
fn across(triangles: &[[u32; 3]], topology: &Topology, t: usize, from: u32, to: u32) -> Option<usize> {
    if topology.edge(from, to)?.triangles() != 2 {
        return None;
    }
    topology.triangles_on(triangles, from, to).map(|other| other as usize).find(|&other| other != t)
}

/// Turns each orientable component that faces inwards; returns how many. Volumes too small to tell which way a
/// component faces, as that of a flat piece, turn nothing.
pub fn turn_outward(mesh: &mut TriMesh, topology: &Topology, pieces: &Components, orientable: &[bool]) -> usize {
    let inward: Vec<bool> = facing(mesh, topology, pieces)
        .iter()
        .zip(orientable)
        .map(|(&(volume, area), &orientable)| orientable && volume < -1e-6 * area * area.sqrt())
        .collect();
    for (t, &component) in mesh.triangles.iter_mut().zip(&pieces.of_triangle) {
        if inward[component as usize] {
            t.swap(1, 2);
        }
    }
    inward.iter().filter(|&&inward| inward).count()
}

/// Signed capped volume and area of each component, about its own first corner: one that is not closed has a volume
/// that depends on where it is taken from.
fn facing(mesh: &TriMesh, topology: &Topology, pieces: &Components) -> Vec<(f64, f64)> {
    let mut component_of = vec![0u32; mesh.positions.len()];
    let mut origins = vec![None; pieces.count()];
    for (t, &component) in mesh.triangles.iter().zip(&pieces.of_triangle) {
        origins[component as usize].get_or_insert(mesh.positions[t[0] as usize]);
        for &v in t {
            component_of[v as usize] = component;
        }
    }
    let origins: Vec<DVec3> = origins.into_iter().map(|p: Option<Vec3>| p.unwrap_or_default().as_dvec3()).collect();
    let mut sums = vec![(0.0, 0.0); pieces.count()];
    for (t, &component) in pieces.of_triangle.iter().enumerate() {
        let [a, b, c] = mesh.corners(t).map(|p| p.as_dvec3() - origins[component as usize]);
        let sum = &mut sums[component as usize];
        sum.0 += a.dot(b.cross(c)) / 6.0;
        sum.1 += (b - a).cross(c - a).length() / 2.0;
    }
    // The rims: directed edges that no other triangle runs back along, in connected groups. Taken so, and not as
    // loops, they close the surface even where more than two triangles meet, and turning it changes the sign alone.
    let surplus = |edge: EdgeUse| i32::from(edge.forward) - i32::from(edge.backward);
    let edges: Vec<(u32, u32, i32)> =
        topology.edges().map(|(a, b, edge)| (a, b, surplus(edge))).filter(|&(_, _, surplus)| surplus != 0).collect();
    let pairs: Vec<[u32; 3]> = edges.iter().map(|&(a, b, _)| [a, b, b]).collect();
    let rims = components(mesh.positions.len(), &pairs);
    let at = |v: u32| mesh.positions[v as usize].as_dvec3() - origins[component_of[v as usize] as usize];
    let mut middles = vec![DVec3::ZERO; rims.count()];
    for (&(a, b, _), &rim) in edges.iter().zip(&rims.of_triangle) {
        middles[rim as usize] += (at(a) + at(b)) / (2.0 * f64::from(rims.triangle_counts[rim as usize]));
    }
    for (&(a, b, surplus), &rim) in edges.iter().zip(&rims.of_triangle) {
        let cap = at(b).dot(at(a).cross(middles[rim as usize])) / 6.0;
        sums[component_of[a as usize] as usize].0 += f64::from(surplus) * cap;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    fn consistent(triangles: &mut [[u32; 3]], vertices: usize) -> Consistency {
        let topology = Topology::new(vertices, triangles);
        make_consistent(triangles, &topology, &components(vertices, triangles))
    }

    #[test]
    fn the_majority_keeps_its_winding() {
        let good = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        for odd in 0..4 {
            let mut triangles = good;
            triangles[odd].swap(1, 2);
            let result = consistent(&mut triangles, 4);
            assert_eq!((triangles, result.reversed, result.orientable), (good, 1, vec![true]));
        }
    }

    #[test]
    fn a_moebius_band_is_left_alone_and_said_to_be_one() {
        // Five triangles around; each has an edge in common with the next, with one twist.
        let band = [[0, 1, 2], [1, 3, 2], [2, 3, 4], [3, 0, 4], [4, 0, 1]];
        let mut triangles = band;
        let result = consistent(&mut triangles, 5);
        assert_eq!((triangles, result.reversed, result.orientable), (band, 0, vec![false]));
    }

    #[test]
    fn an_inside_out_piece_is_turned_and_a_flat_one_is_not() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].map(|p| p + Vec3::splat(100.0));
        let flat = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p - Vec3::splat(50.0));
        let outward = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        // Closed, and open at one side.
        for triangles in [outward.clone(), outward[1..].to_vec()] {
            let inward = triangles.iter().map(|&[a, b, c]| [a, c, b]).chain([[4, 5, 6]]).collect();
            let mut mesh = TriMesh { positions: [&corners[..], &flat].concat(), triangles: inward };
            let topology = Topology::new(7, &mesh.triangles);
            let pieces = components(7, &mesh.triangles);
            assert_eq!(turn_outward(&mut mesh, &topology, &pieces, &[true; 2]), 1);
            assert_eq!(mesh.triangles[..triangles.len()], triangles);
            assert_eq!(mesh.triangles[triangles.len()], [4, 5, 6]);
        }
    }
}
