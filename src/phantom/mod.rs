//! The module `phantom`.
