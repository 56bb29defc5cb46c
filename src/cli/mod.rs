//! The subcommands: the same engine without a window.
//!
//! Results go to standard output, progress and warnings to standard error. The exit status is 0 when it is done, 1
//! when it failed, 2 when the command line makes no sense, 130 when Ctrl-C has ended it, 143 when SIGTERM has.

mod batch;
mod branches;
mod centreline;
mod compare;
#[cfg(feature = "gui")]
mod figures;
#[cfg(not(feature = "gui"))]
#[path = "no_figures.rs"]
mod figures;
mod inspect;
mod interrupt;
mod manual;
mod mend;
mod misuse;
mod optimise;
mod options;
mod outputs;
mod phantom;
#[cfg(feature = "gui")]
mod pictures;
#[cfg(not(feature = "gui"))]
#[path = "no_pictures.rs"]
mod pictures;
mod places;
mod prepare;
mod report;
mod rows;
mod running;
#[cfg(feature = "scans")]
mod scan;
#[cfg(not(feature = "scans"))]
#[path = "no_scan.rs"]
mod scan;
mod scan_options;
pub mod serve;
mod settings;
mod sheet;
mod source;
mod surface;
mod sweep;
mod tables;
mod trial;
mod trial_tables;
pub mod whole;
mod written;

use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{CommandFactory as _, Parser, Subcommand};

/// The command line.
#[derive(Debug, Parser)]
#[command(
    name = "lumen",
    version,
    about = "Makes a blood-vessel surface light enough to simulate on. Not for clinical decisions.",
    after_help = "Without a subcommand a window opens, with FILE in it if there is one.\n\
                  Wherever a file is read, sample:aorta, sample:coronary or sample:aorta-nets can stand for it.",
    args_conflicts_with_subcommands = true
)]
pub struct Arguments {
    /// A surface to open in the window
    pub file: Option<PathBuf>,
    /// What to do without a window
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// A subcommand.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Write the centrelines of a surface with their radii and cross-sections
    Centreline(centreline::Centreline),
    /// Say how far two surfaces are apart, and what became of each vessel
    Compare(compare::Compare),
    /// Draw Figures 6 and 7 of the paper for a surface, as PNG
    Figures(figures::Figures),
    /// Say what is in a surface file
    Inspect(inspect::Inspect),
    /// Write the manual's pages and the completions for shells, for those who make packages
    #[command(hide = true)]
    Manual(manual::Manual),
    /// Mend what is wrong with a surface, and write it
    Mend(mend::Mend),
    /// Keep the largest piece, smooth it, reduce it, and write the result
    Optimise(optimise::Optimise),
    /// Write one of the vessel trees that Lumen makes itself
    Phantom(phantom::Phantom),
    /// Make a surface ready for a flow or structure solver
    Prepare(prepare::Prepare),
    /// Write a page for the record, as PDF or HTML: fingerprint, settings, numbers, verdict, vessels, pictures
    Report(report::WriteReport),
    /// Write the surface in a scan or a mask
    Surface(surface::Surface),
    /// Show what reduction does to a guidewire: trials at many rates beside the unreduced surface
    Sweep(sweep::Sweep),
    /// Make Tables I and II of the paper for a surface, or III and IV, the paper's numbers beside them
    Tables(tables::Tables),
    /// Steer a guidewire through a surface by autopilot
    Trial(trial::Trial),
}

impl Command {
    /// Runs the subcommand and reports a failure on standard error.
    pub fn run(&self) -> ExitCode {
        let result = match self {
            Self::Centreline(command) => command.run(),
            Self::Compare(command) => command.run(),
            Self::Figures(command) => command.run(),
            Self::Inspect(command) => command.run(),
            Self::Manual(command) => command.run(&Arguments::command()),
            Self::Mend(command) => command.run(),
            Self::Optimise(command) => command.run(),
            Self::Phantom(command) => command.run(),
            Self::Prepare(command) => command.run(),
            Self::Report(command) => command.run(),
            Self::Surface(command) => command.run(),
            Self::Sweep(command) => command.run(),
            Self::Tables(command) => command.run(),
            Self::Trial(command) => command.run(),
        };
        match result {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                if let Some(misuse) = error.downcast_ref::<misuse::Misuse>() {
                    Arguments::command().error(ErrorKind::ValueValidation, misuse).exit();
                }
                // Where nobody hears it, the status says it.
                let _ = writeln!(std::io::stderr(), "lumen: {error:#}");
                error.downcast_ref().map_or(ExitCode::FAILURE, |&interrupt::Interrupted(status)| status.into())
            }
        }
    }
}
