//! Lumen for programs in JavaScript: the npm package's module, which its own Worker runs (`web/npm/js/worker.js`).
//!
//! - [`reading`]: the bytes of a file on their way to a surface.
//! - [`surface`]: a surface, what the pipeline makes of it, and what is taken out of that.
//! - [`settings`]: settings as a program says them: any part of the settings file.
//! - [`refusal`]: errors as data.
//! - `types`: TypeScript's types of all that, made from the Rust ones by a test.
//!
//! It rests on the crates below the program and not on `lumen` itself: they are compiled for the browser app anyway.

#[cfg(target_arch = "wasm32")]
mod reading;
#[cfg(target_arch = "wasm32")]
mod refusal;
#[cfg(target_arch = "wasm32")]
mod settings;
#[cfg(target_arch = "wasm32")]
mod surface;
#[cfg(test)]
mod types;

/// Runs when the module is instantiated; the work begins with [`reading::Reading`].
#[cfg(target_arch = "wasm32")]
fn main() {
    refusal::tell_panics();
}

/// On the desktop there is the crate `lumen`.
#[cfg(not(target_arch = "wasm32"))]
fn main() {
    eprintln!("This program runs in a Worker: cargo xtask package npm");
    std::process::exit(2);
}
