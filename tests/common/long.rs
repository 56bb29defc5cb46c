//! How much is tried: all of it with `cargo xtask test --long`, else a sample.

/// Whether all of it is.
pub(crate) fn is_long() -> bool {
    std::env::var_os("LUMEN_LONG").is_some()
}
