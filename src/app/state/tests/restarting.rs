//! Engines that stop by themselves: what is lost, what can still be done, and what starts another.

use super::{Line, agrees, hear, settle, shown, start, stl};
use crate::app::compare::Outcome;
use crate::app::notices::Kind;
use crate::app::state::State;
use crate::engine::{Command, Event};
use crate::io::Format;

/// The engine stops by itself.
fn die(state: &mut State, line: &mut Line) {
    line.is_dead = true;
    state.engine_failed("x", line);
}

/// The engine stops for the third time in a row: it is left alone.
fn die_for_good(state: &mut State, line: &mut Line) {
    (0..3).for_each(|_| die(state, line));
    assert!(line.is_dead);
}

#[test]
fn settings_moved_while_the_engine_starts_again_are_not_lost() {
    let (mut state, mut line) = start();
    die(&mut state, &mut line);
    state.settings.smoothing.iterations += 1;
    state.follow(false, &mut line);
    // They would get there before the surface is read.
    line.deliver();
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn after_the_third_death_what_is_shown_can_still_be_saved() {
    let (mut state, mut line) = start();
    die_for_good(&mut state, &mut line);
    state.save(Format::Stl, &mut line);
    let name = format!("z-{}.stl", shown(&state));
    assert_eq!(settle(&mut state, &mut line), [name]);
    // The one that wrote it has nothing open.
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn after_the_third_death_another_surface_and_a_file_that_is_under_way_both_come() {
    let (mut state, mut line) = start();
    die_for_good(&mut state, &mut line);
    state.save(Format::Ply, &mut line);
    state.open_file("b.stl".into(), stl(12_000), &mut line);
    assert_eq!(settle(&mut state, &mut line).len(), 1);
    assert_eq!(state.document.as_ref().unwrap().name, "b.stl");
    agrees(&state);
}

#[test]
fn a_file_that_dies_with_the_engine_is_said_not_to_be_saved() {
    let (mut state, mut line) = start();
    let name = format!("z-{}.stl", shown(&state));
    let says = |state: &State, what: &str| {
        let notice = state.notices.newest().unwrap();
        assert!(notice.text.contains(&format!("{name} was not saved")) && notice.text.contains(what), "{notice:?}");
    };
    state.save(Format::Stl, &mut line);
    die(&mut state, &mut line);
    says(&state, "(x)");
    assert_eq!(settle(&mut state, &mut line), [""; 0]);
    state.save(Format::Stl, &mut line);
    state.open_file("b.stl".into(), stl(12_000), &mut line);
    state.cancel(&mut line);
    says(&state, "cancelled");
    die_for_good(&mut state, &mut line);
    state.save(Format::Stl, &mut line);
    die(&mut state, &mut line);
    says(&state, "keeps stopping");
    settle(&mut state, &mut line);
    state.save(Format::Stl, &mut line);
    assert_eq!(settle(&mut state, &mut line).len(), 1);
    assert!(state.notices.newest().is_none_or(|notice| !notice.text.contains("not saved")), "{:?}", state.notices);
}

#[test]
fn after_the_third_death_a_comparison_is_tried_again_by_another_engine() {
    let (mut state, mut line) = start();
    state.toggle_comparison();
    state.follow(false, &mut line);
    line.slice();
    die_for_good(&mut state, &mut line);
    settle(&mut state, &mut line);
    assert!(line.is_dead, "it is left alone until something is asked for");
    assert!(state.comparison.cells().iter().all(|cell| matches!(cell.outcome, Outcome::Failed(_))));
    let again = state.comparison.cells()[1].id;
    state.comparison.retry(again);
    settle(&mut state, &mut line);
    assert!(matches!(state.comparison.cells()[1].outcome, Outcome::Done(_)));
    assert!(!state.is_busy() && !state.comparison.is_busy());
}

#[test]
fn a_comparison_that_stops_the_engine_again_is_not_in_progress_for_ever() {
    let (mut state, mut line) = start();
    state.toggle_comparison();
    state.follow(false, &mut line);
    die_for_good(&mut state, &mut line);
    let again = state.comparison.cells()[0].id;
    state.comparison.retry(again);
    state.follow(false, &mut line);
    state.follow(false, &mut line);
    die(&mut state, &mut line);
    settle(&mut state, &mut line);
    assert!(line.is_dead && !state.is_busy() && !state.comparison.is_busy());
    assert!(matches!(state.comparison.cells()[0].outcome, Outcome::Failed(_)));
    assert!(state.notices.newest().is_some_and(|notice| notice.kind == Kind::Wrong));
}

#[test]
fn laplacian_smoothing_is_shown_and_not_asked_for_again_where_the_engine_stopped() {
    let (mut state, mut line) = start();
    let averaged = |state: &State| state.document.as_ref().unwrap().averaged(state.settings.keep).map(|of| of.passes);
    state.shows_averaged = true;
    settle(&mut state, &mut line);
    assert_eq!(averaged(&state), Some(state.settings.smoothing.iterations));
    // It follows the settings.
    state.settings.smoothing.iterations = 7;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    assert_eq!(averaged(&state), Some(7));
    // It may be that which the engine stopped at: started again it is not asked for it.
    state.settings.smoothing.iterations = 9;
    state.follow(false, &mut line);
    die(&mut state, &mut line);
    let asks = |line: &Line| line.sent.iter().any(|command| matches!(command, Command::Average { .. }));
    for _ in 0..20000 {
        state.follow(false, &mut line);
        assert!(!asks(&line), "asked for again");
        let more = line.slice();
        hear(&mut state, &mut line);
        if !more && line.sent.is_empty() {
            break;
        }
    }
    assert!(!state.shows_averaged && averaged(&state).is_none());
    // Nor is anything left of it where no engine is.
    state.shows_averaged = true;
    settle(&mut state, &mut line);
    assert_eq!(averaged(&state), Some(9));
    die_for_good(&mut state, &mut line);
    assert!(!state.shows_averaged && averaged(&state).is_none() && line.is_dead);
    // Wished for again, it starts another.
    state.shows_averaged = true;
    settle(&mut state, &mut line);
    assert_eq!(averaged(&state), Some(9));
    state.shows_averaged = false;
    state.follow(false, &mut line);
    assert_eq!(averaged(&state), None);
}

#[test]
fn a_cancel_that_nobody_can_answer_holds_nothing_up() {
    let (mut state, mut line) = start();
    die_for_good(&mut state, &mut line);
    state.cancel(&mut line);
    settle(&mut state, &mut line);
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
    // One that was on its way when the engine stopped.
    state.settings.smoothing.iterations = 10;
    state.follow(false, &mut line);
    state.cancel(&mut line);
    die_for_good(&mut state, &mut line);
    state.settings.smoothing.iterations = 30;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}

#[test]
fn a_surface_that_another_engine_cannot_open_again_stays_and_that_is_said() {
    let (mut state, mut line) = start();
    let before = shown(&state);
    die(&mut state, &mut line);
    line.sent.clear();
    let id = state.generation();
    state.receive(Event::OpenFailed { id, name: "z.stl".into(), message: "no memory left".into() });
    assert!(
        state
            .notices
            .newest()
            .is_some_and(|notice| notice.kind == Kind::Wrong && notice.text.contains("No memory left."))
    );
    state.cancel(&mut line);
    settle(&mut state, &mut line);
    assert_eq!(shown(&state), before);
    state.settings.smoothing.iterations = 20;
    state.follow(false, &mut line);
    settle(&mut state, &mut line);
    agrees(&state);
}
