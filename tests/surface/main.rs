//! Surfaces: what is read, smoothed, reduced and measured, on meshes made here.

#[path = "../common/crossings.rs"]
mod crossings;
#[path = "../common/long.rs"]
mod long;
#[path = "../common/promises.rs"]
mod promises;
#[path = "../common/shape.rs"]
mod shape;
#[path = "../common/tangles.rs"]
mod tangles;

mod arrays;
mod bad_input;
mod calibre;
mod decimation;
mod fuzz;
mod lumen_width;
mod safe;
mod smoothing;
mod spare_thin;
mod voxel_tubes;
