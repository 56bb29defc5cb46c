//! The trial's engine by a clock of the test's own: what it tells of which command, and when.

use std::sync::Arc;
use std::time::Duration;

use super::engine::TrialEngine;
use super::haptic_channel::HapticChannel;
use super::message::{HAND, TrialCommand, TrialEvent};
use super::pace::BEHIND;
use crate::mesh::shapes::parted;
use crate::mesh::{TriMesh, Vec3};
use crate::phantom::Sample;
use crate::trial::STEP;
use crate::trial::autopilot::AutopilotTask;
use crate::trial::frame::{Frame, Progress};
use crate::trial::log::Log;
use crate::trial::setup::{Entry, Input, Setup};
use crate::trial::wire::Wire;

const SLICE: Duration = Duration::from_millis(1);

fn aorta() -> Arc<TriMesh> {
    Arc::new(crate::io::import_mesh(crate::phantom::generate(Sample::Aorta, 20_000).unwrap(), "sample").mesh)
}

fn events(engine: &mut TrialEngine) -> Vec<TrialEvent> {
    std::iter::from_fn(|| engine.poll()).collect()
}

/// The newest frame, asked for by standing still.
fn frame(engine: &mut TrialEngine, now_s: f64) -> Frame {
    engine.handle(TrialCommand::Pause(true));
    while engine.advance(now_s, SLICE).is_some() {}
    frames(engine).pop().unwrap().1
}

/// What frames were told, each with its number.
fn frames(engine: &mut TrialEngine) -> Vec<(u64, Frame)> {
    let frame = |event| match event {
        TrialEvent::Frame { id, frame } => Some((id, *frame)),
        _ => None,
    };
    events(engine).into_iter().filter_map(frame).collect()
}

/// The frames of 0.4 s of the clock.
fn run_from(engine: &mut TrialEngine, now_s: f64) -> Vec<(u64, Frame)> {
    (0..20).for_each(|i| _ = engine.advance(now_s + f64::from(i) * 0.02, Duration::from_millis(50)));
    frames(engine)
}

#[test]
fn a_comparison_that_is_cancelled_leaves_the_trial_as_it_stands() {
    let mesh = aorta();
    let mut engine = TrialEngine::new();
    let (sample, setup) = (Some(Sample::Aorta), Setup::default());
    engine.handle(TrialCommand::Start { id: 1, mesh: mesh.clone(), sample, setup: setup.clone() });
    assert!(matches!(events(&mut engine)[..], [TrialEvent::Preparing { id: 1, .. }, TrialEvent::Ready(_)]));
    engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
    for i in 0..200 {
        engine.advance(f64::from(i) * 0.02, Duration::from_millis(50));
    }
    let before = frame(&mut engine, 5.0);
    assert!(before.step > 200, "{}", before.step);
    engine.handle(TrialCommand::Compare { id: 2, mesh: mesh.clone() });
    engine.handle(TrialCommand::Measure { id: 3, mesh, sample, setup });
    assert_eq!(engine.advance(6.0, SLICE), Some(Duration::ZERO), "a job goes on");
    engine.handle(TrialCommand::Cancel { id: 2 });
    assert_eq!(engine.jobs.len(), 1, "the measurement is another's");
    engine.handle(TrialCommand::Cancel { id: 3 });
    let after = frame(&mut engine, 7.0);
    assert_eq!((after.step, &after.nodes), (before.step, &before.nodes));
    engine.handle(TrialCommand::Pause(false));
    for i in 0..10 {
        engine.advance(7.0 + f64::from(i) * 0.02, Duration::from_millis(50));
    }
    assert!(frame(&mut engine, 8.0).step > before.step);
    assert!(!events(&mut engine).iter().any(|event| matches!(event, TrialEvent::Compared { .. })));
}

#[test]
fn a_sweep_tells_how_far_it_is_and_all_seeds_and_can_be_cancelled() {
    let mesh = aorta();
    let mut engine = TrialEngine::new();
    let (sample, mut setup) = (Some(Sample::Aorta), Setup::default());
    // Entry and target are the sample's.
    crate::trial::course::Course::new(&mesh, sample, &mut setup).unwrap();
    let sweep =
        |id| TrialCommand::Sweep { id, mesh: mesh.clone(), original: mesh.clone(), setup: setup.clone(), seeds: 2 };
    engine.handle(sweep(4));
    engine.advance(0.0, SLICE);
    engine.handle(TrialCommand::Cancel { id: 4 });
    assert!(engine.jobs.is_empty() && events(&mut engine).is_empty());
    engine.handle(sweep(5));
    while engine.advance(0.0, Duration::from_secs(1)).is_some() {}
    let mut told = events(&mut engine);
    let Some(TrialEvent::Swept { id: 5, row }) = told.pop() else { panic!("{told:?}") };
    assert_eq!((row.seeds, row.arrived, row.triangles), (2, 2, mesh.triangles.len()));
    assert_eq!(row.deviation_mm.map(|spread| spread.largest), Some(0.0), "one surface beside itself");
    let fractions = told.iter().map(|event| match event {
        TrialEvent::Busy { id: 5, fraction } => *fraction,
        other => panic!("{other:?}"),
    });
    assert!(fractions.clone().is_sorted() && fractions.clone().all(|part| (0.0..=1.0).contains(&part)));
}

#[test]
fn time_runs_from_the_first_input_on_and_a_restart_is_by_hand() {
    let mut engine = TrialEngine::new();
    let (sample, setup) = (Some(Sample::Aorta), Setup::default());
    engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
    events(&mut engine);
    assert!(matches!(&run_from(&mut engine, 0.0)[..], [(_, frame)] if frame.step == 0), "the wire at its entry, once");
    engine.handle(TrialCommand::Save);
    let Some(TrialEvent::Saved { csv, json }) = engine.poll() else { panic!("no log") };
    assert_eq!(Log::read(csv.as_bytes()).unwrap().steps, 0);
    assert!(json.contains("\"steps\": 0"), "{json}");
    engine.handle(TrialCommand::Drive(Input::default()));
    assert_eq!(run_from(&mut engine, 100.0).last().unwrap().1.step, 0, "no input");
    engine.handle(TrialCommand::Autopilot(true));
    let steered = run_from(&mut engine, 300.0);
    let (_, last) = steered.last().unwrap();
    assert!(last.step > 0 && last.time_s < 0.5 && last.doing.is_some(), "{last:?}");
    assert!(!steered.iter().any(|(_, frame)| frame.is_behind), "what has passed while it stood is not owed");
    engine.handle(TrialCommand::Restart { id: 2 });
    assert_eq!(run_from(&mut engine, 400.0).last().unwrap().1.step, 0);
    engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
    let (_, by_hand) = run_from(&mut engine, 500.0).pop().unwrap();
    assert!(by_hand.feed == 20.0 && by_hand.doing.is_none(), "{by_hand:?}");
}

#[test]
fn frames_tell_what_they_belong_to() {
    let mut engine = TrialEngine::new();
    let (sample, setup) = (Some(Sample::Aorta), Setup::default());
    engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
    engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
    let is_of = |frames: &[(u64, Frame)], id| frames.len() > 5 && frames.iter().all(|frame| frame.0 == id);
    let first = run_from(&mut engine, 0.0);
    assert!(is_of(&first, 1), "{first:?}");
    engine.handle(TrialCommand::Restart { id: 5 });
    engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
    let second = run_from(&mut engine, 0.4);
    assert!(is_of(&second, 5) && second[0].1.step < first.last().unwrap().1.step, "{second:?}");
    // What is refused leaves the trial as it stands, and is answered all the same.
    engine.handle(TrialCommand::Replay { id: 6, csv: Arc::new(b"no log".to_vec()) });
    let third = run_from(&mut engine, 0.8);
    assert!(is_of(&third, 6), "{third:?}");
    engine.handle(TrialCommand::StepBack { id: 7 });
    engine.advance(2.0, SLICE);
    assert!(matches!(events(&mut engine)[..], [TrialEvent::Frame { id: 7, .. }]));
}

/// Drives for so many seconds of the clock by an input that is told every so many; gives the length that is in the
/// vessel after each tenth of a second.
fn inserted(engine: &mut TrialEngine, from_s: f64, seconds: f64, told_every: Option<f64>) -> Vec<f64> {
    let mut lengths = Vec::new();
    let mut due = told_every;
    for i in 0..(seconds * 100.0) as u32 {
        let passed = f64::from(i) / 100.0;
        if due.is_some_and(|due| passed >= due) {
            engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
            due = due.zip(told_every).map(|(due, every)| due + every);
        }
        engine.advance(from_s + passed, Duration::from_millis(50));
        if i % 10 == 9 {
            lengths.extend(engine.shown.as_ref().map(|shown| shown.trial().simulation().inserted()));
        }
    }
    lengths
}

#[test]
fn an_input_that_is_not_told_again_is_let_go() {
    let mut engine = TrialEngine::new();
    let (sample, setup) = (Some(Sample::Aorta), Setup::default());
    engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
    let entry = inserted(&mut engine, -1.0, 0.1, None)[0];
    engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
    let told_once = inserted(&mut engine, 0.0, 3.0, None);
    let last = told_once[29];
    // 20 mm/s for as long as an input holds, and for the row of the log that it ends in.
    let (fed, most) = (last - entry, 20.0 * (HAND + 0.02));
    assert!(fed <= most + 0.5 && fed >= 0.8 * most, "{fed} mm of {most}");
    assert!(told_once[10..].iter().all(|&length| (length - last).abs() < 1e-9), "{told_once:?}");
    let told_again = inserted(&mut engine, 3.0, 2.0, Some(0.1));
    let fed = told_again[19] - last;
    assert!((fed - 40.0).abs() < 4.0, "{fed} mm in two seconds");
    // By the clock, whatever the pace: the hand is as far from the simulated time as the user is.
    engine.handle(TrialCommand::Pace(0.25));
    engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
    let slow = inserted(&mut engine, 5.0, 3.0, None);
    let fed = slow[29] - told_again[19];
    assert!(fed > 0.5 * HAND * 5.0 && fed < 5.0 * (HAND + 0.1) + 1.0, "{fed} mm");
    // A machine that slept has no hand on it when it wakes.
    engine.handle(TrialCommand::Pace(1.0));
    engine.handle(TrialCommand::Drive(Input { feed: 20.0, roll: 0.0 }));
    engine.advance(8.0, Duration::from_millis(50));
    let before = inserted(&mut engine, 8.0, 0.1, None)[0];
    let after = inserted(&mut engine, 3600.0, 2.0, None)[19];
    assert!((after - before).abs() < 0.5, "{before} {after}");
}

#[test]
fn the_autopilot_and_a_log_need_no_hand() {
    let mut engine = TrialEngine::new();
    let (sample, setup) = (Some(Sample::Aorta), Setup::default());
    engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
    engine.handle(TrialCommand::Autopilot(true));
    let steered = inserted(&mut engine, 0.0, 3.0, None);
    assert!(steered[29] > 1.5 * 20.0 * HAND && steered[29] > steered[20], "{steered:?}");
    engine.handle(TrialCommand::Save);
    let csv = events(&mut engine).into_iter().find_map(|event| match event {
        TrialEvent::Saved { csv, .. } => Some(csv),
        _ => None,
    });
    let csv = Arc::new(csv.unwrap().into_bytes());
    engine.handle(TrialCommand::Replay { id: 2, csv });
    let replayed = inserted(&mut engine, 10.0, 2.5, None);
    assert!((replayed[20] - steered[20]).abs() < 1.0, "{} {}", replayed[20], steered[20]);
}

#[test]
fn what_the_wall_feels_between_frames_is_told() {
    let mut engine = TrialEngine::new();
    let (sample, setup) = (Some(Sample::Aorta), Setup { proposes_wire: true, ..Setup::default() });
    engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample, setup });
    engine.handle(TrialCommand::Autopilot(true));
    let (mut felt, mut framed, mut most) = (0.0_f64, 0.0_f64, None);
    let mut last = Progress::Running;
    for i in 0..20_000 {
        // A frame in 25 steps at first, where the largest force is; then as the engine asks for.
        let now_s = if i < 40 { f64::from(i) * BEHIND } else { 40.0 * BEHIND + f64::from(i) * 2.0 * STEP };
        engine.advance(now_s, Duration::from_secs(1));
        for event in events(&mut engine) {
            match event {
                TrialEvent::Felt { id: 1, touches } => {
                    felt = touches.iter().fold(felt, |most, touch| most.max(f64::from(touch.force)));
                }
                TrialEvent::Frame { frame, .. } => {
                    (framed, last) = (framed.max(frame.max_wall_force_n), frame.progress);
                }
                TrialEvent::Ended { summary, .. } => most = Some(summary.max_wall_force_n),
                _ => {}
            }
        }
        if most.is_some() {
            break;
        }
    }
    let most = most.expect("an end");
    assert!((felt / most - 1.0).abs() < 1e-6, "{felt} of {most}");
    assert!(framed < most, "no frame has shown it: {framed} of {most}");
    assert_eq!(last, Progress::Arrived, "the end is shown");
}

#[test]
fn closing_the_trial_lets_measurements_go_on() {
    let mut engine = TrialEngine::new();
    let (sample, setup) = (Some(Sample::Aorta), Setup::default());
    engine.handle(TrialCommand::Measure { id: 7, mesh: aorta(), sample, setup });
    engine.handle(TrialCommand::Stop);
    assert_eq!(engine.advance(0.0, SLICE), Some(Duration::ZERO));
    engine.handle(TrialCommand::Compare { id: 8, mesh: Arc::default() });
    assert!(matches!(events(&mut engine)[..], [TrialEvent::Refused { id: 8, .. }]), "without a trial");
}

#[test]
fn a_refusal_tells_the_place_where_the_wire_does_not_fit() {
    let (mut engine, mesh) = (TrialEngine::new(), aorta());
    let mut setup = Setup::default();
    setup.wire.diameter_mm = 9.9;
    engine.handle(TrialCommand::Start { id: 4, mesh: mesh.clone(), sample: Some(Sample::Aorta), setup });
    let told = events(&mut engine);
    let [.., TrialEvent::Refused { id: 4, is_too_thin: true, at: Some(at), .. }] = &told[..] else {
        panic!("{told:?}")
    };
    let wall = mesh.positions.iter().map(|p| p.distance(Vec3::from(*at))).fold(f32::INFINITY, f32::min);
    assert!(wall > 1.0 && wall < 9.9 / 2.0 + 1.0, "{wall} mm from the wall: in a lumen thinner than the wire");
}

#[test]
fn a_device_s_hand_moves_the_wire_and_feels_it_and_one_that_is_silent_does_neither() {
    let exchange = HapticChannel::default();
    let mut engine = TrialEngine::with_hand(exchange.clone());
    engine.handle(TrialCommand::Start { id: 1, mesh: aorta(), sample: Some(Sample::Aorta), setup: Setup::default() });
    let length = |engine: &TrialEngine| engine.shown.as_ref().unwrap().trial().simulation().inserted();
    let mut now = 0.0;
    let mut run = |engine: &mut TrialEngine, seconds: f64, speed: Option<f64>| {
        let mut rest = None;
        for _ in 0..(seconds * 100.0) as u32 {
            if let Some(speed) = speed {
                exchange.moves([speed * 0.01, 0.0]);
            }
            now += 0.01;
            rest = engine.advance(now, Duration::from_millis(50));
        }
        rest
    };
    assert!(run(&mut engine, 0.1, None).is_some(), "a device may take hold at any time");
    run(&mut engine, 0.1, Some(0.0));
    let entry = length(&engine);
    run(&mut engine, 1.0, Some(20.0));
    let fed = length(&engine) - entry;
    assert!((fed - 20.0).abs() < 2.0, "{fed} mm");
    let feels = exchange.feels().unwrap();
    assert!(feels.felt[0].is_finite() && feels.stiffness[0] > 0.0);
    // Paused: nothing is felt, and what the hand does is not made up for.
    engine.handle(TrialCommand::Pause(true));
    run(&mut engine, 0.5, Some(20.0));
    assert!(exchange.feels().is_none());
    let stood = length(&engine);
    engine.handle(TrialCommand::Pause(false));
    run(&mut engine, 0.5, Some(0.0));
    assert!((length(&engine) - stood).abs() < 1.0, "{} mm", length(&engine) - stood);
    // Silent: the wire stands, and what it did before does not come back.
    exchange.moves([30.0, 0.0]);
    std::thread::sleep(2 * super::haptic_channel::STALE);
    let stood = length(&engine);
    run(&mut engine, 0.5, None);
    assert!((length(&engine) - stood).abs() < 1e-9 && exchange.feels().is_none());
}

#[test]
fn looking_ahead_goes_on_in_slices_while_the_wire_stands_and_ends_where_a_hand_takes_it() {
    // A trunk with a branch in which this wire fails twice.
    let (mesh, end) = parted(8.0, 90.0, 40.0, 1.0);
    let mesh = Arc::new(mesh);
    let wire = Wire::preset("035-angled").unwrap();
    let entry = Some(Entry { at: [0.0, 0.0, 4.0], direction: [0.0, 0.0, 1.0] });
    let setup = Setup { wire, entry, target: Some(end.as_vec3().to_array()), seed: 2, ..Setup::default() };
    let mut engine = TrialEngine::new();
    engine.handle(TrialCommand::Start { id: 1, mesh, sample: None, setup });
    engine.handle(TrialCommand::Autopilot(true));
    let mut now_s = 0.0;
    let mut advance = |engine: &mut TrialEngine| {
        now_s += 0.02;
        (engine.advance(now_s, SLICE), frames(engine).pop().map(|(_, frame)| frame))
    };
    let looks = |frame: &Frame| matches!(frame.doing, Some(AutopilotTask::LookingAhead { .. }));
    let first = (0..50_000).find_map(|_| advance(&mut engine).1.filter(looks)).expect("it looks ahead");
    let (again, next) = advance(&mut engine);
    let next = next.expect("a frame");
    assert_eq!((again, next.step, &next.nodes), (Some(Duration::ZERO), first.step, &first.nodes));
    assert!(looks(&next) && !next.is_behind, "{next:?}");
    engine.handle(TrialCommand::Autopilot(false));
    let held = advance(&mut engine).1.expect("a frame");
    assert!(held.doing.is_none() && held.step - first.step <= 10, "{held:?}");
}
