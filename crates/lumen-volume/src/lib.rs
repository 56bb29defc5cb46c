#![doc = include_str!("../README.md")]
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "a test compares within bounds"))]

mod connected;
mod cube_cases;
mod error;
mod geometry;
mod grid;
mod half_way;
mod marching_cubes;
mod reduced;
mod samples;
mod selection;
mod sensitivity;
mod slice;
mod surface;
mod surface_nets;
mod survey;
mod window;

pub use error::{Known, VolumeError};
pub use geometry::{Geometry, GeometryError, Region};
pub use grid::Grid;
pub use half_way::{HalfWay, half_way};
pub use marching_cubes::{MarchingCubes, Mask};
pub use reduced::{PREVIEW_POINTS, preview_step, reduced_in_slices};
pub use samples::{SampleType, Samples};
pub use selection::{NamedThreshold, PRESETS, Preset, PresetName, Presets, Selection};
pub use sensitivity::{shift_mm, shifts_mm};
pub use slice::{Axis, Slice, slice};
pub use surface::{Cut, MAX_TRIANGLES, Method, region_of, surface, surface_in_slices};
pub use surface_nets::{LabelledSurface, Relaxation, surface_nets, surface_nets_in_slices};
pub use survey::{BINS, Label, Survey, survey, survey_in_slices};
pub use window::{WINDOWS, Window, WindowName};

/// What translations need of the messages of this crate.
pub const MESSAGES: &[&[lumen_message::Signature]] = &[
    GeometryError::MESSAGES,
    Known::MESSAGES,
    NamedThreshold::MESSAGES,
    PresetName::MESSAGES,
    Presets::MESSAGES,
    VolumeError::MESSAGES,
    WindowName::MESSAGES,
];
