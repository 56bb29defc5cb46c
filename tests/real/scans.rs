//! The surfaces of the two real volumes are VTK's: in count, and vertex by vertex in position.
//!
//! VTK's are the test meshes that INDEX.md says were made of them by marching cubes, and what
//! `benches/peers/volumes.py` prints of VTK 9.7 on the same volumes.

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use libtest_mimic::{Failed, Trial};
use lumen::io::volume::{self, Part, Scan};
use lumen::io::{ImportOptions, Imported, import_mesh, read};
use lumen::mesh::Vec3;
use lumen::volume::{Grid, Label, Selection, surface, survey};

const AORTA: &str = "volumes/vmtk_aorta_mra.mha";
const LUNGS: &str = "volumes/seqseg_PA000016_mask.nii.gz";
/// How far a vertex may be from VTK's, in mm.
const TOLERANCE: f32 = 1e-3;

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let aorta = |name: &'static str, threshold: f64, triangles: usize| {
        let data = data.to_owned();
        Trial::test(format!("scans: {name}"), move || {
            let grid = open(&data.join(AORTA))?;
            let vtk = mesh(&data.join(name))?;
            same_surface(&grid, Selection::Threshold(threshold), &vtk, Vec3::ZERO, triangles)
        })
    };
    let lungs = data.to_owned();
    let (facts, reports) = (data.to_owned(), data.to_owned());
    vec![
        aorta("real/vmtk_aorta_mra_iso600.vtp", 600.0, 231_150),
        aorta("real/vmtk_aorta_mra_iso800.stl", 800.0, 90_504),
        aorta("real/vmtk_aorta_mra_iso1000.ply", 1000.0, 64_102),
        Trial::test("scans: real/seqseg_PA000016_pulm_artery_mask_mc.vtp", move || {
            let grid = open(&lungs.join(LUNGS))?;
            let vtk = mesh(&lungs.join("real/seqseg_PA000016_pulm_artery_mask_mc.vtp"))?;
            // VTK leaves the volume at the origin; the file's quaternion is half a turn around z, which is LPS itself.
            let origin = Vec3::new(-166.677_73, -297.177_73, -771.9);
            same_surface(&grid, Selection::AnyLabel, &vtk, origin, 395_004)
        }),
        Trial::test("scans: facts of both volumes", move || facts_of(&facts)),
        Trial::test("scans: small inputs of public reports", move || public(&reports)),
    ]
}

/// What VTK's readers and an own look at the headers say.
fn facts_of(data: &Path) -> Result<(), Failed> {
    let aorta = open(&data.join(AORTA))?;
    let geometry = aorta.geometry();
    assert_eq!((geometry.size, geometry.spacing.to_array()), ([157, 393, 34], [0.878906, 0.878906, 1.50009]));
    assert_eq!(geometry.origin.to_array(), [-156.445, -24.6094, 0.0]);
    assert_eq!(geometry.direction.to_cols_array(), [-1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1.0]);
    let found = survey(&aorta);
    assert_eq!((found.range, found.is_mask()), ([0.0, 2570.204833984375], false));
    let lungs = open(&data.join(LUNGS))?;
    let geometry = lungs.geometry();
    assert_eq!((geometry.size, geometry.spacing.to_array()), ([512, 512, 295], [0.64453125, 0.64453125, 1.0]));
    let found = survey(&lungs);
    assert_eq!((found.range, &found.labels[..]), ([0.0, 1.0], &[Label { value: 1, points: 264_804 }][..]));
    Ok(())
}

/// What INDEX.md of `public` says of each: the surface at 150 has 4,442.4 mm3 between -46 and -34 mm along x, or so many voxels
/// have the label.
fn public(data: &Path) -> Result<(), Failed> {
    let folder = data.join("public");
    if !folder.is_dir() {
        return Ok(());
    }
    let scan = |name: &str| -> Result<Scan, Failed> {
        let files = volume::gather(&[folder.join(name)])?.ok_or("no volume")?;
        let parts: Vec<Part> = files.iter().map(|(name, bytes)| Part { name, bytes }).collect();
        Ok(volume::read(&parts)?)
    };
    for name in [
        "dcm_enh_perframe_slope",
        "dcm_enh_philips",
        "dcm_nogrouplen",
        "dcm_nopreamble",
        "dcm_temporal_random_instance",
        "mha_4d1.mha",
        "nii_sform_zero.nii",
        "vti_cell.vti",
    ] {
        let mesh = surface(&Arc::new(scan(name)?.grid), Selection::Threshold(150.0), None)?;
        let report = import_mesh(mesh, name).report;
        let [low, high] = [report.bounds_mm.min[0], report.bounds_mm.max[0]];
        assert!(
            report.volume_mm3.is_some_and(|volume| (volume - 4442.376).abs() < 0.01),
            "{name}: {:?}",
            report.volume_mm3
        );
        assert!((low + 46.0).abs() < 0.5 && (high + 34.0).abs() < 0.5, "{name}: {low} to {high}");
    }
    for (name, points, label) in
        [("dcm_seg", 2212, ""), ("nii_label_slope.nii", 2196, ""), ("seg_4d_layers.seg.nrrd", 2196, "aorta")]
    {
        let scan = scan(name)?;
        assert_eq!(survey(&scan.grid).labels, [Label { value: 1, points }], "{name}");
        assert_eq!(scan.names.iter().map(|named| named.name.as_str()).collect::<String>(), label, "{name}");
    }
    Ok(())
}

fn open(path: &Path) -> Result<Arc<Grid>, Failed> {
    let bytes = std::fs::read(path)?;
    let name = path.to_string_lossy();
    Ok(Arc::new(volume::read(&[Part { name: &name, bytes: &bytes }])?.grid))
}

/// VTK's surface, welded.
fn mesh(path: &Path) -> Result<Imported, Failed> {
    Ok(read(&std::fs::read(path)?, &path.to_string_lossy(), &ImportOptions::default())?)
}

/// Whether the surface of a selection is VTK's moved by `origin`, which had so many triangles before any was dropped.
fn same_surface(
    grid: &Arc<Grid>,
    selection: Selection,
    vtk: &Imported,
    origin: Vec3,
    triangles: usize,
) -> Result<(), Failed> {
    let ours = surface(grid, selection, None)?;
    if ours.triangles.len().abs_diff(triangles) * 1000 > triangles {
        return Err(format!("{} triangles, and VTK has {triangles}", ours.triangles.len()).into());
    }
    let ours = import_mesh(ours, "ours");
    println!(
        "{} triangles and {} vertices, VTK {triangles} and {}",
        ours.report.triangles, ours.report.vertices, vtk.report.vertices
    );
    let theirs: Vec<Vec3> = vtk.mesh.positions.iter().map(|&p| p + origin).collect();
    for (some, others, whose) in [(&ours.mesh.positions, &theirs, "ours"), (&theirs, &ours.mesh.positions, "VTK's")] {
        if let Some(lonely) = lonely(some, others) {
            return Err(format!("{lonely} of {whose} has no vertex of the other within {TOLERANCE} mm").into());
        }
    }
    Ok(())
}

/// The first of `points` that has none of `others` within the tolerance.
fn lonely(points: &[Vec3], others: &[Vec3]) -> Option<Vec3> {
    // Cells of four tolerances, a point in each that its neighbourhood touches.
    let cell = |p: Vec3| (p / (4.0 * TOLERANCE)).floor().as_ivec3();
    let mut cells: HashMap<_, Vec<Vec3>> = HashMap::new();
    for &other in others {
        let (low, high) = (cell(other - TOLERANCE), cell(other + TOLERANCE));
        for x in low.x..=high.x {
            for y in low.y..=high.y {
                for z in low.z..=high.z {
                    cells.entry([x, y, z]).or_default().push(other);
                }
            }
        }
    }
    points.iter().copied().find(|&p| {
        let near = cells.get(&cell(p).to_array());
        !near.is_some_and(|near| near.iter().any(|other| other.distance(p) <= TOLERANCE))
    })
}
