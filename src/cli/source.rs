//! Where a subcommand's surface comes from: a file, `sample:aorta`, or a scan.

use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

use anyhow::{Context, Result, bail};

use super::interrupt;
use super::scan;
use super::scan_options::ScanOptions;
use crate::io::{self, ImportOptions, Imported, Unit, UnknownUnit, Warning, read_in_slices};
use crate::phantom::{self, Sample};
use crate::sharing::Digest;
use crate::task::{Budget, Progress, Running};

/// What an option for the unit says of itself.
pub(super) const UNIT_HELP: &str = "The unit of the numbers in the file: mm, cm or m; auto takes the one in which the size would be \
that of vessels, where it is not and only one would do";

/// The unit of a file's numbers, as it is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum UnitOption {
    Given(Unit),
    /// By the size of the surface, where that leaves no doubt.
    Auto,
}

impl UnitOption {
    /// The unit, unless it is to be found by the size.
    pub(super) fn given(self) -> Option<Unit> {
        match self {
            Self::Given(unit) => Some(unit),
            Self::Auto => None,
        }
    }
}

impl FromStr for UnitOption {
    type Err = UnknownUnit;

    fn from_str(word: &str) -> Result<Self, UnknownUnit> {
        if word == "auto" { Ok(Self::Auto) } else { word.parse().map(Self::Given) }
    }
}

/// Reads the file `name`, or makes the sample that `sample:...` names; of a mask, the surface of all that is not 0. Warnings
/// go to standard error.
pub(super) fn read(name: &str, unit: Option<UnitOption>) -> Result<Imported> {
    read_with(name, unit, &ScanOptions::default())
}

/// [`read`], with what of a scan or a mask is the vessel.
pub(super) fn read_with(name: &str, unit: Option<UnitOption>, options: &ScanOptions) -> Result<Imported> {
    Ok(read_known(name, unit, options)?.0)
}

/// [`read_with`], and the file's hash; a sample and a scan have none.
pub(super) fn read_known(
    name: &str,
    unit: Option<UnitOption>,
    options: &ScanOptions,
) -> Result<(Imported, Option<Digest>)> {
    let (imported, digest) = open(name, unit, options)?;
    for warning in &imported.report.warnings {
        eprintln!("lumen: warning: {warning}");
    }
    Ok((imported, digest))
}

/// As [`read`], with the file's hash in place of the warnings; a sample and a scan have none.
pub(super) fn read_quietly(name: &str, unit: Option<UnitOption>) -> Result<(Imported, Option<Digest>)> {
    open(name, unit, &ScanOptions::default())
}

fn open(name: &str, unit: Option<UnitOption>, options: &ScanOptions) -> Result<(Imported, Option<Digest>)> {
    if let Some(sample) = name.strip_prefix("sample:") {
        options.refuse(name)?;
        if unit.and_then(UnitOption::given).is_some() {
            bail!("a sample is in millimetres: --unit makes no sense here");
        }
        let made: Sample = sample.parse()?;
        return Ok((self::sample(made, made.default_triangles())?, None));
    }
    match scan::open(&[name.to_owned()], options)? {
        Some(_) if unit.and_then(UnitOption::given).is_some() => {
            bail!("a scan is in millimetres: --unit makes no sense here")
        }
        Some(opened) => Ok((opened.surface(options).with_context(|| name.to_owned())?, None)),
        None => {
            let bytes = Arc::new(std::fs::read(name).with_context(|| format!("cannot read {name}"))?);
            let read = |unit| surface(Arc::clone(&bytes), name, ImportOptions { unit });
            let mut imported = read(unit.and_then(UnitOption::given))?;
            options.refuse(name)?;
            if unit == Some(UnitOption::Auto)
                && let Some(unit) = imported.report.unit_by_size()
            {
                imported = read(Some(unit))?;
                imported.report.unit_by_size = true;
                imported.report.warnings.push(Warning::UnitBySize { unit });
            }
            Ok((imported, Some(Digest::of(&bytes))))
        }
    }
}

/// The surface in the bytes of a file; fails between two slices once an end was asked for.
fn surface(bytes: Arc<Vec<u8>>, name: &str, options: ImportOptions) -> Result<Imported> {
    let mut reading = Running::new(|yielder| async move { read_in_slices(bytes, name, &options, &yielder).await });
    loop {
        interrupt::check()?;
        if let Progress::Done(read) = reading.advance(Budget::new(Duration::from_millis(50))) {
            return read.map_err(scan::refused).with_context(|| name.to_owned());
        }
    }
}

/// Makes a sample with so many triangles.
pub(super) fn sample(sample: Sample, triangles: usize) -> Result<Imported> {
    Ok(io::import_mesh(phantom::generate(sample, triangles)?, "sample"))
}
