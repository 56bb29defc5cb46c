//! `lumen report`: a page for the record, as PDF or as a web page.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result};
use chrono::NaiveDate;
use clap::Args;

use super::misuse::misuse;
use super::places::write_whole;
use super::rows::row;
use super::running::{advance, run_through};
use super::scan_options::ScanOptions;
use super::settings::SettingsOptions;
use super::{interrupt, pictures, places, source};
use crate::io::{Axes, Format};
use crate::pipeline::deviation::REPORT_SAMPLES;
use crate::pipeline::report::{DISCLAIMER, Report};
use crate::pipeline::run::Pipeline;
use crate::pipeline::verdict::Verdict;
use crate::report::{Carried, Document, Heading, Picture, ReportFormat, Subject, today};

/// Writes a page for the record.
#[derive(Debug, Args)]
pub struct WriteReport {
    /// A surface file, or sample:aorta, sample:coronary; or a scan or a mask
    file: String,
    #[command(flatten)]
    scan: ScanOptions,
    /// Where to write: .pdf or .html
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// What the page is called; the name of the file is not on it, because that may be a patient's
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// Which case it is of
    #[arg(long, value_name = "TEXT")]
    case: Option<String>,
    /// What else is to be said; may have several lines
    #[arg(long, value_name = "TEXT")]
    comment: Option<String>,
    /// The day on the page, such as 2026-11-26; today without it
    #[arg(long, value_name = "DAY")]
    date: Option<NaiveDate>,
    /// Leave the pictures out
    #[arg(long)]
    no_pictures: bool,
    /// Put the surface into the page, to be turned there: shaded and as wireframe, reduced and before (.html)
    #[arg(long)]
    surface: bool,
    #[command(flatten)]
    settings: SettingsOptions,
}

impl WriteReport {
    /// Runs the pipeline and writes the page.
    pub(super) fn run(&self) -> Result<()> {
        let name = self.output.to_string_lossy();
        let format =
            ReportFormat::from_name(&name).ok_or_else(|| misuse(format!("{name} does not end in .pdf or .html")))?;
        let format = match (format, self.surface) {
            (ReportFormat::Html, true) => ReportFormat::HtmlWithSurface,
            (_, true) => return Err(misuse("--surface is of a web page: let the output end in .html")),
            (format, false) => format,
        };
        let inputs = [Path::new(&self.file)].into_iter().chain(self.settings.file());
        places::check(inputs, [("the report".to_owned(), &*self.output)])?;
        let asked = self.settings.asked()?;
        interrupt::listen()?;
        let (imported, digest) = source::read_known(&self.file, asked.unit, &self.scan)?;
        let import = imported.report.clone();
        let settings = asked.shared.settings.clone();
        let pipeline = Pipeline::new(Arc::new(imported.mesh), settings).with_samples(REPORT_SAMPLES);
        let mut pipeline = pipeline.with_certificate();
        run_through(&mut pipeline, asked.wants_safe, advance)?;
        let mut report = Report::new(&self.file, &pipeline).context("the pipeline ended without a result")?;
        report.axes = import.axes;
        let verdict = Verdict::of_run(&pipeline, &report, &import, Format::from_name(&self.file).is_some());
        let drawn = if self.no_pictures { Vec::new() } else { self.pictures(&pipeline, import.axes)? };
        let heading = Heading {
            title: self.title.clone(),
            date: self.date.map_or_else(today, |date| date.to_string()),
            case: self.case.clone().unwrap_or_default(),
            comment: self.comment.clone().unwrap_or_default(),
        };
        let subject = Subject {
            heading: &heading,
            digest,
            import: &import,
            report: &report,
            verdict: &verdict,
            measures: &[],
            patches: &[],
        };
        let mut document = Document::new(&subject, drawn);
        if self.surface {
            document.surface = Carried::of(&pipeline, import.axes);
        }
        write_whole(&self.output, &format.write(&document))?;
        row("verdict", verdict.in_short(|words| words.to_string()));
        row("pictures", document.pictures.len());
        row("written to", self.output.display());
        println!("{DISCLAIMER}");
        Ok(())
    }

    /// The pictures; where there can be none, a line says so.
    fn pictures(&self, pipeline: &Pipeline, axes: Axes) -> Result<Vec<Picture>> {
        match pictures::of(pipeline, axes) {
            Ok(drawn) => drawn.iter().map(|(caption, pixels)| Ok(Picture::new(caption, pixels)?)).collect(),
            Err(why) => {
                eprintln!("lumen: warning: the report is without pictures: {why:#}");
                Ok(Vec::new())
            }
        }
    }
}
