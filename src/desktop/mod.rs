//! The module `desktop`.
