//! `lumen report`: what others read of the page.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::Value;
use sha2::{Digest as _, Sha256};

use super::program::{Folder, json, lumen, succeed};

/// The text of a PDF, page by page, as another's reader finds it.
fn text_of(path: &str) -> Vec<String> {
    let pdf = lopdf::Document::load(path).unwrap();
    pdf.get_pages().into_keys().map(|page| pdf.extract_text(&[page]).unwrap()).collect()
}

/// With its line breaks as spaces.
fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// A tube of 6 mm along x with so much left of its radius at the middle, as OBJ in a unit of so many mm.
fn tube(left: f64, unit: f64) -> String {
    let (sides, rings) = (48, 160);
    let mut text = String::new();
    for ring in 0..=rings {
        let x = 60.0 * f64::from(ring) / f64::from(rings);
        let radius = 3.0 * (1.0 - (1.0 - left) * (-(x - 30.0) * (x - 30.0) / 32.0).exp());
        for side in 0..sides {
            let angle = (f64::from(side) + f64::from(ring % 2) / 2.0) / f64::from(sides) * std::f64::consts::TAU;
            let [x, y, z] = [x, radius * angle.cos(), radius * angle.sin()].map(|mm| mm / unit);
            text += &format!("v {x} {y} {z}\n");
        }
    }
    let at = |ring: i32, side: i32| ring * sides + side % sides + 1;
    for (ring, side) in (0..rings).flat_map(|ring| (0..sides).map(move |side| (ring, side))) {
        let (a, b, c, d) = (at(ring, side), at(ring, side + 1), at(ring + 1, side), at(ring + 1, side + 1));
        let [e, f] = if ring % 2 == 0 { [[a, b, c], [b, d, c]] } else { [[a, b, d], [a, d, c]] };
        for [i, j, k] in [e, f] {
            text += &format!("f {i} {j} {k}\n");
        }
    }
    text
}

#[test]
fn the_pdf_of_a_stenosis_can_be_searched_and_names_no_file() {
    let folder = Folder::new("report-pdf");
    let (file, out) = (folder.file("Doe_Jane.obj"), folder.file("a.pdf"));
    std::fs::write(&file, tube(0.3, 1.0)).unwrap();
    let told = succeed(&["report", &file, "-o", &out, "--title", "Case 12", "--no-pictures", "--reduction", "60"]);
    assert!(told.contains("verdict"), "{told}");
    let pages = text_of(&out);
    let text = flat(&pages.join(" "));
    // `sha256sum` says the same.
    let sum = std::process::Command::new("sha256sum").arg(&file).output().unwrap();
    let sum = String::from_utf8(sum.stdout).unwrap();
    assert!(text.replace(' ', "").contains(sum.split(' ').next().unwrap()), "{text}");
    for part in
        ["Case 12", "Not for clinical decisions", "pass band 0.01", "branch 1", "narrower", "Numbers", "Page 1 of 1"]
    {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert!(!text.contains("Doe"), "{text}");
    let degree = text.split(" % narrower").next().unwrap().rsplit(' ').next().unwrap().parse::<f64>().unwrap();
    assert!((degree - 70.0).abs() <= 2.0, "{degree}");
    assert!(std::fs::metadata(&out).unwrap().len() < 60_000);
    // The same again gives the same, and the date is that of the day.
    let today = || lumen::report::today();
    let (before, again) = (today(), folder.file("b.pdf"));
    succeed(&["report", &file, "-o", &again, "--title", "Case 12", "--no-pictures", "--reduction", "60"]);
    assert!([before, today()].iter().any(|day| flat(&text_of(&again).join(" ")).contains(&format!("Date {day}"))));
    let dated = ["c.pdf", "d.pdf"].map(|name| {
        let out = folder.file(name);
        succeed(&["report", &file, "-o", &out, "--no-pictures", "--reduction", "60", "--date", "2026-02-28"]);
        assert!(flat(&text_of(&out).join(" ")).contains("Date 2026-02-28"));
        std::fs::read(&out).unwrap()
    });
    assert_eq!(dated[0], dated[1]);
    let refused = lumen(&["report", &file, "-o", &out, "--date", "2026-02-29"]);
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn names_are_text_in_the_web_page_and_nothing_comes_from_elsewhere() {
    let folder = Folder::new("report-html");
    let (file, out) = (folder.file("a.obj"), folder.file("a.html"));
    std::fs::write(&file, tube(1.0, 1.0)).unwrap();
    let title = "<script>alert(1)</script>\" onload='x' & <img src=x>";
    succeed(&["report", &file, "-o", &out, "--title", title, "--no-pictures", "--reduction", "60"]);
    let page = std::fs::read_to_string(&out).unwrap();
    assert!(page.contains("&lt;script&gt;alert(1)&lt;/script&gt;&quot; onload=&#39;x&#39; &amp; &lt;img src=x&gt;"));
    for foreign in ["<script", "<img", "http:", "https:", "url(", "@import", "<link", "<iframe", "narrower"] {
        assert!(!page.to_lowercase().contains(foreign), "{foreign}");
    }
    assert!(page.contains("Not for clinical decisions.") && page.contains("<svg"));
    // So are case and comment, whose lines stay lines; a PDF has a question mark for what its font lacks.
    let pdf = folder.file("a.pdf");
    for out in [&out, &pdf] {
        let said = ["--case", "<b>12</b>", "--comment", "Größe: 血\n\n<i>\"so\"</i>"];
        succeed(&[&["report", &file, "-o", out, "--no-pictures", "--reduction", "60"][..], &said].concat());
    }
    let page = std::fs::read_to_string(&out).unwrap();
    assert!(page.contains("<td>&lt;b&gt;12&lt;/b&gt;</td>") && !page.contains("<b>"));
    assert!(page.contains("<td>Größe: 血\n\n&lt;i&gt;&quot;so&quot;&lt;/i&gt;</td>") && !page.contains("<i>"));
    let text = flat(&text_of(&pdf).join(" "));
    assert!(text.contains("Case <b>12</b> Comment Größe: ? <i>\"so\"</i>"), "{text}");
}

#[test]
fn the_surface_in_the_page_is_the_one_that_is_written_as_a_file() {
    let folder = Folder::new("report-surface");
    let (file, out, light) = (folder.file("a.obj"), folder.file("a.html"), folder.file("light.ply"));
    std::fs::write(&file, tube(0.5, 1.0)).unwrap();
    succeed(&["report", &file, "-o", &out, "--no-pictures", "--reduction", "60", "--surface"]);
    succeed(&["optimise", &file, "-o", &light, "--reduction", "60"]);
    let read = |path: &str| lumen::io::read(&std::fs::read(path).unwrap(), path, &Default::default()).unwrap().mesh;
    let (light, whole) = (read(&light), read(&file));
    let page = std::fs::read_to_string(&out).unwrap();
    for foreign in ["http:", "https:", "@import", "<link", "<iframe", "<img"] {
        assert!(!page.to_lowercase().contains(foreign), "{foreign}");
    }
    // The policy names the one script that there is.
    let script = page.rsplit("<script>").next().unwrap().split("</script>").next().unwrap();
    let hash = STANDARD.encode(Sha256::digest(script));
    assert!(
        page.contains(&format!(";script-src 'sha256-{hash}'\"")) && page.matches("<script>").count() == 1,
        "{hash}"
    );
    let data = page.split("id=\"surface\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    let bytes = |level: &Value, what: &str| STANDARD.decode(level[what].as_str().unwrap()).unwrap();
    let level = &data["levels"][0];
    let numbers = |what: &str| -> Vec<f64> {
        level[what].as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
    };
    let (low, size) = (numbers("low"), numbers("size"));
    let grid = bytes(level, "positions");
    let places: Vec<[f64; 3]> = grid
        .chunks_exact(6)
        .map(|place| {
            std::array::from_fn(|k| {
                low[k] + size[k] * f64::from(u16::from_le_bytes([place[2 * k], place[2 * k + 1]])) / 65_535.0
            })
        })
        .collect();
    let corners: Vec<usize> =
        bytes(level, "triangles").chunks_exact(2).map(|v| u16::from_le_bytes([v[0], v[1]]).into()).collect();
    assert_eq!((corners.len() / 3, level["wide"].as_bool()), (light.triangles.len(), Some(false)));
    // To half a step along each axis, and the rounding of the file.
    for (t, corners) in corners.chunks_exact(3).enumerate() {
        for (&v, written) in corners.iter().zip(light.corners(t)) {
            for k in 0..3 {
                let off = (places[v][k] - f64::from(written.to_array()[k])).abs();
                assert!(off <= 0.51 * size[k] / 65_535.0 + 4e-6, "triangle {t}: {off}");
            }
        }
    }
    assert_eq!(bytes(&data["levels"][1], "triangles").len(), 6 * whole.triangles.len());
    // A PDF cannot have it.
    assert_eq!(lumen(&["report", &file, "-o", &folder.file("a.pdf"), "--surface"]).status.code(), Some(2));
}

#[test]
fn a_report_is_a_pdf_or_a_web_page() {
    let folder = Folder::new("report-usage");
    let output = lumen(&["report", "sample:aorta", "-o", &folder.file("a.txt")]);
    assert_eq!(output.status.code(), Some(2));
}

#[test]
fn many_vessels_go_on_over_pages_each_with_the_head_of_the_table() {
    let folder = Folder::new("report-pages");
    let out = folder.file("a.pdf");
    succeed(&["report", "sample:coronary", "-o", &out, "--no-pictures"]);
    let pages = text_of(&out);
    let heads = pages.iter().filter(|page| flat(page).contains("Radius as opened, mm")).count();
    assert!(pages.len() > 1 && heads == pages.len(), "{} pages, {heads} heads", pages.len());
    for (i, page) in pages.iter().enumerate() {
        assert!(flat(page).contains(&format!("Page {} of {}", i + 1, pages.len())));
        assert!(flat(page).contains("Not for clinical decisions."));
    }
}

#[test]
#[cfg(feature = "gui")]
fn pictures_are_in_both_where_there_is_something_to_draw_with() {
    let folder = Folder::new("report-pictures");
    for (name, mark) in [("a.pdf", &b"/Predictor 15"[..]), ("a.html", &b"data:image/png;base64,"[..])] {
        let out = folder.file(name);
        let told = succeed(&["report", "sample:aorta", "-o", &out]);
        let bytes = std::fs::read(&out).unwrap();
        let found = bytes.windows(mark.len()).filter(|part| part == &mark).count();
        assert!(told.contains(&format!("pictures                    {found}")), "{told}");
        assert!(found == 4, "{found} pictures: a graphics device is needed, such as Debian's mesa-vulkan-drivers");
    }
}

#[test]
fn the_numbers_of_a_run_repeat_the_verdict_with_its_remedies() {
    let folder = Folder::new("report-verdict");
    let (file, out, numbers) = (folder.file("a.obj"), folder.file("a.stl"), folder.file("a.json"));
    std::fs::write(&file, tube(1.0, 10.0)).unwrap();
    let told = succeed(&["optimise", &file, "-o", &out, "--report", &numbers, "--reduction", "60"]);
    let verdict = &json(&numbers)["verdict"];
    assert_eq!(verdict["is_safe"], false);
    assert!(told.contains(verdict["head"].as_str().unwrap()), "{told}");
    let first = &verdict["findings"][0];
    assert!(first["is_grave"] == true && first["text"].as_str().unwrap().contains("unusual"), "{first}");
    assert_eq!(
        (&first["remedies"][0]["words"], &first["remedies"][0]["change"]["unit"]),
        (&"Read in cm".into(), &"cm".into())
    );
    // In its own unit nothing is to be looked at.
    succeed(&["optimise", &file, "--unit", "cm", "-o", &out, "--report", &numbers, "--reduction", "60"]);
    let verdict = &json(&numbers)["verdict"];
    assert_eq!(verdict["is_safe"], true);
    // Of 60 mm 3 are left out at each open end.
    let head = verdict["head"].as_str().unwrap();
    let percent =
        head.strip_prefix("Safe to simulate on: ").and_then(|rest| rest.split_once(" % of the length, 1 of 1 vessel"));
    assert!(percent.is_some_and(|(percent, _)| (87..=93).contains(&percent.parse().unwrap_or(0))), "{head}");
    let measured = json(&numbers)["calibre"]["measured_percent"].as_f64().unwrap();
    assert!((measured - 90.0).abs() <= 3.0, "{measured}");
}

#[test]
fn every_text_says_how_much_the_verdict_rests_on() {
    let folder = Folder::new("report-coverage");
    let (file, out, numbers) = (folder.file("a.obj"), folder.file("a.stl"), folder.file("a.json"));
    // As wide as half of its length: of 24 mm 12 are measured, between open ends.
    let scaled = |place: &str| {
        let at: Vec<f64> = place.split(' ').map(|number| number.parse().unwrap()).collect();
        format!("v {} {} {}\n", 0.4 * at[0], 2.0 * at[1], 2.0 * at[2])
    };
    let line = |line: &str| line.strip_prefix("v ").map_or_else(|| format!("{line}\n"), scaled);
    let short: String = tube(1.0, 1.0).lines().map(line).collect();
    std::fs::write(&file, short).unwrap();
    let run = |more: &[&str]| succeed(&[&["optimise", &file, "-o", &out, "--reduction", "60"], more].concat());
    let verdict = |told: &str| told.lines().find(|line| line.starts_with("verdict")).unwrap().to_owned();
    let alone = verdict(&run(&[]));
    assert!(alone.contains("No vessel was measured (--branches measures them)"), "{alone}");
    let told = run(&["--branches", "--report", &numbers]);
    let line = verdict(&told);
    assert!(line.contains("Kept where measured: ") && line.contains(" % of the length, 1 of 1 vessel"), "{line}");
    let found = json(&numbers);
    assert_eq!((&found["verdict"]["is_safe"], &found["calibre"]["verdict"]), (&Value::Null, &"kept".into()));
    let (all, measured) = (&found["calibre"]["coverage"]["length_mm"], &found["calibre"]["coverage"]["measured_mm"]);
    let (all, measured) = (all.as_f64().unwrap(), measured.as_f64().unwrap());
    assert!((all - 24.0).abs() < 0.1 && (measured - 12.0).abs() <= 2.0, "{measured} of {all} mm");
    let told = succeed(&["optimise", &file, "-o", &out, "--reduction", "safe"]);
    assert!(told.contains("kept where measured, to") && !told.contains("safe to"), "{told}");
    for page in ["a.html", "b.pdf"].map(|name| folder.file(name)) {
        let told = succeed(&["report", &file, "-o", &page, "--no-pictures", "--reduction", "60"]);
        assert!(told.contains("Kept where measured: ") && !told.contains("Safe"), "{told}");
        let text = if page.ends_with("pdf") {
            flat(&text_of(&page).join(" "))
        } else {
            std::fs::read_to_string(&page).unwrap()
        };
        assert!(text.contains("Kept where measured: ") && !text.contains("Safe"), "{text}");
    }
}
