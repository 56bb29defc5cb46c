//! A source on its way to a surface, in slices: the digest of a file, then the reading of it.

use std::sync::Arc;

use web_time::Instant;

use super::source::Source;
use crate::io::{Axes, ImportOptions, Imported, Reading};
use crate::phantom;
use crate::pipeline::settings::Settings;
use crate::sharing::{Digest, Digesting};
use crate::task::{Budget, Progress, Task};

/// Bytes that are digested between two looks at the clock.
const BLOCK: usize = 1 << 20;
/// The part of the time that the digest takes.
const DIGESTED: f32 = 0.2;

/// A source that is being read.
pub(super) struct Opening {
    pub(super) id: u64,
    pub(super) name: String,
    /// The settings to begin with.
    pub(super) settings: Settings,
    /// When it began.
    pub(super) since: Instant,
    /// The digest of a file, once it is known.
    pub(super) digest: Option<Digest>,
    /// Whether its numbers can be in one unit or another: those of a file.
    pub(super) has_units: bool,
    step: Step,
}

enum Step {
    Digest {
        bytes: Arc<Vec<u8>>,
        options: ImportOptions,
        digesting: Box<Digesting>,
        done: usize,
    },
    Read(Reading),
    /// Why there is nothing to read.
    Failed(String),
}

impl Opening {
    pub(super) fn new(id: u64, source: Source, settings: Settings) -> Self {
        let has_units = matches!(source, Source::File { .. });
        let (since, name) = (Instant::now(), source.name().to_owned());
        let step = match source {
            Source::File { bytes, options, .. } => Step::Digest { bytes, options, digesting: Box::default(), done: 0 },
            Source::Made { format, mesh, axes, warnings, .. } => {
                Step::Read(Reading::made(Arc::unwrap_or_clone(mesh), format, axes, warnings))
            }
            Source::Sample { sample, triangles } => match phantom::generate(sample, triangles as usize) {
                Ok(mesh) => Step::Read(Reading::made(mesh, "sample".to_owned(), Axes::Lps, Vec::new())),
                Err(error) => Step::Failed(error.to_string()),
            },
        };
        Self { id, name, settings, since, digest: None, has_units, step }
    }
}

impl Task for Opening {
    type Output = Result<Imported, String>;

    fn advance(&mut self, budget: Budget) -> Progress<Self::Output> {
        match &mut self.step {
            Step::Digest { bytes, options, digesting, done } => {
                while *done < bytes.len() {
                    let end = bytes.len().min(*done + BLOCK);
                    digesting.add(&bytes[*done..end]);
                    *done = end;
                    if budget.is_spent() {
                        return Progress::Working(DIGESTED * *done as f32 / bytes.len() as f32);
                    }
                }
                self.digest = Some(std::mem::take(&mut **digesting).digest());
                // Of two owners of the bytes only one is left, which lets them go once they are parsed.
                self.step = Step::Read(Reading::new(std::mem::take(bytes), self.name.clone(), *options));
                Progress::Working(DIGESTED)
            }
            Step::Read(reading) => match reading.advance(budget) {
                Progress::Working(fraction) if self.digest.is_some() => {
                    Progress::Working(DIGESTED + (1.0 - DIGESTED) * fraction)
                }
                Progress::Working(fraction) => Progress::Working(fraction),
                Progress::Done(read) => Progress::Done(read.map_err(|error| error.to_string())),
            },
            Step::Failed(message) => Progress::Done(Err(std::mem::take(message))),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::super::message::{Command, Event, Work};
    use super::super::pipeline_engine::Engine;
    use super::*;
    use crate::io::{Format, write};
    use crate::mesh::Vec3;
    use crate::mesh::shapes::icosphere;

    #[test]
    fn a_file_is_told_while_it_is_parsed_and_let_go_when_that_is_cancelled() {
        let sphere = icosphere(6, 20.0, Vec3::ZERO);
        for format in [Format::Stl, Format::Vtp, Format::Vtk, Format::Glb] {
            let bytes = Arc::new(write(&sphere, None, format).unwrap());
            let source = Source::File { name: "a".to_owned(), bytes: bytes.clone(), options: ImportOptions::default() };
            let mut engine = Engine::new();
            engine.handle(Command::Open { id: 1, source, settings: Settings::default() });
            let mut told = 0.0;
            // Parsing follows the digest, and is a fifth of the rest.
            while told <= DIGESTED {
                assert!(engine.advance(Duration::ZERO));
                while let Some(event) = engine.poll() {
                    let Event::Progress { work: Work::Reading, fraction } = event else { panic!("nothing is open") };
                    assert!(fraction >= told, "{format:?}");
                    told = fraction;
                }
            }
            assert!(told < DIGESTED + 0.2 * (1.0 - DIGESTED), "{format:?} is still parsed: {told}");
            engine.handle(Command::Cancel);
            assert!(!engine.advance(Duration::ZERO) && engine.poll().is_none());
            assert_eq!(Arc::strong_count(&bytes), 1, "{format:?}");
        }
    }
}
