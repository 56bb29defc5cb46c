//! The module `render`.
