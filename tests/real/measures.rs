//! What Lumen measures of real vessels is what other tools measure of the same files.
//!
//! The facts: triangles that run into others as MeshLab counts them (pymeshlab 2025.7, "select self intersecting
//! faces"; of the files' numbers times 100,000, because MeshLab takes 1e-6 in the square of the file's unit for nothing: of
//! the two files in metres it counts 663 and 14 as they are, 697 and 25 in mm), smallest angle and share of slivers by NumPy from VTK's reading, roughness by trimesh's
//! `face_adjacency_angles`. `benches/peers/measures.py` compares more, and writes `docs/benchmarks/measures-*.csv`.

use std::path::Path;

use libtest_mimic::{Failed, Trial};
use lumen::io::{ImportOptions, Unit, read};
use lumen::pipeline::shape::shape;

/// Self-intersecting triangles; smallest angle in degrees; percentage of triangles with one below 10 degrees.
const FACTS: [(&str, usize, f64, f64); 12] = [
    ("bench/aorta74k.ply", 0, 17.398_802, 0.0),
    ("nasty/mesh_stl.stl", 12460, 35.214_730, 0.0),
    ("nasty/soup.stl", 99, 5.784_357, 1.0),
    ("real/aorta-surface-open-ends.stl", 0, 0.018_824, 11.045_680),
    ("real/aorta-surface-segment-2.stl", 0, 0.008_862, 11.102_904),
    ("real/beamadapter_carotids.stl", 5, 0.207_318, 0.611_620),
    ("real/beamadapter_phantom.obj", 0, 13.317_261, 0.0),
    ("real/cathsim_low_tort_arch.stl", 699, 0.000_317, 6.576_479),
    ("real/matteopescio_abdominal_aorta_phantom.stl", 25, 0.604_980, 7.505_878),
    ("real/steve_mechanical_thrombectomy.obj", 0, 2.692_774, 0.101_392),
    ("real/steve_vessel_architecture.obj", 0, 6.326_831, 0.306_919),
    ("real/vmtk_aorta_mra_iso800.stl", 0, 0.031_243, 11.511_093),
];

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let trial = |(file, crossing, smallest, slivers): (&str, usize, f64, f64)| {
        let path = data.join(file);
        Trial::test(format!("measures: {file}"), move || check(&path, crossing, smallest, slivers))
    };
    FACTS.into_iter().map(trial).collect()
}

fn check(path: &Path, crossing: usize, smallest: f64, slivers: f64) -> Result<(), Failed> {
    let options = ImportOptions { unit: Some(Unit::Millimetre) };
    let mesh = read(&std::fs::read(path)?, &path.to_string_lossy(), &options)?.mesh;
    let found = shape(&mesh);
    let angles = found.angles.ok_or("a surface has angles")?;
    // The other tools have cosines, which know small angles to a millionth of a degree at best.
    let agree = (angles.min_deg - smallest).abs() < 1e-3 && (angles.below_10_percent - slivers).abs() < 1e-5;
    if found.self_intersecting_faces == crossing && agree {
        Ok(())
    } else {
        Err(format!("{} crossing, {angles:?}", found.self_intersecting_faces).into())
    }
}
