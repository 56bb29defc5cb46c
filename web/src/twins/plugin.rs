//! The link between egui and the page's twins: the tree goes out after each pass, actions come in before the next.

use std::cell::RefCell;
use std::sync::{Arc, Mutex, PoisonError};

use egui::accesskit::{Action, ActionRequest, TreeId};
use wasm_bindgen::prelude::*;
use web_sys::{Element, HtmlElement};

use super::mirror::{Mirror, node_of};
use super::tree::twins;

thread_local! {
    // A plugin has to be Send, which an element is not; the page has one thread and one mirror.
    static SHOWN: RefCell<Option<Shown>> = const { RefCell::new(None) };
}

/// What is mirrored: another canvas takes the place of one whose context is lost.
struct Shown {
    mirror: Mirror,
    canvas: HtmlElement,
    ctx: egui::Context,
    actions: Actions,
}

type Actions = Arc<Mutex<Vec<ActionRequest>>>;

/// Starts to mirror what `ctx` shows on `canvas` into `container`, in place of what was mirrored before.
///
/// # Errors
///
/// What the browser answers when a listener cannot be added.
pub(crate) fn attach(ctx: &egui::Context, canvas: &HtmlElement, container: &Element) -> Result<(), JsValue> {
    let document = container.owner_document().ok_or("the twins' container is in no document")?;
    let actions = Actions::default();
    let mirror = Mirror::new(document, canvas.clone().into(), container.clone());
    let shown = Shown { mirror, canvas: canvas.clone(), ctx: ctx.clone(), actions: Arc::clone(&actions) };
    let is_first = SHOWN.replace(Some(shown)).is_none();
    if is_first {
        listen(container, "click", Action::Click)?;
        listen(container, "focusin", Action::Focus)?;
    } else {
        container.set_inner_html("");
    }
    ctx.enable_accesskit();
    ctx.add_plugin(Twins { actions });
    Ok(())
}

/// Turns an event on a twin into an action that egui hears in the next pass.
fn listen(container: &Element, event: &str, action: Action) -> Result<(), JsValue> {
    let heard = Closure::<dyn Fn(web_sys::Event)>::new(move |event: web_sys::Event| {
        let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
        let Some(target_node) = target.as_ref().and_then(node_of) else { return };
        let canvas = SHOWN.with_borrow(|shown| {
            let Shown { actions, ctx, canvas, .. } = shown.as_ref()?;
            let request = ActionRequest { action, target_tree: TreeId::ROOT, target_node, data: None };
            actions.lock().unwrap_or_else(PoisonError::into_inner).push(request);
            ctx.request_repaint();
            Some(canvas.clone())
        });
        // The keyboard belongs to the canvas, where egui hears it. It fails only for one that has left the page.
        if let Some(canvas) = canvas.filter(|_| action == Action::Focus) {
            let _ = canvas.focus();
        }
    });
    container.add_event_listener_with_callback(event, heard.as_ref().unchecked_ref())?;
    // The container lives as long as the page.
    heard.forget();
    Ok(())
}

struct Twins {
    actions: Actions,
}

impl egui::Plugin for Twins {
    fn debug_name(&self) -> &'static str {
        "twins"
    }

    fn input_hook(&mut self, _: &egui::Context, input: &mut egui::RawInput) {
        let mut actions = self.actions.lock().unwrap_or_else(PoisonError::into_inner);
        input.events.extend(actions.drain(..).map(egui::Event::AccessKitActionRequest));
    }

    fn output_hook(&mut self, _: &egui::Context, output: &mut egui::FullOutput) {
        let Some(update) = output.platform_output.accesskit_update.take() else { return };
        let device_pixels = web_sys::window().map_or(1.0, |window| window.device_pixel_ratio());
        SHOWN.with_borrow_mut(|shown| {
            let Some(shown) = shown else { return };
            if let Err(error) = shown.mirror.show(&twins(&update, device_pixels), update.focus) {
                web_sys::console::error_2(&"The controls' twins are out of step:".into(), &error);
            }
        });
    }
}
