//! The step that makes a level ready for a solver, used as a user uses it.

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::LumenApp;
use lumen::app::solver::Preparation;
use lumen::prepare::PatchKind;
use lumen::prepare::prepare::{ClipAt, Plan};
use lumen_ui_tests::{DESKTOP, app, offered, open as open_file, says, settle, tube};

/// Brings a control into sight and presses it.
fn press(harness: &mut Harness<'_, LumenApp>, role: Role, label: &str) {
    harness.get_by_role_and_label(role, label).scroll_to_me();
    harness.run_steps(4);
    harness.get_by_role_and_label(role, label).click();
    harness.run_steps(4);
}

fn preparation<'a>(harness: &'a Harness<'_, LumenApp>) -> &'a Preparation {
    &harness.state().state().preparation
}

/// The app with the step unfolded.
fn open() -> (Harness<'static, LumenApp>, std::rc::Rc<std::cell::RefCell<lumen_ui_tests::Memory>>) {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    press(&mut harness, Role::DisclosureTriangle, "For a solver");
    (harness, memory)
}

#[test]
fn a_level_is_made_ready_shown_named_and_saved() {
    let (mut harness, memory) = open();
    press(&mut harness, Role::Button, "Make ready");
    settle(&mut harness);
    let made = preparation(&harness).made.as_ref().unwrap();
    // The sample has five ends.
    assert!(made.ready.fate.is_ready() && made.ready.patches.len() == 6, "{:?}", made.ready.notes);
    let kinds: Vec<PatchKind> = made.ready.patches.iter().map(|patch| patch.kind).collect();
    assert_eq!(kinds[..3], [PatchKind::Wall, PatchKind::Inlet, PatchKind::Outlet]);
    // Edges around a circle of 12 lie on it.
    assert!(made.ready.remeshed.unwrap().0.mean > 0.95);
    assert!(says(&harness, "Nothing was found that stops a volume mesher."));
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded: For a solver").is_some());

    harness.get_by_role_and_label(Role::TextInput, "Name of inlet").scroll_to_me();
    harness.run_steps(4);
    harness.get_by_role_and_label(Role::TextInput, "Name of inlet").click();
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::TextInput, "Name of inlet").focus();
    harness.run_steps(2);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    harness.event(egui::Event::Text("inlet of heart".to_owned()));
    harness.run_steps(2);
    harness.key_press(egui::Key::Enter);
    harness.run_steps(4);
    assert_eq!(preparation(&harness).names()[1], "inlet_of_heart");
    press(&mut harness, Role::Button, "Save for a solver");
    harness.get_by_role_and_label(Role::Button, "STL by patch (OpenFOAM)").click();
    let (name, bytes) = offered(&mut harness, &memory);
    assert!(name.ends_with("-solver.stl"), "{name}");
    let text = String::from_utf8(bytes).unwrap();
    assert_eq!(text.matches("endsolid ").count(), 6);
    assert!(text.contains("solid inlet_of_heart"));

    harness.key_press(egui::Key::Escape);
    harness.run_steps(3);
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_some());
    assert!(preparation(&harness).made.is_some() && !says(&harness, "Made of another level"));
    press(&mut harness, Role::Button, "Show the result");
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded: For a solver").is_some());
}

#[test]
fn the_plan_is_undone_and_what_was_made_by_another_says_so() {
    let (mut harness, _) = open();
    press(&mut harness, Role::Button, "Make ready");
    settle(&mut harness);
    press(&mut harness, Role::CheckBox, "Extend each end");
    assert_eq!(preparation(&harness).plan, Plan { extend: None, ..Plan::flow() });
    assert!(says(&harness, "Made of another level, or by other settings than now."));
    press(&mut harness, Role::ComboBox, "Cut the ends");
    harness.get_by_label("at a distance").click();
    harness.run_steps(4);
    assert!(matches!(preparation(&harness).plan.clip, Some(ClipAt::Distance(_))));
    for _ in 0..2 {
        press(&mut harness, Role::Button, "Undo");
    }
    assert_eq!(preparation(&harness).plan, Plan::flow());
    assert!(!says(&harness, "Made of another level"));
}

#[test]
fn another_surface_forgets_what_was_made_and_a_cancel_ends_the_work() {
    let (mut harness, memory) = open();
    press(&mut harness, Role::Button, "Make ready");
    settle(&mut harness);
    assert!(preparation(&harness).made.is_some());
    open_file(&mut harness, &memory, "tube.obj", tube(3.0, 40.0, 0.8));
    settle(&mut harness);
    assert!(preparation(&harness).made.is_none() && !preparation(&harness).is_open);
    memory.borrow_mut().runs = false;
    press(&mut harness, Role::Button, "Make ready");
    assert!(preparation(&harness).is_busy());
    harness.key_press(egui::Key::Escape);
    memory.borrow_mut().runs = true;
    settle(&mut harness);
    assert!(!preparation(&harness).is_busy() && preparation(&harness).made.is_none());
    press(&mut harness, Role::Button, "Make ready");
    settle(&mut harness);
    let made = preparation(&harness).made.as_ref().unwrap();
    assert_eq!(made.ready.patches.len(), 3, "a tube has two ends: {:?}", made.ready.notes);
}
