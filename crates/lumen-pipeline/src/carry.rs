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
/// Two triangles face the same way where the cosine between their normals is larger.
const ALIKE: f32 = 0.5;

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

/// Carries the arrays of a surface to another one that lies on it but for what was cut off, put on or filled. Of the first,
/// triangles farther from the other than those there are wide, or that face another way, give nothing; where there is no
/// surface of before, values are those of the closest point. Every vertex of `to` is of a triangle.
pub async fn carry_over(arrays: Vec<Array>, mesh: &TriMesh, to: &TriMesh, yielder: &Yielder) -> Vec<Array> {
    let index = SurfaceIndex::new(&to.positions, &to.triangles);
    let normal = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).normalize_or_zero();
    let mut kept = Vec::with_capacity(mesh.triangles.len());
    for block in blocks(mesh.triangles.len(), SLICE) {
        let found = nearest(block.clone(), |t| Some((&index, centroid(mesh.corners(t)))));
        for (t, found) in block.clone().zip(found) {
            let is_of_other = found.is_some_and(|found| {
                let corners = to.corners(found.triangle as usize);
                let width = triangle_area(corners).sqrt() as f32;
                found.distance <= width && normal(corners).dot(normal(mesh.corners(t))) > ALIKE
            });
            kept.extend(is_of_other.then_some(t as u32));
        }
        yielder.rest(0.5 * block.end as f32 / mesh.triangles.len() as f32).await;
    }
    let own = Blend::of_rows(0..mesh.positions.len() as u32);
    let arrays = blended(&arrays, &own, &Blend::of_rows(kept.iter().copied()));
    let all = TriMesh {
        triangles: kept.iter().map(|&t| mesh.triangles[t as usize]).collect(),
        positions: mesh.positions.clone(),
    };
    if all.triangles.is_empty() {
        return Vec::new();
    }
    let from = Entered {
        arrays: arrays.into(),
        index: Arc::new(SurfaceIndex::new(&all.positions, &all.triangles)),
        mesh: all.into(),
        vertex_of_node: vec![MADE; to.positions.len()].into(),
    };
    carry(&from, &to.triangles, to, &index, &yielder.part(0.5..1.0)).await
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

#[cfg(test)]
mod tests {
    use lumen_mesh::arrays::{Scalar, Values};
    use lumen_mesh::shapes::tube;
    use lumen_mesh::task::at_once;

    use super::*;

    /// Heights at the vertices, and a label for each stretch of 10 mm on the triangles.
    fn with_arrays(mesh: &TriMesh) -> Vec<Array> {
        let heights: Vec<f32> = mesh.positions.iter().map(|p| p.z).collect();
        let stretches = (0..mesh.triangles.len()).map(|t| f64::from((centroid(mesh.corners(t)).z / 10.0).floor()));
        vec![
            Array::new("height", Association::Point, 1, Values::from_floats(&heights)),
            Array::new("stretch", Association::Triangle, 1, Values::of(Scalar::I32, stretches)),
        ]
    }

    #[test]
    fn a_part_with_other_triangles_has_the_values_of_its_places_and_none_of_what_was_cut_off() {
        let whole = tube(60, 200, 40.0, |_| 3.0);
        // From 12 to 38 mm: the first stretch is cut off.
        let mut part = tube(24, 37, 26.0, |_| 3.0);
        part.positions.iter_mut().for_each(|p| p.z += 12.0);
        let arrays = with_arrays(&whole);
        let carried = at_once(carry_over(arrays, &whole, &part, &Yielder::never()));
        let [heights, stretches] = &carried[..] else { panic!("{carried:?}") };
        assert_eq!((heights.len(), stretches.len()), (part.positions.len(), part.triangles.len()));
        for (v, p) in part.positions.iter().enumerate() {
            assert!((heights.values.get(v) - f64::from(p.z)).abs() < 0.01, "{} at {p}", heights.values.get(v));
        }
        for t in 0..part.triangles.len() {
            let zs = part.corners(t).map(|p| p.z);
            let [low, high] = [zs.into_iter().fold(f32::MAX, f32::min), zs.into_iter().fold(0.0, f32::max)];
            let stretch = stretches.values.get(t) as f32;
            assert!(
                stretch == (low / 10.0).floor() || stretch == (high / 10.0).floor(),
                "{stretch} at {low} to {high}"
            );
        }
        assert_eq!((0..stretches.len()).map(|t| stretches.values.get(t)).fold(9.0, f64::min), 1.0);
    }

    #[test]
    fn what_was_put_on_has_the_values_where_it_begins() {
        let whole = tube(48, 100, 20.0, |_| 2.0);
        let longer = tube(48, 160, 32.0, |_| 2.0);
        let carried = at_once(carry_over(with_arrays(&whole), &whole, &longer, &Yielder::never()));
        for (v, p) in longer.positions.iter().enumerate() {
            assert!((carried[0].values.get(v) - f64::from(p.z.min(20.0))).abs() < 0.01);
        }
        for t in 0..longer.triangles.len() {
            let z = centroid(longer.corners(t)).z;
            assert_eq!(carried[1].values.get(t), if z < 10.0 { 0.0 } else { 1.0 }, "at {z}");
        }
    }
}
