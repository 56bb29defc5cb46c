//! Scans in a browser: the second program, which the page fetches in the background and runs in a Worker of its own.
//!
//! - [`job`]: begins the Worker's job; the line to the page is `lumen-worker`'s.
//! - [`shelf`]: the files that the page has handed over, which are read here.

#[cfg(target_arch = "wasm32")]
mod job;
#[cfg(target_arch = "wasm32")]
mod shelf;

/// Runs when the module is instantiated, and leaves the start to [`job::worker_main`].
#[cfg(target_arch = "wasm32")]
fn main() {}

/// On the desktop scans are read by `lumen`.
#[cfg(not(target_arch = "wasm32"))]
fn main() {
    eprintln!("This program runs in a browser: cargo xtask serve");
    std::process::exit(2);
}
