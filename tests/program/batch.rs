//! `lumen optimise` on many files: one failure does not end the others, and nothing is written twice to one place.

use std::collections::BTreeMap;
use std::path::Path;

use lumen::sharing::{SharedSettings, write_settings};
use sha2::{Digest as _, Sha256};

use crate::program::{Folder, json, lumen, succeed};

/// Three small vessels, one of them not a surface.
fn vessels(folder: &Folder) -> String {
    let vessels = folder.file("vessels");
    std::fs::create_dir_all(&vessels).unwrap();
    let named = |name: &str| format!("{vessels}/{name}");
    succeed(&["phantom", "aorta", "--triangles", "4000", "-o", &named("b.stl")]);
    succeed(&["phantom", "aorta", "--triangles", "6000", "-o", &named("a.PLY.ply")]);
    std::fs::write(named("broken.stl"), "this is no mesh").unwrap();
    std::fs::write(named("notes.txt"), "left alone").unwrap();
    vessels
}

fn rows(summary: &str) -> Vec<BTreeMap<String, String>> {
    csv::Reader::from_path(summary).unwrap().deserialize().map(Result::unwrap).collect()
}

#[test]
fn a_folder_is_gone_through_whatever_fails_and_jobs_change_no_byte() {
    let folder = Folder::new("batch");
    let vessels = vessels(&folder);
    let outs = [("1", folder.file("one")), ("3", folder.file("three"))];
    for (jobs, out) in &outs {
        let output = lumen(&["optimise", &vessels, "-o", out, "--format", "vtp", "--jobs", jobs]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains("1 of 3 surfaces failed"), "{error}");
    }
    let [one, three] = outs.map(|(_, out)| out);
    let names = |folder: &str| {
        let mut names: Vec<String> =
            std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    };
    assert_eq!(names(&one), ["a.PLY.json", "a.PLY.vtp", "b.json", "b.vtp", "summary.csv"]);
    for name in ["a.PLY.vtp", "b.vtp"] {
        let bytes = |folder: &str| std::fs::read(format!("{folder}/{name}")).unwrap();
        assert_eq!(bytes(&one), bytes(&three), "{name}");
    }
    // The same surface as by itself.
    let alone = folder.file("alone.vtp");
    succeed(&["optimise", &format!("{vessels}/b.stl"), "-o", &alone]);
    assert_eq!(std::fs::read(alone).unwrap(), std::fs::read(format!("{one}/b.vtp")).unwrap());
    let rows = [&one, &three].map(|out| rows(&format!("{out}/summary.csv")));
    let [rows, others] = rows;
    assert_eq!(rows.iter().map(|row| &*row["status"]).collect::<Vec<_>>(), ["ok", "ok", "failed"]);
    for (row, other) in rows.iter().zip(&others) {
        for column in ["file", "sha256", "status", "error", "triangles_out", "deviation_max_mm", "calibre"] {
            assert_eq!(row[column], other[column], "{column}");
        }
        assert_eq!(row["disclaimer"], "Not for clinical decisions.");
    }
    let hash = Sha256::digest(std::fs::read(format!("{vessels}/b.stl")).unwrap());
    assert_eq!(rows[1]["sha256"], hash.iter().map(|byte| format!("{byte:02x}")).collect::<String>());
    let report = json(&format!("{one}/b.json"));
    assert_eq!(rows[1]["triangles_out"], report["output"]["triangles"].to_string());
    assert_eq!(rows[1]["deviation_max_mm"].parse::<f64>().ok(), report["deviation_mm"]["max"].as_f64());
    assert_eq!(rows[1]["calibre"], report["calibre"]["verdict"].as_str().unwrap_or_default());
    let measured = report["calibre"]["measured_percent"].as_f64();
    assert_eq!(rows[1]["calibre_measured_percent"].parse::<f64>().ok(), measured);
    assert!(rows[2]["error"].contains("broken.stl") && rows[2]["triangles_out"].is_empty(), "{:?}", rows[2]);
}

#[test]
fn names_that_collide_are_told_before_anything_is_written() {
    let folder = Folder::new("batch-names");
    let out = folder.file("out");
    let [first, second] = ["x", "y"].map(|name| {
        std::fs::create_dir_all(folder.file(name)).unwrap();
        let path = folder.file(&format!("{name}/Vessel.{}", if name == "x" { "stl" } else { "ply" }));
        std::fs::write(&path, "never read").unwrap();
        path
    });
    let (settings, summary) = (folder.file("x/Vessel.json"), format!("{out}/summary.csv"));
    std::fs::write(&settings, write_settings(&SharedSettings::default())).unwrap();
    let report = format!("{out}/./VESSEL.json");
    let cases: [(&[&str], &str); 11] = [
        (&[&first, &second, "-o", &out], "would both be written to"),
        (&[&first, "-o", &folder.file("x/")], "is to be read"),
        (&[&first, "sample:aorta", "-o", &out, "--save-settings", &first], "is to be read"),
        (&[&first, "sample:aorta", "-o", &out, "--save-settings", &report], "would both be written to"),
        (&[&first, "sample:aorta", "-o", &out, "--save-settings", &summary], "would both be written to"),
        (&[&second, "-o", &folder.file("x/"), "--settings", &settings], "is to be read"),
        (&[&first, "sample:aorta", "-o", &out, "--save-settings", &settings, "--reduction", "safe"], "is for one file"),
        (&[&first, &second, "-o", &second], "is no folder"),
        (&[&first, "-o", &format!("{out}/"), "--report", "r.json"], "--report is for one file"),
        (&[&first, &second, "-o", &format!("{out}.stl")], "would be a folder: if it is to be one"),
        (&[&first, "-o", &format!("{out}.stl"), "--jobs", "2"], "--jobs is for many files"),
    ];
    for (arguments, sentence) in cases {
        let output = lumen(&[&["optimise"], arguments].concat());
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {error}");
        assert!(error.contains(sentence), "{arguments:?}: {error}");
    }
    assert!(!Path::new(&out).exists());
    assert_eq!(std::fs::read_to_string(&first).unwrap(), "never read");
    let empty = folder.file("empty");
    std::fs::create_dir_all(&empty).unwrap();
    assert_eq!(lumen(&["optimise", &empty, "-o", &out]).status.code(), Some(1));
}

/// Whoever listens to the run goes away before the first surface is there.
#[test]
fn results_are_in_the_summary_though_nobody_hears_of_them() {
    use std::process::{Command, Stdio};

    let folder = Folder::new("batch-deaf");
    let vessels = vessels(&folder);
    let out = folder.file("out");
    let mut run = Command::new(env!("CARGO_BIN_EXE_lumen"))
        .args(["optimise", &vessels, "-o", &out, "--jobs", "2"])
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    drop(run.stderr.take());
    assert_eq!(run.wait().unwrap().code(), Some(1));
    let rows = rows(&format!("{out}/summary.csv"));
    assert_eq!(rows.iter().map(|row| &*row["status"]).collect::<Vec<_>>(), ["ok", "ok", "failed"]);
}

/// Ends a run in the middle: what is in the folder then is whole.
#[cfg(unix)]
#[test]
fn an_interrupted_run_leaves_no_part_of_a_file() {
    use std::io::{BufRead as _, BufReader};
    use std::process::{Command, Stdio};

    let folder = Folder::new("batch-interrupt");
    let out = folder.file("out/");
    let small = folder.file("small.stl");
    succeed(&["phantom", "aorta", "--triangles", "3000", "-o", &small]);
    let mut run = Command::new(env!("CARGO_BIN_EXE_lumen"))
        .args(["optimise", &small, "sample:coronary", "sample:aorta", "-o", &out])
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    // The first is done: the second takes longer than this.
    let mut lines = BufReader::new(run.stderr.take().unwrap()).lines();
    assert!(lines.next().unwrap().unwrap().starts_with("[1/3]"));
    let id = run.id().to_string();
    assert!(Command::new("sh").args(["-c", "kill -INT \"$0\"", &id]).status().unwrap().success());
    let rest: Vec<String> = lines.map(Result::unwrap).collect();
    assert_eq!(run.wait().unwrap().code(), Some(130), "{rest:?}");
    let mut names: Vec<_> = std::fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["small.json", "small.stl", "summary.csv"]);
    let rows = rows(&format!("{out}summary.csv"));
    assert_eq!(rows.iter().map(|row| &*row["status"]).collect::<Vec<_>>(), ["ok", "not run", "not run"]);
}
