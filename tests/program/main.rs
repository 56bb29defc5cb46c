//! The program from outside: its subcommands and the files that it writes.

mod cli;
#[cfg(feature = "gui")]
mod figures;
#[cfg(feature = "scans")]
mod scans;
