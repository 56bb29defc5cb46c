//! What is counted, as a WebAssembly module: `main.rs` calls `begin` for each of the cases, then `advance` until nothing
//! is left, and counts the instructions of each call.

#![cfg(target_arch = "wasm32")]

use std::cell::RefCell;
use std::sync::Arc;

use lumen_io::{Format, ImportOptions, read, write};
use lumen_mesh::TriMesh;
use lumen_mesh::task::Budget;
use lumen_pipeline::run::{Advance, Pipeline};
use lumen_pipeline::settings::{Decimation, Method, Settings, Target};
use lumen_trial::course::Course;
use lumen_trial::session::Trial;
use lumen_trial::setup::Setup;
use lumen_vessel::phantom::{Sample, generate};
use wasm_bindgen::prelude::wasm_bindgen;

/// Triangles of the samples: as few as have all of their vessels.
const TRIANGLES: usize = 10_000;
/// Steps of the trial that are counted.
const STEPS: usize = 100;

/// What is left to do of a case.
enum Work {
    Read(Vec<u8>),
    Stages(Box<Pipeline>),
    Course(Arc<TriMesh>),
    Trial(Box<Trial>),
    Nothing,
}

thread_local! {
    static WORK: RefCell<Work> = const { RefCell::new(Work::Nothing) };
    static NAME: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Begins the case of this number, and says whether there is one.
#[wasm_bindgen]
pub fn begin(case: u32) -> bool {
    let aorta = || generate(Sample::Aorta, TRIANGLES).expect("a size in range");
    let coronary = || generate(Sample::Coronary, TRIANGLES).expect("a size in range");
    let work = match case {
        0 => Work::Read(write(&aorta(), None, Format::Stl).expect("a surface")),
        1 => stages(aorta(), Method::Schroeder),
        2 => stages(coronary(), Method::Quadric),
        3 => Work::Course(Arc::new(coronary())),
        _ => return false,
    };
    WORK.set(work);
    true
}

fn stages(mesh: TriMesh, method: Method) -> Work {
    let decimation = Decimation { method, ..Decimation::default() };
    let settings = Settings { decimation, target: Target::Auto, ..Settings::default() };
    Work::Stages(Box::new(Pipeline::new(Arc::new(mesh), settings).with_certificate().with_safe()))
}

/// Does the next part of the case, and says how many bytes its name has: none once nothing is left.
#[wasm_bindgen]
pub fn advance() -> usize {
    let (name, left) = match WORK.replace(Work::Nothing) {
        Work::Read(bytes) => {
            read(&bytes, "aorta.stl", &ImportOptions::default()).expect("what was just written");
            ("Reading".to_owned(), Work::Nothing)
        }
        Work::Stages(mut pipeline) => match pipeline.advance(Budget::UNLIMITED).expect("settings in range") {
            Advance::Finished(stage) => {
                (format!("{stage:?} {:?}", pipeline.settings().decimation.method), Work::Stages(pipeline))
            }
            _ => (String::new(), Work::Nothing),
        },
        Work::Course(mesh) => {
            let mut setup = Setup::default();
            let course = Course::new(&mesh, Some(Sample::Coronary), &mut setup).expect("a way");
            let mut trial = Trial::new(Arc::new(course), setup).expect("room");
            trial.set_autopilot(true);
            ("Course".to_owned(), Work::Trial(Box::new(trial)))
        }
        Work::Trial(mut trial) => {
            (0..STEPS).for_each(|_| trial.step());
            ("Trial".to_owned(), Work::Nothing)
        }
        Work::Nothing => (String::new(), Work::Nothing),
    };
    WORK.set(left);
    let bytes = name.len();
    NAME.set(name);
    bytes
}

/// A byte of the name of what [`advance`] did.
#[wasm_bindgen]
pub fn letter(at: usize) -> u8 {
    NAME.with_borrow(|name| name.as_bytes()[at])
}
