//! `lumen optimise`: the whole pipeline on a file, or on many.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::Result;
use clap::Args;

use super::batch::BatchOptions;
use super::mend::mended_rows;
use super::misuse::misuse;
use super::outputs::{Outcome, Outputs, told_with_remedies};
use super::places::{output_format, write_whole};
use super::rows::{row, shape_rows, threshold_rows};
use super::running::advance;
use super::scan_options::ScanOptions;
use super::settings::{Asked, SettingsOptions};
use super::written::WrittenOptions;
use super::{batch, branches, interrupt, places, source};
use crate::io::Unit;
use crate::pipeline::caps::changes_percent;
use crate::pipeline::report::{DISCLAIMER, Report, SafeReport};
use crate::pipeline::results::Adapted;
use crate::pipeline::verdict::Verdict;
use crate::sharing::{SharedSettings, write_settings};
use crate::task::milliseconds;
use crate::vessel::width::Narrowest;
use lumen_message::signed;

/// Keeps the largest piece, smooths it, reduces it, and writes the result.
#[derive(Debug, Args)]
pub struct Optimise {
    /// Surface files, or sample:aorta, sample:coronary; or folders, for all surfaces in them; a scan or a mask, or with
    /// --threshold or --label a folder of DICOM
    #[arg(value_name = "FILE", required = true)]
    files: Vec<String>,
    #[command(flatten)]
    scan: ScanOptions,
    #[arg(short, long, value_name = "OUT", help = where_to_write())]
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

fn where_to_write() -> String {
    format!("{}; a folder where there are more files than one", places::where_to_write())
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
        let format = output_format(&self.output)?;
        if self.batch.format.is_some() {
            return Err(misuse(format!("--format is for a folder: {} says which format it is", self.output.display())));
        }
        if self.batch.jobs.is_some() {
            return Err(misuse("--jobs is for many files: one surface is worked on by all cores"));
        }
        self.check_outputs(file)?;
        let start = Instant::now();
        let imported = source::read_with(file, asked.unit, &self.scan)?;
        let read = milliseconds(start);
        let outputs = Outputs {
            surface: &self.output,
            format,
            written: &self.written,
            report: self.report.as_deref(),
            branches_csv: self.branches_csv.as_deref(),
            prints_branches: self.branches,
        };
        let Outcome { report, verdict, left_out } = outputs.make(file, imported, read, asked, advance)?;
        if let Some(sentence) = left_out {
            eprintln!("lumen: warning: {}: {sentence}", self.output.display());
        }
        if let Some(path) = &self.save_settings {
            let by_size = report.unit.filter(|taken| taken.by_size).map(|taken| taken.unit);
            let used = SharedSettings { unit: asked.shared.unit.or(by_size), settings: report.settings.clone() };
            write_whole(path, write_settings(&used).as_bytes())?;
        }
        self.print(&report, &verdict, format.unit());
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
                return Err(misuse(format!(
                    "{option} is for one file: of several, each gets a report beside its surface"
                )));
            }
        }
        if self.scan.is_any() {
            return Err(misuse(
                "--threshold, --label, --seed, --surface-by and --box are for one scan: say a file for its surface with -o",
            ));
        }
        if asked.wants_safe && self.save_settings.is_some() {
            return Err(misuse(
                "--save-settings is for one file with --reduction safe: the safe rate is another for each",
            ));
        }
        let batch = self.batch.plan(files, &self.output, self.settings.file(), self.save_settings.as_deref())?;
        if let Some(path) = &self.save_settings {
            write_whole(path, write_settings(&asked.shared).as_bytes())?;
        }
        batch.run(asked, &self.written)
    }

    /// Refuses where an output would overwrite an input or another output.
    fn check_outputs(&self, file: &str) -> Result<()> {
        let outputs = [
            ("the surface", Some(&self.output)),
            ("the report", self.report.as_ref()),
            ("the branches", self.branches_csv.as_ref()),
            ("the settings", self.save_settings.as_ref()),
        ];
        let outputs = outputs.into_iter().filter_map(|(what, path)| Some((what.to_owned(), &**path?)));
        places::check([Path::new(file)].into_iter().chain(self.settings.file()), outputs)
    }

    /// Prints the numbers and the verdict, but for what was told when the file was read.
    fn print(&self, report: &Report, verdict: &Verdict, unit: Unit) {
        let (kept, output) = (report.after_connectivity, report.output);
        row("triangles in file", report.opened.triangles);
        report.threshold.into_iter().for_each(threshold_rows);
        if let Some(done) = &report.mending {
            mended_rows(done);
        }
        row(
            "kept",
            format!("{} triangles in {} of {} components", kept.triangles, kept.components, report.opened.components),
        );
        row("output", format!("{} triangles, {} vertices", output.triangles, output.vertices));
        let auto = match report.auto {
            None => "",
            Some(found) if found.is_at_most() => " (auto)",
            Some(_) => match &report.safe {
                Some(safe) if safe.is_covered => " (auto: as far as is safe)",
                Some(safe) if safe.percent.is_none() => " (auto: as far as no vessel is pinched)",
                _ => " (auto: as far as vessels are kept where they are measured)",
            },
        };
        row("reduction", format!("{:.2} %{auto}", report.reduction_percent));
        if let Some(safe @ SafeReport { percent: Some(percent), tolerance_percent, stopped_by, .. }) = &report.safe {
            let stop = stopped_by.as_ref().map_or(String::new(), |why| format!(": {why}"));
            let name = if safe.is_covered { "safe to" } else { "kept where measured, to" };
            let over = safe.coverage.map_or(String::new(), |found| format!(", measured over {}", found.text()));
            row(name, format!("{percent:.1} %, at a tolerance of {tolerance_percent} %{over}{stop}"));
        }
        if let Some(bound) = report.bound {
            row("deviation asked for", format!("{} mm at most", bound.max_deviation_mm));
            let next = bound.next_coarser_mm.map_or("none".to_owned(), |mm| format!("{mm:.4} mm"));
            row("next coarser level", next);
        }
        if let Some(text) = report.smoothing_response.and_then(|response| response.half_gain_message()) {
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
            row("volume change", format!("{} %", signed(change, 3)));
        }
        if let Some(change) = report.area_change_percent {
            row("area change", format!("{} %", signed(change, 3)));
        }
        if let Some(shape) = &report.output_shape {
            shape_rows(shape);
        }
        let caps = report.caps.as_deref().unwrap_or_default();
        if let Some([least, most]) = changes_percent(caps) {
            row("caps, change of area", format!("{} to {} % ({} caps)", signed(least, 2), signed(most, 2), caps.len()));
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
        row("written to", format!("{}, in {unit}", self.output.display()));
        let little = if verdict.calibre.is_some() { "" } else { " (--branches measures them)" };
        row("verdict", format!("{}{little}", verdict.head_text()));
        for finding in verdict.findings.iter().filter(|finding| !finding.what.is_of_file()) {
            eprintln!("lumen: warning: {}", told_with_remedies(finding));
        }
    }
}
