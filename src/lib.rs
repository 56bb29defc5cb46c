//! Lumen opens a blood-vessel surface, keeps its largest connected piece, smooths it and reduces it to a
//! progressive mesh.
//!
//! A module knows only the modules below it:
//!
//! ```text
//! parallel < mesh < volume < io, phantom, vessel < pipeline < sharing < report, trial < engine < app < desktop, web
//! task < mesh < render < app
//! transfer < trial
//! haptics, transfer < engine < web/worker < web/scan, web
//! engine < cli, desktop < main
//! ```
//!
//! - [`mesh`]: the surface itself: triangles, topology, measures, nearest point.
//! - [`parallel`]: work on all cores, whatever the number of them with the same result.
//! - [`haptics`]: HID reports to axes and forces, and back; it knows no transport and no mesh.
//! - [`volume`]: scans and masks: a grid in the patient's coordinates, and the surface at a threshold by marching cubes.
//! - [`io`]: bytes to mesh or volume and back, one file a format, with a report of what was mended.
//! - [`phantom`]: vessel trees that Lumen makes itself, cut from a voxel mask by marching cubes.
//! - [`vessel`]: the tree in a surface: balls, branches, centrelines, calibres.
//! - [`pipeline`]: connectivity, windowed-sinc smoothing, normals, decimation, the progressive mesh, deviation.
//! - [`sharing`]: what another person needs to see the same: settings as a file, in a link, and a file's hash.
//! - [`report`]: a page for the record, as PDF and as a web page; pictures as PNG.
//! - [`trial`]: the guidewire: rod, contact, route, autopilot, log.
//! - [`engine`]: the pipeline as work that never blocks a frame: commands in, events out.
//! - `render`: what wgpu draws (feature `gui`); it knows `mesh` alone.
//! - `app`: the window's content, the same on the desktop and in the browser (feature `gui`).
//! - `desktop`: what the desktop gives the app: files and threads (feature `gui`).
//! - [`language`]: what Lumen says, in English, German and French; everything that speaks to a user knows it.
//! - [`task`]: long work in slices.
//! - [`transfer`]: messages between threads that share no memory; it knows nothing of what is in them.
//! - `chance`: numbers that a seed decides.
//! - `cli`: the subcommands; the figures among them and the pictures of a report are `app`'s, drawn off screen.

#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test compares within bounds"))]

#[cfg(feature = "gui")]
#[allow(clippy::disallowed_methods, reason = "what it computes ends on the screen")]
pub mod app;
#[cfg(not(target_arch = "wasm32"))]
pub mod cli;
#[cfg(all(feature = "gui", not(target_arch = "wasm32")))]
#[allow(clippy::disallowed_methods, reason = "what it computes ends on the screen")]
pub mod desktop;
pub mod engine;
pub mod report;
pub mod sharing;
#[cfg(all(test, feature = "languages"))]
mod translations;

pub use lumen_haptics as haptics;
pub use lumen_io as io;
pub use lumen_language as language;
pub use lumen_language::say;
pub use lumen_mesh as mesh;
pub use lumen_mesh::{parallel, task};
pub use lumen_pipeline as pipeline;
pub use lumen_prepare as prepare;
#[cfg(feature = "gui")]
pub use lumen_render as render;
pub use lumen_transfer as transfer;
pub use lumen_trial as trial;
pub use lumen_vessel as vessel;
pub use lumen_vessel::phantom;
pub use lumen_volume as volume;

/// What most programs need: `use lumen::prelude::*;`.
///
/// ```
/// use std::sync::Arc;
///
/// use lumen::prelude::*;
///
/// let aorta = lumen::phantom::generate(Sample::Aorta, 5_000)?;
/// let settings = Settings { target: Target::Reduction(900), ..Settings::default() };
/// let mut pipeline = Pipeline::new(Arc::new(aorta), settings).without_measures();
/// pipeline.finish()?;
/// let entering = pipeline.smoothed().unwrap().mesh.triangles.len();
/// let reduced = pipeline.reduced().unwrap().mesh.triangles.len();
/// assert!(reduced.abs_diff(Target::Reduction(900).triangles(entering)) <= 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub mod prelude {
    pub use lumen_io::{Format, ImportOptions, Imported, Unit};
    pub use lumen_mesh::{Topology, TriMesh, Vec3};
    pub use lumen_pipeline::run::Pipeline;
    pub use lumen_pipeline::settings::{Keep, Settings, Smoothing, Target};
    pub use lumen_trial::course::Course;
    pub use lumen_trial::session::Trial;
    pub use lumen_trial::setup::Setup;
    pub use lumen_vessel::phantom::Sample;
}

/// What README.md shows compiles, and runs.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
