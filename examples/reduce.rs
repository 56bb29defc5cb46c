//! Smooths a surface, removes 90 % of its triangles and writes it: `cargo run --release --example reduce IN OUT.stl`

use std::sync::Arc;

use lumen::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let [input, output] = [1, 2].map(|n| std::env::args().nth(n).expect("usage: reduce IN OUT"));
    let imported = lumen::io::read(&std::fs::read(&input)?, &input, &ImportOptions::default())?;
    let settings = Settings { target: Target::Reduction(900), ..Settings::default() };
    let mut pipeline = Pipeline::new(Arc::new(imported.mesh), settings);
    pipeline.finish()?;
    let reduced = pipeline.reduced().expect("a finished pipeline has a level");
    let format = Format::from_name(&output).ok_or("OUT ends in .stl, .ply, .obj, .vtp, .vtk or .glb")?;
    std::fs::write(&output, lumen::io::write(&reduced.mesh, Some(&reduced.normals), format)?)?;
    println!("{} triangles", reduced.mesh.triangles.len());
    Ok(())
}
