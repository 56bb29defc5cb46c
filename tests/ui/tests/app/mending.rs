//! Mending: what is wrong with a file is listed, shown and mended.

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::LumenApp;
use lumen_ui_tests::{DESKTOP, PHONE, app, open, says, seen, settle, settle_wholly, tube, unfold};

fn press(harness: &mut Harness<'_, LumenApp>, role: Role, label: &str) {
    if role != Role::Button || label.contains(": ") {
        harness.get_by_role_and_label(role, label).scroll_to_me();
        harness.run_steps(12);
    }
    harness.get_by_role_and_label(role, label).click();
    harness.run_steps(3);
}

/// A tube of 4 mm and 40 mm with two holes and a fin.
pub(crate) fn faulty() -> Vec<u8> {
    let text = String::from_utf8(tube(4.0, 40.0, 1.0)).unwrap();
    let faces = text.lines().filter(|line| line.starts_with('f')).count();
    let around = (std::f64::consts::TAU * 4.0).ceil() as usize;
    let mut face = 0;
    let mut kept: Vec<&str> = Vec::new();
    for line in text.lines() {
        face += usize::from(line.starts_with('f'));
        let (ring, side) = (face / around, face % around);
        let is_gone = line.starts_with('f')
            && (((10..12).contains(&ring) && (5..7).contains(&side)) || (ring == 25 && side == 15));
        if !is_gone {
            kept.push(line);
        }
    }
    assert!(kept.len() + 5 == text.lines().count() && faces > 900);
    let middle = 18 * around + 3;
    let count = text.lines().count() - faces;
    format!("{}\nv 7 4 18\nf {} {} {}\n", kept.join("\n"), middle + 1, middle, count + 1).into_bytes()
}

/// A tube of 4 mm in one of 5 mm, joined at both rims.
fn wall() -> Vec<u8> {
    let (sides, rings) = (40, 50);
    let mut text = String::new();
    for radius in [5.0, 4.0] {
        for ring in 0..=rings {
            for side in 0..sides {
                let angle = std::f64::consts::TAU * f64::from(side) / f64::from(sides);
                text += &format!("v {} {} {}\n", radius * angle.cos(), radius * angle.sin(), f64::from(ring));
            }
        }
    }
    let at = |wall: i32, ring: i32, side: i32| 1 + (wall * (rings + 1) + ring) * sides + side % sides;
    for side in 0..sides {
        for ring in 0..rings {
            let [a, b, c, d] = [(ring, side), (ring, side + 1), (ring + 1, side + 1), (ring + 1, side)]
                .map(|(ring, side)| (at(0, ring, side), at(1, ring, side)));
            text += &format!("f {} {} {} {}\nf {} {} {} {}\n", a.0, b.0, c.0, d.0, d.1, c.1, b.1, a.1);
        }
        for (ring, turn) in [(0, true), (rings, false)] {
            let [a, b, c, d] = [at(0, ring, side), at(0, ring, side + 1), at(1, ring, side + 1), at(1, ring, side)];
            text += &if turn { format!("f {d} {c} {b} {a}\n") } else { format!("f {a} {b} {c} {d}\n") };
        }
    }
    text.into_bytes()
}

#[test]
fn holes_and_fins_are_listed_shown_one_after_the_other_and_mended() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    settle(&mut harness);
    open(&mut harness, &memory, "faulty.obj", faulty());
    assert!(says(&harness, "needs mending"), "the folded step says it");
    unfold(&mut harness, "Surface");
    assert!(!says(&harness, "needs mending"));
    assert!(says(&harness, "up to 2.8 mm") && says(&harness, "Crowded edges"));
    let before = *harness.state().camera();
    press(&mut harness, Role::Button, "Show: holes");
    let first = *harness.state().camera();
    assert!(first.distance < before.distance, "it goes there");
    assert!(says(&harness, "1 of 2"));
    press(&mut harness, Role::Button, "Next: holes");
    assert!(harness.state().camera().target != first.target, "the other one");
    picture(&mut harness, "mending-desktop-holes");
    press(&mut harness, Role::CheckBox, "Fill holes up to");
    press(&mut harness, Role::CheckBox, "Split crowded edges");
    settle_wholly(&mut harness);
    let state = harness.state().state();
    let done = state.document.as_ref().unwrap().measured.as_ref().unwrap().report.mending.unwrap();
    assert_eq!((done.holes_filled, done.edges_split, done.holes_left), (2, 1, 0));
    assert!(says(&harness, "2 holes filled"));
    press(&mut harness, Role::Button, "Undo");
    settle_wholly(&mut harness);
    assert!(!harness.state().state().settings.mending.split && !says(&harness, "edge split"));
}

#[test]
fn a_wall_is_told_and_its_lumen_taken_at_a_click() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    settle(&mut harness);
    open(&mut harness, &memory, "wall.obj", wall());
    assert!(says(&harness, "The surface is a wall with two sides, 1.0"), "the verdict says it");
    picture(&mut harness, "mending-desktop-wall");
    press(&mut harness, Role::Button, "Take the lumen");
    settle_wholly(&mut harness);
    let state = harness.state().state();
    let document = state.document.as_ref().unwrap();
    assert!(state.settings.mending.lumen);
    assert_eq!(document.opened.triangles.len(), 2 * 40 * 50, "the inner tube");
    assert!(!says(&harness, "The surface is a wall with two sides, 1.0"));
    picture(&mut harness, "mending-desktop-lumen");
    press(&mut harness, Role::Button, "Undo");
    settle_wholly(&mut harness);
    assert_eq!(harness.state().state().document.as_ref().unwrap().opened.triangles.len(), 4 * 40 * 50 + 4 * 40);
}

#[test]
fn a_sound_file_has_nothing_to_mend_and_the_section_is_folded() {
    let (mut harness, _) = app(DESKTOP);
    settle_wholly(&mut harness);
    assert!(!says(&harness, "needs mending"));
    unfold(&mut harness, "Surface");
    assert!(says(&harness, "Mending") && !says(&harness, "Take the lumen"));
    press(&mut harness, Role::DisclosureTriangle, "Mending");
    harness.run_steps(30);
    assert!(says(&harness, "Nothing was found that needs mending."));
}

#[test]
fn a_phone_has_room_for_it() {
    let (mut harness, memory) = seen(|| app(PHONE));
    settle(&mut harness);
    open(&mut harness, &memory, "faulty.obj", faulty());
    unfold(&mut harness, "Surface");
    picture(&mut harness, "mending-phone");
    let button = harness.get_by_role_and_label(Role::Button, "Show: holes").rect();
    assert!(button.right() <= PHONE[0] && button.left() >= 0.0);
}

/// Leaves a picture to look at.
fn picture(harness: &mut Harness<'_, LumenApp>, name: &str) {
    let picture = harness.render().unwrap();
    crate::save(name, [picture.width(), picture.height()], picture.as_raw());
}
