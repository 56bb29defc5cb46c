//! `lumen prepare`: what is written for solvers.

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::path::Path;

use lumen::prepare::prepare::Plan;
use lumen::sharing::{Beside, SharedSettings, write_settings_and};

use crate::program::{Folder, json, lumen, succeed};

/// The area of a closed STL's solids, by their names, and its volume by the divergence theorem.
fn solids(path: &Path) -> (Vec<(String, f64)>, f64) {
    let text = std::fs::read_to_string(path).unwrap();
    let (mut solids, mut volume) = (Vec::new(), 0.0);
    let mut corners: Vec<glam::DVec3> = Vec::new();
    for line in text.lines().map(str::trim) {
        if let Some(name) = line.strip_prefix("solid ") {
            solids.push((name.split_whitespace().next().unwrap().to_owned(), 0.0));
        } else if let Some(numbers) = line.strip_prefix("vertex ") {
            let numbers: Vec<f64> = numbers.split_whitespace().map(|number| number.parse().unwrap()).collect();
            corners.push(glam::DVec3::from_slice(&numbers));
        } else if line == "endfacet" {
            let [a, b, c] = corners[..] else { panic!("a triangle") };
            solids.last_mut().unwrap().1 += (b - a).cross(c - a).length() / 2.0;
            volume += a.dot(b.cross(c)) / 6.0;
            corners.clear();
        }
    }
    (solids, volume)
}

#[test]
fn the_aorta_is_clipped_extended_capped_and_remeshed_for_every_solver() {
    let folder = Folder::new("prepare");
    let out = folder.file("out");
    let options = ["--clip", "round", "--extend", "3", "--cap", "planar", "--remesh", "12", "-o", &out];
    let printed =
        succeed(&[&["prepare", "sample:aorta", "--format", "stl,msh,inp,vtp,simvascular"], &options[..]].concat());
    assert!(
        printed.contains("nothing was found that stops them") && printed.ends_with("Not for clinical decisions.\n"),
        "{printed}"
    );
    let out = Path::new(&out);
    let files: BTreeSet<String> = walk(out);
    let of = |ending: &str| files.iter().filter(|name| name.ends_with(ending)).count();
    assert_eq!((of(".stl"), of(".msh"), of(".inp"), of(".json")), (1, 1, 1, 1), "{files:?}");
    let named = |ending: &str| out.join(files.iter().find(|name| name.ends_with(ending)).unwrap());
    let patches = json(named(".json").to_str().unwrap());
    assert_eq!(patches["is_ready"], true);
    assert!(patches["mean_quality"].as_f64().unwrap() > 0.95 && patches["notice"] == "Not for clinical decisions.");
    let (solids, volume) = solids(&named(".stl"));
    assert!(volume > 0.0, "outwards");
    let names: Vec<&str> = solids.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(&names[..3], ["wall", "inlet", "outlet_1"]);
    for (patch, (name, area)) in patches["patches"].as_array().unwrap().iter().zip(&solids) {
        assert_eq!(patch["name"], **name);
        assert!((patch["area_mm2"].as_f64().unwrap() / area - 1.0).abs() < 1e-3, "{name}");
    }
    // Each patch has a file of its own for SimVascular, the wall among them.
    assert_eq!(files.iter().filter(|name| name.contains("mesh-surfaces/")).count(), names.len(), "{files:?}");
    let inspected = succeed(&["inspect", named(".stl").to_str().unwrap(), "--json"]);
    let inspected: serde_json::Value = serde_json::from_str(&inspected).unwrap();
    assert_eq!((inspected["boundary_edges"].as_u64(), inspected["components"].as_u64()), (Some(0), Some(1)));
}

#[test]
fn the_file_that_is_read_is_never_written_over() {
    let folder = Folder::new("prepare-over");
    let file = folder.file("tube.stl");
    let tube = lumen::mesh::shapes::tube(24, 30, 30.0, |_| 2.0);
    let bytes = lumen::io::write(&tube, None, lumen::io::Format::Stl).unwrap();
    std::fs::write(&file, &bytes).unwrap();
    let out = Path::new(&file).parent().unwrap().to_str().unwrap();
    let refused = lumen(&["prepare", &file, "--cap", "planar", "-o", out]);
    assert_eq!(refused.status.code(), Some(2), "{}", String::from_utf8_lossy(&refused.stderr));
    assert_eq!(std::fs::read(&file).unwrap(), bytes);
    assert!(!Path::new(out).join("tube.json").exists());
}

#[test]
fn what_has_no_end_is_told_and_what_was_closed_is_closed_again() {
    let folder = Folder::new("prepare-ends");
    let [ball, tube] = ["ball.ply", "tube.ply"].map(|name| folder.file(name));
    let write = |file: &str, mesh: &lumen::mesh::TriMesh| {
        std::fs::write(file, lumen::io::write(mesh, None, lumen::io::Format::Ply).unwrap()).unwrap();
    };
    write(&ball, &lumen::mesh::shapes::icosphere(4, 5.0, glam::Vec3::ZERO));
    write(&tube, &lumen::mesh::shapes::capped(24, 30, 30.0, 2.0));
    let out = folder.file("out");
    let told = lumen(&["prepare", &ball, "--cap", "planar", "-o", &out]);
    assert!(told.status.success() && String::from_utf8_lossy(&told.stderr).contains("No end was found"), "{told:?}");
    succeed(&["prepare", &tube, "--extend", "5", "-o", &out]);
    let patches = json(&format!("{out}/tube.json"));
    assert_eq!((patches["is_ready"].as_bool(), patches["patches"].as_array().unwrap().len()), (Some(true), 3));
}

#[test]
fn a_cap_that_is_rounded_is_told_with_what_would_help() {
    let folder = Folder::new("caps");
    let [file, out] = ["tube.ply", "out.ply"].map(|name| folder.file(name));
    let tube = lumen::mesh::shapes::capped(96, 120, 30.0, 2.0);
    std::fs::write(&file, lumen::io::write(&tube, None, lumen::io::Format::Ply).unwrap()).unwrap();
    let of = |options: &[&str]| {
        let done = lumen(&[&["optimise", &file, "-o", &out], options].concat());
        assert!(done.status.success());
        String::from_utf8_lossy(&done.stderr).into_owned()
    };
    let told = of(&["--no-hold-caps"]);
    assert!(told.contains("2 inlets and outlets are no longer flat.") && told.contains("Hold the caps"), "{told}");
    assert!(!of(&[]).contains("inlet"));
    // What is left as it was has changed nothing.
    assert!(!of(&["--no-hold-caps", "--iterations", "0", "--reduction", "0"]).contains("inlet"));
}

/// The files below a folder, by their ways from it.
fn walk(folder: &Path) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if path.is_dir() {
            found.extend(walk(&path).into_iter().map(|below| format!("{name}/{below}")));
        } else {
            found.insert(name);
        }
    }
    found
}

#[test]
fn a_capped_model_keeps_its_caps_as_patches_of_their_areas() {
    let folder = Folder::new("prepare-capped");
    let (file, out) = (folder.file("tube.ply"), folder.file("out"));
    // 48 sides in a circle of 2 mm.
    let tube = lumen::mesh::shapes::capped(48, 60, 30.0, 2.0);
    std::fs::write(&file, lumen::io::write(&tube, None, lumen::io::Format::Ply).unwrap()).unwrap();
    succeed(&["prepare", &file, "--remesh", "16", "-o", &out]);
    let patches = json(&format!("{out}/tube.json"));
    let polygon = 48.0 * 2.0 * (std::f64::consts::TAU / 48.0).sin();
    let [wall, inlet, outlet] = &patches["patches"].as_array().unwrap()[..] else { panic!("{patches}") };
    assert!((wall["area_mm2"].as_f64().unwrap() / (std::f64::consts::TAU * 2.0 * 30.0) - 1.0).abs() < 0.01);
    for end in [inlet, outlet] {
        assert!((end["area_mm2"].as_f64().unwrap() / polygon - 1.0).abs() < 0.005, "{end}");
        assert!((end["normal"][2].as_f64().unwrap().abs() - 1.0).abs() < 1e-4, "{end}");
    }
}

#[test]
fn a_settings_file_says_what_is_done_and_options_count_for_more() {
    let folder = Folder::new("prepare-settings");
    let [file, settings, nothing, out] = ["tube.ply", "s.json", "n.json", "out"].map(|name| folder.file(name));
    let tube = lumen::mesh::shapes::tube(24, 30, 30.0, |_| 2.0);
    std::fs::write(&file, lumen::io::write(&tube, None, lumen::io::Format::Ply).unwrap()).unwrap();
    let solver = Some(Plan { clip: None, ..Plan::flow() });
    let text = write_settings_and(&SharedSettings::default(), Beside { solver, ..Beside::default() });
    std::fs::write(&settings, text).unwrap();
    let made = |options: &[&str]| {
        succeed(&[&["prepare", &file, "--settings", &settings, "--format", "stl", "-o", &out], options].concat());
        let text = std::fs::read_to_string(format!("{out}/tube.stl")).unwrap();
        let along = text.lines().filter_map(|line| line.trim().strip_prefix("vertex "));
        let along: Vec<f64> = along.map(|line| line.split(' ').nth(2).unwrap().parse().unwrap()).collect();
        let length = along.iter().copied().fold(f64::MIN, f64::max) - along.iter().copied().fold(f64::MAX, f64::min);
        (length, text.matches("endsolid").count())
    };
    let near = |(length, solids): (f64, usize), expected: f64, count: usize| {
        assert!((length - expected).abs() < 0.01 && solids == count, "{length} mm, {solids} solids");
    };
    // That of a circle of the polygon's area.
    let radius = 2.0 * (12.0 / PI * (PI / 12.0).sin()).sqrt();
    near(made(&[]), 30.0 + 2.0 * 5.0 * radius, 3);
    near(made(&["--extend", "1mm"]), 32.0, 3);
    // One end is cut 6 mm from its rim, and the other left; what a file says of cuts is added to.
    near(made(&["--extend", "none", "--clip-end", "1,0,29=6mm"]), 24.0, 3);
    near(made(&["--extend", "none", "--cap", "none"]), 30.0, 1);
    std::fs::write(&nothing, write_settings_and(&SharedSettings::default(), Beside::default())).unwrap();
    let told = lumen(&["prepare", &file, "--settings", &nothing, "-o", &out]);
    assert!(String::from_utf8_lossy(&told.stderr).contains("says nothing of a solver"), "{told:?}");
}

#[test]
fn tubes_that_cross_are_wrapped_and_keep_their_ends() {
    let folder = Folder::new("prepare-wrap");
    let [file, settings, out] = ["cross.ply", "s.json", "out"].map(|name| folder.file(name));
    let along = lumen::mesh::shapes::tube(24, 30, 30.0, |_| 2.0);
    let mut across = along.clone();
    across.positions.iter_mut().for_each(|p| *p = lumen::mesh::Vec3::new(p.z - 15.0, p.x, p.y + 15.0));
    let both = lumen::mesh::shapes::joined(&[along, across]);
    std::fs::write(&file, lumen::io::write(&both, None, lumen::io::Format::Ply).unwrap()).unwrap();
    let solver = Some(Plan { wrap: Some(0.4), ..Plan::default() });
    let text = write_settings_and(&SharedSettings::default(), Beside { solver, ..Beside::default() });
    std::fs::write(&settings, text).unwrap();
    let mut made = Vec::new();
    for options in [&["--wrap", "0.4mm"][..], &["--settings", &settings]] {
        succeed(&[&["prepare", &file, "--format", "stl", "-o", &out], options].concat());
        let summary = json(&format!("{out}/cross.json"));
        assert_eq!((&summary["is_ready"], summary["patches"].as_array().unwrap().len()), (&true.into(), 5));
        let told = summary["notes"][0].as_str().unwrap();
        assert!(told.starts_with("The surface is wrapped, at most 0."), "{told}");
        let (solids, volume) = solids(Path::new(&format!("{out}/cross.stl")));
        assert_eq!(solids.len(), 5);
        // What two cylinders have in common is 16 / 3 of the radius cubed.
        let expected = 8.0 * PI * 30.0 - 16.0 / 3.0 * 8.0;
        assert!((volume / expected - 1.0).abs() < 0.03, "{volume} of {expected}");
        made.push(volume);
    }
    assert_eq!(made[0], made[1]);
}

#[test]
fn what_cannot_be_prepared_gets_a_sentence_and_no_file() {
    let folder = Folder::new("prepare-refused");
    let out = folder.file("out");
    for (arguments, status, sentence) in [
        (&[][..], 2, "nothing is asked for"),
        (&["--clip", "-1"], 2, "is no length"),
        (&["--cap", "round"], 2, "there are fan, planar, smooth"),
        (&["--cap", "fan", "--format", "step"], 2, "there are stl, msh, inp, vtp, simvascular"),
        (&["--remesh", "2"], 2, "3 edges around or more"),
        (&["--clip-end", "1,2=3mm"], 2, "is no cut of an end"),
        (&["--clip-end", "1,2,x=3mm"], 2, "is no cut of an end"),
        (&["--clip-end", "1,2,3=far"], 2, "is no length"),
        (&["--wrap", "0"], 2, "is no tolerance in mm"),
        (&["--wrap", "0.001mm"], 1, "would be too large: try"),
    ] {
        let refused = lumen(&[&["prepare", "sample:aorta", "-o", &out], arguments].concat());
        let error = String::from_utf8_lossy(&refused.stderr);
        assert_eq!(refused.status.code(), Some(status), "{arguments:?}: {error}");
        assert!(error.contains(sentence) && !Path::new(&out).exists(), "{arguments:?}: {error}");
    }
}
