//! How long does a step take, and how far off is it, while a wire goes in and out of a stenosis and a branch?
//! `cargo bench --bench strokes --no-default-features`.
//!
//! Vessel and strokes are those of OpenEndovascularTrainer's collision benchmark (`scripts/collision-benchmark.mjs` at
//! e945190a; its figures: `reports/collision-benchmark.md` at c862eb31). The vessel is a straight trunk with a stenosis, a
//! taper and a branch of 2.2 mm radius. The wire is one of 0.035 in with elements of 2.5 mm. It goes 460 mm in, waits, comes
//! back by 235 mm, is turned, goes in again and comes out. What differs:
//!
//! - Strokes are made at [`FEED`], the fastest that a trial takes. Theirs take 5, 0.7, 1 and 2.3 s: nodes lie in the vessel
//!   beforehand, a stroke lets more of them take part, and a spring holds the tip near the middle line.
//! - The wall is of triangles. Theirs is the formula of [`lumen`] itself.
//! - There is no catheter. While theirs is turned, the wire is rolled there and back at the same speed.
//!
//! Arguments are surface files in mm: the same strokes in each, from the entry that it proposes, reduced by 90 % as by
//! `lumen trial --reduction 90`. They end where the tip comes to the proposed target.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use glam::DVec3;
use lumen::io::{ImportOptions, import_mesh, read};
use lumen::mesh::TriMesh;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Target};
use lumen::trial::STEP;
use lumen::trial::course::Course;
use lumen::trial::frame::Progress;
use lumen::trial::report::StepCounts;
use lumen::trial::session::Trial;
use lumen::trial::setup::{Entry, Input, Setup};
use lumen::trial::wire::Wire;
use lumen::volume::{Geometry, Grid, Samples, Selection, surface};

/// Length of an element in mm.
const ELEMENT: f64 = 2.5;
/// Bend of the tip in degrees: one of 30 goes past the branch, one of 60 is pushed over in the trunk, which is no wider.
const BENT: f64 = 45.0;
/// Speed of a stroke in mm/s.
const FEED: f32 = Input::MAX_FEED;
/// How fast the wire is rolled, in rad/s: 0.018 rad in 1/120 s.
const ROLL: f32 = 2.16;
/// Feed in mm/s and roll in rad/s, and for how many seconds: all the way in, back by half, turned, in again, out.
const STROKES: [(f32, f32, f64); 8] = [
    (FEED, 0.0, 9.2),
    (0.0, 0.0, 5.0),
    (-FEED, 0.0, 4.7),
    (0.0, ROLL, 2.5),
    (0.0, -ROLL, 2.5),
    (FEED, 0.0, 4.7),
    (-FEED, 0.0, 9.2),
    (0.0, 0.0, 1.0),
];
/// The mouth of the guide, where their sheath ends, and the end of the vessel, along x in mm.
const ENDS: [f64; 2] = [40.0, 530.0];
/// Spacing in mm of the grid that the surface is cut from: that of their distance field.
const SPACING: f64 = 0.5;

fn main() {
    let files: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    println!(
        "| vessel | triangles | wire | nodes | s | steps | mean ms | p95 | p99 | max | balanced | fed mm | deepest mm | length error mean % | most | of an element |"
    );
    println!("|---|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|");
    if files.is_empty() {
        let entry = Entry { at: [ENDS[0] as f32, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
        let target = [ENDS[1] - 5.0, branch_middle(ENDS[1] - 5.0), 0.0].map(|mm| mm as f32);
        let setup = Setup { entry: Some(entry), target: Some(target), ..Setup::default() };
        measure("stenosis and branch", &Arc::new(vessel()), setup);
    }
    for file in files {
        let bytes = std::fs::read(&file).expect("a file that can be read");
        let opened = read(&bytes, &file, &ImportOptions::default()).expect("a surface");
        let smoothing = Smoothing { pass_band: 0.1, iterations: 30, ..Smoothing::PAPER };
        let settings = Settings { smoothing, target: Target::Reduction(900), ..Settings::default() };
        let mut pipeline = Pipeline::new(Arc::new(opened.mesh), settings).without_measures();
        pipeline.finish().expect("settings that are allowed");
        let name = Path::new(&file).file_name().map_or_else(|| file.clone().into(), |name| name.to_string_lossy());
        measure(&name, &pipeline.reduced().expect("a level").mesh.clone(), Setup::default());
    }
}

/// Where the middle of the branch is, in mm along y.
fn branch_middle(x: f64) -> f64 {
    0.16 * (x - 330.0)
}

/// Distance from the wall in mm, positive in the lumen.
fn lumen(at: DVec3) -> f64 {
    let from_stenosis = at.x - 210.0;
    let stenosis = 2.1 * libm::exp(-from_stenosis * from_stenosis / 300.0);
    let taper = (0.006 * (at.x - 300.0)).clamp(0.0, 1.6);
    let trunk = 6.5 - stenosis - taper - libm::hypot(at.y, at.z);
    let branch = 2.2 - libm::hypot(at.y - branch_middle(at.x), at.z);
    if at.x > 330.0 { trunk.max(branch) } else { trunk }
}

/// The surface around the lumen, open at the ends.
fn vessel() -> TriMesh {
    let (least, most) =
        (DVec3::new(ENDS[0] - 10.0, -9.0, -9.0), DVec3::new(ENDS[1], branch_middle(ENDS[1]) + 5.0, 9.0));
    let size = ((most - least) / SPACING).to_array().map(|points| points as usize + 1);
    let geometry = Geometry::upright(size, DVec3::splat(SPACING), least);
    let place =
        |i: usize| DVec3::new((i % size[0]) as f64, (i / size[0] % size[1]) as f64, (i / size[0] / size[1]) as f64);
    let values = (0..geometry.points()).map(|i| lumen(least + place(i) * SPACING) as f32).collect();
    let grid = Grid::new(geometry, Samples::F32(values), 1.0, 0.0).expect("a volume");
    let surface = surface(&Arc::new(grid), Selection::Threshold(0.0), None).expect("a surface");
    import_mesh(surface, "vessel").mesh
}

/// Makes the strokes and prints a row.
fn measure(name: &str, mesh: &Arc<TriMesh>, setup: Setup) {
    let wire = Wire { elements_mm: [ELEMENT; 2], bend_degrees: BENT, ..Wire::preset("035-angled").expect("a preset") };
    let mut setup = Setup { wire, ..setup };
    let course = Arc::new(Course::new(mesh, None, &mut setup).expect("a way"));
    let mut trial = Trial::new(course, setup).expect("room");
    let (mut times, mut counts) = (Vec::new(), StepCounts::default());
    let (mut nodes, mut wanted, mut fed, mut deepest) = (0, 0.0, 0.0, 0.0_f64);
    let (mut length_errors, mut of_wire, mut of_element) = (0.0, 0.0_f64, 0.0_f64);
    for (feed, roll, seconds) in STROKES {
        trial.drive(Input { feed, roll });
        for _ in 0..(seconds / STEP).round() as usize {
            let start = Instant::now();
            trial.step();
            if trial.progress() != Progress::Running {
                break;
            }
            times.push(start.elapsed().as_secs_f64() * 1e3);
            let simulation = trial.simulation();
            let report = simulation.report();
            counts.count(report.kind);
            (wanted, fed) = (wanted + report.wanted_mm.abs(), fed + report.fed_mm.abs());
            nodes = nodes.max(simulation.count());
            deepest = deepest.max(simulation.body().depth);
            let [wire, element] = simulation.length_errors();
            length_errors += wire;
            (of_wire, of_element) = (of_wire.max(wire), of_element.max(element));
        }
    }
    let steps = times.len();
    times.sort_by(f64::total_cmp);
    let mean = times.iter().sum::<f64>() / steps as f64;
    let at = |part: f64| times[((steps as f64 * part) as usize).min(steps - 1)];
    println!(
        "| {name} | {} | {} | {nodes} | {:.1} | {steps} | {mean:.3} | {:.3} | {:.3} | {:.3} | {:.1} % | {fed:.0} of {wanted:.0} | {deepest:.4} | {:.5} | {:.5} | {:.5} |",
        mesh.triangles.len(),
        trial.wire().name,
        steps as f64 * STEP,
        at(0.95),
        at(0.99),
        at(1.0),
        100.0 * (1.0 - counts.unbalanced_share()),
        100.0 * length_errors / steps as f64,
        100.0 * of_wire,
        100.0 * of_element,
    );
}
