//! The module `io`.
