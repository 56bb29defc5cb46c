//! Reports of the peers' bench, made up, and what is read and drawn of them.

use serde_json::{Value, json};

use super::*;

/// A report as `benches/peers/run.py` writes it: every time it takes, two runs of one surface.
fn sample() -> Value {
    let mut ms = serde_json::Map::new();
    let mut add = |key: String, median: f64| {
        ms.insert(key, json!([median - 1.0, median + 1.0]));
    };
    for (place, factor) in [("lumen", 1.0), ("wasm", 2.0)] {
        for (stage, time) in
            [("connectivity", 1.5), ("adjacency", 2.0), ("areas", 2.0), ("smoothing30", 6.0), ("smoothing60", 11.0)]
        {
            add(format!("{place}.{stage}"), time * factor);
        }
        for (stage, time) in [
            ("smoothing100", 18.0),
            ("normals", 1.5),
            ("decimation", 50.0),
            ("level0", 1.5),
            ("level90", 1.0),
            ("normals90", 1.0),
        ] {
            add(format!("{place}.{stage}"), time * factor);
        }
    }
    for (stage, time) in [
        ("connectivity", 12.0),
        ("smoothing30", 27.0),
        ("smoothing60", 46.0),
        ("smoothing100", 72.0),
        ("normals", 16.0),
    ] {
        add(format!("vtk.{stage}"), time);
    }
    for rate in RATES {
        for (peer, time) in
            [("vtk.pro", 120.0), ("vtk.quadric", 200.0), ("fast", 25.0), ("meshopt", 15.0), ("meshoptWasm", 16.0)]
        {
            add(format!("{peer}{rate}"), time);
        }
    }
    add("wasm.otherPassBand60".to_owned(), 9.0);
    // The paper's setting, and what comes after its level.
    for (stage, time) in [
        ("connectivity", 1.5),
        ("adjacency", 2.0),
        ("areas", 2.0),
        ("smoothing100", 18.0),
        ("decimation", 60.0),
        ("level90", 1.0),
        ("normals90", 1.0),
        ("deviation", 250.0),
        ("measures", 150.0),
    ] {
        add(format!("lumen.paper.{stage}"), time);
    }
    for (key, time) in [("vtk.paper.smoothing100", 72.0), ("vtk.paper.pro90", 130.0)] {
        add(key.to_owned(), time);
    }
    for (stage, time) in [("smoothing30", 1000.0), ("smoothing60", 1500.0), ("smoothing100", 2600.0), ("normals", 60.0)]
    {
        add(format!("vtkjs.{stage}"), time);
    }
    let made = json!({ "settings": { "keep": "Largest" }, "fingerprint": "00ff" });
    let row = |rate: u32, method: &str, triangles: u32, mean: f64| {
        json!({ "rate": rate, "method": method, "triangles": triangles, "mean": mean, "rms": mean, "max": 3.0 * mean,
                "volume_percent": -mean, "slivers_percent": 3.0, "self_intersecting": 0, "pieces": 1, "non_manifold": 0, "euler": -1 })
    };
    let quadric = |mean: f64, max: f64| {
        let mut row = row(90, "Lumen quadric", 7_430, mean);
        (row["max"], row["slivers_percent"]) = (max.into(), 0.8.into());
        row
    };
    let rows = json!([
        row(0, "what enters", 74_312, 0.0),
        row(90, "Lumen schroeder", 7_430, 0.04),
        row(90, "DecimatePro, topology kept", 7_430, 0.09),
        quadric(0.015, 0.144),
        row(90, "vtkQuadricDecimation", 7_430, 0.043),
        row(99, "Lumen schroeder", 742, 0.30),
        row(99, "DecimatePro, topology kept", 3_851, 0.24),
    ]);
    json!({
        "machine": { "cpu": "a processor", "cores": 2, "system": "a system" },
        "versions": { "VTK": "9.7.1" },
        "surfaces": [{
            "name": "aorta.ply", "runs": 2, "triangles": 74_312, "vertices": 37_317, "ms": ms, "chromium": "150.0",
            "lumen": { "schroeder": made }, "wasm_fingerprints": { "schroeder": "00ff" },
            "quality": [{ "pass_band": 0.1, "iterations": 60, "rows": rows }],
        }],
        "memory": [{ "file": "million.stl", "triangles": 1_000_000, "native": 381_000_000_u64, "page": 200_000_000_u64,
                     "worker": 350_000_000_u64, "seconds": 9.5 }],
    })
}

fn parsed(report: &Value) -> anyhow::Result<Report> {
    Report::parse(&report.to_string())
}

fn block(report: &Value, name: &str) -> String {
    let blocks = blocks(&parsed(report).unwrap());
    blocks.into_iter().find(|(found, _)| *found == name).map(|(_, text)| text).unwrap()
}

/// The cells of the row that begins with `what`.
fn cells(text: &str, what: &str) -> Vec<String> {
    let row =
        text.lines().find(|line| line.starts_with(&format!("| {what}"))).unwrap_or_else(|| panic!("{what} in {text}"));
    row.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
}

#[test]
fn times_are_told_beside_vtk_with_what_is_met() {
    let text = block(&sample(), "times");
    let connectivity = cells(&text, "connectivity");
    assert_eq!(
        connectivity[1..],
        ["12.0 (11.0)", "1.50 (0.50)", "0.12", "at most 0.15: met", "3.00 (2.00)", "0.25", "at most 0.15: **missed**"]
    );
    // 20 of 72 ms: the adjacency counts.
    assert_eq!(cells(&text, "smoothing, 100")[3], "0.28");
    // 12 + 46 + 16 + 120 over 1.5 + 2 + 2 + 11 + 1.5 + 50 + 1 + 1.
    assert_eq!(cells(&text, "to the level at 90 %, 60")[3..5], ["2.77x", "at least 4x: **missed**"]);
    // 12 + 72 + 16 + 130 over 1.5 + 2 + 2 + 18 + 1.5 + 60 + 1 + 1.
    assert_eq!(cells(&text, "to the level at 90 %, at the paper's")[3], "2.64x");
    assert_eq!(cells(&text, "Lumen schroeder")[1], "50.0 (49.0): 0.67 of meshoptimizer's five, below 1: met");
    assert_eq!(cells(&text, "another pass band")[6..], ["0.41", "under half of 60 iterations: met"]);
    assert_eq!(cells(&text, "a level at 90 %")[7], "under 2 ms: **missed**");
    assert!(text.contains("`00ff` natively and in the browser the same"));
}

#[test]
fn what_users_wait_for_has_the_measuring_in_it() {
    // 87 to the level, 250 and 150 more.
    let text = block(&sample(), "times");
    assert_eq!(cells(&text, "ms |")[1..], ["87.0 (79.0)", "250.0 (249.0)", "150.0 (149.0)", "487.0 (477.0)"]);
}

#[test]
fn smoothing_in_the_browser_is_told_beside_vtk_in_javascript() {
    // 2 x 11 and twice the adjacency of 2, of 1,500.
    let text = block(&sample(), "times");
    let beside = text.split("vtk.js ms").nth(1).unwrap();
    assert_eq!(cells(beside, "smoothing, 60")[1..], ["1500.0 (1499.0)", "26.0 (24.0)", "0.017"]);
}

#[test]
fn quality_says_what_is_missed() {
    let text = block(&sample(), "quality");
    // A mean that is met does not make up for a maximum that is not.
    assert_eq!(cells(&text, "90 Lumen quadric")[11], "**missed**: max");
    assert_eq!(cells(&text, "90 Lumen schroeder")[11], "met");
    assert_eq!(cells(&text, "99 Lumen schroeder")[11], "**missed**: mean, max");
    assert_eq!(cells(&text, "99 DecimatePro")[11], "");
}

#[test]
fn memory_is_told_of_every_place() {
    let text = block(&sample(), "memory");
    assert_eq!(cells(&text, "million.stl")[2..], ["381", "200", "350", "550", "9.5", "the pipeline below 500: met"]);
}

#[test]
fn a_level_that_differs_in_the_browser_is_told() {
    let mut report = sample();
    report["surfaces"][0]["wasm_fingerprints"]["schroeder"] = "0100".into();
    assert!(block(&report, "times").contains("**another in the browser**"));
}

#[test]
fn a_report_that_lacks_runs_is_none() {
    let mut report = sample();
    report["surfaces"][0]["ms"]["vtk.normals"] = json!([1.0]);
    assert!(parsed(&report).unwrap_err().to_string().contains("vtk.normals has 1 of 2 runs"));
    assert!(Report::parse("{}").is_err());
}
