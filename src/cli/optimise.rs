//! `lumen optimise`: the whole pipeline on a file.

use std::io::IsTerminal;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow};
use clap::{Args, ValueEnum};
use indicatif::{ProgressBar, ProgressStyle};

use super::scan::ScanOptions;
use super::{branches, misuse, output_format, row, shape_rows, source, write_whole};
use crate::io::{self, Unit};
use crate::pipeline::deviation::REPORT_SAMPLES;
use crate::pipeline::narrowest::Narrowest;
use crate::pipeline::report::{DISCLAIMER, Report};
use crate::pipeline::results::Adapted;
use crate::pipeline::run::{Advance, Pipeline};
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::{Decimation, Keep, Method, Preset, Settings, Smoothing, Target, Window};
use crate::pipeline::stage::Stage;
use crate::pipeline::task::Budget;

/// Keeps the largest piece, smooths it, reduces it, and writes the result.
#[derive(Debug, Args)]
pub struct Optimise {
    /// A surface file, or sample:aorta, sample:coronary; a scan or a mask, or a folder of DICOM
    file: String,
    #[command(flatten)]
    scan: ScanOptions,
    /// Where to write: .stl, .ply, .obj, .vtp, .vtk or .glb
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// How to smooth: auto leaves every vessel its calibre and makes no triangles cross; paper is 0.01 and 100 iterations
    /// everywhere
    #[arg(long, value_name = "NAME", value_enum, ignore_case = true, default_value_t = Preset::default())]
    smoothing: Preset,
    /// Pass band of the smoothing filter, 0.001 to 2; with auto that of wide vessels [auto and paper: 0.01]
    #[arg(long, value_name = "F")]
    pass_band: Option<f64>,
    /// Iterations of the smoothing filter, 0 to 200; 0 skips smoothing [auto and paper: 100]
    #[arg(long, value_name = "N")]
    iterations: Option<u32>,
    /// Window of the smoothing filter [hamming]
    #[arg(long, value_name = "NAME", value_enum, ignore_case = true)]
    window: Option<Window>,
    /// Hold the volume to 0.01 % of what it is before smoothing, open ends capped
    #[arg(long)]
    preserve_volume: bool,
    /// Smooth all vessels by the same pass band, though thin ones lose their calibre
    #[arg(long)]
    no_adapt: bool,
    /// Let smoothing make triangles cross
    #[arg(long)]
    no_guard: bool,
    /// The part of the triangles to remove, in percent, 0 to 99.9 (90 or 90%); or safe: as many as leave every vessel its
    /// calibre to --tolerance
    #[arg(long, value_name = "PERCENT", value_parser = reduction, default_value = "90", conflicts_with = "triangles")]
    reduction: Reduction,
    /// How many triangles to keep, in place of --reduction
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    triangles: Option<u32>,
    /// The farthest that the result may be from the smoothed surface, both ways, in mm, 0.001 to 1000, in place of
    /// --reduction: as few triangles as stay within it
    #[arg(long, value_name = "MM", value_parser = micrometres, conflicts_with_all = ["reduction", "triangles"])]
    max_deviation: Option<u32>,
    /// How to reduce
    #[arg(long, value_name = "NAME", value_enum, ignore_case = true, default_value_t = Method::default())]
    method: Method,
    /// Edges sharper than this are kept as edges, degrees, 0 to 180; for schroeder
    #[arg(long, value_name = "DEG", default_value_t = Decimation::default().feature_angle)]
    feature_angle: f64,
    /// Spare thin vessels: an error counts the more, the thinner the vessel is
    #[arg(long)]
    spare_thin: bool,
    /// The unit of the numbers in the file: mm, cm or m
    #[arg(long, value_name = "UNIT")]
    unit: Option<Unit>,
    /// Keep every connected piece, not only the largest
    #[arg(long)]
    keep_all_components: bool,
    /// Write all numbers to this file
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,
    /// Print what became of the calibre of each branch
    #[arg(long)]
    branches: bool,
    /// Write the calibre along each branch to this file, a row a place
    #[arg(long, value_name = "FILE.csv")]
    branches_csv: Option<PathBuf>,
    /// The change of calibre that a branch is allowed, in percent, 0 to 100 (2 or 2%)
    #[arg(long, value_name = "PERCENT", value_parser = tolerance, default_value = "2")]
    tolerance: f64,
}

impl ValueEnum for Window {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(clap::builder::PossibleValue::new(self.name().to_lowercase()))
    }
}

impl ValueEnum for Preset {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(clap::builder::PossibleValue::new(match self {
            Self::Auto => "auto",
            Self::Paper => "paper",
            Self::None => "none",
        }))
    }
}

impl ValueEnum for Method {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<clap::builder::PossibleValue> {
        Some(clap::builder::PossibleValue::new(self.name().to_lowercase()))
    }
}

/// How far to reduce.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reduction {
    Percent(f64),
    /// As far as every vessel keeps its calibre.
    Safe,
}

fn reduction(text: &str) -> Result<Reduction, String> {
    if text.trim().eq_ignore_ascii_case("safe") { Ok(Reduction::Safe) } else { percent(text).map(Reduction::Percent) }
}

/// A reduction rate in percent, with or without the sign.
pub(super) fn percent(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches('%').trim_end();
    let value: f64 = number.parse().map_err(|_| format!("{text} is not a percentage"))?;
    let most = f64::from(Target::MAX_PER_MILLE) / 10.0;
    if (0.0..=most).contains(&value) { Ok(value) } else { Err(format!("{text} is not between 0 and {most} %")) }
}

/// A tolerance in percent, with or without the sign.
fn tolerance(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches('%').trim_end();
    let value: f64 = number.parse().map_err(|_| format!("{text} is not a percentage"))?;
    if (0.0..=100.0).contains(&value) { Ok(value) } else { Err(format!("{text} is not between 0 and 100 %")) }
}

/// A length in mm as thousandths, rounded down: what is within them is within the length.
fn micrometres(text: &str) -> Result<u32, String> {
    let number = text.trim().trim_end_matches("mm").trim_end();
    let value: f64 = number.parse().map_err(|_| format!("{text} is not a length in mm"))?;
    // The nearest binary fraction of 0.29 is a little less than 0.29.
    let thousandths = (value * 1000.0 + 1e-6).floor();
    let range = f64::from(*Target::DEVIATION.start())..=f64::from(*Target::DEVIATION.end());
    if range.contains(&thousandths) {
        Ok(thousandths as u32)
    } else {
        Err(format!("{text} is not between 0.001 and 1000 mm"))
    }
}

impl Optimise {
    /// The preset, with what else was asked for.
    fn smoothing(&self) -> Smoothing {
        let preset = self.smoothing.smoothing();
        Smoothing {
            window: self.window.unwrap_or(preset.window),
            pass_band: self.pass_band.unwrap_or(preset.pass_band),
            iterations: self.iterations.unwrap_or(preset.iterations),
            boundary: preset.boundary,
            preserve_volume: self.preserve_volume,
            adapt: preset.adapt && !self.no_adapt,
            guard: preset.guard && !self.no_guard,
        }
    }

    fn settings(&self) -> Settings {
        Settings {
            keep: if self.keep_all_components { Keep::All } else { Keep::Largest },
            smoothing: self.smoothing(),
            decimation: Decimation {
                method: self.method,
                feature_angle: self.feature_angle,
                spare_thin: self.spare_thin,
            },
            target: match (self.triangles, self.max_deviation) {
                (Some(count), _) => Target::Triangles(count),
                (None, Some(bound)) => Target::Deviation(bound),
                (None, None) => match self.reduction {
                    Reduction::Percent(percent) => Target::Reduction((percent * 10.0).round() as u32),
                    // Until it is known.
                    Reduction::Safe => Target::default(),
                },
            },
            tolerance_percent: self.tolerance,
        }
    }

    /// Runs the pipeline, writes the surface and the report, prints the table.
    pub(super) fn run(&self) -> Result<()> {
        let settings = self.settings();
        settings.check().unwrap_or_else(|error| misuse(error));
        let format = output_format(&self.output);
        if same_file(std::path::Path::new(&self.file), &self.output) {
            misuse(format!("{} would be overwritten: choose another output", self.file));
        }
        if let Some(report) = self.report.as_ref().filter(|report| same_file(std::path::Path::new(&self.file), report))
        {
            misuse(format!("{} would be overwritten by the report", report.display()));
        }
        if self.report.as_ref() == Some(&self.output) {
            misuse(format!("the surface and the report cannot both go to {}", self.output.display()));
        }
        if let Some(csv) = &self.branches_csv {
            if same_file(std::path::Path::new(&self.file), csv) {
                misuse(format!("{} would be overwritten by the branches", csv.display()));
            }
            if [Some(&self.output), self.report.as_ref()].contains(&Some(csv)) {
                misuse(format!("{} is asked for twice", csv.display()));
            }
        }
        if let (None, Reduction::Percent(percent)) = (self.triangles, self.reduction)
            && 0.0 < percent
            && percent < 1.0
        {
            eprintln!(
                "lumen: warning: --reduction {percent} removes less than one percent; nine tenths are --reduction 90"
            );
        }
        let start = Instant::now();
        let imported = source::read_with(&self.file, self.unit, &self.scan)?;
        let read = milliseconds(start.elapsed());
        let mut pipeline = Pipeline::new(Arc::new(imported.mesh), settings).with_samples(REPORT_SAMPLES);
        let wants_safe = self.reduction == Reduction::Safe && self.triangles.is_none() && self.max_deviation.is_none();
        if wants_safe {
            pipeline = pipeline.with_safe();
        } else if self.branches || self.report.is_some() || self.branches_csv.is_some() {
            pipeline = pipeline.with_certificate();
        }
        advance(&mut pipeline)?;
        if wants_safe {
            let safe = pipeline.safe().context("the search for the safe rate ended without a result")?;
            let why = safe.refused.as_deref().unwrap_or_default();
            let percent = safe.percent.with_context(|| format!("no reduction can be called safe: {why}"))?;
            let target = Target::Reduction((percent * 10.0).round() as u32);
            pipeline.set(Settings { target, ..pipeline.settings().clone() })?;
            advance(&mut pipeline)?;
        }
        if let Some(path) = &self.branches_csv {
            let certified = pipeline.certified().context("the calibre was not measured")?;
            let certified = certified.as_ref().map_err(|error| anyhow!("there is no calibre to write: {error}"))?;
            write_whole(path, certified.certificate.csv().as_bytes())?;
        }
        let reduced = pipeline.reduced().context("the pipeline ended without a result")?;
        let start = Instant::now();
        write_whole(&self.output, &io::write(&reduced.mesh, Some(&reduced.normals), format)?)?;
        let mut report = Report::new(&self.file, &pipeline).context("the pipeline ended without a result")?;
        report.stages_ms.read = read;
        report.stages_ms.write = milliseconds(start.elapsed());
        if let Some(path) = &self.report {
            write_whole(path, serde_json::to_string_pretty(&report)?.as_bytes())?;
        }
        self.print(&report);
        if self.branches {
            branches::print(&report);
        }
        println!("{DISCLAIMER}");
        Ok(())
    }

    fn print(&self, report: &Report) {
        let (kept, output) = (report.after_connectivity, report.output);
        row("triangles in file", report.opened.triangles);
        row(
            "kept",
            format!("{} triangles in {} of {} components", kept.triangles, kept.components, report.opened.components),
        );
        row("output", format!("{} triangles, {} vertices", output.triangles, output.vertices));
        row("reduction", format!("{:.2} %", report.reduction_percent));
        if let Some(Safe { percent: Some(percent), tolerance_percent, stopped_by, .. }) = &report.safe {
            let stop = stopped_by.as_ref().map_or(String::new(), |why| format!(": {why}"));
            row("safe to", format!("{percent:.1} %, at a tolerance of {tolerance_percent} %{stop}"));
        }
        if let Some(bound) = report.bound {
            row("deviation asked for", format!("{} mm at most", bound.max_deviation_mm));
            let next = bound.next_coarser_mm.map_or("none".to_owned(), |mm| format!("{mm:.4} mm"));
            row("next coarser level", next);
        }
        if let Some(text) = report.smoothing_response.and_then(|response| response.half_gain_text()) {
            row("smoothing, half gain", text);
        }
        if let Some(Adapted { vertices_percent, widest_pass_band }) = report.smoothing_adapted {
            row(
                "adapted to the calibre",
                format!("{vertices_percent:.1} % of the vertices, up to k = {widest_pass_band:.3}"),
            );
        }
        if let Some(weakened) = report.smoothing_weakened {
            row(
                "smoothing, weakened",
                format!("at {} vertices: {} triangles would cross", weakened.vertices, weakened.triangles_spared),
            );
        }
        if let Some(deviation) = report.deviation_mm {
            row("deviation, mean", format!("{:.4} mm", deviation.mean));
            row("deviation, max", format!("{:.4} mm", deviation.max));
        }
        if let Some(deviation) = report.deviation_from_original_mm {
            row("deviation from original", format!("{:.4} mm mean, {:.4} mm max", deviation.mean, deviation.max));
        }
        if let Some(change) = report.volume_change_percent {
            row("volume change", format!("{change:+.3} %"));
        }
        if let Some(change) = report.area_change_percent {
            row("area change", format!("{change:+.3} %"));
        }
        if let Some(shape) = &report.output_shape {
            shape_rows(shape);
        }
        let before = report.smoothed_shape.as_ref().and_then(|shape| shape.smallest_lumen);
        if let Some(Narrowest { diameter_mm, .. }) = before {
            row("smallest lumen, smoothed", format!("{diameter_mm:.3} mm"));
        }
        let ms = &report.stages_ms;
        row("connectivity", format!("{:.1} ms", ms.connectivity));
        row("smoothing", format!("{:.1} ms", ms.smoothing));
        row("decimation, all rates", format!("{:.1} ms", ms.decimation));
        row("level and normals", format!("{:.1} ms", ms.level + ms.normals));
        let unit = output_format(&self.output).unit();
        row("written to", format!("{}, in {unit}", self.output.display()));
        if let Some(shortfall) = &report.shortfall {
            eprintln!("lumen: warning: {shortfall}");
        }
        if let Some(warning) = report.volume_warning() {
            eprintln!("lumen: warning: {warning}");
        }
        if let Some(warning) = report.volume_held_warning() {
            eprintln!("lumen: warning: {warning}");
        }
        if let Some(warning) = report.smoothing_warning() {
            eprintln!("lumen: warning: {warning}");
        }
        if let Some(warning) = report.pinch_warning() {
            eprintln!("lumen: warning: {warning}");
        }
        if report.pass_band_missed {
            eprintln!("lumen: warning: too few iterations for this pass band: more are needed to smooth");
        }
    }
}

/// Whether both names are of one file that is there.
pub(super) fn same_file(a: &std::path::Path, b: &std::path::Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Runs all stages and shows how far they are, on standard error.
pub(super) fn advance(pipeline: &mut Pipeline) -> Result<()> {
    let is_terminal = std::io::stderr().is_terminal();
    let bar = if is_terminal { ProgressBar::new(1000) } else { ProgressBar::hidden() };
    bar.set_style(ProgressStyle::with_template("{msg:<24} {wide_bar} {percent:>3} %")?);
    loop {
        match pipeline.advance(Budget::new(Duration::from_millis(50)))? {
            Advance::Working(stage, fraction) => {
                bar.set_message(stage.label());
                bar.set_position((fraction * 1000.0) as u64);
            }
            // The measures are two stages of one name: the last says that they are done.
            Advance::Finished(stage) if !is_terminal && stage != Stage::SmoothedMeasures => {
                eprintln!("{}: done", stage.label());
            }
            Advance::Finished(_) => {}
            Advance::Idle => break,
        }
    }
    bar.finish_and_clear();
    Ok(())
}

fn milliseconds(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}

#[cfg(test)]
mod tests {
    use super::{micrometres, percent};

    #[test]
    fn a_length_becomes_as_many_thousandths_as_it_holds() {
        let lengths = ["0.1", "0.29", "1.0009", "0.001", "1000", "0.25 mm"];
        assert_eq!(lengths.map(micrometres), [100, 290, 1000, 1, 1_000_000, 250].map(Ok));
        assert!(["0", "-1", "nan", "inf", "0.0009", "1001", "", "mm"].iter().all(|text| micrometres(text).is_err()));
    }

    #[test]
    fn a_percentage_is_what_is_removed_with_or_without_its_sign() {
        assert_eq!(percent("90"), Ok(90.0));
        assert_eq!(percent("90%"), Ok(90.0));
        assert_eq!(percent(" 99.9 % "), Ok(99.9));
        assert!(["100", "-1", "nan", "", "%", "ninety"].iter().all(|text| percent(text).is_err()));
    }
}
