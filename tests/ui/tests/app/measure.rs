//! Measures as a user makes them: tools taken up by name, places clicked in a view, on surfaces whose sizes are known.

use std::f32::consts::PI;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use lumen::app::{LumenApp, PlatformEvent};
use lumen::mesh::Vec3;
use lumen::phantom::Sample;
use lumen::pipeline::settings::{Preset, Settings, Target};
use lumen::sharing::measures::{Found, MadeOn, Measure};
use lumen::sharing::{SharedSettings, write_settings};
use lumen_ui_tests::{
    DESKTOP, Memory, PHONE, app, offered, open, report_page, says, seen, settle, settle_wholly, tube,
};

type Shared = std::rc::Rc<std::cell::RefCell<Memory>>;

/// The app with a file open, neither smoothed nor reduced, and the controls of measuring shown.
fn measuring(size: [f32; 2], name: &str, bytes: Vec<u8>) -> (Harness<'static, LumenApp>, Shared) {
    let (mut harness, memory) = app(size);
    settle(&mut harness);
    let settings =
        Settings { smoothing: Preset::None.smoothing(), target: Target::Reduction(0), ..Settings::default() };
    let settings = write_settings(&SharedSettings { unit: None, settings }).into_bytes();
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name: "s.json".to_owned(), bytes: settings });
    harness.run_steps(3);
    open(&mut harness, &memory, name, bytes);
    harness.key_press(Key::M);
    harness.run_steps(3);
    (harness, memory)
}

/// Where a place is in the wireframe view.
fn spot(harness: &Harness<'_, LumenApp>, place: Vec3) -> Pos2 {
    let rect = harness.get_by_role_and_label(Role::Image, "Wireframe view").rect();
    let seen = harness.state().camera().project(place, rect.width() / rect.height()).unwrap();
    rect.center() + vec2(seen.x * rect.width() / 2.0, -seen.y * rect.height() / 2.0)
}

fn take(harness: &mut Harness<'_, LumenApp>, tool: &str) {
    harness.get_by_role_and_label(Role::Button, tool).click();
    harness.run_steps(3);
}

/// Clicks a place in the wireframe view, long after the click before.
fn click(harness: &mut Harness<'_, LumenApp>, place: Vec3) {
    let at = spot(harness, place);
    harness.hover_at(at);
    harness.run_steps(4);
    harness.drag_at(at);
    harness.run_steps(1);
    harness.drop_at(at);
    harness.run_steps(4);
}

fn measures(harness: &Harness<'_, LumenApp>) -> Vec<Measure> {
    harness.state().state().measures.to_vec()
}

/// A box around the origin as an OBJ file; each side in mm.
fn cuboid([x, y, z]: [f32; 3]) -> Vec<u8> {
    let mut text = String::new();
    for i in 0..8 {
        let side = |bit: i32, size: f32| if i >> bit & 1 == 0 { -size / 2.0 } else { size / 2.0 };
        text += &format!("v {} {} {}\n", side(0, x), side(1, y), side(2, z));
    }
    for face in [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]] {
        text += &format!("f {} {} {} {}\n", face[0], face[1], face[2], face[3]);
    }
    text.into_bytes()
}

#[test]
fn a_ruler_and_an_angle_on_a_box_are_those_of_its_places() {
    let (mut harness, _) = measuring(DESKTOP, "box.obj", cuboid([40.0, 30.0, 60.0]));
    // As it was opened.
    harness.key_down(Key::B);
    harness.run_steps(2);
    let face = |x: f32, z: f32| Vec3::new(x, -15.0, z);
    take(&mut harness, "Ruler");
    assert!(says(&harness, "Click the first place on the surface"));
    click(&mut harness, face(-12.0, -20.0));
    assert!(says(&harness, "Click the other end") && measures(&harness).is_empty());
    click(&mut harness, face(12.0, 12.0));
    take(&mut harness, "Angle");
    for place in [face(15.0, 0.0), face(0.0, 0.0), face(0.0, 25.0)] {
        click(&mut harness, place);
    }
    harness.key_up(Key::B);
    harness.run_steps(2);
    let found = measures(&harness);
    let [ruler, angle] = &found[..] else { panic!("{found:?}") };
    let Found::Ruler { ends_mm: [from, to] } = ruler.found else { panic!("{ruler:?}") };
    let length = Vec3::from(from).distance(Vec3::from(to));
    // 24 by 32 mm, to a pixel.
    assert!((length - 40.0).abs() < 0.4, "{length}");
    assert!((from[1] + 15.0).abs() < 1e-3, "on the face");
    assert_eq!((&*ruler.name, ruler.made_on), ("Ruler 1", MadeOn::Opened));
    let degrees: f32 = angle.value().trim_end_matches('°').parse().unwrap();
    assert!((degrees - 90.0).abs() < 1.0, "{degrees}");
    assert!(says(&harness, "As opened"));
}

#[test]
fn wherever_a_tube_is_clicked_its_section_and_its_diameter_are_those_of_the_tube() {
    let (mut harness, _) = measuring(DESKTOP, "tube.obj", tube(4.0, 60.0, 0.8));
    take(&mut harness, "Section");
    for x in [0.0, 2.5, -3.0f32] {
        click(&mut harness, Vec3::new(x, -(16.0 - x * x).sqrt(), 31.0));
    }
    take(&mut harness, "Diameter");
    click(&mut harness, Vec3::new(1.0, -15f32.sqrt(), 25.0));
    let found = measures(&harness);
    let sections: Vec<(f32, [f32; 2])> = found
        .iter()
        .filter_map(|measure| match &measure.found {
            Found::Section { area_mm2, widths_mm, direction, .. } => {
                assert!(direction[2].abs() > 0.999, "square to the tube: {direction:?}");
                Some((*area_mm2, *widths_mm))
            }
            _ => None,
        })
        .collect();
    assert_eq!(sections.len(), 3, "{found:?}");
    for (area, [least, largest]) in sections {
        assert!((area / (PI * 16.0) - 1.0).abs() < 0.03, "{area} mm2");
        assert!((least / 8.0 - 1.0).abs() < 0.03 && (largest / 8.0 - 1.0).abs() < 0.03, "{least} to {largest} mm");
    }
    let Some(Measure { found: Found::Diameter { diameter_mm, centre_mm, .. }, made_on, .. }) = found.last() else {
        panic!("{found:?}")
    };
    assert!((diameter_mm / 8.0 - 1.0).abs() < 0.03, "{diameter_mm} mm");
    assert!(centre_mm[0].abs() < 0.3 && centre_mm[1].abs() < 0.3, "on the axis: {centre_mm:?}");
    let triangles = harness.state().state().document.as_ref().unwrap().shown.as_ref().unwrap().level.triangles.len();
    assert_eq!(*made_on, MadeOn::Level(triangles as u32));
    // Another level is shown: what was measured stays where it was, and says what it was made on.
    harness.key_press(Key::Escape);
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::Slider, "Reduction").focus();
    harness.run_steps(2);
    for _ in 0..5 {
        harness.key_press(Key::ArrowRight);
        harness.run_steps(2);
    }
    settle(&mut harness);
    let shown = harness.state().state().document.as_ref().unwrap().shown.as_ref().unwrap().level.triangles.len();
    assert_ne!(shown, triangles);
    assert_eq!(measures(&harness), found);
}

#[test]
fn what_cannot_be_measured_is_told_in_a_sentence() {
    let (mut harness, _) = measuring(DESKTOP, "sheet.obj", b"v 0 0 0\nv 50 0 0\nv 0 0 50\nf 1 2 3\n".to_vec());
    for (tool, why) in
        [("Section", "There is no centreline"), ("Fork", "There is no centreline"), ("Diameter", "No wall")]
    {
        take(&mut harness, tool);
        click(&mut harness, Vec3::new(12.0, 0.0, 12.0));
        assert!(says(&harness, why), "{tool}");
        assert!(measures(&harness).is_empty());
    }
}

#[test]
fn the_angle_of_the_aortas_fork_is_that_of_its_vessels() {
    let (mut harness, _) = app(DESKTOP);
    settle_wholly(&mut harness);
    harness.key_press(Key::M);
    harness.run_steps(3);
    take(&mut harness, "Fork");
    let vessels = lumen::phantom::vessels(Sample::Aorta);
    let iliacs: Vec<_> = vessels.iter().filter(|vessel| vessel.name.contains("iliac")).collect();
    let [one, other] = &iliacs[..] else { panic!("{} iliac arteries", iliacs.len()) };
    click(&mut harness, one.stations[one.stations.len() / 3].position.as_vec3());
    let found = measures(&harness);
    let [measure] = &found[..] else { panic!("no angle") };
    let degrees: f64 = measure.value().trim_end_matches('°').parse().unwrap();
    // Published: about 50 degrees apart. That of the courses that the sample is made of, a third of the way down:
    let way = |vessel: &lumen::phantom::Vessel| vessel.direction(vessel.stations.len() / 3);
    let expected = way(one).angle_between(way(other)).to_degrees();
    assert!((expected - 50.0).abs() < 5.0, "{expected}");
    assert!((degrees - expected).abs() < 10.0, "{degrees} for {expected}");
}

#[test]
fn measures_are_named_undone_saved_and_closed_with_their_surface() {
    let (mut harness, memory) = measuring(DESKTOP, "tube.obj", tube(4.0, 60.0, 0.8));
    let wall = |z: f32| Vec3::new(0.0, -4.0, z);
    take(&mut harness, "Ruler");
    for z in [10.0, 30.0, 40.0, 45.0] {
        click(&mut harness, wall(z));
    }
    let both = measures(&harness);
    assert_eq!(both.iter().map(|measure| &*measure.name).collect::<Vec<_>>(), ["Ruler 1", "Ruler 2"]);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    assert_eq!(measures(&harness), both[..1]);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Y);
    harness.run_steps(2);
    assert_eq!(measures(&harness), both);
    harness.get_by_role_and_label(Role::Button, "Delete Ruler 1").click();
    harness.run_steps(3);
    assert_eq!(measures(&harness), both[1..]);
    // A name is typed, and is one step to undo.
    harness.get_by_role_and_label(Role::TextInput, "Name of measure 1").click();
    harness.run_steps(2);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    harness.event(egui::Event::Text("Neck".to_owned()));
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(3);
    assert_eq!(measures(&harness)[0].name, "Neck");
    let target = harness.state().camera().target;
    harness.get_by_role_and_label(Role::Button, "Show Neck").click();
    harness.run_steps(3);
    let gone_to = harness.state().camera().target;
    assert!(gone_to != target && (gone_to.z - 42.5).abs() < 0.5, "{gone_to}");
    // The settings' file has it, and gives it back.
    harness.get_by_role_and_label(Role::Button, "Save").click();
    harness.run_steps(3);
    harness.get_by_label("Settings...").click();
    harness.run_steps(3);
    let (name, bytes) = offered(&mut harness, &memory);
    let text = String::from_utf8(bytes.clone()).unwrap();
    assert!(text.contains("Neck") && !text.contains("tube"), "what was measured, and never the name of the file");
    let kept = measures(&harness);
    harness.get_by_role_and_label(Role::Button, "Delete Neck").click();
    harness.run_steps(3);
    let settings = PlatformEvent::Chosen { name: name.clone(), bytes: bytes.clone() };
    memory.borrow_mut().events.push_back(settings);
    harness.run_steps(5);
    assert_eq!(measures(&harness), kept);
    // Another surface has none of them, nor takes them from the file.
    open(&mut harness, &memory, "other.obj", tube(5.0, 60.0, 1.0));
    assert!(measures(&harness).is_empty());
    memory.borrow_mut().events.push_back(PlatformEvent::Chosen { name, bytes });
    harness.run_steps(5);
    assert!(measures(&harness).is_empty());
    assert!(says(&harness, "belong to another surface"));
}

/// The pictures of a web page, as RGB.
fn pictures(page: &str) -> Vec<Vec<u8>> {
    let decoded = |part: &str| {
        let png = STANDARD.decode(part.split('"').next().unwrap()).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut pixels).unwrap();
        pixels
    };
    page.split("data:image/png;base64,").skip(1).map(decoded).collect()
}

#[test]
fn the_report_lists_them_and_draws_them_on_the_plain_surfaces_where_the_views_do() {
    let (mut harness, memory) = seen(|| measuring(DESKTOP, "tube.obj", tube(4.0, 60.0, 0.8)));
    take(&mut harness, "Ruler");
    click(&mut harness, Vec3::new(0.0, -4.0, 10.0));
    click(&mut harness, Vec3::new(0.0, -4.0, 30.0));
    let value = measures(&harness)[0].value();
    let report = |harness: &mut Harness<'_, LumenApp>| report_page(harness, &memory);
    let page = report(&mut harness);
    harness.get_by_role_and_label(Role::CheckBox, "In the views").click();
    harness.run_steps(3);
    let bare = pictures(&report(&mut harness));
    let differing =
        |(a, b): (&Vec<u8>, &Vec<u8>)| a.chunks_exact(3).zip(b.chunks_exact(3)).filter(|(a, b)| a != b).count();
    let drawn: Vec<usize> = pictures(&page).iter().zip(&bare).map(differing).collect();
    // A line of 20 mm, two dots and a label, on the first two of four.
    assert!(drawn.len() == 4 && drawn[..2].iter().all(|&count| count > 2000) && drawn[2..] == [0, 0], "{drawn:?}");
    assert!(page.contains("Measured by hand") && page.contains("Ruler 1") && page.contains(&value), "{value}");
}

#[test]
fn the_clip_plane_opens_the_surface_in_both_views_and_is_flipped() {
    let (mut harness, _) = seen(|| measuring(DESKTOP, "tube.obj", tube(4.0, 60.0, 0.8)));
    let part = |harness: &mut Harness<'_, LumenApp>, z: f32| {
        // Away from where anything would be told of what lies under the pointer.
        harness.hover_at(Pos2::new(4.0, 796.0));
        harness.run_steps(3);
        let (views, at) = (["Shaded view", "Wireframe view"], spot(harness, Vec3::new(0.0, 0.0, z)));
        let wireframe = harness.get_by_role_and_label(Role::Image, "Wireframe view").rect();
        let picture = harness.render().unwrap();
        views.map(|view| {
            let rect = harness.get_by_role_and_label(Role::Image, view).rect();
            let at = rect.min + (at - wireframe.min);
            let around = (-9..10).flat_map(|x| (-9..10).map(move |y| vec2(x as f32, y as f32)));
            Vec::from_iter(around.map(|by| picture.get_pixel((at + by).x as u32, (at + by).y as u32).0))
        })
    };
    let (above, below) = (part(&mut harness, 45.0), part(&mut harness, 15.0));
    harness.get_by_role_and_label(Role::CheckBox, "Clip plane").click();
    harness.run_steps(4);
    let is_other = |a: &[Vec<[u8; 4]>; 2], b: &[Vec<[u8; 4]>; 2]| [a[0] != b[0], a[1] != b[1]];
    assert_eq!(is_other(&part(&mut harness, 45.0), &above), [true; 2], "what is above the plane is left out");
    assert_eq!(is_other(&part(&mut harness, 15.0), &below), [false; 2], "what is below stays");
    // What is left out is not measured on.
    take(&mut harness, "Diameter");
    click(&mut harness, Vec3::new(0.0, -4.0, 45.0));
    assert!(measures(&harness).is_empty());
    click(&mut harness, Vec3::new(0.0, -4.0, 15.0));
    assert_eq!(measures(&harness).len(), 1);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    harness.run_steps(2);
    harness.get_by_role_and_label(Role::Button, "Flip").click();
    harness.run_steps(4);
    assert_eq!(is_other(&part(&mut harness, 15.0), &below), [true; 2]);
    // Dragging the handle up along the tube moves it by as many mm as the hand goes.
    let handle = spot(&harness, Vec3::new(0.0, 0.0, 30.0));
    let to = spot(&harness, Vec3::new(0.0, 0.0, 40.0));
    harness.drag_at(handle);
    harness.run_steps(1);
    for part in [0.3, 0.6, 1.0] {
        harness.hover_at(handle.lerp(to, part));
        harness.run_steps(1);
    }
    harness.drop_at(to);
    harness.run_steps(3);
    let handles: Vec<f64> = harness
        .get_all_by_role_and_label(Role::Slider, "Clip plane handle")
        .filter_map(|handle| egui_kittest::kittest::NodeT::accesskit_node(&handle).numeric_value())
        .collect();
    assert!(handles.len() == 2 && handles.iter().all(|at| (at - 40.0).abs() < 1.5), "{handles:?}");
    harness.get_by_role_and_label(Role::CheckBox, "Clip plane").click();
    harness.run_steps(4);
    assert_eq!(is_other(&part(&mut harness, 45.0), &above), [false; 2]);
}

#[test]
fn escape_takes_off_places_then_the_tool_then_the_controls() {
    let (mut harness, _) = measuring(DESKTOP, "tube.obj", tube(4.0, 60.0, 0.8));
    take(&mut harness, "Ruler");
    click(&mut harness, Vec3::new(0.0, -4.0, 20.0));
    for (says_then, is_open) in [("Click the first place", true), ("Choose a tool", true), ("", false)] {
        harness.key_press(Key::Escape);
        harness.run_steps(3);
        assert!(says(&harness, says_then));
        assert_eq!(harness.query_by_role_and_label(Role::CheckBox, "Clip plane").is_some(), is_open, "{says_then}");
    }
}

#[test]
fn by_keys_alone_a_place_is_the_middle_of_the_view_and_on_a_phone_the_controls_take_the_panel() {
    let (mut harness, _) = measuring(PHONE, "tube.obj", tube(4.0, 60.0, 0.8));
    assert!(harness.query_by_role_and_label(Role::Slider, "Iterations").is_none());
    take(&mut harness, "Diameter");
    if let Some(focused) = harness.ctx.memory(egui::Memory::focused) {
        harness.ctx.memory_mut(|memory| memory.surrender_focus(focused));
    }
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    harness.run_steps(4);
    assert_eq!(measures(&harness).len(), 1);
    harness.get_by_role_and_label(Role::Button, "Back").click();
    harness.run_steps(3);
    assert!(harness.query_by_role_and_label(Role::Slider, "Iterations").is_some());
}
