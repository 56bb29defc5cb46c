//! Remeshes a file with edges of one length and prints the seconds that the call takes, and those that it takes with the
//! deviation, the quality and the sources of vertices and triangles, each the least of some: `remesh_file IN.ply MM OUT.ply [TIMES]`.
//! With 0 times nothing but the call is made, once, for a profile. `benches/peers/remeshing.py` sets it beside the calls of others.

use std::error::Error;
use std::time::Instant;

use lumen_io::{Format, ImportOptions};
use lumen_mesh::mending::split::split;
use lumen_prepare::Patched;
use lumen_prepare::remesh::{Sizing, remesh};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, input, length, output, rest @ ..] = &arguments[..] else {
        return Err("remesh_file IN.ply MM OUT.ply [TIMES]".into());
    };
    let mm: f64 = length.parse()?;
    let times: usize = rest.first().map_or(Ok(1), |times| times.parse())?;
    let mesh = split(&lumen_io::read(&std::fs::read(input)?, input, &ImportOptions::default())?.mesh).mesh;
    let radii = vec![f32::INFINITY; mesh.positions.len()];
    let surface = Patched::wall(mesh);
    let sizing = Sizing { least_mm: mm, largest_mm: mm, ..Sizing::default() };
    if times == 0 {
        remesh(&surface, &radii, &sizing)?;
        return Ok(());
    }
    let (mut call, mut with_measures) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..times {
        let begun = Instant::now();
        let found = remesh(&surface, &radii, &sizing)?;
        call = call.min(begun.elapsed().as_secs_f64());
        let (quality, deviation) = (found.quality(), found.deviation());
        let sources = (found.vertex_sources().len(), found.triangle_sources().len());
        with_measures = with_measures.min(begun.elapsed().as_secs_f64());
        std::fs::write(output, lumen_io::write(&found.surface.mesh, None, Format::Ply)?)?;
        eprintln!("{quality:?}, {deviation:?}, {sources:?} have sources, {} cross", found.crossing.len());
    }
    println!("{call} {with_measures}");
    Ok(())
}
