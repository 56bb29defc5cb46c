//! A file on its way to a surface.
//!
//! The bytes are parsed (`parsing`), then taken through the import stage, which takes longer; both in slices.

use std::mem;
use std::sync::Arc;

use super::error::ReadError;
use super::import::{FileImport, Import};
use super::parsing::{Bytes, Parsing};
use super::report::Imported;
use super::{Axes, ImportOptions};
use lumen_mesh::TriMesh;
use lumen_mesh::task::{Budget, Progress, Task};

/// Reads the surface in `bytes`. `name` is the file's name: it matters only where the content alone does not tell
/// the format, as with OBJ.
///
/// # Errors
/// [`ReadError`], each in one plain sentence: the file is empty, of another kind, cut short or broken, or holds no
/// triangle that has an area.
pub fn read(bytes: &[u8], name: &str, options: &ImportOptions) -> Result<Imported, ReadError> {
    let mut parsing = Parsing::new(Bytes::Lent(bytes), name, options)?;
    loop {
        if let Progress::Done(parsed) = parsing.advance(Budget::UNLIMITED) {
            let (raw, unit, axes) = parsed?;
            drop(parsing);
            return FileImport::new(raw, unit, axes)?.finish();
        }
    }
}

/// What a surface was made of.
struct Origin {
    format: String,
    axes: Axes,
    warnings: Vec<String>,
}

/// As [`read`], in slices.
pub struct Reading(Step);

enum Step {
    Begin {
        bytes: Arc<Vec<u8>>,
        name: String,
        options: ImportOptions,
    },
    Parse(Box<Parsing<'static>>),
    Import(Box<FileImport>),
    /// Of a surface that was made, with what is told of what it was made of.
    Made(Box<Import>, Origin),
    Done,
}

impl Reading {
    /// Of a file as for [`read`]. The bytes are let go when they are parsed.
    pub fn new(bytes: Arc<Vec<u8>>, name: String, options: ImportOptions) -> Self {
        Self(Step::Begin { bytes, name, options })
    }

    /// Of a surface that was made, as [`import_mesh`](super::import_mesh) takes it, in these axes: that never fails. The
    /// warnings on what it was made of stand before those on the surface.
    ///
    /// # Panics
    /// When an index of `mesh` is out of range.
    pub fn made(mesh: TriMesh, format: String, axes: Axes, warnings: Vec<String>) -> Self {
        Self(Step::Made(Box::new(Import::made(mesh)), Origin { format, axes, warnings }))
    }
}

impl Task for Reading {
    type Output = Result<Imported, ReadError>;

    fn advance(&mut self, budget: Budget) -> Progress<Self::Output> {
        /// The part of the time that goes by until the bytes are parsed.
        const PARSED: f32 = 0.2;
        match mem::replace(&mut self.0, Step::Done) {
            Step::Begin { bytes, name, options } => match Parsing::new(Bytes::Kept(bytes), &name, &options) {
                Ok(parsing) => {
                    self.0 = Step::Parse(Box::new(parsing));
                    Progress::Working(0.0)
                }
                Err(error) => Progress::Done(Err(error)),
            },
            Step::Parse(mut parsing) => match parsing.advance(budget) {
                Progress::Working(fraction) => {
                    self.0 = Step::Parse(parsing);
                    Progress::Working(PARSED * fraction)
                }
                Progress::Done(parsed) => {
                    drop(parsing);
                    match parsed.and_then(|(raw, unit, axes)| FileImport::new(raw, unit, axes)) {
                        Ok(import) => self.0 = Step::Import(Box::new(import)),
                        Err(error) => return Progress::Done(Err(error)),
                    }
                    Progress::Working(PARSED)
                }
            },
            Step::Import(mut import) => match import.advance(budget) {
                Progress::Working(fraction) => {
                    self.0 = Step::Import(import);
                    Progress::Working(PARSED + (1.0 - PARSED) * fraction)
                }
                Progress::Done(read) => Progress::Done(read),
            },
            Step::Made(mut import, origin) => match import.advance(budget) {
                Progress::Working(fraction) => {
                    self.0 = Step::Made(import, origin);
                    Progress::Working(fraction)
                }
                Progress::Done(mut imported) => {
                    let Origin { format, axes, warnings } = origin;
                    (imported.report.format, imported.report.axes) = (format, axes);
                    imported.report.warnings.splice(..0, warnings);
                    Progress::Done(Ok(imported))
                }
            },
            Step::Done => panic!("a file that is read is not read again"),
        }
    }
}
