//! The work that must not block a frame: commands in, events out.
//!
//! [`Engine`] holds one opened surface and its pipeline. Whoever runs it (a thread on the desktop, a dedicated Worker in the
//! browser) hands it each [`Command`] as it comes, calls [`Engine::advance`] with slices of about 10 ms while there is work,
//! and passes on the [`Event`]s. [`Link`] is the app's end of that line; what passes along it derives all that it needs to
//! cross between threads that share no memory ([`transfer`](crate::transfer)).
//!
//! - `message`: commands and events, with `source`, where a surface comes from, and `found`, what is found out about it;
//!   `surfaces`: how the surfaces in them cross; `link`: the line.
//! - `pipeline_engine`: what is asked, in its order; `current`: the surface that is open; `opening`: a source on its way
//!   in; `compare`: settings to compare ([`Command::Compare`]), which are worked on while nothing else is to be done;
//!   `differing`: how far two of them are apart; `beside`: a surface beside another file; `preparing`: a level made ready for a solver; `averaging`: plain Laplacian smoothing, to be seen beside the filter;
//!   `progress`: how far all this is.
//! - [`trial`]: the guidewire trial, an engine of its own on a line of its own. It keeps pace with the clock.
//! - [`scan`]: scans and masks, an engine of its own as well; the surface that it makes is opened as [`Source::Made`].
//! - [`Machine`]: what they are to whoever runs them.

mod arrays;
mod averaging;
mod beside;
mod compare;
mod current;
mod differing;
mod found;
mod link;
mod machine;
mod message;
mod opening;
mod pipeline_engine;
mod preparing;
mod progress;
mod record;
pub mod scan;
mod source;
mod surfaces;
pub mod trial;

/// An engine with a small sample on its way in, for tests of what is asked of it beside the pipeline.
#[cfg(test)]
fn with_sample() -> Engine {
    let mut engine = Engine::new();
    let source = Source::Sample { sample: crate::phantom::Sample::Aorta, triangles: 10_000 };
    engine.handle(Command::Open { id: 1, source, settings: crate::pipeline::settings::Settings::default() });
    engine
}

pub use self::current::PATIENCE;
pub use self::found::{
    Averaged, Calibre, Compared, CutEnd, CutPlane, CutsPlanned, Deviated, Differed, FaultsFound, FilesCompared,
    LevelArrays, Opened, Over, PlannedCuts, Ready, Reduced, SolverReady, TwoFiles,
};
pub use self::link::Link;
pub use self::machine::{Machine, SLICE};
pub use self::message::{Command, Event, Frame, Judged, Work};
pub use self::pipeline_engine::Engine;
pub use self::record::PAUSE_MS;
pub use self::source::Source;
pub use self::trial::TrialEngine;
