//! Surfaces: what is read, smoothed, reduced and measured, on meshes made here.

#![allow(clippy::disallowed_methods, reason = "a test compares within bounds")]

mod arrays;
mod bad_input;
mod calibre;
mod decimation;
mod fuzz;
#[cfg(feature = "gui")]
mod lessons;
mod lumen_width;
mod safe;
mod smoothing;
mod spare_thin;
mod verdict;
mod voxel_tubes;
