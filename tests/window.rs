//! The desktop window: it starts, shows the sample and closes when it is asked to, on a real X server (xvfb-run
//! gives one; `cargo xtask test` runs the tests under it). Without a display the trial is reported as ignored.

use std::process::{Child, Command};
use std::time::{Duration, Instant};

use libtest_mimic::{Arguments, Failed, Trial};
use x11rb::connection::Connection;
use x11rb::protocol::xproto::{AtomEnum, ClientMessageEvent, ConnectionExt, EventMask, ImageFormat, Window};
use x11rb::rust_connection::RustConnection;

fn main() {
    let has_display = std::env::var_os("DISPLAY").is_some();
    if !has_display {
        eprintln!("no display: run the tests under xvfb-run");
    }
    let trial = Trial::test("the window starts, shows the sample and closes", run).with_ignored_flag(!has_display);
    libtest_mimic::run(&Arguments::from_args(), vec![trial]).exit();
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

/// Pixels that are distinctly more red than blue.
fn warm_pixels(x: &RustConnection, window: Window) -> Option<usize> {
    let size = x.get_geometry(window).ok()?.reply().ok()?;
    let image =
        x.get_image(ImageFormat::Z_PIXMAP, window, 0, 0, size.width, size.height, u32::MAX).ok()?.reply().ok()?;
    Some(image.data.chunks_exact(4).filter(|bgrx| bgrx[2] > 80 && bgrx[2] > bgrx[0].saturating_add(40)).count())
}

fn close(x: &RustConnection, window: Window) -> Result<(), Failed> {
    let atom = |name: &[u8]| -> Result<u32, Failed> { Ok(x.intern_atom(false, name)?.reply()?.atom) };
    let (protocols, delete) = (atom(b"WM_PROTOCOLS")?, atom(b"WM_DELETE_WINDOW")?);
    let message = ClientMessageEvent::new(32, window, protocols, [delete, 0, 0, 0, 0]);
    x.send_event(false, window, EventMask::NO_EVENT, message)?;
    x.flush()?;
    Ok(())
}
