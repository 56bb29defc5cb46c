//! Ambient occlusion, measured: creases are darker, and what is flat or convex is as bright as without.

use glam::{Vec2, Vec3};
use lumen::mesh::{Bounds, TriMesh};
use lumen::render::{Camera, ColourMap, Look, Picture, Style};

use crate::pixel_of;
use crate::shapes::{sphere, square, together};
use crate::stage::{in_front_of, shown, stage};

const SIZE: [u32; 2] = [301, 301];

fn picture(mesh: &TriMesh, camera: &Camera, style: &Style) -> Picture {
    stage().picture(SIZE, camera, &[shown(&stage().surface(mesh), Look::Shaded)], style)
}

/// A picture without it, and one with it.
fn pictures(mesh: &TriMesh, camera: &Camera) -> [Picture; 2] {
    [false, true].map(|occlusion| picture(mesh, camera, &Style { occlusion, ..Style::LIGHT }))
}

fn brightness(picture: &Picture, x: u32, y: u32) -> f32 {
    picture.pixel(x, y).unwrap().map(f32::from).iter().sum()
}

/// How much of its brightness a place keeps.
fn kept([without, with]: &[Picture; 2], camera: &Camera, place: Vec3) -> f32 {
    let at = pixel_of(camera, place, SIZE);
    let [x, y] = [at.x as u32, at.y as u32];
    brightness(with, x, y) / brightness(without, x, y)
}

/// The least that any pixel keeps.
fn least(pictures: &[Picture; 2]) -> f32 {
    let [without, with] = pictures;
    let all = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y)));
    all.map(|(x, y)| brightness(with, x, y) / brightness(without, x, y)).fold(1.0, f32::min)
}

/// From the front, half a right angle above.
fn from_above(mesh: &TriMesh) -> Camera {
    let mut camera = in_front_of(mesh, 1.0);
    camera.orbit(Vec2::new(0.0, 0.25));
    camera.fit(&Bounds::of(&mesh.positions), 1.0);
    camera
}

#[test]
fn the_crease_between_a_wall_and_a_floor_is_darker_and_the_rest_is_not() {
    let floor = TriMesh {
        positions: [(-10.0, -20.0), (10.0, -20.0), (10.0, 0.0), (-10.0, 0.0)]
            .map(|(x, y)| Vec3::new(x, y, -10.0))
            .to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    };
    let corner = together(&square(20.0, 0.0), &floor);
    let camera = from_above(&corner);
    let both = pictures(&corner, &camera);
    for (place, is_crease) in [
        (Vec3::new(0.0, 0.0, -9.7), true),
        (Vec3::new(0.0, -0.3, -10.0), true),
        (Vec3::new(6.0, -0.3, -10.0), true),
        (Vec3::new(0.0, 0.0, 0.0), false),
        (Vec3::new(0.0, -12.0, -10.0), false),
    ] {
        let found = kept(&both, &camera, place);
        assert!(if is_crease { found < 0.93 } else { found > 0.98 }, "{place}: {found}");
    }
    // Behind the surfaces nothing is darker, and the same is drawn each time.
    assert_eq!(both[0].pixel(0, 0), both[1].pixel(0, 0));
    assert_eq!(both, pictures(&corner, &camera));
    // Colours of a map are values.
    let mapped = |occlusion| {
        let map = Some(ColourMap { range: (0.0, 1.0) });
        picture(&corner, &camera, &Style { occlusion, map, ..Style::LIGHT })
    };
    assert_eq!(mapped(true), mapped(false));
}

#[test]
fn what_is_flat_or_convex_is_not_darker() {
    let ball = sphere(10.0, 48);
    let sheet = square(20.0, 0.0);
    for (name, mesh, camera) in [("ball", &ball, in_front_of(&ball, 1.0)), ("sheet", &sheet, from_above(&sheet))] {
        let both = pictures(mesh, &camera);
        let centre = kept(&both, &camera, if name == "ball" { Vec3::new(0.0, -10.0, 0.0) } else { Vec3::ZERO });
        assert!(centre > 0.99, "{name}: {centre}");
        // Wherever it is seen, edge-on too.
        assert!(least(&both) > 0.95, "{name}: {}", least(&both));
    }
}
