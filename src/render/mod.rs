//! What wgpu draws: one camera, one light, a vessel shaded or as a wireframe. It knows [`mesh`](crate::mesh) alone.
//!
//! - A [`ViewTarget`] is what one 3-D view renders to: 4x multisampled colour and depth, and a resolved texture for
//!   the window to show, or to read back as a [`Picture`].
//! - A [`GpuSurface`] holds the positions of all nodes of a progressive mesh, uploaded once; a level brings triangles,
//!   edges and normals.
//! - A [`Renderer`] holds the pipelines, one file and one shader a kind of drawing: `backdrop`, `shaded`, `wireframe`.
//!   [`Renderer::draw`] draws [`Drawable`]s seen by a [`Camera`] in a [`Style`].
//! - A [`TrialRenderer`] draws the guidewire: in the translucent vessel (`glass`, `wire`), from its tip, and as a
//!   fluoroscope sees it (`fluoroscopy`, `thickness`). A [`GpuWire`] is written anew every frame.
//! - [`DeviceHealth`] hears what goes wrong with a device; [`device_descriptor`] says what is asked of one.
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

mod backdrop;
mod buffer;
mod camera;
mod colour;
mod colour_map;
mod edges;
mod fault;
mod fluoroscopy;
mod glass;
mod limits;
mod pick;
mod picture;
mod renderer;
mod scene;
mod shaded;
mod style;
mod surface;
mod target;
mod trial;
mod wire;
mod wireframe;

pub use camera::{Camera, StandardView};
pub use colour::{Colour, contrast};
pub use colour_map::{ColourMap, VIRIDIS, viridis};
pub use edges::unique_edges;
pub use fault::{DeviceHealth, Fault};
pub use fluoroscopy::{Exposure, FluoroscopyTarget, ThicknessFormat};
pub use limits::device_descriptor;
pub use pick::{Hit, Ray, pick};
pub use picture::{Picture, PictureError};
pub use renderer::{Drawable, Look, Renderer};
pub use style::Style;
pub use surface::{GpuSurface, SurfaceError};
pub use target::ViewTarget;
pub use trial::TrialRenderer;
pub use wire::GpuWire;
