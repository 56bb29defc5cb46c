//! The screen that the window is on: it may come to one whose points have more pixels, or fewer, at the same size.
//!
//! eframe hears of that too, and gives the canvas its new pixels, which wipes it. But it paints only where something
//! asks for a frame, and nothing does: the page would stay blank until the pointer comes by. (By reading eframe's source:
//! in a browser without a screen the emulation of another ratio reaches neither the query nor the canvas, so no test
//! shows it.)

use std::cell::RefCell;
use std::rc::{Rc, Weak};

use egui::Context;
use wasm_bindgen::prelude::*;
use web_sys::{MediaQueryList, Window};

/// Paints again where the pixels of a point change.
#[derive(Default)]
pub(crate) struct Screen {
    asked: RefCell<Option<Asked>>,
}

/// A query that holds for the present number of pixels alone, and what hears when it no longer does.
struct Asked {
    query: MediaQueryList,
    heard: Closure<dyn Fn()>,
}

impl Screen {
    /// Has `ctx` painted again from now on, in place of what was before.
    ///
    /// # Errors
    ///
    /// What the browser answers to the query.
    pub(crate) fn watch(self: &Rc<Self>, window: &Window, ctx: &Context) -> Result<(), JsValue> {
        let Some(query) = window.match_media(&format!("(resolution: {}dppx)", window.device_pixel_ratio()))? else {
            return Ok(());
        };
        let heard = Closure::<dyn Fn()>::new({
            let (screen, window, ctx) = (Rc::downgrade(self), window.clone(), ctx.clone());
            move || changed(&screen, &window, &ctx)
        });
        query.add_event_listener_with_callback("change", heard.as_ref().unchecked_ref())?;
        self.forget()?;
        self.asked.replace(Some(Asked { query, heard }));
        Ok(())
    }

    fn forget(&self) -> Result<(), JsValue> {
        let Some(Asked { query, heard }) = self.asked.take() else { return Ok(()) };
        query.remove_event_listener_with_callback("change", heard.as_ref().unchecked_ref())
    }
}

/// The canvas has other pixels, or will have before the next frame.
fn changed(screen: &Weak<Screen>, window: &Window, ctx: &Context) {
    ctx.request_repaint();
    let (screen, window, ctx) = (screen.clone(), window.clone(), ctx.clone());
    // What is heard cannot be given up while it runs.
    wasm_bindgen_futures::spawn_local(async move {
        let Some(screen) = screen.upgrade() else { return };
        if let Err(error) = screen.watch(&window, &ctx) {
            web_sys::console::error_2(&"The next change of the pixels of a point will not be heard:".into(), &error);
        }
    });
}
