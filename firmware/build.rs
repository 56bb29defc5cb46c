//! Where flash and memory lie on the board, and the linker scripts of the runtime that ask for it.

use std::path::Path;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let Some(out) = env::var_os("OUT_DIR") else { return Err(io::Error::other("cargo gives no OUT_DIR")) };
    fs::copy("memory.x", Path::new(&out).join("memory.x"))?;
    println!("cargo:rustc-link-search={}", Path::new(&out).display());
    for argument in ["--nmagic", "-Tlink.x", "-Tlink-rp.x"] {
        println!("cargo:rustc-link-arg-bins={argument}");
    }
    println!("cargo:rerun-if-changed=memory.x");
    Ok(())
}
