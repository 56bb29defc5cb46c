//! Reduction by an error spare_thin to the calibre beside the plain one, at equal count: what becomes of each branch.
//!
//! `LUMEN_LONG=1 cargo test --test real -- spare_thin --nocapture` prints the table of `docs/benchmarks.md`.

use std::path::Path;
use std::sync::Arc;

use libtest_mimic::{Failed, Trial};
use lumen::io::{ImportOptions, read};
use lumen::mesh::TriMesh;
use lumen::phantom::{Sample, generate};
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Decimation, Method, Settings, Target};
use lumen::task::Task;
use lumen::vessel::certificate::{TOLERANCE_PERCENT, Verdict};

const RATES: [u32; 3] = [900, 950, 990];

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let mut files: Vec<_> = std::fs::read_dir(data.join("real")).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    let mut trials: Vec<Trial> = files
        .into_iter()
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            Trial::test(format!("spare_thin: {name}"), move || {
                let mesh = read(&std::fs::read(&path)?, &name, &ImportOptions::default())?.mesh;
                check(&name, mesh)
            })
        })
        .collect();
    for (name, sample, count) in
        [("sample:aorta", Sample::Aorta, 74_307), ("sample:coronary", Sample::Coronary, 380_000)]
    {
        trials.push(Trial::test(format!("spare_thin: {name}"), move || {
            check(name, generate(sample, count).map_err(|e| e.to_string())?)
        }));
    }
    trials
}

fn check(name: &str, mesh: TriMesh) -> Result<(), Failed> {
    let opened = Arc::new(mesh);
    let only = std::env::var("LUMEN_ONLY").unwrap_or_default();
    let mut pipeline = Pipeline::new(opened, Settings::default()).with_samples(100_000).with_safe(TOLERANCE_PERCENT);
    for method in Method::ALL {
        for spare_thin in [false, true] {
            if (only == "on" && !spare_thin) || (only == "off" && spare_thin) {
                continue;
            }
            let decimation = Decimation { method, spare_thin, ..Decimation::default() };
            let mut safe = None;
            for rate in RATES {
                pipeline.set(Settings { decimation, target: Target::Reduction(rate), ..Settings::default() })?;
                pipeline.finish()?;
                safe = safe.or(pipeline.safe().cloned());
                let reduced = pipeline.reduced().ok_or("no level")?;
                let d = pipeline.deviations().and_then(|d| d.from_smoothed.clone()).map(|c| c.deviation);
                let pinch = pipeline.smoothed_measures().and_then(|m| m.pinch).map(|p| p.from_percent);
                let certificate = pipeline.certificate(TOLERANCE_PERCENT).ok_or("none")?.finish();
                let Ok(certificate) = certificate else {
                    println!("ROW {name} {method:?} {spare_thin} {rate} {} none", reduced.mesh.triangles.len());
                    continue;
                };
                let measured: Vec<_> =
                    certificate.branches.iter().filter(|b| b.verdict_smoothed == Verdict::Kept).collect();
                let changed = measured.iter().filter(|b| b.verdict == Verdict::Changed).count();
                let lost = measured.iter().filter(|b| b.verdict == Verdict::NotMeasured).count();
                if std::env::var("LUMEN_SHOW").is_ok() {
                    for b in &certificate.branches {
                        println!(
                            "BRANCH {} {:?} r {:?} smoothed {:?} {:?} -> {:?} {:?}",
                            b.number,
                            b.verdict,
                            b.opened.radius_mm.map(|s| (s.least, s.mean, s.largest)),
                            b.verdict_smoothed,
                            b.smoothed.largest_change.map(|c| c.percent),
                            b.reduced.largest_change.map(|c| (c.percent, c.at_mm)),
                            b.stations_counted
                        );
                    }
                }
                let changes: Vec<f64> =
                    measured.iter().filter_map(|b| b.reduced.largest_change).map(|c| c.percent.abs()).collect();
                let worst = changes.iter().copied().fold(0.0, f64::max);
                let mean = changes.iter().sum::<f64>() / changes.len().max(1) as f64;
                println!(
                    "ROW {name} {method:?} {spare_thin} {rate} {} {:.4} {:.4} {} {changed} {lost} {worst:.2} {mean:.3} pinch {pinch:?} safe {:?}",
                    reduced.mesh.triangles.len(),
                    d.map_or(-1.0, |d| d.mean),
                    d.map_or(-1.0, |d| d.max),
                    measured.len(),
                    safe.as_ref().and_then(|s| s.percent)
                );
            }
        }
    }
    Ok(())
}
