//! The app in windows that are not there, on a platform of plain memory ([`Memory`]), and what a hand does in them. [`told`]
//! is what a trial is told to say, [`hide`] the window that is hidden.

#![allow(clippy::disallowed_methods, reason = "it makes surfaces to look at")]

mod first;
mod memory;
pub mod told;
mod unseen;

use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use eframe::App as _;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use lumen::app::{LastingApp, LumenApp, PlatformEvent, State};
use lumen::render::Fault;

pub use self::memory::{Kept, Memory};
use self::memory::{MemoryPlatform, platform};
use self::unseen::Unseen;
pub use self::unseen::seen;

/// A window on a desktop, in points.
pub const DESKTOP: [f32; 2] = [1280.0, 800.0];
/// That of a phone.
pub const PHONE: [f32; 2] = [390.0, 844.0];

/// The app in a window of `size` points that is not there; nothing is drawn in it, unless it is opened in [`seen`]. Its samples
/// are [coarse](Memory::coarse_samples).
pub fn app(size: [f32; 2]) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    // What egui_kittest takes by default.
    app_at(size, 0.25)
}

/// The same, with so many seconds between two frames.
pub fn app_at(size: [f32; 2], step_dt: f32) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    app_on(platform(), size, step_dt)
}

/// [`app`] with samples as users have them, for what the paper or their own makers tell of them.
pub fn app_in_full(size: [f32; 2]) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    let (platform, memory) = platform();
    memory.borrow_mut().coarse_samples = None;
    app_on((platform, memory), size, 0.25)
}

/// [`app`] whose engine works for so long in each frame.
pub fn slow_app(size: [f32; 2], slice: Duration) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    let (platform, memory) = platform();
    memory.borrow_mut().slice = slice;
    app_on((platform, memory), size, 0.25)
}

/// [`app_at`] where what moves by itself is welcome. The engine waits for the first step of the test: the harness is built
/// with frames of its own, in which the motion at the start could end.
pub fn moving_app(size: [f32; 2], step_dt: f32) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    let (platform, memory) = platform();
    memory.borrow_mut().likes_motion = true;
    memory.borrow_mut().runs = false;
    let (harness, memory) = app_on((platform, memory), size, step_dt);
    memory.borrow_mut().runs = true;
    (harness, memory)
}

/// The same on a phone, held upright in the hand.
pub fn phone() -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    in_hand(PHONE, 0.25, false)
}

/// The same on what a finger points at: of this size, with so many seconds between two frames, where what moves by itself is
/// welcome or not.
pub fn in_hand(size: [f32; 2], step_dt: f32, likes_motion: bool) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    let (platform, memory) = platform();
    memory.borrow_mut().has_finger = true;
    memory.borrow_mut().likes_motion = likes_motion;
    app_on((platform, memory), size, step_dt)
}

/// The same as a page, which has an address, and of which `kept` outlives it.
pub fn page(size: [f32; 2], kept: Kept) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    page_with(size, kept, |_| {})
}

/// The same with samples as users have them: those that links lead to.
pub fn page_in_full(size: [f32; 2], kept: Kept) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    page_with(size, kept, |memory| memory.coarse_samples = None)
}

/// The same where the engine comes to nothing, as one that ends the page while it opens what was kept.
pub fn dying_page(size: [f32; 2], kept: Kept) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    page_with(size, kept, |memory| memory.runs = false)
}

fn page_with(
    size: [f32; 2],
    kept: Kept,
    change: impl FnOnce(&mut Memory),
) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    let (platform, memory) = platform();
    {
        let mut memory = memory.borrow_mut();
        memory.kept = Some(kept);
        memory.address = Some("https://page.test/lumen/".to_owned());
        change(&mut memory);
    }
    app_on((platform, memory), size, 0.25)
}

fn app_on(
    (platform, memory): (MemoryPlatform, Rc<RefCell<Memory>>),
    size: [f32; 2],
    step_dt: f32,
) -> (Harness<'static, LumenApp>, Rc<RefCell<Memory>>) {
    let builder = Harness::builder().with_size(size).with_max_steps(4000).with_step_dt(step_dt);
    let is_seen = unseen::is_seen();
    let builder = if is_seen { builder.wgpu() } else { builder.renderer(Unseen::new()) };
    let harness = builder.build_eframe(move |cc| {
        let app = LumenApp::new(&cc.egui_ctx, cc.wgpu_render_state.as_ref(), Box::new(platform));
        // To fit letters to pixels takes half a second of each window where nothing is optimised.
        cc.egui_ctx.all_styles_mut(|style| style.visuals.text_options.font_hinting &= is_seen);
        app
    });
    (harness, memory)
}

/// A window that is not there with a device of its own, and in it the app that is given or a new one, which outlives it.
pub struct LastingWindow {
    /// The window.
    pub harness: Harness<'static, LastingApp>,
    /// Its device.
    pub device: egui_wgpu::wgpu::Device,
    /// Why the device has to be replaced, once it has to be.
    pub end: Rc<RefCell<Option<Fault>>>,
}

impl LastingWindow {
    /// A window of `size` points.
    ///
    /// # Panics
    /// Where there is no graphics device.
    pub fn new(size: [f32; 2], kept: Option<LastingApp>) -> Self {
        let end: Rc<RefCell<Option<Fault>>> = Rc::default();
        let device: Rc<RefCell<Option<egui_wgpu::wgpu::Device>>> = Rc::default();
        let (noted, found) = (end.clone(), device.clone());
        let harness = Harness::builder().with_size(size).with_max_steps(4000).wgpu().build_eframe(move |cc| {
            let state = cc.wgpu_render_state.as_ref();
            found.replace(state.map(|state| state.device.clone()));
            let app = match kept {
                Some(app) => {
                    app.resume(&cc.egui_ctx, state);
                    app
                }
                None => LastingApp::new(LumenApp::new(&cc.egui_ctx, state, Box::new(platform().0))),
            };
            app.ending_by(Rc::new(move |_, fault| {
                noted.borrow_mut().get_or_insert(fault);
            }))
        });
        let device = device.take().expect("a window with a device");
        Self { harness, device, end }
    }

    /// Steps until the engine has nothing more to do.
    ///
    /// # Panics
    /// When that takes too long.
    pub fn settle(&mut self) {
        for _ in 0..2000 {
            self.harness.step();
            if self.harness.state().look(|app| is_settled(app.state())) {
                self.harness.run_steps(2);
                return;
            }
        }
        panic!("the engine does not come to an end");
    }
}

fn is_settled(state: &State) -> bool {
    let is_measured = state.document.as_ref().is_some_and(|document| {
        document
            .measured
            .as_ref()
            .is_some_and(|measured| !measured.deviation.is_empty() && measured.generation == state.generation())
    });
    is_measured && !state.is_busy()
}

/// Presses the pointer's button at a place, moves the pointer, and lets the button go.
pub fn drag(harness: &mut Harness<'_, LumenApp>, from: egui::Pos2, by: egui::Vec2) {
    harness.drag_at(from);
    harness.run_steps(2);
    harness.hover_at(from + by);
    harness.run_steps(2);
    harness.drop_at(from + by);
    harness.run_steps(2);
}

/// Lets the app look after itself `times` times as eframe does while the window is minimised or its tab hidden: no
/// frame is drawn, `App::logic` runs alone, and of the input it sees only that the window is hidden.
pub fn hide(harness: &mut Harness<'_, LumenApp>, times: usize) {
    let ctx = harness.ctx.clone();
    let hidden = egui::ViewportInfo { occluded: Some(true), minimized: Some(false), ..Default::default() };
    let input = egui::RawInput {
        viewports: [(egui::ViewportId::ROOT, hidden)].into_iter().collect(),
        focused: false,
        ..Default::default()
    };
    for _ in 0..times {
        let _ = ctx.run_logic(&input, |ctx| harness.state_mut().logic(ctx, &mut eframe::Frame::_new_kittest()));
    }
}

/// Steps until the engine has nothing more to do.
///
/// # Panics
/// When that takes too long.
pub fn settle(harness: &mut Harness<'_, LumenApp>) {
    for _ in 0..2000 {
        harness.step();
        if is_settled(harness.state().state()) {
            harness.run_steps(2);
            return;
        }
    }
    panic!("the engine does not come to an end");
}

/// Steps until nothing is under way in the background either: how far is safe, and the calibres.
///
/// # Panics
/// When that takes too long.
pub fn settle_wholly(harness: &mut Harness<'_, LumenApp>) {
    settle(harness);
    for _ in 0..4000 {
        let state = harness.state().state();
        let measured = state.document.as_ref().and_then(|document| document.measured.as_ref());
        let is_known = measured.is_some_and(|measured| measured.safe.is_some()) && state.calibre().is_some();
        if is_known && !state.is_deciding() {
            harness.run_steps(2);
            return;
        }
        harness.step();
    }
    panic!("the background does not come to an end");
}

/// The report that is saved as a web page.
///
/// # Panics
/// As [`offered`].
pub fn report_page(harness: &mut Harness<'_, LumenApp>, memory: &Rc<RefCell<Memory>>) -> String {
    for button in ["Save", "Report...", "Save as web page..."] {
        harness.get_by_role_and_label(Role::Button, button).click();
        harness.run_steps(3);
    }
    String::from_utf8(offered(harness, memory).1).expect("a page is text")
}

/// The file that is offered next: its name and its bytes. How many frames go by before a picture is drawn or a file is made is
/// the machine's affair, not the app's, so that the wait is by the clock.
///
/// # Panics
/// When there is none within two minutes.
pub fn offered(harness: &mut Harness<'_, LumenApp>, memory: &Rc<RefCell<Memory>>) -> (String, Vec<u8>) {
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_secs(120) {
        let file = memory.borrow_mut().offered.pop();
        if let Some(file) = file {
            return file;
        }
        harness.step();
    }
    panic!("no file is offered");
}

/// A tube about the z axis as an OBJ file: its radius, length and edges in the file's unit.
pub fn tube(radius: f64, length: f64, edge: f64) -> Vec<u8> {
    let around = (std::f64::consts::TAU * radius / edge).ceil() as usize;
    let rings = (length / edge) as usize;
    let vertex = |i: usize| {
        let angle = std::f64::consts::TAU * (i % around) as f64 / around as f64;
        format!("v {} {} {}\n", radius * angle.cos(), radius * angle.sin(), (i / around) as f64 * edge)
    };
    let quad = |i: usize| {
        let (ring, next) = (i / around * around, (i + 1) % around);
        let [a, b, c, d] = [i, ring + next, ring + around + next, i + around].map(|v| v + 1);
        format!("f {a} {b} {c} {d}\n")
    };
    let vertices = (0..around * rings).map(vertex);
    vertices.chain((0..around * (rings - 1)).map(quad)).collect::<String>().into_bytes()
}

/// Opens a file as if it had been chosen, and steps until nothing of it is under way any more.
///
/// # Panics
/// When that takes too long.
pub fn open(harness: &mut Harness<'_, LumenApp>, memory: &RefCell<Memory>, name: &str, bytes: Vec<u8>) {
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: name.to_owned(), bytes });
    harness.run_steps(20);
    settle_wholly(harness);
}

/// Unfolds a section of the panel: a step, or what is advanced in it.
pub fn unfold(harness: &mut Harness<'_, LumenApp>, section: &str) {
    harness.get_by_role_and_label(Role::DisclosureTriangle, section).scroll_to_me();
    harness.run_steps(12);
    harness.get_by_role_and_label(Role::DisclosureTriangle, section).click();
    harness.run_steps(12);
}

/// Whether some text that is shown holds this one.
pub fn says(harness: &Harness<'_, LumenApp>, text: &str) -> bool {
    harness.query_all_by_label_contains(text).next().is_some()
}
