//! `lumen compare`: two surfaces of different programs and resolutions, whose distance and calibre are known.

use lumen::io::{Axes, Format, ImportOptions, Output, read, write, write_output};
use lumen::mesh::shapes::{icosphere, square, tube};
use lumen::mesh::{TriMesh, Vec3};
use serde_json::Value;

use crate::program::{Folder, json, lumen, succeed};

/// The report on two surfaces that are written as PLY and STL.
fn report(folder: &Folder, [reference, surface]: [&TriMesh; 2], more: &[&str]) -> Value {
    let [first, second, told] = ["first.ply", "second.stl", "told.json"].map(|name| folder.file(name));
    std::fs::write(&first, write(reference, None, Format::Ply).unwrap()).unwrap();
    std::fs::write(&second, write(surface, None, Format::Stl).unwrap()).unwrap();
    let printed = succeed(&[&["compare", &first, &second, "--report", &told], more].concat());
    assert!(printed.ends_with("Not for clinical decisions.\n"), "{printed}");
    json(&told)
}

fn number(told: &Value, pointer: &str) -> f64 {
    told.pointer(pointer).and_then(Value::as_f64).unwrap_or_else(|| panic!("{pointer} of {told}"))
}

fn moved(mesh: &TriMesh, by: impl Fn(Vec3) -> Vec3) -> TriMesh {
    TriMesh { positions: mesh.positions.iter().map(|&p| by(p)).collect(), triangles: mesh.triangles.clone() }
}

#[test]
fn the_depth_of_a_valley_is_its_distance_though_no_vertex_and_hardly_a_sample_has_it() {
    // Two triangles beside 128: 3 mm down one way, 4 x 3 / 5 mm up the other.
    let flat = square(1, 8.0, 0.0);
    let valley = moved(&square(8, 8.0, 0.0), |p| p.with_z(-3.0 * (1.0 - (p.x - 4.0).abs() / 4.0)));
    let told = report(&Folder::new("compare-valley"), [&flat, &valley], &[]);
    for (side, truth) in [("reference", 2.4), ("surface", 3.0)] {
        let [mm, at_most] = ["mm", "at_most_mm"].map(|name| number(&told, &format!("/{side}_farthest/{name}")));
        assert!(mm <= truth + 1e-6 && at_most >= truth - 1e-9 && at_most <= 1.005 * mm, "{side}: {mm} to {at_most}");
    }
    assert_eq!(number(&told, "/deviation_mm/max"), number(&told, "/surface_farthest/mm"));
    // Where: first on the reference, which is flat, then at the bottom of the valley.
    let z = [0, 1].map(|side| number(&told, &format!("/deviation_mm/max_at_mm/{side}/2")));
    assert!(z[0] == 0.0 && (z[1] + 3.0).abs() < 1e-6, "{z:?}");
    // On the mean over both: the walls are 1.5 mm from the plane, the plane 1.2 mm from the walls; the walls have 5/4 of
    // its area, and as many samples.
    assert!((number(&told, "/deviation_mm/mean") - 1.35).abs() < 0.01, "{told}");
    assert!(told["calibre"]["refused"].is_string() && told["disclaimer"] == "Not for clinical decisions.");
}

#[test]
fn a_vessel_that_is_a_tenth_wider_in_another_triangulation_is_found_changed_by_that() {
    let folder = Folder::new("compare-calibre");
    // A third of the tube of 60 mm is wider; the triangles of the two have nothing in common.
    let (narrow, wide) = (tube(48, 120, 60.0, |_| 3.0), |z: f32| if (25.0..=35.0).contains(&z) { 3.3 } else { 3.0 });
    let wide = tube(64, 300, 60.0, wide);
    let csv = folder.file("stations.csv");
    let told = report(&folder, [&narrow, &wide], &["--csv", &csv]);
    let branch = &told["calibre"]["branches"][0];
    let change = number(branch, "/largest_change_percent");
    assert!((change - 10.0).abs() < 0.4, "{change}");
    assert_eq!((&branch["verdict"], &told["calibre"]["verdict"]), (&"changed".into(), &"changed".into()));
    let z = number(branch, "/largest_change_at_mm/2");
    assert!((24.0..36.0).contains(&z), "{z}");
    // In the middle of the wide part areas are as 1.21 to 1, but for the sides; far from it they are alike.
    let text = std::fs::read_to_string(&csv).unwrap();
    let mut lines = text.lines();
    let heads: Vec<&str> = lines.next().unwrap().split(',').collect();
    let at = |name: &str| heads.iter().position(|head| *head == name).unwrap();
    let [z, reference, surface] = ["z_mm", "area_reference_mm2", "area_surface_mm2"].map(at);
    let mut seen = [0, 0];
    for line in lines {
        let fields: Vec<Option<f64>> = line.split(',').map(|field| field.parse().ok()).collect();
        let (Some(z), Some(reference), Some(surface)) = (fields[z], fields[reference], fields[surface]) else {
            continue;
        };
        let expected = match z {
            10.0..20.0 | 40.0..50.0 => 1.0,
            27.0..33.0 => 1.21,
            _ => continue,
        };
        seen[usize::from(expected > 1.0)] += 1;
        assert!((surface / reference / expected - 1.0).abs() < 0.005, "at {z}: {}", surface / reference);
    }
    assert!(seen.iter().all(|&count| count > 3), "{seen:?}");
    // By a tolerance of a fifth it is kept.
    let told = report(&folder, [&narrow, &wide], &["--tolerance", "20"]);
    assert_eq!(told["calibre"]["verdict"], "kept");
}

#[test]
fn a_surface_is_moved_onto_the_reference_only_when_that_is_asked_for() {
    let folder = Folder::new("compare-align");
    let egg = moved(&icosphere(4, 1.0, Vec3::ZERO), |p| p * (1.0 + 0.2 * p.z.max(0.0)) * Vec3::new(30.0, 20.0, 10.0));
    let turn = glam::Quat::from_rotation_y(0.25);
    let away = moved(&egg, |p| turn * p + Vec3::new(120.0, -35.0, 8.0));
    let told = report(&folder, [&egg, &away], &[]);
    assert!(told["moved"].is_null() && number(&told, "/surface_farthest/mm") > 100.0);
    let aligned = report(&folder, [&egg, &away], &["--align", "rigid"]);
    assert!((number(&aligned, "/moved/turned_deg") - 0.25f64.to_degrees()).abs() < 0.05, "{aligned}");
    assert!(number(&aligned, "/moved/fit/residual_mm") < 0.01 && number(&aligned, "/surface_farthest/mm") < 0.05);
    // The motion that is told undoes the one that was made.
    let [rotation, shift] = ["rotation", "shift_mm"].map(|name| {
        let numbers = aligned["moved"][name].as_array().unwrap().iter();
        numbers.map(|number| number.as_f64().unwrap()).collect::<Vec<_>>()
    });
    let (rotation, shift) = (glam::DQuat::from_slice(&rotation), glam::DVec3::from_slice(&shift));
    for (here, there) in egg.positions.iter().zip(&away.positions).step_by(50) {
        let back = rotation * there.as_dvec3() + shift;
        assert!(back.distance(here.as_dvec3()) < 0.05, "{here} beside {back}");
    }
    assert!((number(&aligned, "/moved/fit/before_mm") / number(&told, "/deviation_mm/rms") - 1.0).abs() < 0.2);
    let [first, second] = ["first.ply", "second.stl"].map(|name| folder.file(name));
    let hint = String::from_utf8(lumen(&["compare", &first, &second]).stderr).unwrap();
    assert!(hint.contains("--align rigid"), "{hint}");
}

#[test]
fn axes_that_differ_are_told_and_turned_when_that_is_asked_for() {
    let folder = Folder::new("compare-axes");
    let egg = moved(&icosphere(3, 1.0, Vec3::ZERO), |p| p * Vec3::new(30.0, 20.0, 10.0) + Vec3::new(9.0, 50.0, 7.0));
    let turned = moved(&egg, |p| Vec3::new(-p.x, -p.y, p.z));
    let files = [("lps.ply", &egg, Axes::Lps), ("ras.ply", &turned, Axes::Ras), ("plain.ply", &egg, Axes::Unknown)];
    let [lps, ras, plain] = files.map(|(name, mesh, axes)| {
        let output = Output { mesh, normals: None, arrays: &[], axes };
        std::fs::write(folder.file(name), write_output(&output, Format::Ply).unwrap()).unwrap();
        folder.file(name)
    });
    let told = folder.file("told.json");
    let output = lumen(&["compare", &lps, &ras, "--report", &told]);
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("the first is in LPS, the second in RAS: --align axes turns it"), "{said}");
    assert!(number(&json(&told), "/surface_farthest/mm") > 50.0);
    succeed(&["compare", &lps, &ras, "--align", "axes", "--report", &told]);
    assert!(number(&json(&told), "/surface_farthest/mm") < 1e-3);
    assert!((number(&json(&told), "/moved/turned_deg") - 180.0).abs() < 1e-9);
    succeed(&["compare", &lps, &lps, "--align", "axes", "--report", &told]);
    assert!(json(&told)["moved"].is_null(), "nothing was to be turned");
    let refused = lumen(&["compare", &lps, &plain, "--align", "axes"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8(refused.stderr).unwrap().contains("--align rigid finds how they fit"));
}

#[test]
fn files_far_from_the_origin_are_compared_where_they_stand_and_turned_about_it() {
    // Of 64 bits, as far away as maps and stages of microscopes are; the second is 0.5 mm off along x.
    let folder = Folder::new("compare-far");
    let egg = moved(&icosphere(3, 1.0, Vec3::ZERO), |p| p * Vec3::new(30.0, 20.0, 10.0));
    let write = |name: &str, axes: &str, to: [f64; 3], sign: f64| {
        let mut text = format!(
            "ply\nformat ascii 1.0\ncomment SPACE={axes}\nelement vertex {}\nproperty double x\nproperty double y\n\
             property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
            egg.positions.len(),
            egg.triangles.len()
        );
        for p in &egg.positions {
            let [x, y, z] = p.to_array().map(f64::from);
            text += &format!("{:.7} {:.7} {:.7}\n", sign * (x + to[0]), sign * (y + to[1]), z + to[2]);
        }
        egg.triangles.iter().for_each(|[a, b, c]| text += &format!("3 {a} {b} {c}\n"));
        std::fs::write(folder.file(name), text).unwrap();
        folder.file(name)
    };
    let lps = write("lps.ply", "LPS", [1e6, -2e6, 3e6], 1.0);
    let off = write("off.ply", "LPS", [1e6 + 0.5, -2e6, 3e6], 1.0);
    let ras = write("ras.ply", "RAS", [1e6 + 0.5, -2e6, 3e6], -1.0);
    let told = folder.file("told.json");
    for (other, more) in [(&off, &[][..]), (&ras, &["--align", "axes"])] {
        succeed(&[&["compare", &lps, other, "--report", &told], more].concat());
        let mm = number(&json(&told), "/surface_farthest/mm");
        assert!((mm - 0.5).abs() < 0.01, "{other}: {mm}");
    }
    succeed(&["compare", &lps, &ras, "--align", "rigid", "--report", &told]);
    assert!(number(&json(&told), "/surface_farthest/mm") < 0.01);
}

#[test]
fn distances_of_an_earlier_comparison_are_replaced_and_a_format_without_room_is_told() {
    let folder = Folder::new("compare-again");
    let [small, large] = [10.0, 12.0].map(|radius| icosphere(3, radius, Vec3::ZERO));
    let [first, again, out] = ["first.vtp", "again.vtp", "out.stl"].map(|name| folder.file(name));
    report(&folder, [&small, &large], &["-o", &first]);
    // Beside itself everything is 0, whatever it was before.
    succeed(&["compare", &first, &first, "-o", &again]);
    let arrays = read(&std::fs::read(&again).unwrap(), &again, &ImportOptions::default()).unwrap().arrays;
    let named: Vec<_> = arrays.iter().filter(|array| array.name == "deviation_mm").collect();
    assert!(named.len() == 1 && (0..named[0].values.len()).all(|i| named[0].values.get(i) < 1e-4));
    let told = lumen(&["compare", &first, &again, "-o", &out]);
    let told = String::from_utf8(told.stderr).unwrap();
    assert!(told.contains("out.stl") && told.contains("deviation_mm"), "{told}");
}

#[test]
fn the_maps_are_written_over_both_with_their_sign() {
    let folder = Folder::new("compare-maps");
    let [small, large] = [10.0, 12.0].map(|radius| icosphere(4, radius, Vec3::new(3.0, 4.0, 5.0)));
    let [over_surface, over_reference] = ["surface.vtp", "reference.ply"].map(|name| folder.file(name));
    report(&folder, [&small, &large], &["-o", &over_surface, "--reference-output", &over_reference]);
    // The surface lies 2 mm outside everywhere, but for the facets.
    for (file, count) in [(over_surface, large.positions.len()), (over_reference, small.positions.len())] {
        let arrays = read(&std::fs::read(&file).unwrap(), &file, &ImportOptions::default()).unwrap().arrays;
        for name in ["deviation_mm", "signed_deviation_mm"] {
            let array = arrays.iter().find(|array| array.name == name).unwrap_or_else(|| panic!("{name} in {file}"));
            assert_eq!(array.values.len(), count);
            for i in 0..count {
                let mm = array.values.get(i);
                assert!((mm - 2.0).abs() < 0.05, "{name} of {file}: {mm}");
            }
        }
    }
}

#[test]
fn nothing_is_written_over_what_is_read_and_half_a_file_is_told() {
    let folder = Folder::new("compare-refused");
    let file = folder.file("a.stl");
    let bytes = write(&icosphere(2, 10.0, Vec3::ZERO), None, Format::Stl).unwrap();
    std::fs::write(&file, &bytes).unwrap();
    let output = lumen(&["compare", "sample:aorta", &file, "-o", &file]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(std::fs::read(&file).unwrap(), bytes);
    // A warning says of which file it is.
    let inside_out = folder.file("inside-out.ply");
    let mut mesh = icosphere(2, 10.0, Vec3::ZERO);
    mesh.triangles.iter_mut().for_each(|t| t.swap(0, 1));
    std::fs::write(&inside_out, write(&mesh, None, Format::Ply).unwrap()).unwrap();
    let told = String::from_utf8(lumen(&["compare", &file, &inside_out]).stderr).unwrap();
    assert!(told.contains("inside-out.ply: 1 piece found inside out and turned."), "{told}");
    let half = folder.file("half.stl");
    std::fs::write(&half, b"solid nothing\nendsolid\n").unwrap();
    let output = lumen(&["compare", &file, &half]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8(output.stderr).unwrap().contains("half.stl"));
}
