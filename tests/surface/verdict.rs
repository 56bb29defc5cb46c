//! What a verdict says of surfaces of which it is known how much can be measured: open tubes, of which a radius is left out at
//! each end.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use lumen::io::{Format, ImportOptions, read, write};
use lumen::mesh::TriMesh;
use lumen::pipeline::report::Report;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Target};
use lumen::pipeline::verdict::{FindingKind, Head, Remedied, Remedy, Verdict, VerdictReport};

use crate::smoothing::{tube, turned};

/// The numbers and the verdict of a run that takes six tenths of the triangles; with the calibre, or without.
fn verdict(mesh: &TriMesh, has_calibre: bool) -> (Report, Verdict) {
    verdict_at(mesh, 600, has_calibre)
}

/// The same of a run to another rate, in tenths of a percent.
fn verdict_at(mesh: &TriMesh, rate: u32, has_calibre: bool) -> (Report, Verdict) {
    let import = read(&write(mesh, None, Format::Obj).unwrap(), "a.obj", &ImportOptions::default()).unwrap();
    let settings = Settings { target: Target::Reduction(rate), ..Settings::default() };
    let mut pipeline = Pipeline::new(Arc::new(import.mesh), settings).with_samples(200);
    if has_calibre {
        pipeline = pipeline.with_safe();
    }
    pipeline.finish().unwrap();
    let report = Report::new("a.obj", &pipeline).unwrap();
    let verdict = Verdict::of_run(&pipeline, &report, &import.report, true);
    (report, verdict)
}

#[test]
fn a_surface_is_safe_where_three_quarters_of_its_length_are_measured() {
    // 54 of 60 mm.
    let (report, found) = verdict(&tube(3.0, 60.0, 0.7, 0.05), true);
    assert_eq!((found.head, found.is_safe), (Head::Safe, Some(true)), "{found:?}");
    let percent = found.coverage.unwrap().percent();
    assert!((percent - 90.0).abs() < 3.0, "{percent}");
    let head = found.head_text().to_string();
    assert_eq!(head, format!("Safe to simulate on: {:.0} % of the length, 1 of 1 vessel", percent.floor()));
    assert_eq!(VerdictReport::from(&found).head, head);
    let safe = report.safe.unwrap();
    assert!(safe.is_covered && safe.percent.is_some(), "{safe:?}");
    assert_eq!(report.calibre.unwrap().measured_percent, Some(percent));
}

#[test]
fn of_a_surface_that_is_measured_less_nothing_is_said_as_a_whole() {
    // 12 of 24 mm.
    let (report, found) = verdict(&tube(6.0, 24.0, 1.0, 0.02), true);
    assert_eq!((found.head, found.is_safe), (Head::KeptWhereMeasured, None), "{found:?}");
    let percent = found.coverage.unwrap().percent();
    assert!((percent - 50.0).abs() < 12.0, "{percent}");
    assert!(found.has_reservations());
    let text = found.in_short(|message| message.to_string());
    let head = format!("Kept where measured: {:.0} % of the length, 1 of 1 vessel. ", percent.floor());
    assert!(text.starts_with(&head) && !text.contains("Safe"), "{text}");
    let safe = report.safe.unwrap();
    assert!(!safe.is_covered && safe.percent.is_some() && safe.refused.is_none(), "{safe:?}");
}

#[test]
fn without_the_calibre_nothing_is_said_of_it() {
    let (report, found) = verdict(&tube(3.0, 60.0, 0.7, 0.05), false);
    assert_eq!((found.head, found.is_safe, found.coverage), (Head::NoneMeasured, None, None));
    assert_eq!(found.in_short(|message| message.to_string()), "No vessel was measured.");
    assert!(report.calibre.is_none() && report.safe.is_none());
}

/// Two legs of 30 mm at a half circle of 6 mm; taken apart too far, it loses 3 % of its volume.
#[test]
fn a_hairpin_that_is_narrower_than_it_was_is_nowhere_called_safe() {
    const LEG: f64 = 30.0;
    const BEND: f64 = 6.0;
    let arc = BEND * PI;
    let mut hairpin = tube(2.0, 2.0 * LEG + arc, 0.26, 0.02);
    for position in &mut hairpin.positions {
        let [x, y, z] = position.as_dvec3().to_array();
        let (sin, cos) = ((z - LEG).clamp(0.0, arc) / BEND).sin_cos();
        let beyond = (z - LEG).min(0.0) - (z - LEG - arc).max(0.0);
        *position = DVec3::new((x - BEND) * cos, y, LEG + (BEND - x) * sin + beyond).as_vec3();
    }
    let (report, unmeasured) = verdict_at(&hairpin, 970, false);
    assert!(report.volume_change_percent.unwrap() < -2.5, "{:?}", report.volume_change_percent);
    assert_eq!((unmeasured.head, unmeasured.is_safe), (Head::NoneMeasured, None));
    let (_, measured) = verdict_at(&hairpin, 970, true);
    assert_eq!((measured.head, measured.is_safe), (Head::ToLookAt { count: 1 }, Some(false)), "{measured:?}");
    let said = measured.calibre.unwrap().to_string();
    assert!(said.starts_with("1 of 1 measured vessels changes by more than 2 %"), "{said}");
}

#[test]
fn a_rate_at_which_too_little_can_be_measured_is_not_safe() {
    // At any rate that is called safe, the verdict is that it is.
    for (length, is_safe) in [(60.0, true), (45.0, true), (14.0, false)] {
        let mesh = tube(3.0, length, 0.7, 0.05);
        let (report, _) = verdict(&mesh, true);
        let safe = report.safe.unwrap();
        let rate = Target::Reduction((safe.percent.unwrap() * 10.0).round() as u32);
        let settings = Settings { target: rate, ..Settings::default() };
        let mut pipeline = Pipeline::new(Arc::new(mesh), settings).with_samples(200).with_certificate();
        pipeline.finish().unwrap();
        let certificate = &pipeline.certified().unwrap().as_ref().unwrap().certificate;
        assert_eq!(certificate.coverage, safe.coverage.unwrap(), "{length} mm");
        assert_eq!((safe.is_covered, certificate.coverage.is_enough()), (is_safe, is_safe), "{length} mm: {safe:?}");
    }
}

#[test]
fn a_narrowing_is_a_note_with_its_degree_its_length_and_its_reference() {
    let radius = |z: f64| 3.0 * (1.0 - 0.6 * libm::exp(-(z - 30.0) * (z - 30.0) / 32.0));
    let (_, found) = verdict(&turned(48, 60.0, 0.4, 0.0, radius), true);
    let narrower = found.findings.iter().find(|finding| matches!(finding.what, FindingKind::Narrower { .. }));
    let finding = narrower.unwrap_or_else(|| panic!("{found:?}"));
    let FindingKind::Narrower { percent, length, .. } = finding.what else { unreachable!() };
    // Where the bell is a twentieth.
    let expected = 2.0 * (32.0 * (0.6f64 / 0.05).ln()).sqrt();
    assert!((percent - 60.0).abs() < 2.0 && (length - expected).abs() < 1.8, "{percent} % over {length} mm");
    assert!(!finding.is_grave && (finding.place.as_ref().unwrap().at_mm[2] - 30.0).abs() < 1.0, "{finding:?}");
    let text = finding.what.to_string();
    let told = format!("branch 1 is {percent:.0} % narrower over {length:.1} mm");
    assert!(text.contains(&told) && text.contains(" mm, by the diameters at "), "{text}");
}

#[test]
fn where_nothing_is_smoothed_that_is_a_note_with_a_way_to_smooth() {
    let import =
        read(&write(&tube(3.0, 60.0, 0.7, 0.05), None, Format::Obj).unwrap(), "a.obj", &ImportOptions::default());
    let import = import.unwrap();
    let mesh = Arc::new(import.mesh);
    for (smoothing, expected) in [(Smoothing::NONE, true), (Smoothing::AUTO, false)] {
        let settings = Settings { smoothing, ..Settings::default() };
        let mut pipeline = Pipeline::new(mesh.clone(), settings).with_samples(200);
        pipeline.finish().unwrap();
        let report = Report::new("a.obj", &pipeline).unwrap();
        let found = Verdict::of_run(&pipeline, &report, &import.report, true);
        let note = found.findings.iter().find(|finding| finding.what == FindingKind::NotSmoothed);
        assert_eq!(note.is_some(), expected, "{found:?}");
        let Some(note) = note else { continue };
        let [Remedy { change: Remedied::Settings(settings), .. }] = &note.remedies[..] else { panic!("{note:?}") };
        assert!(!note.is_grave && settings.smoothing == Smoothing::AUTO, "{note:?}");
    }
}

#[test]
fn nothing_is_said_twice() {
    // One triangle more on an inner edge: the reader says so.
    let mut mesh = tube(3.0, 60.0, 0.7, 0.05);
    let [a, b, _] = mesh.triangles[mesh.triangles.len() / 2];
    mesh.positions.push(mesh.positions[a as usize] * 1.2);
    mesh.triangles.push([a, b, mesh.positions.len() as u32 - 1]);
    let import = read(&write(&mesh, None, Format::Obj).unwrap(), "a.obj", &ImportOptions::default()).unwrap();
    assert!(!import.report.warnings.is_empty());
    let mut doubled = import.report.clone();
    doubled.warnings.extend(import.report.warnings.clone());
    let mut pipeline = Pipeline::new(Arc::new(import.mesh), Settings::default()).with_samples(200);
    pipeline.finish().unwrap();
    let report = Report::new("a.obj", &pipeline).unwrap();
    let [once, twice] = [&import.report, &doubled].map(|import| Verdict::of_run(&pipeline, &report, import, true));
    assert_eq!(once, twice);
    let of_file = |verdict: &Verdict| verdict.findings.iter().filter(|finding| finding.what.is_of_file()).count();
    assert_eq!(of_file(&once), import.report.warnings.len());
}
