//! What the desktop gives the app: a window, file dialogs, and engines on threads.

mod files;
mod thread;

use std::sync::mpsc::{Receiver, Sender, channel};

use self::thread::ThreadLink;
use crate::app::trial::Offer;
use crate::app::{LumenApp, Platform, PlatformEvent};
use crate::engine::trial::TrialLink;
use crate::engine::{Engine, Link, TrialEngine};

/// Opens the window and stays until it is closed. `file` is opened in place of the sample, if there is one.
///
/// # Errors
/// When there is no display or no graphics device.
pub fn run(file: Option<&std::path::Path>) -> eframe::Result {
    let viewport = egui::ViewportBuilder::default()
        .with_title("Lumen")
        .with_app_id("lumen")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([360.0, 480.0]);
    let options = eframe::NativeOptions { viewport, renderer: eframe::Renderer::Wgpu, ..Default::default() };
    let file = file.map(std::path::Path::to_owned);
    let create = move |cc: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
        let platform = Desktop::new(&cc.egui_ctx);
        if let Some(path) = file {
            files::read(path, platform.sender.clone(), cc.egui_ctx.clone());
        }
        Ok(Box::new(LumenApp::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), Box::new(platform))))
    };
    eframe::run_native("Lumen", options, Box::new(create))
}

/// The desktop.
pub struct Desktop {
    link: ThreadLink<Engine>,
    trial: ThreadLink<TrialEngine>,
    sender: Sender<PlatformEvent>,
    events: Receiver<PlatformEvent>,
}

impl Desktop {
    /// A desktop with engines on threads of their own, which wake `ctx` when they have something to say.
    pub fn new(ctx: &egui::Context) -> Self {
        let (sender, events) = channel();
        Self { link: ThreadLink::new(ctx.clone()), trial: ThreadLink::new(ctx.clone()), sender, events }
    }
}

impl Platform for Desktop {
    fn link(&mut self) -> &mut dyn Link {
        &mut self.link
    }

    fn trial(&mut self) -> &mut TrialLink {
        &mut self.trial
    }

    fn choose_file(&mut self, ctx: &egui::Context) {
        files::choose(self.sender.clone(), ctx.clone());
    }

    fn read_dropped(&mut self, file: egui::DroppedFileHandle, ctx: &egui::Context) {
        files::read(file.path().to_owned(), self.sender.clone(), ctx.clone());
    }

    fn offer_file(&mut self, name: &str, bytes: Vec<u8>, ctx: &egui::Context) {
        files::save(name.to_owned(), bytes, self.sender.clone(), ctx.clone());
    }

    fn offer_pair(&mut self, pair: [Offer; 2], ctx: &egui::Context) {
        files::save_pair(pair, self.sender.clone(), ctx.clone());
    }

    fn poll(&mut self) -> Option<PlatformEvent> {
        self.events.try_recv().ok()
    }
}
