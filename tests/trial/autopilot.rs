//! The trial on the samples: the autopilot arrives wherever the lumen is open, logs replay, differences are told.
//!
//! Whether a lumen is open is decided beforehand by `audit`, which shares no code with the solver.

use std::sync::Arc;

use glam::DVec3;
use lumen::io::import_mesh;
use lumen::mesh::TriMesh;
use lumen::phantom::{Sample, generate, vessels};
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Target};
use lumen::trial::audit::Audit;
use lumen::trial::autopilot::AutopilotTask;
use lumen::trial::compare::{Noise, TrialComparison};
use lumen::trial::course::{Course, TrialError};
use lumen::trial::frame::Progress;
use lumen::trial::log::Log;
use lumen::trial::report::StepKind;
use lumen::trial::session::Trial;
use lumen::trial::setup::{Command, Entry, Input, Press, Setup};
use lumen::trial::simulation::Simulation;
use lumen::trial::wire::Wire;
use lumen_test_support::is_long;

/// Levels of a sample at rates in tenths of a percent, smoothed so that thin vessels stay open.
fn levels(sample: Sample, triangles: usize, rates: &[u32]) -> Vec<Arc<TriMesh>> {
    let mesh = import_mesh(generate(sample, triangles).unwrap(), "sample").mesh;
    let smoothing = Smoothing { pass_band: 0.1, iterations: 30, ..Smoothing::default() };
    let settings = Settings { smoothing, target: Target::Reduction(900), ..Settings::default() };
    let mut pipeline = Pipeline::new(Arc::new(mesh), settings).without_measures();
    let level = |&rate: &u32| {
        let settings = Settings { target: Target::Reduction(rate), ..pipeline.settings().clone() };
        pipeline.set(settings).unwrap();
        pipeline.finish().unwrap();
        pipeline.reduced().unwrap().mesh.clone()
    };
    rates.iter().map(level).collect()
}

fn setup(sample: Sample) -> Setup {
    let name = if sample == Sample::Aorta { "035-j" } else { "workhorse" };
    Setup { wire: Wire::preset(name).unwrap(), ..Setup::default() }
}

fn steered(course: &Arc<Course>, setup: &Setup) -> Trial {
    let mut trial = Trial::new(course.clone(), setup.clone()).unwrap();
    trial.set_autopilot(true);
    trial.finish();
    trial
}

/// Runs seeds at each rate where the lumen is open; names those that do not arrive.
fn arrives(sample: Sample, triangles: usize, rates: &[u32]) {
    let seeds = if is_long() { 10 } else { 2 };
    let mut failures = Vec::new();
    let mut open = 0;
    for (mesh, rate) in levels(sample, triangles, rates).iter().zip(rates) {
        let mut setup = setup(sample);
        let course = Arc::new(Course::new(mesh, Some(sample), &mut setup).unwrap());
        let audit = Audit::new(mesh);
        let middle: Vec<DVec3> = course.route.points.iter().map(|point| point.at).collect();
        if audit.is_open(&middle, setup.wire.diameter_mm).is_err() {
            continue;
        }
        open += 1;
        for seed in 0..seeds {
            let trial = steered(&course, &Setup { seed, ..setup.clone() });
            let summary = trial.summary();
            if !summary.success {
                failures.push(format!("{sample} at {} %, seed {seed}: {}", f64::from(*rate) / 10.0, summary.reason));
            }
            let nodes: Vec<DVec3> = trial.simulation().nodes().collect();
            let depth = audit.penetration(&nodes, setup.wire.radius());
            assert!(depth <= 0.05 * setup.wire.radius(), "{sample} at {rate}, seed {seed}: {depth} mm into the wall");
            assert!(summary.max_penetration_mm <= 0.05 * setup.wire.radius(), "{summary:?}");
        }
    }
    assert!(open >= 2, "{sample} is open at {open} rates only");
    eprintln!(
        "{sample}: {} of {} trials arrive\n{}",
        open * seeds - failures.len() as u64,
        open * seeds,
        failures.join("\n")
    );
    // A branch that leaves at a right angle may be missed sixty times; one trial of twenty at most does.
    assert!(failures.len() as u64 * 20 <= open * seeds, "too many do not arrive");
}

#[test]
fn the_autopilot_arrives_in_the_aorta() {
    arrives(Sample::Aorta, 74_307, &[0, 500, 900, 950, 990]);
}

#[test]
fn the_autopilot_arrives_in_the_coronary_tree() {
    arrives(Sample::Coronary, 380_000, &[0, 900, 950, 990]);
}

#[test]
fn the_same_trial_has_the_same_bits_and_its_log_replays_to_the_same_end() {
    let mesh = &levels(Sample::Aorta, 30_000, &[900])[0];
    let mut setup = Setup { seed: 7, ..setup(Sample::Aorta) };
    let course = Arc::new(Course::new(mesh, Some(Sample::Aorta), &mut setup).unwrap());
    let [first, second] = [(), ()].map(|()| steered(&course, &setup));
    let bits = |trial: &Trial| -> Vec<u64> {
        trial.simulation().nodes().flat_map(|p| p.to_array()).map(f64::to_bits).collect()
    };
    assert_eq!(bits(&first), bits(&second));
    let csv = first.log().csv(first.summary().steps).unwrap();
    let recorded = Log::read(csv.as_bytes()).unwrap();
    assert_eq!(recorded.setup, setup);
    let mut replayed = Trial::new(course.clone(), recorded.setup).unwrap();
    replayed.replay(recorded.inputs, recorded.steps);
    replayed.finish();
    assert_eq!(bits(&first), bits(&replayed));
    assert_eq!(replayed.progress(), Progress::Arrived);
    // A trial differs from itself by nothing, and from that on another level by something.
    let mut again = first.on(mesh).unwrap();
    again.finish();
    let same = TrialComparison::new(&first, &again, &Noise::default());
    assert!(same.deviation_mm.iter().all(|&deviation| deviation == 0.0) && same.force_differences.is_empty());
    assert!(same.deviation_mm.len() > 100 && same.pinched.is_empty());
    let said = same.verdict.to_string();
    assert!(said.contains("arrives") && said.contains("0.0 mm"), "{said}");
    assert_eq!(same.smallest_before_mm, same.smallest_after_mm);
}

#[test]
fn what_is_done_by_hand_at_any_step_replays_to_the_same_end() {
    let mesh = &levels(Sample::Aorta, 30_000, &[900])[0];
    let mut setup = setup(Sample::Aorta);
    let course = Arc::new(Course::new(mesh, Some(Sample::Aorta), &mut setup).unwrap());
    let mut trial = Trial::new(course.clone(), setup).unwrap();
    // Changes of input and the end lie between rows of the log.
    for (steps, feed, roll) in [(3, 50.0, 0.0), (404, 30.0, 5.0), (311, -20.0, -12.0), (226, 45.0, 2.0)] {
        (0..steps).for_each(|_| trial.step());
        trial.drive(Input { feed, roll });
    }
    (0..333).for_each(|_| trial.step());
    let recorded = Log::read(trial.log().csv(trial.summary().steps).unwrap().as_bytes()).unwrap();
    let mut replayed = Trial::new(course, recorded.setup).unwrap();
    replayed.replay(recorded.inputs, recorded.steps);
    replayed.finish();
    assert_eq!(replayed.progress(), Progress::Over);
    assert_eq!(replayed.simulation().steps(), trial.simulation().steps());
    let [a, b] = [&trial, &replayed].map(|trial| trial.simulation().nodes().collect::<Vec<_>>());
    assert_eq!(a, b);
    assert!(trial.simulation().inserted() > 20.0);
}

/// A wire without a bend goes straight on from the one iliac artery into the aorta, whatever it was meant to do.
#[test]
fn a_failure_names_the_fork_that_was_missed() {
    let mesh = &levels(Sample::Aorta, 30_000, &[900])[0];
    let vessels = vessels(Sample::Aorta);
    let named = |name: &str| vessels.iter().find(|vessel| vessel.name == name).unwrap();
    let [aorta, left] = [named("abdominal aorta"), named("left common iliac artery")];
    let far = left.stations[left.stations.len() - 5].position;
    let mut setup = Setup { target: Some(far.as_vec3().to_array()), ..setup(Sample::Aorta) };
    setup.wire.bend_degrees = 0.0;
    let course = Arc::new(Course::new(mesh, Some(Sample::Aorta), &mut setup).unwrap());
    let mut trial = Trial::new(course.clone(), setup).unwrap();
    trial.replay(vec![Command { step: 0, input: Input { feed: 50.0, roll: 0.0 }, wire: 0 }], 1250);
    trial.finish();
    assert!(trial.summary().wrong_branches > 0, "{:?}", trial.summary());
    // Names as the lists of entries and targets have them.
    let name = |at: DVec3| &course.tree.branches()[course.tree.locate(at, None).unwrap().branch as usize].name;
    let before = aorta.stations.iter().rev().find(|station| station.position.distance(far) > 80.0).unwrap();
    let reason = trial.summary().reason;
    let expected = format!("going into {} instead of {}", name(before.position), name(far));
    assert!(reason.contains(": it missed the fork ") && reason.ends_with(&expected), "{reason}, not {expected}");
    // The arteries part where the centreline of the one begins; the aorta is 16 mm wide there at least.
    let fork = glam::Vec3::from(trial.summary().missed_fork_at.expect("a place")).as_dvec3();
    let away = fork.distance(left.stations[0].position);
    assert!(away < 25.0 && fork.distance(far) > 30.0, "{fork} is {away:.1} mm from the fork");
}

#[test]
fn a_log_that_is_none_is_refused_with_its_line() {
    let refused = |text: &str| Log::read(text.as_bytes()).unwrap_err().to_string();
    assert!(refused("step,time\n1,2\n").contains("no log"));
    assert!(refused("# lumen trial log, schema 99\n").contains("99"));
    let head = format!("# lumen trial log, schema 1\n# setup {}\n", serde_json::to_string(&Setup::default()).unwrap());
    let columns = "step,time_s,feed_mm_s,roll_rad_s,rest\n";
    for (lines, line) in
        [("0,0,x,0\n", "line 4"), ("0,0,1\n", "line 4"), ("0,0,1,0\n0,0,1,0\n", "line 5"), ("a,0,1,0\n", "line 4")]
    {
        let message = refused(&format!("{head}{columns}{lines}"));
        assert!(message.contains(line), "{message}");
    }
    assert!(refused(&format!("{head}1,2,3,4\n")).contains("columns"));
}

/// Versions before `load` and `press` wrote such setups.
#[test]
fn a_log_of_an_older_version_is_read_without_the_loads_that_it_does_not_name() {
    let setup = Setup { seed: 5, target: Some([1.0, 2.0, 3.0]), ..Setup::default() };
    let mut json = serde_json::to_value(&setup).unwrap();
    for field in ["load", "press", "proposes_wire", "next_wires"] {
        assert!(json.as_object_mut().unwrap().remove(field).is_some(), "{field} of {json}");
    }
    let columns = "step,time_s,feed_mm_s,roll_rad_s,rest\n";
    let log = format!("# lumen trial log, schema 1\n# steps 7\n# setup {json}\n{columns}0,0,-0,1.5\n");
    let recorded = Log::read(log.as_bytes()).unwrap();
    assert_eq!((recorded.setup, recorded.steps), (setup, 7));
    assert_eq!(recorded.inputs[0].input.feed.to_bits(), 0.0_f32.to_bits(), "nought has no sign");
}

#[test]
fn a_wire_that_fails_is_taken_out_for_the_next_and_the_log_replays_that() {
    let mesh = &levels(Sample::Aorta, 30_000, &[900])[0];
    let vessels = vessels(Sample::Aorta);
    let left = vessels.iter().find(|vessel| vessel.name == "left common iliac artery").unwrap();
    let far = left.stations[left.stations.len() - 5].position;
    // From the one iliac artery into the other: a wire without a bend goes straight up.
    let mut setup = Setup { target: Some(far.as_vec3().to_array()), ..setup(Sample::Aorta) };
    setup.wire = Wire { name: "straight".to_owned(), bend_degrees: 0.0, ..setup.wire };
    // One that is too thick for the artery is passed over.
    let thick = Wire { name: "thick".to_owned(), diameter_mm: 9.9, ..Wire::preset("035-angled").unwrap() };
    setup.next_wires = vec![thick, Wire::preset("035-angled").unwrap()];
    let course = Arc::new(Course::new(mesh, Some(Sample::Aorta), &mut setup).unwrap());
    let trial = steered(&course, &setup);
    let summary = trial.summary();
    assert_eq!(summary.wire, "035-angled", "{}", summary.reason);
    assert_eq!(summary.failed_wires, ["straight"]);
    let rows = &trial.log().rows;
    let second = rows.iter().position(|row| row.wire > 0).unwrap();
    // Taking it out takes the time that its length does at 30 mm/s.
    let leaving = rows[..second].iter().rev().take_while(|row| row.input.feed == -30.0);
    let (mut steps, mut length) = (0.0, 0.0);
    for row in leaving {
        (steps, length) = (steps + 1.0, row.inserted_mm);
    }
    assert!(length > 20.0 && steps * 10.0 * lumen::trial::STEP >= (length - 3.0) / 30.0, "{length} mm in {steps} rows");
    assert!(rows[second].inserted_mm < 5.0 && rows[second].step == rows[second - 1].step + 10);
    assert!(rows[second..].iter().all(|row| row.wire == 2) && summary.steps > rows[second].step);
    let csv = trial.log().csv(summary.steps).unwrap();
    let recorded = Log::read(csv.as_bytes()).unwrap();
    assert_eq!(recorded.setup, setup);
    let mut replayed = Trial::new(course, recorded.setup).unwrap();
    replayed.replay(recorded.inputs, recorded.steps);
    replayed.finish();
    let [a, b] = [&trial, &replayed].map(|trial| trial.simulation().nodes().collect::<Vec<_>>());
    assert_eq!(a, b);
    assert_eq!(replayed.summary().failed_wires, ["straight"]);
    let mut on_itself = trial.on(mesh).unwrap();
    on_itself.finish();
    assert_eq!(on_itself.simulation().nodes().collect::<Vec<_>>(), a);
    // A second back across the exchange the first wire is in again, and its log ends there.
    let mut back = Trial::new(trial.course().clone(), setup.clone()).unwrap();
    back.set_autopilot(true);
    while back.failed_wires().is_empty() {
        back.step();
    }
    back.step_back();
    assert!(back.wire().name == "straight" && back.log().rows.iter().all(|row| row.wire == 0));
    // A hand that helps it keeps it.
    back.set_autopilot(true);
    while back.frame().doing != Some(AutopilotTask::Exchanging) {
        back.step();
    }
    back.set_autopilot(false);
    (0..10).for_each(|_| back.step());
    back.set_autopilot(true);
    assert_ne!(back.frame().doing, Some(AutopilotTask::Exchanging));
    // A row that was cut off.
    let cut = csv.trim_end().strip_suffix(",2").unwrap();
    assert!(Log::read(cut.as_bytes()).unwrap_err().to_string().contains("its wire is none of"));
    // A wire that the setup does not name.
    let of_another = |line: &str| line.strip_suffix(",2").map_or(line.to_owned(), |line| format!("{line},3"));
    let broken: Vec<String> = csv.lines().map(of_another).collect();
    let message = Log::read(broken.join("\n").as_bytes()).unwrap_err().to_string();
    assert!(message.contains("its wire is none of those of the setup"), "{message}");
}

#[test]
fn stepping_back_leads_to_where_it_was() {
    let mesh = &levels(Sample::Aorta, 30_000, &[900])[0];
    let mut setup = setup(Sample::Aorta);
    let course = Arc::new(Course::new(mesh, Some(Sample::Aorta), &mut setup).unwrap());
    let mut trial = Trial::new(course, setup).unwrap();
    trial.drive(Input { feed: 25.0, roll: 1.0 });
    (0..1000).for_each(|_| trial.step());
    let there: Vec<DVec3> = trial.simulation().nodes().collect();
    (0..400).for_each(|_| trial.step());
    trial.step_back();
    assert_eq!(trial.simulation().steps(), 1000);
    assert_eq!(trial.simulation().nodes().collect::<Vec<_>>(), there);
    for _ in 0..9 {
        trial.step_back();
    }
    assert_eq!(trial.simulation().steps(), 0);
}

#[test]
fn a_load_bends_a_wire_like_a_beam() {
    let (ei, load, length) = (5.0, 1e-4, 20.0);
    let preset = Wire::preset("workhorse").unwrap();
    let wire = Wire { tip_ei: ei, shaft_ei: ei, bend_degrees: 0.0, elements_mm: [0.5; 2], ..preset };
    let entry = Entry { at: [0.0; 3], direction: [1.0, 0.0, 0.0] };
    let mut simulation = Simulation::new(&wire, [0.0; 2], &entry, 0.0, None).unwrap();
    simulation.set_load(DVec3::Y * load).unwrap();
    while simulation.inserted() < length - 0.02 {
        simulation.step(Input { feed: 20.0, roll: 0.0 });
    }
    (0..5000).for_each(|_| assert_ne!(simulation.step(Input::default()).kind, StepKind::Held));
    // Euler and Bernoulli: w L^4 / 8 EI.
    let expected = load * simulation.inserted().powi(4) / (8.0 * ei);
    let found = simulation.tip().y;
    assert!((found / expected - 1.0).abs() < 0.01, "{found} mm for {expected}");
    for impossible in [DVec3::X, DVec3::NAN] {
        let refused = simulation.set_load(impossible).unwrap_err().to_string();
        assert!(refused.starts_with("a load of") && refused.contains("from 0 to 0.1 N"), "{refused}");
    }
    assert_eq!(simulation.set_load(DVec3::X * f64::from(0.1_f32)), Ok(()), "the most that is possible");
}

#[test]
fn what_cannot_be_tried_gets_a_sentence() {
    let mesh = &levels(Sample::Aorta, 30_000, &[900])[0];
    let sample = Some(Sample::Aorta);
    let refused = |change: &dyn Fn(&mut Setup)| -> TrialError {
        let mut setup = setup(Sample::Aorta);
        change(&mut setup);
        let course = match Course::new(mesh, sample, &mut setup) {
            Ok(course) => course,
            Err(error) => return error,
        };
        Trial::new(Arc::new(course), setup).err().unwrap()
    };
    let outside = Entry { at: [500.0, 0.0, 0.0], direction: [0.0, 0.0, 1.0] };
    assert!(refused(&|setup| setup.entry = Some(outside)).to_string().contains("outside"));
    assert!(refused(&|setup| setup.target = Some([0.0, 900.0, 0.0])).to_string().contains("outside"));
    assert!(refused(&|setup| setup.wire.diameter_mm = 9.9).to_string().contains("too thin"));
    assert!(refused(&|setup| setup.wire.diameter_mm = f64::NAN).to_string().contains("diameter"));
    assert!(refused(&|setup| setup.wire.elements_mm = [0.0, 1.0]).to_string().contains("element"));
    for n_per_mm in [0.2, -0.01, f32::NAN] {
        let refused = refused(&|setup| setup.press = Press { n_per_mm, from_mm: 0.0 }).to_string();
        assert!(
            refused.starts_with(&format!("a load of {n_per_mm} N")) && refused.contains("from 0 to 0.1 N"),
            "{refused}"
        );
    }
    let most = Setup { press: Press { n_per_mm: 0.1, from_mm: 0.0 }, load: [0.0, 0.1, 0.0], ..Setup::default() };
    assert_eq!(most.check_loads(), Ok(()));
    let mut inside_out = (**mesh).clone();
    inside_out.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    let mut turned = setup(Sample::Aorta);
    let error = Course::new(&Arc::new(inside_out), sample, &mut turned).unwrap_err();
    assert!(error.to_string().contains("inside out"), "{error}");
    let mut empty = setup(Sample::Aorta);
    assert!(Course::new(&Arc::new(TriMesh::default()), sample, &mut empty).is_err());
}
