//! Where a subcommand's surface comes from: a file, `sample:aorta`, or a scan.

use anyhow::{Context, Result, bail};

use super::scan::{self, ScanOptions};
use crate::io::{self, ImportOptions, Imported, Unit};
use crate::phantom::{self, Sample};

/// Reads the file `name`, or makes the sample that `sample:...` names; of a mask, the surface of all that is not 0. Warnings
/// go to standard error.
pub(super) fn read(name: &str, unit: Option<Unit>) -> Result<Imported> {
    read_with(name, unit, &ScanOptions::default())
}

/// [`read`], with what of a scan or a mask is the vessel.
pub(super) fn read_with(name: &str, unit: Option<Unit>, options: &ScanOptions) -> Result<Imported> {
    let imported = match name.strip_prefix("sample:") {
        Some(sample) => {
            options.refuse(name);
            if unit.is_some() {
                bail!("a sample is in millimetres: --unit makes no sense here");
            }
            let made: Sample = sample.parse()?;
            self::sample(made, made.default_triangles())?
        }
        None => match scan::open(&[name.to_owned()])? {
            Some(_) if unit.is_some() => bail!("a scan is in millimetres: --unit makes no sense here"),
            Some(opened) => opened.surface(options).with_context(|| name.to_owned())?,
            None => {
                options.refuse(name);
                let bytes = std::fs::read(name).with_context(|| format!("cannot read {name}"))?;
                io::read(&bytes, name, &ImportOptions { unit }).with_context(|| name.to_owned())?
            }
        },
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
