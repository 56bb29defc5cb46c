//! The page's graphics: which of WebGPU and WebGL2, and what happens where the browser takes them back.
//!
//! A graphics context can be lost at any time (the driver is reset, the browser's own process for it dies, a telephone
//! wants its memory back), and neither canvas nor device comes back from that. So eframe is taken down and started
//! again on a fresh canvas with the same app, at most [`Restarts::MAX`] times in a minute; after that the page says so
//! and waits for the user, with all that was open still there.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

use eframe::egui_wgpu::{WgpuConfiguration, WgpuSetup};
use eframe::wgpu::Backends;
use lumen::app::{LastingApp, LumenApp, OnEnd, Restarts};
use lumen::render::{Fault, device_descriptor};
use lumen::say;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Document, Element, HtmlCanvasElement, HtmlElement, WebGl2RenderingContext, Window, console};

use crate::address;
use crate::platform::{Browser, TYPED};
use crate::screen::Screen;

/// How long to wait before graphics are first started again, in milliseconds: a browser whose process for them has died
/// needs a moment.
const PAUSE_MS: i32 = 250;

/// A canvas, and what hears of its lost context.
type Watched = (HtmlCanvasElement, Closure<dyn Fn()>);

/// What draws, and on what.
pub(crate) struct Stage {
    window: Window,
    document: Document,
    runner: eframe::WebRunner,
    app: RefCell<Option<LastingApp>>,
    restarts: RefCell<Restarts>,
    /// Whether the canvas in the page has been used: one gives a context of one kind, once.
    is_used: Cell<bool>,
    /// Whether the graphics are being started, or are given up.
    is_down: Cell<bool>,
    /// Whether WebGPU was what was lost.
    with_webgpu: Cell<bool>,
    /// What hears of a lost WebGL context, and from which canvas.
    watched: RefCell<Option<Watched>>,
    screen: Rc<Screen>,
}

impl Stage {
    /// Starts the app.
    ///
    /// # Errors
    ///
    /// What the browser answers where neither WebGPU nor WebGL2 can be started.
    pub(crate) async fn open(window: Window) -> Result<(), JsValue> {
        let document = window.document().ok_or("the window shows no page")?;
        let stage = Rc::new(Self {
            window,
            document,
            runner: eframe::WebRunner::new(),
            app: RefCell::default(),
            restarts: RefCell::default(),
            is_used: Cell::new(false),
            is_down: Cell::new(true),
            with_webgpu: Cell::new(false),
            watched: RefCell::default(),
            screen: Rc::default(),
        });
        stage.start().await?;
        stage.is_down.set(false);
        let again = Closure::<dyn Fn()>::new({
            let stage = Rc::clone(&stage);
            move || stage.ask_again()
        });
        stage.element("lost-again")?.add_event_listener_with_callback("click", again.as_ref().unchecked_ref())?;
        // It lives as long as the page.
        again.forget();
        Ok(())
    }

    /// Starts eframe on the first kind of graphics that can be had.
    async fn start(self: &Rc<Self>) -> Result<(), JsValue> {
        let mut why = JsValue::from_str("this browser has neither WebGPU nor WebGL2");
        for backend in self.kinds() {
            match self.start_with(backend).await {
                Ok(()) => {
                    self.set_state("ready")?;
                    // Not before it is seen: what is hidden takes no focus, and without it keys do nothing until the
                    // first click.
                    return self.element("lumen")?.unchecked_into::<HtmlElement>().focus();
                }
                Err(error) => {
                    console::warn_2(&format!("{backend:?} could not be started:").into(), &error);
                    why = error;
                }
            }
        }
        Err(why)
    }

    /// WebGPU and then WebGL2; `?renderer=webgl` or `?renderer=webgpu` in the address decides otherwise. WebGPU that was
    /// lost twice of late is left alone.
    fn kinds(&self) -> Vec<Backends> {
        match address::asked("renderer").as_deref() {
            Some("webgl") => vec![Backends::GL],
            Some("webgpu") => vec![Backends::BROWSER_WEBGPU],
            _ if self.with_webgpu.get() && self.restarts.borrow().of_late() > 1 => vec![Backends::GL],
            _ => vec![Backends::BROWSER_WEBGPU, Backends::GL],
        }
    }

    async fn start_with(self: &Rc<Self>, backends: Backends) -> Result<(), JsValue> {
        let is_webgl = backends == Backends::GL;
        if is_webgl && !self.has_webgl() {
            return Err("this browser gives no WebGL2 context at the moment".into());
        }
        if !is_webgl && !has_webgpu(&self.window) {
            return Err("this browser has no WebGPU here".into());
        }
        let canvas = self.canvas()?;
        let mut configuration = WgpuConfiguration::default();
        if let WgpuSetup::CreateNew(setup) = &mut configuration.wgpu_setup {
            setup.instance_descriptor.backends = backends;
            setup.device_descriptor = Arc::new(device_descriptor);
        }
        let options = eframe::WebOptions { wgpu_options: configuration, ..Default::default() };
        let stage = Rc::clone(self);
        let shown = canvas.clone();
        let create: eframe::AppCreator<'static> = Box::new(move |cc| Ok(Box::new(stage.enter(cc, &shown)?)));
        self.watch(&canvas)?;
        self.runner.start(canvas, options, create).await?;
        // What eframe puts into the page to be typed into has no name.
        if let Some(field) = self.document.query_selector("input[type=text]:not([aria-label])")? {
            field.set_id(TYPED);
            field.set_attribute("aria-label", &say!("scan-typed"))?;
        }
        self.with_webgpu.set(!is_webgl);
        Ok(())
    }

    /// The app on a new device: the one that is kept, or the first.
    fn enter(
        self: &Rc<Self>,
        cc: &eframe::CreationContext<'_>,
        canvas: &HtmlCanvasElement,
    ) -> Result<LastingApp, Box<dyn std::error::Error + Send + Sync>> {
        let twins = self.element("twins").map_err(|error| format!("{error:?}"))?;
        crate::twins::attach(&cc.egui_ctx, canvas, &twins).map_err(|error| format!("{error:?}"))?;
        self.screen.watch(&self.window, &cc.egui_ctx).map_err(|error| format!("{error:?}"))?;
        let device = cc.wgpu_render_state.as_ref();
        let mut kept = self.app.borrow_mut();
        if let Some(app) = &*kept {
            app.resume(&cc.egui_ctx, device);
        }
        let app = kept.get_or_insert_with(|| {
            let platform = Box::new(Browser::new(&cc.egui_ctx));
            LastingApp::new(LumenApp::new(&cc.egui_ctx, device, platform))
        });
        Ok(app.ending_by(self.on_end()))
    }

    fn on_end(self: &Rc<Self>) -> OnEnd {
        let stage = Rc::clone(self);
        Rc::new(move |_, fault| stage.lose(&fault))
    }

    /// A canvas that has given no context yet.
    fn canvas(&self) -> Result<HtmlCanvasElement, JsValue> {
        let canvas: HtmlCanvasElement = self.element("lumen")?.unchecked_into();
        if !self.is_used.replace(true) {
            return Ok(canvas);
        }
        let fresh: HtmlCanvasElement = canvas.clone_node()?.unchecked_into();
        fresh.remove_attribute("aria-activedescendant")?;
        canvas.replace_with_with_node_1(&fresh)?;
        Ok(fresh)
    }

    /// Listens for the loss of a WebGL context, which wgpu does not hear of. A WebGPU device tells its own.
    fn watch(self: &Rc<Self>, canvas: &HtmlCanvasElement) -> Result<(), JsValue> {
        const LOST: &str = "webglcontextlost";
        if let Some((old, heard)) = self.watched.take() {
            old.remove_event_listener_with_callback(LOST, heard.as_ref().unchecked_ref())?;
        }
        let heard = Closure::<dyn Fn()>::new({
            let stage = Rc::clone(self);
            move || stage.lose(&Fault::Lost("the browser took the WebGL context back".to_owned()))
        });
        canvas.add_event_listener_with_callback(LOST, heard.as_ref().unchecked_ref())?;
        self.watched.replace(Some((canvas.clone(), heard)));
        Ok(())
    }

    /// Whether a WebGL2 context can be had: one that is lost from its birth would end the program.
    fn has_webgl(&self) -> bool {
        let canvas = self.document.create_element("canvas").ok().and_then(|canvas| canvas.dyn_into().ok());
        let context = canvas.and_then(|canvas: HtmlCanvasElement| canvas.get_context("webgl2").ok().flatten());
        let context = context.and_then(|context| context.dyn_into::<WebGl2RenderingContext>().ok());
        let Some(context) = context.filter(|context| !context.is_context_lost()) else { return false };
        // Browsers keep a few at a time only.
        if let Ok(Some(extension)) = context.get_extension("WEBGL_lose_context") {
            extension.unchecked_into::<web_sys::WebglLoseContext>().lose_context();
        }
        true
    }

    /// The graphics are lost: they are started again once the present frame is over.
    fn lose(self: &Rc<Self>, fault: &Fault) {
        let tell = if matches!(fault, Fault::Refused(_)) { console::error_1 } else { console::warn_1 };
        tell(&fault.to_string().into());
        // Each frame asks, so that what is lost while it is being started is not passed over.
        if let Some(app) = &*self.app.borrow() {
            app.mark(fault.clone());
        }
        if self.is_down.replace(true) {
            return;
        }
        let stage = Rc::clone(self);
        spawn_local(async move { stage.recover().await });
    }

    async fn recover(self: &Rc<Self>) {
        self.runner.destroy();
        if let Some(app) = &*self.app.borrow() {
            app.leave();
        }
        loop {
            let now_s = self.window.performance().map_or(0.0, |clock| clock.now() / 1000.0);
            if !self.restarts.borrow_mut().may(now_s) {
                return self.give_up();
            }
            // Four times as long with each restart of late.
            let before = self.restarts.borrow().of_late().saturating_sub(1) as u32;
            self.pause(PAUSE_MS << (2 * before)).await;
            match self.start().await {
                Ok(()) => return self.is_down.set(false),
                Err(error) => console::warn_2(&"The graphics could not be started again:".into(), &error),
            }
        }
    }

    /// Says that nothing can be drawn, and waits for the user.
    fn give_up(&self) {
        self.runner.destroy();
        // Both fail only for a page that has lost its elements.
        let _ = self.set_state("lost");
        let _ = self.element("lost-again").map(|button| button.unchecked_into::<HtmlElement>().focus());
    }

    /// The user wants it tried again.
    fn ask_again(self: &Rc<Self>) {
        self.restarts.borrow_mut().forget();
        let _ = self.set_state("ready");
        let stage = Rc::clone(self);
        spawn_local(async move { stage.recover().await });
    }

    async fn pause(&self, ms: i32) {
        let promise = js_sys::Promise::new(&mut |done, _| {
            // Without a timer it is done at once.
            if self.window.set_timeout_with_callback_and_timeout_and_arguments_0(&done, ms).is_err() {
                let _ = done.call0(&JsValue::NULL);
            }
        });
        let _ = JsFuture::from(promise).await;
    }

    fn set_state(&self, state: &str) -> Result<(), JsValue> {
        self.document.document_element().ok_or("the page is empty")?.set_attribute("data-state", state)
    }

    fn element(&self, id: &str) -> Result<Element, JsValue> {
        self.document.get_element_by_id(id).ok_or_else(|| format!("the page has no element #{id}").into())
    }
}

/// Whether the page may use WebGPU: browsers offer it to secure pages only.
fn has_webgpu(window: &Window) -> bool {
    js_sys::Reflect::get(&window.navigator(), &"gpu".into()).is_ok_and(|gpu| !gpu.is_null() && !gpu.is_undefined())
}
