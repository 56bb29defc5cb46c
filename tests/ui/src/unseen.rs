//! Windows that nobody looks at: the graphics library checks all that is drawn in them, and draws nothing. On the processor
//! drawing took 42 % of the time of all window tests.

use std::cell::Cell;

use egui_kittest::TestRenderer;
use egui_kittest::wgpu::{WgpuTestRenderer, default_wgpu_setup};
use egui_wgpu::{WgpuSetup, wgpu};
use lumen_test_support::is_long;

thread_local! {
    static IS_SEEN: Cell<bool> = const { Cell::new(false) };
}

/// Opens a window whose pixels, or those of the pictures that the app saves, a test looks at.
pub fn seen<T>(open: impl FnOnce() -> T) -> T {
    IS_SEEN.set(true);
    let opened = open();
    IS_SEEN.set(false);
    opened
}

/// Whether a window that is opened now is drawn, by a real (software) graphics device; with `--long` all are.
pub(crate) fn is_seen() -> bool {
    IS_SEEN.get() || is_long()
}

/// A device that draws nothing.
pub(crate) struct Unseen(WgpuTestRenderer);

impl Unseen {
    pub(crate) fn new() -> Self {
        let mut setup = default_wgpu_setup();
        if let WgpuSetup::CreateNew(new) = &mut setup {
            new.instance_descriptor.backends = wgpu::Backends::NOOP;
            new.instance_descriptor.backend_options.noop.enable = true;
            new.instance_descriptor.backend_options.noop.device_type = Some(wgpu::DeviceType::Cpu);
        }
        Self(WgpuTestRenderer::from_setup(setup))
    }
}

impl TestRenderer for Unseen {
    fn setup_eframe(&self, cc: &mut eframe::CreationContext<'_>, frame: &mut eframe::Frame) {
        self.0.setup_eframe(cc, frame);
    }

    fn handle_delta(&mut self, delta: &mut egui::TexturesDelta) {
        self.0.handle_delta(delta);
    }

    fn render(&mut self, _: &egui::Context, _: &egui::FullOutput) -> Result<image::RgbaImage, String> {
        Err("nothing is drawn in this window: open it in `seen`".to_owned())
    }
}
