//! A source on its way to a surface, in slices: the digest of a file, then the reading of it.

use std::sync::Arc;

use web_time::Instant;

use super::source::Source;
use crate::io::{Axes, Imported, import_made, read_in_slices};
use crate::language::tell;
use crate::phantom;
use crate::pipeline::settings::Settings;
use crate::sharing::{Digest, Digesting};
use crate::task::{Budget, Progress, Running, Yielder, blocks};

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
    /// Whether its numbers can be in one unit or another: those of a file.
    pub(super) has_units: bool,
    reading: Running<'static, Result<Read, String>>,
}

/// What was read.
pub(super) struct Read {
    pub(super) imported: Imported,
    /// The digest of a file.
    pub(super) digest: Option<Digest>,
}

impl Opening {
    pub(super) fn new(id: u64, source: Source, settings: Settings) -> Self {
        let has_units = matches!(source, Source::File { .. });
        let (since, name) = (Instant::now(), source.name().to_owned());
        let of_file = name.clone();
        let reading = Running::new(|yielder| async move { read(source, &of_file, &yielder).await });
        Self { id, name, settings, since, has_units, reading }
    }

    /// Reads on until `budget` is spent or the source is read.
    pub(super) fn advance(&mut self, budget: Budget) -> Progress<Result<Read, String>> {
        self.reading.advance(budget)
    }
}

pub(super) async fn read(source: Source, name: &str, yielder: &Yielder) -> Result<Read, String> {
    let (mesh, format, axes, warnings, threshold) = match source {
        Source::File { bytes, options, .. } => {
            let mut digesting = Digesting::default();
            for block in blocks(bytes.len(), BLOCK) {
                let end = block.end;
                digesting.add(&bytes[block]);
                yielder.rest(DIGESTED * end as f32 / bytes.len() as f32).await;
            }
            let digest = Some(digesting.digest());
            yielder.rest(DIGESTED).await;
            // Of two owners of the bytes only one is left, which lets them go once they are parsed.
            let read = read_in_slices(bytes, name, &options, &yielder.part(DIGESTED..1.0)).await;
            return read.map(|imported| Read { imported, digest }).map_err(|error| tell(&error));
        }
        Source::Made { format, mesh, axes, warnings, threshold, .. } => {
            (Arc::unwrap_or_clone(mesh), format, axes, warnings, threshold)
        }
        Source::Sample { sample, triangles } => {
            let mesh = phantom::generate(sample, triangles as usize).map_err(|error| tell(&error))?;
            (mesh, "sample".to_owned(), Axes::Lps, Vec::new(), None)
        }
    };
    let mut imported = import_made(mesh, format, axes, warnings, yielder).await;
    imported.report.threshold = threshold;
    Ok(Read { imported, digest: None })
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::super::message::{Command, Event, Work};
    use super::super::pipeline_engine::Engine;
    use super::*;
    use crate::io::{Format, ImportOptions, write};
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
