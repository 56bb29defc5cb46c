//! `lumen mend`: what is wrong with a surface mended, and nothing else done to it.

use std::path::{Path, PathBuf};

use anyhow::Result;
use clap::Args;
use serde::Serialize;

use super::misuse::misuse;
use super::options::MendingOptions;
use super::places::{output_format, write_whole};
use super::rows::row;
use super::running::worked;
use super::source::{self, UNIT_HELP, UnitOption};
use super::{interrupt, places};
use crate::io::{self, Imported, Output};
use crate::mesh::mending::{FaultCounts, Faults, MendReport, Mended, mend};
use crate::pipeline::settings::Settings;

/// Mends what is wrong with a surface, and writes it: neither smoothed nor reduced.
#[derive(Debug, Args)]
pub struct Mend {
    /// A surface file, or sample:aorta, sample:coronary
    file: String,
    #[arg(short, long, value_name = "OUT", help = places::where_to_write())]
    output: PathBuf,
    #[command(flatten)]
    mending: MendingOptions,
    #[arg(long, value_name = "UNIT", help = UNIT_HELP)]
    unit: Option<UnitOption>,
    /// Write all numbers to this file
    #[arg(long, value_name = "FILE.json")]
    report: Option<PathBuf>,
}

/// What was wrong, what was done, and what still is. The names of the fields are public and stay.
#[derive(Serialize)]
struct Told {
    faults_before: FaultCounts,
    mending: MendReport,
    faults_after: FaultCounts,
}

impl Mend {
    /// Mends the surface and writes it.
    pub(super) fn run(&self) -> Result<()> {
        let asked = self.mending.asked();
        if asked.is_off() {
            return Err(misuse("nothing is asked for: say --weld, --split, --fill-holes or --lumen"));
        }
        Settings { mending: asked, ..Settings::default() }.check().map_err(misuse)?;
        let format = output_format(&self.output)?;
        let report = self.report.iter().map(|path| ("the report".to_owned(), &**path));
        places::check([Path::new(&self.file)], [("the surface".to_owned(), &*self.output)].into_iter().chain(report))?;
        interrupt::listen()?;
        let Imported { mesh, arrays, report } = source::read(&self.file, self.unit)?;
        let faults_before = Faults::all(&mesh).counts();
        let Mended { mesh, arrays, report: mending } =
            worked("Mending", move |yielder| async move { mend(mesh, arrays, asked, &yielder).await })?;
        let faults_after = Faults::all(&mesh).counts();
        let output = Output { mesh: &mesh, normals: None, arrays: &arrays, axes: report.axes };
        write_whole(&self.output, &io::write_output(&output, format)?)?;
        if let Some(path) = &self.report {
            let told = Told { faults_before, mending, faults_after };
            write_whole(path, serde_json::to_string_pretty(&told)?.as_bytes())?;
        }
        row("triangles in file", report.triangles);
        mended_rows(&mending);
        row("output", format!("{} triangles, {} vertices", mesh.triangles.len(), mesh.positions.len()));
        row("non-manifold edges", faults_after.non_manifold_edges);
        fault_rows(&faults_after);
        row("written to", format!("{}, in {}", self.output.display(), format.unit()));
        for sentence in mending.warnings(&asked) {
            eprintln!("lumen: warning: {sentence}");
        }
        Ok(())
    }
}

/// The rows of what is wrong with a surface, beside the edges that the import counts.
pub(super) fn fault_rows(faults: &FaultCounts) {
    row("non-manifold vertices", faults.non_manifold_vertices);
    let largest = faults.largest_hole_mm.map_or(String::new(), |mm| format!(", the largest {mm:.3} mm across"));
    row("holes in walls", format!("{}{largest}", faults.holes));
    row("open ends of vessels", faults.vessel_ends);
    if faults.sheet_edges > 0 {
        row("edges of sheets", faults.sheet_edges);
    }
    if let Some(wall) = faults.wall {
        let pieces = if wall.is_two_pieces { "two pieces" } else { "one piece" };
        row("a wall with two sides", format!("{:.3} mm thick, {pieces}", wall.thickness_mm));
    }
}

/// The rows of what was mended; what was not is left out.
pub(super) fn mended_rows(done: &MendReport) {
    let tell = |what: &str, count: usize, noun: &str| {
        if count > 0 {
            row(what, format!("{count} {noun}"));
        }
    };
    tell("welded", done.vertices_welded, "vertices");
    tell("turned to agree", done.reoriented_triangles, "triangles");
    tell("turned outwards", done.components_turned, "components");
    tell("left out of the wall", done.wall_triangles_left_out, "triangles");
    tell("split", done.edges_split, "edges");
    tell("split", done.vertices_split, "vertices");
    tell("duplicates left out", done.duplicates_left_out, "triangles");
    tell("holes filled", done.holes_filled, "holes");
    tell("holes left", done.holes_left, "holes");
}
