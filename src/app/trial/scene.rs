//! What of a trial stands in GPU memory: the vessel, the same with its ends closed for X-rays, the wire, and the
//! targets of the three views.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

use egui::TextureId;
use web_time::Instant;

use super::peaks::Peaks;
use crate::app::window_texture::WindowTarget;
use crate::engine::trial::RouteShown;
use crate::mesh::{Topology, TriMesh, Vec3, boundary_loops};
use crate::pipeline::normals::{Weighting, vertex_normals};
use crate::render::{
    Backdrop, Body, Camera, Draw, Exposure, Glass, GpuSurface, GpuWire, Inside, Renderer, Style, Sums, SurfaceError,
    ThicknessFormat, ViewTarget,
};

/// Frames that are drawn to time one.
const TIMED: u32 = 8;
/// The size of the frame that is timed, in pixels.
const TIMED_SIZE: [u32; 2] = [1280, 800];

/// GPU memory and what stands in it.
pub(super) struct TrialScene {
    device: wgpu::Device,
    queue: wgpu::Queue,
    renderer: Renderer,
    vessel: GpuSurface,
    body: GpuSurface,
    wire: GpuWire,
    /// The wire as it was at the last pulse.
    seen: GpuWire,
    /// What the vessel was made from, and the forces on it.
    of: Option<(Arc<TriMesh>, Peaks)>,
    uploaded: u64,
    views: [WindowTarget<Drawn>; 2],
    picture: WindowTarget<(), Sums>,
    /// The camera that the thickness is of.
    measured: Option<Camera>,
    /// Counts up whenever vessel, forces or wire change.
    changes: u64,
    /// Pictures that were drawn.
    draws: u64,
}

/// What a view was drawn from.
#[derive(Clone, Copy, PartialEq)]
struct Drawn {
    camera: Camera,
    size: [u32; 2],
    style: Style,
    changes: u64,
}

impl TrialScene {
    /// A scene on the window's device.
    ///
    /// # Errors
    /// When the device does not allow a buffer.
    pub(super) fn new(state: &egui_wgpu::RenderState) -> Result<Self, SurfaceError> {
        let (device, queue) = (state.device.clone(), state.queue.clone());
        let renderer = Renderer::new(&device, &queue).with_thickness(ThicknessFormat::of(&state.adapter));
        let view = || WindowTarget::new(&device, &state.renderer);
        let views = [view(), view()];
        let picture = renderer.fluoroscopy_target([1, 1]);
        Ok(Self {
            vessel: GpuSurface::new(&device, &queue, &[])?,
            body: GpuSurface::new(&device, &queue, &[])?,
            wire: GpuWire::default(),
            seen: GpuWire::default(),
            renderer,
            of: None,
            uploaded: 0,
            views,
            picture: WindowTarget::with(&device, &state.renderer, picture),
            measured: None,
            changes: 0,
            draws: 0,
            device,
            queue,
        })
    }

    /// How many pictures were drawn.
    pub(super) fn draws(&self) -> u64 {
        self.draws
    }

    /// The forces on the vessel.
    pub(super) fn peaks(&mut self) -> Option<&mut Peaks> {
        self.of.as_mut().map(|(_, peaks)| peaks)
    }

    /// Takes the vessel of a trial and the way through it, if it is another one, which has felt nothing yet; says whether
    /// it is.
    ///
    /// # Errors
    /// When it does not fit into the memory that the device allows.
    pub(super) fn take(&mut self, mesh: &Arc<TriMesh>, route: &RouteShown) -> Result<bool, SurfaceError> {
        if self.of.as_ref().is_some_and(|(of, _)| Arc::ptr_eq(of, mesh)) {
            return Ok(false);
        }
        let (device, queue) = (&self.device, &self.queue);
        upload(device, queue, &mut self.vessel, mesh)?;
        let body = closed(mesh);
        self.body.set_positions(device, queue, &body.positions)?;
        let normals = vec![Vec3::ZERO; body.positions.len()];
        self.body.set_level(device, queue, &body.triangles, &[], &normals)?;
        self.body.set_scalars(device, queue, Some(&along(&body.positions, &route.points)))?;
        self.of = Some((mesh.clone(), Peaks::new(mesh)));
        self.uploaded = 0;
        self.measured = None;
        self.changes += 1;
        Ok(true)
    }

    /// Lets the wall feel this.
    pub(super) fn feel(&mut self, touches: &[crate::trial::frame::Touch]) {
        if let Some((mesh, peaks)) = &mut self.of {
            peaks.take(mesh, touches);
        }
    }

    /// Puts the wire along these nodes.
    ///
    /// # Errors
    /// When it does not fit into the memory that the device allows.
    pub(super) fn set_wire(&mut self, nodes: &[[f32; 3]], radius: f32) -> Result<(), SurfaceError> {
        self.changes += 1;
        self.wire.set(&self.device, &self.queue, nodes, radius)?;
        if let Some((_, peaks)) = &self.of
            && self.uploaded != peaks.changes
        {
            self.vessel.set_scalars(&self.device, &self.queue, Some(peaks.forces()))?;
            self.uploaded = peaks.changes;
        }
        Ok(())
    }

    /// Draws the wire in the vessel, if it would look other than it does, and gives the texture that it is in.
    pub(super) fn vessel(&mut self, camera: &Camera, size: [u32; 2], style: &Style) -> TextureId {
        let of = Drawn { camera: *camera, size, style: *style, changes: self.changes };
        let Some(target) = self.views[0].stale(&self.device, size, of) else { return self.views[0].id() };
        self.draws += 1;
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("trial") });
        self.renderer.draw(&mut encoder, target, camera, &[&Backdrop, &self.wire, &Glass(&self.vessel)], style);
        self.queue.submit([encoder.finish()]);
        self.views[0].id()
    }

    /// Draws what the tip sees, if that is other than it was, and gives the texture that it is in.
    pub(super) fn tip(&mut self, camera: &Camera, size: [u32; 2], style: &Style) -> TextureId {
        let of = Drawn { camera: *camera, size, style: *style, changes: self.changes };
        let Some(target) = self.views[1].stale(&self.device, size, of) else { return self.views[1].id() };
        self.draws += 1;
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("tip") });
        self.renderer.draw(&mut encoder, target, camera, &[&Inside(&self.vessel)], style);
        self.queue.submit([encoder.finish()]);
        self.views[1].id()
    }

    /// The texture that the fluoroscopy is in, and whether it has to be exposed anew for this size.
    pub(super) fn picture(&mut self, size: [u32; 2]) -> (TextureId, bool) {
        let is_other = self.picture.resize(&self.device, size);
        if is_other {
            self.measured = None;
        }
        (self.picture.id(), is_other)
    }

    /// Takes a fluoroscopy: of the wire at these nodes, or without any as it was seen last.
    ///
    /// # Errors
    /// When the wire does not fit into the memory that the device allows.
    pub(super) fn expose(
        &mut self,
        camera: &Camera,
        wire: Option<(&[[f32; 3]], f32)>,
        exposure: &Exposure,
    ) -> Result<(), SurfaceError> {
        if let Some((nodes, radius)) = wire {
            self.seen.set(&self.device, &self.queue, nodes, radius)?;
        }
        self.draws += 1;
        let is_other = self.measured.replace(*camera) != Some(*camera);
        let mut encoder =
            self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("fluoroscopy") });
        let things: &[&dyn Draw] = &[&Body(&self.body), &self.seen];
        self.renderer.expose(&mut encoder, self.picture.target(), camera, things, exposure, is_other);
        self.queue.submit([encoder.finish()]);
        Ok(())
    }

    /// Times the drawing of one frame of 1280x800 of `mesh`, in ms; the answer comes later.
    ///
    /// # Errors
    /// When it does not fit into the memory that the device allows.
    pub(super) fn time_frame(&self, mesh: &TriMesh, style: &Style) -> Result<Receiver<f64>, SurfaceError> {
        let mut vessel = GpuSurface::new(&self.device, &self.queue, &[])?;
        upload(&self.device, &self.queue, &mut vessel, mesh)?;
        let target = ViewTarget::new(&self.device, TIMED_SIZE[0], TIMED_SIZE[1]);
        let mut camera = Camera::default();
        camera.fit(&mesh.bounds(), target.aspect());
        let frame = || {
            let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.renderer.draw(&mut encoder, &target, &camera, &[&Backdrop, &self.wire, &Glass(&vessel)], style);
            encoder.finish()
        };
        // The first one compiles the pipelines, which is not timed.
        drop(frame());
        let (sender, receiver) = channel();
        let since = Instant::now();
        self.queue.submit((0..TIMED).map(|_| frame()));
        self.queue.on_submitted_work_done(move || {
            // Whoever asked may have left meanwhile.
            let _ = sender.send(since.elapsed().as_secs_f64() * 1000.0 / f64::from(TIMED));
        });
        Ok(receiver)
    }
}

/// A surface with its triangles and no forces.
fn upload(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    vessel: &mut GpuSurface,
    mesh: &TriMesh,
) -> Result<(), SurfaceError> {
    vessel.set_positions(device, queue, &mesh.positions)?;
    let normals = vertex_normals(&mesh.positions, &mesh.triangles, Weighting::Area);
    vessel.set_level(device, queue, &mesh.triangles, &[], &normals)?;
    vessel.set_scalars(device, queue, Some(&vec![0.0; mesh.positions.len()]))
}

/// The surface with its open ends closed by fans about their middles: X-rays have to leave what they enter.
fn closed(mesh: &TriMesh) -> TriMesh {
    let mut body = mesh.clone();
    for ring in boundary_loops(&Topology::new(mesh.positions.len(), &mesh.triangles)) {
        let sum: Vec3 = ring.iter().map(|&v| mesh.positions[v as usize]).sum();
        let middle = body.positions.len() as u32;
        body.positions.push(sum / ring.len() as f32);
        let next = ring.iter().cycle().skip(1);
        body.triangles.extend(ring.iter().zip(next).map(|(&a, &b)| [b, a, middle]));
    }
    body
}

/// How far along the way each node is, 0 to 1: by the nearest of some of its points.
fn along(nodes: &[Vec3], way: &[[f32; 3]]) -> Vec<f32> {
    const MAX_POINTS: usize = 96;
    let last = way.len().saturating_sub(1);
    let steps = last.clamp(1, MAX_POINTS);
    let some: Vec<Vec3> = (0..=steps).filter_map(|i| way.get(i * last / steps)).map(|&p| p.into()).collect();
    let nearest = |p: &Vec3| {
        let away = |i: &usize| some[*i].distance_squared(*p);
        (0..some.len()).min_by(|a, b| away(a).total_cmp(&away(b))).unwrap_or(0)
    };
    nodes.iter().map(|p| nearest(p) as f32 / steps as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::volume;

    #[test]
    fn a_closed_surface_has_no_open_ends_and_keeps_its_volume() {
        let mesh = crate::phantom::generate(crate::phantom::Sample::Aorta, 20_000).unwrap();
        let of = |mesh: &TriMesh| Topology::new(mesh.positions.len(), &mesh.triangles);
        assert!(!boundary_loops(&of(&mesh)).is_empty());
        let body = closed(&mesh);
        let topology = of(&body);
        assert!(boundary_loops(&topology).is_empty() && topology.is_consistent());
        let (before, after) = (volume(&mesh, &of(&mesh)), volume(&body, &topology));
        assert!((after / before - 1.0).abs() < 1e-3, "{before} {after}");
    }

    #[test]
    fn places_along_the_way_go_from_none_to_all() {
        let way: Vec<[f32; 3]> = (0..200).map(|i| [0.0, 0.0, i as f32]).collect();
        let places = along(&[Vec3::new(5.0, 0.0, -3.0), Vec3::new(0.0, 5.0, 99.5), Vec3::new(0.0, 0.0, 250.0)], &way);
        assert_eq!((places[0], places[2]), (0.0, 1.0));
        assert!((places[1] - 0.5).abs() < 0.01);
    }
}
