//! `lumen surface`: the surface in a scan or a mask, as a file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use clap::Args;

use super::places::{self, output_format, write_whole};
use super::rows::{row, threshold_rows};
use super::scan;
use super::scan_options::ScanOptions;
use crate::io::{self, Axes, Format, Imported};
use crate::mesh::arrays::{Array, Association, Scalar, Values};
use crate::volume::LabelledSurface;

/// Writes the surface of what reaches a threshold in a scan, or of a label of a mask, in mm; in LPS where the scan says how the patient lies.
#[derive(Debug, Args)]
pub struct Surface {
    /// NIfTI, NRRD, MetaImage or VTI; a header and its data; the files of a DICOM series, or their folder
    #[arg(required = true, value_name = "SCAN")]
    files: Vec<String>,
    #[arg(short, long, value_name = "OUT", help = places::where_to_write())]
    output: PathBuf,
    #[command(flatten)]
    scan: ScanOptions,
}

impl Surface {
    /// Makes the surface and writes it.
    pub(super) fn run(&self) -> Result<()> {
        scan::check()?;
        let format = output_format(&self.output)?;
        places::check(self.files.iter().map(Path::new), [("the surface".to_owned(), &*self.output)])?;
        let Some(opened) = scan::open(&self.files, &self.scan)? else {
            bail!("{} is not a scan or a mask", self.files[0]);
        };
        if let Some(borders) = opened.borders(&self.scan)? {
            for warning in opened.warnings() {
                eprintln!("lumen: warning: {warning}");
            }
            return self.write_borders(&borders, opened.axes(), format);
        }
        let Imported { mesh, report, .. } = opened.surface(&self.scan)?;
        for warning in &report.warnings {
            eprintln!("lumen: warning: {warning}");
        }
        let output = io::Output { mesh: &mesh, normals: None, arrays: &[], axes: report.axes };
        write_whole(&self.output, &io::write_output(&output, format)?)?;
        let size = report.bounds_mm.size();
        row("triangles", report.triangles);
        row("components", report.components);
        row("largest component", format!("{} triangles", report.largest_component_triangles));
        row("size", format!("{:.3} x {:.3} x {:.3} mm", size.x, size.y, size.z));
        row("axes", report.axes);
        report.threshold.into_iter().for_each(threshold_rows);
        opened.print_half_way(&self.scan)?;
        row("written to", self.output.display());
        Ok(())
    }

    /// Writes the borders between labels, with those that each triangle has inside and outside.
    fn write_borders(&self, borders: &LabelledSurface, axes: Axes, format: Format) -> Result<()> {
        let LabelledSurface { mesh, sides } = borders;
        let labels = Values::of(Scalar::I32, sides.as_flattened().iter().map(|&label| f64::from(label)));
        let arrays = [Array::new("BoundaryLabels", Association::Triangle, 2, labels)];
        if let Some(left_out) = io::left_out(&arrays, format) {
            eprintln!("lumen: warning: {left_out}");
        }
        let output = io::Output { mesh, normals: None, arrays: &arrays, axes };
        write_whole(&self.output, &io::write_output(&output, format)?)?;
        let mut between = BTreeMap::new();
        for sides in sides {
            *between.entry(sides).or_insert(0) += 1;
        }
        row("triangles", mesh.triangles.len());
        for ([inside, outside], triangles) in between {
            row(&format!("between {inside} and {outside}"), format!("{triangles} triangles"));
        }
        row("axes", axes);
        row("written to", self.output.display());
        Ok(())
    }
}
