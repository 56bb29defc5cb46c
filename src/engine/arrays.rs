//! Arrays as they are shown: one number a vertex.
//!
//! A vector is its magnitude. What is on triangles is shown at their vertices: the mean of the triangles around, weighted
//! by area, of labels the one with most area.

use crate::mesh::arrays::Association;
use crate::mesh::{Array, Blend, triangle_area};
use crate::pipeline::results::Reduced;

/// For each array a number for each vertex of the level, one array after the other.
pub(super) fn by_vertex(arrays: &[Array], reduced: &Reduced) -> Vec<f32> {
    let around = arrays.iter().any(|array| array.on == Association::Triangle).then(|| around(reduced));
    let mut numbers = Vec::with_capacity(arrays.len() * reduced.mesh.positions.len());
    for array in arrays {
        let at_vertices = around.as_ref().filter(|_| array.on == Association::Triangle).map(|blend| blend.of(array));
        let array = at_vertices.as_ref().unwrap_or(array);
        numbers.extend((0..array.len()).map(|v| array.magnitude(v) as f32));
    }
    numbers
}

/// The triangles around each vertex.
fn around(reduced: &Reduced) -> Blend {
    let (mesh, topology) = (&reduced.mesh, &reduced.topology);
    let areas: Vec<f32> = (0..mesh.triangles.len()).map(|t| triangle_area(mesh.corners(t)) as f32).collect();
    let mut blend = Blend::with_capacity(mesh.positions.len(), 3 * mesh.triangles.len());
    for v in 0..mesh.positions.len() as u32 {
        for &t in topology.triangles(v) {
            blend.push(t, areas[t as usize].max(f32::MIN_POSITIVE));
        }
        blend.finish_row();
    }
    blend
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::mesh::arrays::Values;
    use crate::mesh::shapes::icosphere;
    use crate::mesh::{TriMesh, Vec3};
    use crate::pipeline::run::Pipeline;
    use crate::pipeline::settings::{Preset, Settings, Target};

    #[test]
    fn vertices_have_magnitudes_and_what_the_triangles_around_have() {
        let mesh: TriMesh = icosphere(3, 40.0, Vec3::ZERO);
        let vectors: Vec<f32> = mesh.positions.iter().flat_map(Vec3::to_array).collect();
        let north: Vec<f32> =
            (0..mesh.triangles.len()).map(|t| f32::from(u8::from(mesh.corners(t)[0].z > 0.0))).collect();
        let arrays = vec![
            Array::new("Place", Association::Point, 3, Values::from_floats(&vectors)),
            Array::new("North", Association::Triangle, 1, Values::from_floats(&north)),
        ];
        let settings =
            Settings { smoothing: Preset::None.smoothing(), target: Target::Reduction(500), ..Settings::default() };
        let mut pipeline = Pipeline::new(Arc::new(mesh), settings).with_samples(100).with_arrays(arrays);
        pipeline.finish().unwrap();
        let (reduced, carried) = (pipeline.reduced().unwrap(), pipeline.level_arrays().unwrap());
        let numbers = by_vertex(carried, reduced);
        let (places, north) = numbers.split_at(reduced.mesh.positions.len());
        assert!(places.iter().all(|radius| (radius - 40.0).abs() < 1e-3));
        for (p, north) in reduced.mesh.positions.iter().zip(north) {
            assert!(if p.z > 15.0 { *north == 1.0 } else { p.z > -15.0 || *north == 0.0 }, "{p}: {north}");
        }
    }
}
