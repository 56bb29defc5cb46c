//! What a step of the trial costs, against triangles and against nodes: `cargo bench --bench trial --no-default-features`.
//!
//! The workhorse wire, cut into equal elements, is fed into the coronary sample, unreduced, until it has the nodes; then
//! one scripted input moves and rolls it to and fro. Arguments are triangle counts or, with an `n` behind them, node
//! counts: `-- 10000 1000000 300n`. With `LUMEN_TRIAL_LOG` surface, setup and log of the last are left in that folder, for
//! `benches/trial.mjs` to replay in the browser's Worker.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use lumen::io::import_mesh;
use lumen::mesh::TriMesh;
use lumen::phantom::{Sample, generate};
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Target};
use lumen::trial::course::Course;
use lumen::trial::frame::Progress;
use lumen::trial::session::Trial;
use lumen::trial::setup::{Input, Setup};
use lumen::trial::wire::Wire;

/// Length of the wire outside the guide, in mm.
const LENGTH: f64 = 100.0;
/// Nodes where triangles vary.
const NODES: usize = 300;
/// Triangles where nodes vary.
const TRIANGLES: usize = 380_000;
/// Steps that are timed.
const STEPS: usize = 3000;

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let is_nodes = |text: &&String| text.ends_with('n');
    let number =
        |text: &String| text.trim_end_matches('n').parse().expect("a number of triangles, or of nodes with an n");
    let mut triangles: Vec<usize> = asked.iter().filter(|text| !is_nodes(text)).map(number).collect();
    let mut nodes: Vec<usize> = asked.iter().filter(is_nodes).map(number).collect();
    if asked.is_empty() {
        triangles = vec![10_000, 100_000, 1_000_000, 4_000_000];
        nodes = vec![50, 100, 200, 400, 800];
    }
    println!("| triangles | nodes | touching | mean ms | p50 | p99 | max | steps/s | boxes ms |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for count in triangles {
        let mesh =
            Arc::new(import_mesh(generate(Sample::Coronary, count.max(60_000)).expect("a sample"), "sample").mesh);
        measure(&level(mesh, count), NODES);
    }
    if !nodes.is_empty() {
        let mesh = Arc::new(import_mesh(generate(Sample::Coronary, TRIANGLES).expect("a sample"), "sample").mesh);
        let mesh = level(mesh, TRIANGLES);
        nodes.into_iter().for_each(|count| measure(&mesh, count));
    }
}

fn level(mesh: Arc<TriMesh>, count: usize) -> Arc<TriMesh> {
    let smoothing = Smoothing { pass_band: 0.1, iterations: 30, ..Smoothing::default() };
    let settings = Settings { smoothing, target: Target::Triangles(count as u32), ..Settings::default() };
    let mut pipeline = Pipeline::new(mesh, settings).without_measures();
    pipeline.finish().expect("settings that are allowed");
    pipeline.reduced().expect("a level").mesh.clone()
}

fn measure(mesh: &Arc<TriMesh>, nodes: usize) {
    let wire = Wire { elements_mm: [LENGTH / nodes as f64; 2], ..Wire::preset("workhorse").expect("a preset") };
    let mut setup = Setup { wire, ..Setup::default() };
    let course = Arc::new(Course::new(mesh, Some(Sample::Coronary), &mut setup).expect("a way"));
    let mut trial = Trial::new(course.clone(), setup).expect("room");
    trial.drive(Input { feed: 20.0, roll: 0.0 });
    while trial.simulation().count() < nodes {
        trial.step();
        assert_eq!(trial.progress(), Progress::Running, "with {} nodes", trial.simulation().count());
    }
    let mut times = Vec::with_capacity(STEPS);
    let mut touching = 0;
    for step in 0..STEPS {
        trial.drive(Input { feed: if step / 250 % 2 == 0 { -10.0 } else { 10.0 }, roll: 2.0 });
        let start = Instant::now();
        trial.step();
        times.push(start.elapsed().as_secs_f64() * 1e3);
        let mut at: Vec<usize> = trial.simulation().body().touches().map(|touch| touch.0).collect();
        at.sort_unstable();
        at.dedup();
        touching += at.len();
    }
    assert_eq!(trial.progress(), Progress::Running);
    times.sort_by(f64::total_cmp);
    let mean = times.iter().sum::<f64>() / STEPS as f64;
    let at = |part: f64| times[((STEPS as f64 * part) as usize).min(STEPS - 1)];
    println!(
        "| {} | {} | {:.0} % | {mean:.3} | {:.3} | {:.3} | {:.3} | {:.0} | {:.0} |",
        mesh.triangles.len(),
        trial.simulation().count(),
        100.0 * touching as f64 / (STEPS * trial.simulation().count()) as f64,
        at(0.5),
        at(0.99),
        at(1.0),
        1e3 / mean,
        course.wall_ms,
    );
    if let Some(folder) = std::env::var_os("LUMEN_TRIAL_LOG") {
        leave(Path::new(&folder), mesh, &trial).expect("a folder that can be written");
    }
}

/// Writes what the same trial needs elsewhere.
fn leave(folder: &Path, mesh: &TriMesh, trial: &Trial) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let steps = trial.simulation().steps();
    let facts = serde_json::json!({ "setup": trial.setup(), "steps": steps, "scripted": STEPS });
    std::fs::write(folder.join("trial.json"), facts.to_string())?;
    std::fs::write(folder.join("positions"), bytemuck::cast_slice(&mesh.positions))?;
    std::fs::write(folder.join("triangles"), bytemuck::cast_slice(&mesh.triangles))?;
    std::fs::write(folder.join("log.csv"), trial.log().csv(steps).map_err(std::io::Error::other)?)
}
