//! The desktop program.
fn main() {
    lumen::desktop::run(None).unwrap()
}
