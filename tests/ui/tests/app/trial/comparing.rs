//! The comparison with the unreduced surface, and the tables.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable;
use lumen::app::PlatformEvent;
use lumen::engine::trial::{TrialCommand, TrialComparison, TrialEvent};
use lumen::phantom::{Sample, generate};
use lumen::trial::setup::Entry;
use lumen::trial::stopwatch::StationResult;
use lumen::trial::summary::Summary;
use lumen::trial::sweep::{Spread, SweepRow};
use lumen_ui_tests::told::told;
use lumen_ui_tests::told::{
    DESKTOP, asked, at_entry, frame, id_of_start, now, on, press, put_on, ready, refused, retarget, says, start, tell,
};
use lumen_ui_tests::{app_in_full, settle};

#[test]
fn the_comparison_asks_for_the_surface_before_reduction_and_shows_its_verdict() {
    let (mut harness, memory) = app_in_full(DESKTOP);
    settle(&mut harness);
    put_on(&mut harness, &memory);
    press(&mut harness, "Compare with the unreduced surface");
    let commands = asked(&memory);
    let Some(TrialCommand::Compare { id, mesh }) = commands.first() else { panic!("{commands:?}") };
    // Table I of the paper.
    assert_eq!(mesh.triangles.len(), 74_307);
    let comparison = TrialComparison {
        verdict: told("At 90 % this wire arrives; its tip path differs by 0.3 mm at most."),
        inserted_mm: vec![0.0, 50.0, 100.0],
        deviation_mm: vec![0.0, 0.3, 0.1],
        tip: vec![[0.0; 3], [0.0, 0.0, 50.0]],
        other_tip: vec![[0.0; 3], [0.3, 0.0, 50.0]],
        smallest_before_mm: 3.21,
        smallest_after_mm: 3.05,
        ..TrialComparison::default()
    };
    let compared = TrialEvent::Compared { id: *id, comparison: Box::new(comparison.clone()) };
    tell(&mut harness, &memory, [compared]);
    assert!(says(&harness, &comparison.verdict.to_string()) && says(&harness, "3.05 mm, was 3.21 mm"));
}

#[test]
fn a_comparison_can_be_cancelled_alone_and_ends_with_its_trial() {
    let (mut harness, memory) = on(DESKTOP);
    let compare = "Compare with the unreduced surface";
    press(&mut harness, compare);
    let Some(TrialCommand::Compare { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    tell(&mut harness, &memory, [TrialEvent::Busy { id, fraction: 0.4 }]);
    assert!(says(&harness, "Comparing: 40 %"));
    press(&mut harness, "Cancel comparison");
    assert_eq!(asked(&memory), [TrialCommand::Cancel { id }]);
    assert!(says(&harness, "12.3 cm"), "the trial stands");
    // What the engine had told before it heard of that.
    let late = TrialComparison { verdict: told("Too late."), ..TrialComparison::default() };
    tell(&mut harness, &memory, [TrialEvent::Compared { id, comparison: Box::new(late) }]);
    assert!(!says(&harness, "Too late."));
    press(&mut harness, compare);
    press(&mut harness, "Restart");
    assert!(!harness.state().trial().is_busy(), "the engine gives up comparing what is no more");
    let Some(TrialCommand::Restart { id }) = asked(&memory).pop() else { panic!("no restart") };
    tell(&mut harness, &memory, [now(id, frame())]);
    press(&mut harness, compare);
    let Some(TrialCommand::Compare { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    tell(&mut harness, &memory, [refused(id, "The wire does not fit.", false)]);
    assert!(says(&harness, "The wire does not fit.") && !harness.state().trial().is_busy());
}

#[test]
fn a_row_that_is_refused_says_why_and_the_tables_are_cancelled_without_the_trial() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Tables III and IV");
    harness.run_steps(3);
    let Some(TrialCommand::Measure { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    tell(&mut harness, &memory, [refused(id, "The lumen is too thin.", true)]);
    assert!(says(&harness, "10 %: The lumen is too thin."));
    let Some(TrialCommand::Measure { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    press(&mut harness, "Cancel tables");
    assert_eq!(asked(&memory), [TrialCommand::Cancel { id }]);
    assert!(says(&harness, "12.3 cm"), "the trial stands");
}

#[test]
fn the_tables_run_one_rate_after_another_and_can_be_cancelled() {
    let (mut harness, memory) = app_in_full(DESKTOP);
    settle(&mut harness);
    press(&mut harness, "Tables III and IV");
    let station = StationResult { simulation_ms: Some(8.0), ..StationResult::default() };
    let summary = Summary {
        success: true,
        initial_simulation_ms: 5.0,
        stations: vec![station; 5],
        wire: "stiff".to_owned(),
        entry: Some(Entry { at: [1.0, 2.0, 3.0], direction: [0.0, 0.0, 1.0] }),
        target: Some([4.0, 5.0, 6.0]),
        ..Summary::default()
    };
    // What the rates leave of 74,307; Table II of the paper has 66,875 for the first.
    for (row, most) in [66_876, 37_153, 18_576].into_iter().enumerate() {
        harness.run_steps(3);
        let commands = asked(&memory);
        let [TrialCommand::Measure { id, mesh, sample, setup }] = &commands[..] else { panic!("{commands:?}") };
        // What the first row proposes is what all are run with.
        let proposed = (false, summary.entry, summary.target);
        let with = (setup.proposes_wire, setup.entry, setup.target);
        assert_eq!(with, if row == 0 { (true, None, None) } else { proposed });
        assert!(row == 0 || setup.wire.name == "stiff");
        assert!((most - 2..=most).contains(&mesh.triangles.len()), "{}", mesh.triangles.len());
        assert_eq!(*sample, Some(Sample::Aorta));
        // Later rows tell of other places, which nothing is taken from.
        let mut told = Box::new(summary.clone());
        if row > 0 {
            (told.entry, told.target) = (None, Some([row as f32; 3]));
        }
        tell(&mut harness, &memory, [TrialEvent::Measured { id: *id, summary: told }]);
    }
    assert!(says(&harness, "yes (no)") && says(&harness, "yes (yes)"), "the paper's beside ours");
    press(&mut harness, "Cancel tables");
    harness.run_steps(3);
    asked(&memory);
    assert!(harness.query_by_role_and_label(Role::Button, "Cancel tables").is_none() && says(&harness, "Cancelled."));
    press(&mut harness, "Run again");
    harness.run_steps(3);
    assert!(matches!(&asked(&memory)[..], [TrialCommand::Measure { .. }]));
}

#[test]
fn a_sweep_follows_the_rows_with_their_wire_beside_the_unreduced_surface() {
    let (mut harness, memory) = app_in_full(DESKTOP);
    settle(&mut harness);
    press(&mut harness, "Tables III and IV");
    let target = Some([4.0, 5.0, 6.0]);
    let summary = Summary { success: true, wire: "stiff".to_owned(), target, ..Summary::default() };
    for _ in 0..5 {
        harness.run_steps(3);
        let Some(TrialCommand::Measure { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
        tell(&mut harness, &memory, [TrialEvent::Measured { id, summary: Box::new(summary.clone()) }]);
    }
    harness.run_steps(3);
    assert_eq!(asked(&memory), []);
    let spread = |largest| Some(Spread { median: largest / 2.0, largest });
    press(&mut harness, "10 seeds a rate");
    for (row, most) in [66_876, 37_153, 18_576].into_iter().enumerate() {
        harness.run_steps(3);
        let commands = asked(&memory);
        let [TrialCommand::Sweep { id, mesh, original, setup, seeds: 10 }] = &commands[..] else {
            panic!("{commands:?}")
        };
        assert_eq!((setup.wire.name.as_str(), setup.target, setup.proposes_wire), ("stiff", target, false));
        assert_eq!(original.triangles.len(), 74_307);
        assert!((most - 2..=most).contains(&mesh.triangles.len()), "{}", mesh.triangles.len());
        let (deviation_mm, noise_mm) = (spread(1.25), spread(0.375));
        let told = match row {
            1 => refused(*id, "The lumen is too thin.", true),
            _ => TrialEvent::Swept {
                id: *id,
                row: SweepRow { seeds: 10, arrived: 9, deviation_mm, noise_mm, ..SweepRow::default() },
            },
        };
        tell(&mut harness, &memory, [told]);
    }
    assert!(says(&harness, "9 of 10") && says(&harness, "1.25") && says(&harness, "50 %: The lumen is too thin."));
    harness.run_steps(3);
    let Some(TrialCommand::Sweep { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    press(&mut harness, "Cancel tables");
    assert_eq!(asked(&memory), [TrialCommand::Cancel { id }]);
    harness.run_steps(3);
    assert!(asked(&memory).is_empty() && says(&harness, "9 of 10"), "what is known stands");
}

#[test]
fn another_surface_closes_the_tables_and_forgets_the_places_of_the_last() {
    let (mut harness, memory) = on(DESKTOP);
    retarget(&mut harness);
    let id = id_of_start(&asked(&memory));
    tell(&mut harness, &memory, [ready(id), now(id, at_entry())]);
    press(&mut harness, "Tables III and IV");
    let Some(TrialCommand::Measure { id, .. }) = asked(&memory).pop() else { panic!("nothing was asked") };
    harness.key_press(Key::Escape);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    press(&mut harness, "Tables III and IV");
    assert!(says(&harness, "Initial fps"));
    asked(&memory);
    let bytes = lumen::io::write(&generate(Sample::Aorta, 4000).unwrap(), None, lumen::io::Format::Stl).unwrap();
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "b.stl".to_owned(), bytes });
    settle(&mut harness);
    assert_eq!(harness.state().state().document.as_ref().unwrap().name, "b.stl");
    assert!(!says(&harness, "Initial fps") && asked(&memory).contains(&TrialCommand::Cancel { id }));
    assert!(!harness.state().trial().is_busy());
    start(&mut harness);
    let commands = asked(&memory);
    let Some(TrialCommand::Start { setup, .. }) = commands.last() else { panic!("{commands:?}") };
    assert_eq!((setup.entry, setup.target), (None, None), "places in one vessel are nowhere in another");
}
