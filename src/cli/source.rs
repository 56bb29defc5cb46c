//! Where a subcommand's surface comes from: a file, `sample:aorta`, or a scan.

use anyhow::{Context, Result, bail};

use super::scan::{self, ScanOptions};
use crate::io::{self, ImportOptions, Imported, Unit};
use crate::phantom::{self, Sample};
use crate::sharing::Digest;

/// Reads the file `name`, or makes the sample that `sample:...` names; of a mask, the surface of all that is not 0. Warnings
/// go to standard error.
pub(super) fn read(name: &str, unit: Option<Unit>) -> Result<Imported> {
    read_with(name, unit, &ScanOptions::default())
}

/// [`read`], with what of a scan or a mask is the vessel.
pub(super) fn read_with(name: &str, unit: Option<Unit>, options: &ScanOptions) -> Result<Imported> {
    let (imported, _) = open(name, unit, options)?;
    for warning in &imported.report.warnings {
        eprintln!("lumen: warning: {warning}");
    }
    Ok(imported)
}

/// As [`read`], with the file's hash in place of the warnings; a sample and a scan have none.
pub(super) fn read_quietly(name: &str, unit: Option<Unit>) -> Result<(Imported, Option<Digest>)> {
    open(name, unit, &ScanOptions::default())
}

fn open(name: &str, unit: Option<Unit>, options: &ScanOptions) -> Result<(Imported, Option<Digest>)> {
    if let Some(sample) = name.strip_prefix("sample:") {
        options.refuse(name);
        if unit.is_some() {
            bail!("a sample is in millimetres: --unit makes no sense here");
        }
        let made: Sample = sample.parse()?;
        return Ok((self::sample(made, made.default_triangles())?, None));
    }
    match scan::open(&[name.to_owned()])? {
        Some(_) if unit.is_some() => bail!("a scan is in millimetres: --unit makes no sense here"),
        Some(opened) => Ok((opened.surface(options).with_context(|| name.to_owned())?, None)),
        None => {
            options.refuse(name);
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
