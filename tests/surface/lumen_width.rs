//! Thin vessels under reduction: what the report says of them is what is there.

use std::sync::Arc;

use lumen::io::import_mesh;
use lumen::mesh::{SurfaceIndex, Vec3};
use lumen::phantom::{Sample, generate};
use lumen::pipeline::report::Report;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Target};

/// On the coronary tree, at all rates: the narrowed place is as far from the walls as the report says, a warning is
/// given exactly where less than half of a vessel is left, and the rate at which the first is pinched parts those with
/// a warning from those without.
#[test]
fn the_coronary_tree_is_watched_at_every_rate() {
    let mesh = import_mesh(generate(Sample::Coronary, 60_000).unwrap(), "sample").mesh;
    let smoothing = Smoothing { pass_band: 0.1, iterations: 30, ..Smoothing::default() };
    let mut pipeline =
        Pipeline::new(Arc::new(mesh), Settings { smoothing, target: Target::Reduction(900), ..Settings::default() })
            .with_samples(2_000);
    for rate in [0, 500, 750, 900, 950, 990, 999] {
        let settings = Settings { target: Target::Reduction(rate), ..pipeline.settings().clone() };
        pipeline.set(settings).unwrap();
        pipeline.finish().unwrap();
        let report = Report::new("sample", &pipeline).unwrap();
        let narrowing = report.narrowing.unwrap();
        let [before, after] = [&pipeline.smoothed().unwrap().mesh, &pipeline.reduced().unwrap().mesh].map(|mesh| {
            let index = SurfaceIndex::new(&mesh.positions, &mesh.triangles);
            2.0 * f64::from(index.nearest(Vec3::from(narrowing.at_mm)).unwrap().distance)
        });
        assert!((before - narrowing.diameter_before_mm).abs() < 1e-4, "{rate}: {narrowing:?}, {before}");
        let is_lost = narrowing.diameter_after_mm == 0.0;
        assert!(is_lost || (after - narrowing.diameter_after_mm).abs() < 1e-4, "{rate}: {narrowing:?}, {after}");
        let half = narrowing.diameter_after_mm < 0.5 * narrowing.diameter_before_mm;
        assert_eq!(narrowing.pinched_places > 0, half, "{rate}: {narrowing:?}");
        assert_eq!(report.pinch_warning().is_some(), half, "{rate}");
        match report.pinch {
            Some(pinch) if pinch.from_percent > f64::from(rate) / 10.0 => assert!(rate > 0 || !half, "{narrowing:?}"),
            Some(_) => {}
            None => assert!(!half, "{rate}: {narrowing:?}"),
        }
        assert!(rate > 0 || narrowing.ratio == 1.0, "{narrowing:?}");
        assert!(rate < 999 || half, "sixty triangles are no coronary tree: {narrowing:?}");
        assert!(report.smoothed_shape.is_some() && report.output_shape.is_some());
        let smallest = report.smoothed_shape.unwrap().smallest_lumen.unwrap();
        // The branches end at 1.5 mm; cut from voxels of 1 mm and smoothed, they are narrower there.
        assert!((0.2..1.6).contains(&smallest.diameter_mm), "{smallest:?}");
    }
}
