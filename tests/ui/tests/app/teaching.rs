//! Lessons, and the lecture of `docs/teaching.md`, played as it stands there.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::{LumenApp, PlatformEvent};
use lumen::pipeline::settings::{Settings, Target};
use lumen_ui_tests::{DESKTOP, Kept, app, app_in_full, page, says, seen, settle, settle_wholly, tube};

use crate::controls::press_at;
use crate::recovery::{notice, tell};

/// Clicks the control that is called so, once it is there; scrolls to it first.
pub(crate) fn click(harness: &mut Harness<'_, LumenApp>, label: &str) {
    const ROLES: [Role; 4] = [Role::Button, Role::CheckBox, Role::DisclosureTriangle, Role::MenuItem];
    for _ in 0..200 {
        let role = ROLES.into_iter().find(|role| harness.query_all_by_role_and_label(*role, label).next().is_some());
        let Some(role) = role else {
            harness.step();
            continue;
        };
        if let Some(node) = harness.query_all_by_role_and_label(role, label).last() {
            node.scroll_to_me();
        }
        harness.run_steps(12);
        if let Some(node) = harness.query_all_by_role_and_label(role, label).last() {
            node.click();
        }
        harness.run_steps(3);
        return;
    }
    panic!("there is no \"{label}\" to click");
}

/// Waits until a text is shown.
fn see(harness: &mut Harness<'_, LumenApp>, text: &str) {
    for _ in 0..2000 {
        if says(harness, text) {
            return;
        }
        harness.step();
    }
    panic!("\"{text}\" is never shown");
}

fn menu(harness: &mut Harness<'_, LumenApp>, entry: &str) {
    click(harness, "Learn");
    click(harness, entry);
}

#[test]
fn the_lecture_can_be_given_as_it_is_written() {
    let script = include_str!("../../../../docs/teaching.md");
    let lines: Vec<&str> = script.lines().filter(|line| line.starts_with("- ")).collect();
    assert!(lines.len() > 30, "the script is there");
    let (mut harness, memory) = app_in_full(DESKTOP);
    memory.borrow_mut().trial_runs = true;
    settle(&mut harness);
    for line in lines {
        if let Some(path) = line.strip_prefix("- Click: ") {
            path.split(" > ").for_each(|label| click(&mut harness, label));
        } else if let Some(text) = line.strip_prefix("- See: ") {
            see(&mut harness, text);
        } else {
            panic!("neither clicked nor seen: {line}");
        }
    }
    assert!(harness.state().lessons().given().is_none());
    assert!(harness.state().trial().is_open(), "the wire is on the screen");
}

#[test]
fn every_step_of_every_lesson_sets_the_app_and_can_be_gone_back_to() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    for lesson in ["Stair-steps", "Pass band", "Iterations and windows", "Shrinkage", "What decimation keeps"] {
        menu(&mut harness, lesson);
        let given = harness.state().lessons().given().unwrap().clone();
        assert_eq!(given.lesson.title, lesson);
        for (i, step) in given.lesson.steps.iter().enumerate() {
            settle(&mut harness);
            assert_eq!(harness.state().lessons().given().unwrap().step, i);
            assert_eq!(Some(&harness.state().state().settings), step.settings.as_ref(), "{lesson}, {}", step.title);
            let words = &step.title;
            assert!(says(&harness, words), "{words}");
            if i + 1 < given.lesson.steps.len() {
                click(&mut harness, "Next");
            }
        }
        click(&mut harness, "Back");
        let before = &given.lesson.steps[given.lesson.steps.len() - 2];
        assert_eq!(Some(&harness.state().state().settings), before.settings.as_ref());
    }
    // While the engine works, Esc cancels that.
    settle(&mut harness);
    for _ in 0..4 {
        harness.key_press(Key::Escape);
        harness.run_steps(2);
    }
    assert!(harness.state().lessons().given().is_none(), "Esc leaves the lesson");
}

#[test]
fn the_card_stands_beside_what_it_tells_one_to_look_at_and_says_that_it_is_being_measured() {
    const MEASURED: &str = "Being measured: the numbers follow.";
    for size in [DESKTOP, [900.0, 800.0], [390.0, 844.0]] {
        let (mut harness, _) = app(size);
        settle_wholly(&mut harness);
        if harness.query_by_role_and_label(Role::Button, "Learn").is_none() {
            click(&mut harness, "Menu");
        }
        menu(&mut harness, "Pass band");
        let look = harness.get_by_label_contains("Look at").rect();
        for name in ["Shaded view", "Wireframe view"] {
            let view = harness.get_by_role_and_label(Role::Image, name).rect();
            assert!(!view.intersects(look), "{look} over {view} at {size:?}");
            assert_eq!(look.left() >= view.right(), size == DESKTOP, "{look}, {view} at {size:?}");
        }
        click(&mut harness, "Next");
        assert!(says(&harness, MEASURED), "at {size:?}");
        settle_wholly(&mut harness);
        assert!(!says(&harness, MEASURED), "at {size:?}");
    }
}

#[test]
fn a_step_unfolds_what_it_talks_about_and_scrolls_to_it() {
    for (lesson, nexts, plot) in [("Pass band", 2, "Half gain"), ("What decimation keeps", 2, "Error against")] {
        let (mut harness, _) = app(DESKTOP);
        settle_wholly(&mut harness);
        let plots = |harness: &Harness<'_, LumenApp>| {
            let images = harness.query_all_by_role(Role::Image);
            let found =
                images.filter(|node| node.accesskit_node().label().is_some_and(|label| label.starts_with(plot)));
            found.map(|node| node.rect()).collect::<Vec<_>>()
        };
        // Folded by the user, with its step.
        for step in ["Smooth", "Reduce"] {
            click(&mut harness, step);
        }
        assert!(plots(&harness).is_empty());
        menu(&mut harness, lesson);
        for _ in 0..nexts {
            settle_wholly(&mut harness);
            click(&mut harness, "Next");
        }
        settle_wholly(&mut harness);
        harness.run_steps(20);
        let found = plots(&harness);
        let [plot] = found[..] else { panic!("{found:?} in {lesson}") };
        assert!(plot.top() > 270.0 && plot.bottom() < 760.0, "{plot} in {lesson}");
        // It is unfolded once: folded again it stays so.
        click(&mut harness, "Smooth");
        click(&mut harness, "Reduce");
        harness.run_steps(6);
        assert!(plots(&harness).is_empty());
    }
}

#[test]
fn a_teacher_opens_a_lesson_of_his_own_and_is_told_what_is_wrong_with_it() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let file = |text: &str| PlatformEvent::Chosen { name: "Mine.Lesson".to_owned(), bytes: text.into() };
    let text =
        "lumen lesson 1\ntitle: Mine\nstep: Half\ntext: Half of it.\nsettings: reduction=50\nask: Why?\nanswer: So.\n";
    tell(&mut harness, &memory, file(text));
    assert!(says(&harness, "Mine, 1 of 1") && says(&harness, "Half of it."));
    assert_eq!(harness.state().state().settings.target, Target::Reduction(500));
    assert!(!says(&harness, "So."));
    click(&mut harness, "Show the answer");
    assert!(says(&harness, "So."));
    click(&mut harness, "Undo");
    settle(&mut harness);
    assert_eq!(harness.state().state().settings, Settings::default(), "a step is one to undo");
    tell(&mut harness, &memory, file(&text.replace("reduction=50", "reduction=5000")));
    assert!(notice(&harness).starts_with("Mine.Lesson: Line 5 of the lesson:"), "{}", notice(&harness));
    assert!(says(&harness, "Mine, 1 of 1"), "what was given stays");
}

#[test]
fn a_lesson_that_is_closed_gives_back_settings_and_colours() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    press_at(&mut harness, "Iterations", 0.2);
    settle(&mut harness);
    let settings = harness.state().state().settings.clone();
    let options = harness.state().options();
    menu(&mut harness, "What decimation keeps");
    settle(&mut harness);
    assert_ne!(harness.state().options(), options);
    assert_ne!(harness.state().state().settings, settings, "the lesson has its own");
    click(&mut harness, "Next");
    settle(&mut harness);
    harness.key_press(Key::Escape);
    harness.run_steps(3);
    assert!(harness.state().lessons().given().is_none());
    assert_eq!((&harness.state().state().settings, harness.state().options()), (&settings, options));
    assert!(notice(&harness).starts_with("Settings and colours are as they were before the lesson."));
    // Who wants to keep those of the lesson goes a step back.
    click(&mut harness, "Undo");
    assert_ne!(harness.state().state().settings, settings);
    click(&mut harness, "Redo");
    settle(&mut harness);
    assert_eq!(harness.state().state().settings, settings);
}

/// A lesson begins with a sample: the surface that was open before is open again after it, with what was measured there.
#[test]
fn a_lesson_that_is_closed_gives_back_the_file_that_was_open() {
    let (mut harness, memory) = app(DESKTOP);
    settle(&mut harness);
    let bytes = tube(3.0, 12.0, 0.5);
    tell(&mut harness, &memory, PlatformEvent::Chosen { name: "tube.obj".to_owned(), bytes });
    settle(&mut harness);
    press_at(&mut harness, "Iterations", 0.2);
    settle(&mut harness);
    let settings = harness.state().state().settings.clone();
    let name = |harness: &Harness<'_, LumenApp>| harness.state().state().document.as_ref().unwrap().name.clone();
    menu(&mut harness, "What decimation keeps");
    settle(&mut harness);
    assert_eq!(name(&harness), "Abdominal aorta");
    click(&mut harness, "Close lesson");
    settle(&mut harness);
    assert_eq!((name(&harness), &harness.state().state().settings), ("tube.obj".to_owned(), &settings));
    assert!(notice(&harness).starts_with("tube.obj is open again"), "{}", notice(&harness));
}

#[test]
fn a_link_leads_to_a_step_and_a_step_gives_a_link() {
    let (mut harness, memory) = page(DESKTOP, Kept::default());
    settle(&mut harness);
    tell(&mut harness, &memory, PlatformEvent::Linked { fragment: "#lesson=shrinkage&step=2".to_owned() });
    assert!(says(&harness, "Shrinkage, 2 of 4") && says(&harness, "A thin vessel is a short wave"));
    click(&mut harness, "Copy link");
    assert_eq!(notice(&harness), "The link to this step was copied.");
    tell(&mut harness, &memory, PlatformEvent::Linked { fragment: "#lesson=nothing".to_owned() });
    assert!(notice(&harness).starts_with("There is no lesson of that name; there are stair-steps,"));
}

#[test]
fn the_words_are_explained_and_the_papers_named() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    menu(&mut harness, "Glossary");
    assert!(says(&harness, "Two vertices may become one only if"));
    click(&mut harness, "Close");
    assert!(!says(&harness, "Two vertices may become one only if"), "the sheet is closed");
    click(&mut harness, "About");
    assert!(says(&harness, "Mesh Optimization of Vessel Surface Model"));
}

#[test]
fn a_symbol_of_an_equation_lights_its_slider_and_the_slider_lights_the_symbol() {
    let (mut harness, memory) = seen(|| app([1280.0, 1600.0]));
    settle(&mut harness);
    memory.borrow_mut().runs = false;
    let head = harness.query_all_by_role_and_label(Role::DisclosureTriangle, "Equations: Smooth").next().unwrap();
    head.click();
    harness.run_steps(12);
    let equation = harness.get_by_role_and_label(Role::Image, "(3) y' = f(K) y").rect();
    let (band, slider) = ("k_PB = 2 (1 − cos θ)", harness.get_by_role_and_label(Role::Slider, "Pass band").rect());
    let symbol = harness.query_all_by_label_contains(band).next().unwrap().rect();
    let away = egui::pos2(640.0, 20.0);
    let mut picture = |at: egui::Pos2| {
        harness.hover_at(at);
        harness.run_steps(4);
        let picture = harness.render().unwrap();
        picture.enumerate_pixels().map(|(x, y, pixel)| (egui::pos2(x as f32, y as f32), pixel.0)).collect()
    };
    let rest: Vec<(egui::Pos2, [u8; 4])> = picture(away);
    let differs = |a: &[(egui::Pos2, [u8; 4])], b: &[(egui::Pos2, [u8; 4])], rect: egui::Rect| {
        a.iter().zip(b).filter(|((at, a), (_, b))| rect.contains(*at) && a != b).count()
    };
    // The first letter of the line is that of the pass band.
    let lit = picture(symbol.left_center() + egui::vec2(6.0, 0.0));
    assert!(differs(&rest, &lit, slider.expand(3.0)) > 100, "the slider is ringed");
    assert_eq!(differs(&rest, &lit, equation), 0, "the response is another thing");
    let back = picture(slider.center());
    assert!(differs(&rest, &back, symbol) > 20, "the symbol is lit");
    assert_eq!(differs(&rest, &back, equation), 0);
    assert_eq!(differs(&rest, &picture(away), symbol), 0);
}
