//! `lumen prepare`: a surface made ready for a flow or structure solver.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result, anyhow};
use clap::Args;
use serde_json::{Value, json};

use super::misuse::misuse;
use super::places::write_whole;
use super::rows::row;
use super::running::worked;
use super::source::{self, UNIT_HELP, UnitOption};
use super::{interrupt, places};
use crate::io::Imported;
use crate::pipeline::carry::carry_over;
use crate::pipeline::report::DISCLAIMER;
use crate::prepare::cap::CapKind;
use crate::prepare::cuts::{ClipAt, Cut};
use crate::prepare::ends::Length;
use crate::prepare::prepare::{Plan, Prepared, prepare};
use crate::prepare::remesh::Sizing;
use crate::prepare::write::SolverFormat;
use crate::sharing::{Beside, read_settings_and};

/// Makes a surface ready for a solver: ends cut square, extended and capped, triangles as large as the calibre asks for,
/// patches with names.
#[derive(Debug, Args)]
pub struct Prepare {
    /// A surface file, or sample:aorta, sample:coronary
    file: String,
    /// The folder to write into
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    /// Begin with what this file says, saved in the window with its settings; options count for more
    #[arg(long, value_name = "FILE.json")]
    settings: Option<PathBuf>,
    /// Take in place of the surface a watertight one, at most so far from it: mm, as in 0.3mm; "none". Crossing, double and
    /// inner triangles and gaps narrower than that are gone
    #[arg(long, value_name = "TOLERANCE", value_parser = or_none(tolerance), allow_hyphen_values = true)]
    wrap: Option<Said<f64>>,
    /// Take triangles that cross apart first
    #[arg(long, overrides_with = "no_uncross")]
    uncross: bool,
    #[arg(long, hide = true, overrides_with = "uncross")]
    no_uncross: bool,
    /// Cut the ends square to the vessel: "round" for where each is round, or so far in: radii, or mm as in 3mm; "none"
    #[arg(long, value_name = "WHERE", value_parser = or_none(clip_at), allow_hyphen_values = true)]
    clip: Option<Said<ClipAt>>,
    /// Cut the end nearest to a place in mm elsewhere than the others, as in 12.5,-3,80=3mm; "none" leaves it
    #[arg(long, value_name = "X,Y,Z=WHERE", value_parser = end_cut, allow_hyphen_values = true)]
    clip_end: Vec<Cut>,
    /// Extend each end by so many radii, or mm as in 30mm; "none"
    #[arg(long, value_name = "LENGTH", value_parser = or_none(length), allow_hyphen_values = true)]
    extend: Option<Said<Length>>,
    /// Close each end: fan, planar (evenly meshed), smooth or none
    #[arg(long, value_name = "KIND", value_parser = or_none(cap_kind))]
    cap: Option<Said<CapKind>>,
    /// Make triangles anew, with so many edges around a vessel; "none"
    #[arg(long, value_name = "N", value_parser = or_none(around))]
    remesh: Option<Said<f64>>,
    /// The shortest edge of these, in mm [default: 0.1]
    #[arg(long, value_name = "MM")]
    least: Option<f64>,
    /// The longest edge of these, in mm [default: 5]
    #[arg(long, value_name = "MM")]
    largest: Option<f64>,
    /// How far these may lie from the surface where it bends, in mm
    #[arg(long, value_name = "MM")]
    max_deviation: Option<f64>,
    /// What to write: stl, msh, inp, vtp, simvascular; a JSON of the patches comes with it
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = format, default_value = "vtp,stl")]
    format: Vec<SolverFormat>,
    #[arg(long, value_name = "UNIT", help = UNIT_HELP)]
    unit: Option<UnitOption>,
}

/// What was said of something that can be left out.
#[derive(Clone, Copy, Debug)]
enum Said<T> {
    Not,
    So(T),
}

impl<T> Said<T> {
    fn so(self) -> Option<T> {
        match self {
            Self::Not => None,
            Self::So(value) => Some(value),
        }
    }
}

/// Parses "none", or what `parse` does.
fn or_none<T>(parse: fn(&str) -> Result<T, String>) -> impl Fn(&str) -> Result<Said<T>, String> + Clone {
    move |text| if text == "none" { Ok(Said::Not) } else { parse(text).map(Said::So) }
}

fn around(text: &str) -> Result<f64, String> {
    text.parse().map_err(|_| format!("{text} is no number of edges"))
}

/// A number of mm, more than 0.
fn tolerance(text: &str) -> Result<f64, String> {
    let mm = text.strip_suffix("mm").unwrap_or(text).trim().parse().ok();
    mm.filter(|mm: &f64| mm.is_finite() && *mm > 0.0)
        .ok_or_else(|| format!("{text} is no tolerance in mm, as 0.3mm is"))
}

/// A number of radii, or of mm where that stands behind it.
fn length(text: &str) -> Result<Length, String> {
    let (number, of): (&str, fn(f64) -> Length) = match text.strip_suffix("mm") {
        Some(number) => (number.trim(), Length::Mm),
        None => (text, Length::Radii),
    };
    let number = number.parse().ok().filter(|number: &f64| number.is_finite() && *number >= 0.0);
    number.map(of).ok_or_else(|| format!("{text} is no length: a number of radii is, or of mm as in 3mm"))
}

fn clip_at(text: &str) -> Result<ClipAt, String> {
    if text == "round" { Ok(ClipAt::Round) } else { length(text).map(ClipAt::Distance) }
}

fn end_cut(text: &str) -> Result<Cut, String> {
    let wrong = || format!("{text} is no cut of an end: a place in mm and where is, as in 12.5,-3,80=3mm");
    let (place, at) = text.split_once('=').ok_or_else(wrong)?;
    let numbers: Option<Vec<f64>> =
        place.split(',').map(|x| x.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    let end_mm = numbers.and_then(|numbers| numbers.try_into().ok()).ok_or_else(wrong)?;
    Ok(Cut { end_mm, at: or_none(clip_at)(at)?.so() })
}

fn cap_kind(text: &str) -> Result<CapKind, String> {
    match text {
        "fan" => Ok(CapKind::Fan),
        "planar" => Ok(CapKind::Planar),
        "smooth" => Ok(CapKind::Smooth),
        _ => Err(format!("{text} is no kind of cap; there are fan, planar, smooth, none")),
    }
}

fn format(text: &str) -> Result<SolverFormat, String> {
    let of = |format: &SolverFormat| serde_json::to_value(format).is_ok_and(|name| name == text);
    let known = SolverFormat::ALL.into_iter().filter(|format| *format != SolverFormat::Json).find(of);
    known.ok_or_else(|| format!("{text} is no format; there are stl, msh, inp, vtp, simvascular"))
}

impl Prepare {
    /// Prepares the surface and writes it.
    pub(super) fn run(&self) -> Result<()> {
        let plan = self.plan()?;
        let stem = Path::new(&self.file).file_stem().map_or("surface".into(), |stem| stem.to_string_lossy());
        let stem = stem.replace(':', "-");
        let single = self.format.iter().filter(|format| !format.is_folder());
        let names: Vec<String> =
            single.map(|format| format.extension()).chain(["json"]).map(|ending| format!("{stem}.{ending}")).collect();
        self.check(names.iter().map(String::as_str))?;
        interrupt::listen()?;
        let Imported { mesh, arrays, .. } = source::read(&self.file, self.unit)?;
        let before = mesh.triangles.len();
        let (surface, entered) = (Arc::new(mesh), arrays);
        let mesh = Arc::clone(&surface);
        let found = worked("Preparing", |yielder| async move { prepare(&mesh, &plan, &yielder).await })?;
        let found = found.map_err(|error| anyhow!("the surface cannot be prepared: {error}"))?;
        let arrays = if entered.is_empty() || !self.format.iter().any(|format| format.has_arrays()) {
            Vec::new()
        } else {
            let to = found.surface.mesh.clone();
            worked("Carrying arrays", |yielder| async move { carry_over(entered, &surface, &to, &yielder).await })?
        };
        let mut files = vec![(format!("{stem}.json"), summary(&found)?)];
        for format in &self.format {
            files.extend(format.written_with(&found.surface, &arrays, &stem)?);
        }
        self.check(files.iter().map(|(name, _)| name.as_str()))?;
        for (name, bytes) in &files {
            self.write(name, bytes)?;
        }
        print(&found, before, &self.output);
        Ok(())
    }

    /// Refuses to write over the file that is read.
    fn check<'a>(&self, names: impl Iterator<Item = &'a str>) -> Result<()> {
        let outputs: Vec<(String, PathBuf)> = names.map(|name| (name.to_owned(), self.output.join(name))).collect();
        places::check([Path::new(&self.file)], outputs.iter().map(|(what, path)| (what.clone(), path.as_path())))
    }

    fn plan(&self) -> Result<Plan> {
        let begun = self.settings.as_deref().map(read).transpose()?.unwrap_or_default();
        let mut plan = Plan {
            uncross: (begun.uncross || self.uncross) && !self.no_uncross,
            clip: self.clip.map_or(begun.clip, Said::so),
            // Of two cuts of one end the last counts.
            cuts: [begun.cuts, self.clip_end.clone()].concat(),
            extend: self.extend.map_or(begun.extend, Said::so),
            cap: self.cap.map_or(begun.cap, Said::so),
            remesh: match self.remesh {
                Some(said) => said.so().map(|around| Sizing { around, ..begun.remesh.unwrap_or_default() }),
                None => begun.remesh,
            },
            wrap: self.wrap.map_or(begun.wrap, Said::so),
        };
        match &mut plan.remesh {
            Some(sizing) => {
                sizing.least_mm = self.least.unwrap_or(sizing.least_mm);
                sizing.largest_mm = self.largest.unwrap_or(sizing.largest_mm);
                sizing.max_deviation_mm = self.max_deviation.or(sizing.max_deviation_mm);
                sizing.check().map_err(misuse)?;
            }
            None if self.least.is_some() || self.largest.is_some() || self.max_deviation.is_some() => {
                return Err(misuse(
                    "--least, --largest and --max-deviation are of triangles that are made anew: say --remesh",
                ));
            }
            None => {}
        }
        if plan == Plan::default() {
            return Err(misuse(
                "nothing is asked for: say --wrap, --uncross, --clip, --clip-end, --extend, --cap or --remesh",
            ));
        }
        Ok(plan)
    }

    fn write(&self, name: &str, bytes: &[u8]) -> Result<()> {
        let path = self.output.join(name);
        let folder = path.parent().unwrap_or(&self.output);
        std::fs::create_dir_all(folder).with_context(|| format!("{} cannot be made", folder.display()))?;
        write_whole(&path, bytes)
    }
}

/// What a settings file says of a solver.
fn read(path: &Path) -> Result<Plan> {
    let name = || path.display().to_string();
    let bytes = std::fs::read(path).with_context(|| format!("cannot read {}", name()))?;
    let (_, Beside { solver, .. }) = read_settings_and(&bytes).with_context(name)?;
    solver.ok_or_else(|| misuse(format!("{} says nothing of a solver", name())))
}

/// The patches, what a volume mesher would say, and what was done otherwise than asked for.
fn summary(found: &Prepared) -> Result<Vec<u8>> {
    let files = SolverFormat::Json.written(&found.surface, "")?;
    let (_, patches) = files.first().context("no patches")?;
    let mut summary: Value = serde_json::from_slice(patches)?;
    let findings = found.fate.findings.iter().map(|finding| {
        json!({ "text": finding.fault.to_string(), "stops": finding.fault.stops(), "places_mm": finding.places })
    });
    summary["is_ready"] = found.fate.is_ready().into();
    summary["findings"] = findings.collect();
    summary["notes"] = found.notes.iter().map(ToString::to_string).collect();
    if let Some((quality, deviation)) = found.remeshed {
        summary["mean_quality"] = quality.mean.into();
        summary["least_angle_deg"] = quality.least_angle_deg.into();
        summary["below_30_deg_percent"] = (100.0 * quality.below_30_deg).into();
        summary["deviation_mm"] = deviation.to_old_mm.max(deviation.to_new_mm).into();
    }
    Ok(serde_json::to_vec_pretty(&summary)?)
}

fn print(found: &Prepared, before: usize, folder: &Path) {
    row("triangles", format!("{}, of {before}", found.surface.mesh.triangles.len()));
    for patch in &found.surface.patches {
        row(&patch.name, format!("{:.2} mm2, id {}", patch.area_mm2, patch.id));
    }
    if let Some([before, after]) = found.crossing {
        row("triangles that crossed", format!("{before}, {after} left"));
    }
    if let Some((quality, deviation)) = found.remeshed {
        row(
            "quality",
            format!(
                "{:.3} on the mean, least angle {:.1} degrees, {:.2} % of the triangles below 30",
                quality.mean,
                quality.least_angle_deg,
                100.0 * quality.below_30_deg
            ),
        );
        row("deviation", format!("{:.3} mm", deviation.to_old_mm.max(deviation.to_new_mm)));
    }
    row("volume meshers", if found.fate.is_ready() { "nothing was found that stops them" } else { "will not take it" });
    row("written to", format!("{}, in mm", folder.display()));
    for note in &found.notes {
        eprintln!("lumen: warning: {note}");
    }
    for finding in &found.fate.findings {
        eprintln!("lumen: warning: {}", finding.fault);
    }
    println!("{DISCLAIMER}");
}
