//! The method: connectivity, smoothing, normals, decimation to a progressive mesh, deviation.

pub mod connectivity;
pub mod decimation;
pub mod filter;
pub mod progressive;
pub mod settings;
pub mod smoothing;
pub mod task;
