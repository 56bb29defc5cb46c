//! The app outlives the graphics device. Where a device is lost, eframe is taken down and started again with the same
//! app: document, settings, history, camera and trial stand, and what was on the device is made again from them.

use std::cell::{Cell, RefCell};
use std::rc::Rc;

use egui::{Context, Ui};

use super::lumen_app::LumenApp;
use crate::render::Fault;

/// Called once the device has to be replaced, from within a frame.
pub type OnEnd = Rc<dyn Fn(&Context, Fault)>;

/// The app as eframe runs it; clones are the same app.
#[derive(Clone)]
pub struct LastingApp {
    app: Rc<RefCell<LumenApp>>,
    on_end: OnEnd,
    /// Whether it was heard when keys come up, in the frame before.
    had_attention: Rc<Cell<bool>>,
}

impl LastingApp {
    /// An app that outlives its device.
    pub fn new(app: LumenApp) -> Self {
        Self { app: Rc::new(RefCell::new(app)), on_end: Rc::new(|_, _| {}), had_attention: Rc::new(Cell::new(true)) }
    }

    /// The same app, which calls `on_end` once its device has to be replaced.
    #[must_use]
    pub fn ending_by(&self, on_end: OnEnd) -> Self {
        Self { on_end, ..self.clone() }
    }

    /// Goes on in another window, with another device: see [`LumenApp::resume`].
    pub fn resume(&self, ctx: &Context, render_state: Option<&egui_wgpu::RenderState>) {
        self.app.borrow_mut().resume(ctx, render_state);
    }

    /// Hears of a fault from whoever knows before the device does.
    pub fn mark(&self, fault: Fault) {
        // Within a frame the device tells it by itself.
        if let Ok(app) = self.app.try_borrow() {
            app.device_health().take(fault);
        }
    }

    /// Lets go of the device: see [`LumenApp::leave`].
    pub fn leave(&self) {
        self.app.borrow_mut().leave();
    }

    /// Looks at the app, between two frames.
    pub fn look<R>(&self, at: impl FnOnce(&LumenApp) -> R) -> R {
        at(&self.app.borrow())
    }
}

impl eframe::App for LastingApp {
    fn raw_input_hook(&mut self, _: &Context, input: &mut egui::RawInput) {
        let has_attention = self.app.borrow().has_attention();
        input.focused &= has_attention;
        if self.had_attention.replace(has_attention) && !has_attention {
            // Keys that are held are let go: that they come up is not heard.
            input.events.push(egui::Event::WindowFocused(false));
        }
    }

    fn logic(&mut self, ctx: &Context, frame: &mut eframe::Frame) {
        let end = {
            let mut app = self.app.borrow_mut();
            eframe::App::logic(&mut *app, ctx, frame);
            app.device_end()
        };
        if let Some(fault) = end {
            (self.on_end)(ctx, fault);
        }
    }

    fn ui(&mut self, ui: &mut Ui, frame: &mut eframe::Frame) {
        // What is drawn goes into buffers of the device, and where a lost one gives none egui-wgpu panics.
        if self.app.borrow().device_end().is_none() {
            self.app.borrow_mut().ui(ui, frame);
        }
    }
}

/// How often a device may be replaced before the user is asked: a device that is lost again at once is not replaced for
/// ever.
#[derive(Clone, Debug, Default)]
pub struct Restarts {
    /// When it was, in seconds, the newest last.
    at_s: Vec<f64>,
}

impl Restarts {
    /// The most restarts within [`Self::SPAN_S`].
    pub const MAX: usize = 3;
    /// Seconds in which they are counted.
    pub const SPAN_S: f64 = 60.0;

    /// Counts a restart at `now_s`, by any clock that goes forwards; says whether it may be.
    pub fn may(&mut self, now_s: f64) -> bool {
        self.at_s.retain(|&at_s| now_s - at_s < Self::SPAN_S);
        let may = self.at_s.len() < Self::MAX;
        if may {
            self.at_s.push(now_s);
        }
        may
    }

    /// How many there were of late.
    pub fn of_late(&self) -> usize {
        self.at_s.len()
    }

    /// Begins anew: the user has asked for it.
    pub fn forget(&mut self) {
        self.at_s.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_restarts_in_a_minute_are_the_most() {
        let mut restarts = Restarts::default();
        assert!([0.0, 1.0, 2.0].iter().all(|&now| restarts.may(now)));
        assert!(!restarts.may(3.0) && !restarts.may(59.9));
        assert!(restarts.may(60.5), "the first is forgotten");
        assert!(!restarts.may(60.6));
        restarts.forget();
        assert!(restarts.may(60.7));
    }
}
