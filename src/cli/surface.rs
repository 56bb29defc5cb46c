//! `lumen surface`: the surface in a scan or a mask, as a file.

use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;

use super::optimise::same_file;
use super::scan::{self, ScanOptions};
use super::{misuse, output_format, row, write_whole};
use crate::io::{self, Axes, Imported};

/// Writes the surface of what reaches a threshold in a scan, or of a label of a mask, in LPS mm.
#[derive(Debug, Args)]
pub struct Surface {
    /// NIfTI, NRRD, MetaImage or VTI; a header and its data; the files of a DICOM series, or their folder
    #[arg(required = true, value_name = "SCAN")]
    files: Vec<String>,
    /// Where to write: .stl, .ply, .obj, .vtp, .vtk or .glb
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    scan: ScanOptions,
}

impl Surface {
    /// Makes the surface and writes it.
    pub(super) fn run(&self) -> Result<()> {
        let format = output_format(&self.output);
        if let Some(file) = self.files.iter().find(|file| same_file(file.as_ref(), &self.output)) {
            misuse(format!("{file} would be overwritten: choose another output"));
        }
        let Some(opened) = scan::open(&self.files)? else {
            bail!("{} is not a scan or a mask", self.files[0]);
        };
        let Imported { mesh, report, .. } = opened.surface(&self.scan)?;
        let output = io::Output { mesh: &mesh, normals: None, arrays: &[], axes: Axes::Lps };
        write_whole(&self.output, &io::write_output(&output, format)?)?;
        let size = report.bounds_mm.size();
        row("triangles", report.triangles);
        row("components", report.components);
        row("largest component", format!("{} triangles", report.largest_component_triangles));
        row("size", format!("{:.3} x {:.3} x {:.3} mm", size.x, size.y, size.z));
        row("axes", "LPS");
        row("written to", self.output.display());
        Ok(())
    }
}
