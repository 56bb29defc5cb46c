//! Where a subcommand's surface comes from: a file, or `sample:aorta`.

use anyhow::{Context, Result, bail};

use crate::io::{self, ImportOptions, Imported, Unit};
use crate::phantom::{self, Sample};
use crate::sharing::Digest;

/// Reads the file `name`, or makes the sample that `sample:...` names. Warnings go to standard error.
pub(super) fn read(name: &str, unit: Option<Unit>) -> Result<Imported> {
    let (imported, _) = read_quietly(name, unit)?;
    for warning in &imported.report.warnings {
        eprintln!("lumen: warning: {warning}");
    }
    Ok(imported)
}

/// As [`read`], with the file's hash in place of the warnings; a sample has none.
pub(super) fn read_quietly(name: &str, unit: Option<Unit>) -> Result<(Imported, Option<Digest>)> {
    match name.strip_prefix("sample:") {
        Some(sample) => {
            if unit.is_some() {
                bail!("a sample is in millimetres: --unit makes no sense here");
            }
            let made: Sample = sample.parse()?;
            Ok((self::sample(made, made.default_triangles())?, None))
        }
        None => {
            let bytes = std::fs::read(name).with_context(|| format!("cannot read {name}"))?;
            let imported = io::read(&bytes, name, &ImportOptions { unit }).with_context(|| name.to_owned())?;
            Ok((imported, Some(Digest::of(&bytes))))
        }
    }
}

/// Makes a sample with so many triangles.
pub(super) fn sample(sample: Sample, triangles: usize) -> Result<Imported> {
    Ok(io::import_mesh(phantom::generate(sample, triangles)?, "sample"))
}
