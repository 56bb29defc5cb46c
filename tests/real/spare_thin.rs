//! Reduction that spares thin vessels beside the plain one, at equal counts: what becomes of each branch.
//!
//! `LUMEN_LONG=1 cargo test --test real -- "spare thin" --nocapture` prints the tables of `docs/benchmarks/calibre.md`; else one
//! surface is tried.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use libtest_mimic::{Failed, Trial};
use lumen::io::{ImportOptions, read};
use lumen::mesh::TriMesh;
use lumen::phantom::{Sample, generate};
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Decimation, Method, Settings, Target};
use lumen::vessel::certificate::Verdict;
use lumen_test_support::is_long;

/// In tenths of a percent.
const RATES: [u32; 3] = [900, 950, 990];

/// The one that is always tried.
const SHORT: &str = "aorta-surface-open-ends.stl";

/// Samples that the weights were chosen by, and others that they were not.
const SAMPLES: [(&str, Sample, usize); 6] = [
    ("sample:aorta", Sample::Aorta, 74_307),
    ("sample:coronary", Sample::Coronary, 380_000),
    ("not chosen by: aorta, 20,000", Sample::Aorta, 20_000),
    ("not chosen by: aorta, 300,000", Sample::Aorta, 300_000),
    ("not chosen by: coronary, 60,000", Sample::Coronary, 60_000),
    ("not chosen by: coronary, 150,000", Sample::Coronary, 150_000),
];

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(data.join("real")).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    files.sort();
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    // VTK XML is not read.
    let is_tried =
        |path: &PathBuf| path.extension().is_some_and(|end| end != "vtp") && (is_long() || name(path) == SHORT);
    let of_file = |path: PathBuf| {
        let name = name(&path);
        Trial::test(format!("spare thin: {name}"), move || {
            check(&name, read(&std::fs::read(&path)?, &name, &ImportOptions::default())?.mesh)
        })
    };
    let of_sample = |(name, sample, count): (&'static str, Sample, usize)| {
        Trial::test(format!("spare thin: {name}"), move || check(name, generate(sample, count)?))
    };
    let samples = SAMPLES.into_iter().filter(|_| is_long());
    files.into_iter().filter(is_tried).map(of_file).chain(samples.map(of_sample)).collect()
}

/// Prints a row for each method and order, and checks that the counts are exact and nothing new crosses.
fn check(name: &str, mesh: TriMesh) -> Result<(), Failed> {
    let mut pipeline = Pipeline::new(Arc::new(mesh), Settings::default()).with_safe();
    for (method, spare_thin) in Method::ALL.into_iter().flat_map(|method| [(method, false), (method, true)]) {
        let decimation = Decimation { method, spare_thin, ..Decimation::default() };
        let mut columns = vec![Vec::new(); 5];
        let mut measured = 0;
        for rate in RATES {
            let target = Target::Reduction(rate);
            pipeline.set(Settings { decimation, target, ..Settings::default() })?;
            pipeline.finish()?;
            let (reduced, smoothed) = (pipeline.reduced().ok_or("no level")?, pipeline.smoothed().ok_or("no surface")?);
            let (wanted, count) = (target.triangles(smoothed.mesh.triangles.len()), reduced.mesh.triangles.len());
            if reduced.level.shortfall.is_none() && !(count <= wanted && count + 2 > wanted) {
                return Err(format!("{method:?}, {spare_thin}: {count} triangles, not {wanted}").into());
            }
            let before = pipeline.smoothed_measures().ok_or("no measures")?.shape.self_intersecting_faces;
            let after = pipeline.level_measures().ok_or("no measures")?.shape.self_intersecting_faces;
            if after > before {
                return Err(format!("{method:?}, {spare_thin} at {rate}: {after} cross, {before} before").into());
            }
            let Ok(certified) = pipeline.certified().ok_or("no certificate")? else {
                println!("no tree in {name}");
                return Ok(());
            };
            let certificate = &certified.certificate;
            // What smoothing has changed does not tell of the reduction.
            let branches = || certificate.branches.iter().filter(|branch| branch.verdict_smoothed == Verdict::Kept);
            measured = branches().count();
            let changes = branches().filter_map(|branch| branch.reduced.largest_change);
            let changes: Vec<f64> = changes.map(|change| change.percent.abs()).collect();
            let deviation =
                pipeline.deviations().and_then(|found| found.from_smoothed.clone()).ok_or("no area")?.deviation;
            let numbers = [
                branches().filter(|branch| branch.verdict != Verdict::Kept).count().to_string(),
                format!("{:.2}", changes.iter().sum::<f64>() / changes.len().max(1) as f64),
                format!("{:.1}", changes.iter().copied().fold(0.0, f64::max)),
                format!("{:.3}", deviation.mean),
                format!("{:.2}", deviation.max),
            ];
            columns.iter_mut().zip(numbers).for_each(|(column, number)| column.push(number));
        }
        let safe = pipeline.safe().and_then(|safe| safe.percent).map_or("–".to_owned(), |safe| format!("{safe:.1}"));
        let pinch = pipeline.smoothed_measures().and_then(|measures| measures.pinch);
        let pinch = pinch.map_or("–".to_owned(), |pinch| format!("{:.1}", pinch.from_percent));
        let cells: Vec<String> = columns.iter().map(|column| column.join(", ")).collect();
        let order = if spare_thin { "spared" } else { "plain" };
        println!("| {name} | {method:?} | {order} | {measured} | {} | {safe} | {pinch} |", cells.join(" | "));
    }
    Ok(())
}
