//! What steps tell of themselves on their way to the log, the summary and what is shown; and what only some trials meet:
//! withdrawal with short elements, ends that are no wall, a hand that takes its time, a step back.

use std::sync::Arc;

use lumen::io::import_mesh;
use lumen::phantom::{Sample, generate};
use lumen::trial::compare::{Noise, SHUFFLES, TrialComparison};
use lumen::trial::course::Course;
use lumen::trial::frame::{Progress, Touch};
use lumen::trial::log::Log;
use lumen::trial::report::{StepCounts, StepKind};
use lumen::trial::session::Trial;
use lumen::trial::setup::{Entry, Input, Setup};
use lumen::trial::simulation::Simulation;
use lumen::trial::wall::Wall;
use lumen::trial::wire::Wire;
use lumen_test_support::tubes::{curve, tube};

const AT: Entry = Entry { at: [4.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };

/// A straight tube along x with open ends.
fn straight(length: f64, radius: f64) -> lumen::mesh::TriMesh {
    tube(&curve(&[(length, f64::INFINITY)], 1.0), |_| radius, 24)
}

/// A wire of this name at the entry of the aorta sample.
pub(super) fn in_the_aorta(wire: &str) -> Trial {
    let mesh = Arc::new(import_mesh(generate(Sample::Aorta, 20_000).unwrap(), "sample").mesh);
    let mut setup = Setup { wire: Wire::preset(wire).unwrap(), ..Setup::default() };
    let course = Course::new(&mesh, Some(Sample::Aorta), &mut setup).unwrap();
    Trial::new(Arc::new(course), setup).unwrap()
}

/// A wire with a J of 2 mm radius in an S of narrow bends: rolled, it snaps round.
pub(super) fn in_an_s() -> Trial {
    let parts = [(15.0, f64::INFINITY), (30.0, 15.0), (30.0, -15.0), (30.0, 15.0), (60.0, f64::INFINITY)];
    let path = curve(&parts, 0.7);
    let mesh = Arc::new(tube(&path, |_| 1.3, 12));
    let target = Some(path[path.len() - 8].0.as_vec3().to_array());
    let wire = Wire::preset("workhorse-j").unwrap();
    let mut setup = Setup { wire, entry: Some(AT), target, ..Setup::default() };
    let course = Course::new(&mesh, None, &mut setup).unwrap();
    Trial::new(Arc::new(course), setup).unwrap()
}

/// What a trial should have come to, by each of its steps.
#[derive(Default)]
struct Told {
    counts: StepCounts,
    fed: f64,
    wanted: f64,
    push: f64,
    torque: f64,
    wall: f64,
    residual: f64,
    /// Of steps that were not balanced.
    loose_push: f64,
    loose_wall: f64,
}

/// Drives by hand, to and fro, so fast that a soft wire buckles and snaps.
fn driven(trial: &mut Trial, steps: u64) -> Told {
    let mut told = Told::default();
    for i in 0..steps {
        let feed = if i / 500 % 3 == 2 { -30.0 } else { 25.0 };
        trial.drive(Input { feed, roll: if i / 300 % 2 == 0 { 8.0 } else { -8.0 } });
        trial.step();
        let (report, body) = (trial.simulation().report(), trial.simulation().body());
        told.counts.count(report.kind);
        told.fed += report.fed_mm;
        told.wanted += report.wanted_mm;
        let wall = body.touches().map(|touch| touch.3).fold(0.0, f64::max);
        if report.kind == StepKind::Balanced {
            told.push = told.push.max(report.push_n);
            told.torque = told.torque.max(report.torque_n_mm.abs());
            told.wall = told.wall.max(wall);
            told.residual = told.residual.max(report.residual_n);
            let frame = trial.frame();
            assert_eq!((frame.push_n, frame.max_wall_force_n), (report.push_n, wall));
        } else {
            told.loose_push = told.loose_push.max(report.push_n);
            told.loose_wall = told.loose_wall.max(wall);
        }
        let is_waiting = matches!(report.kind, StepKind::Waited | StepKind::Held);
        assert!(!is_waiting || (report.fed_mm, report.rolled_rad) == (0.0, 0.0), "{report:?}");
        assert_eq!(trial.frame().report, report);
    }
    told
}

#[test]
fn what_is_shown_comes_from_balanced_steps_and_the_share_of_others_is_told() {
    let mut trial = in_an_s();
    let start = trial.simulation().inserted();
    let told = driven(&mut trial, 4000);
    println!(
        "{:?}: push {} and {} N, wall {} and {} N, residual {} N; fed {} of {} mm",
        told.counts, told.push, told.loose_push, told.wall, told.loose_wall, told.residual, told.fed, told.wanted
    );
    let summary = trial.summary();
    assert_eq!(summary.step_kinds, told.counts);
    assert!(told.counts.unbalanced_share() > 0.001, "nothing snapped");
    assert_eq!(summary.unbalanced_share, told.counts.unbalanced_share());
    assert_eq!(summary.max_push_n, told.push);
    assert_eq!(summary.max_torque_n_mm, told.torque);
    assert_eq!(summary.max_wall_force_n, told.wall);
    assert_eq!(summary.max_residual_n, told.residual);
    assert!((told.fed - (trial.simulation().inserted() - start)).abs() < 1e-9, "{} mm", told.fed);
    assert!(summary.fed_mm < summary.wanted_feed_mm, "what was not fed is told");
    // What the wall is coloured by is the same.
    let felt = trial.felt().peaks().iter().map(|touch| touch.force).fold(0.0, f32::max);
    assert_eq!(felt, told.wall as f32);
    // And so are the rows of the log.
    let rows = &trial.log().rows;
    let most = rows.iter().map(|row| row.max_wall_force_n).fold(0.0, f64::max);
    assert!(most <= told.wall && most > 0.0, "{most} N of {}", told.wall);
    assert!(rows.iter().skip(1).all(|row| row.since.counts.all() == 10));
    let fed: f64 = rows.iter().map(|row| row.since.fed_mm).sum();
    let last = rows.last().unwrap();
    assert!((fed - (last.inserted_mm - start)).abs() < 1e-9, "{fed} mm");
    let csv = trial.log().csv(summary.steps).unwrap();
    let table: Vec<&str> = csv.lines().filter(|line| !line.starts_with('#')).collect();
    let columns = table[0].split(',').count();
    assert!(table.iter().all(|line| line.split(',').count() == columns));
    assert!(table[0].ends_with("balanced,unsettled,braked,waited,held,wanted_mm,fed_mm,residual_n,wire"));
    // Logs of the schema before it can be replayed.
    let older = csv.replace("log, schema 3", "log, schema 1");
    assert_eq!(Log::read(older.as_bytes()).unwrap().steps, summary.steps);
}

#[test]
fn a_wire_of_the_shortest_elements_is_withdrawn_as_fast_as_it_goes() {
    let wall = Arc::new(Wall::open(Arc::new(straight(40.0, 0.4))));
    let wire = Wire { elements_mm: [0.05; 2], length_mm: 60.0, bend_degrees: 0.0, tip_ei: 2.0, ..Wire::default() };
    // Along the wall: the nodes at the guide are contacts.
    let entry = Entry { at: [4.0, -0.2, 0.0], ..AT };
    let mut simulation = Simulation::new(&wire, wire.friction, &entry, 0.0, Some(wall)).unwrap();
    let fed = |simulation: &mut Simulation, dt: f64, feed: f32, steps: u32| {
        for _ in 0..steps {
            simulation.step_by(dt, Input { feed, roll: 0.0 });
        }
    };
    fed(&mut simulation, 0.002, 20.0, 150);
    let near = simulation.body().contacts.near().count();
    assert!(simulation.inserted() > 4.0 && near > 20, "{} mm, {near} contacts", simulation.inserted());
    fed(&mut simulation, 0.002, -50.0, 50);
    assert!(simulation.inserted() < 1.5, "{} mm", simulation.inserted());
    // And in steps of twice the length, in which four elements go.
    fed(&mut simulation, 0.004, 50.0, 20);
    fed(&mut simulation, 0.004, -50.0, 20);
    assert!(simulation.tip().is_finite());
}

#[test]
fn the_fans_over_open_ends_hold_the_wire_and_are_no_wall() {
    let mesh = Arc::new(straight(20.0, 1.5));
    let wire = Wire { bend_degrees: 0.0, tip_ei: 20.0, shaft_ei: 20.0, ..Wire::preset("workhorse").unwrap() };
    let mut simulation = Simulation::new(&wire, [0.0; 2], &AT, 0.0, Some(Arc::new(Wall::new(mesh)))).unwrap();
    for _ in 0..900 {
        simulation.step(Input { feed: 10.0, roll: 0.0 });
        if simulation.push_and_torque()[0] > 0.1 {
            break;
        }
    }
    let push = simulation.push_and_torque()[0];
    assert!(push > 0.1 && simulation.tip().x < 20.0, "the end holds it with {push} N at {}", simulation.tip());
    assert_eq!(simulation.body().pressure(), (0.0, 0.0), "it lies against nothing of the vessel");
    assert_eq!(simulation.body().touches().count(), 0);
}

#[test]
fn a_hand_takes_the_time_that_it_takes() {
    let mesh = Arc::new(straight(14.0, 2.0));
    let mut setup = Setup { entry: Some(AT), target: Some([13.0, 0.0, 0.0]), ..Setup::default() };
    let course = Arc::new(Course::new(&mesh, None, &mut setup).unwrap());
    let mut trial = Trial::new(course.clone(), setup.clone()).unwrap();
    let limit = (trial.limit_s() / lumen::trial::STEP) as u64;
    (0..limit + 100).for_each(|_| trial.step());
    assert_eq!(trial.progress(), Progress::Running, "after {} s of {}", trial.frame().time_s, trial.limit_s());
    assert_eq!(trial.simulation().steps(), limit + 100);
    // Its log is as long.
    let recorded = Log::read(trial.log().csv(trial.simulation().steps()).unwrap().as_bytes()).unwrap();
    let mut again = Trial::new(course, setup).unwrap();
    again.replay(recorded.inputs, recorded.steps);
    again.finish();
    assert_eq!((again.progress(), again.simulation().steps()), (Progress::Over, limit + 100));
    // The autopilot has all of its own time after it.
    trial.set_autopilot(true);
    (0..100).for_each(|_| trial.step());
    assert_ne!(trial.progress(), Progress::TimedOut);
}

#[test]
fn a_step_back_takes_back_what_the_wall_has_felt_since() {
    let mut trial = in_the_aorta("035-angled");
    trial.drive(Input { feed: 40.0, roll: 3.0 });
    (0..1500).for_each(|_| trial.step());
    let felt: Vec<Touch> = trial.felt().peaks();
    (0..400).for_each(|_| trial.step());
    assert_ne!(trial.felt().peaks(), felt, "the wall feels more");
    trial.step_back();
    assert_eq!(trial.simulation().steps(), 1500);
    assert_eq!(trial.felt().peaks(), felt);
    trial.felt_mut().tell_again();
    let mut told = trial.felt_mut().news();
    let order = |a: &Touch, b: &Touch| a.at.map(f32::to_bits).cmp(&b.at.map(f32::to_bits));
    told.sort_by(order);
    let mut felt = felt;
    felt.sort_by(order);
    assert_eq!(told, felt);
}

#[test]
fn a_comparison_knows_how_far_a_surface_differs_from_itself() {
    let mut trial = in_an_s();
    let mesh = trial.course().wall.mesh().clone();
    let _ = driven(&mut trial, 1500);
    let finished = |mut other: Trial| {
        other.finish();
        other
    };
    let original = finished(trial.on(&mesh).unwrap());
    let mut noise = Noise::default();
    for seed in 1..=SHUFFLES {
        noise.take(&original, &finished(trial.on_shuffled(&mesh, seed).unwrap()));
    }
    let comparison = TrialComparison::new(&trial, &original, &noise);
    let [most, chance] =
        [&comparison.deviation_mm, &comparison.noise_mm].map(|all| all.iter().copied().fold(0.0, f32::max));
    println!("differs by {most} mm, from itself by {chance} mm: {}", comparison.verdict);
    assert_eq!(most, 0.0, "it is the same surface");
    assert!(chance > 0.0, "another order is another sum");
    assert_eq!(comparison.noise_mm.len(), comparison.deviation_mm.len());
    assert_eq!(comparison.orders[0], SHUFFLES as usize);
    assert!(comparison.verdict.to_string().contains("no more than noise"), "{}", comparison.verdict);
    // The same surface in another order is no other surface: what is told of it is noise.
    let one = finished(trial.on_shuffled(&mesh, 1).unwrap());
    let shuffled = TrialComparison::new(&one, &original, &noise);
    assert!(shuffled.verdict.to_string().contains("no more than noise"), "{}", shuffled.verdict);
    assert!(shuffled.force_differences.is_empty(), "{:?}", shuffled.force_differences);
}
