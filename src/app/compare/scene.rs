//! What of a comparison is in GPU memory: a surface for each result, a target for each picture.

use std::sync::Arc;

use egui::TextureId;

use crate::app::scene::upload;
use crate::app::window_texture::{WindowRenderer, WindowTarget};
use crate::mesh::TriMesh;
use crate::render::{Backdrop, Camera, Draw, Drawable, GpuSurface, Look, Renderer, Style, SurfaceError};

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
    surfaces: Vec<Surface>,
    pictures: Vec<WindowTarget<Drawn>>,
}

/// A number for each vertex of a surface.
pub(in crate::app) type Scalars = Arc<Vec<f32>>;

/// A surface in memory, and the numbers that it has there.
struct Surface {
    mesh: Arc<TriMesh>,
    scalars: Option<Scalars>,
    on_gpu: GpuSurface,
}

/// What a picture was drawn from.
struct Drawn {
    mesh: Arc<TriMesh>,
    scalars: Option<Scalars>,
    shot: Shot,
}

impl PartialEq for Drawn {
    fn eq(&self, other: &Self) -> bool {
        let of = |drawn: &Self| drawn.scalars.as_ref().map(Arc::as_ptr);
        Arc::ptr_eq(&self.mesh, &other.mesh) && of(self) == of(other) && self.shot == other.shot
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
        self.surfaces.retain(|surface| is_kept(&surface.mesh));
        for picture in &mut self.pictures {
            picture.forget_if(|drawn| !is_kept(&drawn.mesh));
        }
    }

    /// Draws picture `index` of `mesh`, if it would look other than it does, and gives the texture that it is in. The
    /// colour map of a shot shows `scalars`.
    ///
    /// # Errors
    /// When the surface does not fit into the memory that the device allows.
    pub(in crate::app) fn draw(
        &mut self,
        index: usize,
        mesh: &Arc<TriMesh>,
        scalars: Option<&Scalars>,
        shot: &Shot,
    ) -> Result<TextureId, SurfaceError> {
        while self.pictures.len() <= index {
            self.pictures.push(WindowTarget::new(&self.device, &self.window));
        }
        let surface = self.surface(mesh, scalars)?;
        let picture = &mut self.pictures[index];
        let drawn = Drawn { mesh: mesh.clone(), scalars: scalars.cloned(), shot: shot.clone() };
        let Some(target) = picture.stale(&self.device, shot.size, drawn) else { return Ok(picture.id()) };
        let surface = &self.surfaces[surface].on_gpu;
        let drawables: Vec<_> = shot.looks.iter().map(|&look| Drawable { surface, look, tint: None }).collect();
        let mut things: Vec<&dyn Draw> = vec![&Backdrop];
        things.extend(drawables.iter().map(|drawable| drawable as &dyn Draw));
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("cell") });
        self.renderer.draw(&mut encoder, target, &shot.camera, &things, &shot.style);
        self.queue.submit([encoder.finish()]);
        Ok(picture.id())
    }

    /// The place of `mesh` among the surfaces; it is uploaded the first time, and `scalars` where it has others.
    fn surface(&mut self, mesh: &Arc<TriMesh>, scalars: Option<&Scalars>) -> Result<usize, SurfaceError> {
        let known = self.surfaces.iter().position(|known| Arc::ptr_eq(&known.mesh, mesh));
        let at = match known {
            Some(at) => at,
            None => {
                let mut on_gpu = GpuSurface::new(&self.device, &self.queue, &[])?;
                upload(&self.device, &self.queue, &mut on_gpu, mesh)?;
                self.surfaces.push(Surface { mesh: mesh.clone(), scalars: None, on_gpu });
                self.surfaces.len() - 1
            }
        };
        let surface = &mut self.surfaces[at];
        if let Some(scalars) = scalars.filter(|new| !surface.scalars.as_ref().is_some_and(|old| Arc::ptr_eq(old, new)))
        {
            surface.on_gpu.set_scalars(&self.device, &self.queue, Some(scalars.as_slice()))?;
            surface.scalars = Some(scalars.clone());
        }
        Ok(at)
    }
}
