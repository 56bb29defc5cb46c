//! The desktop program: a window, or a subcommand without one.

use std::process::ExitCode;

use clap::Parser;
use lumen::cli::Arguments;

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match &arguments.command {
        Some(command) => command.run(),
        None => window(&arguments),
    }
}

#[cfg(feature = "gui")]
fn window(arguments: &Arguments) -> ExitCode {
    match lumen::desktop::run(arguments.file.as_deref()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("lumen: the window could not be opened: {error}");
            eprintln!("lumen: the subcommands need none: lumen --help");
            ExitCode::FAILURE
        }
    }
}

#[cfg(not(feature = "gui"))]
fn window(_: &Arguments) -> ExitCode {
    eprintln!("lumen: this build was made without the window (feature gui); see lumen --help for the subcommands");
    ExitCode::from(2)
}
