//! The module `pipeline`.
