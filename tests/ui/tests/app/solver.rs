//! The step that makes a level ready for a solver, used as a user uses it.

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::LumenApp;
use lumen::app::solver::{Preparation, Shown};
use lumen::prepare::PatchKind;
use lumen::prepare::cuts::ClipAt;
use lumen::prepare::ends::Length;
use lumen::prepare::prepare::Plan;
use lumen_ui_tests::{DESKTOP, PHONE, app, drag, offered, open as open_file, report_page, says, seen, settle, tube};

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
fn the_names_of_ends_stand_neither_on_the_heading_nor_on_each_other() {
    let (mut harness, _) = seen(|| app(DESKTOP));
    settle(&mut harness);
    press(&mut harness, Role::DisclosureTriangle, "For a solver");
    press(&mut harness, Role::Button, "Make ready");
    settle(&mut harness);
    let names = preparation(&harness).names();
    for size in [DESKTOP, PHONE] {
        harness.set_size(size.into());
        settle(&mut harness);
        let mut written: Vec<(String, egui::Rect)> = Vec::new();
        for clipped in &harness.output().shapes {
            let egui::Shape::Text(text) = &clipped.shape else { continue };
            let (words, place) = (text.galley.text(), text.visual_bounding_rect());
            let is_heading = words == "Shaded" || words.starts_with("For a solver: ");
            let is_of_view = is_heading || names[1..].iter().any(|name| name == words);
            // A halo is the same letters a point aside.
            let is_halo = text.override_text_color.is_some() || !clipped.clip_rect.intersects(place);
            if is_of_view && !is_halo {
                written.push((words.to_owned(), place));
            }
        }
        if let Some(folder) = std::env::var_os("LUMEN_SHOTS") {
            let name = std::path::Path::new(&folder).join(format!("solver-{}.png", size[0]));
            harness.render().unwrap().save(name).unwrap();
        }
        assert!(written.iter().filter(|(words, _)| names.contains(words)).count() > 2, "{written:?}");
        for (i, (one, place)) in written.iter().enumerate() {
            for (other, beside) in &written[..i] {
                assert!(!place.shrink(0.5).intersects(beside.shrink(0.5)), "{one} stands on {other} at {size:?}");
            }
        }
    }
}

#[test]
fn a_wrap_is_asked_for_with_its_tolerance() {
    let (mut harness, memory) = open();
    open_file(&mut harness, &memory, "tube.obj", tube(3.0, 40.0, 0.8));
    settle(&mut harness);
    press(&mut harness, Role::CheckBox, "Wrap it watertight");
    assert_eq!(preparation(&harness).plan, Plan { wrap: Some(0.5), ..Plan::flow() });
    assert!(harness.query_by_role_and_label(Role::Slider, "Tolerance").is_some());
    press(&mut harness, Role::Button, "Make ready");
    settle(&mut harness);
    let made = preparation(&harness).made.as_ref().unwrap();
    assert!(made.ready.fate.is_ready() && made.ready.patches.len() == 3, "{:?}", made.ready.notes);
    assert!(says(&harness, "The surface is wrapped, at most"));
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
    assert!(preparation(&harness).made.is_none() && preparation(&harness).shown.is_none());
    memory.borrow_mut().runs = false;
    press(&mut harness, Role::Button, "Make ready");
    assert!(preparation(&harness).is_busy());
    harness.key_press(egui::Key::Escape);
    // The key is heard in the next step: before the work goes on.
    harness.run_steps(2);
    memory.borrow_mut().runs = true;
    settle(&mut harness);
    assert!(!preparation(&harness).is_busy() && preparation(&harness).made.is_none());
    press(&mut harness, Role::Button, "Make ready");
    settle(&mut harness);
    let made = preparation(&harness).made.as_ref().unwrap();
    assert_eq!(made.ready.patches.len(), 3, "a tube has two ends: {:?}", made.ready.notes);
}

#[test]
fn a_cut_is_dragged_and_typed_and_undone_and_what_is_made_is_cut_there() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    open_file(&mut harness, &memory, "tube.obj", tube(3.0, 40.0, 0.8));
    settle(&mut harness);
    press(&mut harness, Role::DisclosureTriangle, "For a solver");
    // How far apart the ends of what is made are, with their extensions.
    let length = |harness: &mut Harness<'_, LumenApp>| {
        press(harness, Role::Button, "Make ready");
        settle(harness);
        let ready = &preparation(harness).made.as_ref().unwrap().ready;
        assert!(ready.fate.is_ready() && ready.patches.len() == 3, "{:?}", ready.notes);
        let [one, other] = [1, 2].map(|end| lumen::mesh::Vec3::from(ready.patches[end].centre.map(|x| x as f32)));
        f64::from(one.distance(other))
    };
    let whole = length(&mut harness);
    press(&mut harness, Role::Button, "Show the cuts");
    settle(&mut harness);
    let planned = preparation(&harness).planned.as_ref().unwrap();
    assert_eq!(planned.found.ends.len(), 2);
    // The tube is round: it is cut just inside of its rims.
    assert!(planned.found.ends.iter().all(|end| end.plane.unwrap().arc_mm < 1.0));
    let first_mm = planned.found.ends[0].plane.unwrap().arc_mm;
    let goes = |harness: &Harness<'_, LumenApp>, end: u32| {
        let found = &preparation(harness).planned.as_ref().unwrap().found;
        let area = |t: usize| lumen::mesh::triangle_area(found.mesh.corners(t));
        (0..found.mesh.triangles.len()).filter(|&t| found.of_triangle[t] == end + 1).map(area).sum::<f64>()
    };
    let before = [goes(&harness, 0), goes(&harness, 1)];

    // The ring of the first end is dragged half way to that of the other.
    let at = |harness: &Harness<'_, LumenApp>, number: u32| {
        let label = format!("Distance of the cut from end {number}");
        harness.get_all_by_role_and_label(Role::Slider, &label).next().unwrap().rect().center()
    };
    let way = at(&harness, 2) - at(&harness, 1);
    let from = at(&harness, 1);
    drag(&mut harness, from, way / 4.0);
    settle(&mut harness);
    let plan = preparation(&harness).plan.clone();
    let [cut] = plan.cuts.as_slice() else { panic!("{plan:?}") };
    let Some(ClipAt::Distance(Length::Mm(mm))) = cut.at else { panic!("{cut:?}") };
    assert!((8.0..12.0).contains(&mm), "a quarter of 40 mm: {mm}");
    // Triangles that the plane cuts stay in part.
    let around = 2.0 * std::f64::consts::PI * 3.0;
    assert!((before[0] + around..mm * around).contains(&goes(&harness, 0)), "{} of {mm} mm", goes(&harness, 0));
    assert_eq!(goes(&harness, 1), before[1]);

    let shorter = length(&mut harness);
    assert!((whole - shorter - (mm - first_mm)).abs() < 0.3, "{shorter} of {whole} with {mm} and not {first_mm} mm");
    press(&mut harness, Role::Button, "Show the cuts");
    settle(&mut harness);
    press(&mut harness, Role::CheckBox, "End 2");
    settle(&mut harness);
    assert_eq!(goes(&harness, 1), 0.0);
    press(&mut harness, Role::Button, "Undo");
    press(&mut harness, Role::Button, "Undo");
    assert_eq!(preparation(&harness).plan, Plan::flow());

    // What is asked of ends is of this surface.
    press(&mut harness, Role::Button, "Redo");
    assert_eq!(preparation(&harness).plan.cuts.len(), 1);
    open_file(&mut harness, &memory, "other.obj", tube(2.0, 30.0, 0.8));
    settle(&mut harness);
    assert_eq!(preparation(&harness).plan, Plan::flow());
    for key in [egui::Key::Z, egui::Key::Z, egui::Key::Y] {
        harness.key_press_modifiers(egui::Modifiers::COMMAND, key);
        harness.run_steps(4);
        assert!(preparation(&harness).plan.cuts.is_empty());
    }
}

#[test]
fn cuts_that_are_cancelled_are_left_and_a_level_that_moves_leaves_them() {
    let (mut harness, memory) = open();
    memory.borrow_mut().runs = false;
    press(&mut harness, Role::Button, "Show the cuts");
    assert!(preparation(&harness).shown == Some(Shown::Cuts));
    harness.key_press(egui::Key::Escape);
    harness.run_steps(2);
    assert!(preparation(&harness).shown.is_none());
    memory.borrow_mut().runs = true;
    settle(&mut harness);
    assert!(preparation(&harness).shown.is_none() && preparation(&harness).planned.is_none());
    press(&mut harness, Role::Button, "Show the cuts");
    settle(&mut harness);
    // The sample has five ends.
    assert_eq!(preparation(&harness).planned.as_ref().unwrap().found.ends.len(), 5);
    press(&mut harness, Role::Button, "Show the level");
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_some());
    press(&mut harness, Role::Button, "Show the cuts");
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_none());
    // Who changes the level looks at the level.
    crate::controls::press_at(&mut harness, "Reduction", 0.5);
    harness.run_steps(4);
    assert!(preparation(&harness).shown.is_none());
    assert!(harness.query_by_role_and_label(Role::Image, "Shaded view").is_some());
}

#[test]
fn a_report_has_the_inlets_and_outlets_while_they_are_of_what_is_asked_for() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    settle(&mut harness);
    press(&mut harness, Role::DisclosureTriangle, "For a solver");
    press(&mut harness, Role::Button, "Make ready");
    settle(&mut harness);
    let report = |harness: &mut Harness<'_, LumenApp>| report_page(harness, &memory);
    let page = report(&mut harness);
    let ready = &preparation(&harness).made.as_ref().unwrap().ready;
    for patch in &ready.patches {
        let cells = format!("<td>{}</td><td>{}</td><td>{:.2}</td>", patch.name, patch.id, patch.area_mm2);
        assert!(page.replace(',', "").contains(&cells), "{cells}");
    }
    press(&mut harness, Role::CheckBox, "Extend each end");
    assert!(!report(&mut harness).contains("outlet_1"));
}
