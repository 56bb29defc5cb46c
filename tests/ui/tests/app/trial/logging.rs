//! Logs: saved, opened, replayed.

use std::sync::Arc;

use lumen::app::PlatformEvent;
use lumen::engine::trial::{TrialCommand, TrialEvent};
use lumen::io::import_mesh;
use lumen::phantom::{Sample, generate};
use lumen::trial::course::Course;
use lumen::trial::setup::Setup;
use lumen::trial::wire::Wire;
use lumen_ui_tests::told::{DESKTOP, asked, on, press, ready, says, tell};

#[test]
fn the_log_is_saved_and_a_chosen_one_is_replayed() {
    let (mut harness, memory) = on(DESKTOP);
    press(&mut harness, "Save log");
    assert_eq!(asked(&memory), [TrialCommand::Save]);
    let (csv, json) = ("# schema 1\n".to_owned(), "{\"schema\": 1}".to_owned());
    tell(&mut harness, &memory, [TrialEvent::Saved { csv: csv.clone(), json: json.clone() }]);
    assert_eq!(memory.borrow().pairs, 1, "the user is asked once");
    let offered = memory.borrow().offered.clone();
    assert_eq!(
        offered.iter().map(|(name, _)| &name[..]).collect::<Vec<_>>(),
        ["abdominal-aorta-trial.csv", "abdominal-aorta-trial.json"]
    );
    assert_eq!((&offered[0].1[..], &offered[1].1[..]), (csv.as_bytes(), json.as_bytes()));
    let message = "run.csv and run.json were saved in logs.".to_owned();
    memory.borrow_mut().events.push_back(PlatformEvent::Saved { message: message.clone() });
    harness.run_steps(3);
    assert!(says(&harness, &message));
    press(&mut harness, "Open log...");
    assert_eq!(memory.borrow().asked, 1);
    let chosen = PlatformEvent::Chosen { name: "log.csv".to_owned(), bytes: csv.clone().into_bytes() };
    memory.borrow_mut().events.push_back(chosen);
    harness.run_steps(3);
    let commands = asked(&memory);
    let [TrialCommand::Replay { csv: bytes, .. }] = &commands[..] else { panic!("{commands:?}") };
    assert_eq!(&bytes[..], csv.as_bytes());
}

#[test]
fn a_log_of_another_way_begins_a_trial_with_its_own_wire_and_way() {
    let mesh = Arc::new(import_mesh(generate(Sample::Aorta, 4000).unwrap(), "sample").mesh);
    let mut setup = Setup { wire: Wire::preset("stiff").unwrap(), ..Setup::default() };
    let course = Arc::new(Course::new(&mesh, Some(Sample::Aorta), &mut setup).unwrap());
    let mut run = lumen::trial::session::Trial::new(course, setup.clone()).unwrap();
    (0..20).for_each(|_| run.step());
    let csv = run.log().csv(20).unwrap();
    let (mut harness, memory) = on(DESKTOP);
    let chosen = PlatformEvent::Chosen { name: "log.csv".to_owned(), bytes: csv.clone().into_bytes() };
    press(&mut harness, "Open log...");
    memory.borrow_mut().events.push_back(chosen);
    harness.run_steps(3);
    let commands = asked(&memory);
    let [TrialCommand::Start { id, setup: asked_for, .. }] = &commands[..] else { panic!("{commands:?}") };
    assert_eq!(asked_for, &setup);
    tell(&mut harness, &memory, [ready(*id)]);
    let commands = asked(&memory);
    assert!(
        matches!(&commands[..], [TrialCommand::Replay { csv: bytes, .. }] if bytes[..] == *csv.as_bytes()),
        "{commands:?}"
    );
}
