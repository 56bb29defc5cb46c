//! What of a comparison is in GPU memory: a surface for each result, a target for each picture.

use std::sync::Arc;

use egui::TextureId;

use crate::app::scene::upload;
use crate::app::window_texture::{WindowRenderer, WindowTarget};
use crate::mesh::TriMesh;
use crate::render::{Camera, Drawable, GpuSurface, Look, Renderer, Style, SurfaceError};

/// How a picture is taken.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::app) struct Shot {
    /// From where.
    pub camera: Camera,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// How the surface is shown, one over the other.
    pub looks: &'static [Look],
    /// The theme's colours.
    pub style: Style,
}

/// GPU memory and what stands in it.
pub(in crate::app) struct CompareScene {
    device: wgpu::Device,
    queue: wgpu::Queue,
    window: WindowRenderer,
    renderer: Renderer,
    surfaces: Vec<(Arc<TriMesh>, GpuSurface)>,
    pictures: Vec<WindowTarget<Drawn>>,
}

/// What a picture was drawn from.
struct Drawn {
    mesh: Arc<TriMesh>,
    shot: Shot,
}

impl PartialEq for Drawn {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.mesh, &other.mesh) && self.shot == other.shot
    }
}

impl CompareScene {
    /// An empty scene on the device of a window, or of none.
    pub(in crate::app) fn new(state: &egui_wgpu::RenderState) -> Self {
        let (device, queue) = (state.device.clone(), state.queue.clone());
        let renderer = Renderer::new(&device, &queue);
        Self { device, queue, window: state.renderer.clone(), renderer, surfaces: Vec::new(), pictures: Vec::new() }
    }

    /// Forgets all surfaces but these.
    pub(in crate::app) fn keep_only<'a>(&mut self, meshes: &(impl Iterator<Item = &'a Arc<TriMesh>> + Clone)) {
        let is_kept = |mesh: &Arc<TriMesh>| meshes.clone().any(|kept| Arc::ptr_eq(kept, mesh));
        self.surfaces.retain(|(mesh, _)| is_kept(mesh));
        for picture in &mut self.pictures {
            picture.forget_if(|drawn| !is_kept(&drawn.mesh));
        }
    }

    /// Draws picture `index` of `mesh`, if it would look other than it does, and gives the texture that it is in.
    ///
    /// # Errors
    /// When the surface does not fit into the memory that the device allows.
    pub(in crate::app) fn draw(
        &mut self,
        index: usize,
        mesh: &Arc<TriMesh>,
        shot: &Shot,
    ) -> Result<TextureId, SurfaceError> {
        while self.pictures.len() <= index {
            self.pictures.push(WindowTarget::new(&self.device, &self.window));
        }
        let surface = self.surface(mesh)?;
        let picture = &mut self.pictures[index];
        let drawn = Drawn { mesh: mesh.clone(), shot: shot.clone() };
        let Some(target) = picture.stale(&self.device, shot.size, drawn) else { return Ok(picture.id()) };
        let surface = &self.surfaces[surface].1;
        let drawables: Vec<_> = shot.looks.iter().map(|&look| Drawable { surface, look, tint: None }).collect();
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("cell") });
        self.renderer.draw(&self.device, &mut encoder, target, &shot.camera, &drawables, &shot.style);
        self.queue.submit([encoder.finish()]);
        Ok(picture.id())
    }

    /// The place of `mesh` among the surfaces; it is uploaded the first time.
    fn surface(&mut self, mesh: &Arc<TriMesh>) -> Result<usize, SurfaceError> {
        if let Some(at) = self.surfaces.iter().position(|(known, _)| Arc::ptr_eq(known, mesh)) {
            return Ok(at);
        }
        let mut surface = GpuSurface::new(&self.device, &self.queue, &[])?;
        upload(&self.device, &self.queue, &mut surface, mesh)?;
        self.surfaces.push((mesh.clone(), surface));
        Ok(self.surfaces.len() - 1)
    }
}
