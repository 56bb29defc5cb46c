//! Scans and masks, an engine of its own on a line of its own: files in, previews, slices and the surface out.
//!
//! - `message`: commands and events.
//! - `shelf`: files that the engine reads itself, a piece at a time; `opening`: files on their way to a volume.
//! - `engine` (feature `scans`): what stands behind them. The browser's first program has the messages alone: the engine is a
//!   Worker of another.

#[cfg(feature = "scans")]
mod engine;
mod message;
#[cfg(feature = "scans")]
mod opening;
#[cfg(feature = "scans")]
mod shelf;
#[cfg(all(test, feature = "scans"))]
mod tests;

#[cfg(feature = "scans")]
pub use engine::ScanEngine;
pub use message::{Contents, NamedFile, OpenedScan, ScanCommand, ScanEvent, ScanLink, ScanWork, is_progress};
#[cfg(feature = "scans")]
pub use shelf::Shelf;
