//! `lumen trial`: the autopilot steers a guidewire through a surface; what happens is printed, and logged on request.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result};
use clap::Args;

use super::misuse::misuse;
use super::options::percent;
use super::places;
use super::places::write_whole;
use super::rows::row;
use super::running::advance;
use super::serve::serve;
use super::source::{self, UNIT_HELP, UnitOption};
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::pipeline::run::Pipeline;
use crate::pipeline::safe::PastSafe;
use crate::pipeline::settings::{Settings, Smoothing, Target};
use crate::trial::course::{Course, TrialError};
use crate::trial::route::RouteError;
use crate::trial::session::Trial as Run;
use crate::trial::setup::{Entry, Press, Setup};
use crate::trial::summary::Summary;
use crate::trial::wire::Wire;

/// Steers a guidewire through a surface.
#[derive(Debug, Args)]
pub struct Trial {
    /// A surface file, or sample:aorta, sample:coronary
    file: String,
    /// Percentage of triangles to remove first
    #[arg(long, value_name = "PERCENT", default_value = "0", value_parser = percent)]
    reduction: f64,
    /// Triangles that a sample is made with; of a file, those that are left (in place of --reduction)
    #[arg(long, value_name = "N")]
    triangles: Option<u32>,
    /// The wire [default: what suits the sample, or the way]
    #[arg(long, value_name = "NAME")]
    wire: Option<String>,
    /// Where the wire enters: x,y,z in mm; it points along the vessel
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    entry: Option<[f32; 3]>,
    /// Where it points there: x,y,z
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true, requires = "entry")]
    direction: Option<[f32; 3]>,
    /// Where it should go: x,y,z in mm
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    target: Option<[f32; 3]>,
    /// Load on each mm of the wire in N, x,y,z: its weight, or what flowing blood does to it
    #[arg(long, value_name = "X,Y,Z", value_parser = point, allow_hyphen_values = true)]
    load: Option<[f32; 3]>,
    /// Presses each mm of the wire to the wall with so many N, away from the middle of the route, while at least so many
    /// mm are outside the guide
    #[arg(long, value_name = "N,MM", value_parser = press, allow_hyphen_values = true)]
    press: Option<Press>,
    /// Varies entry, roll and friction; 0 varies nothing
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    /// Length of an element in mm, from the tip to the end, in place of the wire's own
    #[arg(long, value_name = "MM")]
    element: Option<f64>,
    /// Pass band of the smoothing that comes first, 0 to 2
    #[arg(long, value_name = "K", default_value_t = SMOOTHING.0)]
    pass_band: f64,
    /// Its iterations; 0 leaves the surface as it is
    #[arg(long, value_name = "N", default_value_t = SMOOTHING.1)]
    iterations: u32,
    /// Write the log here
    #[arg(long, value_name = "OUT.csv")]
    log: Option<PathBuf>,
    /// Write the summary here
    #[arg(long, value_name = "OUT.json")]
    json: Option<PathBuf>,
    #[arg(long, value_name = "UNIT", help = UNIT_HELP)]
    unit: Option<UnitOption>,
    /// Let another program hold the wire, by lines of JSON on standard input and output
    #[arg(long, conflicts_with_all = ["log", "json"])]
    serve: bool,
}

/// Pass band and iterations. The paper's 0.01 and 100 draw coronary arteries shut (docs/benchmarks/calibre.md); these take the
/// stairs of a segmentation out and leave vessels of 1.5 mm open.
pub(super) const SMOOTHING: (f64, u32) = (0.1, 30);

/// `x,y,z`.
fn point(text: &str) -> Result<[f32; 3], String> {
    numbers(text).ok_or_else(|| format!("{text} is not a place: three numbers with commas between are"))
}

/// `n,mm`.
fn press(text: &str) -> Result<Press, String> {
    let wrong =
        || format!("{text} is no load with the length from which it acts: two numbers with a comma between are");
    let [n_per_mm, from_mm] = numbers(text).ok_or_else(wrong)?;
    Ok(Press { n_per_mm, from_mm })
}

/// So many numbers with commas between, all finite.
fn numbers<const N: usize>(text: &str) -> Option<[f32; N]> {
    let numbers: Vec<f32> = text.split(',').map(|part| part.trim().parse()).collect::<Result<_, _>>().ok()?;
    <[f32; N]>::try_from(numbers).ok().filter(|numbers| numbers.iter().all(|x| x.is_finite()))
}

/// A surface, and the sample it is, if it is one.
pub(super) fn surface(
    file: &str,
    triangles: Option<u32>,
    unit: Option<UnitOption>,
) -> Result<(Arc<TriMesh>, Option<Sample>)> {
    let sample = file.strip_prefix("sample:").map(str::parse).transpose()?;
    let imported = match (sample, triangles) {
        (Some(sample), Some(triangles)) => source::sample(sample, triangles as usize)?,
        _ => source::read(file, unit)?,
    };
    Ok((Arc::new(imported.mesh), sample))
}

/// The pipeline at settings for a trial.
pub(super) fn settings(smoothing: (f64, u32), target: Target) -> Settings {
    let smoothing = Smoothing { pass_band: smoothing.0, iterations: smoothing.1, ..Smoothing::PAPER };
    Settings { smoothing, target, ..Settings::default() }
}

impl Trial {
    /// Runs the trial.
    pub(super) fn run(&self) -> Result<()> {
        let outputs = [("the log", &self.log), ("the summary", &self.json)];
        let outputs = outputs.into_iter().filter_map(|(what, path)| Some((what.to_owned(), path.as_deref()?)));
        places::check([Path::new(&self.file)], outputs)?;
        let setup = self.setup()?;
        let (opened, sample) = surface(&self.file, self.triangles, self.unit)?;
        let target = match self.triangles {
            Some(count) if sample.is_none() => Target::Triangles(count),
            _ => Target::Reduction((self.reduction * 10.0).round() as u32),
        };
        let settings = settings((self.pass_band, self.iterations), target);
        settings.check().map_err(misuse)?;
        let mut pipeline = Pipeline::new(opened, settings).without_measures();
        advance(&mut pipeline)?;
        let mesh = pipeline.reduced().context("the pipeline ended without a result")?.mesh.clone();
        if self.serve {
            return serve(&mesh, sample, setup, self.element, std::io::stdin().lock(), std::io::stdout().lock());
        }
        let run = match trial(&mesh, sample, setup, self.element, true) {
            Ok(run) => run,
            Err(error) => {
                // Its own reason counts more than one for which no rate is found.
                if may_be_narrowed(&error)
                    && let Ok(Some(sentence)) = past_safe(pipeline)
                {
                    eprintln!("lumen: warning: {sentence}");
                }
                return Err(error);
            }
        };
        let summary = run.summary();
        if let Some(path) = &self.log {
            write_whole(path, run.log().csv(summary.steps)?.as_bytes())?;
        }
        if let Some(path) = &self.json {
            write_whole(path, serde_json::to_string_pretty(&summary)?.as_bytes())?;
        }
        print(&summary);
        // To find the safe rate takes as long as the verdict: only a failure is worth it.
        if !summary.success
            && let Some(sentence) = past_safe(pipeline)?
        {
            row("safe rate", sentence);
        }
        println!("{}", summary.notice);
        Ok(())
    }

    fn setup(&self) -> Result<Setup> {
        let mut wire = wire(self.wire.as_deref())?;
        if let Some(element) = self.element {
            wire.elements_mm = [element; 2];
        }
        wire.check().map_err(misuse)?;
        let entry = self.entry.map(|at| Entry { at, direction: self.direction.unwrap_or([0.0; 3]) });
        let setup = Setup {
            wire,
            proposes_wire: self.wire.is_none(),
            entry,
            target: self.target,
            load: self.load.unwrap_or_default(),
            press: self.press.unwrap_or_default(),
            next_wires: Vec::new(),
            seed: self.seed,
        };
        setup.check_loads().map_err(misuse)?;
        Ok(setup)
    }
}

/// The wire of that name; without one, the first.
pub(super) fn wire(name: Option<&str>) -> Result<Wire> {
    let Some(name) = name else { return Ok(Wire::default()) };
    Wire::preset(name).ok_or_else(|| {
        let names: Vec<_> = Wire::names().collect();
        misuse(format!("there is no wire {name:?}; there are {}", names.join(", ")))
    })
}

/// The way of a setup, and the setup with what it proposes.
pub(super) fn led(mesh: &Arc<TriMesh>, sample: Option<Sample>, mut setup: Setup) -> Result<(Arc<Course>, Setup)> {
    let course = Course::new(mesh, sample, &mut setup).context("no trial is possible")?;
    Ok((Arc::new(course), setup))
}

/// A trial from the start, the wire in elements of `element` mm if that is asked for, and with other wires after it if that is.
pub(super) fn begun((course, mut setup): (Arc<Course>, Setup), element: Option<f64>, exchanges: bool) -> Result<Run> {
    // Wires that are proposed come with their own.
    if let Some(element) = element {
        std::iter::once(&mut setup.wire).chain(&mut setup.next_wires).for_each(|wire| wire.elements_mm = [element; 2]);
    }
    if !exchanges {
        setup.next_wires.clear();
    }
    Run::new(course, setup).context("no trial is possible")
}

/// Runs the autopilot on a surface to the end; the rest as [`begun`] has it.
pub(super) fn trial(
    mesh: &Arc<TriMesh>,
    sample: Option<Sample>,
    setup: Setup,
    element: Option<f64>,
    exchanges: bool,
) -> Result<Run> {
    let mut run = begun(led(mesh, sample, setup)?, element, exchanges)?;
    run.set_autopilot(true);
    run.finish();
    Ok(run)
}

fn print(summary: &Summary) {
    row("result", &summary.reason);
    row("triangles", summary.triangles);
    row(
        "route",
        format!(
            "{:.1} mm, smallest radius {:.2} mm, {} branches passed",
            summary.route_length_mm, summary.route_smallest_radius_mm, summary.branches_passed
        ),
    );
    row("time", format!("{:.2} s, {} steps", summary.time_s, summary.steps));
    let times = summary.step_ms;
    row(
        "speed",
        format!(
            "{:.0} steps a second; a step {:.3} ms, 99 % within {:.3}, at most {:.3}",
            summary.steps_per_second, times.mean, times.p99, times.max
        ),
    );
    row("preparation", format!("{:.0} ms wall, {:.0} ms route", summary.wall_build_ms, summary.route_build_ms));
    row(
        "wire",
        format!(
            "{}, up to {} nodes, {:.0} % of them touching",
            if summary.failed_wires.is_empty() {
                summary.wire.clone()
            } else {
                format!("{} (after {} had failed)", summary.wire, summary.failed_wires.join(", "))
            },
            summary.max_nodes,
            100.0 * summary.max_contact_share
        ),
    );
    if let Some(sentence) = &summary.reach {
        row("reach", sentence);
    }
    let kinds = summary.step_kinds;
    row(
        "balance",
        format!(
            "{:.1} % of the steps are not balanced ({} braked, {} waited, {} held); forces are those of the others",
            100.0 * summary.unbalanced_share,
            kinds.braked,
            kinds.waited,
            kinds.held
        ),
    );
    row("feed", format!("{:.1} mm of {:.1} mm asked for, there and back", summary.fed_mm, summary.wanted_feed_mm));
    row(
        "wall force",
        format!("{:.4} N at most, {:.4} N in all on average", summary.max_wall_force_n, summary.mean_wall_force_n),
    );
    row(
        "push, torque at the guide",
        format!("{:.3} N, {:.4} N mm at most", summary.max_push_n, summary.max_torque_n_mm),
    );
    row("reached into the wall", format!("{:.4} mm at most", summary.max_penetration_mm));
    row(
        "length error",
        format!(
            "{:.4} % on average, {:.4} % at most; a single element {:.4} %",
            summary.mean_length_error_percent, summary.max_length_error_percent, summary.max_element_error_percent
        ),
    );
    row(
        "tries",
        format!(
            "{} retractions, {} wrong branches, {} loops; path {:.2} times the route",
            summary.retractions, summary.wrong_branches, summary.loops, summary.path_ratio
        ),
    );
    if summary.steps_looked_ahead > 0 {
        row("looked ahead", format!("{} steps, beside those of the trial", summary.steps_looked_ahead));
    }
}

/// Whether a reduction can be why no trial is possible: not where an entry or target was given in the wrong place.
fn may_be_narrowed(error: &anyhow::Error) -> bool {
    use TrialError::{NoEntry, NoTarget, Route};
    let no_room = |error: &RouteError| matches!(error, RouteError::NoWay { .. } | RouteError::TooThin { .. });
    match error.downcast_ref() {
        Some(NoEntry | NoTarget) => true,
        Some(Route(error)) => no_room(error),
        _ => false,
    }
}

/// That the level is reduced further than is safe, if it is.
fn past_safe(pipeline: Pipeline) -> Result<Option<PastSafe>> {
    let triangles = pipeline.reduced().map(|level| level.mesh.triangles.len());
    let is_reduced = pipeline.settings().target != Target::Reduction(0);
    let Some(triangles) = triangles.filter(|_| is_reduced) else { return Ok(None) };
    let mut pipeline = pipeline.with_safe();
    advance(&mut pipeline)?;
    Ok(pipeline.safe().and_then(|safe| safe.past(triangles)))
}
