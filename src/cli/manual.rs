//! `lumen manual FOLDER`: manual pages and completions for shells, made of the definition that reads the command line, and
//! the types of files for desktops, made of the table of formats.

use std::path::PathBuf;

use anyhow::{Context, Result};
use clap::{Args, Command};
use clap_complete::Shell;

use crate::io::formats::{MediaType, media_types};

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
        let types = [
            ("types.xml", declared()),
            ("types.txt", media_types().map(|media| media.name.to_owned() + ";").collect()),
        ];
        for (name, text) in types {
            std::fs::write(folder.join(name), text).context("cannot write the types of files")?;
        }
        Ok(())
    }
}

/// The types of surface files as a desktop is told of them, but for what stands around them.
fn declared() -> String {
    let declare = |media: &MediaType| {
        let MediaType { name, comment, extension, magic } = media;
        let magic = magic.map_or(String::new(), |magic| {
            format!("    <magic priority=\"60\"><match type=\"string\" offset=\"0\" value=\"{magic}\"/></magic>\n")
        });
        format!(
            "  <mime-type type=\"{name}\">\n    <comment>{comment}</comment>\n{magic}    \
             <glob pattern=\"*.{extension}\"/>\n  </mime-type>\n"
        )
    };
    media_types().map(declare).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_types_of_surface_files_are_declared_for_desktops() {
        let declared = declared();
        assert!(declared.contains(
            "  <mime-type type=\"model/x-ply\">\n    <comment>PLY surface</comment>\n    <magic priority=\"60\">\
             <match type=\"string\" offset=\"0\" value=\"ply\\n\"/></magic>\n    <glob pattern=\"*.ply\"/>\n\
             \x20 </mime-type>\n"
        ));
        // What a hospital and a segmentation tool hand over opens at a double click.
        for ending in ["stl", "vtp", "ply", "obj", "glb"] {
            assert!(declared.contains(&format!("<glob pattern=\"*.{ending}\"/>")), "{ending}");
        }
        assert_eq!(declared.matches("<mime-type ").count(), media_types().count());
    }
}
