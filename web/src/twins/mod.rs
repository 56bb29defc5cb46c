//! The controls' twins in the page.
//!
//! egui draws the controls into one canvas, where neither assistive tools nor a test can find them. It also describes
//! them as an AccessKit tree after each pass, which eframe drops on the web. Here that tree becomes elements with
//! ARIA roles, names and values (WAI-ARIA 1.2) that lie, unseen, over what is drawn: [`tree`] turns the tree into a
//! list, [`mirror`] keeps the page's elements equal to the list.
//!
//! The pointer goes through the twins to the canvas. What an assistive tool does to a twin goes back to egui as an
//! AccessKit action. The keyboard stays with the canvas, which names the focused twin as its active descendant.

#[cfg(target_arch = "wasm32")]
mod mirror;
#[cfg(target_arch = "wasm32")]
mod plugin;
#[cfg_attr(not(target_arch = "wasm32"), allow(dead_code, reason = "only its tests run on a desktop"))]
mod tree;

#[cfg(target_arch = "wasm32")]
pub(crate) use plugin::attach;
