//! A stand-in: a wire that follows the middle of the lumen, so that the views have something to show. The real engine
//! takes the place of this file.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Duration;

use glam::Vec3;

use super::trial::{RouteShown, TrialCommand, TrialComparison, TrialEvent, TrialReady};
use crate::mesh::TriMesh;
use crate::phantom::{Sample, vessels};
use crate::trial::STEP;
use crate::trial::frame::{Frame, Progress, StationResult, Summary, Touch};
use crate::trial::setup::{Entry, Input, Setup};

/// The trial as a machine of commands and events.
#[derive(Default)]
pub struct TrialEngine {
    run: Option<Run>,
    events: VecDeque<TrialEvent>,
}

struct Run {
    mesh: Arc<TriMesh>,
    setup: Setup,
    path: Vec<Vec3>,
    arcs: Vec<f32>,
    input: Input,
    autopilot: bool,
    paused: bool,
    pace: f64,
    clock: Option<f64>,
    time: f64,
    step: u64,
    inserted: f64,
    roll: f64,
    told: f64,
    over: bool,
}

impl TrialEngine {
    /// An engine without a trial.
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes a command.
    pub fn handle(&mut self, command: TrialCommand) {
        let run = &mut self.run;
        match (command, run.as_mut()) {
            (TrialCommand::Start { id, mesh, sample, setup }, _) => self.start(id, mesh, sample, setup),
            (TrialCommand::Measure { id, mesh, setup, .. }, _) => {
                let summary = Box::new(summary(&mesh, &setup, 20.0, 120.0));
                self.events.push_back(TrialEvent::Busy { fraction: 0.5 });
                self.events.push_back(TrialEvent::Measured { id, summary });
            }
            (TrialCommand::Stop, _) => *run = None,
            (_, None) => self.events.push_back(TrialEvent::Failed { message: "No trial is on.".to_owned() }),
            (TrialCommand::Drive(input), Some(run)) => run.input = input.limited(),
            (TrialCommand::Autopilot(on), Some(run)) => run.autopilot = on,
            (TrialCommand::Pause(on), Some(run)) => run.paused = on,
            (TrialCommand::Pace(pace), Some(run)) => run.pace = f64::from(pace),
            (TrialCommand::Restart | TrialCommand::Replay { .. }, Some(run)) => {
                (run.time, run.step, run.inserted, run.roll, run.told, run.over) = (0.0, 0, 0.0, 0.0, -1.0, false);
                run.input = Input::default();
            }
            (TrialCommand::StepBack, Some(run)) => {
                run.time = (run.time - 1.0).max(0.0);
                run.inserted = (run.inserted - 10.0).max(0.0);
                (run.paused, run.over, run.told) = (true, false, -1.0);
            }
            (TrialCommand::Save, Some(run)) => {
                let json = serde_json::to_string_pretty(&summary(&run.mesh, &run.setup, run.time, run.inserted));
                let csv = format!("# schema 1\ntime_s,feed\n{},{}\n", run.time, run.input.feed);
                self.events.push_back(TrialEvent::Saved { csv, json: json.unwrap_or_default() });
            }
            (TrialCommand::Compare { mesh }, Some(run)) => {
                let compared = run.compared(&mesh);
                self.events.push_back(TrialEvent::Compared(Box::new(compared)));
            }
        }
    }

    fn start(&mut self, id: u64, mesh: Arc<TriMesh>, sample: Option<Sample>, mut setup: Setup) {
        let path = way(&mesh, sample);
        let mut arcs = vec![0.0];
        for pair in path.windows(2) {
            arcs.push(arcs[arcs.len() - 1] + pair[0].distance(pair[1]));
        }
        let length = arcs[arcs.len() - 1];
        let at = |arc: f32| place(&path, &arcs, arc).0.to_array();
        setup.entry =
            setup.entry.or(Some(Entry { at: at(0.0), direction: (path[1] - path[0]).normalize().to_array() }));
        setup.target = setup.target.or(Some(at(length)));
        let points: Vec<_> = (0..200).map(|i| at(length * i as f32 / 199.0)).collect();
        let route = RouteShown {
            radii: points.iter().map(|&p| wall_distance(&mesh, p.into())).collect(),
            points,
            stations: (1..=5).map(|i| at(length * i as f32 / 6.0)).collect(),
            length_mm: f64::from(length),
            tortuosity: f64::from(length / path[0].distance(path[path.len() - 1])),
            smallest_radius_mm: 1.5,
            smallest_at: at(length),
            branches_passed: 3,
        };
        let entries = setup.entry.into_iter().collect();
        let targets = vec![("End".to_owned(), at(length)), ("Middle".to_owned(), at(length / 2.0))];
        let ready = TrialReady { id, setup: setup.clone(), route, entries, targets, wall_ms: 12.0, route_ms: 90.0 };
        self.events.push_back(TrialEvent::Preparing { id, fraction: 0.5 });
        self.events.push_back(TrialEvent::Ready(Box::new(ready)));
        self.run = Some(Run {
            mesh,
            setup,
            path,
            arcs,
            input: Input::default(),
            autopilot: false,
            paused: false,
            pace: 1.0,
            clock: None,
            time: 0.0,
            step: 0,
            inserted: 0.0,
            roll: 0.0,
            told: -1.0,
            over: false,
        });
    }

    /// Goes on for at most a slice; says after what time to call again.
    pub fn advance(&mut self, now_s: f64, _slice: Duration) -> Option<Duration> {
        let run = self.run.as_mut()?;
        let passed = run.clock.replace(now_s).map_or(0.0, |last| (now_s - last).min(0.05));
        if !(run.paused || run.over) {
            let feed = if run.autopilot { 10.0 } else { f64::from(run.input.feed) };
            let length = f64::from(run.arcs[run.arcs.len() - 1]);
            run.time += passed * run.pace;
            run.step = (run.time / STEP) as u64;
            run.inserted = (run.inserted + feed * passed * run.pace).clamp(0.0, length);
            run.roll += f64::from(run.input.roll) * passed * run.pace;
        }
        if run.time - run.told > 0.016 || run.told < 0.0 {
            run.told = run.time;
            let frame = run.frame();
            let arrived = frame.progress == Progress::Arrived && !run.over;
            self.events.push_back(TrialEvent::Frame(Box::new(frame)));
            if arrived {
                run.over = true;
                let ended = summary(&run.mesh, &run.setup, run.time, run.inserted);
                self.events.push_back(TrialEvent::Ended(Box::new(ended)));
            }
        }
        (!(run.paused || run.over)).then_some(Duration::from_millis(8))
    }

    /// What it has to say.
    pub fn poll(&mut self) -> Option<TrialEvent> {
        self.events.pop_front()
    }
}

impl Run {
    fn frame(&self) -> Frame {
        let tip = self.inserted as f32;
        let count = (tip / 1.5) as usize + 2;
        let nodes: Vec<[f32; 3]> = (0..count)
            .map(|i| {
                let arc = (tip - i as f32 * 1.5).max(0.0);
                let (at, along) = place(&self.path, &self.arcs, arc);
                let side = along.any_orthonormal_vector();
                (at + side * 0.8 * libm::sinf(arc * 0.12)).to_array()
            })
            .collect();
        let (at, direction) = place(&self.path, &self.arcs, tip);
        let touches: Vec<Touch> = nodes
            .iter()
            .step_by(12)
            .enumerate()
            .map(|(i, &node)| {
                let triangle = nearest(&self.mesh, node.into());
                let middle = self.mesh.corners(triangle).iter().sum::<Vec3>() / 3.0;
                let force = 0.15 + 0.12 * libm::sinf(i as f32 + self.time as f32);
                Touch { at: middle.to_array(), triangle: triangle as u32, force }
            })
            .collect();
        let length = f64::from(self.arcs[self.arcs.len() - 1]);
        Frame {
            step: self.step,
            time_s: self.time,
            forces: vec![[0.0; 3]; nodes.len()],
            tip_direction: direction.to_array(),
            tip_side: direction.any_orthonormal_vector().to_array(),
            inserted_mm: self.inserted,
            roll: self.roll,
            feed: if self.autopilot { 10.0 } else { self.input.feed },
            push_n: 0.1 + 0.003 * self.inserted,
            torque_n_mm: 0.2 * self.roll,
            wall_force_n: touches.iter().map(|touch| f64::from(touch.force)).sum(),
            max_wall_force_n: touches.iter().map(|touch| f64::from(touch.force)).fold(0.0, f64::max),
            tip_force_n: 0.05,
            arc_mm: f64::from(tip),
            target_mm: (length - self.inserted).max(0.0) + f64::from(at.x) * 0.0,
            branch: (self.inserted / 60.0) as u32,
            progress: if self.inserted > length - 2.0 { Progress::Arrived } else { Progress::Running },
            doing: if self.autopilot { "Feeds along the route".to_owned() } else { String::new() },
            steps_per_second: 900.0,
            nodes,
            touches,
            ..Frame::default()
        }
    }

    fn compared(&self, mesh: &TriMesh) -> TrialComparison {
        let arcs: Vec<f32> = (0..120).map(|i| i as f32 * self.inserted as f32 / 119.0).collect();
        let tip: Vec<_> = arcs.iter().map(|&arc| place(&self.path, &self.arcs, arc).0.to_array()).collect();
        let deviation: Vec<f32> = arcs.iter().map(|&arc| 0.15 + 0.15 * libm::sinf(arc * 0.05)).collect();
        let other = tip.iter().zip(&deviation).map(|(&p, &d)| (Vec3::from(p) + Vec3::X * d * 6.0).to_array());
        TrialComparison {
            verdict: "At 90 % this wire arrives; its tip path differs by 0.3 mm at most.".to_owned(),
            other_tip: other.collect(),
            inserted_mm: arcs,
            deviation_mm: deviation,
            force_differences: vec![(tip[tip.len() / 2], 0.12), (tip[tip.len() / 4], -0.05)],
            tip,
            smallest_before_mm: 3.21,
            smallest_after_mm: 3.05,
            summaries: [
                summary(&self.mesh, &self.setup, self.time, self.inserted),
                summary(mesh, &self.setup, self.time, self.inserted),
            ],
            ..TrialComparison::default()
        }
    }
}

fn summary(mesh: &TriMesh, setup: &Setup, time_s: f64, inserted: f64) -> Summary {
    let station = |i: u32| StationResult {
        arc_mm: f64::from(i) * 40.0,
        time_s: Some(f64::from(i) * 4.0),
        steps_per_second: Some(900.0),
        simulation_ms: Some(6.0 + 0.3 * f64::from(i)),
    };
    Summary {
        schema: 1,
        success: true,
        reason: "The tip arrived.".to_owned(),
        time_s,
        steps: (time_s / STEP) as u64,
        steps_per_second: 900.0,
        stations: (1..=5).map(station).collect(),
        initial_simulation_ms: 5.0,
        triangles: mesh.triangles.len(),
        wire: setup.wire.name.clone(),
        seed: setup.seed,
        max_wall_force_n: 0.27,
        mean_wall_force_n: 1.1,
        max_inserted_mm: inserted,
        ..Summary::default()
    }
}

/// Along a sample's vessels, or straight through the surface.
fn way(mesh: &TriMesh, sample: Option<Sample>) -> Vec<Vec3> {
    let Some(sample) = sample else {
        let bounds = mesh.bounds();
        let (low, high) = (Vec3::from(bounds.min), Vec3::from(bounds.max));
        let middle = bounds.centre();
        return (0..50).map(|i| Vec3::new(middle.x, middle.y, low.z + (high.z - low.z) * i as f32 / 49.0)).collect();
    };
    let list = vessels(sample);
    let mut at = list.iter().rposition(|vessel| vessel.open_end).unwrap_or(0);
    let mut path: Vec<Vec3> = Vec::new();
    let mut end = list[at].stations.len();
    loop {
        let piece: Vec<Vec3> = list[at].stations[..end].iter().map(|s| s.position.as_vec3()).collect();
        path.splice(0..0, piece);
        let Some(parent) = list[at].parent else { break };
        let from = list[at].stations[0].position;
        end = list[parent].stations.iter().position(|s| s.position.distance(from) < 1e-6).unwrap_or(0);
        at = parent;
    }
    if sample == Sample::Aorta {
        path.reverse();
    }
    path.dedup();
    path
}

/// The place at an arc length, and the direction there.
fn place(path: &[Vec3], arcs: &[f32], arc: f32) -> (Vec3, Vec3) {
    let i = arcs.partition_point(|&a| a <= arc).clamp(1, path.len() - 1);
    let along = path[i] - path[i - 1];
    let t = ((arc - arcs[i - 1]) / (arcs[i] - arcs[i - 1])).clamp(0.0, 1.0);
    (path[i - 1] + along * t, along.normalize_or(Vec3::Z))
}

/// Among some of the triangles, which is near.
fn nearest(mesh: &TriMesh, p: Vec3) -> usize {
    let step = mesh.triangles.len() / 20_000 + 1;
    let distance = |t: usize| mesh.positions[mesh.triangles[t][0] as usize].distance_squared(p);
    (0..mesh.triangles.len()).step_by(step).min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap_or(0)
}

fn wall_distance(mesh: &TriMesh, p: Vec3) -> f32 {
    mesh.positions[mesh.triangles[nearest(mesh, p)][0] as usize].distance(p)
}
