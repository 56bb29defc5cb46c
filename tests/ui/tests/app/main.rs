//! The app without a window: its controls, keys, views and trial, driven as assistive tools drive them.

#![allow(clippy::disallowed_methods, reason = "a test compares within bounds")]

mod auto;
mod compare;
mod controls;
mod deviation;
mod device;
mod embedded;
mod explain;
mod flight;
mod keys;
mod labels;
mod language;
mod layout;
mod light;
mod measure;
mod mending;
mod motion;
mod opening;
mod presenter;
mod record;
mod recovery;
mod reference;
mod reveal;
mod scans;
mod sharing;
mod sight;
mod solver;
mod spoken;
mod targets;
mod teaching;
mod touch;
mod trial;
mod verdict;
mod vessels;
mod window;

/// Leaves a picture, four bytes a pixel, to look at in the target folder's `tmp`.
fn save(name: &str, [width, height]: [u32; 2], pixels: &[u8]) {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.png"));
    let mut encoder = png::Encoder::new(std::fs::File::create(path).unwrap(), width, height);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(pixels).unwrap();
}
