//! Scans and masks, an engine of its own on a line of its own: files in, previews, slices and the surface out.
//!
//! - `message`: commands and events.
//! - `engine` (feature `scans`): what stands behind them. The browser's first program has the messages alone: the engine is a
//!   Worker of another.

#[cfg(feature = "scans")]
mod engine;
mod message;
#[cfg(all(test, feature = "scans"))]
mod tests;

#[cfg(feature = "scans")]
pub use engine::ScanEngine;
pub use message::{NamedFile, OpenedScan, ScanCommand, ScanEvent, ScanLink, ScanWork};
