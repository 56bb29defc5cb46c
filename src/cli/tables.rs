//! `lumen tables`: Tables I and II of the paper, made again for any surface, with the paper's numbers beside them.
//!
//! Table I counts polygons before and after the validation of connectivity, Table II those that are left at five
//! reduction rates, all of one run. The paper says nothing on deviation; Lumen's is given besides.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};

use super::places;
use super::places::write_whole;
use super::running::advance;
use super::sheet::{Entry, Item, Sheet, Table};
use super::source::{self, UNIT_HELP, UnitOption};
use crate::pipeline::deviation::{Deviation, REPORT_SAMPLES};
use crate::pipeline::paper;
use crate::pipeline::report::Report;
use crate::pipeline::run::Pipeline;
use crate::pipeline::settings::{Keep, reduction_percent};

/// Makes Tables I and II of the paper, or III and IV.
#[derive(Debug, Args)]
pub struct Tables {
    /// A surface file, or sample:aorta, sample:coronary
    #[arg(default_value = "sample:aorta")]
    file: String,
    /// Tables III and IV instead: the autopilot's trial at the paper's rates, on the aorta and on the whole tree, or on
    /// the file
    #[arg(long)]
    trial: bool,
    /// How to write them; without it, what the extension of OUT says (.csv, .md), else text
    #[arg(long, value_enum, value_name = "FORMAT")]
    format: Option<Form>,
    /// Write to this file instead of standard output
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    #[arg(long, value_name = "UNIT", help = UNIT_HELP)]
    unit: Option<UnitOption>,
}

/// How tables are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Form {
    /// Aligned columns
    Text,
    /// One tidy table: a line a number
    Csv,
    /// Tables for a document
    Markdown,
}

impl Form {
    /// What the name of an output asks for.
    fn of(path: &Path) -> Self {
        match path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("csv") => Self::Csv,
            Some("md" | "markdown") => Self::Markdown,
            _ => Self::Text,
        }
    }
}

impl Tables {
    /// Runs the pipeline at the paper's settings and writes the tables.
    pub(super) fn run(&self) -> Result<()> {
        places::check([Path::new(&self.file)], self.output.iter().map(|output| ("the tables".to_owned(), &**output)))?;
        if self.trial {
            return self.write(&super::trial_tables::sheet(&self.file, self.unit)?);
        }
        let imported = source::read(&self.file, self.unit)?;
        let degenerate = imported.report.degenerate_triangles;
        let pipeline = Pipeline::new(Arc::new(imported.mesh), paper::reduced(paper::TABLE_II[0].0, Keep::Largest));
        let mut pipeline = pipeline.with_samples(REPORT_SAMPLES);
        let mut levels = Vec::new();
        for (percent, polygons) in paper::TABLE_II {
            pipeline.set(paper::reduced(percent, Keep::Largest))?;
            advance(&mut pipeline)?;
            let report = Report::new(&self.file, &pipeline).context("the pipeline ended without a result")?;
            levels.push((percent, polygons, report));
        }
        let first = &levels.first().context("there is no rate in Table II")?.2;
        let sheet = Sheet {
            notes: notes(&self.file, first),
            tables: vec![table_1(&self.file, first, degenerate), table_2(&self.file, &levels)],
        };
        self.write(&sheet)?;
        for shortfall in levels.iter().filter_map(|(.., report)| report.shortfall.as_ref()) {
            eprintln!("lumen: warning: {shortfall}");
        }
        Ok(())
    }

    fn write(&self, sheet: &Sheet) -> Result<()> {
        let form = self.format.or_else(|| self.output.as_deref().map(Form::of)).unwrap_or(Form::Text);
        let written = match form {
            Form::Text => sheet.text(),
            Form::Csv => sheet.csv(),
            Form::Markdown => sheet.markdown(),
        };
        match &self.output {
            Some(path) => write_whole(path, written.as_bytes())?,
            None => print!("{written}"),
        }
        Ok(())
    }
}

/// What a reader has to know to compare.
fn notes(input: &str, report: &Report) -> Vec<String> {
    let smoothing = &report.settings.smoothing;
    let mut notes = vec![
        "The paper's surface was one segment of an abdominal aorta from a patient's CT angiogram, 74,307 triangles. It \
         is not published."
            .to_owned(),
    ];
    notes.push(if input == "sample:aorta" {
        "Lumen's sample is a vessel of the same kind that the program makes itself. Its largest piece has the same \
         number of triangles; its form is another."
            .to_owned()
    } else {
        "This is another surface than the paper's: compare the rates; the counts differ as the surfaces do.".to_owned()
    });
    notes.push(format!(
        "Settings of the paper: {} window, pass band {}, {} iterations. All rates come from one run.",
        smoothing.window.name(),
        smoothing.pass_band,
        smoothing.iterations
    ));
    notes
}

fn table_1(input: &str, report: &Report, degenerate: usize) -> Table {
    let [before, after] = paper::TABLE_I;
    let (opened, kept) = (report.opened, report.after_connectivity);
    let item = |name: &str, paper: usize, counts: crate::pipeline::report::Counts| Item {
        name: name.to_owned(),
        entries: vec![
            Entry::count("polygons", Some(paper), counts.triangles),
            Entry::count("connected pieces", None, counts.components),
        ],
    };
    let mut notes = vec!["Validation keeps the largest connected piece.".to_owned()];
    if opened.components > 1 {
        let left_out = opened.components - kept.components;
        let what = if left_out == 1 { "piece is" } else { "pieces are" };
        notes.push(format!("{left_out} detached {what} left out here; the paper's surface was one piece already."));
    }
    if degenerate > 0 {
        notes.push(format!("{degenerate} degenerate triangles of the file were dropped when it was read."));
    }
    Table {
        number: "I",
        title: "Polygons before and after the validation of connectivity",
        input: input.to_owned(),
        of: "",
        items: vec![item("before validation", before, opened), item("after validation", after, kept)],
        notes,
    }
}

fn table_2(input: &str, levels: &[(u32, usize, Report)]) -> Table {
    let of_paper = paper::TABLE_I[1];
    let items = levels.iter().map(|(percent, polygons, report)| {
        let deviation = |pick: fn(&Deviation) -> f64| report.deviation_mm.as_ref().map(pick);
        Item {
            name: format!("{percent} %"),
            entries: vec![
                Entry::count("polygons", Some(*polygons), report.output.triangles),
                Entry::number(
                    "removed",
                    "%",
                    2,
                    Some(reduction_percent(of_paper, *polygons)),
                    Some(report.reduction_percent),
                ),
                Entry::number("deviation, mean", "mm", 4, None, deviation(|d| d.mean)),
                Entry::number("deviation, max", "mm", 4, None, deviation(|d| d.max)),
                Entry::number("volume change", "%", 2, None, report.volume_change_from_smoothed_percent),
            ],
        }
    });
    let mut notes = vec![
        "A collapse takes one or two triangles, so a count can be one below the target. The difference of what was \
         removed is in percentage points."
            .to_owned(),
        "Deviation and change of volume are from the smoothed surface, measured both ways; the paper gives none."
            .to_owned(),
    ];
    notes.extend(levels.iter().filter_map(|(percent, _, report)| {
        report.shortfall.as_ref().map(|shortfall| format!("{percent} % was not reached: {shortfall}."))
    }));
    Table {
        number: "II",
        title: "Polygons at different reduction rates",
        input: input.to_owned(),
        of: "reduction rate",
        items: items.collect(),
        notes,
    }
}
