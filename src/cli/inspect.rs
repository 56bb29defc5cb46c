//! `lumen inspect`: what is in a surface file, or in a scan.

use anyhow::{Result, bail};
use clap::Args;
use serde::Serialize;

use super::mend::fault_rows;
use super::misuse::misuse;
use super::rows::{array_rows, row, shape_rows};
use super::scan;
use super::scan_options::ScanOptions;
use super::source;
use super::source::{UNIT_HELP, UnitOption};
use crate::io::{ImportReport, Imported};
use crate::mesh::mending::{FaultCounts, Faults};
use crate::pipeline::shape::{Shape, shape};

/// Says what is in a surface file, or in a scan; with a threshold or a label, in the surface of that.
#[derive(Debug, Args)]
pub struct Inspect {
    /// A surface file, or sample:aorta, sample:coronary; a scan or a mask, or a folder of DICOM
    file: String,
    #[command(flatten)]
    scan: ScanOptions,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
    #[arg(long, value_name = "UNIT", help = UNIT_HELP)]
    unit: Option<UnitOption>,
}

/// What is in a file, and its shape: the fields of both, side by side.
#[derive(Serialize)]
struct Inspected {
    #[serde(flatten)]
    report: ImportReport,
    #[serde(flatten)]
    shape: Shape,
    faults: FaultCounts,
}

impl Inspect {
    /// Reads the file and prints its report.
    pub(super) fn run(&self) -> Result<()> {
        if !self.scan.is_chosen()
            && !self.file.starts_with("sample:")
            && let Some(opened) = scan::open(std::slice::from_ref(&self.file), &self.scan)?
        {
            if self.scan.has_box() {
                return Err(misuse(
                    "--box says where the surface is looked for: say with --threshold or --label what it is of",
                ));
            }
            if self.unit.and_then(UnitOption::given).is_some() {
                bail!("a scan is in millimetres: --unit makes no sense here");
            }
            for warning in opened.warnings() {
                eprintln!("lumen: warning: {warning}");
            }
            if self.json {
                println!("{}", opened.json()?);
            } else {
                opened.print();
            }
            return Ok(());
        }
        let Imported { mesh, report, .. } = source::read_with(&self.file, self.unit, &self.scan)?;
        let inspected = Inspected { report, shape: shape(&mesh), faults: Faults::all(&mesh).counts() };
        if self.json {
            println!("{}", serde_json::to_string_pretty(&inspected)?);
            return Ok(());
        }
        let Inspected { report, shape, faults } = inspected;
        let size = report.bounds_mm.size();
        row("format", &report.format);
        row("axes", report.axes);
        row("triangles", report.triangles);
        row("vertices", report.vertices);
        row("components", report.components);
        row("largest component", format!("{} triangles", report.largest_component_triangles));
        row("boundary edges", report.boundary_edges);
        row("non-manifold edges", report.non_manifold_edges);
        fault_rows(&faults);
        row("degenerate triangles", report.degenerate_triangles);
        row("duplicate triangles", report.duplicate_triangles);
        row("winding mended", format!("{} edges", report.winding_flips));
        row("size", format!("{:.3} x {:.3} x {:.3} mm", size.x, size.y, size.z));
        row("area", format!("{:.3} mm2", report.area_mm2));
        match report.volume_mm3 {
            Some(volume) => row("volume, ends capped", format!("{volume:.3} mm3")),
            None => row("volume", "none: the surface cannot be oriented"),
        }
        shape_rows(&shape);
        array_rows(&report.arrays);
        Ok(())
    }
}
