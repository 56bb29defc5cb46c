//! The module `app`.
