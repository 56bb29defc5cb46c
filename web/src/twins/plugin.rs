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
    static MIRROR: RefCell<Option<Mirror>> = const { RefCell::new(None) };
}

type Actions = Arc<Mutex<Vec<ActionRequest>>>;

/// Starts to mirror what `ctx` shows on `canvas` into `container`.
///
/// # Errors
///
/// What the browser answers when a listener cannot be added.
pub(crate) fn attach(ctx: &egui::Context, canvas: &HtmlElement, container: &Element) -> Result<(), JsValue> {
    let document = container.owner_document().ok_or("the twins' container is in no document")?;
    let actions = Actions::default();
    listen(container, "click", Action::Click, ctx, &actions, None)?;
    // The keyboard belongs to the canvas, where egui hears it.
    listen(container, "focusin", Action::Focus, ctx, &actions, Some(canvas.clone()))?;
    MIRROR.set(Some(Mirror::new(document, canvas.clone().into(), container.clone())));
    ctx.enable_accesskit();
    ctx.add_plugin(Twins { actions });
    Ok(())
}

/// Turns an event on a twin into an action that egui hears in the next pass.
fn listen(
    container: &Element,
    event: &str,
    action: Action,
    ctx: &egui::Context,
    actions: &Actions,
    keyboard: Option<HtmlElement>,
) -> Result<(), JsValue> {
    let ctx = ctx.clone();
    let actions = Arc::clone(actions);
    let heard = Closure::<dyn Fn(web_sys::Event)>::new(move |event: web_sys::Event| {
        let target = event.target().and_then(|target| target.dyn_into::<Element>().ok());
        let Some(target_node) = target.as_ref().and_then(node_of) else { return };
        let request = ActionRequest { action, target_tree: TreeId::ROOT, target_node, data: None };
        actions.lock().unwrap_or_else(PoisonError::into_inner).push(request);
        if let Some(keyboard) = &keyboard {
            // It fails only for an element that has left the page.
            let _ = keyboard.focus();
        }
        ctx.request_repaint();
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
        MIRROR.with_borrow_mut(|mirror| {
            let Some(mirror) = mirror else { return };
            if let Err(error) = mirror.show(&twins(&update, device_pixels), update.focus) {
                web_sys::console::error_2(&"The controls' twins are out of step:".into(), &error);
            }
        });
    }
}
