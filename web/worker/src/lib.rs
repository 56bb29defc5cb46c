//! The line between the page and its Workers, as both of the browser's programs have it.
//!
//! - `message`: a message as a script's values; `bytes`: copies that may fail.
//! - `serve`: the Worker's end, which runs an engine; the page's end is `web/src/worker.rs`.
//! - `speech`: the language that the Worker's sentences are in.
//! - `panics`: what makes the end of a program heard.

#![cfg(target_arch = "wasm32")]

pub mod bytes;
pub mod message;
pub mod panics;
pub mod serve;
pub mod speech;
