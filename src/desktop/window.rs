//! The window of the desktop, opened again with the same app where its graphics device is lost.

use std::cell::RefCell;
use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;
use std::time::Instant;

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup};
use egui::{ViewportBuilder, ViewportCommand, ViewportInfo};

use super::{Desktop, files};
use crate::app::{LastingApp, LumenApp, OnEnd, Restarts};
use crate::render::{Fault, device_descriptor};
use crate::say;

/// A device that has to be replaced, and how the window stood.
type End = Rc<RefCell<Option<(Fault, ViewportInfo)>>>;

/// Opens the window and stays until it is closed. `file` is opened in place of the sample, if there is one.
///
/// # Errors
/// When there is no display or no graphics device.
pub fn run(file: Option<&Path>) -> eframe::Result {
    run_on(file, |graphics| graphics)
}

/// As [`run`], on what `choose` makes of Lumen's own choice of graphics, once for each window: for whoever brings a device of
/// his own, as the test of a lost one does.
///
/// # Errors
/// When there is no display or no graphics device.
pub fn run_on(file: Option<&Path>, choose: impl Fn(WgpuConfiguration) -> WgpuConfiguration) -> eframe::Result {
    let mut viewport = ViewportBuilder::default()
        .with_title("Lumen")
        .with_app_id("lumen")
        .with_inner_size([1280.0, 800.0])
        .with_min_inner_size([360.0, 480.0]);
    let kept: Rc<RefCell<Option<LastingApp>>> = Rc::default();
    let (mut restarts, since) = (Restarts::default(), Instant::now());
    loop {
        let end = End::default();
        let shown = show(viewport.clone(), choose(graphics()), &kept, &end, file);
        let Some(app) = kept.borrow().clone() else { return shown };
        let ended = end.take();
        match (&shown, &ended) {
            (Ok(()), None) => return Ok(()),
            (_, Some((fault, info))) => {
                eprintln!("lumen: {fault}");
                viewport = placed(viewport, info);
            }
            (Err(error), None) => eprintln!("lumen: the window could not be opened again: {error}"),
        }
        app.leave();
        if shown.is_err() || !restarts.may(since.elapsed().as_secs_f64()) {
            if !goes_on() {
                return shown;
            }
            restarts.forget();
        }
    }
}

/// Shows one window until it is closed, with the app that is kept, or a new one.
fn show(
    viewport: ViewportBuilder,
    wgpu_options: WgpuConfiguration,
    kept: &Rc<RefCell<Option<LastingApp>>>,
    end: &End,
    file: Option<&Path>,
) -> eframe::Result {
    let options =
        eframe::NativeOptions { viewport, renderer: eframe::Renderer::Wgpu, wgpu_options, ..Default::default() };
    let create = |cc: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App>, _> {
        let device = cc.wgpu_render_state.as_ref();
        let app = match kept.take() {
            Some(app) => {
                app.resume(&cc.egui_ctx, device);
                app
            }
            None => {
                let platform = Desktop::new(&cc.egui_ctx);
                if let Some(path) = file {
                    files::read(vec![path.to_owned()], platform.reader());
                }
                LastingApp::new(LumenApp::new(&cc.egui_ctx, device, Box::new(platform)))
            }
        };
        let app = app.ending_by(closes(end));
        kept.replace(Some(app.clone()));
        Ok(Box::new(app))
    };
    eframe::run_native("Lumen", options, Box::new(create))
}

/// Closes the window and notes why.
fn closes(end: &End) -> OnEnd {
    let end = end.clone();
    Rc::new(move |ctx, fault| {
        end.borrow_mut().get_or_insert_with(|| (fault, ctx.input(|input| input.viewport().clone())));
        ctx.send_viewport_cmd(ViewportCommand::Close);
    })
}

/// The window where and as large as it was.
fn placed(viewport: ViewportBuilder, info: &ViewportInfo) -> ViewportBuilder {
    let viewport = viewport.with_maximized(info.maximized == Some(true)).with_fullscreen(info.fullscreen == Some(true));
    let viewport = match info.inner_rect {
        Some(rect) => viewport.with_inner_size(rect.size()),
        None => viewport,
    };
    match info.outer_rect {
        Some(rect) => viewport.with_position(rect.min),
        None => viewport,
    }
}

fn graphics() -> WgpuConfiguration {
    let mut configuration = WgpuConfiguration::default();
    if let WgpuSetup::CreateNew(setup) = &mut configuration.wgpu_setup {
        setup.device_descriptor = Arc::new(device_descriptor);
    }
    configuration
}

/// Asks whether to open the window again, where it has been lost again and again. Nothing can be drawn, so the system's
/// own dialog asks.
fn goes_on() -> bool {
    let again = say!("app-try-again");
    let answer = rfd::MessageDialog::new()
        .set_level(rfd::MessageLevel::Error)
        .set_title("Lumen")
        .set_description(say!("app-graphics-keep-failing"))
        .set_buttons(rfd::MessageButtons::OkCancelCustom(again.clone(), say!("app-close")))
        .show();
    matches!(answer, rfd::MessageDialogResult::Ok) || answer == rfd::MessageDialogResult::Custom(again)
}
