//! Where a subcommand's surface comes from: a file, or `sample:aorta`.

use anyhow::{Context, Result, bail};

use crate::io::{self, ImportOptions, Imported, Unit};
use crate::phantom::{self, Sample};

/// Reads the file `name`, or makes the sample that `sample:...` names. Warnings go to standard error.
pub(super) fn read(name: &str, unit: Option<Unit>) -> Result<Imported> {
    let imported = match name.strip_prefix("sample:") {
        Some(sample) => {
            if unit.is_some() {
                bail!("a sample is in millimetres: --unit makes no sense here");
            }
            let made: Sample = sample.parse()?;
            self::sample(made, made.default_triangles())?
        }
        None => {
            let bytes = std::fs::read(name).with_context(|| format!("cannot read {name}"))?;
            io::read(&bytes, name, &ImportOptions { unit }).with_context(|| name.to_owned())?
        }
    };
    for warning in &imported.report.warnings {
        eprintln!("lumen: warning: {warning}");
    }
    Ok(imported)
}

/// Makes a sample with so many triangles.
pub(super) fn sample(sample: Sample, triangles: usize) -> Result<Imported> {
    Ok(io::import_mesh(phantom::generate(sample, triangles)?, "sample"))
}
