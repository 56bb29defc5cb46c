//! What passes between a bench in Node and a Worker of dist/, whose messages are `postcard`'s: reads a line of JSON, answers
//! with one. `benches/worker.mjs` starts it.
//!
//! - `{"open": ID, "name": FILE, "settings": {}}`, `{"set": ID, "settings": {}}`, `{"start": ID, "setup": {}}` (the coronary
//!   sample) and `{"replay": ID}` are answered with `{"head": [BYTES]}`; who sends the message adds its arrays.
//! - `{"job": "pipeline" or "trial", "head": [BYTES], "lengths": [BYTES OF EACH ARRAY]}`, a message of the Worker's, is answered
//!   with what a bench asks of it: `{"generation": N, "report": {}}`, `{"failed": SENTENCE}`, `{"ready": true}`,
//!   `{"step": N, "steps_per_second": N}`, `{"summary": {}}`, or `{}`.

use std::error::Error;
use std::io::{BufRead as _, Write as _};
use std::sync::Arc;

use serde::Deserialize;
use serde_json::{Value, json};

use lumen::engine::trial::{TrialCommand, TrialEvent};
use lumen::engine::{Command, Event, Source};
use lumen::io::ImportOptions;
use lumen::mesh::TriMesh;
use lumen::phantom::Sample;
use lumen::pipeline::settings::Settings;
use lumen::transfer::{Buffers, Message, decode, encode};
use lumen::trial::setup::Setup;

#[derive(Deserialize)]
#[serde(untagged)]
enum Question {
    Open { open: u64, name: String, settings: Settings },
    Set { set: u64, settings: Settings },
    Start { start: u64, setup: Setup },
    Replay { replay: u64 },
    Heard { job: Job, head: Vec<u8>, lengths: Vec<usize> },
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Job {
    Pipeline,
    Trial,
}

/// Arrays of these lengths in bytes, all nought: no bench looks into them.
struct Lengths(Vec<usize>);

impl Buffers for Lengths {
    fn len(&self, index: usize) -> Option<usize> {
        self.0.get(index).copied()
    }

    fn copy(&self, _: usize, _: &mut [u8]) {}
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut out = std::io::stdout();
    for line in std::io::stdin().lock().lines() {
        writeln!(out, "{}", answer(serde_json::from_str(&line?)?)?)?;
        out.flush()?;
    }
    Ok(())
}

fn answer(question: Question) -> Result<Value, Box<dyn Error>> {
    Ok(match question {
        Question::Open { open: id, name, settings } => {
            let source = Source::File { name, bytes: Arc::default(), options: ImportOptions::default() };
            head(&Command::Open { id, source, settings })
        }
        Question::Set { set: generation, settings } => head(&Command::Set { generation, settings }),
        Question::Start { start: id, setup } => {
            let mesh = Arc::new(TriMesh::default());
            head(&TrialCommand::Start { id, mesh, sample: Some(Sample::Coronary), setup })
        }
        Question::Replay { replay: id } => head(&TrialCommand::Replay { id, csv: Arc::default() }),
        Question::Heard { job: Job::Pipeline, head, lengths } => match decode(&head, Lengths(lengths))? {
            Event::Measured { generation, report, .. } => json!({ "generation": generation, "report": report }),
            Event::Failed { message } | Event::OpenFailed { message, .. } => json!({ "failed": message }),
            _ => json!({}),
        },
        Question::Heard { job: Job::Trial, head, lengths } => match decode(&head, Lengths(lengths))? {
            TrialEvent::Ready(_) => json!({ "ready": true }),
            TrialEvent::Frame { frame, .. } => {
                json!({ "step": frame.step, "steps_per_second": frame.steps_per_second })
            }
            TrialEvent::Ended { summary, .. } => json!({ "summary": summary }),
            TrialEvent::Refused { message, .. } | TrialEvent::Failed { message, .. } => json!({ "failed": message }),
            _ => json!({}),
        },
    })
}

/// The head of a message: its arrays come after it, in turn.
fn head(message: &impl Message) -> Value {
    let Ok((head, _)) = encode(message, |_| Ok::<_, std::convert::Infallible>(()));
    json!({ "head": head })
}
