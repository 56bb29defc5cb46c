//! What decimation promises of any level under any settings, and any settings.

use std::collections::HashSet;

use lumen_mesh::{Topology, TriMesh, volume};
use lumen_pipeline::run::Pipeline;
use lumen_pipeline::settings::{Boundary, Method, Settings, Smoothing, Target, Window};
use proptest::prelude::*;

use crate::shape::Shape;

/// Table II of the paper, in tenths of a percent.
pub const RATES: [u32; 5] = [100, 500, 750, 900, 990];

/// Triangles below which a target may be out of reach: a torus cannot do with fewer than 14, and each further handle
/// and open end needs some of its own.
fn fewest(shape: &Shape) -> usize {
    let handles = (2 * shape.components as i64 - shape.boundaries as i64 - shape.euler).max(0) as usize / 2;
    64 + 24 * handles + 12 * shape.boundaries
}

/// Any settings: every switch of the smoothing and of the decimation, on and off.
pub fn settings() -> impl Strategy<Value = Settings> {
    let window = prop::sample::select(Window::ALL.to_vec());
    let method = prop::sample::select(Method::ALL.to_vec());
    let boundary = prop::sample::select(vec![Boundary::Loop, Boundary::Vtk15]);
    let pass_band = (-3.0f64..0.3).prop_map(|power| libm::pow(10.0, power).clamp(0.001, 2.0));
    let rate = prop_oneof![prop::sample::select(RATES.to_vec()), 0u32..=999];
    let switches = (any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>());
    let smoothing = (window, pass_band, 0u32..=120, boundary, switches).prop_map(
        |(window, pass_band, iterations, boundary, (preserve_volume, adapt, guard, hold_caps))| Smoothing {
            window,
            pass_band,
            iterations,
            boundary,
            preserve_volume,
            adapt,
            guard,
            hold_caps,
        },
    );
    (smoothing, method, 0.0f64..=180.0, rate, any::<bool>()).prop_map(
        |(smoothing, method, feature_angle, rate, spare_thin)| {
            let mut settings = Settings { smoothing, target: Target::Reduction(rate), ..Settings::default() };
            settings.decimation.method = method;
            settings.decimation.feature_angle = feature_angle;
            settings.decimation.spare_thin = spare_thin;
            settings
        },
    )
}

/// All that holds of any level under any settings.
pub fn check(pipeline: &mut Pipeline) -> Result<(), String> {
    let first = pipeline.settings().clone();
    let mut finer: Option<HashSet<[u32; 3]>> = None;
    for rate in [first.target, Target::Reduction(950), Target::Reduction(990), Target::Triangles(1)] {
        pipeline.set(Settings { target: rate, ..first.clone() }).map_err(|error| error.to_string())?;
        pipeline.finish().map_err(|error| error.to_string())?;
        let (Some(smoothed), Some(reduced), Some(levels)) =
            (pipeline.smoothed(), pipeline.reduced(), pipeline.progressive())
        else {
            return Err("no result".to_owned());
        };
        levels.assert_well_formed();
        let (before, after) = (Shape::of(&smoothed.mesh), Shape::of(&reduced.mesh));
        if before != after {
            return Err(format!("{rate:?}: {before:?} became {after:?}"));
        }
        let (wanted, count) = (rate.triangles(smoothed.mesh.triangles.len()), reduced.mesh.triangles.len());
        match &reduced.level.shortfall {
            None if count <= wanted && count + 2 > wanted => {}
            // Where almost every edge is a feature there may be nothing left that can go, nor where vertices stay because
            // the surface was cut there.
            Some(shortfall) if count > wanted && (wanted < fewest(&before) || shortfall.limit.complex > 0) => {
                let told = shortfall.reached as usize == count && shortfall.wanted as usize == wanted;
                if !told || shortfall.to_string().is_empty() {
                    return Err(format!("{rate:?}: {count} triangles, but {shortfall:?}"));
                }
            }
            shortfall => return Err(format!("{rate:?}: {count} triangles, {wanted} wanted: {shortfall:?}")),
        }
        if first.decimation == Settings::default().decimation && before.boundaries == 0 && count > 200 {
            let of = |mesh: &TriMesh| volume(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles));
            let (before, after) = (of(&smoothed.mesh), of(&reduced.mesh));
            if before.signum().to_bits() != after.signum().to_bits() {
                return Err(format!("{rate:?}: the volume went from {before} to {after} mm3"));
            }
        }
        if first.decimation.method != Method::Schroeder {
            continue;
        }
        // A vertex of a level is one of every finer level, up to the smoothed surface.
        let places = |mesh: &TriMesh| mesh.positions.iter().map(|p| p.to_array().map(f32::to_bits)).collect();
        let these: HashSet<[u32; 3]> = places(&reduced.mesh);
        let outer: HashSet<[u32; 3]> = places(&smoothed.mesh);
        if !these.is_subset(&outer) {
            return Err(format!("{rate:?}: a vertex is none of the smoothed surface's"));
        }
        let is_coarser = finer.as_ref().is_none_or(|finer| finer.len() >= these.len());
        if let Some(finer) = finer.as_ref().filter(|_| is_coarser)
            && !these.is_subset(finer)
        {
            return Err(format!("{rate:?}: a vertex is none of the finer level's"));
        }
        finer = Some(these);
    }
    Ok(())
}
