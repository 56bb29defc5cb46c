//! The other way: triangles are cut out, and the holes filled.
//!
//! The hole of a place is filled by `lumen_mesh::mending::fill`, after Liepa (2003): a patch that goes on as the wall around
//! it does, or a membrane where that would cross. A place is cut as a whole or not at all: where a rim stays open, its
//! triangles go back.

use lumen_mesh::disjoint_sets::{root, union};
use lumen_mesh::mending::fill::fill;
use lumen_mesh::mending::holes::{Opening, holes};
use lumen_mesh::{SurfaceIndex, Topology, TriMesh, components};

use super::clusters::{Cluster, NONE};
use super::{Remedy, Surface, Uncrossed};

/// What is left standing alone beside a hole goes too if it has fewer triangles.
const ISLAND: u32 = 12;

/// Cuts out the clusters with `rings` rings of triangles around them and fills the holes; `next` has the triangles of
/// `surface`, whose vertices may have moved.
pub(super) fn recut(next: &mut Uncrossed, surface: &Surface, clusters: &[&Cluster], rings: usize) {
    if clusters.is_empty() {
        return;
    }
    let count = next.mesh.positions.len();
    let is_cut = cut_out(surface, clusters, rings);
    let cut_of = cuts(surface, clusters, &is_cut);
    let mut kept: Vec<u32> = (0..is_cut.len() as u32).filter(|&t| !is_cut[t as usize]).collect();
    let triangle = |t: u32| surface.mesh.triangles[t as usize];
    let open =
        TriMesh { positions: next.mesh.positions.clone(), triangles: kept.iter().map(|&t| triangle(t)).collect() };
    let open_topology = Topology::new(count, &open.triangles);
    // The cut that a vertex on a new rim is of.
    let mut cut_at = vec![NONE; count];
    for t in (0..is_cut.len() as u32).filter(|&t| is_cut[t as usize]) {
        triangle(t).iter().for_each(|&v| cut_at[v as usize] = cut_of[t as usize]);
    }
    let is_ours = |rim: &[u32]| rim.iter().all(|&v| cut_at[v as usize] != NONE);
    let holes = holes(&open, &open_topology);
    let ours = holes.iter().filter(|hole| hole.opening == Opening::Hole && is_ours(&hole.rim));
    let limit = ours.map(|hole| hole.diameter_mm).fold(0.0, f64::max);
    let filled = fill(&open, limit);

    let new = &filled.mesh.triangles[open.triangles.len()..];
    let pieces = components(filled.mesh.positions.len(), new);
    let mut cut_of_piece = vec![NONE; pieces.count()];
    for first in [true, false] {
        for (t, &piece) in new.iter().zip(&pieces.of_triangle) {
            for &v in t.iter().filter(|&&v| (v as usize) < count) {
                let of_piece = &mut cut_of_piece[piece as usize];
                // All vertices of a rim are of one cut.
                *of_piece = if first || *of_piece == cut_at[v as usize] { cut_at[v as usize] } else { NONE };
            }
        }
    }
    let owned: Vec<usize> = (0..new.len()).filter(|&t| cut_of_piece[pieces.of_triangle[t] as usize] != NONE).collect();
    let closed: Vec<[u32; 3]> = open.triangles.iter().copied().chain(owned.iter().map(|&t| new[t])).collect();
    let closed = Topology::new(filled.mesh.positions.len(), &closed);
    // A cut fails where an edge between what was cut and what was kept is open.
    let mut has_failed = vec![false; is_cut.len()];
    for t in (0..is_cut.len()).filter(|&t| is_cut[t]) {
        let [a, b, c] = surface.mesh.triangles[t];
        let is_closed = |(from, to)| {
            open_topology.edge(from, to).is_none() || closed.edge(from, to).is_some_and(|edge| edge.triangles() == 2)
        };
        if ![(a, b), (b, c), (c, a)].into_iter().all(is_closed) {
            has_failed[cut_of[t] as usize] = true;
        }
    }
    // So does one by which a piece of the surface would be gone, unless that is as small as an island.
    let whole = components(count, &surface.mesh.triangles);
    let mut is_gone: Vec<bool> = whole.triangle_counts.iter().map(|&triangles| triangles >= ISLAND).collect();
    kept.iter().for_each(|&t| is_gone[whole.of_triangle[t as usize] as usize] = false);
    for t in (0..is_cut.len()).filter(|&t| is_cut[t] && is_gone[whole.of_triangle[t] as usize]) {
        has_failed[cut_of[t] as usize] = true;
    }
    kept.extend((0..is_cut.len() as u32).filter(|&t| is_cut[t as usize] && has_failed[cut_of[t as usize] as usize]));
    kept.sort_unstable();
    let owned: Vec<usize> =
        owned.into_iter().filter(|&t| !has_failed[cut_of_piece[pieces.of_triangle[t] as usize] as usize]).collect();

    let own_row = |t: usize| {
        let sources = filled.triangles.sources(open.triangles.len() + t);
        // The nearest along the rim comes first; its number is one of the triangles that were open.
        sources.first().map_or(0, |&(row, _)| row)
    };
    let of_open: Vec<u32> = (0..is_cut.len() as u32).filter(|&t| !is_cut[t as usize]).collect();
    let rows = kept.iter().copied().chain(owned.iter().map(|&t| of_open[own_row(t) as usize]));
    next.triangle_of = rows.map(|t| next.triangle_of[t as usize]).collect();
    next.mesh.triangles = kept.iter().map(|&t| triangle(t)).chain(owned.iter().map(|&t| new[t])).collect();
    next.mesh.positions.clone_from(&filled.mesh.positions);

    let moved = distances(
        next,
        surface,
        &is_cut,
        &cut_of,
        &has_failed,
        &owned.iter().map(|&t| (new[t], cut_of_piece[pieces.of_triangle[t] as usize])).collect::<Vec<_>>(),
    );
    for cluster in clusters {
        let cut = cluster.triangles.first().map_or(0, |&t| cut_of[t as usize] as usize);
        if !has_failed[cut] {
            next.places.push(cluster.place(surface, Remedy::Recut, moved[cut]));
        }
    }
}

/// Which triangles are cut out: those within `rings` rings of a cluster, and so many more that no two rims touch in a vertex
/// and no island stays.
fn cut_out(surface: &Surface, clusters: &[&Cluster], rings: usize) -> Vec<bool> {
    let Surface { mesh, topology, .. } = surface;
    let count = mesh.positions.len();
    let mut is_cut = vec![false; mesh.triangles.len()];
    for cluster in clusters {
        for &v in surface.rings(&cluster.vertices, rings - 1).iter().flatten() {
            topology.triangles(v).iter().for_each(|&t| is_cut[t as usize] = true);
        }
    }
    for _ in rings..3 {
        let kept: Vec<usize> = (0..is_cut.len()).filter(|&t| !is_cut[t]).collect();
        let triangles: Vec<[u32; 3]> = kept.iter().map(|&t| mesh.triangles[t]).collect();
        let (open, pieces) = (Topology::new(count, &triangles), components(count, &triangles));
        let mut is_island: Vec<bool> = pieces.triangle_counts.iter().map(|&triangles| triangles < ISLAND).collect();
        let is_beside = |v: u32| topology.triangles(v).iter().any(|&t| is_cut[t as usize]);
        // A small piece that nothing was cut from is none.
        let mut is_at_cut = vec![false; is_island.len()];
        for (&t, &piece) in kept.iter().zip(&pieces.of_triangle) {
            is_at_cut[piece as usize] |= mesh.triangles[t].iter().any(|&v| is_beside(v));
        }
        is_island.iter_mut().zip(is_at_cut).for_each(|(is_island, is_at_cut)| *is_island &= is_at_cut);
        let is_pinched =
            |v: u32| open.edge_uses(v).iter().filter(|edge| edge.is_boundary()).count() > 2 && is_beside(v);
        let more: Vec<usize> = kept
            .iter()
            .zip(&pieces.of_triangle)
            .filter(|&(&t, &piece)| is_island[piece as usize] || mesh.triangles[t].iter().any(|&v| is_pinched(v)))
            .map(|(&t, _)| t)
            .collect();
        if more.is_empty() {
            break;
        }
        more.into_iter().for_each(|t| is_cut[t] = true);
    }
    is_cut
}

/// For each triangle that is cut, the first of those that it hangs together with or shares a place with: a cut is known by
/// it.
fn cuts(surface: &Surface, clusters: &[&Cluster], is_cut: &[bool]) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..is_cut.len() as u32).collect();
    for pair in clusters.iter().flat_map(|cluster| cluster.triangles.windows(2)) {
        union(&mut parent, pair[0], pair[1]);
    }
    for t in (0..is_cut.len()).filter(|&t| is_cut[t]) {
        for v in surface.mesh.triangles[t] {
            for &other in surface.topology.triangles(v).iter().filter(|&&other| is_cut[other as usize]) {
                union(&mut parent, t as u32, other);
            }
        }
    }
    (0..is_cut.len() as u32).map(|t| if is_cut[t as usize] { root(&mut parent, t) } else { NONE }).collect()
}

/// For each cut the largest distance in mm of a vertex that was from the wall that is, or of one that is from the wall that
/// was.
fn distances(
    next: &Uncrossed,
    surface: &Surface,
    is_cut: &[bool],
    cut_of: &[u32],
    has_failed: &[bool],
    new: &[([u32; 3], u32)],
) -> Vec<f64> {
    let index = SurfaceIndex::new(&next.mesh.positions, &next.mesh.triangles);
    let mut moved = vec![0.0; is_cut.len()];
    let mut note = |cut: u32, index: &SurfaceIndex, p| {
        let distance = index.nearest(p).map_or(0.0, |near| f64::from(near.distance));
        let most: &mut f64 = &mut moved[cut as usize];
        *most = most.max(distance);
    };
    for t in (0..is_cut.len()).filter(|&t| is_cut[t] && !has_failed[cut_of[t] as usize]) {
        surface.mesh.corners(t).into_iter().for_each(|p| note(cut_of[t], &index, p));
    }
    for (triangle, cut) in new {
        triangle.iter().for_each(|&v| note(*cut, &surface.index, next.mesh.positions[v as usize]));
    }
    moved
}
