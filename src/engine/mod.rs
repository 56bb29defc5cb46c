//! The module `engine`.
