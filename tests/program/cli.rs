//! The subcommands as a script sees them: files, reports, exit statuses.

use std::path::Path;

use serde_json::Value;

use crate::program::{Folder, json, lumen, succeed};

#[test]
fn inspect_prints_every_promised_field_of_the_sample() {
    let report: Value = serde_json::from_str(&succeed(&["inspect", "sample:aorta", "--json"])).unwrap();
    assert_eq!(report["largest_component_triangles"], 74_307);
    for field in [
        "format",
        "vertices",
        "triangles",
        "components",
        "boundary_edges",
        "non_manifold_edges",
        "degenerate_triangles",
        "area_mm2",
        "volume_mm3",
        "bounds_mm",
        "warnings",
    ] {
        assert!(!report[field].is_null(), "{field} of {report}");
    }
    assert_eq!((&report["non_manifold_edges"], &report["degenerate_triangles"]), (&0.into(), &0.into()));
}

#[test]
fn optimise_writes_table_two_of_the_paper_and_a_whole_report() {
    let folder = Folder::new("optimise");
    for (rate, printed) in [("10", 66_875), ("50%", 37_153), ("75", 18_576), ("90 %", 7_430), ("99", 743)] {
        let (out, report) = (folder.file("out.ply"), folder.file("report.json"));
        let table = succeed(&["optimise", "sample:aorta", "-o", &out, "--reduction", rate, "--report", &report]);
        assert!(table.contains("Not for clinical decisions."));
        let report = json(&report);
        let count = report["output"]["triangles"].as_i64().unwrap();
        assert!((count - printed).abs() <= 2, "{rate}: {count} beside the paper's {printed}");
        let read: Value = serde_json::from_str(&succeed(&["inspect", &out, "--json"])).unwrap();
        assert_eq!((&read["triangles"], &read["components"]), (&count.into(), &1.into()));
        assert_eq!(report["after_connectivity"]["triangles"], 74_307);
        assert_eq!(report["after_connectivity"]["components"], 1);
        assert_eq!(report["input"], "sample:aorta");
        let work =
            ["connectivity", "adjacency", "smoothing", "decimation", "level", "normals", "measures", "deviation"];
        for stage in work.iter().chain(&["read", "write"]) {
            assert!(report["stages_ms"][stage].as_f64().is_some_and(|ms| ms > 0.0), "{stage}");
        }
        for deviation in ["deviation_mm", "deviation_from_original_mm"] {
            let of = |what: &str| report[deviation][what].as_f64().unwrap();
            assert!(of("mean") <= of("rms") && of("rms") <= of("max") && of("p95") <= of("max"), "{report}");
        }
        assert!(report["volume_change_percent"].as_f64().is_some_and(|change| change.abs() < 10.0));
        assert!(report["area_change_percent"].is_number() && report["shortfall"].is_null());
    }
}

#[test]
fn a_count_can_be_asked_for_and_every_piece_kept() {
    let folder = Folder::new("count");
    let (out, report) = (folder.file("out.glb"), folder.file("report.json"));
    let arguments = ["optimise", "sample:aorta", "-o", &out, "--triangles", "5000", "--iterations", "0"];
    let optimise = || {
        succeed(&[&arguments[..], &["--keep-all-components", "--report", &report]].concat());
        json(&report)
    };
    let ms = |report: &Value| report["stages_ms"]["smoothing"].as_f64().unwrap();
    // On a busy machine the clock may run on while the program waits: the least of three.
    let report = [optimise(), optimise(), optimise()].into_iter().min_by(|a, b| ms(a).total_cmp(&ms(b))).unwrap();
    assert!((4_999..=5_000).contains(&report["output"]["triangles"].as_i64().unwrap()));
    assert_eq!(report["opened"]["components"], report["output"]["components"]);
    assert_eq!(ms(&report).round(), 0.0);
}

#[test]
fn thin_vessels_are_spared_where_that_is_asked_for() {
    let folder = Folder::new("spare");
    let (out, report) = (folder.file("out.stl"), folder.file("report.json"));
    let [plain, spared] = [&[][..], &["--spare-thin"]].map(|option| {
        succeed(&[&["optimise", "sample:aorta", "-o", &out, "--report", &report][..], option].concat());
        json(&report)
    });
    let is_spared = |report: &Value| report["settings"]["decimation"]["spare_thin"].clone();
    assert_eq!((is_spared(&plain), is_spared(&spared)), (false.into(), true.into()));
    assert_ne!(plain["output_fingerprint"], spared["output_fingerprint"]);
    let count = |report: &Value| report["output"]["triangles"].as_i64().unwrap();
    assert!((7_429..=7_430).contains(&count(&plain)) && (7_429..=7_430).contains(&count(&spared)));
}

#[test]
fn a_deviation_can_be_asked_for_and_is_kept() {
    let folder = Folder::new("deviation");
    let (out, report) = (folder.file("out.stl"), folder.file("report.json"));
    let mut before = f64::INFINITY;
    for asked in ["0.05", "0.5", "3mm"] {
        let arguments = ["optimise", "sample:aorta", "-o", &out, "--max-deviation", asked, "--report", &report];
        let table = succeed(&arguments);
        assert!(table.contains("next coarser level"), "{table}");
        let report = json(&report);
        let bound = report["bound"]["max_deviation_mm"].as_f64().unwrap();
        assert!((bound - asked.trim_end_matches("mm").parse::<f64>().unwrap()).abs() < 1e-9);
        assert!(report["deviation_mm"]["max"].as_f64().unwrap() <= bound, "{report}");
        assert!(report["bound"]["next_coarser_mm"].as_f64().unwrap() > 0.998 * bound, "{report}");
        let count = report["output"]["triangles"].as_f64().unwrap();
        assert!(count < before && report["bound"]["steps"].is_u64(), "{report}");
        before = count;
        assert!(report["stages_ms"]["bound"].as_f64().is_some_and(|ms| ms > 0.0));
    }
    let other = ["optimise", "sample:aorta", "-o", &out, "--report", &report, "--iterations", "0"];
    succeed(&other);
    assert!(json(&report)["bound"].is_null());
}

#[test]
fn the_same_input_and_settings_give_the_same_bytes() {
    let folder = Folder::new("same");
    let files = ["a.stl", "b.stl"].map(|name| folder.file(name));
    for file in &files {
        succeed(&["optimise", "sample:aorta", "-o", file, "--reduction", "95", "--window", "nuttall"]);
    }
    let [a, b] = files.map(|file| std::fs::read(file).unwrap());
    assert_eq!(a, b);
}

#[test]
fn phantoms_have_the_size_that_is_asked_for() {
    let folder = Folder::new("phantom");
    let out = folder.file("coronary.stl");
    succeed(&["phantom", "coronary", "--triangles", "60000", "-o", &out]);
    let report: Value = serde_json::from_str(&succeed(&["inspect", &out, "--json"])).unwrap();
    let largest = report["largest_component_triangles"].as_i64().unwrap();
    assert!((largest - 60_000).abs() <= 600, "{largest}");
}

#[test]
fn what_cannot_be_done_ends_with_one_and_a_sentence_and_leaves_the_output_alone() {
    let folder = Folder::new("failures");
    let (out, bad) = (folder.file("out.stl"), folder.file("bad.stl"));
    std::fs::write(&out, "precious").unwrap();
    std::fs::write(&bad, "this is no mesh").unwrap();
    assert_eq!(lumen(&["optimise", &out, "-o", &out]).status.code(), Some(2), "the input is not overwritten");
    let cases: [&[&str]; 3] =
        [&["optimise", "no-such-file.stl", "-o", &out], &["optimise", &bad, "-o", &out], &["inspect", "sample:kidney"]];
    for arguments in cases {
        let output = lumen(arguments);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {error}");
        assert!(error.starts_with("lumen: ") && error.lines().count() == 1, "{error}");
    }
    assert_eq!(std::fs::read_to_string(&out).unwrap(), "precious");
}

#[test]
fn a_command_line_without_sense_ends_with_two() {
    for arguments in [
        &["optimise", "sample:aorta"][..],
        &["optimise", "sample:aorta", "-o", "x.stl", "--reduction", "100"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--pass-band", "NaN"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--iterations", "201"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--feature-angle", "181"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--triangles", "0"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--max-deviation", "0"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--max-deviation", "-0.1"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--max-deviation", "NaN"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--max-deviation", "1", "--reduction", "50"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--max-deviation", "1", "--triangles", "50"],
        &["optimise", "sample:aorta", "-o", "x.docx"],
        &["phantom", "aorta", "-o", "x.stl", "--triangles", "100"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--window", "boxcar"],
        &["optimise", "sample:aorta", "-o", "x.stl", "--unit", "inch"],
    ] {
        let output = lumen(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn centrelines_are_written_as_vtp_and_csv() {
    let folder = Folder::new("centreline");
    let (vtp, csv) = (folder.file("out.vtp"), folder.file("out.csv"));
    let table = succeed(&["centreline", "sample:aorta", "-o", &vtp]);
    assert!(table.contains("branches") && table.contains("Not for clinical decisions."), "{table}");
    let text = std::fs::read_to_string(&vtp).unwrap();
    let arrays = ["MaximumInscribedSphereRadius", "Abscissas", "CenterlineIds", "GroupIds", "TractIds", "Blanking"];
    assert!(text.contains("type=\"PolyData\"") && arrays.iter().all(|name| text.contains(&format!("Name=\"{name}\""))));
    succeed(&["centreline", "sample:aorta", "-o", &csv]);
    let rows = std::fs::read_to_string(&csv).unwrap().lines().count() - 1;
    assert!(text.contains(&format!("NumberOfPoints=\"{rows}\"")), "{rows} rows");
    // What has no vessels has no centrelines, and no file.
    let flat = folder.file("flat.obj");
    std::fs::write(&flat, "v 0 0 0\nv 30 0 0\nv 30 30 0\nv 0 30 0\nf 1 2 3\nf 1 3 4\n").unwrap();
    let none = folder.file("none.vtp");
    let output = lumen(&["centreline", &flat, "-o", &none]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("the surface has no inside"));
    assert!(!Path::new(&none).exists());
    assert_eq!(lumen(&["centreline", "sample:aorta", "-o", "out.stl"]).status.code(), Some(2));
}

#[test]
fn the_calibre_of_each_branch_is_told() {
    let folder = Folder::new("branches");
    let (out, report) = (folder.file("out.ply"), folder.file("report.json"));
    let csv = folder.file("branches.csv");
    let arguments = ["optimise", "sample:aorta", "-o", &out, "--branches", "--report", &report];
    let table = succeed(&[&arguments[..], &["--branches-csv", &csv]].concat());
    assert!(table.contains("largest change at") && table.contains("branch 7"), "{table}");
    let found = json(&report);
    assert_eq!((&found["calibre"]["tolerance_percent"], &found["calibre"]["verdict"]), (&2.0.into(), &"kept".into()));
    let branches = found["branches"].as_array().unwrap();
    assert_eq!(branches.len(), 7);
    for branch in branches {
        let count = branch["abscissas_mm"].as_array().unwrap().len();
        for surface in ["opened", "smoothed", "reduced"] {
            for column in ["areas_mm2", "radii_mm", "inscribed_radii_mm"] {
                assert_eq!(branch[surface][column].as_array().unwrap().len(), count);
            }
        }
    }
    let rows = std::fs::read_to_string(&csv).unwrap();
    let stations = |branch: &Value| branch["abscissas_mm"].as_array().unwrap().len();
    assert_eq!(rows.lines().count() - 1, branches.iter().map(stations).sum::<usize>());
    // A row is what the report has of the place.
    let (branch, i) = (&branches[1], stations(&branches[1]) / 2);
    let cells: Vec<&str> = rows.lines().nth(1 + stations(&branches[0]) + i).unwrap().split(',').collect();
    assert_eq!((cells[0], cells[5]), ("2", branch["standings"][i].as_str().unwrap()));
    for (column, surface) in [(6, "opened"), (7, "smoothed"), (8, "reduced")] {
        let (area, written) =
            (branch[surface]["areas_mm2"][i].as_f64().unwrap(), cells[column].parse::<f64>().unwrap());
        assert!((area - written).abs() < 1e-4, "{surface}: {area} as {written}");
    }
    assert_eq!(lumen(&[&arguments[..], &["--branches-csv", &out]].concat()).status.code(), Some(2), "asked for twice");
    // At no tolerance at all, every branch that is measured has changed.
    succeed(&[&arguments[..], &["--tolerance", "0%"]].concat());
    assert_eq!(json(&report)["calibre"]["verdict"], "changed");
    assert_eq!(lumen(&[&arguments[..], &["--tolerance", "-1"]].concat()).status.code(), Some(2));
}

#[test]
fn a_rate_between_nought_and_one_draws_a_warning() {
    let folder = Folder::new("warning");
    let out = folder.file("out.stl");
    let output = lumen(&["optimise", "sample:aorta", "-o", &out, "--reduction", "0.9", "--iterations", "0"]);
    assert!(output.status.success());
    assert!(String::from_utf8(output.stderr).unwrap().contains("warning: --reduction 0.9"));
}

#[test]
fn a_trial_writes_every_promised_field_and_a_log_and_is_the_same_again() {
    let folder = Folder::new("trial");
    let [summary, again, log] = ["trial.json", "again.json", "trial.csv"].map(|name| folder.file(name));
    let sample = ["trial", "sample:aorta", "--reduction", "99", "--seed", "3"];
    let printed = succeed(&[&sample[..], &["--json", &summary, "--log", &log]].concat());
    assert!(printed.contains("the tip arrived") && printed.ends_with("Not for clinical decisions.\n"), "{printed}");
    let found = json(&summary);
    for field in [
        "reason",
        "time_s",
        "steps",
        "steps_per_second",
        "route_length_mm",
        "tip_distance_mm",
        "max_wall_force_n",
        "max_penetration_mm",
        "max_element_error_percent",
        "step_kinds",
        "unbalanced_share",
        "wire",
        "failed_wires",
        "surface",
    ] {
        assert!(!found[field].is_null(), "{field} of {found}");
    }
    assert!(["mean", "p50", "p95", "p99", "max"].iter().all(|part| found["step_ms"][part].as_f64().unwrap() > 0.0));
    assert_eq!((found["schema"].as_u64(), found["success"].as_bool()), (Some(3), Some(true)));
    assert_eq!((found["seed"].as_u64(), found["triangles"].as_u64()), (Some(3), Some(742)));
    let stations = found["stations"].as_array().unwrap();
    assert!(stations.len() == 5 && stations.iter().all(|station| station["steps_per_second"].as_f64().unwrap() > 0.0));
    assert!(found["tip_distance_mm"].as_f64().unwrap() <= 2.0 && found["max_wall_force_n"].as_f64().unwrap() > 0.0);
    // A row every ten steps, below the heading's six lines.
    let rows = std::fs::read_to_string(&log).unwrap();
    assert_eq!(rows.lines().count() as u64, 6 + found["steps"].as_u64().unwrap().div_ceil(10));
    assert!(rows.contains("not for clinical decisions"));
    let has_sign = |field: &str| field.starts_with('-') && field.bytes().all(|byte| b"-0.".contains(&byte));
    let samples = rows.lines().filter(|line| !line.starts_with('#'));
    assert!(!samples.flat_map(|line| line.split(',')).any(has_sign), "nought has no sign");
    succeed(&[&sample[..], &["--json", &again]].concat());
    for field in ["steps", "tip_distance_mm", "max_wall_force_n", "max_penetration_mm", "max_push_n"] {
        assert_eq!(json(&again)[field], found[field], "{field}");
    }
}

#[test]
fn a_wire_that_is_pressed_touches_in_more_places() {
    let folder = Folder::new("press");
    let path = folder.file("trial.json");
    let share = |press: &[&str]| {
        succeed(&[&["trial", "sample:aorta", "--reduction", "99", "--json", &path], press].concat());
        json(&path)["max_contact_share"].as_f64().unwrap()
    };
    let (free, pressed) = (share(&[]), share(&["--press", "0.001,60"]));
    assert!(pressed > 1.5 * free, "{pressed} for {free}");
}

#[test]
fn a_sweep_tells_of_each_rate_and_the_unreduced_surface_beside_itself_differs_by_nothing() {
    let folder = Folder::new("sweep");
    let [table, plot] = ["sweep.csv", "sweep.svg"].map(|name| folder.file(name));
    let asked = ["sweep", "sample:aorta", "--rates", "0,99", "--seeds", "2", "--csv", &table, "--plot", &plot];
    let printed = succeed(&asked);
    assert!(printed.contains("2 of 2") && printed.ends_with("Not for clinical decisions.\n"), "{printed}");
    let text = std::fs::read_to_string(&table).unwrap();
    let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    assert!(text.starts_with("# not for clinical decisions."));
    let rows: Vec<std::collections::BTreeMap<String, String>> = reader.deserialize().map(Result::unwrap).collect();
    let number = |row: usize, name: &str| rows[row][name].parse::<f64>().unwrap();
    assert_eq!((number(0, "rate_percent"), number(0, "triangles")), (0.0, 74_307.0));
    assert_eq!((number(1, "rate_percent"), number(1, "seeds"), number(1, "arrived")), (99.0, 2.0, 2.0));
    assert_eq!(number(0, "deviation_mm_max"), 0.0, "the same input on the same surface");
    assert!(
        number(1, "deviation_mm_max") >= number(1, "deviation_mm_median") && number(1, "deviation_mm_median") > 0.0
    );
    assert!(number(1, "noise_mm_median") > 0.0 && number(1, "peak_force_n_max") > 0.0);
    let picture = std::fs::read_to_string(&plot).unwrap();
    assert!(
        picture.starts_with("<svg") && picture.ends_with("</svg>\n") && picture.contains("Not for clinical decisions"),
        "{picture}"
    );
    let refused = lumen(&["sweep", "sample:aorta", "--wire", "bamboo"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("there is no wire \"bamboo\""));
}

#[test]
fn what_no_trial_can_be_made_of_gets_a_sentence() {
    for (arguments, status, sentence) in [
        (&["--wire", "bamboo"][..], 2, "there is no wire \"bamboo\"; there are floppy, workhorse"),
        (&["--press", "1"], 2, "two numbers with a comma between"),
        (&["--entry", "1,2"], 2, "three numbers with commas between"),
        (&["--element", "0"], 2, "element"),
        (&["--entry", "500,0,0"], 1, "no trial is possible: the entry (500.0, 0.0, 0.0) lies outside"),
        (&["--press", "0.2,0"], 2, "a load of 0.2 N on each mm of the wire is not possible: it can be from 0 to 0.1 N"),
        (&["--press", "-0.01,0"], 2, "a load of -0.01 N on each mm of the wire is not possible"),
        (&["--load", "0,0,-1"], 2, "a load of 1 N on each mm of the wire is not possible"),
    ] {
        let output = lumen(&[&["trial", "sample:aorta", "--reduction", "99"], arguments].concat());
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{arguments:?}: {error}");
        assert!(error.contains(sentence), "{arguments:?}: {error}");
    }
}

#[test]
fn arrays_and_axes_go_from_file_to_file() {
    let folder = Folder::new("arrays");
    let [ras, lps, glb, out] = ["ras.vtp", "lps.stl", "unknown.glb", "out.ply"].map(|name| folder.file(name));
    let optimise = |from: &str, to: &str, options: &[&str]| {
        let output = lumen(&[&["optimise", from, "-o", to, "--iterations", "0"][..], options].concat());
        (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let inspect = |file: &str| -> Value { serde_json::from_str(&succeed(&["inspect", file, "--json"])).unwrap() };
    let (code, _) = optimise("sample:aorta", &ras, &["--with", "normals,deviation", "--axes", "ras"]);
    assert_eq!(code, Some(0));
    let first = inspect(&ras);
    assert_eq!((&first["axes"], &first["arrays"][0]["name"]), (&Value::from("ras"), &Value::from("deviation_mm")));
    assert_eq!(
        (&first["arrays"][0]["on"], &first["arrays"][0]["type"]),
        (&Value::from("point"), &Value::from("float32"))
    );
    assert!(succeed(&["inspect", &ras]).contains("array deviation_mm          point, 1 x float32, "));

    let whole = ["--reduction", "0", "--axes", "lps"];
    let (code, said) = optimise(&ras, &lps, &whole);
    assert_eq!(code, Some(0));
    assert!(said.contains("STL has no place for arrays: deviation_mm is left out."), "{said}");
    assert!(!optimise(&ras, &lps, &[&whole[..], &["--arrays", "none"]].concat()).1.contains("no place"));
    let second = inspect(&lps);
    let side = |report: &Value, end: &str, axis: usize| report["bounds_mm"][end][axis].as_f64().unwrap();
    for axis in [0, 1] {
        assert_eq!(side(&first, "min", axis), -side(&second, "max", axis));
    }
    assert_eq!((side(&first, "min", 2), &second["axes"]), (side(&second, "min", 2), &Value::from("lps")));

    // glTF does not say which way a patient lies.
    assert_eq!(optimise(&lps, &glb, &[]).0, Some(0));
    let (code, said) = optimise(&glb, &out, &["--axes", "ras"]);
    assert!(code == Some(1) && said.contains("say it with --axes-in"), "{said}");
    assert_eq!(optimise(&glb, &out, &["--axes", "ras", "--axes-in", "lps"]).0, Some(0));
    assert_eq!(inspect(&out)["axes"], "ras");
    assert_eq!(optimise(&lps, &out, &["--axes-in", "ras"]).0, Some(1));
}

#[test]
fn mend_says_what_was_wrong_and_what_is_left() {
    let folder = Folder::new("mend");
    let (tube, out, report) = (folder.file("tube.obj"), folder.file("out.ply"), folder.file("report.json"));
    // A box of 30 by 30 by 60 mm as 6 quads, without one triangle, and with a fin.
    let mut text = String::new();
    for i in 0..8 {
        text += &format!("v {} {} {}\n", 30 * (i & 1), 30 * (i >> 1 & 1), 60 * (i >> 2));
    }
    text += "v 45 45 30\nf 1 3 4 2\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\nf 5 6 8\nf 4 8 9\n";
    std::fs::write(&tube, text).unwrap();
    let found: Value = serde_json::from_str(&succeed(&["inspect", &tube, "--json"])).unwrap();
    assert_eq!((&found["faults"]["non_manifold_edges"], &found["faults"]["holes"]), (&1.into(), &1.into()));
    let table = succeed(&["mend", &tube, "-o", &out, "--split", "--fill-holes", "100", "--report", &report]);
    assert!(table.contains("holes filled"), "{table}");
    let told = json(&report);
    assert_eq!((&told["mending"]["edges_split"], &told["mending"]["holes_filled"]), (&1.into(), &1.into()));
    assert_eq!((&told["faults_after"]["non_manifold_edges"], &told["faults_after"]["holes"]), (&0.into(), &0.into()));
    let refused = lumen(&["mend", &tube, "-o", &out]);
    let error = String::from_utf8_lossy(&refused.stderr);
    assert!(refused.status.code() == Some(2) && error.contains("nothing is asked for"), "{error}");
}

#[test]
fn the_unit_is_found_by_the_size_where_only_one_would_do() {
    let folder = Folder::new("unit");
    let (file, out, report) = (folder.file("box.obj"), folder.file("out.ply"), folder.file("report.json"));
    // A box of 3 by 3 by 24 cm, in metres.
    let mut text = String::new();
    for i in 0..8 {
        text +=
            &format!("v {} {} {}\n", 0.03 * f64::from(i & 1), 0.03 * f64::from(i >> 1 & 1), 0.24 * f64::from(i >> 2));
    }
    text += "f 1 3 4 2\nf 1 2 6 5\nf 2 4 8 6\nf 4 3 7 8\nf 3 1 5 7\nf 5 6 8 7\n";
    std::fs::write(&file, text).unwrap();
    let found: Value = serde_json::from_str(&succeed(&["inspect", &file, "--unit", "auto", "--json"])).unwrap();
    assert_eq!((&found["unit"], &found["unit_by_size"]), (&"m".into(), &true.into()));
    succeed(&["optimise", &file, "-o", &out, "--unit", "auto", "--reduction", "0", "--report", &report]);
    assert_eq!(json(&report)["unit"], serde_json::json!({ "unit": "m", "by_size": true }));
    // What has a usual size stays in mm.
    let found: Value = serde_json::from_str(&succeed(&["inspect", &out, "--unit", "auto", "--json"])).unwrap();
    assert_eq!((&found["unit"], &found["unit_by_size"]), (&"mm".into(), &false.into()));
}

#[test]
fn every_command_that_takes_a_unit_finds_it() {
    let output = ["-o", "is-not-there.csv"].as_slice();
    for (command, more) in [("centreline", output), ("tables", &[]), ("trial", &[]), ("sweep", &[])] {
        let refused = lumen(&[&[command, "is-not-there.stl", "--unit", "auto"], more].concat());
        let error = String::from_utf8_lossy(&refused.stderr);
        assert!(error.contains("cannot read is-not-there.stl"), "{command}: {error}");
    }
}

#[test]
fn a_glb_has_coarser_levels_where_they_are_asked_for_and_other_formats_refuse_them() {
    let folder = Folder::new("levels");
    let [plain, levels, stl] = ["plain.glb", "levels.glb", "levels.stl"].map(|name| folder.file(name));
    let made = |out: &str, more: &[&str]| {
        lumen(&[&["optimise", "sample:aorta", "-o", out, "--reduction", "90"], more].concat())
    };
    assert!(made(&plain, &[]).status.success() && made(&levels, &["--levels"]).status.success());
    let read = |path: &str| std::fs::read(path).unwrap();
    let triangles =
        |bytes: &[u8]| lumen::io::read(bytes, "a.glb", &lumen::io::ImportOptions::default()).unwrap().mesh.triangles;
    assert_eq!(triangles(&read(&plain)), triangles(&read(&levels)));
    let bytes = read(&levels);
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let told: serde_json::Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    let count = |mesh: &serde_json::Value| {
        let indices = mesh["primitives"][0]["indices"].as_u64().unwrap() as usize;
        told["accessors"][indices]["count"].as_f64().unwrap()
    };
    let counts: Vec<f64> = told["meshes"].as_array().unwrap().iter().map(count).collect();
    assert!(counts.len() > 2 && counts.windows(2).all(|pair| (pair[1] / pair[0] - 0.5).abs() < 0.01), "{counts:?}");
    let refused = made(&stl, &["--levels"]);
    assert!(!refused.status.success() && !std::path::Path::new(&stl).exists());
    assert!(String::from_utf8_lossy(&refused.stderr).contains("GLB alone"));
}
