//! The settings file: what is saved is what was used, and read it makes the same.

use lumen::sharing::{SharedSettings, write_settings};
use serde_json::json;

use crate::program::{Folder, json, lumen, succeed};

#[test]
fn saved_settings_make_the_same_bytes_and_options_count_for_more() {
    let folder = Folder::new("settings");
    let vessel = folder.file("vessel.stl");
    succeed(&["phantom", "aorta", "--triangles", "8000", "-o", &vessel]);
    let [first, second, settings, again] = ["a.ply", "b.ply", "s.json", "t.json"].map(|name| folder.file(name));
    let asked = ["--window", "nuttall", "--pass-band", "0.05", "--no-guard", "--reduction", "80", "--unit", "mm"];
    succeed(&[&["optimise", &vessel, "-o", &first, "--save-settings", &settings][..], &asked].concat());
    succeed(&["optimise", &vessel, "-o", &second, "--settings", &settings, "--save-settings", &again]);
    assert_eq!(std::fs::read(&first).unwrap(), std::fs::read(&second).unwrap());
    assert_eq!(std::fs::read(&settings).unwrap(), std::fs::read(&again).unwrap());
    let saved = json(&settings);
    assert_eq!((&saved["unit"], &saved["settings"]["smoothing"]["window"]), (&json!("mm"), &json!("Nuttall")));
    // An option beside the file changes what it says and nothing else.
    succeed(&[
        "optimise",
        &vessel,
        "-o",
        &second,
        "--settings",
        &settings,
        "--reduction",
        "50",
        "--save-settings",
        &again,
    ]);
    let mut expected = saved;
    expected["settings"]["target"] = json!({ "Reduction": 500 });
    assert_eq!(json(&again), expected);
}

#[test]
fn settings_that_cannot_be_used_are_refused_before_any_work() {
    let folder = Folder::new("settings-bad");
    let (settings, out) = (folder.file("s.json"), folder.file("out.stl"));
    for (text, sentence) in [
        ("{}", "This is no file of Lumen's settings."),
        (r#"{"format":"lumen-settings","version":7}"#, "were written by a newer Lumen: their version is 7"),
        (r#"{"format":"lumen-settings","version":1,"colour":1}"#, "unknown field `colour`"),
    ] {
        std::fs::write(&settings, text).unwrap();
        let output = lumen(&["optimise", "sample:aorta", "-o", &out, "--settings", &settings]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains(sentence) && error.lines().count() == 1, "{error}");
    }
    std::fs::write(&settings, write_settings(&SharedSettings::default())).unwrap();
    for (option, path, sentence) in [
        ("--save-settings", &out, "would both be written to"),
        ("--report", &folder.file("./out.stl"), "would both be written to"),
        ("--report", &settings, "is to be read"),
        ("--save-settings", &settings, "is to be read"),
    ] {
        let output = lumen(&["optimise", "sample:aorta", "-o", &out, "--settings", &settings, option, path]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{option} {path}: {error}");
        assert!(error.contains(sentence), "{option} {path}: {error}");
    }
    assert!(!std::path::Path::new(&out).exists());
}
