//! The module `pipeline`.
pub mod deviation;
pub mod normals;
