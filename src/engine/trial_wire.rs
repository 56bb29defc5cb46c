//! Commands and events of the trial as they pass between threads that share no memory: see [`wire`](super::wire).
//!
//! Surfaces, the wire's nodes and logs go as plain buffers; all else is in the line of JSON.

use std::sync::Arc;

use bytemuck::cast_slice;
use serde::{Deserialize, Serialize};

use super::trial::{TrialCommand, TrialComparison, TrialEvent, TrialReady};
use super::wire::{Buffers, Encoded, WireError, array, line, mesh, mesh_buffers};
use crate::phantom::Sample;
use crate::trial::frame::Frame;
use crate::trial::setup::{Input, Setup};
use crate::trial::summary::Summary;

#[derive(Serialize, Deserialize)]
enum CommandHeader {
    Start { id: u64, sample: Option<Sample>, setup: Setup },
    Drive(Input),
    Autopilot(bool),
    Pause(bool),
    Pace(f32),
    Restart { id: u64 },
    StepBack { id: u64 },
    Save,
    Replay { id: u64 },
    Compare { id: u64 },
    Measure { id: u64, sample: Option<Sample>, setup: Setup },
    Cancel { id: u64 },
    Stop,
}

#[derive(Serialize, Deserialize)]
enum EventHeader {
    Preparing { id: u64, fraction: f32 },
    Ready(Box<TrialReady>),
    Refused { id: u64, message: String, is_too_thin: bool },
    Frame { id: u64, frame: Box<Frame> },
    Felt { id: u64 },
    Ended { id: u64, summary: Box<Summary> },
    Saved,
    Compared { id: u64, comparison: Box<TrialComparison> },
    Busy { id: u64, fraction: f32 },
    Measured { id: u64, summary: Box<Summary> },
    Failed { message: String },
}

/// Whether this is the header of a frame, which the next frame makes useless.
pub fn is_frame(header: &str) -> bool {
    header.starts_with("{\"Frame\"")
}

/// A command as a message.
pub fn encode_command(command: &TrialCommand) -> Encoded<'_> {
    let (header, buffers) = match command {
        TrialCommand::Start { id, mesh, sample, setup } => {
            (CommandHeader::Start { id: *id, sample: *sample, setup: setup.clone() }, mesh_buffers(mesh))
        }
        TrialCommand::Drive(input) => (CommandHeader::Drive(*input), vec![]),
        TrialCommand::Autopilot(on) => (CommandHeader::Autopilot(*on), vec![]),
        TrialCommand::Pause(on) => (CommandHeader::Pause(*on), vec![]),
        TrialCommand::Pace(pace) => (CommandHeader::Pace(*pace), vec![]),
        TrialCommand::Restart { id } => (CommandHeader::Restart { id: *id }, vec![]),
        TrialCommand::StepBack { id } => (CommandHeader::StepBack { id: *id }, vec![]),
        TrialCommand::Save => (CommandHeader::Save, vec![]),
        TrialCommand::Replay { id, csv } => (CommandHeader::Replay { id: *id }, vec![&csv[..]]),
        TrialCommand::Compare { id, mesh } => (CommandHeader::Compare { id: *id }, mesh_buffers(mesh)),
        TrialCommand::Measure { id, mesh, sample, setup } => {
            (CommandHeader::Measure { id: *id, sample: *sample, setup: setup.clone() }, mesh_buffers(mesh))
        }
        TrialCommand::Cancel { id } => (CommandHeader::Cancel { id: *id }, vec![]),
        TrialCommand::Stop => (CommandHeader::Stop, vec![]),
    };
    (line(&header), buffers)
}

/// The command in a message.
///
/// # Errors
/// When the message is not one that [`encode_command`] makes.
pub fn decode_command(header: &str, buffers: &impl Buffers) -> Result<TrialCommand, WireError> {
    Ok(match serde_json::from_str(header)? {
        CommandHeader::Start { id, sample, setup } => {
            TrialCommand::Start { id, mesh: Arc::new(mesh(buffers)?), sample, setup }
        }
        CommandHeader::Drive(input) => TrialCommand::Drive(input),
        CommandHeader::Autopilot(on) => TrialCommand::Autopilot(on),
        CommandHeader::Pause(on) => TrialCommand::Pause(on),
        CommandHeader::Pace(pace) => TrialCommand::Pace(pace),
        CommandHeader::Restart { id } => TrialCommand::Restart { id },
        CommandHeader::StepBack { id } => TrialCommand::StepBack { id },
        CommandHeader::Save => TrialCommand::Save,
        CommandHeader::Replay { id } => TrialCommand::Replay { id, csv: Arc::new(array(buffers, 0)?) },
        CommandHeader::Compare { id } => TrialCommand::Compare { id, mesh: Arc::new(mesh(buffers)?) },
        CommandHeader::Measure { id, sample, setup } => {
            TrialCommand::Measure { id, mesh: Arc::new(mesh(buffers)?), sample, setup }
        }
        CommandHeader::Cancel { id } => TrialCommand::Cancel { id },
        CommandHeader::Stop => TrialCommand::Stop,
    })
}

/// An event as a message.
pub fn encode_event(event: &TrialEvent) -> Encoded<'_> {
    let (header, buffers) = match event {
        TrialEvent::Preparing { id, fraction } => (EventHeader::Preparing { id: *id, fraction: *fraction }, vec![]),
        TrialEvent::Ready(ready) => (EventHeader::Ready(ready.clone()), vec![]),
        TrialEvent::Refused { id, message, is_too_thin } => {
            (EventHeader::Refused { id: *id, message: message.clone(), is_too_thin: *is_too_thin }, vec![])
        }
        TrialEvent::Frame { id, frame } => {
            let mut rest = frame.clone();
            (rest.nodes, rest.forces) = Default::default();
            let buffers = vec![cast_slice(&frame.nodes), cast_slice(&frame.forces)];
            (EventHeader::Frame { id: *id, frame: rest }, buffers)
        }
        TrialEvent::Felt { id, touches } => (EventHeader::Felt { id: *id }, vec![cast_slice(touches)]),
        TrialEvent::Ended { id, summary } => (EventHeader::Ended { id: *id, summary: summary.clone() }, vec![]),
        TrialEvent::Saved { csv, json } => (EventHeader::Saved, vec![csv.as_bytes(), json.as_bytes()]),
        TrialEvent::Compared { id, comparison: compared } => {
            let mut rest = compared.clone();
            (rest.inserted_mm, rest.deviation_mm, rest.tip, rest.other_tip) = Default::default();
            rest.noise_mm = Vec::new();
            let buffers = vec![
                cast_slice(&compared.inserted_mm),
                cast_slice(&compared.deviation_mm),
                cast_slice(&compared.tip),
                cast_slice(&compared.other_tip),
                cast_slice(&compared.noise_mm),
            ];
            (EventHeader::Compared { id: *id, comparison: rest }, buffers)
        }
        TrialEvent::Busy { id, fraction } => (EventHeader::Busy { id: *id, fraction: *fraction }, vec![]),
        TrialEvent::Measured { id, summary } => (EventHeader::Measured { id: *id, summary: summary.clone() }, vec![]),
        TrialEvent::Failed { message } => (EventHeader::Failed { message: message.clone() }, vec![]),
    };
    (line(&header), buffers)
}

/// The event in a message.
///
/// # Errors
/// When the message is not one that [`encode_event`] makes.
pub fn decode_event(header: &str, buffers: &impl Buffers) -> Result<TrialEvent, WireError> {
    Ok(match serde_json::from_str(header)? {
        EventHeader::Preparing { id, fraction } => TrialEvent::Preparing { id, fraction },
        EventHeader::Ready(ready) => TrialEvent::Ready(ready),
        EventHeader::Refused { id, message, is_too_thin } => TrialEvent::Refused { id, message, is_too_thin },
        EventHeader::Frame { id, mut frame } => {
            frame.nodes = array(buffers, 0)?;
            frame.forces = array(buffers, 1)?;
            TrialEvent::Frame { id, frame }
        }
        EventHeader::Felt { id } => TrialEvent::Felt { id, touches: array(buffers, 0)? },
        EventHeader::Ended { id, summary } => TrialEvent::Ended { id, summary },
        EventHeader::Saved => TrialEvent::Saved { csv: text(buffers, 0)?, json: text(buffers, 1)? },
        EventHeader::Compared { id, mut comparison } => {
            comparison.inserted_mm = array(buffers, 0)?;
            comparison.deviation_mm = array(buffers, 1)?;
            comparison.tip = array(buffers, 2)?;
            comparison.other_tip = array(buffers, 3)?;
            comparison.noise_mm = array(buffers, 4)?;
            TrialEvent::Compared { id, comparison }
        }
        EventHeader::Busy { id, fraction } => TrialEvent::Busy { id, fraction },
        EventHeader::Measured { id, summary } => TrialEvent::Measured { id, summary },
        EventHeader::Failed { message } => TrialEvent::Failed { message },
    })
}

/// Buffer `index` as text.
fn text(buffers: &impl Buffers, index: usize) -> Result<String, WireError> {
    String::from_utf8(array(buffers, index)?).map_err(|_| WireError::Text { index })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::trial::RouteShown;
    use crate::mesh::TriMesh;
    use crate::trial::frame::{Progress, Touch};
    use crate::trial::report::{StepCounts, StepKind, StepReport};

    fn owned((header, buffers): Encoded<'_>) -> (String, Vec<Vec<u8>>) {
        (header, buffers.into_iter().map(<[u8]>::to_vec).collect())
    }

    #[test]
    fn every_command_comes_through_unchanged() {
        let mesh = Arc::new(TriMesh { positions: vec![glam::Vec3::X; 3], triangles: vec![[0, 1, 2]] });
        let setup = Setup { target: Some([1.0, 2.0, 3.5]), seed: 7, ..Setup::default() };
        let (sample, id) = (Some(Sample::Coronary), 5);
        let commands = [
            TrialCommand::Start { id, mesh: mesh.clone(), sample, setup: setup.clone() },
            TrialCommand::Drive(Input { feed: -3.5, roll: 0.25 }),
            TrialCommand::Autopilot(true),
            TrialCommand::Pause(false),
            TrialCommand::Pace(0.25),
            TrialCommand::Restart { id },
            TrialCommand::StepBack { id },
            TrialCommand::Save,
            TrialCommand::Replay { id, csv: Arc::new(b"time_s\n0\n".to_vec()) },
            TrialCommand::Compare { id, mesh: mesh.clone() },
            TrialCommand::Measure { id, mesh, sample: None, setup },
            TrialCommand::Cancel { id },
            TrialCommand::Stop,
        ];
        for command in commands {
            let (header, buffers) = owned(encode_command(&command));
            assert_eq!(decode_command(&header, &buffers).unwrap(), command);
        }
    }

    #[test]
    fn every_event_comes_through_unchanged() {
        let touch = Touch { at: [1.0, 2.0, 3.0], triangle: 9, force: 0.25 };
        let frame = Frame {
            nodes: vec![[0.1, 0.2, 0.3]; 4],
            forces: vec![[0.0, -1.0, 0.5]; 4],
            contacts: 2,
            report: StepReport { kind: StepKind::Waited, wanted_mm: 0.04, push_n: -0.1, ..StepReport::default() },
            step_kinds: StepCounts { balanced: 40, held: 2, ..StepCounts::default() },
            time_s: 0.1,
            progress: Progress::Arrived,
            doing: "feeds".to_owned(),
            ..Frame::default()
        };
        let route = RouteShown { points: vec![[1.0; 3]; 2], radii: vec![2.0; 2], ..RouteShown::default() };
        let ready = TrialReady { id: 1, route, targets: vec![("left".to_owned(), [0.0; 3])], ..TrialReady::default() };
        let comparison = TrialComparison {
            verdict: "it arrives".to_owned(),
            inserted_mm: vec![1.0, 2.0],
            deviation_mm: vec![0.0, 0.5],
            noise_mm: vec![0.1, 0.2],
            orders: [3, 2],
            tip: vec![[1.0; 3]; 2],
            other_tip: vec![[1.5; 3]; 2],
            force_differences: vec![([1.0; 3], 0.5)],
            ..TrialComparison::default()
        };
        let summary = Box::new(Summary { success: true, friction: [0.06, 0.04], ..Summary::default() });
        let message = "no way".to_owned();
        let events = [
            TrialEvent::Preparing { id: 1, fraction: 0.5 },
            TrialEvent::Ready(Box::new(ready)),
            TrialEvent::Refused { id: 1, message: message.clone(), is_too_thin: true },
            TrialEvent::Frame { id: 4, frame: Box::new(frame) },
            TrialEvent::Felt { id: 4, touches: vec![touch; 3] },
            TrialEvent::Ended { id: 4, summary: summary.clone() },
            TrialEvent::Saved { csv: "a,b\n1,2\n".to_owned(), json: "{}".to_owned() },
            TrialEvent::Compared { id: 2, comparison: Box::new(comparison) },
            TrialEvent::Busy { id: 2, fraction: 0.25 },
            TrialEvent::Measured { id: 3, summary },
            TrialEvent::Failed { message },
        ];
        for event in events {
            let (header, buffers) = owned(encode_event(&event));
            assert_eq!(is_frame(&header), matches!(event, TrialEvent::Frame { .. }));
            assert_eq!(decode_event(&header, &buffers).unwrap(), event);
        }
        assert!(decode_event("\"Saved\"", &vec![vec![0xFF], vec![]]).is_err(), "a log that is no text");
    }
}
