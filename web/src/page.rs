//! Starts the app on the page's canvas and tells the page how it goes.
//!
//! The page shows what `data-state` on its root element says (`www/style.css`): `loading` until here it becomes
//! `ready`, `failed` when the program has stopped (`www/boot.js` hears of that as an error event).

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup};
use eframe::wgpu::Backends;
use lumen::app::LumenApp;
use wasm_bindgen::prelude::*;
use web_sys::{Document, HtmlCanvasElement, Window};

use crate::platform::Browser;

/// Starts the app; the page is told of any failure.
pub(crate) fn start(window: Window) {
    report_panics();
    wasm_bindgen_futures::spawn_local(async move {
        if let Err(error) = run(&window).await {
            report_error(&named_error("The app could not start", &error));
        }
    });
}

async fn run(window: &Window) -> Result<(), JsValue> {
    let document = window.document().ok_or("the window shows no page")?;
    let canvas: HtmlCanvasElement = element(&document, "lumen")?.unchecked_into();
    let twins = element(&document, "twins")?;
    let options = eframe::WebOptions { wgpu_options: graphics(window), ..Default::default() };
    let (shown, ready) = (canvas.clone(), canvas.clone());
    let create: eframe::AppCreator<'static> = Box::new(move |cc| {
        crate::twins::attach(&cc.egui_ctx, &shown, &twins).map_err(|error| format!("{error:?}"))?;
        let platform = Box::new(Browser::new(&cc.egui_ctx));
        Ok(Box::new(LumenApp::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), platform)))
    });
    eframe::WebRunner::new().start(canvas, options, create).await?;
    document.document_element().ok_or("the page is empty")?.set_attribute("data-state", "ready")?;
    // Not before it is seen: what is hidden takes no focus, and without it keys do nothing until the first click.
    ready.focus()
}

fn element(document: &Document, id: &str) -> Result<web_sys::Element, JsValue> {
    document.get_element_by_id(id).ok_or_else(|| format!("the page has no element #{id}").into())
}

/// WebGPU where there is one, else WebGL2; `?renderer=webgl` or `?renderer=webgpu` in the address decides otherwise.
fn graphics(window: &Window) -> WgpuConfiguration {
    let asked = window.location().search().ok();
    let asked = asked.and_then(|search| web_sys::UrlSearchParams::new_with_str(&search).ok());
    let backends = match asked.and_then(|asked| asked.get("renderer")).as_deref() {
        Some("webgl") => Backends::GL,
        Some("webgpu") => Backends::BROWSER_WEBGPU,
        _ => Backends::BROWSER_WEBGPU | Backends::GL,
    };
    let mut configuration = WgpuConfiguration::default();
    if let WgpuSetup::CreateNew(setup) = &mut configuration.wgpu_setup {
        setup.instance_descriptor.backends = backends;
    }
    configuration
}

/// Makes a panic an error event: on the page `boot.js` shows its screen, from a Worker the page's end of the line
/// hears it.
pub(crate) fn report_panics() {
    std::panic::set_hook(Box::new(|info| report_error(&named_error("", &info.to_string().into()))));
}

fn named_error(what: &str, why: &JsValue) -> js_sys::Error {
    let why = why.as_string().unwrap_or_else(|| format!("{why:?}"));
    let error = js_sys::Error::new(&if what.is_empty() { why } else { format!("{what}: {why}") });
    error.set_name("Panic");
    error
}

#[wasm_bindgen]
extern "C" {
    // Global in pages and Workers alike: fires an error event as an exception that nobody caught would.
    #[wasm_bindgen(js_name = reportError)]
    fn report_error(error: &js_sys::Error);
}
