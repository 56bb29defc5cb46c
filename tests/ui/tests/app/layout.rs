//! The main screens on a phone, a tablet, a laptop and a large screen: nothing lies over something else, and nothing is cut
//! off.

use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Node;
use egui_kittest::kittest::{AccessKitNode, NodeT as _, Queryable as _};
use lumen::app::{NoticeKind, PlatformEvent};
use lumen::language::{self, Language};
use lumen::say;
use lumen_ui_tests::told::{App, FIRST, at_entry, frame, now, press, ready, tell};
use lumen_ui_tests::{app, in_hand, settle_wholly, tube};

use crate::targets::{overlapping, targets, words};

/// Width and height in points, and whether a finger points there.
type Screen = ([f32; 2], bool);

const PHONE: Screen = (lumen_ui_tests::PHONE, true);
const TABLET: Screen = ([768.0, 1024.0], true);
const LAPTOP: Screen = (lumen_ui_tests::DESKTOP, false);
const LARGE: Screen = ([1920.0, 1080.0], false);

/// Tries the main screens in every language, on a small surface.
fn is_laid_out(screen: Screen) {
    for language in Language::ALL {
        language::speak(language, language::built_in(language).unwrap());
        is_laid_out_in(language, screen);
    }
    language::speak(Language::English, &[]);
}

fn is_laid_out_in(language: Language, screen: Screen) {
    let (size, has_finger) = screen;
    let (mut harness, memory) = if has_finger { in_hand(size, 0.25, false) } else { app(size) };
    let bytes = tube(4.0, 60.0, 0.8);
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "tube.obj".to_owned(), bytes });
    harness.run_steps(10);
    settle_wholly(&mut harness);
    let views = [&*say!("views-shaded"), &say!("views-wireframe")];
    let told = |what: &str| format!("{what} in {language:?}");
    check(&harness, &told("as it starts"), screen, &views);
    for (key, what) in [(Key::V, "the vessels"), (Key::M, "the measures")] {
        harness.key_press(key);
        harness.run_steps(4);
        check(&harness, &told(what), screen, &views);
    }
    harness.key_press(Key::M);
    harness.run_steps(4);
    let bytes = b"# vtk DataFile Version 3.0\nct\nBINARY\nDATASET RECTILINEAR_GRID\n".to_vec();
    memory
        .borrow_mut()
        .events
        .push_back(PlatformEvent::Chosen { name: "carotid_of_the_left_side.vtk".to_owned(), bytes });
    harness.run_steps(10);
    let refusal = harness
        .state()
        .state()
        .notices
        .newest()
        .cloned()
        .filter(|notice| notice.kind == NoticeKind::Wrong)
        .expect("a refusal")
        .text;
    check(&harness, &told("a refusal"), screen, &views);
    let label = harness.get_by_label(&refusal);
    let (rect, bar) = (label.rect(), label.accesskit_node().parent().expect("a bar").id());
    let is_in_bar = |node: &Node<'_>| {
        std::iter::successors(node.accesskit_node().parent(), AccessKitNode::parent).any(|above| above.id() == bar)
    };
    let in_bar: Vec<_> = harness.query_all_by_role(Role::Label).filter(is_in_bar).collect();
    assert!(in_bar.len() > 1 || size[0] < 600.0, "nothing else stands in the bar");
    let over = in_bar.iter().filter(|label| label.rect().shrink(1.0).intersects(rect));
    assert_eq!(over.count(), 1, "something else stands where {refusal:?} does on {size:?}");
    let lines = rect.height() / 15.0;
    let least = refusal.len() as f32 * 5.0 / size[0];
    assert!(lines >= least.ceil(), "{lines} lines of {refusal:?} on {size:?}");
    let trial = say!("app-trial");
    for menu in [say!("app-prepare"), say!("app-menu")] {
        let is_there = |name: &str| harness.query_all_by_role_and_label(Role::Button, name).next().is_some();
        if !is_there(&trial) && is_there(&menu) {
            press(&mut harness, &menu);
        }
    }
    press(&mut harness, &trial);
    tell(&mut harness, &memory, [ready(FIRST), now(FIRST, at_entry()), now(FIRST, frame())]);
    let views = [&*say!("trial-view"), &say!("trial-fluoroscopy-view"), &say!("trial-tip-view")];
    check(&harness, &told("the trial"), screen, &views);
    press(&mut harness, &say!("trial-large-name"));
    assert_eq!(overlapping(&harness), [""; 0], "the large fluoroscopy of {size:?} in {language:?}");
}

/// Asserts that the views, the panel and the bars lie side by side in the window, and that what can be hit is whole in them.
fn check(harness: &App, what: &str, ([width, height], has_finger): Screen, views: &[&str]) {
    let what = format!("{what}, {width} x {height}");
    // In points as they are drawn: a large window has larger ones.
    let [width, height] = harness.ctx.content_rect().size().into();
    let views: Vec<_> = views
        .iter()
        .copied()
        .filter_map(|view| harness.query_by_role_and_label(Role::Image, view).map(|node| (view, node.rect())))
        .collect();
    assert!(!views.is_empty(), "{what}: no view");
    let window = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(width, height));
    let top = harness.get_by_role_and_label(Role::Button, &say!("app-open")).rect();
    for (i, (name, view)) in views.iter().enumerate() {
        assert!(window.contains_rect(*view) && view.top() > top.bottom(), "{what}: {name} at {view}");
        assert!(view.width() > 100.0 && view.height() > 60.0, "{what}: {name} at {view} is tiny");
        for (other, rect) in &views[i + 1..] {
            let common = view.intersect(*rect);
            assert!(common.width().min(common.height()) <= 1.0, "{what}: {name} at {view} over {other} at {rect}");
        }
    }
    assert_eq!(overlapping(harness), [""; 0], "{what}: over one another");
    let beyond = |node: &egui_kittest::Node<'_>| node.rect().left() < -0.5 || node.rect().right() > width + 0.5;
    let cut: Vec<_> = targets(harness).iter().filter(|&node| beyond(node)).map(words).collect();
    assert_eq!(cut, [""; 0], "{what}: beyond the window");
    // What stands in the panel at the left does not reach into the views.
    let border = views[0].1.left();
    let status = height - if has_finger { 57.0 } else { 41.0 };
    let is_of_panel = |rect: egui::Rect| {
        let is_of_bars = rect.top() < top.bottom() || rect.bottom() > status && rect.top() < height;
        rect.left() < border - 1.0 && !is_of_bars
    };
    let nodes = targets(harness).into_iter().chain(harness.query_all_by_role(Role::Label));
    let wide: Vec<_> = nodes
        .filter(|node| is_of_panel(node.rect()) && node.rect().right() > border + 0.5)
        .map(|node| words(&node))
        .collect();
    assert!(border < 1.0 || wide.is_empty(), "{what}: from the panel into the views: {wide:?}");
}

#[test]
fn on_a_phone() {
    is_laid_out(PHONE);
}

#[test]
fn on_a_tablet() {
    is_laid_out(TABLET);
}

#[test]
fn on_a_laptop() {
    is_laid_out(LAPTOP);
}

#[test]
fn on_a_large_screen() {
    is_laid_out(LARGE);
}

/// A bar that is higher by a pixel with progress in it than with a notice moves both views, and what is drawn in them, with
/// every piece of work.
#[test]
fn the_views_stay_where_they_are_while_work_is_told() {
    for (size, has_finger) in [PHONE, LAPTOP] {
        let (mut harness, memory) = if has_finger { in_hand(size, 0.25, false) } else { app(size) };
        settle_wholly(&mut harness);
        // The engine waits until its work is told, so that the test meets some however fast it is.
        memory.borrow_mut().runs = false;
        let bytes = tube(3.0, 12.0, 0.5);
        memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "tube.obj".to_owned(), bytes });
        let mut seen = std::collections::BTreeSet::new();
        let (mut working, mut idle) = (0, 0);
        for _ in 0..8000 {
            if idle == 3 {
                break;
            }
            harness.step();
            if let Some(view) = harness.query_by_role_and_label(Role::Image, "Shaded view") {
                let rect = view.rect();
                seen.insert([rect.top(), rect.bottom()].map(|y| (y * 100.0).round() as i64));
            }
            let is_working = harness.query_by_role_and_label(Role::ProgressIndicator, "Progress").is_some();
            working += usize::from(is_working);
            if working == 3 {
                memory.borrow_mut().runs = true;
            }
            let document = harness.state().state().document.as_ref();
            let is_measured = document.is_some_and(|document| document.measured.is_some());
            idle += usize::from(is_measured && !is_working && working >= 3);
        }
        assert!(
            idle == 3 && working > 0 && seen.len() == 1,
            "{size:?}: {working} frames of work, the view at {seen:?}"
        );
    }
}
