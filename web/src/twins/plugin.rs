//! The link between egui and the page's twins: the tree goes out after each pass, actions come in before the next.

use std::cell::RefCell;
use std::sync::{Arc, Mutex, PoisonError};

use egui::accesskit::{Action, ActionRequest, TreeId, TreeUpdate};
use wasm_bindgen::prelude::*;
use web_sys::{Element, HtmlElement};

use super::mirror::{Mirror, node_of};
use super::tree::twins;

thread_local! {
    // A plugin has to be Send, which an element is not; the page has one thread and one mirror.
    static SHOWN: RefCell<Option<Shown>> = const { RefCell::new(None) };
    static MIRROR_NEXT: Closure<dyn Fn()> = Closure::new(mirror_next);
}

/// What is mirrored: another canvas takes the place of one whose context is lost.
struct Shown {
    mirror: Mirror,
    canvas: HtmlElement,
    ctx: egui::Context,
    actions: Actions,
    /// What is mirrored, and how many device pixels made a CSS pixel.
    last: Option<(TreeUpdate, f64)>,
    /// What is to be mirrored.
    next: Option<TreeUpdate>,
    /// In how many tasks not all of it was, one after another.
    unfinished: u32,
}

/// How long elements are changed in one task, in ms. To find out what has changed, and to put it in place, comes on top.
const SLICE_MS: f64 = 4.0;

/// After so many unfinished tasks one goes to the end: where every frame changes much, what comes last would never be shown.
const MOST_UNFINISHED: u32 = 8;

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
    let shown = Shown {
        mirror,
        canvas: canvas.clone(),
        ctx: ctx.clone(),
        actions: Arc::clone(&actions),
        last: None,
        next: None,
        unfinished: 0,
    };
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
        SHOWN.with_borrow_mut(|shown| {
            let Some(shown) = shown else { return };
            let is_asked = shown.next.replace(update).is_some();
            if !is_asked {
                ask_to_mirror();
            }
        });
    }
}

/// Lets [`mirror_next`] run between two frames.
fn ask_to_mirror() {
    let window = web_sys::window();
    // It fails in a page that is being left.
    let _ = MIRROR_NEXT.with(|next| Some(window?.set_timeout_with_callback(next.as_ref().unchecked_ref())));
}

/// Shows the page's elements as the last pass has them, or some of them: no task of the page is long. Between two frames,
/// whose time is short enough without.
fn mirror_next() {
    let Some(window) = web_sys::window() else { return };
    let device_pixels = window.device_pixel_ratio();
    let now = || window.performance().map_or(0.0, |clock| clock.now());
    SHOWN.with_borrow_mut(|shown| {
        let Some(shown) = shown else { return };
        let Some(update) = shown.next.take() else { return };
        if shown.last.as_ref().is_some_and(|(last, pixels)| *last == update && *pixels == device_pixels) {
            return;
        }
        let twins = twins(&update, device_pixels);
        let (begun, may_rest) = (now(), shown.unfinished < MOST_UNFINISHED);
        let shows = shown.mirror.show(&twins, update.focus, || may_rest && now() - begun > SLICE_MS);
        shown.unfinished = if matches!(shows, Ok(false)) { shown.unfinished + 1 } else { 0 };
        match shows {
            Ok(true) => shown.last = Some((update, device_pixels)),
            Ok(false) => {
                (shown.next, shown.last) = (Some(update), None);
                ask_to_mirror();
            }
            Err(error) => {
                web_sys::console::error_2(&"The controls' twins are out of step:".into(), &error);
                shown.last = None;
            }
        }
    });
}
