//! `lumen trial --serve`: another program holds the wire, by lines of JSON on standard input and output (docs/serve.md). The
//! Python package takes and gives the same lines without a process between.

use std::io::{BufRead, Write};
use std::sync::Arc;

use anyhow::{Result, anyhow};
use serde::{Deserialize, Serialize};

use super::trial::{begun, led, wire};
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::pipeline::report::DISCLAIMER;
use crate::trial::STEP;
use crate::trial::course::Course;
use crate::trial::frame::Progress;
use crate::trial::session::{ROW_STEPS, Trial};
use crate::trial::setup::{Entry, Input, Setup};

/// Of what this writes and reads.
const SCHEMA: u32 = 1;
/// Decisions of one request, at most: a minute.
const MOST: u32 = 3000;

/// A line that is read.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Request {
    /// A trial from the start.
    Reset(Reset),
    /// What the operator does for a while.
    Step(Step),
    /// Nothing is done.
    Observe(Observe),
}

/// What is not given is as on the command line.
#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Reset {
    seed: Option<u64>,
    wire: Option<String>,
    entry: Option<[f32; 3]>,
    direction: Option<[f32; 3]>,
    target: Option<[f32; 3]>,
    show: Vec<Show>,
}

#[derive(Debug, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Step {
    feed_mm_s: f32,
    roll_rad_s: f32,
    /// How often, each for [`ROW_STEPS`] steps.
    repeat: u32,
    show: Vec<Show>,
}

impl Default for Step {
    fn default() -> Self {
        Self { feed_mm_s: 0.0, roll_rad_s: 0.0, repeat: 1, show: Vec::new() }
    }
}

#[derive(Debug, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Observe {
    show: Vec<Show>,
}

/// What is told on request alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Show {
    Nodes,
    Contacts,
}

/// A line that is written.
#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Answer {
    /// To a reset, and at the start.
    Trial {
        trial: About,
        observation: Box<Observation>,
    },
    Observation {
        observation: Box<Observation>,
    },
    /// What could not be done; the trial stands as it was.
    Error {
        error: String,
    },
}

/// What stays as it is until the next reset.
#[derive(Debug, Serialize)]
struct About {
    schema: u32,
    triangles: usize,
    wire: String,
    entry: Option<Entry>,
    target: Option<[f32; 3]>,
    seed: u64,
    route_length_mm: f64,
    decision_s: f64,
    most_feed_mm_s: f32,
    most_roll_rad_s: f32,
    notice: &'static str,
}

/// The wire at one moment. Forces are those of the last step that was balanced.
#[derive(Debug, Serialize)]
struct Observation {
    steps: u64,
    time_s: f64,
    tip_mm: [f64; 3],
    tip_direction: [f32; 3],
    tip_side: [f32; 3],
    inserted_mm: f64,
    roll_rad: f64,
    push_n: f64,
    torque_n_mm: f64,
    wall_force_n: f64,
    max_wall_force_n: f64,
    tip_force_n: f64,
    contacts: usize,
    route_mm: f64,
    target_mm: f64,
    branch: u32,
    is_wrong_branch: bool,
    is_looped: bool,
    has_arrived: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    nodes_mm: Option<Vec<[f32; 3]>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    contacts_at: Option<Vec<Contact>>,
}

#[derive(Debug, Serialize)]
struct Contact {
    at_mm: [f64; 3],
    triangle: u32,
    force_n: f64,
}

/// A vessel, and the trial in it, for another program.
pub struct Door {
    mesh: Arc<TriMesh>,
    sample: Option<Sample>,
    /// What the command line asks for.
    asked: Setup,
    /// Where that leads.
    home: (Arc<Course>, Setup),
    element: Option<f64>,
    trial: Trial,
}

/// Answers each line of `input` with one on `output`, until there is none. The first is written before any is read.
///
/// # Errors
/// When no trial is possible on this surface, or a line cannot be read or written.
pub(super) fn serve(
    mesh: &Arc<TriMesh>,
    sample: Option<Sample>,
    asked: Setup,
    element: Option<f64>,
    input: impl BufRead,
    mut output: impl Write,
) -> Result<()> {
    let mut door = Door::new(mesh.clone(), sample, asked, element)?;
    write(&mut output, &door.greeting()?)?;
    for line in input.split(b'\n') {
        let line = line?;
        if line.trim_ascii().is_empty() {
            continue;
        }
        let refused = |error| serde_json::to_string(&Answer::Error { error: format!("{error:#}") });
        write(&mut output, &door.answered(&line).or_else(refused)?)?;
    }
    Ok(())
}

fn write(output: &mut impl Write, answer: &str) -> Result<()> {
    writeln!(output, "{answer}")?;
    Ok(output.flush()?)
}

impl Door {
    /// A trial at its start, the wire in elements of `element` mm if that is asked for.
    ///
    /// # Errors
    /// When no trial is possible on this surface.
    pub fn new(mesh: Arc<TriMesh>, sample: Option<Sample>, asked: Setup, element: Option<f64>) -> Result<Self> {
        let home = led(&mesh, sample, asked.clone())?;
        // Nobody but who holds the wire takes it out for another.
        let trial = begun(home.clone(), element, false)?;
        Ok(Self { mesh, sample, asked, home, element, trial })
    }

    /// What is said before anything is asked.
    ///
    /// # Errors
    /// When a number cannot be written.
    pub fn greeting(&self) -> Result<String> {
        Ok(serde_json::to_string(&self.about(&[]))?)
    }

    /// The answer to a line.
    ///
    /// # Errors
    /// When it cannot be followed; the trial stands as it was.
    pub fn answered(&mut self, line: &[u8]) -> Result<String> {
        let request = serde_json::from_slice(line).map_err(|error| anyhow!("the line is not understood: {error}"))?;
        Ok(serde_json::to_string(&self.answer(request)?)?)
    }

    fn answer(&mut self, request: Request) -> Result<Answer> {
        match request {
            Request::Reset(reset) => {
                self.trial = self.reset(&reset)?;
                Ok(self.about(&reset.show))
            }
            Request::Step(step) => {
                if !(1..=MOST).contains(&step.repeat) {
                    return Err(anyhow!("repeat is 1 to {MOST}, not {}", step.repeat));
                }
                self.trial.drive(Input { feed: step.feed_mm_s, roll: step.roll_rad_s });
                for _ in 0..u64::from(step.repeat) * ROW_STEPS {
                    self.trial.step();
                }
                Ok(Answer::Observation { observation: self.observation(&step.show) })
            }
            Request::Observe(Observe { show }) => Ok(Answer::Observation { observation: self.observation(&show) }),
        }
    }

    fn reset(&self, reset: &Reset) -> Result<Trial> {
        if reset.direction.is_some() && reset.entry.is_none() {
            return Err(anyhow!("a direction is that of an entry, which is missing"));
        }
        let is_as_asked = reset.wire.is_none() && reset.entry.is_none() && reset.target.is_none();
        let (course, mut setup) = if is_as_asked {
            self.home.clone()
        } else {
            let mut setup = self.asked.clone();
            if let Some(name) = &reset.wire {
                (setup.wire, setup.proposes_wire) = (wire(Some(name))?, false);
            }
            if let Some(at) = reset.entry {
                setup.entry = Some(Entry { at, direction: reset.direction.unwrap_or_default() });
            }
            setup.target = reset.target.or(setup.target);
            led(&self.mesh, self.sample, setup)?
        };
        setup.seed = reset.seed.unwrap_or(self.asked.seed);
        begun((course, setup), self.element, false)
    }

    fn about(&self, show: &[Show]) -> Answer {
        let (setup, course) = (self.trial.setup(), self.trial.course());
        let trial = About {
            schema: SCHEMA,
            triangles: self.mesh.triangles.len(),
            wire: setup.wire.name.clone(),
            entry: setup.entry,
            target: setup.target,
            seed: setup.seed,
            route_length_mm: course.route.length_mm,
            decision_s: STEP * ROW_STEPS as f64,
            most_feed_mm_s: Input::MAX_FEED,
            most_roll_rad_s: Input::MAX_ROLL,
            notice: DISCLAIMER,
        };
        Answer::Trial { trial, observation: self.observation(show) }
    }

    fn observation(&self, show: &[Show]) -> Box<Observation> {
        let (frame, simulation) = (self.trial.frame(), self.trial.simulation());
        let contacts = || {
            let touches = simulation.body().touches();
            touches.map(|(_, at, triangle, force_n)| Contact { at_mm: at.into(), triangle, force_n }).collect()
        };
        Box::new(Observation {
            steps: frame.step,
            time_s: frame.time_s,
            tip_mm: simulation.tip().into(),
            tip_direction: frame.tip_direction,
            tip_side: frame.tip_side,
            inserted_mm: frame.inserted_mm,
            roll_rad: frame.roll,
            push_n: frame.push_n,
            torque_n_mm: frame.torque_n_mm,
            wall_force_n: frame.wall_force_n,
            max_wall_force_n: frame.max_wall_force_n,
            tip_force_n: frame.tip_force_n,
            contacts: frame.contacts,
            route_mm: frame.arc_mm,
            target_mm: frame.target_mm,
            branch: frame.branch,
            is_wrong_branch: frame.is_wrong_branch,
            is_looped: frame.is_looped,
            has_arrived: frame.progress == Progress::Arrived,
            contacts_at: show.contains(&Show::Contacts).then(contacts),
            nodes_mm: show.contains(&Show::Nodes).then_some(frame.nodes),
        })
    }
}
