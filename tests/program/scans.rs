//! Scans and masks on the command line.

use serde_json::Value;

use crate::program::{Folder, json, lumen, succeed};

/// A ball of 10 mm around (5, -20, 100), in voxels of 0.5 x 0.5 x 1 mm whose rows run to the patient's right, as a
/// MetaImage of bytes: `inside` where it is, else 0; or as a scan that falls by 20 a mm and is 100 at the wall.
fn ball(inside: Option<u8>) -> Vec<u8> {
    let mut bytes = b"ObjectType = Image\nNDims = 3\nBinaryData = True\nTransformMatrix = -1 0 0 0 1 0 0 0 1\n\
        AnatomicalOrientation = LAI\nOffset = 20 -35 85\nElementSpacing = 0.5 0.5 1\nDimSize = 61 61 31\nElementType = MET_UCHAR\n\
        ElementDataFile = LOCAL\n"
        .to_vec();
    for k in 0..31 {
        for j in 0..61 {
            for i in 0..61 {
                let [x, y, z] = [15.0 - 0.5 * f64::from(i), 0.5 * f64::from(j) - 15.0, f64::from(k) - 15.0];
                let distance = (x * x + y * y + z * z).sqrt();
                bytes.push(match inside {
                    Some(label) => label * u8::from(distance < 10.0),
                    None => (100.0 - 20.0 * (distance - 10.0)).round() as u8,
                });
            }
        }
    }
    bytes
}

#[test]
fn a_mask_is_inspected_cut_and_optimised() {
    let folder = Folder::new("mask");
    let (mask, out, report) = (folder.file("mask.mha"), folder.file("out.ply"), folder.file("report.json"));
    std::fs::write(&mask, ball(Some(3))).unwrap();
    let facts: Value = serde_json::from_str(&succeed(&["inspect", &mask, "--json"])).unwrap();
    assert_eq!(facts["dimensions"], serde_json::json!([61, 61, 31]));
    assert_eq!(facts["directions"][0], serde_json::json!([-1.0, 0.0, 0.0]));
    assert_eq!((&facts["sample_type"], &facts["labels"][0]["value"]), (&"8-bit unsigned".into(), &3.into()));
    assert!(succeed(&["surface", &mask, "--label", "3", "-o", &out]).contains("LPS"));
    let surface: Value = serde_json::from_str(&succeed(&["inspect", &out, "--json"])).unwrap();
    assert_eq!((&surface["components"], &surface["boundary_edges"]), (&1.into(), &0.into()));
    let of_mask: Value = serde_json::from_str(&succeed(&["inspect", &mask, "--label", "3", "--json"])).unwrap();
    assert_eq!(of_mask["triangles"], surface["triangles"]);
    assert_eq!((&of_mask["axes"], &of_mask["components_turned"]), (&"lps".into(), &0.into()));
    // With neither threshold nor label a mask is all that is not 0.
    succeed(&["optimise", &mask, "-o", &out, "--reduction", "50", "--report", &report]);
    assert_eq!(json(&report)["opened"]["triangles"], surface["triangles"]);
}

#[test]
fn a_scan_is_cut_at_a_threshold_within_a_box() {
    let folder = Folder::new("scan");
    let (scan, out) = (folder.file("scan.mha"), folder.file("out.ply"));
    std::fs::write(&scan, ball(None)).unwrap();
    succeed(&["surface", &scan, "--threshold", "100", "-o", &out]);
    let whole: Value = serde_json::from_str(&succeed(&["inspect", &out, "--json"])).unwrap();
    let exact = 4.0 / 3.0 * std::f64::consts::PI * 1000.0;
    let ratio = whole["volume_mm3"].as_f64().unwrap() / exact;
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
    let of = |bounds: &Value, which: &str, axis: usize| bounds["bounds_mm"][which][axis].as_f64().unwrap();
    for (axis, centre) in [5.0, -20.0, 100.0].into_iter().enumerate() {
        assert!((of(&whole, "min", axis) - centre + 10.0).abs() < 0.05);
        assert!((of(&whole, "max", axis) - centre - 10.0).abs() < 0.05);
    }
    // Columns from the middle on, which run to the patient's right.
    let half = ["inspect", &scan, "--threshold", "100", "--box", "30,60,0,60,0,30", "--json"];
    let half: Value = serde_json::from_str(&succeed(&half)).unwrap();
    assert!((of(&half, "max", 0) - 5.0).abs() < 1e-6 && half["boundary_edges"].as_u64().unwrap() > 50);
}

#[test]
fn a_mask_is_relaxed_by_surface_nets_around_a_seed() {
    let folder = Folder::new("nets");
    let (mask, out) = (folder.file("mask.mha"), folder.file("out.vtp"));
    std::fs::write(&mask, ball(Some(3))).unwrap();
    let nets = ["surface", &mask, "--surface-by", "nets", "-o", &out];
    let of_threshold = lumen(&["surface", &mask, "--threshold", "2", "--surface-by", "nets", "-o", &out]);
    assert_eq!(of_threshold.status.code(), Some(2));
    for arguments in [&nets[..], &[&nets[..], &["--seed", "5,-20,100"]].concat()] {
        succeed(arguments);
        let surface: Value = serde_json::from_str(&succeed(&["inspect", &out, "--json"])).unwrap();
        assert_eq!((&surface["components"], &surface["boundary_edges"]), (&1.into(), &0.into()));
        let ratio = surface["volume_mm3"].as_f64().unwrap() / (4.0 / 3.0 * std::f64::consts::PI * 1000.0);
        assert!((0.985..1.01).contains(&ratio), "{ratio}");
    }
    // A mask starts from them, and from marching cubes where these are asked for.
    let made = |by: &[&str]| {
        succeed(&[&["surface", &mask, "--label", "3", "-o", &out], by].concat());
        let surface: Value = serde_json::from_str(&succeed(&["inspect", &out, "--json"])).unwrap();
        surface["roughness"]["rms_deg"].as_f64().unwrap()
    };
    let [cubes, nets_too, default] = [&["--surface-by", "cubes"][..], &["--surface-by", "nets"], &[]].map(made);
    assert!(default == nets_too && default < 0.8 * cubes, "{default}, {nets_too}, {cubes}");
    // Outside of the ball nothing is connected.
    assert_eq!(lumen(&[&nets[..], &["--seed", "-9,-20,100"]].concat()).status.code(), Some(1));
    // The way of the reduction has the name --method.
    succeed(&["optimise", &mask, "--surface-by", "nets", "--method", "quadric", "--reduction", "50", "-o", &out]);
}

#[test]
fn how_far_another_threshold_moves_the_wall_is_told() {
    let folder = Folder::new("shifts");
    let (scan, out) = (folder.file("scan.mha"), folder.file("out.ply"));
    std::fs::write(&scan, ball(None)).unwrap();
    let said = succeed(&["surface", &scan, "--threshold", "100", "-o", &out]);
    // 10 of 100, where values fall by 20 a mm: half a millimetre.
    for (which, exact) in [("threshold 10 % lower", 0.5), ("threshold 10 % higher", -0.5)] {
        let line = said.lines().find(|line| line.starts_with(which)).unwrap_or_else(|| panic!("{which}: {said}"));
        let shift: f64 = line.split_whitespace().rev().nth(1).unwrap().parse().unwrap();
        assert!((shift - exact).abs() < 0.02, "{line}");
    }
    let (report, page) = (folder.file("report.json"), folder.file("page.html"));
    succeed(&["optimise", &scan, "--threshold", "100", "-o", &out, "--reduction", "50", "--report", &report]);
    let told = &json(&report)["threshold"];
    assert_eq!(told["value"], 100.0);
    for (which, exact) in [("lower_mm", 0.5), ("higher_mm", -0.5)] {
        assert!((told[which].as_f64().unwrap() - exact).abs() < 0.02, "{told}");
    }
    succeed(&["report", &scan, "--threshold", "100", "--no-pictures", "-o", &page]);
    let page = std::fs::read_to_string(&page).unwrap();
    let [_, row] = page.split("Threshold").collect::<Vec<_>>()[..] else { panic!("a row of its threshold") };
    assert!(row.contains("100; 10 % lower the wall lies +0.") && row.contains("10 % higher -0."), "{row}");
}

#[test]
fn what_is_strange_about_a_scan_is_said_once() {
    let folder = Folder::new("scan-warnings");
    let (scan, out) = (folder.file("scan.nrrd"), folder.file("out.ply"));
    let head = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 61 61 31\nspacings: 0.5 0.5 1\nencoding: raw\n\n";
    let ball = ball(None);
    std::fs::write(&scan, [head.as_bytes(), &ball[ball.len() - 61 * 61 * 31..]].concat()).unwrap();
    for arguments in [
        &["inspect", &scan][..],
        &["inspect", &scan, "--threshold", "100"],
        &["surface", &scan, "--threshold", "100", "-o", &out],
        &["optimise", &scan, "--threshold", "100", "-o", &out],
    ] {
        let output = lumen(arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{arguments:?}: {error}");
        let said =
            error.lines().filter(|line| line.starts_with("lumen: warning: ") && line.contains("the axes are unknown"));
        assert_eq!(said.count(), 1, "{arguments:?}: {error}");
    }
    // What the scan does not say is asserted nowhere, but taken from whoever knows it.
    assert!(!std::fs::read(&out).unwrap().windows(6).any(|word| word == b"SPACE="));
    for file in [&scan, &out] {
        let facts: Value = serde_json::from_str(&succeed(&["inspect", file, "--json"])).unwrap();
        assert_eq!(facts["axes"], "unknown", "{file}");
    }
    let turned = ["optimise", &scan, "--threshold", "100", "-o", &out, "--axes", "ras"];
    assert_eq!(lumen(&turned).status.code(), Some(1));
    succeed(&[&turned[..], &["--axes-in", "lps"]].concat());
    let facts: Value = serde_json::from_str(&succeed(&["inspect", &out, "--json"])).unwrap();
    assert_eq!(facts["axes"], "ras");
}

#[test]
fn what_makes_no_sense_is_refused() {
    let folder = Folder::new("scan-refused");
    let (scan, out) = (folder.file("scan.mha"), folder.file("out.ply"));
    std::fs::write(&scan, ball(None)).unwrap();
    let refused = |arguments: &[&str], status: i32, words: &str| {
        let output = lumen(arguments);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(status), "{said}");
        assert!(said.contains(words), "{said}");
    };
    refused(&["surface", &scan, "-o", &out], 1, "at which threshold its surface is to be made");
    refused(&["optimise", &scan, "-o", &out, "--threshold", "9000"], 1, "No surface lies at the threshold 9000");
    refused(&["surface", &scan, "-o", &out, "--threshold", "9", "--label", "1"], 2, "--label");
    refused(&["surface", &scan, "-o", &out, "--threshold", "9", "--box", "5,1,0,9,0,9"], 2, "six voxel numbers");
    refused(&["optimise", "sample:aorta", "-o", &out, "--label", "1"], 2, "is a surface");
    refused(&["optimise", &scan, "-o", &out, "--threshold", "100", "--unit", "cm"], 1, "--unit makes no sense");
    refused(&["inspect", &scan, "--unit", "cm"], 1, "--unit makes no sense");
    refused(&["inspect", &scan, "--box", "0,9,0,9,0,9"], 2, "say with --threshold or --label");
    refused(&["surface", &scan, "-o", &scan], 2, "does not end in");
    assert!(!std::path::Path::new(&out).exists());
}
