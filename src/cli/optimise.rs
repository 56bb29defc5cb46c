//! `lumen optimise`: the whole pipeline on a file, or on many.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, anyhow};
use clap::Args;
use indicatif::{ProgressBar, ProgressStyle};

use super::batch::BatchOptions;
use super::mend::mended_rows;
use super::scan::ScanOptions;
use super::settings::{Asked, SettingsOptions};
use super::written::WrittenOptions;
use super::{batch, branches, interrupt, misuse, output_format, places, row, shape_rows, source, write_whole};
use crate::io::{self, Format, Imported, Output};
use crate::pipeline::deviation::REPORT_SAMPLES;
use crate::pipeline::narrowest::Narrowest;
use crate::pipeline::report::{DISCLAIMER, Report, UnitReport};
use crate::pipeline::results::Adapted;
use crate::pipeline::run::{Advance, Pipeline};
use crate::pipeline::safe::Safe;
use crate::pipeline::settings::Settings;
use crate::pipeline::stage::Stage;
use crate::pipeline::task::Budget;
use crate::pipeline::verdict::{Finding, Verdict, rate};
use crate::sharing::{SharedSettings, write_settings};

/// Keeps the largest piece, smooths it, reduces it, and writes the result.
#[derive(Debug, Args)]
pub struct Optimise {
    /// Surface files, or sample:aorta, sample:coronary; or folders, for all surfaces in them; a scan or a mask, or with
    /// --threshold or --label a folder of DICOM
    #[arg(value_name = "FILE", required = true)]
    files: Vec<String>,
    #[command(flatten)]
    scan: ScanOptions,
    /// Where to write: .stl, .ply, .obj, .vtp, .vtk or .glb; a folder where there are more files than one
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    settings: SettingsOptions,
    /// Write the settings that were used to this file, for --settings and the window
    #[arg(long, value_name = "FILE.json")]
    save_settings: Option<PathBuf>,
    #[command(flatten)]
    written: WrittenOptions,
    #[command(flatten)]
    batch: BatchOptions,
    /// Write all numbers to this file
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,
    /// Print what became of the calibre of each branch
    #[arg(long)]
    branches: bool,
    /// Write the calibre along each branch to this file, a row a place
    #[arg(long, value_name = "FILE.csv")]
    branches_csv: Option<PathBuf>,
}

/// What is written of one surface.
pub(super) struct Outputs<'a> {
    /// Where the surface goes.
    pub(super) surface: &'a Path,
    /// In which format.
    pub(super) format: Format,
    /// What of it.
    pub(super) written: &'a WrittenOptions,
    /// Where all numbers go.
    pub(super) report: Option<&'a Path>,
    /// Where the calibre along the branches goes.
    pub(super) branches_csv: Option<&'a Path>,
    /// Whether the calibre is measured for what is printed.
    pub(super) prints_branches: bool,
}

impl Outputs<'_> {
    /// Runs the pipeline on the surface called `name` and writes what is asked for; `read` is the time in ms that reading
    /// it took. Returns the report, and a sentence on the arrays that the format has no place for.
    pub(super) fn make(
        &self,
        name: &str,
        imported: Imported,
        read: f64,
        asked: &Asked,
        advance: fn(&mut Pipeline) -> Result<()>,
    ) -> Result<(Report, Option<String>)> {
        let settings = asked.shared.settings.clone();
        let unit = UnitReport { unit: imported.report.unit, by_size: imported.report.unit_by_size };
        let import = imported.report.clone();
        let (axes, to) = self.written.axes(imported.report.axes)?;
        let mut pipeline = Pipeline::new(Arc::new(imported.mesh), settings).with_samples(REPORT_SAMPLES);
        if self.written.takes_arrays() {
            pipeline = pipeline.with_arrays(imported.arrays);
        }
        if asked.wants_safe {
            pipeline = pipeline.with_safe();
        } else if self.prints_branches || self.report.is_some() || self.branches_csv.is_some() {
            pipeline = pipeline.with_certificate();
        }
        run_through(&mut pipeline, asked.wants_safe, advance)?;
        if let Some(path) = self.branches_csv {
            let certified = pipeline.certified().context("the calibre was not measured")?;
            let certified = certified.as_ref().map_err(|error| anyhow!("there is no calibre to write: {error}"))?;
            write_whole(path, certified.certificate.csv().as_bytes())?;
        }
        let reduced = pipeline.reduced().context("the pipeline ended without a result")?;
        let start = Instant::now();
        let mut arrays = self.written.arrays(&pipeline);
        let left_out = io::left_out(&arrays, self.format);
        let (mut mesh, mut normals) = ((*reduced.mesh).clone(), reduced.normals.clone());
        axes.turn(to, &mut mesh, &mut normals, &mut arrays)?;
        let normals = self.written.has_normals().then_some(&normals[..]);
        let output = Output { mesh: &mesh, normals, arrays: &arrays, axes: to };
        write_whole(self.surface, &io::write_output(&output, self.format)?)?;
        let mut report = Report::new(name, &pipeline).context("the pipeline ended without a result")?;
        report.stages_ms.read = read;
        report.axes = to;
        report.unit = Some(unit);
        report.stages_ms.write = milliseconds(start.elapsed());
        report.verdict = Some(Box::new(Verdict::of_run(&report, &import, Format::from_name(name).is_some())));
        if let Some(path) = self.report {
            write_whole(path, serde_json::to_string_pretty(&report)?.as_bytes())?;
        }
        Ok((report, left_out))
    }
}

impl Optimise {
    /// Runs the pipeline, writes the surface and the report, prints the table; or goes through many files.
    pub(super) fn run(&self) -> Result<()> {
        let asked = self.settings.asked()?;
        interrupt::listen()?;
        match &self.files[..] {
            [file] if self.is_one(file) => self.one(file, &asked),
            files => self.many(files, &asked),
        }
    }

    /// Whether this is a surface or a scan by itself: a folder is a series of slices where a threshold or label is given.
    fn is_one(&self, file: &str) -> bool {
        !batch::is_folder(&self.output) && (self.scan.is_any() || !batch::is_folder(Path::new(file)))
    }

    fn one(&self, file: &str, asked: &Asked) -> Result<()> {
        let format = output_format(&self.output);
        if self.batch.format.is_some() {
            misuse(format!("--format is for a folder: {} says which format it is", self.output.display()));
        }
        if self.batch.jobs.is_some() {
            misuse("--jobs is for many files: one surface is worked on by all cores");
        }
        self.check_outputs(file);
        let start = Instant::now();
        let imported = source::read_with(file, asked.unit, &self.scan)?;
        let read = milliseconds(start.elapsed());
        let outputs = Outputs {
            surface: &self.output,
            format,
            written: &self.written,
            report: self.report.as_deref(),
            branches_csv: self.branches_csv.as_deref(),
            prints_branches: self.branches,
        };
        let told = imported.report.warnings.clone();
        let (report, left_out) = outputs.make(file, imported, read, asked, advance)?;
        if let Some(sentence) = left_out {
            eprintln!("lumen: warning: {}: {sentence}", self.output.display());
        }
        if let Some(path) = &self.save_settings {
            let by_size = report.unit.filter(|taken| taken.by_size).map(|taken| taken.unit);
            let used = SharedSettings { unit: asked.shared.unit.or(by_size), settings: report.settings.clone() };
            write_whole(path, write_settings(&used).as_bytes())?;
        }
        self.print(&report, &told);
        if self.branches {
            branches::print(&report);
        }
        println!("{DISCLAIMER}");
        Ok(())
    }

    fn many(&self, files: &[String], asked: &Asked) -> Result<()> {
        for (option, is_given) in [
            ("--report", self.report.is_some()),
            ("--branches", self.branches),
            ("--branches-csv", self.branches_csv.is_some()),
        ] {
            if is_given {
                misuse(format!("{option} is for one file: of several, each gets a report beside its surface"));
            }
        }
        if self.scan.is_any() {
            misuse("--threshold, --label and --box are for one scan: say a file for its surface with -o");
        }
        if asked.wants_safe && self.save_settings.is_some() {
            misuse("--save-settings is for one file with --reduction safe: the safe rate is another for each");
        }
        let batch = self.batch.plan(files, &self.output, self.settings.file(), self.save_settings.as_deref())?;
        if let Some(path) = &self.save_settings {
            write_whole(path, write_settings(&asked.shared).as_bytes())?;
        }
        batch.run(asked, &self.written)
    }

    /// Ends the program where an output would overwrite an input or another output.
    fn check_outputs(&self, file: &str) {
        let outputs = [
            ("the surface", Some(&self.output)),
            ("the report", self.report.as_ref()),
            ("the branches", self.branches_csv.as_ref()),
            ("the settings", self.save_settings.as_ref()),
        ];
        let outputs = outputs.into_iter().filter_map(|(what, path)| Some((what.to_owned(), &**path?)));
        places::check([Path::new(file)].into_iter().chain(self.settings.file()), outputs);
    }

    /// Prints the numbers and the verdict, but for what was `told` when the file was read.
    fn print(&self, report: &Report, told: &[String]) {
        let (kept, output) = (report.after_connectivity, report.output);
        row("triangles in file", report.opened.triangles);
        if let Some(done) = &report.mending {
            mended_rows(done);
        }
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
        let Some(verdict) = &report.verdict else { return };
        let little = if verdict.calibre.is_some() { "" } else { " (the vessels were not measured: --branches does)" };
        row("verdict", format!("{}{little}", verdict.head));
        for finding in verdict.findings.iter().filter(|finding| !told.contains(&finding.text)) {
            eprintln!("lumen: warning: {}", told_with_remedies(finding));
        }
    }
}

/// A finding with its place and what would help, in a line.
pub(super) fn told_with_remedies(finding: &Finding) -> String {
    let at = finding.place.as_ref().map(|place| place.at_mm).filter(|_| !finding.text.contains("at ("));
    let at = at.map_or(String::new(), |[x, y, z]| format!(" At ({x:.1}, {y:.1}, {z:.1})."));
    let help: Vec<&str> = finding.remedies.iter().map(|remedy| &*remedy.words).collect();
    let help = if help.is_empty() { String::new() } else { format!(" Would help: {}.", help.join(", ")) };
    format!("{}{at}{help}", finding.text)
}

/// Lets `advance` run the pipeline to its end; with `wants_safe` once more, to the rate that it has found to be safe.
pub(super) fn run_through(
    pipeline: &mut Pipeline,
    wants_safe: bool,
    advance: fn(&mut Pipeline) -> Result<()>,
) -> Result<()> {
    advance(pipeline)?;
    if !wants_safe {
        return Ok(());
    }
    let safe = pipeline.safe().context("the search for the safe rate ended without a result")?;
    let why = safe.refused.as_deref().unwrap_or_default();
    let percent = safe.percent.with_context(|| format!("no reduction can be called safe: {why}"))?;
    pipeline.set(Settings { target: rate(percent), ..pipeline.settings().clone() })?;
    advance(pipeline)
}

/// Runs all stages and shows how far they are, on standard error.
pub(super) fn advance(pipeline: &mut Pipeline) -> Result<()> {
    let is_terminal = std::io::stderr().is_terminal();
    let bar = if is_terminal { ProgressBar::new(1000) } else { ProgressBar::hidden() };
    bar.set_style(ProgressStyle::with_template("{msg:<24} {wide_bar} {percent:>3} %")?);
    loop {
        interrupt::check()?;
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

/// Runs all stages and says nothing.
pub(super) fn advance_quietly(pipeline: &mut Pipeline) -> Result<()> {
    while pipeline.advance(Budget::new(Duration::from_millis(50)))? != Advance::Idle {
        interrupt::check()?;
    }
    Ok(())
}

pub(super) fn milliseconds(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}
