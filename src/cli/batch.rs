//! `lumen optimise` on many files: a surface and a report of each, and a summary of all.
//!
//! All names are known, and known to be different, before anything is written. A file that fails is told in the summary
//! and the others go on. The surfaces are the same bytes however many are worked on at once.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use anyhow::{Context, Result, anyhow, bail};
use clap::Args;
use serde::Serialize;

use super::interrupt::Interrupted;
use super::misuse::misuse;
use super::outputs::{Outputs, told_with_remedies};
use super::places::write_whole;
use super::running::advance_quietly;
use super::scan::FOLDER_HINT;
use super::settings::Asked;
use super::written::WrittenOptions;
use super::{interrupt, places, source};
use crate::io::Format;
use crate::language::grouped;
use crate::pipeline::report::{DISCLAIMER, Report};
use crate::sharing::Digest;
use crate::task::milliseconds;
use crate::vessel::certificate::Verdict;

/// The summary's name.
const SUMMARY: &str = "summary.csv";

/// Options for many files.
#[derive(Debug, Args)]
pub(super) struct BatchOptions {
    #[arg(long, value_name = "NAME", value_parser = format, help = which_format())]
    pub(super) format: Option<Format>,
    /// How many surfaces are worked on at once, 1 to 64, where OUT is a folder; each takes its own memory [default: 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=64))]
    pub(super) jobs: Option<u16>,
}

fn format(name: &str) -> Result<Format, String> {
    Format::from_extension(name).ok_or_else(|| format!("it is none of {}", places::endings("", "and")))
}

fn which_format() -> String {
    format!("The format of the surfaces where OUT is a folder: {} [default: stl]", places::endings("", "or"))
}

/// Whether a name stands for a folder: one is there, or it ends as folders' names do.
pub(super) fn is_folder(path: &Path) -> bool {
    path.is_dir() || path.to_string_lossy().ends_with(std::path::is_separator)
}

/// What is to be done.
pub(super) struct Batch {
    items: Vec<Item>,
    format: Format,
    jobs: usize,
    summary: PathBuf,
}

/// A surface and what becomes of it.
struct Item {
    file: String,
    surface: PathBuf,
    report: PathBuf,
}

impl BatchOptions {
    /// All surfaces in `files`, each with its names in the folder `output`, which is made. Refuses where two
    /// would be written to one place, the settings that are saved among them, or one over what is to be read.
    pub(super) fn plan(
        &self,
        files: &[String],
        output: &Path,
        settings: Option<&Path>,
        saved_settings: Option<&Path>,
    ) -> Result<Batch> {
        if output.exists() && !output.is_dir() {
            return Err(misuse(format!("{} is no folder: several surfaces need one", output.display())));
        }
        if !is_folder(output) && Format::from_name(&output.to_string_lossy()).is_some() {
            return Err(misuse(format!("{0} would be a folder: if it is to be one, say {0}/", output.display())));
        }
        let format = self.format.unwrap_or(Format::Stl);
        let mut found = Vec::new();
        for name in files {
            if Path::new(name).is_dir() { found.append(&mut surfaces_in(name)?) } else { found.push(name.clone()) }
        }
        let items: Vec<Item> = found.into_iter().map(|file| Item::new(file, output, format)).collect();
        let summary = output.join(SUMMARY);
        let inputs = items.iter().map(|item| Path::new(&item.file)).chain(settings);
        let beside = [("the summary".to_owned(), &*summary)];
        let beside = beside.into_iter().chain(saved_settings.map(|path| ("the settings".to_owned(), path)));
        places::check(inputs, beside.chain(items.iter().flat_map(Item::outputs)))?;
        std::fs::create_dir_all(output).with_context(|| format!("cannot make the folder {}", output.display()))?;
        Ok(Batch { items, format, jobs: self.jobs.unwrap_or(1).into(), summary })
    }
}

/// The surfaces in a folder, not in those below it, by their extensions and in the order of their names.
fn surfaces_in(folder: &str) -> Result<Vec<String>> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).with_context(|| format!("cannot read the folder {folder}"))? {
        let path = entry.with_context(|| format!("cannot read the folder {folder}"))?.path();
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        if path.is_file() && extension.is_some_and(|extension| Format::opened().any(|opened| opened == extension)) {
            found.push(path.to_string_lossy().into_owned());
        }
    }
    if found.is_empty() {
        let opened: Vec<&str> = Format::opened().collect();
        bail!("there are no surfaces in {folder}: Lumen opens {}{FOLDER_HINT}", opened.join(", "));
    }
    found.sort();
    Ok(found)
}

impl Item {
    fn new(file: String, folder: &Path, format: Format) -> Self {
        let stem = match file.strip_prefix("sample:") {
            Some(sample) => format!("sample-{sample}"),
            None => Path::new(&file).file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        };
        let named = |extension: &str| folder.join(format!("{stem}.{extension}"));
        Self { surface: named(format.extension()), report: named("json"), file }
    }

    /// What is written of it, and where.
    fn outputs(&self) -> [(String, &Path); 2] {
        let of = |what: &str| format!("{what} of {}", self.file);
        [(of("the surface"), &*self.surface), (of("the report"), &*self.report)]
    }
}

/// A surface that was made.
struct Made {
    digest: Option<Digest>,
    report: Report,
    warnings: Vec<String>,
}

/// What came of an item, and after how many seconds.
struct Outcome {
    made: Result<Made>,
    seconds: f64,
}

impl Batch {
    /// Goes through all surfaces and writes the summary.
    pub(super) fn run(&self, asked: &Asked, written: &WrittenOptions) -> Result<()> {
        let next = AtomicUsize::new(0);
        let count = self.items.len();
        let work = || {
            let mut done = Vec::new();
            while interrupt::check().is_ok() {
                let i = next.fetch_add(1, Ordering::Relaxed);
                let Some(item) = self.items.get(i) else { break };
                let start = Instant::now();
                let made = catch_unwind(AssertUnwindSafe(|| self.one(item, asked, written)))
                    .unwrap_or_else(|_| Err(anyhow!("an error in the program ended the work on it")));
                if made.as_ref().is_err_and(anyhow::Error::is::<Interrupted>) {
                    break;
                }
                let outcome = Outcome { made, seconds: start.elapsed().as_secs_f64() };
                let told = outcome.told(item, i + 1, count);
                done.push((i, outcome));
                // Whoever listens no longer loses no result by that.
                let _ = std::io::stderr().write_all(told.as_bytes());
            }
            done
        };
        let done: BTreeMap<usize, Outcome> = std::thread::scope(|scope| {
            let threads: Vec<_> = (0..self.jobs.min(count)).map(|_| scope.spawn(work)).collect();
            // What panics in a thread is caught there.
            threads.into_iter().filter_map(|thread| thread.join().ok()).flatten().collect()
        });
        self.write_summary(&done)?;
        interrupt::check()?;
        let failed = count - done.values().filter(|outcome| outcome.made.is_ok()).count();
        println!("{:<28}{}", "surfaces", count);
        println!("{:<28}{failed}", "failed");
        println!("{:<28}{}", "summary", self.summary.display());
        println!("{DISCLAIMER}");
        if failed > 0 {
            bail!("{failed} of {count} surfaces failed: {} says why", self.summary.display());
        }
        Ok(())
    }

    fn one(&self, item: &Item, asked: &Asked, written: &WrittenOptions) -> Result<Made> {
        let start = Instant::now();
        let (imported, digest) = source::read_quietly(&item.file, asked.unit)?;
        let read = milliseconds(start);
        let outputs = Outputs {
            surface: &item.surface,
            format: self.format,
            written,
            report: Some(&item.report),
            branches_csv: None,
            prints_branches: false,
        };
        let made = outputs.make(&item.file, imported, read, asked, advance_quietly)?;
        let warnings = made.verdict.findings.iter().map(told_with_remedies).chain(made.left_out).collect();
        Ok(Made { digest, report: made.report, warnings })
    }

    fn write_summary(&self, done: &BTreeMap<usize, Outcome>) -> Result<()> {
        let mut table = csv::Writer::from_writer(Vec::new());
        for (i, item) in self.items.iter().enumerate() {
            table.serialize(Row::new(item, done.get(&i)))?;
        }
        write_whole(&self.summary, &table.into_inner().context("the summary cannot be made")?)
    }
}

impl Outcome {
    /// What is said of it once it is there: a line, and one for each warning.
    fn told(&self, item: &Item, number: usize, count: usize) -> String {
        let (file, seconds) = (&item.file, self.seconds);
        let Made { report, warnings, .. } = match &self.made {
            Ok(made) => made,
            Err(error) => return format!("[{number}/{count}] {file}: failed: {error:#}\n"),
        };
        let triangles = grouped(report.output.triangles);
        let warnings: String = warnings.iter().map(|warning| format!("lumen: warning: {file}: {warning}\n")).collect();
        format!("[{number}/{count}] {file}: {triangles} triangles, {seconds:.1} s\n{warnings}")
    }
}

/// A row of the summary. The names of the columns are public and stay.
#[derive(Default, Serialize)]
struct Row<'a> {
    file: &'a str,
    /// Of the file's bytes; empty for a sample.
    sha256: String,
    /// "ok", "failed" or "not run".
    status: &'static str,
    /// Why it failed.
    error: String,
    /// Where the surface is.
    output: String,
    triangles_in: Option<usize>,
    triangles_out: Option<usize>,
    vertices_out: Option<usize>,
    reduction_percent: Option<f64>,
    deviation_mean_mm: Option<f64>,
    deviation_max_mm: Option<f64>,
    /// Whether the vessels keep their calibre.
    calibre: Option<Verdict>,
    /// The part of their length that is measured.
    calibre_measured_percent: Option<f64>,
    self_intersecting_triangles: Option<usize>,
    output_fingerprint: String,
    warnings: String,
    seconds: Option<f64>,
    disclaimer: &'static str,
}

impl<'a> Row<'a> {
    fn new(item: &'a Item, outcome: Option<&Outcome>) -> Self {
        let row = Self { file: &item.file, status: "not run", disclaimer: DISCLAIMER, ..Self::default() };
        let Some(outcome) = outcome else { return row };
        let seconds = Some((outcome.seconds * 1e3).round() / 1e3);
        let Made { digest, report, warnings } = match &outcome.made {
            Ok(made) => made,
            Err(error) => return Self { status: "failed", error: format!("{error:#}"), seconds, ..row },
        };
        Self {
            sha256: digest.map_or(String::new(), |digest| digest.to_string()),
            status: "ok",
            output: item.surface.display().to_string(),
            triangles_in: Some(report.opened.triangles),
            triangles_out: Some(report.output.triangles),
            vertices_out: Some(report.output.vertices),
            reduction_percent: Some(report.reduction_percent),
            deviation_mean_mm: report.deviation_mm.map(|deviation| deviation.mean),
            deviation_max_mm: report.deviation_mm.map(|deviation| deviation.max),
            calibre: report.calibre.as_ref().and_then(|calibre| calibre.verdict),
            calibre_measured_percent: report.calibre.as_ref().and_then(|calibre| calibre.measured_percent),
            self_intersecting_triangles: report.output_shape.as_ref().map(|shape| shape.self_intersecting_faces),
            output_fingerprint: report.output_fingerprint.clone(),
            warnings: warnings.join(" "),
            seconds,
            ..row
        }
    }
}
