//! Commands and events as they pass between threads that share no memory: one line of JSON, and the arrays beside
//! it as plain little-endian buffers. Sending costs one bulk copy out of an array, receiving one into a new one.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable, cast_slice, cast_slice_mut};
use serde::{Deserialize, Serialize};

use super::message::{Command, Compared, Event, Opened, Reduced, Source, Work};
use crate::io::{Format, ImportOptions, ImportReport};
use crate::mesh::TriMesh;
use crate::phantom::Sample;
use crate::pipeline::connectivity::Component;
use crate::pipeline::progressive::{Limit, ProgressiveMesh};
use crate::pipeline::report::Report;
use crate::pipeline::settings::{Keep, Settings};

/// A message that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum WireError {
    /// The line is not one of ours.
    #[error("the message is not understood: {0}")]
    Header(#[from] serde_json::Error),
    /// A buffer is missing or has no whole number of elements.
    #[error("buffer {index} of the message has {bytes:?} bytes, not a multiple of {element}")]
    Buffer {
        /// Which.
        index: usize,
        /// Its length, if it is there.
        bytes: Option<usize>,
        /// Bytes of an element.
        element: usize,
    },
    /// There is no memory for a buffer.
    #[error("there is no memory left for its {bytes} bytes")]
    Memory {
        /// Its length.
        bytes: usize,
    },
    /// A buffer that should be text is not UTF-8.
    #[error("buffer {index} of the message is no text")]
    Text {
        /// Which.
        index: usize,
    },
}

/// The buffers that came with a message.
pub trait Buffers {
    /// Length of buffer `index` in bytes; `None` where there is none.
    fn len(&self, index: usize) -> Option<usize>;

    /// Copies buffer `index` into `target`, which has its length.
    fn copy(&self, index: usize, target: &mut [u8]);
}

impl Buffers for Vec<Vec<u8>> {
    fn len(&self, index: usize) -> Option<usize> {
        self.get(index).map(Vec::len)
    }

    fn copy(&self, index: usize, target: &mut [u8]) {
        target.copy_from_slice(&self[index]);
    }
}

/// A message on its way out: the line, and the arrays to be copied.
pub type Encoded<'a> = (String, Vec<&'a [u8]>);

#[derive(Serialize, Deserialize)]
enum CommandHeader {
    OpenFile { id: u64, name: String, options: ImportOptions, settings: Settings },
    OpenSample { id: u64, sample: Sample, triangles: u32, settings: Settings },
    Set { generation: u64, settings: Settings },
    Compare { id: u64, settings: Vec<Settings> },
    Cancel,
    Write { name: String, format: Format },
}

#[derive(Serialize, Deserialize)]
enum EventHeader {
    Opened { id: u64, name: String, report: Box<ImportReport> },
    OpenFailed { id: u64, name: String, message: String },
    Pieces { components: Vec<Component> },
    Progress { work: Work, fraction: f32 },
    Reduced { generation: u64, keep: Keep, limit: Limit },
    Measured { generation: u64, complete: bool, report: Box<Report> },
    Cancelled { generation: u64, settings: Settings },
    Compared { id: u64, index: u32, report: Box<Report> },
    NotCompared { id: u64, index: u32, message: String },
    Written { name: String },
    NotWritten { name: String, message: String },
    Failed { message: String },
}

/// A command as a message.
pub fn encode_command(command: &Command) -> Encoded<'_> {
    let (header, buffers) = match command {
        Command::Open { id, source, settings } => {
            let settings = settings.clone();
            match source {
                Source::File { name, bytes, options } => {
                    let header = CommandHeader::OpenFile { id: *id, name: name.clone(), options: *options, settings };
                    (header, vec![&bytes[..]])
                }
                Source::Sample { sample, triangles } => {
                    let header =
                        CommandHeader::OpenSample { id: *id, sample: *sample, triangles: *triangles, settings };
                    (header, vec![])
                }
            }
        }
        Command::Set { generation, settings } => {
            (CommandHeader::Set { generation: *generation, settings: settings.clone() }, vec![])
        }
        Command::Compare { id, settings } => (CommandHeader::Compare { id: *id, settings: settings.clone() }, vec![]),
        Command::Cancel => (CommandHeader::Cancel, vec![]),
        Command::Write { name, format, mesh } => {
            (CommandHeader::Write { name: name.clone(), format: *format }, mesh_buffers(mesh))
        }
    };
    (line(&header), buffers)
}

/// The command in a message.
///
/// # Errors
/// When the message is not one that [`encode_command`] makes.
pub fn decode_command(header: &str, buffers: &impl Buffers) -> Result<Command, WireError> {
    Ok(match serde_json::from_str(header)? {
        CommandHeader::OpenFile { id, name, options, settings } => {
            let source = Source::File { name, bytes: Arc::new(array(buffers, 0)?), options };
            Command::Open { id, source, settings }
        }
        CommandHeader::OpenSample { id, sample, triangles, settings } => {
            Command::Open { id, source: Source::Sample { sample, triangles }, settings }
        }
        CommandHeader::Set { generation, settings } => Command::Set { generation, settings },
        CommandHeader::Compare { id, settings } => Command::Compare { id, settings },
        CommandHeader::Cancel => Command::Cancel,
        CommandHeader::Write { name, format } => Command::Write { name, format, mesh: mesh(buffers)? },
    })
}

/// An event as a message.
pub fn encode_event(event: &Event) -> Encoded<'_> {
    let (header, buffers) = match event {
        Event::Opened(opened) => {
            let Opened { id, name, report, mesh } = &**opened;
            let header = EventHeader::Opened { id: *id, name: name.clone(), report: Box::new(report.clone()) };
            (header, mesh_buffers(mesh))
        }
        Event::OpenFailed { id, name, message } => {
            (EventHeader::OpenFailed { id: *id, name: name.clone(), message: message.clone() }, vec![])
        }
        Event::Pieces { labels, components } => {
            (EventHeader::Pieces { components: components.clone() }, vec![cast_slice(labels)])
        }
        Event::Progress { work, fraction } => (EventHeader::Progress { work: *work, fraction: *fraction }, vec![]),
        Event::Reduced(reduced) => {
            let Reduced { generation, keep, mesh } = &**reduced;
            let buffers = vec![
                cast_slice(&mesh.positions),
                cast_slice(&mesh.parents),
                cast_slice(&mesh.node_ends),
                cast_slice(&mesh.triangles),
                cast_slice(&mesh.triangle_ends),
                cast_slice(&mesh.errors),
            ];
            (EventHeader::Reduced { generation: *generation, keep: *keep, limit: mesh.limit }, buffers)
        }
        Event::Measured { generation, complete, report, deviation } => {
            let header = EventHeader::Measured { generation: *generation, complete: *complete, report: report.clone() };
            (header, vec![cast_slice(deviation)])
        }
        Event::Cancelled { generation, settings } => {
            (EventHeader::Cancelled { generation: *generation, settings: settings.clone() }, vec![])
        }
        Event::Compared(compared) => {
            let Compared { id, index, report, mesh } = &**compared;
            let header = EventHeader::Compared { id: *id, index: *index, report: Box::new(report.clone()) };
            (header, mesh_buffers(mesh))
        }
        Event::NotCompared { id, index, message } => {
            (EventHeader::NotCompared { id: *id, index: *index, message: message.clone() }, vec![])
        }
        Event::Written { name, bytes } => (EventHeader::Written { name: name.clone() }, vec![&bytes[..]]),
        Event::NotWritten { name, message } => {
            (EventHeader::NotWritten { name: name.clone(), message: message.clone() }, vec![])
        }
        Event::Failed { message } => (EventHeader::Failed { message: message.clone() }, vec![]),
    };
    (line(&header), buffers)
}

/// The event in a message.
///
/// # Errors
/// When the message is not one that [`encode_event`] makes.
pub fn decode_event(header: &str, buffers: &impl Buffers) -> Result<Event, WireError> {
    Ok(match serde_json::from_str(header)? {
        EventHeader::Opened { id, name, report } => {
            Event::Opened(Box::new(Opened { id, name, report: *report, mesh: Arc::new(mesh(buffers)?) }))
        }
        EventHeader::OpenFailed { id, name, message } => Event::OpenFailed { id, name, message },
        EventHeader::Pieces { components } => Event::Pieces { labels: array(buffers, 0)?, components },
        EventHeader::Progress { work, fraction } => Event::Progress { work, fraction },
        EventHeader::Reduced { generation, keep, limit } => {
            let mesh = Arc::new(ProgressiveMesh {
                positions: array(buffers, 0)?,
                parents: array(buffers, 1)?,
                node_ends: array(buffers, 2)?,
                triangles: array(buffers, 3)?,
                triangle_ends: array(buffers, 4)?,
                errors: array(buffers, 5)?,
                limit,
            });
            Event::Reduced(Box::new(Reduced { generation, keep, mesh }))
        }
        EventHeader::Measured { generation, complete, report } => {
            Event::Measured { generation, complete, report, deviation: array(buffers, 0)? }
        }
        EventHeader::Cancelled { generation, settings } => Event::Cancelled { generation, settings },
        EventHeader::Compared { id, index, report } => {
            Event::Compared(Box::new(Compared { id, index, report: *report, mesh: Arc::new(mesh(buffers)?) }))
        }
        EventHeader::NotCompared { id, index, message } => Event::NotCompared { id, index, message },
        EventHeader::Written { name } => Event::Written { name, bytes: array(buffers, 0)? },
        EventHeader::NotWritten { name, message } => Event::NotWritten { name, message },
        EventHeader::Failed { message } => Event::Failed { message },
    })
}

pub(super) fn line(header: &impl Serialize) -> String {
    serde_json::to_string(header).expect("headers are plain data with string keys")
}

pub(super) fn mesh_buffers(mesh: &TriMesh) -> Vec<&[u8]> {
    vec![cast_slice(&mesh.positions), cast_slice(&mesh.triangles)]
}

pub(super) fn mesh(buffers: &impl Buffers) -> Result<TriMesh, WireError> {
    Ok(TriMesh { positions: array(buffers, 0)?, triangles: array(buffers, 1)? })
}

/// Buffer `index` as an array.
pub(super) fn array<T: Pod + Zeroable>(buffers: &impl Buffers, index: usize) -> Result<Vec<T>, WireError> {
    let element = size_of::<T>();
    let bytes = buffers.len(index);
    match bytes {
        Some(length) if length.is_multiple_of(element) => {
            let mut values = Vec::new();
            values.try_reserve_exact(length / element).map_err(|_| WireError::Memory { bytes: length })?;
            values.resize(length / element, T::zeroed());
            buffers.copy(index, cast_slice_mut(&mut values));
            Ok(values)
        }
        _ => Err(WireError::Buffer { index, bytes, element }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::Engine;
    use std::time::Duration;

    fn owned((header, buffers): Encoded<'_>) -> (String, Vec<Vec<u8>>) {
        (header, buffers.into_iter().map(<[u8]>::to_vec).collect())
    }

    /// A buffer of any length that takes no memory.
    struct Claim(usize);

    impl Buffers for Claim {
        fn len(&self, _: usize) -> Option<usize> {
            Some(self.0)
        }

        fn copy(&self, _: usize, _: &mut [u8]) {
            unreachable!("there is no memory to copy into");
        }
    }

    #[test]
    fn a_buffer_that_no_memory_can_hold_is_an_error() {
        let bytes = isize::MAX as usize / 8 * 4;
        let read = array::<u32>(&Claim(bytes), 0);
        assert!(matches!(read, Err(WireError::Memory { bytes: claimed }) if claimed == bytes), "{read:?}");
    }

    #[test]
    fn every_event_of_a_run_and_every_command_comes_through_unchanged() {
        let mut engine = Engine::new();
        let stl = {
            let sample = crate::phantom::generate(Sample::Aorta, 10_000).unwrap();
            Arc::new(crate::io::write(&sample, None, Format::Stl).unwrap())
        };
        let mesh = TriMesh { positions: vec![glam::Vec3::X; 3], triangles: vec![[0, 1, 2]] };
        let source = Source::File { name: "a.stl".into(), bytes: stl, options: ImportOptions::default() };
        let bad = Source::File { name: "b.stl".into(), bytes: Arc::new(vec![0; 3]), options: ImportOptions::default() };
        let settings = Settings::default();
        let impossible = Settings { keep: Keep::Component(10_000), ..Settings::default() };
        let commands = [
            Command::Open { id: 1, source, settings: settings.clone() },
            Command::Open { id: 2, source: bad, settings: settings.clone() },
            Command::Write { name: "c.stl".into(), format: Format::Stl, mesh },
            Command::Set { generation: 3, settings: settings.clone() },
            Command::Compare { id: 4, settings: vec![settings.clone(), impossible] },
            Command::Cancel,
            Command::Open { id: 5, source: Source::sample(Sample::Coronary), settings },
        ];
        let mut kinds = std::collections::BTreeSet::new();
        for command in commands {
            let (header, buffers) = owned(encode_command(&command));
            assert_eq!(decode_command(&header, &buffers).unwrap(), command);
            if matches!(command, Command::Open { id: 5, .. }) {
                break;
            }
            engine.handle(command);
            while engine.advance(Duration::from_millis(1)) {}
            while let Some(event) = engine.poll() {
                let (header, buffers) = owned(encode_event(&event));
                kinds.insert(header.split('"').nth(1).unwrap_or_default().to_owned());
                assert_eq!(decode_event(&header, &buffers).unwrap(), event);
            }
        }
        let expected = [
            "Cancelled",
            "Compared",
            "Measured",
            "NotCompared",
            "OpenFailed",
            "Opened",
            "Pieces",
            "Reduced",
            "Written",
        ];
        assert!(expected.iter().all(|kind| kinds.contains(*kind)), "{kinds:?}");
    }

    #[test]
    fn messages_of_others_are_refused() {
        assert!(decode_event("{}", &Vec::new()).is_err());
        assert!(decode_command("\"Cancel", &Vec::new()).is_err());
        let pieces = r#"{"Pieces":{"components":[]}}"#;
        assert!(matches!(decode_event(pieces, &Vec::new()), Err(WireError::Buffer { index: 0, bytes: None, .. })));
        assert!(matches!(decode_event(pieces, &vec![vec![1u8; 7]]), Err(WireError::Buffer { bytes: Some(7), .. })));
    }
}
