//! What is made of one surface, and written: by itself, or as one of many.

use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use anyhow::{Context, Result, anyhow};

use super::places::write_whole;
use super::running::run_through;
use super::settings::Asked;
use super::written::WrittenOptions;
use crate::io::{self, Format, Imported, Output};
use crate::pipeline::coarser::halved;
use crate::pipeline::deviation::REPORT_SAMPLES;
use crate::pipeline::report::{Report, UnitReport};
use crate::pipeline::run::Pipeline;
use crate::pipeline::verdict::{Finding, Verdict, VerdictReport};
use crate::task::milliseconds;

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

/// What became of it.
pub(super) struct Outcome {
    /// All numbers.
    pub(super) report: Report,
    /// What there is to say of them.
    pub(super) verdict: Verdict,
    /// A sentence on the arrays that the format has no place for.
    pub(super) left_out: Option<String>,
}

impl Outputs<'_> {
    /// Runs the pipeline on the surface called `name` and writes what is asked for; `read` is the time in ms that reading
    /// it took.
    pub(super) fn make(
        &self,
        name: &str,
        imported: Imported,
        read: f64,
        asked: &Asked,
        advance: fn(&mut Pipeline) -> Result<()>,
    ) -> Result<Outcome> {
        let settings = asked.shared.settings.clone();
        let unit = UnitReport { unit: imported.report.unit, by_size: imported.report.unit_by_size };
        let import = imported.report.clone();
        let (axes, to) = self.written.axes(imported.report.axes)?;
        let has_levels = self.written.has_levels(self.format)?;
        let mut pipeline = Pipeline::new(Arc::new(imported.mesh), settings).with_samples(REPORT_SAMPLES);
        if self.written.takes_arrays() {
            pipeline = pipeline.with_arrays(imported.arrays);
        }
        if asked.wants_safe || self.prints_branches || self.report.is_some() || self.branches_csv.is_some() {
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
        let left_out = io::left_out(&arrays, self.format).map(|arrays| arrays.to_string());
        let (mut mesh, mut normals) = ((*reduced.mesh).clone(), reduced.normals.clone());
        axes.turn(to, &mut mesh, &mut normals, &mut arrays)?;
        let mut coarser = match pipeline.progressive() {
            Some(levels) if has_levels => halved(levels, mesh.triangles.len()),
            _ => Vec::new(),
        };
        coarser.iter_mut().try_for_each(|(mesh, normals)| axes.turn(to, mesh, normals, &mut []))?;
        let of = |normals| self.written.has_normals().then_some(normals);
        let finest = Output { mesh: &mesh, normals: of(&normals[..]), arrays: &arrays, axes: to };
        let coarser =
            coarser.iter().map(|(mesh, normals)| Output { normals: of(&normals[..]), axes: to, ..Output::new(mesh) });
        let levels: Vec<Output<'_>> = std::iter::once(finest).chain(coarser).collect();
        let bytes =
            if levels.len() > 1 { io::write_levels(&levels)? } else { io::write_output(&levels[0], self.format)? };
        write_whole(self.surface, &bytes)?;
        let mut report = Report::new(name, &pipeline).context("the pipeline ended without a result")?;
        report.stages_ms.read = read;
        report.axes = to;
        (report.unit, report.threshold) = (Some(unit), import.threshold);
        report.stages_ms.write = milliseconds(start);
        let verdict = Verdict::of_run(&pipeline, &report, &import, Format::from_name(name).is_some());
        report.verdict = Some(Box::new(VerdictReport::from(&verdict)));
        if let Some(path) = self.report {
            write_whole(path, serde_json::to_string_pretty(&report)?.as_bytes())?;
        }
        Ok(Outcome { report, verdict, left_out })
    }
}

/// A finding with its place and what would help, in a line.
pub(super) fn told_with_remedies(finding: &Finding) -> String {
    let at = finding.place.as_ref().map(|place| place.at_mm).filter(|_| !finding.what.says_where());
    let at = at.map_or(String::new(), |[x, y, z]| format!(" At ({x:.1}, {y:.1}, {z:.1})."));
    let help: Vec<String> = finding.remedies.iter().map(|remedy| remedy.label.to_string()).collect();
    let help = if help.is_empty() { String::new() } else { format!(" Would help: {}.", help.join(", ")) };
    format!("{}{at}{help}", finding.what)
}
