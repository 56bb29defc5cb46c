//! A device without a window, and one call from surfaces to a picture.

use std::sync::OnceLock;

use glam::Vec3;
use lumen::mesh::{Bounds, TriMesh};
use lumen::render::{
    Backdrop, Camera, Colour, Draw, Drawable, GpuSurface, Look, Picture, Renderer, StandardView, Style, ViewTarget,
    unique_edges,
};

/// A device with nothing but what WebGL2 has, and the renderer on it.
pub(crate) struct Stage {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) renderer: Renderer,
}

/// The stage that all tests share.
pub(crate) fn stage() -> &'static Stage {
    static STAGE: OnceLock<Stage> = OnceLock::new();
    STAGE.get_or_init(|| pollster::block_on(open()))
}

/// What there is to draw on.
pub(crate) async fn adapter() -> wgpu::Adapter {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
    instance.request_adapter(&wgpu::RequestAdapterOptions::default()).await.unwrap_or_else(|error| {
        panic!("these tests draw and need a GPU or a software one (Debian: mesa-vulkan-drivers): {error}")
    })
}

async fn open() -> Stage {
    let adapter = adapter().await;
    println!("drawing on {:?}", adapter.get_info());
    let required_limits = wgpu::Limits::downlevel_webgl2_defaults().using_resolution(adapter.limits());
    let descriptor = wgpu::DeviceDescriptor { required_limits, ..Default::default() };
    let (device, queue) = adapter.request_device(&descriptor).await.expect("a device with WebGL2's limits");
    let renderer = Renderer::new(&device, &queue);
    Stage { device, queue, renderer }
}

impl Stage {
    /// `mesh` with its own triangles as the level.
    pub(crate) fn surface(&self, mesh: &TriMesh) -> GpuSurface {
        let mut surface = GpuSurface::new(&self.device, &self.queue, &mesh.positions).unwrap();
        self.set_level(&mut surface, mesh, &mesh.triangles);
        surface
    }

    /// Shows `triangles` over the vertices of `mesh`.
    pub(crate) fn set_level(&self, surface: &mut GpuSurface, mesh: &TriMesh, triangles: &[[u32; 3]]) {
        let edges = unique_edges(triangles, mesh.positions.len());
        surface.set_level(&self.device, &self.queue, triangles, &edges, &normals(mesh)).unwrap();
    }

    /// A picture of `width` by `height` pixels.
    pub(crate) fn picture(
        &self,
        size: [u32; 2],
        camera: &Camera,
        drawables: &[Drawable<'_>],
        style: &Style,
    ) -> Picture {
        let target = ViewTarget::new(&self.device, size[0], size[1]);
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.renderer.draw(&mut encoder, &target, camera, &before_backdrop(drawables), style);
        self.queue.submit([encoder.finish()]);
        Picture::read_now(&target, &self.device, &self.queue).unwrap()
    }
}

/// `surface` in one look, untinted.
pub(crate) fn shown(surface: &GpuSurface, look: Look) -> Drawable<'_> {
    Drawable { surface, look, tint: None }
}

/// The background, and what stands before it.
pub(crate) fn before_backdrop<'a>(drawables: &'a [Drawable<'a>]) -> Vec<&'a dyn Draw> {
    let mut things: Vec<&dyn Draw> = vec![&Backdrop];
    things.extend(drawables.iter().map(|drawable| drawable as &dyn Draw));
    things
}

/// A camera in front of `mesh`, which fills the view.
pub(crate) fn in_front_of(mesh: &TriMesh, aspect: f32) -> Camera {
    let mut camera = Camera::default();
    camera.standard_view(StandardView::Anterior);
    camera.fit(&Bounds::of(&mesh.positions), aspect);
    camera
}

/// The light theme on an even background.
pub(crate) fn plain(background: Colour) -> Style {
    Style { background_top: background, background_bottom: background, ..Style::LIGHT }
}

/// Area-weighted vertex normals.
fn normals(mesh: &TriMesh) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; mesh.positions.len()];
    for (t, triangle) in mesh.triangles.iter().enumerate() {
        let [a, b, c] = mesh.corners(t);
        for &v in triangle {
            sums[v as usize] += (b - a).cross(c - a);
        }
    }
    sums.into_iter().map(Vec3::normalize_or_zero).collect()
}
