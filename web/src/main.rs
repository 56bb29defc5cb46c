//! Lumen in a browser.
fn main() {}
