//! Developer commands: `cargo xtask serve | build | test | lint | peers | curve | bench-trial | fuzz-trial |
//! fuzz-surfaces | fuzz-files | instructions | read-back | validation | firmware | package`.
//!
//! Each installs what it needs and is not there yet (`tools`), says what it does and how long that takes (`step`), and
//! does nothing twice.

#![allow(clippy::disallowed_methods, reason = "it draws plots")]

mod bench_trial;
mod build;
mod curve;
mod dependencies;
mod document;
mod estimate;
mod firmware;
mod fuzz;
mod glue;
#[cfg(test)]
mod house;
mod instructions;
mod lacking;
mod lint;
mod package;
mod page;
mod peers;
mod read_back;
mod serve;
mod split;
mod step;
mod test;
mod tools;
mod validation;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Lumen's developer commands.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Build the browser app and serve it on this machine.
    Serve {
        /// Port to listen on; 0 takes a free one.
        #[arg(long, default_value_t = 8080)]
        port: u16,
        /// Open the address in the browser.
        #[arg(long)]
        open: bool,
    },
    /// Build the browser app into dist/, which any web server can host under any path.
    Build,
    /// Run every test: library, command line, window, browser.
    Test {
        /// Run these alone; may be given more than once.
        #[arg(long, value_enum, value_delimiter = ',')]
        only: Vec<test::Suite>,
        /// Run the unit tests of every crate, one window and one page: four minutes once all is compiled.
        #[arg(long, conflicts_with = "long")]
        quick: bool,
        /// Try everything where the ordinary run tries a sample: all seeds, settings and rates. Takes about three times as
        /// long.
        #[arg(long)]
        long: bool,
        /// Fail where something would be skipped because this machine lacks what it needs.
        #[arg(long)]
        whole: bool,
    },
    /// Look for misspelt words, and for dependencies of a licence or source that is not allowed.
    Lint,
    /// Run Lumen beside VTK, meshoptimizer and fast-simplification and write docs/benchmarks/peers.md.
    Peers(peers::Options),
    /// Measure a step of the trial natively and in the browser's Worker, by the same input.
    BenchTrial,
    /// Steer a wire by random input and look that it stays inside.
    FuzzTrial {
        /// Steps of 2 ms.
        #[arg(long, default_value_t = 1_000_000)]
        steps: u64,
    },
    /// Reduce surfaces that are no manifolds and look that every promise is kept.
    FuzzSurfaces {
        /// How many.
        #[arg(long, default_value_t = 100_000)]
        count: u32,
        /// Another seed makes other surfaces.
        #[arg(long, default_value_t = 1)]
        seed: u32,
    },
    /// Let libFuzzer make up files for every reader.
    FuzzFiles {
        /// Readers, by the extension of their files; all where none is named.
        #[arg(long, value_delimiter = ',')]
        only: Vec<String>,
        /// Minutes for each reader.
        #[arg(long, default_value_t = 10)]
        minutes: u64,
    },
    /// Count the instructions of each stage on the samples; fails where one takes 5 % more than is kept.
    Instructions {
        /// Keep what is counted.
        #[arg(long)]
        keep: bool,
    },
    /// Read what Lumen writes with VTK, trimesh and meshio.
    ReadBack,
    /// Test the open feeder's firmware and build it for its board where that target is there.
    Firmware,
    /// Make what is handed to others: a Debian package, an archive of the program, an archive of the browser app.
    Package(package::Options),
    /// Draw what `cargo bench` measured, cost against size, into docs/.
    Curve,
    /// Run the wire's analytic benchmarks, draw them and write docs/validation.md and validation.csv.
    Validation,
}

fn main() -> ExitCode {
    let done = match Arguments::parse().command {
        Command::Serve { port, open } => {
            serve::take_port(port).and_then(|server| serve::serve(&server, &build::build()?, open))
        }
        Command::Build => build::build().map(|_| ()),
        Command::Test { only, quick, long, whole } => {
            let extent = match (quick, long) {
                (true, _) => test::Extent::Quick,
                (_, true) => test::Extent::Long,
                _ => test::Extent::Ordinary,
            };
            test::test(&only, extent, whole)
        }
        Command::Lint => lint::lint(),
        Command::Peers(options) => peers::peers(&options),
        Command::BenchTrial => bench_trial::bench_trial(),
        Command::FuzzTrial { steps } => fuzz::trial(steps),
        Command::FuzzSurfaces { count, seed } => fuzz::surfaces(count, seed),
        Command::Instructions { keep } => instructions::count(keep),
        Command::FuzzFiles { only, minutes } => fuzz::files(&only, minutes),
        Command::ReadBack => read_back::read_back(),
        Command::Firmware => firmware::firmware(),
        Command::Package(options) => package::package(&options),
        Command::Curve => curve::curve(),
        Command::Validation => validation::validation(),
    };
    if let Err(error) = done {
        eprintln!("error: {error:#}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}
