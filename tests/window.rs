//! The desktop window: it starts, shows the sample and closes when it is asked to, and opens again where its graphics
//! device is lost, on a real X server (xvfb-run gives one; `cargo xtask test` runs the tests under it). Without a
//! display the trials are reported as ignored.

use std::cell::Cell;
use std::io::Write as _;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use eframe::egui_wgpu::WgpuSetupExisting;
use libtest_mimic::{Arguments, Failed, Trial};
use lumen::render::device_descriptor;
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{
    AtomEnum, BUTTON_PRESS_EVENT, BUTTON_RELEASE_EVENT, ClientMessageEvent, ConnectionExt, EventMask, ImageFormat,
    MOTION_NOTIFY_EVENT, Window,
};
use x11rb::protocol::xtest::ConnectionExt as _;
use x11rb::rust_connection::RustConnection;

/// What is set where this program is to be the window, on a device that is lost once a line is read.
const LOSES: &str = "LUMEN_TEST_LOSES_DEVICE";

fn main() {
    if std::env::var_os(LOSES).is_some() {
        return loses_its_device();
    }
    let has_display = std::env::var_os("DISPLAY").is_some();
    if !has_display {
        eprintln!("no display: run the tests under xvfb-run");
    }
    let trials = vec![
        Trial::test("the window starts, shows the sample and closes", run).with_ignored_flag(!has_display),
        Trial::test("a window whose device is lost opens again and shows what it showed", open_again)
            .with_ignored_flag(!has_display),
    ];
    // A server whose last client has left begins anew, and refuses the next while it does.
    let _stays = has_display.then(|| x11rb::connect(None).expect("an X server"));
    // They look for a window by its title.
    let arguments = Arguments { test_threads: Some(1), ..Arguments::from_args() };
    libtest_mimic::run(&arguments, trials).exit();
}

/// The program's own window; the first has a device that does not live long.
fn loses_its_device() {
    let is_first = Cell::new(true);
    let shown = lumen::desktop::run_on(None, |mut graphics| {
        if is_first.replace(false) {
            graphics.wgpu_setup = doomed().into();
        }
        graphics
    });
    if let Err(error) = shown {
        eprintln!("the window could not be opened: {error}");
        std::process::exit(1);
    }
}

/// A device that is lost once a line has come, at the next that is asked of it.
fn doomed() -> WgpuSetupExisting {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::VULKAN,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()));
    let adapter = adapter.expect("a graphics device (in a container: mesa-vulkan-drivers)");
    let (device, queue) = pollster::block_on(adapter.request_device(&device_descriptor(&adapter))).expect("a device");
    let (end, line) = (device.clone(), queue.clone());
    std::thread::spawn(move || {
        std::io::stdin().read_line(&mut String::new()).expect("a line");
        line.on_submitted_work_done(move || {
            end.destroy();
            // One that is given up says so once it has come to rest.
            end.poll(wgpu::PollType::wait_indefinitely()).expect("a device at rest");
        });
    });
    WgpuSetupExisting { instance, adapter, device, queue }
}

/// Ends the program whatever happens.
struct Program(Child);

impl Drop for Program {
    fn drop(&mut self) {
        // It has usually ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn run() -> Result<(), Failed> {
    let command = Command::new(env!("CARGO_BIN_EXE_lumen")).env_remove("WAYLAND_DISPLAY").spawn()?;
    let mut program = Program(command);
    let (x, screen) = x11rb::connect(None)?;
    let root = x.setup().roots[screen].root;
    let window = wait(Duration::from_secs(60), || find(&x, root))?;
    // The matte vessel is warm, all else is grey or blue.
    wait(Duration::from_secs(60), || warm_pixels(&x, window).filter(|&count| count > 10_000))?;
    close(&x, window)?;
    let status = wait(Duration::from_secs(20), || program.0.try_wait().ok().flatten())?;
    if status.success() { Ok(()) } else { Err(format!("the program ended with {status}").into()) }
}

fn open_again() -> Result<(), Failed> {
    let mut command = Command::new(std::env::current_exe()?);
    command.env(LOSES, "1").env_remove("WAYLAND_DISPLAY").stdin(Stdio::piped());
    let mut program = Program(command.spawn()?);
    let (x, screen) = x11rb::connect(None)?;
    let root = x.setup().roots[screen].root;
    let window = wait(Duration::from_secs(60), || find(&x, root))?;
    let vessel = |window: Window| warm_pixels(&x, window).filter(|&count| count > 10_000);
    wait(Duration::from_secs(60), || vessel(window))?;
    let size = |window: Window| x.get_geometry(window).ok()?.reply().ok().map(|it| (it.width, it.height));
    let before = size(window);

    // A surface that turns is drawn in each frame, which is where a loss is noticed.
    let mut line = program.0.stdin.take().ok_or("no line to the program")?;
    drag(&x, root, window, || line.write_all(b"\n"))?;
    let again = wait(Duration::from_secs(60), || find(&x, root).filter(|&found| found != window))?;
    wait(Duration::from_secs(60), || vessel(again))?;
    if size(again) != before {
        return Err(format!("the window was {before:?} large, and is {:?}", size(again)).into());
    }
    close(&x, again)?;
    let status = wait(Duration::from_secs(20), || program.0.try_wait().ok().flatten())?;
    if status.success() { Ok(()) } else { Err(format!("the program ended with {status}").into()) }
}

/// Asks again and again until there is an answer.
fn wait<T>(limit: Duration, mut ask: impl FnMut() -> Option<T>) -> Result<T, Failed> {
    let start = Instant::now();
    loop {
        if let Some(answer) = ask() {
            return Ok(answer);
        }
        if start.elapsed() > limit {
            return Err(format!("nothing after {limit:?}").into());
        }
        std::thread::sleep(Duration::from_millis(200));
    }
}

/// The window whose title is "Lumen".
fn find(x: &RustConnection, parent: Window) -> Option<Window> {
    for child in x.query_tree(parent).ok()?.reply().ok()?.children {
        let title = x.get_property(false, child, AtomEnum::WM_NAME, AtomEnum::ANY, 0, 64).ok()?.reply().ok()?;
        if title.value == b"Lumen" {
            return Some(child);
        }
        if let Some(found) = find(x, child) {
            return Some(found);
        }
    }
    None
}

/// Turns the surface in the left view, and calls `midway` while it turns.
fn drag(
    x: &RustConnection,
    root: Window,
    window: Window,
    midway: impl FnOnce() -> std::io::Result<()>,
) -> Result<(), Failed> {
    let size = x.get_geometry(window)?.reply()?;
    let start = x.translate_coordinates(window, root, (size.width / 3) as i16, (size.height / 2) as i16)?.reply()?;
    let pointer = |kind, button, along| -> Result<(), Failed> {
        x.xtest_fake_input(kind, button, 0, root, start.dst_x + along, start.dst_y, 0)?;
        x.flush()?;
        std::thread::sleep(Duration::from_millis(20));
        Ok(())
    };
    pointer(MOTION_NOTIFY_EVENT, 0, 0)?;
    pointer(BUTTON_PRESS_EVENT, 1, 0)?;
    (1..=50).try_for_each(|step| pointer(MOTION_NOTIFY_EVENT, 0, step))?;
    midway()?;
    (51..=100).try_for_each(|step| pointer(MOTION_NOTIFY_EVENT, 0, step))?;
    pointer(BUTTON_RELEASE_EVENT, 1, 0)
}

/// What the window shows: blue, green, red and nothing for each pixel.
fn pixels(x: &RustConnection, window: Window) -> Option<Vec<u8>> {
    let size = x.get_geometry(window).ok()?.reply().ok()?;
    let image = x.get_image(ImageFormat::Z_PIXMAP, window, 0, 0, size.width, size.height, u32::MAX);
    Some(image.ok()?.reply().ok()?.data)
}

/// Pixels that are distinctly more red than blue.
fn warm_pixels(x: &RustConnection, window: Window) -> Option<usize> {
    Some(pixels(x, window)?.chunks_exact(4).filter(|bgrx| bgrx[2] > 80 && bgrx[2] > bgrx[0].saturating_add(40)).count())
}

fn close(x: &RustConnection, window: Window) -> Result<(), Failed> {
    let atom = |name: &[u8]| -> Result<u32, Failed> { Ok(x.intern_atom(false, name)?.reply()?.atom) };
    let (protocols, delete) = (atom(b"WM_PROTOCOLS")?, atom(b"WM_DELETE_WINDOW")?);
    let message = ClientMessageEvent::new(32, window, protocols, [delete, 0, 0, 0, 0]);
    x.send_event(false, window, EventMask::NO_EVENT, message)?;
    x.flush()?;
    Ok(())
}
