//! Vessel trees of real surfaces: how many ends they have, how long the way between two of them is, and that it is open.

use std::path::Path;
use std::sync::Arc;

use libtest_mimic::{Failed, Trial};
use lumen::io::{ImportOptions, Unit, read};
use lumen::mesh::{TriMesh, Vec3};
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Target};
use lumen::pipeline::task::Budget;
use lumen::trial::audit::Audit;
use lumen::trial::route::{Proposals as _, Routes as _};
use lumen::vessel::{Tree, TreeError};

/// File; least and most ends; least and most length in mm of the route from the best entry to the best target; a wire that
/// fits, in mm. The ends were counted in a viewer, small stumps being the difference; a route is at least as long as the
/// surface's box is along its longest side, less a part.
const TREES: [(&str, [usize; 2], [f64; 2], f64); 5] = [
    ("real/aorta-surface-open-ends.stl", [3, 3], [60.0, 90.0], 0.889),
    ("real/aorta-surface-segment-2.stl", [2, 2], [90.0, 150.0], 0.889),
    ("real/beamadapter_carotids.stl", [3, 3], [75.0, 110.0], 0.889),
    ("real/beamadapter_phantom.obj", [10, 13], [330.0, 420.0], 0.889),
    ("real/steve_mechanical_thrombectomy.obj", [17, 32], [600.0, 900.0], 0.356),
];

/// Walls with a thickness: what is inside of the surface is no lumen.
const WALLS: [&str; 2] = ["real/cathsim_low_tort_arch.stl", "real/matteopescio_abdominal_aorta_phantom.stl"];

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let tree = |(file, ends, length, wire): (&str, [usize; 2], [f64; 2], f64)| {
        let path = data.join(file);
        Trial::test(format!("route: {file}"), move || check(&path, ends, length, wire))
    };
    let wall = |file: &str| {
        let path = data.join(file);
        Trial::test(format!("route: {file}"), move || match Tree::new(&load(&path)?) {
            Err(TreeError::Sheet { .. }) => Ok(()),
            other => Err(format!("{:?}", other.map(|tree| tree.branches().len())).into()),
        })
    };
    TREES.into_iter().map(tree).chain(WALLS.into_iter().map(wall)).collect()
}

fn load(path: &Path) -> Result<TriMesh, Failed> {
    let options = ImportOptions { unit: Some(Unit::Millimetre) };
    Ok(read(&std::fs::read(path)?, &path.to_string_lossy(), &options)?.mesh)
}

fn check(path: &Path, ends: [usize; 2], length: [f64; 2], wire: f64) -> Result<(), Failed> {
    let mesh = load(path)?;
    check_level(&mesh, ends, length, wire)?;
    // Of vessels that are a few triangles around, smoothing leaves little.
    let smoothing = Smoothing { iterations: 0, ..Smoothing::default() };
    let mut pipeline =
        Pipeline::new(Arc::new(mesh), Settings { smoothing, target: Target::Reduction(900), ..Settings::default() });
    while pipeline.progressive().is_none() {
        pipeline.advance(Budget::UNLIMITED)?;
    }
    let progressive = pipeline.progressive().ok_or("it was waited for")?.clone();
    let level = progressive.extract(&progressive.level(Target::Reduction(500)).triangles);
    // Thin stumps may be gone, and the way may lead to another end.
    check_level(&level, [2, ends[1] + 2], [0.7 * length[0], 1.2 * length[1]], wire)
}

fn check_level(mesh: &TriMesh, ends: [usize; 2], length: [f64; 2], wire: f64) -> Result<(), Failed> {
    let tree = Tree::new(mesh)?;
    let entries = tree.entries();
    let targets = entries.first().map(|(_, entry)| tree.targets(Vec3::from(entry.at), 0.0)).unwrap_or_default();
    let found = format!("{} ends of {} triangles", entries.len(), mesh.triangles.len());
    if !(ends[0]..=ends[1]).contains(&entries.len()) {
        return Err(found.into());
    }
    for (_, entry) in &entries {
        let (at, direction) = (Vec3::from(entry.at), Vec3::from(entry.direction));
        let located = tree.locate(at.as_dvec3(), None).ok_or("a tree has branches")?;
        let onward = at + direction * (0.5 * located.radius_mm as f32);
        if !tree.is_inside(at) || !tree.is_inside(onward) {
            return Err(format!("{found}: {entry:?} does not point into the lumen").into());
        }
    }
    let (Some((_, entry)), Some(target)) = (entries.first(), targets.first()) else { return Err(found.into()) };
    let route = tree.route(Vec3::from(entry.at), target.at)?;
    if !(length[0]..=length[1]).contains(&route.length_mm) {
        return Err(format!("{found}: a route of {} mm", route.length_mm).into());
    }
    route.clearance(wire)?;
    let points: Vec<_> = route.points.iter().map(|point| point.at).collect();
    Audit::new(mesh).is_open(&points, wire)?;
    Ok(())
}
