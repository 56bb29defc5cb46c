//! What decimation does, explained: classes on the surface, the curve of the error, the collapses one by one.

use std::collections::BTreeSet;

use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use lumen::app::{LumenApp, PlatformEvent};
use lumen::pipeline::decimation::CollapseStatus;
use lumen::pipeline::progressive::Level;
use lumen::pipeline::settings::Target;
use lumen_ui_tests::{DESKTOP, app, app_in_full, says, seen, settle, tube};

use crate::recovery::tell;
use crate::teaching::click;

fn level(harness: &Harness<'_, LumenApp>) -> Level {
    harness.state().state().document.as_ref().unwrap().shown.as_ref().unwrap().level.clone()
}

fn collapses(harness: &mut Harness<'_, LumenApp>) {
    click(harness, "Learn");
    click(harness, "Collapses, one by one");
    harness.run_steps(3);
}

#[test]
fn the_classes_of_a_tube_are_counted_beside_their_colours() {
    let (mut harness, memory) = seen(|| app(DESKTOP));
    settle(&mut harness);
    let bytes = tube(4.0, 40.0, 0.8);
    tell(&mut harness, &memory, PlatformEvent::Chosen { name: "tube.obj".to_owned(), bytes });
    let view = harness.get_by_role_and_label(Role::Image, "Shaded view").rect();
    let plain = harness.render().unwrap();
    for entry in ["Colour by vertex class", "Feature edges and open ends"] {
        click(&mut harness, "View");
        click(&mut harness, entry);
        harness.key_press(egui::Key::Escape);
        harness.run_steps(3);
    }
    let document = harness.state().state().document.as_ref().unwrap();
    let classes = document.classes().unwrap();
    let vertices: BTreeSet<u32> = level(&harness).triangles.into_flattened().into_iter().collect();
    assert_eq!(classes.counts.iter().sum::<usize>(), vertices.len(), "each vertex has one class");
    let [simple, complex, boundary, edges, corners] = classes.counts;
    assert!(complex == 0 && edges == 0 && corners == 0 && simple > 0);
    // Both rims, and each a closed loop: as many edges as vertices.
    assert_eq!(classes.lines.boundary.len(), boundary);
    let ends = |top: bool| {
        let levels = &document.levels.as_ref().unwrap().1;
        let is_there = |&&[node, _]: &&[u32; 2]| (levels.positions[node as usize].z > 20.0) == top;
        classes.lines.boundary.iter().filter(is_there).count()
    };
    assert!(ends(true) >= 3 && ends(false) >= 3);
    assert!(says(&harness, &format!("simple {simple}, complex 0, boundary {boundary},")));
    let coloured = harness.render().unwrap();
    let at = |x: f32, y: f32| (x as u32, y as u32);
    let (x, y) = at(view.center().x, view.center().y);
    assert_ne!(plain.get_pixel(x, y), coloured.get_pixel(x, y), "the surface has other colours");
}

#[test]
fn a_click_on_the_curve_goes_to_that_rate() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    click(&mut harness, "Error against triangles");
    harness.run_steps(4);
    let levels = harness.state().state().document.as_ref().unwrap().levels.as_ref().unwrap().1.clone();
    let (entering, coarsest) =
        (levels.triangles.len() as f64, levels.triangles_after(levels.errors.len() as u32) as f64);
    for part in [0.75, 0.5] {
        // Without the labels of the axes.
        let plot = |harness: &Harness<'_, LumenApp>| {
            let named = harness.query_all_by_label_contains("Error against triangles:");
            let mut pictures = named.filter(|node| node.accesskit_node().role() == Role::Image);
            pictures.next().map(|node| {
                node.scroll_to_me();
                node.rect()
            })
        };
        plot(&harness);
        harness.run_steps(12);
        let rect = plot(&harness).expect("the plot is there");
        let at = egui::pos2(rect.left() + part * rect.width(), rect.center().y);
        harness.hover_at(at);
        harness.run_steps(1);
        harness.drag_at(at);
        harness.run_steps(1);
        harness.drop_at(at);
        harness.run_steps(2);
        settle(&mut harness);
        assert!(matches!(harness.state().state().settings.target, Target::Reduction(_)));
        let triangles = level(&harness).triangles.len() as f64;
        let expected = coarsest * (entering / coarsest).powf(f64::from(part));
        assert!((triangles / expected).ln().abs() < 0.1, "{triangles} where {expected} were clicked");
        let error = levels.error_after(level(&harness).steps);
        assert!(says(&harness, &format!("{error:.3} mm at")), "{error}");
    }
}

#[test]
fn a_collapse_on_and_one_back_is_the_same_surface() {
    let (mut harness, _) = app(DESKTOP);
    settle(&mut harness);
    collapses(&mut harness);
    let before = level(&harness);
    let next = harness.state().collapses().next().unwrap().clone();
    let camera = *harness.state().camera();
    let levels = harness.state().state().document.as_ref().unwrap().levels.as_ref().unwrap().1.clone();
    assert_eq!(camera.target, levels.positions[next.gone[0] as usize], "the camera is where it happens");
    click(&mut harness, "One on");
    let on = level(&harness);
    assert_eq!(
        (on.steps, on.triangles.len()),
        (before.steps + 1, before.triangles.len() + next.patch.len() - next.hole.len())
    );
    assert!(on.triangles.iter().flatten().all(|node| !next.gone.contains(node)), "what was marked is gone");
    click(&mut harness, "One back");
    assert_eq!(level(&harness), before);
    assert_eq!(harness.state().collapses().next(), Some(&next));
    // Played, they follow one another, and are one step to undo.
    click(&mut harness, "Play");
    harness.run_steps(40);
    assert!(level(&harness).steps > before.steps + 3, "{}", level(&harness).steps);
    click(&mut harness, "Play");
    settle(&mut harness);
    click(&mut harness, "Undo");
    harness.run_steps(3);
    assert_eq!(level(&harness).triangles, before.triangles);
}

#[test]
fn a_vertex_that_is_clicked_says_where_it_may_go() {
    let (mut harness, _) = app_in_full(DESKTOP);
    settle(&mut harness);
    assert!(harness.state().collapses().ways().is_none());
    collapses(&mut harness);
    // What goes next stands in the middle of the view, and some way is open to it: it is about to go.
    let view = harness.get_by_role_and_label(Role::Image, "Wireframe view").rect();
    harness.drag_at(view.center());
    harness.run_steps(1);
    harness.drop_at(view.center());
    harness.run_steps(3);
    let ways = harness.state().collapses().ways().expect("a vertex was asked for").clone();
    assert!(ways.to.iter().any(|(_, fate)| matches!(fate, CollapseStatus::Open | CollapseStatus::Eased)), "{ways:?}");
    let next = harness.state().collapses().next().unwrap();
    assert!(ways.to.iter().any(|(node, _)| *node == next.heir), "its neighbour takes over");
    let triangles = level(&harness).triangles.len();
    let shown: String = format!("In this run it goes at {},{:03} triangles", triangles / 1000, triangles % 1000);
    assert!(says(&harness, &shown), "{shown}");
    assert!(says(&harness, "Crossings are not looked at here."));
}
