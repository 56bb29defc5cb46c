//! Lumen in a browser: what the page gives the app.
//!
//! - [`page`]: starts the app and tells the page how it goes; [`graphics`]: WebGPU or WebGL2 on the canvas, started again
//!   where it is lost; [`screen`]: painted again on a screen of other pixels.
//! - [`twins`]: the controls' twins in the page, for assistive tools and tests.
//! - [`platform`]: what the app asks of a browser, with [`files`], the file dialog and downloads, and [`store`], what
//!   outlives the page; [`address`]: what stands after `?` in the page's.
//! - [`hid`]: haptic devices, asked for in the page and served in the trial's Worker; [`sound`]: a tone in place of a force; [`video`]: frames as a video.
//! - [`texts`]: the messages of other languages than English; [`late`]: the half of the program that is fetched later.
//! - [`worker`]: the page's end of the line to a Worker, whose other end is the crate `lumen-worker`'s; [`job`]: which engines
//!   have one; [`link`]: that line as the app's line to the engine; [`scans`]: that of scans, another program's.
//!
//! The page itself is in `www/`; `cargo xtask build` puts both together.

#[cfg(target_arch = "wasm32")]
mod address;
#[cfg(target_arch = "wasm32")]
mod files;
#[cfg(target_arch = "wasm32")]
mod gamepad;
#[cfg(target_arch = "wasm32")]
mod graphics;
#[cfg(target_arch = "wasm32")]
mod hid;
#[cfg(target_arch = "wasm32")]
mod job;
#[cfg(target_arch = "wasm32")]
mod late;
#[cfg(target_arch = "wasm32")]
mod link;
#[cfg(target_arch = "wasm32")]
mod page;
#[cfg(target_arch = "wasm32")]
mod platform;
#[cfg(target_arch = "wasm32")]
mod scans;
#[cfg(target_arch = "wasm32")]
mod screen;
#[cfg(target_arch = "wasm32")]
mod sound;
#[cfg(target_arch = "wasm32")]
mod store;
#[cfg(target_arch = "wasm32")]
mod texts;
mod twins;
#[cfg(target_arch = "wasm32")]
mod video;
#[cfg(target_arch = "wasm32")]
mod worker;

/// Runs when the module is instantiated: on the page it starts the app, in a Worker it leaves the start to
/// [`job::worker_main`].
#[cfg(target_arch = "wasm32")]
fn main() {
    if let Some(window) = web_sys::window() {
        page::start(window);
    }
}

/// The desktop program is `lumen`.
#[cfg(not(target_arch = "wasm32"))]
fn main() {
    eprintln!("This program runs in a browser: cargo xtask serve");
    std::process::exit(2);
}
