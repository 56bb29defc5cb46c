//! The engine without a window: a ball of known size in, its surface out, and what interrupts what.

use std::sync::Arc;

use super::super::machine::Machine;
use super::*;
use crate::mesh::Topology;
use crate::transfer::tests::sent;
use crate::volume::{Axis, Region, Selection};

const RADIUS: f32 = 12.0;

/// A ball of 12 mm around the origin, 64 voxels of half a millimetre along each axis, in MetaImage: 100 at its wall, 10 less
/// for each mm outwards; or a mask of 1 within it.
fn ball(is_mask: bool) -> ScanCommand {
    let mut bytes = b"ObjectType = Image\nNDims = 3\nOffset = -15.75 -15.75 -15.75\nElementSpacing = 0.5 0.5 0.5\n\
        DimSize = 64 64 64\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n"
        .to_vec();
    let along = || (0..64).map(|index| 0.5 * index as f32 - 15.75);
    for (z, y, x) in along().flat_map(|z| along().flat_map(move |y| along().map(move |x| (z, y, x)))) {
        let depth = RADIUS - (x * x + y * y + z * z).sqrt();
        bytes.push(if is_mask { u8::from(depth > 0.0) } else { (100.0 + 10.0 * depth) as u8 });
    }
    ScanCommand::Open { id: 7, files: vec![NamedFile { name: "ball.mha".into(), bytes: Arc::new(bytes) }] }
}

/// Sends a command, lets the engine work until it is done, and says what it told; each message crosses unchanged.
fn run(engine: &mut ScanEngine, command: ScanCommand) -> Vec<ScanEvent> {
    assert_eq!(sent(&command).1.unwrap(), command);
    engine.handle(command);
    while engine.advance(0.0).is_some() {}
    let events: Vec<ScanEvent> = std::iter::from_fn(|| engine.poll()).collect();
    for event in &events {
        assert_eq!(sent(event).1.unwrap(), *event);
    }
    events.into_iter().filter(|event| !ScanEngine::is_passing(event)).collect()
}

fn surface(selection: Selection) -> ScanCommand {
    ScanCommand::Surface { generation: 2, selection, region: None }
}

fn preview(selection: Selection, step: Option<usize>, region: Option<Region>) -> ScanCommand {
    ScanCommand::Preview { generation: 3, selection, region, step }
}

#[test]
fn a_scan_is_opened_previewed_and_cut() {
    let mut engine = ScanEngine::new();
    let [ScanEvent::Opened(opened)] = &run(&mut engine, ball(false))[..] else { panic!("it opens") };
    assert_eq!((opened.id, opened.dimensions, opened.format.as_str()), (7, [64; 3], "MetaImage"));
    assert_eq!((opened.survey.histogram.iter().sum::<u64>(), opened.proposed), (64 * 64 * 64, None));
    let [ScanEvent::Surface { generation: 2, mesh, axes: crate::io::Axes::Lps }] =
        &run(&mut engine, surface(Selection::Threshold(100.0)))[..]
    else {
        panic!("it is cut")
    };
    for p in &mesh.positions {
        // A unit of the samples is a tenth of a millimetre.
        assert!((p.length() - RADIUS).abs() < 0.1, "{p}");
    }
    assert_eq!(Topology::new(mesh.positions.len(), &mesh.triangles).edge_counts().boundary, 0);
    let [ScanEvent::Preview { step: 4, mesh: coarse, .. }] =
        &run(&mut engine, preview(Selection::Threshold(100.0), Some(4), None))[..]
    else {
        panic!("there is a preview")
    };
    assert!(coarse.triangles.len() * 10 < mesh.triangles.len());
    // A block shows its largest value, so the preview is wider by up to three voxels, and lies as far to one side.
    assert!(coarse.positions.iter().all(|p| (RADIUS - 3.0..RADIUS + 3.0).contains(&p.length())));
    let half = Region { first: [32, 0, 0], last: [63; 3] };
    let [ScanEvent::Preview { mesh: half, .. }] =
        &run(&mut engine, preview(Selection::Threshold(100.0), None, Some(half)))[..]
    else {
        panic!("there is half a preview")
    };
    assert!(half.positions.iter().all(|p| p.x > 0.0));
}

#[test]
fn a_mask_proposes_all_of_it_and_slices_are_pictures() {
    let mut engine = ScanEngine::new();
    let [ScanEvent::Opened(opened)] = &run(&mut engine, ball(true))[..] else { panic!("it opens") };
    assert_eq!(opened.proposed, Some(Selection::AnyLabel));
    let picture = ScanCommand::Slice { axis: Axis::K, index: 32, window: [0.0, 1.0] };
    let [ScanEvent::Slice { size: [64, 64], pixels, corners, .. }] = &run(&mut engine, picture)[..] else {
        panic!("there is a picture")
    };
    let area = pixels.iter().filter(|&&grey| grey == 255).count() as f32 * 0.25;
    assert!((area / (std::f32::consts::PI * RADIUS * RADIUS) - 1.0).abs() < 0.01, "{area}");
    assert_eq!(corners[2], [15.75, 15.75, 0.25]);
}

#[test]
fn what_cannot_be_done_is_told_in_a_sentence_and_the_volume_stays() {
    let mut engine = ScanEngine::new();
    let refused = |events: &[ScanEvent]| match events {
        [ScanEvent::Refused { number, sentence }] => (*number, sentence.clone()),
        other => panic!("{other:?}"),
    };
    assert_eq!(refused(&run(&mut engine, surface(Selection::AnyLabel))), (2, "No scan is open yet.".to_owned()));
    run(&mut engine, ball(false));
    let letter = NamedFile { name: "letter".into(), bytes: Arc::new(b"Dear colleague".to_vec()) };
    let (number, sentence) = refused(&run(&mut engine, ScanCommand::Open { id: 9, files: vec![letter] }));
    assert!(number == 9 && sentence.starts_with("\"letter\" is not a volume"), "{sentence}");
    let (number, sentence) = refused(&run(&mut engine, preview(Selection::Threshold(900.0), None, None)));
    assert!(number == 3 && sentence.starts_with("No surface lies at the threshold 900"), "{sentence}");
    let beyond = ScanCommand::Slice { axis: Axis::I, index: 64, window: [0.0, 1.0] };
    assert_eq!(refused(&run(&mut engine, beyond)).1, "There is no such slice.");
    assert!(matches!(run(&mut engine, surface(Selection::Threshold(100.0)))[..], [ScanEvent::Surface { .. }]));
}

#[test]
fn the_newest_command_wins_and_a_cancel_stops() {
    let mut engine = ScanEngine::new();
    run(&mut engine, ball(false));
    engine.handle(surface(Selection::Threshold(100.0)));
    let events = run(&mut engine, preview(Selection::Threshold(110.0), Some(2), None));
    assert!(matches!(events[..], [ScanEvent::Preview { generation: 3, step: 2, .. }]), "the surface was given up");
    engine.handle(surface(Selection::Threshold(100.0)));
    assert_eq!(run(&mut engine, ScanCommand::Cancel), [ScanEvent::Cancelled]);
    assert_eq!(run(&mut engine, ScanCommand::Close), []);
    assert!(matches!(
        run(&mut engine, surface(Selection::Threshold(100.0)))[..],
        [ScanEvent::Refused { number: 2, .. }]
    ));
    run(&mut engine, ball(false));
    // Before it is surveyed, there is nothing to go back to.
    engine.handle(ball(false));
    assert_eq!(run(&mut engine, ScanCommand::Cancel), [ScanEvent::Cancelled]);
    assert!(matches!(run(&mut engine, surface(Selection::Threshold(100.0)))[..], [ScanEvent::Surface { .. }]));
}
