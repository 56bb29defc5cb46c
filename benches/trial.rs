//! What a step of the trial costs, against triangles and against nodes: `cargo bench --bench trial --no-default-features`.
//!
//! A wire of equal elements is steered by the autopilot until [`LENGTH`] of it lie in the coronary sample, on the route,
//! whatever the surface; then one scripted input moves and rolls it to and fro. Arguments are triangle counts or, with an
//! `n` behind them, node counts: `-- 10000 1000000 300n`. Counts below a million are levels of the sample of a million.
//!
//! Two inputs: `workhorse`, which touches here and there as wires do, and, with a `p` before the count, `pressed`: a soft
//! wire that lies along one side from its guide on, and is pressed outward to the wall, so that most of it is in contact.
//! At the wall is a node with a contact that takes part in the step: nearer than 0.1 mm, beside the radius.
//!
//! With `LUMEN_TRIAL_LOG` surface, setup and log of the last are left in that folder, for `benches/trial.mjs` to replay
//! in the browser's Worker.

use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;
use lumen::io::import_mesh;
use lumen::mesh::TriMesh;
use lumen::phantom::{Sample, generate};
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Target};
use lumen::trial::course::Course;
use lumen::trial::frame::Progress;
use lumen::trial::session::Trial;
use lumen::trial::setup::{Entry, Input, Press, Setup};
use lumen::trial::wire::Wire;

/// Length of the wire outside the guide, in mm.
const LENGTH: f64 = 100.0;
/// Nodes where triangles vary.
const NODES: usize = 300;
/// Triangles where nodes vary.
const TRIANGLES: usize = 380_000;
/// Triangles of the sample that smaller levels are made from.
const WHOLE: usize = 1_000_000;
/// Bending stiffness of the pressed wire, all along, in N mm2.
const SOFT: f64 = 0.15;
/// What presses it: from a little less than [`LENGTH`] on.
const PRESS: Press = Press { n_per_mm: 0.012, from_mm: 94.0 };
/// Distance of its entry from the wall in mm.
const BESIDE: f64 = 0.27;
/// Steps that are timed.
const STEPS: usize = 3000;

/// What is done to the wire beside the input.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Workhorse,
    Pressed,
}

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let number = |text: &str| text.parse::<usize>().expect("a number of triangles, with a p before or an n behind it");
    let mut rows: Vec<(Kind, usize, usize)> = Vec::new();
    for text in &asked {
        rows.push(match (text.strip_prefix('p'), text.strip_suffix('n')) {
            (Some(count), _) => (Kind::Pressed, number(count), NODES),
            (_, Some(nodes)) => (Kind::Workhorse, TRIANGLES, number(nodes)),
            _ => (Kind::Workhorse, number(text), NODES),
        });
    }
    if asked.is_empty() {
        rows.extend([10_000, 100_000, WHOLE, 4_000_000].map(|count| (Kind::Workhorse, count, NODES)));
        rows.extend([10_000, WHOLE].map(|count| (Kind::Pressed, count, NODES)));
        rows.extend([50, 100, 200, 400, 800].map(|nodes| (Kind::Workhorse, TRIANGLES, nodes)));
    }
    println!("| input | triangles | nodes | at the wall | pressing | mean ms | p50 | p99 | max | steps/s | boxes ms |");
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    let mut whole = (WHOLE, smoothed(WHOLE));
    for (kind, count, nodes) in rows {
        let made = if count == TRIANGLES { count } else { count.max(WHOLE) };
        if made != whole.0 {
            whole = (made, smoothed(made));
        }
        measure(&level(&mut whole.1, count), kind, nodes);
    }
}

/// The sample of so many triangles, smoothed as the trial needs it.
fn smoothed(count: usize) -> Pipeline {
    let mesh = Arc::new(import_mesh(generate(Sample::Coronary, count).expect("a sample"), "sample").mesh);
    let smoothing = Smoothing { pass_band: 0.1, iterations: 30, ..Smoothing::PAPER };
    Pipeline::new(mesh, Settings { smoothing, ..Settings::default() }).without_measures()
}

fn level(pipeline: &mut Pipeline, count: usize) -> Arc<TriMesh> {
    let settings = Settings { target: Target::Triangles(count as u32), ..pipeline.settings().clone() };
    pipeline.set(settings).expect("settings that are allowed");
    pipeline.finish().expect("settings that are allowed");
    pipeline.reduced().expect("a level").mesh.clone()
}

fn distinct(nodes: impl Iterator<Item = usize>) -> usize {
    nodes.collect::<HashSet<_>>().len()
}

/// An entry moved across to the wall.
fn beside(course: &Course, Entry { at, direction }: Entry) -> Entry {
    let side = DVec3::from(direction.map(f64::from)).any_orthonormal_vector();
    let aside = side * (course.route.at(0.0).radius - BESIDE);
    Entry { at: (DVec3::from(at.map(f64::from)) + aside).as_vec3().to_array(), direction }
}

fn measure(mesh: &Arc<TriMesh>, kind: Kind, nodes: usize) {
    let mut wire = Wire { elements_mm: [LENGTH / nodes as f64; 2], ..Wire::preset("workhorse").expect("a preset") };
    if kind == Kind::Pressed {
        (wire.tip_ei, wire.shaft_ei) = (SOFT, SOFT);
    }
    let mut setup = Setup { wire, ..Setup::default() };
    let course = Arc::new(Course::new(mesh, Some(Sample::Coronary), &mut setup).expect("a way"));
    if kind == Kind::Pressed {
        setup.press = PRESS;
        setup.entry = setup.entry.map(|entry| beside(&course, entry));
    }
    let mut trial = Trial::new(course.clone(), setup).expect("room");
    trial.set_autopilot(true);
    while trial.simulation().count() < nodes {
        trial.step();
        assert_eq!(trial.progress(), Progress::Running, "with {} nodes", trial.simulation().count());
    }
    let arc = trial.frame().arc_mm;
    assert!(arc > 0.9 * LENGTH, "the tip is not on the route, but at {arc} mm");
    trial.set_autopilot(false);
    let mut times = Vec::with_capacity(STEPS);
    let (mut at_wall, mut pressing) = (0, 0);
    for step in 0..STEPS {
        trial.drive(Input { feed: if step / 250 % 2 == 0 { -10.0 } else { 10.0 }, roll: 2.0 });
        let start = Instant::now();
        trial.step();
        times.push(start.elapsed().as_secs_f64() * 1e3);
        let body = trial.simulation().body();
        at_wall += distinct(body.contacts.near().map(|near| near.0));
        pressing += distinct(body.touches().map(|touch| touch.0));
    }
    assert_eq!(trial.progress(), Progress::Running);
    times.sort_by(f64::total_cmp);
    let mean = times.iter().sum::<f64>() / STEPS as f64;
    let at = |part: f64| times[((STEPS as f64 * part) as usize).min(STEPS - 1)];
    let part = |count: usize| 100.0 * count as f64 / (STEPS * trial.simulation().count()) as f64;
    println!(
        "| {} | {} | {} | {:.0} % | {:.0} % | {mean:.3} | {:.3} | {:.3} | {:.3} | {:.0} | {:.0} |",
        if kind == Kind::Pressed { "pressed" } else { "workhorse" },
        mesh.triangles.len(),
        trial.simulation().count(),
        part(at_wall),
        part(pressing),
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
