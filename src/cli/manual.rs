//! `lumen manual FOLDER`: manual pages and completions for shells, made of the definition that reads the command line.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, Command};
use clap_complete::Shell;

/// The shells that there are completions for.
const SHELLS: [Shell; 3] = [Shell::Bash, Shell::Zsh, Shell::Fish];

/// Writes the manual's pages and the completions.
#[derive(Debug, Args)]
pub struct Manual {
    /// The folder to write to
    folder: PathBuf,
}

impl Manual {
    /// Of the command line `command`.
    pub(super) fn run(&self, command: &Command) -> Result<()> {
        let folder = &self.folder;
        std::fs::create_dir_all(folder).with_context(|| format!("cannot make the folder {}", folder.display()))?;
        clap_mangen::generate_to(command.clone(), folder).context("cannot write the manual's pages")?;
        for shell in SHELLS {
            clap_complete::generate_to(shell, &mut command.clone(), "lumen", folder)
                .context("cannot write the completions")?;
        }
        Ok(())
    }
}
