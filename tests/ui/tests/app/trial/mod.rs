//! The trial, used as a user uses it: by buttons and keys. The engine is told what to say: what it computes is tested
//! elsewhere.

mod comparing;
mod drawing;
mod driving;
mod logging;
mod pictures;
mod refusing;
mod starting;
mod telling;

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use lumen_ui_tests::told::App;

/// What is offered where smoothing left no room for the wire.
const ADAPT: &str = "Adapt smoothing to the calibre and start";

/// Shows the numbers beside the three gauges.
fn unfold(harness: &mut App) {
    harness.get_by_label("More numbers").scroll_to_me();
    harness.run_steps(12);
    harness.get_by_label("More numbers").click();
    harness.run_steps(20);
}

/// The part of the window in which a view is, below its writing.
fn picture(harness: &mut App, view: &str) -> Vec<[u8; 4]> {
    let rect = harness.get_by_role_and_label(Role::Image, view).rect().shrink(2.0);
    let whole = harness.render().unwrap();
    let rows = rect.top() as u32 + 90..rect.bottom() as u32 - 30;
    rows.flat_map(|y| (rect.left() as u32..rect.right() as u32).map(move |x| (x, y)))
        .map(|(x, y)| whole.get_pixel(x, y).0)
        .collect()
}
