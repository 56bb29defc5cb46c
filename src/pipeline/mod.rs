//! The method: connectivity, smoothing, normals, decimation to a progressive mesh, deviation.
//!
//! Each stage is a file; [`run`] puts them in order and remembers what each made, so that a change of a setting
//! recomputes from the first stage that it touches.

pub mod bound;
pub mod connectivity;
pub mod decimation;
pub mod deviation;
pub mod filter;
pub mod lumen;
pub mod measuring;
pub mod narrowest;
pub mod normals;
pub mod paper;
pub mod pinch;
pub mod progressive;
pub mod report;
pub mod response;
pub mod results;
pub mod run;
pub mod settings;
pub mod shape;
pub mod smoothing;
pub mod task;
