//! Each file is read by a reader that knows the format and not the writer.

use lumen_mesh::shapes::{icosphere, tube};

use super::*;

/// A tube with a flat cap at either end: wall, inlet and outlet.
pub(crate) fn capped_tube() -> Patched {
    let mut mesh = tube(16, 10, 12.0, |_| 2.0);
    let mut patched = Patched::wall(mesh.clone());
    for (ring, name, kind, z) in [(0u32, "in let", PatchKind::Inlet, -1.0), (10, "out", PatchKind::Outlet, 1.0)] {
        let middle = mesh.positions.len() as u32;
        mesh.positions.push(Vec3::Z * 1.2 * ring as f32);
        for side in 0..16 {
            let (a, b) = (16 * ring + side, 16 * ring + (side + 1) % 16);
            mesh.triangles.push(if ring == 0 { [middle, b, a] } else { [middle, a, b] });
            patched.of_triangle.push(patched.patches.len() as u32);
        }
        patched.patches.push(Patch {
            id: patched.patches.len() as u32 + 4,
            name: name.to_owned(),
            kind,
            centre: [0.0, 0.0, 1.2 * f64::from(ring)],
            normal: [0.0, 0.0, z],
            area_mm2: 1.0,
        });
    }
    patched.mesh = mesh;
    patched
}

fn text(format: SolverFormat, surface: &Patched) -> String {
    let mut files = format.written(surface, "aorta").unwrap();
    assert_eq!(files.len(), 1);
    assert_eq!(files[0].0, format!("aorta.{}", format.extension()));
    String::from_utf8(files.pop().unwrap().1).unwrap()
}

fn numbers<T: std::str::FromStr>(line: &str) -> Vec<T> {
    line.split([' ', ',']).filter_map(|word| word.parse().ok()).collect()
}

/// The lines between `$Name` and `$EndName`.
fn section<'a>(text: &'a str, name: &str) -> Vec<&'a str> {
    let (_, rest) = text.split_once(&format!("${name}\n")).unwrap();
    rest.split_once(&format!("$End{name}\n")).unwrap().0.lines().collect()
}

#[test]
fn the_solids_of_an_stl_are_the_patches_and_face_outwards() {
    let surface = capped_tube();
    let text = text(SolverFormat::Stl, &surface);
    let solids: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("solid ")).collect();
    assert_eq!(solids, ["wall", "in_let", "out"]);
    let inlet = text.split("endsolid in_let").next().unwrap().split("solid in_let").nth(1).unwrap();
    let normals: Vec<Vec<f32>> = inlet.lines().filter(|line| line.contains("normal")).map(numbers).collect();
    assert_eq!(normals, vec![vec![0.0, 0.0, -1.0]; 16]);
    // Every bit of a coordinate comes back.
    let corners: Vec<f32> = text.lines().filter(|line| line.starts_with("vertex")).flat_map(numbers::<f32>).collect();
    let expected: Vec<f32> =
        (0..surface.mesh.triangles.len()).flat_map(|t| surface.mesh.corners(t)).flat_map(|p| p.to_array()).collect();
    assert_eq!(corners, expected);
}

#[test]
fn the_blocks_of_a_gmsh_file_have_every_node_and_triangle_once() {
    let surface = capped_tube();
    let text = text(SolverFormat::Msh, &surface);
    assert_eq!(section(&text, "PhysicalNames"), ["3", "2 1 \"wall\"", "2 5 \"in_let\"", "2 6 \"out\""]);
    let entities = section(&text, "Entities");
    assert_eq!(entities[0], "0 0 3 0");
    for (line, id) in entities[1..].iter().zip([1.0, 5.0, 6.0]) {
        let values = numbers::<f64>(line);
        assert_eq!((values.len(), values[0], &values[7..]), (10, id, &[1.0, id, 0.0][..]));
    }
    let (mut nodes, mut elements) = (Vec::new(), Vec::new());
    let lines = section(&text, "Nodes");
    let mut at = 1;
    while at < lines.len() {
        let count = numbers::<usize>(lines[at])[3];
        let tags = lines[at + 1..=at + count].iter().map(|line| line.parse::<usize>().unwrap());
        let points = lines[at + count + 1..=at + 2 * count].iter().map(|line| numbers::<f32>(line));
        nodes.extend(tags.zip(points));
        at += 1 + 2 * count;
    }
    assert_eq!(lines[0], format!("3 {0} 1 {0}", surface.mesh.positions.len()));
    nodes.sort_by_key(|node| node.0);
    let expected: Vec<(usize, Vec<f32>)> =
        (1..).zip(surface.mesh.positions.iter().map(|p| p.to_array().to_vec())).collect();
    assert_eq!(nodes, expected);
    let lines = section(&text, "Elements");
    let mut at = 1;
    while at < lines.len() {
        let head = numbers::<usize>(lines[at]);
        assert_eq!((head[0], head[2]), (2, 2), "triangles of three nodes");
        elements.extend(lines[at + 1..=at + head[3]].iter().map(|line| (numbers::<u32>(line), head[1])));
        at += 1 + head[3];
    }
    let ids = [1, 5, 6];
    for (t, (element, id)) in elements.iter().enumerate() {
        let [a, b, c] = surface.mesh.triangles[t];
        assert_eq!(
            (&element[..], *id),
            (&[t as u32 + 1, a + 1, b + 1, c + 1][..], ids[surface.of_triangle[t] as usize])
        );
    }
    assert_eq!(elements.len(), surface.mesh.triangles.len());
}

#[test]
fn an_abaqus_file_has_a_set_and_an_inner_surface_for_each_patch() {
    let surface = capped_tube();
    let text = text(SolverFormat::Inp, &surface);
    let mut counts: Vec<(&str, usize)> = Vec::new();
    for line in text.lines() {
        if line.starts_with('*') {
            counts.push((line, 0));
        } else {
            counts.last_mut().unwrap().1 += 1;
        }
    }
    let expected = [
        ("*HEADING", 1),
        ("*NODE", 178),
        ("*ELEMENT, TYPE=S3, ELSET=wall", 320),
        ("*ELEMENT, TYPE=S3, ELSET=in_let", 16),
        ("*ELEMENT, TYPE=S3, ELSET=out", 16),
        ("*SURFACE, TYPE=ELEMENT, NAME=wall_surface", 1),
        ("*SURFACE, TYPE=ELEMENT, NAME=in_let_surface", 1),
        ("*SURFACE, TYPE=ELEMENT, NAME=out_surface", 1),
    ];
    assert_eq!(counts, expected);
    assert!(text.ends_with("out, SNEG\n"));
}

/// The numbers of an array of a VTK file.
fn array(text: &str, name: &str) -> Vec<f32> {
    let (_, rest) = text.split_once(&format!("Name=\"{name}\"")).unwrap();
    let (values, _) = rest.split_once('>').unwrap().1.split_once("</DataArray>").unwrap();
    values.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

#[test]
fn a_vtk_file_has_the_patch_of_each_cell() {
    let surface = capped_tube();
    let text = text(SolverFormat::Vtp, &surface);
    let ids: Vec<f32> = surface.of_triangle.iter().map(|&patch| [1.0, 5.0, 6.0][patch as usize]).collect();
    assert_eq!(array(&text, "ModelFaceID"), ids);
    let caps: Vec<f32> = ids.iter().map(|&id| if id == 1.0 { -1.0 } else { id }).collect();
    assert_eq!(array(&text, "CapID"), caps);
    let connectivity: Vec<f32> = surface.mesh.triangles.as_flattened().iter().map(|&v| v as f32).collect();
    assert_eq!(array(&text, "connectivity"), connectivity);
    let points: Vec<f32> = surface.mesh.positions.iter().flat_map(Vec3::to_array).collect();
    assert_eq!(array(&text, "Points"), points);
}

#[test]
fn the_global_numbers_of_simvascular_lead_from_each_file_to_the_whole() {
    let surface = capped_tube();
    let files = simvascular(&surface).unwrap();
    let names: Vec<&str> = files.iter().map(|(name, _)| &name[..]).collect();
    let surfaces = ["mesh-surfaces/wall.vtp", "mesh-surfaces/in_let.vtp", "mesh-surfaces/out.vtp"];
    assert_eq!(names, [&["mesh-complete.exterior.vtp", "walls_combined.vtp"][..], &surfaces].concat());
    let mut triangles = 0;
    for (name, bytes) in &files[2..] {
        let text = std::str::from_utf8(bytes).unwrap();
        let (nodes, elements) = (array(text, "GlobalNodeID"), array(text, "GlobalElementID"));
        let connectivity = array(text, "connectivity");
        for (t, corners) in elements.iter().zip(connectivity.as_chunks::<3>().0) {
            let global = corners.map(|v| nodes[v as usize] as u32 - 1);
            assert_eq!(surface.mesh.triangles[*t as usize - 1], global, "{name}");
        }
        triangles += elements.len();
    }
    assert_eq!(triangles, surface.mesh.triangles.len());
    assert!(SolverFormat::SimVascular.written(&surface, "a").unwrap()[0].0.starts_with("a-mesh-complete/"));
}

#[test]
fn the_area_in_json_is_that_of_the_polygon() {
    let value: serde_json::Value = serde_json::from_str(&text(SolverFormat::Json, &capped_tube())).unwrap();
    assert_eq!(value["notice"], "Not for clinical decisions.");
    let inlet = &value["patches"][1];
    assert_eq!((&inlet["name"], &inlet["id"], &inlet["kind"]), (&"in_let".into(), &5.into(), &"inlet".into()));
    // A regular polygon of 16 sides within a circle of 2 mm.
    let area = 16.0 / 2.0 * 4.0 * libm::sin(std::f64::consts::TAU / 16.0);
    assert!((inlet["area_mm2"].as_f64().unwrap() - area).abs() < 1e-5);
    assert!((inlet["radius_mm"].as_f64().unwrap() - (area / std::f64::consts::PI).sqrt()).abs() < 1e-5);
    assert!(value["patches"][0]["radius_mm"].is_null());
}

#[test]
fn names_are_plain_and_distinct_whatever_they_were() {
    let mut surface = Patched::wall(icosphere(1, 5.0, Vec3::ZERO));
    surface.patches[0].name = "Äste/../\"x\"\n".to_owned();
    for (id, name) in (2..).zip(["a b", "A_b", "a.b", "", "7", &"l".repeat(200)]) {
        let patch = Patch { id, name: name.to_owned(), ..Patch::wall() };
        surface.of_triangle[id as usize] = surface.patches.len() as u32;
        surface.patches.push(patch);
    }
    let sheet = Sheet::of(&surface).unwrap();
    let names: Vec<&str> = sheet.parts.iter().map(|part| &part.name[..]).collect();
    let long = "l".repeat(LONGEST_NAME);
    assert_eq!(names, ["patch__ste_____x__", "a_b", "A_b_2", "a_b_3", "patch_", "patch_7", &long]);
}

#[test]
fn what_is_no_surface_is_refused() {
    let good = capped_tube();
    let refused = |change: &dyn Fn(&mut Patched)| {
        let mut bad = good.clone();
        change(&mut bad);
        SolverFormat::ALL.map(|format| format.written(&bad, "x").unwrap_err().to_string())[0].clone()
    };
    assert_eq!(
        refused(&|bad| bad.mesh.positions[3].y = f32::NAN),
        "vertex 3 has a coordinate that is not a finite number"
    );
    assert!(refused(&|bad| bad.mesh.triangles[3] = [0, 1, 4000]).starts_with("triangle 3 has a vertex"));
    assert!(refused(&|bad| bad.of_triangle[5] = 3).starts_with("triangle 5 is of patch 3: there are 3"));
    assert!(refused(&|bad| bad.of_triangle.clear()).starts_with("0 of 352 triangles"));
    assert!(refused(&|bad| bad.patches[1].id = 1).contains("cannot be written"));
    assert!(refused(&|bad| *bad = Patched::default()).contains("no triangles"));
}

#[test]
fn vertices_without_a_triangle_are_left_out() {
    let mut surface = capped_tube();
    surface.mesh.positions.insert(0, Vec3::ZERO);
    surface.mesh.triangles.as_flattened_mut().iter_mut().for_each(|v| *v += 1);
    for format in SolverFormat::ALL {
        assert_eq!(format.written(&surface, "x").unwrap(), format.written(&capped_tube(), "x").unwrap());
    }
}

#[test]
fn arrays_stand_in_vtp_and_msh_where_readers_look_for_them() {
    use lumen_io::{ImportOptions, read_in_slices};
    use lumen_mesh::arrays::Values;
    use lumen_mesh::task::{Yielder, at_once};

    let surface = capped_tube();
    let heights: Vec<f32> = surface.mesh.positions.iter().map(|p| p.z + 0.1).collect();
    let speeds = (0..2 * surface.mesh.triangles.len()).map(|i| i as f64 / 3.0);
    let arrays = [
        Array::new("a <b>", Association::Point, 1, Values::from_floats(&heights)),
        Array::new("speed", Association::Triangle, 2, Values::of(Scalar::F64, speeds)),
        Array::new(
            "ModelFaceID",
            Association::Triangle,
            1,
            Values::of(Scalar::I32, vec![77.0; surface.mesh.triangles.len()]),
        ),
    ];
    let written = |format: SolverFormat| format.written_with(&surface, &arrays, "a").unwrap().pop().unwrap().1;
    let (options, never) = (ImportOptions::default(), Yielder::never());
    let read = at_once(read_in_slices(written(SolverFormat::Vtp).into(), "a.vtp", &options, &never)).unwrap();
    // The reader orders vertices as the file does, and the file as the surface does.
    let of = |name: &str| read.arrays.iter().find(|array| array.name == name).expect(name);
    assert_eq!((of("a <b>").values.clone(), of("a <b>").on), (arrays[0].values.clone(), Association::Point));
    assert_eq!((&of("speed").values, of("speed").components), (&arrays[1].values, 2));
    assert_eq!(of("ModelFaceID").info().labels, [1.0, 5.0, 6.0]);

    let text = String::from_utf8(written(SolverFormat::Msh)).unwrap();
    let nodes = section(&text, "NodeData");
    let vertices = surface.mesh.positions.len();
    assert_eq!(nodes[..8], ["1", "\"a <b>\"", "1", "0.0", "3", "0", "1", &vertices.to_string()]);
    assert!(nodes[8..].iter().enumerate().all(|(v, row)| numbers::<f32>(row) == [v as f32 + 1.0, heights[v]]));
    let elements = section(&text, "ElementData");
    // A vector has three numbers there.
    assert_eq!(elements[6..8], ["3", &surface.mesh.triangles.len().to_string()]);
    assert_eq!(numbers::<f64>(elements[9]), [2.0, 2.0 / 3.0, 1.0, 0.0]);

    let short = [Array::new("short", Association::Point, 1, Values::from_floats(&heights[1..]))];
    assert!(matches!(SolverFormat::Vtp.written_with(&surface, &short, "a"), Err(WriteError::Array { .. })));
}
