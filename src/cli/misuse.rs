//! A command line that makes no sense, found out after it was read: it ends as clap ends those that it refuses itself.

use std::fmt::Display;

use thiserror::Error;

/// What is wrong with the command line, in a sentence.
#[derive(Debug, Error)]
#[error("{0}")]
pub(super) struct Misuse(String);

/// That the command line makes no sense.
pub(super) fn misuse(what: impl Display) -> anyhow::Error {
    Misuse(what.to_string()).into()
}
