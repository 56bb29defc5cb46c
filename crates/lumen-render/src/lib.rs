//! What wgpu draws: one camera, one light, a vessel shaded or as a wireframe. It knows [`mesh`](lumen_mesh) alone.
//!
//! - A [`Target`] is what one view renders to: a picture for the window to show, or to read back as a [`Picture`], and
//!   what it is drawn by. That of a 3-D view ([`ViewTarget`]) has 4x multisampled colour and depth.
//! - A [`GpuSurface`] holds the positions of all nodes of a progressive mesh, uploaded once; a level brings triangles,
//!   edges and normals. A [`GpuWire`] is written anew every frame (`tube`).
//! - A [`Renderer`] records pictures of things that implement [`Draw`], seen by a [`Camera`] in a [`Style`]. Each thing
//!   draws in one or more [`Phase`]s. [`Backdrop`], [`Drawable`], [`GpuSlice`], [`GpuWire`], [`Glass`], [`Inside`] and
//!   [`Body`] are such things.
//! - A kind of drawing is one file with one shader (`draw`): over the camera and the theme (`scene`) and a paint for each
//!   thing (`paint`) it makes its pipelines (`pipeline`), binds what its shader reads (`binding`) and draws from buffers
//!   (`buffer`). A new kind takes its file, its shader, and a line for each in this one.
//! - Ambient occlusion (`occlusion`) and fluoroscopy (`fluoroscopy`) draw some phases into textures of their own and
//!   compute pictures from them.
//! - [`DeviceHealth`] hears what goes wrong with a device, [`SurfaceError`] is what does not come to it;
//!   [`device_descriptor`] says what is asked of one.
//! - [`pick`] finds the triangle under a [`Ray`] of the camera, on the CPU.
//!
//! It runs on WebGPU, on WebGL2 (no storage buffers, no compute, no wide lines, no polygon mode) and on Vulkan, Metal
//! and OpenGL, with the same shaders.
//!
//! Colours. The window library samples a texture as `Rgba8Unorm` and takes what it reads as gamma-encoded sRGB (the
//! comment in its shader: "We expect 'normal' textures that are NOT sRGB-aware"), whatever the format of its own
//! target. An sRGB texture would be decoded once too often, and a second view of it in another format does not exist
//! on WebGL2. So the target is `Rgba8Unorm`, shaders light in linear light and encode to sRGB themselves, and a
//! [`Colour`] appears on screen as it is written. Multisamples are therefore averaged as encoded values: edges and
//! lines have the same visual weight dark on light as light on dark.

#![allow(clippy::disallowed_methods, reason = "what it computes ends on the screen")]

mod backdrop;
mod binding;
mod buffer;
mod camera;
mod colour;
mod colour_map;
mod draw;
mod drawable;
mod edges;
mod error;
mod fault;
mod fluoroscopy;
mod glass;
mod limits;
mod occlusion;
mod paint;
mod pick;
mod picture;
mod pipeline;
mod renderer;
mod scene;
mod shaded;
mod slice;
mod standard_view;
mod style;
mod surface;
mod target;
mod texture;
mod thickness;
mod tube;
mod wire;
mod wireframe;

pub use backdrop::Backdrop;
pub use camera::Camera;
pub use colour::{Colour, contrast};
pub use colour_map::{ColourMap, LABELS, VIRIDIS, diverging, label_colour, viridis};
pub use draw::{Draw, DrawContext, Phase};
pub use drawable::{Drawable, Look};
pub use edges::unique_edges;
pub use error::SurfaceError;
pub use fault::{DeviceHealth, Fault};
pub use fluoroscopy::{Exposure, FluoroscopyTarget, Sums};
pub use glass::{Glass, Inside};
pub use limits::device_descriptor;
pub use paint::Paint;
pub use pick::{Hit, Ray, pick};
pub use picture::{Picture, PictureError};
pub use renderer::Renderer;
pub use slice::GpuSlice;
pub use standard_view::StandardView;
pub use style::{ClipPlane, Style};
pub use surface::GpuSurface;
pub use target::{Attachments, Multisampled, Target, ViewTarget};
pub use thickness::{Body, ThicknessFormat};
pub use tube::GpuWire;
