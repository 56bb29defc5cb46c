use std::f64::consts::PI;

use glam::DVec3;
use lumen_mesh::shapes::isosurface;
use lumen_mesh::task::at_once;

use super::*;

fn prepared(mesh: &TriMesh, plan: &Plan) -> Prepared {
    at_once(prepare(mesh, plan, &Yielder::never())).expect("a surface that can be prepared")
}

/// Closed and faced outwards.
fn volume(surface: &Patched) -> f64 {
    check(surface).volume_mm3.expect("a closed surface")
}

#[test]
fn of_a_wall_with_two_sides_the_lumen_is_prepared() {
    // A pipe of 2 mm radius inside and 3 mm outside, 24 mm long, closed between the two sides at its rims.
    let (inner, outer, length) = (2.0, 3.0, 24.0);
    let wall = |p: DVec3| {
        let across = (p.x * p.x + p.y * p.y).sqrt();
        (across - inner).min(outer - across).min(p.z).min(length - p.z)
    };
    let mesh = isosurface(DVec3::new(-3.53, -3.57, -0.65), DVec3::new(3.6, 3.6, 24.7), 0.35, wall);
    let clip = Some(ClipAt::Distance(Length::Mm(4.0)));
    let sizing = Sizing { around: 24.0, ..Sizing::default() };
    let plan = Plan { clip, cap: Some(CapKind::Planar), remesh: Some(sizing), ..Plan::default() };
    let found = prepared(&mesh, &plan);
    assert!(found.fate.is_ready() && found.surface.patches.len() == 3, "{:?} {:?}", found.fate, found.notes);
    let lumen = PI * inner * inner;
    assert!((volume(&found.surface) / (lumen * (length - 8.0)) - 1.0).abs() < 0.03, "{}", volume(&found.surface));
    for patch in &found.surface.patches[1..] {
        assert!((patch.area_mm2 / lumen - 1.0).abs() < 0.02, "{patch:?}");
    }
    let is_told = |note: &Note| matches!(note, Note::Lumen { thickness_mm } if (thickness_mm - 1.0).abs() < 0.1);
    assert!(found.notes.iter().any(is_told), "{:?}", found.notes);
    // What is no vessel is remeshed as it is: the wall.
    let sizing = Sizing { around: 6.0, ..sizing };
    let found = prepared(&mesh, &Plan { remesh: Some(sizing), ..Plan::default() });
    let of_wall = PI * (outer * outer - inner * inner) * length;
    assert!((volume(&found.surface) / of_wall - 1.0).abs() < 0.03, "{}", volume(&found.surface));
    // A wrap is one of the lumen, and says so.
    let found = prepared(&mesh, &Plan { clip, wrap: Some(0.5), ..Plan::default() });
    let is_told = |note: &Note| matches!(note, Note::WrapLumen { thickness_mm } if (thickness_mm - 1.0).abs() < 0.1);
    assert!(found.notes.iter().any(is_told), "{:?}", found.notes);
    assert!((volume(&found.surface) / (lumen * (length - 8.0)) - 1.0).abs() < 0.1, "{}", volume(&found.surface));
}
