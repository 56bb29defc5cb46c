//! `lumen centreline`: the centrelines of a surface with their radii and cross-sections, as a file.

use std::path::PathBuf;
use std::sync::Arc;

use anyhow::{Context, Result};
use clap::Args;

use super::misuse::misuse;
use super::places;
use super::places::write_whole;
use super::rows::row;
use super::source::{self, UNIT_HELP, UnitOption};
use crate::pipeline::report::DISCLAIMER;
use crate::pipeline::run::Pipeline;
use crate::pipeline::settings::{Keep, Settings};
use crate::task::Budget;
use crate::vessel::{CentrelineFormat, Centrelines, Subject};

/// Writes the centrelines.
#[derive(Debug, Args)]
pub struct Centreline {
    /// A surface file, or sample:aorta, sample:coronary
    file: String,
    /// Where to write: .vtp, a line a branch, or .csv, a row a station
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    #[arg(long, value_name = "UNIT", help = UNIT_HELP)]
    unit: Option<UnitOption>,
    /// Look into every connected piece, not only the largest
    #[arg(long)]
    keep_all_components: bool,
}

impl Centreline {
    /// Finds the centrelines and writes them.
    pub(super) fn run(&self) -> Result<()> {
        let extension = self.output.extension().map(|extension| extension.to_string_lossy().into_owned());
        let format = extension.as_deref().and_then(CentrelineFormat::from_extension);
        let format = format.ok_or_else(|| misuse(format!("{} does not end in .vtp or .csv", self.output.display())))?;
        places::check([self.file.as_ref()], [("the centrelines".to_owned(), &*self.output)])?;
        let imported = source::read(&self.file, self.unit)?;
        let keep = if self.keep_all_components { Keep::All } else { Keep::Largest };
        let mut pipeline = Pipeline::new(Arc::new(imported.mesh), Settings { keep, ..Settings::default() });
        while pipeline.kept().is_none() {
            pipeline.advance(Budget::UNLIMITED)?;
        }
        let kept = pipeline.kept().context("there is no surface")?;
        let subject = Subject { mesh: kept.mesh.clone(), topology: kept.topology.clone(), index: None };
        let found = Centrelines::new(&subject).with_context(|| format!("{} has no centrelines", self.file))?;
        write_whole(&self.output, found.written(format).as_bytes())?;
        row("branches", found.branches.len());
        row("too short to be a branch", found.bumps);
        if found.openings_without_branch > 0 {
            row("open ends without a branch", found.openings_without_branch);
        }
        let ends = found.stations.of.iter().filter_map(|range| found.stations.all[range.clone()].last());
        let length: f64 = ends.map(|station| station.abscissa_mm).sum();
        row("length", format!("{length:.1} mm"));
        let radii = || found.stations.all.iter().map(|station| station.radius_mm);
        let (least, largest) = (radii().fold(f64::INFINITY, f64::min), radii().fold(0.0, f64::max));
        row("inscribed radius", format!("{least:.3} to {largest:.3} mm"));
        row("stations", found.stations.all.len());
        let closed = found.calibres.iter().filter(|calibre| calibre.area_mm2.is_some()).count();
        row("closed cross-sections", closed);
        row("written to", format!("{}, in mm", self.output.display()));
        println!("{DISCLAIMER}");
        Ok(())
    }
}
