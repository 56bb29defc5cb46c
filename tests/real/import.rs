//! The facts of `data/INDEX.md`, established with VTK, are what Lumen reports about the same files.
//!
//! The data are not part of the repository: they are looked for where `LUMEN_DATA` says, else in `../shared/data`
//! beside the checkout.

use std::collections::BTreeMap;
use std::path::Path;

use libtest_mimic::{Failed, Trial};
use lumen::io::{Format, ImportOptions, ImportReport, Imported, ReadError, Unit, in_english, read, write};
use lumen::mesh::{Topology, Vec3};

pub(crate) fn trials(data: &Path) -> Vec<Trial> {
    let index = std::fs::read_to_string(data.join("INDEX.md")).expect("INDEX.md is text");
    let rows = index.lines().filter_map(Row::parse);
    let mut trials: Vec<Trial> = rows
        .map(|row| {
            let path = data.join(&row.file);
            Trial::test(format!("import: {}", row.file), move || check(&path, &row))
        })
        .collect();
    for name in ["volumes/seqseg_PA000016_mask.nii.gz", "volumes/vmtk_aorta_mra.mha"] {
        let path = data.join(name);
        trials.push(Trial::test(format!("import: {name}"), move || match open(&path)? {
            Err(ReadError::ImageVolume { .. }) => Ok(()),
            other => Err(format!("{:?}", other.map(|imported| imported.report)).into()),
        }));
    }
    assert!(trials.len() > 60, "INDEX.md is read whole");
    let is_encoding = |row: &Row| {
        row.file.starts_with("formats/") && row.facts.is_some_and(|facts| facts.triangles == ENCODED_TRIANGLES)
    };
    let encodings: Vec<String> = index.lines().filter_map(Row::parse).filter(is_encoding).map(|row| row.file).collect();
    assert_eq!(encodings.len(), 27, "29 less the two that hold it twice");
    let data = data.to_path_buf();
    trials.push(Trial::test("import: one surface in all encodings", move || one_surface(&data, &encodings)));
    trials
}

/// The surface that `formats/` holds in many encodings, and how many triangles it has.
const ENCODED: &str = "real/aorta-surface-open-ends.stl";
const ENCODED_TRIANGLES: usize = 11_887;
/// VTK writes legacy text with six digits: of coordinates from 100 to 1000 mm half a thousandth is lost.
const SIX_DIGITS: f32 = 6e-4;

type Corners = [Vec3; 3];

/// Each file has the triangles of the surface, corner for corner: to the bit, but for text of six digits.
fn one_surface(data: &Path, files: &[String]) -> Result<(), Failed> {
    let mut near: BTreeMap<[i32; 3], Vec<Corners>> = BTreeMap::new();
    for triangle in corners(&data.join(ENCODED))? {
        near.entry(cell(&triangle)).or_default().push(triangle);
    }
    for file in files {
        let apart = if file.contains("legacy_ascii") { SIX_DIGITS } else { 0.0 };
        let triangles = corners(&data.join(file))?;
        let found = |cell: [i32; 3], triangle: &Corners| {
            near.get(&cell).is_some_and(|others| others.iter().any(|other| are_same(triangle, other, apart)))
        };
        for triangle in &triangles {
            let [x, y, z] = cell(triangle);
            let mut around = (0..27).map(|i| [x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1]);
            if !found([x, y, z], triangle) && !around.any(|cell| found(cell, triangle)) {
                return Err(format!("{file}: {triangle:?} is none of the surface").into());
            }
        }
        // Two that six digits leave no area are left out.
        let least = if apart > 0.0 { ENCODED_TRIANGLES - 2 } else { ENCODED_TRIANGLES };
        assert_eq!(triangles.len(), least, "{file}");
    }
    Ok(())
}

/// The triangles of a file in its own unit and axes.
fn corners(path: &Path) -> Result<Vec<Corners>, Failed> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let options = ImportOptions { unit: Some(Unit::Millimetre) };
    let imported = read(&bytes, &path.to_string_lossy(), &options).map_err(|error| error.to_string())?;
    // y is up in GLB, z in Lumen.
    let is_turned = imported.report.format == "GLB";
    let placed = |p: Vec3| if is_turned { Vec3::new(p.x, p.z, -p.y) } else { p };
    Ok((0..imported.mesh.triangles.len()).map(|t| imported.mesh.corners(t).map(placed)).collect())
}

/// The place of a triangle's centre in a grid of a quarter of a mm.
fn cell(triangle: &Corners) -> [i32; 3] {
    (triangle.iter().sum::<Vec3>() / 3.0 * 4.0).floor().to_array().map(|x| x as i32)
}

/// Whether corners lie no farther apart along any axis than that, whichever is the first.
fn are_same(a: &Corners, b: &Corners, apart: f32) -> bool {
    (0..3).any(|first| (0..3).all(|i| (a[i] - b[(first + i) % 3]).abs().max_element() <= apart))
}

/// What INDEX.md says about a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Facts {
    points: usize,
    triangles: usize,
    components: usize,
    largest: usize,
    boundary: usize,
    non_manifold: usize,
    degenerate: usize,
    duplicate: usize,
    flips: usize,
    size: [f64; 3],
}

/// A row of INDEX.md; no facts where VTK found no surface.
struct Row {
    file: String,
    facts: Option<Facts>,
}

impl Row {
    fn parse(line: &str) -> Option<Self> {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        let [
            file,
            _,
            _,
            _,
            _,
            points,
            triangles,
            pieces,
            boundary,
            non_manifold,
            degenerate,
            duplicate,
            flips,
            size,
            ..,
        ] = cells[..]
        else {
            return None;
        };
        if !file.contains('/') {
            return None;
        }
        let n = |cell: &str| cell.parse().unwrap_or_else(|_| panic!("{file}: {cell:?} is a count"));
        let facts = (points != "-").then(|| {
            let (components, largest) = pieces.trim_end_matches(')').split_once(" (").expect("pieces (largest)");
            let sides: Vec<f64> = size.split(" x ").map(|side| side.parse().expect("a length")).collect();
            Facts {
                points: n(points),
                triangles: n(triangles),
                components: n(components),
                largest: n(largest),
                boundary: n(boundary),
                non_manifold: n(non_manifold),
                degenerate: n(degenerate),
                duplicate: n(duplicate),
                flips: n(flips),
                size: sides.try_into().expect("three lengths"),
            }
        });
        Some(Self { file: file.to_owned(), facts })
    }
}

/// Files about which Lumen says something else than VTK, and why. The facts here were counted in the files with a
/// script of their own.
fn deliberate(file: &str) -> Option<Facts> {
    let facts = |points, triangles, components, largest, boundary, degenerate, size| Facts {
        points,
        triangles,
        components,
        largest,
        boundary,
        non_manifold: 0,
        degenerate,
        duplicate: 0,
        flips: 0,
        size,
    };
    Some(match file {
        // VTK refuses the whole file for one face of two corners; Lumen leaves out that face and says so.
        "nasty/CavaVeinAndHeart.obj" => facts(12363, 24713, 2, 21939, 49, 36, [5.765, 19.03, 5.091]),
        // VTK does not step over the list of texture coordinates in each face row and loses its place: 2 of 1000.
        "nasty/fuze_ascii.ply" => facts(502, 1000, 1, 1000, 0, 0, [0.07261, 0.07351, 0.2151]),
        // VTK refuses corners written "1//". The first file has one face of two corners and one of three, the
        // second one face of five.
        "nasty/notenoughindices.obj" => facts(3, 1, 1, 1, 3, 0, [1000.0, 500.0, 0.0]),
        "nasty/polygonfaces.obj" => facts(5, 3, 1, 3, 5, 0, [1000.0, 500.0, 1000.0]),
        _ => return None,
    })
}

/// What Lumen says about the files that hold something else.
fn refusal(file: &str) -> Option<&'static str> {
    Some(match file {
        "reject/carotid.vtk" => {
            "This is no surface but an image volume (VTK structured points) that is broken or of a kind that Lumen does \
             not read: segment it and save the surface."
        }
        "reject/centerline_curves.vtk" => {
            "The VTK ascii file holds no surface, only 145 lines and 0 points: Lumen does not open centrelines."
        }
        "reject/faults.vtk" => {
            "The VTK binary file holds no surface, only 78 lines and 0 points: Lumen does not open centrelines."
        }
        _ => return None,
    })
}

fn open(path: &Path) -> Result<Result<Imported, ReadError>, Failed> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    Ok(read(&bytes, &name, &ImportOptions::default()))
}

fn check(path: &Path, row: &Row) -> Result<(), Failed> {
    let outcome = open(path)?;
    let Some(facts) = deliberate(&row.file).or(row.facts) else {
        return match outcome {
            Err(error) => match refusal(&row.file) {
                Some(sentence) if sentence != error.to_string() => Err(format!("says {error}").into()),
                Some(_) => Ok(()),
                None if matches!(error, ReadError::NoTriangles { .. } | ReadError::NoSurface { .. }) => {
                    a_sentence(&error.to_string())
                }
                None => Err(format!("holds no surface: {error}").into()),
            },
            other => Err(format!("holds no surface: {:?}", other.map(|imported| imported.report)).into()),
        };
    };
    let imported = outcome.map_err(|error| error.to_string())?;
    let found = facts_of(&imported.report);
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 0.51e-3 * 10f64.powf(b.abs().max(1e-9).log10().floor());
    if (Facts { size: facts.size, ..found }) != facts || !found.size.iter().zip(&facts.size).all(close) {
        return Err(format!("expected {facts:?}\n   found {found:?}").into());
    }
    well_formed(&imported)?;
    reads_back(&imported)
}

fn facts_of(report: &ImportReport) -> Facts {
    let bounds = report.bounds_mm;
    let side = |i: usize| (f64::from(bounds.max[i]) - f64::from(bounds.min[i])) / report.scale_to_mm;
    Facts {
        points: report.vertices,
        triangles: report.triangles,
        components: report.components,
        largest: report.largest_component_triangles,
        boundary: report.boundary_edges,
        non_manifold: report.non_manifold_edges,
        degenerate: report.degenerate_triangles,
        duplicate: report.duplicate_triangles,
        flips: report.winding_flips,
        // GLB files of the collection are in mm though glTF is metres: `scale_to_mm` brings back what stands there. And y
        // is up in them, z in Lumen.
        size: if report.format == "GLB" { [side(0), side(2), side(1)] } else { [side(0), side(1), side(2)] },
    }
}

fn a_sentence(text: &str) -> Result<(), Failed> {
    let plain = text.ends_with('.') && !text.contains('\n') && text.len() > 10;
    if plain { Ok(()) } else { Err(format!("no sentence: {text:?}").into()) }
}

/// The promises of an imported surface: windings agree, and it encloses a positive volume where it is closed.
fn well_formed(imported: &Imported) -> Result<(), Failed> {
    let Imported { mesh, report, .. } = imported;
    let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
    if report.orientable != (topology.edge_counts().flipped == 0) {
        return Err("orientable and flips disagree".into());
    }
    if (0..mesh.positions.len() as u32).any(|v| topology.triangles(v).is_empty()) {
        return Err("a vertex is not in use".into());
    }
    if report.boundary_edges + report.non_manifold_edges == 0 && report.volume_mm3.is_some_and(|volume| volume <= 0.0) {
        return Err(format!("inside out: {:?}", report.volume_mm3).into());
    }
    let json = serde_json::to_string(report).map_err(|error| error.to_string())?;
    let back: ImportReport = serde_json::from_str(&json).map_err(|error| error.to_string())?;
    // Warnings stand there as sentences, which are not read back.
    let value: serde_json::Value = serde_json::from_str(&json).map_err(|error| error.to_string())?;
    if value["warnings"] != serde_json::json!(in_english(&report.warnings)) {
        return Err(format!("the warnings are not in JSON: {json}").into());
    }
    let back = ImportReport { warnings: report.warnings.clone(), ..back };
    if back != *report {
        return Err(format!("the report does not survive JSON: {json}").into());
    }
    report.warnings.iter().try_for_each(|warning| a_sentence(&warning.to_string()))
}

/// Written in any format and read again, the surface is the same to the bit, and nothing is left to mend.
fn reads_back(imported: &Imported) -> Result<(), Failed> {
    let mesh = &imported.mesh;
    let corners = |mesh: &lumen::mesh::TriMesh| -> Vec<[[u32; 3]; 3]> {
        (0..mesh.triangles.len()).map(|t| mesh.corners(t).map(|p: Vec3| p.to_array().map(f32::to_bits))).collect()
    };
    for format in Format::ALL {
        let bytes = write(mesh, None, format).map_err(|error| error.to_string())?;
        let name = format!("surface.{}", format.extension());
        let again = read(&bytes, &name, &ImportOptions::default()).map_err(|error| format!("{name}: {error}"))?;
        if corners(&again.mesh) != corners(mesh) || (format != Format::Stl && again.mesh != *mesh) {
            return Err(format!("{name} reads back differently").into());
        }
        if imported.report.orientable && again.report.winding_flips + again.report.components_turned > 0 {
            return Err(format!("{name} has something left to mend: {:?}", again.report).into());
        }
    }
    Ok(())
}
