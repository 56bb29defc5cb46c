//! Faults of real surfaces: as many as VTK and MeshLab count, and gone where they are mended.

use std::path::Path;

use libtest_mimic::{Failed, Trial};
use lumen::io::{ImportOptions, read};
use lumen::mesh::mending::{Faults, Mended, Mending, Opening, mend};
use lumen::mesh::{Topology, TriMesh};
use lumen::task::{Yielder, at_once};

/// Openings as MeshLab counts them.
const OPENINGS: [(&str, usize); 5] = [
    ("real/aorta-surface-open-ends.stl", 3),
    ("real/vampy_artery_C0015.vtp", 3),
    ("real/beamadapter_phantom.obj", 8),
    ("real/vmtk_aorta_mra_iso800.stl", 132),
    ("real/vmtk_aorta_mra_iso1000.ply", 30),
];

/// Phantoms that are modelled as their walls, and how thick these are, in m: twice the volume that the file's surface
/// encloses over its area, which is the mean of a thin sheet.
const WALLS: [(&str, f64); 2] =
    [("real/cathsim_low_tort_arch.stl", 0.001_97), ("real/matteopescio_abdominal_aorta_phantom.stl", 0.002_66)];

/// Files, and what INDEX.md says of them: edges of more than two triangles, duplicate triangles, open edges.
const FILES: [(&str, [usize; 3]); 9] = [
    ("real/seqseg_shawn_260_aorta.vtp", [180, 126, 14]),
    ("real/cathsim_low_tort_arch.stl", [407, 0, 94]),
    ("real/matteopescio_abdominal_aorta_phantom.stl", [8, 0, 18]),
    ("real/steve_mechanical_thrombectomy.obj", [6, 0, 52]),
    ("real/aorta-surface-open-ends.stl", [0, 0, 251]),
    ("real/vampy_artery_C0015.vtp", [0, 0, 241]),
    ("real/beamadapter_carotids.stl", [0, 0, 41]),
    ("real/aorta-surface-segment-2.stl", [0, 0, 0]),
    ("nasty/mesh_stl.stl", [9345, 6230, 0]),
];

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let mut trials = Vec::new();
    for (name, facts) in FILES {
        let path = data.join(name);
        trials.push(Trial::test(format!("mending: {name}"), move || check(&path, facts)));
    }
    for (name, thickness) in WALLS {
        let path = data.join(name);
        trials.push(Trial::test(format!("mending: the wall of {name}"), move || {
            let wall = Faults::all(&open(&path)?).wall.ok_or("it is a wall")?;
            assert!((wall.thickness_mm / thickness - 1.0).abs() < 0.05 && !wall.is_two_pieces, "{wall:?}");
            Ok(())
        }));
    }
    let path = data.join(WALLS[0].0);
    trials.push(Trial::test("mending: the lumen of an arch", move || {
        let asked = Mending { lumen: true, ..Mending::default() };
        let Mended { mesh, report, .. } = at_once(mend(open(&path)?, Vec::new(), asked, &Yielder::never()));
        assert!(!report.wall_not_parted && report.wall_triangles_left_out > 0, "{report:?}");
        // What is left is a sheet without a wall, and faces outwards.
        assert_eq!(Faults::all(&mesh).wall, None);
        assert!(lumen::mesh::volume(&mesh, &Topology::new(mesh.positions.len(), &mesh.triangles)) > 0.0);
        Ok(())
    }));
    for (name, openings) in OPENINGS {
        let path = data.join(name);
        trials.push(Trial::test(format!("mending: openings of {name}"), move || {
            assert_eq!(faults(&open(&path)?).holes.len(), openings);
            Ok(())
        }));
    }
    trials
}

fn open(path: &Path) -> Result<TriMesh, Failed> {
    let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
    let name = path.to_string_lossy();
    Ok(read(&bytes, &name, &ImportOptions::default()).map_err(|error| error.to_string())?.mesh)
}

fn faults(mesh: &TriMesh) -> Faults {
    Faults::of(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles))
}

fn check(path: &Path, [non_manifold, duplicates, open_edges]: [usize; 3]) -> Result<(), Failed> {
    let mesh = open(path)?;
    let found = faults(&mesh);
    assert_eq!(found.non_manifold_edges.len(), non_manifold);
    assert!(found.doubles.len() <= duplicates, "{} beside {duplicates}", found.doubles.len());
    assert_eq!(found.doubles.is_empty(), duplicates == 0);
    let rims: usize = found.holes.iter().map(|hole| hole.rim.len()).sum();
    assert!(rims <= open_edges, "{rims} of {open_edges} open edges");
    if non_manifold == 0 {
        assert_eq!(rims, open_edges, "every open edge is on a rim");
        let ends = found.holes.iter().all(|hole| hole.opening == Opening::VesselEnd);
        assert!(ends, "these surfaces are open where vessels end: {:?}", found.counts());
    }
    assert_eq!(Faults::all(&mesh).wall.is_some(), WALLS.iter().any(|(wall, _)| path.ends_with(wall)));
    let asked = Mending { split: true, fill_mm: Some(1000.0), ..Mending::default() };
    let Mended { mesh: mended, report, .. } = at_once(mend(mesh.clone(), Vec::new(), asked, &Yielder::never()));
    let left = faults(&mended);
    assert_eq!((left.non_manifold_edges.len(), left.non_manifold_vertices.len(), left.doubles.len()), (0, 0, 0));
    let holes = left.holes.iter().filter(|hole| hole.opening == Opening::Hole).count();
    assert_eq!(holes, report.holes_left, "{report:?}");
    assert_eq!(
        mended.triangles.len(),
        mesh.triangles.len() - report.duplicates_left_out + report.triangles_added,
        "{report:?}"
    );
    Ok(())
}
