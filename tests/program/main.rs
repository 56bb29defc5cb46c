//! The program from outside: its subcommands and the files that it writes.

#![allow(clippy::disallowed_methods, reason = "a test compares within bounds")]

mod batch;
mod cli;
mod compare;
#[cfg(feature = "gui")]
mod figures;
mod prepare;
mod privacy;
mod program;
mod report;
#[cfg(feature = "scans")]
mod scans;
mod serve;
mod settings;
mod tables;
#[cfg(not(feature = "scans"))]
mod without_scans;
