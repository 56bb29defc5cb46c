//! Remeshes a tube that narrows from 3 to 1 mm of radius, and prints how well its triangles are shaped.

use lumen_mesh::shapes::tube;
use lumen_prepare::Patched;
use lumen_prepare::remesh::{RemeshError, Sizing, remesh};

fn main() -> Result<(), RemeshError> {
    let radius = |z: f32| 3.0 - z / 20.0;
    let mesh = tube(60, 200, 40.0, radius);
    let radii: Vec<f32> = mesh.positions.iter().map(|p| radius(p.z)).collect();
    let found = remesh(&Patched::wall(mesh), &radii, &Sizing::default())?;
    println!("{} triangles, {:?}, {:?}", found.surface.mesh.triangles.len(), found.quality(), found.deviation());
    Ok(())
}
