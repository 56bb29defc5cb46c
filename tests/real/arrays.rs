//! Arrays of files that other programs wrote: what VTK 9.7 says of them is what Lumen says.
//!
//! The facts were printed by VTK's own readers (`vtkXMLPolyDataReader`, `vtkPolyDataReader` with all fields and scalars
//! switched on): of each array its name, type, components and range. Normals and texture coordinates are no arrays here.

use std::path::Path;

use libtest_mimic::{Failed, Trial};
use lumen::io::{ImportOptions, Imported, read};
use lumen::mesh::ArrayInfo;
use lumen::mesh::arrays::{Association, Kind, Scalar};

/// Name, what it is on, kind, type, components, range.
type Fact = (&'static str, Association, Kind, Scalar, usize, [f64; 2]);

const FACE: Fact = ("ModelFaceID", Association::Triangle, Kind::Label, Scalar::I32, 1, [0.0, 6.0]);
const HEIGHT: Fact =
    ("Height", Association::Point, Kind::Continuous, Scalar::F32, 1, [12.454_676_628_112_793, 35.238_010_406_494_14]);
const HEIGHT_TEXT: Fact =
    ("Height", Association::Point, Kind::Continuous, Scalar::F32, 1, [12.454_700_469_970_703, 35.237_998_962_402_344]);

fn facts() -> Vec<(&'static str, Vec<Fact>)> {
    let continuous = |name, scalar, range| (name, Association::Point, Kind::Continuous, scalar, 1, range);
    let mut facts = vec![
        (
            "formats/cowHead.vtp",
            vec![continuous("Gauss_Curvature", Scalar::F64, [-219.994_390_282_805_85, 666.949_900_496_254_9])],
        ),
        (
            "real/aorta-surface-branch-split.vtp",
            vec![
                continuous("Scalars_", Scalar::F32, [0.0, 0.0]),
                ("GroupIds", Association::Point, Kind::Label, Scalar::I32, 1, [0.0, 3.0]),
                continuous("ClippingArray", Scalar::F64, [-2.745_488_587_559_85e-7, 2_174.453_237_134_945_5]),
            ],
        ),
        ("real/seqseg_shawn_260_aorta.vtp", vec![continuous("Scalars_", Scalar::F32, [1.0, 1.0])]),
        ("real/vampy_artery_C0015.vtp", vec![]),
        (
            "real/vmr_kawasaki_aorta_coronaries.vtp",
            vec![("ModelFaceID", Association::Triangle, Kind::Label, Scalar::I32, 1, [1.0, 17.0])],
        ),
        ("formats/fran_cut.vtk", vec![]),
        ("formats/legacy_ascii_v42.vtk", vec![FACE, HEIGHT_TEXT]),
        ("formats/legacy_ascii_v51.vtk", vec![FACE, HEIGHT_TEXT]),
        ("formats/legacy_ascii_v51_strips.vtk", vec![HEIGHT_TEXT]),
        ("formats/legacy_binary_v42_strips.vtk", vec![HEIGHT]),
        ("formats/vtp_appended_raw_zlib_strips.vtp", vec![HEIGHT]),
    ];
    for name in ["legacy_binary_v42.vtk", "legacy_binary_v42_f64pts.vtk", "legacy_binary_v51.vtk"] {
        facts.push((name, vec![FACE, HEIGHT]));
    }
    for name in [
        "appended_base64_lz4_u32",
        "appended_base64_lzma_u32",
        "appended_base64_nocomp_u32",
        "appended_base64_zlib_u32",
        "appended_raw_nocomp_bigendian",
        "appended_raw_nocomp_f64pts",
        "appended_raw_nocomp_u64",
        "appended_raw_zlib_u32",
        "appended_raw_zlib_u64",
        "ascii",
        "binary_nocomp_u32",
        "binary_zlib_u64",
    ] {
        facts.push((name, vec![HEIGHT, FACE]));
    }
    facts
}

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    facts()
        .into_iter()
        .map(|(name, facts)| {
            let file = match name.rsplit_once('.') {
                _ if name.contains('/') => name.to_owned(),
                Some(_) => format!("formats/{name}"),
                None => format!("formats/vtp_{name}.vtp"),
            };
            let path = data.join(&file);
            Trial::test(format!("arrays: {file}"), move || check(&path, &facts))
        })
        .collect()
}

fn check(path: &Path, facts: &[Fact]) -> Result<(), Failed> {
    let bytes = std::fs::read(path)?;
    let Imported { mesh, arrays, report } = read(&bytes, &path.to_string_lossy(), &ImportOptions::default())?;
    if report.arrays.len() != facts.len() {
        return Err(format!("{:?}", report.arrays).into());
    }
    for (info, &(name, on, kind, scalar, components, range)) in report.arrays.iter().zip(facts) {
        let near = |[a, b]: [f64; 2]| (a - range[0]).abs() < 1e-12 && (b - range[1]).abs() < 1e-12;
        let fact = ArrayInfo {
            name: name.to_owned(),
            on,
            kind,
            scalar,
            components,
            range: info.range,
            labels: info.labels.clone(),
        };
        // Of vertices that were welded the mean is kept: ranges may shrink there.
        let is_welded = path.to_string_lossy().contains("branch-split");
        if *info != fact || !(is_welded || info.range.is_some_and(near)) {
            return Err(format!("{info:?} is not {fact:?} from {range:?}").into());
        }
    }
    // The height is the coordinate itself.
    for array in arrays.iter().filter(|array| array.name == "Height") {
        let differs = |v: usize| array.values.get(v) as f32 != mesh.positions[v].z;
        if let Some(v) = (0..mesh.positions.len()).find(|&v| differs(v)) {
            return Err(format!("vertex {v} is at {} and has {}", mesh.positions[v].z, array.values.get(v)).into());
        }
    }
    Ok(())
}
