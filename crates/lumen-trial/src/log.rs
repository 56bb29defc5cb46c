//! The log of a trial: a row every ten steps, as CSV. The input of a row is in force from its step on, so that the log
//! replays to the same end.
//!
//! Every field is a number, so a line is split at its commas; the setup stands in a comment line as JSON.

use std::fmt::Write;

use glam::DVec3;

use super::STEP;
use super::meter::SinceRow;
use super::reach::ReachFinding;
use super::setup::{Command, Input, Setup};
use lumen_message::messages;

/// Version of the columns of the log and of the fields of the summary.
pub const SCHEMA: u32 = 3;
/// The columns.
const COLUMNS: &str = "step,time_s,feed_mm_s,roll_rad_s,inserted_mm,roll_rad,tip_x,tip_y,tip_z,tip_dx,tip_dy,tip_dz,\
arc_mm,branch,off_route,target_mm,path_ratio,contacts,wall_force_n,max_wall_force_n,max_x,max_y,max_z,tip_force_n,\
push_n,torque_n_mm,retractions,wrong_branches,step_ms,balanced,unsettled,braked,waited,held,wanted_mm,fed_mm,residual_n,wire";
/// The place of the last of them, and the first schema that has it: trials before that have one wire.
const WIRE: usize = 37;
const WITH_WIRES: u32 = 3;

/// The oldest schema whose input can be read.
const OLDEST: u32 = 1;

/// A moment. Forces are those of the last balanced step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Steps since the start.
    pub step: u64,
    /// From this step on.
    pub input: Input,
    /// The wire that is in: see [`Setup::nth_wire`].
    pub wire: usize,
    /// Length outside the guide in mm.
    pub inserted_mm: f64,
    /// Roll at the guide in radians.
    pub roll: f64,
    /// The tip in mm, and its direction.
    pub tip: DVec3,
    /// Of length 1.
    pub tip_direction: DVec3,
    /// Arc length along the route in mm.
    pub arc_mm: f64,
    /// The branch that the tip is in.
    pub branch: u32,
    /// Whether that is off the route.
    pub is_off: bool,
    /// Distance from the target in mm.
    pub target_mm: f64,
    /// Length of the tip's way so far over the route's length.
    pub path_ratio: f64,
    /// Places that press against the wall.
    pub contacts: usize,
    /// Sum of normal forces in N.
    pub wall_force_n: f64,
    /// The largest at one place since the last row, in N, and where.
    pub max_wall_force_n: f64,
    /// In mm.
    pub max_at: DVec3,
    /// Within 5 mm of the tip, in N.
    pub tip_force_n: f64,
    /// As in [`StepReport::push_n`](super::report::StepReport::push_n).
    pub push_n: f64,
    /// As in [`StepReport::torque_n_mm`](super::report::StepReport::torque_n_mm).
    pub torque_n_mm: f64,
    /// Times withdrawn.
    pub retractions: u32,
    /// Times in a wrong branch.
    pub wrong_branches: u32,
    /// Mean milliseconds of the steps since the last row.
    pub step_ms: f64,
    /// What the steps since the last row came to.
    pub since: SinceRow,
}

/// All rows of a trial.
#[derive(Clone, Debug, PartialEq)]
pub struct Log {
    setup: Setup,
    surface: u64,
    /// What the tip of the first wire does not reach.
    reach: Option<ReachFinding>,
    /// The rows.
    pub rows: Vec<Row>,
}

messages! {
    /// Why a log cannot be replayed.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum LogError {
        /// Not one of ours.
        "trial-log-none" NoLog =>
            "this is no log of a Lumen trial: its first line is not \"# lumen trial log\"",
        /// From another version.
        "trial-log-schema" Schema {
            /// The number that stands there.
            found: String,
            /// The oldest that can be read.
            oldest: u32,
            /// The newest.
            newest: u32,
        } => "the log has schema {found}; this version reads schemas {oldest} to {newest}",
        /// The setup cannot be read.
        "trial-log-setup" Setup {
            /// What `serde_json` says.
            why: String,
        } => "the setup in the log cannot be read: {why}",
        /// The setup is not there.
        "trial-log-no-setup" NoSetup => "the log does not say what the setup was",
        /// A line cannot be read.
        "trial-log-line" Line {
            /// Counted from 1.
            line: usize,
            /// What is wrong.
            what: LineProblem,
        } => "line {line} of the log cannot be read: {what}",
    }
}

messages! {
    /// What is wrong with a line of a log.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum LineProblem {
        /// The number of steps of the log is none.
        "trial-log-steps" Steps => "the number of steps is no number",
        /// The step is none.
        "trial-log-step" Step => "its step is no number",
        /// The feed is none.
        "trial-log-feed" Feed => "its feed is no number",
        /// The roll is none.
        "trial-log-roll" Roll => "its roll is no number",
        /// The wire is none of the setup's.
        "trial-log-wire" Wire => "its wire is none of those of the setup",
        /// The step is not after that of the line before.
        "trial-log-order" Order => "its step is not after the one before",
        /// The head names other columns.
        "trial-log-columns" Columns => "the columns are not those of a log",
    }
}

impl From<serde_json::Error> for LogError {
    fn from(error: serde_json::Error) -> Self {
        Self::Setup { why: error.to_string() }
    }
}

/// What a log says that is needed to replay it.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    /// The setup.
    pub setup: Setup,
    /// The surface's fingerprint in hexadecimal, as the summary has it.
    pub surface: String,
    /// Input and wire, each from a step on.
    pub inputs: Vec<Command>,
    /// Steps of it all.
    pub steps: u64,
}

impl Log {
    pub(super) fn new(setup: Setup, surface: u64, reach: Option<ReachFinding>) -> Self {
        Self { setup, surface, reach, rows: Vec::new() }
    }

    /// Input and wire of each row.
    pub fn inputs(&self) -> Vec<Command> {
        self.rows.iter().map(|row| Command { step: row.step, input: row.input, wire: row.wire }).collect()
    }

    /// The log as CSV, of a trial with so many steps.
    ///
    /// # Errors
    /// When the setup is not to be had as JSON.
    pub fn csv(&self, steps: u64) -> Result<String, serde_json::Error> {
        let setup = serde_json::to_string(&self.setup)?;
        let reach = self.reach.map_or(String::new(), |reach| format!("# {reach}\n"));
        let mut text = format!(
            "# lumen trial log, schema {SCHEMA}\n# not for clinical decisions\n{reach}# surface {:016x}\n# steps {steps}\n# setup {setup}\n{COLUMNS}\n",
            self.surface
        );
        for row in &self.rows {
            row.write(&mut text);
        }
        Ok(text)
    }

    /// Reads a log for its replay.
    ///
    /// # Errors
    /// Says which line is wrong.
    pub fn read(bytes: &[u8]) -> Result<Recorded, LogError> {
        let text = std::str::from_utf8(bytes).map_err(|_| LogError::NoLog)?;
        let mut lines = text.lines().enumerate();
        let head = lines.next().and_then(|(_, line)| line.strip_prefix("# lumen trial log, schema "));
        let schema = head.ok_or(LogError::NoLog)?.trim();
        let Some(version) = schema.parse::<u32>().ok().filter(|version| (OLDEST..=SCHEMA).contains(version)) else {
            return Err(LogError::Schema { found: schema.to_owned(), oldest: OLDEST, newest: SCHEMA });
        };
        let (mut setup, mut surface, mut inputs) = (None::<Setup>, String::new(), Vec::<Command>::new());
        let mut steps = 0;
        let mut has_columns = false;
        for (number, line) in lines {
            let wrong = |what| LogError::Line { line: number + 1, what };
            if let Some(json) = line.strip_prefix("# setup ") {
                setup = Some(serde_json::from_str(json)?);
            } else if let Some(count) = line.strip_prefix("# steps ") {
                steps = count.trim().parse().map_err(|_| wrong(LineProblem::Steps))?;
            } else if let Some(hash) = line.strip_prefix("# surface ") {
                surface = hash.trim().to_owned();
            } else if line.starts_with('#') || line.trim().is_empty() {
            } else if has_columns {
                let fields: Vec<&str> = line.split(',').collect();
                let speed = |column: usize| {
                    fields.get(column).and_then(|field| field.parse::<f32>().ok()).filter(|x| x.is_finite())
                };
                let step = fields[0].parse().map_err(|_| wrong(LineProblem::Step))?;
                let feed = speed(2).ok_or(wrong(LineProblem::Feed))?;
                let roll = speed(3).ok_or(wrong(LineProblem::Roll))?;
                let input = Input { feed, roll };
                if inputs.last().is_some_and(|last| last.step >= step) {
                    return Err(wrong(LineProblem::Order));
                }
                let wire = match fields.get(WIRE) {
                    Some(field) => field.parse().map_err(|_| wrong(LineProblem::Wire))?,
                    None if version < WITH_WIRES => 0,
                    None => return Err(wrong(LineProblem::Wire)),
                };
                if setup.as_ref().is_some_and(|setup| setup.nth_wire(wire).is_none()) {
                    return Err(wrong(LineProblem::Wire));
                }
                inputs.push(Command { step, input: input.limited(), wire });
            } else if line.starts_with("step,time_s,feed_mm_s,roll_rad_s,") {
                has_columns = true;
            } else {
                return Err(wrong(LineProblem::Columns));
            }
        }
        Ok(Recorded { setup: setup.ok_or(LogError::NoSetup)?, surface, inputs, steps })
    }
}

impl Row {
    fn write(&self, text: &mut String) {
        let Self { step, input, inserted_mm, roll, tip, tip_direction, .. } = *self;
        let point = |p: DVec3| p.to_array().map(|x| fixed(x, 4)).join(",");
        // Speeds stand in full, so that a replay has the same bits.
        let fields = [
            step.to_string(),
            fixed(step as f64 * STEP, 3),
            input.feed.to_string(),
            input.roll.to_string(),
            fixed(inserted_mm, 4),
            fixed(roll, 5),
            point(tip),
            point(tip_direction),
            fixed(self.arc_mm, 3),
            self.branch.to_string(),
            u8::from(self.is_off).to_string(),
            fixed(self.target_mm, 3),
            fixed(self.path_ratio, 4),
            self.contacts.to_string(),
            fixed(self.wall_force_n, 6),
            fixed(self.max_wall_force_n, 6),
            point(self.max_at),
            fixed(self.tip_force_n, 6),
            fixed(self.push_n, 6),
            fixed(self.torque_n_mm, 6),
            self.retractions.to_string(),
            self.wrong_branches.to_string(),
            fixed(self.step_ms, 4),
            self.since.counts.balanced.to_string(),
            self.since.counts.unsettled.to_string(),
            self.since.counts.braked.to_string(),
            self.since.counts.waited.to_string(),
            self.since.counts.held.to_string(),
            fixed(self.since.wanted_mm, 4),
            fixed(self.since.fed_mm, 4),
            fixed(self.since.residual_n, 6),
            self.wire.to_string(),
        ];
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", fields.join(","));
    }
}

/// With this many digits behind the point; nought has no sign.
fn fixed(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    if text.bytes().all(|byte| b"-0.".contains(&byte)) { text.replace('-', "") } else { text }
}
