//! `lumen phantom`: a vessel tree that Lumen makes itself, as a file.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::Args;

use super::{row, write_whole};
use crate::io::{self, Format};
use crate::mesh::components;
use crate::phantom::{Sample, generate};

/// Writes a vessel tree.
#[derive(Debug, Args)]
pub struct Phantom {
    /// aorta or coronary
    sample: Sample,
    /// Triangles of the largest piece, to within 1 %
    #[arg(long, value_name = "N")]
    triangles: Option<usize>,
    /// Where to write: .stl, .ply, .obj or .glb
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

impl Phantom {
    /// Makes the surface and writes it.
    pub(super) fn run(&self) -> Result<()> {
        let format = Format::from_name(&self.output.to_string_lossy())
            .with_context(|| format!("{} does not end in .stl, .ply, .obj or .glb", self.output.display()))?;
        let mesh = generate(self.sample, self.triangles.unwrap_or(self.sample.default_triangles()))?;
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
