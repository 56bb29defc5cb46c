//! Error against triangles: the whole curve of a surface from its one progressive mesh.
//!
//! The error is the one that the method has logged at each step, made non-decreasing: for Schroeder the distance of the
//! neighbour that took over from the planes (root mean square) or the line that the vertex stood for, for quadrics that of
//! the new vertex from the planes. It is what the steps are ordered by, an estimate and no bound: what a level is off by is
//! measured (`super::deviation`).

use super::progressive::ProgressiveMesh;

/// A level on the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// Its triangles.
    pub triangles: usize,
    /// The largest error of the steps that led to it, in mm; 0 for the finest.
    pub error_mm: f32,
}

impl ProgressiveMesh {
    /// The largest error that the method has logged up to the level after `steps` steps, in mm.
    pub fn error_after(&self, steps: u32) -> f32 {
        steps.checked_sub(1).and_then(|last| self.errors.get(last as usize)).copied().unwrap_or(0.0)
    }

    /// At most `count` levels from the finest to the coarsest, evenly spaced in the logarithm of their triangles; none
    /// without triangles.
    pub fn error_curve(&self, count: usize) -> Vec<CurvePoint> {
        let (finest, coarsest) = (self.triangles.len(), self.triangles_after(self.errors.len() as u32));
        if finest == 0 || count == 0 {
            return Vec::new();
        }
        let ratio = coarsest.max(1) as f64 / finest as f64;
        let wanted =
            |i: usize| (finest as f64 * libm::pow(ratio, i as f64 / count.max(2).saturating_sub(1) as f64)).round();
        let mut steps: Vec<u32> = (0..count).map(|i| self.steps_to(wanted(i) as usize)).collect();
        steps.dedup();
        let point = |steps| CurvePoint { triangles: self.triangles_after(steps), error_mm: self.error_after(steps) };
        steps.into_iter().map(point).collect()
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::decimation::decimate;
    use crate::settings::{Decimation, Method};
    use lumen_mesh::Topology;
    use lumen_mesh::shapes::{icosphere, sagitta};

    #[test]
    fn the_curve_begins_at_nothing_never_falls_and_ends_at_the_last_step() {
        let sphere = icosphere(4, 10.0, Vec3::ZERO);
        let topology = Topology::new(sphere.positions.len(), &sphere.triangles);
        for method in Method::ALL {
            let levels = decimate(&sphere, &topology, &Decimation { method, ..Decimation::default() });
            let curve = levels.error_curve(60);
            assert_eq!(curve[0], CurvePoint { triangles: sphere.triangles.len(), error_mm: 0.0 });
            assert!(curve.windows(2).all(|pair| pair[0].triangles > pair[1].triangles));
            assert!(curve.windows(2).all(|pair| pair[0].error_mm <= pair[1].error_mm), "{method:?}");
            let last = curve[curve.len() - 1];
            let largest = levels.costs.iter().copied().fold(0.0, f32::max);
            assert_eq!((last.triangles, last.error_mm), (levels.triangles_after(levels.errors.len() as u32), largest));
            // A tenth of the triangles of a sphere: of the order of the sagitta of its edges, which grows tenfold.
            let tenth = curve.iter().find(|point| point.triangles <= sphere.triangles.len() / 10).unwrap();
            let sagitta = sagitta(&sphere, 10.0, Vec3::ZERO);
            assert!((1.0..40.0).contains(&(tenth.error_mm / sagitta)), "{method:?}: {} {sagitta}", tenth.error_mm);
        }
        assert_eq!(ProgressiveMesh::default().error_curve(60), []);
    }
}
