//! `lumen phantom`: a vessel tree that Lumen makes itself, as a file.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use super::places::{self, output_format, write_whole};
use super::rows::row;
use crate::io;
use crate::mesh::components;
use crate::phantom::{MAX_TRIANGLES, MIN_TRIANGLES, Sample, generate};

/// Writes a vessel tree.
#[derive(Debug, Args)]
pub struct Phantom {
    /// aorta or coronary
    sample: Sample,
    /// Triangles of the largest piece, to within 1 %; 2,000 to 5,000,000
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(MIN_TRIANGLES as i64..=MAX_TRIANGLES as i64))]
    triangles: Option<u32>,
    #[arg(short, long, value_name = "FILE", help = places::where_to_write())]
    output: PathBuf,
}

impl Phantom {
    /// Makes the surface and writes it.
    pub(super) fn run(&self) -> Result<()> {
        let format = output_format(&self.output)?;
        let wanted = self.triangles.map_or(self.sample.default_triangles(), |n| n as usize);
        let mesh = generate(self.sample, wanted)?;
        write_whole(&self.output, &io::write(&mesh, None, format)?)?;
        let pieces = components(mesh.positions.len(), &mesh.triangles);
        let largest = pieces.largest().map_or(0, |piece| pieces.triangle_counts[piece as usize]);
        row("triangles", mesh.triangles.len());
        row("components", pieces.count());
        row("largest component", format!("{largest} triangles"));
        row("written to", self.output.display());
        Ok(())
    }
}
