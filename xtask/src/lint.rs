//! `cargo xtask lint`: spelling, and what the dependencies are (`_typos.toml`, `deny.toml`).

use std::process::Command;

use anyhow::Result;

use crate::step::{run, step};
use crate::{dependencies, tools};

/// Fails at a word that is misspelt, or a dependency of a licence, source or name that is not allowed.
pub(crate) fn lint() -> Result<()> {
    let typos = tools::typos()?;
    step("Check the spelling", || run(&mut Command::new(typos)))?;
    step("Check the dependencies", dependencies::check)
}
