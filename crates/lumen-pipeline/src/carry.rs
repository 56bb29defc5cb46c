//! The arrays of a level: what the file says of its vertices and triangles, carried to those of the reduced surface.
//!
//! Smoothing moves vertices and keeps them: a vertex takes its values with it. Decimation by half-edge collapses
//! (`schroeder`) keeps vertices too, so that each vertex of a level has exactly its own values. Where a method places new
//! vertices (`quadric`), one has the values at the closest point of the surface that entered decimation: of scalars the
//! mean of the triangle's corners by the point's barycentric weights, of labels that of the corners with most weight.
//!
//! Values on triangles go the other way, so that none is lost between samples: each triangle of the surface that entered
//! gives its area to that of the level which is closest to its centroid. A triangle of the level has the mean of what
//! it was given, weighted by area; of labels the one with the largest area. One that was given nothing takes the
//! value at the point closest to its own centroid.
//!
//! Values are carried for the level that is asked for, when it is asked for. The result does not depend on how the work
//! is sliced or on the number of threads.

use std::ops::Range;
use std::sync::Arc;

use super::progressive::MADE;
use super::task::{Yielder, blocks};
use lumen_mesh::arrays::Association;
use lumen_mesh::parallel;
use lumen_mesh::{Array, Blend, Nearest, SurfaceIndex, TriMesh, Vec3, blended, triangle_area, used_vertices};

/// Closest points between two looks at the clock, and of one thread.
const SLICE: usize = 16_384;
const CHUNK: usize = 2_048;

/// The surface that entered decimation.
#[derive(Clone, Debug)]
pub struct Entered {
    /// Its arrays, for the vertices and triangles of `mesh`.
    pub arrays: Arc<Vec<Array>>,
    /// The surface.
    pub mesh: Arc<TriMesh>,
    /// An index of `mesh`.
    pub index: Arc<SurfaceIndex>,
    /// For each node the vertex of `mesh` that it is, [`MADE`] where it is none.
    pub vertex_of_node: Arc<[u32]>,
}

/// Carries arrays to the level of these `triangles` over the nodes; `level` is the same over its own vertices, `index` of
/// that.
pub async fn carry(
    from: &Entered,
    triangles: &[[u32; 3]],
    level: &TriMesh,
    index: &SurfaceIndex,
    yielder: &Yielder,
) -> Vec<Array> {
    let nodes = used_vertices(from.vertex_of_node.len(), triangles);
    let has = |on: Association| from.arrays.iter().any(|array| array.on == on);
    let wanted = |on: Association, count: usize| if has(on) { count } else { 0 };
    // How many points are looked for on the one surface and on the other.
    let (on_one, on_other) =
        (wanted(Association::Point, nodes.len()), wanted(Association::Triangle, from.mesh.triangles.len()));
    let all = (on_one + on_other) as f32;
    let (vertices, heirs) = (Blend::with_capacity(nodes.len(), nodes.len()), Vec::new());
    let mut carrying = Carrying { from, level, index, nodes, vertices, heirs };
    for block in blocks(on_one, SLICE) {
        let end = block.end;
        carrying.follow_vertices(block);
        yielder.rest(end as f32 / all).await;
    }
    for block in blocks(on_other, SLICE) {
        let end = block.end;
        carrying.follow_triangles(block);
        yielder.rest((on_one + end) as f32 / all).await;
    }
    let of_triangles = if on_other > 0 { carrying.triangles() } else { Blend::default() };
    blended(&from.arrays, &carrying.vertices, &of_triangles)
}

/// Arrays on their way to a level.
struct Carrying<'a> {
    from: &'a Entered,
    level: &'a TriMesh,
    index: &'a SurfaceIndex,
    /// The node that each vertex of the level is.
    nodes: Vec<u32>,
    vertices: Blend,
    /// The triangle of the level that each triangle gives its area to, so far.
    heirs: Vec<u32>,
}

impl Carrying<'_> {
    /// Finds what the next vertices of the level are made of.
    fn follow_vertices(&mut self, range: Range<usize>) {
        let Entered { index, vertex_of_node, .. } = self.from;
        let (nodes, positions) = (&self.nodes, &self.level.positions);
        let found = nearest(range.clone(), |v| {
            (vertex_of_node[nodes[v] as usize] == MADE).then(|| positions[v]).map(|p| (index.as_ref(), p))
        });
        for (v, found) in range.zip(found) {
            let own = vertex_of_node[nodes[v] as usize];
            if own != MADE {
                self.vertices.push(own, 1.0);
            } else if let Some(found) = found {
                let corners = self.from.mesh.triangles[found.triangle as usize];
                for (vertex, weight) in corners.into_iter().zip(found.barycentric) {
                    self.vertices.push(vertex, weight);
                }
            }
            self.vertices.finish_row();
        }
    }

    /// Finds the triangles of the level that the next triangles give their area to.
    fn follow_triangles(&mut self, range: Range<usize>) {
        let (index, mesh) = (self.index, &self.from.mesh);
        let found = nearest(range, |t| Some((index, centroid(mesh.corners(t)))));
        self.heirs.extend(found.iter().map(|found| found.map_or(u32::MAX, |found| found.triangle)));
    }

    /// What the triangles of the level are made of.
    fn triangles(&self) -> Blend {
        let mesh = &self.from.mesh;
        // A triangle without area still counts for something.
        let area = |t: usize| (triangle_area(mesh.corners(t)) as f32).max(f32::MIN_POSITIVE);
        let given = Blend::of_groups(self.level.triangles.len(), &self.heirs, area);
        let mut blend = Blend::with_capacity(given.len(), self.heirs.len());
        for t in 0..given.len() {
            match given.sources(t) {
                [] => {
                    if let Some(found) = self.from.index.nearest(centroid(self.level.corners(t))) {
                        blend.push(found.triangle, 1.0);
                    }
                }
                sources => sources.iter().for_each(|&(source, weight)| blend.push(source, weight)),
            }
            blend.finish_row();
        }
        blend
    }
}

/// The closest points to the points that `query` names with an index; none where it names none.
fn nearest<'a>(
    range: Range<usize>,
    query: impl Fn(usize) -> Option<(&'a SurfaceIndex, Vec3)> + Sync + Send,
) -> Vec<Option<Nearest>> {
    let chunks = parallel::map_ranges(range.len(), CHUNK, |chunk| {
        let mut last: Option<Nearest> = None;
        let mut found = Vec::with_capacity(chunk.len());
        for at in chunk {
            let answer = query(range.start + at).and_then(|(index, p)| match &last {
                Some(last) => index.nearest_from(p, last),
                None => index.nearest(p),
            });
            last = answer.or(last);
            found.push(answer);
        }
        found
    });
    chunks.concat()
}

fn centroid([a, b, c]: [Vec3; 3]) -> Vec3 {
    ((a.as_dvec3() + b.as_dvec3() + c.as_dvec3()) / 3.0).as_vec3()
}
