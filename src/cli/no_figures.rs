//! What stands in for `lumen figures` in a build without the window.

use std::ffi::OsString;

use anyhow::{Result, bail};
use clap::Args;

/// Draws nothing: this build was made without the window (feature gui).
#[derive(Debug, Args)]
pub struct Figures {
    /// Whatever is asked for
    #[arg(hide = true, allow_hyphen_values = true, trailing_var_arg = true)]
    all: Vec<OsString>,
}

impl Figures {
    /// Says what is missing.
    pub(super) fn run(&self) -> Result<()> {
        bail!("this build has nothing to draw with (feature gui)")
    }
}
