//! The subcommands: the same engine without a window.
//!
//! Results go to standard output, progress and warnings to standard error. The exit status is 0 when it is done, 1
//! when it failed, 2 when the command line makes no sense, 130 when Ctrl-C has ended it, 143 when SIGTERM has.

mod batch;
mod branches;
mod centreline;
#[cfg(feature = "gui")]
mod figures;
mod inspect;
mod interrupt;
mod manual;
mod mend;
mod optimise;
mod phantom;
#[cfg(feature = "gui")]
mod pictures;
#[cfg(not(feature = "gui"))]
#[path = "no_pictures.rs"]
mod pictures;
mod places;
mod report;
#[cfg(feature = "scans")]
mod scan;
#[cfg(not(feature = "scans"))]
#[path = "no_scan.rs"]
mod scan;
mod settings;
mod sheet;
mod source;
#[cfg(feature = "scans")]
mod surface;
mod tables;
mod trial;
mod trial_tables;
mod written;

use std::io::Write as _;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use crate::mesh::ArrayInfo;
use crate::mesh::arrays::{Kind, On};
use crate::pipeline::narrowest::Narrowest;
use crate::pipeline::shape::Shape;

/// The command line.
#[derive(Debug, Parser)]
#[command(
    name = "lumen",
    version,
    about = "Makes a blood-vessel surface light enough to simulate on. Not for clinical decisions.",
    after_help = "Without a subcommand a window opens, with FILE in it if there is one.\n\
                  Wherever a file is read, sample:aorta or sample:coronary can stand for it.",
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
    /// Draw Figures 6 and 7 of the paper for a surface, as PNG
    #[cfg(feature = "gui")]
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
    /// Write a page for the record, as PDF or HTML: fingerprint, settings, numbers, verdict, vessels, pictures
    Report(report::WriteReport),
    /// Write the surface in a scan or a mask
    #[cfg(feature = "scans")]
    Surface(surface::Surface),
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
            #[cfg(feature = "gui")]
            Self::Figures(command) => command.run(),
            Self::Inspect(command) => command.run(),
            Self::Manual(command) => command.run(),
            Self::Mend(command) => command.run(),
            Self::Optimise(command) => command.run(),
            Self::Phantom(command) => command.run(),
            Self::Report(command) => command.run(),
            #[cfg(feature = "scans")]
            Self::Surface(command) => command.run(),
            Self::Tables(command) => command.run(),
            Self::Trial(command) => command.run(),
        };
        match result {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                // Where nobody hears it, the status says it.
                let _ = writeln!(std::io::stderr(), "lumen: {error:#}");
                error.downcast_ref().map_or(ExitCode::FAILURE, |&interrupt::Interrupted(status)| status.into())
            }
        }
    }
}

/// Ends the program as for a command line that makes no sense.
fn misuse(error: impl std::fmt::Display) -> ! {
    use clap::CommandFactory;
    Arguments::command().error(clap::error::ErrorKind::ValueValidation, error).exit()
}

/// The format that the name of an output file asks for.
fn output_format(path: &std::path::Path) -> crate::io::Format {
    crate::io::Format::from_name(&path.to_string_lossy())
        .unwrap_or_else(|| misuse(format!("{} does not end in .stl, .ply, .obj, .vtp, .vtk or .glb", path.display())))
}

/// Writes `bytes` to `path` whole or not at all: what was there before stays if the disk is full.
fn write_whole(path: &std::path::Path, bytes: &[u8]) -> anyhow::Result<()> {
    use anyhow::Context;
    let mut name = path.file_name().context("the output has no file name")?.to_owned();
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    let written = std::fs::write(&part, bytes).and_then(|()| std::fs::rename(&part, path));
    written
        .inspect_err(|_| drop(std::fs::remove_file(&part)))
        .with_context(|| format!("cannot write {}", path.display()))
}

/// A row of a table: what it is, padded, and how much.
fn row(what: &str, how_much: impl std::fmt::Display) {
    println!("{what:<27} {how_much}");
}

/// A row for each array: its name, what it is on, its type, and its range.
fn array_rows(arrays: &[ArrayInfo]) {
    for ArrayInfo { name, on, kind, scalar, components, range, .. } in arrays {
        let on = if *on == On::Point { "point" } else { "triangle" };
        let kind = if *kind == Kind::Label { ", labels" } else { "" };
        let range =
            range.map_or("no finite value".to_owned(), |[least, most]| format!("{} to {}", plain(least), plain(most)));
        let (what, scalar) = (format!("array {name}"), scalar.name());
        row(&what, format!("{on}, {components} x {scalar}{kind}, {range}"));
    }
}

/// A number without a row of zeros.
fn plain(x: f64) -> String {
    if x != 0.0 && !(1e-4..1e15).contains(&x.abs()) { format!("{x:e}") } else { format!("{x}") }
}

/// The rows of a surface's shape.
fn shape_rows(shape: &Shape) {
    if let Some(roughness) = shape.roughness {
        row("roughness", format!("{:.2} degrees RMS, {:.2} p95", roughness.rms_deg, roughness.p95_deg));
    }
    if let Some(angles) = &shape.angles {
        row("smallest angle", format!("{:.2} degrees", angles.min_deg));
        row("slivers under 10 degrees", format!("{:.2} % of triangles", angles.below_10_percent));
    }
    row("self-intersecting triangles", shape.self_intersecting_faces);
    if let Some(Narrowest { diameter_mm, at_mm: [x, y, z] }) = shape.smallest_lumen {
        row("smallest lumen", format!("{diameter_mm:.3} mm at ({x:.1}, {y:.1}, {z:.1})"));
    }
}
