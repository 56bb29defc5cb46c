//! The engine without a window: a ball of known size in, its surface out, and what interrupts what.

use super::super::machine::Machine;
use super::*;
use crate::mesh::Topology;
use crate::transfer::sent;
use crate::volume::{Axis, Cut, Region, Selection};

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
    ScanCommand::Open { id: 7, files: vec![NamedFile::new("ball.mha", bytes)], volume: None }
}

/// Sends a command, lets the engine work until it is done, and says what it told; each message crosses unchanged.
fn run(engine: &mut ScanEngine, command: ScanCommand) -> Vec<ScanEvent> {
    assert_eq!(sent(&command).1.unwrap(), command);
    engine.handle(command);
    while engine.advance(0.0).is_some() {}
    let events: Vec<ScanEvent> = std::iter::from_fn(|| engine.poll()).collect();
    for event in &events {
        let (head, arrived) = sent(event);
        assert_eq!(is_progress(&head), ScanEngine::is_passing(event));
        assert_eq!(arrived.unwrap(), *event);
    }
    events.into_iter().filter(|event| !ScanEngine::is_passing(event)).collect()
}

fn surface(selection: Selection) -> ScanCommand {
    ScanCommand::Surface { generation: 2, cut: Cut::new(selection) }
}

fn preview(selection: Selection, step: Option<usize>, region: Option<Region>) -> ScanCommand {
    ScanCommand::Preview { generation: 3, cut: Cut { region, ..Cut::new(selection) }, step }
}

#[test]
fn a_scan_is_opened_previewed_and_cut() {
    let mut engine = ScanEngine::new();
    let [ScanEvent::Opened(opened)] = &run(&mut engine, ball(false))[..] else { panic!("it opens") };
    assert_eq!((opened.id, opened.dimensions, opened.format.as_str()), (7, [64; 3], "MetaImage"));
    assert_eq!((opened.survey.histogram.iter().sum::<u64>(), opened.proposed), (64 * 64 * 64, None));
    let [ScanEvent::Surface { generation: 2, mesh, threshold: Some(_) }] =
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
    let letter = NamedFile::new("letter", b"Dear colleague".to_vec());
    let (number, sentence) = refused(&run(&mut engine, ScanCommand::Open { id: 9, files: vec![letter], volume: None }));
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

/// Files in memory, as a shelf.
struct Shelved {
    first: u32,
    files: Vec<Vec<u8>>,
}

impl Shelf for Shelved {
    fn read(&mut self, number: u32, begin: u64, target: &mut [u8]) -> Result<(), String> {
        let file = number.checked_sub(self.first).and_then(|at| self.files.get(at as usize));
        let bytes = file.and_then(|file| file.get(begin as usize..)?.get(..target.len()));
        target.copy_from_slice(bytes.ok_or("The file has gone.")?);
        Ok(())
    }

    fn forget_before(&mut self, number: u32) {
        let passed = (number - self.first) as usize;
        self.files.drain(..passed.min(self.files.len()));
        self.first = number;
    }
}

/// A mask of `along` voxels in each direction in NRRD, a ball of half that size, as one file or as header and data.
fn large(along: usize, is_apart: bool) -> Vec<(String, Vec<u8>)> {
    let header = format!(
        "NRRD0004\ntype: uchar\ndimension: 3\nspace: LPS\nsizes: {along} {along} {along}\nencoding: raw\n{}\n",
        if is_apart { "data file: a.raw\n" } else { "" }
    );
    let distance = |n: usize| (n as f64 - along as f64 / 2.0).powi(2);
    let inside = |at: usize| {
        let squares = distance(at % along) + distance(at / along % along) + distance(at / along / along);
        u8::from(squares < (along as f64 / 4.0).powi(2))
    };
    let data: Vec<u8> = (0..along.pow(3)).map(inside).collect();
    if is_apart {
        vec![("a.raw".to_owned(), data), ("a.nhdr".to_owned(), header.into_bytes())]
    } else {
        vec![("a.nrrd".to_owned(), [header.into_bytes(), data].concat())]
    }
}

/// An engine with files on its shelf from number `first` on, and the command that opens them.
fn with_shelf(first: u32, files: Vec<(String, Vec<u8>)>) -> (ScanEngine, ScanCommand) {
    let (names, files): (Vec<String>, Vec<Vec<u8>>) = files.into_iter().unzip();
    let named = names.into_iter().zip(&files).zip(first..).map(|((name, bytes), number)| NamedFile {
        name,
        contents: Contents::Shelved { number, bytes: bytes.len() as u64 },
    });
    let open = ScanCommand::Open { id: 7, files: named.collect(), volume: None };
    (ScanEngine::with_shelf(Shelved { first: 0, files: [vec![Vec::new(); first as usize], files].concat() }), open)
}

#[test]
fn files_on_the_shelf_are_read_with_progress() {
    for is_apart in [false, true] {
        let (mut engine, open) = with_shelf(2, large(160, is_apart));
        engine.handle(open);
        let mut reading = Vec::new();
        let opened = loop {
            engine.advance(0.0);
            match engine.poll() {
                Some(ScanEvent::Progress { work: ScanWork::Reading, fraction }) => reading.push(fraction),
                Some(ScanEvent::Opened(opened)) => break opened,
                None | Some(ScanEvent::Progress { .. }) => {}
                other => panic!("{other:?}"),
            }
        };
        assert_eq!(opened.dimensions, [160; 3]);
        assert!(reading.is_sorted() && reading.iter().all(|fraction| (0.0..=1.0).contains(fraction)), "{reading:?}");
    }
}

#[test]
fn a_cancel_stops_reading_and_what_was_open_stands() {
    let (mut engine, open) = with_shelf(0, large(160, false));
    run(&mut engine, ball(false));
    engine.handle(open);
    engine.advance(0.0);
    assert_eq!(run(&mut engine, ScanCommand::Cancel), [ScanEvent::Cancelled]);
    assert!(matches!(run(&mut engine, surface(Selection::Threshold(100.0)))[..], [ScanEvent::Surface { .. }]));
}

#[test]
fn a_file_that_has_gone_is_told() {
    let (mut engine, open) = with_shelf(0, large(8, false));
    let ScanCommand::Open { files, .. } = open else { panic!("it opens") };
    let gone = NamedFile { contents: Contents::Shelved { number: 5, bytes: 100 }, ..files[0].clone() };
    assert_eq!(
        run(&mut engine, ScanCommand::Open { id: 8, files: vec![gone], volume: None }),
        [ScanEvent::Refused { number: 8, sentence: "The file has gone.".to_owned() }]
    );
}
