//! `lumen compare`: two surfaces side by side, whoever made them.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, Result, bail};
use clap::{Args, ValueEnum};
use glam::{DQuat, DVec3};
use serde::Serialize;
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
use crate::io::{self, Axes, Imported, Output};
use crate::language::grouped;
use crate::mesh::arrays::{Association, Values};
use crate::mesh::{Array, SurfaceIndex, TriMesh};
use crate::pipeline::beside::{Beside, Distances, Farthest, Looking, beside};
use crate::pipeline::deviation::{Aligned, Deviation, REPORT_SAMPLES, Rigid, align};
use crate::pipeline::report::DISCLAIMER;
use crate::pipeline::settings::Settings;
use crate::sharing::Digest;
use crate::vessel::certificate::{BranchCalibre, SurfaceColumns, Verdict};
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
    align: Option<Align>,
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
enum Align {
    Axes,
    Rigid,
}

/// What was found. The names of the fields are public and stay.
#[derive(Serialize)]
struct Told<'a> {
    disclaimer: &'static str,
    version: &'static str,
    reference: Side<'a>,
    surface: Side<'a>,
    /// Null where nothing was moved.
    moved: Option<Moved>,
    /// Pooled over samples of both.
    deviation_mm: Deviation,
    reference_farthest: Farthest,
    surface_farthest: Farthest,
    calibre: Calibre<'a>,
}

/// One of the two surfaces.
#[derive(Serialize)]
struct Side<'a> {
    file: &'a str,
    sha256: Option<String>,
    axes: Axes,
    triangles: usize,
    vertices: usize,
    area_mm2: f64,
    volume_mm3: Option<f64>,
}

/// How the surface was moved, in the coordinates of the files in mm: turned about the origin, then shifted.
#[derive(Clone, Copy, Serialize)]
struct Moved {
    /// As a quaternion x, y, z, w.
    rotation: [f64; 4],
    shift_mm: [f64; 3],
    /// The angle of the rotation.
    turned_deg: f64,
    /// How far its vertices came, on the mean.
    mean_shift_mm: f64,
    /// What came of fitting it; null where only axes were turned.
    fit: Option<Fit>,
}

/// Root of the mean square distance of the nearest four fifths of the surface's points.
#[derive(Clone, Copy, Serialize)]
struct Fit {
    /// Before, axes turned already.
    before_mm: f64,
    /// And after.
    residual_mm: f64,
}

/// What became of the vessels.
#[derive(Serialize)]
struct Calibre<'a> {
    tolerance_percent: f64,
    /// Why nothing was measured.
    refused: Option<String>,
    verdict: Option<Verdict>,
    measured_percent: Option<f64>,
    branches: Vec<Branch<'a>>,
}

/// A vessel on both surfaces. Radii and changes are null where nothing was measured.
#[derive(Serialize)]
struct Branch<'a> {
    number: u32,
    name: &'a str,
    parent: Option<u32>,
    length_mm: f64,
    verdict: Verdict,
    measured_percent: f64,
    mean_radius_reference_mm: Option<f64>,
    mean_radius_surface_mm: Option<f64>,
    largest_change_percent: Option<f64>,
    largest_change_at_mm: Option<[f32; 3]>,
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
        let stand = self.stand(&reference, &surface)?;
        let moved = self.moved(&reference, &mut surface, stand)?;

        let both = [&reference, &surface].map(|opened| Arc::new(opened.imported.mesh.clone()));
        let how = Looking {
            samples: REPORT_SAMPLES,
            tolerance_percent: self.tolerance,
            with_reference_map: self.reference_output.is_some(),
        };
        let found = worked("Comparing", |yielder| async move { beside(&both[0], &both[1], how, &yielder).await })?;
        let found = found.context("one of the surfaces has no area: there is nothing to compare")?;

        if let Some(path) = &self.output {
            written(path, &surface.imported, &found.over_surface)?;
        }
        if let (Some(path), Some(distances)) = (&self.reference_output, &found.over_reference) {
            written(path, &reference.imported, distances)?;
        }
        let told = Told {
            disclaimer: DISCLAIMER,
            version: env!("CARGO_PKG_VERSION"),
            reference: side(&self.reference, &reference),
            surface: side(&self.file, &surface),
            moved,
            deviation_mm: found.deviation,
            reference_farthest: found.farthest[0],
            surface_farthest: found.farthest[1],
            calibre: calibre(&found, self.tolerance),
        };
        if let Some(path) = &self.report {
            write_whole(path, serde_json::to_string_pretty(&told)?.as_bytes())?;
        }
        print(&told);
        let size = reference.imported.report.bounds_mm.diagonal();
        if self.align != Some(Align::Rigid) && told.deviation_mm.mean > APART * f64::from(size) {
            eprintln!(
                "lumen: warning: the surfaces lie {:.1} mm apart on the mean: --align rigid moves the second onto the first",
                told.deviation_mm.mean
            );
        }
        println!("{DISCLAIMER}");
        match (&self.csv, &found.calibre) {
            (Some(path), Ok(calibre)) => write_whole(path, calibre.csv_of(&COLUMNS).as_bytes()),
            (Some(path), Err(refused)) => bail!("{} is not written, there are no vessels: {refused}", path.display()),
            (None, _) => Ok(()),
        }
    }

    /// What brings the surface, as it was read, to where it stands in the reference's coordinates: files far from the origin
    /// were moved when they were read, and axes are turned where that is asked for.
    fn stand(&self, reference: &Opened, surface: &Opened) -> Result<Rigid> {
        let both = [reference, surface].map(|opened| &opened.imported.report);
        let [to, from] = both.map(|report| DVec3::from(report.moved_mm));
        let [onto, axes] = both.map(|report| report.axes);
        let are_known = onto != Axes::Unknown && axes != Axes::Unknown;
        if self.align == Some(Align::Axes) && !are_known {
            return Err(misuse(
                "which way the axes point is said by one of the files at most: --align rigid finds how they fit",
            ));
        }
        let differ = are_known && onto != axes;
        if differ && self.align.is_none() {
            eprintln!("lumen: warning: the first is in {onto}, the second in {axes}: --align axes turns it");
        }
        let turned = if differ && self.align.is_some() { Rigid::HALF_TURN } else { Rigid::STILL };
        Ok(Rigid::shift(-from).then(turned).then(Rigid::shift(to)))
    }

    /// Moves the surface to where it stands, and onto the reference where that is asked for.
    fn moved(&self, reference: &Opened, surface: &mut Opened, stand: Rigid) -> Result<Option<Moved>> {
        let (mut motion, mut fit) = (stand, None);
        if self.align == Some(Align::Rigid) {
            let (onto, mut mesh) = (reference.imported.mesh.clone(), surface.imported.mesh.clone());
            mesh.positions.iter_mut().for_each(|p| *p = stand.of(*p));
            let found = worked("Aligning", |yielder| async move {
                let index = SurfaceIndex::new(&onto.positions, &onto.triangles);
                align(&mesh, &onto, &index, &yielder).await
            })?;
            let Aligned { motion: further, before_mm, residual_mm } =
                found.context("one of the surfaces has no area: there is nothing to align")?;
            motion = stand.then(further);
            fit = Some(Fit { before_mm, residual_mm });
        }
        let Imported { mesh, arrays, report } = &mut surface.imported;
        // In the coordinates of the files.
        let [to, from] = [reference.imported.report.moved_mm, report.moved_mm].map(DVec3::from);
        let in_files = Rigid::shift(from).then(motion).then(Rigid::shift(-to));
        let mut shifts = 0.0;
        for p in &mut mesh.positions {
            let begun = p.as_dvec3() - from;
            shifts += begun.distance(in_files.moved(begun));
            *p = motion.of(*p);
        }
        report.moved_mm = to.to_array();
        if fit.is_none() && motion.rotation == DQuat::IDENTITY {
            return Ok(None);
        }
        let onto = reference.imported.report.axes;
        if fit.is_none() {
            report.axes.turn(onto, &mut TriMesh::default(), &mut [], arrays)?;
        } else {
            let lost = arrays.extract_if(.., |array| io::has_directions(array)).map(|array| array.name);
            let lost = lost.collect::<Vec<_>>().join(", ");
            if !lost.is_empty() && self.output.is_some() {
                eprintln!("lumen: warning: directions do not turn with the surface, these arrays are left out: {lost}");
            }
        }
        report.axes = onto;
        Ok(Some(Moved {
            rotation: in_files.rotation.to_array(),
            shift_mm: in_files.shift_mm.to_array(),
            turned_deg: in_files.angle_deg(),
            mean_shift_mm: shifts / mesh.positions.len().max(1) as f64,
            fit,
        }))
    }
}

/// The surfaces of the table of stations.
const COLUMNS: [SurfaceColumns; 2] = [("reference", |branch| &branch.opened), ("surface", |branch| &branch.reduced)];

/// From this part of the reference's size on two surfaces are told to lie apart.
const APART: f64 = 0.05;

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

fn side<'a>(file: &'a str, Opened { imported, digest }: &Opened) -> Side<'a> {
    let Imported { mesh: TriMesh { positions, triangles }, report, .. } = imported;
    Side {
        file,
        sha256: digest.as_ref().map(ToString::to_string),
        axes: report.axes,
        triangles: triangles.len(),
        vertices: positions.len(),
        area_mm2: report.area_mm2,
        volume_mm3: report.volume_mm3,
    }
}

fn calibre(found: &Beside, tolerance_percent: f64) -> Calibre<'_> {
    let certificate = found.calibre.as_ref().ok();
    Calibre {
        tolerance_percent,
        refused: found.calibre.as_ref().err().map(ToString::to_string),
        verdict: certificate.map(|found| found.verdict),
        measured_percent: certificate.map(|found| found.coverage.percent()),
        branches: certificate.map_or_else(Vec::new, |found| found.branches.iter().map(branch).collect()),
    }
}

fn branch(of: &BranchCalibre) -> Branch<'_> {
    Branch {
        number: of.number,
        name: &of.name,
        parent: of.parent,
        length_mm: of.length_mm,
        verdict: of.verdict,
        measured_percent: of.coverage().percent(),
        mean_radius_reference_mm: of.opened.radius_mm.map(|radius| radius.mean),
        mean_radius_surface_mm: of.reduced.radius_mm.map(|radius| radius.mean),
        largest_change_percent: of.reduced.largest_change.map(|change| change.percent),
        largest_change_at_mm: of.reduced.largest_change.map(|change| change.at_mm),
    }
}

fn print(told: &Told<'_>) {
    let Told { reference, surface, moved, deviation_mm, .. } = told;
    let mut rows = Builder::new();
    rows.push_record(["", "reference", "surface", "change %"]);
    let count = |what: &str, of: fn(&Side<'_>) -> usize| {
        let [from, to] = [of(reference), of(surface)];
        [what.to_owned(), grouped(from), grouped(to), change(from as f64, to as f64)]
    };
    let name = |side: &Side<'_>| {
        Path::new(side.file).file_name().map_or("-".into(), |name| name.to_string_lossy().into_owned())
    };
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
