//! The views of a trial: the wire in the translucent vessel, what the tip sees, the fluoroscopy.

use super::backdrop::Backdrop;
use super::fluoroscopy::{Exposure, Fluoroscopy, FluoroscopyTarget};
use super::glass::Glass;
use super::paint::Paint;
use super::scene::{SceneBindings, SceneLayout};
use super::thickness::{Thickness, ThicknessFormat};
use super::wire::Wire;
use super::{Camera, GpuSurface, GpuWire, Style, ViewTarget};

/// The pipelines; one serves all views of a device.
#[derive(Debug)]
pub struct TrialRenderer {
    layout: SceneLayout,
    backdrop: Backdrop,
    glass: Glass,
    wire: Wire,
    thickness: Thickness,
    fluoroscopy: Fluoroscopy,
}

impl TrialRenderer {
    /// Compiles the shaders; `format` is what the adapter can add up thickness in.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, format: ThicknessFormat) -> Self {
        let layout = SceneLayout::new(device, queue);
        Self {
            backdrop: Backdrop::new(device, &layout),
            glass: Glass::new(device, &layout),
            wire: Wire::new(device, &layout),
            thickness: Thickness::new(device, &layout, format),
            fluoroscopy: Fluoroscopy::new(device, queue),
            layout,
        }
    }

    /// Records the wire within `vessel`, whose scalars are the forces in N that the style's map gives colours to.
    pub fn draw(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        target: &ViewTarget,
        camera: &Camera,
        (vessel, wire): (&GpuSurface, &GpuWire),
        style: &Style,
    ) {
        let bindings = self.bind(device, target.size(), camera, style);
        let mut pass = target.begin(encoder);
        bindings.set(&mut pass, 0);
        self.backdrop.draw(&mut pass);
        self.wire.draw(&mut pass, wire);
        self.glass.draw(&mut pass, vessel);
    }

    /// Records `vessel` from inside, with a light beside the eye; what is open is dark.
    pub fn draw_inside(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        target: &ViewTarget,
        camera: &Camera,
        vessel: &GpuSurface,
        style: &Style,
    ) {
        let bindings = self.bind(device, target.size(), camera, style);
        let mut pass = target.begin(encoder);
        bindings.set(&mut pass, 0);
        self.glass.draw_inside(&mut pass, vessel);
    }

    /// A target for fluoroscopies of `size` pixels, brought within 1 and what the device allows.
    pub fn fluoroscopy_target(&self, device: &wgpu::Device, size: [u32; 2]) -> FluoroscopyTarget {
        FluoroscopyTarget::of(device, size, self.thickness.format())
    }

    /// Records a fluoroscopy of the wire in `body`, a closed surface whose scalars say where along the vessel each node
    /// is, 0 to 1; `camera` looks from the tube. The thickness of the body stays in the target until it is `measured`
    /// anew, which it must be where the camera, the body or the target have changed.
    #[expect(clippy::too_many_arguments, reason = "one call, and a struct would only name the same things again")]
    pub fn expose(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        target: &FluoroscopyTarget,
        camera: &Camera,
        (body, wire): (&GpuSurface, &GpuWire),
        exposure: &Exposure,
        measured: bool,
    ) {
        let bindings = self.bind(device, target.size(), camera, &Style::LIGHT);
        let sums = &target.attachments;
        if measured {
            self.thickness.measure(encoder, &sums.thickness, &bindings, body);
        }
        self.wire.draw_shadow(encoder, &sums.shadow, &bindings, wire);
        self.fluoroscopy.expose(device, encoder, target, exposure);
    }

    fn bind(&self, device: &wgpu::Device, size: [u32; 2], camera: &Camera, style: &Style) -> SceneBindings {
        self.layout.bind(device, size, camera, style, &[Paint::of(style)])
    }
}
