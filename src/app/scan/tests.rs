//! What is asked of the engine, and what becomes of its answers, without an engine.

use std::collections::VecDeque;
use std::sync::Arc;

use super::*;
use crate::engine::scan::{NamedFile, OpenedScan, ScanCommand, ScanEvent, ScanWork};
use crate::engine::{Link, Source};
use crate::io::ScanWarning;
use crate::language::Key;
use crate::mesh::TriMesh;
use crate::mesh::shapes::icosphere;
use crate::volume::{Axis, Cut, Label, Method, Region, Selection, Survey};

/// A line whose other end is the test.
#[derive(Default)]
struct Line {
    sent: VecDeque<ScanCommand>,
}

impl Link<ScanCommand, ScanEvent> for Line {
    fn send(&mut self, command: ScanCommand) {
        self.sent.push_back(command);
    }

    fn poll(&mut self) -> Option<ScanEvent> {
        None
    }

    fn restart(&mut self) {}

    fn failure(&mut self) -> Option<String> {
        None
    }
}

fn opened(id: u64, range: [f64; 2], labels: Vec<Label>) -> ScanEvent {
    let proposed = (!labels.is_empty()).then_some(Selection::AnyLabel);
    ScanEvent::Opened(Box::new(OpenedScan {
        id,
        format: "NIfTI".to_owned(),
        dimensions: [10, 20, 30],
        spacing_mm: [1.0; 3],
        origin_mm: [0.0; 3],
        directions: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        axes: crate::io::Axes::Unknown,
        bytes: 12_000,
        is_ct: false,
        survey: Survey { range, histogram: vec![1; 256], labels },
        proposed,
        warnings: vec![ScanWarning::Silent { format: "NIfTI".to_owned() }.into()],
        offers: Vec::new(),
        taken: 0,
        names: Vec::new(),
    }))
}

#[test]
fn another_volume_of_the_files_is_read_anew_and_the_one_that_is_shown_stays_until_then() {
    let (mut scans, mut line) = (Scans::default(), Line::default());
    let files = vec![NamedFile::new("phases.dcm", vec![1, 2, 3])];
    scans.read(files.clone(), &mut line);
    assert_eq!(line.sent.pop_back(), Some(ScanCommand::Open { id: 1, files: files.clone(), volume: None }));
    scans.receive(opened(1, [0.0, 9.0], Vec::new()), &mut line);
    scans.act(Action::Volume(1), &mut line);
    assert_eq!(line.sent.pop_back(), Some(ScanCommand::Open { id: 2, files, volume: Some(1) }));
    assert!(scans.is_open() && scans.opening().is_some_and(|(name, ..)| name == "phases"));
    scans.receive(opened(2, [0.0, 5.0], Vec::new()), &mut line);
    assert_eq!(scans.shown().map(|scan| scan.opened.survey.range), Some([0.0, 5.0]));
}

/// A scan of CT that is open, and its line, after what it asked for first.
fn scan() -> (Scans, Line) {
    let (mut scans, mut line) = (Scans::default(), Line::default());
    scans.read(vec![NamedFile::new("head.nii.gz", Vec::new())], &mut line);
    assert!(matches!(line.sent.pop_front(), Some(ScanCommand::Open { id: 1, .. })));
    assert_eq!((scans.opening(), scans.is_open()), (Some(("head", ScanWork::Reading, 0.0)), false));
    assert_eq!(scans.receive(opened(1, [-1024.0, 3071.0], Vec::new()), &mut line), None);
    (scans, line)
}

fn mesh() -> Arc<TriMesh> {
    Arc::new(icosphere(1, 10.0, glam::Vec3::ZERO))
}

#[test]
fn a_scan_begins_with_arteries_and_asks_for_a_preview_at_a_time() {
    let (mut scans, mut line) = scan();
    assert_eq!(scans.shown().unwrap().selection, Selection::Threshold(180.0));
    scans.follow(&mut line);
    scans.follow(&mut line);
    let Some(ScanCommand::Preview { generation, cut: Cut { selection: Selection::Threshold(180.0), .. }, .. }) =
        line.sent.pop_front()
    else {
        panic!("a preview is asked for")
    };
    assert!(matches!(
        line.sent.pop_front(),
        Some(ScanCommand::Slice { axis: Axis::K, index: 14, window: [-150.0, 550.0] })
    ));
    // A slider that is dragged on: the next preview waits for the first.
    scans.act(Action::Select(Selection::Threshold(200.0)), &mut line);
    scans.act(Action::Select(Selection::Threshold(220.0)), &mut line);
    scans.follow(&mut line);
    assert!(line.sent.is_empty());
    scans.receive(ScanEvent::Preview { generation, step: 2, mesh: mesh() }, &mut line);
    scans.follow(&mut line);
    let next = line.sent.pop_front();
    assert!(
        matches!(next, Some(ScanCommand::Preview { cut: Cut { selection: Selection::Threshold(220.0), .. }, .. })),
        "{next:?}"
    );
    assert_eq!(scans.shown().unwrap().preview.as_ref().unwrap().1, 2);
}

#[test]
fn a_mask_begins_with_all_of_it_and_other_scans_half_way() {
    let (mut scans, mut line) = (Scans::default(), Line::default());
    for (range, labels, expected, method) in [
        ([0.0, 4.0], vec![Label { value: 4, points: 9 }], Selection::AnyLabel, Method::SurfaceNets),
        ([0.0, 2000.0], Vec::new(), Selection::Threshold(1000.0), Method::MarchingCubes),
    ] {
        scans.read(vec![NamedFile::new("a", Vec::new())], &mut line);
        let Some(ScanCommand::Open { id, .. }) = line.sent.pop_back() else { panic!("it is read") };
        scans.receive(opened(id, range, labels), &mut line);
        let open = scans.shown().unwrap();
        assert_eq!((open.selection, open.method), (expected, method));
    }
}

#[test]
fn the_surface_is_opened_and_the_scan_left() {
    let (mut scans, mut line) = scan();
    let region = Region { first: [1, 2, 3], last: [8, 9, 9] };
    scans.act(Action::Bound(region), &mut line);
    scans.act(Action::Make, &mut line);
    let Some(ScanCommand::Surface { generation, cut: Cut { region: Some(asked), .. } }) = line.sent.pop_front() else {
        panic!("a surface is asked for")
    };
    assert_eq!(asked, region);
    // While it is made no preview takes its place.
    scans.follow(&mut line);
    assert!(line.sent.iter().all(|command| matches!(command, ScanCommand::Slice { .. })));
    let told = scans.receive(ScanEvent::Surface { generation, mesh: mesh(), threshold: None }, &mut line);
    let expected = Source::Made {
        name: "head".to_owned(),
        format: "NIfTI".to_owned(),
        mesh: mesh(),
        axes: crate::io::Axes::Unknown,
        warnings: vec![ScanWarning::Silent { format: "NIfTI".to_owned() }.into()],
        threshold: None,
    };
    assert_eq!((told, scans.is_open()), (Some(Told::Made(expected)), false));
}

#[test]
fn what_is_refused_is_said_and_what_is_open_stays() {
    let (mut scans, mut line) = scan();
    scans.follow(&mut line);
    let Some(ScanCommand::Preview { generation, .. }) = line.sent.pop_front() else { panic!("a preview is asked for") };
    let sentence = "There is no surface within the box: all of it lies on one side.".to_owned();
    assert_eq!(scans.receive(ScanEvent::Refused { number: generation, sentence: sentence.clone() }, &mut line), None);
    assert_eq!(scans.shown().unwrap().problem.as_ref(), Some(&sentence));
    scans.read(vec![NamedFile::new("letter", Vec::new())], &mut line);
    let Some(ScanCommand::Open { id, .. }) = line.sent.pop_back() else { panic!("it is read") };
    let told = scans.receive(ScanEvent::Refused { number: id, sentence: "It is none.".to_owned() }, &mut line);
    assert_eq!((told, scans.is_open()), (Some(Told::Refused("It is none.".to_owned())), true));
    scans.act(Action::Close, &mut line);
    assert!(!scans.is_open() && line.sent.pop_back() == Some(ScanCommand::Close));
}

#[test]
fn a_scan_on_its_way_in_can_be_stopped_and_the_one_that_is_shown_stays() {
    let (mut scans, mut line) = scan();
    scans.read(vec![NamedFile::new("next.nrrd", Vec::new())], &mut line);
    assert_eq!(scans.receive(ScanEvent::Progress { work: ScanWork::Reading, fraction: 0.5 }, &mut line), None);
    assert_eq!(scans.opening(), Some(("next", ScanWork::Reading, 0.5)));
    scans.act(Action::Cancel, &mut line);
    assert_eq!(line.sent.pop_back(), Some(ScanCommand::Cancel));
    assert_eq!(scans.receive(ScanEvent::Cancelled, &mut line), Some(Told::Stopped));
    assert_eq!((scans.opening(), scans.shown().unwrap().name.as_str()), (None, "head"));
}

#[test]
fn a_scan_is_kept_for_its_slices_until_another_surface_is_open() {
    let (mut scans, mut line) = scan();
    scans.act(Action::Make, &mut line);
    let Some(ScanCommand::Surface { generation, .. }) = line.sent.pop_front() else { panic!("a surface is asked for") };
    let Some(Told::Made(source)) =
        scans.receive(ScanEvent::Surface { generation, mesh: mesh(), threshold: None }, &mut line)
    else {
        panic!("it is opened")
    };
    scans.surface_opened(Some(&source), &mut line);
    scans.follow(&mut line);
    assert!(line.sent.is_empty(), "neither left nor asked before something is shown");
    let mut options = scans.kept(Some(&source)).unwrap().options;
    options.planes[2] = (true, 7);
    scans.act(Action::Slices(options), &mut line);
    scans.follow(&mut line);
    // A slider that is dragged on: the next slice waits for the first.
    options.planes[2] = (true, 9);
    scans.act(Action::Slices(options), &mut line);
    scans.follow(&mut line);
    let window = [-150.0, 550.0];
    assert_eq!(line.sent.drain(..).collect::<Vec<_>>(), [ScanCommand::Slice { axis: Axis::K, index: 7, window }]);
    let corners = [[0.0, 0.0, 7.0], [9.0, 0.0, 7.0], [9.0, 19.0, 7.0], [0.0, 19.0, 7.0]];
    let slice =
        |index| ScanEvent::Slice { axis: Axis::K, index, size: [10, 20], pixels: vec![0; 200], window, corners };
    scans.receive(slice(7), &mut line);
    assert_eq!(scans.kept(Some(&source)).unwrap().shown().len(), 1);
    scans.follow(&mut line);
    assert_eq!(line.sent.pop_front(), Some(ScanCommand::Slice { axis: Axis::K, index: 9, window }));
    // What cannot be had is not asked for again.
    scans.receive(ScanEvent::Refused { number: 0, sentence: "There is no such slice.".to_owned() }, &mut line);
    scans.follow(&mut line);
    assert!(line.sent.is_empty());
    let sample = Source::sample(crate::phantom::Sample::Aorta);
    assert!(scans.kept(Some(&sample)).is_none());
    scans.surface_opened(Some(&sample), &mut line);
    assert_eq!(line.sent.pop_front(), Some(ScanCommand::Close));
    assert!(scans.kept(Some(&source)).is_none());
}

#[test]
fn planes_are_called_after_the_patients_that_they_are_nearest_to() {
    let (mut scans, mut line) = (Scans::default(), Line::default());
    // Columns run to the patient's back and a little up, rows up and a little to the front, slices to the left.
    let directions = [[0.0, 0.96, 0.28], [0.0, -0.28, 0.96], [1.0, 0.0, 0.0]];
    for (axes, names) in [
        (crate::io::Axes::Lps, ["Coronal", "Axial", "Sagittal"]),
        (crate::io::Axes::Unknown, ["Across columns", "Across rows", "Across slices"]),
    ] {
        scans.read(vec![NamedFile::new("a", Vec::new())], &mut line);
        let Some(ScanCommand::Open { id, .. }) = line.sent.pop_back() else { panic!("it is read") };
        let ScanEvent::Opened(facts) = opened(id, [0.0, 2000.0], Vec::new()) else { panic!("it is opened") };
        scans.receive(ScanEvent::Opened(Box::new(OpenedScan { directions, axes, ..*facts })), &mut line);
        scans.act(Action::Make, &mut line);
        let Some(ScanCommand::Surface { generation, .. }) = line.sent.pop_back() else { panic!("it is made") };
        let Some(Told::Made(source)) =
            scans.receive(ScanEvent::Surface { generation, mesh: mesh(), threshold: None }, &mut line)
        else {
            panic!("it is opened")
        };
        assert_eq!(scans.kept(Some(&source)).unwrap().names.map(Key::say), names);
    }
}
