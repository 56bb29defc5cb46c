//! Writes the valid files of `tests/formats/samples.rs` into a folder, a folder in it for each target.

#[allow(dead_code, reason = "some of the samples are for tests alone")]
#[path = "../../tests/formats/samples.rs"]
mod samples;

use std::path::Path;

fn main() -> std::io::Result<()> {
    let folder = std::env::args().nth(1).ok_or_else(|| std::io::Error::other("which folder?"))?;
    for (i, (name, bytes)) in samples::valid().into_iter().enumerate() {
        let target = match name.rsplit_once('.') {
            Some((_, "glb")) => "gltf",
            Some((_, "vtu")) => "vtp",
            Some((_, extension)) => extension,
            None => continue,
        };
        let folder = Path::new(&folder).join(target);
        std::fs::create_dir_all(&folder)?;
        std::fs::write(folder.join(format!("seed-{i:02}")), bytes)?;
    }
    Ok(())
}
