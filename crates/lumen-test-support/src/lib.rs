#![doc = include_str!("../README.md")]
#![allow(clippy::disallowed_methods, reason = "a test compares within bounds")]

pub mod crossings;
pub mod data;
pub mod promises;
pub mod shape;
pub mod tangles;
pub mod tubes;

/// Whether `cargo xtask test --long` runs: everything is tried, else a sample.
pub fn is_long() -> bool {
    std::env::var_os("LUMEN_LONG").is_some()
}
