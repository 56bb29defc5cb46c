//! `lumen compare`: two surfaces side by side, whoever made them.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Result, bail};
use clap::{Args, ValueEnum};
use tabled::builder::Builder;
use tabled::settings::object::Columns;
use tabled::settings::{Alignment, Style};

use super::misuse::misuse;
use super::options::percent;
use super::places::{output_format, write_whole};
use super::rows::row;
use super::running::worked;
use super::source::{self, UnitOption};
use super::{interrupt, places};
use crate::io::{self, Imported, Output};
use crate::language::grouped;
use crate::mesh::arrays::{Association, Values};
use crate::mesh::{Array, Measures, TriMesh};
use crate::pipeline::beside::{
    Align, BesideError, BesideReport, Distances, Farthest, FileFrame, Fit, Looking, Moved, Placed, Side, axes_differ,
    beside, placed,
};
use crate::pipeline::deviation::REPORT_SAMPLES;
use crate::pipeline::report::DISCLAIMER;
use crate::pipeline::settings::Settings;
use crate::sharing::Digest;
use lumen_message::signed;

/// Compares two surfaces, of any program and resolution: how far apart they are both ways, and each vessel's calibre at the
/// same places.
#[derive(Debug, Args)]
pub struct Compare {
    /// What is compared with: a surface file, or sample:aorta, sample:coronary
    reference: String,
    /// What is judged: a surface file
    file: String,
    /// Move the surface onto the reference first: "axes" turns it where one is in LPS and the other in RAS, "rigid" turns
    /// and shifts it as they fit best
    #[arg(long, value_name = "HOW")]
    align: Option<AlignOption>,
    /// The change of a vessel's radius that counts as kept, in percent
    #[arg(long, value_name = "PERCENT", value_parser = percent, default_value_t = Settings::default().tolerance_percent)]
    tolerance: f64,
    /// Write the surface with its distances from the reference: arrays deviation_mm, and signed_deviation_mm, positive
    /// where it lies outside
    #[arg(short, long, value_name = "OUT")]
    output: Option<PathBuf>,
    /// Write the reference with its distances from the surface
    #[arg(long, value_name = "OUT")]
    reference_output: Option<PathBuf>,
    /// Write a row for each station of a vessel: area and radius on both, empty where a cross-section does not close
    #[arg(long, value_name = "OUT.csv")]
    csv: Option<PathBuf>,
    /// Write all numbers to this file
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,
    /// The unit of the numbers in the surface's file: mm, cm or m; auto takes the one in which the size would be that of
    /// vessels, where it is not and only one would do
    #[arg(long, value_name = "UNIT")]
    unit: Option<UnitOption>,
    /// The same of the reference's
    #[arg(long, value_name = "UNIT")]
    reference_unit: Option<UnitOption>,
}

/// How the surface is moved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum AlignOption {
    Axes,
    Rigid,
}

impl From<AlignOption> for Align {
    fn from(option: AlignOption) -> Self {
        match option {
            AlignOption::Axes => Self::Axes,
            AlignOption::Rigid => Self::Rigid,
        }
    }
}

/// A surface as it was opened.
struct Opened {
    imported: Imported,
    digest: Option<Digest>,
}

impl Compare {
    /// Compares them and writes what is asked for.
    pub(super) fn run(&self) -> Result<()> {
        let outputs = [
            ("the surface", &self.output),
            ("the reference", &self.reference_output),
            ("the table", &self.csv),
            ("the report", &self.report),
        ];
        let outputs = outputs.into_iter().filter_map(|(what, path)| Some((what.to_owned(), path.as_deref()?)));
        places::check([Path::new(&self.reference), Path::new(&self.file)], outputs)?;
        for path in [&self.output, &self.reference_output].into_iter().flatten() {
            output_format(path)?;
        }
        interrupt::listen()?;
        let open = |name: &str, unit| -> Result<Opened> {
            let (imported, digest) = source::read_quietly(name, unit)?;
            for warning in &imported.report.warnings {
                eprintln!("lumen: warning: {name}: {warning}");
            }
            Ok(Opened { imported, digest })
        };
        let reference = open(&self.reference, self.reference_unit)?;
        let mut surface = open(&self.file, self.unit)?;
        let moved = self.moved(&reference, &mut surface)?;

        let both = [&reference, &surface].map(|opened| Arc::new(opened.imported.mesh.clone()));
        let how = Looking {
            samples: REPORT_SAMPLES,
            tolerance_percent: self.tolerance,
            with_reference_map: self.reference_output.is_some(),
        };
        let found = worked("Comparing", |yielder| async move { beside(&both[0], &both[1], how, &yielder).await })??;

        if let Some(path) = &self.output {
            written(path, &surface.imported, &found.over_surface)?;
        }
        if let (Some(path), Some(distances)) = (&self.reference_output, &found.over_reference) {
            written(path, &reference.imported, distances)?;
        }
        let sides = [side(&self.reference, &reference), side(&self.file, &surface)];
        let told = BesideReport::new(sides, moved, &found, self.tolerance);
        if let Some(path) = &self.report {
            write_whole(path, serde_json::to_string_pretty(&told)?.as_bytes())?;
        }
        print(&told);
        if self.align != Some(AlignOption::Rigid) && found.lie_apart(&reference.imported.mesh) {
            eprintln!(
                "lumen: warning: the surfaces lie {:.1} mm apart on the mean: --align rigid moves the second onto the first",
                told.deviation_mm.mean
            );
        }
        println!("{DISCLAIMER}");
        match (&self.csv, &found.calibre) {
            (Some(path), Ok(_)) => write_whole(path, found.csv().unwrap_or_default().as_bytes()),
            (Some(path), Err(refused)) => bail!("{} is not written, there are no vessels: {refused}", path.display()),
            (None, _) => Ok(()),
        }
    }

    /// Moves the surface onto the reference as far as that is asked for.
    fn moved(&self, reference: &Opened, surface: &mut Opened) -> Result<Option<Moved>> {
        let both =
            [reference, surface].map(|opened| (opened.imported.mesh.clone(), FileFrame::from(&opened.imported.report)));
        let [(_, to), (_, from)] = both;
        if axes_differ(to, from) && self.align.is_none() {
            eprintln!(
                "lumen: warning: the first is in {}, the second in {}: --align axes turns it",
                to.axes, from.axes
            );
        }
        let align = self.align.map_or(Align::Still, Align::from);
        let found = worked("Aligning", move |yielder| async move {
            let [(reference, to), (surface, from)] = &both;
            placed((reference, *to), (surface, *from), align, &yielder).await
        })?;
        let Placed { motion, moved } = match found {
            Err(error @ BesideError::AxesUnknown) => {
                return Err(misuse(format!("{error}: --align rigid finds how they fit")));
            }
            found => found?,
        };
        let Imported { mesh, arrays, report } = &mut surface.imported;
        mesh.positions.iter_mut().for_each(|p| *p = motion.of(*p));
        report.moved_mm = to.moved_mm;
        match moved {
            None => return Ok(None),
            Some(Moved { fit: None, .. }) => report.axes.turn(to.axes, &mut TriMesh::default(), &mut [], arrays)?,
            Some(_) => {
                let lost = arrays.extract_if(.., |array| io::has_directions(array)).map(|array| array.name);
                let lost = lost.collect::<Vec<_>>().join(", ");
                if !lost.is_empty() && self.output.is_some() {
                    eprintln!(
                        "lumen: warning: directions do not turn with the surface, these arrays are left out: {lost}"
                    );
                }
            }
        }
        report.axes = to.axes;
        Ok(moved)
    }
}

/// Writes a surface with its distances.
fn written(path: &Path, imported: &Imported, distances: &Distances) -> Result<()> {
    let Imported { mesh, arrays, report } = imported;
    let maps = [("deviation_mm", &distances.plain), ("signed_deviation_mm", &distances.signed)];
    // Those of an earlier comparison go.
    let mut arrays = arrays.clone();
    arrays.retain(|array| array.on != Association::Point || maps.iter().all(|(name, _)| *name != array.name));
    arrays.extend(maps.map(|(name, map)| Array::new(name, Association::Point, 1, Values::from_floats(map))));
    let format = output_format(path)?;
    if let Some(left_out) = io::left_out(&arrays, format) {
        eprintln!("lumen: warning: {}: {left_out}", path.display());
    }
    let output = Output { mesh, normals: None, arrays: &arrays, axes: report.axes };
    write_whole(path, &io::write_output(&output, format)?)
}

fn side(file: &str, Opened { imported, digest }: &Opened) -> Side {
    let Imported { mesh, report, .. } = imported;
    let measures = Measures { area_mm2: report.area_mm2, volume_mm3: report.volume_mm3 };
    Side::new(file, digest.as_ref().map(ToString::to_string), report.axes, mesh, measures)
}

fn print(told: &BesideReport) {
    let BesideReport { reference, surface, moved, deviation_mm, .. } = told;
    let mut rows = Builder::new();
    rows.push_record(["", "reference", "surface", "change %"]);
    let count = |what: &str, of: fn(&Side) -> usize| {
        let [from, to] = [of(reference), of(surface)];
        [what.to_owned(), grouped(from), grouped(to), change(from as f64, to as f64)]
    };
    let name =
        |side: &Side| Path::new(&side.file).file_name().map_or("-".into(), |name| name.to_string_lossy().into_owned());
    rows.push_record(["file".to_owned(), name(reference), name(surface), String::new()]);
    rows.push_record(count("triangles", |side| side.triangles));
    rows.push_record(count("vertices", |side| side.vertices));
    let sizes = [
        ("area mm2", Some(reference.area_mm2), Some(surface.area_mm2)),
        ("volume mm3", reference.volume_mm3, surface.volume_mm3),
    ];
    for (what, from, to) in sizes {
        let shown = |value: Option<f64>| value.map_or("-".to_owned(), |value| grouped(format!("{value:.1}")));
        let change = from.zip(to).map_or("-".to_owned(), |(from, to)| change(from, to));
        rows.push_record([what.to_owned(), shown(from), shown(to), change]);
    }
    let mut table = rows.build();
    table.with(Style::blank()).modify(Columns::new(1..), Alignment::right());
    println!("{table}\n");
    if let Some(Moved { turned_deg, mean_shift_mm, fit, .. }) = moved {
        row("the surface was moved", format!("{mean_shift_mm:.2} mm on the mean, turned by {turned_deg:.2} degrees"));
        if let Some(Fit { before_mm, residual_mm }) = fit {
            row("residual", format!("{residual_mm:.4} mm, {before_mm:.4} before"));
        }
    }
    row("deviation, mean", format!("{:.4} mm", deviation_mm.mean));
    row("deviation, RMS", format!("{:.4} mm", deviation_mm.rms));
    row("deviation, p95", format!("{:.4} mm", deviation_mm.p95));
    for (what, Farthest { mm, at_most_mm, at_mm: [x, y, z], .. }) in
        [("reference from surface", told.reference_farthest), ("surface from reference", told.surface_farthest)]
    {
        // Rounded up, or it would not be so.
        let most = (at_most_mm * 1e4).ceil() / 1e4;
        row(what, format!("{mm:.4} mm at ({x:.1}, {y:.1}, {z:.1}), no point farther than {most:.4}"));
    }
    let calibre = &told.calibre;
    if let Some(refused) = &calibre.refused {
        row("calibre of branches", refused);
        return;
    }
    let mut rows = Builder::new();
    rows.push_record([
        "branch",
        "length mm",
        "radius, reference mm",
        "surface",
        "largest %",
        "measured %",
        "verdict",
        "at",
    ]);
    for branch in &calibre.branches {
        let radius = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.3}"));
        let place = |[x, y, z]: [f32; 3]| format!("({x:.1}, {y:.1}, {z:.1})");
        rows.push_record([
            branch.name.to_owned(),
            format!("{:.1}", branch.length_mm),
            radius(branch.mean_radius_reference_mm),
            radius(branch.mean_radius_surface_mm),
            branch.largest_change_percent.map_or("-".to_owned(), |percent| signed(percent, 2)),
            format!("{:.0}", branch.measured_percent.floor()),
            branch.verdict.to_string(),
            branch.largest_change_at_mm.map_or_else(String::new, place),
        ]);
    }
    let mut table = rows.build();
    table.with(Style::blank()).modify(Columns::new(1..6), Alignment::right());
    println!("\n{table}");
    let verdict = calibre.verdict.map_or_else(String::new, |verdict| verdict.to_string());
    let over = calibre
        .measured_percent
        .map_or_else(String::new, |percent| format!(", measured over {:.0} % of the length", percent.floor()));
    row("calibre", format!("{verdict}, at a tolerance of {} %{over}", calibre.tolerance_percent));
}

fn change(from: f64, to: f64) -> String {
    if from == 0.0 { "-".to_owned() } else { signed(100.0 * (to / from - 1.0), 2) }
}
